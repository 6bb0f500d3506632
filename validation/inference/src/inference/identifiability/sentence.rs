//! Findings in sentences.

use super::{FindingKind, ParameterLabel};
use bagnold_number::short_digits;

/// Writes numbers of the unit cube as a physicist reads them.
pub(super) struct SentenceWriter<'a> {
    pub(super) parameters: &'a [ParameterLabel],
    pub(super) physical: &'a dyn Fn(usize, f64) -> f64,
}

impl SentenceWriter<'_> {
    fn name(&self, k: usize) -> String {
        self.parameters.get(k).map_or_else(|| format!("parameter {k}"), |parameter| format!("`{}`", parameter.name))
    }

    fn value(&self, k: usize, u: f64) -> String {
        short_digits((self.physical)(k, u), 3)
    }

    /// The unit after a number.
    fn unit(&self, k: usize) -> String {
        match self.parameters.get(k).map_or("", |parameter| parameter.unit.as_str()) {
            "" | "-" => String::new(),
            unit => format!(" {unit}"),
        }
    }

    /// "0.71 `a` − 0.71 `b`".
    fn combination(&self, direction: &[f64]) -> String {
        let mut text = String::new();
        for (k, share) in direction.iter().enumerate().filter(|(_, share)| **share != 0.0) {
            let sign = match (text.is_empty(), *share < 0.0) {
                (true, true) => "−",
                (true, false) => "",
                (false, true) => " − ",
                (false, false) => " + ",
            };
            text += &format!("{sign}{} {}", short_digits(share.abs(), 2), self.name(k));
        }
        text
    }

    /// "`a` = 0.7 Pa·s, `b` = 2 m" at a step along a direction.
    fn place(&self, minimum: &[f64], direction: &[f64], step: f64) -> String {
        let members = (0..direction.len()).filter(|k| direction[*k] != 0.0);
        let one = |k: usize| {
            let value = self.value(k, (minimum[k] + step * direction[k]).clamp(0.0, 1.0));
            format!("{} = {value}{}", self.name(k), self.unit(k))
        };
        members.map(one).collect::<Vec<_>>().join(", ")
    }

    /// The sentence that tells a finding about a minimum.
    pub(super) fn sentence(&self, kind: &FindingKind, minimum: &[f64]) -> String {
        match kind {
            FindingKind::FewData { data, parameters } => format!(
                "there are fewer data ({data}) than parameters ({parameters}), so not all parameters can be \
                 determined; fix some or add data"
            ),
            FindingKind::RankDeficient { rank, parameters } => format!(
                "near the best point the data depend on only {rank} independent combination{} of the {parameters} \
                 parameters; fix some or add data of another kind",
                if *rank == 1 { "" } else { "s" }
            ),
            FindingKind::NotDetermined { parameter, intervals, open } => {
                let (name, unit) = (self.name(*parameter), self.unit(*parameter));
                let (lower, upper, what) = match open {
                    [true, false] => ("its lower bound ", "", format!("bound {name} from below")),
                    [false, true] => ("", "its upper bound ", format!("bound {name} from above")),
                    _ => ("", "", format!("determine {name}")),
                };
                let part = |(place, part): (usize, &[f64; 2])| {
                    let [from, to] = part.map(|u| self.value(*parameter, u));
                    let lower = if place == 0 { lower } else { "" };
                    let upper = if place + 1 == intervals.len() { upper } else { "" };
                    format!("from {lower}{from} to {upper}{to}{unit}")
                };
                let parts: Vec<String> = intervals.iter().enumerate().map(part).collect();
                format!(
                    "the data do not {what}: any value {} fits them as well as the best, at 95 %",
                    parts.join(" or ")
                )
            }
            FindingKind::AtBound { parameter, upper } => format!(
                "the best {} lies at its {} bound {}{}: values beyond may agree still better, so widen the range if \
                 physics allows",
                self.name(*parameter),
                if *upper { "upper" } else { "lower" },
                self.value(*parameter, if *upper { 1.0 } else { 0.0 }),
                self.unit(*parameter)
            ),
            FindingKind::Correlated { pair: [first, second], correlation } => format!(
                "the data determine {} and {} only together (correlation {}): a larger value of one is made up for \
                 by a {} value of the other",
                self.name(*first),
                self.name(*second),
                short_digits(*correlation, 3),
                if *correlation > 0.0 { "larger" } else { "smaller" }
            ),
            FindingKind::WeakDirection { free, fixed, within: [back, step], .. } => format!(
                "near the best point the data fix {} (each as a share of its range) but hardly {}: any point on the \
                 line from {} to {} fits them as well as the best, at 95 %",
                self.combination(fixed),
                self.combination(free),
                self.place(minimum, free, -back),
                self.place(minimum, free, *step)
            ),
        }
    }
}
