//! Studies of grains in a league: what a law of their slopes predicts, beside the values of the grains.
//!
//! Errors and uncertainties are those of ASME V&V 20. In the blind study the seeds of the grains follow from the digest of the
//! prediction, so nobody can have known the collapses when it was made.

use super::scatter;
use crate::ToolError;
use crate::number::{four_digits, two_digits};
use crate::output::FileError;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use std::path::Path;

/// Folder of collapses predicted from the friction of grains on slopes before the grains collapsed.
pub const BLIND: &str = "blind";
/// Folder of the friction of the same grains in two codes, on slopes and between walls.
pub const FRICTION: &str = "friction";

/// A predicted quantity with the values of the grains.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct GrainComparison {
    /// `discs` or `spheres`, or the code that ran discs.
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
    /// Predicted value; that of the blind study was written before the measurement was known.
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

/// Reads a study of a league by its folder, if the league has it.
///
/// # Errors
/// Tables that cannot be read.
pub fn read(league: &Path, study: &str) -> Result<Vec<GrainComparison>, ToolError> {
    let folder = league.join(study).join("results");
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let mut all: Vec<GrainComparison> = rows(&folder.join("prediction.csv"))?;
    for row in rows::<Measured>(&folder.join("measured.csv"))? {
        let is_of = |one: &&mut GrainComparison| {
            (&one.grains, &one.case, one.aspect_ratio, &one.quantity)
                == (&row.grains, &row.case, row.aspect_ratio, &row.quantity)
        };
        all.iter_mut().filter(is_of).for_each(|one| one.measured.push(row.value));
    }
    Ok(all)
}

impl GrainComparison {
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

/// Rows of [`FRICTION`] to which its law was fitted.
const FITTED: &str = "LAMMPS, slope";

/// A study with its rows, as pages show it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Study {
    /// Folder in the league.
    pub name: &'static str,
    /// Heading.
    pub title: &'static str,
    /// What was done.
    pub about: &'static str,
    /// What the columns mean.
    pub columns: &'static str,
    /// Headings of the columns.
    pub headings: Vec<&'static str>,
    /// Cells, row by row.
    pub rows: Vec<Vec<String>>,
}

/// The studies that a league has.
///
/// # Errors
/// Tables that cannot be read.
pub fn studies(league: &Path) -> Result<Vec<Study>, ToolError> {
    let blind = Study {
        name: BLIND,
        title: "Blind predictions of collapses of grains",
        about: "The friction of discs and spheres was measured on steady slopes and fitted by μ(I). Bagnold predicted their \
            collapses from this fit. The seeds of the collapses follow from the digest of the stored prediction, so the collapses \
            ran after it. The columns of discs with a = 1 and 3 were known from earlier trials with another fit.",
        columns: "E is the prediction minus the mean of the grains, over that mean. u contains the measured friction and the \
            particle spacing, u_val also the mean of the grains. The 95 % interval contains the model errors of other comparisons.",
        headings: HEADINGS.to_vec(),
        rows: table(&read(league, BLIND)?).into_iter().map(Vec::from).collect(),
    };
    // intervals and a nonlocal law are those of collapses
    let own = |row: &[String; 9]| {
        let mut cells = [0, 2, 3, 5, 6, 7].map(|k| row[k].clone()).to_vec();
        if cells[0].starts_with(FITTED) {
            cells[5] = "fitted".to_owned();
        }
        cells
    };
    let friction = Study {
        name: FRICTION,
        title: "Friction of the same discs in two codes and two geometries",
        about: "LAMMPS and YADE ran the same discs on slopes and between bumpy walls that press and shear them, each with three \
            seeds. μ(I) was fitted to the slopes of LAMMPS only.",
        columns: "Each row compares friction at the mean inertial number I of its seeds. E is the law minus the mean of the \
            grains, over that mean. u is the uncertainty of the fitted law, u_val contains also that of the mean.",
        headings: vec!["code and flow", "friction: mean ± scatter (runs)", "law ± u", "E", "u_val", "verdict"],
        rows: table(&read(league, FRICTION)?).iter().map(own).collect(),
    };
    Ok([blind, friction].into_iter().filter(|study| !study.rows.is_empty()).collect())
}

const HEADINGS: [&str; 9] = [
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
fn table(all: &[GrainComparison]) -> Vec<[String; 9]> {
    let share = |part: f64, whole: f64| format!("{} %", two_digits(100.0 * part / whole));
    let place = |one: &GrainComparison| {
        let aspect_ratio = one.aspect_ratio.map(|a| format!(" a = {a}")).unwrap_or_default();
        format!("{}, {}{aspect_ratio}", one.grains, one.case)
    };
    let error = |one: &GrainComparison| match (one.error(), one.mean()) {
        (Some(error), Some(mean)) => format!("{}{}", if error > 0.0 { "+" } else { "" }, share(error, mean)),
        _ => String::new(),
    };
    let is_same = |a: &GrainComparison, b: &GrainComparison| place(a) == place(b) && a.quantity == b.quantity;
    let row = |one: &GrainComparison| {
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

    fn of(measured: &[f64]) -> GrainComparison {
        let text = "grains,law,case,aspect_ratio,quantity,value,u_input,u_numerical,lower,upper\n\
                    discs,local,column-planar,0.5,run_out,1.5,0.03,0.04,1.0,\n";
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let mut one: GrainComparison = reader.deserialize().next().expect("a row").expect("a comparison");
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
