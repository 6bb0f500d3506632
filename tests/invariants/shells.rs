//! Walls of segments: straight ones are plane walls, slanted ones hold what rests on them, none lets anything pass, and
//! what they give is booked wall by wall.

use crate::invariants::patches::{
    Disorder, EQUATION_OF_STATE, GRAINS, SPACING, SYRUP, advance, bed, block, open_scene, simulation,
};
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::backing;
use bagnold_solver::weakly_compressible::enclosure::facet_wall::{FacetWall, Motion, Side};
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::Simulation;
use bagnold_solver::weakly_compressible::walls::{Surface, Wall, wall};

const GRAVITY: f64 = 9.81;
const ROWS: usize = 4;

pub(crate) fn shell(name: &str, points: &[[f64; 2]]) -> FacetWall<2> {
    let points: Vec<Vector<2>> = points.iter().map(|&point| point.into()).collect();
    FacetWall::polyline(name, &points, Side::Left)
}

/// A layer, periodic along x, under its hydrostatic pressure on a slope `angle` [rad], without a bed.
fn layer(cells: [usize; 2], jitter: f64, angle: f64) -> Scene<2> {
    let mut scene = open_scene(block(cells, Disorder { jitter, ..Disorder::NONE }, 31));
    scene.domain.axes[0] = AxisBoundary::Periodic { lower: 0.0, upper: cells[0] as f64 * SPACING };
    scene.gravity = Vector::<2>::new(GRAVITY * angle.sin(), -GRAVITY * angle.cos());
    let height = cells[1] as f64 * SPACING;
    for (position, density) in scene.flow.position.iter().zip(&mut scene.flow.density) {
        *density = EQUATION_OF_STATE.density(1500.0 * GRAVITY * angle.cos() * (height - position[1]));
    }
    scene
}

fn on_a_plane(mut scene: Scene<2>) -> Scene<2> {
    scene.walls = vec![bed()];
    let extent = (Vector::zeros(), Vector::repeat(1.0));
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, extent, SPACING, ROWS);
    scene
}

fn on_segments(mut scene: Scene<2>) -> Scene<2> {
    let AxisBoundary::Periodic { upper, .. } = scene.domain.axes[0] else { unreachable!("periodic") };
    let points = [0.0, 0.17, 0.18, 0.43, 0.431, 0.77, 1.0].map(|part| [part * upper, 0.0]);
    scene.enclosure.walls = vec![shell("bed", &points)];
    scene
}

#[test]
fn a_straight_wall_of_segments_has_the_dummy_particles_of_a_plane() {
    let (plane, segments) = (on_a_plane(layer([14, 6], 0.0, 0.0)), on_segments(layer([14, 6], 0.0, 0.0)));
    let backing = &backing::lay(&segments.enclosure.walls, &segments.domain, SPACING, ROWS)[0];
    assert_eq!(backing.len(), plane.wall_particles.len());
    for particle in backing {
        let twin = plane.wall_particles.iter().find(|other| (other.position - particle.position).norm() < 1e-12);
        assert!(twin.is_some(), "{particle:?}");
        assert!(
            (particle.volume / (SPACING * SPACING) - 1.0).abs() < 1e-12
                && (particle.depth + particle.position[1]).abs() < 1e-15
        );
        assert!(particle.normal == Vector::<2>::new(0.0, 1.0));
    }
}

/// √(mean square of the difference of two profiles of the mean velocity along x/mean square of the first) over rows.
fn profile_difference(one: &Simulation<2>, other: &Simulation<2>, rows: usize) -> f64 {
    let profile = |simulation: &Simulation<2>| {
        let state = simulation.snapshot();
        let mut sums = vec![(0.0, 0.0); rows];
        for (position, velocity) in state.position.iter().zip(&state.velocity) {
            let sum = &mut sums[((position[1] / SPACING) as usize).min(rows - 1)];
            *sum = (sum.0 + velocity[0], sum.1 + 1.0);
        }
        sums.into_iter().map(|(sum, count)| sum / count).collect::<Vec<f64>>()
    };
    let (one, other) = (profile(one), profile(other));
    let square = |values: &mut dyn Iterator<Item = f64>| values.map(|value| value * value).sum::<f64>();
    (square(&mut one.iter().zip(&other).map(|(a, b)| a - b)) / square(&mut one.iter().copied())).sqrt()
}

#[test]
fn a_layer_flows_over_segments_as_over_a_plane() {
    // from rest, while it speeds up: the bed alone holds it back
    let start = || layer([10, 20], 0.1, 24_f64.to_radians());
    let (mut plane, mut segments) = (simulation(on_a_plane(start())), simulation(on_segments(start())));
    advance(&mut plane, 4000);
    advance(&mut segments, 4000);
    let difference = profile_difference(&plane, &segments, 20);
    assert!(difference < 1e-3, "{difference:e} of the velocity");
    let fastest = plane.snapshot().velocity.iter().map(|v| v[0]).fold(0.0, f64::max);
    assert!(fastest > 0.1, "it must have come far: {fastest} m/s");
}

/// An open box of segments, turned by an angle [°] about the origin with all that is in it, gravity too.
fn turned_box(degrees: f64) -> Scene<2> {
    let cells = [16, 12];
    let (width, height) = (cells[0] as f64 * SPACING, cells[1] as f64 * SPACING);
    let mut scene = layer(cells, 0.0, 0.0);
    scene.domain.axes[0] = AxisBoundary::Open;
    let (sin, cos) = degrees.to_radians().sin_cos();
    let turn = |place: Vector<2>| Vector::<2>::new(cos * place[0] - sin * place[1], sin * place[0] + cos * place[1]);
    for place in &mut scene.flow.position {
        *place = turn(*place);
    }
    scene.gravity = turn(scene.gravity);
    let corners = [[0.0, 2.0 * height], [0.0, 0.0], [width, 0.0], [width, 2.0 * height]];
    scene.enclosure.walls = vec![shell("box", &corners.map(|corner| turn(corner.into()).into()))];
    scene
}

/// Relative L2 error of the pressure at a depth below the surface along gravity, and the largest speed `[m/s]`.
fn rest(simulation: &Simulation<2>, surface: f64, down: &Vector<2>) -> (f64, f64) {
    let state = simulation.snapshot();
    let (mut error, mut all) = (0.0, 0.0);
    for (position, pressure) in state.position.iter().zip(&state.pressure) {
        let exact = 1500.0 * GRAVITY * (surface + position.dot(down));
        error += (pressure - exact).powi(2);
        all += exact.powi(2);
    }
    let fastest = state.velocity.iter().map(|v| v.norm()).fold(0.0, f64::max);
    ((error / all).sqrt(), fastest)
}

/// The same box of plane walls, which cannot be turned.
fn plane_box() -> Scene<2> {
    let mut scene = turned_box(0.0);
    let side = |surface: f64, side: f64| Wall::still(0, surface, side);
    scene.enclosure.walls.clear();
    scene.walls = vec![bed(), side(0.0, 1.0), side(16.0 * SPACING, -1.0)];
    let extent = (Vector::zeros(), Vector::<2>::new(16.0 * SPACING, 24.0 * SPACING));
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, extent, SPACING, ROWS);
    scene
}

fn rested(mut scene: Scene<2>, rheology: Rheology, steps: usize) -> (f64, f64) {
    scene.rheology = rheology;
    let down = scene.gravity / GRAVITY;
    let mut simulation = simulation(scene);
    advance(&mut simulation, steps);
    rest(&simulation, 12.0 * SPACING, &down)
}

#[test]
fn rest_in_a_box_holds_in_a_rotated_box() {
    let (liquid, grains) = (rested(plane_box(), SYRUP, 6000), rested(plane_box(), GRAINS, 2000));
    for degrees in [0.0, 10.0, 30.0, 45.0] {
        let (error, fastest) = rested(turned_box(degrees), SYRUP, 6000);
        assert!(error < 0.01, "{degrees}°: pressure off by {error}");
        assert!((error - liquid.0).abs() < 5e-4, "{degrees}°: {error} for {} between plane walls", liquid.0);
        assert!(fastest < 1.1 * liquid.1, "{degrees}°: {fastest} m/s for {} between plane walls", liquid.1);
        // the pressure of grains between walls that carry a part of them is not unique
        let (_, fastest) = rested(turned_box(degrees), GRAINS, 2000);
        assert!(fastest < 1.5 * grains.1 && fastest < 2e-4, "{degrees}°: grains creep with {fastest} m/s");
    }
}

/// It is no answer to a force, which ten times the viscosity would slow ten times: the density that the coupling moves among
/// particles out of order makes them creep.
#[test]
fn a_liquid_at_rest_creeps_by_less_than_a_quarter_per_cent_of_its_fall() {
    let fall = (GRAVITY * 12.0 * SPACING).sqrt();
    let thick = Rheology::Newtonian(Newtonian { viscosity: 200.0 });
    for (law, smoothing_ratio, steps, most) in
        [(SYRUP, 1.5, 4000, 2.5e-3), (thick, 1.5, 4000, 2.5e-3), (SYRUP, 1.3, 12000, 1e-3)]
    {
        let mut scene = plane_box();
        scene.numerics.smoothing_ratio = smoothing_ratio;
        let (_, fastest) = rested(scene, law, steps);
        assert!(fastest < most * fall, "{smoothing_ratio}: {fastest} m/s");
        assert!(
            fastest > 1e-4 * fall,
            "{smoothing_ratio}: {fastest} m/s: it has come to rest, which the documents deny"
        );
    }
}

#[test]
fn a_scene_of_facets_alone_holds_its_material() {
    let scene = Scene { rheology: SYRUP, ..turned_box(30.0) };
    let down = scene.gravity / GRAVITY;
    let mut simulation = simulation(scene);
    assert!(simulation.particles().wall_count() > 4 * ROWS * 16, "rows stand behind all facets");
    advance(&mut simulation, 500);
    let held: Vector<2> = simulation.facet_wall_impulses().iter().sum();
    let (error, fastest) = rest(&simulation, 12.0 * SPACING, &down);
    let fall = (GRAVITY * 12.0 * SPACING).sqrt();
    assert!(error < 0.01 && fastest < 0.02 * fall, "pressure off by {error}, {fastest} m/s");
    let weight = down * (GRAVITY * simulation.time() * simulation.snapshot().mass.iter().sum::<f64>());
    assert!((held + weight).norm() < 0.01 * weight.norm(), "{held} holds {weight}");
}

#[test]
fn nothing_passes_a_corner_of_30_degrees_at_10_metres_a_second() {
    let (sin, cos) = 15_f64.to_radians().sin_cos();
    let (far, cells) = (60.0 * SPACING, [10, 8]);
    let trough = [[-far * cos, -far * sin], [0.0, 0.0], [-far * cos, far * sin]];
    let solid = [trough[2], trough[1], trough[0]];
    for (corner, from, speed) in [(trough, -0.28, 10.0), (solid, 0.02, -10.0)] {
        for seed in 0..3 {
            let mut scene = open_scene(block(cells, Disorder { jitter: 0.2, ..Disorder::NONE }, seed));
            for place in &mut scene.flow.position {
                *place += Vector::<2>::new(from, -4.0 * SPACING);
            }
            scene.flow.velocity.fill(Vector::<2>::new(speed, 0.0));
            scene.enclosure.walls = vec![shell("corner", &corner)];
            let inside = scene.enclosure.walls[0].facets.clone();
            let mut simulation = simulation(scene);
            // a particle that passed would be a divergence
            advance(&mut simulation, 1500);
            let state = simulation.snapshot();
            // beyond the ends of the walls there is no side to be on
            for place in state.position.iter().filter(|place| place.norm() < 0.9 * far) {
                let height = inside.iter().map(|facet| facet.height(place));
                let stands = if speed > 0.0 {
                    height.fold(f64::INFINITY, f64::min)
                } else {
                    height.fold(f64::NEG_INFINITY, f64::max)
                };
                assert!(stands > 0.0, "{place} is behind the walls");
            }
        }
    }
}

#[test]
fn a_particle_that_has_passed_a_wall_ends_the_run_by_name() {
    let mut scene = open_scene(block([6, 6], Disorder::NONE, 1));
    let lowest = scene.flow.position[0][1] + 0.3 * SPACING;
    scene.enclosure.walls = vec![shell("floor", &[[-0.2, lowest], [0.3, lowest]])];
    let mut simulation = simulation(scene);
    let divergence = simulation.step().expect_err("behind the floor");
    assert_eq!(
        divergence.to_string(),
        "diverged at t = 0.000000 s (step 0): the distance of particle 0 at (5.0000e-3, 5.0000e-3) m is -3.0000e-3 m \
         before the wall `floor`: it has passed it"
    );
}

/// A heap between walls of segments, of which a gate is pulled up.
pub(crate) fn gated() -> Scene<2> {
    let mut scene = open_scene(block([14, 12], Disorder::FULL, 5));
    scene.gravity = Vector::<2>::new(0.5, -9.0);
    let floor = shell("floor", &[[-0.05, 0.2], [-0.05, 0.0], [0.3, 0.0], [0.34, 0.1], [0.34, 0.2]]);
    let plate = [[0.19, 0.15], [0.19, 0.005], [0.15, 0.005], [0.15, 0.15]];
    let mut gate = shell("gate", &plate);
    gate.roughness = Surface::Smooth;
    let up = |y: f64| Vector::<2>::new(0.0, y);
    gate.motion =
        Motion { times: vec![0.0, 0.01, 0.06], displacements: vec![up(0.0), up(0.0), up(0.1)], ..Motion::default() };
    scene.enclosure.walls = vec![floor, gate];
    scene
}

#[test]
fn gravity_and_the_walls_of_segments_give_all_the_momentum() {
    let scene = gated();
    let (gravity, mass) = (scene.gravity, scene.flow.mass.iter().sum::<f64>());
    let mut simulation = simulation(scene);
    let momentum = |simulation: &Simulation<2>| -> Vector<2> {
        let state = simulation.snapshot();
        state.velocity.iter().zip(&state.mass).map(|(v, m)| v * *m).sum()
    };
    let start = momentum(&simulation);
    advance(&mut simulation, 600);
    let given: Vector<2> = simulation.facet_wall_impulses().iter().sum();
    let support: Vector<2> = simulation.snapshot().support_impulse.iter().sum();
    let weight = gravity * (mass * simulation.time());
    let missing = (momentum(&simulation) - start - given - weight).norm() / weight.norm();
    assert!(missing < 1e-11, "{missing:e} of the weight's impulse has no cause");
    assert!((given - support).norm() / weight.norm() < 1e-11);
    let by_gate = simulation.facet_wall_impulses()[1].norm() / weight.norm();
    assert!(by_gate > 0.01, "the gate must matter for this test: {by_gate}");
    assert!(simulation.facet_wall_poses()[1].shift[1] > 0.0);
}

#[test]
fn outflow_is_removed_and_counted() {
    let mut scene = open_scene(block([14, 12], Disorder::FULL, 5));
    scene.gravity = Vector::<2>::new(0.0, -9.0);
    scene.enclosure.exits.lower = Vector::<2>::new(f64::NEG_INFINITY, -0.05);
    scene.enclosure.walls = vec![shell("ledge", &[[-0.1, 0.0], [0.06, 0.0], [0.06, -0.04]])];
    let (gravity, count) = (scene.gravity, scene.flow.mass.len() as u64);
    let mass = scene.flow.mass.iter().sum::<f64>();
    let start: Vector<2> = scene.flow.velocity.iter().zip(&scene.flow.mass).map(|(v, m)| v * *m).sum();
    let mut simulation = simulation(scene);
    let whole = simulation.energy().expect("a ledger");
    advance(&mut simulation, 2500);
    let departed = &simulation.outflow().sides[2];
    let state = simulation.snapshot();
    assert_eq!(departed.particles + state.mass.len() as u64, count);
    assert!(departed.particles > 40 && simulation.outflow().particles() == departed.particles, "{departed:?}");
    let left: f64 = state.mass.iter().sum();
    assert!((departed.mass + left - mass).abs() < 1e-12 * mass);
    // who has left feels no gravity any more
    let impulse = gravity * (left * simulation.time() + departed.mass_times_time);
    let held: Vector<2> = state.velocity.iter().zip(&state.mass).map(|(v, m)| v * *m).sum();
    let given: Vector<2> = simulation.facet_wall_impulses().iter().sum();
    let missing = (held + departed.momentum - start - given - impulse).norm();
    assert!(missing < 1e-11 * impulse.norm(), "{missing:e} of {impulse}");
    let supports: Vector<2> = state.support_impulse.iter().sum();
    assert!((supports + departed.support - given).norm() < 1e-11 * impulse.norm());
    let energy = simulation.energy().expect("a ledger");
    let open = (energy.residual_since(&whole) + departed.energy) / energy.ledger.gravity;
    assert!(open.abs() < 0.02, "{open} of the work of gravity is open");
}
