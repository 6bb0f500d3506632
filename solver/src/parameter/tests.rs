use super::*;
use schemars::JsonSchema;
use serde::Serialize;

#[derive(Serialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
#[expect(dead_code, reason = "read from text only")]
enum Start {
    /// At rest.
    Rest,
    /// As given.
    Given { speed: f64 },
}

#[derive(Serialize, JsonSchema)]
#[serde(tag = "law", rename_all = "kebab-case")]
#[expect(dead_code, reason = "read from text only")]
enum Law {
    /// A liquid.
    Newtonian(Viscous),
    PowerLaw {
        exponent: f64,
    },
}

#[derive(Serialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct Viscous {
    #[schemars(transform = not_negative("give it in Pa·s"))]
    viscosity: f64,
}

/// Flattened into its holder.
#[derive(Serialize, JsonSchema)]
struct Rows {
    #[schemars(transform = between(4.0, 1000.0, "20 is quick"))]
    rows: usize,
}

#[derive(Serialize, JsonSchema)]
struct Layer {
    #[serde(flatten)]
    rows: Rows,
    /// Depth `[m]`.
    #[schemars(transform = positive("give it in metres"))]
    #[schemars(transform = between(0.0, 0.2, "that is deep"))]
    depth: f64,
    #[schemars(transform = filled("a slope", "add one"))]
    slopes: Vec<f64>,
    offset: Option<f64>,
    start: Start,
    material: Law,
    bracket: (f64, f64),
}

fn layer() -> toml::Value {
    let layer = Layer {
        rows: Rows { rows: 20 },
        depth: 0.1,
        slopes: vec![0.01, 0.02],
        offset: None,
        start: Start::Given { speed: 1.0 },
        material: Law::Newtonian(Viscous { viscosity: 1.0 }),
        bracket: (1.0, 2.0),
    };
    assert_eq!(range_problem(&layer), None);
    toml::Value::try_from(&layer).expect("a table")
}

/// Message of the checker for the layer with some fields replaced by those of a text.
fn said(change: &str) -> String {
    let mut layer = layer();
    let changed: toml::Table = toml::from_str(change).expect("TOML");
    layer.as_table_mut().expect("a table").extend(changed);
    match first_fault(schema_of::<Layer>(), &layer) {
        None => "sound".to_owned(),
        Some(Fault::Unknown { path, known }) => format!("no {path} beside {}", known.join(", ")),
        Some(Fault::Missing { path, .. }) => format!("{path} is missing"),
        Some(Fault::Kind { path, value, rule, .. }) => format!("{path} is {value:?}, not {rule}"),
        Some(Fault::Range(problem)) => problem.to_string(),
    }
}

#[test]
fn sound_values_pass() {
    assert_eq!(said(""), "sound");
    assert_eq!(said("depth = 0.2\noffset = -1\nstart = \"rest\"\nslopes = [0.2]"), "sound");
    assert_eq!(said("material = { law = \"power-law\", exponent = 0.5 }"), "sound");
}

#[test]
fn values_outside_their_range_are_named_with_rule_and_remedy() {
    assert_eq!(said("depth = -1"), "`depth` is -1, but must be positive and finite; give it in metres");
    assert_eq!(said("depth = inf"), "`depth` is inf, but must be positive and finite; give it in metres");
    assert_eq!(said("depth = 0.25"), "`depth` is 0.25, but must be between 0 and 0.2; that is deep");
    assert_eq!(said("rows = 3"), "`rows` is 3, but must be between 4 and 1000; 20 is quick");
    assert_eq!(said("slopes = []"), "`slopes` is [], but must be a slope; add one");
    assert_eq!(
        said("material = { law = \"newtonian\", viscosity = -1.0 }"),
        "`material.viscosity` is -1, but must be finite and not negative; give it in Pa·s"
    );
}

#[test]
fn values_of_another_type_are_named_with_the_type() {
    assert_eq!(said("depth = true"), "depth is Some(\"true\"), not a number");
    assert_eq!(said("rows = -3"), "rows is Some(\"-3\"), not a whole number without sign, decimal point or exponent");
    assert_eq!(said("rows = 3.5"), "rows is Some(\"3.5\"), not a whole number without sign, decimal point or exponent");
    assert_eq!(said("start = \"reset\""), "start is Some(\"\\\"reset\\\"\"), not one of `rest`, `given`");
    assert_eq!(said("start = \"given\""), "start is Some(\"\\\"given\\\"\"), not a table of fields");
    assert_eq!(said("start = { given = { speed = \"x\" } }"), "start.given.speed is Some(\"\\\"x\\\"\"), not a number");
    assert_eq!(said("bracket = [1.0]"), "bracket is Some(\"[1.0]\"), not an array of 2 values");
    assert_eq!(
        said("material = { law = \"bingham\" }"),
        "material.law is Some(\"\\\"bingham\\\"\"), not one of `newtonian`, `power-law`"
    );
}

#[test]
fn fields_that_are_too_many_or_too_few_are_named() {
    assert_eq!(said("dept = 1"), "no dept beside rows, depth, slopes, offset, start, material, bracket");
    assert_eq!(
        said("material = { law = \"power-law\", exponent = 1, viscosity = 1 }"),
        "no material.viscosity beside material.law, material.exponent"
    );
    assert_eq!(said("material = { viscosity = 1 }"), "material.law is missing");
    assert_eq!(said("start = { given = {} }"), "start.given.speed is missing");
}

#[test]
fn rules_are_told_without_a_value_and_a_tag_by_its_table() {
    let fields = &schema_of::<Layer>()["properties"];
    let rules = ["rows", "depth", "slopes", "bracket"].map(|name| rule_in_words(&fields[name]));
    let rules = rules.each_ref().map(|rule| rule.as_deref().unwrap_or_default());
    assert_eq!(rules, ["between 4 and 1000", "positive and finite", "a slope", ""]);
    assert_eq!(fields["material"]["oneOf"][0]["properties"]["law"]["description"], "A liquid.");
}

#[test]
fn a_description_is_one_line() {
    let depth = &schema_of::<Layer>()["properties"]["depth"];
    assert_eq!(description(depth).as_deref(), Some("Depth `[m]`."));
}
