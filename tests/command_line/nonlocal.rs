//! The nonlocal law from files: scenes of the plane and of space, and a sweep over its amplitude.

use crate::command_line::program::Place;

/// Material of both scenes; grains nearly as large as the particles, so that the law's length is resolved.
const LAW: &str = "law = \"nonlocal-mu-i\", static_friction = 0.382, limiting_friction = 0.643, reference_inertia = 0.279, \
     grain_diameter = 0.004, grain_density = 2500.0, cooperativity = 0.48, relaxation_time = 1e-4, surface = \"vanishing\", \
     seed = 1e-6";

/// A block beside a plane of symmetry, as fields of a scene.
const BLOCK: &str = "spacing = 0.005\nduration = 0.2\ninterval = 0.02\npictures = 1\nmeasured = []\n\
     sides = { left = { mirror = 0.0 }, right = { open = 0.2 }, bottom = \"none\", top = \"none\" }\n\
     bodies = [{ shape = \"box\", lower = [0.0, 0.0], upper = [0.05, 0.05] }]\n\
     walls = [{ name = \"bed\", points = [[0.0, 0.0], [0.2, 0.0]] }]\n\
     gauges = [{ kind = \"front\", name = \"front\", from = [0.0, 0.0], to = [0.2, 0.0], thickness = 0.005 }]\n";

const BLOCK_IN_SPACE: &str = "spacing = 0.005\nduration = 0.1\ninterval = 0.02\npictures = 1\nmeasured = []\n\
     sides = { left = { mirror = 0.0 }, right = { open = 0.2 }, front = { mirror = 0.0 }, back = { mirror = 0.02 }, \
     bottom = \"none\", top = \"none\" }\n\
     bodies = [{ shape = \"box\", lower = [0.0, 0.0, 0.0], upper = [0.05, 0.02, 0.05] }]\n\
     walls = [{ name = \"bed\", quads = [[[0.0, 0.0, 0.0], [0.2, 0.0, 0.0], [0.2, 0.02, 0.0], [0.0, 0.02, 0.0]]] }]\n\
     gauges = []\n";

/// Balances of mass, momentum and energy hold: the exit code is 0.
#[test]
fn scenes_of_plane_and_space_take_the_law_and_close_their_balances() {
    let place = Place::new();
    for (case, scene) in [("scene", BLOCK), ("scene-space", BLOCK_IN_SPACE)] {
        let file =
            place.file("block.toml", &format!("case = \"{case}\"\nname = \"block\"\nmaterial = {{ {LAW} }}\n{scene}"));
        place.run(&[&file, "--quiet"]).code(0);
        let written = std::fs::read_to_string(place.path("out/case.toml")).expect("a case file");
        assert!(written.contains("nonlocal-mu-i") && written.contains("relaxation_time"), "{written}");
    }
}

/// The amplitude is a parameter like any other. Without it the block runs out like one of the local law, to a spacing; with it,
/// less far.
#[test]
fn a_sweep_varies_the_amplitude() {
    let place = Place::new();
    let local = LAW.replace("nonlocal-mu-i", "mu-i");
    let local = local.split(", cooperativity").next().expect("its first part");
    let file =
        place.file("local.toml", &format!("case = \"scene\"\nname = \"step\"\nmaterial = {{ {local} }}\n{BLOCK}"));
    place.run(&[&file, "--quiet"]).code(0);
    let results = std::fs::read_to_string(place.path("out/metrics.json")).expect("written");
    let results: serde_json::Value = serde_json::from_str(&results).expect("JSON");
    let metrics = results["metrics"].as_array().expect("metrics");
    let local = metrics.iter().find(|metric| metric["name"] == "front").and_then(|metric| metric["value"].as_f64());
    let local = local.expect("a front");

    let plan = format!(
        "design = \"grid\"\nmetrics = [\"front\"]\n[[cases]]\ncase = \"scene\"\n[cases.with]\nmaterial = {{ {LAW} }}\n{BLOCK}\
         [[vary]]\npath = \"material.cooperativity\"\nvalues = [0.0, 1.5]\n"
    );
    let plan = place.file("plan.toml", &plan);
    place.bagnold(&["--quiet", "sweep", &plan, "--out", "sweep"]).assert().code(0);
    let table = std::fs::read_to_string(place.path("sweep/results.csv")).expect("written");
    let fronts: Vec<f64> = table
        .lines()
        .filter(|row| row.contains(",front,"))
        .map(|row| row.rsplit(',').nth(3).and_then(|value| value.parse().ok()).expect("a front"))
        .collect();
    assert_eq!(fronts.len(), 2, "{table}");
    assert!((fronts[0] - local).abs() <= 0.005 + 1e-12, "{fronts:?} m beside {local} m");
    assert!(fronts[1] < fronts[0] - 0.005, "{fronts:?} m");
}
