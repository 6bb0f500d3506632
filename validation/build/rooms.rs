//! Dependences of the simulations of each case, found in the text of the sources: an edit of one case, law or model, or of what
//! judges and draws, leaves stored runs of the others as they are.
//!
//! Relied on, and checked by `tests/structure/simulations.rs`: code outside of a room names the room on its path, or the type of a
//! law; `mod.rs` of laws passes a value on to the file of its own law; a run's description quotes the laws of its values.

use std::collections::{BTreeMap, BTreeSet};

/// Packages and parts of a case's folder that see runs which have ended.
const JUDGING: [&str; 3] = ["validation/inference/src/inference/", "validation/tools/", "validation/harness/src/page/"];
pub(crate) const JUDGING_PARTS: [&str; 2] = ["metrics", "figures"];

/// Name of what drawings depend on besides their data.
pub(crate) const DRAWING: &str = "drawing";

/// The two models by their folders, each of which a case names if it uses it.
const MODELS: [&str; 2] = ["weakly_compressible", "incompressible"];

/// Families whose folders are a case each; other families are one room.
const FAMILIES: [&str; 2] = ["layer", "channel"];

/// Folders of laws: `mu_i.rs` and `mu_i/` are a law's if the folder's `mod.rs` quotes `"mu-i"`.
pub(crate) const LAWS: [&str; 2] = ["solver/src/material/rheology/", "solver/src/material/drag/"];

/// Begins the name of a law's room, and that of a part of the references.
const LAW: &str = "law ";
const REFERENCE: &str = "reference::";

/// Sources, each with its path in the workspace, by room: a case, a family, the scenes, a part of the references, a model, a law;
/// those of all others have no name.
pub(crate) struct Rooms {
    laws: BTreeSet<String>,
    rooms: BTreeMap<String, Vec<(String, String)>>,
}

impl Rooms {
    /// No sources yet; laws by the code of the `mod.rs` of their folders.
    pub(crate) fn new(dispatches: &str) -> Self {
        let laws = dispatches.split('"').skip(1).step_by(2).map(|name| name.replace('-', "_"));
        Self { laws: laws.collect(), rooms: BTreeMap::from([(String::new(), Vec::new())]) }
    }

    /// Sorts in the code of a file by its path in the workspace.
    pub(crate) fn sort_in(&mut self, path: &str, code: &str) {
        if let Some(room) = self.room(path) {
            self.rooms.entry(room).or_default().push((path.to_owned(), code.to_owned()));
        }
    }

    /// The room of a file; none for what no simulation depends on.
    pub(crate) fn room(&self, path: &str) -> Option<String> {
        let within = |folder: &str| path.strip_prefix(folder).and_then(|rest| rest.split_once('/'));
        let is_of_case = path.starts_with("validation/cases/src/") || path.starts_with("validation/scenes/src/");
        let is_judging = |part: &str| JUDGING_PARTS.contains(&part.trim_end_matches(".rs"));
        if JUDGING.iter().any(|package| path.starts_with(package)) || is_of_case && path.split('/').any(is_judging) {
            return None;
        }
        let stem = LAWS.iter().find_map(|folder| path.strip_prefix(folder)?.split(['/', '.']).next());
        if let Some(law) = stem.filter(|stem| self.laws.contains(*stem)) {
            return Some(format!("{LAW}{law}"));
        }
        if let Some((family, rest)) = within("validation/cases/src/") {
            let case = rest.split_once('/').filter(|_| FAMILIES.contains(&family));
            return Some(case.map_or_else(|| family.to_owned(), |(case, _)| format!("{family}::{case}")));
        }
        let model = within("solver/src/").filter(|(folder, _)| MODELS.contains(folder));
        let room = model.or_else(|| within("validation/scenes/"));
        let room = room.or_else(|| within("validation/figure/").map(|(_, file)| (DRAWING, file)));
        let reference = within("validation/reference/src/").map(|(part, _)| format!("{REFERENCE}{part}"));
        Some(room.map_or_else(|| reference.unwrap_or_default(), |(room, _)| room.to_owned()))
    }

    /// The other rooms that the code of one names.
    fn named_by(&self, room: &str) -> Vec<&str> {
        let sources = &self.rooms[room];
        // it names all laws, each for values of its own
        let is_dispatch = |path: &str| LAWS.iter().any(|folder| path == format!("{folder}mod.rs"));
        let own = sources.iter().filter(|(path, _)| !is_dispatch(path));
        let (mut words, mut modules) = (BTreeSet::new(), BTreeSet::new());
        for path in own.flat_map(|(_, code)| code.split(|c: char| !c.is_alphanumeric() && c != '_' && c != ':')) {
            words.extend(path.split("::"));
            modules.extend(path.rsplit("::").skip(1));
        }
        let is_named = |other: &str| match other.strip_prefix(LAW) {
            Some(law) => modules.contains(law) || words.contains(type_name(law).as_str()),
            None if MODELS.contains(&other) => words.contains(other) && !MODELS.contains(&room),
            None => {
                let part = other.strip_prefix(REFERENCE);
                let path = format!("crate::{}", part.unwrap_or(other));
                // a case and a part of the references may have one name
                let own = if part.is_some() { "validation/reference/" } else { "validation/cases/" };
                let is_own = |(file, code): &(String, String)| file.starts_with(own) && code.contains(&path);
                sources.iter().any(|source| is_own(source) || part.is_some() && source.1.contains(other))
            }
        };
        let is_around = |other: &str| room.split_once("::").is_some_and(|(family, _)| family == other);
        self.rooms.keys().map(String::as_str).filter(|other| is_around(other) || is_named(other)).collect()
    }

    /// The rooms that each room uses, itself and what is common among them.
    pub(crate) fn used(&self) -> BTreeMap<&str, BTreeSet<&str>> {
        let named: BTreeMap<&str, Vec<&str>> =
            self.rooms.keys().map(|room| (room.as_str(), self.named_by(room))).collect();
        let all = named.keys().map(|&room| {
            let (mut used, mut next) = (BTreeSet::new(), vec![room, ""]);
            while let Some(room) = next.pop() {
                if used.insert(room) {
                    next.extend(&named[room]);
                }
            }
            (room, used)
        });
        all.collect()
    }

    /// Names of cases, each law as a description quotes it, and [`DRAWING`], with the sources that each depends on.
    pub(crate) fn dependences(&self) -> Vec<(String, Vec<&(String, String)>)> {
        let mut all = Vec::new();
        for (room, used) in self.used() {
            let own = &self.rooms[room];
            let law = room.strip_prefix(LAW).map(|law| format!("{:?}", law.replace('_', "-")));
            let drawing = (room == DRAWING).then(|| DRAWING.to_owned());
            let names = own.iter().flat_map(|(_, code)| names_of_cases(code)).chain(law).chain(drawing);
            let sources: Vec<_> = used.iter().flat_map(|room| &self.rooms[*room]).collect();
            all.extend(names.map(|name| (name, sources.clone())));
        }
        all
    }
}

/// `MuI` of `mu_i`.
pub(crate) fn type_name(law: &str) -> String {
    law.split('_')
        .flat_map(|word| word[..1].to_uppercase().chars().chain(word[1..].chars()).collect::<Vec<_>>())
        .collect()
}

/// The names in a statement such as `const NAME: &'static str = "film";`.
fn names_of_cases(code: &str) -> Vec<String> {
    let statement = code.split_once("const NAME: &'static str = ").and_then(|(_, rest)| rest.split_once(';'));
    let quoted = statement.map_or("", |(statement, _)| statement).split('"').skip(1).step_by(2);
    quoted.map(str::to_owned).collect()
}
