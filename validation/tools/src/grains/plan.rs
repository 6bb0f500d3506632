//! Plan of `bagnold grains`: runs of a grain code with their geometry, files and columns.

use crate::ToolError;
use crate::case::ExternalColumn;
use crate::evaluation::read_plan;
use crate::input::{FieldError, check_name};
use crate::judge::ParticleFiles;
use bagnold_solver::parameter::{inside, positive, range_problem};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Columns of grains; the first five are needed, the next two with contacts.
pub(super) const GRAINS: &[ExternalColumn] = &[
    ExternalColumn::new("y", "m", "height above the bed"),
    ExternalColumn::new("vx", "m/s", "velocity along the flow, down a slope"),
    ExternalColumn::new("vy", "m/s", "velocity away from the bed"),
    ExternalColumn::new("radius", "m", "radius"),
    ExternalColumn::new("density", "kg/m^3", "density of the grain's material"),
    ExternalColumn::new("x", "m", "place along the flow"),
    ExternalColumn::new("id", "-", "number, by which contacts name the grain"),
    ExternalColumn::new("kind", "-", "number of the kind"),
];

/// Columns of contacts; the first four are needed.
pub(super) const CONTACTS: &[ExternalColumn] = &[
    ExternalColumn::new("first", "-", "id of the grain that feels the force"),
    ExternalColumn::new("second", "-", "id of the other grain"),
    ExternalColumn::new("fx", "N", "force on the first grain along the flow"),
    ExternalColumn::new("fy", "N", "force on the first grain over the depth"),
    ExternalColumn::new("tx", "N", "tangential force beside a normal one, along the flow"),
    ExternalColumn::new("ty", "N", "tangential force beside a normal one, over the depth"),
];

/// Runs of a grain code that are averaged over the depth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrainPlan {
    /// The file.
    #[serde(skip)]
    pub path: PathBuf,
    /// Subject, one line
    pub title: String,
    /// Largest range of the velocity between windows over its mean, 0.1 if it is left out `[-]`
    #[schemars(transform = inside(0.0, 1.0, "0.1 is usual"))]
    pub steady_within: Option<f64>,
    /// Runs
    #[serde(rename = "run")]
    pub runs: Vec<GrainRun>,
}

/// A steady layer on a slope or in a shear cell, periodic along the flow and across it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrainRun {
    /// Name in tables and figures
    pub name: String,
    /// Slope `[°]`; absent for a shear cell
    #[schemars(transform = inside(0.0, 90.0, "give degrees"))]
    pub slope_angle: Option<f64>,
    /// Gravity on a slope, 9.81 if it is left out `[m/s²]`
    #[schemars(transform = positive("give it in m/s²"))]
    pub gravity: Option<f64>,
    /// Pressure on a shear cell; absent on a slope `[Pa]`
    #[schemars(transform = positive("give it in Pa"))]
    pub pressure: Option<f64>,
    /// Shear stress on a shear cell; needed without contacts `[Pa]`
    #[schemars(transform = positive("give it in Pa"))]
    pub shear_stress: Option<f64>,
    /// Period along the flow `[m]`
    #[schemars(transform = positive("give it in metres"))]
    pub length: f64,
    /// Period across the flow of spheres; without it grains are discs, per metre of width `[m]`
    #[schemars(transform = positive("give the depth of the cell in metres"))]
    pub width: Option<f64>,
    /// Kinds that flow, of the column `kind`; all if it is left out
    #[serde(default)]
    pub kinds: Vec<f64>,
    /// Diameter of a mixture in the inertial number; the mean of the grains if it is left out `[m]`
    #[schemars(transform = positive("give it in metres"))]
    pub grain_diameter: Option<f64>,
    /// Files of the grains
    pub particles: ParticleFiles,
    /// Files of the contacts at the same times
    pub contacts: Option<ParticleFiles>,
}

impl GrainPlan {
    /// Reads a plan; the files that it names are read later.
    ///
    /// # Errors
    /// A file that cannot be read, is not TOML, or breaks a rule.
    pub fn read(path: &Path) -> Result<Self, ToolError> {
        let plan: Self = read_plan(path, "bagnold grains")?;
        plan.check().map_err(|error| error.in_file(path))?;
        Ok(Self { path: path.to_owned(), ..plan })
    }

    fn check(&self) -> Result<(), FieldError> {
        if let Some(problem) = range_problem(self) {
            return Err(FieldError::new(&problem.field, problem.value, &problem.rule, &problem.remedy));
        }
        let run =
            |(place, run): (usize, &GrainRun)| run.check().map_err(|error| error.within(&format!("run[{place}]")));
        self.runs.iter().enumerate().try_for_each(run)
    }
}

impl GrainRun {
    fn check(&self) -> Result<(), FieldError> {
        check_name("name", &self.name)?;
        if self.slope_angle.is_some() == self.pressure.is_some() {
            let remedy = "give `slope_angle` for a slope, or `pressure` for a shear cell";
            return Err(FieldError::finding("slope_angle", "missing, or given together with `pressure`", remedy));
        }
        if self.pressure.is_some() && self.shear_stress.is_none() && self.contacts.is_none() {
            let remedy = "give the shear stress [Pa] measured at a plate, or give `contacts`";
            return Err(FieldError::finding("shear_stress", "missing", remedy));
        }
        needed(&self.particles, &GRAINS[..if self.contacts.is_some() { 7 } else { 5 }])?;
        if !self.kinds.is_empty() {
            needed(&self.particles, &GRAINS[7..])?;
        }
        let of_contacts =
            |error: FieldError| FieldError { field: error.field.replace("particles", "contacts"), ..error };
        self.contacts.as_ref().map_or(Ok(()), |files| needed(files, &CONTACTS[..4]).map_err(of_contacts))
    }
}

/// Refuses files without a column that is needed.
fn needed(files: &ParticleFiles, items: &[ExternalColumn]) -> Result<(), FieldError> {
    files.check()?;
    let missing = items.iter().find(|item| !files.columns.contains_key(item.name));
    missing.map_or(Ok(()), |ExternalColumn { name, unit, description }| {
        let remedy = format!("dump the {description}, and name it as {name} = \"HEADING [{unit}]\"");
        Err(FieldError::finding(&format!("particles.columns.{name}"), "missing", &remedy))
    })
}
