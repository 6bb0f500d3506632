//! A spray of grains that leave each other and fall back onto a heap: none ends a run, none weighs on the others with more volume than
//! the kernel gives a grain alone, and the heap takes them in.

use crate::invariants::patches::{DENSITY, Disorder, SPACING, bed, block, open_scene, simulation};
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::kernel::Kernel;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::numerics::{Numerics, PairPrecision};
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::walls::wall;

/// Grains along each axis of the heap, and of the spray above it.
const HEAP: usize = 20;
const SPRAY: usize = 6;
/// Density of the spray over that of the heap `[-]`: grains that have been parted before.
const LOOSE: f64 = 0.35;
/// Rate at which the spray flies apart `[1/s]`: no two grains are in each other's reach after 0.1 s.
const DIVERGENCE: f64 = 40.0;
/// Time at which all grains have come down and lie still `[s]`.
const END: f64 = 1.0;

/// The densities of grains alone bound those of all, and all grains end in the heap.
fn check<const D: usize>(heap: [usize; D], spray: [usize; D], pair_precision: PairPrecision)
where
    Simulation<D>: Compiled<D>,
{
    let mut flow = block(heap, Disorder { jitter: 0.05, ..Disorder::NONE }, 21);
    let thrown = block(spray, Disorder { jitter: 0.05, ..Disorder::NONE }, 22);
    let shift = Vector::<D>::from_fn(|axis, _| {
        let above = if axis == D - 1 { heap[axis] as f64 } else { 0.5 * (heap[axis] - spray[axis]) as f64 };
        above * SPACING
    });
    let middle = Vector::<D>::from_fn(|axis, _| 0.5 * spray[axis] as f64 * SPACING);
    let first_thrown = flow.position.len();
    for position in &thrown.position {
        let mut velocity = (position - middle) * DIVERGENCE;
        velocity[D - 1] += 1.0;
        flow.position.push(position + shift);
        flow.velocity.push(velocity);
    }
    flow.density.extend(thrown.density.iter().map(|density| LOOSE * density));
    flow.mass.extend(thrown.mass);
    flow.stress.extend(thrown.stress);
    let masses = flow.mass.clone();
    let mut scene = open_scene(flow);
    scene.numerics = Numerics { pair_precision, ..scene.numerics };
    scene.gravity[D - 1] = -9.81;
    // what flies sideways stays over the heap
    for (axis, &cells) in heap.iter().enumerate().take(D - 1) {
        scene.domain.axes[axis] = AxisBoundary::Periodic { lower: 0.0, upper: cells as f64 * SPACING };
    }
    scene.walls = vec![bed()];
    let reach = Vector::<D>::from_fn(|axis, _| heap[axis] as f64 * SPACING);
    scene.wall_particles =
        wall::fill(&scene.walls, &Domain { axes: scene.domain.axes }, (Vector::zeros(), reach), SPACING, 4);
    let numerics = scene.numerics;
    let kernel = Kernel::<D>::new(numerics.kernel, numerics.smoothing_ratio * SPACING);
    let alone = DENSITY * SPACING.powi(D as i32) * kernel.value_at(0.0);
    let mut simulation = simulation(scene);
    let (mut thinnest, mut highest) = (f64::INFINITY, 0.0_f64);
    while simulation.time() < END {
        if let Err(divergence) = simulation.step() {
            panic!("{D} dimensions: {divergence}");
        }
        if simulation.steps().is_multiple_of(50) {
            let now = simulation.snapshot();
            thinnest = now.density.iter().copied().fold(thinnest, f64::min);
            let of_spray = now.position[first_thrown..].iter().map(|place| place[D - 1]);
            highest = of_spray.fold(highest, f64::max);
        }
    }
    let end = simulation.snapshot();
    let top = heap[D - 1] as f64 * SPACING;
    assert!((thinnest / alone - 1.0).abs() < 1e-12, "{D} dimensions: {thinnest} kg/m³, a grain alone has {alone}");
    assert!(highest > top + 8.0 * SPACING, "{D} dimensions: the spray rose to {highest} m only");
    assert_eq!(end.mass, masses, "masses are never touched");
    let highest = end.position.iter().map(|place| place[D - 1]).fold(0.0, f64::max);
    assert!(highest < top + 4.0 * SPACING, "{D} dimensions: a grain is {highest} m high, the heap {top} m");
    let speed = end.velocity.iter().map(Vector::norm).fold(0.0, f64::max);
    assert!(speed < 0.05, "{D} dimensions: {speed} m/s at the end");
}

#[test]
fn a_spray_of_grains_lands_on_its_heap() {
    for precision in [PairPrecision::Single, PairPrecision::Double] {
        check([HEAP, HEAP / 2], [SPRAY; 2], precision);
    }
    check([HEAP / 2, HEAP / 2, HEAP / 4], [SPRAY / 2; 3], PairPrecision::Single);
}
