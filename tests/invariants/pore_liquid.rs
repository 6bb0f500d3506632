//! Particles of grains and pore liquid: a column that consolidates, and balances in disorder.

use crate::invariants::patches::{Disorder, SPACING, block, open_scene, simulation};
use crate::invariants::{determinism, memories, restart};
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::pore_liquid::{PoreLiquid, SKELETON_SHARE};
use bagnold_solver::material::rheology::{Rheology, ViscousNumber};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::numerics::Numerics;
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use bagnold_solver::weakly_compressible::simulation::Simulation;
use bagnold_solver::weakly_compressible::walls::{Wall, wall};

const HEIGHT: f64 = 0.1;

const SAND: ViscousNumber = ViscousNumber {
    critical_friction: 0.415,
    friction_slope: 90.5,
    critical_fraction: 0.582,
    fraction_slope: 25.0,
    dilatancy: 4.09,
    solid_fraction: 0.6,
    grain_diameter: 2e-4,
    grain_density: 2500.0,
    liquid_density: 1000.0,
    liquid_viscosity: 1e-3,
    permeability_coefficient: 1.0 / 180.0,
};

/// Sand under water.
pub(crate) fn submerged() -> Rheology {
    Rheology::ViscousNumber(SAND)
}

fn pore() -> PoreLiquid {
    submerged().pore_liquid().expect("a liquid")
}

/// A column of so many rows whose liquid bears all of the weight at first, sealed below; with its weight and its consolidation coefficient.
fn liquefied(rows: usize) -> (Scene<2>, f64, f64) {
    let (pore, spacing) = (pore(), HEIGHT / rows as f64);
    let gravity = 9.81 * pore.buoyant_share();
    let weight = pore.mixture_density() * gravity * HEIGHT;
    let bulk_modulus = 1600.0 * weight;
    let site = |k: usize| Vector::<2>::new((k % 4) as f64 + 0.5, (k / 4) as f64 + 0.5) * spacing;
    let flow = Flow::at_rest((0..4 * rows).map(site).collect(), pore.mixture_density(), spacing);
    let equation_of_state =
        EquationOfState { reference_density: pore.mixture_density(), bulk_modulus, tension: Tension::Cut };
    let mut scene = Scene::unbounded(flow, spacing, equation_of_state, submerged());
    scene.flow.field = scene.flow.position.iter().map(|place| weight * (1.0 - place[1] / HEIGHT)).collect();
    scene.gravity[1] = -gravity;
    scene.domain.axes[0] = AxisBoundary::Periodic { lower: 0.0, upper: 4.0 * spacing };
    scene.numerics = Numerics { shear_modulus_ratio: 1e-3, ..Numerics::default() };
    scene.walls = vec![Wall::still(1, 0.0, 1.0)];
    let extent = (Vector::zeros(), Vector::repeat(HEIGHT));
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, extent, spacing, 4);
    let storage = SKELETON_SHARE * (1.0 - SKELETON_SHARE) * bulk_modulus;
    (scene, weight, storage * pore.conductivity(SAND.solid_fraction))
}

/// Terzaghi's series for the triangular start, over that at the floor.
fn terzaghi(height: f64, time_factor: f64) -> f64 {
    let mode = |k: u32| (f64::from(2 * k) + 1.0) * std::f64::consts::FRAC_PI_2;
    let term = |m: f64| 2.0 * (1.0 - m.cos()) / (m * m) * (m * height).cos() * (-m * m * time_factor).exp();
    (0..200).map(|k| term(mode(k))).sum()
}

/// Root mean square of the error over the pressure at the floor, after a fifth of H²/c_v; with the simulation.
fn consolidated(rows: usize) -> (f64, Simulation<2>) {
    let (scene, weight, coefficient) = liquefied(rows);
    let end = 0.2 * HEIGHT * HEIGHT / coefficient;
    let mut simulation = simulation(scene);
    while simulation.time() < end {
        simulation.step().expect("no divergence");
    }
    let snapshot = simulation.snapshot();
    let factor = coefficient * simulation.time() / (HEIGHT * HEIGHT);
    let square =
        |(place, pressure): (&Vector<2>, &f64)| (pressure / weight - terzaghi(place[1] / HEIGHT, factor)).powi(2);
    let sum: f64 = snapshot.position.iter().zip(&snapshot.field).map(square).sum();
    ((sum / snapshot.field.len() as f64).sqrt() / terzaghi(0.0, factor), simulation)
}

#[test]
fn a_column_consolidates_as_terzaghi_has_it_and_loses_the_water_that_it_expels() {
    let errors = [10, 20, 40].map(|rows| consolidated(rows).0);
    let order = (errors[0] / errors[2]).log2() / 2.0;
    println!("errors {errors:?}, order {order}");
    assert!(errors[2] < 0.005 && order > 0.8, "{errors:?}: {order}");
    let (_, simulation) = consolidated(20);
    let (start, end) =
        (simulation.particles().mass.iter().sum::<f64>() / pore().mixture_density(), simulation.snapshot());
    let modulus = (1.0 - SKELETON_SHARE) * simulation.bulk_modulus();
    let (mut lost, mut expelled) = (start, 0.0);
    for (k, mass) in end.mass.iter().enumerate() {
        let volume = mass / end.density[k];
        lost -= volume;
        expelled += volume * end.memory[k][1];
    }
    // the liquid has been let go from the weight at the start
    let compressed: f64 = end.mass.iter().zip(&end.density).zip(&end.field).map(|((m, rho), p)| m / rho * p).sum();
    let (scene, ..) = liquefied(20);
    let before: f64 = scene.flow.field.iter().sum::<f64>() * scene.spacing * scene.spacing;
    let kept = (compressed - before) / modulus;
    assert!(lost > 0.0 && (lost - expelled - kept).abs() < 5e-3 * lost, "{lost} lost, {expelled} expelled, {kept}");
}

/// Disorder everywhere in all that the step reads of a mixture.
fn mixture<const D: usize>(cells: [usize; D]) -> Scene<D> {
    let mut scene = open_scene(block(cells, Disorder::FULL, 7));
    scene.rheology = submerged();
    scene.numerics = Numerics::default();
    scene.flow.field = (0..scene.flow.position.len()).map(|k| 400.0 * (k as f64).sin()).collect();
    scene.flow.memory = (0..scene.flow.position.len()).map(|k| [0.03 * (1.7 * k as f64).cos(), 0.0, 0.0]).collect();
    scene
}

/// No water is lost between particles, however the conductivity varies.
#[test]
fn what_drains_from_one_particle_reaches_another() {
    let mut scene = mixture([16, 12]);
    scene.domain.axes = [16.0, 12.0].map(|cells| AxisBoundary::Periodic { lower: 0.0, upper: cells * SPACING });
    scene.flow.velocity.fill(Vector::zeros());
    scene.rheology = Rheology::ViscousNumber(ViscousNumber { grain_diameter: 1e-3, ..SAND });
    scene.numerics = crate::invariants::patches::exact_pairs();
    let before = scene.flow.clone();
    let mut simulation = simulation(scene);
    simulation.step().expect("stable");
    let after = simulation.snapshot();
    let modulus = (1.0 - SKELETON_SHARE) * simulation.bulk_modulus();
    let (mut sum, mut size) = (0.0, 0.0);
    for k in 0..after.field.len() {
        let volume = before.mass[k] / before.density[k];
        let growth = (before.density[k] - after.density[k]) / after.density[k];
        // disorder opens a few particles to the surface
        let drained = (after.field[k] - before.field[k]) / modulus + growth + after.memory[k][1];
        sum += volume * drained;
        size += volume * drained.abs();
    }
    assert!(size > 0.0 && sum.abs() < 1e-9 * size, "{sum} of {size}");
}

#[test]
fn mixtures_end_in_the_same_bits() {
    restart::check(&mixture([60, 50]));
    determinism::check(&mixture([60, 50]));
    determinism::check(&mixture([13, 12, 14]));
}

#[test]
fn mixtures_that_are_not_served_are_refused() {
    let message = |change: fn(&mut Scene<2>)| {
        let mut scene = memories::labelled([20, 12]);
        (scene.rheology, scene.flow.memory) = (submerged(), Vec::new());
        change(&mut scene);
        Simulation::new(scene).expect_err("refused").to_string()
    };
    let coarse =
        message(|scene| scene.rheology = Rheology::ViscousNumber(ViscousNumber { grain_diameter: 0.05, ..SAND }));
    assert!(coarse.starts_with("`spacing` is 0.01 m, but must be at least"), "{coarse}");
    let mut fed = crate::invariants::inlets::fed();
    fed.rheology = submerged();
    let fed = Simulation::new(fed).expect_err("refused").to_string();
    assert!(fed.starts_with("`inlets`: not supported with a pore liquid"), "{fed}");
}
