//! Steady flow of water and grains over a bed in one dimension: an independent check of two-phase particles.
//!
//! z is normal to the bed, 0 at its top before anything moves; φ is the solid fraction, θ the slope's angle.
//!
//! - water: 0 = (1 − φ) ρ_f g sinθ + ∂_z τ_f − f, τ_f = (1 − φ) ρ_f [ν + l² |∂_z u_f|] ∂_z u_f;
//! - grains: 0 = φ ρ_s g sinθ + ∂_z τ_s + f, τ_s = μ(I) p′ γ/√(γ² + γ_r²) + (1 − φ) ρ_f ν (η_s − 1) γ, γ = ∂_z u_s, I = |γ| d √(ρ_s/p′),
//!   η_s = 1 + 2.5 φ/(1 − φ/0.62) with φ at most 0.59 in its denominator: what grains add to the viscosity resists their
//!   own strain; water between grains that rest keeps its own viscosity;
//! - drag on the grains f = K (u_f − u_s); p′ = ∫_z φ (ρ_s − ρ_f) g cosθ dz;
//! - μ = μ_s + (μ_2 − μ_s) I/(I + I_0) and φ = φ_max/(1 + B I): the grains dilate where they are sheared;
//! - l = κ √(1 − z/h) [∫ (1 − φ/φ_max) dz + r]: eddies grow where grains leave them room, and start from the roughness r of
//!   grains that rest (the solver's `GrainRoughness`), which fades where grains have loosened.
//!
//! Where a turbulent Schmidt number is given, eddies carry a part of the weight (`suspension.rs`) and p′ is what remains.
//!
//! Both velocities vanish at the base, both stresses at z = h. Three ways to treat the grains ([`GrainMotion`]) isolate what a
//! two-phase program does: the flow over and through grains that rest (drag and turbulence), grains that move with a
//! given fraction (friction and both momenta), and all of it. Finite volumes of second order, no particles; of
//! the solver's laws it shares drag, viscosity of suspensions, roughness of grains and κ, and is compared with the others ([`Closures`]). Agreement verifies discretisations; that the model is right needs experiments.
//!
//! A steady state is sought from two starts ([`BedLoadLayer::steady_states`]); a bed that would slide on its base is refused,
//! and [`Stream::outside_bed_load`] says where the layer is not one of bed load (`domain.rs`).
//!
//! ```text
//! let layer =
//!     BedLoadLayer { stream, closures: Closures::default(), grains: Grains::Dilating, cell_height: 2.5e-4, steady_change: STEADY };
//! let state = layer.steady_states()?.single()?;    // from rest and from a fast start
//! let there = state.at(-1e-3);    // φ, both velocities, p′, both stresses, l and K at z = −1 mm
//! let frozen = BedLoadLayer { grains: Grains::Frozen(SolidFraction::of_cells(&state)), ..layer };
//! ```

mod block_tridiagonal;
mod closures;
mod column;
mod dilation;
mod domain;
mod measures;
mod profile;
mod solid_fraction;
mod states;
mod stream;
mod suspension;
#[cfg(test)]
mod tests;

pub use closures::{Closures, MixingLengthClosure};
pub use domain::{DIMENSIONLESS_DIAMETERS, OutsideBedLoad, RELATIVE_DEPTHS, SHIELDS_NUMBERS};
pub use measures::DragPeak;
pub use profile::{LayerPoint, LayerState};
pub use solid_fraction::SolidFractionProfile;
pub use states::{SAME_STATE, SteadyStates};
pub use stream::Stream;

use crate::one_dimension::LayerError;
use column::{Stride, TwoPhaseColumn};

/// A layer and how it is computed.
#[derive(Debug, Clone, PartialEq)]
pub struct BedLoadLayer {
    /// The stream.
    pub stream: Stream,
    /// Closures.
    pub closures: Closures,
    /// Motion of the grains.
    pub grains: GrainMotion,
    /// Height of a cell `[m]`; both depths and the held depth are whole multiples of it.
    pub cell_height: f64,
    /// Change of a step, of velocities over u_* and of fractions, below which a state counts as steady `[-]`; usually [`STEADY`].
    pub steady_change: f64,
}

/// Motion of the grains.
#[derive(Debug, Clone, PartialEq)]
pub enum GrainMotion {
    /// They rest at a given φ(z): flow over and through a porous bed, or clear water.
    Resting(SolidFractionProfile),
    /// They move, but their fraction stays as it is given.
    Frozen(SolidFractionProfile),
    /// They move and dilate. At the start they lie at φ_max below z = 0, and none is lost.
    Dilating,
}

/// The velocities from which the steady state is sought; it must not depend on them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum InitialVelocity {
    /// Nothing moves.
    Rest,
    /// Water and upper grains have a speed `[m/s]` from 15 mm upwards, and in proportion less down to 5 mm below the bed's
    /// top (for grains of 5 mm: 3 d and −d).
    Moving(f64),
}

impl InitialVelocity {
    fn velocity(self, z: f64, stream: &Stream) -> f64 {
        match self {
            Self::Rest => 0.0,
            Self::Moving(speed) => speed * (0.25 * (z / stream.grain_diameter + 1.0)).clamp(0.0, 1.0),
        }
    }
}

/// Last state of the time steps, with its distance from a steady state.
#[derive(Debug, Clone, PartialEq)]
pub struct Approach {
    /// The last state.
    pub state: LayerState,
    /// Time steps taken.
    pub steps: usize,
    /// Length of a time step `[s]`.
    pub time_step: f64,
    /// Reason for an unsteady state; none for a steady one.
    pub unsteady: Option<String>,
}

/// Largest number of time steps; a few hundred are usual.
pub const LARGEST_STEPS: usize = 12_000;

/// Change of a step at which both starts of every layer have met `[-]`: hardly more than rounding.
pub const STEADY: f64 = 1e-11;

/// Time step over h/u_*: only a means to the steady state.
const TIME_STEP: f64 = 0.75;

/// Share of the secant in the derivative of the grains' stress `[-]`: fast, and from a step on sure, for the few layers
/// that swing under the first.
const TOWARDS_SECANT: (f64, f64) = (0.3, 1.0);

/// The step from which on it is sure.
const SURE_FROM: usize = 1000;

/// The step from which on the time step is short, for layers that still swing, and its length over the usual one.
const SHORT: (usize, f64) = (3000, 0.125);

impl BedLoadLayer {
    /// The steady state.
    ///
    /// # Errors
    /// Parameters out of range, or no steady state within [`LARGEST_STEPS`].
    pub fn steady(&self, start: InitialVelocity) -> Result<LayerState, LayerError> {
        self.steady_unless(start, &|| false)
    }

    fn steady_unless(&self, start: InitialVelocity, stopped: &dyn Fn() -> bool) -> Result<LayerState, LayerError> {
        let approach = self.approach_unless(start, stopped)?;
        match approach.unsteady {
            None => Ok(approach.state),
            Some(reason) => Err(LayerError::NotSteady { reason, steps: approach.steps }),
        }
    }

    /// Steps until nothing changes any more or the steps are used up, and says which.
    ///
    /// # Errors
    /// Parameters out of range.
    pub fn approach(&self, start: InitialVelocity) -> Result<Approach, LayerError> {
        self.approach_unless(start, &|| false)
    }

    /// [`Self::approach`], unless `stopped` says between two steps that the layer is no longer wanted; it is then unsteady.
    ///
    /// # Errors
    /// Parameters out of range.
    pub fn approach_unless(&self, start: InitialVelocity, stopped: &dyn Fn() -> bool) -> Result<Approach, LayerError> {
        self.check()?;
        let shear_velocity = self.stream.shear_velocity();
        let usual_step = TIME_STEP * self.stream.flow_depth / shear_velocity;
        let mut column = TwoPhaseColumn::new(self, start);
        let mut steps = 0;
        loop {
            let last_good = column.clone();
            let towards_secant = if steps < SURE_FROM { TOWARDS_SECANT.0 } else { TOWARDS_SECANT.1 };
            let time_step = if steps < SHORT.0 { usual_step } else { SHORT.1 * usual_step };
            let change = column.step(Stride { time_step, towards_secant });
            steps += 1;
            let (velocity_change, fraction_change) = (change.velocity / shear_velocity, change.fraction);
            let steady = velocity_change < self.steady_change && fraction_change < self.steady_change;
            let unsteady = if !change.velocity.is_finite() {
                column = last_good;
                Some("a velocity is no longer a finite number".to_owned())
            } else if stopped() {
                Some("it was stopped".to_owned())
            } else if change.left_over > 1e-9 * self.stream.bed_stress() && (steady || steps == LARGEST_STEPS) {
                Some(format!("the grains need {:.2e} Pa of room above the water's surface", change.left_over))
            } else if steps == LARGEST_STEPS {
                Some(format!("a step still changes u/u_* by {velocity_change:.1e} and φ by {fraction_change:.1e}"))
            } else if steady {
                None
            } else {
                continue;
            };
            let state = column.state();
            return Ok(Approach { state, steps, time_step, unsteady });
        }
    }

    /// Number of cells.
    pub fn cells(&self) -> usize {
        ((self.stream.bed_depth + self.stream.flow_depth) / self.cell_height).round() as usize
    }

    /// z of a face `[m]`, counted from the base.
    fn face(&self, face: usize) -> f64 {
        let below = (self.stream.bed_depth / self.cell_height).round();
        (face as f64 - below) * self.cell_height
    }

    /// Checks every parameter.
    ///
    /// # Errors
    /// The first that is out of its range.
    pub fn check(&self) -> Result<(), LayerError> {
        let Self { stream, closures, .. } = self;
        let refuse = |field, value, rule| Err(LayerError::Parameter { field, value, rule });
        LayerError::unless_positive([
            ("slope", stream.slope),
            ("flow_depth", stream.flow_depth),
            ("gravity", stream.gravity),
            ("fluid_density", stream.fluid_density),
            ("kinematic_viscosity", stream.kinematic_viscosity),
            ("grain_diameter", stream.grain_diameter),
            ("drag_diameter", stream.drag_diameter),
            ("cell_height", self.cell_height),
            ("steady_change", self.steady_change),
            ("static_friction", closures.static_friction),
            ("reference_inertia", closures.reference_inertia),
            ("regularisation_rate", closures.regularisation_rate),
            ("largest_fraction", closures.largest_fraction),
            ("karman", closures.karman),
            ("bed_roughness_fade_length", closures.grain_roughness.bed_roughness_fade_length),
        ])?;
        let not_negative = [
            ("dilation", closures.dilation),
            ("origin_depth", closures.grain_roughness.origin_depth),
            ("turbulent_schmidt", closures.turbulent_schmidt),
            ("bed_depth", stream.bed_depth),
            ("held_depth", stream.held_depth),
        ];
        for (field, value) in not_negative {
            if !(value >= 0.0 && value.is_finite()) {
                return refuse(field, value, "finite and not negative");
            }
        }
        if !(stream.grain_density > stream.fluid_density && stream.grain_density.is_finite()) {
            return refuse("grain_density", stream.grain_density, "finite and greater than the water's");
        }
        if closures.largest_fraction >= 1.0 {
            return refuse("largest_fraction", closures.largest_fraction, "less than 1");
        }
        if !(closures.limiting_friction > closures.static_friction && closures.limiting_friction.is_finite()) {
            return refuse(
                "limiting_friction",
                closures.limiting_friction,
                "finite and greater than the static friction",
            );
        }
        for (field, depth) in
            [("flow_depth", stream.flow_depth), ("bed_depth", stream.bed_depth), ("held_depth", stream.held_depth)]
        {
            let cells = depth / self.cell_height;
            if (cells - cells.round()).abs() > 1e-6 || cells > 1e6 {
                return refuse(field, depth, "a whole multiple of the cell's height");
            }
        }
        if self.grains == GrainMotion::Dilating && stream.bed_depth <= 0.0 {
            return refuse("bed_depth", stream.bed_depth, "greater than 0 if the grains dilate: they come from there");
        }
        if stream.held_depth > stream.bed_depth {
            return refuse("held_depth", stream.held_depth, "at most the depth of the bed");
        }
        if self.grains == GrainMotion::Dilating { stream.check_sliding(closures) } else { Ok(()) }
    }
}
