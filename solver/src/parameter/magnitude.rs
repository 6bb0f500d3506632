//! Largest and smallest size of a number by its unit: the unit bounds what no rule of a field bounds.
//!
//! The unit stands in the field's doc comment, `[m]`, and so in the schema's description. The bounds are far outside of
//! what any scene of grains and water asks for; they stop what is mistyped or given in another unit before it becomes an
//! array, a time step or a file's name.

use serde_json::{Map, Value, json};

/// Largest length or coordinate of a field in metres `[m]`.
pub const LARGEST_LENGTH: f64 = 1e5;

/// Unit, smallest size of a number that is not 0, and largest size.
const BY_UNIT: [(&str, f64, f64); 15] = [
    ("-", 1e-15, 1e9),
    ("m", 1e-9, LARGEST_LENGTH),
    ("s", 1e-12, 1e9),
    ("°", 1e-6, 360.0),
    ("rad", 1e-12, 1e9),
    ("m/s", 1e-12, 1e5),
    ("m/s²", 1e-9, 1e6),
    ("kg/m³", 1e-6, 1e6),
    ("Pa", 1e-12, 1e15),
    ("Pa·s", 1e-12, 1e15),
    ("Pa·sⁿ", 1e-12, 1e15),
    ("1/s", 1e-15, 1e15),
    ("m²/s", 1e-15, 1e6),
    ("kg/s", 1e-15, 1e9),
    ("kg/(m s)", 1e-15, 1e9),
];

/// The largest count that a field without a rule of its own takes.
const LARGEST_COUNT: u64 = 1_000_000;

/// Gives every number of a schema the bounds of its unit, and every count that has none a largest one.
pub(super) fn bound(schema: &mut Value) {
    Walk { units: Vec::new(), is_seed: false }.visit(schema);
}

/// Context of a number, from the schema that encloses it.
#[derive(Clone, Default)]
struct Walk {
    /// Units that the nearest description names, in its order.
    units: Vec<String>,
    /// A seed is a name, not a count: any will do.
    is_seed: bool,
}

impl Walk {
    fn visit(mut self, schema: &mut Value) {
        let Value::Object(place) = schema else { return };
        if let Some(text) = place.get("description").and_then(Value::as_str) {
            let units = units_in(text);
            if !units.is_empty() {
                self.units = units;
            }
        }
        for (name, field) in place.get_mut("properties").and_then(Value::as_object_mut).into_iter().flatten() {
            Self { units: self.units.clone(), is_seed: name.contains("seed") }.visit(field);
        }
        if let Some(items) = place.get_mut("items") {
            self.clone().visit(items);
        }
        let entries = place.get_mut("prefixItems").and_then(Value::as_array_mut).into_iter().flatten();
        for (index, entry) in entries.enumerate() {
            let own = self.units.get(index).or(self.units.first()).cloned();
            Self { units: own.into_iter().collect(), ..self.clone() }.visit(entry);
        }
        for key in ["anyOf", "oneOf"] {
            for choice in place.get_mut(key).and_then(Value::as_array_mut).into_iter().flatten() {
                self.clone().visit(choice);
            }
        }
        self.add_rule(place);
    }

    fn add_rule(&self, place: &mut Map<String, Value>) {
        let is = |kind: &str| match place.get("type") {
            Some(Value::String(own)) => own == kind,
            Some(Value::Array(kinds)) => kinds.iter().any(|own| own == kind),
            _ => false,
        };
        let rule = if is("number") { self.rule_of_size() } else { None };
        let rule = rule.or_else(|| (is("integer") && !self.is_seed).then(rule_of_count));
        if let Some(rule) = rule
            && let Value::Array(further) = place.entry("allOf").or_insert_with(|| json!([]))
        {
            further.push(rule);
        }
    }

    fn rule_of_size(&self) -> Option<Value> {
        let unit = self.units.first()?;
        let (_, least, most) = BY_UNIT.iter().find(|(known, ..)| known == unit)?;
        let (shown, remedy) = match unit.as_str() {
            "-" => (String::new(), "correct the exponent of the number".to_owned()),
            unit => (format!(" {unit}"), format!("give the value in {unit}")),
        };
        Some(json!({
            "minimum": -most,
            "maximum": most,
            "x-smallest": least,
            "x-rule": format!("between {least:e} and {most:e}{shown} in absolute value"),
            "x-remedy": remedy,
        }))
    }
}

fn rule_of_count() -> Value {
    json!({
        "maximum": LARGEST_COUNT,
        "x-rule": format!("at most {LARGEST_COUNT}"),
        "x-remedy": "give a smaller whole number",
    })
}

/// The units that a description names, `[m]` in code.
fn units_in(description: &str) -> Vec<String> {
    let parts = description.split("`[").skip(1);
    parts.filter_map(|part| part.split_once("]`")).map(|(unit, _)| unit.to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::super::{Fault, first_fault, positive, schema_of};
    use schemars::JsonSchema;
    use serde::Serialize;

    #[derive(Serialize, JsonSchema)]
    struct Bed {
        /// Depth `[m]`.
        #[schemars(transform = positive("give it in metres"))]
        depth: f64,
        /// Origin `[m]`.
        offset: f64,
        /// Angles `[°]`.
        angles: Vec<f64>,
        /// Pairs: thickness `[m]`, angle `[°]`.
        stops: Vec<(f64, f64)>,
        columns: usize,
        seed: u64,
    }

    fn said(change: &str) -> String {
        let sound = Bed { depth: 0.1, offset: 0.0, angles: vec![24.0], stops: vec![(0.01, 20.0)], columns: 8, seed: 1 };
        let mut bed = toml::Value::try_from(sound).expect("a table");
        bed.as_table_mut().expect("a table").extend(toml::from_str::<toml::Table>(change).expect("TOML"));
        match first_fault(schema_of::<Bed>(), &bed) {
            Some(Fault::Range(problem)) => problem.to_string(),
            other => format!("{other:?}"),
        }
    }

    #[test]
    fn a_unit_bounds_what_no_rule_does() {
        assert_eq!(said(""), "None");
        assert_eq!(said("seed = 9007199254740993\noffset = -1.0"), "None");
        let metres = "but must be between 1e-9 and 1e5 m in absolute value; give the value in m";
        assert_eq!(said("depth = 1e308"), format!("`depth` is 1e308, {metres}"));
        assert_eq!(said("offset = nan"), format!("`offset` is NaN, {metres}"));
        assert_eq!(said("offset = -1e-308"), format!("`offset` is -1e-308, {metres}"));
        assert_eq!(said("offset = 9000000000000000000"), format!("`offset` is 9000000000000000000, {metres}"));
        assert_eq!(
            said("angles = [24.0, 1e-308]"),
            "`angles[1]` is 1e-308, but must be between 1e-6 and 3.6e2 ° in absolute value; give the value in °"
        );
        assert_eq!(said("stops = [[1e6, 20.0]]"), format!("`stops[0][0]` is 1000000, {metres}"));
        assert!(said("stops = [[1.0, 1e4]]").starts_with("`stops[0][1]` is 10000, but"));
        assert_eq!(
            said("columns = 1000000000000"),
            "`columns` is 1000000000000, but must be at most 1000000; give a smaller whole number"
        );
    }
}
