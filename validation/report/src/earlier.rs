//! An earlier report's folder as the baseline of a new one.

use super::baseline::{Baseline, MetricKey};
use super::error::read_if_there;
use crate::case::{ParameterError, Tier};
use crate::figure::is_file_name;
use crate::input::{DOCUMENT, FieldError, shown};
use crate::result::MetricsDocument;
use std::path::Path;

impl Baseline {
    /// The values that a report's folder holds of some cases, as its `cases/CASE/metrics.json` have them. Cases that it
    /// does not hold have nothing to be compared with.
    ///
    /// # Errors
    /// If it holds none of them, one cannot be read, or one is of another tier.
    pub fn of_report(folder: &Path, cases: &[String], tier: Tier) -> Result<Self, ParameterError> {
        let mut baseline = Self::default();
        let refused = |path: &Path, defect: &str| {
            let remedy = "give the folder of an earlier report of the same tier and cases";
            FieldError::finding("--against", format!("{}: {defect}", shown(path)), remedy)
        };
        let mut found = false;
        for case in cases.iter().filter(|case| is_file_name(case)) {
            let path = folder.join("cases").join(case).join("metrics.json");
            let Some(text) = read_if_there(&path, DOCUMENT)? else { continue };
            let document: MetricsDocument =
                serde_json::from_str(&text).map_err(|error| refused(&path, &error.to_string()))?;
            if document.tier != tier {
                let (its, own) = (document.tier.name(), tier.name());
                return Err(refused(&path, &format!("a report of the {its} tier, not of the {own} tier")).into());
            }
            found = true;
            baseline.made_at(case, &document.provenance.commit);
            for entry in document.metrics {
                let key = MetricKey { case: case.clone(), metric: entry.name, variant: entry.variant };
                // JSON has no word for what is not a finite number
                baseline.add(key, entry.value.unwrap_or(f64::NAN), &entry.unit, entry.verdict);
            }
        }
        if !found {
            return Err(refused(&folder.join("cases"), "no results of the selected cases").into());
        }
        Ok(baseline)
    }
}
