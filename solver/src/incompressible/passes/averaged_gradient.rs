//! Velocity gradients of the sediment, averaged over a short time and then over the neighbours.
//!
//! Grains that dilate jostle, and a rate that is taken from two velocities alone is mostly jostling: a stress that is to
//! be μ p is spread over a rate that is too large, and less of it acts on the mean shear. A mean that is taken before the
//! norm keeps the shear and loses the noise, whose norm is not zero. It also loses shear where a moving layer is only
//! some particles thick: at 2 % such grains come to rest.

use super::super::neighbours::{LEAST_TASK, Pair};
use super::super::phase::Phase;
use crate::vector::{Tensor, Vector, shear_rate};
use rayon::prelude::*;

/// Of the free sediment particles.
#[derive(Debug, Default)]
pub(crate) struct AveragedGradient<const D: usize> {
    /// ∇u averaged over time, then over neighbours `[1/s]`.
    over_time: Vec<Tensor<D>>,
    smoothed: Vec<Tensor<D>>,
}

impl<const D: usize> AveragedGradient<D> {
    /// Takes the present gradients in, of a step `[s]`, into means over an averaging time `[s]`.
    pub(crate) fn update(&mut self, sediment: &Phase<D>, time_step: f64, averaging_time: f64) {
        if self.over_time.len() != sediment.len() {
            self.over_time.clone_from(&sediment.velocity_gradient);
            self.smoothed.clone_from(&self.over_time);
        }
        let part = (time_step / averaging_time).min(1.0);
        for (averaged, present) in self.over_time.iter_mut().zip(&sediment.velocity_gradient) {
            *averaged += (present - *averaged) * part;
        }
        let own = sediment.kernel.value(0.0);
        let over_time = &self.over_time;
        self.smoothed.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(a, smoothed)| {
            let (mut sum, mut weight) = (over_time[a] * own, own);
            for pair in sediment.free_pairs.of(a) {
                sum += over_time[pair.source as usize] * pair.value;
                weight += pair.value;
            }
            *smoothed = sum / weight;
        });
    }

    /// Shear rate of a particle `[1/s]`.
    pub(crate) fn shear_rate(&self, particle: usize) -> f64 {
        shear_rate(&self.smoothed[particle])
    }

    /// |ū_ab|/r of a pair, from the mean of both gradients; a wall has that of its partner `[1/s]`.
    pub(crate) fn pair_rate(&self, a: usize, b: Option<usize>, pair: &Pair<D>) -> f64 {
        let gradient = match b {
            Some(b) => (self.smoothed[a] + self.smoothed[b]) * 0.5,
            None => self.smoothed[a],
        };
        let difference: Vector<D> = gradient * pair.separation;
        (difference.norm_squared() / pair.separation.norm_squared()).sqrt()
    }
}
