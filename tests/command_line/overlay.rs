//! `run --overlay`: a user's measurements in a case's figure.

use crate::command_line::program::{CHEAP, Place, document};
use bagnold_harness::metric::Verdict;

/// The exact velocities of the film of `CHEAP` are not known here: these are some 10 % off at most.
const FILM: &str =
    "# source: own film\n# limit: 50\n# figure: FIGURE\ny/h [-],u [cm/s],uncertainty [cm/s]\n0.5,1,1\n0.9,1,1\n";

fn figure(place: &Place) -> String {
    let refused = place.file("other.csv", "y/h [-],weight [kg],uncertainty [kg]\n0.5,1,1\n");
    let finished = place.run(&[CHEAP, &["--overlay", &refused]].concat()).code(2);
    let text = String::from_utf8_lossy(&finished.get_output().stderr).into_owned();
    assert!(text.contains("is weight [kg] over y/h [-], but must be the axes of one of the case's figures"), "{text}");
    let there = text.split("figures (").nth(1).expect("the figures are named");
    let own = there.split("; ").find(|own| own.contains("u [m/s] and y/h [-]")).expect("a profile").to_owned();
    own.split(':').next().expect("a name").to_owned()
}

#[test]
fn measurements_are_drawn_and_judged_by_the_limit_that_they_state_and_the_case_file_keeps_them() {
    let place = Place::new();
    let table = FILM.replace("FIGURE", &figure(&place));
    let mine = place.file("mine.csv", &table);
    let finished = place.run(&[CHEAP, &["--overlay", &mine, "--json"]].concat());
    let metrics = document(&finished).metrics;
    let own: Vec<_> = metrics.iter().filter(|metric| metric.name == "overlay_residual").collect();
    let [own] = own.as_slice() else { panic!("{own:?}") };
    assert_eq!((own.variant.to_string().as_str(), own.source.as_deref()), ("overlay=mine", Some("own film")));
    assert_eq!((own.verdict, own.unit.as_str()), (Verdict::Pass, "-"));
    let value = own.value.expect("a number");
    assert!(value > 0.5, "the film is faster than 1 cm/s: {value}");

    // the written case file draws the same again
    let text = std::fs::read_to_string(place.path("out/case.toml")).expect("written");
    assert!(text.contains("overlay = [\"overlay/mine.csv\"]"), "{text}");
    assert_eq!(std::fs::read_to_string(place.path("out/overlay/mine.csv")).expect("kept"), table);
    let again = place.bagnold(&["run", "out/case.toml", "--out", "again", "--json"]).assert();
    let again = document(&again).metrics;
    assert_eq!(again.iter().find(|metric| metric.name == "overlay_residual").and_then(|one| one.value), Some(value));

    // a narrower limit fails
    let narrow = place.file("narrow.csv", &table.replace("# limit: 50", "# limit: 0.01"));
    place.run(&[CHEAP, &["--overlay", &narrow]].concat()).code(1);
    // and without one nothing is judged
    let open = place.file("open.csv", &table.replace("# limit: 50\n", ""));
    place.run(&[CHEAP, &["--overlay", &open]].concat()).code(0);
}

#[test]
fn measurements_that_cannot_be_read_are_refused_before_anything_is_simulated() {
    let place = Place::new();
    for (text, message) in [
        (
            "y/h [-],u [m/s],uncertainty [s]\n0.5,1,1\n",
            "`uncertainty` is [s], but must be a unit that converts to [m/s]",
        ),
        (
            "y/h [-],u [knots],uncertainty [m/s]\n0.5,1,1\n",
            "`uncertainty` is [m/s], but must be a known unit, such as [cm/s] or [kPa]; [knots] is unknown",
        ),
        (
            "y/h [-],u [m/s],uncertainty [m/s]\n0.5,inf,1\n",
            "`line 2`: \"inf\" in column u [m/s] is not a measured value",
        ),
        ("y/h [-],u [m/s]\n0.5,1\n", "`columns`: u [m/s] has no uncertainty"),
        ("# limit: -1\ny/h [-],u [m/s],uncertainty [m/s]\n0.5,1,1\n", "`# limit` is -1, but must be a positive number"),
    ] {
        let file = place.file("bad.csv", text);
        let finished = place.run(&["column-planar", "--tier", "fine", "--overlay", &file]).code(2);
        let errors = String::from_utf8_lossy(&finished.get_output().stderr).into_owned();
        assert!(errors.contains(message), "{errors}");
    }
    place.run(&["film", "--overlay", "no-such.csv"]).code(2);
    assert_eq!(place.names(), ["bad.csv"], "nothing was written");
}
