//! The one-dimensional layer of `bed-load-1d`: μ_2, and μ_2 with B, from velocities of water and grains.

use super::coverage::{Problem, Tally, normal};
use bagnold_reference::one_dimension::bed_load::{
    BedLoadLayer, Closures, GrainMotion, InitialVelocity, STEADY, Stream,
};

/// Relative standard uncertainty of a transport.
const NOISE: f64 = 0.05;
/// Ranges of μ_2 and of the dilation B `[-]`.
const RANGES: [(f64, f64); 2] = [(0.5, 1.1), (0.1, 0.6)];
/// Slopes and depths of water `[m]` of the nine experiments.
const SLOPES: [f64; 3] = [0.02, 0.03, 0.05];
const DEPTHS: [f64; 3] = [0.036, 0.046, 0.056];

fn physical(u: &[f64]) -> [f64; 2] {
    let closures = Closures::default();
    let value = |k: usize| RANGES[k].0 + u[k] * (RANGES[k].1 - RANGES[k].0);
    [value(0), if u.len() > 1 { value(1) } else { closures.dilation }]
}

/// Truth in the unit cube: what the closures are by default.
fn truth(parameters: usize) -> Vec<f64> {
    let closures = Closures::default();
    let values = [closures.limiting_friction, closures.dilation];
    (0..parameters).map(|k| (values[k] - RANGES[k].0) / (RANGES[k].1 - RANGES[k].0)).collect()
}

/// Cells `[m]`: coarse ones for μ_2 alone. The topmost grains then fill or leave a whole cell at once, by steps of χ² that are
/// too high for ends along the valley of both parameters; there the cells are finer.
const CELL_HEIGHTS: [f64; 2] = [2e-3, 5e-4];

/// Transports `[m²/s]` of all experiments; none where a layer has no steady state.
fn transports([limiting_friction, dilation]: [f64; 2], cell_height: f64) -> Option<Vec<f64>> {
    let closures = Closures { limiting_friction, dilation, ..Closures::default() };
    let all = SLOPES.iter().flat_map(|slope| DEPTHS.iter().map(move |depth| (*slope, *depth)));
    let one = |(slope, flow_depth): (f64, f64)| {
        let stream = Stream {
            slope,
            flow_depth,
            bed_depth: 0.04,
            held_depth: 0.0,
            gravity: 9.81,
            fluid_density: 1000.0,
            kinematic_viscosity: 1e-6,
            grain_density: 2600.0,
            grain_diameter: 5e-3,
            drag_diameter: 1.0,
        };
        let layer =
            BedLoadLayer { stream, closures, grains: GrainMotion::Dilating, cell_height, steady_change: STEADY };
        layer.steady(InitialVelocity::Rest).ok().map(|state| state.transport())
    };
    all.map(one).collect()
}

fn layer(seed: u64, parameters: usize) -> Problem<impl Fn(&[f64]) -> Option<Vec<f64>>> {
    let truth = truth(parameters);
    let cell_height = CELL_HEIGHTS[parameters - 1];
    let exact = transports(physical(&truth), cell_height).expect("a steady state");
    let noise = normal(seed, exact.len());
    let residuals = move |u: &[f64]| {
        let model = transports(physical(u), cell_height)?;
        Some((0..model.len()).map(|k| (model[k] / exact[k] - 1.0) / NOISE - noise[k]).collect())
    };
    Problem { residuals, truth, series: Vec::new() }
}

#[test]
fn regions_of_the_layer_hold_the_truth() {
    let tally = Tally::of(0..6, &[0.3], |seed| layer(seed, 1));
    tally.print("bed-load-1d, μ_2");
    assert!(tally.joint >= 5 && tally.single[0] >= 5 && tally.settled >= 5, "{tally:?}");
}

#[test]
#[ignore = "the full study: a quarter of an hour"]
fn regions_of_forty_layers_hold_the_truth() {
    let one = Tally::of(100..140, &[0.3], |seed| layer(seed, 1));
    one.print("bed-load-1d, μ_2");
    let two = Tally::of(100..140, &[0.3, 0.7], |seed| layer(seed, 2));
    two.print("bed-load-1d, μ_2 and B");
    assert!(one.joint >= 34 && two.joint >= 34, "{one:?} {two:?}");
    let pooled = [one.pooled(), two.pooled()];
    let (held, all) = pooled.iter().fold((0, 0), |sum, part| (sum.0 + part.0, sum.1 + part.1));
    println!("pooled {held} of {all}");
    assert!(held as f64 >= 0.92 * all as f64, "{held} of {all}");
}
