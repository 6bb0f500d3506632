//! A uniform suspension in a periodic column without a flux of the mixture: formulation `continuum`.

use super::experiment::Experiment;
use super::parameters::SettlingParameters;
use crate::reference::settling::{GrainForm, SettlingGrains};
use bagnold_solver::incompressible::{
    Continuity, DragSlip, IncompressibleScene, MeanFlux, ProjectionNumerics, SolidFraction, Strata, Stratification,
};
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::material::suspension_viscosity::SuspensionViscosity;
use bagnold_solver::material::turbulence::GrainRoughness;
use bagnold_solver::vector::Vector;
use serde::Serialize;

/// Solid fraction from which on Ergun's law is judged: it describes beds `[-]`.
pub(super) const LEAST_BED: f64 = 0.2;

/// One column.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SuspensionRun {
    /// Solid fraction φ `[-]`.
    pub solid_fraction: f64,
    /// Whether it stands for a grain alone.
    pub dilute: bool,
    /// The grains in their column.
    pub experiment: Experiment,
}

/// Whether a law is judged at a solid fraction.
pub(super) fn covers(law: DragLaw, solid_fraction: f64) -> bool {
    law != DragLaw::Ergun || solid_fraction >= LEAST_BED
}

pub(super) fn runs(parameters: &SettlingParameters) -> Vec<SuspensionRun> {
    let suspension = &parameters.suspension;
    let numerics = ProjectionNumerics {
        continuity: Continuity::Mixture,
        mean_flux: MeanFlux::Zero,
        drag_slip: DragSlip::Mean,
        // a thin place of a displaced lattice is no surface
        surface_threshold: 0.5,
        ..parameters.numerics
    };
    let new = |law, solid_fraction, dilute| {
        let relaxation = |grains: &SettlingGrains| relaxation_time(grains, law, solid_fraction);
        let experiment = parameters.experiment(suspension.vessel, law, suspension.relaxation_times, relaxation);
        SuspensionRun { solid_fraction, dilute, experiment: Experiment { numerics, ..experiment } }
    };
    let mut runs = Vec::new();
    for &law in &suspension.laws {
        if suspension.dilute_fraction > 0.0 && covers(law, suspension.dilute_fraction) {
            runs.push(new(law, suspension.dilute_fraction, true));
        }
        let fractions = suspension.solid_fractions.iter().copied().filter(|&fraction| covers(law, fraction));
        runs.extend(fractions.map(|fraction| new(law, fraction, false)));
    }
    runs
}

/// |u_r| ρ_s/((ρ_s − ρ_f) g) `[s]`: Stokes' relaxation of a grain, an upper bound of that of the slip.
fn relaxation_time(grains: &SettlingGrains, law: DragLaw, solid_fraction: f64) -> f64 {
    let slip = grains.hindered_slip(law, solid_fraction).unwrap_or_default();
    slip * grains.grain_density / grains.submerged_weight()
}

impl SuspensionRun {
    /// Root of its balance of weight and drag `[m/s]`.
    #[must_use]
    pub fn slip(&self) -> f64 {
        self.experiment.grains.hindered_slip(self.experiment.law, self.solid_fraction).unwrap_or(f64::NAN)
    }

    /// Velocity of a grain alone as a sphere, c = ¾ `[m/s]`; that of Wen and Yu for Ergun's law.
    #[must_use]
    pub fn terminal_velocity(&self) -> f64 {
        let alone = |law| self.experiment.grains.terminal_velocity(law, GrainForm::Sphere);
        alone(self.experiment.law).or(alone(DragLaw::WenYu)).unwrap_or(f64::NAN)
    }

    pub(super) fn scene(&self) -> IncompressibleScene<2> {
        let Experiment { grains, vessel, seed, .. } = &self.experiment;
        let column = vessel.lattice();
        // the phases' lattices lie beside each other, and so do their displacements
        let beside = Vector::<2>::new(0.25, -0.25) * vessel.diameter;
        let places = column.displaced(vessel.jitter, seed.wrapping_add(1)).into_iter().map(|x| x + beside).collect();
        let stratification = Stratification::of(Strata {
            base: 0.0,
            interval: column.height(),
            solid_fraction: vec![self.solid_fraction],
            packing: 1.0,
            buoyant_weight: (grains.grain_density - grains.fluid_density) * grains.gravity,
            bed_level: 0.0,
            depth: column.height(),
            suspension_viscosity: SuspensionViscosity::default(),
            grain_roughness: GrainRoughness::default(),
            grain_diameter: grains.grain_diameter,
        });
        let sediment = self.experiment.sediment(places, self.solid_fraction, -grains.gravity);
        self.experiment.scene(-grains.gravity, sediment, SolidFraction::Given(stratification))
    }
}
