//! Export of a case for external codes: geometry, material, initial particles, references and definitions.

use super::blank::{blank, of_case, wrapped};
use super::inputs::digest;
use super::laws;
use crate::ToolError;
use crate::case::{AnyCase, CaseResult, Condition, PreparedCase, Tier};
use crate::evidence::shipped_tables;
use crate::figure::{Mark, Series};
use crate::metric::{Metric, MetricKind};
use crate::number::four_digits;
use crate::observation::Frame;
use crate::output::{FileError, Table};
use crate::result::write_snapshots;
use std::fmt::Write as _;
use std::io;
use std::path::Path;

/// Writes `case.toml`, `definitions.md`, `boundary.csv`, `start.csv`, `submission.toml` and `reference/` into a folder. With results of our own runs also their
/// first pictures, the initial particles, in `particles/`, and their profiles and histories in `bagnold/`.
///
/// # Errors
/// Files that cannot be written.
pub fn export(
    case: &'static dyn AnyCase,
    prepared: &dyn PreparedCase,
    tier: Tier,
    own: Option<&CaseResult>,
    folder: &Path,
) -> Result<(), ToolError> {
    let submission = blank(case, tier).map_err(|error| error.in_plan(folder))?;
    let put = || -> io::Result<()> {
        inputs(case, prepared, folder)?;
        own.map_or(Ok(()), |own| results(own, folder))?;
        std::fs::write(folder.join("submission.toml"), submission)
    };
    Ok(put().map_err(|error| FileError::unwritable(folder, &error))?)
}

/// Writes the inputs, which follow from the case alone.
fn inputs(case: &'static dyn AnyCase, prepared: &dyn PreparedCase, folder: &Path) -> io::Result<()> {
    let asked = prepared.asked();
    let parameters = prepared.parameters_toml();
    let digest =
        format!("# inputs = \"{}\": their digest without numerics, for `submission.toml`\n", digest(parameters));
    std::fs::write(folder.join("case.toml"), digest + parameters)?;
    std::fs::write(folder.join("definitions.md"), definitions(case, prepared, &asked.metrics))?;
    conditions(prepared, folder)?;
    let put = |name: &str, text: &str| {
        let path = folder.join("reference").join(name);
        std::fs::create_dir_all(path.parent().unwrap_or(folder))?;
        std::fs::write(path, text)
    };
    for (name, text) in shipped_tables() {
        if let Some(own) = name.strip_prefix(case.name()).and_then(|rest| rest.strip_prefix('/')) {
            put(own, text)?;
        }
    }
    let is_reference = |series: &Series| series.mark == Mark::Reference && !series.points.is_empty();
    for mut figure in asked.figures {
        figure.panels.iter_mut().for_each(|panel| panel.series.retain(is_reference));
        figure.panels.retain(|panel| !panel.series.is_empty());
        if !figure.panels.is_empty() {
            put(&format!("{}.csv", figure.name), &crate::figure::csv(&figure))?;
        }
    }
    Ok(())
}

/// Writes `boundary.csv` and `start.csv`, from the scenes that our own runs start with.
fn conditions(prepared: &dyn PreparedCase, folder: &Path) -> io::Result<()> {
    let of_run = |run| {
        let rows = prepared.conditions(run).unwrap_or_default().rows;
        rows.into_iter().map(move |row| (prepared.variant(run).to_string(), row))
    };
    let all: Vec<(String, Condition)> = (0..prepared.run_count()).flat_map(of_run).collect();
    for (name, is_start) in [("boundary.csv", false), ("start.csv", true)].into_iter().filter(|_| !all.is_empty()) {
        let mut table = csv::Writer::from_path(folder.join(name))?;
        table.write_record(["run", if is_start { "part" } else { "boundary" }, "kind", "quantity", "value", "unit"])?;
        for (run, row) in all.iter().filter(|(_, row)| row.is_of_start() == is_start) {
            let rounded: f64 = format!("{:.5e}", row.value).parse().unwrap_or(row.value);
            let value = if rounded.is_finite() { (rounded + 0.0).to_string() } else { String::new() };
            table.write_record([run, &row.part, row.kind, &row.quantity, &value, row.unit])?;
        }
        table.flush()?;
    }
    Ok(())
}

/// Writes the first pictures and the tables of our own runs.
fn results(own: &CaseResult, folder: &Path) -> io::Result<()> {
    let particles = folder.join("particles");
    for (run, frames) in own.runs.iter().zip(&own.frames) {
        if let Some(first) = frames.first().filter(|frame| frame.time == 0.0) {
            let name = if run.variant.is_empty() { "run".to_owned() } else { run.variant.file_name() };
            write_snapshots(&particles, &name, std::slice::from_ref(first))?;
            table(&name, first).write(&particles)?;
        }
    }
    let curves = folder.join("bagnold");
    std::fs::create_dir_all(&curves)?;
    own.tables.iter().try_for_each(|table| table.write(&curves))
}

/// A picture as a table: places, and every scalar and vector with its unit.
fn table(name: &str, frame: &Frame) -> Table {
    let mut headings: Vec<String> = ["x [m]", "y [m]", "z [m]"].map(str::to_owned).to_vec();
    headings.extend(frame.scalars.iter().map(|(name, unit, _)| format!("{name} [{unit}]")));
    for (name, unit, _) in &frame.vectors {
        headings.extend(["x", "y", "z"].map(|axis| format!("{name}_{axis} [{unit}]")));
    }
    let row = |particle: usize| {
        let mut row = frame.position[particle].to_vec();
        row.extend(frame.scalars.iter().map(|(_, _, values)| values[particle]));
        row.extend(frame.vectors.iter().flat_map(|(_, _, values)| values[particle]));
        row
    };
    let headings: Vec<&str> = headings.iter().map(String::as_str).collect();
    Table::of_rows(name.to_owned(), &headings, (0..frame.position.len()).map(row))
}

/// The exact meaning of everything, as a page of prose.
fn definitions(case: &'static dyn AnyCase, prepared: &dyn PreparedCase, asked: &[Metric]) -> String {
    let mut text = format!("# {}\n\n{}\n", case.name(), paragraph(case.description()));
    text.push_str(
        "\nGeometry, material and gravity are in `case.toml`, in SI units, angles in degrees; every key is explained there. Of a run's \
         keys the resolution and the numerics are a code's own business. `boundary.csv` and `start.csv` hold the boundary conditions \
         and the start of every run, which are those of our own scenes. `submission.toml` lists every column and number \
         with its unit. `reference/` holds exact, measured and published curves. With \
         `bagnold export --simulate`, `particles/` holds the initial particles of our runs and `bagnold/` our profiles and histories.\n",
    );
    text.push_str("\n## Runs\n\n");
    for run in 0..prepared.run_count() {
        let _ = writeln!(text, "- `{}`", prepared.variant(run));
    }
    text.push_str(&laws::section(prepared.parameters_toml()));
    let form = case.form();
    if !form.description.is_empty() {
        let _ = write!(text, "\n## How measurements are taken\n\n{}\n", paragraph(&of_case(form.description, case)));
    }
    text.push_str("\n## Limits\n\n");
    for metric in asked.iter().filter(|metric| metric.kind != MetricKind::Bookkeeping) {
        let Some(gate) = &metric.gate else { continue };
        let source = metric.reference.as_ref().map(|of| format!(" Reference: {}.", of.source)).unwrap_or_default();
        let limit = gate.limit.in_words(four_digits);
        let _ = writeln!(text, "- `{}` of `{}`: {limit}. {}.{source}", metric.name, metric.variant, gate.reason);
    }
    text
}

fn paragraph(text: &str) -> String {
    wrapped(text).join("\n")
}
