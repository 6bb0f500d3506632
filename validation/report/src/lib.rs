//! Verdicts beside accepted values → one self-contained folder with pages, figures and the numbers behind them.

pub mod accepted;
mod case_page;
pub mod comparison;
mod comparison_figure;
mod comparison_page;
pub mod coverage;
mod coverage_page;
mod drawing;
pub mod drift;
mod earlier;
mod error;
mod failures;
mod flows;
mod gate_list;
pub mod judgement;
mod junit;
pub mod known_failures;
mod origin;
mod overview;
mod page;
pub mod papers;
mod papers_page;
mod power;
mod print;
mod rows;
pub mod scatter;
mod shipped;
mod snapshot_text;
mod template;
mod validated_page;
mod view;
mod width;

#[cfg(test)]
mod pages_tests;
#[cfg(test)]
mod tests;

use print::Chapter;

pub use accepted::{Baseline, Drift, MetricKey};
pub use error::{BaselineError, EarlierError, ReportError};
pub use gate_list::{GateList, RemovedGates};
pub use judgement::{Judgement, judge};
pub use junit::check_junit;
pub use known_failures::{KnownFailure, KnownFailureStatus, KnownFailures};
pub use power::GatePower;
pub use snapshot_text::description;

use bagnold_figure as figure;
use bagnold_harness::{case, control, evidence, input, metric, observation, page as pages, result, store};
use bagnold_inference::statistics;
use bagnold_number as number;
use case::{Features, Tier};
use control::ControlTrial;
use evidence::Paper;
use figure::{Animation, Figure, FigureError};
use metric::{Metric, Quantity};
use rayon::prelude::*;
use serde::Serialize;
use std::path::{Path, PathBuf};
use std::time::Duration;
use store::{Drawings, provenance};

/// Everything that a report shows.
#[derive(Debug, Clone)]
pub struct Report {
    /// Heading of the page.
    pub title: String,
    /// The tier that all cases ran at.
    pub tier: Tier,
    /// Provenance of the report.
    pub generated: ReportProvenance,
    /// The cases in the order of their registry.
    pub cases: Vec<CaseReport>,
    /// The values to compare with, accepted ones or those of an earlier report; may be empty.
    pub baseline: Baseline,
    /// Folder of the earlier report that the baseline is; none where it is the accepted values.
    pub against: Option<String>,
    /// The gates that are known to fail; may be empty.
    pub known_failures: KnownFailures,
    /// The papers whose elements are accounted for; none for no page of them.
    pub papers: &'static [Paper],
    /// The options whose coverage is shown; none for no page of them.
    pub features: Option<Features>,
}

/// Provenance of a report.
#[derive(Debug, Clone, Default)]
pub struct ReportProvenance {
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

impl ReportProvenance {
    /// Provenance of a report that this program made in `wall` time, by `command` if it is to be shown.
    #[must_use]
    pub fn of_this_program(wall: Duration, command: String) -> Self {
        Self {
            version: provenance::version().to_owned(),
            commit: provenance::commit().to_owned(),
            threads: rayon::current_num_threads(),
            wall_seconds: wall.as_secs_f64(),
            command,
            date: None,
        }
    }
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
    /// Their descriptions, as far as the case declares them.
    pub quantities: &'static [Quantity],
    /// Accepted gates that do not judge it, with what took each away.
    pub not_judged: Vec<(MetricKey, String)>,
    /// Results of its controls; empty where none was tried.
    pub controls: Vec<ControlTrial>,
    /// Figures in reading order.
    pub figures: Vec<Figure>,
    /// Moving pictures, shown after the figures.
    pub animations: Vec<Animation>,
    /// The simulations behind the metrics.
    pub runs: Vec<crate::case::RunSummary>,
    /// Values that each run depends on, by field name.
    pub run_parameters: Vec<serde_json::Value>,
    /// The text of `metrics.json`, written as it is.
    pub metrics_json: String,
}

/// A figure or animation as the page refers to it.
#[derive(Debug, Clone, Serialize)]
struct DrawnFigure {
    caption: String,
    name: String,
    /// A GIF, instead of an SVG with a PNG.
    moves: bool,
    /// Width and height of the picture `[px]`, so that the page does not move when it comes.
    size: Option<(u32, u32)>,
    /// Reason why there is no picture; none if there is one.
    failure: Option<String>,
}

/// Writes the report into `folder`: `index.html`, `papers.html`, `papers.json`, `coverage.html`, `comparisons.html`, `print.html` with all pages as one, `figures/CASE/NAME.{svg,png,pdf,csv,gif}`, in
/// `cases/CASE/` the case's page `index.html`, `metrics.json`, `case.toml` and `reference/NAME.csv`, and what the cases say
/// together as `metrics.json`, small pictures in `figures/overview/CASE.png` and `figures/scatter/QUANTITY.{svg,png,pdf,csv}`. Files of the same names are replaced, others are left
/// alone.
///
/// Earlier drawings are taken from `drawings`. A figure that cannot be drawn does not spoil the report: the page says
/// so in its place.
///
/// # Errors
/// If a case name is no folder name, or a file cannot be written.
pub fn write(report: &Report, folder: &Path, drawings: &Drawings) -> Result<(), ReportError> {
    if let Some(case) = report.cases.iter().find(|case| !figure::is_file_name(&case.name)) {
        return Err(ReportError::Name { name: case.name.clone() });
    }
    make(folder)?;
    let drawn: Vec<Vec<DrawnFigure>> = report
        .cases
        .par_iter()
        .map(|case| draw(case, &folder.join("figures").join(&case.name), drawings))
        .collect::<Result<_, _>>()?;
    let judgement = judge(report);
    let mut chapters = Vec::new();
    for judged in &judgement.cases {
        let name = &judged.case.name;
        let place = folder.join("cases").join(name);
        put_case(judged.case, &place)?;
        let pictures = page::pictures(report, &drawn, judged.case);
        let text = case_page::render(report, judged, pictures, Some(neighbours(report, name)))?;
        chapters.push(Chapter::of(format!("case-{name}"), &text));
        put(place.join("index.html"), &text)?;
    }
    let mut add = |name: &str, text: String| {
        chapters.push(Chapter::of(name, &text));
        put(folder.join(format!("{name}.html")), &text)
    };
    if !judgement.papers.is_empty() {
        add("papers", papers_page::render(report, &judgement.papers)?)?;
        put(folder.join("papers.json"), &papers_page::json(report.tier, &judgement.papers))?;
    }
    if let Some(features) = &report.features {
        add("coverage", coverage_page::render(report, features)?)?;
        let maps = folder.join("figures").join(validated_page::FOLDER);
        let maps = draw_figures(&validated_page::figures(), &maps, drawings)?;
        add("validated", validated_page::render(report, &maps)?)?;
    }
    let beside = draw_figures(
        &comparison_figure::figures(report),
        &folder.join("figures").join(comparison_figure::FOLDER),
        drawings,
    )?;
    if let Some(text) = comparison_page::render(report, &beside) {
        add("comparisons", text?)?;
    }
    let quantities = scatter::quantities(report);
    let compared =
        draw_figures(&scatter::figures(&quantities), &folder.join("figures").join(scatter::FOLDER), drawings)?;
    put(folder.join("metrics.json"), &scatter::json(&quantities))?;
    let comparisons = scatter::rows(&quantities, &compared);
    let small = draw_small(report, &folder.join("figures").join(overview::FOLDER), drawings)?;
    let overview = page::render(report, &judgement, (&drawn, &small), comparisons)?;
    chapters.insert(0, Chapter::of("index", &overview));
    put(folder.join("print.html"), &print::render(&report.title, &chapters)?)?;
    put(folder.join("index.html"), &overview)
}

/// Writes the page of each case of `report`, which is one as a rule, straight into `folder`: what [`write()`] puts into
/// `cases/CASE/`, and the figures in `figures/NAME.{svg,png,pdf,csv,gif}`.
///
/// # Errors
/// If a file cannot be written.
pub fn write_alone(report: &Report, folder: &Path, drawings: &Drawings) -> Result<(), ReportError> {
    for judged in &judge(report).cases {
        let drawn = draw(judged.case, &folder.join("figures"), drawings)?;
        put_case(judged.case, folder)?;
        put(folder.join("index.html"), &case_page::render(report, judged, &drawn, None)?)?;
    }
    Ok(())
}

/// Writes the verdicts as JUnit's XML, for programs that show tests: one per gate.
///
/// # Errors
/// If the file cannot be written.
pub fn write_junit(report: &Report, path: &Path) -> Result<(), ReportError> {
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        make(folder)?;
    }
    put(path.to_owned(), &junit::text(report, &judge(report)))
}

/// A case's numbers and parameters, and the tables of reference data that it has.
fn put_case(case: &CaseReport, folder: &Path) -> Result<(), ReportError> {
    make(folder)?;
    put(folder.join("metrics.json"), &case.metrics_json)?;
    put(folder.join("case.toml"), &case.parameters_toml)?;
    for (name, text) in case_page::tables(&case.name) {
        let path = folder.join("reference").join(name);
        make(path.parent().unwrap_or(folder))?;
        put(path, text)?;
    }
    Ok(())
}

/// The cases before and after one, in the report's order.
fn neighbours(report: &Report, name: &str) -> serde_json::Value {
    let place = report.cases.iter().position(|case| case.name == name).unwrap_or(0);
    let name_at = |place: Option<usize>| report.cases.get(place?).map(|case| &case.name);
    serde_json::json!({
        "has_papers": !report.papers.is_empty(),
        "previous": name_at(place.checked_sub(1)),
        "next": name_at(Some(place + 1)),
    })
}

fn draw(case: &CaseReport, folder: &Path, drawings: &Drawings) -> Result<Vec<DrawnFigure>, ReportError> {
    let mut drawn = draw_figures(&case.figures, folder, drawings)?;
    if !case.animations.is_empty() {
        make(folder)?;
    }
    let animations = case.animations.par_iter().map(|animation| {
        let written = drawing::write_animation(animation, folder, drawings);
        as_drawn(&animation.name, &animation.caption, true, written)
    });
    drawn.extend(animations.collect::<Result<Vec<DrawnFigure>, ReportError>>()?);
    Ok(drawn)
}

fn draw_figures(figures: &[Figure], folder: &Path, drawings: &Drawings) -> Result<Vec<DrawnFigure>, ReportError> {
    if !figures.is_empty() {
        make(folder)?;
    }
    let draw = |figure: &Figure| {
        let written = drawing::write_figure(figure, folder, drawings);
        as_drawn(&figure.name, &figure.caption, false, written)
    };
    figures.par_iter().map(draw).collect()
}

/// The first panel of the figure that stands for each case, named like the case.
fn draw_small(report: &Report, folder: &Path, drawings: &Drawings) -> Result<Vec<DrawnFigure>, ReportError> {
    make(folder)?;
    let draw = |case: &CaseReport| {
        let figure = flows::figure_of(case)?;
        let panels = figure.panels.iter().take(1).cloned().collect();
        let small = Figure { name: case.name.clone(), panels, ..figure.clone() };
        Some(as_drawn(&case.name, &figure.caption, false, drawing::write_small(&small, folder, drawings)))
    };
    report.cases.par_iter().filter_map(draw).collect()
}

/// Figure as the page shows it. One that was not drawn is named there and in the log; a file that cannot be written is
/// an error of the whole report.
fn as_drawn(
    name: &str,
    caption: &str,
    moves: bool,
    written: Result<PathBuf, FigureError>,
) -> Result<DrawnFigure, ReportError> {
    let (size, failure) = match written {
        Ok(path) => (figure::size_of(&path), None),
        Err(error @ FigureError::Write { .. }) => return Err(error.into()),
        Err(error) => {
            tracing::error!("figure {name}: failed to {error}");
            (None, Some(error.to_string()))
        }
    };
    Ok(DrawnFigure { caption: caption.to_owned(), name: name.to_owned(), moves, size, failure })
}

fn make(folder: &Path) -> Result<(), ReportError> {
    std::fs::create_dir_all(folder).map_err(|source| ReportError::Write { path: folder.to_owned(), source })
}

fn put(path: PathBuf, text: &str) -> Result<(), ReportError> {
    std::fs::write(&path, text).map_err(|source| ReportError::Write { path, source })
}
