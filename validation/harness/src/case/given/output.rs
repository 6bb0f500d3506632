//! States that a run shows on its way, for other programs to look at: `[output]` in a case file.

use crate::input::{FieldError, did_you_mean, nearest};
use crate::observation::Frame;
use serde::Deserialize;
use std::path::Path;

/// Quantities of a state that can be written, of both models; a case without a quantity leaves it out.
pub const OUTPUT_FIELDS: [&str; 12] = [
    "id",
    "mass",
    "density",
    "pressure",
    "velocity",
    "shear_stress",
    "shear_rate",
    "inertial_number",
    "stress_ratio",
    "mobilised",
    "concentration",
    "phase",
];

/// Selection of the states that a run writes.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub struct OutputPlan {
    /// Time between two states `[s]`.
    pub every: f64,
    /// Quantities of the particles; all where none are named.
    #[serde(default)]
    pub fields: Vec<String>,
}

/// Receives states during one run.
pub trait StateOutput: Sync {
    /// Whether one is wanted at a time `[s]`.
    fn is_due(&self, time: f64) -> bool;
    /// Takes one: what flows, and the walls if they have particles.
    fn take(&self, pictures: (Frame, Option<Frame>));
}

impl OutputPlan {
    /// A plan of checked values.
    ///
    /// # Errors
    /// An interval that is no positive number, quantities that are unknown.
    pub fn new(every: f64, fields: Vec<String>) -> Result<Self, FieldError> {
        if !(every > 0.0 && every.is_finite()) {
            let remedy = "give the time between two states in seconds, such as every = 0.01";
            return Err(FieldError::new("output.every", every, "a positive number", remedy));
        }
        if let Some(unknown) = fields.iter().find(|field| !OUTPUT_FIELDS.contains(&field.as_str())) {
            let guess = did_you_mean(&nearest(unknown, OUTPUT_FIELDS));
            let rule = format!("one of {}", OUTPUT_FIELDS.join(", "));
            return Err(FieldError::new(
                "output.fields",
                format!("\"{unknown}\""),
                &rule,
                &format!("{guess}leave `fields` out to write all"),
            ));
        }
        Ok(Self { every, fields })
    }

    /// The same as the table of a case file.
    pub fn text(&self) -> String {
        let fields = if self.fields.is_empty() { String::new() } else { format!("fields = {:?}\n", self.fields) };
        format!("[output]\nevery = {:?}\n{fields}", self.every)
    }

    /// Removes the table from the fields of a case file and returns it.
    ///
    /// # Errors
    /// Errors of [`OutputPlan::new`]; other keys, and values of another type.
    pub(in crate::case) fn taken(fields: &mut toml::Table, path: &Path) -> Result<Option<Self>, FieldError> {
        let Some(given) = fields.remove("output") else { return Ok(None) };
        let plan = given.clone().try_into().map_err(|error: toml::de::Error| {
            let remedy = format!("write output = {{ every = 0.01 }} ({})", error.message());
            FieldError::new("output", given, "a table with `every` and `fields`", &remedy)
        });
        let plan = plan.and_then(|plan: Self| Self::new(plan.every, plan.fields));
        plan.map(Some).map_err(|error| error.in_file(path))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taken(text: &str) -> Result<Option<OutputPlan>, String> {
        let mut fields: toml::Table = toml::from_str(text).expect("TOML");
        OutputPlan::taken(&mut fields, Path::new("case.toml")).map_err(|error| error.to_string())
    }

    #[test]
    fn a_plan_is_read_back_from_its_text() {
        assert_eq!(taken("depth = 1.0"), Ok(None));
        let plan = OutputPlan::new(0.01, vec!["id".to_owned(), "velocity".to_owned()]).expect("a plan");
        assert_eq!(taken(&plan.text()), Ok(Some(plan)));
        let all = OutputPlan { every: 2.0, fields: Vec::new() };
        assert_eq!(taken("output = { every = 2 }"), Ok(Some(all)));
    }

    #[test]
    fn invalid_plan_is_refused() {
        for (text, expected) in [
            (
                "output = 3",
                "case.toml: `output` is 3, but must be a table with `every` and `fields`; write output = { every = 0.01 } (invalid type: integer `3`, expected a table)",
            ),
            (
                "output = { every = -1 }",
                "case.toml: `output.every` is -1, but must be a positive number; give the time between two states in seconds, such as every = 0.01",
            ),
            (
                "output = { }",
                "case.toml: `output` is {}, but must be a table with `every` and `fields`; write output = { every = 0.01 } (missing field `every`)",
            ),
            (
                "output = { evry = 1 }",
                "case.toml: `output` is { evry = 1 }, but must be a table with `every` and `fields`; write output = { every = 0.01 } (unknown field `evry`, expected `every` or `fields`)",
            ),
        ] {
            assert_eq!(taken(text), Err(expected.to_owned()));
        }
        let message = taken("output = { every = 1, fields = [\"presure\"] }").expect_err("unknown");
        assert!(
            message.starts_with("case.toml: `output.fields` is \"presure\", but must be one of id, mass,"),
            "{message}"
        );
        assert!(message.ends_with("did you mean `pressure`? leave `fields` out to write all"), "{message}");
    }
}
