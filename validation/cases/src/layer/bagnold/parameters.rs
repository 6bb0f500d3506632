//! The parameters.

use crate::case::ParameterError;
use crate::layer::PeriodicLayer;
use crate::reference::one_dimension::BagnoldProfile;
use crate::setup::rules;
use bagnold_solver::material::rheology::{MuI, Rheology};
use bagnold_solver::parameter::{between, each, not_negative, positive, unique};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the layer starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LayerStart {
    /// At rest, with the shear stress at its static limit.
    Rest,
    /// With the steady velocity and shear stress of the slope angle.
    Profile,
}

/// Grains of another material, which flow from their own profile.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct OtherGrains {
    /// What figures and variants call them.
    pub name: String,
    /// Slope angle `[°]`, between the friction angles of these grains.
    #[schemars(transform = rules::slope_angle())]
    pub slope_angle: f64,
    /// Rows of particles over the layer. The particles' own Reynolds number γ̇ Δ² ρ/η = (I Δ/D)²/(μ φ) is to stay below
    /// 0.1: above it the unevenness of the flow between particles is not damped within a strain, and the layer sinks.
    #[schemars(transform = rules::rows())]
    pub resolution: usize,
    /// The grains' law.
    pub grains: MuI,
}

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BagnoldParameters {
    /// The layer.
    #[serde(flatten)]
    pub layer: PeriodicLayer,
    /// Solid fraction φ `[-]`: the bulk density is φ times the grain density.
    #[schemars(transform = between(0.0, 1.0, "grains fill 0.5 to 0.64 of the space; 1 where a law gives the density of the bulk"))]
    pub solid_fraction: f64,
    /// Slope angles of the steady runs `[°]`, between the friction angles of the material.
    #[schemars(transform = each(rules::slope_angle()))]
    pub slope_angles: Vec<f64>,
    /// Starts of the steady runs.
    pub starts: Vec<LayerStart>,
    /// Simulated time over the recipe's, 3.5 … 5 s at 22 … 25° for 10 mm `[-]`.
    #[schemars(transform = positive("1 runs as long as the reference figures need"))]
    pub duration_factor: f64,
    /// Averaging window before the end `[s]`.
    #[schemars(transform = positive("give it in seconds, such as 0.5"))]
    pub averaging_time: f64,
    /// Slope angle of the convergence study `[°]`.
    #[schemars(transform = rules::slope_angle())]
    pub convergence_slope_angle: f64,
    /// Rows of the convergence study, lattice and jittered; empty for none.
    #[schemars(transform = each(rules::rows()))]
    pub convergence_resolutions: Vec<usize>,
    /// Seeds of the displaced particles of that study, in layers that are raised again by as much as they sink while they settle: by 0.2 % at
    /// every spacing, which is 0.4 % of the velocity and hides how the spacing's own error falls. The error of the mean velocity over the seeds
    /// is judged; empty for layers as all others are, of the case's own seed.
    #[schemars(transform = unique("name every seed once"))]
    pub convergence_seeds: Vec<u64>,
    /// Slope angles below the band of steady flow `[°]`; each starts with the profile of `arrest_start_angle`.
    #[schemars(transform = each(rules::slope_angle()))]
    #[schemars(transform = each(not_negative("the layer lies on a slope that it flows down: give its angle in degrees")))]
    pub arrest_slope_angles: Vec<f64>,
    /// Slope angle whose profile the arresting layers start with `[°]`.
    #[schemars(transform = rules::slope_angle())]
    pub arrest_start_angle: f64,
    /// Slope angles above the band `[°]`, from rest.
    #[schemars(transform = each(rules::slope_angle()))]
    #[schemars(transform = each(not_negative("the layer lies on a slope that it flows down: give its angle in degrees")))]
    pub runaway_slope_angles: Vec<f64>,
    /// Grains of other materials, whose profile is the same law's: what holds for one material is to hold for all.
    pub other_grains: Vec<OtherGrains>,
    /// Material, which must be of μ(I).
    pub material: Rheology,
    /// Slopes repeated with (35) and an implicit step, from the profile `[°]`; empty for none.
    #[schemars(transform = each(rules::slope_angle()))]
    pub regularised_slope_angles: Vec<f64>,
    /// Its rate α_r `[1/s]`.
    #[schemars(transform = positive("0.01 1/s in the paper"))]
    pub regularised_rate: f64,
    /// Rates α_r `[1/s]` with which the paper's own algorithm runs from the profile of `convergence_slope_angle`: its numerics,
    /// (35) by explicit steps, once with (11) and once with (13); empty for none. The steps become as short as the rate:
    /// 10 rows take seconds with 1 1/s and minutes with 0.01 1/s.
    #[schemars(transform = each(positive("0.01 1/s in the paper")))]
    pub printed_rates: Vec<f64>,
    /// Rows of particles in these.
    #[schemars(transform = rules::rows())]
    pub printed_resolution: usize,
}

/// Simulated time of an arresting layer of 10 mm `[s]`, the shortest of all runs.
pub(super) const ARREST_DURATION: f64 = 1.5;

impl BagnoldParameters {
    /// That grains flow steadily at a slope angle `[°]`.
    pub(super) fn steady(&self, grains: &MuI, field: &str, angle: f64) -> Result<(), ParameterError> {
        let PeriodicLayer { layer_height, gravity, .. } = self.layer;
        let profile = BagnoldProfile::of(grains, layer_height, self.solid_fraction, gravity, angle);
        if profile.inertial_number().is_some() {
            return Ok(());
        }
        let band = [grains.static_friction, grains.limiting_friction].map(|mu| libm::atan(mu).to_degrees());
        Err(ParameterError::field(
            field,
            angle,
            &format!("between {:.2}° and {:.2}°, the friction angles of the material", band[0], band[1]),
            "put other angles under `arrest_slope_angles` or `runaway_slope_angles`",
        ))
    }

    /// How long the runs are over those of a layer of 10 mm: (h/10 mm)^1.5 is how the time to the steady state grows.
    pub(super) fn duration_scale(&self) -> f64 {
        self.duration_factor * libm::pow(self.layer.layer_height / 0.01, 1.5)
    }
}
