//! `bagnold compare`: results that were written earlier, beside each other.

use super::arguments::CompareArguments;
use super::error::ProgramError;
use super::{Exit, Session};
use crate::case::ParameterError;
use crate::compare::{self, Difference, PairedKey, Results};
use crate::number::four_digits;
use crate::output::OutputFolder;
use crate::result::MetricEntry;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Numbers that differ, the largest difference first, on the terminal; the page has all.
const MOST_SHOWN: usize = 8;

/// Reads, compares and writes.
pub(super) fn compare(command: &CompareArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let all = Results::read(&command.folders)?;
    let same = |folder: &&PathBuf| {
        let whole = |path: &Path| path.canonicalize().ok();
        whole(folder).is_some_and(|folder| whole(&command.out) == Some(folder))
    };
    if let Some(folder) = command.folders.iter().find(same) {
        let (rule, remedy) = ("another folder than those compared", "name another one: its contents would be replaced");
        return Err(ParameterError::field("--out", folder.display(), rule, remedy).into());
    }
    if let Some((first, others)) = all.split_first().filter(|_| !command.across_gates) {
        others.iter().try_for_each(|other| first.same_gates(other))?;
    }
    let claimed = OutputFolder::claim(&command.out)?;
    let moved = compare::write(&all, claimed.staging())?;
    claimed.publish()?;
    for one in compare::changed(&all).iter().take(MOST_SHOWN) {
        let values: Vec<&str> = one.values.iter().map(|value| value.as_deref().unwrap_or("–")).collect();
        session.say(&format!("parameter {}: {}\n", one.path, values.join(" → ")));
    }
    for PairedKey { case, key, values } in all.iter().flat_map(|results| &results.paired) {
        session.say(&format!("{case}: runs with {key}={} compared with those with {key}={}\n", values[1], values[0]));
    }
    let numbers = compare::differences(&all);
    let (common, apart): (Vec<_>, Vec<_>) = numbers.iter().partition(|one| one.entries.iter().all(Option::is_some));
    let of_cases = |numbers: &[&Difference]| {
        let cases: BTreeSet<&str> = numbers.iter().map(|one| one.case.as_str()).collect();
        format!("{} numbers of {}", numbers.len(), cases.into_iter().collect::<Vec<_>>().join(", "))
    };
    session.say(&format!("compared: {}\n", of_cases(&common)));
    if !apart.is_empty() {
        session.say(&format!("not in every folder, so not compared: {}\n", of_cases(&apart)));
    }
    let shown = if moved.len() > MOST_SHOWN { ", the largest differences first; index.html has all" } else { "" };
    session.say(&format!("{} numbers differ by more than their tolerance{shown}\n", moved.len()));
    moved.iter().take(MOST_SHOWN).for_each(|one| session.say(&in_words(one)));
    let limits =
        all.split_first().map_or(0, |(first, others)| others.iter().map(|other| first.moved_limits(other)).sum());
    if limits > 0 {
        session.say(&format!(
            "limits of {limits} gates differ: the versions of the gates differ, or limits depend on the runs\n"
        ));
    }
    session.say(&format!("Report: {}\n", command.out.join("index.html").display()));
    Ok(if !moved.is_empty() && command.deny_differences { Exit::GateFailed } else { Exit::Held })
}

/// A number that differs, with its values in the order of the folders.
fn in_words(one: &Difference) -> String {
    let value = |entry: &Option<MetricEntry>| {
        let value = entry.as_ref().and_then(|entry| entry.value);
        value.map_or_else(|| "–".to_owned(), four_digits)
    };
    let values: Vec<String> = one.entries.iter().map(value).collect();
    let changes: Vec<String> = (0..values.len()).filter_map(|folder| one.change_in_words(folder)).collect();
    let changes = if changes.is_empty() { String::new() } else { format!("; {}", changes.join(", ")) };
    format!("  {} {} {}: {} {}{changes}\n", one.case, one.metric, one.variant, values.join(" → "), one.unit)
}
