//! The case's parameters and their tiers.

use crate::case::{ParameterError, Parameters, Tier};
use crate::collapse::{self, ColumnPurpose, ColumnRun, Geometry, Material, Release};
use crate::reference::grains::{LAGREE_GRAINS, TABLE_2_SAND};
use crate::setup::{Bulk, rules};
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
    /// Radius r_0 `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.1"))]
    pub radius: f64,
    /// Density in bulk.
    #[serde(flatten)]
    pub bulk: Bulk,
    /// How columns are released and simulated.
    #[serde(flatten)]
    pub release: Release,
    /// Columns of the grains to run.
    pub columns: Vec<RoundColumn>,
    /// Columns of Lagrée's grains to run, r_0 = 0.1 m: their friction rises with the rate by enough to be told.
    pub lagree: Vec<RoundColumn>,
    /// Grains.
    pub sand: Rheology,
}

impl Parameters for ColumnRoundParameters {
    type Run = ColumnRun;

    fn of_tier(tier: Tier) -> Self {
        let columns = |pairs: &[(f64, usize)]| {
            pairs.iter().map(|&(aspect_ratio, resolution)| RoundColumn { aspect_ratio, resolution }).collect()
        };
        let paper = [(0.5, 40), (0.9, 24), (1.7, 20), (2.75, 16), (4.8, 14), (8.0, 12)];
        Self {
            radius: collapse::SAND_HALF_WIDTH,
            bulk: Bulk::of_grains(TABLE_2_SAND.solid_fraction),
            // in space 1.3 holds 80 neighbours, 1.5 holds 120
            release: Release::with(Numerics { smoothing_ratio: 1.3, ..Numerics::default() }),
            columns: match tier {
                Tier::Quick => columns(&[(1.7, 12)]),
                Tier::Paper => columns(&paper),
                Tier::Fine => columns(&paper.map(|(aspect_ratio, resolution)| (aspect_ratio, resolution * 3 / 2))),
            },
            lagree: match tier {
                Tier::Quick => columns(&[(0.9, 12)]),
                Tier::Paper | Tier::Fine => columns(&[(0.9, 12), (0.9, 24), (3.0, 14)]),
            },
            sand: Rheology::MuI(TABLE_2_SAND.law),
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        rules::material("sand", &self.sand)?;
        self.bulk.check(&self.sand)?;
        rules::viscous_step("numerics", &self.release.numerics, &self.sand)
    }

    fn check_runs(&self, runs: &[&ColumnRun]) -> Result<(), ParameterError> {
        collapse::check_size(runs, |run| {
            let is_it =
                |column: &RoundColumn| column.aspect_ratio == run.aspect_ratio && column.resolution == run.resolution;
            let (list, columns) =
                if run.material == Material::LAGREE { ("lagree", &self.lagree) } else { ("columns", &self.columns) };
            format!("{list}[{}].resolution", columns.iter().position(is_it).unwrap_or(0))
        })
    }

    fn runs(&self) -> Vec<ColumnRun> {
        let run = |column: &RoundColumn, material, half_width, law: Rheology, bulk: &Bulk| ColumnRun {
            purpose: ColumnPurpose::Law,
            geometry: Geometry::Round,
            material,
            aspect_ratio: column.aspect_ratio,
            resolution: column.resolution,
            half_width,
            law,
            bulk_density: bulk.density(&law),
            regularisation_rate: None,
            shown_times: Vec::new(),
            release: self.release,
        };
        let (law, bulk) = (Rheology::MuI(LAGREE_GRAINS.law), Bulk::of_grains(LAGREE_GRAINS.solid_fraction));
        let own = self.columns.iter().map(|column| run(column, Material::SAND, self.radius, self.sand, &self.bulk));
        own.chain(self.lagree.iter().map(|column| run(column, Material::LAGREE, 0.1, law, &bulk))).collect()
    }
}
