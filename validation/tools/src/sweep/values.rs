//! The values of a grid's parameter: numbers, each once, because each is a run of its own.

use crate::input::FieldError;
use std::collections::BTreeMap;
use toml::Value;

/// Refuses a value that is not a number, and values that are equal.
pub(super) fn check_values(values: &[Value], field: &str) -> Result<(), FieldError> {
    let mut seen = BTreeMap::new();
    for (place, value) in values.iter().enumerate() {
        if has_nan(value) {
            let remedy = "nothing can be simulated with it: correct it, or leave it out";
            return Err(FieldError::new(&format!("{field}[{place}]"), value, "a number", remedy));
        }
        if let Some(earlier) = seen.insert(canonical(value), place) {
            let value = format!("{value}, equal to `{field}[{earlier}]`");
            let remedy = "list every value once: equal ones are the same run";
            return Err(FieldError::new(&format!("{field}[{place}]"), value, "unique", remedy));
        }
    }
    Ok(())
}

/// Refuses levels of a range so narrow that rounding makes some of them equal.
pub(super) fn check_levels(levels: &[String], field: &str) -> Result<(), FieldError> {
    let Some(place) = (1..levels.len()).find(|&place| levels[place] == levels[place - 1]) else { return Ok(()) };
    let value = format!("{}, of which several are {}", levels.len(), levels[place]);
    Err(FieldError::new(field, value, "so many that all differ", "take fewer levels, or a wider range"))
}

fn has_nan(value: &Value) -> bool {
    match value {
        Value::Float(number) => number.is_nan(),
        Value::Array(values) => values.iter().any(has_nan),
        Value::Table(table) => table.values().any(has_nan),
        _ => false,
    }
}

/// A text that equal values share, also where one is written as a whole number.
fn canonical(value: &Value) -> String {
    match value {
        // both zeros are equal
        Value::Float(number) => format!("{:?}", number + 0.0),
        Value::Integer(whole) => {
            let number = *whole as f64;
            // beyond 2⁵³ several whole numbers share a float
            if number.abs() < 9e15 { format!("{number:?}") } else { whole.to_string() }
        }
        Value::Array(values) => format!("[{}]", values.iter().map(canonical).collect::<Vec<_>>().join(", ")),
        Value::Table(table) => {
            let fields: BTreeMap<&String, String> = table.iter().map(|(key, value)| (key, canonical(value))).collect();
            format!("{fields:?}")
        }
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(values: &str) -> String {
        let table: toml::Table = toml::from_str(&format!("values = {values}")).expect("TOML");
        let values = table["values"].as_array().expect("a list");
        check_values(values, "parameters[0].values").map_or_else(|error| error.to_string(), |()| String::new())
    }

    #[test]
    fn every_value_is_a_number_and_stands_once() {
        for sound in [
            "[1, 2.0, 3]",
            "[\"a\", \"b\"]",
            "[[1, 2], [2, 1]]",
            "[9007199254740993, 9007199254740992]",
            "[true, false]",
            "[inf]",
        ] {
            assert_eq!(message(sound), "", "{sound}");
        }
        assert_eq!(
            message("[0.5, 1.0, 1]"),
            "`parameters[0].values[2]` is 1, equal to `parameters[0].values[1]`, but must be unique; list every \
             value once: equal ones are the same run"
        );
        for equal in ["[0.0, -0.0]", "[\"a\", \"a\"]", "[[1, 2.0], [1.0, 2]]", "[{ a = 1 }, { a = 1.0 }]"] {
            assert!(message(equal).contains("unique"), "{equal}");
        }
        assert_eq!(
            message("[1.0, nan]"),
            "`parameters[0].values[1]` is nan, but must be a number; nothing can be simulated with it: correct it, or leave \
             it out"
        );
        assert!(message("[[1.0, nan]]").contains("must be a number"));
    }

    #[test]
    fn levels_of_a_range_differ() {
        let levels = ["1.0", "1.0", "1.0000000000000002"].map(str::to_owned);
        let message = check_levels(&levels, "parameters[0].levels").expect_err("equal").to_string();
        assert!(message.starts_with("`parameters[0].levels` is 3, of which several are 1.0, but"), "{message}");
        assert_eq!(check_levels(&levels[1..], "parameters[0].levels"), Ok(()));
    }
}
