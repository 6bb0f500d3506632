//! The mutations, as a file beside the sources holds them.

use super::Scope;
use crate::case::ParameterError;
use crate::evaluation::read_plan;
use crate::input::FieldError;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// File of the mutations, from the root of a checkout.
pub const FILE: &str = "validation/dev/mutations.toml";

/// An error that a programmer could make.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mutation {
    /// Name on the command line and in results.
    pub name: String,
    /// Description of the error, half a sentence.
    pub description: String,
    /// The cases that ought to notice, the likeliest first.
    #[serde(default)]
    pub cases: Vec<String>,
    /// The tests that ought to fail, where no case is asked: `path/of/file.rs::function`.
    #[serde(default)]
    pub tests: Vec<String>,
    /// Whether it was found by rule, and stands here because a gate kills it.
    #[serde(default)]
    pub generated: bool,
    /// Replacements in the sources.
    pub places: Vec<SourceReplacement>,
}

/// A text of the sources and the text instead of it.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SourceReplacement {
    /// File below `solver/src`, or from the root of the checkout where it begins with `validation/`.
    pub file: String,
    /// Text directly before `text`, where `text` alone is not unique.
    #[serde(default)]
    pub after: String,
    /// An expression.
    pub text: String,
    /// The wrong expression.
    pub instead: String,
}

/// All mutations of a checkout.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Mutations {
    /// Settings of `--set` by case, which shorten the runs.
    settings: BTreeMap<String, Vec<String>>,
    #[serde(rename = "mutation")]
    list: Vec<Mutation>,
}

impl SourceReplacement {
    /// The file from the root of the checkout.
    pub fn path(&self) -> PathBuf {
        let root = if self.file.starts_with("validation/") { "" } else { "solver/src" };
        Path::new(root).join(&self.file)
    }

    /// Text to search for in the file.
    pub fn needle(&self) -> String {
        format!("{}{}", self.after, self.text)
    }
}

impl Mutations {
    /// Reads the mutations from a checkout.
    ///
    /// # Errors
    /// A file that cannot be read or typed, or two of the same name.
    pub fn read(workspace: &Path) -> Result<Self, ParameterError> {
        let file = workspace.join(FILE);
        let all: Self = read_plan(&file, "bagnold-dev mutate")?;
        let mut names = BTreeSet::new();
        if let Some(twin) = all.list.iter().find(|mutation| !names.insert(&mutation.name)) {
            let error = FieldError::new("mutation.name", &twin.name, "unique", "rename one of them");
            return Err(error.in_file(&file).into());
        }
        Ok(all)
    }

    /// Mutations that stand in no file.
    pub fn of(list: Vec<Mutation>) -> Self {
        Self { settings: BTreeMap::new(), list }
    }

    /// All entries, in the file's order.
    pub fn iter(&self) -> impl Iterator<Item = &Mutation> {
        self.list.iter()
    }

    /// The one of that name.
    pub fn find(&self, name: &str) -> Option<&Mutation> {
        self.iter().find(|mutation| mutation.name == name)
    }

    /// The number by which a copy of the program chooses it, from 1.
    pub fn number(&self, mutation: &Mutation) -> usize {
        self.list.iter().position(|other| other == mutation).map_or(0, |place| place + 1)
    }

    /// The cases that ought to notice it, cut to what matters.
    pub fn scopes(&self, mutation: &Mutation) -> Vec<Scope> {
        mutation.cases.iter().map(|case| self.scope(case)).collect()
    }

    /// A case, reduced to what matters.
    pub fn scope(&self, case: &str) -> Scope {
        Scope { case: case.to_owned(), settings: self.settings.get(case).cloned().unwrap_or_default() }
    }
}
