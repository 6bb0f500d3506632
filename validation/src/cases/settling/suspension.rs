//! A uniform suspension in a periodic column without a flux of the mixture: formulation `continuum`.

use super::grain::WITHOUT_STRENGTH;
use super::parameters::SettlingParameters;
use super::probe::{Drag, Probe, SettlingObservation};
use crate::case::{ParameterError, Progress, Run};
use crate::cases::channel::Lattice;
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::reference::{GrainForm, SettlingGrains};
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::incompressible::{
    Bed, Continuity, DragForm, DragSlip, Fluid, IncompressibleScene, MeanFlux, ParticleSet, ProjectionNumerics,
    Sediment, SedimentLoad, SedimentPressure, SolidFraction, Strata, Stratification, Turbulence,
};
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::material::suspension_viscosity::SuspensionViscosity;
use bagnold_solver::vector::Vector;
use serde::Serialize;

/// Solid fraction from which on Ergun's law is judged: it describes beds `[-]`.
pub(super) const LEAST_BED: f64 = 0.2;

/// One column.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SuspensionRun {
    /// Drag law.
    pub law: DragLaw,
    /// Solid fraction φ `[-]`.
    pub solid_fraction: f64,
    /// Whether it stands for a grain alone.
    pub dilute: bool,
    diameter: f64,
    grain_density: f64,
    fluid_density: f64,
    kinematic_viscosity: f64,
    gravity: f64,
    columns: usize,
    rows: usize,
    jitter: f64,
    seed: u64,
    drag_smoothing_length: f64,
    duration: f64,
    numerics: ProjectionNumerics,
}

/// Whether a law is judged at a solid fraction.
pub(super) fn covers(law: DragLaw, solid_fraction: f64) -> bool {
    law != DragLaw::Ergun || solid_fraction >= LEAST_BED
}

pub(super) fn runs(parameters: &SettlingParameters) -> Vec<SuspensionRun> {
    let suspension = &parameters.suspension;
    let grains = parameters.grains(suspension.diameter);
    let new = |law, solid_fraction, dilute| SuspensionRun {
        law,
        solid_fraction,
        dilute,
        diameter: suspension.diameter,
        grain_density: parameters.grain_density,
        fluid_density: parameters.water.density,
        kinematic_viscosity: parameters.water.kinematic_viscosity,
        gravity: parameters.gravity,
        columns: suspension.columns,
        rows: suspension.rows,
        jitter: suspension.jitter,
        seed: parameters.seed,
        drag_smoothing_length: suspension.drag_smoothing_ratio * suspension.diameter,
        duration: suspension.relaxation_times * relaxation_time(grains, law, solid_fraction),
        numerics: ProjectionNumerics {
            continuity: Continuity::Mixture,
            mean_flux: MeanFlux::Zero,
            drag_slip: DragSlip::Mean,
            // a thin place of a displaced lattice is no surface
            surface_threshold: 0.5,
            ..parameters.numerics
        },
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
fn relaxation_time(grains: SettlingGrains, law: DragLaw, solid_fraction: f64) -> f64 {
    let slip = grains.hindered_slip(law, solid_fraction).unwrap_or_default();
    slip * grains.grain_density / grains.submerged_weight()
}

impl Run for SuspensionRun {
    type Observation = SettlingObservation;

    fn variant(&self) -> Variant {
        Variant::of("formulation", "continuum").and("law", self.law.name()).and("solid_fraction", self.solid_fraction)
    }

    fn particle_steps(&self) -> f64 {
        self.duration / self.numerics.time_step * (2 * self.columns * self.rows) as f64
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<SettlingObservation>, ParameterError> {
        Ok(Probe::run(self.scene(), Drag::OfMean, self.duration, progress)?)
    }
}

impl SuspensionRun {
    /// The grains and their fluid.
    #[must_use]
    pub fn grains(&self) -> SettlingGrains {
        SettlingGrains {
            grain_diameter: self.diameter,
            grain_density: self.grain_density,
            fluid_density: self.fluid_density,
            kinematic_viscosity: self.kinematic_viscosity,
            gravity: self.gravity,
        }
    }

    /// Root of its balance of weight and drag `[m/s]`.
    #[must_use]
    pub fn slip(&self) -> f64 {
        self.grains().hindered_slip(self.law, self.solid_fraction).unwrap_or(f64::NAN)
    }

    /// Velocity of a grain alone as a sphere, c = ¾ `[m/s]`; that of Wen and Yu for Ergun's law.
    #[must_use]
    pub fn terminal_velocity(&self) -> f64 {
        let alone = |law| self.grains().terminal_velocity(law, GrainForm::Sphere);
        alone(self.law).or(alone(DragLaw::WenYu)).unwrap_or(f64::NAN)
    }

    fn scene(&self) -> IncompressibleScene<2> {
        let column = Lattice { spacing: self.diameter, rows: self.rows, columns: self.columns, bottom: 0.0 };
        let size = Vector::<2>::new(column.length(), column.height());
        let at_rest =
            |position: Vec<Vector<2>>| ParticleSet { velocity: vec![Vector::zeros(); column.len()], position };
        // the phases' lattices lie beside each other, and so do their displacements
        let beside = Vector::<2>::new(0.25, -0.25) * self.diameter;
        let grains = column.displaced(self.jitter, self.seed.wrapping_add(1)).into_iter().map(|x| x + beside).collect();
        let gravity = Vector::<2>::new(0.0, -self.gravity);
        let buoyant_weight = (self.grain_density - self.fluid_density) * self.gravity;
        IncompressibleScene {
            fluid: Fluid {
                particles: at_rest(column.displaced(self.jitter, self.seed)),
                wall: Vec::new(),
                spacing: self.diameter,
                density: self.fluid_density,
                kinematic_viscosity: self.kinematic_viscosity,
                turbulence: Turbulence::Laminar,
                bed: Bed::Slip,
                gravity,
            },
            sediment: Some(Sediment {
                particles: at_rest(grains),
                filling: vec![self.solid_fraction; column.len()],
                wall: Vec::new(),
                spacing: self.diameter,
                smoothing_ratio: ProjectionNumerics::default().smoothing_ratio,
                density: self.grain_density,
                grain_diameter: self.diameter,
                law: WITHOUT_STRENGTH,
                load: SedimentLoad::Stratified,
                pressure: SedimentPressure::None,
                drag: self.law,
                drag_form: DragForm::Exchange,
                drag_smoothing_length: self.drag_smoothing_length,
                gravity,
            }),
            solid_fraction: SolidFraction::Given(Stratification::of(Strata {
                base: 0.0,
                interval: size[1],
                solid_fraction: vec![self.solid_fraction],
                packing: 1.0,
                buoyant_weight,
                bed_level: 0.0,
                depth: size[1],
                suspension_viscosity: SuspensionViscosity::default(),
            })),
            domain: Domain { axes: [0, 1].map(|axis| AxisBoundary::Periodic { lower: 0.0, upper: size[axis] }) },
            numerics: self.numerics,
        }
    }
}
