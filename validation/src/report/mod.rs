//! Verdicts → one self-contained folder with a page, figures and the numbers behind them.

pub mod accepted;
pub mod drift;
mod earlier;
mod error;
pub mod history;
pub mod judgement;
pub mod known_failures;
mod page;
pub mod papers;
mod papers_page;
mod rows;
pub mod scatter;
mod snapshot_text;
mod template;
mod view;
mod width;

#[cfg(test)]
mod tests;

pub use accepted::{Baseline, Drift, Key};
pub use error::{BaselineError, EarlierError, ReportError};
pub use history::History;
pub use judgement::{Judgement, judge};
pub use known_failures::{KnownFailure, KnownFailures, Standing};
pub use snapshot_text::description;
pub(crate) use template::template_value;

use crate::case::Tier;
use crate::figure::{self, Animation, Figure, FigureError};
use crate::metric::Metric;
use crate::reference::Paper;
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// Everything that a report shows.
#[derive(Debug, Clone)]
pub struct Report {
    /// Heading of the page.
    pub title: String,
    /// The tier that all cases ran at.
    pub tier: Tier,
    /// How the report came about.
    pub generated: Provenance,
    /// The cases in the order of their registry.
    pub cases: Vec<CaseReport>,
    /// The values to compare with, accepted ones or those of an earlier report; may be empty.
    pub baseline: Baseline,
    /// Folder of the earlier report that the baseline is; none where it is the accepted values.
    pub against: Option<String>,
    /// What accepted figures were at earlier times; may be empty.
    pub history: History,
    /// The gates that are known to fail; may be empty.
    pub known_failures: KnownFailures,
    /// The papers whose elements are accounted for; none for no page of them.
    pub papers: &'static [Paper],
}

/// How a report came about.
#[derive(Debug, Clone, Default)]
pub struct Provenance {
    /// Version of the program.
    pub version: String,
    /// Commit of the sources, empty if unknown.
    pub commit: String,
    /// Threads used.
    pub threads: usize,
    /// Wall time of everything `[s]`.
    pub wall_seconds: f64,
    /// The command that makes the report again.
    pub command: String,
    /// Day and time, shown in the footer only; `None` where the page must be the same every time.
    pub date: Option<String>,
}

/// One case of a report.
#[derive(Debug, Clone)]
pub struct CaseReport {
    /// Name, also of its folders.
    pub name: String,
    /// One line.
    pub summary: String,
    /// A paragraph: what is simulated and what it is judged against.
    pub description: String,
    /// The parameters as run; written as `case.toml`.
    pub parameters_toml: String,
    /// The command that reproduces the case.
    pub command: String,
    /// Judged and observed numbers.
    pub metrics: Vec<Metric>,
    /// Figures in reading order.
    pub figures: Vec<Figure>,
    /// Moving pictures, shown after the figures.
    pub animations: Vec<Animation>,
    /// The simulations behind the metrics.
    pub runs: Vec<crate::case::RunSummary>,
    /// The text of `metrics.json`, written as it is.
    pub metrics_json: String,
}

/// A figure or animation as the page refers to it.
#[derive(Debug, Clone)]
struct Drawn {
    caption: String,
    name: String,
    /// A GIF, instead of an SVG with a PNG.
    moves: bool,
    /// Why there is no picture, or nothing.
    failure: Option<String>,
}

/// Writes the report into `folder`: `index.html`, `papers.html`, `papers.json`, `figures/CASE/NAME.{svg,png,gif}`,
/// `cases/CASE/metrics.json` and `cases/CASE/case.toml`, and what the cases say together as `metrics.json` and
/// `figures/scatter/QUANTITY.{svg,png}`. Files of the same names are replaced, others are left alone.
///
/// A figure that cannot be drawn does not spoil the report: the page says so in its place.
///
/// # Errors
/// If a case name is no folder name, or a file cannot be written.
pub fn write(report: &Report, folder: &Path) -> Result<(), ReportError> {
    if let Some(case) = report.cases.iter().find(|case| !figure::is_file_name(&case.name)) {
        return Err(ReportError::Name { name: case.name.clone() });
    }
    make(folder)?;
    let drawn: Vec<Vec<Drawn>> = report
        .cases
        .par_iter()
        .map(|case| draw(case, &folder.join("figures").join(&case.name)))
        .collect::<Result<_, _>>()?;
    for case in &report.cases {
        let place = folder.join("cases").join(&case.name);
        make(&place)?;
        put(place.join("metrics.json"), &case.metrics_json)?;
        put(place.join("case.toml"), &case.parameters_toml)?;
    }
    let judgement = judge(report);
    if !judgement.papers.is_empty() {
        put(folder.join("papers.html"), &papers_page::render(report, &judgement.papers)?)?;
        put(folder.join("papers.json"), &papers_page::json(report.tier, &judgement.papers))?;
    }
    let quantities = scatter::quantities(report);
    let compared = draw_figures(&scatter::figures(&quantities), &folder.join("figures").join(scatter::FOLDER))?;
    put(folder.join("metrics.json"), &scatter::json(&quantities))?;
    let comparisons = scatter::rows(&quantities, &compared);
    put(folder.join("index.html"), &page::render(report, &judgement, &drawn, comparisons)?)
}

fn draw(case: &CaseReport, folder: &Path) -> Result<Vec<Drawn>, ReportError> {
    let mut drawn = draw_figures(&case.figures, folder)?;
    let animations = case.animations.par_iter().map(|animation| {
        let failure = failure_of(figure::write_animation(animation, folder))?;
        Ok(Drawn { caption: animation.caption.clone(), name: animation.name.clone(), moves: true, failure })
    });
    drawn.extend(animations.collect::<Result<Vec<Drawn>, ReportError>>()?);
    Ok(drawn)
}

fn draw_figures(figures: &[Figure], folder: &Path) -> Result<Vec<Drawn>, ReportError> {
    let draw = |figure: &Figure| {
        let failure = failure_of(figure::write(figure, folder))?;
        Ok(Drawn { caption: figure.caption.clone(), name: figure.name.clone(), moves: false, failure })
    };
    figures.par_iter().map(draw).collect()
}

/// Why something was not drawn; a file that cannot be written is an error of the whole report.
fn failure_of<W>(written: Result<W, FigureError>) -> Result<Option<String>, ReportError> {
    match written {
        Ok(_) => Ok(None),
        Err(error @ FigureError::Write { .. }) => Err(error.into()),
        Err(error) => Ok(Some(error.to_string())),
    }
}

fn make(folder: &Path) -> Result<(), ReportError> {
    std::fs::create_dir_all(folder).map_err(|source| ReportError::Write { path: folder.to_owned(), source })
}

fn put(path: PathBuf, text: &str) -> Result<(), ReportError> {
    std::fs::write(&path, text).map_err(|source| ReportError::Write { path, source })
}
