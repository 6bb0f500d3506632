//! Field and memory that a law keeps of each particle beside the stress, and diffusion of the field among particles.
//!
//! A law declares its field once, as a [`LawField`]; the model stores it with the particle, sorts, saves and removes it
//! with it, and hands it to the law together with the elastic trial. Beside its field a law may keep up to [`MOST_MEMORIES`]
//! numbers, its memory, which go with the particle alike but stay its own. A field may diffuse. The model then adds up
//!
//! D ∇²f_a = Σ_b D w_ab (f_b − f_a) = gain − loss f_a, w_ab = −2 V_b F ≥ 0,
//!
//! over the neighbours b of a particle a (a graph Laplacian: no flux through a free surface by itself, and what one
//! particle takes another one gives, up to the ratio of their volumes) and gives the law the two sums. A law that takes
//! its loss at the end of the step, f (1/Δt + loss) = f⁰/Δt + gain, keeps f ≥ 0 for every Δt.

use super::TrialStress;
use crate::lanes::Real;
use crate::material::pore_liquid::PoreLiquid;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Condition on a field at a boundary.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum FieldBoundary {
    /// The field is zero there.
    Vanishing,
    /// Derivative along the normal is zero there.
    NoFlux,
}

/// Diffusion of a field among particles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldDiffusion {
    /// D, the factor of ∇²f in the law's equation of its field, in the unit of that equation times `[m²]`.
    pub strength: f64,
    /// Boundary condition at rough walls; at smooth walls and symmetry planes the flux is zero.
    pub wall: FieldBoundary,
    /// Boundary condition at the free surface.
    pub surface: FieldBoundary,
}

/// One number that a law keeps of each particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawField {
    /// Name, as files and pages have it.
    pub name: &'static str,
    /// Unit.
    pub unit: &'static str,
    /// Meaning of the field, in a few words.
    pub description: &'static str,
    /// Value of particles that a scene gives none, and of those that come in by an inlet.
    pub initial: f64,
    /// Least and largest value that it may start with.
    pub bounds: (f64, f64),
    /// Diffusion of the field; none for a memory of the particle alone.
    pub diffusion: Option<FieldDiffusion>,
}

impl LawField {
    /// Whether a value lies in its bounds.
    #[must_use]
    pub fn holds(&self, value: f64) -> bool {
        value >= self.bounds.0 && value <= self.bounds.1
    }
}

/// Largest number of values that a law may keep of each particle beside its field `[-]`.
pub const MOST_MEMORIES: usize = 3;

/// Memory of a particle beside the law's field, in the order and the units in which the law declares it; zero beyond
/// that.
pub type Memory<R> = [R; MOST_MEMORIES];

/// A field at the start of a step, what its neighbours do to it, and the law's memory beside it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct FieldStep<R> {
    /// Value at the start of the step.
    pub value: R,
    /// Σ D w f_b of the neighbours at the start of the step; 0 without diffusion.
    pub gain: R,
    /// Σ D w, with what walls and the surface take; 0 without diffusion.
    pub loss: R,
    /// Share by which the volume grows in the step `[-]`; 0 where the pressure is given.
    pub growth: R,
    /// Memory of the law beside the field, at the start of the step.
    pub memory: Memory<R>,
}

/// Memory of a particle under a law with a pore liquid, by name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PoreState<R> {
    /// Pressure of the liquid beyond the hydrostatic one `[Pa]`: the law's field.
    pub pressure: R,
    /// φ_0/φ − 1 of the plastic solid fraction `[-]`: the first memory.
    pub growth: R,
    /// Liquid that has passed to the free surface over the particle's volume `[-]`: the second memory.
    pub expelled: R,
}

impl<R: Real> PoreState<R> {
    /// Memory beside the field.
    #[inline(always)]
    pub(super) fn memory(self) -> Memory<R> {
        [self.growth, self.expelled, R::splat(0.0)]
    }
}

impl<R: Real> FieldStep<R> {
    /// Memory under a law with a pore liquid.
    #[inline(always)]
    pub fn pore(&self) -> PoreState<R> {
        let [growth, expelled, _] = self.memory;
        PoreState { pressure: self.value, growth, expelled }
    }

    /// A field that nothing is done to.
    #[inline(always)]
    pub fn alone(value: R) -> Self {
        Self::new(value, R::splat(0.0), R::splat(0.0))
    }

    /// A field with the two sums of its diffusion.
    #[inline(always)]
    pub fn new(value: R, gain: R, loss: R) -> Self {
        Self { value, gain, loss, growth: R::splat(0.0), memory: [R::splat(0.0); MOST_MEMORIES] }
    }

    /// The same with a memory.
    #[inline(always)]
    #[must_use]
    pub fn with_memory(self, memory: Memory<R>) -> Self {
        Self { memory, ..self }
    }
}

/// Stress and field at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FieldReturn<R> {
    /// Equivalent shear stress `[Pa]`.
    pub shear_stress: R,
    /// The field.
    pub field: R,
}

/// Stress, field and memory of a particle at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StateReturn<S, R> {
    /// Deviatoric stress `[Pa]`.
    pub stress: S,
    /// The law's field.
    pub field: R,
    /// Memory of the law beside its field.
    pub memory: Memory<R>,
}

impl<S, R: Real> StateReturn<S, R> {
    /// Field and memory, as the next step starts with them.
    #[inline(always)]
    pub fn kept(&self) -> FieldStep<R> {
        FieldStep::alone(self.field).with_memory(self.memory)
    }

    /// Stress and field, where nothing is kept beside.
    #[inline(always)]
    pub fn stress_and_field(self) -> (S, R) {
        (self.stress, self.field)
    }
}

/// A law that carries the stress along and keeps a field of each particle.
///
/// A cohesion is allowed: the stress up to which the material is elastic need not vanish with the pressure. Only a
/// law that bears tension carries a shear stress at p ≤ 0.
pub trait FieldLaw {
    /// Field that the law keeps of each particle.
    fn field(&self) -> LawField;

    /// Memory of a particle beside the field: up to [`MOST_MEMORIES`] numbers that do not diffuse.
    fn memories(&self) -> &[LawField] {
        &[]
    }

    /// Equivalent shear stress `[Pa]` and field at the end of a time step, from the elastic trial and the field before.
    /// The shear stress is at most the trial's. A step of no length leaves the field as it was.
    fn end_of_step<R: Real>(&self, trial: &TrialStress<R>, field: &FieldStep<R>) -> FieldReturn<R>;

    /// The memory at the end of the step that ended so. A step of no length leaves it as it was.
    #[inline(always)]
    fn memory_after<R: Real>(&self, _trial: &TrialStress<R>, field: &FieldStep<R>, _end: &FieldReturn<R>) -> Memory<R> {
        field.memory
    }

    /// Whether plastic flow changes the volume.
    fn dilates(&self) -> bool {
        false
    }

    /// Plastic volume strain e `[-]` that goes with a value of the field, where the law dilates: at the density ρ the pressure is that of the equation
    /// of state at ρ exp(e). Never falling with the plastic strain of a law that only dilates. Then the stress at the end of a step is that under
    /// [`TrialStress::dilated_pressure`].
    fn plastic_volume_strain<R: Real>(&self, _field: R) -> R {
        R::splat(0.0)
    }

    /// Liquid in the pores, if the law's field is its pressure. Then every pressure that the law is given is the total one, the grains' and the
    /// liquid's; field and memory are a [`PoreState`], and the field diffuses by the conductivity over that at the start.
    fn pore_liquid(&self) -> Option<PoreLiquid> {
        None
    }

    /// Elastic part of a particle at an equivalent shear stress and a pressure `[Pa]`, from 1 to 0 `[-]`; 0 without
    /// pressure. `elastic_viscosity` `[Pa·s]` is that of the damping which the elastic part feels.
    fn elasticity<R: Real>(&self, shear_stress: R, pressure: R, field: &FieldStep<R>, elastic_viscosity: f64) -> R;

    /// Part of the spin that turns the stress `[-]`: 1 where nothing flows, 0 where all of the shear is plastic.
    /// `vorticity` is |2ω| `[1/s]`.
    fn turned_part<R: Real>(
        &self,
        trial: &TrialStress<R>,
        before: &FieldStep<R>,
        end: &FieldReturn<R>,
        vorticity: R,
    ) -> R;

    /// Friction coefficient `[-]` of a contact with a rough wall.
    fn contact_friction(&self) -> f64;

    /// Whether it stands by itself, and so holds to rough walls with all of its volume: by friction, or by a cohesion.
    fn is_solid(&self) -> bool {
        self.contact_friction() > 0.0
    }

    /// Whether it may carry a shear stress at p < 0, where the equation of state keeps tension. Of such a law the shear stress
    /// is what it returns; without a pressure, and where that is not a number, it must return none.
    fn bears_tension(&self) -> bool {
        false
    }

    /// Whether its strength is proportional to the pressure. Without a cohesion yielding neighbours have about the same
    /// ratio of stress and pressure, which may then diffuse among them.
    fn strength_is_friction(&self) -> bool {
        true
    }

    /// Apparent viscosity τ/|γ̇| `[Pa·s]` of the steady, uniform flow at a shear rate `[1/s]` and a pressure `[Pa]`; finite
    /// also at rest. For diagnostics: the stress update does not use it.
    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64;

    /// The field of a flow at a shear rate `[1/s]` under a ratio of shear stress and pressure `[-]`, for scenes that start
    /// in motion.
    fn field_in_flow(&self, shear_rate: f64, stress_ratio: f64) -> f64;
}
