//! Each bad input: its exact message, exit code 2, nothing printed and nothing written.

use crate::program::Place;

/// Runs, and expects this message and no result.
pub(crate) fn refused(place: &Place, arguments: &[&str], message: &str) {
    place.run(arguments).code(2).stdout("").stderr(format!("error: {message}\n"));
    assert!(!place.path("out").exists(), "nothing is written");
    assert!(!place.path("store").exists(), "nothing is simulated");
}

#[test]
fn an_unknown_field() {
    let place = Place::new();
    let file = place.file("my.toml", "case = \"film\"\nslope_angel = 12\n");
    refused(
        &place,
        &[&file],
        &format!(
            "{file}: unknown field `slope_angel`; did you mean `slope_angle`? `bagnold show film` prints all fields"
        ),
    );
    let file = place.file("my.toml", "case = \"bagnold\"\n[material]\ngrain_diametre = 5e-4\n");
    refused(
        &place,
        &[&file],
        &format!(
            "{file}: unknown field `material.grain_diametre`; did you mean `material.grain_diameter`? `bagnold show bagnold` prints all fields"
        ),
    );
}

#[test]
fn a_negative_diameter() {
    let place = Place::new();
    let file = place.file("my.toml", "case = \"bagnold\"\n[material]\ngrain_diameter = -0.0005\n");
    let message = "`material.grain_diameter` is -0.0005, but must be finite and greater than 0; give the diameter in metres; 0.0005 for 0.5 mm";
    refused(&place, &[&file], &format!("{file}: {message}"));
    refused(&place, &["bagnold", "--set", "material.grain_diameter=-5e-4"], message);
}

#[test]
fn a_slope_angle_outside_its_range() {
    let place = Place::new();
    let message = |origin: &str, field: &str, value: &str| {
        format!(
            "{origin}`{field}` is {value}, but must be inside (−90°, 90°); give the angle between the slope and the horizontal in degrees"
        )
    };
    let file = place.file("my.toml", "case = \"film\"\nslope_angle = 90\n");
    refused(&place, &[&file], &message(&format!("{file}: "), "slope_angle", "90"));
    refused(&place, &["film", "--set", "slope_angle=-90.5"], &message("", "slope_angle", "-90.5"));
    refused(&place, &["film", "--set", "slope_angle=nan"], &message("", "slope_angle", "NaN"));
    refused(&place, &["bagnold", "--set", "slope_angles=[24, 95]"], &message("", "slope_angles[1]", "95"));
}

#[test]
fn an_unreadable_file() {
    let place = Place::new();
    refused(
        &place,
        &["no-such.toml"],
        "no-such.toml: cannot be read (no such file or directory); check the path and its permissions",
    );
    std::fs::create_dir(place.path("folder.toml")).expect("writable");
    refused(
        &place,
        &["folder.toml"],
        "folder.toml: cannot be read (is a directory); check the path and its permissions",
    );
    std::fs::write(place.path("binary.toml"), [0xff, 0xfe, 0x00]).expect("writable");
    refused(
        &place,
        &["binary.toml"],
        "binary.toml: cannot be read (text in UTF-16, not in UTF-8); save it as plain text in UTF-8",
    );
}

#[test]
fn an_output_folder_with_somebody_elses_files() {
    let place = Place::new();
    let out = place.path("thesis");
    std::fs::create_dir(&out).expect("writable");
    std::fs::write(out.join("chapter.tex"), "years of work").expect("writable");
    for command in [&["run", "film"][..], &["report", "--cases", "film"]] {
        place.bagnold(&[command, &["--out", "thesis"]].concat()).assert().code(2).stdout("").stderr(
            "error: output folder thesis: not empty and not written by bagnold, so nothing was changed; name an empty or new folder with --out\n",
        );
        assert_eq!(std::fs::read_to_string(out.join("chapter.tex")).expect("still there"), "years of work");
        assert_eq!(std::fs::read_dir(&out).expect("readable").count(), 1);
    }
    assert!(!place.path("store").exists(), "nothing is simulated");
}

#[test]
fn a_setting_of_a_wrong_type() {
    let place = Place::new();
    refused(
        &place,
        &["film", "--set", "resolution=many"],
        "`--set resolution=many`: `resolution` is many, but must be a whole number that is not negative; `bagnold show film` prints a valid value",
    );
    refused(
        &place,
        &["film", "--set", "density=true"],
        "`--set density=true`: `density` is true, but must be a number; `bagnold show film` prints a valid value",
    );
}

#[test]
fn a_setting_of_a_wrong_path_or_form() {
    let place = Place::new();
    refused(
        &place,
        &["film", "--set", "newtonian.viscocity=1"],
        "`--set newtonian.viscocity=1`: unknown field `newtonian.viscocity`; did you mean `newtonian.viscosity`? `bagnold show film` prints all fields",
    );
    refused(
        &place,
        &["film", "--set", "slope_angle.degrees=1"],
        "`--set slope_angle.degrees=1`: unknown field `slope_angle.degrees`; did you mean `slope_angle`? `bagnold show film` prints all fields",
    );
    refused(
        &place,
        &["film", "--set", "xyz=1"],
        "`--set xyz=1`: unknown field `xyz`; `bagnold show film` prints all fields",
    );
    place.run(&["film", "--set", "resolution"]).code(2).stdout("").stderr(
        "error: `--set resolution` must have the form path=value; for example `--set bingham.plastic_viscosity=0.5`\n",
    );
}

#[test]
fn an_unknown_case() {
    let place = Place::new();
    refused(&place, &["bagnald"], "unknown case `bagnald`; did you mean `bagnold`? `bagnold list` prints all cases");
    let file = place.file("my.toml", "case = \"flim\"\n");
    refused(
        &place,
        &[&file],
        &format!("{file}: unknown case `flim`; did you mean `film`? `bagnold list` prints all cases"),
    );
    for command in [&["show", "hydrostatics"][..], &["report", "--cases", "film,hydrostatics", "--out", "out"]] {
        place.bagnold(command).assert().code(2).stdout("").stderr(
            "error: unknown case `hydrostatics`; did you mean `hydrostatic`? `bagnold list` prints all cases\n",
        );
    }
    assert!(!place.path("out").exists());
}

#[test]
fn missing_earlier_report() {
    let place = Place::new();
    let path = std::path::Path::new("missing").join("cases");
    place.bagnold(&["report", "--cases", "film", "--out", "out", "--against", "missing"]).assert().code(2).stdout("").stderr(
        format!("error: failed to compare with {}: it holds none of the cases; give --against the folder of an earlier report of the same tier and cases\n", path.display()),
    );
    assert!(!place.path("out").exists() && !place.path("store").exists());
}

#[test]
fn invalid_command_lines() {
    let place = Place::new();
    for arguments in [&["run"][..], &["run", "film", "--tier", "papre"], &["run", "film", "--threads", "0"], &["fly"]] {
        place.bagnold(arguments).assert().code(2).stdout("");
    }
}

#[test]
fn columns_that_nobody_can_wait_for_and_windows_that_do_not_fit() {
    let place = Place::new();
    refused(
        &place,
        &["column-round", "--set", "columns=[{aspect_ratio=1.0,resolution=900}]"],
        "`columns[0].resolution` is 900, but must be chosen for at most 5e6 particles per column; the column of aspect ratio 1 would have 5.7e8: choose a smaller resolution",
    );
    refused(
        &place,
        &["bagnold", "--set", "averaging_time=2", "--set", "duration_factor=0.2"],
        "`averaging_time` is 2, but must be between 0 and 0.3; the window must fit into the shortest run: choose a shorter one or a larger `duration_factor`",
    );
}
