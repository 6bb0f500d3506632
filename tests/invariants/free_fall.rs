//! Free fall of a block without contact: its masses are exact, its shape stays, it falls with g.

use crate::invariants::patches::{Disorder, SPACING, advance, bed, block, open_scene, simulation};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::numerics::{MomentumOperator, Numerics};
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::walls::wall;

#[test]
fn a_loose_block_falls_as_a_body() {
    fn check<const D: usize>(cells: [usize; D], momentum_operator: MomentumOperator)
    where
        Simulation<D>: Compiled<D>,
    {
        let mut scene = open_scene(block(cells, Disorder { jitter: 0.2, mass: 0.1, ..Disorder::NONE }, 14));
        scene.gravity[D - 1] = -9.81;
        scene.gravity[0] = 2.0;
        let thrown = Vector::<D>::from_fn(|axis, _| [1.0, -0.5, 0.3][axis]);
        scene.flow.velocity.fill(thrown);
        scene.numerics = Numerics { momentum_operator, ..scene.numerics };
        let (start, gravity) = (scene.flow.clone(), scene.gravity);
        let mut simulation = simulation(scene);
        let (mut velocity, mut fallen, mut time) = (thrown, Vector::<D>::zeros(), 0.0);
        for _ in 0..300 {
            advance(&mut simulation, 1);
            let step = simulation.time() - time;
            velocity += gravity * step;
            fallen += velocity * step;
            time = simulation.time();
        }
        // the body's own solution, to the first order of the symplectic step
        let exact = thrown * time + gravity * (0.5 * time * time);
        let half_a_step = 0.5 * gravity.norm() * time * simulation.time_step_bounds().step();
        assert!((fallen - exact).norm() < 1.01 * half_a_step, "{fallen} for {exact}");
        let after = simulation.snapshot();
        assert_eq!(after.mass, start.mass, "masses are never touched");
        for (index, place) in after.position.iter().enumerate() {
            assert!((place - start.position[index] - fallen).norm() < 1e-12, "particle {index} in {D}-D");
            assert!((after.velocity[index] - velocity).norm() < 1e-11);
            assert!((after.density[index] - start.density[index]).abs() < 1e-9);
        }
    }
    for operator in [MomentumOperator::SingleDivergence, MomentumOperator::UncorrectedDivergence] {
        check([12, 10], operator);
        check([6, 7, 6], operator);
    }
}

#[test]
fn masses_are_exact_and_nothing_is_lost_in_an_impact() {
    let cells = [24, 20];
    let mut scene = open_scene(block(cells, Disorder { jitter: 0.1, mass: 0.1, ..Disorder::NONE }, 15));
    for position in &mut scene.flow.position {
        position[1] += 2.0 * SPACING;
    }
    scene.flow.velocity.fill(Vector::<2>::new(0.0, -1.0));
    scene.gravity = Vector::<2>::new(0.0, -9.81);
    scene.walls = vec![bed()];
    let reach = (Vector::<2>::new(-0.6, 0.0), Vector::<2>::new(0.84, 0.3));
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, reach, SPACING, 4);
    let masses = scene.flow.mass.clone();
    let mut simulation = simulation(Scene { ..scene });
    advance(&mut simulation, 1200);
    let after = simulation.snapshot();
    assert_eq!(after.mass, masses);
    let lowest = after.position.iter().map(|place| place[1]).fold(f64::INFINITY, f64::min);
    assert!(lowest > 0.0, "a particle {lowest} m below the bed");
    let speed = after.velocity.iter().map(Vector::norm).fold(0.0, f64::max);
    assert!(speed < 2.0, "{speed} m/s: an impact makes no energy");
}
