//! Data of the templates: nothing but text, made by `page` and `rows`.

use super::judgement::{JudgedCase, Rank, Severity};
use crate::metric::Variant;
use crate::store::provenance::workspace;
use serde::Serialize;

/// A verdict in colour, symbol and word, so that none of them is needed alone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub(super) struct VerdictMark {
    /// Class of the style sheet.
    pub(super) class: &'static str,
    pub(super) symbol: &'static str,
    pub(super) word: &'static str,
}

impl VerdictMark {
    pub(super) const FAIL: Self = Self { class: "fail", symbol: "✗", word: Severity::NewFailure.word() };
    pub(super) const NOT_JUDGED: Self = Self { class: "fail", symbol: "–", word: Severity::NotJudged.word() };
    pub(super) const UNEXPECTED: Self = Self { class: "fail", symbol: "!", word: Severity::UnexpectedPass.word() };
    pub(super) const EXPECTED: Self = Self { class: "expected", symbol: "△", word: Severity::ExpectedFailure.word() };
    pub(super) const INCONCLUSIVE: Self =
        Self { class: "inconclusive", symbol: "○", word: Severity::Inconclusive.word() };
    pub(super) const PASS: Self = Self { class: "pass", symbol: "✓", word: Severity::Pass.word() };
    pub(super) const MOVED: Self = Self { class: "moved", symbol: "≠", word: "moved" };
    pub(super) const OBSERVED: Self = Self { class: "observed", symbol: "·", word: "observed" };

    /// The mark of a gate; of a metric without one it is observed.
    pub(super) fn of(severity: Option<Severity>) -> Self {
        match severity {
            Some(Severity::NewFailure) => Self::FAIL,
            Some(Severity::NotJudged) => Self::NOT_JUDGED,
            Some(Severity::UnexpectedPass) => Self::UNEXPECTED,
            Some(Severity::ExpectedFailure) => Self::EXPECTED,
            Some(Severity::Inconclusive) => Self::INCONCLUSIVE,
            Some(Severity::Pass) => Self::PASS,
            None => Self::OBSERVED,
        }
    }

    /// The mark of a case: its worst gate, or that a value moved.
    pub(super) fn of_case(judged: &JudgedCase<'_>) -> Self {
        match judged.rank() {
            Rank::Failing(severity) => Self::of(Some(severity)),
            Rank::Moved => Self::MOVED,
            Rank::Within | Rank::Observed => Self::of(judged.tally().0.into_iter().min()),
        }
    }
}

/// The words of a name with underscores: `after_0_66_s` is "after 0.66 s".
pub(super) fn words(name: &str) -> String {
    let is_number = |word: &str| word.bytes().all(|byte| byte.is_ascii_digit());
    let join = |text: String, word: &str| {
        let is_decimal = is_number(word) && text.rsplit(' ').next().is_some_and(is_number);
        format!("{text}{}{word}", if is_decimal { '.' } else { ' ' })
    };
    name.split('_').map(str::to_owned).reduce(|text, word| join(text, &word)).unwrap_or_default()
}

/// Link target of a metric's row: letters, digits, points and dashes.
pub(super) fn anchor(case: &str, metric: &str, variant: &Variant) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '.' || c == '-' || c == '_' { c } else { '-' };
    format!("metric-{case}-{metric}-{}", variant.file_name()).chars().map(plain).collect()
}

/// The command as typed: in a checkout by cargo, elsewhere as that of the installed program.
pub(super) fn typed(command: &str) -> String {
    if workspace().is_none() {
        return command.to_owned();
    }
    command.strip_prefix("bagnold ").map_or_else(|| command.to_owned(), |rest| format!("cargo run -- {rest}"))
}
