//! The same bits for every number of threads and every instruction set.

use crate::invariants::patches::{
    Disorder, EQUATION_OF_STATE, GRAINS, SPACING, advance, bed, block, open_scene, simulation,
};
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::lanes::InstructionSet;
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::numerics::{MomentumOperator, Numerics, PairPrecision, ViscousStep};
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::walls::{SideWalls, wall};
use rayon::ThreadPoolBuilder;

/// Steps at most, and after the last of so many searches that sort the particles anew.
const STEPS: [usize; 2] = [150, 20];
const SEARCHES: u64 = 4;

/// A column that starts to collapse beside a mirror plane, large enough for every parallel loop to be split.
pub(crate) fn column<const D: usize>(cells: [usize; D]) -> Scene<D> {
    let disorder = Disorder { jitter: 0.1, speed: 0.05, ..Disorder::NONE };
    let height = cells[D - 1] as f64 * SPACING;
    let mut scene = open_scene(block(cells, disorder, 17));
    for (position, density) in scene.flow.position.iter().zip(&mut scene.flow.density) {
        *density = EQUATION_OF_STATE.density(1500.0 * 9.81 * (height - position[D - 1]).max(0.0));
    }
    scene.domain.axes[0] = AxisBoundary::Mirror { lower: Some(0.0), upper: None };
    if D == 3 {
        scene.domain.axes[1] = AxisBoundary::Periodic { lower: 0.0, upper: cells[1] as f64 * SPACING };
    }
    let reach = Vector::<D>::from_fn(|axis, _| (cells[axis] as f64 + 8.0) * SPACING);
    scene.walls = vec![bed()];
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, (Vector::zeros(), reach), SPACING, 4);
    scene.gravity[D - 1] = -9.81;
    scene
}

fn bytes<const D: usize>(scene: &Scene<D>, threads: usize, instruction_set: InstructionSet) -> Vec<u8>
where
    Simulation<D>: Compiled<D>,
{
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
    pool.install(|| {
        let mut simulation = simulation(scene.clone());
        simulation.use_instruction_set(instruction_set);
        for _ in 0..STEPS[0] {
            if simulation.neighbour_searches() < SEARCHES {
                advance(&mut simulation, 1);
            }
        }
        assert_eq!(simulation.neighbour_searches(), SEARCHES, "the particles are sorted anew in the run");
        advance(&mut simulation, STEPS[1]);
        simulation.snapshot().to_bytes()
    })
}

pub(crate) fn check<const D: usize>(scene: &Scene<D>)
where
    Simulation<D>: Compiled<D>,
{
    let best = InstructionSet::best();
    let expected = bytes(scene, 1, best);
    assert!(expected.iter().any(|&byte| byte != 0));
    // a build that has several sets, for `instruction_sets.rs`, leaves threads alone to every other build
    let others: Vec<_> = InstructionSet::available().into_iter().filter(|set| *set != best).collect();
    if others.is_empty() {
        assert!(bytes(scene, 3, best) == expected, "three threads change the state");
    }
    for instruction_set in others {
        let found = bytes(scene, 2, instruction_set);
        assert!(found == expected, "{} changes the state", instruction_set.name());
    }
}

fn in_both_precisions<const D: usize>(scene: &Scene<D>)
where
    Simulation<D>: Compiled<D>,
{
    for pair_precision in [PairPrecision::Double, PairPrecision::Single] {
        check(&Scene { numerics: Numerics { pair_precision, ..scene.numerics }, ..scene.clone() });
    }
}

#[test]
fn a_plane_column_is_the_same_to_the_last_bit() {
    in_both_precisions(&column([110, 80]));
}

#[test]
fn a_column_between_side_walls_is_the_same_to_the_last_bit() {
    let mut scene = column([110, 80]);
    let free = bytes(&scene, 1, InstructionSet::best());
    scene.side_walls = Some(SideWalls { width: 0.1, friction: 0.3 });
    assert!(bytes(&scene, 1, InstructionSet::best()) != free, "side walls change the state");
    in_both_precisions(&scene);
}

#[test]
fn a_column_in_space_is_the_same_to_the_last_bit() {
    in_both_precisions(&column([13, 12, 14]));
}

#[test]
fn a_law_with_a_field_is_the_same_to_the_last_bit() {
    in_both_precisions(&crate::invariants::fields::flowing([60, 50]));
    in_both_precisions(&crate::invariants::fields::flowing([13, 12, 14]));
}

#[test]
fn a_law_with_memories_is_the_same_to_the_last_bit() {
    check(&crate::invariants::memories::labelled([60, 50]));
    check(&crate::invariants::memories::labelled([13, 12, 14]));
}

#[test]
fn the_papers_numerics_are_the_same_to_the_last_bit() {
    let mut scene = column([60, 40]);
    scene.numerics = Numerics { momentum_operator: MomentumOperator::Pairwise, ..Numerics::paper() };
    scene.rheology = crate::invariants::patches::SYRUP;
    check(&scene);
}

#[test]
fn an_implicit_viscous_step_is_the_same_to_the_last_bit() {
    let Rheology::MuI(law) = GRAINS else { unreachable!("grains") };
    fn run<const D: usize>(mut scene: Scene<D>, rheology: Rheology)
    where
        Simulation<D>: Compiled<D>,
    {
        scene.numerics.viscous_step = ViscousStep::Implicit;
        scene.rheology = rheology;
        check(&scene);
    }
    let regularised = Rheology::RegularisedMuI(law.regularised(0.01));
    // 22 blocks of partial sums
    run(column([80, 70]), regularised);
    run(column([13, 12, 14]), regularised);
}

#[test]
fn one_changed_bit_in_the_start_changes_the_bytes() {
    let scene = column([20, 12]);
    let mut other = scene.clone();
    other.flow.density[7] = other.flow.density[7].next_up();
    let best = InstructionSet::best();
    assert!(bytes(&scene, 1, best) != bytes(&other, 1, best), "the comparison can fail");
}
