//! The case's parameters and their tiers.

use crate::case::{ParameterError, Parameters, Tier};
use crate::cases::collapse::{self, ColumnRun, Geometry, Material, Purpose};
use crate::cases::{Bulk, rules};
use crate::reference::TABLE_2_SAND;
use bagnold_solver::material::rheology::Rheology;
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
    /// Density in bulk.
    #[serde(flatten)]
    pub bulk: Bulk,
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
    pub sand: Rheology,
    /// Numerics.
    pub numerics: Numerics,
}

impl Parameters for ColumnRoundParameters {
    type Run = ColumnRun;

    fn of_tier(tier: Tier) -> Self {
        let columns = |pairs: &[(f64, usize)]| {
            pairs.iter().map(|&(aspect_ratio, resolution)| RoundColumn { aspect_ratio, resolution }).collect()
        };
        let paper = [(0.5, 40), (0.9, 24), (1.7, 20), (2.75, 16), (4.8, 14), (8.0, 12)];
        Self {
            gravity: 9.81,
            radius: collapse::SAND_HALF_WIDTH,
            bulk: Bulk::of_grains(TABLE_2_SAND.solid_fraction),
            jitter: 0.05,
            seed: 1,
            duration: 10.0,
            columns: match tier {
                Tier::Quick => columns(&[(1.7, 12)]),
                Tier::Paper => columns(&paper),
                Tier::Fine => columns(&paper.map(|(aspect_ratio, resolution)| (aspect_ratio, resolution * 3 / 2))),
            },
            sand: Rheology::MuI(TABLE_2_SAND.law),
            // in space 1.3 holds 80 neighbours, 1.5 holds 120
            numerics: Numerics { smoothing_ratio: 1.3, ..Numerics::default() },
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        rules::material("sand", &self.sand)?;
        self.bulk.check(&self.sand)?;
        rules::viscous_step("numerics", &self.numerics, &self.sand)?;
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
            bulk_density: self.bulk.density(&self.sand),
            regularisation_rate: None,
            gravity: self.gravity,
            jitter: self.jitter,
            seed: self.seed,
            duration: self.duration,
            shown_times: Vec::new(),
            numerics: self.numerics,
        };
        self.columns.iter().map(run).collect()
    }
}
