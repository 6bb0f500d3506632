//! A grain alone in a periodic box of fluid.

use super::parameters::SettlingParameters;
use super::probe::{Drag, Probe, SettlingObservation};
use crate::case::{ParameterError, Progress, Run};
use crate::cases::channel::Lattice;
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::reference::{GrainForm, SettlingGrains};
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::incompressible::{
    Bed, DragForm, DragSlip, Fluid, IncompressibleScene, ParticleSet, ProjectionNumerics, Sediment, SedimentLoad,
    SedimentPressure, SolidFraction, Turbulence,
};
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::vector::Vector;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A formulation of the two-phase model that knows single grains.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Formulation {
    /// The bed-load paper's operators, drag from the slip of each pair.
    Paper,
    /// The case's numerics, drag from the slip against the mean of the fluid around.
    Stabilised,
}

impl Formulation {
    /// Its name in parameters and results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Paper => "paper",
            Self::Stabilised => "stabilised",
        }
    }

    fn numerics(self, of_case: ProjectionNumerics) -> ProjectionNumerics {
        let ProjectionNumerics { smoothing_ratio, time_step, pressure_tolerance, velocity_tolerance, .. } = of_case;
        match self {
            Self::Stabilised => of_case,
            Self::Paper => ProjectionNumerics {
                smoothing_ratio,
                time_step,
                pressure_tolerance,
                velocity_tolerance,
                ..ProjectionNumerics::paper()
            },
        }
    }
}

/// One grain.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct GrainRun {
    /// Formulation.
    pub formulation: Formulation,
    /// Drag law.
    pub law: DragLaw,
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

pub(super) fn runs(parameters: &SettlingParameters) -> Vec<GrainRun> {
    let grain = &parameters.grain;
    let grains = parameters.grains(grain.diameter);
    let new = |formulation: Formulation, law| GrainRun {
        formulation,
        law,
        diameter: grain.diameter,
        grain_density: parameters.grain_density,
        fluid_density: parameters.water.density,
        kinematic_viscosity: parameters.water.kinematic_viscosity,
        gravity: parameters.gravity,
        columns: grain.columns,
        rows: grain.rows,
        jitter: grain.jitter,
        seed: parameters.seed,
        drag_smoothing_length: grain.drag_smoothing_ratio * grain.diameter,
        duration: grain.relaxation_times * relaxation_time(grains, law),
        numerics: formulation.numerics(parameters.numerics),
    };
    let of_law = |&law| grain.formulations.iter().map(move |&formulation| (formulation, law));
    grain.laws.iter().flat_map(of_law).map(|(formulation, law)| new(formulation, law)).collect()
}

/// u_t ρ_s/(2 (ρ_s − ρ_f) g) `[s]`: with it a grain gets to its velocity in Newton's regime, elsewhere within twice it.
fn relaxation_time(grains: SettlingGrains, law: DragLaw) -> f64 {
    let velocity = grains.terminal_velocity(law, GrainForm::Planar).unwrap_or_default();
    0.5 * velocity * grains.grain_density / grains.submerged_weight()
}

impl Run for GrainRun {
    type Observation = SettlingObservation;

    fn variant(&self) -> Variant {
        Variant::of("formulation", self.formulation.name()).and("law", self.law.name())
    }

    fn particle_steps(&self) -> f64 {
        self.duration / self.numerics.time_step * (self.columns * self.rows + 1) as f64
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<SettlingObservation>, ParameterError> {
        let slip = match self.numerics.drag_slip {
            DragSlip::Pair => Drag::OfPairs,
            DragSlip::Mean => Drag::OfMean,
        };
        Ok(Probe::run(self.scene(), slip, self.duration, progress)?)
    }
}

impl GrainRun {
    /// The grain and its fluid.
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
    pub fn terminal_velocity(&self) -> f64 {
        self.grains().terminal_velocity(self.law, GrainForm::Planar).unwrap_or(f64::NAN)
    }

    fn scene(&self) -> IncompressibleScene<2> {
        let box_ = Lattice { spacing: self.diameter, rows: self.rows, columns: self.columns, bottom: 0.0 };
        let size = Vector::<2>::new(box_.length(), box_.height());
        let submerged = self.gravity * (1.0 - self.fluid_density / self.grain_density);
        // the fluid is pushed up by as much as the grain weighs, so that both together stay where they are
        let push = submerged * self.grain_density / (self.fluid_density * box_.len() as f64);
        let up = Vector::<2>::new(0.0, 1.0);
        IncompressibleScene {
            fluid: Fluid {
                particles: ParticleSet {
                    position: box_.displaced(self.jitter, self.seed),
                    velocity: vec![Vector::zeros(); box_.len()],
                },
                wall: Vec::new(),
                spacing: self.diameter,
                density: self.fluid_density,
                kinematic_viscosity: self.kinematic_viscosity,
                turbulence: Turbulence::Laminar,
                bed: Bed::Slip,
                gravity: up * push,
            },
            sediment: Some(Sediment {
                // beside the lattice's planes of symmetry
                particles: ParticleSet {
                    position: vec![size * 0.5 + Vector::<2>::new(0.13, 0.31) * self.diameter],
                    velocity: vec![Vector::zeros()],
                },
                filling: vec![1.0],
                wall: Vec::new(),
                spacing: self.diameter,
                smoothing_ratio: ProjectionNumerics::default().smoothing_ratio,
                density: self.grain_density,
                grain_diameter: self.diameter,
                law: WITHOUT_STRENGTH,
                load: SedimentLoad::Stratified,
                pressure: SedimentPressure::Incompressible,
                drag: self.law,
                drag_form: DragForm::Grain(1.0),
                drag_smoothing_length: self.drag_smoothing_length,
                gravity: up * -submerged,
            }),
            solid_fraction: SolidFraction::Overlapping,
            domain: Domain { axes: [0, 1].map(|axis| AxisBoundary::Periodic { lower: 0.0, upper: size[axis] }) },
            numerics: self.numerics,
        }
    }
}

/// Grains that do not touch: no stress between them.
pub(super) const WITHOUT_STRENGTH: Rheology = Rheology::Newtonian(Newtonian { viscosity: 0.0 });
