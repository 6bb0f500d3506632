//! Verdicts beside the baseline → one self-contained folder with pages, figures and the numbers behind them.

mod baseline;
mod case_page;
mod committed;
pub mod comparison;
mod comparison_page;
pub mod coverage;
mod coverage_page;
mod drawing;
mod earlier;
mod error;
mod exit;
mod expected_failures;
mod failures;
mod flow_picture;
mod flows;
mod gate_list;
mod judgement;
mod junit;
mod moved;
mod origin;
mod overview;
mod page;
pub mod papers;
mod papers_page;
mod power;
mod print;
mod process;
mod rows;
pub mod scatter;
mod shipped;
mod single;
mod snapshot_text;
mod summary;
mod template;
mod unchanged;
mod validated_page;
mod view;
mod width;

#[cfg(test)]
mod pages_tests;
#[cfg(test)]
mod tests;

use print::Chapter;

pub use baseline::{Baseline, Change, MetricKey};
pub use committed::CommittedValues;
pub use error::ReportError;
pub use exit::Exit;
pub use expected_failures::{ExpectedFailure, ExpectedFailures, FailureKind, ListStatus};
pub use gate_list::{GateList, RemovedGates};
pub use judgement::{JudgedCase, JudgedMetric, Judgement, Rank, Severity, Tally, judge};
pub use junit::{check_junit, put_refusal};
pub use power::Doubt;
pub use process::{ChangedCases, ReportOutcome, ReportProcess, ReportRequest};
pub use single::{SingleOutcome, SingleRun};
pub use snapshot_text::description;
pub use summary::{Terminal, of_case, of_metrics};

use bagnold_figure as figure;
use bagnold_harness::{
    case, control, evidence, input, measured, metric, observation, output, page as pages, result, store,
};
use bagnold_inference::statistics;
use bagnold_number as number;
use case::{CaseResult, Features, Registry, Tier};
use control::ControlTrial;
use evidence::Paper;
use figure::{Figure, FigureError, FigureFormat};
use input::FieldError;
use measured::Measurements;
use metric::{Metric, Quantity};
use output::FileError;
use rayon::prelude::*;
use result::MetricsDocument;
use serde::Serialize;
use std::ops::Deref;
use std::path::{Path, PathBuf};
use std::time::Duration;
use store::{Drawings, provenance};

/// Everything that a report shows.
#[derive(Debug, Clone, Default)]
pub struct Report {
    /// Heading of the page.
    pub title: String,
    /// The tier that all cases ran at.
    pub tier: Tier,
    /// Provenance of the report.
    pub generated: ReportProvenance,
    /// The cases in the order of their registry.
    pub cases: Vec<CaseReport>,
    /// The values to compare with, committed ones or those of an earlier report; may be empty.
    pub baseline: Baseline,
    /// Folder of the earlier report that the baseline is; none where it is the committed values.
    pub against: Option<String>,
    /// The gates that are expected to fail; may be empty.
    pub expected_failures: ExpectedFailures,
    /// Expected failures that no study measures, at any tier.
    pub listed_in_vain: Vec<MetricKey>,
    /// Papers whose elements the report lists; empty for no page of papers.
    pub papers: &'static [Paper],
    /// The options whose coverage is shown; none for no page of them.
    pub features: Option<Features>,
}

impl Report {
    /// A report of some cases without anything to compare with.
    pub fn of(title: String, tier: Tier, cases: Vec<CaseReport>) -> Self {
        Self { title, tier, cases, ..Self::default() }
    }
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
}

impl ReportProvenance {
    /// Provenance of a report that this program made in `wall` time, by `command` if it is to be shown.
    pub fn of_this_program(wall: Duration, command: String) -> Self {
        Self {
            version: provenance::version().to_owned(),
            commit: provenance::commit().to_owned(),
            threads: rayon::current_num_threads(),
            wall_seconds: wall.as_secs_f64(),
            command,
        }
    }
}

/// One case of a report: its result and the data that the report adds.
#[derive(Debug, Clone)]
pub struct CaseReport {
    /// The finished case.
    pub result: CaseResult,
    /// Descriptions of its metrics, as far as the case declares them.
    pub quantities: &'static [Quantity],
    /// Gates of the baseline that do not judge it, with what took each away.
    pub not_judged: Vec<(MetricKey, String)>,
    /// Results of its controls; empty where none was tried.
    pub controls: Vec<ControlTrial>,
    /// Measurements of which its folder receives copies.
    pub measured: Vec<Measurements>,
}

impl CaseReport {
    /// A finished case of a registry.
    pub fn of(result: CaseResult, registry: Registry) -> Self {
        let quantities = registry.find(&result.name).map_or(&[][..], |case| case.quantities());
        Self { result, quantities, not_judged: Vec::new(), controls: Vec::new(), measured: Vec::new() }
    }

    /// Metric of a key.
    fn metric(&self, key: &MetricKey) -> Option<&Metric> {
        self.metrics.iter().find(|metric| MetricKey::of(&self.name, metric) == *key)
    }
}

impl Deref for CaseReport {
    type Target = CaseResult;

    fn deref(&self) -> &CaseResult {
        &self.result
    }
}

/// A figure or animation as the page refers to it.
#[derive(Debug, Clone, Serialize)]
struct DrawnFigure {
    caption: String,
    name: String,
    /// Endings of its files, what the picture leads to first.
    files: &'static [&'static str],
    /// Width and height of the picture `[px]`, so that the page does not move when it comes.
    size: Option<(u32, u32)>,
    /// Reason why there is no picture; none if there is one.
    failure: Option<String>,
}

/// Files of a figure, of an animation, and of a picture alone.
const FIGURE_FILES: &[&str] = &["svg", "png", "pdf", "csv"];
const ANIMATION_FILES: &[&str] = &["gif", "png"];
const PICTURE_FILES: &[&str] = &["png"];

/// Writes a report into `folder`: `index.html`, `papers.html`, `papers.json`, `coverage.html`, `comparisons.html`, `print.html` with all pages as one, `figures/CASE/NAME.{svg,png,pdf,csv,gif}`, in
/// `cases/CASE/` the case's page `index.html`, `metrics.json`, `case.toml` and `reference/NAME.csv`, and what the cases say
/// together as `metrics.json`, all metrics as `metrics.csv`, small pictures of flows in `figures/overview/CASE.png` and `figures/scatter/QUANTITY.{svg,png,pdf,csv}`. Files of the same names are replaced, others are left
/// alone.
///
/// Earlier drawings are taken from `drawings`. A figure that cannot be drawn does not spoil the report: the page says
/// so in its place.
///
/// # Errors
/// If a case name is no folder name, or a file cannot be written.
fn write(judgement: &Judgement<'_>, folder: &Path, drawings: &Drawings) -> Result<(), ReportError> {
    let report = judgement.report;
    report.cases.iter().try_for_each(|case| error::check_case_name(&case.name))?;
    let figures = folder.join("figures");
    let draw_in = |name: &str, all: &[Figure]| draw_figures(all, &figures.join(name), drawings);
    let drawn = report.cases.par_iter().map(|case| draw(case, &figures.join(&case.name), drawings));
    let drawn: Vec<Vec<DrawnFigure>> = drawn.collect::<Result<_, _>>()?;
    let mut chapters = Vec::new();
    for judged in &judgement.cases {
        let name = &judged.case.name;
        let place = folder.join("cases").join(name);
        put_case(judged, &place)?;
        let pictures = case_page::pictures(report, &drawn, judged.case);
        let text = case_page::render(report, judged, pictures, Some(neighbours(report, name)))?;
        chapters.push(Chapter::of(format!("case-{name}"), &text));
        put(&place.join("index.html"), &text)?;
    }
    let mut add = |name: &str, text: String| {
        chapters.push(Chapter::of(name, &text));
        put(&folder.join(format!("{name}.html")), &text)
    };
    if !judgement.papers.is_empty() {
        add("papers", papers_page::render(report, &judgement.papers)?)?;
        put(&folder.join("papers.json"), papers_page::json(report.tier, &judgement.papers))?;
    }
    if let Some(features) = &report.features {
        add("coverage", coverage_page::render(report, features)?)?;
        let maps = draw_in(validated_page::FOLDER, &validated_page::figures())?;
        add("validated", validated_page::render(report, &maps)?)?;
    }
    let quantities = scatter::quantities(report);
    let compared = draw_in(scatter::FOLDER, &scatter::figures(&quantities))?;
    if let Some(text) = comparison_page::render(report, scatter::rows(&quantities, &compared)) {
        add("comparisons", text?)?;
    }
    add("gates", page::gates(judgement)?)?;
    put(&folder.join("metrics.json"), scatter::json(judgement, &quantities))?;
    put(&folder.join("metrics.csv"), overview::csv(judgement))?;
    let small = draw_small(report, &figures.join(overview::FOLDER), drawings)?;
    let overview = page::render(judgement, (&drawn, &small))?;
    chapters.insert(0, Chapter::of("index", &overview));
    put(&folder.join("print.html"), print::render(&report.title, &chapters)?)?;
    Ok(put(&folder.join("index.html"), overview)?)
}

/// Writes the page of each case, which is one as a rule, straight into `folder`: what [`write()`] puts into
/// `cases/CASE/`, and the figures in `figures/NAME.{svg,png,pdf,csv,gif}`.
fn write_alone(judgement: &Judgement<'_>, folder: &Path, drawings: &Drawings) -> Result<(), ReportError> {
    for judged in &judgement.cases {
        let drawn = draw(judged.case, &folder.join("figures"), drawings)?;
        put_case(judged, folder)?;
        put(&folder.join("index.html"), case_page::render(judgement.report, judged, &drawn, None)?)?;
    }
    Ok(())
}

/// Writes verdicts as JUnit's XML, for programs that show tests: one per gate.
///
/// # Errors
/// A file that cannot be written.
pub fn put_junit(path: &Path, text: &str) -> Result<(), FieldError> {
    let remedy = "check the folder and its permissions";
    put(path, text).map_err(|_| FieldError::new("--junit", path.display(), "a file that can be written", remedy))
}

/// A case's numbers, parameters and measurements, and the tables of reference data that it has.
fn put_case(judged: &JudgedCase<'_>, folder: &Path) -> Result<(), ReportError> {
    let case = judged.case;
    let mut document = MetricsDocument::of(case, rayon::current_num_threads());
    document.tally = judged.tally().by_word();
    put(&folder.join("metrics.json"), document.text())?;
    put(&folder.join("case.toml"), &case.parameters_toml)?;
    for (name, text) in case_page::tables(&case.name) {
        put(&folder.join("reference").join(name), text)?;
    }
    let kept = case.measured.iter().try_for_each(|own| own.keep(folder));
    Ok(kept.map_err(|error| FileError::unwritable(folder, &error))?)
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

/// The flow, in motion if it can be, before the figures, and other animations behind them.
fn draw(case: &CaseReport, folder: &Path, drawings: &Drawings) -> Result<Vec<DrawnFigure>, ReportError> {
    let animations = case.animations.par_iter().map(|animation| {
        let written = drawing::write_animation(animation, folder, drawings);
        as_drawn(&animation.name, &animation.caption, ANIMATION_FILES, written)
    });
    let mut moving = animations.collect::<Result<Vec<DrawnFigure>, ReportError>>()?.into_iter();
    let still = || {
        let picture = flow_picture::of_case(case)?;
        // what is drawn for a paper has its size
        if drawings.format() != FigureFormat::SCREEN {
            return Some(draw_figures(&[picture], folder, drawings).map(|mut own| own.remove(0)));
        }
        let written = drawing::write_picture(&picture, folder, drawings, FigureFormat::HALF);
        Some(as_drawn(&picture.name, &picture.caption, PICTURE_FILES, written))
    };
    let flow = moving.next().map(Ok).or_else(still).transpose()?;
    let mut drawn: Vec<DrawnFigure> = flow.into_iter().collect();
    drawn.extend(draw_figures(&case.figures, folder, drawings)?);
    drawn.extend(moving);
    Ok(drawn)
}

fn draw_figures(figures: &[Figure], folder: &Path, drawings: &Drawings) -> Result<Vec<DrawnFigure>, ReportError> {
    let draw = |figure: &Figure| {
        let written = drawing::write_figure(figure, folder, drawings);
        as_drawn(&figure.name, &figure.caption, FIGURE_FILES, written)
    };
    figures.par_iter().map(draw).collect()
}

/// A number at the names of figures whose quantities have one name and different units.
fn with_numbers(mut figures: Vec<Figure>) -> Vec<Figure> {
    for place in (1..figures.len()).rev() {
        if figures[place].name == figures[place - 1].name {
            figures[place].name += &format!("-{}", place + 1);
        }
    }
    figures
}

/// The first panel of each figure that stands for a flow of the project, named like its case.
fn draw_small(report: &Report, folder: &Path, drawings: &Drawings) -> Result<Vec<DrawnFigure>, ReportError> {
    let draw = |case: &CaseReport| {
        let figure = flows::figure_of(case)?;
        let panels = figure.panels.iter().take(1).cloned().collect();
        let small = Figure { name: case.name.clone(), panels, ..figure.clone() };
        let written = drawing::write_picture(&small, folder, drawings, FigureFormat::SMALL);
        Some(as_drawn(&small.name, &small.caption, PICTURE_FILES, written))
    };
    report.cases.par_iter().filter_map(draw).collect()
}

/// Figure as the page shows it. One that was not drawn is named there and in the log; a file that cannot be written is
/// an error of the whole report.
fn as_drawn(
    name: &str,
    caption: &str,
    files: &'static [&'static str],
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
    Ok(DrawnFigure { caption: caption.to_owned(), name: name.to_owned(), files, size, failure })
}

/// Writes a file, and before it the folder that it lies in.
///
/// # Errors
/// A file or folder that cannot be written.
pub fn put(path: &Path, text: impl AsRef<[u8]>) -> Result<(), FileError> {
    let folder = path.parent().unwrap_or(path);
    let written = std::fs::create_dir_all(folder).and_then(|()| std::fs::write(path, text));
    written.map_err(|error| FileError::unwritable(path, &error))
}
