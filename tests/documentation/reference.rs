//! Reference pages of the book that follow from the program: commands, fields of files, metrics.

use crate::documentation::book;
use bagnold_harness::case::{AnyCase, Tier};
use bagnold_harness::metric::MetricKind;
use bagnold_scenes::study;
use bagnold_tools::{calibration, grains, sweep};
use bagnold_validation::REGISTRY;
use bagnold_validation::cli::Arguments;
use clap::{Arg, Command, CommandFactory};
use serde_json::Value;
use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

/// First line of a generated page.
const NOTICE: &str = "<!-- Generated; `cargo test --test suite documentation` tells when it is out of date. -->\n\n";

/// Compares a page with its text; a page that differs is written to `target/reference`.
pub(crate) fn assert_page(name: &str, text: &str) {
    // readers see no comment
    let told = text.trim_end().replacen("\n\n", "\n\n*This page is generated from the program.*\n\n", 1);
    let text = format!("{NOTICE}{told}\n");
    let page = book().join(name);
    if std::fs::read_to_string(&page).is_ok_and(|old| old == text) {
        return;
    }
    let folder = book().join("../../target/reference");
    std::fs::create_dir_all(&folder).expect("a folder for generated pages");
    std::fs::write(folder.join(name), text).expect("a generated page");
    panic!("docs/src/{name} is out of date: copy target/reference/{name} there");
}

/// A cell of a table: one line without bars.
pub(crate) fn cell(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|")
}

/// A paragraph in lines of at most 100 characters.
pub(crate) fn wrapped(text: &str) -> String {
    let mut lines = vec![String::new()];
    for word in text.split_whitespace() {
        let last = lines.last().map_or(0, |line| line.chars().count());
        if last > 0 && last + 1 + word.chars().count() > 98 {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            line.push_str(if line.is_empty() { "" } else { " " });
            line.push_str(word);
        }
    }
    lines.join("\n")
}

fn description(schema: &Value) -> String {
    cell(schema["description"].as_str().unwrap_or_default()).trim_end_matches('.').to_owned()
}

/// Options and arguments of a command, then its subcommands.
fn write_command(page: &mut String, path: &str, command: &Command) {
    let about = command.get_about().map(ToString::to_string).unwrap_or_default();
    let arguments: Vec<&Arg> =
        command.get_arguments().filter(|own| !own.is_hide_set() && own.get_id() != "help").collect();
    let children: Vec<&Command> =
        command.get_subcommands().filter(|own| own.get_name() != "help" && !own.is_hide_set()).collect();
    let _ = writeln!(page, "## {path}\n\n{}.\n", wrapped(&about));
    if !arguments.is_empty() {
        page.push_str("| option | value | description |\n|---|---|---|\n");
    }
    for argument in arguments {
        let values: Vec<String> =
            argument.get_value_names().unwrap_or_default().iter().map(|name| cell(name)).collect();
        let takes_value = argument.get_action().takes_values();
        let short = argument.get_short().map(|letter| format!("`-{letter}` ")).unwrap_or_default();
        let name =
            argument.get_long().map_or_else(|| format!("`{}`", values.join(" ")), |long| format!("{short}`--{long}`"));
        let choices: Vec<String> = argument
            .get_possible_values()
            .iter()
            .filter(|_| takes_value)
            .map(|own| own.get_name().to_owned())
            .collect();
        let value = match (takes_value && argument.get_long().is_some(), choices.is_empty()) {
            (true, true) => values.join(" "),
            (true, false) => choices.join(", "),
            (false, _) => String::new(),
        };
        let defaults: Vec<String> = argument
            .get_default_values()
            .iter()
            .filter(|_| takes_value)
            .map(|own| own.to_string_lossy().into_owned())
            .collect();
        let help = argument.get_help().map(ToString::to_string).unwrap_or_default();
        let default = if defaults.is_empty() { String::new() } else { format!(" (default: {})", defaults.join(", ")) };
        let _ = writeln!(page, "| {name} | {value} | {}{default} |", cell(&help));
    }
    if let Some(after) = command.get_after_help() {
        let _ = writeln!(page, "\n```text\n{after}\n```");
    }
    page.push('\n');
    for child in children {
        write_command(page, &format!("{path} {}", child.get_name()), child);
    }
}

#[test]
fn commands_are_those_of_the_program() {
    let command = Arguments::command();
    let mut page = "# Commands\n\n".to_owned();
    write_command(&mut page, "bagnold", &command);
    assert_page("commands.md", &page);
}

/// Word for the type of a field.
fn kind(schema: &Value) -> String {
    if let Some(value) = schema.get("const") {
        return value.to_string();
    }
    // of an optional field the type beside null
    let types = schema["type"].as_array().into_iter().flatten().chain([&schema["type"]]);
    match types.filter_map(Value::as_str).find(|name| *name != "null") {
        Some("number") => "number".to_owned(),
        Some("integer") => "integer".to_owned(),
        Some("boolean") => "true or false".to_owned(),
        Some("string") if schema["enum"].is_null() => "text".to_owned(),
        Some("array") if schema["prefixItems"].is_array() => {
            let count = schema["prefixItems"].as_array().map_or(0, Vec::len);
            format!("{count} values")
        }
        Some("array") => "list".to_owned(),
        Some("object") => "table".to_owned(),
        _ if schema["not"].is_object() => "number".to_owned(),
        _ => choices(schema).join(", "),
    }
}

/// Values of a field that takes one of several words.
fn choices(schema: &Value) -> Vec<String> {
    let ways = ["oneOf", "anyOf"].iter().filter_map(|key| schema[key].as_array()).flatten();
    let of_ways = ways
        .filter(|way| way["type"] != "null")
        .map(|way| way.get("const").map_or_else(|| kind(way), |value| value.to_string()));
    let listed = schema["enum"].as_array().into_iter().flatten().map(ToString::to_string);
    let mut found: Vec<String> = of_ways.chain(listed).filter(|word| !word.is_empty()).collect();
    found.dedup();
    found
}

/// A row for a field, and rows for the fields below it.
fn write_field(page: &mut String, path: &str, schema: &Value) {
    let default = schema.get("default").map(ToString::to_string).filter(|text| text.chars().count() <= 24);
    let default = default.map(|text| format!("`{text}`")).unwrap_or_default();
    let rule = schema["x-rule"].as_str().map(|rule| format!("; {rule}")).unwrap_or_default();
    let says = description(schema);
    let _ = writeln!(page, "| `{path}` | {} | {default} | {says}{rule} |", cell(&kind(schema)));
    write_below(page, path, schema);
}

fn write_below(page: &mut String, path: &str, schema: &Value) {
    for (name, field) in schema["properties"].as_object().into_iter().flatten() {
        if field.get("const").is_none() {
            write_field(page, &format!("{path}.{name}"), field);
        }
    }
    if schema["items"].is_object() {
        write_below(page, &format!("{path}[]"), &schema["items"]);
    }
    for way in ["oneOf", "anyOf"].iter().filter_map(|key| schema[key].as_array()).flatten() {
        let fields = way["properties"].as_object();
        let tag = fields.into_iter().flatten().find(|(_, field)| field.get("const").is_some());
        let Some((tag, value)) = tag else {
            write_below(page, path, way);
            continue;
        };
        let path = format!("{path} {tag}={}", value["const"].as_str().unwrap_or_default());
        let _ = writeln!(page, "| `{path}` | | | {} |", description(way));
        write_below(page, &path, way);
    }
}

/// The fields of a file, without those that another one has with the same words.
fn write_file(page: &mut String, title: &str, schema: &Value) {
    let mut rows = String::new();
    for (name, field) in schema["properties"].as_object().into_iter().flatten() {
        write_field(&mut rows, name, field);
    }
    let known: BTreeSet<&str> = page.lines().collect();
    let (again, new): (Vec<&str>, Vec<&str>) = rows.lines().partition(|row| known.contains(row));
    let mut section = format!("## {title}\n\n");
    if !again.is_empty() {
        let _ = writeln!(section, "Further fields, {} of them, are those of the files above.\n", again.len());
    }
    let _ = writeln!(section, "| field | type | default | description |\n|---|---|---|---|\n{}\n", new.join("\n"));
    page.push_str(&section);
}

#[test]
fn fields_are_those_of_the_schemas() {
    let mut page = "# Fields of scenes, studies and plans\n\n`a.b` is field `b` of table `a`, and `a[].b` is field `b` of each entry of \
        list `a`.\n`a kind=x.b` exists where field `kind` of `a` is `x`. `bagnold show CASE` prints the fields of\nother cases.\n\n"
        .to_owned();
    for name in ["scene", "scene-space"] {
        let case = REGISTRY.find(name).expect("a case");
        write_file(
            &mut page,
            &format!("{name}: {}", case.summary().split(':').next().unwrap_or_default()),
            &case.schema(Tier::Quick),
        );
    }
    write_file(&mut page, "study", &study::schema());
    let mut plan = calibration::schema().clone();
    plan["properties"]["hold_out"]["items"].take(); // those of `fit`
    write_file(&mut page, "calibration", &plan);
    write_file(&mut page, "grains", grains::schema());
    write_file(&mut page, "sweep", sweep::schema());
    assert_page("fields.md", &page);
}

#[test]
fn catalogue_is_that_of_the_registry() {
    let mut page = "# Cases and studies\n\n`bagnold list` prints this list, `bagnold show NAME` the parameters, `bagnold run NAME` runs one.\n\n\
        ## Cases in Rust\n\n| case | what it is |\n|---|---|\n"
        .to_owned();
    for case in REGISTRY.cases() {
        let _ = writeln!(page, "| `{}` | {} |", case.name(), cell(case.summary()));
    }
    page.push_str(
        "\n## Studies\n\nScene files with checks, in `validation/studies`:\n\n| study | what it is |\n|---|---|\n",
    );
    for study in REGISTRY.studies() {
        let _ = writeln!(page, "| `{}` | {} |", study.name(), cell(study.summary()));
    }
    assert_page("cases.md", &page);
}

#[test]
fn metrics_are_those_of_the_cases() {
    let mut page = "# Metrics\n\nEach value stands in `metrics.json` and on the page of its case, with its reference and limit.\n\n\
        | kind | compared with |\n|---|---|\n| verification | the equations of the model |\n| validation | measurements or published fits \
        |\n| statement | statements of the two papers |\n| bookkeeping | balances of the run |\n\n⟨ ⟩ is a mean.\n\n"
        .to_owned();
    let mut rows: BTreeMap<String, &str> = BTreeMap::new();
    let mut write = |case: &dyn AnyCase| {
        if case.quantities().is_empty() {
            return;
        }
        let _ = writeln!(page, "## {}\n\n| metric | unit | kind | definition |\n|---|---|---|---|", case.name());
        let mut again: BTreeMap<&str, Vec<String>> = BTreeMap::new();
        for own in case.quantities() {
            let kind = match own.kind {
                MetricKind::Validation => "validation",
                MetricKind::Statement => "statement",
                MetricKind::Verification => "verification",
                MetricKind::Bookkeeping => "bookkeeping",
            };
            let row = format!("| `{}` | {} | {kind} | {} |", own.name, own.unit, cell(own.description));
            if let Some(&first) = rows.get(&row) {
                again.entry(first).or_default().push(format!("`{}`", own.name));
            } else {
                let _ = writeln!(page, "{row}");
                rows.insert(row, case.name());
            }
        }
        for (first, names) in again {
            let _ = writeln!(page, "| {} | | | as in `{first}` |", names.join(", "));
        }
        page.push('\n');
    };
    REGISTRY.cases().for_each(&mut write);
    assert_page("metrics.md", &page);
}
