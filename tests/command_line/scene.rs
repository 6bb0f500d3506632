//! Scenes of a user's own: those that are shipped run, and write what their gauges measured.

use crate::command_line::program::{Place, document};
use std::path::{Path, PathBuf};

pub(crate) fn shipped() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/examples/scenes");
    let entries = std::fs::read_dir(folder).expect("validation/examples/scenes").flatten();
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
        let short = ["--set", "duration=0.03", "--set", "interval=0.006", "--set", "measured=[]", "--quiet"];
        // hoppers differ by an angle: one of them is run as finely as it is shipped
        let is_another = ["hopper-48.toml", "hopper-64.toml"].iter().any(|name| file.ends_with(name));
        let coarse: &[&str] = if is_another { &["--set", "spacing=0.006"] } else { &[] };
        let finished = place.run(&[&[path.as_str()][..], &short, coarse].concat()).code(0);
        let told = String::from_utf8_lossy(&finished.get_output().stdout).into_owned();
        let force =
            "no interval for `depth` of before-the-obstacle, `mass_crossed` of overflow, `mean_force` of impact: vary";
        assert!(!path.ends_with("obstacle.toml") || told.contains(force), "{told}");
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
    let shipped = Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/examples/scenes");
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

pub(crate) fn walk(folder: &Path) -> Vec<PathBuf> {
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
fn grains_in_a_box_push_its_sides_with_the_given_part_of_their_weight() {
    let place = Place::new();
    let mut text = "case = \"scene\"\nname = \"box\"\nspacing = 0.005\nduration = 0.2\ninterval = 0.01\n\
        sides = { left = \"none\", right = \"none\", bottom = \"none\", top = \"none\" }\n\
        [[bodies]]\nshape = \"box\"\nlower = [0.0, 0.0]\nupper = [0.2, 0.1]\n"
        .to_owned();
    let walls = [
        ("left", "[0.0, 0.15], [0.0, 0.0]"),
        ("floor", "[0.0, 0.0], [0.2, 0.0]"),
        ("right", "[0.2, 0.0], [0.2, 0.15]"),
    ];
    for (name, points) in walls {
        text += &format!("[[walls]]\nname = \"{name}\"\nsurface = \"smooth\"\npoints = [{points}]\n");
        text += &format!("[[gauges]]\nkind = \"force\"\nname = \"{name}\"\nwall = \"{name}\"\n");
    }
    place.file("box.toml", &text);
    // without the field K_0 is 1
    for (setting, ratio) in [(None, 1.0), (Some("lateral_pressure_ratio=0.618"), 0.618)] {
        let set = setting.map_or(Vec::new(), |setting| vec!["--set", setting]);
        place.run(&[&["box.toml", "--quiet"], &set[..]].concat()).code(0);
        let hydrostatic = 0.5 * 1500.0 * 9.81 * 0.1 * 0.1;
        for wall in ["left", "right"] {
            let force = metric(&place, "mean_force", &format!("gauge={wall}")) / hydrostatic;
            // half a spacing of the height, of which the force is the square
            assert!((force / ratio - 1.0).abs() < 0.05, "{setting:?}: {force} of ρ g H²/2 on {wall}");
        }
        assert!((metric(&place, "mean_force", "gauge=floor") / (4.0 * hydrostatic) - 1.0).abs() < 0.02);
        assert!(metric(&place, "final_rms_speed", "scene=box") < 1e-3);
    }
}

#[test]
fn material_removed_by_walls_is_reported() {
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

/// A front that all material has passed below is told, with what to change.
#[test]
fn a_front_that_falls_back_is_told() {
    let place = Place::new();
    let scene = "case = \"scene\"\nname = \"away\"\nspacing = 0.005\nduration = 0.2\ninterval = 0.01\n\
        [sides]\nleft = \"none\"\nright = \"none\"\ntop = \"none\"\nbottom = { open = 0.0 }\n\
        [[bodies]]\nshape = \"box\"\nlower = [0.0, 0.05]\nupper = [0.06, 0.08]\n\
        [[gauges]]\nkind = \"front\"\nname = \"tip\"\nfrom = [0.0, 0.0]\nto = [0.2, 0.0]\nthickness = 0.01\n";
    let file = place.file("away.toml", scene);
    for (duration, is_told) in [("0.2", true), ("0.05", false)] {
        let finished = place.run(&[&file, "--set", &format!("duration={duration}")]);
        let told = String::from_utf8_lossy(&finished.get_output().stderr).into_owned();
        assert_eq!(told.contains("front `tip` of scene `away` falls back from 0.06"), is_told, "{duration}: {told}");
    }
    // a panel alone would take the label of another curve of its colour
    let table = std::fs::read_to_string(place.path("out/figures/gauges.csv")).expect("written");
    assert!(table.contains(",line,front [m],"), "{table}");
}

/// Plates that shear grains too fast for their particles, stop before the end or are pulled off are told.
#[test]
fn a_shear_cell_beyond_its_particles_is_told() {
    let place = Place::new();
    let scene = "case = \"scene\"\nname = \"cell\"\ngravity = [0.0, 0.0]\nspacing = 0.002\nduration = 0.2\ninterval = 0.02\n\
        pressure = 100.0\ngauges = []\nsides = { left = { periodic = 0.0 }, right = { periodic = 0.02 }, bottom = \"none\", top = \
        \"none\" }\nbodies = [{ shape = \"box\", lower = [0.0, 0.0], upper = [0.02, 0.02] }]\n[[walls]]\nname = \"lower\"\n\
        points = [[0.0, 0.0], [0.02, 0.0]]\n[[walls]]\nname = \"upper\"\npoints = [[0.02, 0.02], [0.0, 0.02]]\n\
        load = { direction = [0.0, -1.0], pressure = 100.0 }\n";
    let file = place.file("cell.toml", scene);
    let told = |motion: &str, direction: &str| {
        let motion = format!("walls[1].motion=[[0.0, 0.0, 0.0], {motion}]");
        let load = format!("walls[1].load.direction=[0.0, {direction}]");
        let finished = place.run(&[&file, "--set", &motion, "--set", &load]);
        String::from_utf8_lossy(&finished.get_output().stderr).into_owned()
    };
    let [coarse, ends, off] =
        ["above 0.2 friction comes out too small", "motion of wall `upper` ends at 0.1 s", "points away from"];
    for (motion, direction, expected) in [
        ("[0.2, 0.4, 0.0]", "-1.0", [true, false, false]),
        ("[0.2, 0.004, 0.0]", "-1.0", [false, false, false]),
        ("[0.1, 0.002, 0.0]", "-1.0", [false, true, false]),
        ("[0.2, 0.004, 0.0]", "1.0", [false, false, true]),
    ] {
        let text = told(motion, direction);
        assert_eq!([coarse, ends, off].map(|words| text.contains(words)), expected, "{motion}, {direction}: {text}");
    }
}

/// A box of some height `[m]` that falls onto a floor, with more fields before it.
fn falls_with(fields: &str, top: f64) -> String {
    format!(
        "case = \"scene\"\nname = \"falls\"\nspacing = 0.005\nduration = 0.15\ninterval = 0.01\n{fields}\
         [[bodies]]\nshape = \"box\"\nlower = [0.0, 0.1]\nupper = [0.04, {top}]\n\
         [[walls]]\nname = \"floor\"\npoints = [[-0.1, 0.0], [0.14, 0.0]]\n"
    )
}

#[test]
fn unlikely_units_and_speeds_and_gaps_are_warned_of_and_can_be_rejected() {
    let place = Place::new();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../validation/examples/scenes");
    let warned = |name: &str, setting: &str| {
        let file = folder.join(name).display().to_string();
        let rejected = place.run(&[&file, "--set", setting, "--deny-warnings"]).code(2);
        assert!(!place.path("out").exists());
        String::from_utf8_lossy(&rejected.get_output().stderr).into_owned()
    };
    let millimetres = warned("obstacle.toml", "material.grain_diameter=0.7");
    assert!(
        millimetres.contains("0.7 m, but usually 0.000001 to 0.1 m; 0.7 in millimetres is 7×10⁻⁴ m"),
        "{millimetres}"
    );
    assert!(millimetres.contains("175 particle spacings"), "{millimetres}");
    let soft = warned("obstacle.toml", "stiffness=20");
    assert!(soft.contains("a speed of 2.701 m/s is Mach 0.32, above 0.2"), "{soft}");
    assert!(soft.contains("set `stiffness = 50`"), "{soft}");
    let coarse = warned("hopper-36.toml", "spacing=0.015");
    assert!(coarse.contains("walls `left` and `right` is 2.4 particle spacings wide"), "{coarse}");
    // what a run has reached is told after it, and not of a stiff material
    let falls = falls_with("stiffness = 20.0\n", 0.12);
    let told = |stiffness: &str| {
        let file = place.file("falls.toml", &falls.replace("stiffness = 20.0", stiffness));
        // so soft an impact may fail the balance of energy as well
        let finished = place.run(&[&file]);
        String::from_utf8_lossy(&finished.get_output().stderr).into_owned()
    };
    let soft = told("stiffness = 20.0");
    assert!(
        soft.contains("scene=falls: the Mach number reaches 0.2") && soft.contains("multiply `stiffness` by "),
        "{soft}"
    );
    let stiff = told("stiffness = 200.0");
    assert!(!stiff.contains("the Mach number reaches"), "{stiff}");
    // the same in a file is not told once a setting corrects it; a single length is told before the particles are counted
    let upwards = falls_with("gravity = [0.0, 9.81]\n", 0.12);
    let file = place.file("falls.toml", &upwards);
    let told =
        String::from_utf8_lossy(&place.run(&[&file, "--deny-warnings"]).code(2).get_output().stderr).into_owned();
    assert!(told.contains("its last component is 9.81; for downwards give -9.81"), "{told}");
    place.run(&[&file, "--set", "gravity=[0.0, -9.81]", "--set", "duration=0.01", "--deny-warnings"]).code(0);
    let file = place.file("falls.toml", &falls_with("", 60_000.0));
    let told = String::from_utf8_lossy(&place.run(&[&file]).code(2).get_output().stderr).into_owned();
    let all = "`bodies[0]` reaches 60000 m, but all other parts 0.45 m; subtract a common offset";
    assert!(told.contains(all) && told.contains("above the limit of"), "{told}");
}

/// The value of a metric in the results that a run has written.
pub(crate) fn metric(place: &Place, name: &str, variant: &str) -> f64 {
    let text = std::fs::read_to_string(place.path("out").join("metrics.json")).expect("written");
    let results: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let metrics = results["metrics"].as_array().expect("metrics");
    let of = |metric: &&serde_json::Value| {
        metric["name"] == name && metric["variant"].as_str().is_some_and(|text| text.contains(variant))
    };
    metrics.iter().find(of).and_then(|metric| metric["value"].as_f64()).unwrap_or_else(|| panic!("no {name}: {text}"))
}

#[test]
fn a_gauge_at_an_opening_counts_what_the_inlet_feeds() {
    let place = Place::new();
    place.file("feed.csv", "t [s],rate [kg/(m s)]\n0,0\n0.02,6\n0.1,6\n0.12,0\n");
    let plane = "case = \"scene\"\nname = \"fed\"\nspacing = 0.005\nduration = 0.15\ninterval = 0.01\nbodies = []\n\
        [sides]\nleft = \"none\"\nright = { open = 0.1 }\nbottom = \"none\"\ntop = \"none\"\n\
        [[walls]]\nname = \"bed\"\npoints = [[-0.02, 0.0], [0.12, 0.0]]\n\
        [[inlets]]\nname = \"feed\"\nfrom = [0.0, 0.03]\nto = [0.0, 0.0]\ntable = \"feed.csv\"\n\
        [[gauges]]\nkind = \"flux\"\nname = \"opening\"\nfrom = [0.0, 0.1]\nto = [0.0, -0.1]\n\
        [[gauges]]\nkind = \"force\"\nname = \"on-the-rows\"\nwall = \"feed\"\n";
    place.file("plane.toml", plane);
    place.run(&["plane.toml", "--quiet"]).code(0);
    let fed = metric(&place, "mass_fed", "inlet=feed");
    // half a row of the integral, 0.6 kg/m
    assert!((fed - 0.6).abs() <= 0.5 * 1500.0 * 0.03 * 0.005 + 1e-12, "{fed} kg/m");
    assert!((metric(&place, "mass_crossed", "gauge=opening") / fed - 1.0).abs() < 1e-12);
    assert!(metric(&place, "mean_force", "gauge=on-the-rows") > 0.0);
    let written = std::fs::read_to_string(place.path("out").join("case.toml")).expect("a case file");
    assert!(written.contains("rates = [[0.0, 0.0], [0.02, 6.0], [0.1, 6.0], [0.12, 0.0]]"), "{written}");

    // onto a floor, between planes of symmetry
    let space = "case = \"scene-space\"\nname = \"pushed\"\nspacing = 0.008\nduration = 0.12\ninterval = 0.01\nbodies = []\n\
        [sides]\nleft = \"none\"\nright = \"none\"\nfront = { mirror = 0.0 }\nback = { mirror = 0.032 }\n\
        bottom = \"none\"\ntop = \"none\"\n\
        [[walls]]\nname = \"floor\"\nquads = [[[-0.05, 0.0, 0.0], [0.1, 0.0, 0.0], [0.1, 0.032, 0.0], [-0.05, 0.032, 0.0]]]\n\
        [[inlets]]\nname = \"pushed\"\ncorners = [[0.0, 0.0, 0.0], [0.0, 0.032, 0.0], [0.0, 0.0, 0.032]]\nrate = 0.6\n\
        [[gauges]]\nkind = \"flux\"\nname = \"opening\"\ncorners = [[0.0, -1.0, -1.0], [0.0, 1.0, -1.0], [0.0, -1.0, 1.0]]\n";
    place.file("space.toml", space);
    place.run(&["space.toml", "--quiet"]).code(0);
    let fed = metric(&place, "mass_fed", "inlet=pushed");
    assert!((fed - 0.072).abs() <= 0.5 * 1500.0 * 0.032 * 0.032 * 0.008 + 1e-12, "{fed} kg");
    assert!((metric(&place, "mass_crossed", "gauge=opening") / fed - 1.0).abs() < 1e-12);
}

/// A feed as a logger writes it: two rows of a time are a jump.
#[test]
fn a_staircase_of_rates_is_fed_as_its_rows_stand_and_ends_as_it_is_told() {
    let place = Place::new();
    let scene = "case = \"scene\"\nname = \"staircase\"\nspacing = 0.005\nduration = 0.3\ninterval = 0.005\nbodies = []\n\
        [sides]\nleft = \"none\"\nright = { open = 0.12 }\nbottom = \"none\"\ntop = \"none\"\n\
        [[walls]]\nname = \"bed\"\npoints = [[-0.03, 0.0], [0.12, 0.0]]\n\
        [[inlets]]\nname = \"feed\"\nfrom = [0.0, 0.02]\nto = [0.0, 0.0]\n";
    let half_a_row = 0.5 * 1500.0 * 0.02 * 0.005 + 1e-12;
    let fed = |rows: &str, told: &str, mass: f64| {
        place.file("stairs.toml", &format!("{scene}{rows}\n"));
        let finished = place.run(&["stairs.toml"]).code(0);
        let errors = String::from_utf8_lossy(&finished.get_output().stderr).into_owned();
        let first = errors.lines().next().unwrap_or_default();
        assert!(first.contains(told), "{told}: {errors}");
        let fed = metric(&place, "mass_fed", "inlet=feed");
        assert!((fed - mass).abs() <= half_a_row, "{rows}: {fed} for {mass} kg/m");
    };
    let jumps = "rates = [[0.0, 2.0], [0.1, 2.0], [0.1, 6.0], [0.2, 6.0], [0.2, 0.0]]";
    fed(jumps, "inlet `feed` feeds 0 kg/(m s) after 0.2 s", 0.8);
    let late = "rates = [[0.1, 2.0], [0.2, 6.0]]\nends = ";
    fed(&format!("{late}\"hold\""), "feeds 2 kg/(m s) before 0.1 s; inlet `feed` feeds 6 kg/(m s) after 0.2 s", 1.2);
    fed(&format!("{late}\"zero\""), "feeds 0 kg/(m s) before 0.1 s; inlet `feed` feeds 0 kg/(m s) after 0.2 s", 0.4);
    fed("rates = [[0.0, 2.0], [0.3, 2.0]]\nends = \"error\"", "spacing 0.005 m", 0.6);
    // plateaux on both sides of a jump, by the mass of 11 and 32 rows
    let fine = scene.replace("0.005", "0.00125").replace("duration = 0.3", "duration = 0.4");
    place.file("feed.csv", "t [s],rate [kg/(m s)]\n0,2\n0.2,2\n0.2,6\n0.4,6\n");
    place.file("fine.toml", &format!("{fine}table = \"feed.csv\"\n"));
    place.run(&["fine.toml", "--quiet"]).code(0);
    let table = std::fs::read_to_string(place.path("out/tables/gauges-scene-staircase.csv")).expect("written");
    let rows = table.lines().skip(1).map(|line| line.split(',').map(|cell| cell.parse().expect("a number")).collect());
    let rows: Vec<Vec<f64>> = rows.collect();
    for (from, to, rate) in [(0.0, 0.2, 2.0), (0.2, 0.4, 6.0)] {
        let points: Vec<(f64, f64)> =
            rows.iter().filter(|row| (from..=to).contains(&row[0])).map(|row| (row[0], row[1])).collect();
        let mean = |of: &dyn Fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
        let (x, y) = (mean(&|point| point.0), mean(&|point| point.1));
        let slope = mean(&|point| (point.0 - x) * (point.1 - y)) / mean(&|point| (point.0 - x).powi(2));
        assert!((slope / rate - 1.0).abs() < 0.03, "{slope} of {rate} kg/(m s) from {from} to {to} s");
    }
    // the rows of another file would not be read
    let other = place.run(&["fine.toml", "--quiet", "--set", "inlets[0].table=\"other.csv\""]).code(2);
    let said = String::from_utf8_lossy(&other.get_output().stderr).into_owned();
    assert!(
        said.contains("`inlets[0].table`: cannot be set, because its file has been read with the case file"),
        "{said}"
    );
}

/// The front of a block that is thrown is that of no column, and has no interval of one.
#[test]
fn only_a_block_that_stands_has_an_interval_of_its_front() {
    let place = Place::new();
    let quoted = |velocity: &str| {
        let scene = format!(
            "case = \"scene\"\nname = \"block\"\nspacing = 0.01\nduration = 0.2\ninterval = 0.02\n\
             sides = {{ left = \"none\", right = \"none\", bottom = \"none\", top = \"none\" }}\n\
             bodies = [{{ shape = \"box\", lower = [0.0, 0.0], upper = [0.1, 0.1], velocity = {velocity} }}]\n\
             walls = [{{ name = \"floor\", points = [[-0.5, 0.0], [0.7, 0.0]] }}]\n\
             gauges = [{{ kind = \"front\", name = \"front\", from = [0.0, 0.0], to = [0.6, 0.0], thickness = 0.02 }}]\n"
        );
        place.file("block.toml", &scene);
        let finished = place.run(&["block.toml", "--quiet"]).code(0);
        String::from_utf8_lossy(&finished.get_output().stdout).contains("`front` to quote")
    };
    assert_eq!([quoted("[0.0, 0.0]"), quoted("[1.0, 0.0]")], [true, false]);
}

/// The impact of a fall is over within a fifth of such a sample.
#[test]
fn a_fall_that_is_sampled_coarsely_keeps_its_ledger() {
    let place = Place::new();
    let drop = "case = \"scene\"\nname = \"drop\"\nspacing = 0.01\nduration = 0.5\ninterval = 0.05\ngauges = []\n\
        sides = { left = \"none\", right = \"none\", bottom = \"none\", top = \"none\" }\n\
        bodies = [{ shape = \"box\", lower = [0.0, 0.2], upper = [0.1, 0.3] }]\n\
        walls = [{ name = \"floor\", points = [[-0.5, 0.0], [0.6, 0.0]] }]\n";
    place.file("drop.toml", drop);
    for settings in [&[][..], &["--set", "interval=0.1"], &["--set", "interval=0.004"]] {
        place.run(&[&["drop.toml", "--quiet"], settings].concat()).code(0);
    }
}

#[test]
fn a_syrup_by_implicit_steps_collapses_as_by_explicit_ones_in_fewer() {
    let place = Place::new();
    let syrup = "case = \"scene\"\nname = \"syrup\"\nspacing = 0.005\nduration = 0.4\ninterval = 0.02\n\
        [sides]\nleft = { mirror = 0.0 }\nright = \"none\"\nbottom = \"none\"\ntop = \"none\"\n\
        [material]\nlaw = \"newtonian\"\nviscosity = 200.0\n[bulk]\nsolid_fraction = 1.0\nbulk_density = 1400.0\n\
        [[bodies]]\nshape = \"box\"\nlower = [0.0, 0.0]\nupper = [0.06, 0.06]\n\
        [[walls]]\nname = \"bed\"\npoints = [[0.0, 0.0], [0.2, 0.0]]\n\
        [[gauges]]\nkind = \"depth\"\nname = \"middle\"\nat = [0.01, 0.0]\nwidth = 0.02\n\
        [[gauges]]\nkind = \"force\"\nname = \"weight\"\nwall = \"bed\"\n";
    place.file("syrup.toml", syrup);
    let by = |step: &str| {
        let setting = format!("numerics.viscous_step={step}");
        place.run(&["syrup.toml", "--quiet", "--set", &setting]).code(0);
        let text = std::fs::read_to_string(place.path("out").join("metrics.json")).expect("written");
        let results: serde_json::Value = serde_json::from_str(&text).expect("JSON");
        let steps = results["runs"][0]["steps"].as_u64().expect("steps");
        (metric(&place, "depth", "gauge=middle"), metric(&place, "mean_force", "gauge=weight"), steps)
    };
    let (explicit, implicit) = (by("\"explicit\""), by("\"implicit\""));
    println!("{explicit:?} and {implicit:?}");
    assert!(explicit.0 < 0.055, "it has sunk, from 0.06 m: {explicit:?}");
    assert!(
        (implicit.0 / explicit.0 - 1.0).abs() < 0.02 && (implicit.1 / explicit.1 - 1.0).abs() < 0.01,
        "{implicit:?}"
    );
    assert!(4 * implicit.2 < explicit.2, "{implicit:?} of {explicit:?}");
}

/// Edges and corners hold with all of their walls, whose kernels lack most neighbours.
#[test]
fn thick_liquids_bear_explicit_steps_in_the_edges_of_tanks() {
    let place = Place::new();
    let head = |case: &str, jitter: f64| {
        format!(
            "case = \"{case}\"\nname = \"thick\"\nspacing = 0.01\nduration = 0.02\ninterval = 0.004\njitter = {jitter}\n\
             [numerics]\nviscous_step = \"explicit\"\n[bulk]\nsolid_fraction = 1.0\nbulk_density = 1000.0\n"
        )
    };
    let law = |viscosity: f64| format!("[material]\nlaw = \"newtonian\"\nviscosity = {viscosity}\n");
    let plane = "[[bodies]]\nshape = \"box\"\nlower = [0.0, 0.0]\nupper = [0.1, 0.05]\n\
        [[walls]]\nname = \"tank\"\npoints = [[0.0, 0.2], [0.0, 0.0], [0.1, 0.0], [0.1, 0.2]]\n";
    let side = |a: &str, b: &str| format!("[[{a}, 0.0], [{b}, 0.0], [{b}, 0.1], [{a}, 0.1]], ");
    let [a, b, c, d] = ["0.0, 0.0", "0.06, 0.0", "0.06, 0.06", "0.0, 0.06"];
    let space = format!(
        "[[bodies]]\nshape = \"box\"\nlower = [0.0, 0.0, 0.0]\nupper = [0.06, 0.06, 0.05]\n[[walls]]\nname = \"tank\"\n\
         quads = [{}{}{}{}[[{a}, 0.0], [{b}, 0.0], [{c}, 0.0], [{d}, 0.0]]]\n",
        side(b, a),
        side(c, b),
        side(d, c),
        side(a, d)
    );
    place.file("plane.toml", &format!("{}{}{plane}", head("scene", 0.3), law(500.0)));
    place.file("space.toml", &format!("{}{}{space}", head("scene-space", 0.0), law(5.0)));
    place.run(&["plane.toml", "--quiet"]).code(0);
    place.run(&["space.toml", "--quiet"]).code(0);
}

#[test]
fn a_table_that_show_documents_can_be_added_to_a_scene() {
    let place = Place::new();
    let shown = place.bagnold(&["show", "scene"]).output().expect("started");
    let shown = String::from_utf8_lossy(&shown.stdout).into_owned();
    // a file is completed, and another law shown with all of its parameters
    place.file("mine.toml", "case = \"film\"\nresolution = 17\n");
    let mine = place.bagnold(&["show", "mine.toml", "--set", "material.viscosity=0.25"]).assert().code(0);
    let mine = String::from_utf8_lossy(&mine.get_output().stdout).into_owned();
    assert!(mine.contains("\nresolution = 17") && mine.contains("\nviscosity = 0.25  # dynamic viscosity"), "{mine}");
    let law = place.bagnold(&["show", "scene", "--set", "material.law=bingham"]).assert().code(2);
    let law = String::from_utf8_lossy(&law.get_output().stderr).into_owned();
    assert!(law.contains("add `yield_stress` (") && law.contains("`plastic_viscosity` ("), "{law}");
    let measured = shown.split("\n\n").find(|table| table.starts_with("# [[measured]]")).expect("documented");
    let added: String = measured.lines().map(|line| format!("{}\n", line.trim_start_matches("# "))).collect();
    let added = added.replace("gauge = \"…\"", "gauge = \"front\"").replace("limit = 0.0", "limit = 200.0");
    place.file("added.toml", &(shown.replace("measured = []", "") + "\n" + &added));
    let refused = place.bagnold(&["run", "added.toml", "--quiet"]).assert().code(2);
    let said = String::from_utf8_lossy(&refused.get_output().stderr).into_owned();
    assert!(said.contains("`measured[0].limit` is 200, but must be between 0 and 100"), "{said}");
}

#[test]
fn a_scene_is_drawn_as_it_starts_also_one_that_is_refused() {
    let place = Place::new();
    let slope = "case = \"scene\"\nname = \"slope\"\nspacing = 0.01\n\
        [[bodies]]\nshape = \"box\"\nlower = [0.0, 0.0]\nupper = [0.3, 0.3]\n\
        [[walls]]\nname = \"terrain\"\npoints = [[-0.1, 0.3], [0.5, 0.0]]\n";
    place.file("slope.toml", slope);
    place.run(&["slope.toml", "--quiet"]).code(2);
    let shown = place.bagnold(&["show", "slope.toml", "--picture", "setup.svg"]).output().expect("started");
    let said = String::from_utf8_lossy(&shown.stdout).into_owned();
    // of 30 by 30 sites those below the line from (0, 0.25) to (0.3, 0.1)
    assert!(
        shown.status.success() && said.contains("Of 900 lattice sites inside the bodies, 360 get particles"),
        "{said}"
    );
    let picture = std::fs::read_to_string(place.path("setup.svg")).expect("drawn");
    assert!(picture.contains("<svg") && picture.contains("terrain"));
    for (case, file) in [("film", "setup.png"), ("slope.toml", "setup.pdf")] {
        let refused = place.bagnold(&["show", case, "--picture", file]).output().expect("started");
        assert_eq!(refused.status.code(), Some(2), "{case} into {file}");
        assert!(!place.path(file).exists());
    }
}

/// A mirrored silo with 8 particles in the opening. Finer ones (24 and 48) extrapolate to 100.4 kg/(m s) at spacing zero. An edge that
/// keeps particles half a spacing away gives 85.8, a lip that shears the jet which leaves it 79.6.
#[test]
fn a_silo_discharges_through_its_whole_opening() {
    let place = Place::new();
    let silo = "case = \"scene\"\nname = \"silo\"\nspacing = 0.00783125\nduration = 0.42\ninterval = 0.03\nstiffness = 50.0\n\
        jitter = 0.05\nmeasured = []\n\
        [material]\nlaw = \"mu-i\"\nstatic_friction = 0.32\nlimiting_friction = 0.6\nreference_inertia = 0.4\n\
        grain_diameter = 0.0033333\ngrain_density = 2500.0\n[bulk]\nsolid_fraction = 0.6\n\
        [sides]\nleft = { mirror = 0.0 }\nright = \"none\"\nbottom = { open = -0.06 }\ntop = \"none\"\n\
        [[bodies]]\nshape = \"box\"\nlower = [0.0, 0.0]\nupper = [0.125, 0.225]\n\
        [[walls]]\nname = \"right\"\npoints = [[0.031325, -0.01], [0.031325, 0.0], [0.125, 0.0], [0.125, 0.275]]\n\
        [[gauges]]\nkind = \"flux\"\nname = \"opening\"\nfrom = [0.061325, -0.012]\nto = [0.0, -0.012]\n";
    place.file("silo.toml", silo);
    let crossed = |duration: &str| {
        place.run(&["silo.toml", "--quiet", "--set", duration]).code(0);
        metric(&place, "mass_crossed", "gauge=opening")
    };
    // the half that is simulated, twice
    let rate = 2.0 * (crossed("duration=0.42") - crossed("duration=0.15")) / 0.27;
    assert!((88.0..101.0).contains(&rate), "{rate} kg/(m s)");
}
