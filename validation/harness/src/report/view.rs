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

/// A case in the list of cases.
#[derive(Debug, Serialize)]
pub(super) struct CaseLine {
    pub(super) picture: Option<FigureView>,
    pub(super) mark: VerdictMark,
    pub(super) name: String,
    pub(super) summary: String,
    pub(super) statement: String,
    pub(super) least_margin: String,
}

/// A metric in the table of all cases.
#[derive(Debug, Serialize)]
pub(super) struct GateRow {
    pub(super) case: String,
    pub(super) row: MetricView,
}

/// The page of a case.
#[derive(Debug, Serialize)]
pub(super) struct CasePage {
    pub(super) title: String,
    pub(super) tier: &'static str,
    pub(super) case: CaseView,
    /// Whether there is a baseline to have moved from.
    pub(super) compared: bool,
    /// The report that the page belongs to, if it does.
    pub(super) report: Option<Neighbours>,
    pub(super) provenance: Vec<(&'static str, String)>,
    pub(super) script: &'static str,
}

/// What a case's page leads to in its report.
#[derive(Debug, Serialize)]
pub(super) struct Neighbours {
    pub(super) has_papers: bool,
    pub(super) previous: Option<String>,
    pub(super) next: Option<String>,
}

#[derive(Debug, Serialize)]
pub(super) struct Banner {
    pub(super) mark: VerdictMark,
    pub(super) headline: String,
    pub(super) detail: String,
    pub(super) items: Vec<BannerItem>,
    /// Number of those, from the first, that are named as the weakest results.
    pub(super) weakest: Vec<usize>,
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

/// One of the separate verdicts.
#[derive(Debug, Serialize)]
pub(super) struct VerdictCount {
    pub(super) mark: VerdictMark,
    pub(super) name: &'static str,
    pub(super) meaning: &'static str,
    pub(super) statement: String,
    pub(super) detail: String,
    /// Page that has more of it.
    pub(super) link: Option<&'static str>,
}

#[derive(Debug, Serialize)]
pub(super) struct CaseView {
    pub(super) name: String,
    pub(super) summary: String,
    pub(super) description: Vec<String>,
    pub(super) mark: VerdictMark,
    pub(super) statement: String,
    /// What fails, in short.
    pub(super) failures: Vec<BannerItem>,
    pub(super) groups: Vec<MetricGroup>,
    pub(super) vanished: Vec<String>,
    /// Gates that are no longer judged, and why.
    pub(super) not_judged: Vec<String>,
    /// Its gates and controls.
    pub(super) controls: Option<ControlsView>,
    pub(super) figures: Vec<FigureView>,
    /// Tables of reference data that are written beside the page.
    pub(super) tables: Vec<&'static str>,
    pub(super) parameters: String,
    pub(super) command: String,
    pub(super) runs: Vec<RunView>,
}

/// Rows that stand in one table.
#[derive(Debug, Serialize)]
pub(super) struct MetricGroup {
    /// What the table's id ends in.
    pub(super) name: &'static str,
    pub(super) title: &'static str,
    /// Whether the page shows the table unfolded.
    pub(super) is_open: bool,
    pub(super) rows: Vec<MetricView>,
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
    pub(super) prediction: Option<PredictionView>,
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

/// The controls of a case and what its gates say of them.
#[derive(Debug, Serialize)]
pub(super) struct ControlsView {
    pub(super) controls: Vec<ControlView>,
    pub(super) rows: Vec<ControlRow>,
    /// Parameters whose errors were tried in several sizes.
    pub(super) series: Vec<SeriesView>,
    /// Gates that were tried with these.
    pub(super) sizes: Vec<SizeRow>,
}

/// A parameter whose errors were tried in several sizes.
#[derive(Debug, Serialize)]
pub(super) struct SeriesView {
    pub(super) name: &'static str,
    pub(super) parameter: &'static str,
    /// Its factors, from the smallest error to the largest.
    pub(super) factors: String,
}

/// The smallest error of each series that a gate rejects.
#[derive(Debug, Serialize)]
pub(super) struct SizeRow {
    pub(super) metric: String,
    pub(super) variant: String,
    /// Class and words; both empty where the gate was not tried.
    pub(super) cells: Vec<(&'static str, String)>,
}

#[derive(Debug, Serialize)]
pub(super) struct ControlView {
    pub(super) name: String,
    pub(super) error: String,
    pub(super) command: String,
    /// Whether it is an error of the solver.
    pub(super) is_solver: bool,
    /// When it was tried, or why it shows nothing.
    pub(super) note: String,
    /// Metrics that are meant to feel it and accept it, and why.
    pub(super) cannot_tell: Vec<(String, String)>,
}

/// A gate before each control.
#[derive(Debug, Serialize)]
pub(super) struct ControlRow {
    pub(super) metric: String,
    pub(super) variant: String,
    pub(super) cells: Vec<ControlCell>,
}

#[derive(Debug, Serialize)]
pub(super) struct ControlCell {
    pub(super) class: &'static str,
    pub(super) symbol: &'static str,
    /// Empty where the control's runs do not measure the gate.
    pub(super) word: &'static str,
    /// Whether the gate is meant to feel the error.
    pub(super) is_named: bool,
}

#[derive(Debug, Serialize)]
pub(super) struct PredictionView {
    pub(super) interval: String,
    pub(super) warnings: Vec<String>,
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

#[derive(Debug, Serialize)]
pub(super) struct RunView {
    pub(super) variant: String,
    pub(super) mark: VerdictMark,
    pub(super) outcome: String,
    pub(super) particles: String,
    pub(super) steps: String,
    pub(super) simulated_time: String,
    pub(super) wall_seconds: String,
    pub(super) threads: usize,
    pub(super) pace: String,
    pub(super) hash: String,
    pub(super) short_hash: String,
    pub(super) from_store: bool,
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
