//! Columns of an external file: the quantity and unit of each.

use crate::case::{ExternalColumn, RunScales};
use crate::input::{FieldError, check_stated, name_and_unit, number_in, unit};

/// Source of the values of a quantity.
#[derive(Debug, Clone, PartialEq)]
pub enum ColumnSource {
    /// A column of the file.
    Heading {
        /// The text as given, which may be the heading itself, unit and all.
        text: String,
        /// The heading without its unit.
        name: String,
        /// Unit.
        unit: String,
    },
    /// The same for all.
    Constant {
        /// Value in the unit.
        value: f64,
        /// Unit.
        unit: String,
    },
}

impl ColumnSource {
    /// `"x [cm]"` for a column, `{ value = 0.25, unit = "cm^2" }` for what is the same for all.
    pub fn parse(value: &toml::Value, field: &str) -> Result<Self, FieldError> {
        let own = value.as_str().unwrap_or("x");
        let unit = if field.ends_with("time") { "ms" } else { "cm" };
        let remedy =
            format!("write \"{own} [{unit}]\" for a column, or {{ value = 0.25, unit = \"cm^2\" }} for a constant");
        let wrong = |text: String| FieldError::new(field, text, "a heading with its unit in brackets", &remedy);
        match value {
            toml::Value::String(text) => {
                let (name, unit) = name_and_unit(text).ok_or_else(|| wrong(format!("\"{text}\"")))?;
                check_stated(name, unit)
                    .map_err(|rule| FieldError::new(field, value, &rule, "correct the unit in brackets"))?;
                Ok(Self::Heading { text: text.clone(), name: name.to_owned(), unit: unit.to_owned() })
            }
            toml::Value::Table(table) => {
                let number = table.get("value").and_then(number_in);
                let unit = table.get("unit").and_then(toml::Value::as_str);
                match (number, unit, table.len()) {
                    (Some(value), Some(unit), 2) if value.is_finite() => {
                        Ok(Self::Constant { value, unit: unit.to_owned() })
                    }
                    _ => Err(wrong(value.to_string())),
                }
            }
            other => Err(wrong(other.to_string())),
        }
    }

    fn unit(&self) -> &str {
        match self {
            Self::Heading { unit, .. } | Self::Constant { unit, .. } => unit,
        }
    }

    /// The factor to the unit of an item; `r0` and `t0` are the scales of the run, where it has some.
    ///
    /// # Errors
    /// A unit that is unknown or measures something else, or a scale that the run does not have.
    pub fn factor(&self, item: &ExternalColumn, field: &str, scales: Option<RunScales>) -> Result<f64, FieldError> {
        let with = |scales: RunScales| {
            unit::factor_with(
                self.unit(),
                item.unit,
                &[("r0", scales.length, [1, 0, 0]), ("t0", scales.time, [0, 0, 1])],
            )
        };
        scales.map_or_else(|| unit::factor(self.unit(), item.unit), with).ok_or_else(|| {
            let is_scaled = with(RunScales { length: 1.0, time: 1.0 }).is_some();
            let rule = format!("a unit that converts to {}", item.unit);
            let remedy = if is_scaled {
                "convert the column: this case defines no r_0 and t_0".to_owned()
            } else {
                let scaled = if scales.is_some() { "r0 or t0 of the column, or " } else { "" };
                format!("give a unit such as {scaled}cm, mm/s, g/cm^3, kPa; products and powers of m, g, s, min, h, Pa, N, J with prefixes")
            };
            FieldError::new(field, format!("[{}]", self.unit()), &rule, &remedy)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<ColumnSource, FieldError> {
        let table: toml::Table = toml::from_str(&format!("x = {text}")).expect("TOML");
        ColumnSource::parse(&table["x"], "columns.x")
    }

    #[test]
    fn a_heading_has_its_unit_in_brackets_and_a_constant_beside_it() {
        let heading = parse("\"X position [cm]\"").expect("a heading");
        let item = ExternalColumn::new("x", "m", "place");
        assert_eq!(heading.factor(&item, "columns.x", None), Ok(1e-2));
        assert!(matches!(heading, ColumnSource::Heading { name, .. } if name == "X position"));
        let constant = ColumnSource::Constant { value: 2.0, unit: "mm".to_owned() };
        assert_eq!(parse("{ value = 2, unit = \"mm\" }"), Ok(constant));
    }

    #[test]
    fn a_column_without_a_unit_or_with_another_kind_of_unit_is_refused() {
        for text in ["\"x\"", "3", "{ value = 1.0 }", "{ value = nan, unit = \"m\" }"] {
            let message = parse(text).expect_err("no unit").to_string();
            assert!(message.contains("but must be a heading with its unit in brackets"), "{message}");
        }
        let wrong =
            parse("\"t [s]\"").expect("a heading").factor(&ExternalColumn::new("x", "m", "place"), "columns.x", None);
        assert_eq!(
            wrong.expect_err("not a length").to_string(),
            "`columns.x` is [s], but must be a unit that converts to m; give a unit such as cm, mm/s, g/cm^3, kPa; products and powers of m, g, s, min, h, Pa, N, J with prefixes"
        );
    }

    #[test]
    fn scales_of_a_run_are_units_where_it_has_them() {
        let factor = |text: &str, unit: &'static str, scales| {
            parse(text).expect("a heading").factor(&ExternalColumn::new("x", unit, ""), "columns.x", scales)
        };
        let scales = Some(RunScales { length: 0.25, time: 0.125 });
        for (text, unit, expected) in [
            ("\"x/r0 [r0]\"", "m", 0.25),
            ("\"t* [t0]\"", "s", 0.125),
            ("\"A [r0^2]\"", "m^2", 0.0625),
            ("\"u [r0/t0]\"", "m/s", 2.0),
            ("\"x [cm]\"", "m", 1e-2),
        ] {
            assert_eq!(factor(text, unit, scales), Ok(expected), "{text}");
        }
        let message = |text, scales| factor(text, "m", scales).expect_err("no length").to_string();
        let without = "`columns.x` is [r0], but must be a unit that converts to m; convert the column: this case defines no r_0 and t_0";
        assert!(message("\"x [r0]\"", None).starts_with(without), "{}", message("\"x [r0]\"", None));
        let wrong = "`columns.x` is [t0], but must be a unit that converts to m; give a unit such as r0 or t0 of the column, or cm";
        assert!(message("\"x [t0]\"", scales).starts_with(wrong));
    }
}
