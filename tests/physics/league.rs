//! The league of other codes: submissions with one error are red or refused.

use bagnold_harness::case::{Silent, execute};
use bagnold_harness::store::{Store, StorePolicy};
use bagnold_tools::judge::{self, CodeComparison, JudgeError};
use bagnold_tools::league::{self, WRONG};
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
