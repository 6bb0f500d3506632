//! The blind study of a league: collapses predicted from the friction of grains on slopes before the grains collapsed.
//!
//! Errors and uncertainties are those of ASME V&V 20. The seeds of the grains follow from the digest of the prediction, so nobody
//! can have known the collapses when it was made.

use super::scatter;
use crate::ToolError;
use crate::number::{four_digits, two_digits};
use crate::output::FileError;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Folder of the study in a league.
const FOLDER: &str = "blind/results";

/// A predicted quantity with the values of the grains.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct BlindComparison {
    /// `discs` or `spheres`.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub grains: String,
    /// `local` or `nonlocal` friction.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub law: String,
    /// The case, or the slope.
    pub case: String,
    /// Initial height over half width `[-]` of a column.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub aspect_ratio: Option<f64>,
    /// Name of the quantity; lengths are over the half width but for the front's way down an incline `[m]`.
    pub quantity: String,
    /// Predicted value, written before the measurement was known.
    pub value: f64,
    /// Standard uncertainty from the friction that was measured.
    pub u_input: f64,
    /// Standard uncertainty from the particle spacing.
    pub u_numerical: f64,
    /// Lower end of the 95 % interval that carries the model's errors elsewhere.
    pub lower: Option<f64>,
    /// Upper end.
    pub upper: Option<f64>,
    /// Values of the grains, one for each seed.
    #[serde(skip)]
    pub measured: Vec<f64>,
    /// Standard uncertainty of their mean, where it is stated; else it follows from their scatter.
    #[serde(skip)]
    pub u_measured: Option<f64>,
}

#[derive(Deserialize)]
struct Measured {
    grains: String,
    case: String,
    aspect_ratio: Option<f64>,
    quantity: String,
    value: f64,
}

fn rows<Row: DeserializeOwned>(path: &Path) -> Result<Vec<Row>, ToolError> {
    let rows = csv::Reader::from_path(path).and_then(|reader| reader.into_deserialize().collect());
    Ok(rows.map_err(|error| FileError::unreadable(path, &error.into()))?)
}

/// Reads the study of a league, if it has one.
///
/// # Errors
/// Tables that cannot be read.
pub fn read(league: &Path) -> Result<Vec<BlindComparison>, ToolError> {
    let folder = league.join(FOLDER);
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let mut all: Vec<BlindComparison> = rows(&folder.join("prediction.csv"))?;
    for row in rows::<Measured>(&folder.join("measured.csv"))? {
        let is_of = |one: &&mut BlindComparison| {
            (&one.grains, &one.case, one.aspect_ratio, &one.quantity)
                == (&row.grains, &row.case, row.aspect_ratio, &row.quantity)
        };
        all.iter_mut().filter(is_of).for_each(|one| one.measured.push(row.value));
    }
    Ok(all)
}

impl BlindComparison {
    /// Mean of the grains over the seeds; none without runs.
    pub fn mean(&self) -> Option<f64> {
        (!self.measured.is_empty()).then(|| self.measured.iter().sum::<f64>() / self.measured.len() as f64)
    }

    /// Standard deviation of the grains between seeds; none for fewer than two.
    pub fn scatter(&self) -> Option<f64> {
        scatter(self.measured.iter().copied(), 2).map(|(_, scatter)| scatter)
    }

    /// Error E: prediction minus mean of the grains.
    pub fn error(&self) -> Option<f64> {
        self.mean().map(|mean| self.value - mean)
    }

    /// Standard uncertainty of E as far as it is known, and whether all of it is: one seed tells no scatter.
    pub fn uncertainty(&self) -> (f64, bool) {
        let scatter = || self.scatter().map(|scatter| scatter / (self.measured.len() as f64).sqrt());
        let of_mean = self.u_measured.or_else(scatter);
        let known = [self.u_input, self.u_numerical, of_mean.unwrap_or(0.0)];
        (known.iter().map(|part| part * part).sum::<f64>().sqrt(), of_mean.is_some())
    }

    /// Verdict on the error.
    pub fn verdict(&self) -> &'static str {
        let (u_val, is_known) = self.uncertainty();
        match self.error() {
            None => "not run",
            Some(error) if error.abs() <= u_val => "validated to ± u_val",
            Some(_) if is_known => "model error",
            Some(_) => "beyond what is known",
        }
    }
}

/// Headings of [`table`].
pub const HEADINGS: [&str; 9] = [
    "collapse or slope",
    "quantity",
    "grains: mean ± scatter (runs)",
    "predicted ± u",
    "95 % interval",
    "E",
    "u_val",
    "verdict",
    "E of the nonlocal law",
];

/// The comparisons as a table: a row for each quantity, with the local law first and the nonlocal law's error last.
pub fn table(all: &[BlindComparison]) -> Vec<[String; 9]> {
    let share = |part: f64, whole: f64| format!("{} %", two_digits(100.0 * part / whole));
    let place = |one: &BlindComparison| {
        let aspect_ratio = one.aspect_ratio.map(|a| format!(" a = {a}")).unwrap_or_default();
        format!("{}, {}{aspect_ratio}", one.grains, one.case)
    };
    let error = |one: &BlindComparison| match (one.error(), one.mean()) {
        (Some(error), Some(mean)) => format!("{}{}", if error > 0.0 { "+" } else { "" }, share(error, mean)),
        _ => String::new(),
    };
    let is_same = |a: &BlindComparison, b: &BlindComparison| place(a) == place(b) && a.quantity == b.quantity;
    let row = |one: &BlindComparison| {
        let (u_val, _) = one.uncertainty();
        let u = (one.u_input * one.u_input + one.u_numerical * one.u_numerical).sqrt();
        let nonlocal = all.iter().find(|other| other.law == "nonlocal" && is_same(one, other));
        let measured = one.mean().map(|mean| {
            let scatter = one.scatter().map(|scatter| format!(" ± {}", two_digits(scatter))).unwrap_or_default();
            format!("{}{scatter} ({})", four_digits(mean), one.measured.len())
        });
        let interval = one.lower.zip(one.upper);
        [
            place(one),
            one.quantity.clone(),
            measured.unwrap_or_default(),
            format!("{} ± {}", four_digits(one.value), two_digits(u)),
            interval.map(|(low, high)| format!("{} … {}", four_digits(low), four_digits(high))).unwrap_or_default(),
            error(one),
            share(u_val, one.mean().unwrap_or(one.value)),
            one.verdict().to_owned(),
            nonlocal.map(error).unwrap_or_default(),
        ]
    };
    all.iter().filter(|one| one.law == "local").map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(measured: &[f64]) -> BlindComparison {
        let text = "grains,law,case,aspect_ratio,quantity,value,u_input,u_numerical,lower,upper\n\
                    discs,local,column-planar,0.5,run_out,1.5,0.03,0.04,1.0,\n";
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let mut one: BlindComparison = reader.deserialize().next().expect("a row").expect("a comparison");
        one.measured = measured.to_vec();
        one
    }

    #[test]
    fn error_and_uncertainty_are_those_of_the_standard() {
        let near = of(&[1.45, 1.55, 1.53]);
        assert!((near.error().expect("run") + 0.01).abs() < 1e-12);
        let scatter = near.scatter().expect("three seeds");
        assert!((scatter - 0.0028f64.sqrt()).abs() < 1e-12, "{scatter}");
        assert!((near.uncertainty().0 - (0.0025 + 0.0028f64 / 3.0).sqrt()).abs() < 1e-12);
        assert_eq!(near.verdict(), "validated to ± u_val");
        assert_eq!((near.lower, near.upper), (Some(1.0), None));
        assert_eq!(of(&[1.2, 1.21, 1.19]).verdict(), "model error");
        let rows = table(&[near]);
        assert_eq!(rows[0][0], "discs, column-planar a = 0.5");
        assert_eq!(rows[0][2..6], ["1.51 ± 0.053 (3)", "1.5 ± 0.05", "", "−0.66 %"]);
        assert_eq!((of(&[1.2]).verdict(), of(&[]).verdict()), ("beyond what is known", "not run"));
    }
}
