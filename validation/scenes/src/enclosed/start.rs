//! Start from a state that a run of a scene has left.

use super::flow::{Dimension, SceneFlow, SceneStart};
use crate::case::ParameterError;
use crate::checkpoint::{BULK_MODULUS, Likeness, StoredState};
use crate::store::source_hash;
use serde_json::Value;
use std::path::Path;

impl<S: Dimension<D>, const D: usize> SceneFlow<S, D> {
    /// The state that the scene starts from, where it names one.
    ///
    /// # Errors
    /// A file that holds no state of such a scene.
    pub(super) fn stored_state(&self) -> Result<Option<StoredState>, ParameterError> {
        let Some(SceneStart { file, sha256, .. }) = &self.from else { return Ok(None) };
        let refused = |defect: String| {
            let remedy = "give the file of a state that `bagnold run` names after a run of a scene";
            ParameterError::field("from.file", format!("\"{file}\": {defect}"), "", remedy)
        };
        let state = StoredState::read(Path::new(file)).map_err(refused)?;
        if state.digest != *sha256 {
            let rule = format!("{}, the digest of {file}", state.digest);
            let remedy = "find the original file, or give this digest";
            return Err(ParameterError::field("from.sha256", sha256, &rule, remedy));
        }
        match state.difference(&self.likeness()).map_err(refused)? {
            Some([field, value, rule]) => {
                let rule = format!("{rule}, as in the state");
                Err(ParameterError::field(&field, value, &rule, "restore it, or start from another state"))
            }
            None => Ok(Some(state)),
        }
    }

    /// Properties that a state of the scene has in common with every scene that starts from it.
    pub(super) fn likeness(&self) -> Likeness {
        let mut likeness = vec![
            ("program".to_owned(), source_hash().get(..16).unwrap_or_default().to_owned()),
            ("axes".to_owned(), D.to_string()),
            ("bulk density".to_owned(), self.bulk.density(&self.material).to_string()),
            ("material.law".to_owned(), self.material.name().to_owned()),
        ];
        let whole = serde_json::to_value(self).unwrap_or_default();
        likeness.push(("stiffness".to_owned(), format!("{:?}", self.stiffness())));
        for field in ["spacing", "tension", "sides", "inlets", "numerics"] {
            add_leaves(field, &whole[field], &mut likeness);
        }
        likeness.push((BULK_MODULUS.to_owned(), self.equation_of_state().bulk_modulus.to_string()));
        likeness
    }
}

/// Adds the values within a value, by their paths.
fn add_leaves(path: &str, value: &Value, leaves: &mut Likeness) {
    match value {
        Value::Object(fields) => {
            fields.iter().for_each(|(name, part)| add_leaves(&format!("{path}.{name}"), part, leaves))
        }
        Value::Array(parts) => {
            parts.iter().enumerate().for_each(|(k, part)| add_leaves(&format!("{path}[{k}]"), part, leaves));
        }
        value => leaves.push((path.to_owned(), value.to_string())),
    }
}
