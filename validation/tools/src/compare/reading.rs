//! Reads folders of `bagnold run` and `bagnold report`.

use super::roles::{self, PairedKey};
use crate::ToolError;
use crate::input::{STORED, read_text, shown, text_fault};
use crate::metric::Limit;
use crate::output::{ABSENT, FileError, Table};
use crate::result::{MetricEntry, MetricsDocument};
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// Contents of a folder.
#[derive(Debug, Clone)]
pub struct Results {
    /// The folder as it was named.
    pub folder: PathBuf,
    /// Label in legends and tables: the folder's name, as far as needed to distinguish it from others.
    pub label: String,
    /// Keys by which its runs are paired with those of the first folder.
    pub paired: Vec<PairedKey>,
    /// Cases by name.
    pub cases: BTreeMap<String, CaseResults>,
}

/// Contents of a folder for one case.
#[derive(Debug, Clone)]
pub struct CaseResults {
    /// Metrics of the case.
    pub document: MetricsDocument,
    /// Parameters; none where the folder has no `case.toml`.
    pub parameters: Option<toml::Table>,
    /// Profiles and histories, by file name; a report keeps none.
    pub tables: Vec<Table>,
}

impl Results {
    /// Reads folders, the first of which the others are compared with.
    ///
    /// # Errors
    /// A folder without results, a damaged file, folders without a variant in common.
    pub fn read(folders: &[PathBuf]) -> Result<Vec<Self>, ToolError> {
        let mut all: Vec<Self> = folders.iter().map(|folder| Self::of(folder)).collect::<Result<_, _>>()?;
        for (place, label) in labels(folders).into_iter().enumerate() {
            all[place].label = label;
        }
        if let Some((first, others)) = all.split_first_mut() {
            for other in others {
                for (name, own) in &first.cases {
                    let Some(theirs) = other.cases.get_mut(name) else { continue };
                    other.paired.extend(roles::pair(&own.document, &mut theirs.document, &mut theirs.tables));
                }
            }
        }
        if let Some((first, others)) = all.split_first() {
            let key = |(case, metric): (&str, &MetricEntry)| format!("{case} {} {}", metric.name, metric.variant);
            let keys: BTreeSet<String> = first.entries().map(key).collect();
            let is_apart = |other: &&Self| !other.entries().any(|entry| keys.contains(&key(entry)));
            if let Some(other) = others.iter().find(is_apart) {
                let apart = format!("has no variant of a case in common with {}", shown(&other.folder));
                let remedy = "so nothing can be compared; compare runs of the same variants";
                return Err(ToolError::at(&first.folder, format!("{apart}, {remedy}")));
            }
        }
        Ok(all)
    }

    /// Number of gates that another folder judges by another limit.
    pub fn moved_limits(&self, other: &Self) -> usize {
        self.moved_by_case(other).map(|(_, _, moved)| moved).sum()
    }

    /// Refuses a folder of the same parameters that was judged by other versions of the gates.
    ///
    /// # Errors
    /// The first case of which limits moved.
    pub fn same_gates(&self, other: &Self) -> Result<(), ToolError> {
        let is_version = |(own, theirs, moved): &(&CaseResults, &CaseResults, usize)| {
            *moved > 0 && own.parameters == theirs.parameters
        };
        self.moved_by_case(other).find(is_version).map_or(Ok(()), |(own, theirs, moved)| {
            let (own, theirs, other) = (&own.document, &theirs.document, shown(&other.folder));
            let gates = format!("the gates of {} were {} and are {} in {other}", own.case, own.gates, theirs.gates);
            let remedy = "compare the limits in both metrics.json, then the values with --across-gates";
            Err(ToolError::at(&self.folder, format!("{gates}: limits of {moved} gates changed; {remedy}")))
        })
    }

    fn moved_by_case<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = (&'a CaseResults, &'a CaseResults, usize)> {
        self.cases.iter().filter_map(|(name, own)| other.cases.get(name).map(|theirs| (own, theirs))).map(
            |(own, theirs)| {
                let key = |metric: &MetricEntry| format!("{} {}", metric.name, metric.variant);
                let limits: BTreeMap<String, Option<Limit>> =
                    theirs.document.metrics.iter().map(|one| (key(one), one.limit)).collect();
                let is_moved = |one: &&MetricEntry| limits.get(&key(one)).is_some_and(|limit| *limit != one.limit);
                (own, theirs, own.document.metrics.iter().filter(is_moved).count())
            },
        )
    }

    fn of(folder: &Path) -> Result<Self, ToolError> {
        let mut cases = BTreeMap::new();
        let of_report = folder.join("cases");
        let is_report = of_report.is_dir();
        let places = if is_report {
            let entries = std::fs::read_dir(of_report).map_err(|error| FileError::unreadable(folder, &error))?;
            entries.flatten().map(|entry| entry.path()).collect()
        } else {
            vec![folder.to_owned()]
        };
        for place in places.into_iter().filter(|place| place.join("metrics.json").is_file()) {
            let (document, parameters) = (document(&place.join("metrics.json"))?, parameters(&place)?);
            let tables = if is_report { Vec::new() } else { tables(&place.join("tables"))? };
            cases.insert(document.case.clone(), CaseResults { document, parameters, tables });
        }
        if cases.is_empty() {
            let nothing = "contains neither a run's metrics.json nor a report's cases/CASE/metrics.json";
            let remedy = "name a folder that `bagnold run` or `bagnold report` has written";
            return Err(ToolError::at(folder, format!("{nothing}; {remedy}")));
        }
        Ok(Self { folder: folder.to_owned(), label: String::new(), paired: Vec::new(), cases })
    }
}

/// The last parts of paths, as many as tell them apart; numbered where they are the same.
fn labels(folders: &[PathBuf]) -> Vec<String> {
    let parts: Vec<Vec<String>> = folders
        .iter()
        .map(|folder| folder.components().map(|part| part.as_os_str().to_string_lossy().into_owned()).collect())
        .collect();
    let longest = parts.iter().map(Vec::len).max().unwrap_or(0);
    let of = |count: usize| -> Vec<String> {
        parts.iter().map(|parts| parts[parts.len().saturating_sub(count)..].join("/")).collect()
    };
    let are_different = |labels: &[String]| {
        let mut sorted = labels.to_vec();
        sorted.sort();
        sorted.windows(2).all(|pair| pair[0] != pair[1])
    };
    (1..=longest).map(of).find(|labels| are_different(labels)).unwrap_or_else(|| {
        let numbered = of(1).into_iter().enumerate();
        numbered.map(|(place, label)| format!("{label} ({})", place + 1)).collect()
    })
}

fn text(file: &Path) -> Result<String, FileError> {
    read_text(file, STORED).map_err(|error| FileError::unreadable(file, &error))
}

fn damaged(file: &Path, reason: String) -> FileError {
    FileError::damaged(file, reason, "write the folder again with `bagnold run`")
}

fn document(file: &Path) -> Result<MetricsDocument, FileError> {
    serde_json::from_str(&text(file)?).map_err(|error| damaged(file, error.to_string()))
}

/// The parameters that a folder's `case.toml` gives; none where there is no such file.
fn parameters(folder: &Path) -> Result<Option<toml::Table>, FileError> {
    let file = folder.join("case.toml");
    if !file.is_file() {
        return Ok(None);
    }
    toml::from_str(&text(&file)?).map(Some).map_err(|error| damaged(&file, error.message().to_owned()))
}

/// Tables of numbers in a folder, by name; none where there is no such folder.
fn tables(folder: &Path) -> Result<Vec<Table>, FileError> {
    let Ok(entries) = std::fs::read_dir(folder) else { return Ok(Vec::new()) };
    let mut files: Vec<PathBuf> = entries.flatten().map(|entry| entry.path()).collect();
    files.retain(|file| file.extension().is_some_and(|ending| ending == "csv"));
    files.sort();
    files.iter().map(|file| table(file)).collect()
}

fn table(file: &Path) -> Result<Table, FileError> {
    let text = text(file)?;
    if let Some(fault) = text_fault(&text) {
        return Err(damaged(file, fault.to_string()));
    }
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let wrong = |error: csv::Error| damaged(file, error.to_string());
    let columns = reader.headers().map_err(wrong)?.iter().map(str::to_owned).collect();
    let row = |row: Result<Vec<Option<f64>>, _>| Ok(row?.into_iter().map(|cell| cell.unwrap_or(ABSENT)).collect());
    let rows = reader.deserialize().map(row).collect::<Result<Vec<Vec<f64>>, _>>().map_err(wrong)?;
    let name = file.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
    Ok(Table { name, columns, rows })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_are_as_short_as_they_can_be() {
        let of = |paths: &[&str]| labels(&paths.iter().map(PathBuf::from).collect::<Vec<_>>());
        assert_eq!(of(&["out/a", "out/b"]), ["a", "b"]);
        assert_eq!(of(&["a/out", "b/out"]), ["a/out", "b/out"]);
        assert_eq!(of(&["out", "out"]), ["out (1)", "out (2)"]);
    }

    #[test]
    fn a_folder_without_results_is_refused() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let error = Results::read(&[folder.path().to_owned()]).expect_err("empty");
        assert!(error.to_string().contains("contains neither a run's metrics.json nor"), "{error}");
        std::fs::write(folder.path().join("metrics.json"), "{}").expect("writable");
        let error = Results::read(&[folder.path().to_owned()]).expect_err("damaged");
        assert!(error.to_string().contains("metrics.json: damaged (missing field"), "{error}");
    }
}
