//! A file of controls → controls; every rule that one can break.

use super::{Control, ErrorSeries};
use serde::Deserialize;

include!(concat!(env!("OUT_DIR"), "/controls.rs"));

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    /// Errors in several sizes that the case's gates are asked about.
    #[serde(default)]
    series: Vec<String>,
    #[serde(default, rename = "control")]
    controls: Vec<Control>,
}

/// The text of a file beside the controls; none where there is none.
pub(super) fn text(file: &str) -> Option<&'static str> {
    FILES.iter().find(|(name, _)| *name == file).map(|(_, text)| *text)
}

/// The controls of a case by its name; none where it has none.
///
/// # Panics
/// If its file is malformed. No user can bring that about: the files are part of the program, and tests read every one of them.
pub fn of_case(case: &str) -> Vec<Control> {
    let file = format!("{case}.toml");
    text(&file).map_or_else(Vec::new, |text| parse(&file, text).unwrap_or_else(|error| panic!("failed to {error}")))
}

/// The controls of a file, or a message that completes "failed to …": the file, the defect and its remedy.
fn parse(file: &str, text: &str) -> Result<Vec<Control>, String> {
    let refuse = |message: String| format!("read controls/{file}: {message}");
    let rows: File = toml::from_str(text).map_err(|error| refuse(error.to_string().trim_end().to_owned()))?;
    let mut controls: Vec<Control> = Vec::new();
    for row in rows.controls {
        let of = |rule: &str| refuse(format!("control \"{}\" {rule}", row.name));
        if controls.iter().any(|other| other.name == row.name) {
            return Err(of("is listed twice; give each another name"));
        }
        if row.set.is_empty() == row.solver.is_none() {
            return Err(of("needs either `set`, changes of parameters, or `solver`, an error of the solver"));
        }
        if row.rejected_by.is_empty() && row.accepted_by.is_empty() {
            return Err(of("names no metric; name some in `rejected_by` or `accepted_by`"));
        }
        controls.push(row);
    }
    for name in rows.series {
        let series = ErrorSeries::find(&name);
        let series = series
            .ok_or_else(|| refuse(format!("`series` names \"{name}\", which does not exist; name a known one")))?;
        controls.extend(series.controls());
    }
    Ok(controls)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROW: &str = "[[control]]\nname = \"a\"\nerror = \"b\"\nset = [\"x=1\"]\nrejected_by = [\"front\"]\n";

    #[test]
    fn every_file_is_read() {
        assert!(!FILES.is_empty());
        for (name, _) in FILES.iter().filter(|(name, _)| name.ends_with(".toml")) {
            assert!(!of_case(name.trim_end_matches(".toml")).is_empty(), "{name}");
        }
        assert!(of_case("no such case").is_empty());
    }

    #[test]
    fn broken_rule_names_the_field() {
        assert_eq!(parse("x.toml", ROW).expect("a control").len(), 1);
        for (text, expected) in [
            (ROW.repeat(2), "twice"),
            (ROW.replace("set = [\"x=1\"]\n", ""), "either `set`"),
            (ROW.replace("rejected_by = [\"front\"]\n", ""), "names no metric"),
            (ROW.replace("error", "mistake"), "mistake"),
            (format!("series = [\"friction\"]\n{ROW}"), "\"friction\", which does not exist"),
        ] {
            let error = parse("x.toml", &text).expect_err("refused").to_string();
            assert!(error.contains(expected) && error.contains("controls/x.toml"), "{error}");
        }
    }
}
