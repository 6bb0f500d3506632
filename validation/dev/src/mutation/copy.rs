//! A copy of the program that holds all mutations, of which one is chosen as it starts.

use super::record::{FILE, Mutations};
use crate::case::ParameterError;
use crate::error::DevError;
use crate::input::{FieldError, WRITTEN_BY_HAND, read_text};
use crate::output::FileError;
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// By which the copy is told the number of the mutation; none or 0 for the program as it is; a file, to write there the numbers of the
/// mutations whose expressions it reaches.
pub const CHOICE: &str = "BAGNOLD_MUTATION";

/// Files and folders of a checkout from which the program is built.
const SOURCES: [&str; 7] = ["Cargo.toml", "Cargo.lock", "README.md", "solver", "validation", "tests", "reference-data"];

/// Module that the copy has in addition: it knows which mutation is chosen, or where to record which expressions are reached.
const CHOOSER: &str = "//! Which mutation is chosen.

use std::io::Write;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

const UNREAD: usize = usize::MAX;
const TRACED: usize = usize::MAX - 1;

static CHOSEN: AtomicUsize = AtomicUsize::new(UNREAD);
static TRACE: OnceLock<String> = OnceLock::new();
static REACHED: [AtomicBool; COUNT] = [const { AtomicBool::new(false) }; COUNT];

#[inline(always)]
pub(crate) fn is(number: usize) -> bool {
    let chosen = CHOSEN.load(Ordering::Relaxed);
    if chosen < TRACED { chosen == number } else { reach(number) }
}

#[cold]
#[inline(never)]
fn reach(number: usize) -> bool {
    if CHOSEN.load(Ordering::Relaxed) == UNREAD {
        let text = std::env::var(\"BAGNOLD_MUTATION\").unwrap_or_default();
        let chosen = match text.parse() {
            Err(_) if !text.is_empty() => TRACED,
            chosen => chosen.unwrap_or(0),
        };
        let _ = TRACE.set(text);
        CHOSEN.store(chosen, Ordering::Relaxed);
    }
    let chosen = CHOSEN.load(Ordering::Relaxed);
    if chosen == TRACED && !REACHED[number].load(Ordering::Relaxed) && !REACHED[number].swap(true, Ordering::Relaxed) {
        let file = std::fs::OpenOptions::new().create(true).append(true).open(TRACE.wait());
        file.and_then(|mut file| file.write_all(format!(\"{number}\\n\").as_bytes())).expect(\"a trace can be written\");
    }
    chosen == number
}
";

/// Command of cargo that builds the copy.
pub(super) const BUILD: [&str; 3] = ["build", "--bin", "bagnold-dev"];

/// The copy says nothing of what a mutation makes odd, such as a comparison that always holds.
const NO_LINTS: &str = "#![allow(warnings, arithmetic_overflow, unconditional_panic, overflowing_literals)]\n";

/// Makes or renews the copy below `target/mutations` of a checkout and builds it; returns the program.
///
/// # Errors
/// A text that does not stand once in its file, files that cannot be written, a copy that does not compile.
pub fn build(workspace: &Path, mutations: &Mutations) -> Result<PathBuf, DevError> {
    let copy = SourceCopy::renew(workspace, mutations)?;
    copy.compile(&BUILD)?.whole(&copy)?;
    Ok(copy.program())
}

/// The program of the tests that lie in `tests/`.
const SUITE: &str = "suite";

/// The target of cargo that has some tests.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct TestTarget {
    package: String,
    pub(crate) name: String,
    is_library: bool,
}

impl TestTarget {
    /// The targets that ask for physics: the solver's tests, and those of balances, orders and bits.
    pub fn of_physics() -> Vec<Self> {
        ["solver/src", "solver/tests", "tests/"].iter().filter_map(|source| Self::of(source)).collect()
    }

    /// The target of a source, by its path in the checkout.
    pub fn of(source: &str) -> Option<Self> {
        let mut folders = source.split('/');
        let (package, name, is_library) = match (folders.next()?, folders.next()?) {
            ("solver", "src") => ("bagnold-solver-tests".to_owned(), "solver".to_owned(), false),
            ("solver", "tests") => ("bagnold-solver-tests".to_owned(), "steps".to_owned(), false),
            ("tests", _) => ("bagnold-tests".to_owned(), SUITE.to_owned(), false),
            ("validation", "inference") => ("bagnold-inference-tests".to_owned(), "inference".to_owned(), false),
            ("validation", part) => (format!("bagnold-{part}"), format!("bagnold_{part}"), true),
            _ => return None,
        };
        Some(Self { package, name, is_library })
    }

    /// Filters of its tests that ask for physics; none where all of them do.
    pub fn physics(&self) -> &'static [&'static str] {
        if self.name == SUITE { &["invariants::", "convergence::", "determinism::"] } else { &[] }
    }
}

/// A test program of the copy.
#[derive(Debug, Clone)]
pub struct TestProgram {
    /// Target.
    pub target: TestTarget,
    /// The program.
    pub path: PathBuf,
    /// Folder that it runs in.
    pub folder: PathBuf,
}

/// Builds tests of the copy that [`build`] has made.
///
/// # Errors
/// Tests that do not compile.
pub fn build_tests(workspace: &Path, targets: &[TestTarget]) -> Result<Vec<TestProgram>, DevError> {
    let copy = SourceCopy::at(workspace);
    let mut arguments = vec!["test", "--no-run"];
    for target in targets {
        arguments.extend(["-p", &target.package]);
        if !target.is_library {
            arguments.extend(["--test", &target.name]);
        }
    }
    arguments.extend(targets.iter().any(|target| target.is_library).then_some("--lib"));
    let compiled = copy.compile(&arguments)?.whole(&copy)?;
    let test = |message: &Value| {
        let name = message["target"]["name"].as_str()?;
        Some(TestProgram {
            target: targets.iter().find(|target| target.name == name)?.clone(),
            path: message["executable"].as_str()?.into(),
            folder: Path::new(message["manifest_path"].as_str()?).parent()?.to_owned(),
        })
    };
    Ok(compiled.messages.iter().filter_map(test).collect())
}

/// Folders of the copy.
pub(super) struct SourceCopy {
    pub(super) tree: PathBuf,
    target: PathBuf,
}

/// Output of a command of cargo.
pub(super) struct Compilation {
    succeeded: bool,
    /// Objects of cargo's `--message-format=json`.
    messages: Vec<Value>,
    said: String,
}

impl Compilation {
    /// Errors of the compiler.
    pub(super) fn errors(&self) -> impl Iterator<Item = &Value> {
        self.messages.iter().map(|message| &message["message"]).filter(|message| message["level"] == "error")
    }

    /// # Errors
    /// Errors of the compiler.
    pub(super) fn whole(self, copy: &SourceCopy) -> Result<Self, DevError> {
        if self.succeeded {
            return Ok(self);
        }
        let first = self.errors().find_map(|error| error["rendered"].as_str()).unwrap_or(&self.said);
        let said = first.lines().take(12).collect::<Vec<_>>().join("\n");
        Err(copy.unbuilt(&said))
    }
}

impl SourceCopy {
    fn at(workspace: &Path) -> Self {
        let below = workspace.join("target").join("mutations");
        Self { tree: below.join("tree"), target: below.join("build") }
    }

    pub(super) fn renew(workspace: &Path, mutations: &Mutations) -> Result<Self, DevError> {
        let copy = Self::at(workspace);
        let changed = changed_sources(workspace, mutations)?;
        let unwritable = |error: io::Error| DevError::File(FileError::unwritable(&copy.tree, &error));
        std::fs::create_dir_all(&copy.tree).map_err(unwritable)?;
        for name in SOURCES {
            mirror(&workspace.join(name), &copy.tree.join(name), &changed, workspace).map_err(unwritable)?;
        }
        Ok(copy)
    }

    /// The copy that is not built, with the first of what was said to that.
    fn unbuilt(&self, said: &str) -> DevError {
        let folder = self.tree.display();
        DevError::Stopped(format!("failed to build a copy of the program with all mutations in {folder}: {said}"))
    }

    pub(super) fn program(&self) -> PathBuf {
        self.target.join("debug").join(format!("bagnold-dev{}", std::env::consts::EXE_SUFFIX))
    }

    pub(super) fn compile(&self, arguments: &[&str]) -> Result<Compilation, DevError> {
        let program = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
        let mut command = Command::new(program);
        command.args(arguments).args(["--quiet", "--locked", "--message-format=json", "--manifest-path"]);
        command.arg(self.tree.join("Cargo.toml")).arg("--target-dir").arg(&self.target).stdin(Stdio::null());
        let done = command.output().map_err(|error| self.unbuilt(&format!("cargo cannot be started ({error})")))?;
        let messages = String::from_utf8_lossy(&done.stdout);
        Ok(Compilation {
            succeeded: done.status.success(),
            messages: messages.lines().filter_map(|line| serde_json::from_str(line).ok()).collect(),
            said: String::from_utf8_lossy(&done.stderr).into_owned(),
        })
    }
}

/// Beginning of a choice in the copy.
pub(super) fn beginning(number: usize) -> String {
    format!("if crate::chosen_mutation::is({number}) {{")
}

/// An expression of a source, and what stands instead of it by the number of a mutation.
struct MutatedExpression {
    start: usize,
    end: usize,
    wrong: Vec<(usize, String)>,
}

impl MutatedExpression {
    /// The expression with its alternatives.
    fn expression(&self, source: &str) -> String {
        let wrong = |(number, text): &(usize, String)| format!("{} {text} }} else ", beginning(*number));
        let wrong: String = self.wrong.iter().map(wrong).collect();
        format!("({wrong}{{ {} }})", &source[self.start..self.end])
    }
}

/// The sources that differ in the copy, by their paths in the checkout.
fn changed_sources(workspace: &Path, mutations: &Mutations) -> Result<BTreeMap<PathBuf, String>, DevError> {
    let read = |path: &Path| {
        let file = workspace.join(path);
        read_text(&file, WRITTEN_BY_HAND).map_err(|error| FileError::unreadable(&file, &error))
    };
    let mut sources: BTreeMap<PathBuf, (String, Vec<MutatedExpression>)> = BTreeMap::new();
    for mutation in mutations.iter() {
        let number = mutations.number(mutation);
        for place in &mutation.places {
            let path = place.path();
            if !sources.contains_key(&path) {
                sources.insert(path.clone(), (read(&path)?, Vec::new()));
            }
            let (text, choices) = sources.get_mut(&path).expect("it was just read");
            let refused = |value: String, rule: &str, remedy: &str| {
                let error = FieldError::new(&format!("mutation \"{}\"", mutation.name), value, rule, remedy);
                DevError::from(ParameterError::from(error.in_file(&workspace.join(FILE))))
            };
            let needle = place.needle();
            let found: Vec<usize> = text.match_indices(&needle).map(|(start, _)| start).collect();
            let [at] = found[..] else {
                let rule =
                    format!("of a text that stands once in {}, where it stands {} times", place.file, found.len());
                return Err(refused(format!("`{needle}`"), &rule, "give the text as it stands there"));
            };
            let (start, end) = (at + place.after.len(), at + needle.len());
            match choices.iter_mut().find(|choice| choice.start < end && start < choice.end) {
                None => choices.push(MutatedExpression { start, end, wrong: vec![(number, place.instead.clone())] }),
                Some(same) if (same.start, same.end) == (start, end) => {
                    same.wrong.push((number, place.instead.clone()))
                }
                Some(_) => {
                    let rule = "of a text that overlaps with none of another mutation";
                    return Err(refused(format!("`{needle}`"), rule, "give the same text as the other one"));
                }
            }
        }
    }
    let changed = sources.into_iter().map(|(path, (mut text, mut choices))| {
        choices.sort_by_key(|choice| choice.start);
        for choice in choices.iter().rev() {
            let expression = choice.expression(&text);
            text.replace_range(choice.start..choice.end, &expression);
        }
        (path, text)
    });
    let mut changed: BTreeMap<PathBuf, String> = changed.collect();
    let count = format!("\nconst COUNT: usize = {};\n", mutations.iter().count() + 1);
    let root_of = |path: &PathBuf| path.ancestors().find(|folder| folder.ends_with("src")).map(Path::to_owned);
    let roots: BTreeSet<PathBuf> = changed.keys().filter_map(root_of).collect();
    for root in roots {
        let library = root.join("lib.rs");
        changed.insert(root.join("chosen_mutation.rs"), CHOOSER.to_owned() + &count);
        let text = changed.remove(&library).map_or_else(|| read(&library), Ok)?;
        changed.insert(library, NO_LINTS.to_owned() + &text + "\nmod chosen_mutation;\n");
    }
    Ok(changed)
}

/// Makes `to` what `from` is, but for changed files; what is the same already is not touched, so that little is built anew.
fn mirror(from: &Path, to: &Path, changed: &BTreeMap<PathBuf, String>, workspace: &Path) -> io::Result<()> {
    let kind = std::fs::symlink_metadata(from)?.file_type();
    if kind.is_symlink() {
        let target = std::fs::read_link(from)?;
        if std::fs::read_link(to).ok().as_ref() != Some(&target) {
            return link(&target, to);
        }
        return Ok(());
    }
    let path = from.strip_prefix(workspace).unwrap_or(from);
    if !kind.is_dir() {
        let contents = match changed.get(path) {
            Some(text) => text.clone().into_bytes(),
            None => std::fs::read(from)?,
        };
        return write_if_new(to, &contents);
    }
    std::fs::create_dir_all(to)?;
    let added = changed.iter().filter(|(own, _)| own.parent() == Some(path) && !workspace.join(own).exists());
    let mut kept: Vec<_> = Vec::new();
    for (own, text) in added {
        kept.extend(own.file_name().map(ToOwned::to_owned));
        write_if_new(&to.join(own.file_name().unwrap_or_default()), text.as_bytes())?;
    }
    for entry in std::fs::read_dir(from)? {
        let name = entry?.file_name();
        // workspaces of their own may have been built in their folders
        if name != "target" {
            mirror(&from.join(&name), &to.join(&name), changed, workspace)?;
            kept.push(name);
        }
    }
    for entry in std::fs::read_dir(to)? {
        let entry = entry?;
        if !kept.contains(&entry.file_name()) {
            let gone = entry.path();
            if entry.file_type()?.is_dir() { std::fs::remove_dir_all(gone)? } else { std::fs::remove_file(gone)? }
        }
    }
    Ok(())
}

fn write_if_new(to: &Path, contents: &[u8]) -> io::Result<()> {
    if std::fs::read(to).is_ok_and(|old| old == contents) { Ok(()) } else { std::fs::write(to, contents) }
}

#[cfg(unix)]
fn link(target: &Path, to: &Path) -> io::Result<()> {
    std::os::unix::fs::symlink(target, to)
}

#[cfg(not(unix))]
fn link(_: &Path, to: &Path) -> io::Result<()> {
    Err(io::Error::new(io::ErrorKind::Unsupported, format!("{}: links need another system", to.display())))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_text_stands_once_and_becomes_a_choice() {
        let workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
        let mutations = Mutations::read(&workspace).expect("a file of mutations");
        let changed = changed_sources(&workspace, &mutations).expect("every text stands once");
        let all: String = changed.values().map(String::as_str).collect();
        for mutation in mutations.iter() {
            let choices = all.matches(&format!("chosen_mutation::is({})", mutations.number(mutation))).count();
            assert_eq!(choices, mutation.places.len(), "{}", mutation.name);
            assert!(mutation.places.iter().all(|place| place.text != place.instead), "{}", mutation.name);
        }
        assert!(CHOOSER.contains(CHOICE));
    }

    #[test]
    fn a_copy_is_renewed_where_its_source_has_changed() {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let (from, to) = (folder.path().join("from/solver/src"), folder.path().join("to"));
        std::fs::create_dir_all(from.join("deep")).expect("writable");
        let write = |name: &str, text: &str| std::fs::write(from.join(name), text).expect("writable");
        write("a.rs", "a");
        write("deep/b.rs", "b");
        let workspace = folder.path().join("from");
        let changed = BTreeMap::from([
            (PathBuf::from("solver/src/a.rs"), "changed".to_owned()),
            (PathBuf::from("solver/src/new.rs"), "new".to_owned()),
        ]);
        let copy = || mirror(&from, &to, &changed, &workspace).expect("a copy");
        copy();
        let text = |name: &str| std::fs::read_to_string(to.join(name)).unwrap_or_default();
        assert_eq!([text("a.rs"), text("deep/b.rs"), text("new.rs")], ["changed", "b", "new"]);
        let before = std::fs::metadata(to.join("deep/b.rs")).and_then(|data| data.modified()).expect("a time");
        std::fs::remove_file(from.join("a.rs")).expect("there");
        copy();
        assert_eq!([text("a.rs"), text("new.rs")], ["changed", "new"], "what the copy adds stays");
        write("c.rs", "c");
        std::fs::remove_dir_all(from.join("deep")).expect("there");
        std::fs::create_dir_all(from.join("deep")).expect("writable");
        write("deep/b.rs", "b");
        copy();
        let after = std::fs::metadata(to.join("deep/b.rs")).and_then(|data| data.modified()).expect("a time");
        assert_eq!((text("c.rs").as_str(), before), ("c", after), "what is the same is not touched");
        std::fs::remove_file(from.join("c.rs")).expect("there");
        copy();
        assert!(!to.join("c.rs").exists());
    }
}
