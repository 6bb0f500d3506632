//! Judgements of calibrations on data that were held out. `tests/snapshots/calibrations/NAME.json` holds those of the examples, so
//! that a report shows them without a search.

use super::shipped::carried;
use serde::{Deserialize, Serialize};

include!(concat!(env!("OUT_DIR"), "/held_out_judgements.rs"));

/// Deviations up to this many standard uncertainties agree `[-]`.
const AGREES: f64 = 2.0;
/// Uncertainty by the parameters over that of the datum from which on an agreement tells nothing `[-]`.
const TOO_UNCERTAIN: f64 = 2.0;

/// A calibration and its prediction of what was held out.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HeldOutJudgement {
    /// Subject of the calibration.
    pub title: String,
    /// First digits of the SHA-256 of the plan and its data files.
    pub digest: String,
    /// Version and commit of the program that searched.
    pub made_by: String,
    /// Best values of the parameters, each in its unit.
    pub values: Vec<f64>,
    /// Parameters with their 95 % intervals, a sentence each.
    pub parameters: Vec<String>,
    /// Parameters or combinations that the fitted data do not constrain, one sentence each.
    pub findings: Vec<String>,
    /// The data that were held out.
    pub data: Vec<HeldOutDatum>,
}

/// A datum that was held out beside its prediction.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct HeldOutDatum {
    /// Quantity with the run that it belongs to.
    pub quantity: String,
    /// Unit of all values.
    pub unit: String,
    /// The datum less its standard uncertainty, the datum, the datum plus it.
    pub datum: [f64; 3],
    /// Prediction at the best parameters.
    pub model: f64,
    /// Interval of 95 % that the uncertainty of the parameters gives; none where it could not be found.
    pub predicted: Option<(f64, f64)>,
    /// Standard uncertainty of the prediction by that of the parameters, over that of the datum `[-]`.
    pub spread: f64,
    /// Deviation over `u_val`, the uncertainties of the datum and of the parameters together `[-]`.
    pub deviation: f64,
    /// Source of the datum.
    pub source: String,
}

impl HeldOutDatum {
    /// Whether datum and prediction agree within two `u_val`; none where the parameters are too uncertain to tell.
    pub fn agrees(&self) -> Option<bool> {
        let agrees = self.deviation.abs() <= AGREES;
        (!agrees || self.spread <= TOO_UNCERTAIN).then_some(agrees)
    }
}

impl HeldOutJudgement {
    /// The sentence that sums up the judgement.
    pub fn in_words(&self) -> String {
        let count = |wanted: Option<bool>| self.data.iter().filter(|datum| datum.agrees() == wanted).count();
        let (agree, differ, open) = (count(Some(true)), count(Some(false)), count(None));
        let open =
            if open > 0 { format!("; for {open} the parameters are too uncertain to tell") } else { String::new() };
        let verb = if differ == 1 { "differs" } else { "differ" };
        format!(
            "Held out: {agree} of {} data agree with their prediction within 2 u_val, {differ} {verb}{open}.",
            self.data.len()
        )
    }

    /// Names and judgements of the examples.
    ///
    /// # Panics
    /// If one is malformed. No user can bring that about: they are part of the program, and a test reads each.
    pub fn shipped() -> Vec<(&'static str, Self)> {
        carried(&FILES, ".json", serde_json::from_str).into_iter().collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_agreement_counts_only_where_the_parameters_are_known_well_enough() {
        let datum = |deviation: f64, spread: f64| HeldOutDatum {
            quantity: "run_out".to_owned(),
            unit: "-".to_owned(),
            datum: [0.9, 1.0, 1.1],
            model: 1.0,
            predicted: None,
            spread,
            deviation,
            source: "a test".to_owned(),
        };
        let data = vec![datum(1.9, 0.5), datum(-2.1, 0.5), datum(0.1, 3.0), datum(2.1, 3.0)];
        let verdicts: Vec<Option<bool>> = data.iter().map(HeldOutDatum::agrees).collect();
        assert_eq!(verdicts, [Some(true), Some(false), None, Some(false)]);
        let (title, digest, made_by) = (String::new(), String::new(), String::new());
        let (values, parameters, findings) = (Vec::new(), Vec::new(), Vec::new());
        let judgement = HeldOutJudgement { title, digest, made_by, values, parameters, findings, data };
        let words = "Held out: 1 of 4 data agree with their prediction within 2 u_val, 2 differ; for 1 the parameters are too \
                     uncertain to tell.";
        assert_eq!(judgement.in_words(), words);
    }

    #[test]
    fn every_example_that_is_carried_has_data_with_intervals() {
        let shipped = HeldOutJudgement::shipped();
        assert!(shipped.len() >= 2, "{} judgements", shipped.len());
        for (name, judgement) in shipped {
            assert!(!judgement.data.is_empty() && !judgement.parameters.is_empty(), "{name}");
            assert!(
                judgement.data.iter().all(|datum| datum.predicted.is_some() && datum.deviation.is_finite()),
                "{name}"
            );
        }
    }
}
