//! Damping of the water's velocity fluctuation across the bed by grains: there are no eddies smaller than the pores,
//! and motion that the particles' disorder stirs on their own scale must not carry momentum into the bed.
//!
//! Between grains w relaxes towards its mean, dw/dt = −(w − w̄)/T_q min(φ/φ_q, 1), implicitly.

use super::super::{IncompressibleScene, Phase, ProjectionNumerics, height_axis};
use crate::vector::Vector;

/// Relaxes the predicted velocities `[m/s]` of the fluid across the bed towards a mean at each particle `[m/s]`.
pub(crate) fn relax_fluctuation<const D: usize>(
    scene: &IncompressibleScene<D>,
    fluid: &Phase<D>,
    predicted: &mut [Vector<D>],
    mean: impl Fn(&Vector<D>) -> f64,
    time_step: f64,
) {
    let ProjectionNumerics { fluctuation_rate, fluctuation_fraction, .. } = scene.numerics;
    let Some(layer) = scene.solid_fraction.stratification().filter(|_| fluctuation_rate > 0.0) else { return };
    let normal = height_axis(D);
    for (position, velocity) in fluid.position.iter().zip(predicted) {
        let fraction = layer.solid_fraction_at(position);
        if fraction > 0.0 {
            let mean = mean(position);
            let rate = fluctuation_rate * (fraction / fluctuation_fraction).min(1.0);
            velocity[normal] = mean + (velocity[normal] - mean) / (1.0 + rate * time_step);
        }
    }
}
