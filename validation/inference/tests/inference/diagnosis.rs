//! Outliers of drawn residuals, and steps of a model.

use bagnold_inference::inference::Evaluated;
use bagnold_inference::inference::diagnosis::{outliers, widest_step};
use bagnold_inference::sampling::Random;
use nalgebra::DMatrix;

fn normal(random: &mut Random, count: usize) -> Vec<f64> {
    (0..count).map(|_| random.normal()).collect()
}

#[test]
fn two_outliers_of_fifteen_are_named_and_nothing_else() {
    let (mut both, mut others) = (0, 0);
    for seed in 0..200 {
        let mut residuals = normal(&mut Random::new(seed), 15);
        residuals[3] += 8.0;
        residuals[11] -= 8.0;
        let found: Vec<usize> = outliers(&residuals, 0).into_iter().map(|(place, _)| place).collect();
        both += usize::from(found.contains(&3) && found.contains(&11));
        others += usize::from(found.iter().any(|place| *place != 3 && *place != 11));
    }
    assert!(both >= 140 && others <= 6, "{both} and {others} of 200");
}

#[test]
fn correct_residuals_raise_nothing() {
    for count in [6, 9, 15, 40, 100] {
        let mut outlying = 0;
        for seed in 0..1000 {
            let residuals = normal(&mut Random::new(seed), count);
            outlying += usize::from(!outliers(&residuals, 1).is_empty());
        }
        assert!(outlying <= 25, "{count} data: {outlying} of 1000");
    }
}

/// A front of whole quarters of a spacing beside a datum that follows the first of two parameters smoothly.
#[test]
fn the_widest_step_is_that_of_a_datum_that_its_slope_would_change() {
    let model = |width: f64| {
        let run = |k: u32| {
            let u = f64::from(k) / 20.0;
            let front = if width > 0.0 { (10.0 * u / width).floor() * width } else { 10.0 * u };
            Evaluated::new(vec![u, 1.0 - u], Some(vec![front - 5.0, 2.0 * u - 1.0]))
        };
        (0..=20).map(run).collect::<Vec<_>>()
    };
    let slopes = |of_front: f64| DMatrix::from_row_slice(2, 2, &[of_front, 0.0, 2.0, 0.0]);
    let jacobian = slopes(10.0);
    let (smooth, stepped) = (model(0.0), model(2.5));
    assert_eq!(widest_step(&jacobian, &smooth, 100.0), None);
    let step = widest_step(&jacobian, &stepped, 100.0).expect("a step");
    assert_eq!((step.datum, step.points[0].len()), (0, 2));
    assert!(
        (step.promised - 2.0).abs() < 1e-12 && (step.points[1][0] - step.points[0][0] - 0.2).abs() < 1e-12,
        "{step:?}"
    );
    // no parameter moves what never changes
    assert_eq!(widest_step(&slopes(0.0), &stepped, 100.0), None);
    assert_eq!(
        widest_step(&jacobian, &stepped, 0.005),
        None,
        "far from the minimum a front may reach the end of its line"
    );
}
