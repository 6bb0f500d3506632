//! A simulation that is saved, written, read and continued, also on another number of threads, ends in the bits of one
//! that was never interrupted.

use crate::invariants::determinism::column;
use crate::invariants::fields;
use crate::invariants::inlets;
use crate::invariants::loads;
use crate::invariants::memories;
use crate::invariants::patches::{self, GRAINS, SYRUP, bed, simulation};
use crate::invariants::shells;
use crate::invariants::turns;
use crate::invariants::two_phases;
use bagnold_solver::incompressible::{IncompressibleScene, IncompressibleSimulation, SavedIncompressible};
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::run::{Observer, RunProgress, StopReason};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::SavedSimulation;
use bagnold_solver::weakly_compressible::numerics::{MomentumOperator, Numerics, ViscousStep};
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::walls::SideWalls;
use rayon::ThreadPoolBuilder;
use std::ops::ControlFlow;

/// Steps before a simulation is saved, of all; in between the neighbours are searched anew.
const SAVED: [usize; 3] = [0, 1, 57];
const STEPS: usize = 120;

fn on<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool").install(work)
}

pub(crate) fn check<const D: usize>(scene: &Scene<D>)
where
    Simulation<D>: Compiled<D>,
{
    let end = |simulation: &Simulation<D>| {
        let counts = (simulation.steps(), simulation.neighbour_searches(), simulation.viscous_iterations());
        (
            simulation.snapshot().to_bytes(),
            counts,
            simulation.energy(),
            simulation.side_wall_impulse(),
            simulation.time().to_bits(),
        )
    };
    let expected = on(1, || {
        let mut whole = simulation(scene.clone());
        patches::advance(&mut whole, STEPS);
        assert!(whole.neighbour_searches() > 2, "the particles are sorted anew in the run");
        end(&whole)
    });
    for (saved, threads) in SAVED.into_iter().zip([(1, 2), (2, 1), (3, 1)]) {
        let written = on(threads.0, || {
            let mut first = simulation(scene.clone());
            patches::advance(&mut first, saved);
            postcard::to_stdvec(&first.save()).expect("written")
        });
        let found = on(threads.1, || {
            let read: SavedSimulation<'static, D> = postcard::from_bytes(&written).expect("read");
            // of the flow only the number of particles counts
            let mut other = scene.clone();
            other.flow.velocity.fill(Vector::repeat(1.0));
            let mut second = Simulation::continued(other, read).expect("the same scene");
            assert_eq!(postcard::to_stdvec(&second.save()).expect("written"), written, "saved again");
            patches::advance(&mut second, STEPS - saved);
            end(&second)
        });
        assert!(found == expected, "saved after {saved} steps");
    }
}

#[test]
fn columns_in_the_plane_and_in_space_go_on_in_the_same_bits() {
    check(&column([40, 30]));
    check(&column([9, 8, 10]));
}

#[test]
fn every_operator_and_step_goes_on_in_the_same_bits() {
    let Rheology::MuI(law) = GRAINS else { unreachable!("grains") };
    let mut implicit = column([40, 30]);
    implicit.numerics.viscous_step = ViscousStep::Implicit;
    implicit.rheology = Rheology::RegularisedMuI(law.regularised(0.01));
    check(&implicit);
    for momentum_operator in [MomentumOperator::Pairwise, MomentumOperator::PairwiseCorrected] {
        let mut scene = column([40, 30]);
        scene.numerics = Numerics { momentum_operator, ..Numerics::paper() };
        scene.rheology = SYRUP;
        check(&scene);
    }
    let mut uncoupled = column([40, 30]);
    uncoupled.numerics =
        Numerics { momentum_operator: MomentumOperator::Pairwise, density_coupling: 0.0, ..Numerics::paper() };
    uncoupled.rheology = SYRUP;
    check(&uncoupled);
}

#[test]
fn a_law_with_a_field_goes_on_in_the_same_bits() {
    check(&fields::flowing([40, 30]));
    check(&fields::flowing([9, 8, 10]));
    check(&memories::labelled([40, 30]));
    check(&memories::labelled([9, 8, 10]));
    let mut fed = inlets::fed();
    fed.rheology = fields::nonlocal();
    check(&fed);
    let mut gated = shells::gated();
    gated.rheology = fields::nonlocal();
    gated.enclosure.exits.lower = Vector::<2>::new(f64::NEG_INFINITY, 0.004);
    check(&gated);
}

#[test]
fn a_wall_that_travels_goes_on_in_the_same_bits() {
    let mut scene = column([40, 30]);
    let mut travelling = bed();
    travelling.velocity[0] = 0.5;
    travelling.travel = 0.01;
    scene.walls = vec![travelling];
    check(&scene);
}

#[test]
fn walls_of_segments_and_open_sides_go_on_in_the_same_bits() {
    let mut scene = shells::gated();
    scene.enclosure.exits.lower = Vector::<2>::new(f64::NEG_INFINITY, 0.004);
    check(&scene);
    let mut simulation = simulation(scene);
    patches::advance(&mut simulation, STEPS);
    assert!(simulation.outflow().particles() > 0, "somebody leaves on the way");
    let mut narrow = shells::gated();
    narrow.side_walls = Some(SideWalls { width: 0.1, friction: 0.3 });
    check(&narrow);
}

#[test]
fn walls_that_loads_move_or_that_turn_go_on_in_the_same_bits() {
    check(&loads::pressed(30.0));
    check(&loads::pressed_in_space());
    check(&loads::sheared());
    check(&turns::drum(3.0));
    check(&turns::tube());
}

#[test]
fn inlets_go_on_in_the_same_bits() {
    check(&inlets::fed());
    check(&inlets::fed_in_space());
    let mut simulation = simulation(inlets::fed());
    patches::advance(&mut simulation, STEPS);
    let rows = simulation.inflow().inlets[0].rows;
    assert!(rows > 2, "{rows} rows come in on the way");
}

fn check_phases(scene: &IncompressibleScene<2>) {
    let end = |simulation: &IncompressibleSimulation<2>| {
        let forces = (simulation.holding_force(), simulation.time().to_bits(), simulation.cost());
        (simulation.snapshot().to_bytes(), forces)
    };
    let expected = on(1, || {
        let mut whole = two_phases::simulation(scene.clone());
        two_phases::advance(&mut whole, STEPS);
        assert!(whole.cost().searches > 2, "candidates are searched anew in the run");
        end(&whole)
    });
    for (saved, threads) in SAVED.into_iter().zip([(1, 2), (2, 1), (3, 1)]) {
        let written = on(threads.0, || {
            let mut first = two_phases::simulation(scene.clone());
            two_phases::advance(&mut first, saved);
            postcard::to_stdvec(&first.save()).expect("written")
        });
        let found = on(threads.1, || {
            let read: SavedIncompressible<2> = postcard::from_bytes(&written).expect("read");
            let mut second = IncompressibleSimulation::continued(scene.clone(), read).expect("the same scene");
            two_phases::advance(&mut second, STEPS - saved);
            end(&second)
        });
        assert!(found == expected, "saved after {saved} steps");
    }
}

#[test]
fn water_and_grains_go_on_in_the_same_bits() {
    check_phases(&two_phases::bed([40, 30], 6, 9));
    check_phases(&two_phases::periodic_box([24, 24], 0.1, 0.5, 3));
}

#[test]
fn a_state_of_another_scene_is_refused() {
    let saved = simulation(column([20, 12]));
    let refused = Simulation::continued(column([20, 13]), saved.save()).expect_err("another scene");
    assert_eq!(refused.to_string(), "the saved state has 240 flow particles, but its scene has 260");
    let saved = two_phases::simulation(two_phases::bed([16, 16], 4, 2)).save();
    let water = two_phases::water([16, 16], 0.02, 2);
    let refused = IncompressibleSimulation::continued(water, saved).expect_err("another scene");
    assert_eq!(refused.to_string(), "the saved state has 1 sediments, but its scene has 0");
}

/// A clock far before the start would run for ever.
#[test]
fn a_state_from_before_the_start_is_refused() {
    let scene = column([20, 12]);
    let mut simulation = simulation(scene.clone());
    patches::advance(&mut simulation, 3);
    let written = postcard::to_stdvec(&simulation.save()).expect("written");
    let now = simulation.time().to_le_bytes();
    let place = written.windows(8).position(|bytes| bytes == now).expect("the time");
    for time in [-3.2e277, f64::NAN, f64::INFINITY] {
        let mut damaged = written.clone();
        damaged[place..place + 8].copy_from_slice(&time.to_le_bytes());
        let read: SavedSimulation<'_, 2> = postcard::from_bytes(&damaged).expect("read");
        let refused = Simulation::continued(scene.clone(), read).expect_err("a damaged clock");
        assert!(refused.to_string().contains(&format!("its time is {time} s, but must be")), "{time}: {refused}");
    }
    let bed = || two_phases::bed([16, 16], 4, 2);
    let saved = two_phases::simulation(bed()).save();
    let mut later = serde_json::to_value(&saved).expect("written");
    later["time"] = (-1.0).into();
    let read: SavedIncompressible<2> = serde_json::from_value(later).expect("read");
    let refused = IncompressibleSimulation::continued(bed(), read).expect_err("a damaged clock");
    assert!(refused.to_string().contains("its time is -1 s, but must be"), "{refused}");
}

/// Interrupts a run after some steps, and remembers when it was shown what.
struct Interrupting {
    steps: u64,
    seen: Vec<(u64, u64)>,
}

impl Observer<Simulation<2>> for Interrupting {
    fn observe(&mut self, simulation: &Simulation<2>) -> ControlFlow<()> {
        self.seen.push((simulation.steps(), simulation.time().to_bits()));
        ControlFlow::Continue(())
    }

    fn pause(&mut self, simulation: &Simulation<2>, _: &RunProgress) -> ControlFlow<()> {
        if simulation.steps() == self.steps { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    }
}

#[test]
fn an_interrupted_course_shows_what_it_would_have_shown() {
    let (end, interval) = (0.02, 0.003);
    let run = |interruptions: &[u64]| {
        let scene = column([20, 12]);
        let mut going = simulation(scene.clone());
        let mut course = RunProgress::new(end, interval);
        let mut seen = Vec::new();
        for &steps in interruptions {
            let mut observer = Interrupting { steps, seen };
            assert_eq!(going.follow(&mut course, &mut observer), StopReason::Interrupted);
            seen = observer.seen;
            let written = postcard::to_stdvec(&(course, going.save())).expect("written");
            let (read, saved): (RunProgress, SavedSimulation<'static, 2>) =
                postcard::from_bytes(&written).expect("read");
            assert_eq!(read, course);
            course = read;
            going = Simulation::continued(scene.clone(), saved).expect("the same scene");
        }
        let mut observer = Interrupting { steps: u64::MAX, seen };
        assert_eq!(going.follow(&mut course, &mut observer), StopReason::Finished);
        (observer.seen, going.snapshot().to_bytes())
    };
    let whole = run(&[]);
    assert!(whole.0.len() > 6);
    assert_eq!(run(&[0, 1, 20, 33]), whole);
}
