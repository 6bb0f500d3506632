//! Runs that go on from finished ones, and scenes that start from a state: bits, tables and pictures of an uninterrupted run.

use crate::program::{Place, document};
use crate::scene::{shipped, walk};

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
    for (name, duration) in [("fed-slope.toml", 0.06), ("gate.toml", 0.04), ("funnel.toml", 0.02)] {
        let lasting = |times: f64| {
            let settings = [format!("duration={}", times * duration), format!("interval={}", duration / 10.0)];
            set(&example(name), &[&settings[0], &settings[1], "measured=[]", "pictures=2"])
        };
        let place = Place::new();
        outcome(&place, &lasting(1.0));
        for times in [1.3, 2.0] {
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
        assert!(told.contains(&format!("begins anew: the finished run {reason}")), "{reason}: {told}");
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
    let column = |duration: f64| {
        let lists = "lagree sensitivity regularised bars bars_frictions bars_limiting_frictions";
        let empty = lists.split(' ').map(|list| format!("{list}.aspect_ratios=[]"));
        let others = ["eddy", "uncoupled"].map(|list| format!("other_numerics.{list}_aspect_ratios=[]"));
        let own = [format!("duration={duration}"), "resolution=10".to_owned(), "sand.aspect_ratios=[0.9]".to_owned()];
        let settings: Vec<String> = empty.chain(others).chain(own).collect();
        set("column-planar", &settings.iter().map(String::as_str).collect::<Vec<_>>())
    };
    let incline = |duration: f64| {
        let duration = format!("duration={duration}");
        set("incline-collapse", &["slope_angles=[16.0]", "resolution=15", &duration])
    };
    let still = |duration: f64| {
        let duration = format!("duration={duration}");
        set("still-water", &[&duration, "averaging_time=0.2", "unstabilised_jitters=[]"])
    };
    let bed_load = |duration: f64| {
        let grains = format!("stabilised.duration={duration}");
        let continuum = format!(
            "continuum.runs=[{{ stage = \"dilating\", slopes = [0.03], pair_laws = [], starts = [1.0], spacings = [0.001], \
             duration = {duration}, averaging_time = 0.05 }}]"
        );
        let lists = ["stabilised.slopes=[0.03]", "beside=[]", "continuum.numerics.time_step=4e-4"];
        set("bed-load", &[&lists[..], &["stabilised.averaging_time=0.05", &grains, &continuum]].concat())
    };
    let cases: [(&dyn Fn(f64) -> Vec<String>, f64, f64); 4] =
        [(&column, 0.5, 0.7), (&incline, 0.1, 0.17), (&bed_load, 0.1, 0.13), (&still, 0.5, 0.6)];
    for (case, short, long) in cases {
        let place = Place::new();
        outcome(&place, &case(short));
        assert_continues(&place, &case(long), &case(long)[0]);
    }
}
