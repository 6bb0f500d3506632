//! A user's own measurements in a case's figure, and how far the case is from them: `--overlay FILE.csv`.

mod column;
mod drawing;
mod place;
mod reading;

pub use crate::evidence::WantedColumns;
pub use column::ColumnSource;
pub use place::{COARSE, HALF_A_ROW, coarse_in_words};

use crate::case::{CaseResult, ParameterError, PreparedCase};
use crate::evidence::{NumberColumn, in_unit};
use crate::input::{FieldError, MeasuredFiles};
use crate::metric::{Confidence, Limit, Metric, MetricKind, Origin, Variant};
use crate::number::four_digits;
use crate::output::caution;
use place::{CurveResidual, MatchingPanel};
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Measurements of one quantity over another, with a standard uncertainty each.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Measurements {
    /// File of the measurements.
    pub path: PathBuf,
    /// Text of the copy that a folder of results keeps.
    pub text: String,
    /// Independent variable of the measurements: the first column.
    abscissa: NumberColumn,
    /// Measured quantity; of repeats their mean.
    pub measured: NumberColumn,
    /// Standard uncertainties, in the unit of what was measured.
    uncertainty: Vec<f64>,
    /// Number of repeats.
    repeats: usize,
    /// Number of their files.
    files: usize,
    /// Standard deviation of the repeats of each row, in that unit.
    scatter: Vec<f64>,
    /// Words of a column `variant`; empty without one.
    pub variants: Vec<String>,
    /// Values that the comments of the file give.
    said: Said,
}

/// Values that comments of the form `# key: value` give.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
struct Said {
    /// Largest root mean square of the residuals `[-]`.
    limit: Option<f64>,
    /// Name of the figure that is meant.
    figure: Option<String>,
    /// Title of its panel.
    panel: Option<String>,
    /// Legend of the curve that is compared.
    curve: Option<String>,
    /// Source of the measurements.
    source: Option<String>,
    /// Confidence in the measurements.
    confidence: Option<Confidence>,
}

/// Draws measurements into a finished case and judges by them; its parameters then name the copies that [`Measurements::keep`] makes.
///
/// # Errors
/// Refusals of [`Measurements::draw`].
pub fn draw_measured(result: &mut CaseResult, measurements: &[Measurements]) -> Result<(), ParameterError> {
    measurements.iter().try_for_each(|own| own.draw(result))?;
    if !measurements.is_empty() {
        result.parameters_toml = with_overlay(&result.parameters_toml, measurements);
        "bagnold run case.toml".clone_into(&mut result.command);
    }
    Ok(())
}

/// A case file that names the copies of measurements beside it.
pub fn with_overlay(case_file: &str, measurements: &[Measurements]) -> String {
    let files: Vec<toml::Value> = measurements.iter().map(|own| toml::Value::String(own.kept())).collect();
    let line = format!("overlay = {}\ntier = ", toml::Value::Array(files));
    if measurements.is_empty() { case_file.to_owned() } else { case_file.replacen("tier = ", &line, 1) }
}

/// Reads the measurements that are drawn into a case's figures: those of its file and further ones. Where its figures are known before it is simulated, headings that fit
/// none of them are refused: those of scenes, and of cases that tell their axes.
///
/// # Errors
/// Two files of one name, and what [`Measurements::read`] and [`Measurements::draw`] refuse.
pub fn read_overlay(
    case: &dyn PreparedCase,
    of_case: &[MeasuredFiles],
    further: &[PathBuf],
) -> Result<Vec<Measurements>, ParameterError> {
    let read = |files| Measurements::read(&files, WantedColumns::default());
    let further = further.iter().cloned().map(MeasuredFiles::One);
    let measurements: Vec<Measurements> = of_case.iter().cloned().chain(further).map(read).collect::<Result<_, _>>()?;
    let outline = if measurements.is_empty() { None } else { case.outline() };
    let axes = if measurements.is_empty() || outline.is_some() { Vec::new() } else { case.axes() };
    for (number, own) in measurements.iter().enumerate() {
        if let Some(twin) = measurements[..number].iter().find(|twin| twin.kept() == own.kept()) {
            let defect = format!("{} has the same name as {}", own.path.display(), twin.path.display());
            return Err(FieldError::finding("overlay", defect, "rename one of the two files").into());
        }
        if let Some(CaseResult { figures, .. }) = &outline {
            MatchingPanel::of(own, figures)?.curves(own, figures)?;
        } else if !axes.is_empty() {
            MatchingPanel::check_axes(own, &axes)?;
        }
    }
    Ok(measurements)
}

impl Measurements {
    /// Reads what was varied, what was measured and its standard uncertainties, or repeats.
    ///
    /// # Errors
    /// A file that cannot be read or lacks a column, numbers that are not finite, uncertainties that are not positive, comments
    /// that look like a key but are none.
    pub fn read(given: &MeasuredFiles, wanted: WantedColumns<'_>) -> Result<Self, ParameterError> {
        reading::read(given, wanted)
    }

    /// Name of the file without its ending: the measurements' name in figures and metrics.
    pub fn name(&self) -> String {
        self.path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// Name of their points in a legend.
    pub fn legend(&self) -> String {
        if self.repeats == 1 { self.name() } else { format!("{}, mean of {}", self.name(), self.repeated()) }
    }

    /// Repeats in words: what their mean is named after is the first of several files.
    fn repeated(&self) -> String {
        if self.files == 1 { format!("{} repeats", self.repeats) } else { format!("{} files", self.files) }
    }

    /// Source of the measurements: as the file states it, else the path of the file; with the scatter of repeats.
    pub fn source(&self) -> String {
        let source = self.said.source.clone().unwrap_or_else(|| self.path.display().to_string());
        if self.repeats == 1 {
            return source;
        }
        let scatter = four_digits(self.scatter.iter().copied().fold(0.0, f64::max));
        format!("{source}; mean of {}, which scatter by up to {scatter} {}", self.repeated(), self.measured.unit)
    }

    /// Limit of the residuals' root mean square that the file states `[-]`, with its reason.
    pub fn limit(&self) -> Option<(Limit, String)> {
        let reason = || format!("the limit that {} states", self.path.display());
        self.said.limit.map(|limit| (Limit::AtMost(limit), reason()))
    }

    /// Confidence in the measurements, as the file states it.
    pub fn confidence(&self) -> Option<Confidence> {
        self.said.confidence
    }

    /// Points (abscissa, value, standard uncertainty) in other units of the same kinds.
    ///
    /// # Errors
    /// A unit of another kind.
    pub fn in_units(&self, abscissa: &str, measured: &str) -> Result<Vec<[f64; 3]>, FieldError> {
        let uncertainty = NumberColumn { values: self.uncertainty.clone(), ..self.measured.clone() };
        let columns = [(&self.abscissa, abscissa), (&self.measured, measured), (&uncertainty, measured)];
        let columns = columns.map(|(own, to)| in_unit(own, to).map_err(|error| error.in_file(&self.path)));
        let [x, y, u] = columns;
        Ok(x?.into_iter().zip(y?).zip(u?).map(|((x, y), u)| [x, y, u]).collect())
    }

    /// Draws them into the figure whose axes are theirs, and adds a metric for each curve that is there: the root mean square of
    /// (curve − measurement)/uncertainty, observed unless the file states a limit.
    ///
    /// # Errors
    /// Axes that no figure of the case has or more than one, a curve that is not there, measurements beside every curve.
    pub fn draw(&self, result: &mut CaseResult) -> Result<(), ParameterError> {
        if self.said.limit.is_some() && self.said.confidence == Some(Confidence::Unverified) {
            caution(&format!("{}: unverified measurements never judge: `# limit` is left out", self.path.display()));
        }
        let place = MatchingPanel::of(self, &result.figures)?;
        let curves = place.curves(self, &result.figures)?;
        drawing::draw(self, &place, &mut result.figures);
        let metrics: Vec<Metric> = curves.iter().map(|curve| self.metric(curve, curves.len() > 1)).collect();
        result.metrics.extend(metrics);
        Ok(())
    }

    fn metric(&self, curve: &CurveResidual, one_of_several: bool) -> Metric {
        let name = text_of_variant(&self.name());
        let variant = Variant::of("overlay", name.as_str());
        let variant =
            if one_of_several { variant.and("curve", text_of_variant(&curve.label).as_str()) } else { variant };
        let (compared, all) = (curve.compared, self.measured.values.len());
        let left_out = || format!("`{}` has a value at {compared} of {all} measurements", curve.label);
        let remarks =
            (compared < all).then(left_out).into_iter().chain(curve.short.clone()).chain(curve.coarse.clone());
        let confidence = self.said.confidence.unwrap_or(Confidence::Low);
        let is_judged = curve.short.is_none() || self.said.limit.is_none();
        let residual = if is_judged { curve.residual } else { f64::NAN };
        let metric = Metric::observed("overlay_residual", &variant, residual, "-")
            .against(None, &self.source(), confidence)
            .remarked(remarks.reduce(|all, own| format!("{all}; {own}")))
            .known_to(Origin::Numerical, Some(curve.by_resolution), COARSE)
            .of_kind(MetricKind::Validation);
        let (limit, reason) = self.limit().unzip();
        metric.gated_by(limit, &reason.unwrap_or_default()).of_user()
    }

    /// Copies the file into the folder of a run, from where its `case.toml` reads it.
    ///
    /// # Errors
    /// A folder that cannot be written.
    pub fn keep(&self, folder: &Path) -> std::io::Result<()> {
        let file = folder.join(self.kept());
        std::fs::create_dir_all(file.parent().unwrap_or(folder))?;
        std::fs::write(file, &self.text)
    }

    /// Path of the copy in the folder of a run.
    pub fn kept(&self) -> String {
        format!("overlay/{}.csv", self.name())
    }
}

/// Text in the form that a variant can hold: it uses `=`, `,` and `_` itself.
fn text_of_variant(text: &str) -> String {
    let letter = |letter: char| if letter.is_alphanumeric() || letter == '.' { letter } else { '-' };
    let text: String = text.chars().map(letter).collect();
    let words: Vec<&str> = text.split('-').filter(|word| !word.is_empty()).collect();
    if words.is_empty() { "unnamed".to_owned() } else { words.join("-") }
}

#[cfg(test)]
mod tests;
