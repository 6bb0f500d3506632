//! Parameters, tiers and runs.

use crate::case::{ParameterError, Parameters, Progress, Run, Tier};
use crate::cases::layer::{Layer, LayerObservation, Preparation, bulk_modulus};
use crate::cases::rules;
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::reference::GLASS_BEADS;
use bagnold_solver::material::rheology::{MuI, Newtonian, Rheology};
use bagnold_solver::parameter::{between, positive};
use bagnold_solver::weakly_compressible::numerics::Numerics;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct HydrostaticParameters {
    /// Layer height H `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.1"))]
    pub layer_height: f64,
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Rows of particles over the layer.
    #[schemars(transform = rules::rows())]
    pub resolution: usize,
    /// Columns of particles along the period.
    pub columns: usize,
    /// Largest random displacement of a particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "0.1 breaks the lattice without overlaps"))]
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// What happens before the start.
    pub preparation: Preparation,
    /// Simulated time `[s]`.
    #[schemars(transform = between(2.2, 1e4, "drift is measured over 0.4 s about 1 s and about 2 s"))]
    pub duration: f64,
    /// Bulk density of the grains' layer over the grain density `[-]`.
    #[schemars(transform = between(0.0, 0.74, "grains fill 0.5 to 0.64 of the space"))]
    pub solid_fraction: f64,
    /// Density of the liquid `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 1000"))]
    pub liquid_density: f64,
    /// The liquid.
    pub liquid: Newtonian,
    /// The grains.
    pub grains: MuI,
    /// Numerics.
    pub numerics: Numerics,
}

impl Parameters for HydrostaticParameters {
    type Run = HydrostaticRun;

    fn of_tier(tier: Tier) -> Self {
        let quick = Self {
            layer_height: 0.1,
            gravity: 9.81,
            resolution: 20,
            columns: 12,
            jitter: 0.1,
            seed: 1,
            preparation: Preparation::Settled,
            duration: 2.25,
            solid_fraction: GLASS_BEADS.solid_fraction,
            liquid_density: 1000.0,
            liquid: Newtonian { viscosity: 1e-3 },
            grains: GLASS_BEADS.law,
            numerics: Numerics::default(),
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => Self { resolution: 40, columns: 20, duration: 4.0, ..quick },
            Tier::Fine => Self { resolution: 80, columns: 40, duration: 10.0, ..quick },
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        rules::columns("columns", self.columns, &self.numerics)?;
        rules::material("grains", &Rheology::MuI(self.grains))?;
        rules::viscous_step("numerics", &self.numerics, &Rheology::MuI(self.grains))
    }

    fn runs(&self) -> Vec<HydrostaticRun> {
        let new = |material, density_coupling| {
            let (rheology, density, static_friction) = match material {
                MaterialKind::Newtonian => (Rheology::Newtonian(self.liquid), self.liquid_density, 0.0),
                MaterialKind::MuI => (
                    Rheology::MuI(self.grains),
                    self.solid_fraction * self.grains.grain_density,
                    self.grains.static_friction,
                ),
            };
            HydrostaticRun {
                material,
                density_coupling,
                layer_height: self.layer_height,
                gravity: self.gravity,
                density,
                static_friction,
                resolution: self.resolution,
                columns: self.columns,
                jitter: self.jitter,
                seed: self.seed,
                preparation: self.preparation,
                duration: self.duration,
                rheology,
                numerics: Numerics { density_coupling, ..self.numerics },
            }
        };
        let coupling = self.numerics.density_coupling;
        let mut runs = vec![new(MaterialKind::Newtonian, coupling), new(MaterialKind::MuI, coupling)];
        if coupling > 0.0 {
            runs.extend([new(MaterialKind::Newtonian, 0.0), new(MaterialKind::MuI, 0.0)]);
        }
        runs
    }
}

/// Which material a run is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum MaterialKind {
    /// The Newtonian liquid.
    Newtonian,
    /// The grains.
    MuI,
}

/// One simulation.
#[derive(Debug, Clone, Serialize)]
pub struct HydrostaticRun {
    /// Material.
    pub material: MaterialKind,
    /// σ of the density–pressure coupling `[-]`.
    pub density_coupling: f64,
    /// Layer height H `[m]`.
    pub layer_height: f64,
    /// Gravity `[m/s²]`.
    pub gravity: f64,
    /// Bulk density `[kg/m³]`.
    pub density: f64,
    /// Static friction of the material `[-]`, 0 for the liquid.
    pub static_friction: f64,
    resolution: usize,
    columns: usize,
    jitter: f64,
    seed: u64,
    preparation: Preparation,
    duration: f64,
    rheology: Rheology,
    numerics: Numerics,
}

impl Run for HydrostaticRun {
    type Observation = LayerObservation;

    fn variant(&self) -> Variant {
        let material = match self.material {
            MaterialKind::Newtonian => "newtonian",
            MaterialKind::MuI => "mu_i",
        };
        Variant::of("material", material)
            .and("density_coupling", self.density_coupling)
            .and("resolution", self.resolution)
    }

    fn particle_steps(&self) -> f64 {
        self.layer().expected_steps() * (self.resolution * self.columns) as f64
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<LayerObservation>, ParameterError> {
        Ok(self.layer().run(progress)?)
    }
}

impl HydrostaticRun {
    fn layer(&self) -> Layer<'static> {
        Layer {
            height: self.layer_height,
            rows: self.resolution,
            columns: self.columns,
            slope_angle: 0.0,
            gravity: self.gravity,
            reference_density: self.density,
            bulk_modulus: bulk_modulus(self.density, self.gravity, self.layer_height, 0.0),
            rheology: self.rheology,
            numerics: self.numerics,
            jitter: self.jitter,
            seed: self.seed,
            preparation: self.preparation,
            velocity: &|_| 0.0,
            shear_stress: &|_| 0.0,
            duration: self.duration,
            window: 0.5,
            interval: 5e-3,
            stop_above: f64::INFINITY,
            frames: 3,
            may_diverge: false,
        }
    }

    /// Exact pressure `[Pa]` at a height `[m]`.
    #[must_use]
    pub fn pressure(&self, y: f64) -> f64 {
        self.layer().hydrostatic_pressure(y)
    }
}
