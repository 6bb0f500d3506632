//! Uncertainty of a value and its reference: the parts of a gate's width, each with the sentence that it comes from.
//!
//! Parts are standard uncertainties of independent causes, so they add as squares. An unknown part is absent: the
//! sum is then that of what is known, and says of how much that is.

use serde::{Deserialize, Serialize};

/// Cause of an uncertainty.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Origin {
    /// Scatter of the experiment, as its authors give it.
    Experiment,
    /// Reading a figure.
    Digitisation,
    /// Spacing of the particles, from a study of the resolution.
    Numerical,
    /// Repetition with other seeds.
    Repeat,
    /// Inputs that are known within a range.
    Input,
}

impl Origin {
    /// Name for a reader.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Experiment => "experiment",
            Self::Digitisation => "digitisation",
            Self::Numerical => "spacing",
            Self::Repeat => "repetition",
            Self::Input => "input",
        }
    }
}

/// Part of a comparison's uncertainty, after ASME V&V 20.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum ComparisonPart {
    /// Spacing, time step and repetitions: u_num.
    Numerical,
    /// Inputs: u_input.
    Input,
    /// The reference: u_D.
    Reference,
}

impl ComparisonPart {
    /// All entries, in the order of a page.
    pub const ALL: [Self; 3] = [Self::Numerical, Self::Input, Self::Reference];

    /// The origins that belong to it.
    pub const fn origins(self) -> &'static [Origin] {
        match self {
            Self::Numerical => &[Origin::Numerical, Origin::Repeat],
            Self::Input => &[Origin::Input],
            Self::Reference => &[Origin::Experiment, Origin::Digitisation],
        }
    }

    /// Symbol of the part.
    pub const fn symbol(self) -> &'static str {
        match self {
            Self::Numerical => "u_num",
            Self::Input => "u_input",
            Self::Reference => "u_D",
        }
    }
}

/// One cause.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct UncertaintyComponent {
    /// Cause of the uncertainty.
    pub origin: Origin,
    /// Standard uncertainty, in the metric's unit.
    pub standard: f64,
    /// Source of the number, one sentence.
    pub source: String,
}

impl UncertaintyComponent {
    /// Name of the component: its source up to the first bracket.
    pub fn name(&self) -> &str {
        self.source.split(" (").next().unwrap_or(&self.source)
    }
}

/// All causes that are known.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Uncertainty {
    parts: Vec<UncertaintyComponent>,
}

impl Uncertainty {
    /// The parts in the order in which they were added.
    pub fn parts(&self) -> &[UncertaintyComponent] {
        &self.parts
    }

    /// Whether nothing is known.
    pub fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// Root of the sum of squares of all parts, in the metric's unit; none where nothing is known.
    pub fn standard(&self) -> Option<f64> {
        root_of_squares(self.parts.iter())
    }

    /// Root of the sum of squares of the parts with these origins, in the metric's unit.
    pub fn of(&self, origins: &[Origin]) -> Option<f64> {
        root_of_squares(self.parts.iter().filter(|part| origins.contains(&part.origin)))
    }

    /// Root of the sum of squares of the parts u_num, u_input or u_D of a comparison, in the metric's unit.
    pub fn of_part(&self, part: ComparisonPart) -> Option<f64> {
        self.of(part.origins())
    }

    /// The largest of what belongs to a part of a comparison, with its share of the sum of squares `[-]`; none where nothing is known or
    /// all is nothing.
    pub fn largest(&self, part: ComparisonPart) -> Option<(&UncertaintyComponent, f64)> {
        let all = self.of_part(part).filter(|all| *all > 0.0)?;
        let own = self.parts.iter().filter(|own| part.origins().contains(&own.origin));
        let largest = own.max_by(|one, other| one.standard.total_cmp(&other.standard))?;
        Some((largest, (largest.standard / all).powi(2)))
    }

    /// Removes everything that belongs to a part of a comparison.
    pub(crate) fn forget(&mut self, part: ComparisonPart) {
        self.parts.retain(|own| !part.origins().contains(&own.origin));
    }

    /// A part that is known to be negligible.
    pub(crate) fn add_none(&mut self, origin: Origin, source: &str) {
        self.parts.push(UncertaintyComponent { origin, standard: 0.0, source: source.to_owned() });
    }

    /// Adds a part; nothing where it is unknown or not positive.
    pub fn add(&mut self, origin: Origin, standard: Option<f64>, source: &str) {
        if let Some(standard) = standard.filter(|standard| standard.is_finite() && *standard > 0.0) {
            self.parts.push(UncertaintyComponent { origin, standard, source: source.to_owned() });
        }
    }
}

fn root_of_squares<'p>(parts: impl Iterator<Item = &'p UncertaintyComponent>) -> Option<f64> {
    let (sum, number) = parts.fold((0.0, 0), |(sum, number), part| (sum + part.standard * part.standard, number + 1));
    (number > 0).then(|| f64::sqrt(sum))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::{Metric, Variant};

    #[test]
    fn parts_add_as_squares_and_unknown_ones_not_at_all() {
        let metric = Metric::observed("run_out", &Variant::default(), 1.2, "-");
        assert_eq!(
            (metric.uncertainty.standard(), metric.uncertainty.of_part(ComparisonPart::Reference)),
            (None, None)
        );
        let metric = metric
            .known_to(Origin::Digitisation, Some(0.3), "other readings")
            .known_to(Origin::Experiment, None, "not given")
            .known_to(Origin::Numerical, Some(f64::NAN), "no study")
            .known_to(Origin::Repeat, Some(0.4), "five seeds");
        assert_eq!(metric.uncertainty.parts().len(), 2);
        assert!(metric.uncertainty.standard().is_some_and(|standard| (standard - 0.5).abs() < 1e-15));
        assert_eq!(metric.uncertainty.of_part(ComparisonPart::Reference), Some(0.3));
        assert_eq!(metric.uncertainty.largest(ComparisonPart::Input), None);
        let metric = metric.known_to(Origin::Input, Some(0.3), "a (a reason)").known_to(
            Origin::Input,
            Some(0.4),
            "b (a reason)",
        );
        let (largest, share) = metric.uncertainty.largest(ComparisonPart::Input).expect("two inputs");
        assert_eq!(largest.name(), "b");
        assert!((share - 0.64).abs() < 1e-12);
        let text = serde_json::to_string(&metric.uncertainty).expect("serialises");
        assert!(text.starts_with(r#"[{"origin":"digitisation","standard":0.3,"source":"other readings"}"#), "{text}");
    }
}
