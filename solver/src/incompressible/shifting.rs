//! Particle shifting: δr = −A h |u| Δt ∇C with C = Σ V W, after Xu et al. (2009) and Lind et al. (2012).
//!
//! In a shear flow particles line up along stream lines and leave gaps between; shifting fills them. None at the
//! surface and beside it, where ∇C is that of the surface, and no more than a twentieth of a spacing.

use super::pairs::LEAST_TASK;
use super::phase::Phase;
use crate::vector::Vector;
use rayon::prelude::*;

/// Most that a particle is shifted in a step, in spacings `[-]`.
const LARGEST_SHIFT: f64 = 0.05;

/// Shifts of all particles `[m]` at a coefficient A `[-]`.
pub(super) fn find_shifts<const D: usize>(
    phase: &Phase<D>,
    coefficient: f64,
    time_step: f64,
    shifts: &mut Vec<Vector<D>>,
) {
    shifts.resize(phase.len(), Vector::zeros());
    let volume = phase.lattice_volume;
    let length = phase.kernel.smoothing_length();
    shifts.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(a, shift)| {
        *shift = Vector::zeros();
        if phase.at_surface[a] {
            return;
        }
        let mut gradient = Vector::zeros();
        for pair in phase.free_pairs.of(a) {
            gradient += pair.separation * (volume * pair.gradient);
            if phase.at_surface[pair.source as usize] {
                return;
            }
        }
        for pair in phase.wall_pairs.of(a) {
            gradient += pair.separation * (volume * pair.gradient);
        }
        let way = gradient * (-coefficient * length * phase.velocity[a].norm() * time_step);
        let size = way.norm();
        let largest = LARGEST_SHIFT * phase.spacing;
        *shift = if size > largest { way * (largest / size) } else { way };
    });
}
