//! Files of measurements that gauges of a case file are compared with: their rows are read with the file and are parameters like any
//! others, so that a run is known by them, whatever becomes of their file.

use super::error::ParameterError;
use super::rates::in_unit;
use crate::input::{
    DOCUMENT, FieldError, MeasuredFiles, TextTable, is_uncertainty, of_repeats, parted, read_text, renamed,
};
use crate::output::FileError;
use std::collections::{BTreeMap, BTreeSet};
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
        let wanted = GaugeColumn { gauge, column, unit: units[usize::from(case == "scene-space")] };
        let columns = if let MeasuredFiles::Named { columns, .. } = &files { Some(columns) } else { None };
        let [only] = files.files() else {
            let (value, remedy) = (files.files().len(), "give the repeats as columns of one file");
            return Err(
                ParameterError::field("measured.file", format!("{value} files"), "one file", remedy).in_file(path)
            );
        };
        let file = path.parent().unwrap_or(Path::new("")).join(only);
        let text = read_text(&file, DOCUMENT).map_err(|error| FileError::unreadable(&file, &error))?;
        let row = |(time, value): (f64, f64)| Value::Array(vec![Value::Float(time), Value::Float(value)]);
        let rows: Vec<Value> = rows(&text, &file, &wanted, columns)?.into_iter().map(row).collect();
        let name = only.display().to_string();
        measured.insert("points".to_owned(), rows.into());
        measured.insert("file".to_owned(), name.into());
    }
    Ok(())
}

/// First column of a gauge.
struct GaugeColumn<'a> {
    gauge: &'a str,
    column: &'a str,
    unit: &'a str,
}

/// Times `[s]` and values of a gauge, of repeats their mean; without a unit they are taken as they are.
fn rows(
    text: &str,
    file: &Path,
    &GaugeColumn { gauge, column, unit }: &GaugeColumn<'_>,
    columns: Option<&BTreeMap<String, Value>>,
) -> Result<Vec<(f64, f64)>, FieldError> {
    let mut table = TextTable::parse(text, file)?;
    if let Some(columns) = columns {
        let given: Vec<&str> = table.headings.iter().map(String::as_str).collect();
        let meant = renamed(&given, columns).map_err(|error| error.in_file(file))?;
        let all = meant.into_iter().zip(std::mem::take(&mut table.columns));
        let mut meant: Vec<(String, Vec<f64>)> = all.filter(|(heading, _)| !heading.is_empty()).collect();
        meant.sort_by_key(|(heading, _)| !["t", "time"].contains(&parted(heading).0));
        (table.headings, table.columns) = meant.into_iter().unzip();
    }
    let names: Vec<String> = table.headings.iter().map(|heading| of_repeats(heading)).collect();
    let quantities: BTreeSet<&str> =
        names.iter().skip(1).map(String::as_str).filter(|name| !is_uncertainty(parted(name).0)).collect();
    let bare: BTreeSet<&str> = quantities.iter().map(|name| parted(name).0).collect();
    if bare.len() < quantities.len() {
        let defect = format!("one quantity in several units: {}", names.join(", "));
        return Err(FieldError::finding("columns", defect, "convert the columns to one unit").in_file(file));
    }
    let is_named = |name: &&&str| {
        let own = parted(name).0;
        own == gauge || own == column || own.strip_prefix(gauge) == Some(&format!(": {column}"))
    };
    // another column of a gauge is another quantity
    let is_other = |name: &&&str| [": ", " along "].iter().any(|mark| parted(name).0.contains(mark));
    let only = quantities.first().filter(|name| quantities.len() == 1 && !is_other(name));
    let Some(heading) = quantities.iter().find(is_named).or(only) else {
        let defect = format!("none of {} is the {column} of `{gauge}`", names.join(", "));
        let repeats = format!("repeats as several columns `{gauge} [{unit}]`");
        let own = format!(
            "name your own headings by file = {{ files = […], columns = {{ t = \"ms [ms]\", {gauge} = [\"run A [cm]\"] }} }}"
        );
        let remedy = format!("write `t [ms],{gauge} [{unit}]` above the rows, {repeats}, or {own}");
        return Err(FieldError::finding("columns", defect, &remedy).in_file(file));
    };
    let times = in_unit(&names[0], &table.columns[0], "s", file)?;
    let values = in_unit(heading, &table.column(heading, "columns", file)?, unit, file)?;
    Ok(times.into_iter().zip(values).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOE: GaugeColumn<'_> = GaugeColumn { gauge: "toe", column: "front", unit: "m" };

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
    fn what_is_no_series_of_the_gauge_is_named() {
        let read = |text: &str| rows(text, Path::new("a.csv"), &TOE, None).map_err(|error| error.to_string());
        for (text, said) in [
            (
                "t [s],toe [cm],toe #2 [mm]\n0,1,2\n",
                "a.csv: `columns`: one quantity in several units: t [s], toe [cm], toe [mm];",
            ),
            (
                "t [s],toe: front at half a row more [m]\n0,1\n",
                "a.csv: `columns`: none of t [s], toe: front at half a row more [m] is the front of `toe`;",
            ),
            ("t [s],toe [s]\n0,1\n", "a.csv: `toe [s]` is [s], but must be a unit that converts to [m]"),
            ("t [s],u [m],v [m]\n0,1,2\n", "a.csv: `columns`: none of t [s], u [m], v [m] is the front of `toe`;"),
            ("t [s]\n0\n", "a.csv: `columns`: none of t [s] is the front of `toe`; write `t [ms],toe [m]` above"),
        ] {
            assert!(read(text).is_err_and(|message| message.starts_with(said)), "{said}: {:?}", read(text));
        }
        assert_eq!(read("t,toe: front [cm],other [m]\n1,200,7\n"), Ok(vec![(1.0, 2.0)]));
    }
}
