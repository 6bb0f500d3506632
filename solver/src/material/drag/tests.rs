//! Properties common to all drag laws.

use super::DragLaw;
use proptest::prelude::*;

const DIAMETER: f64 = 1e-3;
const DENSITY: f64 = 1000.0;
const VISCOSITY: f64 = 1e-6;

fn exchange(law: DragLaw, solid_fraction: f64, slip: f64) -> f64 {
    law.exchange_coefficient(solid_fraction, slip, DIAMETER, DENSITY, VISCOSITY)
}

/// K d²/(φ μ): 18 in Stokes' regime.
fn reduced_exchange(law: DragLaw, solid_fraction: f64, slip: f64) -> f64 {
    exchange(law, solid_fraction, slip) * DIAMETER * DIAMETER / (solid_fraction * DENSITY * VISCOSITY)
}

fn single_grain_laws() -> impl Iterator<Item = DragLaw> {
    DragLaw::ALL.into_iter().filter(|&law| law != DragLaw::Ergun)
}

#[test]
fn names_are_those_that_parameters_use() {
    for law in DragLaw::ALL {
        let written = serde::de::value::StrDeserializer::<serde::de::value::Error>::new(law.name());
        assert_eq!(serde::Deserialize::deserialize(written), Ok(law));
    }
}

#[test]
fn exchange_without_slip_is_viscous() {
    for solid_fraction in [1e-3, 0.1, 0.4] {
        let voidage: f64 = 1.0 - solid_fraction;
        for (law, expected) in [
            (DragLaw::MorsiAlexander, 18.0),
            (DragLaw::SchillerNaumann, 18.0),
            (DragLaw::WenYu, 18.0 * voidage.powf(-2.65)),
            (DragLaw::DiFelice, 17.28 * voidage.powf(-2.7)),
            (DragLaw::Ergun, 150.0 * solid_fraction / voidage),
        ] {
            let reduced = reduced_exchange(law, solid_fraction, 0.0);
            assert!((reduced / expected - 1.0).abs() < 1e-12, "{law:?} at {solid_fraction}: {reduced}");
            let nearly = reduced_exchange(law, solid_fraction, 1e-12);
            assert!((nearly / expected - 1.0).abs() < 1e-4, "{law:?} at {solid_fraction}: {nearly}");
        }
    }
}

#[test]
fn exchange_of_a_dilute_suspension_is_that_of_its_grains() {
    for law in single_grain_laws() {
        for reynolds in [0.0, 0.03, 4.0, 250.0, 3000.0, 4e4] {
            let (slip, solid_fraction) = (reynolds * VISCOSITY / DIAMETER, 1e-7);
            let alone = 0.75 * law.drag_times_reynolds(reynolds).unwrap();
            let reduced = reduced_exchange(law, solid_fraction, slip);
            assert!((reduced / alone - 1.0).abs() < 1e-6, "{law:?} at R = {reynolds}: {reduced} or {alone}");
        }
    }
}

#[test]
fn a_bed_has_no_single_grain_and_clear_fluid_no_exchange() {
    assert_eq!(DragLaw::Ergun.drag_coefficient(10.0), None);
    for law in DragLaw::ALL {
        assert_eq!(exchange(law, 0.0, 0.3), 0.0, "{law:?}");
    }
}

#[test]
fn only_the_table_ends() {
    for law in DragLaw::ALL {
        assert!(law.reynolds_range().contains(&0.0) && law.reynolds_range().contains(&50_000.0));
        assert_eq!(law.reynolds_range().contains(&50_001.0), law != DragLaw::MorsiAlexander);
    }
}

proptest! {
    #[test]
    fn coefficients_are_positive_and_finite(exponent in -8.0..4.69f64, solid_fraction in 1e-6..0.7f64) {
        let reynolds = libm::pow(10.0, exponent);
        for law in DragLaw::ALL {
            let exchange = exchange(law, solid_fraction, reynolds * VISCOSITY / DIAMETER);
            prop_assert!(exchange > 0.0 && exchange.is_finite(), "{law:?}");
            let alone = law.drag_coefficient(reynolds).unwrap_or(1.0);
            prop_assert!(alone > 0.0 && alone.is_finite(), "{law:?}");
        }
    }

    /// Growth of the drag with slip: between two rows of Morsi and Alexander's table the force may drop by 2.3 %, which
    /// 3 % more slip makes good.
    #[test]
    fn force_grows_with_slip(exponent in -8.0..4.67f64, solid_fraction in 1e-6..0.7f64, growth in 1.03..1.5f64) {
        let slip = libm::pow(10.0, exponent) * VISCOSITY / DIAMETER;
        for law in DragLaw::ALL {
            let force = |slip| exchange(law, solid_fraction, slip) * slip;
            prop_assert!(force(growth * slip) > force(slip), "{law:?}");
        }
    }

    #[test]
    fn hindrance_grows_with_the_solid_fraction(
        exponent in -8.0..4.67f64, solid_fraction in 1e-6..0.69f64, more in 1e-3..0.01f64,
    ) {
        let slip = libm::pow(10.0, exponent) * VISCOSITY / DIAMETER;
        for law in DragLaw::ALL {
            prop_assert!(exchange(law, solid_fraction + more, slip) > exchange(law, solid_fraction, slip), "{law:?}");
        }
    }
}
