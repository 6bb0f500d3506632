//! The league: verdicts on stored results of other codes do not change unseen, and submissions with one error are red or refused.

use bagnold_harness::case::{Silent, execute};
use bagnold_harness::metric::Verdict;
use bagnold_harness::store::{Store, StorePolicy};
use bagnold_tools::judge::{self, CodeComparison, JudgeError};
use bagnold_tools::league::{self, WRONG};
use bagnold_validation::REGISTRY;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/league")
}

fn judged(files: &[PathBuf]) -> Result<Vec<CodeComparison>, JudgeError> {
    let (prepared, entries) = league::split(league::read(files, *REGISTRY)?);
    let own = execute(prepared, &Store::open(StorePolicy::Use), &Silent).unwrap_or_else(|error| panic!("{error}"));
    own.into_iter().zip(&entries).map(|(own, entries)| judge::judge(own, entries)).collect()
}

/// A line for each code and case: gates that pass, fail and lack data, and the names of those that fail.
#[test]
fn verdicts_on_stored_results_are_the_accepted_ones() {
    let files = league::submissions(&folder()).unwrap_or_else(|error| panic!("{error}"));
    let mut lines = Vec::new();
    for judgement in judged(&files).unwrap_or_else(|error| panic!("{error}")) {
        for code in &judgement.codes {
            let (pass, fail, open) = code.counts();
            let failing = code.metrics.iter().filter(|one| one.verdict() == Some(Verdict::Fail));
            let mut line =
                format!("{} | {} | {pass} pass, {fail} fail, {open} without data", judgement.own.name, code.code.name);
            for one in failing {
                let _ = write!(line, " | {}", one.own.name);
            }
            lines.push(line);
        }
    }
    lines.sort();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("snapshots/league.txt");
    let accepted = std::fs::read_to_string(&path).unwrap_or_default();
    assert_eq!(accepted.trim_end(), lines.join("\n"), "{} is out of date", path.display());
}

#[test]
fn a_submission_with_one_error_is_red_or_refused() {
    let entries = std::fs::read_dir(folder().join(WRONG)).expect("the folder of wrong submissions");
    let mut files: Vec<PathBuf> =
        entries.map(|entry| entry.expect("an entry").path().join("submission.toml")).collect();
    files.sort();
    assert!(files.len() >= 7, "{files:?}");
    let accepted: Vec<&PathBuf> = files
        .iter()
        .filter(|file| match judged(std::slice::from_ref(file)) {
            Ok(judged) => judged.iter().flat_map(|one| &one.codes).all(|code| code.counts().1 == 0),
            Err(error) => {
                let message = error.to_string();
                assert!(message.contains("`run 1."), "{}: {message}", file.display());
                false
            }
        })
        .collect();
    assert!(accepted.is_empty(), "no gate rejects {accepted:?}");
}
