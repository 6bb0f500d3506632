//! Faults that the checker finds in a field, as messages for the user.

use super::error::ParameterError;
use crate::case::shown::notes::remark;
use crate::input::{FieldError, did_you_mean, nearest};
use bagnold_solver::parameter::{Fault, ParameterProblem};

/// Defect of a path that the parameters of a case do not have.
pub(in crate::case) const UNKNOWN_FIELD: &str = "unknown field";

/// A parameter that is out of its range, or excludes another choice.
impl From<ParameterProblem> for ParameterError {
    fn from(problem: ParameterProblem) -> Self {
        of_problem(&problem).into()
    }
}

fn of_problem(problem: &ParameterProblem) -> FieldError {
    FieldError::new(&problem.field, &problem.value, &problem.rule, &problem.remedy)
}

/// The error for a fault in the parameters of `case`; `known` are all paths that it has.
pub(in crate::case) fn in_parameters(fault: Fault, case: &str, known: &[String]) -> FieldError {
    match fault {
        Fault::Unknown { path, known: beside } => unknown_field(&path, &[&beside, known], case),
        Fault::Missing { path, absent } => {
            let of = |(name, about): &(String, String)| match about.as_str() {
                "" => format!("`{name}`"),
                _ => format!("`{name}` ({})", remark(about)),
            };
            let remedy = if absent.len() > 1 {
                format!("add {}", absent.iter().map(of).collect::<Vec<_>>().join(", "))
            } else if known.contains(&path) {
                format!("`bagnold show {case}` prints it with a valid value")
            } else {
                // of a table that is left out by default
                format!("`bagnold schema {case}` tells what it is")
            };
            FieldError::finding(&path, "missing", &remedy)
        }
        Fault::Kind { path, value, rule, choice } => {
            let value = value.unwrap_or_else(|| "not valid".to_owned());
            let rule = without_unit(rule, value.trim_matches('"'));
            FieldError::new(&path, value, &rule, &remedy(choice.as_ref(), case))
        }
        Fault::Range(problem) => of_problem(&problem),
    }
}

/// Error of an unknown field; `known` are the fields of the case, those of the same table first.
pub(in crate::case) fn unknown_field(path: &str, known: &[&[String]], case: &str) -> FieldError {
    let guess = did_you_mean(&nearest_path(path, known));
    FieldError::finding(path, UNKNOWN_FIELD, &format!("{guess}`bagnold show {case}` prints all fields"))
}

/// Rule for the message of a value: "a number without a unit" if a short word follows a number, otherwise `rule`.
pub(in crate::case) fn without_unit(rule: String, value: &str) -> String {
    let behind = value.trim_start_matches(|c: char| c.is_ascii_digit() || "+-.eE".contains(c)).trim_start();
    let is_unit = behind.chars().next().is_some_and(|first| first.is_alphabetic() || "°%".contains(first));
    let has_unit =
        rule == "a number" && behind.len() < value.len() && behind.len() <= 8 && is_unit && !behind.contains('=');
    if has_unit { "a number without a unit".to_owned() } else { rule }
}

/// Remedy for a value of the wrong type: the nearest name of an enum, or the command that shows a valid value.
pub(in crate::case) fn remedy(choice: Option<&(String, Vec<String>)>, case: &str) -> String {
    choice
        .and_then(|(name, known)| nearest(name, known.iter().map(String::as_str)))
        .map_or_else(|| format!("`bagnold show {case}` prints a valid value"), |name| format!("did you mean `{name}`?"))
}

/// Most tables with a field of the same name that a message lists.
const MOST_NAMESAKES: usize = 4;

/// The path that is most like one that does not exist, from the first list that has any; of one behind a prefix that does not
/// exist, the one without.
pub(in crate::case) fn nearest_path(path: &str, known: &[&[String]]) -> Option<String> {
    let name = path.rsplit('.').next().unwrap_or(path);
    // the angle stands for the coefficient, which is the one that the schema has
    let angle = path == "friction_angle";
    if let Some(coefficient) =
        known.iter().flat_map(|paths| *paths).find(|own| angle && own.ends_with(".static_friction"))
    {
        return Some(coefficient.replace("static_friction", path));
    }
    let bare = path.split_once('.').map(|(_, bare)| bare.to_owned());
    if let Some(bare) = bare.filter(|bare| known.iter().any(|paths| paths.contains(bare))) {
        return Some(bare);
    }
    // the same name in other tables
    let leaf = format!(".{name}");
    let is_namesake = |own: &&String| own.ends_with(&leaf) && *own != path;
    let namesakes = |paths: &&[String]| paths.iter().filter(is_namesake).cloned().collect::<Vec<_>>();
    if let Some(namesakes) = known.iter().map(namesakes).find(|found| (1..=MOST_NAMESAKES).contains(&found.len())) {
        return Some(namesakes.join("` or `"));
    }
    // the table that the path is in is no suggestion
    let is_above = |paths: &[String], other: &str| {
        let below = |own: &String| own.strip_prefix(other).is_some_and(|rest| rest.starts_with('.'));
        path.starts_with(other) && paths.iter().any(below)
    };
    known.iter().find_map(|paths| {
        let others = paths.iter().map(String::as_str);
        nearest(path, others.filter(|other| *other != path && !is_above(paths, other)))
    })
}
