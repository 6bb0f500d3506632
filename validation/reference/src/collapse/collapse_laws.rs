//! Published laws of run-out and final height of granular columns, which `laws.csv` of `reference-data/column-planar` and
//! `column-round` list. Lengths over the initial half width r_0, a = h_0/r_0.

use crate::evidence::{MeasuredData, read_shipped};
use crate::input::FieldError;
use crate::metric::Confidence;
use std::sync::LazyLock;

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
#[derive(Debug, Clone, PartialEq)]
pub struct CollapseLaw {
    /// Source of the law.
    pub source: String,
    /// Confidence in the law.
    pub confidence: Confidence,
    /// Branches in ascending order.
    pub branches: Vec<Branch>,
}

/// Source of a law by which columns are judged.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CollapseLawSource {
    /// Lube et al.: planar and round columns.
    Lube,
    /// Lagrée et al.: planar columns.
    Lagree,
    /// Lajeunesse et al.: planar columns.
    Lajeunesse,
}

impl CollapseLawSource {
    /// The author's law among those of one quantity.
    ///
    /// # Panics
    /// If there is none; the tables are part of the program, and a test looks up every author.
    pub fn law(self, laws: &[CollapseLaw]) -> &CollapseLaw {
        let name = match self {
            Self::Lube => "Lube",
            Self::Lagree => "Lagrée",
            Self::Lajeunesse => "Lajeunesse",
        };
        let found = laws.iter().find(|law| law.source.starts_with(name));
        found.unwrap_or_else(|| panic!("no law of columns by {name}"))
    }
}

/// The laws of one geometry.
#[derive(Debug, Clone, PartialEq)]
pub struct CollapseLaws {
    /// Run-out (r_∞ − r_0)/r_0.
    pub run_out: Vec<CollapseLaw>,
    /// Final height h_∞/r_0.
    pub height: Vec<CollapseLaw>,
}

/// Range in which the laws are drawn `[-]`.
pub const DRAWN: (f64, f64) = (0.4, 25.0);

/// Planar columns on a horizontal bed.
pub static PLANAR_COLLAPSE: LazyLock<CollapseLaws> =
    LazyLock::new(|| read_shipped("column-planar/laws.csv", CollapseLaws::read));

/// Round columns on a horizontal bed; no document at hand quotes their final height.
pub static ROUND_COLLAPSE: LazyLock<CollapseLaws> =
    LazyLock::new(|| read_shipped("column-round/laws.csv", CollapseLaws::read));

/// Duration of a collapse from release to rest over √(h_0/g) `[-]`, with its source and confidence.
pub static COLLAPSE_DURATION: LazyLock<(f64, String, Confidence)> = LazyLock::new(|| {
    read_shipped("column-planar/statements.csv", |table| {
        let value = table.number_of("statement", "duration", "value")?;
        Ok((value, table.metadata.source.clone(), table.metadata.confidence))
    })
});

impl CollapseLaws {
    /// The laws of a table: rows of one quantity and source are branches of one law.
    pub fn read(table: &MeasuredData) -> Result<Self, FieldError> {
        let (quantities, sources) = (table.labels("quantity")?, table.labels("source")?);
        let (confidences, to) = (table.confidences()?, table.upper_ends("to, or open")?);
        let (from, coefficients) = (table.numbers("from")?, table.numbers("coefficient")?);
        let exponents = table.numbers("exponent")?;
        let mut laws = Self { run_out: Vec::new(), height: Vec::new() };
        for (row, (quantity, source)) in quantities.iter().zip(sources).enumerate() {
            let laws = match quantity.as_str() {
                "run-out" => &mut laws.run_out,
                "final height" => &mut laws.height,
                other => return Err(table.bad_label("quantity", other, "run-out, final height")),
            };
            let branch =
                Branch { from: from[row], to: to[row], coefficient: coefficients[row], exponent: exponents[row] };
            match laws.iter_mut().find(|law| law.source == *source) {
                Some(law) => law.branches.push(branch),
                None => laws.push(CollapseLaw {
                    source: source.clone(),
                    confidence: confidences[row],
                    branches: vec![branch],
                }),
            }
        }
        Ok(laws)
    }
}

impl CollapseLaw {
    /// The law's value at an aspect ratio; none in its gaps.
    pub fn value(&self, aspect_ratio: f64) -> Option<f64> {
        let branch = self.branches.iter().find(|branch| aspect_ratio >= branch.from && aspect_ratio < branch.to)?;
        Some(branch.coefficient * libm::pow(aspect_ratio, branch.exponent))
    }

    /// The law's value at an aspect ratio in words, or the gap in which it has none.
    pub fn in_words(&self, aspect_ratio: f64) -> String {
        if let Some(value) = self.value(aspect_ratio) {
            return format!("{} {value:.2}", self.source);
        }
        let below = self.branches.iter().map(|branch| branch.to).filter(|&to| to <= aspect_ratio).fold(0.0, f64::max);
        let above = self.branches.iter().map(|branch| branch.from).filter(|&from| from > aspect_ratio);
        match above.fold(f64::INFINITY, f64::min) {
            above if above.is_finite() => format!("{} none from a = {below} to {above}", self.source),
            _ => format!("{} none beyond a = {below}", self.source),
        }
    }

    /// Points of its branches in the drawn range, branch by branch.
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
        let lube = CollapseLawSource::Lube.law(&PLANAR_COLLAPSE.run_out);
        assert_eq!(lube.value(1.0), Some(1.2));
        assert_eq!(lube.value(2.0), None);
        assert!((lube.value(8.0).unwrap() - 7.6).abs() < 1e-12);
        assert_eq!(lube.curves().len(), 2);
        assert_eq!(lube.in_words(1.0), "Lube et al. 2005, planar experiment 1.20");
        assert_eq!(lube.in_words(2.0), "Lube et al. 2005, planar experiment none from a = 1.8 to 2.8");
    }

    #[test]
    fn the_laws_stand_with_their_authors_and_all_branches() {
        let counts = |laws: &CollapseLaws| (laws.run_out.len(), laws.height.len());
        assert_eq!((counts(&PLANAR_COLLAPSE), counts(&ROUND_COLLAPSE)), ((5, 3), (1, 1)));
        let all = [&PLANAR_COLLAPSE.run_out, &PLANAR_COLLAPSE.height, &ROUND_COLLAPSE.run_out, &ROUND_COLLAPSE.height];
        for laws in all {
            assert!(CollapseLawSource::Lube.law(laws).source.starts_with("Lube"));
        }
        for laws in &all[..2] {
            assert_eq!(CollapseLawSource::Lagree.law(laws).source, "Lagrée et al. 2011, planar continuum μ(I)");
            assert_eq!(CollapseLawSource::Lajeunesse.law(laws).source, "Lajeunesse et al. 2005, planar channel");
        }
        assert_eq!(COLLAPSE_DURATION.0, 3.0);
        // thirds and sixths of the exponents, to the last bit
        assert_eq!(PLANAR_COLLAPSE.run_out[4].branches[1].exponent, 2.0 / 3.0);
        assert_eq!(PLANAR_COLLAPSE.height[2].branches[1].exponent, 1.0 / 3.0);
        assert_eq!(ROUND_COLLAPSE.height[0].branches[1].exponent, 1.0 / 6.0);
    }

    #[test]
    fn the_branches_of_a_law_meet_within_its_scatter() {
        let (planar, round) = (&*PLANAR_COLLAPSE, &*ROUND_COLLAPSE);
        for law in planar.run_out.iter().chain(&planar.height).chain(&round.run_out).chain(&round.height) {
            for pair in law.branches.windows(2).filter(|pair| pair[0].to == pair[1].from) {
                let at = |branch: &Branch| branch.coefficient * libm::pow(pair[0].to, branch.exponent);
                let ratio = at(&pair[0]) / at(&pair[1]);
                assert!((0.75..1.35).contains(&ratio), "{}: {ratio}", law.source);
            }
        }
    }
}
