//! The case's parameters and their tiers.

use crate::case::{ParameterError, Tier};
use crate::cases::collapse::{Alteration, ColumnRun, Geometry, Grains, Material, Purpose};
use crate::cases::rules;
use crate::reference::{GLASS_BEADS, LAGREE_GRAINS, TABLE_2_SAND};
use bagnold_solver::material::rheology::{MuI, Rheology};
use bagnold_solver::weakly_compressible::numerics::{Numerics, ViscousStep};
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

/// Columns of grains that differ from others in one number.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Variants {
    /// What that number is instead; empty for none.
    pub values: Vec<f64>,
    /// Aspect ratios of their columns `[-]`.
    pub aspect_ratios: Vec<f64>,
}

/// How far results depend on what should not matter, for the grains of Lagrée et al.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sensitivity {
    /// Aspect ratios `[-]`; empty for none.
    pub aspect_ratios: Vec<f64>,
    /// Particles over the half width.
    pub resolutions: Vec<usize>,
    /// Seeds of each resolution; the first is the case's own.
    pub seeds: Vec<u64>,
    /// Hourglass coefficients at which the first aspect ratio is repeated `[-]`; empty for none.
    pub hourglass: Vec<f64>,
    /// Particles over the half width of these.
    pub hourglass_resolutions: Vec<usize>,
}

/// The regularised law with an implicit viscous step, beside the return mapping.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Regularised {
    /// Aspect ratios of columns of the sand that are repeated with it `[-]`; empty for none.
    pub aspect_ratios: Vec<f64>,
    /// Rate α_r of (35) `[1/s]`.
    pub rate: f64,
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
    /// Sand with other values of I_0 `[-]`.
    pub sand_inertias: Variants,
    /// Grains of Lagrée et al. with other diameters `[m]`.
    pub lagree_diameters: Variants,
    /// Grid convergence and hourglass control.
    pub sensitivity: Sensitivity,
    /// The paper's stress update.
    pub regularised: Regularised,
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
    ("sand.law.reference_inertia", "I_0 [-]; 2.65 as printed; 0.279 follows from (41) for the glass beads"),
    ("sand.law.grain_diameter", "D [m]"),
    ("sand.law.grain_density", "ρ_s [kg/m³]"),
    ("glass.aspect_ratios", "h_0/r_0 [-]; other fields as of the sand"),
    ("lagree.aspect_ratios", "h_0/r_0 [-]"),
    ("lagree.half_width", "r_0 [m]"),
    ("lagree.tall_half_width", "r_0 [m], the same at every aspect ratio"),
    ("sand_inertias.values", "I_0 [-] of further columns of sand; empty for none"),
    ("lagree_diameters.values", "D [m] of further columns of Lagrée's grains; empty for none"),
    ("sensitivity.resolutions", "particles over r_0, for the grid convergence of Lagrée's grains"),
    ("sensitivity.seeds", "of each resolution; three at the finest of several"),
    ("sensitivity.hourglass", "[-], coefficients at which the first of these columns is repeated"),
    (
        "regularised.aspect_ratios",
        "h_0/r_0 [-] of columns of sand with (35), implicitly; compared with those of sand.aspect_ratios",
    ),
    ("regularised.rate", "α_r [1/s]"),
    ("lagree.law.grain_diameter", "D [m]; the source does not say, here D/r_0 = 0.02"),
];

/// Aspect ratio above which a column is narrower and coarser: the paper's own division of half widths.
const TALL: f64 = 3.0;
/// Aspect ratio above which `tall_resolution` holds.
const COARSE: f64 = 5.0;
/// Seeds at the finest resolution of a study.
const FINEST_SEEDS: usize = 3;
/// Longest time of a regularised column over √(h_0/g) `[-]`: it never rests.
const REGULARISED_DURATION: f64 = 5.0;
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
                solid_fraction: TABLE_2_SAND.solid_fraction,
                law: TABLE_2_SAND.law,
            },
            // Table 1; figures 7–9 are captioned glass beads
            glass: Columns {
                aspect_ratios: Vec::new(),
                half_width: 0.0972,
                tall_half_width: 0.0292,
                solid_fraction: GLASS_BEADS.solid_fraction,
                law: GLASS_BEADS.law,
            },
            lagree: Columns {
                aspect_ratios: vec![1.0],
                half_width: 0.1,
                tall_half_width: 0.1,
                solid_fraction: LAGREE_GRAINS.solid_fraction,
                law: LAGREE_GRAINS.law,
            },
            sand_inertias: Variants { values: Vec::new(), aspect_ratios: Vec::new() },
            lagree_diameters: Variants { values: Vec::new(), aspect_ratios: Vec::new() },
            // the spread over five seeds, which the gates of run-out and height take into account
            sensitivity: Sensitivity {
                aspect_ratios: vec![1.0],
                resolutions: vec![20],
                seeds: vec![1, 2, 3, 4, 5],
                hourglass: Vec::new(),
                hourglass_resolutions: Vec::new(),
            },
            regularised: Regularised { aspect_ratios: vec![0.9], rate: 0.01 },
            numerics: Numerics::default(),
        };
        let paper = Self {
            sand_inertias: Variants {
                values: vec![GLASS_BEADS.law.reference_inertia],
                aspect_ratios: vec![5.0, 7.0, 10.0, 14.0, 20.0],
            },
            // D/r_0 = 0.01 and 0.04: the source does not say which
            lagree_diameters: Variants { values: vec![1e-3, 4e-3], aspect_ratios: vec![0.5, 1.0, 2.0, 3.0, 7.0] },
            sensitivity: Sensitivity {
                aspect_ratios: vec![1.0, 3.0],
                resolutions: vec![40, 60, 90],
                seeds: vec![1, 2, 3, 4, 5],
                hourglass: vec![0.0, 0.05, 0.2, 0.5],
                hourglass_resolutions: vec![20, 40],
            },
            regularised: Regularised { aspect_ratios: vec![1.0, 3.0], rate: 0.01 },
            resolution: 40,
            sand: Columns {
                aspect_ratios: vec![0.5, 0.7, 0.9, 1.0, 1.5, 2.0, 2.75, 3.0, 4.8, 5.0, 7.0, 10.0, 14.0, 20.0],
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

    pub(super) fn check(&self) -> Result<(), ParameterError> {
        rules::positive("gravity", self.gravity, "give it in m/s², such as 9.81")?;
        rules::rows("resolution", self.resolution)?;
        rules::rows("tall_resolution", self.tall_resolution)?;
        rules::between("jitter", self.jitter, 0.0, 0.5, "0.05 breaks the lattice without overlaps")?;
        rules::between("duration", self.duration, 0.1, 1000.0, "a column has come to rest after about 5")?;
        for (grains, columns) in self.materials() {
            let name = grains.name();
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
        self.check_variants()?;
        rules::numerics("numerics", &self.numerics)?;
        if !self.regularised.aspect_ratios.is_empty() {
            rules::implicit_runs("numerics", &self.numerics, "regularised.aspect_ratios")?;
        }
        rules::viscous_step("numerics", &self.numerics, &Rheology::MuI(self.sand.law))
    }

    fn check_variants(&self) -> Result<(), ParameterError> {
        let ratios = [
            ("sand_inertias", &self.sand_inertias.aspect_ratios),
            ("lagree_diameters", &self.lagree_diameters.aspect_ratios),
            ("sensitivity", &self.sensitivity.aspect_ratios),
            ("regularised", &self.regularised.aspect_ratios),
        ];
        for (name, ratios) in ratios {
            for (index, &ratio) in ratios.iter().enumerate() {
                let field = format!("{name}.aspect_ratios[{index}]");
                rules::between(&field, ratio, 0.1, 100.0, "the published laws reach from 0.3 to 20")?;
            }
        }
        for (index, &value) in self.sand_inertias.values.iter().enumerate() {
            rules::positive(
                &format!("sand_inertias.values[{index}]"),
                value,
                "0.279 follows from (41) for the glass beads",
            )?;
        }
        for (index, &value) in self.lagree_diameters.values.iter().enumerate() {
            let field = format!("lagree_diameters.values[{index}]");
            rules::positive(&field, value, "give it in metres, such as 0.001")?;
        }
        let study = &self.sensitivity;
        for (name, resolutions) in
            [("resolutions", &study.resolutions), ("hourglass_resolutions", &study.hourglass_resolutions)]
        {
            for (index, &resolution) in resolutions.iter().enumerate() {
                rules::rows(&format!("sensitivity.{name}[{index}]"), resolution)?;
            }
        }
        for (index, &coefficient) in study.hourglass.iter().enumerate() {
            let remedy = "the recipe has 0.2";
            rules::between(&format!("sensitivity.hourglass[{index}]"), coefficient, 0.0, 2.0, remedy)?;
        }
        rules::positive("regularised.rate", self.regularised.rate, "0.01 1/s in the paper")
    }

    /// The materials with their names.
    pub(super) fn materials(&self) -> [(Grains, &Columns); 3] {
        [(Grains::Sand, &self.sand), (Grains::Glass, &self.glass), (Grains::Lagree, &self.lagree)]
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
    let column = |material: Material, columns: &Columns, aspect_ratio: f64| ColumnRun {
        purpose: Purpose::Law,
        geometry: Geometry::Planar,
        material,
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
        shown_times: if matches!(material, Material::SAND | Material::GLASS) {
            shown_times(aspect_ratio)
        } else {
            Vec::new()
        },
        numerics: parameters.numerics,
    };
    let mut runs = Vec::new();
    for (grains, columns) in parameters.materials() {
        runs.extend(
            columns
                .aspect_ratios
                .iter()
                .map(|&aspect_ratio| column(Material::published(grains), columns, aspect_ratio)),
        );
    }
    let (sand, lagree) = (&parameters.sand, &parameters.lagree);
    for &reference_inertia in &parameters.sand_inertias.values {
        let columns = Columns { law: MuI { reference_inertia, ..sand.law }, ..sand.clone() };
        let material = Material::altered(Grains::Sand, Alteration::ReferenceInertia(reference_inertia));
        runs.extend(parameters.sand_inertias.aspect_ratios.iter().map(|&ratio| column(material, &columns, ratio)));
    }
    for &grain_diameter in &parameters.lagree_diameters.values {
        let columns = Columns { law: MuI { grain_diameter, ..lagree.law }, ..lagree.clone() };
        let material = Material::altered(Grains::Lagree, Alteration::GrainDiameter(grain_diameter));
        runs.extend(parameters.lagree_diameters.aspect_ratios.iter().map(|&ratio| column(material, &columns, ratio)));
    }
    let study = &parameters.sensitivity;
    let finest = study.resolutions.iter().copied().max().unwrap_or(0);
    for &ratio in &study.aspect_ratios {
        for &resolution in &study.resolutions {
            let seeds = study.seeds.iter().take(if resolution == finest && study.resolutions.len() > 1 {
                FINEST_SEEDS
            } else {
                usize::MAX
            });
            for &seed in seeds {
                let own = column(Material::LAGREE, lagree, ratio);
                // the column that is there for the laws is one of its ensemble
                let known = resolution == own.resolution && seed == own.seed && lagree.aspect_ratios.contains(&ratio);
                if !known {
                    runs.push(ColumnRun { purpose: Purpose::Convergence, resolution, seed, ..own });
                }
            }
        }
    }
    for &ratio in study.aspect_ratios.iter().take(1) {
        for &resolution in &study.hourglass_resolutions {
            runs.extend(study.hourglass.iter().map(|&hourglass| {
                let numerics = Numerics { hourglass, ..parameters.numerics };
                ColumnRun {
                    purpose: Purpose::Hourglass,
                    resolution,
                    numerics,
                    ..column(Material::LAGREE, lagree, ratio)
                }
            }));
        }
    }
    runs.extend(parameters.regularised.aspect_ratios.iter().map(|&ratio| ColumnRun {
        purpose: Purpose::Regularised,
        regularisation_rate: Some(parameters.regularised.rate),
        duration: REGULARISED_DURATION.min(parameters.duration),
        numerics: Numerics { viscous_step: ViscousStep::Implicit, ..parameters.numerics },
        shown_times: Vec::new(),
        ..column(Material::SAND, sand, ratio)
    }));
    runs
}
