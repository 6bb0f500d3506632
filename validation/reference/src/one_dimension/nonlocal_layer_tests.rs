use super::*;
use crate::one_dimension::nonlocal_transient::NonlocalTransient;
use bagnold_solver::material::rheology::MuI;

/// Glass beads of 0.5 mm on a slope `[°]`, as thick as some grains.
fn beads(degrees: f64, grains: f64, surface: FieldBoundary) -> NonlocalLayer {
    let grain_diameter = 0.5e-3;
    NonlocalLayer {
        layer: BagnoldProfile {
            layer_height: grains * grain_diameter,
            inclination: degrees.to_radians(),
            gravity: 9.81,
            grains: MuI {
                static_friction: 0.3819,
                limiting_friction: 0.6435,
                reference_inertia: 0.279,
                grain_diameter,
                grain_density: 2450.0,
            },
            solid_fraction: 0.6,
        },
        cooperativity: 0.48,
        surface,
    }
}

/// Stopping thicknesses and angles of another program (finite volumes in Python).
#[test]
fn stopping_thicknesses_and_angles_are_those_of_another_program() {
    let thicknesses = [(21.0, 33.90), (22.0, 9.70), (23.0, 6.69), (24.0, 5.22), (26.0, 3.58), (29.0, 2.12)];
    for (degrees, expected) in thicknesses {
        let of = |surface| beads(degrees, 1.0, surface).stopping_thickness().expect("between the friction angles");
        let (vanishing, free) = (of(FieldBoundary::Vanishing) / 0.5e-3, of(FieldBoundary::NoFlux) / 0.5e-3);
        assert!((vanishing - expected).abs() < 0.0051, "{vanishing} d at {degrees}°");
        assert!((free - 0.5 * vanishing).abs() < 1e-12 * vanishing);
    }
    let angles =
        [(3.0, 27.04, 23.40), (5.0, 24.20, 21.94), (8.0, 22.45, 21.33), (20.0, 21.18, 20.97), (80.0, 20.92, 20.91)];
    for (grains, vanishing, free) in angles {
        for (surface, expected) in [(FieldBoundary::Vanishing, vanishing), (FieldBoundary::NoFlux, free)] {
            let layer = beads(0.0, grains, surface);
            let angle = layer.stopping_angle().to_degrees();
            assert!((angle - expected).abs() < 0.0051, "{angle}° for {grains} d and {surface:?}");
            let at = beads(angle, grains, surface).stopping_thickness().expect("it flows there");
            assert!((at / layer.layer.layer_height - 1.0).abs() < 1e-9);
        }
    }
    assert_eq!(beads(20.0, 5.0, FieldBoundary::Vanishing).stopping_thickness(), None);
    assert_eq!(beads(33.0, 5.0, FieldBoundary::Vanishing).stopping_thickness(), None);
}

#[test]
fn froude_numbers_and_shapes_are_those_of_another_program() {
    let vanishing = [(1.5, 0.0769, 0.372), (2.0, 0.1460, 0.530), (3.0, 0.2815, 0.682), (10.0, 1.240, 0.901)];
    let free = [(1.5, 0.0162, 0.157), (3.0, 0.0902, 0.437), (10.0, 0.5555, 0.807)];
    let cases = vanishing.map(|case| (FieldBoundary::Vanishing, case)).into_iter();
    for (surface, (times, froude, ratio)) in cases.chain(free.map(|case| (FieldBoundary::NoFlux, case))) {
        let thickness = beads(24.0, 1.0, surface).stopping_thickness().expect("24° flows");
        let layer = beads(24.0, times * thickness / 0.5e-3, surface);
        let mean = layer.steady(3000).expect("steady").depth_mean();
        let found = mean / (9.81 * layer.layer.layer_height).sqrt();
        let local = layer.layer.depth_mean().expect("24° flows");
        assert!((found - froude).abs() < 1.2e-3 * froude.max(0.05), "{found} at {times} h_stop, {surface:?}");
        assert!((mean / local - ratio).abs() < 0.0015, "{} at {times} h_stop, {surface:?}", mean / local);
    }
    let at = |times: f64| beads(24.0, times * 5.2191, FieldBoundary::Vanishing);
    for (times, shape) in [(1.5, 0.5275), (3.0, 0.583)] {
        let layer = at(times);
        let profile = layer.steady(3000).expect("steady");
        let found = profile.velocity(0.5 * layer.layer.layer_height) / profile.surface_velocity;
        assert!((found - shape).abs() < 0.0006, "{found} at {times} h_stop");
    }
    let still = at(0.99).steady(500).expect("at rest");
    assert!(still.fluidities.iter().all(|&fluidity| fluidity == 0.0));
}

#[test]
fn the_profile_converges_and_without_cooperation_it_is_bagnolds() {
    let mean = |cells| beads(24.0, 7.83, FieldBoundary::Vanishing).steady(cells).expect("steady").depth_mean();
    let (coarse, middle, fine) = (mean(40), mean(80), mean(160));
    let order = ((coarse - middle) / (middle - fine)).log2();
    assert!(order > 1.3, "order {order}");
    let local = NonlocalLayer { cooperativity: 0.0, ..beads(24.0, 8.0, FieldBoundary::Vanishing) };
    let found = local.steady(4000).expect("steady");
    let expected = local.layer.surface_velocity().expect("24° flows");
    assert!((found.surface_velocity / expected - 1.0).abs() < 1e-4, "{}", found.surface_velocity / expected);
}

/// A tenth of a degree below the exact angle the layer slows to rest, a tenth above it flows on.
#[test]
fn the_layer_in_motion_stops_where_the_first_mode_says() {
    for surface in [FieldBoundary::Vanishing, FieldBoundary::NoFlux] {
        let exact = beads(0.0, 5.0, surface).stopping_angle().to_degrees();
        let ending = |degrees: f64| {
            let layer = beads(degrees, 5.0, surface);
            let modulus = 0.3 * 50.0 * layer.layer.bulk_density() * 9.81 * layer.layer.layer_height;
            let mut moving =
                NonlocalTransient::from_bagnold(layer, 30, 22.5_f64.to_radians(), 1e-4, modulus).expect("a start");
            moving.advance(2.0);
            moving.depth_mean() / (9.81 * layer.layer.layer_height).sqrt()
        };
        let (below, above) = (ending(exact - 0.1), ending(exact + 0.1));
        println!("{surface:?}: {below:.2e} below {exact:.3}°, {above:.2e} above");
        // particles count as at rest below 1e-4
        assert!(below.abs() < 1e-4 && above > 5e-4, "{below} and {above} around {exact}° with {surface:?}");
    }
}
