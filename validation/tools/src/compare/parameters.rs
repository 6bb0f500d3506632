//! Parameters that are not the same in all folders.

use super::reading::Results;
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use toml::{Table, Value};

/// Longest value that is shown whole, in letters.
const LONGEST: usize = 60;

/// Values as TOML by path.
type Leaves = BTreeMap<String, String>;

/// A parameter in every folder that has its case.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct ChangedParameter {
    /// Name of the case.
    pub case: String,
    /// Dotted path of the parameter, as `--set` takes it; places in lists in brackets.
    pub path: String,
    /// Value in every folder as TOML; none where the folder has no such parameter.
    pub values: Vec<Option<String>>,
}

/// The parameters of each case that two folders have at least and that are not the same in all of them.
pub fn changed(all: &[Results]) -> Vec<ChangedParameter> {
    let cases: BTreeSet<&String> = all.iter().flat_map(|results| results.cases.keys()).collect();
    let own = |results: &Results, case: &str| Some(leaves(results.cases.get(case)?.parameters.as_ref()?));
    let of_case = |case: &String| differing(case, &all.iter().map(|results| own(results, case)).collect::<Vec<_>>());
    cases.into_iter().flat_map(of_case).collect()
}

/// Parameters that differ among the folders that state parameters.
fn differing(case: &str, all: &[Option<Leaves>]) -> Vec<ChangedParameter> {
    let given: Vec<&Leaves> = all.iter().flatten().collect();
    let paths: BTreeSet<&String> = given.iter().flat_map(|leaves| leaves.keys()).collect();
    let differs = |path: &&String| given.iter().any(|other| other.get(*path) != given[0].get(*path));
    let changed = |path: &String| {
        let value = |leaves: &Option<Leaves>| Some(shown(leaves.as_ref()?.get(path)?));
        ChangedParameter { case: case.to_owned(), path: path.clone(), values: all.iter().map(value).collect() }
    };
    paths.into_iter().filter(differs).map(changed).collect()
}

/// Every value that is neither a table nor a list of tables, by its path.
fn leaves(table: &Table) -> Leaves {
    let mut found = Leaves::new();
    for (key, value) in table {
        enter(&mut found, key.clone(), value);
    }
    found
}

fn enter(found: &mut Leaves, path: String, value: &Value) {
    match value {
        Value::Table(table) => {
            table.iter().for_each(|(key, value)| enter(found, format!("{path}.{key}"), value));
        }
        Value::Array(rows) if rows.iter().any(Value::is_table) => {
            rows.iter().enumerate().for_each(|(place, row)| enter(found, format!("{path}[{place}]"), row));
        }
        _ => {
            found.insert(path, value.to_string());
        }
    }
}

fn shown(value: &str) -> String {
    if value.chars().count() <= LONGEST {
        return value.to_owned();
    }
    value.chars().take(LONGEST - 1).chain(std::iter::once('…')).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn differences_are_found_in_tables_and_lists_of_tables() {
        let of = |text: &str| Some(leaves(&toml::from_str::<Table>(text).expect("TOML")));
        let text = "a = 1\nb = [1, 2]\n[law]\nmu = 0.4\n[[walls]]\nname = \"one\"\n[[walls]]\nname = \"two\"\n";
        let other = text.replace("0.4", "0.5").replace("two", "three").replace("a = 1\n", "");
        let all = [of(text), None, of(&other)];
        let found: Vec<(String, Vec<Option<String>>)> =
            differing("scene", &all).into_iter().map(|changed| (changed.path, changed.values)).collect();
        let some = |text: &str| Some(text.to_owned());
        assert_eq!(
            found,
            [
                ("a".to_owned(), vec![some("1"), None, None]),
                ("law.mu".to_owned(), vec![some("0.4"), None, some("0.5")]),
                ("walls[1].name".to_owned(), vec![some("\"two\""), None, some("\"three\"")]),
            ]
        );
        assert!(differing("scene", &[of(text), of(text)]).is_empty());
        assert_eq!(shown(&"é".repeat(100)).chars().count(), LONGEST);
    }
}
