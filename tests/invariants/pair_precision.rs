//! Pairs in single precision beside those in double precision: by how much a step and a short run differ, wherever the flow
//! is, and what is left of the balances.

use crate::invariants::determinism::column;
use crate::invariants::patches::{
    Disorder, GRAINS, SPACING, advance, exact_pairs, largest_difference, periodic_scene, simulation,
};
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::numerics::{Numerics, PairPrecision};
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::snapshot::Snapshot;

fn run<const D: usize>(scene: &Scene<D>, pair_precision: PairPrecision, steps: usize) -> Snapshot<D>
where
    Simulation<D>: Compiled<D>,
{
    let mut simulation = simulation(Scene { numerics: Numerics { pair_precision, ..scene.numerics }, ..scene.clone() });
    advance(&mut simulation, steps);
    simulation.snapshot()
}

fn both<const D: usize>(scene: &Scene<D>, steps: usize) -> [Snapshot<D>; 2]
where
    Simulation<D>: Compiled<D>,
{
    [PairPrecision::Double, PairPrecision::Single].map(|precision| run(scene, precision, steps))
}

/// Largest difference of the changes of velocity over the largest change.
fn differing_share<const D: usize>(scene: &Scene<D>) -> f64
where
    Simulation<D>: Compiled<D>,
{
    let [double, single] = both(scene, 1);
    let largest = largest_difference(&double.velocity, &scene.flow.velocity);
    largest_difference(&double.velocity, &single.velocity) / largest
}

#[test]
fn a_step_differs_by_rounding_wherever_the_block_is() {
    let plane = periodic_scene([17, 14], Disorder::FULL, 11);
    let space = periodic_scene([8, 7, 9], Disorder::FULL, 11);
    let mut far = plane.clone();
    // a kilometre away, where f32 tells places apart by six thousandths of a spacing
    let offset = Vector::<2>::new(1000.0, -500.0);
    for (axis, boundary) in far.domain.axes.iter_mut().enumerate() {
        let AxisBoundary::Periodic { lower, upper } = boundary else { unreachable!("periodic") };
        (*lower, *upper) = (*lower + offset[axis], *upper + offset[axis]);
    }
    far.flow.position.iter_mut().for_each(|position| *position += offset);
    let found = [differing_share(&plane), differing_share(&far), differing_share(&space)];
    println!("{found:?}");
    assert!(found.iter().all(|&share| share > 0.0 && share < 2e-6), "{found:?}");
}

#[test]
fn pairs_give_to_one_what_they_take_from_the_other_to_seven_digits() {
    let numerics = Numerics { pair_precision: PairPrecision::Single, ..exact_pairs() };
    let scene = Scene { numerics, ..periodic_scene([17, 14], Disorder::FULL, 11) };
    let mut simulation = simulation(scene);
    let before = simulation.snapshot();
    advance(&mut simulation, 20);
    let after = simulation.snapshot();
    let (mut sum, mut scale) = (Vector::<2>::zeros(), 0.0);
    for ((old, new), mass) in before.velocity.iter().zip(&after.velocity).zip(&before.mass) {
        sum += (new - old) * *mass;
        scale += (new - old).norm() * mass;
    }
    println!("{:.1e}", sum.norm() / scale);
    assert!(sum.norm() / scale < 1e-6, "{:.1e}", sum.norm() / scale);
}

#[test]
fn a_collapse_and_a_layer_stay_together_for_two_hundred_steps() {
    fn apart<const D: usize>(scene: &Scene<D>) -> f64
    where
        Simulation<D>: Compiled<D>,
    {
        let [double, single] = both(scene, 200);
        largest_difference(&double.position, &single.position) / SPACING
    }
    let mut slope = column([30, 20]);
    slope.domain.axes[0] = AxisBoundary::Periodic { lower: 0.0, upper: 30.0 * SPACING };
    slope.gravity = Vector::<2>::new(4.0, -8.9);
    slope.wall_particles.retain(|particle| (0.0..30.0 * SPACING).contains(&particle.position[0]));
    let mut rest = slope.clone();
    rest.gravity = Vector::<2>::new(0.0, -9.81);
    assert_eq!(slope.rheology, GRAINS);
    let found = [apart(&column([30, 20])), apart(&column([13, 12, 14])), apart(&slope), apart(&rest)];
    // seven digits, which the branches of the law and of the walls part
    println!("{found:?} spacings");
    assert!(found.iter().all(|&distance| distance > 0.0 && distance < 1e-3), "{found:?}");
}
