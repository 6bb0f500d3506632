//! Grains in columns with their water, step by step.

#[path = "../../../src/incompressible/columns/tests/moving_bed.rs"]
pub(super) mod moving_bed;

use bagnold_solver::incompressible::{IncompressibleScene, IncompressibleSimulation, SolidFraction};
use bagnold_solver::internals::incompressible::{Grains, state};
use moving_bed::{scene, shear_flow, with_eddies};

/// Momentum of fluid and grains together changes by gravity and by the held grains alone: moving grains are not a wall.
#[test]
fn the_balance_of_both_phases_closes() {
    for eddies in [0.0, 0.7] {
        assert_closed_balance(eddies);
    }
}

fn assert_closed_balance(eddies: f64) {
    let mut scene = with_eddies(scene(0.02, shear_flow, 5), eddies);
    // without pressure gradients of φ: the fluid's momentum counts by its share of the space
    scene.numerics.shifting = 0.0;
    let mut simulation = IncompressibleSimulation::new(scene).expect("a valid scene");
    for _ in 0..50 {
        simulation.step().expect("a step");
        let state = state(&simulation);
        let system = &state.system;
        let columns = state.columns.as_ref().expect("columns");
        let time_step = state.last_step;
        // what the rows of the fluid have lost to everything but each other
        let held: f64 = (0..system.velocity.len())
            .map(|row| (system.of_constant[row] - system.inertia[row]) * system.velocity[row][0])
            .sum();
        let exchanged: f64 = (0..system.velocity.len())
            .map(|row| (columns.drag.hold[row] * system.velocity[row][0] - columns.drag.push[row]) * time_step)
            .sum();
        let on_grains: f64 = columns.drag.impulse.iter().sum::<f64>() * columns.grid.row.width;
        assert!((exchanged - on_grains).abs() < 1e-12 * on_grains.abs(), "{exchanged} and {on_grains}");
        assert!(held > exchanged, "the floor holds as well");
        // the pressure moves nothing along the floor but fluid against grains
        let change = |row: usize| state.phases.fluid.velocity[row][0] - system.velocity[row][0];
        let of_fluid: f64 = (0..system.velocity.len()).map(|row| system.inertia[row] * change(row)).sum();
        let of_grains: f64 = columns.pressed.iter().sum::<f64>() * columns.grid.row.width;
        let size: f64 = columns.pressed.iter().map(|impulse| impulse.abs()).sum::<f64>() * columns.grid.row.width;
        assert!(size > 0.0 && (of_fluid + of_grains).abs() < 1e-4 * size, "{of_fluid} and {of_grains} of {size}");
    }
    let Grains { position, velocity, .. } = &state(&simulation).columns.as_ref().expect("columns").grains;
    assert!(position.iter().all(|x| x[1] > -4.5e-3 && x[1] < 6e-3));
    assert!(velocity.iter().all(|u| u[0] > -1e-3 && u[0] < 1.0));
}

#[test]
fn threads_change_no_bit() {
    let bytes = |threads: usize, eddies: f64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let mut simulation =
                IncompressibleSimulation::new(with_eddies(scene(0.06, shear_flow, 9), eddies)).expect("a valid scene");
            for _ in 0..20 {
                simulation.step().expect("a step");
            }
            simulation.snapshot().to_bytes()
        })
    };
    for eddies in [0.0, 0.7] {
        assert!(bytes(1, eddies) == bytes(2, eddies));
    }
}

#[test]
fn columns_ask_for_what_holds_them() {
    let problem = |change: &dyn Fn(&mut IncompressibleScene<2>)| {
        let mut scene = scene(0.01, |_| 0.0, 1);
        change(&mut scene);
        IncompressibleSimulation::new(scene).err().map(|error| error.to_string()).expect("a refusal")
    };
    let loose = problem(&|scene| scene.sediment.as_mut().expect("a sediment").wall.clear());
    assert!(loose.contains("grains that hold the columns"), "{loose}");
    let unstirred = problem(&|s| *s = with_eddies(s.clone(), f64::NAN));
    assert!(unstirred.contains("`turbulent_schmidt` is NaN, but must be 0 or positive"), "{unstirred}");
    let overlapping = problem(&|scene| scene.solid_fraction = SolidFraction::Overlapping);
    assert!(overlapping.contains("that of the columns where grains dilate"), "{overlapping}");
}
