//! Controls of a study: changes of its parameters that its checks must reject.

use super::Study;
use crate::case::{CaseResult, Limits, ParameterError, PreparedCase, Registry, Tier, twice_given};
use crate::control::{Answer, Control};
use crate::input::{FieldError, check_name, check_text};
use crate::metric::{Limit, Metric, Variant};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toml::Table;

/// Wrong physics or a wrong input that checks must reject.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct ControlText {
    /// Name of the negative control.
    pub(super) name: String,
    /// Wrong values by the dotted paths of parameters.
    #[schemars(with = "std::collections::BTreeMap<String, serde_json::Value>")]
    pub(super) set: Table,
    /// The error in words.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub(super) error: String,
    /// Names of the checks that must reject it.
    pub(super) rejects: Vec<String>,
}

impl ControlText {
    /// Control in the form that cases have.
    pub(super) fn control(&self) -> Control {
        let set = self.set.iter().map(|(path, value)| format!("{path}={value}")).collect();
        let error = if self.error.is_empty() { self.name.replace(['-', '_'], " ") } else { self.error.clone() };
        let rejected_by = self.rejects.clone();
        Control { name: self.name.clone(), error, set, rejected_by, ..Control::default() }
    }
}

/// Rejects controls without a change or without a check that could reject them; `judged` holds the names of checks with a limit.
pub(super) fn check(controls: &[ControlText], judged: &[&str]) -> Result<(), FieldError> {
    for (place, control) in controls.iter().enumerate() {
        let field = |name: &str| format!("controls[{place}].{name}");
        let name = &control.name;
        check_name(&field("name"), name)?;
        check_text(&field("error"), &control.error)?;
        if controls[..place].iter().any(|other| other.name == *name) {
            return Err(FieldError::new(&field("name"), name, "unique", "give each a name of its own"));
        }
        if control.set.is_empty() {
            let remedy = "name a parameter and its wrong value, such as { \"material.viscosity\" = 2.0 }";
            return Err(FieldError::finding(&field("set"), "no changes", remedy));
        }
        let unknown = control.rejects.iter().find(|own| !judged.contains(&own.as_str()));
        if control.rejects.is_empty() || unknown.is_some() {
            let value = unknown.map_or_else(|| "empty".to_owned(), |name| format!("\"{name}\""));
            let remedy = match judged.first() {
                Some(name) => format!("name one, such as \"{name}\""),
                None => "give a check a limit, such as `at_most`".to_owned(),
            };
            return Err(FieldError::new(&field("rejects"), value, "names of checks with a limit", &remedy));
        }
    }
    Ok(())
}

impl Study {
    /// The study without its controls, for a report that runs them as those of cases.
    pub(super) fn without_controls(mut self) -> Self {
        self.text.controls.clear();
        self
    }

    /// The controls as a case has them.
    pub(super) fn controls(&self) -> Vec<Control> {
        self.text.controls.iter().map(ControlText::control).collect()
    }

    /// The cases of all controls, each with all variants.
    pub(super) fn prepare_controls(
        &self,
        registry: Registry,
        tier: Option<Tier>,
        settings: &[String],
        limits: Limits,
    ) -> Result<Vec<Box<dyn PreparedCase>>, ParameterError> {
        let mut all = Vec::new();
        for (place, control) in self.controls().into_iter().enumerate() {
            let set = control.set;
            for (setting, (path, _)) in set.iter().zip(&self.text.controls[place].set) {
                let remedy = "set a parameter that no variant sets".into();
                let of_control = |error: FieldError| {
                    let field = format!("controls[{place}].set.{path}");
                    FieldError { field, remedy, ..error }.in_file(&self.file)
                };
                self.refuse_varied(setting).map_err(of_control)?;
                if let Some(given) = settings.iter().find(|given| twice_given(setting, given).is_some()) {
                    let control = format!("control `{}` in {}", control.name, self.file.display());
                    let rule = format!("of another parameter, because {control} sets `{path}` to a wrong value");
                    let remedy = "remove that control in a copy of the study";
                    return Err(FieldError::new("--set", given, &rule, remedy).into());
                }
            }
            // without the control's changes the same variants have been prepared
            let cases = self.prepare_variants(registry, tier, &[settings, &set[..]].concat(), limits);
            all.extend(cases.map_err(|error| error.in_plan(&self.file))?);
        }
        Ok(all)
    }

    /// One metric for each check that a control names: 1 if the check rejects the control, 0 if it accepts it. A check that fails
    /// on the right run is left out.
    pub(super) fn rejections(&self, right: &CaseResult, place: usize, wrong: &CaseResult) -> Vec<Metric> {
        let control = self.text.controls[place].control();
        let name = control.name.clone();
        let trial = wrong.trial(control, right);
        let own = right.metrics.iter().filter(|metric| trial.control.rejected_by.contains(&metric.name));
        let number = |metric: &Metric| {
            let rejected = match trial.answer(metric)? {
                Answer::Rejects | Answer::NotJudged => 1.0,
                Answer::Accepts => 0.0,
                Answer::Nothing => return None,
            };
            let variant =
                Variant::of("control", name.as_str()).and("check", metric.name.as_str()).followed_by(&metric.variant);
            let reason = "1: a check that passes with a known error cannot judge the correct run";
            let judged =
                Metric::observed("rejects_control", &variant, rejected, "-").gated(Limit::AtLeast(1.0), reason);
            Some(judged.exactly(1.0, "the negative control contains a known error").of_user())
        };
        own.filter_map(number).collect()
    }
}
