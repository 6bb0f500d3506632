//! Tests of reading reference files: good ones completely, bad ones with their exact place.

use super::*;

const HEADER: &str = "# quantity: velocity over depth\n# unit: m/s\n# kind: measured\n# confidence: high\n\
                      # uncertainty: 3 %\n# source: test: its own\n# licence: none\n";

fn message(text: &str) -> String {
    MeasuredData::parse(Path::new("data.csv"), text).expect_err("refused").to_string()
}

fn message_of_table(table: &str) -> String {
    message(&format!("{HEADER}{table}"))
}

#[test]
fn a_good_file_is_read_completely() {
    let text = format!(
        "\u{feff}{HEADER}\nheight [m], velocity [m/s] ,run\r\n0.001,0.012,a\r\n\n0.002,-2.4e-2,\"b, again\"\r\n"
    );
    let data = MeasuredData::parse(Path::new("data.csv"), &text).expect("readable");
    assert_eq!(data.metadata.quantity, "velocity over depth");
    assert_eq!(data.metadata.source, "test: its own");
    assert_eq!((data.metadata.origin, data.metadata.confidence), (ReferenceKind::Measured, Confidence::High));
    assert_eq!(data.numbers("height").expect("present"), [0.001, 0.002]);
    assert_eq!(data.numbers("velocity").expect("present"), [0.012, -0.024]);
    assert_eq!(data.labels("run").expect("present"), ["a", "b, again"]);
    assert!(matches!(&data.columns[1], ReferenceColumn::Numbers(column) if column.unit == "m/s"));
}

#[test]
fn a_column_that_is_not_there_is_answered_with_those_that_are() {
    let data = MeasuredData::parse(Path::new("data.csv"), &format!("{HEADER}y [m],run\n1,a\n")).expect("readable");
    let error = data.numbers("run").expect_err("a label").to_string();
    assert_eq!(error, "data.csv: `run`: no column of numbers; the columns are `y`, `run`");
    assert!(data.labels("y").is_err());
}

#[test]
fn a_bad_number_is_located() {
    for bad in ["abc", "NaN", "inf", "", "1,5", "-9999"] {
        let field = if bad.contains(',') { format!("\"{bad}\"") } else { bad.to_owned() };
        let error = message_of_table(&format!("y [m],u [m/s]\n1,2\n2,{field}\n"));
        let place = format!("data.csv: `line 10`: \"{bad}\" in column u [m/s] is not a measured value;");
        assert!(error.starts_with(&place), "{error}");
    }
}

#[test]
fn a_bad_table_is_located() {
    let cases = [
        ("y [m],u [m/s]\n1,2\n1\n", "`line 10`: 1 columns, and the heading has 2"),
        ("y [m],u [m/s]\n1,2,3\n", "`line 9`: 3 columns, and the heading has 2"),
        ("y [m],y [mm]\n1,2\n", "`line 8`: two columns `y`"),
        ("y [m]  u [m/s]\n1  2\n", "`line 8`: names of columns and values differ in number; name each column"),
        ("y [m],u [m/s]\n", "`table`: missing"),
        ("", "`table`: missing"),
    ];
    for (table, expected) in cases {
        let error = message_of_table(table);
        assert!(error.contains(expected), "{error} for {table:?}");
    }
}

#[test]
fn columns_may_be_separated_by_semicolons_and_tabs() {
    for separator in [";", "\t"] {
        let table = "y [m],run\n1,a\n2,b\n".replace(',', separator);
        let data = MeasuredData::parse(Path::new("data.csv"), &format!("{HEADER}{table}")).expect("readable");
        assert_eq!((data.numbers("y").expect("there"), data.labels("run").expect("there").len()), (&[1.0, 2.0][..], 2));
    }
}

#[test]
fn bad_metadata_is_located() {
    let table = "y [m]\n1\n";
    let replaced = |from: &str, to: &str| message(&format!("{}{table}", HEADER.replace(from, to)));
    for (from, to, expected) in [
        ("# unit: m/s\n", "", "data.csv: `header`: missing field `unit`; write `# key: value`"),
        ("kind: measured", "kind: guess", "unknown variant `guess`, expected one of `analytic`"),
        ("confidence: high", "confidence: sure", "unknown variant `sure`"),
        ("confidence: high", "confidence: exact", "`# confidence` is exact, but must be one of high"),
        ("# unit: m/s", "# units: m/s", "unknown field `units`, expected one of `quantity`"),
        ("# unit: m/s", "# unit m/s", "`line 2`: \"# unit m/s\"; write `# key: value`"),
        ("# unit: m/s", "# unit:", "`line 2`: \"# unit:\"; write"),
        ("# unit: m/s", "# kind: fit", "`line 3`: \"# kind: measured\"; write"),
    ] {
        let said = replaced(from, to);
        assert!(said.contains(expected), "{said}");
    }
}

#[test]
fn rows_are_found_by_their_labels_and_say_how_sure_they_are() {
    let table = "law,confidence,\"to, or open\",c [-]\na,high,2.5,1\nb,low,open,4\n";
    let data = MeasuredData::parse(Path::new("data.csv"), &format!("{HEADER}{table}")).expect("readable");
    assert_eq!(data.number_of("law", "b", "c").expect("present"), 4.0);
    assert_eq!(data.confidences().expect("words"), [Confidence::High, Confidence::Low]);
    assert_eq!(data.upper_ends("to, or open").expect("ends"), [2.5, f64::INFINITY]);
    assert_eq!(data.row("law", "d").expect_err("absent").to_string(), "data.csv: `law`: no row `d`; the rows are a, b");
    assert_eq!(
        data.upper_ends("law").expect_err("words").to_string(),
        "data.csv: `law` is \"a\", but must be one of finite numbers and `open`; correct the row"
    );
    let bad =
        MeasuredData::parse(Path::new("data.csv"), &format!("{HEADER}law,confidence\na,sure\n")).expect("readable");
    assert!(bad.confidences().expect_err("no word").to_string().contains("`confidence` is \"sure\""));
    let plain = MeasuredData::parse(Path::new("data.csv"), &format!("{HEADER}y [m]\n1\n2\n")).expect("readable");
    assert_eq!(plain.confidences().expect("the header's"), [Confidence::High; 2]);
}
