//! Tests of settling against balances solved by hand.

use super::*;

/// Sand or gravel in water, ρ_s − ρ_f = 1600 kg/m³: the weight is 15 696 N/m³.
fn sand(grain_diameter: f64) -> SettlingGrains {
    SettlingGrains {
        grain_diameter,
        grain_density: 2600.0,
        fluid_density: 1000.0,
        kinematic_viscosity: 1e-6,
        gravity: 9.81,
    }
}

fn assert_close(found: Option<f64>, expected: f64, tolerance: f64) {
    let Some(found) = found else { panic!("none instead of {expected}") };
    assert!((found / expected - 1.0).abs() < tolerance, "{found} instead of {expected}");
}

#[test]
fn silt_sinks_after_stokes() {
    // 15 696 · 1e-10/(18 · 1e-3) = 8.72e-5 m/s at R = 8.7e-4; planar 3/2 of it
    let silt = sand(1e-5);
    assert_close(silt.terminal_velocity(DragLaw::MorsiAlexander, GrainForm::Sphere), 8.72e-5, 1e-14);
    assert_close(silt.terminal_velocity(DragLaw::MorsiAlexander, GrainForm::Planar), 1.308e-4, 1e-14);
    assert_close(silt.terminal_velocity(DragLaw::SchillerNaumann, GrainForm::Sphere), 8.72e-5, 2e-3);
}

#[test]
fn gravel_sinks_after_newton() {
    // u² = 15 696 · 5e-3/(c · 0.44 · 1000) = 0.237818 and 0.356727 m²/s², R = 2438 and 2986
    let gravel = sand(5e-3);
    for law in [DragLaw::SchillerNaumann, DragLaw::WenYu, DragLaw::Gidaspow] {
        assert_close(gravel.terminal_velocity(law, GrainForm::Sphere), 0.487_666, 1e-6);
        assert_close(gravel.terminal_velocity(law, GrainForm::Planar), 0.597_267, 1e-6);
    }
}

#[test]
fn gravel_sinks_after_a_row_of_the_table() {
    // K3 R² + K1 R + K2 = Ar/c with Ar = 1.962e6 and the row of 1000 to 5000, solved for R
    for (form, c) in [(GrainForm::Sphere, 0.75), (GrainForm::Planar, 0.5)] {
        let (k1, k2, k3) = (148.62f64, -4.75e4 - 1.962e6 / c, 0.357);
        let reynolds = ((k1 * k1 - 4.0 * k3 * k2).sqrt() - k1) / (2.0 * k3);
        assert!((1000.0..5000.0).contains(&reynolds));
        assert_close(sand(5e-3).terminal_velocity(DragLaw::MorsiAlexander, form), reynolds * 2e-4, 1e-12);
    }
}

#[test]
fn dallavalles_drag_has_a_closed_form() {
    // (0.63 √R + 4.8) √R = √(Ar/c), a quadratic in √R
    let target = (4.0 / 3.0 * 1.962e6f64).sqrt();
    let root = ((4.8f64 * 4.8 + 4.0 * 0.63 * target).sqrt() - 4.8) / (2.0 * 0.63);
    assert_close(sand(5e-3).terminal_velocity(DragLaw::DiFelice, GrainForm::Sphere), root * root * 2e-4, 1e-12);
}

#[test]
fn there_is_no_velocity_without_a_law_for_it() {
    assert_eq!(sand(1e-3).terminal_velocity(DragLaw::Ergun, GrainForm::Sphere), None);
    // 5 cm cobbles: √(15 696 · 0.05/330) = 1.54 m/s, R = 77 000
    assert_eq!(sand(5e-2).terminal_velocity(DragLaw::MorsiAlexander, GrainForm::Sphere), None);
    assert!(sand(5e-2).terminal_velocity(DragLaw::SchillerNaumann, GrainForm::Sphere).is_some());
    assert_eq!(sand(1e-3).hindered_slip(DragLaw::WenYu, 0.0), None);
    assert_eq!(sand(1e-3).hindered_slip(DragLaw::WenYu, 1.0), None);
}

#[test]
fn a_drag_belongs_to_its_slip() {
    for law in DragLaw::ALL {
        // R = 0.05, 75, 3000: none at a joint of the table, where a drag has two slips
        for slip in [1e-5, 0.015, 0.6] {
            let product = law.drag_times_reynolds(sand(5e-3).reynolds(slip)).map(|product| product * slip);
            let found = product.and_then(|product| sand(5e-3).slip_of_drag(law, product));
            assert!(law == DragLaw::Ergun || (found.unwrap() / slip - 1.0).abs() < 1e-12, "{law:?}: {found:?}");
        }
    }
    assert_eq!(sand(5e-3).slip_of_drag(DragLaw::Ergun, 1.0), None);
}

#[test]
fn light_grains_rise_as_fast_as_heavy_ones_sink() {
    let light = SettlingGrains { grain_density: 500.0, ..sand(1e-3) };
    let heavy = SettlingGrains { grain_density: 1500.0, ..light };
    let velocity = |grains: SettlingGrains| grains.terminal_velocity(DragLaw::WenYu, GrainForm::Sphere);
    assert_eq!(velocity(light), velocity(heavy));
    let neutral = SettlingGrains { grain_density: 1000.0, ..light };
    assert_eq!(velocity(neutral), Some(0.0));
}

#[test]
fn a_few_grains_sink_like_one() {
    for law in DragLaw::ALL.into_iter().filter(|&law| law != DragLaw::Ergun) {
        for diameter in [1e-5, 2e-4, 5e-3] {
            let alone = sand(diameter).terminal_velocity(law, GrainForm::Sphere).unwrap();
            assert_close(sand(diameter).hindered_slip(law, 1e-8), alone, 1e-6);
        }
    }
}

#[test]
fn silt_is_hindered_as_richardson_and_zaki_found() {
    // Wen–Yu in Stokes' regime: ε |u_r| = u_t ε^4.65; the fit's R^0.687 leaves 0.2 % at R = 1e-3
    for solid_fraction in [0.05f64, 0.2, 0.5] {
        let expected = 8.72e-5 * (1.0 - solid_fraction).powf(richardson_zaki_exponent(1e-3));
        assert_close(sand(1e-5).hindered_velocity(DragLaw::WenYu, solid_fraction), expected, 2e-3);
    }
}

#[test]
fn a_bed_is_fluidised_as_ergun_says() {
    // φ = 0.6, d = 1 mm: 1.05e6 u² + 1.35e5 u = 0.24 · 15 696 = 3767.04, u = 23.0 mm/s
    let slip = (135_000f64.powi(2) + 4.0 * 1.05e6 * 3767.04).sqrt() - 135_000.0;
    assert_close(sand(1e-3).hindered_slip(DragLaw::Ergun, 0.6), slip / 2.1e6, 1e-12);
    assert_close(sand(1e-3).hindered_slip(DragLaw::Gidaspow, 0.6), slip / 2.1e6, 1e-12);
}

#[test]
fn slip_balances_weight_and_drag() {
    for law in DragLaw::ALL.into_iter().filter(|&law| law != DragLaw::MorsiAlexander) {
        for solid_fraction in [0.02, 0.3, 0.55] {
            let slip = sand(1e-3).hindered_slip(law, solid_fraction).unwrap();
            let drag = law.exchange_coefficient(solid_fraction, slip, 1e-3, 1000.0, 1e-6) * slip;
            assert_close(Some(drag), solid_fraction * (1.0 - solid_fraction) * 15_696.0, 1e-13);
        }
    }
}

#[test]
fn drag_laws_give_the_tabulated_coefficients() {
    let table = crate::evidence::shipped_table("settling/drag.csv").expect("readable");
    let column = |name| table.numbers(name).expect("numbers");
    let rows = column("Reynolds number").iter().zip(column("drag coefficient"));
    for (name, (&reynolds, &expected)) in table.labels("law").expect("labels").iter().zip(rows) {
        let law = DragLaw::ALL.into_iter().find(|law| law.name() == name).expect("a law");
        let found = law.drag_coefficient(reynolds);
        assert!(found.is_some_and(|found| (found / expected - 1.0).abs() < 1e-6), "{name} at {reynolds}: {found:?}");
    }
}

#[test]
fn exponents_meet_where_their_ranges_do() {
    for joint in [0.2f64, 1.0, 500.0] {
        let jump = richardson_zaki_exponent(joint) / richardson_zaki_exponent(joint.next_down());
        assert!((jump - 1.0).abs() < 0.025, "{joint}: {jump}");
    }
    // 4.45 · 100^−0.1 = 4.45/1.584893
    assert!((richardson_zaki_exponent(100.0) - 2.807_761).abs() < 1e-6);
}
