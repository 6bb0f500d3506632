//! The league of other codes: submissions with one error are red or refused.

use bagnold_harness::case::{Silent, execute};
use bagnold_harness::metric::Verdict;
use bagnold_harness::store::{Store, StorePolicy};
use bagnold_tools::ToolError;
use bagnold_tools::judge::{self, CodeComparison};
use bagnold_tools::league::studies::GrainComparison;
use bagnold_tools::league::{self, WRONG, studies};
use bagnold_validation::REGISTRY;
use sha2::{Digest, Sha256};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/league")
}

fn judged(files: &[PathBuf]) -> Result<Vec<CodeComparison>, ToolError> {
    let (prepared, entries) = league::split(league::read(files, *REGISTRY)?);
    let own = execute(prepared, &Store::open(StorePolicy::Use), &Silent).unwrap_or_else(|error| panic!("{error}"));
    own.into_iter().zip(&entries).map(|(own, entries)| judge::judge(own, entries)).collect()
}

/// Rejection of each: a gate by its name, or a part of the message.
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

/// Files of a folder below it, by their paths.
fn files(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let mut all: Vec<PathBuf> =
        entries.flat_map(|path| if path.is_dir() { files(&path) } else { vec![path] }).collect();
    // as `sort` of the C locale sorts them
    all.sort_by(|a, b| a.as_os_str().cmp(b.as_os_str()));
    all
}

/// A deck or table that changes after its run no longer belongs to what `made.toml` says of it.
#[test]
fn decks_and_results_are_those_that_were_recorded() {
    let mut checked = 0;
    for file in files(&folder()).into_iter().filter(|file| file.ends_with("made.toml")) {
        let made: toml::Table = std::fs::read_to_string(&file).expect("text").parse().expect("TOML");
        for part in ["deck", "results"] {
            let own = file.parent().expect("a folder").join(part);
            // decks of readers' samples stand elsewhere
            if own.is_dir() {
                let bytes: Vec<u8> = files(&own).iter().flat_map(|path| std::fs::read(path).expect("bytes")).collect();
                let digest: String = Sha256::digest(&bytes).iter().map(|byte| format!("{byte:02x}")).collect();
                let recorded = made[&format!("{part}_sha256")].as_str();
                assert_eq!(recorded, Some(digest.as_str()), "{}: run record.sh again", own.display());
                checked += 1;
            }
        }
    }
    assert!(checked >= 20, "{checked} folders");
}

/// The law of LAMMPS' slopes holds for the same discs in YADE and between walls; a friction without rate does not.
#[test]
fn the_same_discs_have_one_friction_in_both_codes_and_geometries() {
    let all = studies::read(&folder(), studies::FRICTION).unwrap_or_else(|error| panic!("{error}"));
    let codes: BTreeSet<&str> = all.iter().map(|one| one.grains.as_str()).collect();
    assert_eq!((codes.len(), all.len()), (2, 16));
    let own = |one: &GrainComparison| one.mean().expect("three seeds");
    let without_rate = all.iter().map(own).sum::<f64>() / all.len() as f64;
    let mut rejected = 0;
    for one in &all {
        assert_eq!(one.measured.len(), 3, "{}, {}", one.grains, one.case);
        assert!((one.value / own(one) - 1.0).abs() < 0.05, "{}, {}: {:?}", one.grains, one.case, one.error());
        rejected += usize::from((without_rate / own(one) - 1.0).abs() > 0.05);
    }
    assert!(rejected > 8, "{rejected} of 16 reject a friction without rate");
}

/// Nobody can have known what the grains would do when the prediction was stored.
#[test]
fn seeds_of_the_blind_study_follow_from_the_digest_of_its_prediction() {
    let read = |name: &str| std::fs::read(folder().join("blind/results").join(name)).expect("a table");
    let digest = Sha256::digest(["friction.csv", "law.csv", "prediction.csv"].map(read).concat());
    let from_digest: BTreeSet<u16> = (0..3).map(|k| u16::from_be_bytes([digest[2 * k], digest[2 * k + 1]])).collect();
    let measured = String::from_utf8(read("measured.csv")).expect("text");
    let mut rows = measured.lines().map(|row| row.split(',').collect::<Vec<_>>());
    let column = rows.next().and_then(|heading| heading.iter().position(|name| *name == "seed")).expect("seeds");
    let run: BTreeSet<u16> = rows.map(|row| row[column].parse().expect("a seed")).collect();
    assert_eq!(run, from_digest);
    let all = studies::read(&folder(), studies::BLIND).unwrap_or_else(|error| panic!("{error}"));
    assert!(all.iter().all(|one| !one.measured.is_empty()), "every prediction has been compared");
}
