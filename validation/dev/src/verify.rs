//! `bagnold-dev verify`: short runs of every case end in the committed bits, on 1, 2 and 3 threads.

use crate::arguments::VerifyArguments;
use crate::case::{Changes, ParameterError, Registry, Silent, Tier, execute};
use crate::error::DevError;
use crate::input::{FieldError, WRITTEN_BY_HAND, read_text};
use crate::output::{FileError, write_whole};
use crate::store::{Store, StorePolicy};
use bagnold_validation::cli::{Exit, Session, in_pool};
use serde::{Deserialize, Serialize};
use std::path::Path;

/// The committed list.
const SHORT_RUNS: &str = include_str!("../short_runs.toml");

const THREADS: [u16; 3] = [1, 2, 3];

const HEADER: &str = "# What `bagnold-dev verify` runs: every case at the quick tier, cut short by its settings, and the hash of its final states.\n\
    # `cargo run -p bagnold-dev -- verify --write validation/dev/short_runs.toml` writes the hashes anew, where bits are meant to change.\n\n";

#[derive(Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ShortRuns {
    runs: Vec<ShortRun>,
}

#[derive(Debug, Clone, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct ShortRun {
    case: String,
    settings: Vec<String>,
    state_hash: String,
}

/// Runs the list and compares, or writes it anew.
pub(crate) fn verify(command: &VerifyArguments, session: &mut Session<'_>) -> Result<Exit, DevError> {
    let mut list = read(command.file.as_deref())?;
    let mut differing = Vec::new();
    for run in &mut list.runs {
        let hashes = THREADS
            .into_iter()
            .map(|threads| Ok((threads, state_hash(run, session.registry, threads)?)))
            .collect::<Result<Vec<(u16, String)>, DevError>>()?;
        let expected = if command.write.is_some() { hashes[0].1.clone() } else { run.state_hash.clone() };
        let wrong: Vec<String> = hashes
            .iter()
            .filter(|(_, hash)| *hash != expected)
            .map(|(threads, hash)| format!("{hash} on {threads}"))
            .collect();
        if wrong.is_empty() {
            session.say(&format!("same     {} {}\n", run.case, expected.get(..16).unwrap_or(&expected)));
        } else {
            let line = format!("differs  {}: {} threads, but {expected} is committed\n", run.case, wrong.join(", "));
            session.say(&line);
            differing.push(run.case.clone());
        }
        run.state_hash = expected;
    }
    if let Some(file) = &command.write {
        let text = toml::to_string(&list).map_err(|error| FileError::damaged(file, error, "please report it"))?;
        write_whole(file, format!("{HEADER}{text}").as_bytes()).map_err(|error| FileError::unwritable(file, &error))?;
    }
    if differing.is_empty() {
        session.say(&format!("{} cases: final states bitwise identical on 1, 2 and 3 threads\n", list.runs.len()));
        return Ok(Exit::Held);
    }
    let remedy = "numbers were changed, or compiler or machine round differently";
    session.say(&format!("final states differ: {} ({remedy})\n", differing.join(", ")));
    Ok(Exit::GateFailed)
}

fn read(file: Option<&Path>) -> Result<ShortRuns, DevError> {
    let path = file.unwrap_or_else(|| Path::new("short_runs.toml"));
    let text = match file {
        Some(file) => read_text(file, WRITTEN_BY_HAND).map_err(|error| FileError::unreadable(file, &error))?,
        None => SHORT_RUNS.to_owned(),
    };
    let remedy = "write [[runs]] with case, settings and state_hash";
    let list: ShortRuns =
        toml::from_str(&text).map_err(|error: toml::de::Error| FileError::damaged(path, error.message(), remedy))?;
    if list.runs.is_empty() {
        let error = FieldError::finding("runs", "no run", "add a `[[runs]]` table");
        return Err(ParameterError::from(error.in_file(path)).into());
    }
    Ok(list)
}

/// Hash of the final states of a short run on a given number of threads.
fn state_hash(run: &ShortRun, registry: Registry, threads: u16) -> Result<String, DevError> {
    let changes = Changes { settings: &run.settings, ..Changes::default() };
    in_pool(Some(threads), || {
        let prepared = registry.find(&run.case)?.prepare(Tier::Quick, &changes)?;
        let results = execute(vec![prepared], &Store::open(StorePolicy::Bypass), &Silent)?;
        Ok(results.into_iter().map(|result| result.state_hash).collect())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::REGISTRY;
    use crate::pendulum;

    fn run(file: &Path, write: bool) -> (Exit, String) {
        let command = VerifyArguments { file: Some(file.to_owned()), write: write.then(|| file.to_owned()) };
        let mut output = Vec::new();
        let exit = verify(&command, &mut Session { registry: pendulum::REGISTRY, quiet: true, output: &mut output })
            .expect("a good list");
        (exit, String::from_utf8(output).expect("text"))
    }

    #[test]
    fn a_hash_that_has_changed_fails_and_names_the_case() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let file = folder.path().join("runs.toml");
        std::fs::write(&file, "[[runs]]\ncase = \"pendulum\"\nsettings = [\"steps=20\"]\nstate_hash = \"00\"\n")
            .expect("writable");
        let (exit, text) = run(&file, false);
        assert_eq!(exit, Exit::GateFailed);
        assert!(text.starts_with("differs  pendulum: ") && text.contains("final states differ: pendulum ("), "{text}");
        assert_eq!(run(&file, true).0, Exit::Held);
        let (exit, text) = run(&file, false);
        assert_eq!(exit, Exit::Held, "{text}");
        // one bit of the damping
        let changed = std::fs::read_to_string(&file).expect("written").replace(
            "settings = [\"steps=20\"]",
            &format!("settings = [\"steps=20\", \"grain.damping={:?}\"]", 1.0_f64.next_up()),
        );
        std::fs::write(&file, changed).expect("writable");
        assert_eq!(run(&file, false).0, Exit::GateFailed);
    }

    #[test]
    fn kept_states_are_of_the_present_bits() {
        let list = read(None).expect("a good list");
        let states = include_str!("../../cases/states/bed-load.toml");
        let run = list.runs.iter().find(|run| run.case == "bed-load").expect("a short run");
        let remedy = "renew them by the commands at the head of validation/cases/states/bed-load.toml";
        assert!(states.contains(&run.state_hash), "kept states are older than the bits of bed-load; {remedy}");
    }

    #[test]
    fn every_case_has_a_short_run_that_takes_seconds() {
        let list = read(None).expect("a good list");
        let mut named: Vec<&str> = list.runs.iter().map(|run| run.case.as_str()).collect();
        named.sort_unstable();
        let mut cases: Vec<&str> = REGISTRY.cases().map(|case| case.name()).collect();
        cases.sort_unstable();
        assert_eq!(named, cases);
        for run in &list.runs {
            let changes = Changes { settings: &run.settings, ..Changes::default() };
            let prepared = REGISTRY.find(&run.case).and_then(|case| case.prepare(Tier::Quick, &changes));
            let estimate = prepared.expect("valid settings").estimate_of_all();
            assert!(estimate.core_seconds < 3.0, "{}: {} s", run.case, estimate.core_seconds);
        }
    }
}
