//! A grain alone in a periodic box of fluid.

use super::experiment::Experiment;
use super::formulation::GrainFormulation;
use super::parameters::SettlingParameters;
use crate::reference::settling::{GrainForm, SettlingGrains};
use bagnold_solver::incompressible::{DragForm, IncompressibleScene, Sediment, SedimentPressure, SolidFraction};
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::vector::Vector;
use serde::Serialize;

/// One grain.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GrainRun {
    /// Formulation.
    pub formulation: GrainFormulation,
    /// The grain in its box.
    pub experiment: Experiment,
}

pub(super) fn runs(parameters: &SettlingParameters) -> Vec<GrainRun> {
    let grain = &parameters.grain;
    let new = |formulation: GrainFormulation, law| {
        let relaxation = |grains: &SettlingGrains| relaxation_time(grains, law);
        let experiment = parameters.experiment(grain.vessel, law, grain.relaxation_times, relaxation);
        let numerics = formulation.numerics(parameters.numerics);
        GrainRun { formulation, experiment: Experiment { numerics, ..experiment } }
    };
    let of_law = |&law| grain.formulations.iter().map(move |&formulation| (formulation, law));
    grain.laws.iter().flat_map(of_law).map(|(formulation, law)| new(formulation, law)).collect()
}

/// u_t ρ_s/(2 (ρ_s − ρ_f) g) `[s]`: with it a grain gets to its velocity in Newton's regime, elsewhere within twice it.
fn relaxation_time(grains: &SettlingGrains, law: DragLaw) -> f64 {
    let velocity = grains.terminal_velocity(law, GrainForm::Planar).unwrap_or_default();
    0.5 * velocity * grains.grain_density / grains.submerged_weight()
}

impl GrainRun {
    /// Root of its balance of weight and drag `[m/s]`.
    #[must_use]
    pub fn terminal_velocity(&self) -> f64 {
        let Experiment { grains, law, .. } = &self.experiment;
        grains.terminal_velocity(*law, GrainForm::Planar).unwrap_or(f64::NAN)
    }

    pub(super) fn scene(&self) -> IncompressibleScene<2> {
        let Experiment { grains, vessel, .. } = &self.experiment;
        let submerged = grains.gravity * (1.0 - grains.fluid_density / grains.grain_density);
        // the fluid is pushed up by as much as the grain weighs, so that both together stay where they are
        let push = submerged * grains.grain_density / (grains.fluid_density * vessel.lattice().len() as f64);
        // beside the lattice's planes of symmetry
        let place = vessel.size() * 0.5 + Vector::<2>::new(0.13, 0.31) * vessel.diameter;
        let grain = Sediment {
            pressure: SedimentPressure::Incompressible,
            drag_form: DragForm::Grain,
            ..self.experiment.sediment(vec![place], 1.0, -submerged)
        };
        self.experiment.scene(push, grain, SolidFraction::Overlapping)
    }
}
