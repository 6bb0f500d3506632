//! The artificial viscosity (15): its value for two particles, that it acts on approaching pairs only, and what it is for.

use crate::invariants::patches::{DENSITY, Disorder, SOUND_SPEED, SPACING, block, exact_pairs, open_scene, simulation};
use bagnold_solver::kernel::{Kernel, KernelShape};
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::numerics::{Contact, Numerics};
use bagnold_solver::weakly_compressible::scene::Scene;

/// Two particles without stress, a spacing apart along x, with the velocity of the second against the first `[m/s]`.
fn pair(artificial_viscosity: f64, relative: Vector<2>) -> Scene<2> {
    let mut flow = block([2, 1], Disorder::NONE, 1);
    flow.velocity[1] = relative;
    let numerics = Numerics {
        contact: Contact::None,
        density_coupling: 0.0,
        hourglass: 0.0,
        artificial_viscosity,
        ..exact_pairs()
    };
    Scene { numerics, rheology: Rheology::Newtonian(Newtonian { viscosity: 0.0 }), ..open_scene(flow) }
}

/// Contribution of an artificial viscosity to the relative velocity in the first step, over that step `[m/s²]`.
fn added(artificial_viscosity: f64, relative: Vector<2>) -> Vector<2> {
    let after = |coefficient| {
        let mut simulation = simulation(pair(coefficient, relative));
        simulation.step().expect("a stable step");
        let velocity = simulation.snapshot().velocity;
        ((velocity[1] - velocity[0]), simulation.time())
    };
    let ((with, step), (without, other)) = (after(artificial_viscosity), after(0.0));
    assert_eq!(step, other, "an acoustic step, whatever the coefficient");
    (with - without) / step
}

#[test]
fn two_particles_that_approach_feel_monaghans_term_and_others_nothing() {
    // (15) by hand: 2 m α h c (r·v)/(ρ̄ (r² + δ²)) ∂W/∂r of both particles, δ = 0.01 h
    let smoothing = 1.5 * SPACING;
    let kernel = Kernel::<2>::new(KernelShape::WendlandC2, smoothing);
    let speed = 1e-3;
    let gradient = -kernel.gradient_factor_at(SPACING) * SPACING;
    let inverse = SPACING * speed / (DENSITY * (SPACING * SPACING + 1e-4 * smoothing * smoothing));
    let mass = DENSITY * SPACING * SPACING;
    for alpha in [0.02, 0.5] {
        let expected = 2.0 * mass * alpha * smoothing * SOUND_SPEED * inverse * gradient.abs();
        let approach = added(alpha, Vector::<2>::new(-speed, 0.0));
        assert!((approach[0] - expected).abs() < 1e-3 * expected, "{} for {expected} m/s²", approach[0]);
        assert!(approach[1].abs() < 1e-9 * expected);
        for other in [Vector::<2>::new(speed, 0.0), Vector::<2>::new(0.0, speed)] {
            assert!(added(alpha, other).norm() < 1e-9 * expected, "parting or passing by, {other}");
        }
    }
}

#[test]
fn particles_that_run_into_each_other_turn_back_sooner_with_it() {
    // a head-on impact, far below the sound speed: the pressure alone lets them come closer
    let closest = |coefficient: f64| {
        let mut simulation = simulation(pair(coefficient, Vector::<2>::new(-2.0, 0.0)));
        let mut least = SPACING;
        for _ in 0..400 {
            simulation.step().expect("a stable step");
            let place = simulation.snapshot().position;
            assert!(place[1][0] > place[0][0], "they pass through each other");
            least = least.min((place[1] - place[0]).norm());
        }
        least / SPACING
    };
    let (without, little, much) = (closest(0.0), closest(0.1), closest(1.0));
    assert!(without < little - 1e-3 && little < much - 1e-3, "{without} {little} {much} spacings");
}
