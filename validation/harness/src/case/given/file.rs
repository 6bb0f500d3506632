//! A case as a TOML file: `case` and `tier` on top, the parameters below.

use super::changes::lay_over;
use super::error::ParameterError;
use super::{measured_rows, meshes, rates};
use crate::case::{OutputPlan, Tier};
use crate::input::{DOCUMENT, FieldError, MeasuredFiles, nearest, read_text};
use crate::output::FileError;
use bagnold_solver::parameter::shortened;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use toml::{Table, Value};

/// A file that was read, its parameters still untyped.
#[derive(Debug, Clone)]
pub struct CaseFile {
    /// Path of the file.
    pub path: PathBuf,
    /// The case that it describes.
    pub case: String,
    /// Tier that supplies parameters missing in the file.
    pub tier: Option<Tier>,
    /// Files with measurements to be drawn into its figures; beside the file, unless they say otherwise.
    pub overlay: Vec<MeasuredFiles>,
    /// States to be written during its runs.
    pub output: Option<OutputPlan>,
    /// Everything else.
    pub fields: Table,
}

impl CaseFile {
    /// Reads a file; its parameters are checked when the case takes them.
    ///
    /// # Errors
    /// A file that cannot be read, is not TOML, or does not name its case.
    pub fn read(path: &Path) -> Result<Self, ParameterError> {
        let text = read_text(path, DOCUMENT).map_err(|error| FileError::unreadable(path, &error))?;
        Self::parse(path, &text)
    }

    fn parse(path: &Path, text: &str) -> Result<Self, ParameterError> {
        let mut fields: Table = toml::from_str(text).map_err(|error| {
            FieldError::of_toml(text, &error, error.message(), "correct the TOML syntax there").in_file(path)
        })?;
        let wrong = |field: &str, value: &Value, rule: &str, remedy: &str| {
            ParameterError::field(field, value, rule, remedy).in_file(path)
        };
        let case = match fields.remove("case") {
            Some(Value::String(case)) => shortened(case),
            Some(other) => return Err(wrong("case", &other, "the name of a case", "`bagnold list` prints the names")),
            None if fields.contains_key("study") => {
                let remedy = "run it with `bagnold run`, or name its base file here";
                return Err(FieldError::finding("study", "a study, not a case file", remedy).in_file(path).into());
            }
            None => {
                let remedy = "add `case = \"…\"` (`bagnold list` prints the names)";
                return Err(FieldError::finding("case", "missing", remedy).in_file(path).into());
            }
        };
        let tier = match fields.remove("tier") {
            None => None,
            Some(value) => Some(value.clone().try_into::<Tier>().map_err(|_| {
                let rule = "one of `quick`, `paper`, `fine`";
                let guess = value.as_str().and_then(|name| nearest(name, ["quick", "paper", "fine"]));
                let remedy = guess
                    .map_or_else(|| "leave it out for `quick`".to_owned(), |guess| format!("did you mean `{guess}`?"));
                wrong("tier", &value, rule, &remedy)
            })?),
        };
        let overlay = match fields.remove("overlay") {
            None => Vec::new(),
            Some(value) => value.clone().try_into::<Vec<MeasuredFiles>>().map_err(|_| {
                let rule = "files with measurements, or tables of `files` and `columns`";
                wrong("overlay", &value, rule, "write overlay = [\"mine.csv\"]")
            })?,
        };
        let beside = path.parent().unwrap_or(Path::new(""));
        let overlay = overlay.iter().map(|files| files.beside(beside)).collect();
        let output = OutputPlan::taken(&mut fields, path)?;
        meshes::read_beside(&mut fields, path)?;
        rates::read_beside(&mut fields, path)?;
        measured_rows::read_beside(&mut fields, &case, path)?;
        Ok(Self { path: path.to_owned(), case, tier, overlay, output, fields })
    }

    /// Values by their dotted paths in a file of another form; files that they name stand beside it.
    ///
    /// # Errors
    /// A file of triangles that cannot be read.
    pub fn of_parameters(path: &Path, case: &str, tier: Option<Tier>, values: &Table) -> Result<Self, ParameterError> {
        let mut fields = Table::new();
        lay_over(&mut fields, values);
        meshes::read_beside(&mut fields, path)?;
        rates::read_beside(&mut fields, path)?;
        measured_rows::read_beside(&mut fields, case, path)?;
        let case = shortened(case.to_owned());
        Ok(Self { path: path.to_owned(), case, tier, overlay: Vec::new(), output: None, fields })
    }

    /// Parameters of a plan: those of its case or base file, overwritten by the values of the plan.
    ///
    /// # Errors
    /// Neither a case nor a base, a base of another case, a file that cannot be read.
    pub fn of_plan(
        plan: &Path,
        case: Option<&str>,
        base: Option<&Path>,
        tier: Option<Tier>,
        own: &Table,
    ) -> Result<Self, ParameterError> {
        let base = base.map(|base| Self::read(&plan.parent().unwrap_or(Path::new("")).join(base))).transpose()?;
        let Some(name) = case.or(base.as_ref().map(|base| &*base.case)) else {
            let remedy = "add case = \"scene\", or base = \"my-case.toml\"";
            return Err(FieldError::finding("case", "missing", remedy).into());
        };
        let mut own = own.clone();
        // by which measurements know their units
        if let Some(gauges) =
            base.as_ref().and_then(|base| base.fields.get("gauges")).filter(|_| own.contains_key("measured"))
        {
            own.entry("gauges").or_insert_with(|| gauges.clone());
        }
        let own = Self::of_parameters(plan, name, tier, &own)?;
        let Some(mut base) = base else { return Ok(own) };
        if own.case != base.case {
            let rule = format!("the case of {}, \"{}\"", base.path.display(), base.case);
            let remedy = "name the same case in both files";
            return Err(ParameterError::field("case", format!("\"{}\"", own.case), &rule, remedy).in_file(plan));
        }
        base.lay_over(&own.fields);
        base.tier = tier.or(base.tier);
        Ok(base)
    }

    /// Lays fields over its own: tables field by field, everything else as a whole.
    pub fn lay_over(&mut self, over: &Table) {
        lay_over(&mut self.fields, over);
    }

    /// The text of a complete file: the parameters in the order of their struct, each with its note.
    pub(in crate::case) fn text(case: &str, tier: Tier, parameters: &str, notes: &BTreeMap<String, String>) -> String {
        let mut text = format!("case = \"{case}\"\ntier = \"{tier}\"\n");
        if !parameters.starts_with('[') {
            text.push('\n');
        }
        let mut section = String::new();
        let mut entries = BTreeMap::new();
        for line in parameters.lines() {
            let path = if line.starts_with('[') {
                section = numbered(line, &mut entries);
                if !text.ends_with("\n\n") {
                    text.push('\n');
                }
                Some(section.clone())
            } else {
                let key = line.split_once(" = ").map(|(key, _)| key);
                key.map(|key| if section.is_empty() { key.to_owned() } else { format!("{section}.{key}") })
            };
            text.push_str(line);
            if let Some(note) = path.and_then(|path| notes.get(&path)) {
                text.push_str("  # ");
                text.push_str(note);
            }
            text.push('\n');
        }
        // The serialiser already parts its tables by an empty line, and so does the loop above.
        text.replace("\n\n\n", "\n\n")
    }
}

/// The path of a table's head, in which entries of lists are numbered as far as they have been counted: `gauges[1].grains`.
fn numbered(head: &str, entries: &mut BTreeMap<String, usize>) -> String {
    let keys = head.trim_matches(['[', ']']);
    if head.starts_with("[[") {
        // each entry counts the lists below it anew
        entries.retain(|list, _| !list.starts_with(&format!("{keys}.")));
        entries.entry(keys.to_owned()).and_modify(|index| *index += 1).or_insert(0);
    }
    let (mut list, mut path) = (String::new(), String::new());
    for key in keys.split('.') {
        let dot = if list.is_empty() { "" } else { "." };
        list += &format!("{dot}{key}");
        path += &format!("{dot}{key}");
        path.extend(entries.get(&list).map(|index| format!("[{index}]")));
    }
    path
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(text: &str) -> String {
        CaseFile::parse(Path::new("case.toml"), text).expect_err("bad file").to_string()
    }

    #[test]
    fn a_file_must_be_toml_and_name_its_case() {
        assert_eq!(
            message("depth = 1.0"),
            "case.toml: `case`: missing; add `case = \"…\"` (`bagnold list` prints the names)"
        );
        assert_eq!(
            message("case = 3"),
            "case.toml: `case` is 3, but must be the name of a case; `bagnold list` prints the names"
        );
        assert_eq!(
            message("case = \"film\"\ntier = \"papre\""),
            "case.toml: `tier` is \"papre\", but must be one of `quick`, `paper`, `fine`; did you mean `paper`?"
        );
        assert!(message("study = \"mine\"").contains("`study`: a study, not a case file; run it with"));
        assert!(message("case = \"film\"\ndepth = = 1").starts_with("case.toml: `line 2, column 9`: "));
    }

    #[test]
    fn measurements_are_files_beside_it() {
        let read = |text: &str| CaseFile::parse(Path::new("mine/case.toml"), text);
        let file = read("case = \"film\"\noverlay = [\"a.csv\", { files = [\"/b.csv\"] }]").expect("a case file");
        let files: Vec<&PathBuf> = file.overlay.iter().flat_map(MeasuredFiles::files).collect();
        assert_eq!(files, [Path::new("mine/a.csv"), Path::new("/b.csv")]);
        assert!(file.fields.is_empty());
        assert_eq!(
            read("case = \"film\"\noverlay = 3").expect_err("no list").to_string(),
            "mine/case.toml: `overlay` is 3, but must be files with measurements, or tables of `files` and `columns`; write overlay = [\"mine.csv\"]"
        );
    }

    #[test]
    fn an_unreadable_file_is_named_with_the_reason() {
        let error = CaseFile::read(Path::new("no/such/case.toml")).expect_err("no such file");
        assert_eq!(
            error.to_string(),
            "no/such/case.toml: cannot be read (no such file or directory); check the path and its permissions"
        );
    }

    #[test]
    fn notes_stand_behind_their_fields() {
        let text = CaseFile::text(
            "film",
            Tier::Paper,
            "depth = 0.01\n\n[fluid]\ndensity = 1000.0\n",
            &[("depth", "height of the layer [m]"), ("fluid", "water"), ("fluid.density", "[kg/m³]")]
                .map(|(path, note)| (path.to_owned(), note.to_owned()))
                .into(),
        );
        assert_eq!(
            text,
            "case = \"film\"\ntier = \"paper\"\n\ndepth = 0.01  # height of the layer [m]\n\n[fluid]  # water\ndensity = 1000.0  # [kg/m³]\n"
        );
    }

    #[test]
    fn heads_of_list_entries_are_numbered() {
        let heads = ["[a]", "[[b]]", "[b.c]", "[[b.d]]", "[[b.d]]", "[[b]]", "[b.c]", "[[b.d]]"];
        let mut entries = BTreeMap::new();
        let paths = heads.map(|head| numbered(head, &mut entries));
        assert_eq!(paths, ["a", "b[0]", "b[0].c", "b[0].d[0]", "b[0].d[1]", "b[1]", "b[1].c", "b[1].d[0]"]);
    }

    #[test]
    fn fields_are_laid_over_others_table_by_table() {
        let mut base: Table = toml::from_str("a = 1\n[b]\nc = 1\nd = [1]").expect("TOML");
        lay_over(&mut base, &toml::from_str("e = 2\n[b]\nd = [2, 3]").expect("TOML"));
        assert_eq!(base, toml::from_str::<Table>("a = 1\ne = 2\n[b]\nc = 1\nd = [2, 3]").expect("TOML"));
    }
}
