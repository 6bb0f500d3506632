//! Walls under a load: the flow gets what the load gives less the momentum of the wall, and a wall that its load drives out is named.

use crate::invariants::patches::{Disorder, SPACING, advance, block, open_scene, simulation};
use crate::invariants::shells::shell;
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::facet_wall::{FacetWall, Motion};
use bagnold_solver::weakly_compressible::enclosure::wall_load::WallLoad;
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};

/// A load against the last axis, of a force `[N]` on a wall of a mass `[kg]`.
fn down<const D: usize>(force: f64, mass: f64, damping: f64) -> WallLoad<D> {
    let direction = Vector::from_fn(|axis, _| if axis + 1 == D { -1.0 } else { 0.0 });
    WallLoad { direction, force, mass, damping, travel: 0.002 }
}

/// Disordered grains in a trough under a lid of 13 cm, whose middle is 12.5 cm high at the start.
pub(crate) fn pressed(damping: f64) -> Scene<2> {
    let mut scene = open_scene(block([14, 12], Disorder::FULL, 5));
    scene.gravity = Vector::<2>::new(0.5, -9.0);
    let trough = shell("trough", &[[0.0, 0.2], [0.0, 0.0], [0.14, 0.0], [0.14, 0.2]]);
    let mut lid = shell("lid", &[[0.135, 0.127], [0.005, 0.127]]);
    lid.motion.load = Some(down(60.0, 10.0, damping));
    scene.enclosure.walls = vec![trough, lid];
    scene
}

/// Grains between two plates over a period, of which the upper one slides and is pressed down.
pub(crate) fn sheared() -> Scene<2> {
    let mut scene = pressed(30.0);
    scene.domain.axes[0] = AxisBoundary::Periodic { lower: 0.0, upper: 0.14 };
    let mut lid = shell("lid", &[[0.3, 0.127], [-0.1, 0.127]]);
    let displacements = vec![Vector::zeros(), Vector::<2>::new(2.0, 0.0)];
    lid.motion =
        Motion { times: vec![0.0, 1.0], displacements, turn: None, load: scene.enclosure.walls[1].motion.load };
    scene.enclosure.walls = vec![shell("floor", &[[-0.1, 0.0], [0.3, 0.0]]), lid];
    scene
}

/// Grains in space under a lid, on a floor that is wide enough.
pub(crate) fn pressed_in_space() -> Scene<3> {
    let mut scene = open_scene(block([7, 7, 7], Disorder::FULL, 5));
    let plate = |height: f64, lower: f64, upper: f64| {
        let corner = |x: f64, y: f64| Vector::<3>::new(x, y, height);
        let [a, b, c, d] = [corner(lower, lower), corner(upper, lower), corner(upper, upper), corner(lower, upper)];
        if height > 0.0 { [[a, d, c], [a, c, b]] } else { [[a, b, c], [a, c, d]] }
    };
    let mut lid = FacetWall::mesh("lid", &plate(0.077, -0.02, 0.09));
    lid.motion.load = Some(down(3.0, 0.3, 20.0));
    scene.gravity = Vector::<3>::new(0.4, -0.7, -9.0);
    scene.enclosure.walls = vec![FacetWall::mesh("floor", &plate(0.0, -0.3, 0.3)), lid];
    scene
}

fn check_balance<const D: usize>(scene: Scene<D>)
where
    Simulation<D>: Compiled<D>,
{
    let load = scene.enclosure.walls[1].motion.load.expect("a load");
    let mut simulation = simulation(scene);
    let travel = |simulation: &Simulation<D>| simulation.facet_wall_poses()[1].shift.dot(&load.direction);
    assert!((travel(&simulation) - load.travel).abs() < 1e-15, "it starts where it has travelled to");
    advance(&mut simulation, 500);
    let (before, time) = (travel(&simulation), simulation.time());
    let given = |simulation: &Simulation<D>| simulation.facet_wall_impulses()[1].dot(&load.direction);
    advance(&mut simulation, 1);
    // the contacts of the last step count in the next one, and the damper takes its rate times the travel
    let speed = (travel(&simulation) - before) / (simulation.time() - time);
    let impulse =
        load.force * simulation.time() - load.mass * (speed + load.damping * (travel(&simulation) - load.travel));
    let missing = given(&simulation) - impulse;
    assert!(missing.abs() < load.force * time / 500.0, "{missing} of {impulse} kg m/s, more than the load of a step");
    let borne = given(&simulation) / (load.force * time);
    println!("{missing} of {impulse} kg m/s, {borne} of the load is borne");
    assert!(borne > 0.05, "the lid bears on the grains: {borne}");
}

#[test]
fn the_flow_gets_the_load_without_the_momentum_of_the_wall_and_the_damper() {
    check_balance(pressed(0.0));
    check_balance(pressed(30.0));
    check_balance(pressed_in_space());
}

#[test]
fn the_energy_of_the_flow_is_that_of_gravity_and_of_the_lid() {
    let mut scene = pressed(30.0);
    scene.flow = block([14, 12], Disorder { jitter: 0.1, ..Disorder::NONE }, 5);
    let mut simulation = simulation(scene);
    let start = simulation.energy().expect("a ledger");
    advance(&mut simulation, 500);
    let end = simulation.energy().expect("a ledger");
    let through = end.ledger.gravity.abs() + end.ledger.walls.abs();
    let missing = end.residual_since(&start) / through;
    println!("{missing} of {through} J/m");
    assert!(missing.abs() < 0.02, "{missing} of the energy has no cause");
}

/// End of the run of a load that meets no material.
fn end(force: f64, floor: f64, open: f64) -> String {
    let mut scene = open_scene(block([4, 4], Disorder::NONE, 5));
    let mut lid = shell("lid", &[[0.235, 0.1], [0.105, 0.1]]);
    lid.motion.load = Some(WallLoad { travel: 0.0, ..down(force, 1.0, 0.0) });
    scene.enclosure.walls = vec![shell("floor", &[[-0.1, floor], [0.3, floor]]), lid];
    scene.enclosure.exits.lower[1] = open;
    let mut simulation = simulation(scene);
    let end = (0..100_000).find_map(|_| simulation.step().err());
    end.expect("it is driven out").to_string()
}

#[test]
fn a_wall_that_its_load_drives_out_is_named() {
    let closed = f64::NEG_INFINITY;
    let met = end(10.0, 0.0, closed);
    assert!(met.ends_with(": `lid` under its load meets `floor`") && met.contains("the travel of a wall is"), "{met}");
    let left = end(10.0, -0.3, -0.05);
    assert!(left.ends_with(": `lid` under its load leaves the domain by an open side"), "{left}");
    let fast = end(1e4, -200.0 * SPACING, closed);
    assert!(fast.contains(": `lid` under its load moves at") && fast.ends_with("faster than sound"), "{fast}");
}
