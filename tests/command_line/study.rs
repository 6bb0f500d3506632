//! Studies of a user's own: `run STUDY.toml` and `report --suite`.

use crate::command_line::program::{Place, document};
use assert_cmd::assert::Assert;
use bagnold_harness::metric::Verdict;
use bagnold_harness::result::MetricEntry;

/// A block of beads of a few particles that falls apart for a moment.
const FLUME: &str = "case = \"scene\"\nname = \"flume\"\ngravity = [0.0, -9.81]\nspacing = 0.02\nduration = 0.1\ninterval = 0.01\n\
    [sides]\nleft = { mirror = 0.0 }\nright = { open = 0.5 }\nbottom = \"none\"\ntop = \"none\"\n\
    [[bodies]]\nshape = \"box\"\nlower = [0.0, 0.0]\nupper = [0.1, 0.1]\n\
    [[walls]]\nname = \"bed\"\npoints = [[0.0, 0.0], [0.5, 0.0]]\n\
    [[gauges]]\nkind = \"front\"\nname = \"front\"\nfrom = [0.0, 0.0]\nto = [0.5, 0.0]\nthickness = 0.02\n";

const STUDY: &str = "study = \"my-flume\"\nsummary = \"beads in my flume\"\nbase = \"flume.toml\"\n\
    [[vary]]\npath = \"spacing\"\nvalues = [0.02, 0.0125]\n\
    [[checks]]\nname = \"front_at_the_end\"\ntable = \"gauges\"\ncolumn = \"front: front [m]\"\nvalue = \"last\"\n\
    within = [0.0, 1.0]\nreason = \"the flume is that long\"\n\
    [[checks]]\nname = \"front_over_time\"\ntable = \"gauges\"\ncolumn = \"front: front [m]\"\ncompare = \"front.csv\"\n\
    distance = \"mean\"\nat_most = 0.0\nreason = \"the series lies ahead\"\n\
    [[checks]]\nname = \"change\"\ndifference_of = \"front_at_the_end\"\nbetween = [\"spacing=0.02\", \"spacing=0.0125\"]\n";

/// Measurements a metre ahead of anything, in another unit.
const AHEAD: &str = "# source: far ahead\nt [ms],front [cm],uncertainty [cm]\n20,100,1\n80,100,1\n";

fn place() -> Place {
    let place = Place::new();
    place.file("flume.toml", FLUME);
    place.file("front.csv", AHEAD);
    place.file("study.toml", STUDY);
    place
}

fn of(finished: &Assert, name: &str) -> Vec<MetricEntry> {
    document(finished).metrics.into_iter().filter(|metric| metric.name == name).collect()
}

fn refused(place: &Place, text: &str) -> String {
    place.file("bad.toml", text);
    let finished = place.bagnold(&["run", "bad.toml", "--out", "out", "--quiet"]).assert().code(2);
    String::from_utf8_lossy(&finished.get_output().stderr).into_owned()
}

/// A limit of a study that is looser than that of its file would be green in silence.
#[test]
fn a_limit_beyond_that_of_the_measurements_is_refused() {
    let place = place();
    place.file("front.csv", &format!("# limit: 2\n{AHEAD}"));
    let study = |limit: &str| STUDY.replace("distance = \"mean\"\nat_most = 0.0", limit);
    for (limit, said) in [("at_most = 3.0", "at_most` is 3"), ("at_least = 0.0", "at_least` is 0")] {
        let message = refused(&place, &study(limit));
        let rule = format!("{said}, but must be no looser than 2, the `# limit` of the measurements");
        assert!(message.contains(&rule), "{message}");
    }
    place.file("study.toml", &study("at_most = 1.5"));
    place.run(&["study.toml"]).code(1);
}

#[test]
fn a_study_is_judged_by_what_its_tables_hold() {
    let place = place();
    let finished = place.run(&["study.toml", "--json"]).code(0);
    let fronts = of(&finished, "front_at_the_end");
    let variants: Vec<String> = fronts.iter().map(|metric| metric.variant.to_string()).collect();
    assert_eq!(variants, ["spacing=0.02,scene=flume", "spacing=0.0125,scene=flume"]);
    for (metric, file) in fronts.iter().zip(["spacing-0.02", "spacing-0.0125"]) {
        let table =
            std::fs::read_to_string(place.path(&format!("out/tables/gauges-scene-flume-{file}.csv"))).expect("a table");
        let column =
            table.lines().next().and_then(|line| line.split(',').position(|heading| heading == "front: front [m]"));
        let last = table.lines().last().and_then(|line| line.split(',').nth(column.expect("the column")));
        assert_eq!(metric.value, last.and_then(|word| word.parse().ok()), "{file}");
        assert_eq!((metric.verdict, metric.unit.as_str()), (Verdict::Pass, "m"));
    }
    // a metre is 100 cm, and the front has come some 0.1 m
    let ahead = of(&finished, "front_over_time");
    assert!(ahead.iter().all(|metric| metric.value.is_some_and(|value| value > -0.95 && value < -0.8)), "{ahead:?}");
    let [change] = &of(&finished, "change")[..] else { panic!("one pair of variants") };
    let front = |place: usize| fronts[place].value.expect("a front");
    assert_eq!(change.value, Some(100.0 * (front(0) - front(1)) / front(1)));
    assert_eq!((change.variant.to_string().as_str(), change.unit.as_str()), ("scene=flume,spacing=0.02_0.0125", "%"));
    // the balances of the case itself stand below
    let balances = of(&finished, "mass_residual");
    assert!(balances.len() == 2 && balances.iter().all(|metric| metric.verdict == Verdict::Pass));
    let page = std::fs::read_to_string(place.path("out/index.html")).expect("a page");
    assert!(page.contains("the flume is that long") && page.contains("far ahead"));
    assert!(place.path("out/figures/gauges-front-front-m.svg").is_file());

    // what the folder keeps gives the same again, from the store
    let again = place.bagnold(&["run", "out/case.toml", "--out", "again", "--json", "--quiet"]).assert().code(0);
    for name in ["front_at_the_end", "front_over_time"] {
        let values = |finished: &Assert| of(finished, name).iter().map(|metric| metric.value).collect::<Vec<_>>();
        assert_eq!(values(&again), values(&finished), "{name}");
    }
    assert_eq!(document(&again).state_hash, document(&finished).state_hash);
}

#[test]
fn a_column_less_itself_is_nothing_and_with_itself_twice() {
    let place = place();
    let value = |field: &str| {
        let own = format!("value = \"last\"\n{field} = \"front: front [m]\"");
        place.file("study.toml", &STUDY.replacen("value = \"last\"", &own, 1));
        let values = of(&place.run(&["study.toml", "--json", "--quiet"]), "front_at_the_end");
        values.iter().filter_map(|metric| metric.value).collect::<Vec<_>>()
    };
    let (whole, nothing) = (value("plus"), value("minus"));
    assert!(whole.iter().all(|front| *front > 0.2 && *front < 0.4), "{whole:?}");
    assert_eq!(nothing, [0.0, 0.0]);
}

/// A front that anything has is no check; one that half of the gravity does not reach is.
#[test]
fn a_study_fails_where_a_check_accepts_its_control() {
    let control =
        "[[controls]]\nname = \"half-gravity\"\nset = { gravity = [0.0, -4.905] }\nrejects = [\"front_at_the_end\"]\n";
    let place = place();
    place.file("study.toml", &(STUDY.to_owned() + control));
    let finished = place.run(&["study.toml", "--json", "--quiet"]).code(1);
    let accepted = of(&finished, "rejects_control");
    assert_eq!(accepted.len(), 2, "{accepted:?}");
    assert!(accepted.iter().all(|metric| metric.verdict == Verdict::Fail && metric.value == Some(0.0)));
    // with half of the gravity the front is nearer
    let fronts: Vec<f64> = of(&finished, "front_at_the_end").iter().filter_map(|metric| metric.value).collect();
    let nearest = fronts.iter().copied().fold(f64::INFINITY, f64::min) - 1e-3;
    let narrow = STUDY.replace("within = [0.0, 1.0]", &format!("at_least = {nearest}"));
    place.file("study.toml", &(narrow + control));
    let finished = place.run(&["study.toml", "--json", "--quiet"]);
    let rejected = of(&finished, "rejects_control");
    assert!(rejected.iter().any(|metric| metric.value == Some(1.0)), "{fronts:?}: {rejected:?}");

    let unknown = refused(&place, &(STUDY.to_owned() + &control.replace("front_at_the_end", "no_check")));
    assert!(unknown.contains("controls[0].rejects") && unknown.contains("front_at_the_end"), "{unknown}");
    let varied = refused(&place, &(STUDY.to_owned() + &control.replace("gravity = [0.0, -4.905]", "spacing = 0.01")));
    assert!(varied.contains("controls[0].set.spacing") && varied.contains("leaves free: `vary[0]`"), "{varied}");
    let misspelt = refused(&place, &(STUDY.to_owned() + &control.replace("gravity = ", "gravty = ")));
    assert!(misspelt.contains("bad.toml") && misspelt.contains("did you mean `gravity`"), "{misspelt}");
    assert!(!misspelt.contains("--set"), "{misspelt}");
}

#[test]
fn a_gate_of_a_study_fails_and_late_measurements_are_refused() {
    let place = place();
    place.file("study.toml", &STUDY.replace("at_most = 0.0", "at_least = 0.0"));
    let finished = place.run(&["study.toml", "--json", "--quiet"]).code(1);
    assert!(of(&finished, "front_over_time").iter().all(|metric| metric.verdict == Verdict::Fail));
    // runs that end before the last measured point are not begun
    place.file("study.toml", STUDY);
    place.file("front.csv", &AHEAD.replace("80,", "800,"));
    let refused = place.run(&["study.toml", "--json", "--quiet"]).code(2);
    let told = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(told.contains("`duration` is 0.1 s, but must be at least 0.8 s"), "{told}");
}

#[test]
fn a_figure_of_checks_stands_on_the_page_and_slips_in_it_are_named() {
    let place = place();
    let figure = "[[figures]]\nname = \"front-over-spacing\"\ncaption = \"Where the front is.\"\nx = \"Δ [m]\"\ny = \"front [m]\"\nover = \"spacing\"\n\
        [[figures.series]]\ncheck = \"front_at_the_end\"\nsimulated = \"simulated\"\n";
    place.file("study.toml", &format!("{STUDY}{figure}"));
    place.run(&["study.toml", "--quiet"]).code(0);
    let drawn = std::fs::read_to_string(place.path("out/figures/front-over-spacing.svg")).expect("a figure");
    assert!(drawn.contains("front [m]"));
    assert!(std::fs::read_to_string(place.path("out/case.toml")).expect("a study").contains("[[figures.series]]"));
    for (from, to, words) in [
        ("check = \"front_at_the_end\"", "check = \"front_at_rest\"", "figures[0].series[0].check"),
        ("over = \"spacing\"", "over = \"gravity\"", "figures[0].over"),
        ("over = \"spacing\"", "at = { steep = 1.0 }", "figures[0].at"),
        ("over = \"spacing\"", "", "exactly one of `over` and `at`"),
        ("name = \"front-over-spacing\"", "name = \"gauges-front-front-m\"", "figures[0].name"),
        ("simulated = \"simulated\"", "", "at least one of `simulated` and `reference`"),
    ] {
        let said = refused(&place, &format!("{STUDY}{}", figure.replace(from, to)));
        assert!(said.contains(words), "{from} -> {to}: {said}");
    }
    let said = refused(&place, &format!("{STUDY}{figure}{figure}"));
    assert!(said.contains("figures[1].name") && said.contains("unique"), "{said}");
}

#[test]
fn every_shipped_study_can_be_prepared() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/examples/studies");
    let mut seen = 0;
    for entry in std::fs::read_dir(folder).expect("the shipped studies") {
        let path = entry.expect("an entry").path();
        if path.extension().is_some_and(|kind| kind == "toml") && bagnold_scenes::study::is_study(&path) {
            let registry = *bagnold_validation::REGISTRY;
            let study = bagnold_scenes::study::Study::read(&path, registry).expect("a study");
            let cases = study.prepare(registry, None, &[], bagnold_harness::case::Limits::default()).expect("cases");
            assert!(!cases.is_empty());
            seen += 1;
        }
    }
    assert!(seen >= 2, "studies are shipped");
}

#[test]
fn a_printed_canonical_study_can_be_prepared_with_a_table_that_it_documents() {
    let place = place();
    let registry = *bagnold_validation::REGISTRY;
    for case in registry.iter().filter(|case| case.is_study()) {
        let text = case.show(bagnold_harness::case::Tier::Quick);
        let vary = text.split("\n\n").find(|table| table.starts_with("# [[vary]]")).expect("documented");
        let added: String = vary.lines().map(|line| format!("{}\n", line.trim_start_matches("# "))).collect();
        for (added, times) in
            [("", 1), (&added.replace("path = \"…\"", "path = \"seed\"").replace("[1.0]", "[1, 2]"), 2)]
        {
            place.file("printed.toml", &format!("{text}{added}"));
            let study = bagnold_scenes::study::Study::read(&place.path("printed.toml"), registry).expect("a study");
            let cases = study.prepare(registry, None, &[], bagnold_harness::case::Limits::default()).expect("cases");
            assert!(!cases.is_empty() && cases.len().is_multiple_of(times), "{}: {}", case.name(), cases.len());
        }
    }
}

#[test]
fn variants_and_settings_change_what_is_simulated() {
    let place = place();
    let variants =
        "[[variants]]\nname = \"low\"\nset = { \"gravity\" = [0.0, -1.0] }\n[[variants]]\nname = \"usual\"\n[[checks]]";
    let text = STUDY
        .replacen("[[vary]]\npath = \"spacing\"\nvalues = [0.02, 0.0125]\n", "", 1)
        .replacen("[[checks]]", variants, 1)
        .replacen("[\"spacing=0.02\", \"spacing=0.0125\"]", "[\"variant=low\", \"variant=usual\"]", 1);
    place.file("study.toml", &text);
    let finished = place.run(&["study.toml", "--json", "--quiet"]).code(0);
    let fronts = of(&finished, "front_at_the_end");
    let [low, usual] = &fronts[..] else { panic!("{fronts:?}") };
    assert_eq!(low.variant.to_string(), "variant=low,scene=flume");
    let change = of(&finished, "change")[0].value.expect("one pair");
    assert!(change < 0.0 && change > -100.0, "{change}");
    assert!(low.value < usual.value, "beads run slower under a tenth of gravity: {low:?}, {usual:?}");
    let set = ["study.toml", "--json", "--quiet", "--set", "duration=0.09"];
    let shorter = document(&place.run(&set).code(0)).state_hash;
    assert_ne!(shorter, document(&finished).state_hash);
    // what is written repeats what ran
    let again = place.bagnold(&["run", "out/case.toml", "--json", "--quiet", "--out", "again"]).assert().code(0);
    assert_eq!(document(&again).state_hash, shorter);
}

#[test]
fn a_setting_of_what_the_study_varies_names_both_places() {
    let place = place();
    let named =
        STUDY.replacen("[[checks]]", "[[variants]]\nname = \"low\"\nset = { gravity = [0.0, -1.0] }\n[[checks]]", 1);
    place.file("study.toml", &named);
    for (setting, field, at) in
        [("spacing=0.03", "spacing", "vary[0]"), ("gravity=[0.0, -2.0]", "gravity", "variants[0].set")]
    {
        let arguments = ["run", "study.toml", "--set", setting, "--out", "out", "--quiet"];
        let finished = place.bagnold(&arguments).assert().code(2);
        let message = String::from_utf8_lossy(&finished.get_output().stderr).into_owned();
        let said = format!("`{at}` in study.toml gives `{field}`; change it there, or leave --set out");
        assert!(message.contains(&format!("`--set` is {setting}")) && message.contains(&said), "{message}");
    }
}

#[test]
fn a_study_that_cannot_be_followed_is_refused_by_its_field() {
    let place = place();
    for (from, to, said) in [
        ("table = \"gauges\"", "table = \"gaugs\"", "`checks[0].table` is \"gaugs\", but must be a table of scene"),
        ("front: front [m]", "front [m]", "did you mean \"front: front [m]\"?"),
        ("path = \"spacing\"", "path = \"spacin\"", "bad.toml: `spacin`: unknown field"),
        ("0.0125]", "0.02]", "`vary[0].values[1]`: 0.02 is listed already as `vary[0].values[0]`"),
        ("0.0125]", "-1.0]", "bad.toml: `spacing` is -1"),
        ("study = \"my-flume\"", "study = \"film\"", "different from all cases"),
        ("study = \"my-flume\"", "study = \"../x\"", "a name that a folder can have"),
        ("study = ", "study == ", "bad.toml: `line 1, column 8`"),
        // in a suite it would be passed over, and its gates with it
        ("study = ", "stduy = ", "unknown field `stduy`, expected one of `study`"),
        ("at_most = 0.0", "at_most = -2.0", "`checks[1].at_most` is -2, but must be 0 or more"),
        ("at_most = 0.0", "at_most = \"2\"", "`at_most`: found string \"2\", expected a number, without quotes"),
        ("base = \"flume.toml\"", "", "`case` is missing"),
        ("base = \"flume.toml\"", "case = \"scen\"", "`scen`: unknown case; did you mean `scene`?"),
        ("base = \"flume.toml\"", "base = \"no.toml\"", "no.toml: cannot be read"),
        ("reason = \"the flume is that long\"", "", "`checks[0].reason` is missing"),
        ("within = [0.0, 1.0]", "within = [1.0, 0.0]", "`checks[0].within` is 1 … 0"),
        ("within = [0.0, 1.0]", "within = [0.0, 1.0]\nat_most = 1.0", "but must be the only limit"),
        ("within = [0.0, 1.0]", "within_uncertainties = 2.0", "beside `reference` and `standard_uncertainty`"),
        ("within = [0.0, 1.0]", "within = [0.0, 1.0]\nreference = 0.1", "`checks[0].source` is missing"),
        (
            "within = [0.0, 1.0]",
            "within = [0.0, 1.0]\nconfidence = \"unverified\"",
            "`checks[0].confidence` is unverified, but must be higher for a check with a limit",
        ),
        ("value = \"last\"", "", "exactly one of `metric`, `value`, `compare`, `order_of` and `difference_of`"),
        ("value = \"last\"", "value = \"last\"\nminus = \"t [s]\"", "a column in the unit of `column`, m"),
        ("value = \"last\"", "value = \"last\"\nplus = \"front [m]\"", "did you mean \"front: front [m]\"?"),
        ("value = \"last\"", "value = \"last\"\norder_in = \"spacing\"", "`checks[0].order_in` is given"),
        ("value = \"last\"", "value = \"last\"\nonly = \"spacing=3\"", "`checks[0].only` is \"spacing=3\""),
        ("compare = \"front.csv\"", "compare = \"flume.toml\"", "`checks[1].compare`: flume.toml: "),
        ("difference_of = \"front_at_the_end\"", "difference_of = \"front\"", "`checks[2].difference_of` is front"),
        ("\"spacing=0.02\",", "\"spacing=0.0125\",", "`checks[2].between` is [\"spacing=0.0125\", \"spacing=0.0125\"]"),
        ("\"spacing=0.02\",", "\"spacing=0.01\",", "name the keys in which the two differ"),
        ("\"front_over_time\"", "\"Front over time\"", "a word of lower-case letters"),
        ("\"front_over_time\"", "\"front_at_the_end\"", "`checks[1].name` is front_at_the_end"),
    ] {
        assert!(STUDY.contains(from), "{from}");
        let message = refused(&place, &STUDY.replacen(from, to, 1));
        assert!(message.contains(said), "{to}: {message}");
    }
    let variants = "[[variants]]\nname = \"a/b\"\n[[variants]]\nname = \"a b\"\n[[checks]]";
    assert!(refused(&place, &STUDY.replacen("[[checks]]", variants, 1)).contains("as part of file names"));
    // their number is judged before each is compared with all others
    let many = format!("{}0.0125]", "0.0125, ".repeat(100_000));
    assert!(
        refused(&place, &STUDY.replacen("0.0125]", &many, 1)).contains("`vary`: 100002 runs, above the limit of 1000")
    );
    let whole = STUDY.split("[[checks]]").next().expect("a beginning");
    assert!(refused(&place, whole).contains("`checks` is []"));
    let order = "[[checks]]\nname = \"order\"\norder_of = \"front\"\norder_in = \"spacing\"\n";
    assert!(
        refused(&place, &format!("{STUDY}{order}"))
            .contains("`checks[3].order_of` is front, but must be the name of an earlier check")
    );
    let only = place.bagnold(&["run", "study.toml", "--only", "spacing=0.02"]).assert().code(2);
    assert!(String::from_utf8_lossy(&only.get_output().stderr).contains("not available for a study"));
}

#[test]
fn a_suite_is_one_report_with_a_baseline_of_its_own() {
    let place = place();
    let metric = "study = \"balances\"\nsummary = \"its balances\"\nbase = \"flume.toml\"\n\
        [[checks]]\nname = \"energy\"\nmetric = \"energy_residual\"\n";
    place.file("balances.toml", metric);
    let report = |more: &[&str]| {
        let arguments = [&["report", "--suite", ".", "--out", "suite", "--quiet"], more].concat();
        place.bagnold(&arguments).assert()
    };
    report(&[]).code(0);
    for name in ["my-flume", "balances"] {
        assert!(place.path(&format!("suite/cases/{name}/index.html")).is_file(), "{name}");
    }
    let overview = std::fs::read_to_string(place.path("suite/index.html")).expect("a page");
    assert!(
        overview.contains("beads in my flume")
            && overview.contains("its balances")
            && !overview.contains("column-planar")
    );
    // what a study compares with lies beside its file
    place.bagnold(&["run", "suite/cases/my-flume/case.toml", "--out", "alone", "--quiet"]).assert().code(0);

    report(&["--accept"]).code(0);
    report(&["--deny", "moved"]).code(0);
    let snapshot = place.path("snapshots/quick/balances.snap");
    let text = std::fs::read_to_string(&snapshot).expect("accepted");
    let line = text.lines().find(|line| line.starts_with("energy |")).expect("the check").to_owned();
    let moved: String = line.chars().map(|letter| if letter == '1' { '7' } else { letter }).collect();
    let moved = if moved == line { line.replace(['2', '3', '4', '5', '6', '8', '9'], "1") } else { moved };
    std::fs::write(&snapshot, text.replace(&line, &moved)).expect("writable");
    // a moved value alone does not change the exit code, and the report says so
    let finished = report(&[]).code(0);
    let text = String::from_utf8_lossy(&finished.get_output().stdout).into_owned();
    assert!(text.contains("moved: balances") && text.contains("moved without a new failure"), "{text}");
    assert!(text.contains("unless --deny moved is given"), "{text}");
    let finished = report(&["--deny", "moved"]).code(1);
    assert!(!String::from_utf8_lossy(&finished.get_output().stdout).contains("unless --deny moved"));
    assert!(String::from_utf8_lossy(&finished.get_output().stdout).contains("moved: balances"));

    place.file(
        "snapshots/expected_failures.toml",
        &[("my-flume", "front_at_the_end", "spacing=0.02,scene=flume"), ("gone", "front", "")]
            .map(|(case, metric, variant)| {
                format!(
                    "[[failure]]\ncase = \"{case}\"\nmetric = \"{metric}\"\nvariant = \"{variant}\"\n\
                     best_value = 1.0\ndate = \"2026-01-01\"\nreason = \"slip\"\n"
                )
            })
            .concat(),
    );
    let finished = report(&[]).code(1);
    let text = String::from_utf8_lossy(&finished.get_output().stdout).into_owned();
    assert!(text.contains("my-flume front_at_the_end spacing=0.02,scene=flume: Listed as an expected failure, but the gate passes: remove the entry"), "{text}");
    assert!(text.contains("gone front : no study measures this"), "{text}");

    let refused = |said: &str| {
        let finished = report(&[]).code(2);
        let message = String::from_utf8_lossy(&finished.get_output().stderr).into_owned();
        assert!(message.contains(said), "{message}");
    };
    place.file("snapshots/known_failures.toml", "");
    refused("known_failures.toml`: outdated name; rename it to expected_failures.toml");
    std::fs::remove_file(place.path("snapshots/known_failures.toml")).expect("there");
    std::fs::write(place.path("balances.toml"), b"\xff\xfes\0").expect("writable");
    refused("balances.toml: cannot be read (text in UTF-16, not in UTF-8); save it as plain text");
    place.file("balances.toml", "stduy == \"balances\"\n");
    refused("balances.toml: `line 1, column 8`");
    std::fs::remove_file(place.path("balances.toml")).expect("there");
    refused("balances.snap: `study` is balances, but must be the name of a study of the suite; restore the study");
    std::fs::create_dir(place.path("more")).expect("writable");
    place.file("more/balances.toml", metric);
    refused("more/balances.toml: `study`: in a subfolder of the suite; move it into");
    std::fs::rename(place.path("more/balances.toml"), place.path("balances.TOML")).expect("movable");
    place.file("snapshots/expected_failures.toml", "");
    report(&[]).code(0);

    let empty = Place::new();
    let finished = empty.bagnold(&["report", "--suite", "."]).assert().code(2);
    assert!(String::from_utf8_lossy(&finished.get_output().stderr).contains("a folder with at least one study"));
}

#[test]
fn the_shipped_study_holds() {
    let shipped =
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/examples/studies/beads-in-a-flume.toml");
    let finished = Place::new().run(&[&shipped.display().to_string(), "--json", "--quiet"]).code(0);
    let gated: Vec<String> = document(&finished)
        .metrics
        .into_iter()
        .filter(|metric| metric.verdict == Verdict::Pass && metric.name.starts_with(['f', 'l']))
        .map(|metric| metric.name)
        .collect();
    assert_eq!(gated, ["front_over_time", "load_at_rest", "load_at_rest"]);
}

#[test]
fn a_study_that_cannot_fail_is_rejected_with_its_warnings() {
    let place = Place::new();
    let check = "study = 'mine'\nsummary = 'one'\ncase = 'film'\n[[checks]]\nname = 'flux'\nmetric = 'flux_error'\n";
    place.file("mine.toml", &format!("{check}at_most = 1e9\nreference = 2.0\nsource = 'a book'\nreason = 'wide'\n"));
    let finished = place.run(&["mine.toml", "--deny-warnings"]).code(2);
    let said = String::from_utf8_lossy(&finished.get_output().stderr).into_owned();
    assert!(
        said.contains("check `flux`: the limit ≤ 1000000000 allows an error above 100 % of the reference"),
        "{said}"
    );
    assert!(said.contains("no control shows that a check can fail") && said.contains("2 of the warnings"), "{said}");
}
