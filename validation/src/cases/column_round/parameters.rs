//! The case's parameters and their tiers.

use crate::case::{ParameterError, Tier};
use crate::cases::collapse::{ColumnRun, Geometry, Material, Purpose};
use crate::cases::column_planar::ColumnPlanarParameters;
use crate::cases::rules;
use bagnold_solver::material::rheology::{MuI, Rheology};
use bagnold_solver::weakly_compressible::numerics::Numerics;
use serde::{Deserialize, Serialize};

/// One column.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RoundColumn {
    /// a = h_0/r_0 `[-]`.
    pub aspect_ratio: f64,
    /// Particles over the radius.
    pub resolution: usize,
}

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ColumnRoundParameters {
    /// Gravity `[m/s²]`.
    pub gravity: f64,
    /// Radius r_0 `[m]`.
    pub radius: f64,
    /// Solid fraction φ `[-]`.
    pub solid_fraction: f64,
    /// Largest random displacement of a particle in spacings `[-]`.
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Longest simulated time over √(h_0/g) `[-]`.
    pub duration: f64,
    /// Columns to run.
    pub columns: Vec<RoundColumn>,
    /// Grains.
    pub sand: MuI,
    /// Numerics.
    pub numerics: Numerics,
}

pub(super) const FIELD_NOTES: &[(&str, &str)] = &[
    ("gravity", "[m/s²]"),
    ("radius", "r_0 [m]"),
    ("solid_fraction", "[-], bulk density over grain density"),
    ("jitter", "[-], largest random displacement in spacings"),
    ("duration", "[-], longest simulated time over √(h_0/g)"),
    ("sand.static_friction", "μ_s [-]"),
    ("sand.limiting_friction", "μ_2 [-]"),
    ("sand.reference_inertia", "I_0 [-]"),
    ("sand.grain_diameter", "D [m]"),
    ("sand.grain_density", "ρ_s [kg/m³]"),
];

impl ColumnRoundParameters {
    pub(super) fn of_tier(tier: Tier) -> Self {
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

    pub(super) fn check(&self) -> Result<(), ParameterError> {
        rules::positive("gravity", self.gravity, "give it in m/s², such as 9.81")?;
        rules::positive("radius", self.radius, "give it in metres, such as 0.1")?;
        rules::between("solid_fraction", self.solid_fraction, 0.01, 0.74, "grains fill 0.5 to 0.64 of the space")?;
        rules::between("jitter", self.jitter, 0.0, 0.5, "0.05 breaks the lattice without overlaps")?;
        rules::between("duration", self.duration, 0.1, 1000.0, "a column has come to rest after about 5")?;
        for (index, column) in self.columns.iter().enumerate() {
            let field = |name: &str| format!("columns[{index}].{name}");
            let remedy = "the published laws reach from 0.3 to 20";
            rules::between(&field("aspect_ratio"), column.aspect_ratio, 0.1, 100.0, remedy)?;
            rules::rows(&field("resolution"), column.resolution)?;
        }
        rules::material("sand", &Rheology::MuI(self.sand))?;
        rules::numerics("numerics", &self.numerics)?;
        rules::viscous_step("numerics", &self.numerics, &Rheology::MuI(self.sand))
    }
}

pub(super) fn runs(parameters: &ColumnRoundParameters) -> Vec<ColumnRun> {
    let run = |column: &RoundColumn| ColumnRun {
        purpose: Purpose::Law,
        geometry: Geometry::Round,
        material: Material::SAND,
        aspect_ratio: column.aspect_ratio,
        resolution: column.resolution,
        half_width: parameters.radius,
        law: parameters.sand,
        regularisation_rate: None,
        gravity: parameters.gravity,
        solid_fraction: parameters.solid_fraction,
        jitter: parameters.jitter,
        seed: parameters.seed,
        duration: parameters.duration,
        shown_times: Vec::new(),
        numerics: parameters.numerics,
    };
    parameters.columns.iter().map(run).collect()
}
