//! What a wall particle does to a flow particle in the momentum equation: read by the pass of the forces, and by the one
//! that books them to facet walls.

use super::flow_partner::{Constants, FlowPartner};
use super::layout;
use super::records::{self, LaneRecord, Records};
use crate::lanes::algebra::{difference, scaled};
use crate::lanes::{LaneIndices, Lanes, Real};
use crate::weakly_compressible::terms::{hourglass, stress_divergence, wall_slip};

/// What is read of a wall particle: records of the length of [`FlowPartner`]'s with a layout of their own.
pub(super) struct WallPartner<V, const D: usize> {
    pub(super) position: [V; D],
    /// Velocity of the wall itself.
    pub(super) velocity: [V; D],
    /// Depth behind the surface `[m]`.
    pub(super) depth: V,
    /// √(p/ρ0) `[m/s]`.
    pub(super) pressure_speed: V,
    /// σ `[Pa]`.
    pub(super) stress: [[V; D]; D],
    pub(super) normal: [V; D],
}

impl<V: Lanes, const D: usize> WallPartner<V, D> {
    #[inline(always)]
    pub(super) fn load(records: &Records, indices: &LaneIndices<'_>) -> Self {
        let record: LaneRecord<V> = records.load(const { layout::momentum(D).div_ceil(4) }, indices);
        Self {
            position: records::vector(&record, 0),
            velocity: records::vector(&record, D),
            depth: records::scalar(&record, 2 * D),
            pressure_speed: records::scalar(&record, 2 * D + 1),
            stress: records::tensor(&record, 2 * D + 3),
            normal: records::vector(&record, 2 * D + 3 + D * D),
        }
    }
}

/// The parts of a pair's force, both still to be multiplied by the pair's weight V F.
pub(super) struct WallPair<V, const D: usize> {
    /// Traction `[Pa m]`: over ρ_a an acceleration.
    pub(super) traction: [V; D],
    /// 2 ν `[m²/s]` of the hourglass control.
    pub(super) drag: V,
    /// Velocity that it acts on `[m/s]`.
    pub(super) unexplained: [V; D],
}

impl<V: Real, const D: usize> WallPair<V, D> {
    #[inline(always)]
    pub(super) fn of(
        constants: &Constants,
        own: &FlowPartner<V, D>,
        wall: &WallPartner<V, D>,
        correction: &[[V; D]; D],
    ) -> Self {
        Self::at(constants, own, wall, correction, &difference(&own.position, &wall.position))
    }

    /// The same at a distance r `[m]` of its own.
    #[inline(always)]
    pub(super) fn at(
        constants: &Constants,
        own: &FlowPartner<V, D>,
        wall: &WallPartner<V, D>,
        correction: &[[V; D]; D],
        r: &[V; D],
    ) -> Self {
        let beta = wall_slip::factor(r, &wall.normal, wall.depth, constants.smoothing_length, wall_slip::LIMIT);
        let slip = scaled(beta, &difference(&own.velocity, &wall.velocity));
        let traction = stress_divergence::wall_traction(&own.corrected_stress, &wall.stress, correction, r);
        let speed_sum = own.pressure_speed + wall.pressure_speed;
        let drag = hourglass::twice_viscosity::<V>(constants.hourglass_strength, speed_sum);
        let unexplained = hourglass::unexplained_at_wall(&slip, &own.velocity_gradient, r, &wall.normal);
        Self { traction, drag, unexplained }
    }
}
