//! Decks of other codes that the program carries: inputs, `run.sh` and the submission that reads its results.

use super::error::ProgramError;
use crate::case::{AnyCase, ParameterError, Tier};
use crate::judge;
use std::collections::BTreeSet;

include!(concat!(env!("OUT_DIR"), "/decks.rs"));

/// Files of the deck of a code for a case, by their names, and the submission that replaces the blank one.
pub(super) fn find(
    code: &str,
    case: &'static dyn AnyCase,
    tier: Tier,
) -> Result<Vec<(&'static str, &'static str)>, ProgramError> {
    let cell = format!("{code}/{}/", case.name());
    let files: Vec<(&str, &str)> =
        FILES.iter().filter_map(|(name, text)| Some((name.strip_prefix(&cell)?, *text))).collect();
    let refuse = |rule: &str, remedy: &str| Err(ParameterError::field("--for", code, rule, remedy).into());
    if !files.iter().any(|(name, _)| *name == "deck/run.sh") || tier != Tier::Quick {
        let has_deck = |name: &&str| name.ends_with(&format!("/{}/deck/run.sh", case.name()));
        let codes: BTreeSet<&str> =
            FILES.iter().map(|(name, _)| *name).filter(has_deck).filter_map(|name| name.split('/').next()).collect();
        let codes: Vec<&str> = codes.into_iter().collect();
        let rule = match codes[..] {
            [] => format!("left out, because no code has a deck of {}", case.name()),
            _ => format!("a code with a deck of {} at the tier quick: {}", case.name(), codes.join(", ")),
        };
        return refuse(&rule, "leave it out, and write your own deck from case.toml and definitions.md");
    }
    let today = format!("inputs = \"{}\"", judge::inputs_of(case, tier)?);
    if files.iter().any(|(name, text)| *name == "submission.toml" && !text.contains(&today)) {
        return refuse(&format!("a code with a deck of {today}"), "compare case.toml with the numbers of the deck");
    }
    Ok(files)
}
