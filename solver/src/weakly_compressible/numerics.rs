//! The numerical choices of a run; the default is the recipe, [`Numerics::paper`] the paper's own set.

use crate::kernel::KernelShape;
use crate::material::rheology::Rheology;
use crate::parameter::{ParameterProblem, between, up_to};
use crate::weakly_compressible::{Surface, WallTreatment};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Discrete momentum equation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MomentumOperator {
    /// One divergence of the whole stress with the kernel correction of each particle (default).
    SingleDivergence,
    /// The same divergence without kernel correction.
    UncorrectedDivergence,
    /// The single divergence with the kernel correction for all laws with a friction; for liquids with the share of it that
    /// [`correction_share`] gives to their motion: none at rest, where forces must do no work that the density does not answer.
    ///
    /// [`correction_share`]: crate::weakly_compressible::terms::common_motion::correction_share
    ByLaw,
    /// Pressure (10) and pairwise viscosity (11).
    Pairwise,
    /// Pressure (10) and pairwise viscosity with Schwaiger's correction (13).
    PairwiseCorrected,
}

/// Choice of the artificial viscosity's coefficient.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ViscositySwitch {
    /// The same everywhere.
    Constant,
    /// Morris & Monaghan's switch (16) between 0.1 and 1.
    MorrisMonaghan,
}

/// Whether particles very near a wall are stopped from approaching it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Contact {
    /// Within half a spacing.
    HalfSpacing,
    /// Not at all.
    None,
}

/// Precision of the terms of a pair; what particles keep, and sums over pairs, are always double.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PairPrecision {
    /// f64.
    Double,
    /// f32, with positions as integers whose differences are exact: faster, and half the memory (default). What it does not serve (pairwise
    /// operators, Morris & Monaghan's switch, implicit viscous steps) stays double.
    Single,
}

/// Velocity that a viscous law's stress is taken from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ViscousStep {
    /// At the old velocity, with the bound ρh²/η of (29) on the time step. Laws by return mapping know no other.
    Explicit,
    /// At the new velocity, by a linear solve in every step and without that bound.
    Implicit,
}

/// Remedy for numerics out of range.
const DEFAULTS: &str = "see the default numerics with `bagnold show`";

/// Numerical parameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Numerics {
    /// Smoothing kernel.
    pub kernel: KernelShape,
    /// Smoothing length over particle spacing h/Δ `[-]`.
    #[schemars(transform = between(1.0, 2.5, DEFAULTS))]
    pub smoothing_ratio: f64,
    /// Discrete momentum equation.
    pub momentum_operator: MomentumOperator,
    /// Wall particles.
    pub wall_treatment: WallTreatment,
    /// Contact insurance at walls.
    pub contact: Contact,
    /// σ of the density–pressure coupling (27) `[-]`; 0 switches it off. Laws with a cohesion go without it.
    #[schemars(transform = between(0.0, 10.0, DEFAULTS))]
    pub density_coupling: f64,
    /// α_Π of the artificial viscosity (15) `[-]`.
    #[schemars(transform = between(0.0, 2.0, DEFAULTS))]
    pub artificial_viscosity: f64,
    /// Switch of the artificial viscosity.
    pub viscosity_switch: ViscositySwitch,
    /// C_s of the eddy viscosity (5) `[-]`; 0 switches it off.
    #[schemars(transform = between(0.0, 1.0, DEFAULTS))]
    pub smagorinsky_constant: f64,
    /// Coefficient of the velocity hourglass control `[-]`, along the line between two flow particles and along the normal of walls.
    #[schemars(transform = between(0.0, 2.0, DEFAULTS))]
    pub hourglass: f64,
    /// Diffusion δ of the stress ratio among yielding particles, as a diffusivity δ c h `[-]`; 0 switches it off.
    #[schemars(transform = between(0.0, 1.0, DEFAULTS))]
    pub stress_diffusion: f64,
    /// Damping ζ of elastic shear below the yield, as a viscosity ζ ρ0 c_s h `[-]`; none where the material yields.
    #[schemars(transform = between(0.0, 1.0, DEFAULTS))]
    pub elastic_damping: f64,
    /// Elastic shear modulus over bulk modulus G/K `[-]`, for laws with a yield by return mapping.
    #[schemars(transform = up_to(1.5, DEFAULTS))]
    pub shear_modulus_ratio: f64,
    /// Largest Courant number of the sound speed `[-]`.
    #[schemars(transform = up_to(1.0, DEFAULTS))]
    pub acoustic_courant: f64,
    /// Largest Courant number of the flow speed `[-]`.
    #[schemars(transform = up_to(1.0, DEFAULTS))]
    pub advective_courant: f64,
    /// Coefficient of the explicit viscous bound ρh²/η `[-]`.
    #[schemars(transform = up_to(1.0, DEFAULTS))]
    pub viscous_courant: f64,
    /// Precision of the terms of a pair.
    pub pair_precision: PairPrecision,
    /// Viscous stress before or after the step.
    pub viscous_step: ViscousStep,
    /// Share of the net acceleration that an implicit viscous step may leave without its viscous answer `[-]`, both as
    /// root mean squares.
    #[schemars(transform = between(1e-10, 0.5, DEFAULTS))]
    pub viscous_tolerance: f64,
    /// Skin of the neighbour list over the kernel's support `[-]`.
    #[schemars(transform = up_to(1.0, DEFAULTS))]
    pub verlet_skin: f64,
}

impl Default for Numerics {
    fn default() -> Self {
        Self {
            kernel: KernelShape::WendlandC2,
            smoothing_ratio: 1.5,
            momentum_operator: MomentumOperator::SingleDivergence,
            wall_treatment: WallTreatment::Extrapolated,
            contact: Contact::HalfSpacing,
            density_coupling: 1.0,
            artificial_viscosity: 0.02,
            viscosity_switch: ViscositySwitch::Constant,
            smagorinsky_constant: 0.0,
            hourglass: 0.4,
            stress_diffusion: 0.1,
            elastic_damping: 0.5,
            shear_modulus_ratio: 0.3,
            acoustic_courant: 0.4,
            advective_courant: 0.25,
            viscous_courant: 0.2,
            pair_precision: PairPrecision::Single,
            viscous_step: ViscousStep::Explicit,
            viscous_tolerance: 0.1,
            verlet_skin: 0.1,
        }
    }
}

impl Numerics {
    /// The paper's own set: cubic spline, pairwise operators, Morris–Adami walls, (16), (29) with C = 0.2.
    #[must_use]
    pub fn paper() -> Self {
        Self {
            kernel: KernelShape::CubicSpline,
            smoothing_ratio: 1.3,
            momentum_operator: MomentumOperator::PairwiseCorrected,
            wall_treatment: WallTreatment::Paper,
            contact: Contact::None,
            artificial_viscosity: 0.1,
            viscosity_switch: ViscositySwitch::MorrisMonaghan,
            hourglass: 0.0,
            stress_diffusion: 0.0,
            acoustic_courant: 0.2,
            advective_courant: 0.2,
            ..Self::default()
        }
    }

    /// Share of each particle's kernel correction in its momentum equation `[-]`, with a law; none if it follows from the motion.
    #[must_use]
    pub fn force_correction(&self, law: &Rheology) -> Option<f64> {
        match self.momentum_operator {
            MomentumOperator::SingleDivergence => Some(1.0),
            MomentumOperator::ByLaw => law.is_solid().then_some(1.0),
            MomentumOperator::UncorrectedDivergence
            | MomentumOperator::Pairwise
            | MomentumOperator::PairwiseCorrected => Some(0.0),
        }
    }

    /// Whether the terms of pairs are single precision: asked for, and served by these numerics.
    #[must_use]
    pub fn pairs_in_single(&self) -> bool {
        self.pair_precision == PairPrecision::Single
            && self.pairwise_operator().is_none()
            && self.viscosity_switch == ViscositySwitch::Constant
            && self.viscous_step == ViscousStep::Explicit
    }

    /// The name of the momentum operator, where it is one of the pairwise ones.
    #[must_use]
    pub fn pairwise_operator(&self) -> Option<&'static str> {
        match self.momentum_operator {
            MomentumOperator::SingleDivergence | MomentumOperator::UncorrectedDivergence | MomentumOperator::ByLaw => {
                None
            }
            MomentumOperator::Pairwise => Some("pairwise"),
            MomentumOperator::PairwiseCorrected => Some("pairwise-corrected"),
        }
    }

    /// The choice that a wall with this surface excludes: only the single divergence with extrapolated walls knows
    /// smooth ones.
    #[must_use]
    pub fn wall_problem(&self, roughness: Surface) -> Option<ParameterProblem> {
        if roughness == Surface::Rough {
            return None;
        }
        if let Some(operator) = self.pairwise_operator() {
            return Some(ParameterProblem::new(
                "momentum_operator",
                operator,
                "\"single-divergence\" or \"uncorrected-divergence\" with a smooth wall, such as a gate",
                "the pairwise operators support rough walls only; choose one of these, or leave the gate out",
            ));
        }
        (self.wall_treatment == WallTreatment::Paper).then(|| {
            let rule = "\"extrapolated\" with a smooth wall, such as a gate";
            let remedy = "the paper's walls are always rough; choose \"extrapolated\", or leave the gate out";
            ParameterProblem::new("wall_treatment", "paper", rule, remedy)
        })
    }

    /// The choice that goes neither with the law nor with the momentum operator: an implicit step needs a viscosity and
    /// the divergence whose transpose it is solved with.
    #[must_use]
    pub fn step_problem(&self, law: &Rheology) -> Option<ParameterProblem> {
        if self.viscous_step == ViscousStep::Explicit {
            return None;
        }
        if law.is_plastic() {
            return Some(ParameterProblem::new(
                "viscous_step",
                "implicit",
                "explicit with an elastoplastic law",
                "choose \"explicit\", or a regularised law",
            ));
        }
        self.pairwise_operator().map(|_| {
            let remedy = "choose the operator \"single-divergence\", or \"explicit\"";
            ParameterProblem::new("viscous_step", "implicit", "explicit with the pairwise momentum operators", remedy)
        })
    }

    /// The operator that a law with a field of its own excludes: the pairwise ones carry no stress along, and so no field.
    #[must_use]
    pub fn field_problem(&self, law: &Rheology) -> Option<ParameterProblem> {
        law.field()?;
        self.pairwise_operator().map(|operator| {
            let rule = "\"single-divergence\", \"uncorrected-divergence\" or \"by-law\" with a law that has a field";
            let remedy = "choose one of these, or a law without a field, such as \"mu-i\"";
            ParameterProblem::new("momentum_operator", operator, rule, remedy)
        })
    }
}
