//! The onset of motion over the grain size, beside Shields' curve.
//!
//! A layer has no threshold but a transport that falls steeply, so the onset is where it falls below a rate. Three are
//! given: W* = q*/τ*^{3/2} = 0.002, the literature's own definition of a reference transport (Parker, Klingeman & McLean 1982),
//! q* = 10⁻⁴ and q* = 10⁻³. None is judged: W* = 0.002 is some 10⁻⁵ of q*, within the creep of a resting bed whose yield is regularised,
//! and which of the two others would count as motion is no literature's choice; between them lies a factor of two.

use super::BedLoad1dRecord;
use super::run::{BedLoad1dRun, LayerPurpose, ONE_STATE, ONE_STATE_REASON};
use crate::case::Run;
use crate::figure::{Axis, Band, Figure, Mark, Panel, Series};
use crate::metric::{Limit, Metric, Quantity};
use crate::reference::{ONSET_SCATTER, ONSET_SOURCE, critical_shields_number, onset_confidence};

/// A transport that counts as motion.
#[derive(Debug, Clone, Copy, PartialEq)]
enum OnsetCriterion {
    /// q* `[-]`.
    Transport(f64),
    /// W* = q*/τ*^{3/2} `[-]`.
    DimensionlessRate(f64),
}

const CRITERIA: [(OnsetCriterion, &str); 3] = [
    (OnsetCriterion::DimensionlessRate(0.002), "W=0.002"),
    (OnsetCriterion::Transport(1e-4), "q=1e-4"),
    (OnsetCriterion::Transport(1e-3), "q=1e-3"),
];

impl OnsetCriterion {
    /// Transport over that of the criterion `[-]`.
    fn ratio(self, shields_number: f64, transport: f64) -> f64 {
        match self {
            Self::Transport(rate) => transport / rate,
            Self::DimensionlessRate(rate) => transport / (rate * libm::pow(shields_number, 1.5)),
        }
    }

    /// Shields number at which a scanned transport crosses the criterion, straight in logarithms; NaN if it does not.
    fn onset(self, scan: &[(f64, f64)]) -> f64 {
        let logarithm = |&(tau, q): &(f64, f64)| (libm::log(tau), libm::log(self.ratio(tau, q)));
        let crossing = scan.windows(2).find_map(|pair| {
            let ((a, low), (b, high)) = (logarithm(&pair[0]), logarithm(&pair[1]));
            (low <= 0.0 && high > 0.0).then(|| libm::exp(a - low * (b - a) / (high - low)))
        });
        crossing.unwrap_or(f64::NAN)
    }
}

fn expected(run: &BedLoad1dRun) -> f64 {
    critical_shields_number(run.stream.dimensionless_diameter())
}

fn tables(records: &[BedLoad1dRecord]) -> impl Iterator<Item = (&BedLoad1dRun, &[(f64, f64)], f64)> {
    records
        .iter()
        .filter(|(run, _)| run.purpose == LayerPurpose::Onset)
        .map(|(run, record)| (run, record.data.scan.as_slice(), record.data.start_difference))
}

/// Onsets and how far the starts differ.
pub(super) fn metrics(records: &[BedLoad1dRecord], ratio: Quantity, onset: Quantity, start: Quantity) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (run, scan, difference) in tables(records) {
        for (criterion, name) in CRITERIA {
            let variant = run.variant().and("criterion", name);
            let found = criterion.onset(scan);
            metrics.push(
                ratio
                    .of(&variant, found / expected(run))
                    .against(Some(1.0), ONSET_SOURCE, onset_confidence())
                    .with_snapshot_tolerance(0.01, 0.0),
            );
            metrics.push(
                onset
                    .of(&variant, found)
                    .against(Some(expected(run)), ONSET_SOURCE, onset_confidence())
                    .with_snapshot_tolerance(0.01, 0.0),
            );
        }
        metrics.push(
            start
                .of(&run.variant(), difference)
                .against(Some(0.0), "the layers from rest, all Shields numbers", crate::metric::Confidence::Exact)
                .gated(Limit::AtMost(ONE_STATE), ONE_STATE_REASON)
                .with_snapshot_tolerance(1.0, 0.1 * ONE_STATE),
        );
    }
    metrics
}

/// Onset over the grain size, and the transport about it.
pub(super) fn figure(records: &[BedLoad1dRecord]) -> Option<Figure> {
    let mut curve = Panel::new("onset", Axis::logarithmic("D* [-]"), Axis::logarithmic("τ* at the onset [-]"));
    let mut rates = Panel::new("transport about it", Axis::logarithmic("τ*/τ*_c [-]"), Axis::logarithmic("q* [-]"));
    let points: Vec<f64> = (0..=60).map(|k| 8.0 * libm::pow(25.0, f64::from(k) / 60.0)).collect();
    let expectation: Vec<(f64, f64)> = points.iter().map(|&size| (size, critical_shields_number(size))).collect();
    curve.bands.push(Band {
        label: format!("factor {ONSET_SCATTER}"),
        points: expectation.iter().map(|&(size, tau)| (size, tau / ONSET_SCATTER, tau * ONSET_SCATTER)).collect(),
    });
    curve.series.push(Series::new(ONSET_SOURCE, Mark::Reference, 0, expectation));
    for (slot, (criterion, name)) in CRITERIA.into_iter().enumerate() {
        let onsets = tables(records).map(|(run, scan, _)| (run.stream.dimensionless_diameter(), criterion.onset(scan)));
        curve.series.push(Series::new(name, Mark::LinePoints, slot, onsets.collect()));
    }
    for (slot, (run, scan, _)) in tables(records).enumerate() {
        let label = format!("{} mm", 1e3 * run.stream.grain_diameter);
        let points = scan.iter().map(|&(tau, transport)| (tau / expected(run), transport)).collect();
        rates.series.push(Series::new(&label, Mark::LinePoints, slot, points));
    }
    (!rates.series.is_empty()).then(|| Figure {
        name: "onset".to_owned(),
        caption: "The Shields number at which the transport reaches a rate, over the grain size, beside Shields' curve and \
                  the scatter of its experiments; and the transport about it. Grains of a millimetre and less lie within \
                  the viscous sublayer and creep: between the first motion and q* = 10⁻³ lies a factor of two."
            .to_owned(),
        panels: vec![curve, rates],
        columns: 2,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_onset_of_a_power_law_is_exact() {
        let scan: Vec<(f64, f64)> =
            [0.02, 0.03, 0.05, 0.08].map(|tau: f64| (tau, 1e-4 * (tau / 0.04).powi(6))).to_vec();
        assert!((OnsetCriterion::Transport(1e-4).onset(&scan) / 0.04 - 1.0).abs() < 1e-12);
        // 1e-4 (τ/0.04)⁶ = 0.002 τ^{3/2}: τ^{4.5} = 20 · 0.04⁶
        let expected = (20.0_f64 * 0.04_f64.powi(6)).powf(1.0 / 4.5);
        assert!((OnsetCriterion::DimensionlessRate(0.002).onset(&scan) / expected - 1.0).abs() < 1e-12);
        assert!(OnsetCriterion::Transport(1.0).onset(&scan).is_nan());
    }
}
