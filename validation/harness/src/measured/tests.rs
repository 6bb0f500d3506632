use super::*;
use crate::case::Tier;
use crate::figure::{Axis, Band, Figure, Mark, Panel};
use crate::metric::Verdict;
use std::collections::BTreeMap;

const TABLE: &str = "# source: own flume\nt [ms],front [cm],uncertainty [mm]\n100,20,10\n200,40,10\n";

fn read(text: &str) -> Result<Measurements, String> {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("mine.csv");
    std::fs::write(&path, text).expect("writable");
    Measurements::read(&MeasuredFiles::One(path.clone()), WantedColumns::default())
        .map_err(|error| error.to_string().replace(&path.display().to_string(), "mine.csv"))
}

/// A front that moves 2 m/s in one panel, and a profile u = 3 y in another.
fn result() -> CaseResult {
    let mut front = Panel::new("", Axis::linear("t [s]"), Axis::linear("front [m]"));
    front.line("sand", 0, [(0.0, 0.0), (1.0, 2.0)]);
    front.reference("law", [(0.0, 0.0), (1.0, 9.0)]);
    let mut profile = Panel::new("", Axis::linear("u [m/s]"), Axis::linear("y/h"));
    profile.points("coarse", 0, [(0.0, 0.0), (3.0, 1.0)]);
    profile.line_points("fine", 1, [(0.0, 0.0), (6.0, 1.0)]);
    CaseResult {
        name: "film".to_owned(),
        origin: crate::store::CodeOrigin::PACKAGE,
        summary: String::new(),
        description: String::new(),
        tier: Tier::Quick,
        parameters_toml: String::new(),
        command: String::new(),
        metrics: Vec::new(),
        figures: vec![Figure::new("front", "", vec![front]), Figure::new("profile", "", vec![profile])],
        animations: Vec::new(),
        tables: Vec::new(),
        runs: Vec::new(),
        run_parameters: Vec::new(),
        regimes: Vec::new(),
        frames: Vec::new(),
        first_bad: Vec::new(),
        state_hash: String::new(),
    }
}

fn refused(text: &str) -> String {
    match read(text) {
        Err(message) => message,
        Ok(measurements) => {
            let error = measurements.draw(&mut result()).expect_err("refused").to_string();
            error.replace(&measurements.path.display().to_string(), "mine.csv")
        }
    }
}

#[test]
fn points_with_bars_go_into_the_panel_with_their_axes_and_units_are_converted() {
    let mut result = result();
    read(TABLE).expect("a table").draw(&mut result).expect("axes that are there");
    let series = result.figures[0].panels[0].series.last().expect("drawn");
    assert_eq!((series.label.as_str(), series.mark, series.colour), ("mine", Mark::Points, 1));
    assert_eq!(series.points, [(0.1, 0.2), (0.2, 0.4)]);
    assert_eq!(series.error, [0.01, 0.01]);
    let [metric] = result.metrics.as_slice() else { panic!("{:?}", result.metrics) };
    assert_eq!((metric.name.as_str(), metric.variant.to_string().as_str()), ("overlay_residual", "overlay=mine"));
    assert!(metric.value < 1e-12, "the front is where it was measured: {}", metric.value);
    assert_eq!(metric.verdict(), Verdict::Observed);
    assert_eq!(metric.reference.as_ref().map(|reference| reference.source.as_str()), Some("own flume"));
}

#[test]
fn a_residual_is_the_root_mean_square_in_uncertainties_and_a_stated_limit_judges() {
    // 2 and 4 uncertainties above the curve: √((4 + 16)/2) = √10
    let text = |limit: f64| format!("# limit: {limit}\nt [s],front [m],σ [m]\n0.1,0.22,0.01\n0.2,0.44,0.01\n");
    for (limit, verdict) in [(3.0, Verdict::Fail), (3.2, Verdict::Pass)] {
        let mut result = result();
        read(&text(limit)).expect("a table").draw(&mut result).expect("drawn");
        assert!((result.metrics[0].value - 10f64.sqrt()).abs() < 1e-12, "{}", result.metrics[0].value);
        assert_eq!(result.metrics[0].verdict(), verdict);
    }
    let mut result = result();
    let unverified = "# confidence: unverified\n".to_owned() + &text(3.0);
    read(&unverified).expect("a table").draw(&mut result).expect("drawn");
    assert_eq!(result.metrics[0].verdict(), Verdict::Observed, "what is unverified never judges");
}

/// A front jumps by rows of particles, whatever a camera resolves.
#[test]
fn a_resolution_that_counts_in_place_of_uncertainties_is_told() {
    let mut own = result();
    let points = [(0.0, 0.0, 0.1), (1.0, 2.0, 2.1)];
    own.figures[0].panels[0].bands.push(Band { label: HALF_A_ROW.to_owned(), points: points.to_vec() });
    let table = "t [s],front [m],uncertainty [m]\n0.1,0.3,0.01\n0.2,0.5,0.02\n0.3,0.7,1\n7,1,1\n";
    read(table).expect("a table").draw(&mut own).expect("drawn");
    let metric = own.metrics.remove(0);
    assert!((metric.value - (8.01f64 / 3.0).sqrt()).abs() < 1e-12, "{}", metric.value);
    assert_eq!(
        metric.remark.as_deref(),
        Some(
            "`sand` has a value at 3 of 4 measurements; it covers 0 … 1, but the measurements 0.1 … 7; half a row of particles, which moves the value by up to 0.05 m, counts in place of the uncertainty at \
             2 of 3 measurements"
        )
    );
}

/// A gauge at a place that is reached after half a second.
#[test]
fn measurements_at_a_dry_place_are_left_out_and_nothing_else_is_not_judged() {
    let with = |rows: &str| {
        let mut own = result();
        let points = &mut own.figures[0].panels[0].series[0].points;
        *points = vec![(0.0, f64::NAN), (0.5, f64::NAN), (0.6, 1.2), (1.0, 2.0)];
        let table = format!("# limit: 1\nt [s],front [m],uncertainty [m]\n{rows}");
        read(&table).expect("a table").draw(&mut own).expect("drawn");
        own.metrics.remove(0)
    };
    let wet = with("0.2,7,1\n0.55,7,1\n0.8,1.6,1\n");
    assert!(wet.value.abs() < 1e-12 && wet.verdict() == Verdict::Pass, "{}", wet.value);
    assert_eq!(wet.remark.as_deref(), Some("`sand` has a value at 1 of 3 measurements"));
    // the run ends before a measurement
    let short = with("0.8,1.6,1\n7,1,1\n");
    assert!(short.value.is_nan() && short.verdict() == Verdict::Fail, "{}", short.value);
    let dry = with("0.2,7,1\n0.55,7,1\n");
    assert!(dry.value.is_nan() && dry.verdict() == Verdict::Fail, "{}", dry.value);
    assert_eq!(dry.reason_of_absence().map(String::as_str), Some("`sand` has a value at 0 of 2 measurements"));
}

#[test]
fn a_byte_order_mark_hides_no_limit() {
    let text = "# limit: 1e-9\n# source: own flume\nt [s],front [m],uncertainty [m]\n0.1,0.22,0.01\n";
    let mut plain = result();
    read(text).expect("a table").draw(&mut plain).expect("drawn");
    let mut marked = result();
    read(&format!("\u{feff}{text}")).expect("a table").draw(&mut marked).expect("drawn");
    let said = |own: &CaseResult| {
        let source = own.metrics[0].reference.as_ref().map(|reference| reference.source.clone());
        (own.metrics[0].verdict(), own.metrics[0].value, source)
    };
    assert_eq!(said(&marked).0, Verdict::Fail);
    assert_eq!(said(&marked), said(&plain));
}

#[test]
fn horizontal_values_are_compared_over_the_vertical_axis() {
    let table = "y/h [-],u [cm/s],uncertainty [cm/s]\n0.5,150,10\n1,300,10\n";
    let mut own = result();
    read(table).expect("a table").draw(&mut own).expect("drawn");
    let panel = &own.figures[1].panels[0];
    assert_eq!(panel.series.last().expect("drawn").points, [(1.5, 0.5), (3.0, 1.0)]);
    assert_eq!(panel.series[2].points, [(1.4, 0.5), (1.6, 0.5)], "a bar along the axis of what was measured");
    let found: Vec<(String, f64)> =
        own.metrics.iter().map(|metric| (metric.variant.to_string(), metric.value)).collect();
    assert_eq!(found[0], ("overlay=mine,curve=coarse".to_owned(), 0.0));
    assert!(found[1].0 == "overlay=mine,curve=fine" && (found[1].1 - 562.5f64.sqrt()).abs() < 1e-9, "{found:?}");
    let mut own = result();
    read(&format!("# curve: fine\n{table}")).expect("a table").draw(&mut own).expect("drawn");
    assert_eq!(own.metrics.len(), 1);
}

#[test]
fn lengths_and_times_are_taken_where_the_axes_are_ratios_of_them() {
    // x/r0 and thickness/r0 of r0 = 0.05 m, over times of 0.2 s
    let with_scales = |half_widths: [f64; 2]| {
        let axis = |label: &str, name: &str| Axis::linear(label).over(name, "m", half_widths);
        let mut deposit = Panel::new("", axis("x/r0 [-]", "x"), axis("thickness/r0 [-]", "thickness"));
        deposit.line("sand", 0, [(0.0, 1.0), (4.0, 0.0)]);
        CaseResult { figures: vec![Figure::new("deposit", "", vec![deposit])], ..result() }
    };
    let table = "x [cm],thickness [mm],uncertainty [cm]\n5,37.5,0.5\n10,30,0.5\n";
    let mut own = with_scales([0.05, 0.05]);
    read(table).expect("a table").draw(&mut own).expect("drawn");
    let series = own.figures[0].panels[0].series.last().expect("drawn");
    let near = |found: f64, expected: f64| (found - expected).abs() < 1e-12;
    assert!(series.points.iter().zip([(1.0, 0.75), (2.0, 0.6)]).all(|(a, b)| near(a.0, b.0) && near(a.1, b.1)));
    assert!(near(series.error[0], 0.1), "{:?}", series.error);
    // on the curve, then a tenth of r0 above it: one uncertainty
    assert!(near(own.metrics[0].value, 0.5f64.sqrt()), "{}", own.metrics[0].value);
    // a name with a minus sign is also read with a hyphen
    let mut way = CaseResult {
        figures: vec![Figure::new(
            "way",
            "",
            vec![Panel::new("", Axis::linear("t [s]"), {
                Axis::linear("(front − r0)/(a r0) [-]").over("front − r0", "m", [0.1])
            })],
        )],
        ..result()
    };
    way.figures[0].panels[0].line("sand", 0, [(0.0, 0.0), (1.0, 1.0)]);
    read("t [s],front - r0 [cm],uncertainty [cm]\n0.5,5,1\n").expect("a table").draw(&mut way).expect("drawn");
    assert!(near(way.metrics[0].value, 0.0), "{}", way.metrics[0].value);
    // the ratio itself may be given along one axis
    let mixed = "x/r0 [-],thickness [mm],uncertainty [cm]\n1,37.5,0.5\n";
    let mut own = with_scales([0.05, 0.05]);
    read(mixed).expect("a table").draw(&mut own).expect("drawn");
    assert!(near(own.metrics[0].value, 0.0));
    let message =
        |own: &mut CaseResult, table: &str| read(table).expect("a table").draw(own).expect_err("refused").to_string();
    let kind = message(&mut with_scales([0.05, 0.05]), "x [s],thickness [mm],uncertainty [cm]\n5,37.5,0.5\n");
    assert!(kind.contains("(deposit: x/r0 [-] or x [m] and thickness/r0 [-] or thickness [m])"), "{kind}");
    // curves of several scales share no length
    let several = message(&mut with_scales([0.05, 0.1]), table);
    assert!(several.contains("(deposit: x/r0 [-] and thickness/r0 [-])"), "{several}");
}

#[test]
fn unplaceable_curve_is_refused_with_the_available_ones() {
    assert_eq!(
        refused("t [s],back [m],uncertainty [m]\n1,1,1\n"),
        "mine.csv: `columns` is back [m] over t [s], but must be the axes of one of the case's figures \
         (front: t [s] and front [m]; profile: u [m/s] and y/h); name the columns as the axes are labelled, in any unit that converts to theirs"
    );
    let other_unit = refused("t [s],front [kg],uncertainty [kg]\n1,1,1\n");
    assert!(other_unit.contains("is front [kg] over t [s], but must be the axes"), "{other_unit}");
    assert_eq!(
        refused("t [s],front [m],uncertainty [m]\n5,1,1\n6,1,1\n"),
        "mine.csv: `t` is 5 … 6, but must be within the curves of front, which cover 0 … 1; check the unit and the origin of the abscissa"
    );
    assert_eq!(
        refused("# curve: gravel\nt [s],front [m],uncertainty [m]\n0.5,1,1\n"),
        "mine.csv: `# curve` is \"gravel\", but must be the legend of a curve of front: `sand`; correct it, or leave it out to compare all"
    );
    let mut twice = result();
    let again = Figure { name: "again".to_owned(), ..twice.figures[0].clone() };
    twice.figures.push(again);
    let error = read(TABLE).expect("a table").draw(&mut twice).expect_err("two panels").to_string();
    assert!(
        error.contains("are the axes of several panels: front; again; name one above the table by `# figure: NAME`"),
        "{error}"
    );
    let one = read(&format!("# figure: again\n{TABLE}")).expect("a table");
    one.draw(&mut twice).expect("named");
    assert_eq!(twice.figures[2].panels[0].series.len(), 3);
}

#[test]
fn invalid_measurements_are_refused() {
    for (text, message) in [
        (
            "t [s],front [m]\n1,1\n",
            "mine.csv: `columns`: front [m] has no uncertainty; add a column `uncertainty [m]`, or repeats: columns of one name, or a list of files in the place of this one",
        ),
        (
            "t,front [m],uncertainty [m]\n1,1,1\n",
            "mine.csv: `t` is \"t\", but must be a heading with its unit in brackets; write `t [s],front [cm],uncertainty [cm]` above `0.1,14,0.5`, repeats as `front #1 [cm],front #2 [cm]`, or in a case file give { files = […], columns = { t = \"t [s]\", front = [\"a [cm]\", \"b [cm]\"] } }",
        ),
        (
            "t [s],front [m],uncertainty [s]\n1,1,1\n",
            "mine.csv: `uncertainty` is [s], but must be a unit that converts to [m]; correct the unit in the heading",
        ),
        (
            "t [s],front [m],uncertainty [m]\n1,nan,1\n",
            "mine.csv: `line 2`: \"nan\" in column front [m] is not a measured value; write a finite number with a decimal point, or leave the row out",
        ),
        (
            "t [s],front [m],uncertainty [m]\n1,-9999,1\n",
            "mine.csv: `line 2`: \"-9999\" in column front [m] is not a measured value; write a finite number with a decimal point, or leave the row out",
        ),
        (
            "t [s],front [m],uncertainty [m]\n1,1,1\n2,1,0\n",
            "mine.csv: `uncertainty` is 0 in row 2, but must be positive; give a standard deviation above 0",
        ),
        (
            "# limit: much\nt [s],front [m],uncertainty [m]\n1,1,1\n",
            "mine.csv: `# limit` is much, but must be a positive number; give it in standard uncertainties, such as 2",
        ),
        (
            "# Limit = 2\nt [s],front [m],uncertainty [m]\n1,1,1\n",
            "mine.csv: `# limit` is Limit = 2, but must be followed by a colon; write `# limit: 2`, in standard uncertainties",
        ),
        (
            "# limt: 2\nt [s],front [m],uncertainty [m]\n1,1,1\n",
            "mine.csv: `# limt` is 2, but must be a comment of another form, or one of the keys limit, figure, panel, curve, source, confidence; did you mean `limit`?",
        ),
        (
            "t [s],front [m],uncertainty [m]\n1,1\n",
            "mine.csv: `line 2`: 2 columns, and the heading has 3; complete or shorten the row",
        ),
    ] {
        assert_eq!(refused(text), message);
    }
}

/// Measurements of files `0.csv`, `1.csv`, … in a folder.
fn read_of(texts: &[&str], columns: &str, wanted: WantedColumns<'_>) -> Result<Measurements, String> {
    let folder = tempfile::tempdir().expect("a folder");
    for (number, text) in texts.iter().enumerate() {
        std::fs::write(folder.path().join(format!("{number}.csv")), text).expect("writable");
    }
    let files: Vec<String> = (0..texts.len()).map(|number| format!("\"{number}.csv\"")).collect();
    let plan = format!("files = {{ files = [{}], columns = {{ {columns} }} }}", files.join(", "));
    let plan = if columns.is_empty() { format!("files = [{}]", files.join(", ")) } else { plan };
    let plan: std::collections::BTreeMap<String, MeasuredFiles> = toml::from_str(&plan).expect("files");
    let read = Measurements::read(&plan["files"].beside(folder.path()), wanted);
    read.map_err(|error| error.to_string().replace(&format!("{}/", folder.path().display()), ""))
}

#[test]
fn repeats_are_a_mean_with_the_scatter_of_the_mean() {
    let columns = "t [s],front [cm],front [cm],front [mm]\n1,10,12,140\n2,20,20,200\n";
    let [first, second, third] =
        [[10, 20], [12, 20], [14, 20]].map(|[a, b]| format!("t [s],front [cm]\n1,{a}\n# so\n2,{b}\n"));
    let numbered =
        columns.replacen("front", "front #1", 1).replacen("front [cm],front [mm]", "front #2 [cm],front #3 [mm]", 1);
    for texts in [vec![columns], vec![&numbered], vec![&first, &second, &third]] {
        let own = read_of(&texts, "", WantedColumns::default()).expect("repeats");
        assert_eq!(own.repeats, 3);
        let points = own.in_units("s", "cm").expect("units");
        // scatter 2 cm and none: √(4/3) cm of the mean, of both rows together √(2/3) cm
        let expected = [[1.0, 12.0, (4.0 / 3.0_f64).sqrt()], [2.0, 20.0, (2.0 / 3.0_f64).sqrt()]];
        let close = |(a, b): (&[f64; 3], &[f64; 3])| a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-12);
        assert!(points.iter().zip(&expected).all(close), "{points:?}");
        let repeated = if texts.len() == 1 { "3 repeats" } else { "3 files" };
        assert_eq!(own.legend(), format!("0, mean of {repeated}"));
        let source = format!("mean of {repeated}, which scatter by up to 2 cm");
        assert!(own.source().ends_with(&source), "{}", own.source());
        // the copy gives the same
        let copy = read_of(&[&own.text], "", WantedColumns::default()).expect("a copy");
        assert_eq!((copy.measured.values, copy.uncertainty), (own.measured.values, own.uncertainty));
    }
    let with = read_of(&["t [s],u [m],u [m],sigma [cm]\n1,1,3,100\n"], "", WantedColumns::default()).expect("both");
    assert_eq!(with.uncertainty, [2f64.sqrt()]);
    let equal = read_of(&["t [s],u [m],u [m]\n1,1,1\n"], "", WantedColumns::default()).expect_err("no scatter");
    assert!(equal.starts_with("0.csv: `columns`: u [m] is equal in all repeats; add a column"), "{equal}");
    let apart =
        read_of(&["t [s],u [m]\n1,1\n", "t [s],u [m]\n2,1\n"], "", WantedColumns::default()).expect_err("other times");
    assert!(apart.contains("but must be in rows of the same t as in the first file"), "{apart}");
}

#[test]
fn columns_are_found_by_their_names_or_by_those_that_a_plan_gives() {
    let wanted = WantedColumns { over: Some("t"), quantity: &["tip: front"], of_time: false };
    let text =
        "# time depth\nnumber,depth [m],t [ms],uncertainty of depth [m],front [cm],sigma [mm]\n1,5,100,2,10,30\n";
    let own = read_of(&[text], "", wanted).expect("by heading");
    assert_eq!(own.in_units("s", "m").expect("units"), [[0.1, 0.1, 0.03]]);
    let text = "toe;time;spread\n10;100;3\n";
    let columns = "front = \"toe [cm]\", t = \"time [ms]\", uncertainty = \"spread [cm]\"";
    let own = read_of(&[text], columns, wanted).expect("by name");
    assert_eq!(own.in_units("s", "m").expect("units"), [[0.1, 0.1, 0.03]]);
    assert_eq!(own.text, "t [ms],front [cm],uncertainty [cm]\n100,10,3\n");
    let repeats = read_of(&["toe [cm],t [s],toe [cm]\n1,1,3\n"], "front = \"toe [cm]\", t = \"t [s]\"", wanted);
    assert_eq!(repeats.expect("both columns").measured.values, [2.0]);
    let refused = |columns: &str| read_of(&[text], columns, wanted).expect_err("refused");
    assert!(
        refused("front = \"to [cm]\"")
            .contains("`columns.front` is \"to [cm]\", but must be a heading of each file with its unit: toe, time")
    );
    assert!(refused("front = \"toe\"").ends_with("such as front = \"toe [cm]\""));
    let stated = ["toe (cm);t [s]\n10;1\n"];
    let read = |columns: &str| read_of(&stated, columns, wanted);
    let message = read("front = \"toe (cm) [mm]\", t = \"t [s]\"").expect_err("two units");
    assert!(message.contains("must be the unit that the heading states"), "{message}");
    let message = read("front = \"toe (cm) [cm]\", t = \"t [s]\"").expect_err("no uncertainty");
    assert!(message.contains("front [cm] has no uncertainty"), "{message}");
    assert!(
        refused("t = \"time [ms]\", x = \"toe [cm]\"")
            .contains("no column `front` among toe, time, spread; rename one, or")
    );
}

#[test]
fn names_become_values_of_variants() {
    assert_eq!(text_of_variant("24°, N = 40_a"), "24-N-40-a");
    assert_eq!(text_of_variant("="), "unnamed");
}

#[test]
fn a_column_may_have_the_name_of_a_gauge_in_the_tables_of_results() {
    let gauges = || {
        let mut load = Panel::new("load", Axis::linear("t [s]"), Axis::linear("force [N/m]"));
        load.line("force along x [N/m]", 0, [(0.0, 1.0), (1.0, 1.0)]);
        load.line("force along y [N/m]", 1, [(0.0, 2.0), (1.0, 2.0)]);
        let mut front = Panel::new("tip", Axis::linear("t [s]"), Axis::linear("front [m]"));
        front.line("", 0, [(0.0, 0.0), (1.0, 2.0)]);
        CaseResult { figures: vec![Figure::new("gauges", "", vec![load, front])], ..result() }
    };
    let of = |heading: &str| {
        let mut result = gauges();
        let read = read(&format!("t [s],{heading} [kN/m],u [N/m]\n0.5,0.002,1\n")).expect("a table");
        read.draw(&mut result).map(|()| result.metrics).map_err(|error| error.to_string())
    };
    for name in ["load: force along y", "force along y"] {
        let metrics = of(name).expect("a column");
        // the measured force is that along y, so along x nothing is compared
        assert!(metrics.len() == 1 && metrics[0].value < 1e-9, "{metrics:?}");
    }
    assert_eq!(of("force").expect("the axis").len(), 2);
    let mut tip = gauges();
    read("t [s],tip: front [cm],u [cm]\n0.5,100,1\n").expect("a table").draw(&mut tip).expect("the only curve");
    assert!(tip.metrics[0].value < 1e-9);
    let told = of("Fy").expect_err("no such column");
    assert!(told.contains("force [N/m] or load: force along x [N/m] or load: force along y [N/m]"), "{told}");
}

/// The third repeat is shorter and has times of its own; its comments count.
#[test]
fn repeats_count_where_they_have_a_value_and_all_their_comments_do() {
    let folder = tempfile::tempdir().expect("temporary folder");
    let write = |name: &str, text: &str| {
        std::fs::write(folder.path().join(name), text).expect("writable");
        folder.path().join(name)
    };
    let files = vec![
        write("a.csv", "# limit: 5\nt [s],front [m]\n0.1,0.30\n0.2,0.50\n0.3,0.70\n"),
        write("b.csv", "# limit: 2\nt [ms],front [cm]\n100,32\n200,52\n300,72\n"),
        write("c.csv", "# confidence: unverified\nt [s],front [m]\n0.05,0.24\n0.25,0.64\n"),
    ];
    let read =
        |files: &[PathBuf]| Measurements::read(&MeasuredFiles::Repeats(files.to_vec()), WantedColumns::default());
    let own = read(&files).expect("repeats");
    let named = MeasuredFiles::Named { files: files.clone(), columns: BTreeMap::new() };
    let named = Measurements::read(&named, WantedColumns::default()).expect("files without names for their columns");
    assert_eq!((named.repeats, named.measured), (own.repeats, own.measured.clone()));
    assert_eq!((own.said.limit, own.said.confidence), (Some(2.0), Some(Confidence::Unverified)));
    let points = own.in_units("s", "m").expect("the same units");
    let expected = [(0.1, 0.32), (0.2, 0.52), (0.3, 0.71)];
    for ([t, front, _], (at, mean)) in points.iter().zip(expected) {
        assert!((t - at).abs() < 1e-12 && (front - mean).abs() < 1e-12, "{points:?}");
    }
    // variances 4e-4, 4e-4 and of two repeats 2e-4, below the mean of all
    let pooled: f64 = (4e-4 + 4e-4 + 2e-4) / 3.0;
    assert!((points[0][2] - (4e-4_f64 / 3.0).sqrt()).abs() < 1e-12, "{points:?}");
    assert!((points[2][2] - (pooled / 2.0).sqrt()).abs() < 1e-12, "{points:?}");
    // the kept copy gives the same again
    let again = read(&[write("kept.csv", &own.text)]).expect("a table");
    assert_eq!(again.in_units("s", "m"), Ok(points));
    let apart = write("d.csv", "t [s],front [m]\n7,1\n8,1\n");
    let refused = read(&[files[0].clone(), apart]).expect_err("refused").to_string();
    assert!(refused.contains("d.csv: `t` is [7.0, 8.0], but must be in rows of the same t"), "{refused}");
    let variants = ["variant,run_out [m]\nA,1\nB,2\nC,3\n", "variant,run_out [m]\nA,1\nC,3\n"];
    let variants: Vec<PathBuf> =
        ["e.csv", "f.csv"].iter().zip(variants).map(|(name, text)| write(name, text)).collect();
    let wanted = WantedColumns { quantity: &["run_out"], ..WantedColumns::default() };
    let mixed = Measurements::read(&MeasuredFiles::Repeats(variants), wanted).expect_err("refused").to_string();
    assert!(mixed.contains("but must be in rows of the same row as in the first file"), "{mixed}");
}
