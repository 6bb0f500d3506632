//! Decks of other codes that the program carries: inputs, `run.sh` and the submission that reads its results.

use super::error::ProgramError;
use crate::case::{AnyCase, ParameterError, Tier};
use crate::judge;
use crate::output::FileError;
use std::collections::BTreeSet;
use std::path::Path;

include!(concat!(env!("OUT_DIR"), "/decks.rs"));

/// Writes the deck of a code for a case into a folder; its submission replaces the blank one.
pub(super) fn write(code: &str, case: &'static dyn AnyCase, tier: Tier, folder: &Path) -> Result<(), ProgramError> {
    let cell = format!("{code}/{}/", case.name());
    let files: Vec<(&str, &str)> =
        FILES.iter().filter_map(|(name, text)| Some((name.strip_prefix(&cell)?, *text))).collect();
    if !files.iter().any(|(name, _)| *name == "deck/run.sh") || tier != Tier::Quick {
        let has_deck = |name: &&str| name.ends_with(&format!("/{}/deck/run.sh", case.name()));
        let codes: BTreeSet<&str> =
            FILES.iter().map(|(name, _)| *name).filter(has_deck).filter_map(|name| name.split('/').next()).collect();
        let codes: Vec<&str> = codes.into_iter().collect();
        let rule = match codes[..] {
            [] => format!("absent: no code has a deck of {}", case.name()),
            _ => format!("a code with a deck of {} at the tier quick: {}", case.name(), codes.join(", ")),
        };
        let remedy = "leave it out, and write the deck from case.toml and definitions.md";
        return Err(ParameterError::field("--for", code, &rule, remedy).into());
    }
    for (name, text) in files {
        let today = judge::inputs_of(case, tier)?;
        if name == "submission.toml" && !text.contains(&format!("inputs = \"{today}\"")) {
            let rule = format!("a deck of today's inputs, {today}");
            return Err(
                ParameterError::field("--for", code, &rule, "compare case.toml with the numbers of the deck").into()
            );
        }
        let file = folder.join(name);
        std::fs::create_dir_all(file.parent().unwrap_or(folder))
            .and_then(|()| std::fs::write(&file, text))
            .map_err(|error| FileError::unwritable(folder, &error))?;
    }
    Ok(())
}
