//! Friction of grains given as an angle, whose tangent is the coefficient.

use super::error::ParameterError;
use crate::input::number_in;
use crate::output::caution_about;
use serde_json::Value as Schema;
use toml::{Table, Value};

/// Name of the field that gives a static friction coefficient as an angle.
const ANGLE: &str = "friction_angle";

/// Name of the field that a friction angle sets, by its tangent.
const COEFFICIENT: &str = "static_friction";

/// The first friction angle `[°]` that has no tangent to stand for, or stands beside what it stands for.
pub(in crate::case) fn wrong(fields: &Table, above: &str) -> Option<ParameterError> {
    fields.iter().find_map(|(key, value)| {
        let path = if above.is_empty() { key.clone() } else { format!("{above}.{key}") };
        match value {
            Value::Table(inner) => wrong(inner, &path),
            Value::String(text) if key == ANGLE => {
                let rule = "a number of degrees without its unit";
                Some(ParameterError::field(&path, format!("{text:?}"), rule, "write 27.5 for 27.5°"))
            }
            _ if key == ANGLE => {
                let angle = number_in(value)?;
                if !(angle > 0.0 && angle < 90.0) {
                    let remedy = "give the angle at which grains stop in degrees, such as 20.9 for glass beads";
                    return Some(ParameterError::field(&path, angle, "above 0° and below 90°", remedy));
                }
                let coefficient = fields.get(COEFFICIENT)?;
                let defect = format!("given together with `{COEFFICIENT}` ({coefficient}), the tangent of the angle");
                Some(ParameterError::field(&path, defect, "", "leave one of the two out"))
            }
            _ => None,
        }
    })
}

/// The changes with the coefficient of friction in place of a friction angle `[°]`, where the law has the one and knows
/// nothing of the other: sand is as often told by its angle.
pub(in crate::case) fn as_coefficient(law: Option<&Schema>, changes: &Table) -> Option<Table> {
    let properties = law?.get("properties")?.as_object()?;
    let takes = properties.contains_key(COEFFICIENT) && !properties.contains_key(ANGLE);
    let angle = changes.get(ANGLE).and_then(number_in)?;
    if !takes || changes.contains_key(COEFFICIENT) {
        return None;
    }
    let mut changes = changes.clone();
    changes.remove(ANGLE);
    changes.insert(COEFFICIENT.to_owned(), Value::Float(libm::tan(angle.to_radians())));
    Some(changes)
}

/// Warns once of the parameters of friction that keep their values where an angle is given alone: friction in fast flow does not
/// follow from the angle at which grains stop.
pub(in crate::case) fn warn_of_the_rest(table: &Table, changes: &Table) {
    let keeps = |name: &&&str| !changes.contains_key(**name) && table.contains_key(**name);
    let value = |name: &&str| table.get(*name).map(|value| format!("{name} = {value}"));
    let stays: Vec<String> =
        ["limiting_friction", "reference_inertia"].iter().filter(keeps).filter_map(value).collect();
    if let Some(coefficient) = changes.get(COEFFICIENT).filter(|_| !stays.is_empty()) {
        let rest = stays.join(" and ");
        caution_about(ANGLE, &format!("`{ANGLE}` sets {COEFFICIENT} = {coefficient}; {rest} keep their values"));
    }
}
