//! An earlier report's folder as the baseline of a new one.

use super::baseline::{Baseline, MetricKey};
use super::error::EarlierError;
use crate::case::Tier;
use crate::figure::is_file_name;
use crate::input::{DOCUMENT, read_text};
use crate::result::MetricsDocument;
use std::path::Path;

impl Baseline {
    /// The values that a report's folder holds of some cases, as its `cases/CASE/metrics.json` have them. Cases that it
    /// does not hold have nothing to be compared with.
    ///
    /// # Errors
    /// If it holds none of them, one cannot be read, or one is of another tier.
    pub fn of_report(folder: &Path, cases: &[String], tier: Tier) -> Result<Self, EarlierError> {
        let mut baseline = Self::default();
        let mut found = false;
        for case in cases.iter().filter(|case| is_file_name(case)) {
            let path = folder.join("cases").join(case).join("metrics.json");
            let text = match read_text(&path, DOCUMENT) {
                Ok(text) => text,
                Err(error) if error.kind() == std::io::ErrorKind::NotFound => continue,
                Err(source) => return Err(EarlierError::Read { path, source }),
            };
            let refuse = |message: String| EarlierError::Content { path: path.clone(), message };
            let document: MetricsDocument = serde_json::from_str(&text).map_err(|error| refuse(error.to_string()))?;
            if document.tier != tier {
                let (its, own) = (document.tier.name(), tier.name());
                return Err(refuse(format!("it is of the {its} tier, not of the {own} tier")));
            }
            found = true;
            baseline.made_at(case, &document.provenance.commit);
            for entry in document.metrics {
                let key = MetricKey { case: case.clone(), metric: entry.name, variant: entry.variant };
                // JSON has no word for what is not a finite number
                baseline.add(key, entry.value.unwrap_or(f64::NAN), &entry.unit, entry.verdict);
            }
        }
        if found {
            Ok(baseline)
        } else {
            let message = "it holds none of the cases".to_owned();
            Err(EarlierError::Content { path: folder.join("cases"), message })
        }
    }
}
