//! Particle shifting: δr = −A h |u| Δt ∇C with C = Σ V W, after Xu et al. (2009) and Lind et al. (2012).
//!
//! In a shear flow particles line up along stream lines and leave gaps between; shifting fills them. None at the
//! surface and beside it, where ∇C is that of the surface, and no more than a part of a spacing.

use super::super::boundary::AT_SURFACE;
use super::super::phase::records;
use super::super::{LEAST_TASK, Periods, Phase, ProjectionNumerics};
use crate::lanes::algebra::{accumulate, difference, dot};
use crate::lanes::{LANES, LaneIndices, LanePass, Lanes, Real, gather, gather_vectors};
use crate::parallel::prelude::*;
use crate::vector::Vector;

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
        let first = task * (LEAST_TASK / LANES);
        let (scale, largest) = (-numerics.shifting * time_step, numerics.largest_shift * phase.spacing);
        phase.free.set.run(Shift { phase, periods, scale, largest, first, shifts });
    });
}

/// The shifts of some groups.
struct Shift<'a, const D: usize> {
    phase: &'a Phase<D>,
    periods: &'a Periods<D>,
    /// −A Δt `[s]`.
    scale: f64,
    /// Longest shift `[m]`.
    largest: f64,
    /// The first group.
    first: usize,
    shifts: &'a mut [Vector<D>],
}

impl<const D: usize> LanePass for Shift<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { phase, periods, .. } = self;
        let (zero, volume) = (V::splat(0.0), V::Single::splat(phase.lattice_volume));
        let reach_squared = V::splat(phase.kernel.support() * phase.kernel.support());
        let scale = self.scale * phase.kernel.smoothing_length();
        for (task_group, shifts) in self.shifts.chunks_mut(LANES).enumerate() {
            let global = self.first + task_group;
            let own_indices = records::group_indices(global, phase.len());
            let own = gather_vectors::<V, D>(&phase.position, &LaneIndices::new(&own_indices, phase.len()));
            let across = periods.across(&own, phase.kernel.support());
            let (mut gradient, mut deficit) = ([zero; D], zero);
            let group = global * LANES..(global * LANES + shifts.len());
            let near_surface = phase.nearness[group].iter().any(|&nearness| nearness > 0.0);
            for chunk in phase.free.group(global) {
                let other = gather_vectors::<V, D>(&phase.position, &chunk);
                let separation = periods.shortest_if(across, difference(&own, &other));
                let square = dot(&separation, &separation);
                if square.less_mask(reach_squared) == 0 {
                    continue;
                }
                // W falls to zero at the reach: what lies beyond adds nothing, nor does padding, which is the own particle
                let weight = V::widen(phase.kernel.gradient_weight(square.narrow(), volume));
                accumulate(&mut gradient, weight, &separation);
                if near_surface {
                    deficit = deficit.max(gather::<V>(&phase.deficit, &chunk).where_less(weight, zero));
                }
            }
            let candidates = phase.walls.counts::<V>(global);
            for (k, chunk) in phase.walls.group(global).enumerate() {
                let other = gather_vectors::<V, D>(&phase.wall, &chunk);
                let separation = periods.shortest_if(across, difference(&own, &other));
                let square = dot(&separation, &separation).narrow();
                let weight = V::widen(phase.kernel.gradient_weight(square, volume));
                accumulate(&mut gradient, weight.where_less(V::splat(k as f64), candidates), &separation);
            }
            let deficit = deficit.to_array();
            let mut crowding = [[0.0; LANES]; D];
            for axis in 0..D {
                crowding[axis] = gradient[axis].to_array();
            }
            for (lane, shift) in shifts.iter_mut().enumerate() {
                let a = global * LANES + lane;
                let beside_surface = phase.at_surface[a] || deficit[lane] > AT_SURFACE;
                let gradient = Vector::<D>::from_fn(|axis, _| crowding[axis][lane]);
                let full = gradient * (scale * phase.velocity[a].norm());
                let size = full.norm();
                let bounded = if size > self.largest { full * (self.largest / size) } else { full };
                *shift = if beside_surface { Vector::zeros() } else { bounded };
            }
        }
    }
}
