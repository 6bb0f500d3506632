//! `bagnold predict`: the transport of a flume and the collapse of a column, with their intervals.

use crate::command_line::program::{Place, document};

const FLUME: &[&str] =
    &["predict", "bed-load", "--grain-diameter", "0.005", "--grain-density", "2600", "--slope", "0.02"];

/// Numbers that follow a word in what a flume without or with side walls prints.
fn numbers(options: &[&str], word: &str) -> Vec<f64> {
    let finished = Place::new().bagnold(&[FLUME, options].concat()).assert().code(0);
    let text = String::from_utf8_lossy(&finished.get_output().stdout).into_owned();
    let line = text.lines().find(|line| line.contains(word)).unwrap_or_else(|| panic!("no {word} in {text}"));
    line.split(|c: char| !(c.is_ascii_digit() || c == '.')).filter_map(|part| part.parse().ok()).collect()
}

#[test]
fn a_wide_flume_carries_what_the_layer_carries_and_a_narrow_one_less() {
    // 0.9924 of Wong & Parker's formula in the baseline of `bed-load-1d`, in kg/(m s) by ρ_s √((s − 1) g d³)
    let wide = numbers(&["--depth", "0.046", "--draws", "16"], "bed load");
    let formula = 4.93 * (0.046_f64 * 0.02 / (1.6 * 0.005) - 0.047).powf(1.6);
    let expected = 0.9924 * formula * 2600.0 * (1.6 * 9.81 * 0.005_f64.powi(3)).sqrt();
    assert!((wide[0] / expected - 1.0).abs() < 0.005, "{wide:?} for {expected}");
    let (least, most) = (wide[2], wide[3]);
    assert!(least < 0.5 * wide[0] && wide[0] < most, "{wide:?}");
    let narrow = numbers(&["--depth", "0.046", "--draws", "16", "--width", "0.1"], "bed load");
    assert!(narrow[0] < 0.8 * wide[0], "{narrow:?}");
    // the bed of a flume as narrow as that bears more than half of the stress
    let share = numbers(&["--depth", "0.046", "--draws", "8", "--width", "0.1"], "side walls")[0];
    assert!((0.5..1.0).contains(&share), "{share}");
}

#[test]
fn what_was_compared_with_measurements_is_told_from_what_was_not() {
    let of = |depth: &str, slope: &str| {
        let options =
            ["predict", "bed-load", "--grain-diameter", "0.005", "--draws", "8", "--depth", depth, "--slope", slope];
        let finished = Place::new().bagnold(&options).assert().code(0);
        String::from_utf8_lossy(&finished.get_output().stdout).into_owned()
    };
    assert!(of("0.046", "0.02").contains("\ninside the range compared"));
    let deep = of("0.2", "0.02");
    assert!(deep.contains("reservation   measurements: ") && deep.contains("fewer than ten runs"), "{deep}");
    let still = of("0.1", "0.0004");
    assert!(still.starts_with("bed load      none: q* = ") && !still.contains("95 % interval"), "{still}");
    assert!(!still.contains("not computed"), "{still}");
}

#[test]
fn a_measured_rate_is_inside_of_the_interval_or_not() {
    let of = |slope: &str, rate: &str| {
        let options =
            ["predict", "bed-load", "--grain-diameter", "0.0025", "--draws", "8", "--depth", "0.08", "--slope"];
        let finished = Place::new().bagnold(&[&options[..], &[slope, "--measured", rate]].concat()).assert().code(0);
        String::from_utf8_lossy(&finished.get_output().stdout).into_owned()
    };
    let [own, far, still] = [of("0.02", "1.0"), of("0.02", "100.0"), of("0.001", "1.0")];
    assert!(still.contains("yours         1 kg/(m s), none is predicted"), "{still}");
    assert!(own.contains("yours         1 kg/(m s), inside of the 95 % interval; predicted over yours: "), "{own}");
    assert!(far.contains("outside of the 95 % interval") && far.contains(": antidunes)"), "{far}");
}

/// Static friction of a law and of its draws.
const LAW: [f64; 3] = [0.26, 0.24, 0.29];
const FLOW: &[&str] = &["--set", "half_width=0.08", "--set", "aspect_ratio=1.0", "--set", "solid_fraction=0.76"];

/// Run-out of the column by `bagnold run`.
fn run_out(place: &Place, static_friction: f64, resolution: usize) -> f64 {
    let law = format!("material.static_friction={static_friction}");
    let resolution = format!("resolution={resolution}");
    let others = "material.limiting_friction=1.1 material.reference_inertia=0.7 material.grain_diameter=0.002 \
        material.grain_density=2500.0 variants=[]";
    let own = others.split(' ').chain([law.as_str(), resolution.as_str()]).flat_map(|setting| ["--set", setting]);
    let own: Vec<&str> = ["run", "column-planar", "--json", "--out", "alone"].into_iter().chain(own).collect();
    // gates of coarse runs may fail
    let finished = place.bagnold(&[&own, FLOW].concat()).assert();
    let metrics = document(&finished).metrics;
    let own = metrics.iter().find(|metric| metric.name == "run_out" && metric.variant.get("quantity").is_none());
    own.and_then(|metric| metric.value).expect("a run-out")
}

#[test]
fn a_column_is_predicted_from_the_draws_of_a_law_and_judged_by_the_grains() {
    let place = Place::new();
    let others = "limiting_friction = 1.1\nreference_inertia = 0.7\ngrain_diameter = 0.002\ngrain_density = 2500.0\n";
    let draws: String = LAW[1..].iter().map(|draw| format!("\n[[draws]]\nstatic_friction = {draw}\n")).collect();
    place.file("law.toml", &format!("[material]\nlaw = \"mu-i\"\nstatic_friction = {}\n{others}{draws}", LAW[0]));
    let predict =
        ["predict", "column-planar", "--law", "law.toml", "--draws", "2", "--resolution", "5", "--out", "out"];
    let predict = |more: &[&str]| place.bagnold(&[&predict, FLOW, more].concat()).assert();
    predict(&[]).code(0);
    let read = |name: &str| std::fs::read_to_string(place.path("out").join(name)).expect("written");
    let (plan, prediction) = (read("plan.json"), read("prediction.csv"));
    let summary = read("summary.txt");
    let row = prediction.lines().find(|line| line.contains(",run_out,")).expect("a run-out");
    let numbers: Vec<f64> = row.split(',').filter_map(|cell| cell.parse().ok()).collect();
    let [value, u_input, u_numerical, lower, upper] = numbers[..] else { panic!("{row}") };
    assert!((value - run_out(&place, LAW[0], 10)).abs() < 1e-9, "{row}");
    let difference = (value - run_out(&place, LAW[0], 5)).abs();
    assert!(u_numerical > difference - 1e-9 && u_numerical < difference + 0.2, "half a row counts at least: {row}");
    let apart = run_out(&place, LAW[1], 5) - run_out(&place, LAW[2], 5);
    assert!((u_input - apart.abs() / 2.0_f64.sqrt()).abs() < 1e-9 && lower < value && value < upper, "{row}");
    let judged = |measured: f64| {
        let text = format!("run_out [-],run_out uncertainty [-]\n{measured},0.01\n");
        let measured = place.file("own.csv", &text);
        predict(&["--measured", &measured]).code(0);
        read("verdict-own.txt")
    };
    assert!(judged(value + 0.9 * u_numerical).contains(": validated to ± u_val\n"));
    assert!(judged(value + 3.0 * (u_numerical + u_input + 0.01)).contains(": model error\n"));
    assert_eq!((read("plan.json"), read("prediction.csv")), (plan.clone(), prediction));
    assert_eq!(read("summary.txt"), summary, "measurements replace no prediction");
    let refused = predict(&["--set", "gravity=3.7"]).code(2);
    assert!(String::from_utf8_lossy(&refused.get_output().stderr).contains("contains a prediction of another plan"));
    assert_eq!(read("plan.json"), plan);
}
