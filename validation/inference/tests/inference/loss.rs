//! Huber's loss and its inverse.

use bagnold_inference::inference::Loss;
use bagnold_inference::internals::CORNER;

#[test]
fn hubers_loss_is_smooth_and_linear_far_out() {
    let loss = |r: f64| Loss::Huber.root(r).powi(2);
    assert_eq!((loss(-1.0), Loss::Squares.root(-7.0)), (1.0, -7.0));
    let slope = |r: f64| (loss(r + 1e-6) - loss(r - 1e-6)) / 2e-6;
    assert!((slope(CORNER - 1e-5) - slope(CORNER + 1e-5)).abs() < 1e-4);
    for r in [-7.0, -1.0, 0.3, 2.0] {
        assert!((Loss::Huber.residual(Loss::Huber.root(r)) - r).abs() < 1e-12);
    }
    assert!((slope(10.0) - 2.0 * CORNER).abs() < 1e-6 && Loss::Huber.root(-10.0) < 0.0);
}
