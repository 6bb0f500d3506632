//! From defaults, a TOML file and `--set` to typed parameters, with errors that name the field.

use super::error::{ParameterError, SettingError};
use super::fault::Fault;
use crate::input::nearest;
use serde::{Serialize, de::DeserializeOwned};
use std::path::Path;
use toml::{Table, Value};

/// What the user asks to differ from a tier's parameters.
#[derive(Debug, Clone, Default)]
pub struct Changes<'a> {
    /// A file's fields, without `case` and `tier`, and where it stands.
    pub file: Option<(&'a Path, Table)>,
    /// `path=value` arguments, applied in order after the file.
    pub settings: &'a [String],
}

/// The parameters as a TOML table.
pub(super) fn table_of<P: Serialize>(parameters: &P) -> Table {
    Table::try_from(parameters).expect("a case's parameters are structs that TOML can hold")
}

/// Lays the changes over the defaults and types the result.
pub(super) fn resolve<P>(case: &str, defaults: &P, changes: &Changes<'_>) -> Result<P, ParameterError>
where
    P: Serialize + DeserializeOwned,
{
    let mut table = table_of(defaults);
    if let Some((file, fields)) = &changes.file {
        overlay(&mut table, fields);
        typed::<P>(&table).map_err(|fault| fault.in_parameters(case, &table).in_file(file))?;
    }
    for argument in changes.settings {
        set::<P>(case, &mut table, argument)?;
    }
    typed::<P>(&table).map_err(|fault| fault.in_parameters(case, &table))
}

/// Whether one of the `--set` arguments gives `field`, so that the file is not to blame for its value.
pub(super) fn is_set(settings: &[String], field: &str) -> bool {
    settings.iter().filter_map(|argument| argument.split_once('=')).any(|(path, _)| {
        let path = path.trim();
        field == path || field.strip_prefix(path).is_some_and(|rest| rest.starts_with(['.', '[']))
    })
}

/// Lays `changes` over `table`: tables field by field, everything else whole.
fn overlay(table: &mut Table, changes: &Table) {
    for (key, change) in changes {
        match (table.get_mut(key), change) {
            (Some(Value::Table(inner)), Value::Table(changed)) if !is_other_choice(inner, changed) => {
                overlay(inner, changed);
            }
            _ => {
                table.insert(key.clone(), change.clone());
            }
        }
    }
}

/// Whether `changed` picks another variant of an enum (a table with the variant's name as its only key),
/// whose fields must not be mixed with the default variant's.
fn is_other_choice(default: &Table, changed: &Table) -> bool {
    default.len() == 1 && default.values().all(Value::is_table) && !changed.keys().any(|key| default.contains_key(key))
}

/// Types the table. A field that the type silently ignores is as unknown as one that it refuses.
fn typed<P: Serialize + DeserializeOwned>(table: &Table) -> Result<P, Fault> {
    let parameters: P = Fault::catch(table)?;
    match ignored_field(table, &table_of(&parameters)) {
        Some(path) => Err(Fault::Unknown { path, known: Vec::new() }),
        None => Ok(parameters),
    }
}

fn ignored_field(given: &Table, understood: &Table) -> Option<String> {
    given.iter().find_map(|(key, value)| match (value, understood.get(key)) {
        (_, None) => Some(key.clone()),
        (Value::Table(given), Some(Value::Table(understood))) => {
            ignored_field(given, understood).map(|inner| format!("{key}.{inner}"))
        }
        _ => None,
    })
}

/// Applies one `path=value`.
fn set<P: Serialize + DeserializeOwned>(case: &str, table: &mut Table, argument: &str) -> Result<(), ParameterError> {
    let form = |table: &Table| SettingError::Form {
        argument: argument.to_owned(),
        example: paths(table)
            .into_iter()
            .find_map(|path| {
                find(table, &path).filter(|value| !value.is_table()).map(|value| format!("{path}={value}"))
            })
            .unwrap_or_else(|| "path=value".to_owned()),
    };
    let Some((path, text)) = argument.split_once('=').map(|(path, text)| (path.trim(), text.trim())) else {
        return Err(form(table).into());
    };
    if path.is_empty() || text.is_empty() {
        return Err(form(table).into());
    }
    let unknown = |table: &Table| {
        let known = paths(table);
        SettingError::Path {
            path: path.to_owned(),
            value: text.to_owned(),
            nearest: nearest(path, known.iter().map(String::as_str)),
            case: case.to_owned(),
        }
    };

    let mut changed = table.clone();
    let mut keys: Vec<&str> = path.split('.').collect();
    let Some(last) = keys.pop() else { return Err(form(table).into()) };
    let mut parent = &mut changed;
    for key in keys {
        parent = match parent.get_mut(key) {
            Some(Value::Table(inner)) => inner,
            _ => return Err(unknown(table).into()),
        };
    }
    // An optional field that is absent by default may be set: the type decides below whether it exists.
    match (parent.get_mut(last), value_of(text)) {
        (Some(Value::Table(inner)), Value::Table(change)) if !is_other_choice(inner, &change) => {
            overlay(inner, &change);
        }
        (_, value) => {
            parent.insert(last.to_owned(), value);
        }
    }
    match typed::<P>(&changed) {
        Ok(_) => {
            *table = changed;
            Ok(())
        }
        Err(Fault::Unknown { path: field, .. }) if field == path => Err(unknown(table).into()),
        Err(Fault::Value { path: field, rule, remedy }) if field == path => Err(SettingError::Value {
            path: path.to_owned(),
            value: text.to_owned(),
            rule,
            remedy: remedy.unwrap_or_else(|| format!("`bagnold show {case}` prints a valid value")),
        }
        .into()),
        Err(fault) => Err(fault.in_parameters(case, &changed)),
    }
}

/// A TOML value; what is not TOML is a word that the shell took the quotes from.
fn value_of(text: &str) -> Value {
    toml::from_str::<Table>(&format!("value = {text}"))
        .ok()
        // More than one key means that the text smuggled in a line of its own.
        .filter(|table| table.len() == 1)
        .and_then(|mut table| table.remove("value"))
        .unwrap_or_else(|| Value::String(text.to_owned()))
}

/// All dotted paths of a table, parents first.
pub(super) fn paths(table: &Table) -> Vec<String> {
    table
        .iter()
        .flat_map(|(key, value)| {
            let inner = value.as_table().map(paths).unwrap_or_default();
            std::iter::once(key.clone()).chain(inner.into_iter().map(move |path| format!("{key}.{path}")))
        })
        .collect()
}

/// The value at a dotted path.
pub(super) fn find<'a>(table: &'a Table, path: &str) -> Option<&'a Value> {
    let mut keys = path.split('.');
    let first = table.get(keys.next()?)?;
    keys.try_fold(first, |value, key| value.as_table()?.get(key))
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde::Deserialize;

    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Layer {
        depth: f64,
        rows: usize,
        angles: Vec<f64>,
        grains: Grains,
        law: Law,
    }

    // No `deny_unknown_fields`: the loader has to notice by itself.
    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    struct Grains {
        diameter: f64,
        spread: Option<f64>,
        packing: Packing,
    }

    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    #[serde(rename_all = "snake_case")]
    enum Packing {
        Lattice,
        Jittered,
    }

    #[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
    #[serde(rename_all = "snake_case", deny_unknown_fields)]
    enum Law {
        Newtonian { viscosity: f64 },
        Bingham { viscosity: f64, yield_stress: f64 },
    }

    fn layer() -> Layer {
        Layer {
            depth: 0.01,
            rows: 20,
            angles: vec![22.0, 24.0],
            grains: Grains { diameter: 1e-3, spread: None, packing: Packing::Lattice },
            law: Law::Newtonian { viscosity: 1.0 },
        }
    }

    fn resolved(file: &str, settings: &[&str]) -> Result<Layer, String> {
        let settings: Vec<String> = settings.iter().map(|&text| text.to_owned()).collect();
        let fields = toml::from_str(file).expect("test TOML");
        let changes = Changes { file: Some((Path::new("layer.toml"), fields)), settings: &settings };
        resolve("layer", &layer(), &changes).map_err(|error| error.to_string())
    }

    fn message(file: &str, settings: &[&str]) -> String {
        resolved(file, settings).expect_err("bad input must be refused")
    }

    #[test]
    fn a_file_and_settings_change_only_what_they_name() {
        let changed = resolved(
            "angles = [20]\ngrains.diameter = 2e-3\nlaw.bingham = { viscosity = 1, yield_stress = 2 }",
            &["rows=40", "grains.packing=jittered", "grains.spread=0.1", "law.bingham.yield_stress=3"],
        )
        .expect("valid changes");
        let expected = Layer {
            depth: 0.01,
            rows: 40,
            angles: vec![20.0],
            grains: Grains { diameter: 2e-3, spread: Some(0.1), packing: Packing::Jittered },
            law: Law::Bingham { viscosity: 1.0, yield_stress: 3.0 },
        };
        assert_eq!(changed, expected);
    }

    #[test]
    fn unknown_fields_are_refused_with_the_nearest_name() {
        assert_eq!(
            message("dept = 0.02", &[]),
            "layer.toml: unknown field `dept`; did you mean `depth`? `bagnold show layer` prints all fields"
        );
        assert_eq!(
            message("[grains]\ndiametre = 0.002", &[]),
            "layer.toml: unknown field `grains.diametre`; did you mean `grains.diameter`? `bagnold show layer` prints all fields"
        );
        assert_eq!(message("xyz = 1", &[]), "layer.toml: unknown field `xyz`; `bagnold show layer` prints all fields");
    }

    #[test]
    fn wrong_values_are_refused_with_the_type_they_should_have() {
        assert_eq!(
            message("depth = \"deep\"", &[]),
            "layer.toml: `depth` is \"deep\", but must be a number; `bagnold show layer` prints a valid value"
        );
        assert_eq!(
            message("rows = -3", &[]),
            "layer.toml: `rows` is -3, but must be a whole number that is not negative; `bagnold show layer` prints a valid value"
        );
        assert_eq!(
            message("grains.packing = \"latice\"", &[]),
            "layer.toml: `grains.packing` is \"latice\", but must be one of `lattice`, `jittered`; did you mean `lattice`?"
        );
        assert_eq!(
            message("law.bingham = { viscosity = 1, yield_stress = true }", &[]),
            "layer.toml: `law.bingham.yield_stress` is true, but must be a number; `bagnold show layer` prints a valid value"
        );
        assert_eq!(
            message("law.binghm.viscosity = 1", &[]),
            "layer.toml: `law.binghm` is { viscosity = 1 }, but must be one of `newtonian`, `bingham`; did you mean `bingham`?"
        );
        assert_eq!(
            message("law.bingham.viscosity = 1", &[]),
            "layer.toml: `law.bingham.yield_stress` is missing; `bagnold show layer` prints it with a valid value"
        );
    }

    #[test]
    fn settings_of_a_wrong_form_path_or_type_are_refused() {
        assert_eq!(
            message("", &["depth"]),
            "`--set depth` must have the form path=value; for example `--set angles=[22.0, 24.0]`"
        );
        assert_eq!(
            message("", &["grains.diametre=0.002"]),
            "`--set grains.diametre=0.002`: unknown field `grains.diametre`; did you mean `grains.diameter`? `bagnold show layer` prints all fields"
        );
        assert_eq!(
            message("", &["depth.x=1"]),
            "`--set depth.x=1`: unknown field `depth.x`; did you mean `depth`? `bagnold show layer` prints all fields"
        );
        assert_eq!(
            message("", &["rows=many"]),
            "`--set rows=many`: `rows` is many, but must be a whole number that is not negative; `bagnold show layer` prints a valid value"
        );
        assert_eq!(
            message("", &["rows=1\ndepth=3"]),
            "`--set rows=1\ndepth=3`: `rows` is 1\ndepth=3, but must be a whole number that is not negative; `bagnold show layer` prints a valid value"
        );
    }

    #[test]
    fn a_setting_takes_the_blame_for_its_field_only() {
        let settings = ["grains.diameter=1".to_owned(), "angles=[1]".to_owned()];
        assert!(is_set(&settings, "grains.diameter"));
        assert!(is_set(&settings, "angles[0]"));
        assert!(!is_set(&settings, "grains"));
        assert!(!is_set(&settings, "depth"));
    }
}
