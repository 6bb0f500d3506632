//! The onset of motion over the grain size, beside Shields' curve.
//!
//! A layer has no threshold but a transport that falls steeply, so the onset is where it falls below a rate. Three are
//! given: W* = q*/τ*^{3/2} = 0.002, the literature's own definition of a reference transport (Parker, Klingeman & McLean 1982),
//! q* = 10⁻⁴ and q* = 10⁻³. Which of them would count as motion is no literature's choice, and W* = 0.002 is some 10⁻⁵ of q*, within the
//! creep of a resting bed whose yield is regularised; from the first to the last lies a factor of two. So does between the methods by
//! which experimenters tell it: every criterion is judged by the band of the thresholds that they measured with grains of that size.

use super::BedLoad1dRecord;
use super::run::{BedLoad1dRun, LayerPurpose, ONE_STATE, ONE_STATE_REASON};
use crate::case::Run;
use crate::figure::{Axis, Band, Figure, Mark, Panel, Series};
use crate::metric::{Confidence, Limit, Metric, Origin, Quantity};
use crate::reference::{MOTION_THRESHOLDS, ONSET_SCATTER, ONSET_SOURCE, critical_shields_number, onset_confidence};

/// Colour of the measured thresholds, beyond those of the criteria.
const MEASURED_SLOT: usize = 6;

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

    /// Relative distance of the onset to that by a parabola for ln τ* over ln of the ratio, through the points beside the crossing and
    /// the next one `[-]`; NaN if there is none.
    fn bend(self, scan: &[(f64, f64)]) -> f64 {
        let points: Vec<(f64, f64)> =
            scan.iter().map(|&(tau, q)| (libm::log(self.ratio(tau, q)), libm::log(tau))).collect();
        let Some(place) = points.windows(2).position(|pair| pair[0].0 <= 0.0 && pair[1].0 > 0.0) else {
            return f64::NAN;
        };
        let third = if place + 2 < points.len() { place + 2 } else { place.wrapping_sub(1) };
        let (Some(&(x2, y2)), (x0, y0), (x1, y1)) = (points.get(third), points[place], points[place + 1]) else {
            return f64::NAN;
        };
        let (first, second) = ((y1 - y0) / (x1 - x0), (y2 - y1) / (x2 - x1));
        // what Newton's third term adds at a ratio of 1
        ((second - first) / (x2 - x0) * x0 * x1).abs()
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
pub(super) fn metrics(
    records: &[BedLoad1dRecord],
    [ratio, onset, over_measured]: [Quantity; 3],
    start: Quantity,
) -> Vec<Metric> {
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
            metrics.extend(beside_measured(over_measured.of(&variant, found), run, criterion.bend(scan)));
        }
        metrics.push(
            start
                .of(&run.variant(), difference)
                .against(Some(0.0), "the layers from rest, all Shields numbers", Confidence::Exact)
                .gated(Limit::AtMost(ONE_STATE), ONE_STATE_REASON)
                .with_snapshot_tolerance(1.0, 0.1 * ONE_STATE),
        );
    }
    metrics
}

/// An onset over the median of the thresholds measured with grains of its size; none where too few were.
fn beside_measured(metric: Metric, run: &BedLoad1dRun, bend: f64) -> Option<Metric> {
    let thresholds = &*MOTION_THRESHOLDS;
    let band = thresholds.band(run.stream.dimensionless_diameter())?;
    let (lower, upper) = band.bounds;
    let value = metric.value / band.median;
    let source = format!("median of {} measured thresholds, {}", band.number, thresholds.source);
    Some(
        Metric { value, ..metric }
            .against(Some(1.0), &source, thresholds.confidence)
            .known_to(
                Origin::Experiment,
                Some(band.deviation / band.median),
                "half of the width of the middle two thirds of the thresholds with grains within a factor of two in size",
            )
            .known_to(
                Origin::Numerical,
                Some(value * bend),
                "distance of the straight line in logarithms between two Shields numbers of the scan to the parabola through three",
            )
            .gated(
                Limit::Within(lower / band.median, upper / band.median),
                "nine tenths of the measured thresholds of grains within a factor of two in size lie there, whatever their authors took for                  motion",
            )
            .with_snapshot_tolerance(0.01, 0.0),
    )
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
    let thresholds = &*MOTION_THRESHOLDS;
    let measured = points.iter().filter_map(|&size| {
        let (lower, upper) = thresholds.band(size)?.bounds;
        Some((size, lower, upper))
    });
    curve.bands.push(Band { label: "nine tenths of the measured ones".to_owned(), points: measured.collect() });
    let drawn = |point: &&(f64, f64)| point.0 > points[0] && point.0 < points[points.len() - 1] && point.1 < 0.3;
    let measured = thresholds.points.iter().filter(drawn).copied().collect();
    curve.series.push(Series::new("measured thresholds", Mark::Points, MEASURED_SLOT, measured));
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
                  511 thresholds measured in flumes, of which nine tenths of those within a factor of two in size lie in the wider band; and the transport about it. Grains of a millimetre and less lie within \
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
        // a power law has no bend; of a bent one the parabola of a fine scan is the curve itself up to its third order
        assert!(OnsetCriterion::Transport(1e-4).bend(&scan) < 1e-12);
        assert!(OnsetCriterion::Transport(1.0).bend(&scan).is_nan());
        let bent =
            |tau: f64| (tau, 1e-4 * libm::exp(6.0 * libm::log(tau / 0.04) - 4.0 * libm::log(tau / 0.04).powi(2)));
        let scan = [0.037, 0.039, 0.041, 0.043].map(bent);
        let (own, bend) = (OnsetCriterion::Transport(1e-4).onset(&scan), OnsetCriterion::Transport(1e-4).bend(&scan));
        assert!(((own / 0.04 - 1.0).abs() / bend - 1.0).abs() < 0.3, "{own}, {bend}");
    }
}
