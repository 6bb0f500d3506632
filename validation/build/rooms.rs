//! What the simulations of each case depend on, found in the text of the sources: an edit of one case, of one model, or of what
//! judges and draws leaves stored runs of the others as they are.

use crate::{add, digits};
use sha2::Sha256;
use std::collections::{BTreeMap, BTreeSet};

/// Packages and parts of a case's folder that see runs which have ended.
const JUDGING: [&str; 2] = ["validation/inference/", "validation/tools/"];
const JUDGING_PARTS: [&str; 2] = ["metrics", "figures"];

/// Name of what drawings depend on besides their data.
const DRAWING: &str = "drawing";

/// The two models by their folders, each of which a case names if it uses it.
const MODELS: [&str; 2] = ["weakly_compressible", "incompressible"];

/// Sources by room: a folder of cases, the scenes, a model; those of all others have no name.
#[derive(Default)]
pub(crate) struct Rooms(BTreeMap<String, Vec<(String, String)>>);

impl Rooms {
    /// Sorts in the code of a file by its path in the workspace.
    pub(crate) fn sort_in(&mut self, path: &str, code: &str) {
        let within = |folder: &str| path.strip_prefix(folder).and_then(|rest| rest.split_once('/'));
        let is_of_case = path.starts_with("validation/cases/src/") || path.starts_with("validation/scenes/src/");
        let is_judging = |part: &str| JUDGING_PARTS.contains(&part.trim_end_matches(".rs"));
        if JUDGING.iter().any(|package| path.starts_with(package)) || is_of_case && path.split('/').any(is_judging) {
            return;
        }
        let model = within("solver/src/").filter(|(folder, _)| MODELS.contains(folder));
        let room = model.or_else(|| within("validation/cases/src/")).or_else(|| within("validation/scenes/"));
        let room = room.or_else(|| within("validation/figure/").map(|(_, file)| (DRAWING, file)));
        let sources = self.0.entry(room.map_or_else(String::new, |(room, _)| room.to_owned())).or_default();
        sources.push((path.to_owned(), code.to_owned()));
    }

    /// The rooms that one of them names, itself among them; a model names no case.
    fn used_by(&self, room: &str, used: &mut BTreeSet<String>) {
        if used.insert(room.to_owned()) && !MODELS.contains(&room) {
            let names = |other: &str| {
                let word = if MODELS.contains(&other) { other.to_owned() } else { format!("crate::{other}") };
                !other.is_empty() && self.0[room].iter().any(|(_, code)| code.contains(&word))
            };
            self.0.keys().filter(|other| names(other)).for_each(|other| self.used_by(other, used));
        }
    }

    /// Each case with the hash of all that its simulations depend on, beside the rest of the build.
    pub(crate) fn hashes(&self, build: &Sha256) -> Vec<(String, String)> {
        let mut hashes = Vec::new();
        for (room, sources) in &self.0 {
            let mut used = BTreeSet::from([String::new()]);
            self.used_by(room, &mut used);
            let mut hash = build.clone();
            for (path, code) in used.iter().filter_map(|room| self.0.get(room)).flatten() {
                add(&mut hash, path, code.as_bytes());
            }
            let hash = digits(hash);
            if room == DRAWING {
                hashes.push((DRAWING.to_owned(), hash.clone()));
            }
            // the names in a statement such as `const NAME: &'static str = "film";`
            let names = |code: &str| -> Vec<String> {
                let statement =
                    code.split_once("const NAME: &'static str = ").and_then(|(_, rest)| rest.split_once(';'));
                let quoted = statement.map_or("", |(statement, _)| statement).split('"').skip(1).step_by(2);
                quoted.map(str::to_owned).collect()
            };
            hashes.extend(sources.iter().flat_map(|(_, code)| names(code)).map(|name| (name, hash.clone())));
        }
        hashes
    }
}
