//! The onset of motion over the grain size, beside Shields' curve.
//!
//! A layer has no threshold but a transport that falls steeply, so the onset is where it falls below a rate. Three are
//! given: W* = q*/τ*^{3/2} = 0.002, the literature's own definition of a reference transport (Parker, Klingeman & McLean 1982),
//! q* = 10⁻⁴ and q* = 10⁻³. Which of them would count as motion is no literature's choice, and W* = 0.002 is some 10⁻⁵ of q*, within the
//! creep of a resting bed whose yield is regularised (half its rate moves that onset by 2 to 10 %, and that of
//! q* = 10⁻⁴ by less than 1 %); from the first to the last lies a factor of two. So does between the methods by
//! which experimenters tell it: every criterion is judged by the band of the thresholds that they measured with grains of that size.

use super::BedLoad1dRecord;
use super::onset_criterion::{CRITERIA, OnsetCriterion};
use super::quantities::ONSET_OVER_MEASURED;
use super::records::one_state;
use super::run::{BedLoad1dRun, BedLoadLayerObservation, LayerPurpose};
use crate::case::Run;
use crate::figure::{Axis, Figure, Mark, Panel, Series};
use crate::metric::{Limit, Metric, Origin};
use crate::reference::bed_load::{MOTION_THRESHOLDS, ONSET_SCATTER, ONSET_SOURCE, critical_shields_number};

/// Colour of the measured thresholds, beyond those of the criteria.
const MEASURED_SLOT: usize = 6;

fn tables(records: &[BedLoad1dRecord]) -> impl Iterator<Item = (&BedLoad1dRun, &BedLoadLayerObservation)> {
    records.iter().filter(|(run, _)| run.purpose == LayerPurpose::Onset).map(|(run, record)| (run, &record.data))
}

/// Onsets beside measured thresholds, and how far the starts differ.
pub(super) fn metrics(records: &[BedLoad1dRecord]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (run, data) in tables(records) {
        metrics.extend(CRITERIA.iter().filter_map(|(criterion, name)| beside_measured(run, data, *criterion, name)));
        metrics.push(one_state(&run.variant(), data.start_difference, "the layers from rest, all Shields numbers"));
    }
    metrics
}

/// An onset over the median of the thresholds measured with grains of its size; none where too few were.
fn beside_measured(
    run: &BedLoad1dRun,
    data: &BedLoadLayerObservation,
    criterion: OnsetCriterion,
    name: &str,
) -> Option<Metric> {
    let thresholds = &*MOTION_THRESHOLDS;
    let band = thresholds.band(run.stream.dimensionless_diameter())?;
    let (lower, upper) = band.bounds;
    let crossing = criterion.onset(&data.scan);
    let value = crossing.value() / band.median;
    let creep = (criterion.onset(&data.scan_at_half_rate).value() / crossing.value() - 1.0).abs();
    let remark = crossing.remark();
    let source = format!("median of {} measured thresholds, {}{remark}", band.number, thresholds.source);
    let metric = ONSET_OVER_MEASURED
        .of(&run.variant().and("criterion", name), value)
        .against(Some(1.0), &source, thresholds.confidence)
        .known_to(
            Origin::Experiment,
            Some(band.deviation / band.median),
            "half of the width of the middle two thirds of the thresholds with grains within a factor of two in size",
        )
        .known_to(
            Origin::Numerical,
            Some(value * criterion.bend(&data.scan)),
            "distance of the straight line in logarithms between two Shields numbers of the scan to the parabola through three",
        )
        .known_to(
            Origin::Numerical,
            Some(value * creep),
            "what half the rate of the regularised yield adds, of about twice as much that no creep would",
        )
        .gated(
            Limit::Within(lower / band.median, upper / band.median),
            "nine tenths of the measured thresholds of grains within a factor of two in size lie there, whatever their authors took for motion",
        )
        .with_snapshot_tolerance(0.01, 0.0);
    Some(metric)
}

/// Onset over the grain size, and the transport about it.
pub(super) fn figure(records: &[BedLoad1dRecord]) -> Option<Figure> {
    let mut curve = Panel::new("onset", Axis::logarithmic("D* [-]"), Axis::logarithmic("τ* at the onset [-]"));
    let mut rates = Panel::new("transport about it", Axis::logarithmic("τ*/τ*_c [-]"), Axis::logarithmic("q* [-]"));
    let points: Vec<f64> = (0..=60).map(|k| 8.0 * libm::pow(25.0, f64::from(k) / 60.0)).collect();
    let expectation: Vec<(f64, f64)> = points.iter().map(|&size| (size, critical_shields_number(size))).collect();
    let thresholds = &*MOTION_THRESHOLDS;
    let measured = points.iter().filter_map(|&size| {
        let (lower, upper) = thresholds.band(size)?.bounds;
        Some((size, lower, upper))
    });
    curve.band("nine tenths of the thresholds", measured);
    let drawn = |point: &&(f64, f64)| point.0 > points[0] && point.0 < points[points.len() - 1] && point.1 < 0.3;
    let measured: Vec<(f64, f64)> = thresholds.points.iter().filter(drawn).copied().collect();
    let caption = format!(
        "Left: Shields number at which the transport reaches a rate, over the grain size D* = d ((s − 1) g/ν²)^⅓. The rates are \
         W* = q*/τ*^{{3/2}} = 0.002, q* = 10⁻⁴ and q* = 10⁻³, with q* the transport over √((s − 1) g d³). Points are {} of {} thresholds \
         measured in flumes; the others lie outside of the axes. The band holds nine tenths of the thresholds of grains within a factor of two in size. Dash-dotted is Shields' curve times and over {ONSET_SCATTER}. \
         Right: transport over the Shields number τ* over its value τ*_c on Shields' curve. Grains of a millimetre and less lie within \
         the viscous sublayer and creep: between W* = 0.002 and q* = 10⁻³ lies a factor of two.",
        measured.len(),
        thresholds.points.len()
    );
    curve.points("measured thresholds", MEASURED_SLOT, measured);
    curve.reference(ONSET_SOURCE, expectation.iter().copied());
    for factor in [ONSET_SCATTER, 1.0 / ONSET_SCATTER] {
        let label = format!("factor {ONSET_SCATTER} about it");
        curve.reference(&label, expectation.iter().map(|&(size, tau)| (size, factor * tau)));
    }
    for (slot, (criterion, name)) in CRITERIA.into_iter().enumerate() {
        let onsets = tables(records)
            .map(|(run, data)| (run.stream.dimensionless_diameter(), criterion.onset(&data.scan).value()))
            .filter(|(_, onset)| onset.is_finite());
        curve.series.push(Series::new(name, Mark::LinePoints, slot, onsets.collect()));
    }
    for (slot, (run, data)) in tables(records).enumerate() {
        let label = format!("{} mm", 1e3 * run.stream.grain_diameter);
        let expected = critical_shields_number(run.stream.dimensionless_diameter());
        let points = data.scan.iter().map(|&(tau, transport)| (tau / expected, transport)).collect();
        rates.series.push(Series::new(&label, Mark::LinePoints, slot, points));
    }
    (!rates.series.is_empty()).then(|| Figure::new("onset", &caption, vec![curve, rates]))
}
