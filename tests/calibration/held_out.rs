//! Stored judgements of the example calibrations: plan and data are those of today, and so are the predictions.

use super::findings::Unseen;
use bagnold_harness::case::Limits;
use bagnold_harness::evidence::HeldOutJudgement;
use bagnold_tools::calibration::CalibrationPlan;
use bagnold_validation::REGISTRY;
use std::path::{Path, PathBuf};

/// Plan of an example.
fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("../validation/calibrations/{name}.toml"))
}

fn plan(name: &str) -> CalibrationPlan {
    CalibrationPlan::read(&file(name), *REGISTRY, Limits::default()).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn plans_and_data_are_those_of_the_stored_judgements() {
    for (name, stored) in HeldOutJudgement::shipped() {
        let now = plan(name).digest().unwrap_or_else(|error| panic!("{error}"));
        let remedy = format!("run `bagnold calibrate validation/calibrations/{name}.toml` and store its held-out.json");
        assert!(!stored.made_by.ends_with("+changes"), "{name} was made by sources that no commit holds");
        assert_eq!(now, stored.digest, "{name} was calibrated from another plan or other data: {remedy}");
    }
}

mod long {
    use super::*;
    use bagnold_harness::store::{Store, StorePolicy};
    use bagnold_tools::calibration::{CalibrationFolder, predict};

    /// Relative difference that counts as the same prediction: the tolerance of baseline values `[-]`.
    const SAME: f64 = 1e-3;

    #[test]
    #[ignore = "takes a minute"]
    fn stored_predictions_are_those_of_today() {
        for (name, stored) in HeldOutJudgement::shipped() {
            let folder = tempfile::tempdir().expect("a folder");
            let kept = CalibrationFolder::begin(&folder.path().join("out"), &file(name), REGISTRY.origin(), false)
                .unwrap_or_else(|error| panic!("{error}"));
            let store = Store::open(StorePolicy::Use);
            let now = predict(&plan(name), &kept, *REGISTRY, &store, &Unseen, &stored.values)
                .unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(now.len(), stored.data.len(), "{name}");
            for (now, stored) in now.iter().zip(&stored.data) {
                let difference = (now.model / stored.model - 1.0).abs();
                assert!(difference < SAME, "{name}: {} = {} was {}", stored.quantity, now.model, stored.model);
                let deviation = now.residual / (1.0 + stored.spread * stored.spread).sqrt();
                assert!((deviation - stored.deviation).abs() < 0.01, "{name}: {} {deviation}", stored.quantity);
            }
        }
    }
}
