//! A random draw of mutations by rule, of those that compile, and what has been found of it so far.

use super::copy::{BUILD, SourceCopy, beginning};
use super::generator::{Candidate, candidates};
use super::record::{Mutation, Mutations};
use super::{MutantRun, MutationOutcome};
use crate::error::DevError;
use crate::input::{WRITTEN_BY_HAND, read_text};
use crate::observation::state_hash;
use crate::output::{FileError, write_whole};
use crate::sampling::Random;
use crate::store::provenance::source_hash;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Every candidate of the solver, in the random order of a seed. A mutation is known by its place in that order.
#[derive(Debug)]
pub struct Draw {
    seed: u64,
    sources: BTreeMap<String, String>,
    order: Vec<Candidate>,
}

impl Draw {
    /// Draw of a seed, which depends on the seed and the sources only.
    ///
    /// # Errors
    /// A source that cannot be read, or is no Rust.
    pub fn new(workspace: &Path, seed: u64) -> Result<Self, DevError> {
        let root = workspace.join("solver").join("src");
        let sources = sources(&root)?;
        let mut order = Vec::new();
        for (file, text) in &sources {
            order.extend(candidates(file, text).map_err(|error| {
                let (file, line) = (root.join(file), error.span().start().line);
                let remedy = "mutations by rule need sources that compile";
                DevError::Stopped(format!("{}:{line}: {error}; {remedy}", file.display()))
            })?);
        }
        Random::new(seed).shuffle(&mut order);
        Ok(Self { seed, sources, order })
    }

    /// Number of candidates.
    pub fn count(&self) -> usize {
        self.order.len()
    }

    /// The candidate of a place in the order, as a record.
    pub fn mutation(&self, place: usize) -> Mutation {
        let candidate = &self.order[place];
        candidate.mutation(format!("drawn-{place}"), &self.sources[&candidate.file])
    }

    /// The first places that are not rejected and whose expressions do not overlap.
    fn first(&self, count: usize, rejected: &BTreeSet<usize>) -> Vec<usize> {
        let mut taken: Vec<usize> = Vec::new();
        for (place, candidate) in self.order.iter().enumerate() {
            let overlaps = |&other: &usize| {
                let Candidate { file, range, .. } = &self.order[other];
                *file == candidate.file && range.start < candidate.range.end && candidate.range.start < range.end
            };
            if taken.len() < count && !rejected.contains(&place) && !taken.iter().any(overlaps) {
                taken.push(place);
            }
        }
        taken
    }

    /// Builds a copy with the first N mutations that compile; returns their places and the program, which numbers them as in that list,
    /// from 1. What does not compile is rejected, and the next in the order takes its place.
    ///
    /// # Errors
    /// Files that cannot be written, and errors of the compiler that no mutation is near to.
    pub fn build(
        &self,
        workspace: &Path,
        count: usize,
        rejected: &mut BTreeSet<usize>,
        tell: &dyn Fn(&str),
    ) -> Result<(Vec<usize>, PathBuf), DevError> {
        loop {
            let places = self.first(count, rejected);
            let list: Vec<Mutation> = places.iter().map(|place| self.mutation(*place)).collect();
            let copy = SourceCopy::renew(workspace, &Mutations::of(list.clone()))?;
            let mut compilation = copy.compile(&["check", "-p", "bagnold-solver"])?;
            if compilation.errors().next().is_none() {
                compilation = copy.compile(&BUILD)?;
            }
            let wrong = culprits(&copy.tree, &list, compilation.errors());
            if wrong.is_empty() {
                compilation.whole(&copy)?;
                return Ok((places, copy.program()));
            }
            tell(&format!("{} of {} mutations do not compile, others take their places", wrong.len(), places.len()));
            rejected.extend(wrong.into_iter().map(|index| places[index]));
        }
    }
}

/// Texts of the files below a folder, by their paths in it; those of tests are left out.
fn sources(root: &Path) -> Result<BTreeMap<String, String>, FileError> {
    let (mut found, mut open) = (BTreeMap::new(), vec![root.to_owned()]);
    while let Some(folder) = open.pop() {
        let unreadable = |error| FileError::unreadable(&folder, &error);
        for entry in std::fs::read_dir(&folder).map_err(unreadable)? {
            let path = entry.map_err(unreadable)?.path();
            let name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
            if name == "tests" || name.ends_with("_tests") {
                continue;
            }
            if path.is_dir() {
                open.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let text = read_text(&path, WRITTEN_BY_HAND).map_err(|error| FileError::unreadable(&path, &error))?;
                let own = path.strip_prefix(root).unwrap_or(&path);
                found.insert(own.to_string_lossy().replace('\\', "/"), text);
            }
        }
    }
    Ok(found)
}

/// Mutations that contain the errors of the compiler; where an error stands in none, the nearest of its file.
fn culprits<'a>(tree: &Path, list: &[Mutation], errors: impl Iterator<Item = &'a Value>) -> BTreeSet<usize> {
    let place = |(index, mutation): (usize, &Mutation)| {
        let place = &mutation.places[0];
        let text = std::fs::read_to_string(tree.join("solver/src").join(&place.file)).unwrap_or_default();
        let beginning = beginning(index + 1);
        let start = text.find(&beginning).unwrap_or(0);
        let length = beginning.len() + place.instead.len() + " } else { }".len() + place.text.len();
        (index, place.file.clone(), start..start + length)
    };
    let places: Vec<_> = list.iter().enumerate().map(place).collect();
    let mut found: Vec<(usize, usize)> = Vec::new();
    for error in errors {
        let spans = error["spans"].as_array().into_iter().flatten().filter(|span| span["is_primary"] == true);
        let distances = spans.flat_map(|span| {
            let byte = |key: &str| span[key].as_u64().unwrap_or(0) as usize;
            let (start, end) = (byte("byte_start"), byte("byte_end"));
            let file = span["file_name"].as_str().unwrap_or_default().replace('\\', "/");
            let in_file = places.iter().filter(move |place| file.ends_with(&format!("solver/src/{}", place.1)));
            in_file.map(move |(index, _, range)| {
                (range.start.saturating_sub(end).max(start.saturating_sub(range.end)), *index)
            })
        });
        found.extend(distances.min());
    }
    let stands_in_one = found.iter().any(|(distance, _)| *distance == 0);
    found.into_iter().filter(|(distance, _)| *distance == 0 || !stands_in_one).map(|(_, index)| index).collect()
}

/// A case without an error: what it says, and which mutations of the draw its runs reach.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct TracedCase {
    /// Result without an error.
    pub right: MutantRun,
    /// Places in the order of the draw.
    pub reached: BTreeSet<usize>,
}

/// Findings of a draw; kept in a file, so that a command that was interrupted continues.
#[derive(Debug, Default, Serialize, Deserialize)]
pub struct DrawProgress {
    /// Places whose candidates do not compile.
    pub rejected: BTreeSet<usize>,
    /// Places that the cases were traced for.
    pub traced: BTreeSet<usize>,
    /// Every case by its name.
    pub cases: BTreeMap<String, TracedCase>,
    /// Outcomes of mutations by their places.
    pub outcomes: BTreeMap<usize, MutationOutcome>,
    /// Places that the tests were run for.
    pub tested: BTreeSet<usize>,
}

impl DrawProgress {
    /// Findings of a draw with this program, and the file that keeps them.
    pub fn open(workspace: &Path, draw: &Draw) -> (Self, PathBuf) {
        let sources: String = draw.sources.iter().map(|(file, text)| format!("{file}\n{text}")).collect();
        let digest = state_hash(format!("{}{sources}", source_hash()).as_bytes());
        let name = format!("drawn-{:x}-{digest}", draw.seed);
        let file = workspace.join("target").join("mutations").join(name);
        let kept = std::fs::read(&file).ok().and_then(|bytes| postcard::from_bytes(&bytes).ok());
        (kept.unwrap_or_default(), file)
    }

    /// Keeps it.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn save(&self, file: &Path) -> Result<(), FileError> {
        let bytes = postcard::to_stdvec(self).map_err(std::io::Error::other);
        bytes.and_then(|bytes| write_whole(file, &bytes)).map_err(|error| FileError::unwritable(file, &error))
    }

    /// The cases that reach a mutation, the cheapest first.
    pub fn cases_of(&self, place: usize) -> Vec<(&String, &TracedCase)> {
        let mut cases: Vec<_> = self.cases.iter().filter(|(_, case)| case.reached.contains(&place)).collect();
        cases.sort_by(|(_, a), (_, b)| a.right.wall_seconds.total_cmp(&b.right.wall_seconds));
        cases
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn workspace() -> PathBuf {
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
    }

    #[test]
    fn a_seed_gives_one_draw() {
        let drawn = |seed| {
            let draw = Draw::new(&workspace(), seed).expect("sources");
            assert!(draw.count() > 5000 && draw.sources.keys().all(|file| !file.contains("tests")), "{}", draw.count());
            let rejected = BTreeSet::from([0, 2]);
            let places = draw.first(30, &rejected);
            assert!(places.len() == 30 && places.is_sorted() && !places.iter().any(|place| rejected.contains(place)));
            places.into_iter().map(|place| draw.mutation(place)).collect::<Vec<_>>()
        };
        let (one, other) = (drawn(1), drawn(2));
        assert_eq!(one, drawn(1));
        assert_ne!(one, other);
    }

    #[test]
    fn an_error_belongs_to_the_mutation_that_it_stands_in_or_is_next_to() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let text = format!(
            "fn f() {{ ({} b }} else {{ a }}); }} fn g() {{ ({} d }} else {{ c }}); }}",
            beginning(1),
            beginning(2)
        );
        std::fs::create_dir_all(folder.path().join("solver/src")).expect("writable");
        std::fs::write(folder.path().join("solver/src/f.rs"), &text).expect("writable");
        let candidates = candidates("f.rs", "fn f() { -a; !c; }").expect("Rust");
        let list: Vec<_> = candidates.iter().map(|one| one.mutation(String::new(), "fn f() { -a; !c; }")).collect();
        let error = |at: usize, file: &str| json!({ "spans": [{ "is_primary": true, "file_name": file, "byte_start": at, "byte_end": at + 1 }] });
        let of = |errors: &[Value]| culprits(folder.path(), &list, errors.iter());
        let (second, end) = (text.find(" d }").expect("there"), text.len() - 1);
        assert_eq!(of(&[error(second, "solver/src/f.rs")]), BTreeSet::from([1]));
        assert_eq!(of(&[error(end, "solver/src/f.rs")]), BTreeSet::from([1]));
        assert_eq!(of(&[error(0, "solver/src/f.rs")]), BTreeSet::from([0]));
        assert_eq!(of(&[error(0, "solver/src/f.rs"), error(second, "solver/src/f.rs")]), BTreeSet::from([1]));
        assert_eq!(of(&[error(0, "solver/src/g.rs")]), BTreeSet::new());
    }

    #[test]
    fn findings_are_kept() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let file = folder.path().join("drawn");
        let right = |wall_seconds| MutantRun { metrics: Vec::new(), diverged: Vec::new(), wall_seconds };
        let case = |seconds, reached: &[usize]| TracedCase {
            right: right(seconds),
            reached: reached.iter().copied().collect(),
        };
        let progress = DrawProgress {
            cases: BTreeMap::from([("bagnold".to_owned(), case(3.0, &[1, 2])), ("film".to_owned(), case(2.0, &[1]))]),
            ..DrawProgress::default()
        };
        progress.save(&file).expect("writable");
        let kept: DrawProgress = postcard::from_bytes(&std::fs::read(&file).expect("there")).expect("readable");
        let names = |place| kept.cases_of(place).into_iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>();
        assert_eq!((names(1), names(2), names(3)), (vec!["film", "bagnold"], vec!["bagnold"], vec![]));
    }
}
