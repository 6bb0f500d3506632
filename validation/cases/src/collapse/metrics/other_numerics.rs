//! Columns of the sand with other numerics beside the same ones as they are: with an eddy viscosity, and without the coupling of density
//! and pressure (27), whose pressure then oscillates.

use super::quantities::*;
use super::{Measure, RESULTS, bands};
use crate::case::Flow;
use crate::collapse::{Collapse, CollapseRecord};
use crate::metric::{Confidence, Metric, Variant};
use crate::observation::Frame;

/// Time at which the noise is measured over √(h_0/g) `[-]`: in mid-collapse, when a picture is taken anyway.
const MID_COLLAPSE: f64 = 1.5;
/// Distance within which particles are neighbours, in spacings `[-]`.
const NEAR: f64 = 2.1;
/// Fewest neighbours whose mean says something: fewer stand at a surface.
const FEWEST: usize = 10;

pub(super) fn metrics<const D: usize>(records: &[CollapseRecord<D>]) -> Vec<Metric> {
    let of = |record: &CollapseRecord<D>| match record.0.partner(records) {
        Some(own) if record.0.has_eddies() => with_eddies(record, own),
        Some(own) if !record.0.is_coupled() => without_coupling(record, own),
        _ => Vec::new(),
    };
    records.iter().flat_map(of).collect()
}

/// By how much an eddy viscosity moves run-out and height, and how much nearer to the laws it brings the run-out.
fn with_eddies<const D: usize>((run, record): &CollapseRecord<D>, (_, own): &CollapseRecord<D>) -> Vec<Metric> {
    let variant = run.variant();
    let change = |of: Measure| 100.0 * (of(&record.data) / of(&own.data) - 1.0);
    let acts = "statement of the collapse paper: turbulence acts in such fluids at high Reynolds numbers";
    let helps = "statement of the collapse paper: the eddy viscosity helped where tall columns flow fast";
    let mut metrics: Vec<Metric> = RESULTS
        .into_iter()
        .map(|(quantity, of)| {
            EDDY_CHANGE
                .of(&Variant::of("quantity", quantity).followed_by(&variant), change(of).abs())
                .against(None, acts, Confidence::Medium)
                .with_snapshot_tolerance(0.05, 0.1)
        })
        .collect();
    if let Some(law) = bands::laws_of(run).0.value(run.initial_height()) {
        let off = |collapse: &Collapse| 100.0 * (collapse.run_out() / law - 1.0).abs();
        metrics.push(
            EDDY_GAIN
                .of(&variant, off(&own.data) - off(&record.data))
                .against(None, helps, Confidence::Medium)
                .with_snapshot_tolerance(0.05, 0.1),
        );
    }
    metrics
}

/// Noise of pressure and velocity in mid-collapse without the coupling over that with it.
fn without_coupling<const D: usize>((run, record): &CollapseRecord<D>, (_, own): &CollapseRecord<D>) -> Vec<Metric> {
    let statement = "statement of the collapse paper: oscillations of the pressure can disturb velocity and surface, for the law depends on it";
    let time = MID_COLLAPSE * run.time_scale();
    let (Some(without), Some(with)) = (Frame::nearest(&record.frames, time), Frame::nearest(&own.frames, time)) else {
        return Vec::new();
    };
    let noise = |frame: &Frame| {
        let speeds = frame.speeds();
        let scale = (speeds.iter().map(|speed| speed * speed).sum::<f64>() / speeds.len() as f64).sqrt();
        let velocity = frame.vector("velocity");
        let across: Vec<f64> = velocity.iter().map(|velocity| velocity[1]).collect();
        let along: Vec<f64> = velocity.iter().map(|velocity| velocity[0]).collect();
        let of = |values: &[f64]| roughness(&frame.position, values, NEAR * run.spacing());
        (of(&frame.pressures()), of(&along).hypot(of(&across)) / scale)
    };
    let (without, with) = (noise(without), noise(with));
    let variant = run.variant();
    [(PRESSURE_NOISE_RATIO, without.0 / with.0), (VELOCITY_NOISE_RATIO, without.1 / with.1)]
        .map(|(quantity, ratio)| {
            quantity
                .of(&variant, ratio)
                .against(Some(1.0), statement, Confidence::Medium)
                .with_snapshot_tolerance(0.05, 0.0)
        })
        .to_vec()
}

/// Root mean square of a value less the mean over the neighbours, of particles that have enough of them.
fn roughness(position: &[[f64; 3]], values: &[f64], near: f64) -> f64 {
    let mut order: Vec<usize> = (0..position.len()).collect();
    order.sort_by(|&a, &b| position[a][0].total_cmp(&position[b][0]));
    let (mut squares, mut number) = (0.0, 0_usize);
    let mut from = 0;
    for &own in &order {
        while position[order[from]][0] < position[own][0] - near {
            from += 1;
        }
        let (mut sum, mut count) = (0.0, 0_usize);
        let beside = order[from..].iter().take_while(|&&other| position[other][0] <= position[own][0] + near);
        for &other in beside.filter(|&&other| other != own) {
            let way = (position[other][0] - position[own][0]).hypot(position[other][1] - position[own][1]);
            if way <= near {
                sum += values[other];
                count += 1;
            }
        }
        if count >= FEWEST {
            let off = values[own] - sum / count as f64;
            squares += off * off;
            number += 1;
        }
    }
    (squares / number as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gradient_is_no_noise_and_turns_of_sign_are() {
        let position: Vec<[f64; 3]> = (0..400).map(|k| [f64::from(k % 20), f64::from(k / 20), 0.0]).collect();
        let of = |value: &dyn Fn(&[f64; 3]) -> f64| {
            let values: Vec<f64> = position.iter().map(value).collect();
            roughness(&position, &values, 2.1)
        };
        // inside a lattice a gradient cancels; at its edges some neighbours are missing
        let linear = of(&|x| 0.1 * x[0]);
        let turns = of(&|x| if (x[0] + x[1]) as i64 % 2 == 0 { 0.1 } else { -0.1 });
        // of twelve neighbours four have the other sign: two thirds
        assert!(linear < 0.01 && (turns - 0.1 * 2.0 / 3.0).abs() < 0.005, "{linear}, {turns}");
    }
}
