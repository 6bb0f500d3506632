//! Lists of runs: one flow with the values of named variants, and of parameters that take several.
//!
//! A list says which runs there are, in the same keys wherever one stands: the tiers of a case (`cases/runs/CASE.toml`), a case
//! file, a study, and `--vary` on the command line. Variants come in their order, each with all combinations of the varied values.
//!
//! ```toml
//! [[variants]]
//! name = "steep"
//! tier = "paper"                                             # at this tier and the ones above it
//! set = { slope_angle = 34.0 }
//! vary = [{ path = "resolution", values = [10, 20], paper = [10, 20, 40] }]
//!
//! [paper]                                                    # values of all runs at this tier and above
//! columns = 40
//! ```

use crate::case::Tier;
use crate::case::given::changes::is_same_or_within;
use crate::input::{FieldError, check_name};
use crate::metric::{Value as VariantValue, Variant};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use toml::{Table, Value};

/// More runs than this are a slip of the pen.
const MOST_RUNS: usize = 1000;

/// For the schema: fields of any name and type.
pub type Fields = BTreeMap<String, serde_json::Value>;

/// For the schema: a value of a varied parameter.
#[derive(JsonSchema)]
#[serde(untagged)]
#[expect(dead_code, reason = "only its schema is used")]
enum VariedValue {
    Number(f64),
    Word(String),
    Switch(bool),
    List(Vec<serde_json::Value>),
    Table(Fields),
}

/// Named changes of the base values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct NamedVariant {
    /// Name of the variant.
    pub name: String,
    /// Lowest tier at which it is run; the quick one, if it is left out.
    pub tier: Option<Tier>,
    /// Values by the dotted paths of parameters, in their units.
    #[serde(default, skip_serializing_if = "Table::is_empty")]
    #[schemars(with = "Fields")]
    pub set: Table,
    /// Parameters of this variant that take several values.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub vary: Vec<VariedParameter>,
}

/// A parameter that takes several values.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, expecting = "struct Varied")]
pub struct VariedParameter {
    /// Dotted path of the parameter.
    pub path: String,
    /// Name of the parameter in variants of a study; the last key of the path, if it is left out.
    pub name: Option<String>,
    /// Values of the parameter in its unit, each once.
    #[schemars(with = "Vec<VariedValue>")]
    pub values: Vec<Value>,
    /// Values at the paper tier and above.
    #[schemars(with = "Option<Vec<VariedValue>>")]
    pub paper: Option<Vec<Value>>,
    /// Values at the fine tier.
    #[schemars(with = "Option<Vec<VariedValue>>")]
    pub fine: Option<Vec<Value>>,
}

impl VariedParameter {
    /// Label of the parameter in variants.
    pub fn label(&self) -> &str {
        self.name.as_deref().unwrap_or_else(|| self.path.rsplit('.').next().unwrap_or_default())
    }

    /// The parameter with the values of a tier alone.
    pub fn of_tier(self, tier: Tier) -> Self {
        let values = match tier {
            Tier::Quick => None,
            Tier::Paper => self.paper,
            Tier::Fine => self.fine.or(self.paper),
        };
        Self { values: values.unwrap_or(self.values), paper: None, fine: None, ..self }
    }
}

/// The variants and varied parameters of a list.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ListOfRuns {
    /// Named changes of the base values.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub variants: Vec<NamedVariant>,
    /// Parameters that take several values, each with each.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub vary: Vec<VariedParameter>,
}

/// One set of changes: the variant and the `path, value` pairs that make it.
#[derive(Debug, Clone, PartialEq)]
pub struct ListedChange {
    /// Name: of the named variant, then of the varied values.
    pub variant: Variant,
    /// Place in the file of each value, for errors, with its dotted path.
    pub values: Vec<(String, String, Value)>,
}

impl ListedChange {
    /// Values as settings `path=value`.
    pub fn settings(&self) -> impl Iterator<Item = String> {
        self.values.iter().map(|(_, path, value)| format!("{path}={value}"))
    }
}

impl ListOfRuns {
    /// The list of a tier: its variants, and its values of varied parameters.
    pub fn of_tier(mut self, tier: Tier) -> Self {
        let of_tier = |vary: Vec<VariedParameter>| vary.into_iter().map(|varied| varied.of_tier(tier)).collect();
        self.variants.retain(|named| named.tier.is_none_or(|lowest| lowest <= tier));
        for named in &mut self.variants {
            named.tier = None;
            named.vary = of_tier(std::mem::take(&mut named.vary));
        }
        Self { vary: of_tier(self.vary), ..self }
    }

    /// Refuses values for tiers, because a run list has a single tier.
    ///
    /// # Errors
    /// The first key that names a tier.
    pub fn check_single_tier(&self) -> Result<(), FieldError> {
        let varied = self.varied().find_map(|(place, varied)| {
            let key = varied.paper.as_ref().map(|_| "paper").or(varied.fine.as_ref().map(|_| "fine"))?;
            Some(format!("{place}.{key}"))
        });
        let lowest = self.variants.iter().position(|named| named.tier.is_some());
        let Some(field) = varied.or(lowest.map(|place| format!("variants[{place}].tier"))) else { return Ok(()) };
        let remedy = "keep the values of one tier here, and write another file for the other tier";
        Err(FieldError::finding(&field, "values of another tier in a list that has one tier", remedy))
    }

    /// All varied parameters with their places.
    fn varied(&self) -> impl Iterator<Item = (String, &VariedParameter)> {
        let own = self.vary.iter().enumerate().map(|(place, varied)| (format!("vary[{place}]"), varied));
        own.chain(self.variants.iter().enumerate().flat_map(|(variant, named)| {
            let below = move |place: usize| format!("variants[{variant}].vary[{place}]");
            named.vary.iter().enumerate().map(move |(place, varied)| (below(place), varied))
        }))
    }

    /// Refuses names and values that are given twice, parameters that are varied without a value, and lists of too many runs.
    ///
    /// # Errors
    /// The first place that breaks a rule.
    pub fn check(&self) -> Result<(), FieldError> {
        self.check_at_most(MOST_RUNS, "list fewer values, or use `bagnold sweep`")
    }

    /// The same for another number of runs at most, with the remedy for more.
    ///
    /// # Errors
    /// The first place that breaks a rule.
    pub fn check_at_most(&self, most: usize, remedy: &str) -> Result<(), FieldError> {
        let product = |vary: &[VariedParameter], start: usize| {
            vary.iter().map(|varied| varied.values.len()).fold(start, usize::saturating_mul)
        };
        let variants = self.variants.iter().map(|named| product(&named.vary, 1)).fold(0, usize::saturating_add);
        let count = product(&self.vary, if self.variants.is_empty() { 1 } else { variants });
        if count > most {
            return Err(FieldError::finding("vary", format!("{count} runs, above the limit of {most}"), remedy));
        }
        for (place, named) in self.variants.iter().enumerate() {
            let field = format!("variants[{place}].name");
            check_name(&field, &named.name)?;
            if self.variants[..place].iter().any(|other| other.name == named.name) {
                return Err(FieldError::new(&field, &named.name, "unique", "give each a name of its own"));
            }
            check_vary(&format!("variants[{place}]."), &named.vary, &self.vary)?;
        }
        check_vary("", &self.vary, &[])
    }

    /// All sets of changes, in the order of the list: one without changes for a list without entries.
    pub fn changes(&self) -> Vec<ListedChange> {
        let unnamed = [NamedVariant { name: String::new(), tier: None, set: Table::new(), vary: Vec::new() }];
        let variants = if self.variants.is_empty() { &unnamed[..] } else { &self.variants };
        variants.iter().enumerate().flat_map(|(place, named)| self.changes_of(place, named)).collect()
    }

    fn changes_of(&self, place: usize, named: &NamedVariant) -> Vec<ListedChange> {
        let variant =
            if named.name.is_empty() { Variant::default() } else { Variant::of("variant", named.name.as_str()) };
        let set = format!("variants[{place}].set");
        let values = named.set.iter().map(|(path, value)| (set.clone(), path.clone(), value.clone())).collect();
        let own = named.vary.iter().enumerate();
        let own = own.map(|(index, varied)| (format!("variants[{place}].vary[{index}]"), varied));
        let common = self.vary.iter().enumerate().map(|(index, varied)| (format!("vary[{index}]"), varied));
        let mut all = vec![ListedChange { variant, values }];
        for (field, varied) in own.chain(common) {
            let with = |changed: &ListedChange, (place, value): (usize, &Value)| {
                let mut next = changed.clone();
                next.values.push((field.clone(), varied.path.clone(), value.clone()));
                // what has no name is numbered
                next.variant =
                    next.variant.and(varied.label(), in_variant(value).unwrap_or((place as f64 + 1.0).into()));
                next
            };
            all = all
                .iter()
                .flat_map(|changed| varied.values.iter().enumerate().map(|value| with(changed, value)))
                .collect();
        }
        all
    }

    /// Removes a parameter from the list, because each run sets its own value.
    pub fn forget(&mut self, path: &str) {
        let is_it = |other: &str| is_same_or_within(path, other);
        self.vary.retain(|varied| !is_it(&varied.path));
        for named in &mut self.variants {
            named.vary.retain(|varied| !is_it(&varied.path));
            forget_below(&mut named.set, "", &is_it);
        }
    }
}

fn forget_below(table: &mut Table, above: &str, is_it: &dyn Fn(&str) -> bool) {
    table.retain(|key, value| {
        let path = if above.is_empty() { key.to_owned() } else { format!("{above}.{key}") };
        match value {
            Value::Table(inner) => {
                forget_below(inner, &path, is_it);
                !inner.is_empty()
            }
            _ => !is_it(&path),
        }
    });
}

fn check_vary(above: &str, vary: &[VariedParameter], beside: &[VariedParameter]) -> Result<(), FieldError> {
    for (place, varied) in vary.iter().enumerate() {
        let field = format!("{above}vary[{place}]");
        if varied.path.split('.').any(str::is_empty) {
            let (rule, remedy) =
                ("the dotted path of a parameter", "give one such as \"slope_angle\"; `bagnold show` prints all");
            return Err(FieldError::new(&format!("{field}.path"), format!("{:?}", varied.path), rule, remedy));
        }
        check_name(&format!("{field}.name"), varied.label())?;
        let twin = |other: &VariedParameter| other.label() == varied.label() || other.path == varied.path;
        if varied.label() == "variant" || vary[..place].iter().chain(beside).any(twin) {
            let remedy = "vary each parameter once, each with another `name`; \"variant\" is reserved for [[variants]]";
            return Err(FieldError::new(&format!("{field}.name"), varied.label(), "unique", remedy));
        }
        if varied.values.is_empty() {
            let remedy = "list them, such as [0.01, 0.005]";
            return Err(FieldError::finding(&format!("{field}.values"), "no values", remedy));
        }
        let mut seen = BTreeMap::new();
        for (place, value) in varied.values.iter().enumerate() {
            let refused = |value: String, rule: &str, remedy: &str| {
                Err(FieldError::new(&format!("{field}.values[{place}]"), value, rule, remedy))
            };
            let known_by = identity(value);
            if known_by.contains("NaN") && !value.is_str() {
                let remedy = "correct it, or leave it out";
                return refused(value.to_string(), "a number", remedy);
            }
            if let Some(earlier) = seen.insert(known_by, place) {
                let defect = format!("{value} is listed already as `{field}.values[{earlier}]`");
                return refused(defect, "", "list each value once");
            }
        }
    }
    Ok(())
}

/// A text that equal values share, also where one is written as a whole number.
fn identity(value: &Value) -> String {
    match value {
        // both zeros are equal
        Value::Float(number) => format!("{:?}", number + 0.0),
        // beyond 2⁵³ several whole numbers share a float
        Value::Integer(whole) if whole.abs() < 1 << 53 => format!("{:?}", *whole as f64),
        Value::Array(values) => format!("[{}]", values.iter().map(identity).collect::<Vec<_>>().join(", ")),
        Value::Table(table) => {
            let fields: BTreeMap<&String, String> = table.iter().map(|(key, value)| (key, identity(value))).collect();
            format!("{fields:?}")
        }
        other => other.to_string(),
    }
}

/// A value as a variant has it: numbers and words.
fn in_variant(value: &Value) -> Option<VariantValue> {
    match value {
        Value::Float(number) if number.is_finite() => Some((*number).into()),
        Value::Integer(whole) => Some((*whole as f64).into()),
        Value::Boolean(is_so) => Some(is_so.to_string().into()),
        Value::String(word) => Some(word.replace(['=', ',', '_', ' '], "-").into()),
        _ => None,
    }
}

/// The settings that replace the list of runs by values of the command line, each `FIELD=A,B,C`; a list in brackets is TOML.
///
/// # Errors
/// An argument of another form.
pub fn settings_to_vary(arguments: &[String]) -> Result<Vec<String>, FieldError> {
    if arguments.is_empty() {
        return Ok(Vec::new());
    }
    let mut vary = Vec::new();
    for argument in arguments {
        let parts = argument.split_once('=').map(|(path, values)| (path.trim(), values.trim()));
        let Some((path, values)) = parts.filter(|(path, values)| !path.is_empty() && !values.is_empty()) else {
            let remedy = "write it as in --vary resolution=10,20";
            return Err(FieldError::new("--vary", argument, "of the form FIELD=A,B,C", remedy));
        };
        let text = if values.starts_with('[') { values.to_owned() } else { format!("[{values}]") };
        let list =
            toml::from_str::<Table>(&format!("values = {text}")).ok().and_then(|mut table| table.remove("values"));
        let words = || values.split(',').map(|word| Value::String(word.trim().to_owned())).collect();
        let values = if let Some(Value::Array(values)) = list { values } else { words() };
        vary.push(VariedParameter { path: path.to_owned(), name: None, values, paper: None, fine: None });
    }
    check_vary("--", &vary, &[])?;
    let list = Value::try_from(vary).map_err(|error| FieldError::finding("--vary", error, "correct the values"))?;
    Ok(vec!["variants=[]".to_owned(), format!("vary={list}")])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(values: &str) -> String {
        let list: ListOfRuns =
            toml::from_str(&format!("vary = [{{ path = \"a\", values = {values} }}]")).expect("TOML");
        list.check().map_or_else(|error| error.to_string(), |()| String::new())
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
            "`vary[0].values[2]`: 1 is listed already as `vary[0].values[1]`; list each value once"
        );
        for equal in ["[0.0, -0.0]", "[\"a\", \"a\"]", "[[1, 2.0], [1.0, 2]]", "[{ a = 1 }, { a = 1.0 }]"] {
            assert!(message(equal).contains("is listed already as"), "{equal}");
        }
        assert_eq!(
            message("[1.0, nan]"),
            "`vary[0].values[1]` is nan, but must be a number; correct it, or leave it out"
        );
        assert!(message("[[1.0, nan]]").contains("must be a number"));
    }
}
