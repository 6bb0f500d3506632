//! Places where nothing is: probes that grains reach late, leave or never reach, and fronts that do not exist.

use crate::command_line::program::{Place, document};
use bagnold_harness::metric::Verdict;
use bagnold_harness::result::MetricEntry;
use std::collections::BTreeMap;

/// A block of a few particles that falls apart on a bed, or what an inlet feeds from 0.05 s on.
const FLUME: &str = "case = \"scene\"\nname = \"flume\"\nspacing = 0.01\nduration = 0.3\ninterval = 0.01\nmeasured = []\n\
    [sides]\nleft = { mirror = 0.0 }\nright = { open = 0.5 }\nbottom = \"none\"\ntop = \"none\"\n\
    [[walls]]\nname = \"bed\"\npoints = [[0.0, 0.0], [0.5, 0.0]]\n\
    [[gauges]]\nkind = \"probe\"\nname = \"always\"\nat = [0.03, 0.01]\n\
    [[gauges]]\nkind = \"probe\"\nname = \"late\"\nat = [0.16, 0.008]\n\
    [[gauges]]\nkind = \"probe\"\nname = \"falls-dry\"\nat = [0.08, 0.09]\n\
    [[gauges]]\nkind = \"probe\"\nname = \"never\"\nat = [0.4, 0.05]\n\
    [[gauges]]\nkind = \"probe\"\nname = \"behind-the-bed\"\nat = [0.03, -0.05]\n\
    [[gauges]]\nkind = \"depth\"\nname = \"far\"\nat = [0.4, 0.0]\nwidth = 0.02\n\
    [[gauges]]\nkind = \"flux\"\nname = \"gate\"\nfrom = [0.45, 0.2]\nto = [0.45, -0.2]\n\
    [[gauges]]\nkind = \"front\"\nname = \"high\"\nfrom = [0.0, 0.0]\nto = [0.5, 0.0]\nthickness = 0.2\n";
const BODY: &str = "[[bodies]]\nshape = \"box\"\nlower = [0.0, 0.0]\nupper = [0.1, 0.1]\n";

fn flume(place: &Place) {
    place.file("flume.toml", &format!("{FLUME}{BODY}"));
}

/// Cells of the gauges' table in a folder, column by column.
fn columns(place: &Place, folder: &str) -> BTreeMap<String, Vec<Option<f64>>> {
    let file = place.path(folder).join("tables/gauges-scene-flume.csv");
    let text = std::fs::read_to_string(file).expect("a table");
    let mut rows = text.lines().map(|line| line.split(',').collect::<Vec<_>>());
    let mut columns: Vec<(String, Vec<Option<f64>>)> =
        rows.next().expect("headings").into_iter().map(|heading| (heading.to_owned(), Vec::new())).collect();
    for row in rows {
        for ((_, cells), word) in columns.iter_mut().zip(row) {
            cells.push((!word.is_empty()).then(|| word.parse().expect("a number")));
        }
    }
    columns.into_iter().collect()
}

fn metric(place: &Place, command: &[&str], code: i32, name: &str) -> MetricEntry {
    let finished = place.bagnold(&[command, &["--json", "--quiet"]].concat()).assert().code(code);
    let mut metrics = document(&finished).metrics;
    let at = metrics.iter().position(|metric| metric.name == name).unwrap_or_else(|| panic!("no {name}"));
    metrics.swap_remove(at)
}

#[test]
fn a_dry_place_has_empty_cells_a_gap_in_its_curve_and_a_depth_of_nothing() {
    let place = Place::new();
    flume(&place);
    let front = metric(&place, &["run", "flume.toml", "--out", "out"], 0, "front");
    assert_eq!((front.value, front.verdict), (None, Verdict::Observed));
    assert_eq!(
        front.remark.as_deref(),
        Some("at the end, the material is thinner than `thickness` everywhere on the line")
    );
    let columns = columns(&place, "out");
    let wet = |heading: &str| columns[heading].iter().flatten().count();
    for quantity in ["pressure [Pa]", "pore pressure [Pa]", "velocity along x [m/s]"] {
        let of = |name: &str| wet(&format!("{name}: {quantity}"));
        assert_eq!((of("always"), of("never"), of("behind-the-bed")), (31, 0, 0), "{quantity}");
        assert!((5..31).contains(&of("late")) && (2..31).contains(&of("falls-dry")), "{quantity}");
    }
    assert_eq!(columns["late: pressure [Pa]"][0], None, "nothing has arrived");
    assert_eq!(columns["falls-dry: pressure [Pa]"][30], None, "all has left");
    assert!(columns["late: pressure [Pa]"].iter().flatten().all(|pressure| *pressure >= 0.0));
    for heading in
        ["far: depth [m]", "gate: mass that has crossed [kg/m]", "gate: mean flux since the last row [kg/(m s)]"]
    {
        assert_eq!(columns[heading], [Some(0.0); 31], "{heading}");
    }
    assert_eq!(wet("high: front [m]"), 0);
    // a panel for the pressures, and one for the velocities
    let drawn = std::fs::read_to_string(place.path("out/figures/gauges.csv")).expect("data of the figure");
    let empty = |axis: &str| drawn.lines().filter(|line| line.contains(&format!("never,t [s],{axis}"))).count();
    assert_eq!((empty("pressure [Pa]"), empty("velocity [m/s]")), (62, 62));
    assert!(!drawn.contains("NaN"));
    // the table is read again
    place.bagnold(&["compare", "out", "out", "--out", "compared"]).assert().code(0);
}

/// Grains with water in their pores: above both there is no pressure of either.
#[test]
fn above_the_water_there_is_no_pore_pressure() {
    let place = Place::new();
    let material = "material = { law = \"viscous-number\", critical_friction = 0.415, friction_slope = 90.5, \
        critical_fraction = 0.582, fraction_slope = 25.0, dilatancy = 4.09, solid_fraction = 0.578, grain_diameter = 1e-3, \
        grain_density = 2500.0, liquid_density = 1000.0, liquid_viscosity = 0.001 }\n\
        bulk = { solid_fraction = 1.0, bulk_density = 0.0 }\n[sides]";
    let wet = FLUME.replace("[sides]", material).replace("duration = 0.3", "duration = 0.02");
    place.file("flume.toml", &format!("{wet}{BODY}"));
    place.run(&["flume.toml", "--quiet"]).code(0);
    let columns = columns(&place, "out");
    assert!(columns["always: pore pressure [Pa]"].iter().flatten().any(|pressure| *pressure != 0.0));
    assert!(columns["never: pore pressure [Pa]"].iter().all(Option::is_none));
}

#[test]
fn a_gate_on_a_place_that_nothing_reaches_is_not_judged_and_a_mean_counts_wet_rows() {
    let place = Place::new();
    flume(&place);
    let check = |column: &str, rest: &str| {
        let study = "study = \"dry\"\nsummary = \"dry places\"\nbase = \"flume.toml\"\n";
        let check = format!("[[checks]]\nname = \"check\"\ntable = \"gauges\"\ncolumn = \"{column}\"\n{rest}\n");
        place.file("study.toml", &format!("{study}{check}reason = \"any\"\n"));
    };
    let run = ["run", "study.toml", "--out", "judged", "--junit", "judged.xml"];
    for (column, rest) in [
        ("never: pressure [Pa]", "value = \"largest\"\nat_most = 1.0"),
        ("never: velocity along x [m/s]", "value = \"mean\"\nwithin = [-1.0, 1.0]"),
        ("high: front [m]", "value = \"last\"\nat_most = 0.1"),
        ("falls-dry: pressure [Pa]", "value = { at = 0.28 }\nat_most = 1.0"),
        ("never: velocity along x [m/s]", "compare = \"never.csv\"\nat_most = 9.0"),
    ] {
        place.file("never.csv", "t [s],velocity along x [m/s],uncertainty [m/s]\n0.1,0.0,0.05\n0.2,0.0,0.05\n");
        check(column, rest);
        let dry = metric(&place, &run, 1, "check");
        assert_eq!((dry.value, dry.verdict), (None, Verdict::Fail), "{column}");
        assert!(dry.remark.as_ref().is_some_and(|reason| reason.contains(" of 31 rows")), "{:?}", dry.remark);
        let junit = std::fs::read_to_string(place.path("judged.xml")).expect("written");
        assert!(junit.contains("type=\"not judged\">no value, limit"), "{junit}");
        assert!(junit.contains(&format!("`{column}` has a value in ")), "{junit}");
    }
    let column = "late: velocity along x [m/s]";
    check(column, "value = \"mean\"\nwithin = [0.0, 2.0]");
    let mean = metric(&place, &run, 0, "check");
    let wet: Vec<f64> = columns(&place, "judged").remove(column).expect("a column").into_iter().flatten().collect();
    let (count, plain) = (wet.len(), wet.iter().sum::<f64>() / wet.len() as f64);
    // over all rows it would be a third less
    assert!(mean.value.is_some_and(|mean| (mean / plain - 1.0).abs() < 0.1), "{:?} and {plain}", mean.value);
    let counted = format!("`{column}` has a value in {count} of 31 rows, t [s] from 0 to 0.29");
    assert!(mean.remark.as_ref().is_some_and(|remark| remark.starts_with(&counted)), "{:?}", mean.remark);
}

#[test]
fn measurements_beside_a_dry_place_judge_nothing_and_constrain_nothing() {
    let place = Place::new();
    flume(&place);
    place.file("never.csv", "# limit: 1\nt [s],never: velocity along x [m/s],sigma [m/s]\n0.1,0.0,0.1\n0.2,0.0,0.1\n");
    let overlay = ["run", "flume.toml", "--out", "out", "--overlay", "never.csv"];
    let dry = metric(&place, &overlay, 1, "overlay_residual");
    assert_eq!((dry.value, dry.verdict), (None, Verdict::Fail));
    assert_eq!(dry.remark.as_deref(), Some("`velocity along x [m/s]` has a value at 0 of 2 measurements"));
    let data = "# quantity: velocity\n# unit: m/s\n# kind: measured\n# confidence: medium\n# uncertainty: 3 %, column\n\
        # source: own\n# licence: own data\nt [s],never: velocity along x [m/s],uncertainty [m/s]\n0.1,0.1,0.03\n0.2,0.2,0.04\n";
    place.file("data.csv", data);
    let tables = format!("{FLUME}{BODY}").replace("[sides]", "[fit.with.sides]").replace("\n[[", "\n[[fit.with.");
    let plan = "title = \"friction\"\n[[parameters]]\npath = \"material.static_friction\"\nunit = \"-\"\nlower = 0.3\nupper = 0.5\n\
        [[fit]]\ndata = [{ table = \"gauges-scene-flume\", x = \"t [s]\", y = \"never: velocity along x [m/s]\", file = \"data.csv\" }]\n";
    let (case, with) = tables.split_once('\n').expect("a case");
    place.file("plan.toml", &format!("{plan}{case}\n[fit.with]\n{with}"));
    let refused = place.bagnold(&["calibrate", "plan.toml", "--out", "fitted"]).assert().code(2);
    let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(
        message.contains("no value of `gauges-scene-flume` at 0.1") && message.contains("0 of 31 rows"),
        "{message}"
    );
}

#[test]
fn before_an_inlet_feeds_there_is_no_front_and_no_velocity() {
    let place = Place::new();
    let inlet = "[[inlets]]\nname = \"feed\"\nfrom = [0.0, 0.06]\nto = [0.0, 0.0]\n\
        rates = [[0.0, 0.0], [0.05, 0.0], [0.06, 20.0], [0.3, 20.0]]\n\
        [[gauges]]\nkind = \"front\"\nname = \"toe\"\nfrom = [0.0, 0.0]\nto = [0.5, 0.0]\nthickness = 0.01\n";
    let fed =
        FLUME.replace("left = { mirror = 0.0 }", "left = \"none\"").replace("[[0.0, 0.0], [0.5", "[[-0.05, 0.0], [0.5");
    place.file("flume.toml", &format!("bodies = []\n{fed}{inlet}"));
    place.run(&["flume.toml", "--quiet"]).code(0);
    let columns = columns(&place, "out");
    for heading in ["toe: front [m]", "always: velocity along x [m/s]"] {
        let wet = columns[heading].iter().position(Option::is_some).expect("it arrives");
        assert!((5..31).contains(&wet) && columns[heading][wet..].iter().all(Option::is_some), "{heading}: {wet}");
    }
    assert_eq!(columns["far: depth [m]"], [Some(0.0); 31]);
}
