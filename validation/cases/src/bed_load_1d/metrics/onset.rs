//! The onset of motion over the grain size, beside Shields' curve.
//!
//! A layer has no threshold but a transport that falls steeply, so the onset is where it falls below a rate. Three are
//! given: W* = q*/τ*^{3/2} = 0.002, the literature's own definition of a reference transport (Parker, Klingeman & McLean 1982),
//! q* = 10⁻⁴ and q* = 10⁻³. Which of them would count as motion is no literature's choice, and W* = 0.002 is some 10⁻⁵ of q*, within the
//! creep of a resting bed whose yield is regularised (half its rate moves that onset by 2 to 10 %, and that of
//! q* = 10⁻⁴ by less than 1 %); from the first to the last lies a factor of two. So does between the methods by
//! which experimenters tell it: every criterion is judged by the band of the thresholds that they measured with grains of that size.

use super::super::BedLoad1dRecord;
use super::super::flow::BedLoad1dFlow;
use super::super::onset_criterion::{CRITERIA, OnsetCriterion};
use super::super::quantities::ONSET_OVER_MEASURED;
use super::super::records::scans;
use super::super::run::BedLoadLayerObservation;
use super::one_state;
use crate::case::Flow;
use crate::metric::{Limit, Metric, Origin};
use crate::reference::bed_load::{MOTION_THRESHOLDS, thresholds_about};

/// Onsets beside measured thresholds, and how far the starts differ.
pub(super) fn metrics(records: &[BedLoad1dRecord]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (run, data) in scans(records) {
        metrics.extend(CRITERIA.iter().filter_map(|(criterion, name)| beside_measured(run, data, *criterion, name)));
        metrics.push(one_state(&run.variant(), data.start_difference, "the layers from rest, all Shields numbers"));
    }
    metrics
}

/// An onset over the median of the thresholds measured with grains of its size; none where too few were.
fn beside_measured(
    run: &BedLoad1dFlow,
    data: &BedLoadLayerObservation,
    criterion: OnsetCriterion,
    name: &str,
) -> Option<Metric> {
    let thresholds = &*MOTION_THRESHOLDS;
    let band = thresholds_about(run.stream().dimensionless_diameter())?;
    let (lower, upper) = band.bounds;
    let crossing = criterion.onset(&data.scan);
    let value = crossing.value() / band.median;
    let creep = (criterion.onset(&data.scan_at_half_rate).value() / crossing.value() - 1.0).abs();
    let remark = crossing.remark();
    let source = format!("median of {} measured thresholds, {}{remark}", band.number, thresholds.source);
    let scatter =
        "half of the width of the middle two thirds of the thresholds with grains within a factor of two in size";
    let bent = "distance of the straight line in logarithms between two Shields numbers of the scan to the parabola through three";
    let creeping = "change with half the regularisation rate of the yield stress; without creep the change is about twice as large";
    let reason = "limits enclose 90 % of thresholds measured with grains of 0.5 to 2 times this size";
    let metric = ONSET_OVER_MEASURED
        .of(&run.variant().and("criterion", name), value)
        .against(Some(1.0), &source, thresholds.confidence)
        .known_to(Origin::Experiment, Some(band.deviation / band.median), scatter)
        .known_to(Origin::Numerical, Some(value * criterion.bend(&data.scan)), bent)
        .known_to(Origin::Numerical, Some(value * creep), creeping)
        .gated(Limit::Within(lower / band.median, upper / band.median), reason)
        .with_snapshot_tolerance(0.01, 0.0);
    Some(metric)
}
