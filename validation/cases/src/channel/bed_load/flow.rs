//! The flow: water over a bed that moves.

use crate::case::ParameterError;
use crate::channel::TurbulenceClosure;
use crate::reference::bed_load::TransportFormula;
use crate::reference::one_dimension::bed_load::{Closures, MixingLengthClosure, Stream};
use crate::setup::rules;
use bagnold_solver::incompressible::{ColumnNumerics, PairLaw, ProjectionNumerics};
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::material::rheology::{CoulombBingham, Rheology};
use bagnold_solver::material::turbulence::{MixingLengthShape, VON_KARMAN};
use bagnold_solver::parameter::{between, not_negative, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Fitted to Wong & Parker at 2 and 5 %; 3 % is held out.
pub(super) const FITTED: CoulombBingham = CoulombBingham {
    yield_stress: 5.1,
    friction: 0.6,
    plastic_viscosity: 1.67,
    regularisation_rate: 0.01,
    largest_viscosity: 1e4,
};

/// Velocity of the water over the logarithmic law's from which one particle a grain starts `[-]`; another start is named.
const USUAL_START: f64 = 0.9;

/// Height of a cell of the 1-D layer `[m]`.
pub(super) const LAYER_CELL: f64 = 2.5e-4;

/// Tenths of a millimetre in a metre.
const TENTHS: f64 = 1e4;

/// Formulation of the grains.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum BedLoadFormulation {
    /// One particle a grain, over a bed whose pores hold water.
    Stabilised,
    /// One particle a grain as printed: water above the bed only, on the grains as on a floor.
    Paper,
    /// One particle a grain, all of them held.
    AtRest,
    /// One particle a grain, with a law of the grid that the fits interpolate in: the run is named by it.
    Fit,
    /// Grains as volume fractions: they rest at the 1-D layer's solid fraction.
    Porous,
    /// Grains as volume fractions: they move at the 1-D layer's solid fraction.
    Frozen,
    /// Grains as volume fractions: they dilate, in columns instead of pairs.
    Dilating,
}

impl BedLoadFormulation {
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Stabilised => "stabilised",
            Self::Paper => "paper",
            Self::AtRest => "at-rest",
            Self::Fit => "fit",
            Self::Porous => "porous",
            Self::Frozen => "frozen",
            Self::Dilating => "dilating",
        }
    }

    /// Whether grains are volume fractions.
    pub(super) const fn is_continuum(self) -> bool {
        matches!(self, Self::Porous | Self::Frozen | Self::Dilating)
    }
}

/// Formulation with one particle per grain.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct GrainParticles {
    /// How the grains resist a shear, a law by its name; its pressure is the weight of the grains below the top row.
    pub material: Rheology,
    /// Depth of the bed `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.03"))]
    pub bed_depth: f64,
    /// Length of the period `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.04"))]
    pub length: f64,
    /// Spacing of the water's particles `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.002 as in the paper"))]
    pub spacing: f64,
    /// Closure of the water's turbulence above the bed.
    pub turbulence: TurbulenceClosure,
    /// Depth of the origin of the mixing length below the bed `[m]`.
    #[schemars(transform = not_negative("give it in metres, a fraction of a grain diameter, such as 0.0006"))]
    pub origin_offset: f64,
    /// Drag law.
    pub drag: DragLaw,
    /// Smoothing length of the drag `[m]`.
    pub drag_smoothing_length: f64,
    /// Velocity of the water at the start over that of the logarithmic law of a rough bed `[-]`.
    #[schemars(transform = between(0.0, 3.0, "give 0.9 to start near the steady flow"))]
    pub start: f64,
    /// Numerical scheme of the incompressible model.
    pub numerics: ProjectionNumerics,
}

/// State from which grains as volume fractions start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StartState {
    /// A bed that has not dilated, in the flow of the 1-D layer.
    Layer,
    /// The last state of the paper tier on this slope.
    Kept,
}

/// Grains as volume fractions, closures of the literature.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Continuum {
    /// Depth of the bed `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.016"))]
    pub bed_depth: f64,
    /// Depth of the lowest part of the bed, whose grains are held `[m]`.
    pub held_depth: f64,
    /// Length of the period `[m]`.
    pub length: f64,
    /// Spacing of the particles of both phases `[m]`; `frozen` takes a smaller one where `largest_spacing` says so.
    pub spacing: f64,
    /// State at the start.
    pub start_state: StartState,
    /// Velocities at the start over those of that state `[-]`.
    #[schemars(transform = between(0.0, 3.0, "1 starts as the 1-D layer or the kept state flows"))]
    pub start: f64,
    /// Closures of particles and of the layer.
    pub closures: Closures,
    /// Diameter of the sphere with the drag of a grain, over d `[-]`.
    #[schemars(transform = between(0.01, 2.0, "give it in grain diameters: 1 for spheres, 0.5 for crushed plastic"))]
    pub drag_diameter: f64,
    /// Largest spacing of grains that move at a given fraction, over τ* d `[-]`: their velocity falls by e over some
    /// 0.9 τ* d, and a layer thinner than that needs finer particles.
    #[schemars(transform = between(0.1, 100.0, "give 0.9 for three rows in the moving layer"))]
    pub largest_spacing: f64,
    /// Solid fraction of the layer below which a row carries no sediment particle `[-]`.
    #[schemars(transform = between(0.0, 0.5, "give 0.002 to leave out rows that carry no grains"))]
    pub least_fraction: f64,
    /// Solid fraction below which the topmost row of grains at a given fraction gives its grains to the row below `[-]`.
    #[schemars(transform = between(0.0, 0.3, "give 0.03, or 0 to keep every row as it is"))]
    pub sparse_row_fraction: f64,
    /// Particles of dilating sediment along a spacing of the water: they cost little, and a layer of a grain's thickness
    /// wants many.
    #[schemars(transform = between(1.0, 8.0, "give 2 for an error below 1 % in given water"))]
    pub sediment_refinement: u32,
    /// Largest random displacement of dilating sediment in its spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "give 0.3 to break the rows"))]
    pub sediment_jitter: f64,
    /// The columns of dilating sediment.
    pub columns: ColumnNumerics,
    /// Numerics at a spacing of 1 mm; the time step goes with the spacing.
    pub numerics: ProjectionNumerics,
}

/// Water over a bed that moves; of `particles` and `continuum` the one of the formulation counts.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BedLoadFlow {
    /// Formulation of the grains.
    pub formulation: BedLoadFormulation,
    /// Slope i of the bed, a tangent `[-]`; 0.03 is 3 %.
    #[schemars(transform = rules::driving_slope())]
    pub slope: f64,
    /// Depth h of the water above the bed `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.046"))]
    pub depth: f64,
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Density of the water `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 1000"))]
    pub fluid_density: f64,
    /// Kinematic viscosity of the water `[m²/s]`.
    #[schemars(transform = positive("give it in m²/s; water has 1e-6"))]
    pub kinematic_viscosity: f64,
    /// Density of the grains `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 2600"))]
    pub grain_density: f64,
    /// Diameter of the grains `[m]`.
    #[schemars(transform = positive("give it in metres; 0.005 for 5 mm"))]
    pub grain_diameter: f64,
    /// Simulated time `[s]`.
    #[schemars(transform = between(0.1, 1e4, "give a few seconds, or more for a stationary flow"))]
    pub duration: f64,
    /// Averaging window before its end `[s]`.
    pub averaging_time: f64,
    /// Formulation with one particle per grain.
    pub particles: GrainParticles,
    /// Volume fractions.
    pub continuum: Continuum,
    /// Largest random displacement of a fluid particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "give 0.001 to break the lattice without waves"))]
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
}

impl Default for BedLoadFlow {
    fn default() -> Self {
        Self {
            formulation: BedLoadFormulation::Stabilised,
            slope: 0.03,
            depth: 0.046,
            gravity: 9.81,
            fluid_density: 1000.0,
            kinematic_viscosity: 1e-6,
            grain_density: 2600.0,
            grain_diameter: 5e-3,
            duration: 1.0,
            averaging_time: 0.6,
            particles: GrainParticles {
                material: Rheology::CoulombBingham(FITTED),
                bed_depth: 0.03,
                length: 0.04,
                spacing: 2e-3,
                turbulence: TurbulenceClosure::MixingLength { shape: MixingLengthShape::Parabolic },
                origin_offset: 6e-4,
                drag: DragLaw::MorsiAlexander,
                drag_smoothing_length: 3e-3,
                start: USUAL_START,
                numerics: ProjectionNumerics::default(),
            },
            continuum: Continuum {
                bed_depth: 0.014,
                held_depth: 0.004,
                length: 0.0085,
                spacing: 1e-3,
                start_state: StartState::Layer,
                start: 1.0,
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
                    pair_law: PairLaw::PairRateMeanLoad,
                    ..ProjectionNumerics::default()
                },
            },
            jitter: 1e-3,
            seed: 1,
        }
    }
}

impl BedLoadFlow {
    /// The rules between fields.
    pub(super) fn checked(&self) -> Result<(), ParameterError> {
        let remedy = "give it in kg/m³; floating grains form no bed load";
        rules::between("grain_density", self.grain_density, 1.01 * self.fluid_density, 1e5, remedy)?;
        let remedy = "shorten the averaging window, or lengthen `duration`";
        rules::between("averaging_time", self.averaging_time, 0.05, self.duration, remedy)?;
        if self.formulation.is_continuum() { self.check_continuum() } else { self.check_particles() }
    }

    fn check_particles(&self) -> Result<(), ParameterError> {
        let (grains, diameter) = (&self.particles, self.grain_diameter);
        rules::material("particles.material", &grains.material)?;
        if self.formulation == BedLoadFormulation::Fit && !matches!(grains.material, Rheology::CoulombBingham(_)) {
            let (rule, remedy) = ("coulomb-bingham in a fit", "choose it: its yield stress and viscosity are fitted");
            return Err(ParameterError::field("particles.material.law", grains.material.name(), rule, remedy));
        }
        if grains.drag == DragLaw::Ergun {
            let (rule, remedy) = ("a law for single grains", "choose another; `continuum` has Ergun's law");
            return Err(ParameterError::field("particles.drag", "ergun", rule, remedy));
        }
        for (field, length) in [("particles.bed_depth", grains.bed_depth), ("particles.length", grains.length)] {
            whole(field, length, diameter, "of the grain diameter")?;
            whole(field, length, grains.spacing, "of the spacing")?;
        }
        let remedy = "give it in metres, a fraction of a grain diameter; the origin lies within the bed";
        rules::between("particles.origin_offset", grains.origin_offset, 0.0, grains.bed_depth, remedy)?;
        let (least, remedy) = (4.8 * diameter, "lengthen it: the period must be wider than twice the grains' kernel");
        rules::between("particles.length", grains.length, least, 10.0, remedy)?;
        whole("depth", self.depth, grains.spacing, "of the spacing of every formulation")?;
        let (most, remedy) = (0.25 * grains.length, "give a length between a grain and a quarter of the period");
        rules::between("particles.drag_smoothing_length", grains.drag_smoothing_length, 1e-4, most, remedy)?;
        rules::projection("particles.numerics", &grains.numerics)
    }

    fn check_continuum(&self) -> Result<(), ParameterError> {
        let continuum = &self.continuum;
        if !self.rests() {
            let remedy = "hold less than nine tenths of the bed, or all of it where grains dilate";
            rules::between("continuum.held_depth", continuum.held_depth, 0.0, 0.9 * continuum.bed_depth, remedy)?;
        }
        rules::refuse("continuum.closures", continuum.closures.problem())?;
        let Closures { mixing_length, karman, turbulent_schmidt, .. } = continuum.closures;
        if mixing_length != MixingLengthClosure::Integral {
            let remedy = "choose it: the particle model has only this one; bed-load-1d compares all";
            let given = mixing_length.name();
            return Err(ParameterError::field("continuum.closures.mixing_length", given, "integral", remedy));
        }
        if turbulent_schmidt != 0.0 && self.formulation != BedLoadFormulation::Dilating {
            let (rule, remedy) = ("0 unless grains dilate", "give 0: eddies do not disperse other grains");
            return Err(ParameterError::field("continuum.closures.turbulent_schmidt", turbulent_schmidt, rule, remedy));
        }
        if karman != VON_KARMAN {
            let remedy = "give it: the particle model has this constant; bed-load-1d accepts others";
            return Err(ParameterError::field("continuum.closures.karman", karman, &VON_KARMAN.to_string(), remedy));
        }
        for (name, length) in [
            ("depth", self.depth),
            ("continuum.bed_depth", continuum.bed_depth),
            ("continuum.held_depth", continuum.held_depth),
        ] {
            if length > 0.0 {
                whole(name, length, LAYER_CELL, "of a cell of the 1-D layer")?;
            }
        }
        let remedy = "give it in metres: 0.001 for 1 mm; the period must be 7.2 spacings or longer";
        rules::between("continuum.spacing", continuum.spacing, 1e-4, continuum.length / 7.2, remedy)?;
        rules::projection("continuum.numerics", &continuum.numerics)
    }

    /// The pair law of grains as volume fractions; none for grains that dilate.
    pub(super) fn pair_law(&self) -> Option<PairLaw> {
        let has_pairs = matches!(self.formulation, BedLoadFormulation::Porous | BedLoadFormulation::Frozen);
        has_pairs.then_some(self.continuum.numerics.pair_law)
    }

    /// Whether all grains of a bed that could dilate are held.
    pub(super) fn rests(&self) -> bool {
        self.dilates() && self.continuum.held_depth == self.continuum.bed_depth
    }

    /// Whether grains as volume fractions are judged; runs of other pair laws show what a law does.
    pub(super) fn is_judged(&self) -> bool {
        self.pair_law().is_none_or(|law| law == PairLaw::PairRateMeanLoad)
    }

    /// Spacing of the water's particles `[m]`; of grains that move at a given fraction in whole tenths of a millimetre.
    pub(super) fn spacing(&self) -> f64 {
        let Continuum { spacing, largest_spacing, .. } = self.continuum;
        match self.formulation {
            BedLoadFormulation::Porous | BedLoadFormulation::Dilating => spacing,
            BedLoadFormulation::Frozen => {
                // τ* d
                let scale = self.depth * self.slope / (self.grain_density / self.fluid_density - 1.0);
                spacing.min((largest_spacing * scale * TENTHS).floor().max(1.0) / TENTHS)
            }
            _ => self.particles.spacing,
        }
    }

    /// Velocity of the water at the start over that of the logarithmic law or the 1-D layer `[-]`.
    pub(super) fn start(&self) -> f64 {
        if self.formulation.is_continuum() { self.continuum.start } else { self.particles.start }
    }

    /// Whether it starts as most runs of its formulation.
    pub(super) fn starts_as_usual(&self) -> bool {
        self.start() == if self.formulation.is_continuum() { 1.0 } else { USUAL_START }
    }

    /// Whether it starts from a state that is kept.
    pub(super) fn is_kept(&self) -> bool {
        self.formulation.is_continuum() && self.continuum.start_state == StartState::Kept
    }

    /// Whether a run differs from this one in its start alone.
    pub(super) fn has_another_start_than(&self, other: &Self) -> bool {
        let alike = |run: &Self| (run.formulation, run.pair_law(), run.rests(), run.continuum.start_state);
        let lengths = |run: &Self| (run.slope, run.duration, run.spacing());
        alike(self) == alike(other) && lengths(self) == lengths(other) && self.start() != other.start()
    }

    /// q* of Wong & Parker's formula at the run's Shields number `[-]`.
    pub(super) fn formula_transport(&self) -> f64 {
        TransportFormula::WongParker.transport(self.stream().shields_number())
    }

    /// The stream of the 1-D layer.
    pub fn stream(&self) -> Stream {
        let (bed_depth, held_depth, drag_diameter) = if self.formulation.is_continuum() {
            (self.continuum.bed_depth, self.continuum.held_depth, self.continuum.drag_diameter)
        } else {
            (self.particles.bed_depth, 0.0, 1.0)
        };
        Stream {
            slope: self.slope,
            flow_depth: self.depth,
            bed_depth,
            held_depth,
            gravity: self.gravity,
            fluid_density: self.fluid_density,
            kinematic_viscosity: self.kinematic_viscosity,
            grain_density: self.grain_density,
            grain_diameter: self.grain_diameter,
            drag_diameter,
        }
    }
}

/// A length that is a whole multiple of another.
fn whole(field: &str, length: f64, part: f64, of: &str) -> Result<(), ParameterError> {
    let parts = length / part;
    if parts >= 0.99 && (parts - parts.round()).abs() < 1e-6 * parts.max(1.0) && parts < 1e4 {
        return Ok(());
    }
    let rule = format!("a whole multiple {of}, {part} m");
    Err(ParameterError::field(field, length, &rule, "choose lengths that divide each other"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{RunList, Tier};

    #[test]
    fn the_set_up_has_the_numbers_that_the_paper_prints() {
        let runs = RunList::<BedLoadFlow>::of_tier(Tier::Paper).flows().to_vec();
        let of = |formulation| runs.iter().find(|run| run.formulation == formulation).expect("a run");
        for run in [of(BedLoadFormulation::Paper), of(BedLoadFormulation::Stabilised)] {
            let grains = &run.particles;
            assert_eq!(grains.spacing, 2e-3);
            assert!((run.depth / grains.spacing - 23.0).abs() < 1e-9, "23 particles over the depth");
            assert_eq!((grains.numerics.smoothing_ratio, grains.numerics.surface_threshold), (1.2, 0.95));
        }
        let paper = of(BedLoadFormulation::Paper);
        assert!((paper.particles.bed_depth / paper.grain_diameter - 16.0).abs() < 1e-9, "16 rows of grains");
        assert!((paper.particles.length / paper.grain_diameter - 8.0).abs() < 1e-9, "8 grains along the flow");
        assert_eq!((paper.fluid_density, paper.grain_density), (1000.0, 2600.0));
        assert_eq!(paper.particles.numerics, ProjectionNumerics::paper());
    }

    #[test]
    fn the_printed_shields_numbers_follow_from_the_set_up_and_from_no_other_density() {
        let BedLoadFlow { depth, fluid_density, grain_diameter, grain_density, .. } = BedLoadFlow::default();
        let shields = |slope: f64, density: f64| depth * slope / ((density / fluid_density - 1.0) * grain_diameter);
        // three digits are printed
        for (slope, printed) in [(0.03, 0.173), (0.05, 0.288)] {
            assert!((shields(slope, grain_density) - printed).abs() <= 5.01e-4, "{}", shields(slope, grain_density));
            for other in [2590.0, 2650.0] {
                assert!((shields(slope, other) - printed).abs() > 5.01e-4, "{other} kg/m³ would do as well");
            }
        }
    }

    /// A layer that moves has two rows at least, and no run is coarser than it is asked for.
    #[test]
    fn a_thin_layer_has_finer_particles() {
        let of = |formulation, slope, depth| {
            let mut flow = BedLoadFlow { formulation, slope, depth, ..BedLoadFlow::default() };
            flow.continuum.largest_spacing = 1.3;
            flow.spacing()
        };
        assert_eq!(of(BedLoadFormulation::Frozen, 0.02, 0.046), 7e-4);
        assert_eq!(of(BedLoadFormulation::Frozen, 0.03, 0.046), 1e-3);
        assert_eq!(of(BedLoadFormulation::Frozen, 0.02, 0.03), 4e-4);
        assert_eq!(of(BedLoadFormulation::Dilating, 0.02, 0.03), 1e-3);
    }
}
