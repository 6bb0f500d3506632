//! The neighbour list against a search through all pairs and all images, made without the solver's own images.

use crate::invariants::patches::{Disorder, SPACING, bed, block, open_scene, random, simulation};
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::run::SceneError;
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::walls::{Wall, wall};
use rand::RngExt;

/// Largest excess of a neighbour's distance over the search radius, relative to it `[-]`: distances are in single
/// precision.
const ROUNDING: f64 = 1e-6;

/// A position and all its images, the position first; none along open axes.
fn with_images<const D: usize>(domain: &Domain<D>, position: &Vector<D>) -> Vec<Vector<D>> {
    let mut all = vec![*position];
    for (axis, boundary) in domain.axes.iter().enumerate() {
        let maps: Vec<(f64, f64)> = match *boundary {
            AxisBoundary::Open => Vec::new(),
            AxisBoundary::Periodic { lower, upper } => vec![(1.0, upper - lower), (1.0, lower - upper)],
            AxisBoundary::Mirror { lower, upper } => {
                lower.iter().chain(&upper).map(|plane| (-1.0, 2.0 * plane)).collect()
            }
        };
        for index in 0..all.len() {
            for &(sign, shift) in &maps {
                let mut image = all[index];
                image[axis] = sign * image[axis] + shift;
                all.push(image);
            }
        }
    }
    all
}

/// Vectors from `centre` to all `sources` and their images within `radius`, but for the centre itself.
fn offsets<const D: usize>(
    domain: &Domain<D>,
    centre: &Vector<D>,
    sources: &[Vector<D>],
    radius: f64,
) -> Vec<Vector<D>> {
    let mut found: Vec<_> = sources
        .iter()
        .flat_map(|source| with_images(domain, source))
        .map(|place| place - centre)
        .filter(|offset| offset.norm() < radius && offset.norm() > 0.0)
        .collect();
    sort(&mut found);
    found
}

/// Sorts by coordinates rounded to 1e-8 spacings, so that rounding does not change the order.
fn sort<const D: usize>(offsets: &mut [Vector<D>]) {
    offsets.sort_by_key(|offset| -> [i64; D] {
        std::array::from_fn(|axis| (offset[axis] / (1e-8 * SPACING) + 0.37).floor() as i64)
    });
}

fn listed<const D: usize>(simulation: &Simulation<D>, centre: usize, indices: &[u32]) -> Vec<Vector<D>> {
    let position = &simulation.particles().position;
    let mut found: Vec<_> = indices.iter().map(|&index| position[index as usize] - position[centre]).collect();
    sort(&mut found);
    found
}

/// Compares every row of the fresh list; returns the number of pairs.
fn compare<const D: usize>(scene: Scene<D>) -> usize
where
    Simulation<D>: Compiled<D>,
{
    let radius = scene.search_radius();
    let walls: Vec<_> = scene.wall_particles.iter().map(|particle| particle.position).collect();
    let simulation = simulation(scene.clone());
    let flow = simulation.particles().flow_count();
    let mut pairs = 0;
    for particle in 0..simulation.particles().real_count() {
        let centre = simulation.particles().position[particle];
        let row = simulation.neighbours().row(particle);
        let no_walls: &[Vector<D>] = &[];
        // rows of wall particles hold flow neighbours only
        let wall_sources = if particle < flow { &walls[..] } else { no_walls };
        for (indices, sources) in [(&row.flow, &scene.flow.position[..]), (&row.wall, wall_sources)] {
            let (mut found, mut expected) =
                (listed(&simulation, particle, indices), offsets(&scene.domain, &centre, sources, radius));
            assert!(found.iter().all(|offset| offset.norm() < radius * (1.0 + ROUNDING)), "particle {particle}");
            // at the radius itself, where periodic images of a particle may stand, rounding decides
            for offsets in [&mut found, &mut expected] {
                offsets.retain(|offset| offset.norm() < radius * (1.0 - 1e-12));
            }
            assert_eq!(found.len(), expected.len(), "neighbours of particle {particle} at {centre}");
            for (found, expected) in found.iter().zip(&expected) {
                assert!((found - expected).norm() < 1e-12, "a neighbour at {found} instead of {expected}");
            }
            pairs += found.len();
        }
    }
    pairs
}

/// Particles anywhere in a box of `side` spacings.
fn scattered<const D: usize>(count: usize, side: f64, seed: u64) -> Flow<D> {
    let mut random = random(seed);
    let mut flow = Flow::default();
    for _ in 0..count {
        push(&mut flow, Vector::from_fn(|_, _| random.random::<f64>() * side * SPACING));
    }
    flow
}

fn push<const D: usize>(flow: &mut Flow<D>, position: Vector<D>) {
    flow.position.push(position);
    flow.velocity.push(Vector::zeros());
    flow.density.push(1500.0);
    flow.mass.push(0.15);
    flow.stress.push(Tensor::zeros());
}

/// Tight clusters far apart, with one stray particle very far away.
fn clustered<const D: usize>(seed: u64) -> Flow<D> {
    let mut random = random(seed);
    let mut flow = Flow::default();
    for _ in 0..6 {
        let centre = Vector::<D>::from_fn(|_, _| (random.random::<f64>() - 0.5) * 300.0 * SPACING);
        for _ in 0..40 {
            push(&mut flow, centre + Vector::from_fn(|_, _| random.random::<f64>() * 2.0 * SPACING));
        }
    }
    push(&mut flow, Vector::repeat(-1e5 * SPACING));
    flow
}

#[test]
fn open_flows_agree_with_all_pairs() {
    fn check<const D: usize>(cells: [usize; D], count: usize, side: f64)
    where
        Simulation<D>: Compiled<D>,
    {
        let lattice = compare(open_scene(block(cells, Disorder::NONE, 1)));
        let jittered = compare(open_scene(block(cells, Disorder { jitter: 0.3, ..Disorder::NONE }, 2)));
        let random = compare(open_scene(scattered::<D>(count, side, 3)));
        let clusters = compare(open_scene(clustered::<D>(4)));
        assert!(lattice.min(jittered).min(random).min(clusters) > 1000, "the test sees pairs");
    }
    check([19, 23], 500, 22.0);
    check([8, 7, 9], 500, 8.0);
}

#[test]
fn open_flows_agree_with_a_search_through_all_pairs() {
    let scene = open_scene(scattered::<3>(400, 8.0, 12));
    let radius = scene.search_radius();
    let simulation = simulation(scene);
    let position = &simulation.particles().position;
    let real = simulation.particles().real_count();
    for (particle, place) in position[..real].iter().enumerate() {
        let is_near = |&other: &usize| other != particle && (position[other] - place).norm_squared() < radius * radius;
        let expected: Vec<u32> = (0..real).filter(is_near).map(|other| other as u32).collect();
        let mut found = simulation.neighbours().row(particle).flow;
        found.sort_unstable();
        assert_eq!(found, expected, "row {particle}");
    }
}

#[test]
fn periodic_flows_agree_with_all_images() {
    fn check<const D: usize>(side: f64, count: usize, seed: u64)
    where
        Simulation<D>: Compiled<D>,
    {
        let axes = [AxisBoundary::Periodic { lower: 0.0, upper: side * SPACING }; D];
        let mut scene = open_scene(scattered::<D>(count, side, seed));
        scene.domain = Domain { axes };
        assert!(compare(scene.clone()) > 1000);
        scene.domain.axes[0] = AxisBoundary::Mirror { lower: Some(0.0), upper: Some(side * SPACING) };
        assert!(compare(scene) > 1000);
    }
    // 3.3 spacings is the search radius itself, the shortest period that is allowed
    for side in [3.3, 5.0, 12.0] {
        check::<2>(side, 100, 5);
    }
    check::<3>(3.5, 60, 6);
    check::<3>(7.0, 300, 7);
}

#[test]
fn mirror_corners_and_walls_agree_with_all_images() {
    fn check<const D: usize>(cells: [usize; D])
    where
        Simulation<D>: Compiled<D>,
    {
        let size = Vector::<D>::from_fn(|axis, _| cells[axis] as f64 * SPACING);
        let mut scene = open_scene(block(cells, Disorder { jitter: 0.3, ..Disorder::NONE }, 10));
        scene.domain.axes = [AxisBoundary::Mirror { lower: Some(0.0), upper: None }; D];
        assert!(compare(scene.clone()) > 1000, "a corner of mirrors");
        scene.domain.axes[D - 1] = AxisBoundary::Open;
        scene.walls = vec![bed(), Wall::still(0, size[0], -1.0)];
        scene.wall_particles = wall::fill(&scene.walls, &scene.domain, (Vector::zeros(), size), SPACING, 4);
        assert!(compare(scene.clone()) > 1000, "a bed and a side wall beside a mirror");
        scene.domain.axes[0] = AxisBoundary::Periodic { lower: 0.0, upper: size[0] };
        scene.walls.truncate(1);
        scene.wall_particles = wall::fill(&scene.walls, &scene.domain, (Vector::zeros(), size), SPACING, 4);
        assert!(compare(scene) > 1000, "a periodic bed");
    }
    check([14, 12]);
    check([7, 8, 6]);
}

#[test]
fn no_pair_is_missed_between_two_searches() {
    let cells = [12, 10];
    let size = Vector::<2>::new(12.0, 10.0) * SPACING;
    let mut scene = open_scene(block(cells, Disorder { speed: 1.0, stress: 0.0, ..Disorder::FULL }, 13));
    scene.domain.axes[0] = AxisBoundary::Periodic { lower: 0.0, upper: size[0] };
    scene.walls = vec![bed()];
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, (Vector::zeros(), size), SPACING, 4);
    scene.gravity = Vector::<2>::new(0.0, -9.81);
    scene.numerics.density_coupling = 0.5;
    let walls: Vec<_> = scene.wall_particles.iter().map(|particle| particle.position).collect();
    let (domain, support) = (scene.domain, 2.0 * scene.numerics.smoothing_ratio * SPACING);
    let mut simulation = simulation(scene);
    let mut pairs_of_old_lists = 0;
    for _ in 0..60 {
        let (before, searches) = (simulation.snapshot(), simulation.neighbour_searches());
        simulation.step().expect("a stable step");
        let fresh = simulation.neighbour_searches() > searches;
        // what the step saw, matched to what is listed through the small way that the step has moved it since
        let fastest = simulation.snapshot().velocity.iter().map(Vector::norm).fold(0.0, f64::max);
        let moved = 2.01 * (simulation.time() - before.time) * fastest;
        assert!(moved < 0.2 * SPACING, "small against the distance of two particles");
        for particle in 0..simulation.particles().flow_count() {
            let centre = before.position[simulation.particles().identity[particle] as usize];
            let row = simulation.neighbours().row(particle);
            for (indices, sources) in [(&row.flow, &before.position), (&row.wall, &walls)] {
                let found = listed(&simulation, particle, indices);
                for expected in offsets(&domain, &centre, sources, support) {
                    let near = found.iter().any(|offset| (offset - expected).norm() < moved);
                    assert!(near, "step {}: the neighbour at {expected} is missing", simulation.steps());
                    pairs_of_old_lists += usize::from(!fresh);
                }
            }
        }
    }
    assert!(pairs_of_old_lists > 10_000 && simulation.neighbour_searches() > 4);
}

#[test]
fn a_row_that_cannot_hold_its_neighbours_is_an_error_and_not_a_loss() {
    for count in [1020, 1030, 3000] {
        let result = Simulation::new(open_scene(scattered::<2>(count, 0.5, 1)));
        match result {
            Ok(simulation) => {
                let listed = simulation.neighbours().row(0).flow.len();
                assert_eq!(listed, count - 1, "particle 0 of {count} misses neighbours");
            }
            Err(SceneError::Value { quantity, .. }) => {
                assert_eq!(quantity, "number of neighbours");
                assert!(count > 1024);
            }
            Err(other) => panic!("{other}"),
        }
    }
}
