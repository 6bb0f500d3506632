//! Reference values that files hold as numbers, by the route that they came from: what material points extrapolate to, and the travelling front
//! that `fed-slope` is compared with.

use super::submerged_layer::{SubmergedColumn, SubmergedLayer};
use bagnold_harness::evidence::shipped_table;
use bagnold_reference::collapse::{CodeQuantity, OtherCodes, PLANAR_CODES, ROUND_CODES, RoughIncline, SLOPE_CODES};
use bagnold_reference::grains::{GLASS_BEADS, GLASS_BEADS_FLOW_RULE};
use bagnold_reference::one_dimension::{BagnoldProfile, NonlocalLayer};
use bagnold_solver::material::rheology::field::FieldBoundary;
use std::path::Path;

fn text(path: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Kinetic energy over ½ M g h_0 of a stored run of material points at a time `[ms]`.
fn kinetic_energy(folder: &str, time: f64) -> f64 {
    let table = text(&format!("tests/foreign/mpm/output/{folder}/series.csv"));
    let heading: Vec<&str> = table.lines().next().unwrap_or_default().split(';').collect();
    let column = heading.iter().position(|name| *name == "kinetic_over_Mgh0").expect("a column of energies");
    let point = |line: &str| -> (f64, f64) {
        let cells: Vec<f64> = line.split(';').map(|cell| cell.parse().expect("a number")).collect();
        (cells[0], 2.0 * cells[column])
    };
    let points: Vec<(f64, f64)> = table.lines().skip(1).map(point).collect();
    let after = points.iter().position(|point| point.0 >= time).expect("a run that lasts as long");
    let [(from, low), (to, high)] = [points[after - 1], points[after]];
    low + (high - low) * (time - from) / (to - from)
}

/// The finest energy and once more the last difference: an error of first order in the spacing.
#[test]
fn energies_of_other_codes_follow_from_stored_runs() {
    let flows: [(&OtherCodes, f64, f64, f64, &str, &str); 5] = [
        (&PLANAR_CODES, 1.0, 0.1, 2.0, "a1-40-points", "a1-80-points"),
        (&PLANAR_CODES, 3.0, 0.3, 2.0, "a3", "a3-40-points"),
        (&ROUND_CODES, 0.9, 0.09, 2.0, "round-a0.9-40-points", "round-a0.9-80-points"),
        (&ROUND_CODES, 3.0, 0.3, 2.0, "round-a3", "round-a3-40-points"),
        (&SLOPE_CODES, 22.0, 0.14, 4.0, "slope-22-60-points", "slope-22-120-points"),
    ];
    for (codes, flow, height, time, coarse, fine) in flows {
        let milliseconds = 1e3 * time * (height / 9.81_f64).sqrt();
        let [coarse, fine] = [coarse, fine].map(|folder| kinetic_energy(folder, milliseconds));
        let (value, _) = codes.at(flow, CodeQuantity::KineticEnergy, time).expect("a value");
        let expected = 2.0 * fine - coarse;
        assert!((value / expected - 1.0).abs() < 0.015, "{flow}: {value} instead of {expected}");
    }
}

/// A front of the local law that travels as it is: uniform layer h_∞ `[m]`, mean velocity u `[m/s]`, and the thickness over h_∞ behind
/// the place of half of it, by (1 + u²/(4 g cosθ h)) dh/dx = tanθ − μ(I), I ∝ h^(−3/2).
struct TravellingFront {
    thickness: f64,
    velocity: f64,
    /// Behind the place of half of the thickness, every hundredth of h_∞.
    profile: Vec<f64>,
}

impl TravellingFront {
    fn of(gravity: [f64; 2], discharge: f64) -> Self {
        let (grains, slope, weight) = (GLASS_BEADS.law, -gravity[0] / gravity[1], -gravity[1]);
        let range = grains.limiting_friction - grains.static_friction;
        let inertia = (slope - grains.static_friction) / (grains.limiting_friction - slope);
        let rate = 0.4 * grains.reference_inertia * inertia / grains.grain_diameter;
        let thickness = (discharge / (rate * (GLASS_BEADS.solid_fraction * weight).sqrt())).powf(0.4);
        let velocity = discharge / thickness;
        let squared_froude = velocity * velocity / (weight * thickness);
        let rise = |y: f64| {
            let friction = grains.static_friction + range / (1.0 + y.powf(1.5) / inertia);
            (friction - slope) / (1.0 + 0.25 * squared_froude / y)
        };
        let mut profile = vec![0.5];
        for place in 0..12_000 {
            let y = profile[place];
            profile.push(y + 0.01 * rise(y + 0.005 * rise(y)));
        }
        Self { thickness, velocity, profile }
    }

    /// Mean thickness `[m]` over an interval of distances `[m]` behind the place of half of the thickness.
    fn mean_thickness(&self, from: f64, to: f64) -> f64 {
        let steps = 200;
        let behind = |step: i32| (from + (f64::from(step) + 0.5) * (to - from) / f64::from(steps)) / self.thickness;
        let at = |step: i32| self.profile[(100.0 * behind(step)).round() as usize];
        self.thickness * (0..steps).map(at).sum::<f64>() / f64::from(steps)
    }
}

fn number(value: &toml::Value) -> f64 {
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64)).expect("a number")
}

fn numbers(value: &toml::Value) -> Vec<f64> {
    value.as_array().expect("a list").iter().map(number).collect()
}

#[test]
fn references_of_the_fed_slope_are_those_of_its_front() {
    let study: toml::Value = toml::from_str(&text("validation/studies/fed-slope.toml")).expect("TOML");
    let density = GLASS_BEADS.solid_fraction * GLASS_BEADS.law.grain_density;
    let variants = study["variants"].as_array().expect("variants");
    assert_eq!(variants.len(), 7);
    for variant in variants {
        let (name, set) = (variant["name"].as_str().expect("a name"), &variant["set"]);
        let only = format!("variant={name}");
        let checks = study["checks"].as_array().expect("checks");
        let check = |wanted: &str| {
            let own =
                |check: &&toml::Value| check["name"].as_str() == Some(wanted) && check["only"].as_str() == Some(&only);
            checks.iter().find(own).unwrap_or_else(|| panic!("{wanted} of {name}"))
        };
        let gravity: [f64; 2] = numbers(&set["gravity"]).try_into().expect("two numbers");
        let rate = number(&set["inlets"][0]["rates"][0][1]);
        let front = TravellingFront::of(gravity, rate / density);
        let station = numbers(&set["gauges"][1]["at"])[0];
        // where the front is while a check counts: given by the check, or by the start and the time
        let beyond = |check: &toml::Value| {
            let window = [number(&check["from"]), number(&check["to"])];
            if check.get("over").is_some() {
                return window.map(|front| front - station);
            }
            // the surface of the uppermost slice, from the tip backwards
            let surface: Vec<Vec<f64>> =
                set["bodies"][3]["points"].as_array().expect("points").iter().map(numbers).collect();
            let half = 0.5 * front.thickness;
            let pair =
                surface.windows(2).find(|pair| pair[0][1] < half && pair[1][1] >= half).expect("half of the thickness");
            let start = pair[0][0] + (pair[1][0] - pair[0][0]) * (half - pair[0][1]) / (pair[1][1] - pair[0][1]);
            window.map(|time| start - station + front.velocity * time)
        };
        let mean = |check: &toml::Value| {
            let [from, to] = beyond(check);
            front.mean_thickness(from, to)
        };
        let mut references = vec![
            ("front_speed", front.velocity),
            ("thickness_behind_front", mean(check("thickness_behind_front"))),
            ("flux_behind_front", density * front.velocity * mean(check("flux_behind_front"))),
        ];
        if name.starts_with("slope") {
            let at_thickness = check("flux_at_thickness");
            let middle = 0.5 * (number(&at_thickness["from"]) + number(&at_thickness["to"]));
            references.push(("flux_at_thickness", density * front.velocity * middle));
            references.push(("thickness_near_front", mean(check("thickness_near_front"))));
        }
        for (wanted, expected) in references {
            let reference = number(&check(wanted)["reference"]);
            assert!((reference / expected - 1.0).abs() < 0.01, "{name} {wanted}: {reference} instead of {expected}");
        }
    }
}

/// References of the tilted layers are those of the layer without particles, of the same storage and liquid.
#[test]
fn references_of_the_submerged_slope_are_those_of_its_layer() {
    let study: toml::Value = toml::from_str(&text("validation/studies/submerged-slope.toml")).expect("TOML");
    let checks = study["checks"].as_array().expect("checks");
    let mut compared = 0;
    for (name, solid_fraction) in [("loose", 0.578), ("dense", 0.584)] {
        let layer = SubmergedLayer::GLASS_BEADS;
        let mut column = SubmergedColumn::new(&layer, solid_fraction, 0.0);
        let is_named = |check: &toml::Value, part: &str| check["name"].as_str().is_some_and(|name| name.contains(part));
        let own = checks.iter().filter(|check| check["only"].as_str().is_some_and(|only| only.contains(name)));
        let own = own.filter(|check| !is_named(check, "measured_velocity"));
        let (of_weight, mut of_time): (Vec<_>, Vec<_>) =
            own.partition(|check| is_named(check, "pressure_on_the_floor"));
        for check in of_weight {
            let (reference, exact) = (number(&check["reference"]), layer.floor_overburden(solid_fraction));
            assert!((reference / exact - 1.0).abs() < 1e-4, "{reference} Pa instead of {exact} Pa");
        }
        let at = |check: &toml::Value| check["value"].get("at").map(number);
        let order = |check: &&toml::Value| at(check).map_or(f64::MAX, |time| time);
        of_time.sort_by(|one, other| order(one).total_cmp(&order(other)));
        let mut reached = None;
        for check in of_time {
            let time = at(check).unwrap_or(f64::MAX);
            while column.time < time && (time < f64::MAX || reached.is_none()) {
                let (before, from) = (column.surface_velocity(), column.time);
                column.advance_to((from + 0.02).min(time)).expect("it flows");
                let (after, goal) = (column.surface_velocity(), 0.009);
                if reached.is_none() && from >= 0.3 && after >= goal {
                    reached = Some(from + (column.time - from) * (goal - before) / (after - before));
                }
            }
            let expected = match check["name"].as_str() {
                Some("suction_after_20_s") => column.pore_pressure[0],
                Some("time_to_0_3_mm_s") => reached.expect("it accelerates"),
                _ => column.surface_velocity(),
            };
            let reference = number(&check["reference"]);
            assert!((reference / expected - 1.0).abs() < 0.005, "{check}: {reference} instead of {expected}");
            compared += 1;
        }
    }
    assert_eq!(compared, 10);
}

/// Measured velocities of the tilted layers end the digitised curves; the liquid is thirty times as thin.
#[test]
fn measured_velocities_of_the_submerged_slope_are_those_of_its_table() {
    let study: toml::Value = toml::from_str(&text("validation/studies/submerged-slope.toml")).expect("TOML");
    let table = shipped_table("submerged-slope/measured-velocity.csv").expect("a table");
    let [fractions, times, velocities] =
        ["solid fraction", "time", "surface velocity"].map(|name| table.numbers(name).expect("a column"));
    let is_measured = |check: &&toml::Value| check["name"].as_str() == Some("measured_velocity");
    let checks: Vec<&toml::Value> = study["checks"].as_array().expect("checks").iter().filter(is_measured).collect();
    for check in &checks {
        let is_own = |variant: &&toml::Value| {
            check["only"].as_str().and_then(|only| only.strip_prefix("variant=")) == variant["name"].as_str()
        };
        let variant = study["variants"].as_array().expect("variants").iter().find(is_own).expect("a variant");
        let own = variant["set"].get("material.solid_fraction");
        let fraction = number(own.unwrap_or(&study["set"]["material"]["solid_fraction"]));
        let end = fractions.iter().rposition(|row| (row - fraction).abs() < 1e-9).expect("a curve");
        let (time, velocity) = (times[end] / 30.0, velocities[end] * 30e-3);
        assert!((number(&check["value"]["at"]) - time).abs() < 1e-4, "{check}: {time} s");
        assert!((number(&check["reference"]) - velocity).abs() < 1e-9, "{check}: {velocity} m/s");
        assert_eq!(check["source"].as_str(), Some(table.metadata.source.as_str()));
    }
    assert_eq!(checks.len(), 5);
}

/// Curves of the figure over the slope: the uniform layers of the local and of the nonlocal law at one discharge, h_stop of
/// experiments, and (44) of the collapse paper.
#[test]
fn curves_of_the_fed_slope_are_those_of_their_formulas() {
    let study: toml::Value = toml::from_str(&text("validation/studies/fed-slope.toml")).expect("TOML");
    let density = GLASS_BEADS.solid_fraction * GLASS_BEADS.law.grain_density;
    let law = GLASS_BEADS.law;
    let length = GLASS_BEADS_FLOW_RULE.deposit_length * law.grain_diameter;
    let curve = |label: &str| -> Vec<Vec<f64>> {
        let series = study["figures"][0]["series"].as_array().expect("series");
        let own = series.iter().find(|own| own.get("reference").and_then(toml::Value::as_str) == Some(label));
        own.expect("a series")["curve"].as_array().expect("points").iter().map(numbers).collect()
    };
    for point in curve("uniform layer of the local law") {
        let (sine, cosine) = point[0].to_radians().sin_cos();
        let layer = TravellingFront::of([9.81 * sine, -9.81 * cosine], 2.475 / density).thickness;
        assert!((point[1] / layer - 1.0).abs() < 0.002, "{point:?}: {layer}");
    }
    for point in curve("h_stop of experiments") {
        let slope = point[0].to_radians().tan();
        let stop = length * (law.limiting_friction - slope) / (slope - law.static_friction);
        assert!((point[1] / stop - 1.0).abs() < 0.002, "{point:?}: {stop}");
    }
    for point in curve("(44), reconstructed, of a reservoir of 14 cm") {
        let formula = RoughIncline::of_glass_beads().flow_thickness(0.14, point[0].to_radians()).expect("a flow");
        assert!((point[1] / formula - 1.0).abs() < 0.002, "{point:?}: {formula}");
    }
    // the discharge of the layer that is drawn is the fed one, in finite volumes
    for point in curve("uniform layer of the nonlocal law") {
        let layer = BagnoldProfile {
            inclination: point[0].to_radians(),
            layer_height: point[1],
            gravity: 9.81,
            solid_fraction: GLASS_BEADS.solid_fraction,
            grains: law,
        };
        let layer = NonlocalLayer { layer, cooperativity: 0.48, surface: FieldBoundary::Vanishing };
        let discharge = density * point[1] * layer.steady(400).expect("a steady flow").depth_mean();
        assert!((discharge / 2.475 - 1.0).abs() < 0.005, "{point:?}: {discharge} kg/(m s)");
    }
}
