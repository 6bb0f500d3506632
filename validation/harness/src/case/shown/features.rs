//! Options that the parameters offer and those that a run has chosen. They are read from the schemas of the parameters
//! and from the serialised run, so that a new option of a law, an operator or a boundary shows by itself.

use crate::case::Registry;
use bagnold_solver::parameter::{Shape, Variant};
use serde::Serialize;
use serde_json::Value;
use std::collections::BTreeSet;

/// A choice that has been made: a parameter and the name of its option.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
pub struct FeatureOption {
    /// The parameter, such as `momentum_operator`.
    pub feature: String,
    /// The option, such as `uncorrected-divergence`; `on` or `off` for a term that 0 switches off.
    pub option: String,
}

/// All parameters that are chosen from a list, or that 0 switches off, with their options.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Features {
    options: BTreeSet<FeatureOption>,
}

/// The words by which a parameter's description states that it is a switch too.
const SWITCH: &str = "0 switches it off";

impl Features {
    /// Features of all cases of a registry.
    pub fn of(registry: Registry) -> Self {
        let mut features = Self::default();
        let fields = |schema: &'static Value| schema["properties"].as_object().into_iter().flatten();
        for (name, schema) in registry.iter().flat_map(|case| fields(case.parameter_schema())) {
            // a list of runs names tiers, which are no option of a run
            if !["variants", "vary"].contains(&name.as_str()) {
                features.collect(name, schema);
            }
        }
        features
    }

    /// The options in alphabetical order.
    pub fn options(&self) -> impl Iterator<Item = FeatureOption> {
        self.options.iter().cloned()
    }

    /// Options that a serialised run has chosen.
    pub fn chosen(&self, run: &Value) -> BTreeSet<FeatureOption> {
        let mut chosen = BTreeSet::new();
        self.walk("", run, &mut chosen);
        chosen
    }

    fn collect(&mut self, name: &str, schema: &Value) {
        match Shape::of(schema) {
            Shape::Fields { properties, .. } => {
                properties.iter().for_each(|(name, property)| self.collect(name, property));
            }
            Shape::Choice(variants) => self.collect_variants(name, &variants),
            Shape::Tagged { tag, variants, .. } => self.collect_variants(tag, &variants),
            Shape::List(items) => self.collect(name, items),
            Shape::Tuple(items) => items.iter().for_each(|item| self.collect(name, item)),
            Shape::Number => {
                let description = schema.get("description").and_then(Value::as_str).unwrap_or_default();
                if description.contains(SWITCH) {
                    self.add(name, "on");
                    self.add(name, "off");
                }
            }
            Shape::Integer { .. } | Shape::Text | Shape::Flag | Shape::Any => {}
        }
    }

    fn collect_variants(&mut self, name: &str, variants: &[Variant<'_>]) {
        for variant in variants {
            self.add(name, variant.name);
            if let Some(content) = variant.content {
                self.collect(name, content);
            }
        }
    }

    fn add(&mut self, feature: &str, option: &str) {
        self.options.insert(FeatureOption { feature: feature.to_owned(), option: option.to_owned() });
    }

    fn walk(&self, name: &str, value: &Value, chosen: &mut BTreeSet<FeatureOption>) {
        let mut choose = |option: &str| {
            let option = FeatureOption { feature: name.to_owned(), option: option.to_owned() };
            chosen.extend(self.options.get(&option).cloned());
        };
        match value {
            Value::String(option) => choose(option),
            Value::Number(number) => choose(if number.as_f64() == Some(0.0) { "off" } else { "on" }),
            Value::Array(items) => items.iter().for_each(|item| self.walk(name, item, chosen)),
            Value::Object(fields) => {
                // an enum by name: a table whose only key is the option
                if let (1, Some(option)) = (fields.len(), fields.keys().next()) {
                    choose(option);
                }
                fields.iter().for_each(|(field, value)| self.walk(field, value, chosen));
            }
            Value::Null | Value::Bool(_) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn option(feature: &str, option: &str) -> FeatureOption {
        FeatureOption { feature: feature.to_owned(), option: option.to_owned() }
    }

    #[test]
    fn choices_tags_and_switches_are_options_wherever_they_stand() {
        let schema = json!({ "type": "object", "properties": {
            "kernel": { "enum": ["cubic", "wendland"] },
            "diffusion": { "type": "number", "description": "δ; 0 switches it off." },
            "size": { "type": "number", "description": "a size" },
            "sides": { "type": "array", "items": { "oneOf": [
                { "const": "none" },
                { "type": "object", "properties": { "open": { "type": "number" } }, "required": ["open"] },
            ] } },
            "material": { "oneOf": [
                { "type": "object", "properties": { "law": { "const": "water" }, "eddies": { "enum": ["none", "some"] } } },
                { "type": "object", "properties": { "law": { "const": "sand" } } },
            ] },
        } });
        let mut features = Features::default();
        features.collect("", &schema);
        let expected = [
            ("diffusion", "off"),
            ("diffusion", "on"),
            ("eddies", "none"),
            ("eddies", "some"),
            ("kernel", "cubic"),
            ("kernel", "wendland"),
            ("law", "sand"),
            ("law", "water"),
            ("sides", "none"),
            ("sides", "open"),
        ];
        assert_eq!(features.options().collect::<Vec<_>>(), expected.map(|(feature, name)| option(feature, name)));
        let run = json!({ "numerics": { "kernel": "cubic", "diffusion": 0.0, "size": 0.0 }, "law": { "law": "sand" },
            "sides": [{ "open": 0.5 }, "none"], "name": "water" });
        let chosen = [("diffusion", "off"), ("kernel", "cubic"), ("law", "sand"), ("sides", "none"), ("sides", "open")];
        assert_eq!(features.chosen(&run), chosen.map(|(feature, name)| option(feature, name)).into());
    }
}
