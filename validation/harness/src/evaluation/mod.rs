//! One case with some of its parameters changed, simulated and judged: what sweeps and calibrations are made of.
//!
//! An evaluation is a file, written whole or not at all, and known by its [`key`]: what the program computes with, the
//! case, its tier, all its parameters and the runs that are meant. Whoever finds the file need not simulate.

mod paths;
mod plan;
mod record;
mod sensitivity;

pub use paths::Paths;
pub use plan::{parse_plan, read_plan};
pub use record::{EvaluationRecord, MetricValue};
pub use sensitivity::SensitivityPlan;

use crate::case::{CaseFile, Changes, Limits, Monitor, ParameterError, PreparedCase, Registry, Tier, execute};
use crate::input::MeasuredFiles;
use crate::measured::{Measurements, draw_measured};
use crate::metric::Variant;
use crate::store::{Store, hash_of_parts, identity_or_unique};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::panic::AssertUnwindSafe;
use std::path::{Path, PathBuf};

/// A case and the changes of its tier's parameters.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CaseRequest {
    /// Case that is run; may be left out beside `base`
    #[serde(default)]
    pub case: String,
    /// A case file with the base values, beside the plan
    pub base: Option<PathBuf>,
    /// Name that distinguishes it from other requests of the same case
    pub name: Option<String>,
    /// Tier that supplies parameters missing in `with`
    pub tier: Option<Tier>,
    /// Files with measurements that its figures are compared with
    #[serde(default)]
    pub overlay: Vec<MeasuredFiles>,
    /// Parameters, as in a case file
    #[serde(default)]
    #[schemars(with = "std::collections::BTreeMap<String, serde_json::Value>")]
    pub with: toml::Table,
    /// Runs that are needed, as `key=value`; all of the case, if it is left out
    #[serde(default)]
    #[schemars(with = "Vec<String>")]
    pub only: Vec<Variant>,
}

/// A number as TOML writes it, with all its digits: the value of a setting.
pub fn toml_number(value: f64) -> String {
    toml::Value::Float(value).to_string()
}

impl CaseRequest {
    /// Label of the request in tables.
    pub fn label(&self) -> &str {
        self.name.as_deref().unwrap_or(&self.case)
    }

    /// Request with the values of its base file, and with files relative to the plan.
    ///
    /// # Errors
    /// Neither a case nor a base, a file that cannot be read.
    pub fn based(self, plan: &Path) -> Result<Self, ParameterError> {
        let case = Some(&*self.case).filter(|case| !case.is_empty());
        let file = CaseFile::of_plan(plan, case, self.base.as_deref(), self.tier, &self.with)?;
        let beside = plan.parent().unwrap_or(Path::new(""));
        let own = self.overlay.iter().map(|files| files.beside(beside));
        let overlay = file.overlay.into_iter().chain(own).collect();
        Ok(Self { case: file.case, base: None, tier: file.tier, overlay, with: file.fields, ..self })
    }

    /// Types and checks the parameters, `settings` (`path=value`) over what the file gives, and what they ask for.
    ///
    /// # Errors
    /// An unknown case, or the first field that is unknown, of the wrong type, or breaks a rule.
    pub fn prepare(
        &self,
        registry: Registry,
        file: &Path,
        settings: &[String],
        limits: Limits,
    ) -> Result<Box<dyn PreparedCase>, ParameterError> {
        let case = registry.find(&self.case).map_err(|error| error.in_file(file))?;
        let changes = Changes { file: Some((file, self.with.clone())), settings, limits, only: &self.only };
        chosen(case.prepare(self.tier.unwrap_or_default(), &changes)?, &self.only, file)
    }
}

/// Runs that `only` of a plan selects.
///
/// # Errors
/// Runs that the case does not have.
pub fn chosen(
    prepared: Box<dyn PreparedCase>,
    only: &[Variant],
    file: &Path,
) -> Result<Box<dyn PreparedCase>, ParameterError> {
    crate::case::only(prepared, only, "only").map_err(|error| error.in_file(file))
}

/// The hash that an evaluation is known by, with what its figures are compared with: 32 hexadecimal digits.
pub fn key(prepared: &dyn PreparedCase, overlay: &[Measurements]) -> String {
    let variants: Vec<String> = (0..prepared.run_count()).map(|run| prepared.variant(run).to_string()).collect();
    let runs = variants.join("\n");
    let parts = [identity_or_unique(prepared.origin()), prepared.name(), prepared.parameters_toml(), &runs];
    hash_of_parts(parts.into_iter().chain(overlay.iter().map(|own| &*own.text)))[..32].to_owned()
}

/// Simulates and judges on the current rayon pool's threads. Parameters that give no scene, a run that diverges and one
/// that panics are records too, with the reason.
///
/// # Errors
/// Errors unrelated to the parameters, such as threads that cannot be started.
pub fn evaluate(
    prepared: Box<dyn PreparedCase>,
    overlay: &[Measurements],
    store: &Store,
    monitor: &dyn Monitor,
) -> Result<EvaluationRecord, ParameterError> {
    let key = key(prepared.as_ref(), overlay);
    let case = prepared.name().to_owned();
    let simulate = AssertUnwindSafe(|| {
        let mut results = execute(vec![prepared], store, monitor)?;
        results.iter_mut().try_for_each(|result| draw_measured(result, overlay))?;
        Ok(results)
    });
    let failed = |reason: &str| EvaluationRecord::failed(&key, &case, reason);
    match std::panic::catch_unwind(simulate) {
        Ok(Ok(results)) => Ok(results
            .first()
            .map_or_else(|| failed("nothing was simulated"), |result| EvaluationRecord::of(&key, result))),
        Ok(Err(error @ (ParameterError::Field(_) | ParameterError::Scene(_) | ParameterError::Changed { .. }))) => {
            Ok(failed(&error.to_string()))
        }
        Ok(Err(error)) => Err(error),
        Err(_) => Ok(failed("a run panicked, which is an error of the program; please report it")),
    }
}
