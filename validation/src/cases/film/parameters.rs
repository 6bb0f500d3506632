//! Parameters, tiers and runs.

use super::comparison::NumericsSet;
use super::fluid::{Fluid, FluidKind};
use crate::case::{ParameterError, Parameters, Progress, Run, Tier};
use crate::cases::Arrangement;
use crate::cases::layer::{Layer, LayerObservation, Preparation, bulk_modulus};
use crate::cases::rules;
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::reference::Incline;
use bagnold_solver::material::rheology::{Bingham, HerschelBulkley, Newtonian, Rheology};
use bagnold_solver::parameter::{between, each, positive};
use bagnold_solver::weakly_compressible::numerics::Numerics;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FilmParameters {
    /// Layer height h `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.01"))]
    pub layer_height: f64,
    /// Slope angle `[°]`.
    #[schemars(transform = rules::slope_angle())]
    #[schemars(transform = between(0.1, 89.0, "a film needs a slope to flow down"))]
    pub slope_angle: f64,
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Density `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 1000"))]
    pub density: f64,
    /// Fluids to run.
    pub fluids: Vec<FluidKind>,
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
    /// Rows of the Newtonian convergence study on the lattice; empty for none.
    #[schemars(transform = each(rules::rows()))]
    pub convergence_resolutions: Vec<usize>,
    /// Rows of the Newtonian film that compares other operators and walls with the default; 0 for none.
    pub comparison_resolution: usize,
    /// Simulated time of the Newtonian film, from rest, over ρh²/η `[-]`.
    #[schemars(transform = positive("5 leaves less than 0.01 % of the approach"))]
    pub relaxation_times: f64,
    /// Simulated time of the yield-stress films, from the exact profile, over ρh²/η `[-]`.
    #[schemars(transform = positive("1 lets the errors of the start decay"))]
    pub yield_relaxation_times: f64,
    /// The Newtonian fluid.
    pub newtonian: Newtonian,
    /// The Bingham fluid.
    pub bingham: Bingham,
    /// The Herschel–Bulkley fluid.
    pub herschel_bulkley: HerschelBulkley,
    /// Numerics.
    pub numerics: Numerics,
}

impl Parameters for FilmParameters {
    type Run = FilmRun;

    fn of_tier(tier: Tier) -> Self {
        let quick = Self {
            layer_height: 0.01,
            slope_angle: 10.0,
            gravity: 9.81,
            density: 1000.0,
            fluids: vec![FluidKind::Newtonian, FluidKind::Bingham, FluidKind::HerschelBulkley],
            resolution: 20,
            columns: 8,
            jitter: 0.1,
            seed: 1,
            preparation: Preparation::Settled,
            convergence_resolutions: vec![10, 20],
            comparison_resolution: 20,
            relaxation_times: 5.0,
            yield_relaxation_times: 1.0,
            newtonian: Newtonian { viscosity: 1.0 },
            // a plug over the upper 0.3 h that creeps by about 1 % of its speed
            bingham: Bingham { yield_stress: 5.1, plastic_viscosity: 0.5, regularisation_rate: 0.3 },
            herschel_bulkley: HerschelBulkley {
                yield_stress: 5.1,
                consistency: 1.1,
                flow_index: 0.7,
                regularisation_rate: 0.3,
            },
            // a viscous fluid needs no artificial viscosity, which is first order: α h c/8 is 0.4 % of ν at 20 rows
            numerics: Numerics { artificial_viscosity: 0.0, ..Numerics::default() },
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => Self { resolution: 40, columns: 12, convergence_resolutions: vec![10, 20, 40], ..quick },
            Tier::Fine => Self { resolution: 80, columns: 12, convergence_resolutions: vec![20, 40, 80], ..quick },
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        if self.comparison_resolution > 0 {
            rules::row_count("comparison_resolution", self.comparison_resolution)?;
            let widest = NumericsSet::OTHERS.map(|set| set.numerics(self.numerics));
            for numerics in &widest {
                rules::columns("columns", self.columns, numerics)?;
            }
        }
        rules::columns("columns", self.columns, &self.numerics)?;
        let base = self.incline().shear_stress(0.0);
        let fluids = [
            ("bingham.yield_stress", self.bingham.yield_stress),
            ("herschel_bulkley.yield_stress", self.herschel_bulkley.yield_stress),
        ];
        for (field, yield_stress) in fluids {
            let remedy = format!("the shear stress at the bed is {base:.3} Pa: above it nothing flows");
            rules::between(field, yield_stress, 0.0, 0.95 * base, &remedy)?;
        }
        rules::viscous_step("numerics", &self.numerics, &Rheology::Newtonian(self.newtonian))
    }

    fn runs(&self) -> Vec<FilmRun> {
        let new = |kind, particles, resolution, numerics_set: NumericsSet| FilmRun {
            fluid: self.fluid(kind),
            particles,
            resolution,
            numerics_set,
            layer_height: self.layer_height,
            slope_angle: self.slope_angle,
            gravity: self.gravity,
            density: self.density,
            columns: self.columns,
            jitter: particles.displacement(self.jitter),
            seed: self.seed,
            preparation: self.preparation,
            relaxation_times: match kind {
                FluidKind::Newtonian => self.relaxation_times,
                _ => self.yield_relaxation_times,
            },
            numerics: numerics_set.numerics(self.numerics),
        };
        let mut runs = Vec::new();
        for &kind in &self.fluids {
            runs.push(new(kind, Arrangement::Jittered, self.resolution, NumericsSet::Default));
            if kind == FluidKind::Newtonian {
                let study = self.convergence_resolutions.iter();
                runs.extend(study.map(|&rows| new(kind, Arrangement::Lattice, rows, NumericsSet::Default)));
            }
        }
        if self.comparison_resolution > 0 && self.fluids.contains(&FluidKind::Newtonian) {
            let other = |set| new(FluidKind::Newtonian, Arrangement::Jittered, self.comparison_resolution, set);
            // the default is compared at the same resolution, which the profile may have run already
            if self.comparison_resolution != self.resolution {
                runs.push(other(NumericsSet::Default));
            }
            runs.extend(NumericsSet::OTHERS.map(other));
        }
        runs
    }
}

impl FilmParameters {
    fn incline(&self) -> Incline {
        Incline {
            layer_height: self.layer_height,
            slope_angle: self.slope_angle.to_radians(),
            gravity: self.gravity,
            density: self.density,
        }
    }

    fn fluid(&self, kind: FluidKind) -> Fluid {
        match kind {
            FluidKind::Newtonian => Fluid::Newtonian(self.newtonian),
            FluidKind::Bingham => Fluid::Bingham(self.bingham),
            FluidKind::HerschelBulkley => Fluid::HerschelBulkley(self.herschel_bulkley),
        }
    }
}

/// One simulation.
#[derive(Debug, Clone, Serialize)]
pub struct FilmRun {
    /// Fluid.
    pub fluid: Fluid,
    /// Arrangement of the particles.
    pub particles: Arrangement,
    /// Rows over the layer.
    pub resolution: usize,
    /// Which numerics.
    pub numerics_set: NumericsSet,
    layer_height: f64,
    slope_angle: f64,
    gravity: f64,
    density: f64,
    columns: usize,
    jitter: f64,
    seed: u64,
    preparation: Preparation,
    relaxation_times: f64,
    numerics: Numerics,
}

impl Run for FilmRun {
    type Observation = LayerObservation;

    fn variant(&self) -> Variant {
        let fluid = match self.fluid.kind() {
            FluidKind::Newtonian => "newtonian",
            FluidKind::Bingham => "bingham",
            FluidKind::HerschelBulkley => "herschel_bulkley",
        };
        let variant = Variant::of("fluid", fluid).and("particles", self.particles.name());
        let variant = match self.numerics_set {
            NumericsSet::Default => variant,
            other => variant.and("numerics", other.name()),
        };
        variant.and("resolution", self.resolution)
    }

    fn particle_steps(&self) -> f64 {
        self.layer(&|_| 0.0).expected_steps() * (self.resolution * self.columns) as f64
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<LayerObservation>, ParameterError> {
        let moving = self.fluid.kind() != FluidKind::Newtonian;
        let incline = self.incline();
        let velocity = |y: f64| if moving { self.fluid.velocity(incline, y) } else { 0.0 };
        Ok(self.layer(&velocity).run(progress)?)
    }
}

impl FilmRun {
    /// The film's geometry.
    #[must_use]
    pub fn incline(&self) -> Incline {
        Incline {
            layer_height: self.layer_height,
            slope_angle: self.slope_angle.to_radians(),
            gravity: self.gravity,
            density: self.density,
        }
    }

    /// Exact velocity `[m/s]` of the Newtonian film as a weakly compressible fluid, whose density grows with the
    /// pressure p = K (exp(ρ0 g cosθ (h − y)/K) − 1): η du/dy = p tanθ. It exceeds the incompressible one by 0.7 % of
    /// the surface velocity at K = 50 ρ0 g h. None for the other fluids.
    #[must_use]
    pub fn weakly_compressible_velocity(&self, height: f64) -> Option<f64> {
        let Fluid::Newtonian(law) = self.fluid else { return None };
        let layer = self.layer(&|_| 0.0);
        let (bulk_modulus, h) = (layer.bulk_modulus, self.layer_height);
        let rate = self.density * self.gravity * libm::cos(layer.slope_angle) / bulk_modulus;
        // (exp(ah) − exp(a(h − y)))/a − y without cancellation for a stiff fluid
        let integral = libm::exp(rate * (h - height)) * libm::expm1(rate * height) / rate - height;
        Some(libm::tan(layer.slope_angle) * bulk_modulus / law.viscosity * integral)
    }

    fn layer<'a>(&self, velocity: &'a (dyn Fn(f64) -> f64 + Sync)) -> Layer<'a> {
        let incline = self.incline();
        let viscosity = self.fluid.relaxing_viscosity(incline);
        let duration = self.relaxation_times * self.density * self.layer_height * self.layer_height / viscosity;
        let mean = self.fluid.flux(incline) / self.layer_height;
        Layer {
            height: self.layer_height,
            rows: self.resolution,
            columns: self.columns,
            slope_angle: incline.slope_angle,
            gravity: self.gravity,
            reference_density: self.density,
            bulk_modulus: bulk_modulus(self.density, self.gravity, self.layer_height, mean),
            rheology: self.fluid.rheology(),
            numerics: self.numerics,
            jitter: self.jitter,
            seed: self.seed,
            preparation: self.preparation,
            velocity,
            // viscous laws make their stress from the velocity
            shear_stress: &|_| 0.0,
            duration,
            window: 0.15 * duration,
            interval: duration / 500.0,
            stop_above: f64::INFINITY,
            frames: 2,
            // (13) is known to go unstable on displaced particles; that is shown, and no error of the run
            may_diverge: self.numerics_set != NumericsSet::Default,
        }
    }
}
