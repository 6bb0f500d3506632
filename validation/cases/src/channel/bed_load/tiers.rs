//! What each tier runs.

use super::parameters::{BedLoadParameters, Beside, Continuum, Fit, GrainParticles, Materials, Stage, StageRuns};
use super::run::BedLoadRun;
use super::runs;
use crate::case::{ParameterError, Parameters, Tier};
use crate::channel::TurbulenceClosure;
use crate::reference::one_dimension::bed_load::Closures;
use bagnold_solver::incompressible::{ColumnNumerics, PairLaw, ProjectionNumerics};
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::material::rheology::{CoulombBingham, Rheology};
use bagnold_solver::material::turbulence::MixingLengthShape;

/// Fitted to Wong & Parker at 2 and 5 %; 3 % is held out.
pub(super) const FITTED: CoulombBingham = CoulombBingham {
    yield_stress: 5.1,
    friction: 0.6,
    plastic_viscosity: 1.67,
    regularisation_rate: 0.01,
    largest_viscosity: 1e4,
};

/// The slopes of the paper `[-]`.
const SLOPES: [f64; 3] = [0.02, 0.03, 0.05];

/// The pair law by which grains in rows are judged, and none for grains in columns.
const ROWS: [PairLaw; 1] = [PairLaw::PairRateMeanLoad];
const COLUMNS: [PairLaw; 0] = [];

impl Parameters for BedLoadParameters {
    type Run = BedLoadRun;

    fn of_tier(tier: Tier) -> Self {
        match tier {
            Tier::Quick => quick(),
            Tier::Paper => paper(quick()),
            Tier::Fine => fine(quick()),
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        self.check_combinations()
    }

    fn runs(&self) -> Vec<BedLoadRun> {
        runs::runs(self)
    }
}

/// One particle a grain, by the recipe and as printed.
fn grains() -> (GrainParticles, GrainParticles) {
    let stabilised = GrainParticles {
        slopes: vec![0.03],
        material: Rheology::CoulombBingham(FITTED),
        bed_depth: 0.03,
        length: 0.04,
        spacing: 2e-3,
        turbulence: TurbulenceClosure::MixingLength { shape: MixingLengthShape::Parabolic },
        origin_offset: 6e-4,
        drag: DragLaw::MorsiAlexander,
        drag_smoothing_length: 3e-3,
        start: 0.9,
        other_start: 0.45,
        duration: 1.0,
        averaging_time: 0.6,
        numerics: ProjectionNumerics::default(),
    };
    let paper = GrainParticles {
        slopes: Vec::new(),
        // printed with |S| = √(S:S): 863 Pa in this norm; the bed is rigid with either
        material: Rheology::CoulombBingham(CoulombBingham {
            yield_stress: 1220.0,
            friction: 0.0,
            plastic_viscosity: 0.26,
            ..FITTED
        }),
        bed_depth: 0.08,
        drag_smoothing_length: 6e-3,
        duration: 1.0,
        averaging_time: 0.5,
        numerics: ProjectionNumerics::paper(),
        ..stabilised.clone()
    };
    (stabilised, paper)
}

/// Runs of one stage at a spacing of 1 mm, averaged over the last two fifths.
fn stage(stage: Stage, slopes: &[f64], pair_laws: &[PairLaw], starts: &[f64], duration: f64) -> StageRuns {
    StageRuns {
        stage,
        slopes: slopes.to_vec(),
        pair_laws: pair_laws.to_vec(),
        starts: starts.to_vec(),
        spacings: vec![1e-3],
        duration,
        averaging_time: 0.4 * duration,
    }
}

fn quick() -> BedLoadParameters {
    let (stabilised, paper) = grains();
    BedLoadParameters {
        materials: Materials {
            depth: 0.046,
            gravity: 9.81,
            fluid_density: 1000.0,
            kinematic_viscosity: 1e-6,
            grain_density: 2600.0,
            grain_diameter: 5e-3,
        },
        paper,
        stabilised,
        continuum: Continuum {
            runs: vec![
                stage(Stage::Porous, &[0.03], &ROWS, &[1.0], 0.5),
                StageRuns { averaging_time: 0.6, ..stage(Stage::Dilating, &SLOPES, &COLUMNS, &[1.0], 1.2) },
                StageRuns { averaging_time: 0.6, ..stage(Stage::Dilating, &[0.03], &COLUMNS, &[0.5], 1.2) },
            ],
            bed_depth: 0.014,
            held_depth: 0.004,
            length: 0.0085,
            closures: Closures::default(),
            drag_diameter: 1.0,
            largest_spacing: 0.9,
            least_fraction: 2e-3,
            sparse_row_fraction: 0.03,
            sediment_refinement: 2,
            sediment_jitter: 0.3,
            columns: ColumnNumerics::default(),
            numerics: ProjectionNumerics {
                time_step: 1.5e-4,
                even_pairs: 1.0,
                fluctuation_rate: 500.0,
                ..ProjectionNumerics::default()
            },
        },
        beside: vec![Beside::AtRest, Beside::OtherStart],
        fit: Fit {
            yield_stresses: Vec::new(),
            viscosities: Vec::new(),
            slopes: SLOPES.to_vec(),
            duration: 3.0,
            averaging_time: 1.5,
        },
        jitter: 1e-3,
        seed: 1,
    }
}

/// A bed and a period longer than the quick tier's, which are the least that a layer on 5 % and the kernel need.
fn deeper(continuum: Continuum) -> Continuum {
    Continuum { bed_depth: 0.016, length: 0.01, ..continuum }
}

fn paper(quick: BedLoadParameters) -> BedLoadParameters {
    BedLoadParameters {
        paper: GrainParticles { slopes: SLOPES.to_vec(), ..quick.paper },
        stabilised: GrainParticles { slopes: SLOPES.to_vec(), duration: 12.0, averaging_time: 3.0, ..quick.stabilised },
        continuum: Continuum {
            runs: vec![
                stage(Stage::Porous, &SLOPES, &ROWS, &[1.0], 4.0),
                stage(Stage::Frozen, &[0.03, 0.04, 0.05], &ROWS, &[1.0], 4.0),
                // what moves in a thin layer slows down for long
                stage(Stage::Frozen, &[0.02], &ROWS, &[1.0], 8.0),
                stage(Stage::Frozen, &[0.03], &[PairLaw::PairRate, PairLaw::HarmonicMean], &[1.0], 4.0),
                stage(Stage::Dilating, &SLOPES, &COLUMNS, &[1.0], 4.0),
                stage(Stage::Dilating, &[0.03], &COLUMNS, &[0.3, 1.4], 12.0),
            ],
            ..deeper(quick.continuum)
        },
        ..quick
    }
}

fn fine(quick: BedLoadParameters) -> BedLoadParameters {
    BedLoadParameters {
        paper: GrainParticles { slopes: Vec::new(), ..quick.paper },
        stabilised: GrainParticles { slopes: Vec::new(), ..quick.stabilised },
        continuum: Continuum {
            runs: vec![StageRuns {
                spacings: vec![7e-4, 5e-4],
                ..stage(Stage::Dilating, &SLOPES, &COLUMNS, &[1.0, 0.3], 4.0)
            }],
            ..deeper(quick.continuum)
        },
        fit: Fit { yield_stresses: vec![1.0, 4.0, 7.0, 10.0], viscosities: vec![0.7, 2.0], ..quick.fit },
        ..quick
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_set_up_has_the_numbers_that_the_paper_prints() {
        let BedLoadParameters { materials, paper, stabilised, .. } = BedLoadParameters::of_tier(Tier::Paper);
        for grains in [&paper, &stabilised] {
            assert_eq!(grains.spacing, 2e-3);
            assert!((materials.depth / grains.spacing - 23.0).abs() < 1e-9, "23 particles over the depth");
            assert_eq!((grains.numerics.smoothing_ratio, grains.numerics.surface_threshold), (1.2, 0.95));
        }
        assert!((paper.bed_depth / materials.grain_diameter - 16.0).abs() < 1e-9, "16 rows of grains");
        assert!((paper.length / materials.grain_diameter - 8.0).abs() < 1e-9, "8 grains along the flow");
        assert_eq!((materials.fluid_density, materials.grain_density), (1000.0, 2600.0));
    }

    #[test]
    fn the_printed_shields_numbers_follow_from_the_set_up_and_from_no_other_density() {
        let Materials { depth, fluid_density, grain_diameter, grain_density, .. } =
            BedLoadParameters::of_tier(Tier::Paper).materials;
        let shields = |slope: f64, density: f64| depth * slope / ((density / fluid_density - 1.0) * grain_diameter);
        // three digits are printed
        for (slope, printed) in [(0.03, 0.173), (0.05, 0.288)] {
            assert!((shields(slope, grain_density) - printed).abs() <= 5.01e-4, "{}", shields(slope, grain_density));
            for other in [2590.0, 2650.0] {
                assert!((shields(slope, other) - printed).abs() > 5.01e-4, "{other} kg/m³ would do as well");
            }
        }
    }
}
