//! Field that a law keeps of each particle: its diffusion, and its transport with the particle.

use crate::invariants::determinism::column;
use crate::invariants::patches::{
    self, Disorder, EQUATION_OF_STATE, GRAINS, SPACING, advance, bed, block, open_scene, periodic_scene, simulation,
};
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::material::equation_of_state::EquationOfState;
use bagnold_solver::material::rheology::field::{FieldBoundary, FieldDiffusion, FieldReturn, FieldStep, LawField};
use bagnold_solver::material::rheology::open::{OpenFieldLaw, OpenLaw, Parameters, register};
use bagnold_solver::material::rheology::{NonlocalMuI, Rheology, TrialStress};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::numerics::{MomentumOperator, Numerics, PairPrecision};
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::walls::{Surface, wall};
use serde::Deserialize;
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Once;

/// The nonlocal law of the grains that the invariants are tested on.
pub(crate) fn nonlocal() -> Rheology {
    let Rheology::MuI(grains) = GRAINS else { unreachable!("grains") };
    // a diameter of a spacing, so that the fluidity reaches over particles
    Rheology::NonlocalMuI(NonlocalMuI { grain_diameter: SPACING, seed: 1e-4, ..NonlocalMuI::of(grains) })
}

/// A field that does nothing but spread, by explicit steps, in a material without stress.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Spreading {
    strength: f64,
    vanishes_at_surface: f64,
}

impl OpenFieldLaw for Spreading {
    fn field(&self) -> LawField {
        let surface = if self.vanishes_at_surface > 0.0 { FieldBoundary::Vanishing } else { FieldBoundary::NoFlux };
        LawField {
            name: "concentration",
            unit: "-",
            description: "what spreads",
            initial: 0.25,
            bounds: (0.0, 10.0),
            diffusion: Some(FieldDiffusion { strength: self.strength, wall: FieldBoundary::Vanishing, surface }),
        }
    }

    fn end_of_step(&self, trial: &TrialStress<f64>, field: &FieldStep<f64>) -> FieldReturn<f64> {
        let rate = field.gain - field.loss * field.value;
        FieldReturn { shear_stress: 0.0, field: field.value + trial.time_step * rate }
    }

    fn yield_stress(&self, _pressure: f64, _field: &FieldStep<f64>) -> f64 {
        0.0
    }

    fn viscosity(&self, _shear_rate: f64, _pressure: f64) -> f64 {
        0.0
    }

    fn contact_friction(&self) -> f64 {
        0.0
    }
}

fn spreading(strength: f64, surface: FieldBoundary) -> Rheology {
    static ONCE: Once = Once::new();
    let make = |parameters: &Parameters| Ok(OpenLaw::with_field(parameters.read::<Spreading>()?));
    ONCE.call_once(|| register("spreading", make).expect("a new name"));
    let vanishes = if surface == FieldBoundary::Vanishing { 1.0 } else { 0.0 };
    Rheology::open("spreading", &[("strength", strength), ("vanishes_at_surface", vanishes)]).expect("a law")
}

/// k h of the first mode of a layer at rest on a bed, from its decay.
fn first_mode<const D: usize>(cells: [usize; D], jitter: f64, surface: FieldBoundary, precision: PairPrecision) -> f64
where
    Simulation<D>: Compiled<D>,
{
    let mut scene = open_scene(block(cells, Disorder { jitter, ..Disorder::NONE }, 23));
    for axis in 0..D - 1 {
        scene.domain.axes[axis] = AxisBoundary::Periodic { lower: 0.0, upper: cells[axis] as f64 * SPACING };
    }
    scene.walls = vec![bed()];
    let extent = Vector::<D>::from_fn(|axis, _| cells[axis] as f64 * SPACING);
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, (Vector::zeros(), extent), SPACING, 4);
    scene.numerics.pair_precision = precision;
    let height = cells[D - 1] as f64 * SPACING;
    let phase = if surface == FieldBoundary::Vanishing { PI } else { FRAC_PI_2 };
    // no step moves anything, so that all are equally long
    let step = simulation(scene.clone()).time_step_bounds().step();
    scene.flow.field = scene.flow.position.iter().map(|x| (phase * x[D - 1] / height).sin().max(0.0)).collect();
    // D Δt Σ w is well below 1, also of a particle between wall and surface
    let strength = 0.05 * SPACING * SPACING / step;
    scene.rheology = spreading(strength, surface);
    let mut simulation = simulation(scene);
    let size = |simulation: &Simulation<D>| simulation.snapshot().field.iter().map(|f| f * f).sum::<f64>().sqrt();
    let (settling, steps) = (250, 150);
    advance(&mut simulation, settling);
    let before = size(&simulation);
    advance(&mut simulation, steps);
    let factor = (size(&simulation) / before).powf(1.0 / steps as f64);
    height * ((1.0 - factor) / (strength * step)).sqrt()
}

/// k h over the exact π or π/2. On a lattice the rest is that of the wall's and the surface's weights; the disorder of particles
/// that have lost it changes it by less than a per cent.
#[test]
fn a_field_of_a_layer_decays_by_its_first_mode() {
    let check = |name: &str, found: f64, phase: f64, allowed: f64| {
        println!("{name}: k h / exact = {:.4}", found / phase);
        assert!((found / phase - 1.0).abs() < allowed, "{name}: {found} for {phase}");
    };
    for (surface, phase) in [(FieldBoundary::Vanishing, PI), (FieldBoundary::NoFlux, FRAC_PI_2)] {
        for (jitter, allowed) in [(0.0, 0.003), (0.1, 0.006)] {
            let plane = first_mode([12, 20], jitter, surface, PairPrecision::Double);
            check(&format!("plane, {surface:?}, jitter {jitter}"), plane, phase, allowed);
            let space = first_mode([6, 6, 20], jitter, surface, PairPrecision::Single);
            check(&format!("space, {surface:?}, jitter {jitter}"), space, phase, allowed);
        }
    }
    let of = |precision| first_mode([12, 20], 0.1, FieldBoundary::Vanishing, precision);
    let (double, single) = (of(PairPrecision::Double), of(PairPrecision::Single));
    assert!((single / double - 1.0).abs() < 1e-5, "{single} and {double} in both precisions");
}

/// A block without walls or surface keeps what it has, and nothing becomes negative.
#[test]
fn a_field_is_conserved_and_stays_positive() {
    fn check<const D: usize>(cells: [usize; D])
    where
        Simulation<D>: Compiled<D>,
    {
        let mut scene = periodic_scene(cells, Disorder { jitter: 0.2, ..Disorder::NONE }, 3);
        let step = simulation(scene.clone()).time_step_bounds().step();
        scene.rheology = spreading(0.1 * SPACING * SPACING / step, FieldBoundary::Vanishing);
        scene.flow.field = (0..scene.flow.position.len()).map(|k| if k % 7 == 0 { 1.0 } else { 0.0 }).collect();
        let mut simulation = simulation(scene);
        let content = |simulation: &Simulation<D>| simulation.snapshot().field.iter().sum::<f64>();
        let before = content(&simulation);
        advance(&mut simulation, 60);
        let end = simulation.snapshot().field;
        let (least, most) = (end.iter().copied().fold(1.0, f64::min), end.iter().copied().fold(0.0, f64::max));
        assert!((content(&simulation) / before - 1.0).abs() < 1e-13);
        assert!(least > 0.0 && most < 0.5, "between {least} and {most}");
    }
    check([15, 13]);
    check([7, 8, 9]);
}

/// A smooth wall and a mirror let nothing through.
#[test]
fn smooth_walls_and_mirrors_take_nothing() {
    let mut scene = open_scene(block([12, 8], Disorder { jitter: 0.1, ..Disorder::NONE }, 5));
    scene.domain.axes[0] = AxisBoundary::Mirror { lower: Some(0.0), upper: Some(12.0 * SPACING) };
    let mut smooth = bed();
    smooth.roughness = Surface::Smooth;
    scene.walls = vec![smooth];
    let extent = (Vector::zeros(), Vector::<2>::new(12.0 * SPACING, 8.0 * SPACING));
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, extent, SPACING, 4);
    scene.rheology = spreading(0.01, FieldBoundary::NoFlux);
    scene.flow.field = scene.flow.position.iter().map(|x| 1.0 + x[0] / SPACING / 12.0).collect();
    let mut simulation = simulation(scene);
    let content = |simulation: &Simulation<2>| simulation.snapshot().field.iter().sum::<f64>();
    let before = content(&simulation);
    advance(&mut simulation, 100);
    assert!((content(&simulation) / before - 1.0).abs() < 1e-12, "{} of {before}", content(&simulation));
}

/// The column of the other tests of identical bits, under the nonlocal law: it creeps from its seed.
pub(crate) fn flowing<const D: usize>(cells: [usize; D]) -> Scene<D> {
    let mut scene = column(cells);
    scene.rheology = nonlocal();
    scene.flow.field = scene.flow.position.iter().map(|x| 5.0 + x[0] / SPACING).collect();
    scene
}

#[test]
fn a_field_goes_with_its_particle() {
    // a memory that nothing changes, sorted with what moves
    let mut scene = column([40, 30]);
    scene.rheology = spreading(0.0, FieldBoundary::NoFlux);
    scene.enclosure.exits.upper = Vector::<2>::new(0.41, f64::INFINITY);
    let count = scene.flow.position.len();
    scene.flow.field = (0..count).map(|identity| identity as f64 / count as f64).collect();
    scene.flow.velocity.iter_mut().for_each(|velocity| velocity[0] += 1.0);
    let mut simulation = simulation(scene);
    advance(&mut simulation, 200);
    assert!(simulation.neighbour_searches() > 3 && simulation.outflow().particles() > 10);
    let particles = simulation.particles();
    for index in 0..particles.flow_count() {
        let field = particles.field.as_ref().expect("a field")[index];
        assert_eq!(field, f64::from(particles.identity[index]) / count as f64);
    }
}

#[test]
fn fields_that_do_not_fit_are_refused() {
    let message = |change: fn(&mut Scene<2>)| {
        let mut scene = flowing([20, 12]);
        change(&mut scene);
        Simulation::new(scene).expect_err("refused").to_string()
    };
    assert_eq!(
        message(|scene| scene.flow.field.truncate(7)),
        "the flow's field has 7 entries, but there are 240 positions"
    );
    assert_eq!(
        message(|scene| scene.flow.field[3] = -1.0),
        "the fluidity of particle 3 is -1, but must be finite and in the range that its law gives"
    );
    assert_eq!(
        message(|scene| scene.rheology = GRAINS),
        "the flow gives 240 particles a field, but its law `mu-i` has none; leave the field out"
    );
    let operator = message(|scene| {
        scene.numerics = Numerics { momentum_operator: MomentumOperator::Pairwise, ..Numerics::paper() };
    });
    assert!(
        operator.starts_with("momentum_operator is pairwise") || operator.contains("momentum_operator"),
        "{operator}"
    );
    // a state of another law
    let saved = simulation(flowing([20, 12]));
    let mut other = column([20, 12]);
    other.rheology = GRAINS;
    assert!(Simulation::continued(other, saved.save()).is_err());
}

#[test]
fn inflow_has_the_initial_value() {
    let mut scene = crate::invariants::inlets::fed();
    scene.rheology = spreading(0.0, FieldBoundary::NoFlux);
    scene.flow.field = vec![1.0; scene.flow.position.len()];
    let begun = scene.flow.position.len() as u32;
    let mut simulation = simulation(scene);
    patches::advance(&mut simulation, 120);
    let particles = simulation.particles();
    let field = particles.field.as_ref().expect("a field");
    let arrived = (0..particles.flow_count()).filter(|&index| particles.identity[index] >= begun);
    let values: Vec<f64> = arrived.map(|index| field[index]).collect();
    assert!(values.len() > 5 && values.iter().all(|&value| value == 0.25), "{values:?}");
}

/// A column of beads of 0.5 mm, 97 mm wide and as high, that collapses beside a mirror: twice the mean distance of its particles from
/// the mirror over its width, less one, when it has come to rest.
pub(crate) fn collapsed(rheology: Rheology) -> f64 {
    let (cells, width) = (20, 0.0972);
    let spacing = width / f64::from(cells);
    let beads =
        EquationOfState { reference_density: 1470.0, bulk_modulus: 1470.0 * 50.0 * 9.81 * width, ..EQUATION_OF_STATE };
    let mut flow = block([cells as usize; 2], Disorder { jitter: 0.02, ..Disorder::NONE }, 7);
    for index in 0..flow.position.len() {
        flow.position[index] *= spacing / SPACING;
        flow.density[index] = beads.density(1470.0 * 9.81 * (width - flow.position[index][1]));
        flow.mass[index] = flow.density[index] * spacing * spacing;
    }
    let mut scene = Scene { rheology, spacing, equation_of_state: beads, ..open_scene(flow) };
    scene.numerics = Numerics::default();
    scene.domain.axes[0] = AxisBoundary::Mirror { lower: Some(0.0), upper: None };
    scene.walls = vec![bed()];
    let reach = Vector::<2>::new(8.0 * width, 2.0 * width);
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, (Vector::zeros(), reach), spacing, 4);
    scene.gravity[1] = -9.81;
    let mut simulation = simulation(scene);
    while simulation.time() < 8.0 * (width / 9.81).sqrt() {
        simulation.step().expect("a stable step");
    }
    let end = simulation.snapshot();
    2.0 * end.position.iter().map(|x| x[0]).sum::<f64>() / (end.position.len() as f64 * width) - 1.0
}

/// Without cooperation the nonlocal law lets a column run out as the local one does.
#[test]
fn without_cooperation_a_column_runs_out_as_under_the_local_law() {
    let Rheology::MuI(grains) = GRAINS else { unreachable!("grains") };
    let local = collapsed(GRAINS);
    let nonlocal = NonlocalMuI { cooperativity: 0.0, relaxation_time: 1e-6, ..NonlocalMuI::of(grains) };
    let without = collapsed(Rheology::NonlocalMuI(nonlocal));
    let with = collapsed(Rheology::NonlocalMuI(NonlocalMuI::of(grains)));
    println!("local {local:.4}, without cooperation {without:.4}, with {with:.4}");
    assert!((without / local - 1.0).abs() < 0.005, "{without} for {local}");
    // the heap is two hundred grains wide, so that cooperation hardly acts
    assert!((with / local - 1.0).abs() < 0.01, "{with} for {local}");
}
