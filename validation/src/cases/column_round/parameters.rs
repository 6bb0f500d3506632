//! The case's parameters and their tiers.

use crate::case::{ParameterError, Parameters, Tier};
use crate::cases::collapse::{self, ColumnRun, Geometry, Material, Purpose};
use crate::cases::column_planar::ColumnPlanarParameters;
use crate::cases::rules;
use bagnold_solver::material::rheology::{MuI, Rheology};
use bagnold_solver::parameter::{between, positive};
use bagnold_solver::weakly_compressible::numerics::Numerics;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// One column.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct RoundColumn {
    /// a = h_0/r_0 `[-]`.
    #[schemars(transform = between(0.1, 100.0, "the published laws reach from 0.3 to 20"))]
    pub aspect_ratio: f64,
    /// Particles over the radius.
    #[schemars(transform = rules::rows())]
    pub resolution: usize,
}

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ColumnRoundParameters {
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Radius r_0 `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.1"))]
    pub radius: f64,
    /// Solid fraction φ `[-]`.
    #[schemars(transform = between(0.01, 0.74, "grains fill 0.5 to 0.64 of the space"))]
    pub solid_fraction: f64,
    /// Largest random displacement of a particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "0.05 breaks the lattice without overlaps"))]
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Longest simulated time over √(h_0/g) `[-]`.
    #[schemars(transform = between(0.1, 1000.0, "a column has come to rest after about 5"))]
    pub duration: f64,
    /// Columns to run.
    pub columns: Vec<RoundColumn>,
    /// Grains.
    pub sand: MuI,
    /// Numerics.
    pub numerics: Numerics,
}

impl Parameters for ColumnRoundParameters {
    type Run = ColumnRun;

    fn of_tier(tier: Tier) -> Self {
        // the sand, and so its table, are those of the planar columns
        let planar = ColumnPlanarParameters::of_tier(tier);
        let columns = |pairs: &[(f64, usize)]| {
            pairs.iter().map(|&(aspect_ratio, resolution)| RoundColumn { aspect_ratio, resolution }).collect()
        };
        let paper = [(0.5, 40), (0.9, 24), (1.7, 20), (2.75, 16), (4.8, 14), (8.0, 12)];
        Self {
            gravity: planar.gravity,
            radius: planar.sand.half_width,
            solid_fraction: planar.sand.solid_fraction,
            jitter: planar.jitter,
            seed: planar.seed,
            duration: planar.duration,
            columns: match tier {
                Tier::Quick => columns(&[(1.7, 12)]),
                Tier::Paper => columns(&paper),
                Tier::Fine => columns(&paper.map(|(aspect_ratio, resolution)| (aspect_ratio, resolution * 3 / 2))),
            },
            sand: planar.sand.law,
            // in space 1.3 holds 80 neighbours, 1.5 holds 120
            numerics: Numerics { smoothing_ratio: 1.3, ..planar.numerics },
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        rules::material("sand", &Rheology::MuI(self.sand))?;
        rules::viscous_step("numerics", &self.numerics, &Rheology::MuI(self.sand))?;
        collapse::check_size(&self.runs(), |run| {
            let is_it =
                |column: &RoundColumn| column.aspect_ratio == run.aspect_ratio && column.resolution == run.resolution;
            format!("columns[{}].resolution", self.columns.iter().position(is_it).unwrap_or(0))
        })
    }

    fn runs(&self) -> Vec<ColumnRun> {
        let run = |column: &RoundColumn| ColumnRun {
            purpose: Purpose::Law,
            geometry: Geometry::Round,
            material: Material::SAND,
            aspect_ratio: column.aspect_ratio,
            resolution: column.resolution,
            half_width: self.radius,
            law: self.sand,
            regularisation_rate: None,
            gravity: self.gravity,
            solid_fraction: self.solid_fraction,
            jitter: self.jitter,
            seed: self.seed,
            duration: self.duration,
            shown_times: Vec::new(),
            numerics: self.numerics,
        };
        self.columns.iter().map(run).collect()
    }
}
