//! Wall times of runs on this machine, kept beside their results: the basis of the next estimate.
//!
//! A run's time is kept over its nominal time, which follows from its parameters alone. So what was measured once holds for
//! other sizes and durations as well, as far as the nominal time grows with them as it should.

use crate::input::{DOCUMENT, read_text};
use crate::metric::Variant;
use crate::output::write_whole;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io;
use std::path::Path;

/// Name of the file in the folder of a store.
const FILE: &str = "speeds.json";

/// A time `[s]` of one core, expected and taken.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
struct Taken {
    nominal: f64,
    taken: f64,
}

/// Known times of a case.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
struct OfCase {
    /// By the run's full name.
    runs: BTreeMap<String, Taken>,
    /// Wall time `[s]` of a command beside its runs, case by case: references, figures, pages. By the command.
    beside: BTreeMap<String, f64>,
}

/// Times of the runs of one build of the program.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct Speeds {
    /// Wall time `[µs]` of a particle-step of a small flow, by which machines are compared; 0 if it was not measured.
    pub machine: f64,
    cases: BTreeMap<String, OfCase>,
}

impl Speeds {
    /// Records that a run took a number of seconds of one core and was expected to take `nominal`.
    pub fn learn(&mut self, case: &str, variant: &Variant, nominal: f64, taken: f64) {
        if nominal > 0.0 && nominal.is_finite() && taken > 0.0 && taken.is_finite() {
            let runs = &mut self.cases.entry(case.to_owned()).or_default().runs;
            runs.insert(variant.to_string(), Taken { nominal, taken });
        }
    }

    /// Records the time `[s]` that a command took in addition to the runs of a case.
    pub fn learn_beside(&mut self, case: &str, command: &str, seconds: f64) {
        if seconds >= 0.0 && seconds.is_finite() {
            self.cases.entry(case.to_owned()).or_default().beside.insert(command.to_owned(), seconds);
        }
    }

    /// Time taken over the nominal one `[-]`: of that run, else the median of all runs of its case, which a single odd one does not
    /// move.
    pub fn ratio(&self, case: &str, variant: &Variant) -> Option<f64> {
        let runs = &self.cases.get(case)?.runs;
        let ratio = |taken: f64, nominal: f64| (nominal > 0.0).then_some(taken / nominal);
        match runs.get(&variant.to_string()) {
            Some(run) => ratio(run.taken, run.nominal),
            None => {
                let mut ratios: Vec<f64> = runs.values().filter_map(|run| ratio(run.taken, run.nominal)).collect();
                ratios.sort_by(f64::total_cmp);
                let middle = |place: usize| ratios.get(place).copied();
                Some((middle(ratios.len().saturating_sub(1) / 2)? * middle(ratios.len() / 2)?).sqrt())
            }
        }
    }

    /// Nominal time of the runs of a case that are known `[s]`.
    pub fn nominal(&self, case: &str) -> f64 {
        self.cases.get(case).map_or(0.0, |case| case.runs.values().map(|run| run.nominal).sum())
    }

    /// Wall time of a command beside the runs of a case `[s]`.
    pub fn beside(&self, case: &str, command: &str) -> Option<f64> {
        self.cases.get(case)?.beside.get(command).copied()
    }
}

/// The times of all builds that use a store, by what tells their speeds apart.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct AllSpeeds(BTreeMap<String, Speeds>);

impl AllSpeeds {
    /// Speeds of a store; none where its file is missing or unreadable, so that they are measured again.
    pub fn read(root: &Path) -> Self {
        read_text(&root.join(FILE), DOCUMENT).ok().and_then(|text| serde_json::from_str(&text).ok()).unwrap_or_default()
    }

    /// Speeds of one build.
    pub fn of(&mut self, build: &str) -> &mut Speeds {
        self.0.entry(build.to_owned()).or_default()
    }

    /// Writes them into a store.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write(&self, root: &Path) -> io::Result<()> {
        let text = serde_json::to_string_pretty(self).map_err(io::Error::other)?;
        std::fs::create_dir_all(root)?;
        write_whole(&root.join(FILE), format!("{text}\n").as_bytes())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_known_by_its_name_and_others_by_their_case() {
        let mut speeds = Speeds::default();
        let variant = |resolution: usize| Variant::of("resolution", resolution);
        assert_eq!(speeds.ratio("film", &variant(10)), None);
        speeds.learn("film", &variant(10), 1.0, 3.0);
        speeds.learn("film", &variant(20), 3.0, 1.0);
        for (nominal, taken) in [(0.0, 1.0), (1.0, f64::NAN), (f64::INFINITY, 1.0), (1.0, -1.0)] {
            speeds.learn("film", &variant(30), nominal, taken);
        }
        assert_eq!(speeds.ratio("film", &variant(10)), Some(3.0));
        assert_eq!(speeds.ratio("film", &variant(20)), Some(1.0 / 3.0));
        assert_eq!(speeds.ratio("film", &variant(40)), Some(1.0), "between 3 and 1/3");
        let mut odd = speeds.clone();
        odd.learn("film", &variant(30), 1.0, 1000.0);
        assert_eq!(odd.ratio("film", &variant(40)).map(f64::round), Some(3.0), "one odd run says little of others");
        assert_eq!(speeds.ratio("bagnold", &variant(10)), None);
        speeds.learn("film", &variant(10), 2.0, 4.0);
        assert_eq!(speeds.ratio("film", &variant(10)), Some(2.0), "the latest counts");
        speeds.learn_beside("film", "run", 0.5);
        assert_eq!((speeds.beside("film", "run"), speeds.beside("film", "report")), (Some(0.5), None));
    }

    #[test]
    fn speeds_come_back_from_their_store_build_by_build() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let root = folder.path().join("store");
        let mut all = AllSpeeds::read(&root);
        assert_eq!(all, AllSpeeds::default());
        all.of("debug").learn("film", &Variant::default(), 1.0, 30.0);
        all.of("release").learn("film", &Variant::default(), 1.0, 0.5);
        all.write(&root).expect("writable");
        let mut read = AllSpeeds::read(&root);
        assert_eq!(read, all);
        assert_eq!(read.of("release").ratio("film", &Variant::default()), Some(0.5));
        std::fs::write(root.join(FILE), "{").expect("writable");
        assert_eq!(AllSpeeds::read(&root), AllSpeeds::default());
    }
}
