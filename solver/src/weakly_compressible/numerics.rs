//! The numerical choices of a run; the default is the recipe, [`Numerics::paper`] the paper's own set.

use crate::kernel::KernelShape;
use crate::material::rheology::Rheology;
use crate::weakly_compressible::boundary::{Surface, WallTreatment};
use serde::{Deserialize, Serialize};

/// Which discrete momentum equation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum MomentumOperator {
    /// One divergence of the whole stress with the kernel correction of each particle (default).
    SingleDivergence,
    /// The same divergence without kernel correction.
    UncorrectedDivergence,
    /// Pressure (10) and pairwise viscosity (11).
    Pairwise,
    /// Pressure (10) and pairwise viscosity with Schwaiger's correction (13).
    PairwiseCorrected,
}

/// How the artificial viscosity's coefficient is chosen.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ViscositySwitch {
    /// The same everywhere.
    Constant,
    /// Morris & Monaghan's switch (16) between 0.1 and 1.
    MorrisMonaghan,
}

/// Whether particles very near a wall are stopped from approaching it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Contact {
    /// Within half a spacing.
    HalfSpacing,
    /// Not at all.
    None,
}

/// How a viscous law's stress enters the momentum equation.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum ViscousStep {
    /// At the old velocity, with the bound ρh²/η of (29) on the time step. Laws by return mapping know no other.
    Explicit,
    /// At the new velocity, by a linear solve in every step and without that bound.
    Implicit,
}

/// Numerical parameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Numerics {
    /// Smoothing kernel.
    pub kernel: KernelShape,
    /// Smoothing length over particle spacing h/Δ `[-]`.
    pub smoothing_ratio: f64,
    /// Discrete momentum equation.
    pub momentum_operator: MomentumOperator,
    /// Wall particles.
    pub wall_treatment: WallTreatment,
    /// Contact insurance at walls.
    pub contact: Contact,
    /// σ of the density–pressure coupling (27) `[-]`; 0 switches it off.
    pub density_coupling: f64,
    /// α_Π of the artificial viscosity (15) `[-]`.
    pub artificial_viscosity: f64,
    /// Switch of the artificial viscosity.
    pub viscosity_switch: ViscositySwitch,
    /// C_s of the eddy viscosity (5) `[-]`; 0 switches it off.
    pub smagorinsky_constant: f64,
    /// Coefficient of the velocity hourglass control `[-]`.
    pub hourglass: f64,
    /// Damping ζ of elastic shear below the yield, as a viscosity ζ ρ0 c_s h `[-]`; none where the material yields.
    pub elastic_damping: f64,
    /// Elastic shear modulus over bulk modulus G/K `[-]`, for laws with a yield by return mapping.
    pub shear_modulus_ratio: f64,
    /// Courant number of the sound speed `[-]`.
    pub acoustic_courant: f64,
    /// Courant number of the flow speed `[-]`.
    pub advective_courant: f64,
    /// Coefficient of the explicit viscous bound ρh²/η `[-]`.
    pub viscous_courant: f64,
    /// Explicit or implicit viscous stress.
    pub viscous_step: ViscousStep,
    /// Share of the net acceleration that an implicit viscous step may leave without its viscous answer `[-]`, both as
    /// root mean squares.
    pub viscous_tolerance: f64,
    /// Skin of the neighbour list over the kernel's support `[-]`.
    pub verlet_skin: f64,
}

/// A choice that another one excludes: the field's name, its value, the rule it breaks, and what to do about it.
pub type ChoiceProblem = (&'static str, &'static str, &'static str, &'static str);

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
            hourglass: 0.2,
            elastic_damping: 0.5,
            shear_modulus_ratio: 0.3,
            acoustic_courant: 0.4,
            advective_courant: 0.25,
            viscous_courant: 0.2,
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
            acoustic_courant: 0.2,
            advective_courant: 0.2,
            ..Self::default()
        }
    }

    /// The name of the momentum operator, where it is one of the pairwise ones.
    #[must_use]
    pub fn pairwise_operator(&self) -> Option<&'static str> {
        match self.momentum_operator {
            MomentumOperator::SingleDivergence | MomentumOperator::UncorrectedDivergence => None,
            MomentumOperator::Pairwise => Some("pairwise"),
            MomentumOperator::PairwiseCorrected => Some("pairwise-corrected"),
        }
    }

    /// The choice that a wall with this surface excludes: only the single divergence with extrapolated walls knows
    /// smooth ones.
    #[must_use]
    pub fn wall_problem(&self, roughness: Surface) -> Option<ChoiceProblem> {
        if roughness == Surface::Rough {
            return None;
        }
        if let Some(operator) = self.pairwise_operator() {
            return Some((
                "momentum_operator",
                operator,
                "\"single-divergence\" or \"uncorrected-divergence\" with a smooth wall, such as a gate",
                "the pairwise operators know rough walls only; choose one of these, or leave the gate out",
            ));
        }
        (self.wall_treatment == WallTreatment::Paper).then_some((
            "wall_treatment",
            "paper",
            "\"extrapolated\" with a smooth wall, such as a gate",
            "the paper's walls are rough; choose this, or leave the gate out",
        ))
    }

    /// The choice that goes neither with the law nor with the momentum operator: an implicit step needs a viscosity and
    /// the divergence whose transpose it is solved with.
    #[must_use]
    pub fn step_problem(&self, law: &Rheology) -> Option<ChoiceProblem> {
        if self.viscous_step == ViscousStep::Explicit {
            return None;
        }
        if law.is_plastic() {
            return Some((
                "viscous_step",
                "implicit",
                "explicit with a law by return mapping",
                "its stress bounds no time step; regularise the law, or choose \"explicit\"",
            ));
        }
        self.pairwise_operator().map(|_| {
            (
                "viscous_step",
                "implicit",
                "explicit with the pairwise momentum operators",
                "choose the operator \"single-divergence\", or \"explicit\"",
            )
        })
    }

    /// The first field that breaks its rule, as (field, value, rule, remedy).
    #[must_use]
    pub fn parameter_problem(&self) -> Option<(&'static str, f64, &'static str, &'static str)> {
        let within = |value: f64, lower: f64, upper: f64| value >= lower && value <= upper;
        let positive = |value: f64, upper: f64| value > 0.0 && value <= upper;
        let rules = [
            ("smoothing_ratio", self.smoothing_ratio, within(self.smoothing_ratio, 1.0, 2.5), "between 1 and 2.5"),
            ("density_coupling", self.density_coupling, within(self.density_coupling, 0.0, 10.0), "between 0 and 10"),
            (
                "artificial_viscosity",
                self.artificial_viscosity,
                within(self.artificial_viscosity, 0.0, 2.0),
                "between 0 and 2",
            ),
            (
                "smagorinsky_constant",
                self.smagorinsky_constant,
                within(self.smagorinsky_constant, 0.0, 1.0),
                "between 0 and 1",
            ),
            ("hourglass", self.hourglass, within(self.hourglass, 0.0, 2.0), "between 0 and 2"),
            ("elastic_damping", self.elastic_damping, within(self.elastic_damping, 0.0, 1.0), "between 0 and 1"),
            (
                "shear_modulus_ratio",
                self.shear_modulus_ratio,
                positive(self.shear_modulus_ratio, 1.5),
                "above 0 and at most 1.5",
            ),
            ("acoustic_courant", self.acoustic_courant, positive(self.acoustic_courant, 1.0), "above 0 and at most 1"),
            (
                "advective_courant",
                self.advective_courant,
                positive(self.advective_courant, 1.0),
                "above 0 and at most 1",
            ),
            ("viscous_courant", self.viscous_courant, positive(self.viscous_courant, 1.0), "above 0 and at most 1"),
            (
                "viscous_tolerance",
                self.viscous_tolerance,
                within(self.viscous_tolerance, 1e-10, 0.5),
                "between 1e-10 and 0.5",
            ),
            ("verlet_skin", self.verlet_skin, positive(self.verlet_skin, 1.0), "above 0 and at most 1"),
        ];
        rules
            .into_iter()
            .find(|(_, _, holds, _)| !holds)
            .map(|(field, value, _, rule)| (field, value, rule, "see the default numerics with `bagnold show`"))
    }
}
