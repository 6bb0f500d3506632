//! `bagnold predict`: the transport of a flume with its interval.

use crate::command_line::program::Place;

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
    assert!(of("0.046", "0.02").contains("\ninside of what was compared"));
    let deep = of("0.2", "0.02");
    assert!(deep.contains("outside of what was compared") && deep.contains("fewer than ten runs"), "{deep}");
    assert!(of("0.1", "0.0004").contains("no motion"));
}
