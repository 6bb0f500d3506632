//! Particle shifting: δr = −A h |u| Δt ∇C with C = Σ V W, after Xu et al. (2009) and Lind et al. (2012).
//!
//! In a shear flow particles line up along stream lines and leave gaps between; shifting fills them. None at the
//! surface and beside it, where ∇C is that of the surface, and no more than a part of a spacing.

use super::super::neighbours::{LEAST_TASK, Periods};
use super::super::numerics::ProjectionNumerics;
use super::super::phase::Phase;
use crate::lanes::{LANES, LanePass, Lanes};
use crate::vector::Vector;
use rayon::prelude::*;

/// Shifts of all particles `[m]` at their present positions.
pub(crate) fn find_shifts<const D: usize>(
    phase: &Phase<D>,
    periods: &Periods<D>,
    numerics: &ProjectionNumerics,
    time_step: f64,
    shifts: &mut Vec<Vector<D>>,
) {
    shifts.resize(phase.len(), Vector::zeros());
    shifts.par_chunks_mut(LEAST_TASK).enumerate().for_each(|(task, shifts)| {
        let first = task * LEAST_TASK;
        let (scale, largest) = (-numerics.shifting * time_step, numerics.largest_shift * phase.spacing);
        phase.free_pairs.set().run(Shift { phase, periods, scale, largest, first, shifts });
    });
}

/// The shifts of some particles.
struct Shift<'a, const D: usize> {
    phase: &'a Phase<D>,
    periods: &'a Periods<D>,
    /// −A Δt `[s]`.
    scale: f64,
    /// Longest shift `[m]`.
    largest: f64,
    first: usize,
    shifts: &'a mut [Vector<D>],
}

impl<const D: usize> LanePass for Shift<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let (phase, periods) = (self.phase, self.periods);
        let reach_squared = phase.kernel.support() * phase.kernel.support();
        let length = phase.kernel.smoothing_length();
        for (row, shift) in self.shifts.iter_mut().enumerate() {
            let a = self.first + row;
            *shift = Vector::zeros();
            if phase.at_surface[a] {
                continue;
            }
            let mut gradient = Vector::<D>::zeros();
            let mut beside_surface = false;
            for (pairs, sources) in [(&phase.free_pairs, &phase.position), (&phase.wall_pairs, &phase.wall)] {
                let (eights, mut left) = pairs.candidates(a);
                let free = std::ptr::eq(sources, &phase.position);
                for eight in eights {
                    let (separation, square) = periods.separations::<V>(&phase.position[a], sources, eight);
                    // W falls to zero at the reach: what lies beyond adds nothing
                    let weight = phase.kernel.gradient_weight(square, V::splat(phase.lattice_volume));
                    for axis in 0..D {
                        let terms = (separation[axis] * weight).to_array();
                        for term in &terms[..left.min(LANES)] {
                            gradient[axis] += term;
                        }
                    }
                    if free {
                        let square = square.to_array();
                        for lane in 0..left.min(LANES) {
                            beside_surface |= square[lane] < reach_squared && phase.at_surface[eight[lane] as usize];
                        }
                    }
                    left = left.saturating_sub(LANES);
                }
            }
            if beside_surface {
                continue;
            }
            let full = gradient * (self.scale * length * phase.velocity[a].norm());
            let size = full.norm();
            *shift = if size > self.largest { full * (self.largest / size) } else { full };
        }
    }
}
