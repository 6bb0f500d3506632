//! Scenes that last for tens of falls: at rest, pushed, swinging, sliding. All hold the balances that a scene is judged by.

use crate::physics::scene_texts::{CLOSED, PISTON, SLOPING, WATER, boxed, result};
use bagnold_harness::metric::{Metric, Verdict};

#[test]
fn the_energy_ledger_closes_in_sound_runs_of_every_kind() {
    let slope = boxed(3.0, (0.1, 0.05), 0.1, "rough", SLOPING)
        .replace("[0.0, -9.81]", "[4.0, -8.9]")
        .replace("[[0.0, 0.2], [0.0, 0.0], [0.1, 0.0], [0.1, 0.2]]", "[[0.0, 0.0], [0.1, 0.0]]");
    let square = (0.1, 0.1);
    let falls = |body: &str, more: &str| {
        let sides = CLOSED.replace("right = \"none\"", "right = { open = 0.3 }");
        boxed(0.3, (0.05, 0.15), 0.31, "smooth", &format!("{more}{sides}"))
            .replace("lower = [0.0, 0.0]", body)
            .replace("spacing = 0.005", "spacing = 0.0025")
    };
    // 60 m/s against a plate that is wider than the jet
    let jet = boxed(0.0023, (0.16, 0.02), 0.31, "smooth", &format!("{CLOSED}{WATER}"))
        .replace("bottom = \"none\"\ntop = \"none\"", "bottom = { open = -0.07 }\ntop = { open = 0.09 }")
        .replace("spacing = 0.005", "spacing = 0.0025")
        .replace("lower = [0.0, 0.0]", "velocity = [-60.0, 0.0]\nlower = [0.002, 0.0]")
        .replace("[[0.0, 0.2], [0.0, 0.0], [0.31, 0.0], [0.31, 0.2]]", "[[0.0, 0.1], [0.0, -0.08]]");
    let runs = [
        (
            "stiff water that drops by 10 cm",
            falls("lower = [0.0, 0.1]", "stiffness = 800.0\n").replace("[sides]", &format!("{WATER}[sides]")),
        ),
        ("stiff grains that drop by 10 cm", falls("lower = [0.0, 0.1]", "stiffness = 800.0\n")),
        ("a jet on a plate", jet),
        ("grains at rest", boxed(3.0, square, 0.1, "rough", CLOSED)),
        ("displaced grains at rest", boxed(3.0, square, 0.1, "rough", &format!("jitter = 0.1\n{CLOSED}"))),
        ("water at rest", boxed(5.0, square, 0.1, "smooth", &format!("jitter = 0.05\n{CLOSED}{WATER}"))),
        ("a piston in grains", boxed(1.5, (0.3, 0.05), 0.3, "smooth", CLOSED) + PISTON),
        ("water that swings", boxed(2.0, square, 0.4, "smooth", &format!("tension = \"cut\"\n{CLOSED}{WATER}"))),
        ("a heap", boxed(2.0, square, 0.5, "rough", CLOSED)),
        ("grains down a slope", slope),
    ];
    for (name, text) in runs {
        let metrics: Vec<Metric> = result(&text).1.metrics;
        let of = |wanted: &str| metrics.iter().find(|metric| metric.name == wanted).expect("a metric of scenes");
        let residual = of("energy_residual");
        println!("{name}: {} %", residual.value);
        let momentum = of("momentum_residual");
        assert_eq!(momentum.verdict(), Verdict::Pass, "{name}: {} % of the momentum", momentum.value);
        assert_eq!(residual.verdict(), Verdict::Pass, "{name}: {} %", residual.value);
        assert!(residual.value > 0.0, "{name}: a run that does nothing");
    }
}
