//! A submission to be filled in: everything that a case takes, with what it means.

use crate::case::{AnyCase, Changes, ExternalColumn, ExternalSchema, ParameterError, Tier};
use std::fmt::Write as _;

/// A commented submission for a case: one run written out, the others listed.
///
/// # Errors
/// A tier whose parameters the case refuses, which no case does.
pub fn blank(case: &'static dyn AnyCase, tier: Tier) -> Result<String, ParameterError> {
    let prepared = case.prepare(tier, &Changes::default())?;
    let (form, (gates, limits)) = (case.form(), super::gates::digests(&prepared.asked().metrics));
    let mut text = format!(
        "# What another code gives of the case `{name}`, for `bagnold judge`.\n# {summary}\n#\n# Leave out what the code does not \
         give: it reads \"not judged\".\n# `bagnold show {name} --tier {tier}` prints geometry and \
         material; `bagnold export {name} --tier {tier} --out DIR`\n# writes them with initial particles, references and definitions.\n\n\
         case = \"{name}\"\ntier = \"{tier}\"\n# base = \"my-case.toml\"  # a case file with the parameters, such as a scene of one's own\n\
         # with = {{ … }}          # parameters that differ from the tier's, or from those of `base`\n\n\
         # Law of the runs: \"same\" as the case's, \"own\", or \"grains\"; only the same is judged against exact solutions.\n\
         law = \"same\"\n# Digest of the inputs without numerics: another value is refused.\ninputs = \"{inputs}\"\n\
         # Digests of the gates and of each limit: limits that have moved since are counted.\n\
         gates = \"{gates}\"\nlimits = \"{limits}\"\n\n\
         [code]\nname = \"my code\"\nversion = \"1.0\"\n\n",
        inputs = super::inputs::digest(prepared.parameters_toml()),
        name = case.name(),
        summary = case.summary(),
    );
    let variants: Vec<String> = (0..prepared.run_count()).map(|run| prepared.variant(run).to_string()).collect();
    text.push_str(
        "# One table [[run]] for each run that the code has: the name of the run here whose inputs it has. Name as many keys\n\
         # as tell it from the others. The runs of this tier:\n",
    );
    for variant in &variants {
        let _ = writeln!(text, "#   \"{variant}\"");
    }
    let _ = writeln!(text, "[[run]]\nvariant = \"{}\"\n", variants.first().map_or("", String::as_str));
    text.push_str("# Single numbers: metrics of this run by name, in their units. Some belong to other runs of the case; a number that a run does\n# not have is refused with those that it has.\n[run.numbers]\n");
    for quantity in case.quantities() {
        let _ = writeln!(text, "# {} = 0.0  # [{}] {}", quantity.name, quantity.unit, quantity.description);
    }
    text.push_str(&files(form, &of_case(form.description, case)));
    Ok(text)
}

/// A description that several cases share, without the sentences that open with a metric of another case.
pub(super) fn of_case(description: &str, case: &'static dyn AnyCase) -> String {
    let concerns = |sentence: &&str| {
        let first = sentence.split([' ', ',']).next().unwrap_or_default().trim_end_matches('…');
        !first.contains('_') || case.quantities().iter().any(|quantity| quantity.name.starts_with(first))
    };
    let kept: Vec<&str> = description.trim_end_matches('.').split(". ").filter(concerns).collect();
    if kept.is_empty() { String::new() } else { format!("{}.", kept.join(". ")) }
}

/// The tables of files that a form has.
fn files(form: &ExternalSchema, description: &str) -> String {
    let mut text = String::new();
    if form.particles.is_empty() && form.series.is_empty() && form.profile.is_empty() {
        text.push_str("\n# This case takes single numbers only.\n");
        return text;
    }
    for line in wrapped(description) {
        let _ = write!(text, "\n# {line}");
    }
    text.push_str(
        "\n\n# Files stand beside this one. Tables of numbers may be separated by commas, semicolons, tabs or blanks, with a heading;\n\
         # a column is named by its heading and its unit in brackets, such as \"x_cm [cm]\"; in files of VTK places are\n\
         # \"Points:0 [m]\", parts of a vector \"velocity:0 [m/s]\". What is the same for all is { value = 0.25, unit = \"cm^2\" }.\n",
    );
    if !form.particles.is_empty() {
        text.push_str(
            "# [run.particles]\n# files = [\"t0.csv\", \"t1.csv\"]   # .csv, .txt, .vtu, .vtp, .vtk, or one .pvd, or one .dump of LAMMPS\n\
             # times = [0.0, 0.1]             # [s], one per file; a .pvd or a dump says them itself\n\
             # time_step = 1e-5               # [s], of a dump that counts steps\n# [run.particles.columns]\n",
        );
        text.push_str(&columns(form.particles));
    }
    for (name, items) in [("series", form.series), ("profile", form.profile)] {
        if !items.is_empty() {
            let _ = writeln!(text, "# [run.{name}]\n# file = \"{name}.csv\"\n# [run.{name}.columns]");
            text.push_str(&columns(items));
        }
    }
    text
}

fn columns(items: &[ExternalColumn]) -> String {
    let line = |ExternalColumn { name, unit, description }: &ExternalColumn| {
        format!("# {name} = \"{name} [{unit}]\"  # {description}\n")
    };
    items.iter().map(line).collect()
}

/// Text in lines of at most 118 letters.
pub(super) fn wrapped(text: &str) -> Vec<String> {
    const LONGEST: usize = 118;
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut().filter(|line| line.chars().count() + word.chars().count() < LONGEST) {
            Some(line) => {
                line.push(' ');
                line.push_str(word);
            }
            None => lines.push(word.to_owned()),
        }
    }
    lines
}
