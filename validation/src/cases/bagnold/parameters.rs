//! The case's parameters and their tiers.

use crate::case::{ParameterError, Tier};
use crate::cases::layer::Preparation;
use crate::cases::rules;
use crate::reference::{BagnoldProfile, GLASS_BEADS};
use bagnold_solver::material::rheology::{MuI, Rheology};
use bagnold_solver::weakly_compressible::numerics::Numerics;
use serde::{Deserialize, Serialize};

/// How the layer starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Start {
    /// At rest, with the shear stress at its static limit.
    Rest,
    /// With the steady velocity and shear stress of the slope angle.
    Profile,
}

/// How the particles are arranged at the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Arrangement {
    /// On a square lattice.
    Lattice,
    /// Displaced at random from the lattice.
    Jittered,
}

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BagnoldParameters {
    /// Layer height h `[m]`.
    pub layer_height: f64,
    /// Gravity `[m/s²]`.
    pub gravity: f64,
    /// Solid fraction φ `[-]`: the bulk density is φ times the grain density.
    pub solid_fraction: f64,
    /// Slope angles of the steady runs `[°]`.
    pub slope_angles: Vec<f64>,
    /// Starts of the steady runs.
    pub starts: Vec<Start>,
    /// Rows of particles over the layer in the steady runs.
    pub resolution: usize,
    /// Columns of particles along the period.
    pub columns: usize,
    /// Largest random displacement of a particle in spacings `[-]`.
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// What happens before the start.
    pub preparation: Preparation,
    /// Simulated time over the recipe's `[-]`.
    pub duration_factor: f64,
    /// Averaging window before the end `[s]`.
    pub averaging_time: f64,
    /// Slope angle of the convergence study `[°]`.
    pub convergence_slope_angle: f64,
    /// Rows of the convergence study, lattice and jittered; empty for none.
    pub convergence_resolutions: Vec<usize>,
    /// Slope angles below the band of steady flow `[°]`; each starts with the profile of `arrest_start_angle`.
    pub arrest_slope_angles: Vec<f64>,
    /// Slope angle whose profile the arresting layers start with `[°]`.
    pub arrest_start_angle: f64,
    /// Slope angles above the band `[°]`, from rest.
    pub runaway_slope_angles: Vec<f64>,
    /// Material.
    pub material: MuI,
    /// Rate α_r `[1/s]` of the regularised viscosity (35), taken as `numerics.viscous_step` says; 0 for the return
    /// mapping.
    pub regularisation_rate: f64,
    /// Slopes repeated with (35) and an implicit step, from the profile `[°]`; empty for none.
    pub regularised_slope_angles: Vec<f64>,
    /// Its rate α_r `[1/s]`.
    pub regularised_rate: f64,
    /// Numerics.
    pub numerics: Numerics,
}

/// Simulated time of an arresting layer of 10 mm `[s]`, the shortest of all runs.
pub(super) const ARREST_DURATION: f64 = 1.5;

pub(super) const FIELD_NOTES: &[(&str, &str)] = &[
    ("layer_height", "[m]"),
    ("gravity", "[m/s²]"),
    ("solid_fraction", "[-], bulk density over grain density"),
    ("slope_angles", "[°], steady runs"),
    ("starts", "\"rest\" and \"profile\""),
    ("resolution", "rows of particles over the layer"),
    ("columns", "columns of particles along the period"),
    ("jitter", "[-], largest random displacement in spacings"),
    ("preparation", "\"settled\" or \"none\""),
    ("duration_factor", "[-], simulated time over 3.5 … 5 s at 22 … 25° for 10 mm"),
    ("averaging_time", "[s], window before the end"),
    ("convergence_slope_angle", "[°]"),
    ("convergence_resolutions", "rows; empty for no study"),
    ("arrest_slope_angles", "[°], below the band of steady flow"),
    ("arrest_start_angle", "[°], whose profile the arresting layers start with"),
    ("runaway_slope_angles", "[°], above the band"),
    ("regularised_slope_angles", "[°], repeated with the viscosity (35) and an implicit step; empty for none"),
    ("regularised_rate", "[1/s], of these"),
    ("regularisation_rate", "[1/s], of the viscosity (35), see numerics.viscous_step; 0 for the return mapping"),
    ("material.static_friction", "μ_s [-]"),
    ("material.limiting_friction", "μ_2 [-]"),
    ("material.reference_inertia", "I_0 [-]"),
    ("material.grain_diameter", "D [m]"),
    ("material.grain_density", "ρ_s [kg/m³]"),
];

impl BagnoldParameters {
    pub(super) fn of_tier(tier: Tier) -> Self {
        let quick = Self {
            layer_height: 0.01,
            gravity: 9.81,
            solid_fraction: GLASS_BEADS.solid_fraction,
            slope_angles: vec![22.0, 23.0, 24.0, 25.0],
            starts: vec![Start::Rest],
            resolution: 20,
            columns: 12,
            jitter: 0.1,
            seed: 1,
            preparation: Preparation::Settled,
            duration_factor: 1.0,
            averaging_time: 0.5,
            convergence_slope_angle: 24.0,
            convergence_resolutions: vec![],
            arrest_slope_angles: vec![20.0],
            arrest_start_angle: 24.0,
            // at 20 rows the particles' agitation breaks the layer up before its mean reaches half the sound speed
            runaway_slope_angles: vec![],
            // glass beads of Table 1 (Forterre & Pouliquen 2003); I_0 from (41) at 25°, kept at every angle
            material: GLASS_BEADS.law,
            regularisation_rate: 0.0,
            regularised_slope_angles: Vec::new(),
            regularised_rate: 0.01,
            // Twice the recipe's hourglass control. Near the static friction the law is convex in the stress, so that
            // the particles' agitation speeds the layer up: at 22° and 40 rows by 0.7 %, with this by 0.3 %.
            numerics: Numerics { hourglass: 0.4, ..Numerics::default() },
        };
        let paper = Self {
            resolution: 40,
            // with 20 columns the velocity at 22° scatters by 0.3 % from seed to seed, with 40 by less than 0.1 %
            columns: 40,
            starts: vec![Start::Rest, Start::Profile],
            convergence_resolutions: vec![10, 20, 40],
            runaway_slope_angles: vec![34.0],
            regularised_slope_angles: vec![24.0],
            ..quick.clone()
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => paper,
            Tier::Fine => {
                Self { layer_height: 0.02, resolution: 60, convergence_resolutions: vec![20, 40, 60], ..paper }
            }
        }
    }

    pub(super) fn check(&self) -> Result<(), ParameterError> {
        rules::positive("layer_height", self.layer_height, "give it in metres, such as 0.01")?;
        rules::positive("gravity", self.gravity, "give it in m/s², such as 9.81")?;
        rules::between("solid_fraction", self.solid_fraction, 0.0, 0.74, "grains fill 0.5 to 0.64 of the space")?;
        rules::between("jitter", self.jitter, 0.0, 0.5, "0.1 breaks the lattice without overlaps")?;
        rules::positive("duration_factor", self.duration_factor, "1 runs as long as the reference figures need")?;
        rules::positive("averaging_time", self.averaging_time, "give it in seconds, such as 0.5")?;
        let shortest = ARREST_DURATION * self.duration_scale();
        let remedy = "the window must fit into the shortest run: choose a shorter one or a larger `duration_factor`";
        rules::between("averaging_time", self.averaging_time, 0.0, shortest, remedy)?;
        rules::between("regularisation_rate", self.regularisation_rate, 0.0, 1e6, "0 takes the return mapping")?;
        rules::positive("regularised_rate", self.regularised_rate, "0.01 1/s in the paper")?;
        let angles = [
            ("slope_angles", &self.slope_angles),
            ("arrest_slope_angles", &self.arrest_slope_angles),
            ("runaway_slope_angles", &self.runaway_slope_angles),
        ];
        for (field, values) in angles {
            for (index, &angle) in values.iter().enumerate() {
                rules::slope_angle(&format!("{field}[{index}]"), angle)?;
            }
        }
        rules::slope_angle("convergence_slope_angle", self.convergence_slope_angle)?;
        rules::slope_angle("arrest_start_angle", self.arrest_start_angle)?;
        for (index, &rows) in self.convergence_resolutions.iter().enumerate() {
            rules::rows(&format!("convergence_resolutions[{index}]"), rows)?;
        }
        rules::rows("resolution", self.resolution)?;
        rules::columns("columns", self.columns, &self.numerics)?;
        rules::material("material", &Rheology::MuI(self.material))?;
        rules::numerics("numerics", &self.numerics)?;
        rules::viscous_step("numerics", &self.numerics, &law(&self.material, self.regularisation_rate))?;
        if !self.regularised_slope_angles.is_empty() {
            rules::implicit_runs("numerics", &self.numerics, "regularised_slope_angles")?;
        }
        let steady = |field: &str, angle: f64| {
            if self.profile(angle).inertial_number().is_some() {
                return Ok(());
            }
            let band =
                [self.material.static_friction, self.material.limiting_friction].map(|mu| libm::atan(mu).to_degrees());
            Err(ParameterError::field(
                field,
                angle,
                &format!("between {:.2}° and {:.2}°, the friction angles of the material", band[0], band[1]),
                "put other angles under `arrest_slope_angles` or `runaway_slope_angles`",
            ))
        };
        for (index, &angle) in self.slope_angles.iter().enumerate() {
            steady(&format!("slope_angles[{index}]"), angle)?;
        }
        for (index, &angle) in self.regularised_slope_angles.iter().enumerate() {
            steady(&format!("regularised_slope_angles[{index}]"), angle)?;
        }
        if !self.convergence_resolutions.is_empty() {
            steady("convergence_slope_angle", self.convergence_slope_angle)?;
        }
        if !self.arrest_slope_angles.is_empty() {
            steady("arrest_start_angle", self.arrest_start_angle)?;
        }
        Ok(())
    }

    /// How long the runs are over those of a layer of 10 mm: (h/10 mm)^1.5 is how the time to the steady state grows.
    pub(super) fn duration_scale(&self) -> f64 {
        self.duration_factor * libm::pow(self.layer_height / 0.01, 1.5)
    }

    /// The exact steady profile at a slope angle `[°]`.
    #[must_use]
    pub fn profile(&self, slope_angle: f64) -> BagnoldProfile {
        profile(&self.material, self.layer_height, self.solid_fraction, self.gravity, slope_angle)
    }
}

/// The material's law: regularised with the rate `[1/s]`, or by return mapping where that is 0.
pub(super) fn law(material: &MuI, regularisation_rate: f64) -> Rheology {
    if regularisation_rate > 0.0 {
        Rheology::RegularisedMuI(material.regularised(regularisation_rate))
    } else {
        Rheology::MuI(*material)
    }
}

/// The exact steady profile of a material at a slope angle `[°]`.
pub(super) fn profile(
    material: &MuI,
    layer_height: f64,
    solid_fraction: f64,
    gravity: f64,
    slope_angle: f64,
) -> BagnoldProfile {
    BagnoldProfile {
        layer_height,
        slope_angle: slope_angle.to_radians(),
        gravity,
        grain_diameter: material.grain_diameter,
        grain_density: material.grain_density,
        solid_fraction,
        static_friction: material.static_friction,
        limiting_friction: material.limiting_friction,
        reference_inertia: material.reference_inertia,
    }
}
