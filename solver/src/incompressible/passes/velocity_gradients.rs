//! Velocity gradients by the corrected difference over free particles.

use super::super::neighbours::LEAST_TASK;
use super::super::phase::Phase;
use crate::vector::Tensor;
use rayon::prelude::*;

/// ∇u of every particle; none where the norm of its correction `[-]` exceeds a bound.
pub(crate) fn find_velocity_gradients<const D: usize>(phase: &mut Phase<D>, largest_correction: f64) {
    let Phase { free_pairs, velocity, lattice_volume, .. } = phase;
    let volume = *lattice_volume;
    phase.velocity_gradient.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(a, gradient)| {
        let mut moments = Tensor::<D>::zeros();
        let mut differences = Tensor::<D>::zeros();
        for pair in free_pairs.of(a) {
            let weighted = pair.separation * (-volume * pair.gradient);
            moments += weighted * pair.separation.transpose();
            differences += (velocity[a] - velocity[pair.source as usize]) * weighted.transpose();
        }
        // a loose particle has too few neighbours to tell a gradient
        *gradient = match moments.try_inverse() {
            Some(inverse) if inverse.norm() < largest_correction => differences * inverse,
            _ => Tensor::zeros(),
        };
    });
}
