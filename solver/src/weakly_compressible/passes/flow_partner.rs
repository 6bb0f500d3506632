//! Inputs of the momentum equation from a flow particle and from the numerics.

use super::layout::Momentum;
use super::precision::Precision;
use super::records::{self, LaneRecord};
use crate::lanes::Real;
use crate::weakly_compressible::terms::artificial_stress::ArtificialStress;
use crate::weakly_compressible::{Model, ViscositySwitch};

/// Neighbour data of a flow particle.
pub(super) struct FlowPartner<V, const D: usize> {
    pub(super) position: [V; D],
    pub(super) velocity: [V; D],
    pub(super) density: V,
    /// √(p/ρ0) `[m/s]`.
    pub(super) pressure_speed: V,
    /// α of (15) `[-]`, in double precision only.
    pub(super) alpha: V,
    /// σE `[Pa]`.
    pub(super) corrected_stress: [[V; D]; D],
    /// In single precision the coefficients of r_i r_j in ½ r·∇v r, i ≤ j.
    pub(super) velocity_gradient: [[V; D]; D],
}

impl<V: Real, const D: usize> FlowPartner<V, D> {
    #[inline(always)]
    pub(super) fn of<P: Precision>(record: &LaneRecord<V>) -> Self {
        let last = Momentum::<P, D>::LAST;
        Self {
            position: records::vector(record, 0),
            velocity: records::vector(record, Momentum::<P, D>::VELOCITY),
            density: records::scalar(record, Momentum::<P, D>::DENSITY),
            pressure_speed: records::scalar(record, Momentum::<P, D>::SPEED),
            alpha: if P::SINGLE { V::splat(0.0) } else { records::scalar(record, Momentum::<P, D>::ALPHA) },
            corrected_stress: records::tensor(record, Momentum::<P, D>::STRESS),
            velocity_gradient: if P::SINGLE { records::triangle(record, last) } else { records::tensor(record, last) },
        }
    }
}

/// Constants of the pair loops, from the numerics.
pub(super) struct Constants {
    pub(super) smoothing_length: f64,
    /// h c `[m²/s]`.
    pub(super) speed_length: f64,
    /// k h `[m]` of the hourglass control.
    pub(super) hourglass_strength: f64,
    pub(super) artificial_viscosity: f64,
    /// Whether the body is of grains: the artificial viscosity then acts on what no gradient explains alone. A liquid at rest needs all
    /// of it against its noise.
    pub(super) of_grains: bool,
    pub(super) reference_density: f64,
    /// C h² `[m²]` of the viscous bound.
    pub(super) viscous_step: f64,
    pub(super) viscosity_switch: ViscositySwitch,
    /// Whether walls turn.
    pub(super) turns: bool,
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
            of_grains: model.rheology.is_solid(),
            reference_density: model.equation_of_state.reference_density,
            viscous_step: model.numerics.viscous_courant * smoothing_length * smoothing_length,
            viscosity_switch: model.numerics.viscosity_switch,
            turns: model.turns,
            artificial_stress: model.artificial_stress,
        }
    }
}
