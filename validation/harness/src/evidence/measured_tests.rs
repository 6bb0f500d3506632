//! Tests of reading reference files: good ones completely, bad ones with their exact place.

use super::*;

const HEADER: &str = "# quantity: velocity over depth\n# unit: m/s\n# kind: measured\n# confidence: high\n\
                      # uncertainty: 3 %\n# source: test: its own\n# licence: none\n";

fn message(text: &str) -> String {
    MeasuredData::parse("data.csv", text).expect_err("refused").to_string()
}

fn message_of_table(table: &str) -> String {
    message(&format!("{HEADER}{table}"))
}

#[test]
fn a_good_file_is_read_completely() {
    let text = format!(
        "\u{feff}{HEADER}\nheight [m], velocity [m/s] ,run\r\n0.001,0.012,a\r\n\n0.002,-2.4e-2,\"b, again\"\r\n"
    );
    let data = MeasuredData::parse("data.csv", &text).expect("readable");
    assert_eq!(data.metadata.quantity, "velocity over depth");
    assert_eq!(data.metadata.source, "test: its own");
    assert_eq!((data.metadata.origin, data.metadata.confidence), (ReferenceKind::Measured, Confidence::High));
    assert_eq!(data.numbers("height").expect("present"), [0.001, 0.002]);
    assert_eq!(data.numbers("velocity").expect("present"), [0.012, -0.024]);
    assert_eq!(data.labels("run").expect("present"), ["a", "b, again"]);
    assert!(matches!(&data.columns[1], ReferenceColumn::Numbers { unit, .. } if unit == "m/s"));
}

#[test]
fn a_column_that_is_not_there_is_answered_with_those_that_are() {
    let data = MeasuredData::parse("data.csv", &format!("{HEADER}y [m],run\n1,a\n")).expect("readable");
    let error = data.numbers("run").expect_err("a label").to_string();
    assert_eq!(error, "read the reference data data.csv: there is no number column `run`; its columns are `y`, `run`");
    assert!(data.labels("y").is_err());
}

#[test]
fn a_bad_number_is_located() {
    for bad in ["abc", "NaN", "inf", "", "1,5", "-9999"] {
        let field = if bad.contains(',') { format!("\"{bad}\"") } else { bad.to_owned() };
        let error = message_of_table(&format!("y [m],u [m/s]\n1,2\n2,{field}\n"));
        let place = format!(
            "read the reference data data.csv, line 10, column 2 (`u`): `{bad}` is not a finite measured value"
        );
        assert!(error.starts_with(&place), "{error}");
    }
}

#[test]
fn a_bad_table_is_located() {
    let cases = [
        ("y [m],u [m/s]\n1,2\n1\n", "line 10, column 1: 1 fields in a table"),
        ("y [m],u [m/s]\n1,2,3\n", "line 9, column 2: 3 fields in a table"),
        ("y [m],y [mm]\n1,2\n", "line 8, column 2: the name `y` is used twice"),
        ("y [m],u [m/s\n1,2\n", "line 8, column 2: `u [m/s` does not end"),
        ("y [],u [m/s]\n1,2\n", "line 8, column 1: `y []` has an empty unit"),
        ("y [m],\n1,2\n", "line 8, column 2: the column has no name"),
        ("y [m],u [m/s]\n", "line 8, column 1: the table has no rows"),
        ("", "line 8, column 1: there is no table"),
    ];
    for (table, expected) in cases {
        let error = message_of_table(table);
        assert!(error.contains(expected), "{error} for {table:?}");
    }
}

#[test]
fn bad_metadata_is_located() {
    let table = "y [m]\n1\n";
    let replaced = |from: &str, to: &str| message(&format!("{}{table}", HEADER.replace(from, to)));
    assert_eq!(
        replaced("# unit: m/s\n", ""),
        "read the reference data data.csv: the line `# unit: …` is missing; add it above the table"
    );
    assert!(
        replaced("kind: measured", "kind: guess")
            .contains("line 3: `guess` is not one of analytic, computed, fit, measured, statement")
    );
    assert!(replaced("confidence: high", "confidence: sure").contains("line 4: `sure` is not one of high"));
    assert!(
        replaced("# unit: m/s", "# units: m/s")
            .contains("line 2: `# units: m/s` has an unknown key; the keys are quantity, unit")
    );
    assert!(replaced("# unit: m/s", "# unit m/s").contains("line 2: `# unit m/s` has no colon"));
    assert!(replaced("# unit: m/s", "# unit:").contains("line 2: `# unit:` has no value"));
    assert!(replaced("# unit: m/s", "# kind: fit").contains("line 3: `# kind: measured` repeats a key"));
}

#[test]
fn a_file_that_is_absent_is_named() {
    let error = MeasuredData::read(Path::new("no-such-folder/data.csv")).expect_err("absent").to_string();
    assert!(error.starts_with("read the reference data no-such-folder/data.csv: "), "{error}");
}

#[test]
fn rows_are_found_by_their_labels_and_say_how_sure_they_are() {
    let table = "law,confidence,\"to, or open\",c [-]\na,high,2.5,1\nb,low,open,4\n";
    let data = MeasuredData::parse("data.csv", &format!("{HEADER}{table}")).expect("readable");
    assert_eq!(data.number_of("law", "b", "c").expect("present"), 4.0);
    assert_eq!(data.confidences().expect("words"), [Confidence::High, Confidence::Low]);
    assert_eq!(data.upper_ends("to, or open").expect("ends"), [2.5, f64::INFINITY]);
    assert_eq!(
        data.row("law", "d").expect_err("absent").to_string(),
        "read the reference data data.csv: no row has `d` in the column `law`; there are a, b"
    );
    assert_eq!(
        data.upper_ends("law").expect_err("words").to_string(),
        "read the reference data data.csv: `a` in the column `law` is not one of finite numbers and `open`"
    );
    let bad = MeasuredData::parse("data.csv", &format!("{HEADER}law,confidence\na,sure\n")).expect("readable");
    assert!(bad.confidences().expect_err("no word").to_string().contains("`sure` in the column `confidence`"));
    let plain = MeasuredData::parse("data.csv", &format!("{HEADER}y [m]\n1\n2\n")).expect("readable");
    assert_eq!(plain.confidences().expect("the header's"), [Confidence::High; 2]);
}
