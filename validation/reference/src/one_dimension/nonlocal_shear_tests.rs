use super::*;
use crate::one_dimension::fluidity_balance::{cooperativity_length, growth};

const DIAMETER: f64 = 0.5e-3;

const BEADS: MuI = MuI {
    static_friction: 0.3819,
    limiting_friction: 0.6435,
    reference_inertia: 0.279,
    grain_diameter: DIAMETER,
    grain_density: 2450.0,
};

impl NonlocalShearProfile {
    /// Length u/|du/dy| `[m]` over which the velocity falls by e, at a distance from the near end `[m]`; not a number at rest.
    fn decay_length(&self, distance: f64) -> f64 {
        self.velocity(distance) / self.shear_rate(distance)
    }
}

fn beads(grains: f64, stress: ShearStress, ends: [FieldBoundary; 2]) -> NonlocalShear {
    NonlocalShear { grains: BEADS, cooperativity: 0.48, thickness: grains * DIAMETER, stress, ends }
}

/// A chute as wide as twice some grains, its walls with a condition of their own.
fn chute(grains: f64, wall_friction: f64, wall: FieldBoundary) -> NonlocalShear {
    beads(grains, ShearStress::Chute { pressure: 100.0, wall_friction }, [FieldBoundary::NoFlux, wall])
}

/// A heap of 60 grains between walls of friction 0.2, 60 grains apart, and the depth `[m]` at which the local law is at rest.
fn heap(degrees: f64) -> (NonlocalShear, f64) {
    let (slope, side_friction) = (degrees.to_radians().tan(), 0.2 / (60.0 * DIAMETER));
    let weight = 0.6 * 2450.0 * 9.81 * degrees.to_radians().cos();
    let of = beads(
        60.0,
        ShearStress::Heap { slope, weight, side_friction },
        [FieldBoundary::NoFlux, FieldBoundary::Vanishing],
    );
    (of, (slope - BEADS.static_friction) / side_friction)
}

/// A plate with a load of ten grains' weight over twenty grains of which the local law shears the upper 7.3.
fn below_a_plate(cells: usize) -> NonlocalShearProfile {
    let unit = 2450.0 * 9.81 * DIAMETER;
    let stress = ShearStress::UnderGravity { load: 10.0 * unit, traction: 5.5 * unit, weight: 0.6 * 2450.0 * 9.81 };
    beads(20.0, stress, [FieldBoundary::Vanishing; 2]).steady(cells).expect("steady")
}

/// Shooting solution of a small fluidity from 1 in the middle of a chute to its wall, by a Runge–Kutta method. Returns the
/// least g on the way, and g′ at the wall.
fn shot(of: &NonlocalShear) -> (f64, f64) {
    let steps = 4000;
    let step = of.thickness / f64::from(steps);
    let length = of.cooperativity * BEADS.grain_diameter;
    let slope = |y: f64, g: f64| -growth(&of.grains, of.stress.at(y, of.thickness).1) * g / (length * length);
    let (mut g, mut rise, mut least) = (1.0, 0.0, f64::MAX);
    for index in 0..steps {
        let y = f64::from(index) * step;
        let (a, b) = (rise, slope(y, g));
        let (c, d) = (rise + 0.5 * step * b, slope(y + 0.5 * step, g + 0.5 * step * a));
        let (e, f) = (rise + 0.5 * step * d, slope(y + 0.5 * step, g + 0.5 * step * c));
        let (h, i) = (rise + step * f, slope(y + step, g + step * e));
        g += step / 6.0 * (a + 2.0 * c + 2.0 * e + h);
        rise += step / 6.0 * (b + 2.0 * d + 2.0 * f + i);
        least = least.min(g);
    }
    (least, rise)
}

/// Layers and thresholds of another program (finite volumes in Python).
#[test]
fn chutes_shear_at_their_walls_as_in_another_program() {
    for (grains, expected) in [(10.0, 1.70), (20.0, 2.49), (40.0, 3.97)] {
        let profile = chute(grains, 0.5, FieldBoundary::NoFlux).steady(4000).expect("steady");
        let found = profile.wall_layer().expect("it flows") / DIAMETER;
        assert!((found - expected).abs() < 0.0051, "{found} d in a chute of {grains} d");
        let flows = chute(grains, 0.42, FieldBoundary::NoFlux).steady(4000).expect("a state").fastest > 0.0;
        assert_eq!(flows, grains > 30.0, "{grains} d");
    }
    for (grains, friction, plug, layer) in [(10.0, 0.6, 0.43715, 2.2983), (20.0, 0.5, 0.06430, 3.7045)] {
        let profile = chute(grains, friction, FieldBoundary::Vanishing).steady(4000).expect("steady");
        let scale = (100.0 / BEADS.grain_density).sqrt();
        let (fastest, found) = (profile.fastest / scale, profile.wall_layer().expect("it flows") / DIAMETER);
        assert!((fastest / plug - 1.0).abs() < 2e-4 && (found / layer - 1.0).abs() < 2e-4, "{fastest}, {found} d");
    }
}

/// The first mode at the threshold of flow ends at the wall with g = 0 at rough walls and with g′ = 0 without flux, however it is found.
#[test]
fn a_chute_begins_to_flow_where_its_first_mode_fits() {
    for (wall, grains) in
        [(FieldBoundary::NoFlux, 10.0), (FieldBoundary::NoFlux, 20.0), (FieldBoundary::Vanishing, 20.0)]
    {
        let fits = |friction: f64| {
            let (least, rise) = shot(&chute(grains, friction, wall));
            least > 0.0 && (rise > 0.0 || wall == FieldBoundary::Vanishing)
        };
        let (mut still, mut flowing) = (0.385, 0.6);
        assert!(fits(still) && !fits(flowing));
        for _ in 0..40 {
            let middle = 0.5 * (still + flowing);
            if fits(middle) { still = middle } else { flowing = middle }
        }
        let flows = |friction: f64| chute(grains, friction, wall).steady(2000).expect("a state").fastest > 0.0;
        assert!(!flows(still - 2e-4) && flows(still + 2e-4), "{still} for {grains} d and {wall:?}");
        println!("{wall:?}, {grains} d: μ_w = {still:.4}");
    }
}

/// Under a uniform μ (a deep heap whose side walls do not rub) the flow is that of the layer on an incline.
#[test]
fn a_heap_without_side_friction_stops_like_a_layer() {
    let slope = 24.0_f64.to_radians().tan();
    for (surface, phase) in
        [(FieldBoundary::Vanishing, std::f64::consts::PI), (FieldBoundary::NoFlux, std::f64::consts::FRAC_PI_2)]
    {
        let stress = ShearStress::Heap { slope, weight: 14_000.0, side_friction: 1e-12 };
        let of = |grains| beads(grains, stress, [surface, FieldBoundary::Vanishing]);
        let stopping = phase * cooperativity_length(&BEADS, 0.48, slope) / DIAMETER;
        let flows = |times: f64| of(times * stopping).steady(2000).expect("a state").fastest > 0.0;
        assert!(!flows(0.999) && flows(1.001), "{stopping} d with {surface:?}");
    }
}

/// Below the depth at which the local law is at rest, in diameters: the lengths of another program, the same on every slope.
#[test]
fn the_tail_of_a_heap_decays_as_in_another_program() {
    for degrees in [23.0, 24.0] {
        let (of, edge) = heap(degrees);
        let profile = of.steady(6000).expect("steady");
        for (below, expected) in [(5.0, 2.85), (10.0, 2.40), (15.0, 2.12), (20.0, 1.94)] {
            let found = profile.decay_length(edge + below * DIAMETER) / DIAMETER;
            assert!((found - expected).abs() < 0.0055, "{found} d at {below} d and {degrees}°");
        }
    }
    let limit = cooperativity_length(&BEADS, 0.48, 0.0) / DIAMETER;
    let expected = 0.48 * (0.6435_f64 / (0.2616 * 0.3819)).sqrt();
    assert!((limit - expected).abs() < 1e-12 && (limit - 1.22).abs() < 0.0051, "{limit} d");
}

/// Exact decay over ξ(0) of a fluidity from above: the side walls support all shear, and μ = 0 is uniform.
#[test]
fn a_far_tail_decays_over_the_length_of_the_law() {
    let stress = ShearStress::Heap { slope: 0.4877, weight: 14_000.0, side_friction: 0.02 / DIAMETER };
    let of = beads(45.0, stress, [FieldBoundary::NoFlux, FieldBoundary::Vanishing]);
    let profile = of.steady(9000).expect("steady");
    let at = |grains: f64| profile.fluidities[(grains / 45.0 * 9000.0) as usize];
    let found = 4.0 * DIAMETER / (at(28.0) / at(32.0)).ln();
    let expected = cooperativity_length(&of.grains, of.cooperativity, 0.0);
    assert!(at(0.0) > 1.0 && at(32.0) > 0.0, "{} and {}", at(0.0), at(32.0));
    assert!((found / expected - 1.0).abs() < 1e-5, "{} d for {} d", found / DIAMETER, expected / DIAMETER);
}

#[test]
fn profiles_converge_at_second_order() {
    let of_plate = |cells| {
        let profile = below_a_plate(cells);
        (profile.fastest, profile.decay_length(11.0 * DIAMETER))
    };
    let of_chute = |cells| {
        let profile = chute(10.0, 0.6, FieldBoundary::Vanishing).steady(cells).expect("steady");
        (profile.fastest, profile.wall_layer().expect("it flows"))
    };
    for [coarse, middle, fine] in [[200, 400, 800].map(of_plate), [200, 400, 800].map(of_chute)] {
        let order = |a: f64, b: f64, c: f64| ((a - b) / (b - c)).log2();
        let orders = [order(coarse.0, middle.0, fine.0), order(coarse.1, middle.1, fine.1)];
        println!("orders {orders:.2?}");
        assert!(orders.iter().all(|order| (order - 2.0).abs() < 0.25), "{orders:?}");
    }
    // the other program's velocity of the plate over √(g d), and its lengths
    let profile = below_a_plate(6000);
    assert!((profile.fastest / (9.81 * DIAMETER).sqrt() / 2.18409 - 1.0).abs() < 1e-3, "{}", profile.fastest);
    for (below, expected) in [(0.0, 2.1534), (2.0, 1.9417), (4.0, 1.7817), (6.0, 1.6409)] {
        let found = profile.decay_length((7.3361 + below) * DIAMETER) / DIAMETER;
        assert!((found - expected).abs() < 5e-4, "{found} d at {below} d below the local law's depth");
    }
}

/// Without cooperation the local law flows, and nothing where it is at rest.
#[test]
fn without_cooperation_a_flow_ends_at_a_line() {
    let of = NonlocalShear { cooperativity: 0.0, ..heap(24.0).0 };
    let profile = of.steady(2000).expect("steady");
    for (cell, &distance) in profile.distances.iter().enumerate() {
        let (pressure, friction) = of.stress.at(distance, of.thickness);
        let inertia = BEADS.reference_inertia * (friction - BEADS.static_friction).max(0.0)
            / (BEADS.limiting_friction - friction);
        let rate = inertia * (pressure / BEADS.grain_density).sqrt() / DIAMETER;
        let found = profile.fluidities[cell] * friction;
        assert!((found - rate).abs() < 1e-6 * (1.0 + rate), "{found} for {rate} at {distance} m");
    }
}

#[test]
fn value_out_of_range_names_the_field() {
    let refused = |of: NonlocalShear| of.steady(100).expect_err("it is refused").to_string();
    assert!(refused(chute(10.0, 0.7, FieldBoundary::NoFlux)).contains("below limiting_friction"));
    assert!(refused(chute(-1.0, 0.5, FieldBoundary::NoFlux)).contains("thickness"));
    let stress = ShearStress::UnderGravity { load: 0.0, traction: 1.0, weight: 1.0 };
    assert!(refused(beads(5.0, stress, [FieldBoundary::NoFlux; 2])).contains("load"));
}
