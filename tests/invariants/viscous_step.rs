//! The implicit viscous step against the explicit one, beyond its bound, and at walls.

use crate::invariants::patches::{
    Disorder, GRAINS, SPACING, SYRUP, bed, block, open_scene, periodic_scene, simulation,
};
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::numerics::{Numerics, ViscousStep};
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::Simulation;
use bagnold_solver::weakly_compressible::walls::wall;

fn numerics(viscous_step: ViscousStep, viscous_tolerance: f64) -> Numerics {
    Numerics { viscous_step, viscous_tolerance, artificial_viscosity: 0.0, hourglass: 0.0, ..Numerics::default() }
}

/// Syrup on a bed under gravity, between a mirror plane and open space.
fn heap(numerics: Numerics, rheology: Rheology) -> Simulation<2> {
    let cells = [12, 10];
    let disorder = Disorder { stress: 0.0, compression: (0.0, 0.0), ..Disorder::FULL };
    let mut scene = open_scene(block(cells, disorder, 3));
    scene.domain.axes[0] = AxisBoundary::Mirror { lower: Some(0.0), upper: None };
    scene.walls = vec![bed()];
    let reach = Vector::<2>::new(30.0, 10.0) * SPACING;
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, (Vector::zeros(), reach), SPACING, 4);
    scene.gravity[1] = -9.81;
    simulation(Scene { numerics, rheology, ..scene })
}

fn largest_speed(simulation: &Simulation<2>) -> f64 {
    simulation.snapshot().velocity.iter().map(Vector::norm).fold(0.0, f64::max)
}

#[test]
fn both_steps_agree_as_the_time_step_falls() {
    // ρh²/η = 17 ms, and sound crosses h in 0.75 ms
    let velocity = |viscous_step, courant: f64, steps: usize| {
        let chosen = Numerics { acoustic_courant: courant, ..numerics(viscous_step, 1e-8) };
        let mut simulation = heap(chosen, SYRUP);
        crate::invariants::patches::advance(&mut simulation, steps);
        simulation.snapshot().velocity
    };
    let difference = |courant, steps| {
        let (explicit, implicit) =
            (velocity(ViscousStep::Explicit, courant, steps), velocity(ViscousStep::Implicit, courant, steps));
        crate::invariants::patches::largest_difference(&explicit, &implicit)
    };
    let [coarse, fine] = [difference(0.1, 8), difference(0.05, 16)];
    println!("{coarse:.2e}, {fine:.2e}");
    assert!(coarse > 1e-4, "the steps differ: {coarse:.1e}");
    assert!((1.6..2.5).contains(&(coarse / fine)), "first order: {coarse:.2e}, {fine:.2e}");
}

#[test]
fn grains_come_to_rest_hundreds_of_times_beyond_the_explicit_bound() {
    let Rheology::MuI(law) = GRAINS else { unreachable!("grains") };
    let rheology = Rheology::RegularisedMuI(law.regularised(0.01));
    for tolerance in [0.3, 0.1, 1e-3] {
        let chosen =
            Numerics { hourglass: 0.2, artificial_viscosity: 0.02, ..numerics(ViscousStep::Implicit, tolerance) };
        let mut simulation = heap(chosen, rheology);
        let start = largest_speed(&simulation);
        crate::invariants::patches::advance(&mut simulation, 3000);
        let end = largest_speed(&simulation);
        let viscosity = rheology.largest_viscosity(1500.0 * 9.81 * 0.05);
        let explicit = 0.2 * (1.5 * SPACING).powi(2) * 1500.0 / viscosity;
        let bounds = simulation.time_step_bounds();
        assert!(bounds.viscous.is_infinite() && bounds.step() > 100.0 * explicit, "{bounds:?}, {explicit}");
        println!("tolerance {tolerance}: {start} → {end} m/s, {} iterations", simulation.viscous_iterations());
        assert!(start > 0.3 && end < 0.02, "tolerance {tolerance}: {end} m/s");
    }
}

#[test]
fn an_implicit_step_keeps_the_momentum_of_a_periodic_block() {
    let scene = periodic_scene([17, 14], Disorder::FULL, 11);
    for (name, smagorinsky_constant) in [("Newtonian", 0.0), ("eddy viscosity", 0.5)] {
        // what the tolerance leaves of the residual has a sum: the momentum is exact when the solve is
        let numerics = Numerics { smagorinsky_constant, ..numerics(ViscousStep::Implicit, 1e-10) };
        let mut simulation = simulation(Scene { numerics, rheology: SYRUP, ..scene.clone() });
        for _ in 0..24 {
            let before = simulation.snapshot();
            simulation.step().expect("a stable step");
            let after = simulation.snapshot();
            let (mut sum, mut scale) = (Vector::<2>::zeros(), 0.0);
            for ((old, new), mass) in before.velocity.iter().zip(&after.velocity).zip(&before.mass) {
                sum += (new - old) * *mass;
                scale += (new - old).norm() * mass;
            }
            assert!(scale > 0.0 && sum.norm() < 1e-11 * scale, "{name}: {sum} of {scale}");
        }
        assert!(simulation.viscous_iterations() >= 24);
    }
}
