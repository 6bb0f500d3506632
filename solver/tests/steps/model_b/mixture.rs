//! One pore pressure for both phases: what it conserves, its operator and its limits.

use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::incompressible::{
    Bed, Continuity, DragForm, Fluid, IncompressibleScene, IncompressibleSimulation, MeanFlux, ParticleSet,
    ProjectionNumerics, Sediment, SedimentLoad, SedimentPressure, SolidFraction, Strata, Stratification, Turbulence,
};
use bagnold_solver::internals::incompressible::{LatticeSums, Operators, state, state_mut, take_mixture};
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::material::suspension_viscosity::SuspensionViscosity;
use bagnold_solver::material::turbulence::GrainRoughness;
use bagnold_solver::vector::Vector;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64;

const SPACING: f64 = 1e-3;
const COLUMNS: usize = 8;
const ROWS: usize = 16;
const FRACTION: f64 = 0.3;
/// One wave over the height `[1/m]`.
const WAVE_NUMBER: f64 = 2.0 * std::f64::consts::PI / (ROWS as f64 * SPACING);
const LAWLESS: Rheology = Rheology::Newtonian(Newtonian { viscosity: 0.0 });

/// A displaced suspension in a periodic box, with velocities by place.
pub(super) fn suspension(
    fluid: impl Fn(Vector<2>) -> Vector<2>,
    sediment: impl Fn(Vector<2>) -> Vector<2>,
    (mean_flux, gravity): (MeanFlux, f64),
) -> IncompressibleSimulation<2> {
    let mut random = Pcg64::seed_from_u64(3);
    let mut places = |offset: f64| -> Vec<Vector<2>> {
        let mut shift = || 0.2 * (random.random::<f64>() - 0.5) + offset;
        let site = |k: usize| ((k % COLUMNS) as f64, (k / COLUMNS) as f64);
        (0..COLUMNS * ROWS)
            .map(|k| Vector::<2>::new(site(k).0 + 0.5 + shift(), site(k).1 + 0.5 + shift()) * SPACING)
            .collect()
    };
    let set = |position: Vec<Vector<2>>, velocity: &dyn Fn(Vector<2>) -> Vector<2>| ParticleSet {
        velocity: position.iter().map(|x| velocity(*x)).collect(),
        position,
    };
    let [length, height] = [COLUMNS, ROWS].map(|count| count as f64 * SPACING);
    let gravity = Vector::<2>::new(0.0, -gravity);
    let scene = IncompressibleScene {
        fluid: Fluid {
            particles: set(places(0.0), &fluid),
            wall: Vec::new(),
            spacing: SPACING,
            density: 1000.0,
            kinematic_viscosity: 1e-6,
            turbulence: Turbulence::Laminar,
            bed: Bed::Slip,
            gravity,
        },
        sediment: Some(Sediment {
            particles: set(places(0.25), &sediment),
            filling: vec![FRACTION; COLUMNS * ROWS],
            wall: Vec::new(),
            spacing: SPACING,
            smoothing_ratio: 1.2,
            density: 2600.0,
            grain_diameter: SPACING,
            drag_diameter: SPACING,
            law: LAWLESS,
            load: SedimentLoad::Stratified,
            pressure: SedimentPressure::None,
            drag: DragLaw::DiFelice,
            drag_form: DragForm::Exchange,
            drag_smoothing_length: 2.0 * SPACING,
            gravity,
        }),
        solid_fraction: SolidFraction::Given(Stratification::of(Strata {
            base: 0.0,
            interval: height,
            solid_fraction: vec![FRACTION],
            packing: 0.64,
            buoyant_weight: 1600.0 * 9.81,
            bed_level: 0.0,
            depth: height,
            suspension_viscosity: SuspensionViscosity::default(),
            grain_roughness: GrainRoughness::default(),
            grain_diameter: SPACING,
        })),
        domain: Domain { axes: [length, height].map(|upper| AxisBoundary::Periodic { lower: 0.0, upper }) },
        numerics: ProjectionNumerics {
            time_step: 5e-4,
            surface_threshold: 0.5,
            // the divergence alone
            density_correction: 0.0,
            pressure_tolerance: 1e-6,
            continuity: Continuity::Mixture,
            mean_flux,
            ..ProjectionNumerics::default()
        },
    };
    IncompressibleSimulation::new(scene).unwrap()
}

fn at_rest(_: Vector<2>) -> Vector<2> {
    Vector::zeros()
}

/// Σ m u of both phases and Σ m `[kg m/s]`, `[kg]`.
fn momentum(simulation: &IncompressibleSimulation<2>) -> (Vector<2>, f64) {
    let sum = |velocities: &[Vector<2>]| velocities.iter().fold(Vector::<2>::zeros(), |sum, u| sum + u);
    let area = SPACING * SPACING;
    let (fluid, grains) = (1000.0 * (1.0 - FRACTION) * area, 2600.0 * FRACTION * area);
    let all = (fluid + grains) * (COLUMNS * ROWS) as f64;
    (sum(simulation.fluid().1) * fluid + sum(simulation.sediment().1) * grains, all)
}

/// 𝒟u `[1/s]` with the coefficients of the last step: its part in cos k z, and its root mean square.
fn divergence(simulation: &IncompressibleSimulation<2>) -> (f64, f64) {
    let operators = operators(simulation);
    let (fluid, sediment) = (simulation.fluid().1, simulation.sediment().1);
    let (mut wave, mut square) = (0.0, 0.0);
    for (a, place) in simulation.fluid().0.iter().enumerate() {
        let value = state(simulation).projection.mixture.divergence(&operators, a, fluid, sediment);
        wave += 2.0 * value * (WAVE_NUMBER * place[1]).cos();
        square += value * value;
    }
    (wave / fluid.len() as f64, (square / fluid.len() as f64).sqrt())
}

fn operators(simulation: &IncompressibleSimulation<2>) -> Operators<'_, 2> {
    Operators {
        poisson: &state(simulation).projection.fluid,
        exchange: &state(simulation).exchange,
        voidage: &state(simulation).viscosities.voidage,
        lattice_gradient: LatticeSums::of(state(simulation).exchange.kernel(), SPACING).gradient,
        fluid_volume: SPACING * SPACING,
        stabilisation: 0.5,
    }
}

#[test]
fn pressure_exchanges_momentum_without_loss() {
    let mut random = Pcg64::seed_from_u64(5);
    let mut velocities: Vec<Vector<2>> = Vec::new();
    velocities.resize_with(2 * COLUMNS * ROWS, || Vector::<2>::from_fn(|_, _| 0.1 * (random.random::<f64>() - 0.5)));
    let cell = |x: Vector<2>| ((x[0] / SPACING) as usize + COLUMNS * (x[1] / SPACING) as usize) % (COLUMNS * ROWS);
    let mut simulation =
        suspension(|x| velocities[cell(x)], |x| velocities[COLUMNS * ROWS + cell(x)], (MeanFlux::Free, 9.81));
    for _ in 0..5 {
        let (before, mass) = momentum(&simulation);
        let time = simulation.time();
        simulation.step().unwrap();
        let impulse = Vector::<2>::new(0.0, -9.81) * (mass * (simulation.time() - time));
        let error = (momentum(&simulation).0 - before - impulse).norm() / impulse.norm();
        assert!(error < 1e-12, "{error}");
    }
}

#[test]
fn operator_is_symmetric_and_positive() {
    let mut simulation = suspension(at_rest, at_rest, (MeanFlux::Zero, 9.81));
    simulation.step().unwrap();
    let mut random = Pcg64::seed_from_u64(7);
    let count = COLUMNS * ROWS;
    let mut field = || (0..count).map(|_| random.random::<f64>() - 0.5).collect::<Vec<f64>>();
    let (p, q) = (field(), field());
    let mut mixture = take_mixture(state_mut(&mut simulation));
    let operators = operators(&simulation);
    let (mut of_p, mut of_q) = (vec![0.0; count], vec![0.0; count]);
    mixture.apply(&operators, &p, &mut of_p);
    mixture.apply(&operators, &q, &mut of_q);
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (one, other) = (dot(&q, &of_p), dot(&p, &of_q));
    assert!((one - other).abs() < 1e-12 * dot(&p, &of_p), "{one} and {other}");
    assert!(dot(&p, &of_p) > 0.0 && dot(&q, &of_q) > 0.0);
}

#[test]
fn the_diagonal_is_that_of_the_operator_that_is_applied() {
    let mut simulation = suspension(at_rest, at_rest, (MeanFlux::Zero, 9.81));
    simulation.step().unwrap();
    let (mut random, count) = (Pcg64::seed_from_u64(9), COLUMNS * ROWS);
    let voidage: Vec<f64> = (0..count).map(|_| 0.5 + 0.4 * random.random::<f64>()).collect();
    let mut mixture = take_mixture(state_mut(&mut simulation));
    let operators = Operators { voidage: &voidage, ..operators(&simulation) };
    let phases = &state(&simulation).phases;
    mixture.assemble(&operators, &phases.fluid, phases.sediment.as_ref().unwrap());
    for a in 0..count {
        let (mut unit, mut product) = (vec![0.0; count], vec![0.0; count]);
        unit[a] = 1.0;
        mixture.apply(&operators, &unit, &mut product);
        let error = product[a] * mixture.inverse_diagonal[a] - 1.0;
        assert!(error.abs() < 1e-12, "{error} in row {a}");
    }
}

#[test]
fn a_sinusoidal_flux_is_projected() {
    // the grains alone begin to gather along a sine: the fluid must give way
    let wave = |x: Vector<2>| Vector::<2>::new(0.0, 1e-2 * (WAVE_NUMBER * x[1]).sin());
    let start = FRACTION * 1e-2 * WAVE_NUMBER;
    let mut simulation = suspension(at_rest, wave, (MeanFlux::Zero, 0.0));
    simulation.step().unwrap();
    let (first, _) = divergence(&simulation);
    for _ in 0..40 {
        simulation.step().unwrap();
    }
    let (last, all) = divergence(&simulation);
    // A + ½ L leaves a third of a smooth divergence, and more of what the displaced particles see between each other
    assert!(first.abs() < 0.4 * start, "{first} of {start}");
    assert!(last.abs() < 0.02 * start && all < 0.1 * start, "{last}, {all} of {start}");
    let moving = simulation.sediment().1.iter().map(|u| u.norm()).fold(0.0, f64::max);
    assert!(moving > 1e-3, "the grains must not have stopped: {moving}");
}

#[test]
fn a_uniform_suspension_has_no_mean_flux_and_the_floor_carries_it() {
    let mut simulation = suspension(at_rest, at_rest, (MeanFlux::Zero, 9.81));
    for _ in 0..200 {
        simulation.step().unwrap();
    }
    let mean = |velocities: &[Vector<2>]| {
        velocities.iter().fold(Vector::<2>::zeros(), |sum, u| sum + u) / velocities.len() as f64
    };
    let (fluid, grains) = (mean(simulation.fluid().1), mean(simulation.sediment().1));
    let flux = fluid * (1.0 - FRACTION) + grains * FRACTION;
    assert!(grains[1] < -0.05 && flux.norm() < 1e-14, "{grains:?} {flux:?}");
    let weight = -9.81 * (1000.0 * (1.0 - FRACTION) + 2600.0 * FRACTION);
    assert!((simulation.mean_pressure_gradient()[1] / weight - 1.0).abs() < 1e-3);
}

#[test]
fn a_mixture_needs_a_solid_fraction_and_grains_without_a_pressure() {
    let scene = || suspension(at_rest, at_rest, (MeanFlux::Zero, 9.81)).scene().clone();
    let overlapping = IncompressibleScene { solid_fraction: SolidFraction::Overlapping, ..scene() };
    let message =
        "`continuity` is mixture, but must be \"fluid\" where grains displace no fluid; change one of the two";
    assert_eq!(overlapping.check().unwrap_err().to_string(), message);
    let mut held = scene();
    held.sediment.as_mut().unwrap().pressure = SedimentPressure::AlongBed;
    assert!(held.check().unwrap_err().to_string().contains("unless there is a sediment without a pressure of its own"));
    let mut of_fluid = scene();
    of_fluid.numerics.continuity = Continuity::Fluid;
    assert!(of_fluid.check().unwrap_err().to_string().starts_with("`mean_flux` is zero, but must be \"free\""));
}
