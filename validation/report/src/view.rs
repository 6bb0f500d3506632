//! Data of the templates: nothing but text, made by `page` and `rows`.

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
    pub(super) const FAIL: Self = Self { class: "fail", symbol: "✗", word: "fails" };
    pub(super) const KNOWN: Self = Self { class: "known", symbol: "✗", word: "known failure" };
    pub(super) const DRIFT: Self = Self { class: "drift", symbol: "≠", word: "drifted" };
    pub(super) const PASS: Self = Self { class: "pass", symbol: "✓", word: "holds" };
    pub(super) const CANNOT_TELL: Self = Self { class: "known", symbol: "○", word: "cannot tell" };
    pub(super) const OBSERVED: Self = Self { class: "observed", symbol: "○", word: "observed" };
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
