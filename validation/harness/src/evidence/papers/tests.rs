//! The shipped rows are complete, and every rule that a row can break is named.

use super::*;

const HEAD: &str = "title = \"A paper\"\nsource = \"its text\"\n";

const ROW: &str = r#"
[[element]]
id = "eq-1"
place = "section 2"
says = "a law"
implemented = "none"
metrics = [{ case = "film", metric = "velocity_l2", variant = "fluid=newtonian", printed = 5.0, tolerance = 0.5 }]
"#;

fn parse(rows: &str) -> Result<Paper, crate::evidence::ReferenceError> {
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
status = "replaced"
because = "by something else"
note = "a note"
"#;
    let paper = parse(&format!("{ROW}{more}")).expect("readable");
    assert_eq!((paper.name.as_str(), paper.title.as_str(), paper.elements.len()), ("made-up", "A paper", 2));
    let printed = paper.elements[0].metrics[0].printed.expect("printed");
    assert_eq!((printed.value, printed.lowest, printed.highest, printed.contradicts), (Some(5.0), 4.5, 5.5, true));
    assert!(printed.agrees(4.5) && !printed.agrees(5.6) && !printed.agrees(f64::NAN));
    let second = &paper.elements[1];
    assert_eq!(second.settled.as_deref(), Some("replaced: by something else"));
    assert_eq!(second.tests[0].function, "a_deviator_has_no_trace");
    assert_eq!(second.figures[0], FigureName { case: "film".to_owned(), figure: "operators".to_owned() });
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
fn every_rule_is_refused_by_file_row_field_and_value() {
    let with = |old: &str, new: &str| ROW.replace(old, new);
    let metric = "printed = 5.0, tolerance = 0.5";
    for (text, expected) in [
        (ROW.repeat(2), "row 2 (`eq-1`): `id` is \"eq-1\", but must be unique; row 1 has it already"),
        (with("eq-1", "equation 1"), "`id` is \"equation 1\""),
        (with("eq-1", "eq-"), "`id` is \"eq-\", but must be one of eq-, table-, fig-, number-, claim-"),
        (with("section 2", " "), "`place` is \" \""),
        (with("a law", ""), "`says` is \"\""),
        (with("\"none\"", "\"\""), "`implemented` is \"\""),
        (format!("{ROW}status = \"reproduced\"\nbecause = \"x\"\n"), "every other status is computed"),
        (format!("{ROW}status = \"replaced\"\n"), "`because` is \"\""),
        (format!("{ROW}because = \"x\"\n"), "`because` is \"x\", but must be absent"),
        (format!("{ROW}tests = [\"vector.rs\"]\n"), "`tests` is \"vector.rs\""),
        (format!("{ROW}figures = [\"film\"]\n"), "`figures` is \"film\""),
        (with(metric, "printed = 5.0"), "`printed` is \"5\", but must be with a `tolerance`"),
        (with(metric, "tolerance = 0.5"), "`tolerance` is \"0.5\", but must be beside"),
        (with(metric, "printed = 5.0, tolerance = -1.0"), "`tolerance` is \"-1\""),
        (with(metric, "printed = 5.0, tolerance = 1.0, at_least = 0.0"), "without `at_least`"),
        (with(metric, "at_least = 2.0, at_most = 1.0"), "`at_least` is \"2\", but must be at most"),
        (with(metric, "at_least = 2.0, outside = \"wrong\""), "`outside` is \"wrong\""),
        (with(metric, "outside = \"contradicted\""), "absent where nothing is printed"),
        (with("metrics", "figures = [\"film/x\"] # metrics"), "`status` is \"\", but must be one of replaced"),
        (with("says", "sais"), "sais"),
        (with("velocity_l2\", variant = \"fluid=newtonian", "velocity_l2\", variant = \"fluid"), "key=value"),
    ] {
        let error = parse(&text).expect_err(expected).to_string();
        assert!(error.contains(expected) && error.contains("reference-data/papers/made-up.toml"), "{error}");
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
