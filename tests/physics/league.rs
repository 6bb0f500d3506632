//! The league of other codes: submissions with one error are red or refused.

use bagnold_harness::case::{Silent, execute};
use bagnold_harness::metric::Verdict;
use bagnold_harness::store::{Store, StorePolicy};
use bagnold_tools::judge::{self, CodeComparison, JudgeError};
use bagnold_tools::league::{self, WRONG, blind};
use bagnold_validation::REGISTRY;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/league")
}

fn judged(files: &[PathBuf]) -> Result<Vec<CodeComparison>, JudgeError> {
    let (prepared, entries) = league::split(league::read(files, *REGISTRY)?);
    let own = execute(prepared, &Store::open(StorePolicy::Use), &Silent).unwrap_or_else(|error| panic!("{error}"));
    own.into_iter().zip(&entries).map(|(own, entries)| judge::judge(own, entries)).collect()
}

/// What rejects each: a gate by its name, or a part of the message that refuses it.
const REJECTED_BY: [(&str, &str); 8] = [
    ("another-depth", "velocity_l2"),
    ("bingham-for-herschel-bulkley", "velocity_l2"),
    ("bulk-density", "`run 1.profile.columns.thickness` is 8.1"),
    ("half-converged", "flux_error"),
    ("mirrored", "`run 1.profile.columns.x` is -"),
    ("nan-in-series", "`run 1.series.columns.front, row 8` is NaN"),
    ("other-size", "`run 1.profile.columns.thickness` is 6.3"),
    ("stopped-early", "final_height"),
];

#[test]
fn each_submission_with_one_error_is_rejected_by_what_feels_it() {
    let entries = std::fs::read_dir(folder().join(WRONG)).expect("the folder of wrong submissions");
    assert_eq!(entries.count(), REJECTED_BY.len(), "every wrong submission is listed here");
    for (name, cause) in REJECTED_BY {
        let rejected = match judged(&[folder().join(WRONG).join(name).join("submission.toml")]) {
            Ok(judged) => {
                let metrics = judged.iter().flat_map(|one| &one.codes).flat_map(|code| &code.metrics);
                metrics.filter(|one| one.own.name == cause).any(|one| one.verdict() == Some(Verdict::Fail))
            }
            Err(error) => error.to_string().contains(cause),
        };
        assert!(rejected, "{name}: not rejected by {cause}");
    }
}

/// Nobody can have known what the grains would do when the prediction was stored.
#[test]
fn seeds_of_the_blind_study_follow_from_the_digest_of_its_prediction() {
    let (run, from_digest) = blind::seeds(&folder()).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(run, from_digest);
    let all = blind::read(&folder()).unwrap_or_else(|error| panic!("{error}"));
    assert!(all.iter().all(|one| !one.measured.is_empty()), "every prediction has been compared");
}
