//! What the template sees: nothing but text, made by `page` and `rows`.

use super::DrawnFigure;
use crate::metric::Variant;
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
    pub(super) const OBSERVED: Self = Self { class: "observed", symbol: "○", word: "observed" };
}

/// What a link to a metric's row names: letters, digits, points and dashes.
pub(super) fn anchor(case: &str, metric: &str, variant: &Variant) -> String {
    let plain = |c: char| if c.is_ascii_alphanumeric() || c == '.' || c == '-' || c == '_' { c } else { '-' };
    format!("metric-{case}-{metric}-{}", variant.file_name()).chars().map(plain).collect()
}

/// The command as typed in a checkout, where the program is not installed.
pub(super) fn typed(command: &str) -> String {
    command.strip_prefix("bagnold ").map_or_else(|| command.to_owned(), |rest| format!("cargo run -- {rest}"))
}

/// A metric in the table of all cases.
#[derive(Debug, Serialize)]
pub(super) struct GateRow {
    pub(super) case: String,
    pub(super) row: MetricView,
}

#[derive(Debug, Serialize)]
pub(super) struct BannerItem {
    pub(super) mark: VerdictMark,
    pub(super) case: String,
    /// Where it stands on the case's page.
    pub(super) anchor: String,
    /// The case in words.
    pub(super) title: String,
    /// The quantity in words.
    pub(super) what: String,
    /// Its name; empty where no metric is meant.
    pub(super) metric: String,
    pub(super) variant: String,
    pub(super) statement: String,
    /// Distance from the reference in words.
    pub(super) off: String,
    /// What the list of known failures says, without its reason.
    pub(super) note: String,
}

#[derive(Debug, Serialize)]
pub(super) struct MetricView {
    /// What a link to the row names.
    pub(super) anchor: String,
    pub(super) mark: VerdictMark,
    /// What is known of the uncertainty, over the width of the gate.
    pub(super) width: Option<super::width::Width>,
    pub(super) metric: String,
    pub(super) variant: Vec<String>,
    pub(super) value: String,
    /// Where the true value lies, and in what the flow is unlike those that were measured.
    pub(super) prediction: Option<serde_json::Value>,
    pub(super) reference: String,
    /// How far the value is from the reference.
    pub(super) residual: String,
    pub(super) source: String,
    pub(super) confidence: &'static str,
    pub(super) kind: &'static str,
    pub(super) limit: String,
    pub(super) reason: String,
    /// The reason stands in the row above already.
    pub(super) reason_repeats: bool,
    /// The source stands in the row above already.
    pub(super) source_repeats: bool,
    pub(super) margin: String,
    pub(super) relative_margin: String,
    /// The margin's share of the limit as a number to sort by, empty if there is none.
    pub(super) margin_key: String,
    /// The change in tolerances as a number to sort by, empty if there is none.
    pub(super) change_key: String,
    /// The figure of the case that shows it best, or nothing.
    pub(super) figure: String,
    pub(super) drift: VerdictMark,
    pub(super) change: String,
    pub(super) relative_change: String,
    pub(super) note: String,
    /// Controls that it rejects, in a few words.
    pub(super) power: String,
}

#[derive(Debug, Clone, Serialize)]
pub(super) struct FigureView {
    pub(super) name: String,
    pub(super) caption: String,
    /// A GIF, instead of an SVG with a PNG.
    pub(super) moves: bool,
    /// Width and height `[px]`, so that the page does not move when the picture comes.
    pub(super) size: Option<(u32, u32)>,
    pub(super) failure: Option<String>,
}

/// A drawn figure as a page refers to it.
pub(super) fn picture(drawn: &DrawnFigure) -> FigureView {
    FigureView {
        name: drawn.name.clone(),
        caption: drawn.caption.clone(),
        moves: drawn.moves,
        size: drawn.size,
        failure: drawn.failure.clone(),
    }
}
