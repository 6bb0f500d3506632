//! A small film through scene, probe and record.

use super::*;
use crate::case::Progress;
use crate::observation::Outcome;

const DEPTH: f64 = 0.012;
const SLOPE: f64 = 0.03;
const VISCOSITY: f64 = 1e-3;

fn exact(z: f64) -> f64 {
    9.81 * SLOPE / VISCOSITY * (DEPTH * z - 0.5 * z * z)
}

fn film(until: AveragingWindowEnd, window: f64) -> Channel<'static> {
    Channel {
        slope: SLOPE,
        kinematic_viscosity: VISCOSITY,
        bed: Bed::NoSlip(0.0),
        jitter: 0.1,
        seed: 3,
        until,
        window,
        interval: 1e-3,
        ..Channel::of(Lattice { spacing: 2e-3, rows: 6, columns: 6, bottom: 0.0 }, 1000.0, 9.81, &exact)
    }
}

#[test]
fn momentum_closes_and_samples_are_evenly_spaced() {
    let (record, seen) = film(AveragingWindowEnd::Time(0.1), 0.05)
        .run_observed(&Progress::SILENT, (0, 0), |seen: &mut (usize, usize), simulation, in_window| {
            assert_eq!(simulation.fluid().0.len(), 36);
            seen.0 += 1;
            seen.1 += usize::from(in_window);
        })
        .expect("a valid scene");
    let data = &record.data;
    assert_eq!(record.outcome, Outcome::Finished);
    assert_eq!((seen.0, data.series.time.len()), (100, 100));
    assert_eq!((seen.1, data.profile.times), (51, 51), "the window's first sample counts");
    assert!((data.window.0 - 0.05).abs() < 1e-9 && (data.window.1 - 0.1).abs() < 1e-9, "{:?}", data.window);
    assert!(data.momentum.residual().abs() < 1e-11, "{:?}", data.momentum);
    // the impulse of the body force is its weight along the slope times the window's length
    let driven = 1000.0 * 9.81 * SLOPE * 36.0 * 4e-6 * 0.05;
    assert!((data.momentum.driven / driven - 1.0).abs() < 1e-9);
    // the bed's friction over time is the impulse of the walls
    let shear: f64 = data.series.within(&data.series.bed_shear, (0.0505, 0.1001)).iter().sum();
    assert!((shear * 1e-3 * 0.012 / -data.momentum.held - 1.0).abs() < 1e-9);
    assert_eq!((data.particles_lost, record.frames.len()), (0, 2));
}

#[test]
fn a_stationary_flow_ends_one_window_after_the_criterion() {
    let until = AveragingWindowEnd::Stationary { tolerance: 0.1, checks: 2, at_most: 10.0 };
    let record = film(until, 0.02).run(&Progress::SILENT).expect("a valid scene");
    let data = &record.data;
    assert!(matches!(record.outcome, Outcome::Stopped { .. }), "{:?}", record.outcome);
    assert_eq!(data.stationary_since, Some(data.window.0));
    assert!((data.window.1 - data.window.0 - 0.02).abs() < 1.1e-3);

    let never = AveragingWindowEnd::Stationary { tolerance: 0.1, checks: 2, at_most: 0.01 };
    let record = film(never, 0.02).run(&Progress::SILENT).expect("a valid scene");
    assert_eq!(record.outcome, Outcome::Finished);
    assert_eq!(record.data.stationary_since, None);
    assert!((record.data.window.0 - 0.01).abs() < 1e-9);
}
