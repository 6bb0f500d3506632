//! Results in README.md: the table that follows from the baseline values of the quick tier.

use crate::structure::source::workspace;
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
    row("column-planar", "surface of a pile {} off measured", "surface_distance", "material=bars,", ""),
    row("column-round", "run-out {} times the measured", "run_out_ratio", "material=sand", ""),
    row("incline-collapse", "run-out {}; measured 0.54–1.5 m", "front_displacement", "gate=1.3", ""),
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

/// (name, variant, value, unit, verdict) of all metrics of a case.
fn baseline(case: &str) -> Vec<[String; 5]> {
    let path = workspace().join(format!("tests/snapshots/quick/{case}.snap"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let cells = |line: &str| -> Option<[String; 5]> {
        line.split(" | ").map(str::to_owned).collect::<Vec<_>>().try_into().ok()
    };
    text.lines().filter_map(cells).collect()
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

fn results() -> String {
    let mut lines = vec!["| case | result |".to_owned(), "|---|---|".to_owned()];
    for Row { case, says, metric, with, without } in &ROWS {
        let metrics = baseline(case);
        let is_shown = |own: &&[String; 5]| {
            let has = |part: &str| part.split(',').all(|part| own[1].contains(part));
            own[0] == *metric && own[4] != "observed" && has(with) && (without.is_empty() || !own[1].contains(without))
        };
        let shown: Vec<&[String; 5]> = metrics.iter().filter(is_shown).collect();
        let values: Vec<f64> = shown.iter().map(|own| own[2].parse::<f64>().expect("a number").abs()).collect();
        let (least, most) = values.iter().fold((f64::INFINITY, 0.0_f64), |(a, b), &value| (a.min(value), b.max(value)));
        let unit = shown.first().map_or("", |own| own[3].as_str()).replace('-', "");
        let range = if short(least, &unit) == short(most, &unit) {
            short(most, &unit)
        } else {
            format!("{}–{}", short(least, &unit), short(most, &unit))
        };
        let result = says.replace("{}", format!("{range} {unit}").trim());
        lines.push(format!("| `{case}` | {result} |"));
    }
    let studies = REGISTRY.studies().count();
    lines.push(format!("| {studies} studies | flows with known solutions ([list](docs/src/cases.md)) |"));
    lines.join("\n")
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

#[test]
fn catalogue_is_that_of_the_registry() {
    let rows = |named: Vec<(&str, &str)>| -> String {
        named.iter().map(|(name, summary)| format!("| `{name}` | {summary} |\n")).collect()
    };
    let cases = rows(REGISTRY.cases().map(|case| (case.name(), case.summary())).collect());
    let studies = rows(REGISTRY.studies().map(|study| (study.name(), study.summary())).collect());
    let book = std::fs::read_to_string(workspace().join("docs/src/cases.md")).expect("docs/src/cases.md");
    for table in [cases, studies] {
        assert!(book.contains(&table), "docs/src/cases.md needs these rows:\n{table}");
    }
}
