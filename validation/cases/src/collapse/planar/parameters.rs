//! The parameters.

use crate::collapse::{ExperimentGrains, Release, SAND_HALF_WIDTH, TALLEST_FINE};
use crate::reference::grains::PublishedGrains;
use crate::setup::{Bulk, rules};
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::parameter::{between, each, positive, within};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Grains and the columns that are made of them.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PlanarColumns {
    /// Aspect ratios a = h_0/r_0 `[-]`; empty for none.
    #[schemars(transform = each(between(0.1, 100.0, "the published laws reach from 0.3 to 20")))]
    pub aspect_ratios: Vec<f64>,
    /// Half width r_0 of columns up to an aspect ratio of 3 `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.1"))]
    pub half_width: f64,
    /// Half width of taller columns `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.03"))]
    pub tall_half_width: f64,
    /// Density in bulk.
    #[serde(flatten)]
    pub bulk: Bulk,
    /// Constitutive law.
    pub law: Rheology,
}

/// Columns of grains that differ from others in one number.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct Variants {
    /// What that number is instead; empty for none.
    pub values: Vec<f64>,
    /// Aspect ratios of their columns `[-]`.
    #[schemars(transform = each(between(0.1, 100.0, "the published laws reach from 0.3 to 20")))]
    pub aspect_ratios: Vec<f64>,
}

/// How far results depend on what should not matter: resolution and seed for the grains of Lagrée et al., the hourglass
/// coefficient for the sand as well.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct Sensitivity {
    /// Aspect ratios `[-]`; empty for none.
    #[schemars(transform = each(between(0.1, 100.0, "the published laws reach from 0.3 to 20")))]
    pub aspect_ratios: Vec<f64>,
    /// Particles over the half width, for the grid convergence.
    #[schemars(transform = each(rules::rows()))]
    pub resolutions: Vec<usize>,
    /// Seeds of each resolution, three at the finest of several; the first is the case's own.
    pub seeds: Vec<u64>,
    /// Hourglass coefficients at which the columns are repeated `[-]`; empty for none.
    #[schemars(transform = each(between(0.0, 2.0, "0.4 is the default of the numerics")))]
    pub hourglass: Vec<f64>,
    /// Seeds of each coefficient where fewer than 80 particles lie over the half width, whose mean is judged; one with more.
    pub hourglass_seeds: Vec<u64>,
    /// Particles over the half width of these.
    #[schemars(transform = each(rules::rows()))]
    pub hourglass_resolutions: Vec<usize>,
    /// Aspect ratios of columns of the sand and of Lagrée's grains whose velocity profile is judged by the mean over seeds `[-]`; empty for none.
    #[schemars(transform = each(between(0.1, 100.0, "the published laws reach from 0.3 to 20")))]
    pub profile_aspect_ratios: Vec<f64>,
    /// Their seeds beside the case's own.
    pub profile_seeds: Vec<u64>,
}

/// The regularised law with an implicit viscous step, beside the return mapping.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Regularised {
    /// Aspect ratios of columns of the sand that are repeated with it, implicitly, beside those of `sand` `[-]`; empty for none.
    #[schemars(transform = each(between(0.1, 100.0, "the published laws reach from 0.3 to 20")))]
    pub aspect_ratios: Vec<f64>,
    /// Rate α_r of (35) `[1/s]`.
    #[schemars(transform = positive("0.01 1/s in the paper"))]
    pub rate: f64,
}

/// Columns of the sand that are repeated with other numerics.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct OtherNumerics {
    /// Aspect ratios of columns with an eddy viscosity, beside those of `sand` `[-]`; empty for none.
    #[schemars(transform = each(between(0.1, 100.0, "the published laws reach from 0.3 to 20")))]
    pub eddy_aspect_ratios: Vec<f64>,
    /// Its constant C_s (5) `[-]`.
    #[schemars(transform = between(0.0, 1.0, "0.07 to 0.25 is usual"))]
    pub smagorinsky_constant: f64,
    /// Aspect ratios of columns without the coupling of density and pressure (27) `[-]`; empty for none.
    #[schemars(transform = each(between(0.1, 100.0, "the published laws reach from 0.3 to 20")))]
    pub uncoupled_aspect_ratios: Vec<f64>,
}

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ColumnPlanarParameters {
    /// Particles over the half width, aspect ratios up to 5.
    #[schemars(transform = rules::rows())]
    pub resolution: usize,
    /// Particles over the half width, taller columns.
    #[schemars(transform = rules::rows())]
    pub tall_resolution: usize,
    /// How columns are released and simulated.
    #[serde(flatten)]
    pub release: Release,
    /// The paper's sand; I_0 is 2.65 as printed, 0.279 follows from (41) for the glass beads.
    pub sand: PlanarColumns,
    /// The paper's glass beads, for figures 7–9.
    pub glass: PlanarColumns,
    /// Grains of Lagrée, Staron & Popinet (2011); the source does not say their diameter, here it is 0.02 r_0.
    pub lagree: PlanarColumns,
    /// The pile of aluminium bars that Bui et al. (2008) let collapse; their friction has no rate.
    pub bars: PlanarColumns,
    /// Particles over the half width of piles of bars.
    #[schemars(transform = rules::rows())]
    pub bars_resolution: usize,
    /// Bars with another friction, whatever the rate `[-]`: what the measured angle leaves open.
    #[schemars(transform = within("values", each(positive("the sine of the angle, 0.3387, is a wedge's in the plane"))))]
    pub bars_frictions: Variants,
    /// Bars whose friction rises with the rate, to these μ_2 `[-]`, with diameter and I_0 of Lagrée's grains: that of the bars was not
    /// measured.
    #[schemars(transform = within("values", each(positive("μ_s and the 0.28 of Lagrée's grains make 0.64"))))]
    pub bars_limiting_frictions: Variants,
    /// Sand with other values of I_0 `[-]`.
    #[schemars(transform = within("values", each(positive("0.279 follows from (41) for the glass beads"))))]
    pub sand_inertias: Variants,
    /// Grains of Lagrée et al. with other diameters `[m]`.
    #[schemars(transform = within("values", each(positive("give it in metres, such as 0.001"))))]
    pub lagree_diameters: Variants,
    /// Grid convergence and hourglass control.
    pub sensitivity: Sensitivity,
    /// An eddy viscosity, and no coupling of density and pressure.
    pub other_numerics: OtherNumerics,
    /// The paper's stress update.
    pub regularised: Regularised,
}

/// Aspect ratio above which a column is narrower and coarser: the paper's own division of half widths.
pub(super) const TALL: f64 = 3.0;
/// Half width of the paper's tall columns of sand `[m]`.
const TALL_SAND_HALF_WIDTH: f64 = 0.0292;
/// The paper's figures 7–9: aspect ratio and times `[s]`.
pub(super) const SHOWN: [(f64, &[f64]); 3] =
    [(0.9, &[0.07, 0.11, 0.3]), (2.75, &[0.04, 0.12, 0.34, 0.53]), (4.8, &[0.04, 0.2, 0.4])];

impl ColumnPlanarParameters {
    /// The materials with their names.
    pub(super) fn materials(&self) -> [(ExperimentGrains, &PlanarColumns); 4] {
        [
            (ExperimentGrains::Sand, &self.sand),
            (ExperimentGrains::Glass, &self.glass),
            (ExperimentGrains::Lagree, &self.lagree),
            (ExperimentGrains::Bars, &self.bars),
        ]
    }

    /// The parameter that a column's resolution comes from.
    pub(super) fn resolution_field(&self, grains: ExperimentGrains, aspect_ratio: f64) -> &'static str {
        match grains {
            ExperimentGrains::Bars => "bars_resolution",
            _ if aspect_ratio > TALLEST_FINE => "tall_resolution",
            _ => "resolution",
        }
    }

    /// Particles over the half width of a column.
    pub(super) fn resolution_of(&self, grains: ExperimentGrains, aspect_ratio: f64) -> usize {
        match grains {
            ExperimentGrains::Bars => self.bars_resolution,
            _ if aspect_ratio > TALLEST_FINE => self.tall_resolution,
            _ => self.resolution,
        }
    }
}

impl PlanarColumns {
    /// No columns yet, of published grains, 0.1 m to either side.
    pub(super) fn of(grains: &PublishedGrains) -> Self {
        Self {
            aspect_ratios: Vec::new(),
            half_width: 0.1,
            tall_half_width: 0.1,
            bulk: Bulk::of_grains(grains.solid_fraction),
            law: Rheology::MuI(grains.law),
        }
    }

    /// Whether the half width is the user's and that of tall columns still the paper's.
    pub(super) fn has_paper_width_of_tall_columns_alone(&self) -> bool {
        self.half_width != SAND_HALF_WIDTH && self.tall_half_width == TALL_SAND_HALF_WIDTH
    }

    /// Half width of a column `[m]`.
    pub(super) fn half_width_of(&self, aspect_ratio: f64) -> f64 {
        if aspect_ratio > TALL { self.tall_half_width } else { self.half_width }
    }
}
