//! Walls that turn: no radius drifts, their moments are the power over the rate, and one that is in the way of another is named.

use crate::invariants::patches::{Disorder, advance, block, open_scene, simulation};
use crate::invariants::shells::shell;
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::facet_wall::FacetWall;
use bagnold_solver::weakly_compressible::enclosure::wall_turn::WallTurn;
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};

/// A turn at a rate `[rad/s]` for a hundred seconds, from the first axis to the last.
fn turn<const D: usize>(centre: [f64; D], rate: f64) -> Option<WallTurn<D>> {
    let plane = [0, D - 1].map(|along| Vector::from_fn(|axis, _| if axis == along { 1.0 } else { 0.0 }));
    Some(WallTurn {
        centre: centre.into(),
        plane,
        times: vec![0.0, 100.0],
        angles: vec![0.0, 100.0 * rate].into_iter().map(Vector::<1>::new).collect(),
    })
}

/// Disordered grains in a drum of sixteen sides.
pub(crate) fn drum(rate: f64) -> Scene<2> {
    let mut scene = open_scene(block([14, 12], Disorder::FULL, 5));
    scene.gravity = Vector::<2>::new(0.5, -9.0);
    let corner = |k: u32| {
        let (sine, cosine) = (std::f64::consts::FRAC_PI_8 * f64::from(k)).sin_cos();
        [0.07 + 0.12 * cosine, 0.06 + 0.12 * sine]
    };
    let mut drum = shell("drum", &(0..=16).map(corner).collect::<Vec<_>>());
    drum.motion.turn = turn([0.07, 0.06], rate);
    scene.enclosure.walls = vec![drum];
    scene
}

/// Grains in a square tube along a period, which turns about its own axis.
pub(crate) fn tube() -> Scene<3> {
    let mut scene = open_scene(block([7, 7, 7], Disorder { jitter: 0.1, ..Disorder::NONE }, 5));
    scene.gravity = Vector::<3>::new(0.4, -0.7, -9.0);
    scene.domain.axes[1] = AxisBoundary::Periodic { lower: 0.0, upper: 0.07 };
    let corners = [[-0.03, -0.03], [0.1, -0.03], [0.1, 0.1], [-0.03, 0.1]];
    let side = |k: usize| {
        let at = |[x, z]: [f64; 2], y: f64| Vector::<3>::new(x, y, z);
        let (from, to) = (corners[k], corners[(k + 1) % 4]);
        let [a, b, c, d] = [at(from, -0.1), at(from, 0.2), at(to, 0.2), at(to, -0.1)];
        [[a, c, b], [a, d, c]]
    };
    let mut tube = FacetWall::mesh("tube", &(0..4).flat_map(side).collect::<Vec<_>>());
    tube.motion.turn = turn([0.035, 0.0, 0.035], 4.0);
    scene.enclosure.walls = vec![tube];
    scene
}

fn check_places<const D: usize>(scene: Scene<D>)
where
    Simulation<D>: Compiled<D>,
{
    let turn = scene.enclosure.walls[0].motion.turn.clone().expect("a turn");
    let axis = |place: &Vector<D>| {
        let way = place - turn.centre;
        way.dot(&turn.plane[0]).hypot(way.dot(&turn.plane[1]))
    };
    let mut simulation = simulation(scene);
    let places = |simulation: &Simulation<D>| -> Vec<f64> {
        let particles = simulation.particles();
        let walls = &particles.position[particles.flow_count()..particles.real_count()];
        walls.iter().map(axis).collect()
    };
    let (start, before) = (places(&simulation), simulation.energy().expect("a ledger"));
    advance(&mut simulation, 600);
    for (start, end) in start.iter().zip(places(&simulation)) {
        assert!((start - end).abs() < 1e-15, "from {start} to {end} m");
    }
    let end = simulation.energy().expect("a ledger");
    let through = end.ledger.gravity.abs() + end.ledger.walls.abs();
    let missing = end.residual_since(&before) / through;
    let power = simulation.facet_wall_moments()[0] * turn.angles[1][0] / 100.0 / through;
    println!("{missing} of {through} J has no cause, {power} is the turn's");
    assert!(missing.abs() < 0.03 && power > 0.02, "{missing}, {power}");
}

#[test]
fn no_radius_drifts_and_the_energy_has_causes() {
    check_places(drum(3.0));
    check_places(tube());
}

#[test]
fn a_liquid_that_turns_with_its_drum_feels_nothing() {
    let mut scene = drum(3.0);
    (scene.gravity, scene.rheology) = (Vector::zeros(), Rheology::Newtonian(Newtonian { viscosity: 5.0 }));
    let site = |k: usize| Vector::<2>::new((k % 24) as f64 - 4.5, (k / 24) as f64 - 5.5) * 0.01;
    let inside = |place: &Vector<2>| (place - Vector::<2>::new(0.07, 0.06)).norm() < 0.112;
    scene.flow.position = (0..24 * 24).map(site).filter(inside).collect();
    let count = scene.flow.position.len();
    scene.flow = bagnold_solver::weakly_compressible::scene::Flow::at_rest(scene.flow.position, 1500.0, 0.01);
    let turned = |place: &Vector<2>| Vector::<2>::new(0.06 - place[1], place[0] - 0.07) * 3.0;
    scene.flow.velocity = scene.flow.position.iter().map(turned).collect();
    let mut simulation = simulation(scene);
    let inertia = 0.5 * std::f64::consts::PI * 1500.0 * 0.12_f64.powi(4);
    advance(&mut simulation, 300);
    let lost = simulation.facet_wall_moments()[0] / (inertia * 3.0);
    println!("{count} particles got {lost} of their angular momentum in {} s", simulation.time());
    assert!(lost.abs() < 0.01, "{lost} of the angular momentum");
}

/// End of the run of a bar that turns about its left end, above a floor, with an open side below a height.
fn end(floor: f64, open: f64) -> String {
    let mut scene = open_scene(block([4, 4], Disorder::NONE, 5));
    let mut bar = shell("bar", &[[0.3, 0.1], [0.105, 0.1]]);
    bar.motion.turn = turn([0.105, 0.1], -2.0);
    scene.enclosure.walls = vec![shell("floor", &[[-0.1, floor], [0.4, floor]]), bar];
    scene.enclosure.exits.lower[1] = open;
    let mut simulation = simulation(scene);
    let end = (0..100_000).find_map(|_| simulation.step().err());
    end.expect("it is driven out").to_string()
}

#[test]
fn a_wall_that_turns_into_another_or_out_is_named() {
    let met = end(0.0, f64::NEG_INFINITY);
    assert!(met.ends_with(": `bar` turns and meets `floor`") && met.contains("the angle of a wall is -5.4"), "{met}");
    let left = end(-0.3, -0.05);
    assert!(left.ends_with(": `bar` turns and leaves the domain by an open side"), "{left}");
}
