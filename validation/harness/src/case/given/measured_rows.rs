//! Files of measurements that gauges of a case file are compared with: their rows are read with the file and are parameters like any
//! others, so that a run is known by them, whatever becomes of their file.

use super::error::ParameterError;
use crate::evidence::{MeasuredColumns, WantedColumns};
use crate::input::MeasuredFiles;
use std::path::Path;
use toml::{Table, Value};

/// Adds the rows of the files that `measured` names by a path from the case file on. What has rows keeps them: the name then says where
/// they came from.
pub(in crate::case) fn read_beside(fields: &mut Table, case: &str, path: &Path) -> Result<(), ParameterError> {
    let gauges = fields.get("gauges").and_then(Value::as_array).cloned().unwrap_or_default();
    let measured = fields.get_mut("measured").and_then(Value::as_array_mut);
    for measured in measured.into_iter().flatten().filter_map(Value::as_table_mut) {
        let points = measured.get("points");
        // a path in place of rows is what people try first
        let named = points.map_or(measured.get("file"), |points| Some(points).filter(|points| points.is_str()));
        let Some(named) = named.filter(|named| named.as_str() != Some("")).cloned() else { continue };
        let files: MeasuredFiles = named.clone().try_into().map_err(|_| {
            let rule =
                "a file of measurements, or { files = […], columns = { t = \"ms [ms]\", toe = [\"run A [cm]\"] } }";
            ParameterError::field("measured.file", &named, rule, "write file = \"mine.csv\"").in_file(path)
        })?;
        if files.files().is_empty() {
            let remedy = "write file = \"mine.csv\"";
            return Err(ParameterError::field("measured.file", &named, "one file or more", remedy).in_file(path));
        }
        let gauge = measured.get("gauge").and_then(Value::as_str).unwrap_or_default();
        let is_own = |other: &&Value| other.get("name").and_then(Value::as_str) == Some(gauge);
        let own = gauges.iter().find(is_own);
        if own.is_none() && !gauges.is_empty() {
            let (value, remedy) = (format!("\"{gauge}\""), "correct the name");
            return Err(ParameterError::field("measured.gauge", value, "the name of a gauge", remedy).in_file(path));
        }
        let kind = own.and_then(|gauge| gauge.get("kind")).and_then(Value::as_str);
        // the first column of a gauge; in the plane per width
        let (column, units) = match kind {
            Some("probe") => ("pressure", ["Pa", "Pa"]),
            Some("force") => ("force along x", ["N/m", "N"]),
            Some("turn") => ("torque", ["N m/m", "N m"]),
            Some("flux") => ("mass that has crossed", ["kg/m", "kg"]),
            Some("position") => ("displacement along x", ["m", "m"]),
            Some("depth") => ("depth", ["m", "m"]),
            _ => ("front", ["m", "m"]),
        };
        let unit = units[usize::from(case == "scene-space")];
        let both = format!("{gauge}: {column}");
        let wanted = WantedColumns { quantity: &[gauge, column, &both], of_time: true, ..Default::default() };
        let beside = files.beside(path.parent().unwrap_or(Path::new("")));
        let read = MeasuredColumns::read::<ParameterError>(&beside, wanted)?;
        let points = read.means("s", unit).map_err(|error| error.in_file(&beside.files()[0]))?;
        let row = |(time, value): (f64, f64)| Value::Array(vec![Value::Float(time), Value::Float(value)]);
        let rows: Vec<Value> = points.into_iter().map(row).collect();
        let names: Vec<String> = files.files().iter().map(|file| file.display().to_string()).collect();
        let name = names.join(", ");
        measured.insert("points".to_owned(), rows.into());
        measured.insert("file".to_owned(), name.into());
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn repeats_in_centimetres_become_rows_of_their_mean_in_metres() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let text = "# own\nt [ms],front #1 [cm],front #2 [cm],sigma [cm]\n100,13,15,1\n200,19,21,1\n";
        std::fs::write(folder.path().join("a.csv"), text).expect("writable");
        let path = folder.path().join("case.toml");
        let gauge = "[[gauges]]\nkind = \"front\"\nname = \"toe\"\n[[measured]]\ngauge = \"toe\"\n";
        let rows = "points = [[0.1, 0.14], [0.2, 0.2]]\nfile = \"a.csv\"";
        let own = "file = { files = [\"a.csv\"], columns = { t = \"t [ms]\", toe = [\"front #1 [cm]\", \"front #2 [cm]\"] } }";
        for given in ["file = \"a.csv\"", "points = \"a.csv\"", own] {
            let mut fields: Table = toml::from_str(&format!("{gauge}{given}")).expect("TOML");
            read_beside(&mut fields, "scene", &path).expect("read");
            assert_eq!(fields, toml::from_str(&format!("{gauge}{rows}")).expect("TOML"), "{given}");
        }
        let mut slip: Table =
            toml::from_str(&format!("{gauge}file = \"a.csv\"").replace("gauge = \"toe\"", "gauge = \"teo\""))
                .expect("TOML");
        let slip = read_beside(&mut slip, "scene", &path).expect_err("no such gauge").to_string();
        assert!(slip.contains("`measured.gauge` is \"teo\", but must be the name of a gauge"), "{slip}");
        let mut own: Table = toml::from_str(&format!("{gauge}{}", rows.replace("a.csv", "gone.csv"))).expect("TOML");
        assert!(read_beside(&mut own, "scene", &path).is_ok(), "what has rows needs no file");
    }

    #[test]
    fn files_of_repeats_count_by_their_mean_at_common_times_and_what_is_no_series_is_named() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let read = |texts: &[&str]| {
            for (name, text) in ["a.csv", "b.csv"].iter().zip(texts) {
                std::fs::write(folder.path().join(name), text).expect("writable");
            }
            let files = if texts.len() == 1 { "\"a.csv\"" } else { "[\"a.csv\", \"b.csv\"]" };
            let text =
                format!("[[gauges]]\nkind = \"front\"\nname = \"toe\"\n[[measured]]\ngauge = \"toe\"\nfile = {files}");
            let mut fields: Table = toml::from_str(&text).expect("TOML");
            let read = read_beside(&mut fields, "scene", &folder.path().join("case.toml"));
            read.map(|()| fields["measured"][0]["points"].to_string()).map_err(|error| error.to_string())
        };
        let other = "t [s],toe [m]\n0.3,0.3\n0.15,0.15\n0.05,0.05\n";
        assert_eq!(
            read(&["t [s],toe [cm]\n0.1,20\n0.2,30\n0.4,50\n", other]).as_deref(),
            Ok("[[0.1, 0.15000000000000002], [0.2, 0.25], [0.4, 0.5]]")
        );
        assert_eq!(read(&["t [ms],toe: front [cm],other [m]\n1000,200,7\n"]).as_deref(), Ok("[[1.0, 2.0]]"));
        let refused = read(&["t [s],toe [cm]\n1,20\n", "t [s],toe [kg]\n1,2\n"]).expect_err("refused");
        assert!(refused.contains("b.csv: `toe` is [kg], but must be a unit that converts to [cm]"), "{refused}");
        let mut none: Table = toml::from_str("[[measured]]\ngauge = \"toe\"\nfile = []").expect("TOML");
        let none = read_beside(&mut none, "scene", &folder.path().join("case.toml")).expect_err("refused").to_string();
        assert!(none.contains("case.toml: `measured.file` is [], but must be one file or more"), "{none}");
        for (texts, said) in [
            (
                &["t [s],toe [cm]\n1,20\n", other][..],
                "b.csv: `t` is [0.3, 0.15, 0.05], but must be in rows of the same t as in the first file;",
            ),
            (
                &["t [s],toe\n0,1\n"],
                "a.csv: `columns`: no unit of `toe` among t [s], toe; write it in brackets, such as `toe [cm]`",
            ),
            (&["toe [cm]\n1\n"], "a.csv: `columns`: no column of what was varied, such as `t`, among toe [cm];"),
            (
                &["t [s],toe: front at half a row more [m]\n0,1\n"],
                "a.csv: `columns`: no column `toe` among t [s], toe: front at",
            ),
            (&["t [s],toe [s]\n0,1\n"], "a.csv: `toe` is [s], but must be a unit that converts to [m]"),
            (
                &["t [s],u [m],v [m]\n0,1,2\n"],
                "a.csv: `columns`: no column `toe` among t [s], u [m], v [m]; rename one, or",
            ),
            (&["t [s]\n0\n"], "a.csv: `columns`: no column `toe` among t [s];"),
        ] {
            let found = read(texts);
            assert!(found.as_ref().is_err_and(|message| message.contains(said)), "{said}: {found:?}");
        }
    }
}
