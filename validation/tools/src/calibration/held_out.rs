//! Judgement of a calibration on what was held out, as its folder keeps it and a report shows it.

use super::data::DatumText;
use super::plan::CalibrationPlan;
use super::result::{CalibrationResult, DatumComparison};
use crate::evidence::{HeldOutDatum, HeldOutJudgement};
use crate::input::{WRITTEN_BY_HAND, read_text};
use crate::number::four_digits;
use crate::output::FileError;
use crate::store::{hexadecimal, provenance};
use sha2::{Digest, Sha256};
use std::path::Path;

/// Digits of a digest.
const DIGITS: usize = 8;

impl CalibrationPlan {
    /// First digits of the SHA-256 of the plan and of the data files that it names, in their order.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn digest(&self) -> Result<String, FileError> {
        let folder = self.file.parent().unwrap_or_else(|| Path::new(""));
        let files =
            self.blocks.iter().flat_map(|block| &block.data).flat_map(DatumText::files).map(|file| folder.join(file));
        let mut digest = Sha256::new();
        for file in std::iter::once(self.file.clone()).chain(files) {
            digest.update(read_text(&file, WRITTEN_BY_HAND).map_err(|error| FileError::unreadable(&file, &error))?);
        }
        Ok(hexadecimal(&digest.finalize())[..DIGITS].to_owned())
    }
}

impl DatumComparison {
    /// Deviation over the standard uncertainties of datum and prediction together `[-]`.
    pub(super) fn deviation(&self) -> f64 {
        self.residual / libm::sqrt(1.0 + self.spread * self.spread)
    }
}

/// The judgement; none where nothing was held out, or where choices are ranked.
pub(super) fn judged(outcome: &CalibrationResult, digest: String) -> Option<HeldOutJudgement> {
    let datum = |datum: &DatumComparison| HeldOutDatum {
        quantity: datum.label.clone(),
        unit: datum.unit.clone(),
        datum: [datum.band.0, datum.datum, datum.band.1],
        model: datum.model,
        predicted: datum.predicted,
        spread: datum.spread,
        deviation: datum.deviation(),
        source: datum.source.clone(),
    };
    let parameters = outcome.parameters.iter().map(|found| {
        let unit = if found.unit == "-" { String::new() } else { format!(" {}", found.unit) };
        format!("{} {}{unit}, 95 %: {}", found.name, four_digits(found.best), found.intervals_in_words(four_digits))
    });
    (!outcome.hold_out.is_empty()).then(|| HeldOutJudgement {
        title: outcome.title.clone(),
        digest,
        made_by: format!("{}, {}", provenance::version(), provenance::commit()),
        values: outcome.parameters.iter().map(|found| found.best).collect(),
        parameters: parameters.collect(),
        findings: outcome.findings.clone(),
        data: outcome.hold_out.iter().map(datum).collect(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uncertain_parameters_excuse_a_deviation() {
        let off = |spread: f64| {
            let datum = DatumComparison {
                block: "hold_out[0]".to_owned(),
                label: "run_out".to_owned(),
                at: None,
                datum: 1.0,
                band: (0.9, 1.1),
                model: 1.3,
                unit: "-".to_owned(),
                residual: 3.0,
                scatter: 0.0,
                predicted: None,
                spread,
                source: "a test".to_owned(),
            };
            datum.deviation()
        };
        assert_eq!(off(0.0), 3.0);
        assert!((off(3.0_f64.sqrt()) - 1.5).abs() < 1e-15);
    }
}
