//! Manifest of a sweep: its runs, fixed once; every engine works from it.

use crate::ToolError;
use crate::case::Tier;
use crate::input::FieldError;
use crate::measured::Measurements;
use crate::metric::Variant;
use crate::output::Owner;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// One run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, Default)]
pub struct SweepRun {
    /// Number, from 1.
    pub number: usize,
    /// Name of the case.
    pub case: String,
    /// Label in the tables.
    pub label: String,
    /// Tier of the run.
    pub tier: Tier,
    /// Name of its folder below `runs`.
    pub folder: String,
    /// The parameters' values as TOML, in the manifest's order.
    pub point: Vec<String>,
    /// Key of the record; empty for a rejected run.
    pub key: String,
    /// Expected cost `[particle-steps]`.
    pub particle_steps: f64,
    /// Complete parameters.
    pub parameters_toml: String,
    /// Keys of the runs that are meant; all runs where there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub only: Vec<Variant>,
    /// Reason for the rejection of these parameters by the case.
    pub refusal: Option<String>,
}

/// All runs of a sweep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Manifest {
    /// Source hash of the program that wrote the manifest.
    pub source_hash: String,
    /// Names of the parameters.
    pub parameters: Vec<String>,
    /// Metrics to be drawn over the parameters; empty for the gated ones.
    pub metrics: Vec<String>,
    /// Measurements that the figures of a case are compared with, by its label.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub overlay: BTreeMap<String, Vec<Measurements>>,
    /// The runs by number.
    pub entries: Vec<SweepRun>,
}

impl Manifest {
    /// The entry of a number.
    ///
    /// # Errors
    /// A number that the manifest does not have.
    pub fn entry(&self, number: usize) -> Result<&SweepRun, ToolError> {
        self.entries.iter().find(|entry| entry.number == number).ok_or_else(|| {
            let rule = format!("between 1 and {}", self.entries.len());
            FieldError::new("--entry", number, &rule, "choose a run that manifest.json lists").into()
        })
    }
}

impl Owner for Manifest {
    const WHAT: &'static str = "sweep";
    const MARKER: &'static str = "manifest.json";

    fn is_foreign(&self) -> bool {
        !crate::store::is_of_this_program(&self.source_hash)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::Random;

    #[test]
    fn a_manifest_comes_back_to_the_bit() {
        let mut random = Random::new(3);
        let entry = |number: usize| SweepRun {
            number,
            case: "film".to_owned(),
            label: "film".to_owned(),
            tier: Tier::Quick,
            folder: format!("{number:04}-film"),
            point: vec!["0.1".to_owned()],
            key: String::new(),
            particle_steps: 1e7 * random.uniform() + random.uniform(),
            parameters_toml: String::new(),
            only: vec![Variant::of("fluid", "newtonian")],
            refusal: None,
        };
        let manifest = Manifest {
            source_hash: String::new(),
            parameters: vec!["viscosity".to_owned()],
            metrics: Vec::new(),
            overlay: BTreeMap::new(),
            entries: (1..=1000).map(entry).collect(),
        };
        let text = serde_json::to_string(&manifest).expect("writable");
        assert_eq!(serde_json::from_str::<Manifest>(&text).expect("readable"), manifest);
    }
}
