//! A user's own measurements in a case's figure, and how far the case is from them: `--overlay FILE.csv`.

mod column;
mod drawing;
mod place;
mod reading;

pub use column::ColumnSource;

use crate::case::CaseResult;
use crate::case::ParameterError;
use crate::input::FieldError;
use crate::metric::{Confidence, Limit, Metric, MetricKind, Variant};
use place::{CurveResidual, MatchingPanel};
use std::path::{Path, PathBuf};

/// Measurements of one quantity over another, with a standard uncertainty each.
#[derive(Debug, Clone, PartialEq)]
pub struct Measurements {
    /// Their file.
    pub path: PathBuf,
    /// Its text, as it was read.
    text: String,
    /// Independent variable of the measurements: the first column.
    abscissa: MeasuredColumn,
    /// Measured quantity: the second column.
    measured: MeasuredColumn,
    /// Standard uncertainties, in the unit of what was measured.
    uncertainty: Vec<f64>,
    /// Values that the comments of the file give.
    said: Said,
}

/// A column of the file.
#[derive(Debug, Clone, PartialEq)]
struct MeasuredColumn {
    /// Name of the quantity, as an axis has it.
    name: String,
    /// Unit.
    unit: String,
    /// Values in that unit.
    values: Vec<f64>,
}

/// Values that comments of the form `# key: value` give.
#[derive(Debug, Clone, PartialEq, Default)]
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
/// Two files of one name, and what [`Measurements::draw`] refuses.
pub fn draw_measured(result: &mut CaseResult, measurements: &[Measurements]) -> Result<(), ParameterError> {
    for (number, own) in measurements.iter().enumerate() {
        if let Some(twin) = measurements[..number].iter().find(|twin| twin.kept() == own.kept()) {
            let rule = format!("of another name than {}", twin.path.display());
            let remedy = "its name stands in figures and metrics: rename one";
            return Err(FieldError::new("overlay", own.path.display(), &rule, remedy).into());
        }
        own.draw(result)?;
    }
    if !measurements.is_empty() {
        let files: Vec<toml::Value> = measurements.iter().map(|own| toml::Value::String(own.kept())).collect();
        let line = format!("overlay = {}\n", toml::Value::Array(files));
        let head = format!("tier = \"{}\"\n", result.tier);
        result.parameters_toml = result.parameters_toml.replacen(&head, &(head.clone() + &line), 1);
        "bagnold run case.toml".clone_into(&mut result.command);
    }
    Ok(())
}

impl Measurements {
    /// Reads a file: three columns with their units, comments before.
    ///
    /// # Errors
    /// A file that cannot be read or is no such table, numbers that are not finite, uncertainties that are not positive, comments
    /// that look like a key but are none.
    pub fn read(path: &Path) -> Result<Self, ParameterError> {
        reading::read(path)
    }

    /// Name of the file without its ending: the measurements' name in figures and metrics.
    #[must_use]
    pub fn name(&self) -> String {
        self.path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
    }

    /// Source of the measurements: as the file states it, else the path of the file.
    pub fn source(&self) -> String {
        self.said.source.clone().unwrap_or_else(|| self.path.display().to_string())
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
        let factor = |column: &MeasuredColumn, unit: &str| {
            reading::same_kind(&column.unit, unit).ok_or_else(|| {
                let rule = format!("a unit of the same kind as [{unit}]");
                let error = FieldError::new(&column.name, format!("[{}]", column.unit), &rule, "mend the heading");
                error.in_file(&self.path)
            })
        };
        let (to_x, to_y) = (factor(&self.abscissa, abscissa)?, factor(&self.measured, measured)?);
        let points = self.abscissa.values.iter().zip(&self.measured.values).zip(&self.uncertainty);
        Ok(points.map(|((x, y), u)| [x * to_x, y * to_y, u * to_y]).collect())
    }

    /// Draws them into the figure whose axes are theirs, and adds a metric for each curve that is there: the root mean square of
    /// (curve − measurement)/uncertainty, observed unless the file states a limit.
    ///
    /// # Errors
    /// Axes that no figure of the case has or more than one, a curve that is not there, measurements beside every curve.
    pub fn draw(&self, result: &mut CaseResult) -> Result<(), ParameterError> {
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
        let confidence = self.said.confidence.unwrap_or(Confidence::Low);
        let metric = Metric::observed("overlay_residual", &variant, curve.residual, "-")
            .against(Some(0.0), &self.source(), confidence)
            .remarked((compared < all).then(left_out))
            .of_kind(MetricKind::Validation);
        let reason = format!("the limit that {} states", self.path.display());
        metric.gated_by(self.said.limit.map(Limit::AtMost), &reason).of_user()
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
    #[must_use]
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
