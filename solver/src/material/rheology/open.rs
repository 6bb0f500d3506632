//! Laws of a user's own crate, in f64 and boxed: slower than the built-in ones, which are compiled for lanes.
//!
//! ```
//! use bagnold_solver::material::rheology::open::{OpenLaw, Parameters, RegistrationError, register};
//! use bagnold_solver::material::rheology::{Rheology, ViscousLaw};
//!
//! #[derive(Debug, serde::Deserialize)]
//! #[serde(deny_unknown_fields)]
//! struct PowerLaw {
//!     consistency: f64,
//!     flow_index: f64,
//! }
//!
//! impl ViscousLaw for PowerLaw {
//!     fn viscosity(&self, shear_rate: f64, _pressure: f64) -> f64 {
//!         self.consistency * shear_rate.max(0.01).powf(self.flow_index - 1.0)
//!     }
//!     fn largest_viscosity(&self, pressure: f64) -> f64 {
//!         self.viscosity(0.0, pressure)
//!     }
//! }
//!
//! register("power-law", |parameters: &Parameters| Ok(OpenLaw::viscous(parameters.read::<PowerLaw>()?)))?;
//! let law = Rheology::open("power-law", &[("consistency", 2.0), ("flow_index", 0.5)])?;
//! assert_eq!(law.viscosity(4.0, 0.0), 1.0);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! From then on `law = "power-law"` finds it wherever a [`Rheology`](super::Rheology) is read.

mod declaration;
mod error;
mod registry;
mod table;

#[cfg(test)]
mod tests;

pub use error::{OpenLawError, RegistrationError};
pub use registry::{Maker, built_in, register, registered};
pub use table::Parameters;
pub(super) use table::Written;

use super::field::{FieldLaw, FieldReturn, FieldStep, LawField, Memory};
use super::{PlasticLaw, TrialStress, ViscousLaw};
use crate::lanes::Real;
use std::fmt::Debug;

/// A plastic law in f64: what [`PlasticLaw`] asks for, with the same meaning.
pub trait OpenPlasticLaw: Debug + Send + Sync {
    /// Equivalent shear stress `[Pa]` at the end of a time step: the trial up to the yield stress. In a step of no length
    /// nothing flows: there it is the trial, up to the shear stress of the fastest flow where the law has one.
    fn admissible_shear_stress(&self, trial: &TrialStress<f64>) -> f64;

    /// Equivalent shear stress `[Pa]` up to which the material is elastic, at a pressure `[Pa]`. A cohesion is allowed.
    fn yield_stress(&self, pressure: f64) -> f64;

    /// Apparent viscosity τ/|γ̇| `[Pa·s]` of the steady flow at a shear rate `[1/s]` and a pressure `[Pa]`; finite also
    /// at rest.
    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64;

    /// Friction coefficient `[-]` of a contact with a rough wall. A cohesion is no friction, and a law with 0 counts as a
    /// liquid.
    fn contact_friction(&self) -> f64;
}

/// A plastic law in f64 with a field of its own: what it keeps of each particle beside the stress, such as the plastic strain
/// that it has softened by. A cohesion is allowed.
pub trait OpenFieldLaw: Debug + Send + Sync {
    /// Field that the law keeps of each particle.
    fn field(&self) -> LawField;

    /// Memory of a particle beside the field: up to [`MOST_MEMORIES`](super::field::MOST_MEMORIES) numbers that do not
    /// diffuse.
    fn memories(&self) -> &[LawField] {
        &[]
    }

    /// Equivalent shear stress `[Pa]`, at most the trial's, and field at the end of a time step. A step of no length leaves the
    /// field as it was. The plastic strain of a step is (τ* − τ)/G.
    fn end_of_step(&self, trial: &TrialStress<f64>, field: &FieldStep<f64>) -> FieldReturn<f64>;

    /// Whether plastic flow changes the volume.
    fn dilates(&self) -> bool {
        false
    }

    /// Plastic volume strain e `[-]` that goes with a value of its field, where the law dilates: at the density ρ the pressure is that of the equation of
    /// state at ρ exp(e). The stress at the end of a step is then that under `trial.dilated_pressure(e − e⁰)`, with e⁰ of the
    /// field before.
    fn plastic_volume_strain(&self, _field: f64) -> f64 {
        0.0
    }

    /// Memory beside the field at the end of the step that ended so, zero beyond the declared numbers. A step of no
    /// length leaves it as it was.
    fn memory_after(&self, _trial: &TrialStress<f64>, field: &FieldStep<f64>, _end: &FieldReturn<f64>) -> Memory<f64> {
        field.memory
    }

    /// Equivalent shear stress `[Pa]` up to which the material is elastic, at a pressure `[Pa]`, a value of its field and a memory.
    fn yield_stress(&self, pressure: f64, field: &FieldStep<f64>) -> f64;

    /// Apparent viscosity τ/|γ̇| `[Pa·s]` of the steady flow at a shear rate `[1/s]` and a pressure `[Pa]`; finite also
    /// at rest.
    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64;

    /// Friction coefficient `[-]` of a contact with a rough wall, a question of its own: a cohesion is no friction.
    fn contact_friction(&self) -> f64;

    /// The field of a flow at a shear rate `[1/s]` under a ratio of shear stress and pressure `[-]`, for scenes that start in
    /// motion: its initial value, if the law says nothing else.
    fn field_in_flow(&self, _shear_rate: f64, _stress_ratio: f64) -> f64 {
        self.field().initial
    }
}

/// A viscous law that can be shared between threads.
trait OpenViscousLaw: ViscousLaw + Debug + Send + Sync {}

impl<L: ViscousLaw + Debug + Send + Sync> OpenViscousLaw for L {}

/// A law of a user's own crate, of one of the three kinds.
#[derive(Debug)]
pub struct OpenLaw(Kind);

#[derive(Debug)]
enum Kind {
    Viscous(Box<dyn OpenViscousLaw>),
    Plastic(Box<dyn OpenPlasticLaw>),
    WithField(Box<dyn OpenFieldLaw>),
}

impl OpenLaw {
    /// A law whose stress follows from the present strain rate alone.
    pub fn viscous(law: impl ViscousLaw + Debug + Send + Sync + 'static) -> Self {
        Self(Kind::Viscous(Box::new(law)))
    }

    /// A law that carries the stress along.
    pub fn plastic(law: impl OpenPlasticLaw + 'static) -> Self {
        Self(Kind::Plastic(Box::new(law)))
    }

    /// A law that carries the stress along and keeps a field of each particle.
    pub fn with_field(law: impl OpenFieldLaw + 'static) -> Self {
        Self(Kind::WithField(Box::new(law)))
    }
}

/// A law with its name and its parameters, made once for the life of the program.
#[derive(Debug)]
struct Instance<L: ?Sized + 'static> {
    name: &'static str,
    parameters: Parameters,
    law: Box<L>,
}

macro_rules! open_law {
    ($(#[$doc:meta])* $name:ident, $law:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy)]
        pub struct $name(&'static Instance<dyn $law>);

        impl $name {
            /// The name that its `law` key has.
            #[must_use]
            pub fn name(self) -> &'static str {
                self.0.name
            }

            /// Parameters.
            #[must_use]
            pub fn parameters(self) -> &'static Parameters {
                &self.0.parameters
            }

            pub(super) fn written(self) -> Written {
                Written { name: self.0.name, parameters: &self.0.parameters }
            }
        }

        impl PartialEq for $name {
            fn eq(&self, other: &Self) -> bool {
                self.0.name == other.0.name && self.0.parameters == other.0.parameters
            }
        }
    };
}

open_law! {
    /// A registered viscous law with its parameters.
    OpenViscous, OpenViscousLaw
}
open_law! {
    /// A registered plastic law with its parameters.
    OpenPlastic, OpenPlasticLaw
}
open_law! {
    /// A registered law with a field of its own, with its parameters.
    OpenField, OpenFieldLaw
}

impl ViscousLaw for OpenViscous {
    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64 {
        self.0.law.viscosity(shear_rate, pressure)
    }

    fn largest_viscosity(&self, pressure: f64) -> f64 {
        self.0.law.largest_viscosity(pressure)
    }

    fn contact_friction(&self) -> f64 {
        self.0.law.contact_friction()
    }
}

impl PlasticLaw for OpenPlastic {
    fn admissible_shear_stress<R: Real>(&self, trial: &TrialStress<R>) -> R {
        let &TrialStress { shear_modulus, time_step, .. } = trial;
        R::lane_by_lane([trial.shear_stress, trial.pressure], &|[shear_stress, pressure]| {
            self.0.law.admissible_shear_stress(&TrialStress::new(shear_stress, pressure, shear_modulus, time_step))
        })
    }

    fn yield_stress<R: Real>(&self, pressure: R) -> R {
        R::lane_by_lane([pressure], &|[pressure]| self.0.law.yield_stress(pressure))
    }

    fn contact_friction(&self) -> f64 {
        self.0.law.contact_friction()
    }

    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64 {
        self.0.law.viscosity(shear_rate, pressure)
    }
}

/// Below its yield stress by more than this part of it a material is wholly elastic `[-]`.
const YIELDING: f64 = 0.01;

impl FieldLaw for OpenField {
    fn field(&self) -> LawField {
        self.0.law.field()
    }

    fn end_of_step<R: Real>(&self, trial: &TrialStress<R>, field: &FieldStep<R>) -> FieldReturn<R> {
        let [first, second, third] = field.memory;
        let values = [trial.shear_stress, trial.pressure, field.value, field.gain, field.loss, first, second, third];
        let end = |[shear_stress, pressure, value, gain, loss, first, second, third]: [f64; 8]| {
            let trial = trial.at(shear_stress, pressure);
            self.0.law.end_of_step(&trial, &FieldStep::new(value, gain, loss).with_memory([first, second, third]))
        };
        FieldReturn {
            shear_stress: R::lane_by_lane(values, &|values| end(values).shear_stress),
            field: R::lane_by_lane(values, &|values| end(values).field),
        }
    }

    fn dilates(&self) -> bool {
        self.0.law.dilates()
    }

    fn plastic_volume_strain<R: Real>(&self, field: R) -> R {
        R::lane_by_lane([field], &|[field]| self.0.law.plastic_volume_strain(field))
    }

    fn memories(&self) -> &[LawField] {
        self.0.law.memories()
    }

    fn memory_after<R: Real>(&self, trial: &TrialStress<R>, field: &FieldStep<R>, end: &FieldReturn<R>) -> Memory<R> {
        if self.0.law.memories().is_empty() {
            return field.memory;
        }
        let [first, second, third] = field.memory;
        let values = [
            trial.shear_stress,
            trial.pressure,
            field.value,
            field.gain,
            field.loss,
            first,
            second,
            third,
            end.shear_stress,
            end.field,
        ];
        let after = |values: [f64; 10]| {
            let [shear_stress, pressure, value, gain, loss, first, second, third, at_end, field] = values;
            let trial = trial.at(shear_stress, pressure);
            let before = FieldStep::new(value, gain, loss).with_memory([first, second, third]);
            self.0.law.memory_after(&trial, &before, &FieldReturn { shear_stress: at_end, field })
        };
        std::array::from_fn(|place| R::lane_by_lane(values, &|values| after(values)[place]))
    }

    fn elasticity<R: Real>(&self, shear_stress: R, pressure: R, field: &FieldStep<R>, _elastic_viscosity: f64) -> R {
        let [first, second, third] = field.memory;
        let values = [shear_stress, pressure, field.value, first, second, third];
        R::lane_by_lane(values, &|[shear_stress, pressure, field, first, second, third]| {
            let kept = FieldStep::alone(field).with_memory([first, second, third]);
            let yield_stress = self.0.law.yield_stress(pressure, &kept);
            if pressure > 0.0 && yield_stress > 0.0 {
                ((1.0 - shear_stress / yield_stress) / YIELDING).clamp(0.0, 1.0)
            } else {
                0.0
            }
        })
    }

    /// All of it up to the yield stress of the start of the step, nothing beyond.
    fn turned_part<R: Real>(
        &self,
        trial: &TrialStress<R>,
        before: &FieldStep<R>,
        _end: &FieldReturn<R>,
        _vorticity: R,
    ) -> R {
        let [first, second, third] = before.memory;
        let values = [trial.shear_stress, trial.pressure, before.value, first, second, third];
        R::lane_by_lane(values, &|[shear_stress, pressure, field, first, second, third]| {
            let kept = FieldStep::alone(field).with_memory([first, second, third]);
            if self.0.law.yield_stress(pressure, &kept) < shear_stress { 0.0 } else { 1.0 }
        })
    }

    fn contact_friction(&self) -> f64 {
        self.0.law.contact_friction()
    }

    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64 {
        self.0.law.viscosity(shear_rate, pressure)
    }

    fn field_in_flow(&self, shear_rate: f64, stress_ratio: f64) -> f64 {
        self.0.law.field_in_flow(shear_rate, stress_ratio)
    }
}
