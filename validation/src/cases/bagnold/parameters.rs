//! The case's parameters and their tiers.

use super::runs::{self, BagnoldRun};
use crate::case::{ParameterError, Parameters, Tier};
use crate::cases::layer::PeriodicLayer;
use crate::cases::rules;
use crate::input::check_name;
use crate::reference::{BagnoldProfile, GLASS_BEADS};
use bagnold_solver::material::rheology::{MuI, Rheology};
use bagnold_solver::parameter::{between, each, not_negative, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// How the layer starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Start {
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
    pub starts: Vec<Start>,
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
    /// Rate α_r `[1/s]` of the regularised viscosity (35), taken as `numerics.viscous_step` says; 0 for the return
    /// mapping.
    #[schemars(transform = between(0.0, 1e6, "0 takes the return mapping"))]
    pub regularisation_rate: f64,
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

impl Parameters for BagnoldParameters {
    type Run = BagnoldRun;

    fn of_tier(tier: Tier) -> Self {
        let quick = Self {
            layer: PeriodicLayer::settled(0.01, 20, 12),
            solid_fraction: GLASS_BEADS.solid_fraction,
            slope_angles: vec![22.0, 23.0, 24.0, 25.0],
            starts: vec![Start::Rest],
            duration_factor: 1.0,
            averaging_time: 0.5,
            convergence_slope_angle: 24.0,
            convergence_resolutions: vec![],
            arrest_slope_angles: vec![20.0],
            arrest_start_angle: 24.0,
            // at 20 rows the particles' agitation breaks the layer up before its mean reaches half the sound speed
            runaway_slope_angles: vec![],
            other_grains: Vec::new(),
            // glass beads of Table 1 (Forterre & Pouliquen 2003); I_0 from (41) at 25°, kept at every angle
            material: Rheology::MuI(GLASS_BEADS.law),
            regularisation_rate: 0.0,
            regularised_slope_angles: Vec::new(),
            regularised_rate: 0.01,
            printed_rates: Vec::new(),
            printed_resolution: 10,
        };
        let paper = Self {
            // with 20 columns the velocity at 22° scatters by 0.3 % from seed to seed, with 40 by less than 0.1 %
            layer: PeriodicLayer { resolution: 40, columns: 40, ..quick.layer },
            starts: vec![Start::Rest, Start::Profile],
            convergence_resolutions: vec![10, 20, 40],
            runaway_slope_angles: vec![34.0],
            other_grains: other_grains(),
            printed_rates: vec![1.0],
            regularised_slope_angles: vec![24.0],
            ..quick.clone()
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => paper,
            Tier::Fine => Self {
                layer: PeriodicLayer { layer_height: 0.02, resolution: 60, ..paper.layer },
                convergence_resolutions: vec![20, 40, 60],
                ..paper
            },
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        let shortest = ARREST_DURATION * self.duration_scale();
        let remedy = "the window must fit into the shortest run: choose a shorter one or a larger `duration_factor`";
        rules::between("averaging_time", self.averaging_time, 0.0, shortest, remedy)?;
        self.layer.check()?;
        let remedy = "Bagnold's profile, which the case is judged by, is exact for it alone";
        let grains = rules::only_mu_i("material", &self.material, remedy)?;
        rules::material("material", &self.material)?;
        let numerics = &self.layer.numerics;
        rules::viscous_step("numerics", numerics, &law(&grains, self.regularisation_rate))?;
        if !self.regularised_slope_angles.is_empty() {
            rules::implicit_runs("numerics", numerics, "regularised_slope_angles")?;
        }
        let steady = |field: &str, angle: f64| self.steady(&grains, field, angle);
        let lists =
            [("slope_angles", &self.slope_angles), ("regularised_slope_angles", &self.regularised_slope_angles)];
        for (index, other) in self.other_grains.iter().enumerate() {
            let name = |field: &str| format!("other_grains[{index}].{field}");
            check_name(&name("name"), &other.name)?;
            rules::row_count(&name("resolution"), other.resolution)?;
            rules::material(&name("grains"), &Rheology::MuI(other.grains))?;
            self.steady(&other.grains, &name("slope_angle"), other.slope_angle)?;
        }
        for (name, angles) in lists {
            for (index, &angle) in angles.iter().enumerate() {
                steady(&format!("{name}[{index}]"), angle)?;
            }
        }
        if !self.convergence_resolutions.is_empty() || !self.printed_rates.is_empty() {
            steady("convergence_slope_angle", self.convergence_slope_angle)?;
        }
        if !self.arrest_slope_angles.is_empty() {
            steady("arrest_start_angle", self.arrest_start_angle)?;
        }
        Ok(())
    }

    fn runs(&self) -> Vec<BagnoldRun> {
        runs::all(self)
    }
}

impl BagnoldParameters {
    /// That grains flow steadily at a slope angle `[°]`.
    fn steady(&self, grains: &MuI, field: &str, angle: f64) -> Result<(), ParameterError> {
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

/// Three materials that no experiment has: 20, 30 and 100 grains over a layer of 10 mm, friction from 0.3 to 0.95.
fn other_grains() -> Vec<OtherGrains> {
    let new =
        |name: &str, slope_angle, resolution, [static_friction, limiting_friction]: [f64; 2], inertia, diameter| {
            let grains = MuI {
                static_friction,
                limiting_friction,
                reference_inertia: inertia,
                grain_diameter: diameter,
                ..GLASS_BEADS.law
            };
            OtherGrains { name: name.to_owned(), slope_angle, resolution, grains }
        };
    vec![
        new("slippery", 20.0, 40, [0.3, 0.5], 0.1, 0.5e-3),
        new("rough", 28.0, 40, [0.45, 0.75], 0.3, 0.33e-3),
        new("fine", 34.0, 60, [0.6, 0.95], 0.6, 0.1e-3),
    ]
}

/// The material's law: regularised with the rate `[1/s]`, or by return mapping where that is 0.
pub(super) fn law(material: &MuI, regularisation_rate: f64) -> Rheology {
    if regularisation_rate > 0.0 {
        Rheology::RegularisedMuI(material.regularised(regularisation_rate))
    } else {
        Rheology::MuI(*material)
    }
}
