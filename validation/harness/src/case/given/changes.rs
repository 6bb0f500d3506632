//! From defaults, a TOML file and `--set` to typed parameters, with errors that name the field.

use super::error::ParameterError;
use super::{fault, friction_angle, plausible};
use crate::case::plan::estimate::Limits;
use crate::input::FieldError;
use crate::metric::Variant;
use crate::output::caution;
use bagnold_solver::material::rheology::open::registered;
use bagnold_solver::parameter::{Fault, Shape, first_fault};
use serde::{Serialize, de::DeserializeOwned};
use serde_json::Value as Schema;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use toml::{Table, Value};

/// User's changes to the parameters of a tier.
#[derive(Debug, Clone, Default)]
pub struct Changes<'a> {
    /// Path of a case file and its fields without `case` and `tier`.
    pub file: Option<(&'a Path, Table)>,
    /// `path=value` arguments, applied after the file; each sets different fields.
    pub settings: &'a [String],
    /// Resource limits of the runs.
    pub limits: Limits,
    /// Keys of the runs that are to be simulated; all runs where there are none. What concerns only other runs is not refused.
    pub only: &'a [Variant],
}

/// Source of the user's parameters, for errors that occur after the changes are discarded.
#[derive(Debug, Default)]
pub(in crate::case) struct ParameterSource {
    file: Option<PathBuf>,
    settings: Vec<String>,
}

impl ParameterSource {
    /// An error whose field stands in the user's file, or that names none of his fields, says which file it is.
    pub(in crate::case) fn placed(&self, error: ParameterError) -> ParameterError {
        let names_none = matches!(error, ParameterError::Changed { .. });
        match &self.file {
            Some(file) if error.field_path().map_or(names_none, |field| !is_set(&self.settings, field)) => {
                error.in_file(file)
            }
            _ => error,
        }
    }
}

impl Changes<'_> {
    /// Source of these changes: the file and the `--set` arguments.
    pub(in crate::case) fn source(&self) -> ParameterSource {
        ParameterSource {
            file: self.file.as_ref().map(|(file, _)| file.to_path_buf()),
            settings: self.settings.to_vec(),
        }
    }

    /// An error of the parameters as a whole, with the file where it is to blame. Of a field that is named without its path only what else
    /// was given tells whether an argument or the file holds it.
    pub(in crate::case) fn blamed(&self, error: ParameterError) -> ParameterError {
        let has_path = error.field_path().is_some_and(|field| field.contains('['));
        if has_path || self.settings.is_empty() { self.source().placed(error) } else { error }
    }

    /// The same, with lists empty that a file leaves out.
    pub(in crate::case) fn with_lists(&self, [of_flow, of_runs]: [&[&str]; 2]) -> Self {
        let mut changes = self.clone();
        if let Some((_, fields)) = &mut changes.file {
            let of_runs = if fields.is_empty() { &[] } else { of_runs };
            for list in of_flow.iter().chain(of_runs) {
                fields.entry(*list).or_insert_with(|| Value::Array(Vec::new()));
            }
        }
        changes
    }
}

/// The parameters as a TOML table.
pub(in crate::case) fn table_of<P: Serialize>(parameters: &P) -> Table {
    Table::try_from(parameters).expect("a case's parameters are structs that TOML can hold")
}

/// The values of a table whose fields are sound.
///
/// # Errors
/// What no schema can tell, such as what the maker of a law of the user's own says of its parameters.
pub(in crate::case) fn typed<T: DeserializeOwned>(case: &str, table: Table) -> Result<T, ParameterError> {
    Value::Table(table).try_into().map_err(|error: toml::de::Error| {
        let usual = format!("`bagnold show {case}` prints valid ones");
        let (field, value, rule, remedy) = said(error.message()).unwrap_or(("parameters", error.message(), "", &usual));
        ParameterError::field(field, value, rule, remedy)
    })
}

/// The defaults with the changes, each field checked along the schema.
pub(in crate::case) fn checked(
    case: &str,
    schema: &'static Schema,
    defaults: &Table,
    changes: &Changes<'_>,
    set_for_all: fn(&mut Table, &[String]),
) -> Result<Table, ParameterError> {
    let mut table = defaults.clone();
    if let Some((_, fields)) = &changes.file {
        overlay(schema, &mut table, fields);
    }
    let mut settings = Table::new();
    for (index, argument) in changes.settings.iter().enumerate() {
        refuse_twice(&changes.settings[..index], argument)?;
        refuse_beside_read(changes, argument)?;
        add_setting(defaults, &mut settings, argument)?;
    }
    let file = changes.file.as_ref().map(|(file, fields)| (Some(*file), fields));
    for (file, fields) in file.into_iter().chain([(None, &settings)]) {
        if let Some(error) = friction_angle::wrong(fields, "") {
            return Err(error.given_in(file));
        }
    }
    // Together, so that a law and its parameters may come in any order.
    overlay(schema, &mut table, &settings);
    set_for_all(&mut table, &leaves(&settings));
    // what a setting corrects is not warned of
    let of_file = changes.file.iter().flat_map(|(_, fields)| plausible::warnings(fields));
    let of_file = of_file.filter(|(path, _)| !is_set(changes.settings, path));
    let given = of_file.chain(plausible::warnings(&settings)).map(|(_, text)| text);
    let unlikely: Vec<String> = given.chain(plausible::wide_grains(&table)).collect();
    let value = Value::Table(table);
    if let Some(fault) = first_fault(schema, &value).or_else(|| unknown_law(schema, &value, "")) {
        return Err(blame(fault, case, defaults, changes));
    }
    unlikely.iter().for_each(|warning| caution(warning));
    let Value::Table(table) = value else { return Ok(Table::new()) };
    Ok(table)
}

/// Fields by which an entry of a list names a file that is read with the case file, each with those that the file is read by.
const READ_WITH_THE_FILE: [(&str, &[&str]); 2] =
    [("table", &["table"]), ("mesh", &["mesh", "unit", "scale", "rotate", "move"])];

/// Refuses a setting of how a file is read that has been read with the case file: its contents would stay.
fn refuse_beside_read(changes: &Changes<'_>, argument: &str) -> Result<(), FieldError> {
    let named = || {
        let ((path, _), (_, fields)) = (parts(argument)?, changes.file.as_ref()?);
        let (place, field) = path.rsplit_once('.')?;
        let (list, index) = place.strip_suffix(']')?.split_once('[')?;
        let entry = fields.get(list)?.as_array()?.get(index.parse::<usize>().ok()?)?.as_table()?;
        let is_read = |name: &str| entry.get(name).and_then(Value::as_str).is_some_and(|name| !name.is_empty());
        READ_WITH_THE_FILE.iter().find(|(name, with)| with.contains(&field) && is_read(name))?;
        let defect = "cannot be set, because its file has been read with the case file";
        Some(FieldError::finding(path, defect, "change it in the case file, or in a copy").set_by(argument.to_owned()))
    };
    named().map_or(Ok(()), Err)
}

/// Refuses lists of values that are runs of one flow now.
pub(in crate::case) fn refuse_former(
    former: &BTreeMap<String, String>,
    changes: &Changes<'_>,
) -> Result<(), ParameterError> {
    let of_file = changes.file.iter().flat_map(|(file, fields)| fields.iter().map(|field| (Some(*file), field)));
    let of_file = of_file.map(|(file, (path, _))| (file, path.as_str()));
    let set = changes.settings.iter().filter_map(|setting| parts(setting));
    for (file, old) in of_file.chain(set.map(|(path, _)| (None, path))) {
        let now = former.get(old).or_else(|| former.get(old.split('.').next()?));
        if let Some(now) = now {
            let defect = format!("replaced by the single value `{now}`");
            let remedy = format!("for several, use `--vary {now}=A,B,C`, or in a file [[vary]] with path = \"{now}\"");
            return Err(ParameterError::field(old, defect, "", &remedy).given_in(file));
        }
    }
    Ok(())
}

/// Field, value, rule and remedy of what the maker of a law says of a parameter, where it says all four.
fn said(message: &str) -> Option<(&str, &str, &str, &str)> {
    let (field, rest) = message.strip_prefix('`')?.split_once("` is ")?;
    let (value, rest) = rest.split_once(", but must be ")?;
    let (rule, remedy) = rest.split_once("; ")?;
    Some((field, value, rule, remedy.trim_end()))
}

/// A law that is neither the solver's nor one of the user's own: the schema leaves the names of the latter open.
pub(in crate::case) fn unknown_law(schema: &Schema, value: &Value, path: &str) -> Option<Fault> {
    let below = |name: &str| if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
    match (Shape::of(schema), value) {
        (Shape::Tagged { tag, variants, open: true }, Value::Table(fields)) => {
            let name = fields.get(tag)?.as_str()?;
            let built_in = variants.iter().map(|variant| variant.name);
            let names: Vec<String> = built_in.chain(registered()).map(str::to_owned).collect();
            (!names.iter().any(|known| known == name)).then(|| Fault::Kind {
                path: below(tag),
                value: Some(format!("{name:?}")),
                rule: format!("one of `{}`", names.join("`, `")),
                choice: Some((name.to_owned(), names)),
            })
        }
        (Shape::Fields { properties, .. }, Value::Table(fields)) => fields
            .iter()
            .find_map(|(name, value)| properties.get(name).and_then(|schema| unknown_law(schema, value, &below(name)))),
        (Shape::List(item), Value::Array(values)) => {
            values.iter().enumerate().find_map(|(index, value)| unknown_law(item, value, &format!("{path}[{index}]")))
        }
        _ => None,
    }
}

/// The error for a fault: that of the `--set` which gives the field, else of the file.
fn blame(fault: Fault, case: &str, defaults: &Table, changes: &Changes<'_>) -> ParameterError {
    let known = paths(defaults);
    let arguments = changes.settings.iter().rev().filter_map(|argument| parts(argument));
    // A path that leads through a value: `depth.x` makes `depth` a table, and no number.
    if let Fault::Kind { path: field, .. } = &fault
        && let Some((path, value)) =
            arguments.clone().find(|(path, _)| path.strip_prefix(field).is_some_and(|rest| rest.starts_with('.')))
        && !find(defaults, field).is_some_and(Value::is_table)
    {
        return unknown_path(case, &[&known], path, value);
    }
    // of an unknown table the whole path: `water.resolution`, and not `water`
    let is_unknown = matches!(fault, Fault::Unknown { .. });
    let exact = arguments.clone().find(|(path, _)| *path == fault.path() || is_unknown && is_below(path, fault.path()));
    match (fault, exact) {
        (Fault::Unknown { known: beside, .. }, Some((path, value))) => {
            unknown_path(case, &[&beside, &known], path, value)
        }
        (Fault::Kind { rule, choice, .. }, Some((path, value))) => {
            let (rule, remedy) = (fault::without_unit(rule, value), fault::remedy(choice.as_ref(), case));
            FieldError::new(path, value, &rule, &remedy).set_by(format!("{path}={value}")).into()
        }
        (fault, _) => {
            let file = changes.file.as_ref().filter(|_| !is_set(changes.settings, fault.path()));
            ParameterError::from(fault::in_parameters(fault, case, &known)).given_in(file.map(|(file, _)| *file))
        }
    }
}

/// A path that does not exist; `known` are those that do, the ones beside it first.
fn unknown_path(case: &str, known: &[&[String]], path: &str, value: &str) -> ParameterError {
    fault::unknown_field(path, known, case).set_by(format!("{path}={value}")).into()
}

/// Whether one of the `--set` arguments gives `field`, so that the file is not to blame for its value.
pub(in crate::case) fn is_set(settings: &[String], field: &str) -> bool {
    settings.iter().filter_map(|argument| parts(argument)).any(|(path, _)| is_within(field, path))
}

/// Place of the setting that a case does not take: it lacks the field, or a study gives it values itself.
pub fn untaken(error: &ParameterError, settings: &[String]) -> Option<usize> {
    let ParameterError::Field(FieldError { field, value, .. }) = error else { return None };
    let is_at_fault = |setting: &String| match field.as_str() {
        "--set" => setting == value,
        _ => value == fault::UNKNOWN_FIELD && is_set(std::slice::from_ref(setting), field),
    };
    settings.iter().position(is_at_fault)
}

/// Whether a field is another, or lies within it.
fn is_within(field: &str, other: &str) -> bool {
    field.strip_prefix(other).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}

/// Whether a field is another, or lies within it, or holds it.
pub(in crate::case) fn is_same_or_within(field: &str, other: &str) -> bool {
    is_within(field, other) || is_within(other, field)
}

/// Path and value of a `--set` argument.
fn parts(argument: &str) -> Option<(&str, &str)> {
    argument.split_once('=').map(|(path, value)| (path.trim(), value.trim()))
}

/// Lays `changes` over `table`: tables field by field, everything else whole; another choice of an enum replaces the
/// table's, whose fields are not its own.
pub(in crate::case) fn overlay(schema: &Schema, table: &mut Table, changes: &Table) {
    let shape = Shape::of(schema);
    let chosen = shape.chosen(&Value::Table(changes.clone())).or_else(|| shape.chosen(&Value::Table(table.clone())));
    let in_degrees = friction_angle::as_coefficient(chosen.and_then(|variant| variant.content), changes);
    if let Some(changes) = &in_degrees {
        friction_angle::warn_of_the_rest(table, changes);
    }
    let changes = in_degrees.as_ref().unwrap_or(changes);
    if is_other_choice(&shape, table, changes) {
        table.clone_from(changes);
        return;
    }
    let content = |key: &str| match &shape {
        Shape::Choice(_) => chosen.filter(|variant| variant.name == key).and_then(|variant| variant.content),
        Shape::Tagged { .. } => chosen.and_then(|variant| variant.content?.get("properties")?.get(key)),
        Shape::Fields { properties, .. } => properties.get(key),
        _ => None,
    };
    for (key, change) in changes {
        let (schema, value) = match entry_of(key) {
            Some((list, index)) => {
                let entries = table.get_mut(list).and_then(Value::as_array_mut);
                let schema = content(list).and_then(|list| match Shape::of(list) {
                    Shape::List(entry) => Some(entry),
                    _ => None,
                });
                (schema, entries.and_then(|entries| entries.get_mut(index)))
            }
            None => (content(key), table.get_mut(key)),
        };
        match (value, change) {
            (Some(Value::Table(inner)), Value::Table(changed)) => {
                overlay(schema.unwrap_or(&Schema::Null), inner, changed);
            }
            (Some(value), _) => *value = change.clone(),
            (None, _) => {
                table.insert(key.clone(), change.clone());
            }
        }
    }
}

/// The list and the entry in it that a key such as `gauges[0]` names.
fn entry_of(key: &str) -> Option<(&str, usize)> {
    let (list, index) = key.strip_suffix(']')?.split_once('[')?;
    Some((list, index.parse().ok()?))
}

/// Overwrites values of a table: nested tables field by field, other values as a whole.
pub(in crate::case) fn lay_over(table: &mut Table, over: &Table) {
    over.iter().for_each(|(path, value)| lay_at(table, path, value));
}

/// Puts a value at a dotted path of a table.
pub(in crate::case) fn lay_at(table: &mut Table, path: &str, value: &Value) {
    match path.split_once('.') {
        Some((first, rest)) => {
            let inner = table.entry(first).or_insert_with(|| Value::Table(Table::new()));
            if !inner.is_table() {
                *inner = Value::Table(Table::new());
            }
            if let Value::Table(inner) = inner {
                lay_at(inner, rest, value);
            }
        }
        None => match (table.get_mut(path), value) {
            (Some(Value::Table(inner)), Value::Table(changes)) => {
                lay_over(inner, changes);
            }
            _ => {
                table.insert(path.to_owned(), value.clone());
            }
        },
    }
}

/// Whether `changes` picks another variant of an enum than `table`.
fn is_other_choice(shape: &Shape<'_>, table: &Table, changes: &Table) -> bool {
    match shape {
        Shape::Choice(_) => !changes.keys().any(|key| table.contains_key(key)),
        Shape::Tagged { tag, .. } => changes.get(*tag).is_some_and(|choice| table.get(*tag) != Some(choice)),
        _ => false,
    }
}

/// Refuses a `path=value` that gives a field which one before it gives: which is meant would be ambiguous.
fn refuse_twice(before: &[String], argument: &str) -> Result<(), FieldError> {
    for earlier in before {
        if let Some(field) = twice_given(earlier, argument) {
            let defect = format!("given twice, first by `--set {earlier}`");
            return Err(FieldError::finding(&field, defect, "give each field once").set_by(argument.to_owned()));
        }
    }
    Ok(())
}

/// The field that a `path=value` gives which another one, before it, gives as well. A path that leads through a value is
/// refused as a path that does not exist.
pub fn twice_given(earlier: &str, argument: &str) -> Option<String> {
    let ((path, value), (other, first)) = (parts(argument)?, parts(earlier)?);
    let is_given_by = |field: &String| {
        given_by(other, first).iter().any(|given| given == field || is_below(given, field) || is_below(field, given))
    };
    let twice = given_by(path, value).into_iter().find(is_given_by);
    twice.filter(|_| !is_below(path, other) || value_of(first).is_table())
}

/// The fields that a setting gives: its path, or of a table those in it.
fn given_by(path: &str, value: &str) -> Vec<String> {
    match value_of(value) {
        Value::Table(table) => leaves(&table).into_iter().map(|field| format!("{path}.{field}")).collect(),
        _ => vec![path.to_owned()],
    }
}

/// Whether a path leads through another one.
fn is_below(path: &str, above: &str) -> bool {
    path.strip_prefix(above).is_some_and(|rest| rest.starts_with('.'))
}

/// Adds one `path=value` to the table of all that are set.
fn add_setting(defaults: &Table, settings: &mut Table, argument: &str) -> Result<(), FieldError> {
    let Some((path, text)) = parts(argument).filter(|(path, text)| !path.is_empty() && !text.is_empty()) else {
        let example = paths(defaults)
            .into_iter()
            .find_map(|path| {
                find(defaults, &path).filter(|value| !value.is_table()).map(|value| format!("{path}={value}"))
            })
            .unwrap_or_else(|| "path=value".to_owned());
        let path = format!("\"{}\"", argument.split('=').next().unwrap_or_default());
        let rule = "the dotted path of a parameter, followed by `=` and a value";
        let error = FieldError::new("path", path, rule, &format!("write it as in `{example}`"));
        return Err(error.set_by(argument.to_owned()));
    };
    lay_at(settings, path, &value_of(text));
    Ok(())
}

/// The tables that some `path=value` settings make; those that are no settings are left out.
pub fn table_of_settings(settings: &[String]) -> Table {
    let mut table = Table::new();
    for setting in settings {
        // a setting that is refused is refused where it is applied
        let _ = add_setting(&Table::new(), &mut table, setting);
    }
    table
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

/// The dotted paths of all values that are no tables.
pub fn leaves(table: &Table) -> Vec<String> {
    paths(table).into_iter().filter(|path| find(table, path).is_some_and(|value| !value.is_table())).collect()
}

/// All dotted paths of a table, parents first.
pub(in crate::case) fn paths(table: &Table) -> Vec<String> {
    table
        .iter()
        .flat_map(|(key, value)| {
            let inner = value.as_table().map(paths).unwrap_or_default();
            std::iter::once(key.clone()).chain(inner.into_iter().map(move |path| format!("{key}.{path}")))
        })
        .collect()
}

/// The value at a dotted path.
pub(in crate::case) fn find<'a>(table: &'a Table, path: &str) -> Option<&'a Value> {
    let mut keys = path.split('.');
    let first = table.get(keys.next()?)?;
    keys.try_fold(first, |value, key| value.as_table()?.get(key))
}

#[cfg(test)]
mod tests;
