//! Scenes of a user's own: those that are shipped run, and write what their gauges measured.

use crate::program::{Place, document};
use std::path::{Path, PathBuf};

fn shipped() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/scenes");
    let entries = std::fs::read_dir(folder).expect("validation/scenes").flatten();
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.path()).collect();
    files.retain(|path| path.extension().is_some_and(|ending| ending == "toml"));
    files.sort();
    files
}

#[test]
fn every_shipped_scene_runs_and_closes_its_balances() {
    let files = shipped();
    assert!(files.len() >= 8, "{files:?}");
    for file in files {
        let place = Place::new();
        let path = file.display().to_string();
        // a few steps; what is measured later cannot be compared with them
        let short = ["--set", "duration=0.1", "--set", "interval=0.02", "--set", "measured=[]", "--quiet"];
        place.run(&[&[path.as_str()][..], &short].concat()).code(0);
        let name = file.file_stem().expect("a name").to_string_lossy().into_owned();
        let folder = place.path("out");
        let tables = walk(&folder).into_iter().filter(|path| path.extension().is_some_and(|ending| ending == "csv"));
        let texts: Vec<String> = tables.map(|path| std::fs::read_to_string(path).expect("text")).collect();
        let series = texts.iter().find(|text| text.starts_with("t [s],mass in the scene [kg")).expect("a series");
        assert!(series.lines().count() >= 6, "{name}: {series}");
        let heading = series.lines().next().unwrap_or_default();
        assert!(heading.split(',').all(|column| column.ends_with(']')), "{name}: every column has a unit: {heading}");
    }
}

#[test]
fn a_scene_is_known_by_the_triangles_of_its_mesh() {
    let place = Place::new();
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/scenes");
    let text = |name: &str| std::fs::read_to_string(shipped.join(name)).expect("a shipped file");
    std::fs::write(place.path("funnel.toml"), text("funnel.toml")).expect("writable");
    let simulated = |mesh: &str| {
        std::fs::write(place.path("funnel.stl"), mesh).expect("writable");
        let short = ["--set", "duration=0.02", "--set", "interval=0.01", "--set", "spacing=0.016", "--quiet"];
        place.run(&[&["funnel.toml"], &short[..]].concat()).code(0);
        let results = walk(&place.path("store")).into_iter().filter(|path| path.is_file()).count();
        let written =
            walk(&place.path("out")).into_iter().find(|path| path.ends_with("case.toml")).expect("a case file");
        (results, std::fs::read_to_string(written).expect("text"))
    };
    let mesh = text("funnel.stl");
    let (first, written) = simulated(&mesh);
    assert!(first > 0 && written.contains("mesh = \"funnel.stl\"") && written.contains("triangles = [[["), "{written}");
    assert_eq!(simulated(&mesh).0, first, "the same mesh is the same run");
    assert!(simulated(&mesh.replace("-0.032", "-0.034")).0 > first, "another mesh is another run");
    // the case file that was written repeats the mesh: its own file is not needed any more
    std::fs::remove_file(place.path("funnel.stl")).expect("there");
    std::fs::write(place.path("again.toml"), written).expect("writable");
    place.run(&["again.toml", "--quiet"]).code(0);
}

fn walk(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("readable").flatten();
    entries.flat_map(|entry| if entry.path().is_dir() { walk(&entry.path()) } else { vec![entry.path()] }).collect()
}

#[test]
fn water_in_a_tank_comes_to_rest_straight_and_turned() {
    let place = Place::new();
    let text = |body: &str, wall: &str| {
        format!(
            "case = \"scene\"\nname = \"tank\"\nspacing = 0.005\nduration = 5.0\ninterval = 0.05\nstiffness = 200.0\n\
             [material]\nlaw = \"newtonian\"\nviscosity = 0.001\n[bulk]\nsolid_fraction = 1.0\nbulk_density = 1000.0\n\
             [[bodies]]\n{body}\n[[walls]]\nname = \"tank\"\npoints = {wall}\n"
        )
    };
    let straight = text(
        "shape = \"box\"\nlower = [0.0, 0.0]\nupper = [0.1, 0.1]",
        "[[0.0, 0.2], [0.0, 0.0], [0.1, 0.0], [0.1, 0.2]]",
    );
    // a tank turned by 30°, with a level surface at 8 cm
    let turned = text(
        "shape = \"polygon\"\npoints = [[0.0, 0.0], [0.138564, 0.08], [-0.046188, 0.08]]",
        "[[-0.1, 0.173205], [0.0, 0.0], [0.173205, 0.1]]",
    );
    // of √(g H): what is left of the start's displacements; with the kernel correction of the forces 0.6 and 0.3 %
    for (file, most) in [(straight, 0.002 * 0.99), (turned, 0.003 * 0.89)] {
        let file = place.file("tank.toml", &file);
        let metrics = document(&place.run(&[&file, "--json", "--quiet"])).metrics;
        let value = |name: &str| metrics.iter().find(|metric| metric.name == name).and_then(|metric| metric.value);
        let (speed, given) = (value("final_rms_speed"), value("correction_work"));
        assert!(speed.is_some_and(|speed| speed < most), "{speed:?} m/s");
        assert!(given.is_some_and(|given| given.abs() < 0.01), "{given:?} % by corrections");
    }
}

#[test]
fn what_walls_take_of_the_bodies_is_told() {
    let place = Place::new();
    let text = |lower: f64| {
        format!(
            "case = \"scene\"\nname = \"cut\"\nspacing = 0.01\nduration = 0.01\ninterval = 0.005\n\
             cut_at_most = 0.5\n[[bodies]]\nshape = \"box\"\nlower = [0.0, {lower}]\nupper = [0.1, 0.1]\n[[walls]]\nname = \"floor\"\npoints = [[-0.1, 0.0], [0.2, 0.0]]\n"
        )
    };
    // rows of ten particles; the dummy particles fill four rows, behind which a wall takes what a body has too
    for (lower, taken) in [(0.0, 0.0), (-0.03, 100.0 * 3.0 / 13.0), (-0.1, 50.0)] {
        let file = place.file("cut.toml", &text(lower));
        let metrics = document(&place.run(&[&file, "--json", "--quiet"])).metrics;
        let cut_off = metrics.iter().find(|metric| metric.name == "cut_off").and_then(|metric| metric.value);
        assert!((cut_off.expect("a number") - taken).abs() < 1e-9, "{cut_off:?}");
    }
}
