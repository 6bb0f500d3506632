//! `run --output-every` and `[output]`: states of the runs on their way.

use crate::command_line::program::{CHEAP, Place};

/// Names of the point data of a VTU file.
fn arrays(text: &str) -> Vec<String> {
    let data = text.split("<PointData>").nth(1).unwrap_or_default();
    let names = data.split("Name=\"").skip(1).filter_map(|rest| rest.split('"').next());
    names.map(str::to_owned).collect()
}

#[test]
fn states_are_written_at_the_interval_with_what_was_asked_for_and_change_no_number() {
    let place = Place::new();
    let metrics = |folder: &str| {
        let text = std::fs::read_to_string(place.path(folder).join("metrics.json")).expect("written");
        let read: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        (read["state_hash"].clone(), read["metrics"].clone())
    };
    place.run(CHEAP).code(0);
    let fields = ["--output-every", "0.05", "--output-fields", "id,velocity,shear_rate,stress_ratio,mobilised"];
    let arguments = [&["run", "--out", "shown"], CHEAP, &fields].concat();
    place.bagnold(&arguments).assert().code(0);
    assert_eq!(metrics("shown"), metrics("out"), "who looks on changes nothing");

    let states = place.path("shown/states");
    let name = "fluid=newtonian,particles=jittered,resolution=10";
    let read =
        |file: String| std::fs::read_to_string(states.join(&file)).unwrap_or_else(|error| panic!("{file}: {error}"));
    let series = read(format!("{name}.pvd"));
    let times: Vec<f64> =
        series.split("timestep=\"").skip(1).filter_map(|rest| rest.split('"').next()?.parse().ok()).collect();
    assert!(times.len() > 5 && times[0] == 0.0, "{times:?}");
    let between = |pair: &[f64]| pair[1] - pair[0];
    let last = times.len() - 1;
    assert!(times[..last].windows(2).all(|pair| (between(pair) - 0.05).abs() < 5e-3), "{times:?}");
    let state = read(format!("{name}/state_{last:05}.vtu"));
    let expected = ["id [-]", "shear_rate [1/s]", "stress_ratio [-]", "mobilised [-]", "velocity [m/s]"];
    assert_eq!(arrays(&state), expected);
    assert_eq!(arrays(&read(format!("{name}-walls/state_{last:05}.vtu"))), ["velocity [m/s]"]);

    // the written case file asks for the same, of a file's table
    let text = std::fs::read_to_string(place.path("shown/case.toml")).expect("written");
    assert!(
        text.ends_with(
            "[output]\nevery = 0.05\nfields = [\"id\", \"velocity\", \"shear_rate\", \"stress_ratio\", \"mobilised\"]\n"
        ),
        "{text}"
    );
    place.bagnold(&["run", "shown/case.toml", "--out", "again"]).assert().code(0);
    assert_eq!(
        std::fs::read_to_string(place.path("again/states").join(format!("{name}.pvd"))).expect("written"),
        series
    );
}

#[test]
fn both_phases_and_grains_are_shown_with_what_they_have() {
    let place = Place::new();
    let water = ["run", "water-film", "--output-every", "10", "--out", "water"];
    place.bagnold(&water).assert().success();
    let folder = std::fs::read_dir(place.path("water/states")).expect("written").flatten();
    let mut folders: Vec<_> = folder.map(|entry| entry.path()).filter(|path| path.is_dir()).collect();
    folders.sort();
    let of = |walls: bool| {
        let own = folders.iter().find(|path| path.to_string_lossy().ends_with("-walls") == walls).expect("a run");
        arrays(&std::fs::read_to_string(own.join("state_00000.vtu")).expect("written"))
    };
    assert_eq!(of(false), ["id [-]", "pressure [Pa]", "concentration [-]", "phase [-]", "mass [kg]", "velocity [m/s]"]);
    assert!(of(true).is_empty());
}

#[test]
fn a_wrong_interval_or_quantity_is_refused() {
    let place = Place::new();
    for (arguments, message) in [
        (&["--output-every", "0"][..], "`output.every` is 0, but must be a positive number"),
        (
            &["--output-every", "1", "--output-fields", "presure"],
            "`output.fields` is \"presure\", but must be one of id, mass",
        ),
    ] {
        let finished = place.run(&[CHEAP, arguments].concat()).code(2);
        let errors = String::from_utf8_lossy(&finished.get_output().stderr).into_owned();
        assert!(errors.contains(message), "{errors}");
    }
    assert!(place.names().is_empty(), "nothing was written");
}
