//! The case's parameters and their tiers.

use crate::case::Tier;
use crate::cases::collapse::{ColumnRun, Geometry};
use crate::cases::rules;
use crate::error::InputError;
use bagnold_solver::numerics::Numerics;
use bagnold_solver::rheology::{MuI, Rheology};
use serde::{Deserialize, Serialize};

/// Grains and the columns that are made of them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Columns {
    /// Aspect ratios a = h_0/r_0 `[-]`; empty for none.
    pub aspect_ratios: Vec<f64>,
    /// Half width r_0 of columns up to an aspect ratio of 3 `[m]`.
    pub half_width: f64,
    /// Half width of taller columns `[m]`.
    pub tall_half_width: f64,
    /// Solid fraction φ `[-]`: the bulk density is φ times the grain density.
    pub solid_fraction: f64,
    /// Constitutive law.
    pub law: MuI,
}

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ColumnPlanarParameters {
    /// Gravity `[m/s²]`.
    pub gravity: f64,
    /// Particles over the half width, aspect ratios up to 5.
    pub resolution: usize,
    /// Particles over the half width, taller columns.
    pub tall_resolution: usize,
    /// Largest random displacement of a particle in spacings `[-]`.
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Longest simulated time over √(h_0/g) `[-]`; a deposit at rest ends a run before.
    pub duration: f64,
    /// The paper's sand.
    pub sand: Columns,
    /// The paper's glass beads, for figures 7–9.
    pub glass: Columns,
    /// Grains of Lagrée, Staron & Popinet (2011).
    pub lagree: Columns,
    /// Numerics.
    pub numerics: Numerics,
}

pub(super) const FIELD_NOTES: &[(&str, &str)] = &[
    ("gravity", "[m/s²]"),
    ("resolution", "particles over the half width, aspect ratios up to 5"),
    ("tall_resolution", "the same for taller columns"),
    ("jitter", "[-], largest random displacement in spacings"),
    ("duration", "[-], longest simulated time over √(h_0/g)"),
    ("sand.aspect_ratios", "h_0/r_0 [-]"),
    ("sand.half_width", "r_0 [m] up to an aspect ratio of 3"),
    ("sand.tall_half_width", "r_0 [m] of taller columns"),
    ("sand.solid_fraction", "[-], bulk density over grain density"),
    ("sand.law.static_friction", "μ_s [-]"),
    ("sand.law.limiting_friction", "μ_2 [-]"),
    ("sand.law.reference_inertia", "I_0 [-]; 2.65 as printed, 0.279 in other tables of the paper"),
    ("sand.law.grain_diameter", "D [m]"),
    ("sand.law.grain_density", "ρ_s [kg/m³]"),
    ("glass.aspect_ratios", "h_0/r_0 [-]; other fields as of the sand"),
    ("lagree.aspect_ratios", "h_0/r_0 [-]"),
    ("lagree.half_width", "r_0 [m]"),
    ("lagree.tall_half_width", "r_0 [m], the same at every aspect ratio"),
    ("lagree.law.grain_diameter", "D [m]; the source does not say, here D/r_0 = 0.02"),
];

/// Aspect ratio above which a column is narrower and coarser: the paper's own division of half widths.
const TALL: f64 = 3.0;
/// Aspect ratio above which `tall_resolution` holds.
const COARSE: f64 = 5.0;
/// The paper's figures 7–9: aspect ratio and times `[s]`.
const SHOWN: [(f64, &[f64]); 3] = [(0.9, &[0.07, 0.3]), (2.75, &[0.04, 0.12, 0.34, 0.53]), (4.8, &[0.04, 0.2, 0.4])];

/// Times at which the paper shows a column of this aspect ratio `[s]`.
fn shown_times(aspect_ratio: f64) -> Vec<f64> {
    SHOWN.iter().find(|shown| shown.0 == aspect_ratio).map_or(Vec::new(), |shown| shown.1.to_vec())
}

impl ColumnPlanarParameters {
    pub(in crate::cases) fn of_tier(tier: Tier) -> Self {
        let quick = Self {
            gravity: 9.81,
            resolution: 20,
            tall_resolution: 20,
            jitter: 0.05,
            seed: 1,
            duration: 10.0,
            // Table 2; figures 7–10
            sand: Columns {
                aspect_ratios: vec![0.7, 0.9, 1.5, 3.0],
                half_width: 0.0972,
                tall_half_width: 0.0292,
                solid_fraction: 0.62,
                law: MuI {
                    static_friction: 0.589,
                    limiting_friction: 1.248,
                    reference_inertia: 2.65,
                    grain_diameter: 0.32e-3,
                    grain_density: 2600.0,
                },
            },
            // Table 1; figures 7–9 are captioned glass beads
            glass: Columns {
                aspect_ratios: Vec::new(),
                half_width: 0.0972,
                tall_half_width: 0.0292,
                solid_fraction: 0.6,
                law: MuI {
                    static_friction: 0.382,
                    limiting_friction: 0.643,
                    reference_inertia: 0.279,
                    grain_diameter: 0.5e-3,
                    grain_density: 2500.0,
                },
            },
            lagree: Columns {
                aspect_ratios: vec![1.0],
                half_width: 0.1,
                tall_half_width: 0.1,
                solid_fraction: 0.6,
                law: MuI {
                    static_friction: 0.32,
                    limiting_friction: 0.60,
                    reference_inertia: 0.4,
                    grain_diameter: 2e-3,
                    grain_density: 2500.0,
                },
            },
            numerics: Numerics::default(),
        };
        let paper = Self {
            resolution: 40,
            sand: Columns {
                aspect_ratios: vec![0.5, 0.7, 0.9, 1.5, 2.0, 2.75, 4.8, 5.0, 7.0, 10.0, 14.0, 20.0],
                ..quick.sand.clone()
            },
            glass: Columns { aspect_ratios: SHOWN.iter().map(|shown| shown.0).collect(), ..quick.glass.clone() },
            lagree: Columns { aspect_ratios: vec![0.5, 1.0, 2.0, 3.0, 7.0, 10.0, 14.0, 20.0], ..quick.lagree.clone() },
            ..quick.clone()
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => paper,
            Tier::Fine => Self { resolution: 80, tall_resolution: 40, ..paper },
        }
    }

    pub(super) fn check(&self) -> Result<(), InputError> {
        rules::positive("gravity", self.gravity, "give it in m/s², such as 9.81")?;
        rules::rows("resolution", self.resolution)?;
        rules::rows("tall_resolution", self.tall_resolution)?;
        rules::between("jitter", self.jitter, 0.0, 0.5, "0.05 breaks the lattice without overlaps")?;
        rules::between("duration", self.duration, 0.1, 1000.0, "a column has come to rest after about 5")?;
        for (name, columns) in self.materials() {
            for (index, &ratio) in columns.aspect_ratios.iter().enumerate() {
                let field = format!("{name}.aspect_ratios[{index}]");
                rules::between(&field, ratio, 0.1, 100.0, "the published laws reach from 0.3 to 20")?;
            }
            rules::positive(&format!("{name}.half_width"), columns.half_width, "give it in metres, such as 0.1")?;
            let field = format!("{name}.tall_half_width");
            rules::positive(&field, columns.tall_half_width, "give it in metres, such as 0.03")?;
            let field = format!("{name}.solid_fraction");
            rules::between(&field, columns.solid_fraction, 0.01, 0.74, "grains fill 0.5 to 0.64 of the space")?;
            rules::material(&format!("{name}.law"), &Rheology::MuI(columns.law))?;
        }
        rules::numerics("numerics", &self.numerics)
    }

    /// The materials with their names.
    pub(super) fn materials(&self) -> [(&'static str, &Columns); 3] {
        [("sand", &self.sand), ("glass", &self.glass), ("lagree", &self.lagree)]
    }

    /// The parameter that a column's resolution comes from.
    pub(super) fn resolution_field(&self, aspect_ratio: f64) -> &'static str {
        if aspect_ratio > COARSE { "tall_resolution" } else { "resolution" }
    }

    /// Particles over the half width of a column.
    pub(super) fn resolution_of(&self, aspect_ratio: f64) -> usize {
        if aspect_ratio > COARSE { self.tall_resolution } else { self.resolution }
    }
}

impl Columns {
    /// Half width of a column `[m]`.
    pub(super) fn half_width_of(&self, aspect_ratio: f64) -> f64 {
        if aspect_ratio > TALL { self.tall_half_width } else { self.half_width }
    }
}

pub(super) fn runs(parameters: &ColumnPlanarParameters) -> Vec<ColumnRun> {
    let mut runs = Vec::new();
    for (material, columns) in parameters.materials() {
        runs.extend(columns.aspect_ratios.iter().map(|&aspect_ratio| ColumnRun {
            geometry: Geometry::Planar,
            material: material.to_owned(),
            aspect_ratio,
            resolution: parameters.resolution_of(aspect_ratio),
            half_width: columns.half_width_of(aspect_ratio),
            law: columns.law,
            regularisation_rate: None,
            gravity: parameters.gravity,
            solid_fraction: columns.solid_fraction,
            jitter: parameters.jitter,
            seed: parameters.seed,
            duration: parameters.duration,
            shown_times: if material == "lagree" { Vec::new() } else { shown_times(aspect_ratio) },
            numerics: parameters.numerics,
        }));
    }
    runs
}
