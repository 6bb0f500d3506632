//! Bounds, scales and their messages.

use bagnold_inference::sampling::{Bounds, Spacing};

#[test]
fn values_and_coordinates_are_inverse_on_both_scales() {
    for spacing in [Spacing::Linear, Spacing::Log] {
        let bounds = Bounds { lower: 0.1, upper: 10.0, spacing };
        for k in 0..=10 {
            let coordinate = f64::from(k) / 10.0;
            assert!((bounds.coordinate(bounds.value(coordinate)) - coordinate).abs() < 1e-14);
        }
    }
    let log = Bounds { lower: 0.1, upper: 10.0, spacing: Spacing::Log };
    assert!((log.value(0.5) - 1.0).abs() < 1e-15);
}

#[test]
fn reversed_bounds_and_logarithms_of_zero_are_refused() {
    let message = |lower, upper, spacing| Bounds { lower, upper, spacing }.check().map_err(|error| error.to_string());
    assert_eq!(message(1.0, 2.0, Spacing::Log), Ok(()));
    assert_eq!(
        message(3.0, 2.0, Spacing::Linear),
        Err("`lower` is 3, but must be below `upper`, which is 2; exchange the two bounds".to_owned())
    );
    assert_eq!(
        message(0.0, 2.0, Spacing::Log),
        Err("`lower` is 0, but must be positive on a logarithmic scale; raise it, or use scale = \"linear\"".to_owned())
    );
    assert!(message(f64::NAN, 2.0, Spacing::Linear).is_err());
}
