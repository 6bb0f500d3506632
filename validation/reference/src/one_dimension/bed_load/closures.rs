//! Closures of the equations: friction and dilation of the grains, viscosity and mixing length of the water, drag.
//!
//! The layer verifies a discretisation, so it may take from the solver's `material` what needs no discretising: the drag
//! laws, the viscosity of suspensions, κ. Friction, dilation and mixing length it writes anew, in the form that its own
//! method needs (a stress with its derivative, a march over the weight, a length that cases choose); tests compare each
//! with the solver's law, so that a slip in either is seen.

use crate::one_dimension::table::{number, rows};
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::material::suspension_viscosity::SuspensionViscosity;
use bagnold_solver::material::turbulence::{GrainRoughness, eddy_viscosity};
use bagnold_solver::parameter::{ParameterProblem, between, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// Reach of an eddy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum MixingLengthClosure {
    /// No turbulence.
    None,
    /// l = κ √(1 − z/h) (∫ (1 − φ/φ_max) dz + r) from the base up to z: an eddy grows where grains leave it room, and
    /// starts from the roughness r where they rest. Over resting grains the root makes the log law exact.
    Integral,
    /// l = κ √(1 − z/h) z above z = 0 and 0 below, whatever the grains do.
    Root,
}

impl MixingLengthClosure {
    /// Name in parameters and results.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Integral => "integral",
            Self::Root => "root",
        }
    }
}

/// All closures; the default is the literature's set for bed load (Maurin et al. 2016, as used in sedFoam's tutorial).
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Closures {
    /// Static friction μ_s `[-]`.
    #[schemars(transform = positive("give μ_s, such as 0.35"))]
    pub static_friction: f64,
    /// Limiting friction μ_2 `[-]`.
    #[schemars(transform = positive("give μ_2, such as 0.97"))]
    pub limiting_friction: f64,
    /// Reference inertia I_0 `[-]`.
    #[schemars(transform = positive("give I_0, such as 0.69"))]
    pub reference_inertia: f64,
    /// Rate γ_r `[1/s]` below which friction falls to zero.
    #[schemars(transform = positive("give it in 1/s, such as 5e-3"))]
    pub regularisation_rate: f64,
    /// Solid fraction φ_max of grains without shear `[-]`.
    #[schemars(transform = between(0.1, 0.74, "give 0.5 to 0.64, the share of the space that grains at rest fill"))]
    pub largest_fraction: f64,
    /// Dilation B in φ = φ_max/(1 + B I) `[-]`; 0 for none.
    #[schemars(transform = between(0.0, 100.0, "give B, such as 0.31, or 0 for grains that do not dilate in shear"))]
    pub dilation: f64,
    /// Drag law; Gidaspow's jumps at φ = 0.2 and gives no steady state.
    pub drag: DragLaw,
    /// Mixing length.
    pub mixing_length: MixingLengthClosure,
    /// The constant κ of von Kármán `[-]`.
    #[schemars(transform = positive("give von Kármán's constant, 0.41"))]
    pub karman: f64,
    /// Turbulent Schmidt number Sc of the grains `[-]`, eddy viscosity over the diffusivity of φ; 0 for grains that eddies
    /// do not carry.
    #[schemars(transform = between(0.0, 10.0, "give 0.4 to 1 for suspensions, or 0 for no dispersion"))]
    pub turbulent_schmidt: f64,
    /// Roughness of resting grains; only the integral mixing length knows it.
    pub grain_roughness: GrainRoughness,
    /// Viscosity of a suspension: what it exceeds the water's by resists the strain of the grains.
    pub suspension_viscosity: SuspensionViscosity,
}

static LITERATURE: LazyLock<Closures> = LazyLock::new(|| {
    let table = rows(include_str!("../../../reference-data/bed-load/closures.csv"));
    let value = |name: &str| {
        let row = table.iter().find(|row| row.get("closure").is_some_and(|closure| closure == name));
        number(row.unwrap_or_else(|| panic!("closures.csv: no closure `{name}`")), "value [-]")
    };
    Closures {
        static_friction: value("static friction"),
        limiting_friction: value("limiting friction"),
        reference_inertia: value("reference inertia"),
        regularisation_rate: REGULARISATION_RATE,
        largest_fraction: value("largest solid fraction"),
        dilation: value("dilation"),
        drag: DragLaw::DiFelice,
        mixing_length: MixingLengthClosure::Integral,
        karman: value("Kármán constant"),
        turbulent_schmidt: 0.0,
        grain_roughness: GrainRoughness {
            origin_depth: value("origin below resting grains"),
            bed_roughness_fade_length: value("fade length of the bed roughness"),
        },
        suspension_viscosity: SuspensionViscosity {
            intrinsic: value("suspension viscosity coefficient"),
            largest_fraction: value("suspension viscosity pole"),
            bounded_from: value("suspension viscosity fraction at most"),
        },
    }
});

/// Numerical: a fifth of it changes the transport by at most 0.4 % `[1/s]`.
const REGULARISATION_RATE: f64 = 5e-3;

impl Default for Closures {
    fn default() -> Self {
        *LITERATURE
    }
}

/// A stress at a shear rate γ, and how it changes with it.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct StressResponse {
    /// τ `[Pa]`.
    pub(super) value: f64,
    /// dτ/dγ `[Pa·s]`.
    pub(super) tangent: f64,
    /// τ/γ `[Pa·s]`.
    pub(super) secant: f64,
}

/// Water between grains.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Between {
    /// Density ρ_f `[kg/m³]`.
    pub(super) density: f64,
    /// Kinematic viscosity ν of the water alone `[m²/s]`.
    pub(super) viscosity: f64,
    /// Solid fraction φ `[-]`.
    pub(super) solid_fraction: f64,
}

impl Closures {
    /// The first rule between the closures that they break, once each is in its own range.
    pub fn problem(&self) -> Option<ParameterProblem> {
        let pole = self.suspension_viscosity.pole_problem().map(|problem| problem.within("suspension_viscosity"));
        let grows = self.limiting_friction > self.static_friction;
        let (rule, remedy) =
            ("greater than the static friction", "raise it: friction grows from μ_s at rest to μ_2 in fast shear");
        let friction =
            || (!grows).then(|| ParameterProblem::new("limiting_friction", self.limiting_friction, rule, remedy));
        pole.or_else(friction)
    }

    /// Stress of the grains, μ(I) p′ γ/√(γ² + γ_r²), at a shear rate `[1/s]` and a pressure p′ `[Pa]`, and what the
    /// water between them adds to it.
    pub(super) fn grain_stress(&self, rate: f64, pressure: f64, inertia_unit: f64, water: &Between) -> StressResponse {
        let friction = self.friction(rate, pressure, inertia_unit);
        let excess = self.suspension_viscosity.relative(water.solid_fraction) - 1.0;
        let viscosity = (1.0 - water.solid_fraction) * water.density * water.viscosity * excess;
        StressResponse {
            value: friction.value + viscosity * rate,
            tangent: friction.tangent + viscosity,
            secant: friction.secant + viscosity,
        }
    }

    fn friction(&self, rate: f64, pressure: f64, inertia_unit: f64) -> StressResponse {
        if pressure <= 0.0 {
            return StressResponse::default();
        }
        let speed = rate.abs();
        let span = self.limiting_friction - self.static_friction;
        // the rate at which I = I_0
        let reference = self.reference_inertia * pressure.sqrt() / inertia_unit;
        let friction = self.static_friction + span * speed / (speed + reference);
        let slope = span * reference / ((speed + reference) * (speed + reference));
        let regularised = (rate * rate + self.regularisation_rate * self.regularisation_rate).sqrt();
        let secant = friction * pressure / regularised;
        let ratio = self.regularisation_rate / regularised;
        let tangent = secant * ratio * ratio + pressure * slope * speed / regularised;
        StressResponse { value: secant * rate, tangent, secant }
    }

    /// Stress of the water, (1 − φ) ρ_f [ν + l² |γ|] γ.
    pub(super) fn fluid_stress(&self, rate: f64, length: f64, water: &Between) -> StressResponse {
        let inertia = (1.0 - water.solid_fraction) * water.density;
        let eddy = length * length * rate.abs();
        let secant = inertia * (water.viscosity + eddy);
        StressResponse { value: secant * rate, tangent: inertia * (water.viscosity + 2.0 * eddy), secant }
    }

    /// Diffusivity ε = ν_t/Sc `[m²/s]` of grains that eddies carry, at a rate of the water `[1/s]`; 0 if they carry none.
    pub(super) fn diffusivity(&self, length: f64, rate: f64) -> f64 {
        if self.turbulent_schmidt > 0.0 { eddy_viscosity(length, rate.abs()) / self.turbulent_schmidt } else { 0.0 }
    }

    /// Mixing length `[m]` at a height, given the room ∫ (1 − φ/φ_max) dz below it and its roughness `[m]`.
    pub(super) fn mixing_length(&self, height: f64, flow_depth: f64, room: f64) -> f64 {
        let root = (1.0 - height / flow_depth).max(0.0).sqrt();
        self.karman
            * match self.mixing_length {
                MixingLengthClosure::None => 0.0,
                MixingLengthClosure::Integral => root * room,
                MixingLengthClosure::Root => root * height.max(0.0),
            }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bagnold_solver::material::rheology::{Rheology, RootMuI};
    use bagnold_solver::material::turbulence::{StratifiedMixingLength, VON_KARMAN};

    /// Water that adds nothing to friction.
    const CLEAR: Between = Between { density: 1000.0, viscosity: 0.0, solid_fraction: 0.5 };
    const PORES: Between = Between { viscosity: 1e-6, ..CLEAR };

    #[test]
    fn tangents_are_derivatives() {
        let closures = Closures::default();
        let water = Between { solid_fraction: 0.2, ..PORES };
        let (pressure, inertia_unit) = (20.0, 5e-3 * 2600f64.sqrt());
        let step = 1e-6;
        for rate in [-30.0, -1e-3, 4e-3, 0.7, 55.0] {
            let at = |rate| closures.grain_stress(rate, pressure, inertia_unit, &water);
            let difference = (at(rate + step * rate).value - at(rate - step * rate).value) / (2.0 * step * rate);
            assert!((at(rate).tangent / difference - 1.0).abs() < 1e-6, "grains at {rate}");
            let at = |rate| closures.fluid_stress(rate, 2e-3, &water);
            let difference = (at(rate + step * rate).value - at(rate - step * rate).value) / (2.0 * step * rate);
            assert!((at(rate).tangent / difference - 1.0).abs() < 1e-6, "water at {rate}");
        }
    }

    #[test]
    fn the_files_constants_are_the_solvers_defaults() {
        let closures = Closures::default();
        assert_eq!(closures.karman, VON_KARMAN);
        assert_eq!(closures.grain_roughness, GrainRoughness::default());
        assert_eq!(closures.suspension_viscosity, SuspensionViscosity::default());
    }

    #[test]
    fn friction_is_that_of_the_law_in_the_solver() {
        let closures = Closures::default();
        let law = Rheology::RootMuI(RootMuI {
            static_friction: closures.static_friction,
            limiting_friction: closures.limiting_friction,
            reference_inertia: closures.reference_inertia,
            grain_diameter: 5e-3,
            grain_density: 2600.0,
            regularisation_rate: closures.regularisation_rate,
        });
        for (rate, pressure) in [(1e-4, 3.0), (5e-3, 50.0), (2.0, 1.0), (80.0, 120.0), (3.0, 0.0)] {
            let stress = closures.grain_stress(rate, pressure, 5e-3 * 2600f64.sqrt(), &CLEAR).value;
            let expected = law.viscosity(rate, pressure) * rate;
            assert!((stress - expected).abs() <= 1e-14 * expected, "{rate} 1/s, {pressure} Pa: {stress} or {expected}");
        }
    }

    #[test]
    fn the_mixing_length_is_that_of_the_law_in_the_solver() {
        let (closures, law) = (Closures::default(), StratifiedMixingLength { packing: 0.6, depth: 0.046 });
        for (height, room) in [(-0.003, 1e-5), (0.0, 4e-4), (0.02, 0.0205), (0.045, 0.04), (0.05, 0.05)] {
            let expected = law.length(height, room);
            let length = closures.mixing_length(height, 0.046, room);
            assert!((length - expected).abs() <= 1e-15 * expected, "{height} m: {length} or {expected}");
        }
    }

    /// For water and grains with one shear rate, both stresses together have the viscosity of the suspension.
    #[test]
    fn a_suspension_has_its_viscosity() {
        let closures = Closures::default();
        let (rate, no_eddies, no_weight) = (3.0, 0.0, 0.0);
        for solid_fraction in [0.0, 0.1, 0.45, 0.6] {
            let water = Between { solid_fraction, ..PORES };
            let both = closures.fluid_stress(rate, no_eddies, &water).value
                + closures.grain_stress(rate, no_weight, 0.25, &water).value;
            let relative = SuspensionViscosity::default().relative(solid_fraction);
            let expected = (1.0 - solid_fraction) * 1000.0 * 1e-6 * relative * rate;
            assert!((both / expected - 1.0).abs() < 1e-14, "{solid_fraction}: {both} for {expected}");
        }
    }

    #[test]
    fn friction_has_its_limits_and_its_reference() {
        let closures = Closures::default();
        // p′ = 26 Pa and d √ρ_s = 0.255 √(kg/m): I = γ 0.255/5.1 = 0.69 at γ = 13.8 1/s
        let friction = |rate: f64| closures.grain_stress(rate, 26.01, 0.255, &CLEAR).value / 26.01;
        assert!((friction(13.8) - 0.66).abs() < 1e-6, "{}", friction(13.8));
        assert!((friction(1e9) - 0.97).abs() < 1e-6);
        assert!((friction(0.1) - 0.3545).abs() < 1e-3);
        assert!(friction(1e-5) < 1e-3);
    }
}
