//! One run: its formulation and what it depends on.

use super::parameters::{Continuum, GrainParticles, Materials, Stage};
use crate::reference::bed_load::TransportFormula;
use crate::reference::one_dimension::bed_load::Stream;
use bagnold_solver::incompressible::PairLaw;
use bagnold_solver::material::rheology::CoulombBingham;
use serde::Serialize;

/// Which formulation a run is of.
#[derive(Debug, Clone, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum BedLoadFormulation {
    /// One particle a grain.
    Grains(GrainKind, GrainParticles),
    /// Volume fractions.
    Continuum(ContinuumRun),
}

/// Kind of a run of one particle per grain.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum GrainKind {
    /// As printed.
    Paper,
    /// By the recipe.
    Stabilised,
    /// By the recipe, with all grains held: the same bed at rest.
    AtRest,
    /// By the recipe, from another start.
    OtherStart,
    /// By the recipe, one point of the grid of the fits: its law.
    Fit(CoulombBingham),
}

impl GrainKind {
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Stabilised => "stabilised",
            Self::AtRest => "at-rest",
            Self::OtherStart => "other-start",
            Self::Fit(_) => "fit",
        }
    }
}

impl BedLoadFormulation {
    /// The kind of a run of one particle a grain.
    pub(super) fn kind(&self) -> Option<GrainKind> {
        if let Self::Grains(kind, _) = self { Some(*kind) } else { None }
    }
}

/// What is special to one run.
#[derive(Debug, Clone, Serialize)]
pub struct ContinuumRun {
    /// The formulation's parameters, without its list of runs.
    pub continuum: Continuum,
    /// Stage.
    pub stage: Stage,
    /// Pair law; none of grains that dilate.
    pub pair_law: Option<PairLaw>,
    /// Velocities at the start over those of the 1-D layer `[-]`.
    pub start: f64,
    /// Spacing `[m]`.
    pub spacing: f64,
}

/// One simulation.
#[derive(Debug, Clone, Serialize)]
pub struct BedLoadRun {
    /// Formulation.
    pub formulation: BedLoadFormulation,
    /// Slope `[-]`.
    pub slope: f64,
    /// Water and grains.
    pub materials: Materials,
    /// Simulated time `[s]`.
    pub duration: f64,
    /// Averaging window before its end `[s]`.
    pub averaging_time: f64,
    pub(super) jitter: f64,
    pub(super) seed: u64,
}

impl BedLoadRun {
    /// Velocity of the water at the start over that of the logarithmic law or the 1-D layer `[-]`.
    pub(super) fn start(&self) -> f64 {
        match &self.formulation {
            BedLoadFormulation::Grains(_, grains) => grains.start,
            BedLoadFormulation::Continuum(own) => own.start,
        }
    }

    /// What is special to a run of volume fractions.
    pub(super) fn continuum(&self) -> Option<&ContinuumRun> {
        if let BedLoadFormulation::Continuum(own) = &self.formulation { Some(own) } else { None }
    }

    /// Whether a run differs from this one in its start alone.
    pub(super) fn has_another_start_than(&self, other: &Self) -> bool {
        let is_alike = match (&self.formulation, &other.formulation) {
            (BedLoadFormulation::Grains(a, _), BedLoadFormulation::Grains(b, _)) => {
                a != b && [a, b].iter().all(|kind| matches!(kind, GrainKind::Stabilised | GrainKind::OtherStart))
            }
            (BedLoadFormulation::Continuum(a), BedLoadFormulation::Continuum(b)) => {
                (a.stage, a.pair_law, a.spacing) == (b.stage, b.pair_law, b.spacing)
            }
            _ => false,
        };
        is_alike && self.slope == other.slope && self.duration == other.duration && self.start() != other.start()
    }

    /// q* of Wong & Parker's formula at the run's Shields number `[-]`.
    pub(super) fn formula_transport(&self) -> f64 {
        TransportFormula::WongParker.transport(self.stream().shields_number())
    }

    /// The stream of the 1-D layer.
    #[must_use]
    pub fn stream(&self) -> Stream {
        let Materials { depth, gravity, fluid_density, kinematic_viscosity, grain_density, grain_diameter } =
            self.materials;
        let (bed_depth, held_depth, drag_diameter) = match &self.formulation {
            BedLoadFormulation::Grains(_, grains) => (grains.bed_depth, 0.0, 1.0),
            BedLoadFormulation::Continuum(own) => {
                (own.continuum.bed_depth, own.continuum.held_depth, own.continuum.drag_diameter)
            }
        };
        Stream {
            slope: self.slope,
            flow_depth: depth,
            bed_depth,
            held_depth,
            gravity,
            fluid_density,
            kinematic_viscosity,
            grain_density,
            grain_diameter,
            drag_diameter,
        }
    }
}
