//! Published laws of run-out and final height of granular columns, as `reference-data/column-planar/laws.csv` lists
//! them. Lengths over the initial half width r_0, a = h_0/r_0.

use crate::metric::Confidence;

/// c a^n over a range of aspect ratios.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Branch {
    /// Smallest aspect ratio `[-]`.
    pub from: f64,
    /// Largest aspect ratio `[-]`.
    pub to: f64,
    /// Coefficient `[-]`.
    pub coefficient: f64,
    /// Exponent `[-]`.
    pub exponent: f64,
}

/// A law in branches, with gaps where its source gives none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CollapseLaw {
    /// Where it comes from.
    pub source: &'static str,
    /// How sure the project is of it.
    pub confidence: Confidence,
    /// Its branches in ascending order.
    pub branches: &'static [Branch],
}

/// Range in which the laws are drawn `[-]`.
pub const DRAWN: (f64, f64) = (0.4, 25.0);

const fn branch(from: f64, to: f64, coefficient: f64, exponent: f64) -> Branch {
    Branch { from, to, coefficient, exponent }
}

/// Run-out (r_∞ − r_0)/r_0 of planar columns on a horizontal bed.
pub const PLANAR_RUN_OUT: [CollapseLaw; 5] = [
    CollapseLaw {
        source: "Lube et al. 2005, planar experiment",
        confidence: Confidence::High,
        branches: &[branch(0.0, 1.8, 1.2, 1.0), branch(2.8, f64::INFINITY, 1.9, 2.0 / 3.0)],
    },
    CollapseLaw {
        source: "Lagrée et al. 2011, planar continuum μ(I)",
        confidence: Confidence::Medium,
        branches: &[branch(0.0, 7.0, 2.2, 1.0), branch(7.0, f64::INFINITY, 3.9, 0.7)],
    },
    CollapseLaw {
        source: "Lajeunesse et al. 2005, planar channel",
        confidence: Confidence::Medium,
        branches: &[branch(0.0, 3.0, 1.8, 1.0), branch(3.0, f64::INFINITY, 2.3, 2.0 / 3.0)],
    },
    CollapseLaw {
        source: "Bougouin & Lacaze 2018, planar experiment",
        confidence: Confidence::Medium,
        branches: &[branch(0.0, 2.0, 2.7, 1.0), branch(2.0, f64::INFINITY, 3.7, 0.64)],
    },
    CollapseLaw {
        source: "Kumar 2015, planar DEM",
        confidence: Confidence::High,
        branches: &[branch(0.0, 2.7, 1.67, 1.0), branch(2.7, f64::INFINITY, 2.7, 2.0 / 3.0)],
    },
];

/// Final height h_∞/r_0 of planar columns.
pub const PLANAR_HEIGHT: [CollapseLaw; 3] = [
    CollapseLaw {
        source: "Lube et al. 2005, planar experiment",
        confidence: Confidence::High,
        branches: &[branch(0.0, 1.15, 1.0, 1.0), branch(1.15, f64::INFINITY, 1.0, 0.4)],
    },
    CollapseLaw {
        source: "Lagrée et al. 2011, planar continuum μ(I)",
        confidence: Confidence::Medium,
        branches: &[branch(1.0, f64::INFINITY, 0.65, 0.35)],
    },
    CollapseLaw {
        source: "Lajeunesse et al. 2005, planar channel",
        confidence: Confidence::Medium,
        branches: &[branch(0.0, 0.7, 1.0, 1.0), branch(0.7, f64::INFINITY, 1.0, 1.0 / 3.0)],
    },
];

/// Run-out of round columns.
pub const ROUND_RUN_OUT: [CollapseLaw; 2] = [
    CollapseLaw {
        source: "Lube et al. 2004, round experiment",
        confidence: Confidence::High,
        branches: &[branch(0.0, 1.7, 1.24, 1.0), branch(1.7, f64::INFINITY, 1.6, 0.5)],
    },
    CollapseLaw {
        source: "Lajeunesse et al. 2004, round experiment (unverified)",
        confidence: Confidence::Unverified,
        branches: &[branch(0.74, f64::INFINITY, 2.0, 0.5)],
    },
];

/// Final height of round columns; no document at hand quotes it.
pub const ROUND_HEIGHT: [CollapseLaw; 1] = [CollapseLaw {
    source: "Lube et al. 2004, round experiment (unverified)",
    confidence: Confidence::Unverified,
    branches: &[branch(0.0, 1.0, 1.0, 1.0), branch(1.0, f64::INFINITY, 0.88, 1.0 / 6.0)],
}];

impl CollapseLaw {
    /// The law's value at an aspect ratio; none in its gaps.
    #[must_use]
    pub fn value(&self, aspect_ratio: f64) -> Option<f64> {
        let branch = self.branches.iter().find(|branch| aspect_ratio >= branch.from && aspect_ratio < branch.to)?;
        Some(branch.coefficient * libm::pow(aspect_ratio, branch.exponent))
    }

    /// Points of its branches in the drawn range, branch by branch.
    #[must_use]
    pub fn curves(&self) -> Vec<Vec<(f64, f64)>> {
        let curve = |branch: &Branch| {
            let (from, to) = (branch.from.max(DRAWN.0), branch.to.min(DRAWN.1));
            let point = |k: i32| from * libm::pow(to / from, f64::from(k) / 40.0);
            (0..=40).map(point).map(|a| (a, branch.coefficient * libm::pow(a, branch.exponent))).collect()
        };
        self.branches.iter().map(curve).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lube_has_a_gap_between_his_branches() {
        let lube = PLANAR_RUN_OUT[0];
        assert_eq!(lube.value(1.0), Some(1.2));
        assert_eq!(lube.value(2.0), None);
        assert!((lube.value(8.0).unwrap() - 7.6).abs() < 1e-12);
        assert_eq!(lube.curves().len(), 2);
    }

    #[test]
    fn the_branches_of_a_law_meet_within_its_scatter() {
        for law in PLANAR_RUN_OUT.iter().chain(&PLANAR_HEIGHT).chain(&ROUND_RUN_OUT).chain(&ROUND_HEIGHT) {
            for pair in law.branches.windows(2).filter(|pair| pair[0].to == pair[1].from) {
                let at = |branch: &Branch| branch.coefficient * libm::pow(pair[0].to, branch.exponent);
                let ratio = at(&pair[0]) / at(&pair[1]);
                assert!((0.75..1.35).contains(&ratio), "{}: {ratio}", law.source);
            }
        }
    }
}
