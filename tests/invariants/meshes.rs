//! Walls of triangles in space: flat ones are plane walls, the space behind them is covered once, what rests in a box of
//! them rests, and what they give is booked.

use crate::invariants::patches::{
    Disorder, EQUATION_OF_STATE, SPACING, SYRUP, advance, bed, block, open_scene, simulation,
};
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::facet_wall::{BackingParticle, FacetWall, Motion};
use bagnold_solver::weakly_compressible::enclosure::mesh_backing;
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::Simulation;
use bagnold_solver::weakly_compressible::walls::{Wall, wall};

const GRAVITY: f64 = 9.81;
const ROWS: usize = 4;

type Triangle = [Vector<3>; 3];

fn at(x: f64, y: f64, z: f64) -> Vector<3> {
    Vector::<3>::new(x, y, z)
}

/// A parallelogram in two triangles, with the flow where its edges turn against the clock.
fn quad(corner: Vector<3>, along: Vector<3>, across: Vector<3>) -> Vec<Triangle> {
    let opposite = corner + along + across;
    vec![[corner, corner + along, opposite], [corner, opposite, corner + across]]
}

/// A parallelogram in rows of triangles.
fn divided(corner: Vector<3>, along: Vector<3>, across: Vector<3>, [m, n]: [usize; 2]) -> Vec<Triangle> {
    let cell = |k: usize| {
        let (i, j) = ((k % m) as f64 / m as f64, (k / m) as f64 / n as f64);
        quad(corner + along * i + across * j, along / m as f64, across / n as f64)
    };
    (0..m * n).flat_map(cell).collect()
}

/// The inside of a box without a lid, from the origin, in five walls.
fn box_of(size: Vector<3>) -> Vec<Triangle> {
    let (x, y, z) = (at(size[0], 0.0, 0.0), at(0.0, size[1], 0.0), at(0.0, 0.0, size[2]));
    let none = Vector::zeros();
    [quad(none, x, y), quad(none, y, z), quad(none, z, x), quad(x, z, y), quad(y, x, z)].concat()
}

fn backing(triangles: &[Triangle], domain: &Domain<3>) -> Vec<BackingParticle<3>> {
    mesh_backing::lay(&[FacetWall::mesh("wall", triangles)], domain, SPACING, ROWS).concat()
}

const OPEN: Domain<3> = Domain { axes: [AxisBoundary::Open; 3] };

fn volume(backing: &[BackingParticle<3>]) -> f64 {
    backing.iter().map(|particle| particle.volume).sum()
}

#[test]
fn a_flat_mesh_has_the_dummy_particles_of_a_plane() {
    let (m, n) = (8, 6);
    let upper = Vector::<3>::new(m as f64, n as f64, 10.0) * SPACING;
    let periodic = |axis: usize| AxisBoundary::Periodic { lower: 0.0, upper: upper[axis] };
    let mirrored = AxisBoundary::Mirror { lower: Some(0.0), upper: Some(upper[1]) };
    let domain = Domain { axes: [periodic(0), mirrored, AxisBoundary::Open] };
    let plane = wall::fill(&[bed()], &domain, (Vector::zeros(), upper), SPACING, ROWS);
    let bed = divided(Vector::zeros(), at(upper[0], 0.0, 0.0), at(0.0, upper[1], 0.0), [5, 4]);
    let mesh = backing(&bed, &domain);
    assert_eq!(mesh.len(), plane.len());
    for particle in &mesh {
        let near = plane.iter().filter(|other| (other.position - particle.position).norm() < 1e-12 * SPACING);
        assert_eq!(near.count(), 1, "{particle:?}");
        assert!((particle.volume / SPACING.powi(3) - 1.0).abs() < 1e-12);
        assert!((particle.depth + particle.position[2]).abs() < 1e-12 * SPACING);
        assert!(particle.normal == at(0.0, 0.0, 1.0));
    }
}

#[test]
fn the_space_behind_a_mesh_is_covered_once() {
    let (size, reach) = (at(0.143, 0.11, 0.087), ROWS as f64 * SPACING);
    // prisms behind five faces; quarters of a cylinder along eight edges; eighths of a ball at four corners
    let [x, y, z] = [size[0], size[1], size[2]];
    let faces = x * y + 2.0 * (x + y) * z;
    let quarter = std::f64::consts::FRAC_PI_4 * reach * reach;
    let eighths = 4.0 * std::f64::consts::PI / 6.0 * reach.powi(3);
    let expected = faces * reach + quarter * (2.0 * (x + y) + 4.0 * z) + eighths;
    let found = volume(&backing(&box_of(size), &OPEN));
    assert!((found / expected - 1.0).abs() < 0.02, "{found} m³ for {expected} m³ behind a box");
    // a slanted plane between mirrors that it is not square to: what lies behind it ends at them
    let mirrored = AxisBoundary::Mirror { lower: Some(0.0), upper: Some(x) };
    let domain = Domain { axes: [mirrored, AxisBoundary::Open, AxisBoundary::Open] };
    let slope = quad(Vector::zeros(), at(x, 0.0, -0.5 * x), at(0.0, y, 0.0));
    let length = 1.25_f64.sqrt() * x;
    let found = volume(&backing(&slope, &OPEN));
    assert!((found / (length * y * reach) - 1.0).abs() < 0.02, "{found} m³ behind a slope");
    // at the lower mirror a wedge is lost, at the upper one a wedge and its image's meet
    let found = volume(&backing(&slope, &domain));
    let angle = 0.5_f64.atan();
    let wedge = 0.5 * reach * reach * angle.tan() * y;
    let fan = 0.5 * reach * reach * angle * y;
    let expected = length * y * reach - wedge + fan;
    assert!((found / expected - 1.0).abs() < 0.02, "{found} m³ for {expected} m³ between mirrors");
}

/// A pipe along z of `facets` strips with the flow inside, each in `rows` pairs of triangles.
fn pipe(radius: f64, length: f64, facets: usize, rows: usize) -> Vec<Triangle> {
    let around = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / facets as f64;
        at(radius * angle.cos(), radius * angle.sin(), 0.0)
    };
    let strip = |k: usize| {
        let (start, end) = (around(k), around(k + 1));
        divided(start, at(0.0, 0.0, length), end - start, [rows, 1])
    };
    (0..facets).flat_map(strip).collect()
}

#[test]
fn a_curved_mesh_of_five_thousand_triangles_is_backed_all_around() {
    let (radius, length, reach) = (0.2, 0.3, ROWS as f64 * SPACING);
    let shell = FacetWall::mesh("wall", &pipe(radius, length, 125, 20));
    assert_eq!(shell.facets.len(), 5_000);
    let (mut backing, looked_at) = mesh_backing::lay_counted(std::slice::from_ref(&shell), &OPEN, SPACING, ROWS);
    let backing = backing.remove(0);
    // a place looks at the facets within six spacings only; all facets would be 5000 for every single place
    let each = looked_at as f64 / backing.len() as f64;
    assert!(each < 0.5 * shell.facets.len() as f64, "{each} facets were looked at for every particle");
    let expected = std::f64::consts::PI * ((radius + reach).powi(2) - radius.powi(2)) * length;
    let found = volume(&backing);
    assert!((found / expected - 1.0).abs() < 0.02, "{found} m³ for {expected} m³");
    for particle in &backing {
        let across = at(particle.position[0], particle.position[1], 0.0);
        assert!((across.norm() - radius - particle.depth).abs() < 0.05 * SPACING, "{particle:?}");
        assert!(particle.normal.dot(&across.normalize()) < -0.99, "{particle:?}");
    }
}

/// A liquid at rest under its own weight in a box of 8 by 8 by 8 particles.
fn filled() -> Scene<3> {
    let mut scene = open_scene(block([8, 8, 8], Disorder::NONE, 1));
    scene.rheology = SYRUP;
    scene.gravity = at(0.0, 0.0, -GRAVITY);
    for (position, density) in scene.flow.position.iter().zip(&mut scene.flow.density) {
        *density = EQUATION_OF_STATE.density(1500.0 * GRAVITY * (8.0 * SPACING - position[2]));
    }
    scene
}

fn in_a_mesh(mut scene: Scene<3>) -> Scene<3> {
    let size = at(8.0, 8.0, 14.0) * SPACING;
    scene.enclosure.walls = vec![FacetWall::mesh("wall", &box_of(size))];
    scene
}

fn in_planes(mut scene: Scene<3>) -> Scene<3> {
    let side = |axis: usize, surface: f64, side: f64| Wall::still(axis, surface, side);
    let far = 8.0 * SPACING;
    scene.walls = vec![bed(), side(0, 0.0, 1.0), side(0, far, -1.0), side(1, 0.0, 1.0), side(1, far, -1.0)];
    let extent = (Vector::zeros(), at(far, far, 14.0 * SPACING));
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, extent, SPACING, ROWS);
    scene
}

/// Relative L2 error of the pressure, and the largest speed `[m/s]`.
fn rest(simulation: &Simulation<3>) -> (f64, f64) {
    let state = simulation.snapshot();
    let exact = |place: &Vector<3>| 1500.0 * GRAVITY * (8.0 * SPACING - place[2]);
    let pairs = || state.position.iter().map(exact).zip(&state.pressure);
    let error: f64 = pairs().map(|(exact, pressure)| (pressure - exact).powi(2)).sum();
    let all: f64 = pairs().map(|(exact, _)| exact.powi(2)).sum();
    ((error / all).sqrt(), state.velocity.iter().map(|v| v.norm()).fold(0.0, f64::max))
}

#[test]
fn a_liquid_rests_in_a_box_of_triangles_as_between_planes() {
    let (mut mesh, mut planes) = (simulation(in_a_mesh(filled())), simulation(in_planes(filled())));
    advance(&mut mesh, 600);
    advance(&mut planes, 600);
    let (found, expected) = (rest(&mesh), rest(&planes));
    println!("pressure {} for {}, speed {} for {} m/s", found.0, expected.0, found.1, expected.1);
    // eight layers; between planes it is the same
    assert!(found.0 < 0.04 && (found.0 - expected.0).abs() < 1e-3, "{} for {} between planes", found.0, expected.0);
    assert!(found.1 < 1.5 * expected.1, "{} m/s for {} m/s between planes", found.1, expected.1);
}

#[test]
fn gravity_and_the_walls_of_triangles_give_all_the_momentum_and_nothing_passes() {
    let mut scene = open_scene(block([7, 7, 7], Disorder::FULL, 5));
    scene.gravity = at(0.4, -0.7, -9.0);
    // a funnel of four slopes below, and a lid that sinks onto the block
    let (low, high, [near, far]) = (at(0.035, 0.035, -0.06), 0.12, [-0.095, 0.165]);
    let corners = [at(near, near, high), at(far, near, high), at(far, far, high), at(near, far, high)];
    let funnel: Vec<Triangle> = (0..4).map(|k| [corners[(k + 1) % 4], low, corners[k]]).collect();
    let lid = quad(at(-0.03, -0.03, 0.085), at(0.0, 0.13, 0.0), at(0.13, 0.0, 0.0));
    let mut moved = FacetWall::mesh("lid", &lid);
    moved.motion = Motion {
        times: vec![0.0, 0.02],
        displacements: vec![Vector::zeros(), at(0.0, 0.0, -0.012)],
        ..Motion::default()
    };
    scene.enclosure.walls = vec![FacetWall::mesh("funnel", &funnel), moved];
    let (gravity, mass) = (scene.gravity, scene.flow.mass.iter().sum::<f64>());
    let mut simulation = simulation(scene);
    let momentum = |simulation: &Simulation<3>| -> Vector<3> {
        let state = simulation.snapshot();
        state.velocity.iter().zip(&state.mass).map(|(v, m)| v * *m).sum()
    };
    let start = momentum(&simulation);
    // a particle that passed would be a divergence
    advance(&mut simulation, 500);
    let given: Vector<3> = simulation.facet_wall_impulses().iter().sum();
    let support: Vector<3> = simulation.snapshot().support_impulse.iter().sum();
    let weight = gravity * (mass * simulation.time());
    let missing = (momentum(&simulation) - start - given - weight).norm() / weight.norm();
    assert!(missing < 1e-9, "{missing:e} of the weight's impulse has no cause");
    assert!((given - support).norm() / weight.norm() < 1e-9);
    for (shell, impulse) in simulation.facet_walls().iter().zip(simulation.facet_wall_impulses()) {
        let part = impulse.norm() / weight.norm();
        assert!(part > 1e-3, "`{}` must matter for this test: {part}", shell.name);
    }
    let state = simulation.snapshot();
    for place in &state.position {
        let heights = simulation.facet_walls()[0].facets.iter().map(|facet| facet.height(place));
        assert!(heights.fold(f64::INFINITY, f64::min) > 0.0, "{place} is behind the funnel");
    }
}
