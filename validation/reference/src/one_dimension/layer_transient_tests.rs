//! Tests of the 1-D layer solver: exact limits, observed orders, tabulated times.

use super::*;
use crate::one_dimension::bagnold_profile::glass_beads;
use crate::one_dimension::table::{number, rows};
use bagnold_solver::material::rheology::MuI;

fn from_rest(degrees: f64, cells: usize, time_step: f64, duration: f64) -> (LayerTransient, TransientHistory) {
    let mut layer = LayerTransient::from_rest(glass_beads(degrees), cells, time_step).expect("accepted");
    let history = layer.run(duration, &[]).expect("converges");
    (layer, history)
}

#[test]
fn tends_to_the_bagnold_profile_as_the_cells_shrink() {
    let exact = glass_beads(24.0);
    let error = |cells: usize| {
        let profile = from_rest(24.0, cells, 0.02, 30.0).0.profile();
        let squares = profile.heights.iter().zip(&profile.velocities).map(|(y, u)| {
            let difference = u / exact.velocity(*y).expect("steady") - 1.0;
            difference * difference
        });
        (squares.sum::<f64>() / cells as f64).sqrt()
    };
    let (coarse, fine) = (error(20), error(40));
    let order = (coarse / fine).log2();
    println!("relative L2 {coarse:.2e}, {fine:.2e}, order {order:.2}");
    assert!(fine < 2e-2 && order > 1.4, "{coarse}, {fine}, order {order}");
    let mean =
        |cells: usize| from_rest(24.0, cells, 0.02, 30.0).0.depth_mean() / exact.depth_mean().expect("steady") - 1.0;
    let order = (mean(20) / mean(40)).log2();
    println!("depth mean {:.2e}, {:.2e}, order {order:.2}", mean(20), mean(40));
    assert!(mean(80).abs() < 5e-4 && order > 1.8 && order < 2.2, "order {order}");
}

#[test]
fn converges_with_first_order_in_the_time_step_and_second_in_the_cell() {
    let mean = |cells, step| from_rest(24.0, cells, step, 1.0).0.depth_mean();
    let (a, b, c) = (mean(40, 0.02), mean(40, 0.01), mean(40, 0.005));
    let time_order = ((a - b) / (b - c)).log2();
    let (a, b, c) = (mean(25, 0.01), mean(50, 0.01), mean(100, 0.01));
    let cell_order = ((a - b) / (b - c)).log2();
    println!("orders: time {time_order:.3}, cell {cell_order:.3}");
    assert!((time_order - 1.0).abs() < 0.1, "order in time {time_order}");
    assert!((cell_order - 2.0).abs() < 0.2, "order in the cell {cell_order}");
}

#[test]
fn reproduces_the_tabulated_transients() {
    for row in rows(include_str!("../../reference-data/bagnold/transient.csv")) {
        let [slope, expected, uncertainty] =
            ["slope angle [deg]", "value [s or m/s]", "uncertainty [s or m/s]"].map(|column| number(&row, column));
        let quantity = &row["quantity"];
        let value = match quantity.as_str() {
            "t_99 from rest" => {
                let steady = glass_beads(slope).depth_mean().expect("steady");
                from_rest(slope, 100, 5e-4, 3.0).1.rise_time(steady, 0.99).expect("reached")
            }
            "depth mean at 1 s from rest" => from_rest(slope, 100, 5e-4, 1.0).0.depth_mean(),
            "arrest time from the 24 degree profile" => arrest(slope, 100, 1e-3).expect("arrests"),
            unknown => panic!("no computation for {unknown}"),
        };
        println!("{quantity} at {slope}°: {value:.4} for {expected}");
        assert!(
            (value - expected).abs() <= uncertainty,
            "{quantity} at {slope}°: {value} for {expected} ± {uncertainty}"
        );
    }
}

fn arrest(degrees: f64, cells: usize, step: f64) -> Option<f64> {
    let start = glass_beads(24.0);
    let velocity = |y| start.velocity(y).unwrap_or(f64::NAN);
    let mut layer = LayerTransient::from_profile(glass_beads(degrees), cells, step, velocity).expect("accepted");
    let history = layer.run(1.5, &[]).expect("converges");
    assert_eq!(layer.depth_mean(), 0.0, "unyielded everywhere is rest, exactly");
    history.arrest_time(1e-3)
}

/// Depth mean `[m/s]` by a different method: explicit, the stress carried by a stiff elastic spring and returned
/// to the friction law (hyperbolic with wave speed √stiffness, where the solver under test is parabolic).
fn explicit_elastic_depth_mean(layer: &BagnoldProfile, cells: usize, duration: f64) -> f64 {
    let (width, stiffness) = (layer.layer_height / cells as f64, 400.0f64);
    let step = 0.2 * width / stiffness.sqrt();
    let push = layer.gravity * libm::sin(layer.inclination);
    let (mut velocity, mut stress) = (vec![0.0; cells], vec![0.0; cells + 1]);
    for _ in 0..(duration / step) as usize {
        for j in 0..cells {
            let shear = if j == 0 { velocity[0] / (0.5 * width) } else { (velocity[j] - velocity[j - 1]) / width };
            let pressure = layer.gravity * libm::cos(layer.inclination) * (layer.layer_height - j as f64 * width);
            let (low, high) = (layer.grains.static_friction * pressure, layer.grains.limiting_friction * pressure);
            let rate =
                layer.grains.reference_inertia * (layer.solid_fraction * pressure).sqrt() / layer.grains.grain_diameter;
            let trial: f64 = stress[j] + stiffness * step * shear;
            let relaxation = rate * stiffness * step;
            let (sum, product) = (high + trial + relaxation, high * trial + low * relaxation);
            let returned = 2.0 * product / (sum + (sum * sum - 4.0 * product).sqrt());
            stress[j] = if trial > low { returned } else { trial };
        }
        for i in 0..cells {
            velocity[i] += step * (push + (stress[i + 1] - stress[i]) / width);
        }
    }
    velocity.iter().sum::<f64>() / cells as f64
}

#[test]
fn agrees_with_an_explicit_elastic_computation() {
    let explicit = explicit_elastic_depth_mean(&glass_beads(24.0), 20, 1.0);
    let implicit = from_rest(24.0, 20, 2.5e-4, 1.0).0.depth_mean();
    println!("implicit {implicit:.5}, explicit {explicit:.5}");
    assert!((implicit / explicit - 1.0).abs() < 1e-3, "{implicit} and {explicit}");
}

#[test]
fn arrest_time_converges() {
    let times = [(50, 2e-3), (100, 1e-3), (200, 5e-4)].map(|(cells, step)| arrest(20.0, cells, step).expect("arrests"));
    println!("arrest {times:?}");
    assert!((times[1] - times[2]).abs() < 0.005 * times[2], "{times:?}");
}

#[test]
fn a_steep_layer_tends_to_the_acceleration_of_limiting_friction() {
    // tan 34° > μ_2: the bed's friction tends to μ_2 p, so dŪ/dt tends to g cosθ (tanθ − μ_2) from above.
    let (angle, history) = (34.0f64.to_radians(), from_rest(34.0, 50, 0.02, 400.0).1);
    let last = history.times.len() - 1;
    let acceleration =
        (history.depth_means[last] - history.depth_means[last - 50]) / (history.times[last] - history.times[last - 50]);
    let limit = 9.81 * (libm::sin(angle) - 0.643 * libm::cos(angle));
    println!("acceleration {acceleration} limit {limit}");
    assert!(acceleration > limit && acceleration < 1.05 * limit, "{acceleration} for {limit}");
}

#[test]
fn a_layer_below_the_static_angle_never_starts() {
    let (layer, history) = from_rest(20.0, 40, 1e-2, 1.0);
    assert!(layer.profile().velocities.iter().all(|u| *u == 0.0));
    assert_eq!(history.rise_time(1.0, 0.5), None);
}

#[test]
fn motion_is_the_same_mirrored() {
    let up = from_rest(24.0, 30, 0.01, 0.5).0.depth_mean();
    let down = from_rest(-24.0, 30, 0.01, 0.5).0.depth_mean();
    assert!(up > 0.05 && (up + down).abs() < 1e-12, "{up}, {down}");
}

#[test]
fn profiles_are_recorded_at_the_times_asked_for() {
    let mut layer = LayerTransient::from_rest(glass_beads(24.0), 20, 0.01).expect("accepted");
    let history = layer.run(0.5, &[0.0, 0.1, 0.33, 2.0]).expect("converges");
    let times: Vec<f64> = history.profiles.iter().map(|profile| profile.time).collect();
    assert_eq!(times.len(), 3);
    assert!((times[1] - 0.1).abs() < 1e-9 && (times[2] - 0.33).abs() < 1e-9);
    assert_eq!(history.times.len(), 51);
}

#[test]
fn bad_resolutions_are_refused() {
    let layer = glass_beads(24.0);
    assert!(LayerTransient::from_rest(layer, 1, 0.01).is_err());
    assert!(LayerTransient::from_rest(layer, 10, f64::NAN).is_err());
    assert!(LayerTransient::from_profile(layer, 10, 0.01, |_| f64::NAN).is_err());
    assert!(
        LayerTransient::from_rest(
            BagnoldProfile { grains: MuI { limiting_friction: 0.3, ..layer.grains }, ..layer },
            10,
            0.01
        )
        .is_err()
    );
}
