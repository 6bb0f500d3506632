//! Onset of flow in a chute of the nonlocal law: the case `nonlocal-shear` judges the flow itself.

use crate::invariants::nonlocal_layers::on_one_thread;
use crate::invariants::patches::simulation;
use bagnold_cases::nonlocal_shear::{Channel, ExactShear, Motion, NonlocalShearFlow, ShearedGrains, UpperBoundary};
use bagnold_harness::case::recording::StartState;

/// A chute of the case that is 20 diameters wide, whose walls bear a friction.
fn chute(wall_friction: f64) -> NonlocalShearFlow {
    NonlocalShearFlow { thickness: 10.0, wall_friction, ..NonlocalShearFlow::default() }
}

/// Velocity of its middle fifth after half a second under a friction, from the steady flow of another, over that.
fn remaining(grains: &ShearedGrains, start: &ExactShear, wall_friction: f64) -> f64 {
    let flow = chute(wall_friction);
    let channel = Channel {
        grains: flow.particles(),
        width: flow.width(),
        gravity: flow.driving(grains),
        pressure: &|_| grains.load,
        above: UpperBoundary::Wall(0.0),
        rheology: flow.material,
        start: &|y| Motion {
            velocity: start.velocity(y),
            shear_rate: start.shear_rate(y),
            shear_stress: start.shear_stress(y),
        },
    };
    let scene = channel.scene(StartState::New).expect("a valid scene");
    let mut simulation = simulation(scene);
    while simulation.time() < 0.5 {
        simulation.step().expect("a stable step");
    }
    let state = simulation.snapshot();
    let inside = |y: f64| (y / channel.width - 0.5).abs() < 0.1;
    let velocities: Vec<f64> =
        state.position.iter().zip(&state.velocity).filter(|(x, _)| inside(x[1])).map(|(_, v)| v[0]).collect();
    velocities.iter().sum::<f64>() / velocities.len() as f64 / start.profile.fastest
}

/// A local law flows in every chute whose walls bear more than μ_s. This one stops below a friction that depends on the width.
#[test]
fn a_narrow_chute_stops_where_its_first_mode_does() {
    let grains = chute(0.6).nominal();
    let (mut still, mut flowing) = (chute(0.6).law().static_friction, 0.6);
    for _ in 0..12 {
        let middle = 0.5 * (still + flowing);
        if chute(middle).steady(&grains).is_some() { flowing = middle } else { still = middle }
    }
    let start = chute(0.6).steady(&grains).expect("it flows");
    let [below, above] = [-0.015, 0.015].map(|offset| on_one_thread(|| remaining(&grains, &start, still + offset)));
    println!("threshold {still:.4}; {below:.2e} of the start below, {above:.2e} above");
    assert!(below.abs() < 1e-3 && above > 1e-2, "{below}, {above} about {still}");
}
