//! Momentum from walls, mirrors, gates and contacts: with gravity it is all the momentum that the flow gains.

use crate::invariants::patches::{Disorder, SPACING, SYRUP, bed, block, open_scene, simulation};
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::numerics::{MomentumOperator, Numerics};
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::walls::gate::Gate;
use bagnold_solver::weakly_compressible::walls::{Surface, WallTreatment, wall};

const MIRROR: AxisBoundary = AxisBoundary::Mirror { lower: Some(0.0), upper: None };

/// Disordered grains on a bed, between a mirror and free space.
fn heap<const D: usize>(cells: [usize; D]) -> Scene<D> {
    let mut scene = open_scene(block(cells, Disorder::FULL, 5));
    scene.domain = Domain { axes: [MIRROR; D] };
    scene.domain.axes[D - 1] = AxisBoundary::Open;
    scene.walls = vec![bed::<D>()];
    let extent = (Vector::zeros(), Vector::repeat(25.0 * SPACING));
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, extent, SPACING, 4);
    scene.gravity[0] = 3.0;
    scene.gravity[D - 1] = -9.0;
    scene
}

/// The heap in the plane with a gate at its side.
fn gated(speed: f64) -> Scene<2> {
    let mut scene = heap([12, 10]);
    let gate = Gate { position: 0.12, edge: 0.0, height: 0.15, speed, lift: 0.05, rows: 4 };
    let (walls, particles) = gate.build(SPACING, 1);
    scene.walls.extend(walls);
    scene.wall_particles.extend(particles);
    scene
}

/// Largest |Σ m (v − v_0) − support − M g t| and |support|, both over M g t, after some steps.
fn residual<const D: usize>(scene: Scene<D>, steps: usize) -> (f64, f64)
where
    Simulation<D>: Compiled<D>,
{
    let gravity = scene.gravity;
    let mut simulation = simulation(scene);
    let momentum = |simulation: &Simulation<D>| {
        let state = simulation.snapshot();
        let sum: Vector<D> = state.velocity.iter().zip(&state.mass).map(|(v, m)| v * *m).sum();
        let support: Vector<D> = state.support_impulse.iter().sum();
        (sum, support, state.mass.iter().sum::<f64>())
    };
    let (start, nothing, mass) = momentum(&simulation);
    assert!(nothing == Vector::<D>::zeros());
    crate::invariants::patches::advance(&mut simulation, steps);
    let (end, support, _) = momentum(&simulation);
    assert!(simulation.neighbour_searches() > 3, "images and particles are exchanged and sorted anew on the way");
    let weight = mass * gravity.norm() * simulation.time();
    let missing = end - start - support - gravity * (mass * simulation.time());
    (missing.norm() / weight, support.norm() / weight)
}

#[test]
fn gravity_and_the_supports_give_all_the_momentum() {
    for (missing, support) in [
        residual(heap([14, 12]), 300),
        residual(heap([6, 7, 8]), 200),
        residual(gated(0.0), 300),
        residual(gated(2.0), 300),
    ] {
        assert!(missing < 1e-11, "{missing:e} of the weight's impulse has no cause");
        assert!(support > 0.1, "the supports must matter for this test: {support}");
    }
}

#[test]
fn nothing_rubs_along_a_smooth_wall() {
    let rising = |roughness: Surface| {
        let mut scene = open_scene(block([12, 10], Disorder::NONE, 1));
        scene.rheology = SYRUP;
        let gate = Gate { position: 0.12, edge: -0.2, height: 0.6, speed: 0.0, lift: 0.0, rows: 4 };
        (scene.walls, scene.wall_particles) = gate.build(SPACING, 0);
        scene.walls.iter_mut().for_each(|wall| wall.roughness = roughness);
        scene.flow.velocity.fill(Vector::<2>::new(0.0, 0.5));
        let mut simulation = simulation(scene);
        crate::invariants::patches::advance(&mut simulation, 40);
        let state = simulation.snapshot();
        state.velocity.iter().map(|v| (v - Vector::<2>::new(0.0, 0.5)).norm()).fold(0.0, f64::max)
    };
    assert!(rising(Surface::Smooth) < 1e-12, "{}", rising(Surface::Smooth));
    assert!(rising(Surface::Rough) > 0.05);
}

/// Moments that a mean is taken over.
const MOMENTS: usize = 30;

#[test]
fn a_closed_gate_holds_a_liquid_as_a_mirror_does() {
    let settled = |scene: Scene<2>| {
        let mut simulation = simulation(Scene { rheology: SYRUP, gravity: Vector::<2>::new(0.0, -9.0), ..scene });
        crate::invariants::patches::advance(&mut simulation, 3000);
        // the fastest particle changes from moment to moment
        let mut fastest = 0.0;
        for _ in 0..MOMENTS {
            crate::invariants::patches::advance(&mut simulation, 100);
            let velocity = simulation.snapshot().velocity;
            fastest += velocity.iter().map(|v| v.norm()).fold(0.0, f64::max) / MOMENTS as f64;
        }
        let state = simulation.snapshot();
        let total: f64 = state.mass.iter().sum();
        let mean = |axis: usize| state.position.iter().zip(&state.mass).map(|(x, m)| x[axis] * m).sum::<f64>() / total;
        (fastest, mean(0), mean(1))
    };
    let mut mirrored = heap([12, 10]);
    mirrored.domain.axes[0] = AxisBoundary::Mirror { lower: Some(0.0), upper: Some(0.12) };
    let reference = settled(mirrored);
    let found = settled(gated(0.0));
    assert!(found.0 < 2.0 * reference.0 && reference.0 < 0.01, "as quiet: {reference:?}, {found:?}");
    assert!((found.1 - reference.1).abs() < 0.1 * SPACING, "{found:?} for {reference:?}");
    assert!((found.2 - reference.2).abs() < 0.1 * SPACING, "{found:?} for {reference:?}");
}

#[test]
fn a_smooth_wall_is_refused_where_the_operators_know_rough_ones_only() {
    let refused = |numerics: Numerics| {
        let mut scene = gated(1.0);
        scene.numerics = numerics;
        let Err(error) = Simulation::new(scene) else { panic!("must be refused") };
        error.to_string()
    };
    let default = gated(1.0).numerics;
    assert_eq!(
        refused(Numerics { momentum_operator: MomentumOperator::Pairwise, ..default }),
        "`momentum_operator` is pairwise, but must be \"single-divergence\" or \"uncorrected-divergence\" with a smooth \
         wall, such as a gate; the pairwise operators support rough walls only; choose one of these, or leave the gate out"
    );
    assert_eq!(
        refused(Numerics { wall_treatment: WallTreatment::Paper, ..default }),
        "`wall_treatment` is paper, but must be \"extrapolated\" with a smooth wall, such as a gate; the paper's walls are \
         always rough; choose \"extrapolated\", or leave the gate out"
    );
}
