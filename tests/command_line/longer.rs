//! Runs that go on from finished ones, and scenes that start from a state: bits, tables and pictures of an uninterrupted run.

use crate::command_line::program::{self, Place, document};
use crate::command_line::restart::has_gone_on;
use crate::command_line::scene::{metric, shipped, walk};
use std::process::Command;

/// Final states with all metrics, the tables and pictures, and what the command has told.
type Outcome = ((String, String), Vec<String>, String);

/// Runs into a folder of a place with its own store.
fn outcome(place: &Place, arguments: &[String]) -> Outcome {
    let all: Vec<&str> =
        ["run", "--json", "--out", "out"].into_iter().chain(arguments.iter().map(String::as_str)).collect();
    let finished = place.bagnold(&all).assert();
    let told = String::from_utf8_lossy(&finished.get_output().stderr).into_owned();
    // gates of a flow may fail before its time is up
    assert!(finished.get_output().status.code().is_some_and(|code| code <= 1), "{arguments:?}: {told}");
    let judged = document(&finished);
    let files = walk(&place.path("out")).into_iter();
    let files = files.filter(|file| file.extension().is_some_and(|end| end == "csv" || end == "vtu"));
    let mut read: Vec<String> = files.map(|file| std::fs::read_to_string(file).expect("text")).collect();
    read.sort();
    ((judged.state_hash, format!("{:?}", judged.metrics)), read, told)
}

/// Arguments that set parameters.
fn set(target: &str, settings: &[&str]) -> Vec<String> {
    let settings = settings.iter().flat_map(|setting| ["--set".to_owned(), (*setting).to_owned()]);
    std::iter::once(target.to_owned()).chain(settings).collect()
}

fn example(name: &str) -> String {
    shipped().into_iter().find(|file| file.ends_with(name)).expect("a scene").display().to_string()
}

/// Compares a run that continues, on one thread, with one that begins anew, on two.
fn assert_continues(place: &Place, arguments: &[String], name: &str) {
    let threads = |count: &str| [arguments, &["--threads".to_owned(), count.to_owned()]].concat();
    let (whole, continued) = (outcome(&Place::new(), &threads("2")), outcome(place, &threads("1")));
    assert!(continued.2.contains("resumes from its checkpoint"), "{name}: {}", continued.2);
    assert_eq!(whole.0, continued.0, "{name}");
    assert!(whole.1.len() > 2 && whole.1 == continued.1, "{name}: tables and pictures");
}

#[test]
fn a_longer_run_continues_a_finished_one_bit_for_bit() {
    // an inlet, a wall that moves, a mesh in space
    for (name, duration) in [("fed-slope.toml", 0.04), ("gate.toml", 0.03), ("funnel.toml", 0.01)] {
        let lasting = |times: f64| {
            let settings = [format!("duration={}", times * duration), format!("interval={}", duration / 10.0)];
            let coarse = if name == "funnel.toml" { &["spacing=0.012"][..] } else { &[] };
            set(&example(name), &[&[&settings[0], &settings[1], "measured=[]", "pictures=2"], coarse].concat())
        };
        let place = Place::new();
        outcome(&place, &lasting(1.0));
        for times in if name == "gate.toml" { vec![1.3, 2.0] } else { vec![1.3] } {
            assert_continues(&place, &lasting(times), name);
        }
    }
}

#[test]
fn a_run_that_cannot_continue_a_finished_one_says_why() {
    let told = |place: &Place, duration: f64, interval: f64, pictures: u32| {
        let settings = [format!("duration={duration}"), format!("interval={interval}"), format!("pictures={pictures}")];
        outcome(place, &set(&example("gate.toml"), &settings.each_ref().map(String::as_str))).2
    };
    for (duration, interval, pictures, reason) in [
        (0.08, 0.002, 2, "was sampled every 0.004 s, not every 0.002 s"),
        (0.02, 0.004, 2, "ended at 0.04 s, not before 0.02 s"),
        (0.048, 0.004, 12, "has a picture every 0.016 s, not every 0.004 s"),
    ] {
        let place = Place::new();
        told(&place, 0.04, 0.004, 2);
        let told = told(&place, duration, interval, pictures);
        assert!(
            told.contains(&format!("simulated again from the start: the finished run {reason}")),
            "{reason}: {told}"
        );
        assert!(!told.contains("resumes"), "{told}");
    }
    // another parameter makes another run
    let place = Place::new();
    told(&place, 0.04, 0.004, 2);
    let other = set(&example("gate.toml"), &["duration=0.08", "interval=0.004", "pictures=2", "stiffness=60"]);
    let told = outcome(&place, &other).2;
    assert!(!told.contains("resumes") && !told.contains("anew"), "{told}");
}

#[test]
fn longer_runs_of_cases_of_both_models_continue_finished_ones() {
    let column =
        |duration: f64| set("column-planar", &[&format!("duration={duration}"), "resolution=10", "variants=[]"]);
    let incline = |duration: f64| {
        let duration = format!("duration={duration}");
        set("incline-collapse", &["slope_angle=16", "resolution=15", &duration])
    };
    let still = |duration: f64| {
        let duration = format!("duration={duration}");
        set("still-water", &[&duration, "averaging_time=0.1", "vary=[]", "variants=[]"])
    };
    let bed_load = |duration: f64| {
        let runs = r#"variants=[{name="stabilised"},{name="dilating",set={formulation="dilating"}}]"#;
        let duration = format!("duration={duration}");
        set("bed-load", &[runs, &duration, "averaging_time=0.05", "continuum.numerics.time_step=4e-4"])
    };
    let cases = [
        (column(0.2), column(0.26)),
        (incline(0.1), incline(0.17)),
        (bed_load(0.1), bed_load(0.13)),
        (still(0.24), still(0.3)),
    ];
    for (short, long) in cases {
        let place = Place::new();
        outcome(&place, &short);
        assert_continues(&place, &long, &long[0]);
    }
}

#[test]
fn a_continued_run_that_is_killed_resumes_to_the_same_bits() {
    let place = Place::new();
    let lasting = |duration: &str| set(&example("fed-slope.toml"), &[duration, "interval=0.02", "measured=[]"]);
    outcome(&place, &lasting("duration=0.1"));
    let longer = lasting("duration=0.6");
    let mut child = Command::new(program::path())
        .current_dir(place.path(""))
        .args(["run", "--quiet", "--store", "store", "--checkpoint-interval", "0.02", "--threads", "1"])
        .args(&longer)
        .spawn()
        .expect("started");
    assert!(has_gone_on(&mut child, &place, "store"), "over before it could be killed");
    child.kill().expect("kill -9");
    child.wait().expect("ended");
    assert_continues(&place, &longer, "killed");
}

/// A layer at rest on a bed between periodic sides, under gravity at an angle, with a friction and a spacing.
fn layer(slope: f64, friction: f64, spacing: f64) -> String {
    let (sine, cosine) = (slope.to_radians().sin(), slope.to_radians().cos());
    format!(
        "case = \"scene\"\nname = \"bed\"\ngravity = [{}, {}]\nspacing = {spacing}\nduration = 0.05\ninterval = 0.005\n\
         pictures = 2\nmeasured = []\n[material]\nlaw = \"mu-i\"\nstatic_friction = {friction}\nlimiting_friction = 0.6\n\
         reference_inertia = 0.3\ngrain_diameter = 0.001\ngrain_density = 2500.0\n\
         [sides]\nleft = {{ periodic = 0.0 }}\nright = {{ periodic = 0.05 }}\nbottom = \"none\"\ntop = \"none\"\n\
         [[bodies]]\nshape = \"box\"\nlower = [0.0, 0.0]\nupper = [0.05, 0.03]\n\
         [[walls]]\nname = \"bed\"\npoints = [[-0.02, 0.0], [0.07, 0.0]]\n",
        9.81 * sine,
        -9.81 * cosine
    )
}

/// The state that a run has left, by what it has told.
fn state_of(outcome: &Outcome) -> String {
    let told = &outcome.2;
    let state = told.split("for --from, is ").nth(1).and_then(|rest| rest.split_whitespace().next());
    state.unwrap_or_else(|| panic!("no state: {told}")).to_owned()
}

fn from(target: &str, state: &str, settings: &[&str]) -> Vec<String> {
    [set(target, settings), vec!["--from".to_owned(), state.to_owned()]].concat()
}

#[test]
fn a_scene_from_its_own_state_ends_as_an_uninterrupted_run() {
    // of the scene with an inlet and of the one with a moving wall
    for (name, settings) in [
        ("fed-slope.toml", ["duration=0.06", "interval=0.006", "measured=[]"]),
        ("gate.toml", ["duration=0.04", "interval=0.004", "measured=[]"]),
    ] {
        let place = Place::new();
        let state = state_of(&outcome(&place, &set(&example(name), &settings)));
        let longer = ["duration=0.1", settings[1], settings[2]];
        let whole = outcome(&Place::new(), &set(&example(name), &longer));
        let other = Place::new();
        let begun = outcome(&other, &from(&example(name), &state, &longer));
        assert!(!begun.2.contains("resumes") && begun.2.contains("starts at t = 0.0"), "{}", begun.2);
        assert_eq!(whole.0.0, begun.0.0, "{name}: the last state");
        let case = std::fs::read_to_string(other.path("out/case.toml")).expect("written");
        assert!(case.contains("sha256 = \""), "{case}");
    }
}

#[test]
fn a_folder_of_results_and_one_of_states_stand_for_their_newest_state() {
    let place = Place::new();
    let level = place.file("level.toml", &layer(0.0, 0.4, 0.005));
    let state = state_of(&outcome(&place, &set(&level, &[])));
    std::fs::rename(place.path("out"), place.path("first")).expect("renamed");
    let states = std::path::Path::new(&state).parent().expect("a folder").display().to_string();
    let ends = ["first", &states, &state].map(|given| {
        let begun = outcome(&place, &from(&level, given, &["duration=0.07"]));
        let case = std::fs::read_to_string(place.path("out/case.toml")).expect("written");
        assert!(case.contains(".checkpoint\""), "{given}: {case}");
        begun.0.0
    });
    assert!(ends.iter().all(|end| *end == ends[2]), "{ends:?}");
    // --fresh neither discards nor overlooks it
    let fresh = [from(&level, "first", &["duration=0.08"]), vec!["--fresh".to_owned()]].concat();
    outcome(&place, &fresh);
    std::fs::create_dir(place.path("empty")).expect("writable");
    std::fs::remove_dir_all(place.path("store")).expect("removed");
    for (given, reason) in [("empty", "neither a state nor the case.toml"), ("first", "no state of this run is stored")]
    {
        let arguments = from(&level, given, &[]);
        let all = std::iter::once("run").chain(arguments.iter().map(String::as_str)).collect::<Vec<_>>();
        let finished = place.bagnold(&all).assert().code(2);
        let told = String::from_utf8_lossy(&finished.get_output().stderr).into_owned();
        assert!(told.contains(reason) && told.contains("; give the state file that `bagnold run` names"), "{told}");
    }
}

#[test]
fn a_prepared_bed_is_tilted_and_its_balances_close() {
    let place = Place::new();
    let level = place.file("level.toml", &layer(0.0, 0.4, 0.0025));
    let state = state_of(&outcome(&place, &set(&level, &[])));
    let speed = |slope: f64, friction: f64| {
        let tilted = place.file("tilted.toml", &layer(slope, friction, 0.0025));
        // every balance gates, from the state on
        let arguments = from(&tilted, &state, &["duration=0.15"]);
        place.run(&arguments.iter().map(String::as_str).collect::<Vec<_>>()).code(0);
        metric(&place, "final_rms_speed", "")
    };
    // angles of friction of 22° and 29°
    let (flows, rests) = (speed(24.0, 0.4), speed(24.0, 0.55));
    assert!(flows > 0.05 && rests < 0.01, "{flows} m/s, {rests} m/s");
}

#[test]
fn a_belt_that_starts_below_a_resting_layer_leaves_its_weight() {
    let place = Place::new();
    let level = layer(0.0, 0.4, 0.0025) + "[[gauges]]\nkind = \"force\"\nname = \"bed\"\nwall = \"bed\"\n";
    let belt =
        level.replace("[0.07, 0.0]]", "[0.07, 0.0]]\nmotion = [[0.0, 0.0, 0.0], [0.3, 0.0, 0.0], [1.3, 2.0, 0.0]]");
    let (rests, moves) = (place.file("level.toml", &level), place.file("belt.toml", &belt));
    let state = state_of(&outcome(&place, &set(&rests, &["duration=0.3"])));
    let arguments = from(&moves, &state, &["duration=0.305", "interval=0.005"]);
    place.run(&arguments.iter().map(String::as_str).collect::<Vec<_>>()).code(0);
    // the bed of a belt alone would have the sound of 2 m/s, and its layer a load 17 % too large
    let weight = 1500.0 * 9.81 * 0.05 * 0.03;
    let load = metric(&place, "mean_force", "gauge=bed");
    assert!((load / weight - 1.0).abs() < 0.05, "{load} N/m for {weight}");
}

#[test]
fn a_state_that_does_not_fit_is_refused_by_field_and_rule() {
    let place = Place::new();
    let level = place.file("level.toml", &layer(0.0, 0.4, 0.0025));
    let state = state_of(&outcome(&place, &set(&level, &[])));
    let refused = |target: &str, state: &str, settings: &[&str]| {
        let arguments = from(target, state, settings);
        let all = ["run", "--quiet", "--out", "refused"].into_iter().chain(arguments.iter().map(String::as_str));
        let finished = place.bagnold(&all.collect::<Vec<_>>()).assert().code(2);
        String::from_utf8_lossy(&finished.get_output().stderr).into_owned()
    };
    let whole = std::fs::read(&state).expect("a state");
    std::fs::write(place.path("cut"), &whole[..whole.len() / 2]).expect("writable");
    place.file("text", "no state");
    let channel = Place::new();
    let still = ["duration=0.5", "averaging_time=0.1", "vary=[]", "variants=[]"];
    outcome(&channel, &set("still-water", &still));
    let of_model_b =
        walk(&channel.path("store")).into_iter().find(|file| file.ends_with("0.checkpoint")).expect("a state");
    let coarse = place.file("coarse.toml", &layer(0.0, 0.4, 0.005));
    // 5 mm lower, and lowered before the state was left
    let wall = "walls=[{ name = \"bed\", points = [[-0.02, -0.005], [0.07, -0.005]] }]";
    let moved = "walls=[{ name = \"bed\", points = [[-0.02, 0.0], [0.07, 0.0]], motion = [[0.0, 0.0, 0.0], [0.04, 0.0, -0.005]] }]";
    let bodies = "bodies=[{ shape = \"box\", lower = [0.0, 0.0], upper = [0.05, 0.02] }]";
    for (target, state, settings, message) in [
        (&level, "nowhere", vec!["duration=0.1"], "`--from`: \"nowhere\": it cannot be read"),
        (&level, "cut", vec!["duration=0.1"], "it is damaged"),
        (&level, "text", vec!["duration=0.1"], "it is not a bagnold checkpoint"),
        (&level, &of_model_b.display().to_string(), vec!["duration=0.1"], "it does not hold the state of a scene"),
        (&coarse, &state, vec!["duration=0.1"], "`spacing` is 0.005, but must be 0.0025"),
        (&level, &state, vec!["duration=0.1", "stiffness=60"], "`stiffness` is 60.0, but must be 50.0"),
        (
            &level,
            &state,
            vec!["duration=0.1", "sides.right={ periodic = 0.06 }"],
            "`sides.right.periodic` is 0.06, but must be 0.05",
        ),
        (&level, &state, vec!["duration=0.01", "interval=0.001"], "`duration` is 0.01 s, but must be later than 0.045"),
        (&level, &state, vec!["duration=0.1", wall], "wall particles where its walls have moved"),
        (&level, &state, vec!["duration=0.1", moved], "wall particles where its walls have moved"),
        (&level, &state, vec!["duration=0.1", bodies], "flow particles, but its scene has"),
        (&"film".to_owned(), &state, vec![], "only scenes start from a state"),
    ] {
        let told = refused(target, state, &settings);
        assert!(told.contains(message), "{message}: {told}");
        assert!(told.contains("; "), "a remedy: {told}");
    }
}
