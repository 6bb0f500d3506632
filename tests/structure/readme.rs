//! Results in README.md and in the chapter on limits: what follows from the baseline values of the quick tier.

use crate::structure::source::workspace;
use bagnold_harness::evidence::{ValidatedComparison, ValidationSet};
use bagnold_validation::REGISTRY;

/// Row of the table: a case, its result in words, and the metric whose range over the chosen variants stands in their `{}`.
struct Row {
    case: &'static str,
    says: &'static str,
    metric: &'static str,
    /// Part that a variant must have, and part that it must not have.
    with: &'static str,
    without: &'static str,
}

const fn row(
    case: &'static str,
    says: &'static str,
    metric: &'static str,
    with: &'static str,
    without: &'static str,
) -> Row {
    Row { case, says, metric, with, without }
}

const ROWS: [Row; 17] = [
    row("hydrostatic", "pressure at rest {} off exact", "pressure_l2", "", ""),
    row("film", "velocity {} off exact", "velocity_l2", "particles=jittered,resolution=20", "numerics"),
    row("bagnold", "velocity on 22 and 24° {} off exact", "velocity_l2", "start=rest", "material"),
    row("column-planar", "run-out of sand {} times a fit to experiments", RUN_OUT, "material=sand", ""),
    row("column-round", "run-out {} times the measured", "run_out_ratio", "material=sand", ""),
    row("incline-collapse", "run-out {} times a fit to experiments", FRONT, "gate=1.3", ""),
    row("flow-thickness", "thin layers stop on slopes {} too gentle", "experimental_excess", "", ""),
    row("nonlocal-shear", "velocity {} off exact", "velocity_l2", "", ""),
    row("water-column", "height {} off measured", "height_error", "bed=smooth,tension=cut", ""),
    row("still-water", "pressure {} off exact", "pressure_l2", "", ""),
    row("water-film", "velocity {} off exact", "velocity_l2", "", ""),
    row("clear-water", "mean velocity {} times the logarithmic law's", "mean_velocity", "", ""),
    row("settling", "settling velocity {} off exact", "terminal_velocity_error", "", ""),
    row("bed-load-1d", "transport {} times Wong & Parker's fit", "transport_ratio", "start=rest", ""),
    row("bed-load", "transport {} times the 1-D layer's", "transport_ratio", "formulation=dilating", ""),
    row("scene", "balances of your 2-D geometry", "", "", ""),
    row("scene-space", "balances of your 3-D geometry", "", "", ""),
];

/// Metrics of the table of comparisons: a value over its reference.
const RUN_OUT: &str = "run_out/reference";
const FRONT: &str = "front_displacement/reference";

/// Sentences, each with its document; a metric that ends in `/reference` is a value over its reference.
const SENTENCES: [(&str, Row); 13] = [
    (
        "README.md",
        row(
            "bed-load-1d",
            "The 1-D layer carries {} of the measured transport",
            "transport_ratio",
            "sheet-flow,turbulent_schmidt=0",
            "grains",
        ),
    ),
    ("README.md", row("bed-load-1d", "with suspension {}", "transport_ratio", "layer=sheet-flow,grains=suspended", "")),
    (
        "README.md",
        row("flow-thickness", "stop on slopes {} too gentle under local μ(I)", "experimental_excess", "", "surface"),
    ),
    ("README.md", row("flow-thickness", "{} under the nonlocal law", "experimental_excess", "surface=vanishing", "")),
    (
        "README.md",
        row("column-planar", "run-out of sand is {} times the fit's", RUN_OUT, "material=sand,aspect_ratio=1.5", ""),
    ),
    (LIMITS, row("column-planar", "{} of the work of gravity in columns", "correction_work", "material=sand", "=10")),
    (LIMITS, row("column-round", "run-out {} with 12 particles", "run_out", "material=sand", "quantity")),
    (LIMITS, row("film", "{} at 10 particles", FILM, "fluid=newtonian,particles=jittered,resolution=10", "numerics")),
    (LIMITS, row("film", "{} at 20 particles", FILM, "fluid=newtonian,particles=jittered,resolution=20", "numerics")),
    (LIMITS, row("submerged-column", "after 2 s {}, measured 144", "pore_pressure_after_2_s", "", "")),
    (LIMITS, row("water-column", "front early by {}", "front_delay", "bed=smooth,tension=cut", "gate")),
    (
        LIMITS,
        row(
            "bed-load-1d",
            "{} of the measured transport",
            "transport_ratio",
            "layer=sheet-flow,turbulent_schmidt=0",
            "grains",
        ),
    ),
    (
        LIMITS,
        row("lid-driven-cavity", "circulation {} times the reference", "circulation_of_the_vortex/reference", "", ""),
    ),
];

const LIMITS: &str = "docs/src/limits.md";
const FILM: &str = "velocity_l2_compressible";

/// Flows of the table of ranges, with their cases.
const RANGES: [(&str, &str); 5] = [
    ("columns, 2-D | fits, other codes, a measured pile", "column-planar"),
    ("columns, 3-D | measured run-outs", "column-round"),
    ("collapse on a slope | a fit", "incline-collapse"),
    ("bed load, h the water depth | measured up to 1.7° and a Shields number of 0.25, a fit above", "bed-load-1d"),
    ("water column | measured", "water-column"),
];

/// Comparisons of a case with published results.
fn comparisons(case: &str) -> impl Iterator<Item = &'static ValidatedComparison> {
    ValidationSet::shipped().comparisons.iter().filter(move |own| own.case == case)
}

/// (name, variant, value, unit, verdict) of all metrics of a case, and of its values over their references.
fn baseline(case: &str) -> Vec<[String; 5]> {
    let ratio = |own: &ValidatedComparison| {
        let (name, value) = (format!("{}/reference", own.quantity), own.value / own.reference);
        [name, own.variant.to_string(), value.to_string(), "-".to_owned(), "compared".to_owned()]
    };
    let path = workspace().join(format!("tests/snapshots/quick/{case}.snap"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let cells = |line: &str| -> Option<[String; 5]> {
        line.split(" | ").map(str::to_owned).collect::<Vec<_>>().try_into().ok()
    };
    text.lines().filter_map(cells).chain(comparisons(case).map(ratio)).collect()
}

/// Gates that hold, and all gates.
fn gates(metrics: &[[String; 5]]) -> (usize, usize) {
    let of = |verdict: &str| metrics.iter().filter(|metric| metric[4] == verdict).count();
    (of("pass"), of("pass") + of("fail"))
}

/// Two decimals of a ratio, two significant digits of other values.
fn short(value: f64, unit: &str) -> String {
    if unit.is_empty() {
        return format!("{value:.2}");
    }
    let digits = (1.0 - value.abs().log10().floor()).clamp(0.0, 4.0) as usize;
    format!("{value:.digits$}")
}

impl Row {
    /// What it says, with the range of the values: of those with a gate if there are any.
    fn text(&self) -> String {
        let metrics = baseline(self.case);
        let is_own = |own: &&[String; 5]| {
            let has = |part: &str| part.split(',').all(|part| own[1].contains(part));
            own[0] == self.metric && has(self.with) && (self.without.is_empty() || !own[1].contains(self.without))
        };
        let (observed, gated): (Vec<_>, Vec<_>) = metrics.iter().filter(is_own).partition(|own| own[4] == "observed");
        let shown = if gated.is_empty() { observed } else { gated };
        let values: Vec<f64> = shown.iter().map(|own| own[2].parse::<f64>().expect("a number").abs()).collect();
        let (least, most) = values.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), &value| (a.min(value), b.max(value)));
        let unit = shown.first().map_or("", |own| own[3].as_str()).replace('-', "");
        let range = span(least, most, |value| short(value, &unit));
        self.says.replace("{}", format!("{range} {unit}").trim())
    }
}

fn span(least: f64, most: f64, digits: impl Fn(f64) -> String) -> String {
    let [least, most] = [least, most].map(digits);
    if least == most { most } else { format!("{least}–{most}") }
}

fn results() -> String {
    let mut lines = vec!["| case | result |".to_owned(), "|---|---|".to_owned()];
    lines.extend(ROWS.iter().map(|row| format!("| `{}` | {} |", row.case, row.text())));
    let studies = REGISTRY.studies().count();
    lines.push(format!("| {studies} studies | flows with known solutions ([list](docs/src/cases.md)) |"));
    lines.join("\n")
}

/// A document in one line.
fn document(name: &str) -> String {
    let text = std::fs::read_to_string(workspace().join(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn sentences_are_those_of_the_baseline() {
    let missing = SENTENCES.iter().map(|(name, row)| (name, row.text()));
    let missing: Vec<_> = missing.filter(|(name, says)| !document(name).contains(says)).collect();
    assert!(missing.is_empty(), "sentences are missing: {missing:#?}");
}

#[test]
fn ranges_are_those_of_the_comparisons() {
    let limits = document(LIMITS);
    let two = |value: f64| {
        let digits = (1.0 - value.abs().max(1e-9).log10().floor()).clamp(0.0, 4.0) as usize;
        format!("{value:.digits$}").parse::<f64>().expect("a number").to_string()
    };
    let missing = RANGES.map(|(flow, case)| {
        let rows: Vec<[Option<f64>; 4]> = comparisons(case).map(|own| own.regime().numbers()).collect();
        // slope, D/h, a and I
        let ranges = [1, 3, 0, 2].map(|number| {
            let values: Vec<f64> = rows.iter().filter_map(|row| row[number]).collect();
            let (least, most) = values.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), &own| (a.min(own), b.max(own)));
            if values.is_empty() { "–".to_owned() } else { span(least, most, two) }
        });
        format!("| {flow} | {} |", ranges.join(" | "))
    });
    let missing: Vec<_> = missing.into_iter().filter(|row| !limits.contains(row)).collect();
    assert!(missing.is_empty(), "{LIMITS} needs the rows:\n{}", missing.join("\n"));
}

#[test]
fn results_are_those_of_the_baseline() {
    let readme = std::fs::read_to_string(workspace().join("README.md")).expect("README.md");
    let table = results();
    assert!(readme.contains(&table), "README.md needs this table:\n{table}");
    let names: Vec<&str> = REGISTRY.cases().map(|case| case.name()).collect();
    assert_eq!(ROWS.map(|row| row.case).to_vec(), names);
}

/// The kinds are compared with a report by the tests in a browser.
#[test]
fn counts_of_gates_are_those_of_the_baseline() {
    let readme = std::fs::read_to_string(workspace().join("README.md")).expect("README.md");
    let cases = REGISTRY.cases().map(|case| case.name()).chain(REGISTRY.studies().map(|study| study.name()));
    let (held, all) = cases.map(|case| gates(&baseline(case))).fold((0, 0), |sum, own| (sum.0 + own.0, sum.1 + own.1));
    let row = readme.lines().find_map(|line| line.strip_prefix(&format!("| all {all} |"))).expect("a row of all gates");
    let numbers: Vec<usize> = row.split('|').filter_map(|cell| cell.trim().parse().ok()).collect();
    assert_eq!((numbers[0] + numbers[1], numbers[2]), (held, all - held), "{row}");
}
