//! Galilean invariance, quarter turns, mirror images, and independence of the length of the neighbour list.

use crate::invariants::patches::{
    Disorder, EQUATION_OF_STATE, GRAINS, SPACING, SYRUP, advance, bed, block, exact_pairs, largest_difference,
    open_scene, periodic_scene, simulation,
};
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::material::rheology::{Bingham, Rheology};
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::numerics::{MomentumOperator, Numerics, ViscositySwitch};
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::walls::{WallTreatment, wall};

const BINGHAM: Rheology =
    Rheology::Bingham(Bingham { plastic_viscosity: 5.0, yield_stress: 400.0, regularisation_rate: 5.0 });

/// Every operator with the law that it is meant for, all its options on.
fn variants() -> [(Numerics, Rheology); 7] {
    let recipe = Numerics { smagorinsky_constant: 0.2, ..exact_pairs() };
    let with = |momentum_operator| Numerics { momentum_operator, ..recipe };
    [
        (recipe, GRAINS),
        (recipe, crate::invariants::fields::nonlocal()),
        (recipe, crate::invariants::pore_liquid::submerged()),
        (with(MomentumOperator::UncorrectedDivergence), GRAINS),
        (with(MomentumOperator::Pairwise), SYRUP),
        (with(MomentumOperator::PairwiseCorrected), BINGHAM),
        (Numerics { viscosity_switch: ViscositySwitch::MorrisMonaghan, ..recipe }, SYRUP),
    ]
}

#[test]
fn a_uniform_velocity_changes_nothing() {
    fn check<const D: usize>(cells: [usize; D], drift: Vector<D>)
    where
        Simulation<D>: Compiled<D>,
    {
        for (numerics, rheology) in variants() {
            let scene = Scene { numerics, rheology, ..periodic_scene(cells, Disorder::FULL, 21) };
            let mut moving = scene.clone();
            for velocity in &mut moving.flow.velocity {
                *velocity += drift;
            }
            let (mut still, mut moving) = (simulation(scene), simulation(moving));
            advance(&mut still, 10);
            advance(&mut moving, 10);
            assert!((still.time() - moving.time()).abs() < 1e-15, "the acoustic bound holds in both");
            let (still, mut moving) = (still.snapshot(), moving.snapshot());
            for velocity in &mut moving.velocity {
                *velocity -= drift;
            }
            let found = largest_difference(&still.velocity, &moving.velocity);
            assert!(found < 1e-10, "{:?} in {D}-D: {found:.1e} m/s", numerics.momentum_operator);
        }
    }
    check([15, 13], Vector::<2>::new(3.0, -2.0));
    check([7, 8, 6], Vector::<3>::new(2.0, -1.0, 3.0));
}

/// The flow turned by 90° about the origin in the plane of the first two axes.
fn turned<const D: usize>(flow: &Flow<D>) -> Flow<D> {
    let mut turn = Tensor::<D>::identity();
    (turn[(0, 0)], turn[(0, 1)], turn[(1, 0)], turn[(1, 1)]) = (0.0, -1.0, 1.0, 0.0);
    Flow {
        position: flow.position.iter().map(|x| turn * x).collect(),
        velocity: flow.velocity.iter().map(|v| turn * v).collect(),
        stress: flow.stress.iter().map(|s| turn * s * turn.transpose()).collect(),
        ..flow.clone()
    }
}

#[test]
fn a_quarter_turn_of_the_start_turns_the_result() {
    fn check<const D: usize>(cells: [usize; D])
    where
        Simulation<D>: Compiled<D>,
    {
        for (numerics, rheology) in variants() {
            let mut scene = Scene { numerics, rheology, ..open_scene(block(cells, Disorder::FULL, 4)) };
            scene.gravity[0] = 9.81;
            let mut other = Scene { flow: turned(&scene.flow), ..scene.clone() };
            (other.gravity[0], other.gravity[1]) = (0.0, 9.81);
            let (mut straight, mut other) = (simulation(scene), simulation(other));
            advance(&mut straight, 10);
            advance(&mut other, 10);
            let (straight, other) = (straight.snapshot(), other.snapshot());
            let expected = turned(&Flow {
                position: straight.position,
                velocity: straight.velocity,
                density: straight.density.clone(),
                mass: straight.mass,
                stress: straight.stress,
                field: straight.field,
                memory: straight.memory,
            });
            let velocity = largest_difference(&expected.velocity, &other.velocity);
            let stress = expected.stress.iter().zip(&other.stress).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
            let name = numerics.momentum_operator;
            assert!(velocity < 1e-10 && stress < 1e-6, "{name:?} in {D}-D: {velocity:.1e} m/s, {stress:.1e} Pa");
        }
    }
    check([13, 11]);
    check([7, 8, 6]);
}

/// A column of twice the width with a jitter that mirrors itself, and its right half beside a mirror plane.
fn column_and_half<const D: usize>(half: [usize; D], numerics: Numerics, rheology: Rheology) -> [Scene<D>; 2] {
    let disorder = Disorder { jitter: 0.1, speed: 0.1, stress: 0.2, ..Disorder::NONE };
    let mut right = block(half, disorder, 8);
    let height = half[D - 1] as f64 * SPACING;
    for (position, density) in right.position.iter().zip(&mut right.density) {
        *density = EQUATION_OF_STATE.density(1500.0 * 9.81 * (height - position[D - 1]).max(0.0));
    }
    let mut sign = Vector::<D>::repeat(1.0);
    sign[0] = -1.0;
    let flip = Tensor::<D>::from_diagonal(&sign);
    let mut whole = right.clone();
    whole.position.extend(right.position.iter().map(|x| flip * x));
    whole.velocity.extend(right.velocity.iter().map(|v| flip * v));
    whole.stress.extend(right.stress.iter().map(|s| flip * s * flip));
    whole.density.extend(&right.density);
    whole.mass.extend(&right.mass);
    let reach = Vector::<D>::from_fn(|axis, _| (half[axis] as f64 + 10.0) * SPACING);
    [(right, Some(0.0), 0.0), (whole, None, -reach[0])].map(|(flow, plane, start)| {
        let mut scene = Scene { numerics, rheology, ..open_scene(flow) };
        if plane.is_some() {
            scene.domain.axes[0] = AxisBoundary::Mirror { lower: plane, upper: None };
        }
        if D == 3 {
            scene.domain.axes[1] = AxisBoundary::Periodic { lower: 0.0, upper: half[1] as f64 * SPACING };
        }
        let mut lower = Vector::<D>::zeros();
        lower[0] = start;
        scene.walls = vec![bed()];
        scene.wall_particles = wall::fill(&scene.walls, &scene.domain, (lower, reach), SPACING, 4);
        scene.gravity[D - 1] = -9.81;
        scene
    })
}

#[test]
fn a_column_beside_a_mirror_is_half_of_the_whole_column() {
    fn check<const D: usize>(half: [usize; D])
    where
        Simulation<D>: Compiled<D>,
    {
        for (mut numerics, rheology) in variants() {
            numerics.verlet_skin = 0.02;
            if numerics.momentum_operator == MomentumOperator::Pairwise {
                numerics.wall_treatment = WallTreatment::Paper;
            }
            let [right, whole] = column_and_half(half, numerics, rheology);
            let count = right.flow.position.len();
            let (mut right, mut whole) = (simulation(right), simulation(whole));
            advance(&mut right, 15);
            advance(&mut whole, 15);
            assert!(right.neighbour_searches() > 1, "the images are made anew");
            let (right, whole) = (right.snapshot(), whole.snapshot());
            let found = largest_difference(&right.velocity, &whole.velocity[..count]);
            let name = numerics.momentum_operator;
            assert!(found < 1e-9, "{name:?} {:?} in {D}-D: {found:.1e} m/s", numerics.viscosity_switch);
        }
    }
    check([12, 14]);
    check([7, 7, 8]);
}

#[test]
fn the_result_does_not_depend_on_how_often_neighbours_are_searched() {
    for (numerics, rheology) in variants() {
        let run = |verlet_skin| {
            let [scene, _] = column_and_half([12, 14], Numerics { verlet_skin, ..numerics }, rheology);
            let mut simulation = simulation(scene);
            advance(&mut simulation, 20);
            (simulation.neighbour_searches(), simulation.snapshot().velocity)
        };
        let (often, seldom) = (run(0.005), run(0.3));
        assert!(often.0 > 4 && seldom.0 < 3, "{} and {} searches", often.0, seldom.0);
        let found = largest_difference(&often.1, &seldom.1);
        let (name, switch) = (numerics.momentum_operator, numerics.viscosity_switch);
        assert!(found < 1e-9, "{name:?} {switch:?}: {found:.1e} m/s");
    }
}

#[test]
fn a_particle_that_leaves_a_period_comes_back_on_the_other_side() {
    let cells = [12, 10];
    let mut scene = periodic_scene(cells, Disorder { jitter: 0.1, ..Disorder::NONE }, 6);
    scene.flow.velocity.fill(Vector::<2>::new(4.0, -3.0));
    let start = scene.flow.position.clone();
    let Domain { axes } = scene.domain;
    let mut simulation = simulation(scene);
    advance(&mut simulation, 150);
    let travelled = Vector::<2>::new(4.0, -3.0) * simulation.time();
    assert!(travelled.norm() > 0.15, "farther than a period");
    for (place, start) in simulation.snapshot().position.iter().zip(start) {
        for axis in 0..2 {
            let AxisBoundary::Periodic { lower, upper } = axes[axis] else { unreachable!("periodic") };
            let turns = (place[axis] - start[axis] - travelled[axis]) / (upper - lower);
            assert!((turns - turns.round()).abs() < 1e-9, "{turns} periods");
            assert!(place[axis] > lower - 0.01 && place[axis] < upper + 0.01);
        }
    }
}
