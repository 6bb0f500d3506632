//! End of a run: finished, stopped by its observer, or diverged with a message that names place and reason.

use crate::invariants::patches::{Disorder, SOUND_SPEED, SPACING, block, open_scene, simulation};
use bagnold_solver::material::rheology::ViscousLaw;
use bagnold_solver::material::rheology::open::{OpenLaw, register};
use bagnold_solver::run::{Divergence, StopReason};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::divergence::Quantity;
use bagnold_solver::weakly_compressible::numerics::{MomentumOperator, Numerics};
use bagnold_solver::weakly_compressible::scene::Scene;
use std::ops::ControlFlow;

fn quiet() -> Scene<2> {
    open_scene(block([8, 8], Disorder::NONE, 1))
}

#[test]
fn the_message_names_time_step_particle_place_quantity_and_limit() {
    let divergence = |quantity: Quantity, value| {
        let (quantity, unit, rule) = quantity.texts();
        let position = Vector::<3>::new(0.5, -0.25, 1e-3);
        Divergence::<3> { time: 0.123_456_78, step: 4321, particle: 17, position, quantity, value, unit, rule }
    };
    let cases = [
        (
            divergence(Quantity::Speed { limit: 60.0 }, 75.0),
            "speed of particle 17 at (5.0000e-1, -2.5000e-1, 1.0000e-3) m is 7.5000e1 m/s, above the 6.0000e1 m/s \
             (three sound speeds) that the model allows",
        ),
        (
            divergence(Quantity::Density { limits: (30.0, 3000.0) }, f64::NAN),
            "density of particle 17 at (5.0000e-1, -2.5000e-1, 1.0000e-3) m is NaN kg/m³, outside the 3.0000e1 to \
             3.0000e3 kg/m³ that the model allows",
        ),
        (
            divergence(Quantity::Neighbours { limit: 1024 }, 1024.0),
            "number of neighbours of particle 17 at (5.0000e-1, -2.5000e-1, 1.0000e-3) m is 1.0240e3 or more, above \
             the 1024 that a neighbour list row can hold",
        ),
    ];
    for (divergence, expected) in cases {
        assert_eq!(divergence.to_string(), format!("diverged at t = 0.123457 s (step 4321): the {expected}"));
    }
}

#[test]
fn an_absurd_velocity_stops_the_run_in_its_first_step() {
    let mut scene = quiet();
    // far from the others, so that nothing changes its speed
    scene.flow.position[40] = Vector::<2>::new(0.5, 0.25);
    scene.flow.velocity[40] = Vector::<2>::new(0.0, -1000.0);
    let mut simulation = simulation(scene);
    let StopReason::Diverged(divergence) = simulation.run(1.0, 0.1, |_| ControlFlow::Continue(())) else {
        panic!("the run went on");
    };
    assert_eq!((divergence.particle, divergence.quantity, divergence.step), (40, "speed", 0));
    assert_eq!(
        divergence.to_string(),
        "diverged at t = 0.000000 s (step 0): the speed of particle 40 at (5.0000e-1, 2.5000e-1) m is 1.0000e3 m/s, \
         above the 6.0000e1 m/s (three sound speeds) that the model allows"
    );
}

/// A liquid that no number is large enough for.
#[derive(Debug)]
struct Overflowing(f64);

impl ViscousLaw for Overflowing {
    fn viscosity(&self, _: f64, _: f64) -> f64 {
        self.0
    }

    fn largest_viscosity(&self, _: f64) -> f64 {
        1e200
    }
}

#[test]
fn not_a_number_stops_the_run_in_its_first_step() {
    let mut scene = quiet();
    // the square of the viscosity overflows, and ∞ times no velocity is not a number; no law of ours may be so stiff
    register("overflowing", |_| Ok(OpenLaw::viscous(Overflowing(1e200)))).expect("a new name");
    scene.rheology = toml::from_str("law = \"overflowing\"").expect("found by its name");
    scene.numerics = Numerics { momentum_operator: MomentumOperator::Pairwise, ..scene.numerics };
    let mut simulation = simulation(scene);
    let StopReason::Diverged(divergence) = simulation.run(1.0, 0.1, |_| ControlFlow::Continue(())) else {
        panic!("the run went on");
    };
    assert_eq!((divergence.quantity, divergence.step), ("speed", 0));
    assert!(divergence.value.is_nan());
    assert!(divergence.to_string().contains("m is NaN m/s, above the 6.0000e1 m/s"), "{divergence}");
    register("no-number", |_| Ok(OpenLaw::viscous(Overflowing(f64::NAN)))).expect("a new name");
    let scene = Scene { rheology: toml::from_str("law = \"no-number\"").expect("found by its name"), ..quiet() };
    let reason = crate::invariants::patches::simulation(scene).run(1.0, 0.1, |_| ControlFlow::Continue(()));
    assert!(format!("{reason:?}").contains("; the law `no-number` gives a viscosity or stress"), "{reason:?}");
}

#[test]
fn a_crushed_block_stops_with_its_density() {
    let mut scene = quiet();
    let middle = Vector::<2>::repeat(4.0 * SPACING);
    for (position, velocity) in scene.flow.position.iter().zip(&mut scene.flow.velocity) {
        *velocity = (middle - position) * (0.5 * SOUND_SPEED / middle[0]);
    }
    scene.flow.density.fill(1.95 * 1500.0);
    let mut observed = 0;
    let mut simulation = simulation(scene);
    let reason = simulation.run(1.0, 1e-5, |_| {
        observed += 1;
        ControlFlow::Continue(())
    });
    let StopReason::Diverged(divergence) = reason else { panic!("the run went on") };
    assert_eq!(divergence.quantity, "density");
    assert!(divergence.value > 3000.0 && divergence.rule.contains("3.0000e1 to 3.0000e3 kg/m³"), "{divergence}");
    assert_eq!(divergence.step, simulation.steps());
    assert_eq!(observed, simulation.steps() + 1, "the state that diverged is not shown to the observer");
}

#[test]
fn a_run_ends_by_its_time_or_by_its_observer() {
    let mut simulation = simulation(quiet());
    let reason = simulation
        .run(0.01, 0.004, |now| if now.time() >= 0.008 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) });
    assert_eq!(reason, StopReason::Stopped);
    assert!(simulation.time() >= 0.008 && simulation.time() < 0.008 + simulation.time_step_bounds().step());
    assert_eq!(simulation.run(0.02, 0.01, |_| ControlFlow::Continue(())), StopReason::Finished);
    assert!((simulation.time() - 0.02).abs() <= 0.5 * simulation.time_step_bounds().step() + 1e-15);
}

#[test]
fn the_start_every_interval_and_the_end_are_observed() {
    for (end, interval) in [(0.01, 0.004), (0.0123, 0.0041), (0.0101, 1.0)] {
        let mut simulation = simulation(quiet());
        let mut times = Vec::new();
        let reason = simulation.run(end, interval, |now| {
            times.push(now.time());
            ControlFlow::Continue(())
        });
        assert_eq!(reason, StopReason::Finished);
        let step = simulation.time_step_bounds().step();
        assert_eq!(times[0], 0.0);
        let inner: Vec<f64> = (1..).map(|k| f64::from(k) * interval).take_while(|&due| due < end - step).collect();
        for (due, seen) in inner.iter().zip(&times[1..]) {
            assert!(*seen >= due - 1e-8 && *seen < due + step, "due at {due} s, seen at {seen} s");
        }
        let last = times[times.len() - 1];
        assert_eq!(last, simulation.time(), "the end of {end} s is observed; interval {interval} s");
    }
}
