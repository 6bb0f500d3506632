//! Correction of what polynomials leave over.

use bagnold_inference::internals::KrigingCorrection;
use bagnold_inference::sampling::Random;
use bagnold_inference::sampling::design::latin_hypercube;
use nalgebra::DMatrix;

fn left(points: &[Vec<f64>], value: impl FnMut(&Vec<f64>) -> f64) -> DMatrix<f64> {
    DMatrix::from_iterator(points.len(), 1, points.iter().map(value))
}

fn fitted(points: &[Vec<f64>], left: &DMatrix<f64>) -> Option<KrigingCorrection> {
    let borrowed: Vec<&[f64]> = points.iter().map(Vec::as_slice).collect();
    let error = left.norm_squared() / points.len() as f64;
    KrigingCorrection::fit(&borrowed, left, &vec![1.0; points.len()], error)
}

#[test]
fn a_smooth_left_over_is_carried_between_its_points() {
    let points = latin_hypercube(40, 2, 3);
    let smooth = |u: &Vec<f64>| libm::sin(5.0 * u[0]) * libm::cos(4.0 * u[1]);
    let correction = fitted(&points, &left(&points, smooth)).expect("it predicts");
    let value = |u: &[f64]| correction.basis(u).dot(&correction.coefficients.column(0));
    for u in latin_hypercube(20, 2, 8).iter().filter(|u| u.iter().all(|x| (0.15..0.85).contains(x))) {
        assert!((value(u) - smooth(u)).abs() < 0.05, "{u:?}: {} is not {}", value(u), smooth(u));
    }
    for u in &points {
        assert!((value(u) - smooth(u)).abs() < 0.01);
    }
}

#[test]
fn mere_scatter_is_not_carried() {
    let points = latin_hypercube(60, 2, 3);
    let mut random = Random::new(5);
    let scatter = left(&points, |_| random.normal());
    let correction = fitted(&points, &scatter);
    let largest = correction.map_or(0.0, |correction| {
        let values = points.iter().map(|u| correction.basis(u).dot(&correction.coefficients.column(0)).abs());
        values.fold(0.0, f64::max)
    });
    assert!(largest < 1.0, "{largest} of a scatter of 1");
}

#[test]
fn the_slopes_are_those_of_differences() {
    let points = latin_hypercube(10, 2, 3);
    let correction = fitted(&points, &left(&points, |u| u[0] * u[1])).expect("it predicts");
    let (u, h) = ([0.3, 0.6], 1e-6);
    let slopes = correction.slopes(&u);
    for k in 0..2 {
        let at = |step: f64| {
            let mut place = u;
            place[k] += step;
            correction.basis(&place)
        };
        let difference = (at(h) - at(-h)) / (2.0 * h);
        assert!((slopes.column(k) - difference).norm() < 1e-8);
    }
}
