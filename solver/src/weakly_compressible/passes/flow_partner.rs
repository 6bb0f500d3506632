//! What the momentum equation reads of a flow particle and of the numerics.

use super::layout;
use super::records::{self, LaneRecord, Records};
use crate::lanes::{LaneIndices, Lanes};
use crate::weakly_compressible::model::Model;
use crate::weakly_compressible::numerics::ViscositySwitch;
use crate::weakly_compressible::terms::artificial_stress::ArtificialStress;

/// What is read of a flow particle.
pub(super) struct FlowPartner<V, const D: usize> {
    pub(super) position: [V; D],
    pub(super) velocity: [V; D],
    pub(super) density: V,
    /// √(p/ρ0) `[m/s]`.
    pub(super) pressure_speed: V,
    /// α of (15) `[-]`.
    pub(super) alpha: V,
    /// σE `[Pa]`.
    pub(super) corrected_stress: [[V; D]; D],
    pub(super) velocity_gradient: [[V; D]; D],
}

impl<V: Lanes, const D: usize> FlowPartner<V, D> {
    #[inline(always)]
    pub(super) fn load(records: &Records, indices: &LaneIndices<'_>) -> Self {
        let record: LaneRecord<V> = records.load(const { layout::momentum(D).div_ceil(4) }, indices);
        Self {
            position: records::vector(&record, 0),
            velocity: records::vector(&record, D),
            density: records::scalar(&record, 2 * D),
            pressure_speed: records::scalar(&record, 2 * D + 1),
            alpha: records::scalar(&record, 2 * D + 2),
            corrected_stress: records::tensor(&record, 2 * D + 3),
            velocity_gradient: records::tensor(&record, 2 * D + 3 + D * D),
        }
    }
}

/// What the loops need of the numerics.
pub(super) struct Constants {
    pub(super) smoothing_length: f64,
    /// h c `[m²/s]`.
    pub(super) speed_length: f64,
    /// k h `[m]` of the hourglass control.
    pub(super) hourglass_strength: f64,
    pub(super) artificial_viscosity: f64,
    pub(super) viscosity_switch: ViscositySwitch,
    pub(super) artificial_stress: Option<ArtificialStress>,
}

impl Constants {
    #[inline(always)]
    pub(super) fn of<const D: usize>(model: &Model<D>) -> Self {
        let smoothing_length = model.kernel.smoothing_length();
        Self {
            smoothing_length,
            speed_length: smoothing_length * model.equation_of_state.sound_speed(),
            hourglass_strength: model.numerics.hourglass * smoothing_length,
            artificial_viscosity: model.numerics.artificial_viscosity,
            viscosity_switch: model.numerics.viscosity_switch,
            artificial_stress: model.artificial_stress,
        }
    }
}
