//! `judge`, `export` and `compare`: other codes, and our own files as if another code had written them.

use crate::command_line::program::{CHEAP, Place};
use serde_json::Value;

/// One planar column, in a second.
const COLUMN: &[&str] =
    &["run", "column-planar", "--only", "material=lagree,aspect_ratio=1,resolution=20", "--out", "own", "--quiet"];

/// Our own pictures of that column as another code's files.
const OUR_FILES: &str = r#"
case = "column-planar"

[code]
name = "our own files"

[[run]]
variant = "material=lagree,aspect_ratio=1"

[run.particles]
files = ["own/snapshots/material=lagree,aspect_ratio=1,resolution=20.pvd"]
[run.particles.columns]
x = "Points:0 [m]"
y = "Points:1 [m]"
mass = "mass [kg]"
density = "density [kg/m³]"
vx = "velocity:0 [m/s]"
vy = "velocity:1 [m/s]"
"#;

fn read(place: &Place, file: &str) -> Value {
    let text = std::fs::read_to_string(place.path(file)).unwrap_or_else(|error| panic!("{file}: {error}"));
    serde_json::from_str(&text).unwrap_or_else(|error| panic!("{file}: {error}"))
}

#[test]
fn our_own_files_have_the_numbers_of_our_own_run() {
    let place = Place::new();
    // the aspect ratio has an ensemble of seeds, which carry further keys: they are the same column
    place.sharing(COLUMN).assert().code(0);
    place.file("mine.toml", OUR_FILES);
    place.sharing(&["judge", "mine.toml", "--out", "judged", "--junit", "judged.xml", "--quiet"]).assert().code(0);
    let metrics = read(&place, "judged/metrics.json")["codes"][0]["metrics"].as_array().expect("metrics").clone();
    let of = |name: &str, key: &str| {
        let own = |metric: &&Value| {
            let variant = metric["variant"].as_str().unwrap_or_default();
            metric["name"] == name && variant == "material=lagree,aspect_ratio=1,resolution=20"
        };
        metrics.iter().find(own).unwrap_or_else(|| panic!("no {name}"))[key].clone()
    };
    for name in ["run_out", "final_height", "deposit_slope_angle", "height_by_top", "rest_time"] {
        assert_eq!(of(name, "value"), of(name, "bagnold"), "{name}");
        assert!(of(name, "value").is_f64(), "{name}");
    }
    // six pictures do not tell when the front stopped, and nobody gave a ledger
    assert_eq!(of("stopping_time", "verdict"), "not_judged");
    assert!(!metrics.iter().any(|metric| metric["name"] == "energy_residual"));
    let xml = std::fs::read_to_string(place.path("judged.xml")).expect("written");
    assert!(xml.contains("our own files") && xml.contains("final_height"), "{xml}");
}

#[test]
fn a_code_that_is_wrong_fails_and_a_number_that_is_missing_does_not_pass() {
    let place = Place::new();
    let text = "case = \"still-water\"\n[code]\nname = \"one number\"\n[[run]]\nvariant = \"stabilisation=0.5\"\n[run.numbers]\n";
    let template = place.bagnold(&["judge", "--template", "still-water"]).assert().code(0);
    let template = String::from_utf8_lossy(&template.get_output().stdout).into_owned();
    let name = template.lines().find_map(|line| line.strip_prefix("# ")?.split_once(" = 0.0")).expect("a metric").0;
    place.file("wrong.toml", &format!("{text}{name} = 1e9\n"));
    place.sharing(&["judge", "wrong.toml", "--out", "judged", "--quiet"]).assert().code(1);
    let codes = read(&place, "judged/metrics.json")["codes"][0].clone();
    assert_eq!(codes["tally"]["new failure"], 1, "{codes}");
    assert!(codes["tally"]["not judged"].as_u64() > Some(0), "{codes}");
    let wrong = place.bagnold(&["judge", "missing.toml"]).assert().code(2);
    let message = String::from_utf8_lossy(&wrong.get_output().stderr).into_owned();
    assert!(message.contains("missing.toml: cannot be read"), "{message}");
    let twice = place.bagnold(&["judge", "wrong.toml", "wrong.toml", "--out", "twice"]).assert().code(2);
    let message = String::from_utf8_lossy(&twice.get_output().stderr).into_owned();
    assert!(message.contains("but must be another code than that of wrong.toml"), "{message}");
}

#[test]
fn every_case_has_a_submission_to_fill_in() {
    let place = Place::new();
    let list = place.bagnold(&["list"]).assert().code(0);
    for line in String::from_utf8_lossy(&list.get_output().stdout).lines() {
        let case = line.split_whitespace().next().expect("a name");
        let printed = place.bagnold(&["judge", "--template", case]).assert().code(0);
        let text = String::from_utf8_lossy(&printed.get_output().stdout).into_owned();
        let table: toml::Table = toml::from_str(&text).unwrap_or_else(|error| panic!("{case}: {error}"));
        assert_eq!(table["case"].as_str(), Some(case));
    }
}

#[test]
fn export_contains_all_inputs() {
    let place = Place::new();
    place.bagnold(&["export", "film", "--out", "out", "--quiet"]).assert().code(0);
    for file in ["case.toml", "submission.toml", "reference/velocity-profile.csv"] {
        assert!(place.path("out").join(file).is_file(), "{file}");
    }
    // boundaries and start are those of the scene: its period, its surface, its weight along the slope of 10°
    let table = |name: &str| std::fs::read_to_string(place.path("out").join(name)).expect("written");
    let run = "\"fluid=bingham,particles=jittered,resolution=20\"";
    for row in
        ["bottom,no slip,position,0,m", "top,free surface,position,0.01,m", "left and right,periodic,period,0.004,m"]
    {
        assert!(table("boundary.csv").contains(&format!("{run},{row}\n")), "{row}: {}", table("boundary.csv"));
    }
    for row in
        ["flow,start,upper y,0.01,m", "flow,start,mean velocity x,0.0641373,m/s", "all,start,gravity x,1.70349,m/s^2"]
    {
        assert!(table("start.csv").contains(&format!("{run},{row}\n")), "{row}: {}", table("start.csv"));
    }
    let definitions = std::fs::read_to_string(place.path("out/definitions.md")).expect("written");
    let limit = "- `velocity_l2` of `fluid=bingham,particles=jittered,resolution=20`: ≤ 3.";
    assert!(definitions.contains("`herschel-bulkley`: η = τ_y") && definitions.contains(limit), "{definitions}");
    assert!(!place.path("store").exists() && !place.path("out/particles").exists(), "nothing was simulated");
    // with the deck of a code comes the submission that reads its results
    place.bagnold(&["export", "film", "--for", "openfoam", "--out", "deck", "--quiet"]).assert().code(0);
    let own = std::fs::read_to_string(place.path("deck/submission.toml")).expect("written");
    assert!(own.contains("results/newtonian-profile.csv") && place.path("deck/deck/run.sh").is_file(), "{own}");
    // a deck may have tables
    place.bagnold(&["export", "water-film", "--for", "dualsphysics", "--out", "sph", "--quiet"]).assert().code(0);
    assert!(["start.csv", "particles.py"].iter().all(|name| place.path("sph/deck").join(name).is_file()));
    let refused = place.bagnold(&["export", "film", "--for", "newton", "--out", "none", "--quiet"]).assert().code(2);
    let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(message.contains("`--for` is newton, but must be a code with a deck of film at the tier quick: openfoam"));
    // a submission of other inputs than the export's is refused
    let text = std::fs::read_to_string(place.path("out/submission.toml")).expect("written");
    let own = text.lines().find(|line| line.starts_with("inputs = ")).expect("the digest");
    let other = text.replace(own, "inputs = \"00000000\"").replace("# velocity_l2 = 0.0", "velocity_l2 = 0.1");
    std::fs::write(place.path("other.toml"), other).expect("written");
    let refused = place.bagnold(&["judge", "other.toml", "--quiet"]).assert().code(2);
    let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(message.contains("`inputs` is \"00000000\", but must be"), "{message}");
    // one of other gates is judged with a notice of the limits that have moved
    let given = text.replace("# velocity_l2 = 0.0", "velocity_l2 = 0.1");
    let gates = text.lines().find_map(|line| line.strip_prefix("gates = ")).expect("the digest").trim_matches('"');
    let limits = text.lines().find_map(|line| line.strip_prefix("limits = ")).expect("the limits").trim_matches('"');
    place.file("same.toml", &given);
    place.file("moved.toml", &given.replace(gates, "3f2a3f2a").replace(&limits[..4], "zzzz"));
    for (file, notice) in [("same.toml", None), ("moved.toml", Some("made for gates 3f2a3f2a, now "))] {
        let told = place.bagnold(&["judge", file, "--out", "judged", "--quiet"]).assert().code(0);
        let told = String::from_utf8_lossy(&told.get_output().stdout).into_owned();
        assert_eq!(told.contains(": limits of 1 moved\n"), notice.is_some(), "{told}");
        let moved = read(&place, "judged/metrics.json")["codes"][0]["moved"].as_str().map(str::to_owned);
        assert_eq!(moved.is_some_and(|moved| moved.starts_with(notice.unwrap_or_default())), notice.is_some());
    }
}

#[test]
fn two_runs_are_compared_number_by_number() {
    let place = Place::new();
    let run = |out: &'static str, more: &[&str]| {
        let arguments = [&["run"], CHEAP, more, &["--out", out, "--quiet"]].concat();
        place.bagnold(&arguments).assert().code(0);
    };
    run("first", &[]);
    run("again", &[]);
    run("thicker", &["--set", "material.viscosity=1.1"]);
    place.bagnold(&["compare", "first", "again", "--out", "same", "--deny-differences"]).assert().code(0);
    let differ =
        place.bagnold(&["compare", "first", "thicker", "--out", "other", "--deny-differences"]).assert().code(1);
    let shown = String::from_utf8_lossy(&differ.get_output().stdout).into_owned();
    assert!(shown.starts_with("parameter material.viscosity: 1.0 → 1.1\n"), "{shown}");
    assert!(shown.lines().nth(3).is_some_and(|line| line.starts_with("  film ") && line.contains(" → ")), "{shown}");
    let lines = read(&place, "other/differences.json");
    assert!(lines[0]["tolerances"].as_f64() > Some(1.0), "{}", lines[0]);
    // a folder of another version of the gates
    let text = std::fs::read_to_string(place.path("thicker/metrics.json")).expect("written");
    let moved = text.replacen("\"at_most\": 0.0", "\"at_most\": 1.0", 1);
    assert_ne!(moved, text, "a limit of zero");
    std::fs::write(place.path("thicker/metrics.json"), moved).expect("written");
    let told = place.bagnold(&["compare", "first", "thicker", "--out", "moved"]).assert().code(0);
    let line = "limits of 1 gates differ: the versions of the gates differ, or limits depend on the runs";
    assert!(String::from_utf8_lossy(&told.get_output().stdout).contains(line));
    // of the same parameters only the gates can have moved
    let text = std::fs::read_to_string(place.path("again/metrics.json")).expect("written");
    let gates = serde_json::from_str::<Value>(&text).expect("JSON")["gates"].as_str().expect("a digest").to_owned();
    let moved = text.replacen("\"at_most\": 0.0", "\"at_most\": 1.0", 1).replace(&gates, "00000000");
    std::fs::write(place.path("again/metrics.json"), moved).expect("written");
    let refused = place.bagnold(&["compare", "first", "again", "--out", "none"]).assert().code(2);
    let message = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    let words = format!("first: the gates of film were {gates} and are 00000000 in again: limits of 1 gates changed");
    assert!(message.contains(&words), "{message}");
    place.bagnold(&["compare", "first", "again", "--out", "across", "--across-gates"]).assert().code(0);
    let parameters = read(&place, "other/parameters.json");
    assert_eq!(parameters[0]["path"], "material.viscosity", "{parameters}");
    assert_eq!((parameters[0]["values"][1].as_str(), parameters.as_array().map(Vec::len)), (Some("1.1"), Some(1)));
    assert_eq!(read(&place, "same/parameters.json").as_array().map(Vec::len), Some(0));
    let figures = std::fs::read_dir(place.path("other/figures")).expect("figures").count();
    assert!(figures >= 4, "{figures} files of profile and history");
    let finer = CHEAP.iter().map(|word| if *word == "resolution=10" { "resolution=11" } else { word });
    let finer: Vec<&str> = ["run", "--out", "finer", "--quiet"].into_iter().chain(finer).collect();
    place.bagnold(&finer).assert().code(0);
    // one key apart: paired, with their numbers and curves
    let paired = place.bagnold(&["compare", "first", "finer", "--out", "paired"]).assert().code(0);
    let told = String::from_utf8_lossy(&paired.get_output().stdout).into_owned();
    assert!(told.contains("film: runs with resolution=11 compared with those with resolution=10"), "{told}");
    assert!(!told.contains("not in every folder"), "{told}");
    let figures = std::fs::read_dir(place.path("paired/figures")).expect("figures").count();
    assert!(figures >= 4, "{figures} files of profile and history");
    std::fs::create_dir(place.path("water")).expect("writable");
    let renamed = text.replacen("\"case\": \"film\"", "\"case\": \"hydrostatic\"", 1);
    std::fs::write(place.path("water/metrics.json"), renamed).expect("written");
    let apart = place.bagnold(&["compare", "first", "water", "--out", "none"]).assert().code(2);
    let message = String::from_utf8_lossy(&apart.get_output().stderr).into_owned();
    assert!(message.contains("first: has no variant of a case in common with water"), "{message}");
    let wrong = place.bagnold(&["compare", "first", "store", "--out", "none"]).assert().code(2);
    let message = String::from_utf8_lossy(&wrong.get_output().stderr).into_owned();
    assert!(message.contains("contains neither a run's metrics.json nor a report's"), "{message}");
    let own = place.bagnold(&["compare", "first", "again", "--out", "again"]).assert().code(2);
    let message = String::from_utf8_lossy(&own.get_output().stderr).into_owned();
    assert!(message.contains("`--out` is again, but must be another folder than those compared"), "{message}");
    assert!(place.path("again/metrics.json").is_file(), "what is compared stays");
}

/// A submission of `tests/foreign`.
fn foreign(name: &str) -> String {
    let file = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("foreign").join(name);
    file.display().to_string()
}

#[test]
fn two_codes_that_are_not_ours_are_judged_from_their_files() {
    let place = Place::new();
    let layer = foreign("layer/bagnold.toml");
    place.sharing(&["judge", &layer, "--out", "layer", "--quiet"]).assert().code(0);
    let code = read(&place, "layer/metrics.json")["codes"][0].clone();
    let value = |name: &str| {
        let metrics = code["metrics"].as_array().expect("metrics");
        metrics.iter().find(|metric| metric["name"] == name).and_then(|metric| metric["value"].as_f64())
    };
    // its own script measures 0.008 % against the exact profile, with velocities of four digits
    assert!(value("velocity_l2").expect("a profile") < 0.02, "{code}");
    assert!(value("implied_stress_error").expect("a pressure") < 0.1, "{code}");
    assert!(value("transient_mean_error_half").expect("a history").abs() < 0.5, "{code}");
    assert_eq!(code["tally"]["new failure"], 0, "{code}");

    let column = foreign("mpm/column-planar.toml");
    // its height at a = 3 misses the law: a foreign code may fail
    let judged = place.sharing(&["judge", &column, "--out", "column", "--quiet"]).assert().code(1);
    let said = String::from_utf8_lossy(&judged.get_output().stdout).into_owned();
    assert!(said.contains("; not judged: front, kinetic_energy, rest_time\n"), "{said}");
    let code = read(&place, "column/metrics.json")["codes"][0].clone();
    let of = |ratio: &str| {
        let variant = format!("material=lagree,aspect_ratio={ratio},resolution=20");
        let metrics = code["metrics"].as_array().expect("metrics").clone();
        let own = |metric: &&Value| metric["name"] == "run_out" && metric["variant"] == variant.as_str();
        metrics.iter().find(own).and_then(|metric| metric["value"].as_f64()).expect("a deposit")
    };
    // as its own script measures them
    assert!((of("1") - 2.1690).abs() < 1e-4 && (of("3") - 6.9226).abs() < 1e-4, "{} {}", of("1"), of("3"));
    assert!(code["tally"]["not judged"].as_u64() > Some(0), "{code}");
}

/// Elements within elements, which a parser follows by calling itself.
#[test]
fn collections_and_grids_nested_too_deep_are_refused() {
    let nested = format!("{}{}", "<a>".repeat(3000), "</a>".repeat(3000));
    let submission = |files: &str| {
        format!(
            "case = \"column-planar\"\n[code]\nname = \"deep\"\n[[run]]\nvariant = \"material=lagree,aspect_ratio=1\"\n\
             [run.particles]\n{files}\n[run.particles.columns]\nx = \"Points:0 [m]\"\n"
        )
    };
    for (file, files) in [("deep.pvd", "files = [\"deep.pvd\"]"), ("deep.vtu", "files = [\"deep.vtu\"]\ntimes = [0.0]")]
    {
        let place = Place::new();
        place.file(file, &nested);
        place.file("mine.toml", &submission(files));
        let output = place.bagnold(&["judge", "mine.toml", "--quiet"]).assert().code(2).get_output().clone();
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(message.contains(file) && message.contains("nested deeper than 64 elements"), "{message}");
    }
}

/// A block of beads of a few particles that falls apart, with a front that was measured and may be missed by half.
const FLUME: &str = "case = \"scene\"\nname = \"flume\"\ngravity = [0.0, -9.81]\nspacing = 0.02\nduration = 0.1\ninterval = 0.01\n\
    [sides]\nleft = { mirror = 0.0 }\nright = { open = 0.5 }\nbottom = \"none\"\ntop = \"none\"\n\
    [[bodies]]\nshape = \"box\"\nlower = [0.0, 0.0]\nupper = [0.1, 0.1]\n\
    [[walls]]\nname = \"bed\"\npoints = [[0.0, 0.0], [0.5, 0.0]]\n\
    [[gauges]]\nkind = \"front\"\nname = \"toe\"\nfrom = [0.0, 0.0]\nto = [0.5, 0.0]\nthickness = 0.02\n\
    [[measured]]\ngauge = \"toe\"\nsource = \"own flume\"\npoints = [[0.05, 0.11], [0.09, 0.13]]\nlimit = 50.0\n";

#[test]
fn a_series_of_the_front_of_a_scene_is_judged_by_what_its_file_says_was_measured() {
    let place = Place::new();
    place.file("flume.toml", FLUME);
    place.bagnold(&["run", "flume.toml", "--out", "own", "--quiet"]).assert().code(0);
    let submission = "case = \"scene\"\nbase = \"flume.toml\"\n[code]\nname = \"our own series\"\n[[run]]\nvariant = \"scene=flume\"\n\
        series = { file = \"own/tables/gauges-scene-flume.csv\", columns = { time = \"t [s]\", front = \"toe: front [m]\" } }\n";
    place.file("mine.toml", submission);
    let judge = |code: i32| {
        let finished = place.bagnold(&["judge", "mine.toml", "--out", "judged", "--quiet"]).assert().code(code);
        String::from_utf8_lossy(&finished.get_output().stderr).into_owned()
    };
    judge(0);
    let metrics = read(&place, "judged/metrics.json")["codes"][0]["metrics"].as_array().expect("metrics").clone();
    let of = |name: &str| metrics.iter().find(|metric| metric["name"] == name).unwrap_or_else(|| panic!("no {name}"));
    for (name, verdict) in [("front", "observed"), ("gauge_error", "pass")] {
        assert!(of(name)["value"].is_f64(), "{name}: {}", of(name));
        assert_eq!(of(name)["value"], of(name)["bagnold"], "{name}");
        assert_eq!(of(name)["verdict"], verdict, "{name}");
    }
    // both are drawn, and who measured it is named
    let page = std::fs::read_to_string(place.path("judged/index.html")).expect("a page");
    assert!(page.contains("our own series") && page.contains("own flume"));
    // twice as far is beyond the limit of the scene's file
    place.file("far.csv", "t,front\n0,0.2\n0.1,0.26\n");
    place.file(
        "mine.toml",
        &submission.replace("own/tables/gauges-scene-flume.csv", "far.csv").replace("toe: front", "front"),
    );
    judge(1);
    // where nothing was measured, nothing is judged, which is no success
    place.file("mine.toml", submission);
    place.file("flume.toml", FLUME.split("[[measured]]").next().expect("text"));
    judge(1);
    let told = place.bagnold(&["judge", "mine.toml", "--out", "judged", "--junit", "judged.xml"]).assert().code(1);
    let told = String::from_utf8_lossy(&told.get_output().stdout).into_owned();
    let xml = std::fs::read_to_string(place.path("judged.xml")).expect("JUnit");
    assert!(xml.contains("errors=\"1\"") && xml.contains("no gate was judged"), "{xml}");
    assert!(
        told.contains("no gate was judged: the case has none; a scene has one for each [[measured]] with a `limit`"),
        "{told}"
    );
    // a scene in which nothing measures a front
    let without = FLUME.split("[[gauges]]").next().expect("text");
    place.file("flume.toml", without);
    let message = judge(2);
    assert!(
        message.contains("mine.toml: `run 1.series.front`: scene `flume` has no gauge of kind \"front\""),
        "{message}"
    );
    assert!(message.contains("add one under [[gauges]] with name"), "{message}");
    place.file("flume.toml", &FLUME.replace("\"scene\"", "\"film\""));
    let message = judge(2);
    assert!(message.contains("`case` is \"scene\", but must be the case of flume.toml, \"film\""), "{message}");
    place.file("mine.toml", &submission.replace("base = \"flume.toml\"\n", ""));
    let message = judge(2);
    assert!(message.contains("name the file of the scene by `base`"), "{message}");
}
