//! Scenes that several questions are asked of, as a user writes them.

use crate::threads::alone;
use bagnold_harness::case::{CaseResult, Changes, Silent, Tier, execute};
use bagnold_harness::store::{Store, StorePolicy};
use bagnold_validation::REGISTRY;
use std::path::Path;

pub(crate) const WATER: &str = r#"
[material]
law = "newtonian"
viscosity = 0.001
[bulk]
solid_fraction = 1.0
bulk_density = 1000.0
"#;
pub(crate) const CLOSED: &str = r#"
[sides]
left = "none"
right = "none"
bottom = "none"
top = "none"
"#;

pub(crate) const SLOPING: &str = r#"
[sides]
left = { periodic = 0.0 }
right = { periodic = 0.1 }
bottom = "none"
top = "none"
"#;

/// A box of some width and height `[m]` in a tank of another width.
pub(crate) fn boxed(duration: f64, (width, height): (f64, f64), tank: f64, surface: &str, more: &str) -> String {
    format!(
        r#"
name = "long-run"
gravity = [0.0, -9.81]
spacing = 0.005
duration = {duration}
interval = {interval}
pictures = 2
{more}
[[bodies]]
shape = "box"
lower = [0.0, 0.0]
upper = [{width}, {height}]
[[walls]]
name = "tank"
points = [[0.0, 0.2], [0.0, 0.0], [{tank}, 0.0], [{tank}, 0.2]]
surface = "{surface}"
"#,
        interval = duration / 100.0
    )
}

/// A smooth wall that pushes what stands before it 5 cm to the right in a second.
pub(crate) const PISTON: &str = r#"
[[walls]]
name = "piston"
surface = "smooth"
points = [[0.0, 0.15], [0.0, 0.0]]
motion = [[0.0, 0.0, 0.0], [1.0, 0.05, 0.0], [1.5, 0.05, 0.0]]
"#;

/// Particle-steps that are expected of a scene, and what it gives.
pub(crate) fn result(text: &str) -> (f64, CaseResult) {
    let fields = toml::from_str(text).expect("a table");
    let changes = Changes { file: Some((Path::new("scene.toml"), fields)), ..Changes::default() };
    let prepared = REGISTRY.find("scene").and_then(|case| case.prepare(Tier::Quick, &changes));
    let prepared = prepared.unwrap_or_else(|error| panic!("{error}"));
    let expected = prepared.estimate(0).particle_steps;
    alone();
    let mut results = execute(vec![prepared], &Store::open(StorePolicy::Use), &Silent).expect("a result");
    (expected, results.remove(0))
}
