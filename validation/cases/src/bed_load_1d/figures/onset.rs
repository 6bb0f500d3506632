//! The onset of motion over the grain size.

use super::super::BedLoad1dRecord;
use super::super::onset_criterion::CRITERIA;
use super::super::records::scans;
use crate::figure::{Axis, Figure, Mark, Panel, Series};
use crate::reference::bed_load::{
    MOTION_THRESHOLDS, ONSET_SCATTER, ONSET_SOURCE, critical_shields_number, thresholds_about,
};

/// Colour of the measured thresholds, beyond those of the criteria.
const MEASURED_SLOT: usize = 6;

/// Onset over the grain size, and the transport about it.
pub(super) fn figure(records: &[BedLoad1dRecord]) -> Option<Figure> {
    let mut curve = Panel::new("onset", Axis::logarithmic("D* [-]"), Axis::logarithmic("τ* at the onset [-]"));
    let mut rates = Panel::new("transport at onset", Axis::logarithmic("τ*/τ*_c [-]"), Axis::logarithmic("q* [-]"));
    let points: Vec<f64> = (0..=60).map(|k| 8.0 * libm::pow(25.0, f64::from(k) / 60.0)).collect();
    let expectation: Vec<(f64, f64)> = points.iter().map(|&size| (size, critical_shields_number(size))).collect();
    let thresholds = &*MOTION_THRESHOLDS;
    let measured = points.iter().filter_map(|&size| {
        let (lower, upper) = thresholds_about(size)?.bounds;
        Some((size, lower, upper))
    });
    curve.band("90 % of the thresholds", measured);
    let drawn = |point: &&(f64, f64)| point.0 > points[0] && point.0 < points[points.len() - 1] && point.1 < 0.3;
    let measured: Vec<(f64, f64)> = thresholds.points.iter().filter(drawn).copied().collect();
    let caption = format!(
        "Left: Shields number at the onset by each criterion over D* = d ((s − 1) g/ν²)^⅓, with {} of {} measured \
         thresholds, their 90 % band and Shields' curve. Right: transport over τ* relative to this curve.",
        measured.len(),
        thresholds.points.len()
    );
    curve.points("measured thresholds", MEASURED_SLOT, measured);
    curve.reference(ONSET_SOURCE, expectation.iter().copied());
    for factor in [ONSET_SCATTER, 1.0 / ONSET_SCATTER] {
        let label = format!("factor {ONSET_SCATTER} about this curve");
        curve.reference(&label, expectation.iter().map(|&(size, tau)| (size, factor * tau)));
    }
    for (slot, (criterion, name)) in CRITERIA.into_iter().enumerate() {
        let onsets = scans(records)
            .map(|(run, data)| (run.stream().dimensionless_diameter(), criterion.onset(&data.scan).value()))
            .filter(|(_, onset)| onset.is_finite());
        curve.series.push(Series::new(name, Mark::LinePoints, slot, onsets.collect()));
    }
    for (slot, (run, data)) in scans(records).enumerate() {
        let label = format!("{} mm", 1e3 * run.grain_diameter);
        let expected = critical_shields_number(run.stream().dimensionless_diameter());
        let points = data.scan.iter().map(|&(tau, transport)| (tau / expected, transport)).collect();
        rates.series.push(Series::new(&label, Mark::LinePoints, slot, points));
    }
    (!rates.series.is_empty()).then(|| Figure::new("onset", &caption, vec![curve, rates]))
}
