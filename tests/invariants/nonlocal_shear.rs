//! Flows between two walls under the nonlocal law, where the balance of momentum gives the stresses: a vertical chute, and grains
//! under gravity below a plate that drags them. Held against a solution without particles at the pressure that the run has.

use crate::channel::{Channel, Measured, STIFFNESS};
use crate::nonlocal_layers::{BEADS, GRAVITY, SOLID_FRACTION, on_one_thread};
use bagnold_solver::material::rheology::field::FieldBoundary;
use bagnold_solver::vector::Vector;
use bagnold_validation::reference::{NonlocalShear, NonlocalShearProfile, ShearStress};

const DIAMETER: f64 = BEADS.grain_diameter;
/// ρ_s g d `[Pa]`.
const GRAIN_WEIGHT: f64 = BEADS.grain_density * GRAVITY * DIAMETER;
/// Pressure in chutes and below plates `[Pa]`.
const LOAD: f64 = 10.0 * GRAIN_WEIGHT;
/// Cells of the solution without particles.
const CELLS: usize = 2000;

/// A chute, half as wide as some grains, with rough walls, at a pressure `[Pa]` and a friction of its walls.
fn chute(grains: f64, pressure: f64, wall_friction: f64) -> NonlocalShear {
    NonlocalShear {
        grains: BEADS,
        cooperativity: 0.48,
        thickness: grains * DIAMETER,
        stress: ShearStress::Chute { pressure, wall_friction },
        ends: [FieldBoundary::NoFlux, FieldBoundary::Vanishing],
    }
}

/// The gravity along a chute of some half width `[m]` at which its walls bear a friction `[m/s²]`.
fn driving(wall_friction: f64, half: f64) -> f64 {
    // the compression makes the grains denser by p/K
    let density = SOLID_FRACTION * BEADS.grain_density * (1.0 + 1.0 / STIFFNESS);
    wall_friction * LOAD / (density * half)
}

/// A chute of particles in motion at `pace` times the steady velocity of `start`, driven by a friction of its walls.
fn chute_of_particles(
    grains: f64,
    per_grain: f64,
    wall_friction: f64,
    start: &NonlocalShear,
    pace: f64,
    duration: f64,
) -> Measured {
    let half = grains * DIAMETER;
    let pressure = LOAD;
    let profile = start.steady(CELLS).expect("a steady flow");
    let channel = Channel {
        width: 2.0 * half,
        rows: (2.0 * grains * per_grain) as usize,
        gravity: Vector::<2>::new(driving(wall_friction, half), 0.0),
        pressure: &|_| pressure,
        upper_wall: 0.0,
        start: &|y| {
            let from_middle = (y - half).abs();
            let stress = wall_friction * pressure * (half - y) / half;
            (pace * profile.velocity(from_middle), pace * profile.shear_rate(from_middle), stress)
        },
    };
    channel.measured(duration)
}

/// A chute of 20 d to either side, which begins a tenth too fast: the layer at the wall within a part of its width, the velocity's relative
/// L2, and the friction at which the model would have the same plug. So near its threshold the plug goes with the friction to the power
/// of 14: 0.4 % of the friction are 5 % of the velocity.
fn check_chute(per_grain: f64, limit: f64) {
    let (grains, wall_friction) = (20.0, 0.53);
    let start = chute(grains, LOAD, wall_friction);
    let found = on_one_thread(|| chute_of_particles(grains, per_grain, wall_friction, &start, 1.1, 1.0));
    let half = grains * DIAMETER;
    // the friction at the measured pressure
    let friction = found.density * driving(wall_friction, half) * half / found.pressure;
    let exact = chute(grains, found.pressure, friction);
    let profile = exact.steady(CELLS).expect("a steady flow");
    let rows = found.height.len();
    let (mut squares, mut scale) = (0.0, 0.0);
    for (&y, u) in found.height.iter().zip(&found.velocity) {
        let expected = profile.velocity((y - half).abs());
        squares += (u - expected).powi(2);
        scale += expected * expected;
    }
    let error = (squares / scale).sqrt();
    // both halves, from the middle to the wall
    let folded: Vec<(f64, f64)> = (0..rows / 2)
        .map(|row| {
            let (right, left) = (rows / 2 + row, rows / 2 - 1 - row);
            let distance = 0.5 * (found.height[right] - found.height[left]);
            (distance, 0.5 * (found.velocity[right] + found.velocity[left]))
        })
        .collect();
    let plug = folded[0].1;
    let lagging = plug * (1.0 - (-1.0_f64).exp());
    let beyond = folded.iter().position(|&(_, u)| u < lagging).expect("it lags at the wall");
    let ((near, faster), (far, slower)) = (folded[beyond - 1], folded[beyond]);
    let layer = half - (far - (far - near) * (lagging - slower) / (faster - slower));
    let expected = profile.wall_layer().expect("it flows");
    let (mut slow, mut fast) = (0.97 * friction, 1.03 * friction);
    for _ in 0..20 {
        let middle = 0.5 * (slow + fast);
        let reached = chute(grains, found.pressure, middle).steady(CELLS).expect("a state").fastest;
        if reached < plug { slow = middle } else { fast = middle }
    }
    let implied = slow / friction - 1.0;
    println!(
        "{per_grain} rows a grain: p {:.3} Pa for {:.3}, uneven by {:.1e}; layer {:.3} d for {:.3}: {:+.2} %; plug {:.4} m/s for \
         {:.4}: {:+.2} %; L2 {:.2} %, friction {:+.2} %",
        found.pressure,
        LOAD,
        found.unevenness,
        layer / DIAMETER,
        expected / DIAMETER,
        100.0 * (layer / expected - 1.0),
        plug,
        profile.fastest,
        100.0 * (plug / profile.fastest - 1.0),
        100.0 * error,
        100.0 * implied
    );
    assert!(found.unevenness < 0.01, "{}", found.unevenness);
    assert!((layer / expected - 1.0).abs() < limit, "{layer} for {expected}");
    assert!(error < 0.05 && implied.abs() < 0.004, "{error}, {implied}");
}

#[test]
fn a_chute_shears_at_its_walls_as_without_particles() {
    check_chute(2.0, 0.05);
}

#[test]
#[ignore = "half a minute: twice the rows (layer -0.5 % for -1.7 %)"]
fn a_chute_shears_at_its_walls_as_without_particles_with_twice_the_rows() {
    check_chute(4.0, 0.02);
}

/// A local law flows in every chute whose walls bear more than μ_s. This one stops below a friction that depends on the width.
#[test]
fn a_narrow_chute_stops_where_its_first_mode_does() {
    let grains = 10.0;
    let pressure = LOAD;
    let flows = |friction: f64| chute(grains, pressure, friction).steady(CELLS).expect("a state").fastest > 0.0;
    let (mut still, mut flowing) = (BEADS.static_friction, 0.6);
    for _ in 0..12 {
        let middle = 0.5 * (still + flowing);
        if flows(middle) { flowing = middle } else { still = middle }
    }
    let start = chute(grains, pressure, 0.6);
    let scale = start.steady(CELLS).expect("steady").fastest;
    let fastest = [-0.015, 0.015].map(|offset| {
        let found = on_one_thread(|| chute_of_particles(grains, 2.0, still + offset, &start, 1.0, 0.5));
        found.velocity.iter().copied().fold(0.0, f64::max) / scale
    });
    println!("threshold {still:.4}; {:.2e} of the start below, {:.2e} above", fastest[0], fastest[1]);
    assert!(fastest[0] < 1e-3 && fastest[1] > 1e-2, "{fastest:?} about {still}");
}

/// Twenty grains below a plate with the load of ten, which moves at 2.18 √(g d).
fn below_a_plate(load: f64, traction: f64, weight: f64) -> NonlocalShear {
    NonlocalShear {
        grains: BEADS,
        cooperativity: 0.48,
        thickness: 20.0 * DIAMETER,
        stress: ShearStress::UnderGravity { load, traction, weight },
        ends: [FieldBoundary::Vanishing; 2],
    }
}

/// The same with the traction at which the plate moves at a velocity `[m/s]`.
fn driven(load: f64, weight: f64, velocity: f64) -> (f64, NonlocalShearProfile) {
    let (mut slow, mut fast) = (BEADS.static_friction * load, 0.999 * BEADS.limiting_friction * load);
    for _ in 0..40 {
        let traction = 0.5 * (slow + fast);
        let reached = below_a_plate(load, traction, weight).steady(CELLS).expect("a state").fastest;
        if reached < velocity { slow = traction } else { fast = traction }
    }
    (fast, below_a_plate(load, fast, weight).steady(CELLS).expect("steady"))
}

/// Length over which a velocity falls by e: the line of least squares through its logarithm.
fn decay_length(points: &[(f64, f64)]) -> f64 {
    let count = points.len() as f64;
    let (x, y) =
        (points.iter().map(|p| p.0).sum::<f64>() / count, points.iter().map(|p| p.1.ln()).sum::<f64>() / count);
    let slope = points.iter().map(|p| (p.0 - x) * (p.1.ln() - y)).sum::<f64>()
        / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>();
    -1.0 / slope
}

/// The tail below the depth at which the local law would be at rest, over five grains and in the deeper half of them.
fn check_plate(per_grain: f64, limit: f64) {
    let height = 20.0 * DIAMETER;
    let weight = SOLID_FRACTION * BEADS.grain_density * GRAVITY;
    let load = LOAD;
    let velocity = 2.18 * (GRAVITY * DIAMETER).sqrt();
    let (traction, start) = driven(load, weight, velocity);
    let channel = Channel {
        width: height,
        rows: (20.0 * per_grain) as usize,
        gravity: Vector::<2>::new(0.0, -GRAVITY),
        pressure: &|y| load + weight * (height - y),
        upper_wall: velocity,
        start: &|y| (1.2 * start.velocity(height - y), 1.2 * start.shear_rate(height - y), traction),
    };
    let found = on_one_thread(|| channel.measured(0.5));
    let weight = found.density * GRAVITY;
    let load = found.pressure - 0.5 * weight * height;
    let (traction, profile) = driven(load, weight, velocity);
    let edge = (traction / BEADS.static_friction - load) / weight;
    let lengths = [(0.0, 5.0), (2.5, 6.0)].map(|(upper, lower)| {
        let rows: Vec<usize> = (0..found.height.len())
            .filter(|&row| {
                let depth = height - found.height[row] - edge;
                depth >= upper * DIAMETER && depth <= lower * DIAMETER
            })
            .collect();
        let depth = |row: usize| height - found.height[row];
        let particles: Vec<_> = rows.iter().map(|&row| (depth(row), found.velocity[row])).collect();
        let exact: Vec<_> = rows.iter().map(|&row| (depth(row), profile.velocity(depth(row)))).collect();
        (decay_length(&particles), decay_length(&exact))
    });
    let (mut squares, mut scale) = (0.0, 0.0);
    for (&y, u) in found.height.iter().zip(&found.velocity) {
        let expected = profile.velocity(height - y);
        squares += (u - expected).powi(2);
        scale += expected * expected;
    }
    let error = (squares / scale).sqrt();
    println!(
        "{per_grain} rows a grain: load {:.3} Pa for {:.3}, uneven by {:.1e}; traction {:.3} Pa for {:.3}; local law at rest {:.2} d \
         below the plate; lengths {:.3} d for {:.3}, {:.3} d for {:.3}; L2 {:.2} %",
        load,
        LOAD,
        found.unevenness,
        found.shear_stress,
        traction,
        edge / DIAMETER,
        lengths[0].0 / DIAMETER,
        lengths[0].1 / DIAMETER,
        lengths[1].0 / DIAMETER,
        lengths[1].1 / DIAMETER,
        100.0 * error
    );
    for (found, expected) in lengths {
        assert!((found / expected - 1.0).abs() < limit, "{found} m for {expected} m");
    }
    assert!((found.shear_stress / traction - 1.0).abs() < 0.005, "{} Pa for {traction} Pa", found.shear_stress);
    assert!(error < 0.02, "{error}");
}

#[test]
fn grains_below_a_plate_creep_as_without_particles() {
    check_plate(2.0, 0.05);
}

#[test]
#[ignore = "half a minute: twice the rows (lengths -0.6 and +0.7 % for -4.1 and -2.2 %)"]
fn grains_below_a_plate_creep_as_without_particles_with_twice_the_rows() {
    check_plate(4.0, 0.02);
}
