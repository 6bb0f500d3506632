//! Rows are read with all their fields, and the shipped ones are complete.

use super::*;

const HEAD: &str = "title = \"A paper\"\nsource = \"its text\"\n";

const ROW: &str = r#"
[[element]]
id = "eq-1"
place = "section 2"
says = "a law"
metrics = [{ case = "film", metric = "velocity_l2", variant = "fluid=newtonian", printed = { value = 5.0, at_least = 4.5, at_most = 5.5 } }]
"#;

fn parse(rows: &str) -> Result<Paper, toml::de::Error> {
    Paper::parse("made-up", &format!("{HEAD}{rows}"))
}

#[test]
fn a_good_row_is_read_completely() {
    let more = r#"
[[element]]
id = "claim-two"
place = "abstract"
says = "a claim"
implemented = "solver/src/vector.rs"
tests = ["solver/src/vector.rs::a_deviator_has_no_trace"]
runs = [{ case = "film", variant = "numerics=paper" }]
figures = ["film/operators"]
not_covered = "replaced: by something else"
note = "a note"
"#;
    let paper = parse(&format!("{ROW}{more}")).expect("readable");
    assert_eq!((paper.name.as_str(), paper.title.as_str(), paper.elements.len()), ("made-up", "A paper", 2));
    let printed = paper.elements[0].metrics[0].printed.expect("printed");
    assert!(printed.value == Some(5.0) && !printed.shortcoming);
    assert!(printed.agrees(4.5) && !printed.agrees(5.6) && !printed.agrees(f64::NAN));
    let second = &paper.elements[1];
    assert_eq!(second.not_covered.as_deref(), Some("replaced: by something else"));
    assert_eq!(second.tests, ["solver/src/vector.rs::a_deviator_has_no_trace"]);
    assert_eq!(second.figures, ["film/operators"]);
    assert!(second.runs[0].names(&"fluid=newtonian,numerics=paper".parse().expect("a variant")));
    assert!(!second.runs[0].names(&"fluid=newtonian".parse().expect("a variant")));
    assert_eq!(second.implemented.as_deref(), Some("solver/src/vector.rs"));
}

#[test]
fn a_metric_is_named_by_what_its_variants_have_in_common() {
    let name = &parse(ROW).expect("readable").elements[0].metrics[0];
    let named = |metric: &str, variant: &str| name.names(metric, &variant.parse().expect("a variant"));
    assert!(named("velocity_l2", "fluid=newtonian,resolution=20"));
    assert!(!named("velocity_l2", "fluid=bingham,resolution=20"));
    assert!(!named("flux_error", "fluid=newtonian"));
    assert!(!named("velocity_l2", "quantity=mean,fluid=newtonian"), "another number of the same run");
}

#[test]
fn an_unknown_field_and_a_malformed_variant_are_refused() {
    for (old, new) in [("says", "sais"), ("at_least", "least"), ("fluid=newtonian", "fluid")] {
        parse(&ROW.replace(old, new)).expect_err(new);
    }
}

#[test]
fn names_of_elements_are_unique_and_fit_into_addresses() {
    for paper in PAPERS.iter() {
        let names: std::collections::BTreeSet<&str> = paper.elements.iter().map(|element| &*element.id).collect();
        assert_eq!(names.len(), paper.elements.len(), "{}", paper.name);
        let is_plain = |letter: char| letter.is_ascii_lowercase() || letter.is_ascii_digit() || letter == '-';
        assert!(names.iter().all(|name| name.chars().all(is_plain)), "{names:?}");
    }
}

#[test]
fn every_numbered_equation_figure_and_table_has_a_row() {
    for (paper, equations, figures, tables) in [("salehizadeh", 46, 10, 2), ("kazemi", 37, 13, 0)] {
        let paper = PAPERS.iter().find(|own| own.name == paper).expect("shipped");
        for (kind, last) in [("eq", equations), ("fig", figures), ("table", tables)] {
            for number in 1..=last {
                let id = format!("{kind}-{number}");
                // a figure of several things has a row for each
                let is_it = |element: &Element| element.id == id || element.id.starts_with(&format!("{id}-"));
                assert!(paper.elements.iter().any(is_it), "{} has no row {id}", paper.name);
            }
        }
        assert!(paper.elements.len() >= 100, "{}: {} rows", paper.name, paper.elements.len());
    }
}
