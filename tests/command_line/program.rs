//! The built program and a folder of its own for each test.

use assert_cmd::Command;
use assert_cmd::assert::Assert;
use bagnold_harness::result::MetricsDocument;
use bagnold_harness::store::{Store, StorePolicy};
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// One Newtonian film of ten rows: a quarter of a second, and its gates hold.
pub(crate) const CHEAP: &[&str] = &["film", "--vary", "resolution=10"];

/// The program that belongs to this test; `cargo test` of the whole workspace builds it.
pub(crate) fn path() -> PathBuf {
    let test = std::env::current_exe().expect("the test knows its own path");
    let folder = test.parent().and_then(Path::parent).expect("a test stands in target/PROFILE/deps");
    let program = folder.join(format!("bagnold{}", std::env::consts::EXE_SUFFIX));
    assert!(
        program.is_file(),
        "{} does not exist: run `cargo test` at the root of the workspace, or `cargo build --bin bagnold` first",
        program.display()
    );
    program
}

/// The store that reports and the tests of physics use.
pub(crate) fn usual_store() -> PathBuf {
    let store = Store::open(StorePolicy::Use).root().to_owned();
    std::fs::create_dir_all(&store).and_then(|()| store.canonicalize()).expect("a store")
}

/// A new folder in which the program runs, and where its results and its store are.
pub(crate) struct Place {
    folder: TempDir,
}

impl Place {
    pub(crate) fn new() -> Self {
        Self { folder: tempfile::tempdir().expect("a temporary folder") }
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Names of what lies in the folder, sorted.
    pub(crate) fn names(&self) -> Vec<String> {
        let entries = std::fs::read_dir(self.folder.path()).expect("readable").flatten();
        let mut names: Vec<String> = entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }

    /// Writes a file and returns its path as text.
    pub(crate) fn file(&self, name: &str, contents: &str) -> String {
        let path = self.path(name);
        std::fs::write(&path, contents).expect("writable");
        path.display().to_string()
    }

    /// The program with a store that no other test uses.
    pub(crate) fn bagnold(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(path());
        command.current_dir(self.folder.path()).env("BAGNOLD_STORE", self.path("store")).args(arguments);
        command
    }

    /// The program with the usual store: what a report or another test has simulated is not simulated again.
    pub(crate) fn sharing(&self, arguments: &[&str]) -> Command {
        let mut command = self.bagnold(arguments);
        command.env("BAGNOLD_STORE", usual_store());
        command
    }

    /// `bagnold run … --out out`.
    pub(crate) fn run(&self, arguments: &[&str]) -> Assert {
        self.bagnold(&[&["run", "--out", "out"], arguments].concat()).assert()
    }
}

/// Standard output as the document that it must be, and nothing else.
pub(crate) fn document(finished: &Assert) -> MetricsDocument {
    let text = String::from_utf8_lossy(&finished.get_output().stdout);
    let document: MetricsDocument =
        serde_json::from_str(&text).unwrap_or_else(|error| panic!("not one JSON document ({error}):\n{text}"));
    // its first use declares what these tests are built from
    std::sync::LazyLock::force(&bagnold_validation::REGISTRY);
    assert_eq!(
        document.provenance.source_hash,
        bagnold_harness::store::source_hash(),
        "the program is older than this test: run `cargo build --bin bagnold`"
    );
    document
}
