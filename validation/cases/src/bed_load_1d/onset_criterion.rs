//! What counts as motion at an onset, and where a scan of Shields numbers crosses it.

/// A transport that counts as motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum OnsetCriterion {
    /// q* `[-]`.
    Transport(f64),
    /// W* = q*/τ*^{3/2} `[-]`.
    DimensionlessRate(f64),
}

/// The criteria with their names in variants.
pub(super) const CRITERIA: [(OnsetCriterion, &str); 3] = [
    (OnsetCriterion::DimensionlessRate(0.002), "W=0.002"),
    (OnsetCriterion::Transport(1e-4), "q=1e-4"),
    (OnsetCriterion::Transport(1e-3), "q=1e-3"),
];

/// Shields number of an onset `[-]`, or a bound of it where the scan does not reach it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Crossing {
    /// Found.
    At(f64),
    /// The least of the scan carries more: a bed whose yield is regularised creeps by more than the criterion asks for.
    Below(f64),
    /// The largest of the scan carries less.
    Above(f64),
}

impl Crossing {
    /// The Shields number `[-]`; NaN where only a bound is known, which no gate takes for a value.
    pub(super) fn value(self) -> f64 {
        match self {
            Self::At(shields_number) => shields_number,
            Self::Below(_) | Self::Above(_) => f64::NAN,
        }
    }

    /// What follows a source where only a bound is known.
    pub(super) fn remark(self) -> String {
        match self {
            Self::At(_) => String::new(),
            Self::Below(lowest) => format!(
                "; not reached: it is below {lowest:.4}, the least Shields number that was tried, at which the bed creeps by more than \
                 the criterion: take a smaller `closures.regularisation_rate`"
            ),
            Self::Above(highest) => {
                format!("; not reached: it is above {highest:.4}, the largest Shields number that was tried")
            }
        }
    }
}

impl OnsetCriterion {
    /// Transport over that of the criterion `[-]`.
    fn ratio(self, shields_number: f64, transport: f64) -> f64 {
        match self {
            Self::Transport(rate) => transport / rate,
            Self::DimensionlessRate(rate) => transport / (rate * libm::pow(shields_number, 1.5)),
        }
    }

    /// Where a scanned transport crosses the criterion, straight in logarithms.
    pub(super) fn onset(self, scan: &[(f64, f64)]) -> Crossing {
        let logarithm = |&(tau, q): &(f64, f64)| (libm::log(tau), libm::log(self.ratio(tau, q)));
        let crossing = scan.windows(2).find_map(|pair| {
            let ((a, low), (b, high)) = (logarithm(&pair[0]), logarithm(&pair[1]));
            (low <= 0.0 && high > 0.0).then(|| libm::exp(a - low * (b - a) / (high - low)))
        });
        match (crossing, scan) {
            (Some(shields_number), _) => Crossing::At(shields_number),
            (None, [(lowest, transport), ..]) if self.ratio(*lowest, *transport) > 1.0 => Crossing::Below(*lowest),
            (None, [.., (highest, _)]) => Crossing::Above(*highest),
            (None, []) => Crossing::Above(f64::NAN),
        }
    }

    /// Relative distance of the onset to that by a parabola for ln τ* over ln of the ratio, through the points beside the crossing and
    /// the next one `[-]`; NaN if there is none.
    pub(super) fn bend(self, scan: &[(f64, f64)]) -> f64 {
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

/// Whether a Shields number and its transport count as motion by any of the criteria.
pub(super) fn moves_by_some_criterion((shields_number, transport): (f64, f64)) -> bool {
    CRITERIA.iter().any(|(criterion, _)| criterion.ratio(shields_number, transport) > 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_onset_of_a_power_law_is_exact() {
        let scan: Vec<(f64, f64)> =
            [0.02, 0.03, 0.05, 0.08].map(|tau: f64| (tau, 1e-4 * (tau / 0.04).powi(6))).to_vec();
        assert!((OnsetCriterion::Transport(1e-4).onset(&scan).value() / 0.04 - 1.0).abs() < 1e-12);
        // 1e-4 (τ/0.04)⁶ = 0.002 τ^{3/2}: τ^{4.5} = 20 · 0.04⁶
        let expected = (20.0_f64 * 0.04_f64.powi(6)).powf(1.0 / 4.5);
        assert!((OnsetCriterion::DimensionlessRate(0.002).onset(&scan).value() / expected - 1.0).abs() < 1e-12);
        assert_eq!(OnsetCriterion::Transport(1.0).onset(&scan), Crossing::Above(0.08));
        let below = OnsetCriterion::Transport(1e-7).onset(&scan);
        assert_eq!(below, Crossing::Below(0.02));
        assert!(below.value().is_nan() && below.remark().contains("below 0.0200"), "{}", below.remark());
        // a power law has no bend; of a bent one the parabola of a fine scan is the curve itself up to its third order
        assert!(OnsetCriterion::Transport(1e-4).bend(&scan) < 1e-12);
        assert!(OnsetCriterion::Transport(1.0).bend(&scan).is_nan());
        let bent =
            |tau: f64| (tau, 1e-4 * libm::exp(6.0 * libm::log(tau / 0.04) - 4.0 * libm::log(tau / 0.04).powi(2)));
        let scan = [0.037, 0.039, 0.041, 0.043].map(bent);
        let (own, bend) =
            (OnsetCriterion::Transport(1e-4).onset(&scan).value(), OnsetCriterion::Transport(1e-4).bend(&scan));
        assert!(((own / 0.04 - 1.0).abs() / bend - 1.0).abs() < 0.3, "{own}, {bend}");
    }
}
