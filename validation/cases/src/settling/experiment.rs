//! What a grain alone and a suspension have in common: grains as large as the particles of a fluid in a periodic box.

use crate::case::ParameterError;
use crate::reference::settling::SettlingGrains;
use crate::setup::Lattice;
use crate::setup::rules;
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::incompressible::{
    Bed, DragForm, Fluid, IncompressibleScene, ParticleSet, ProjectionNumerics, Sediment, SedimentLoad,
    SedimentPressure, SolidFraction, Turbulence,
};
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::parameter::{between, positive};
use bagnold_solver::vector::Vector;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A periodic box of fluid, whose particles are as large as the grains.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Vessel {
    /// Diameter d of the grains `[m]`.
    #[schemars(transform = positive("give it in metres; 0.005 for 5 mm"))]
    pub diameter: f64,
    /// Length of the box in diameters.
    pub columns: usize,
    /// Height of the box in diameters.
    pub rows: usize,
    /// Smoothing length of the drag in diameters `[-]`.
    #[schemars(transform = between(1.0, 10.0, "the drag needs some fluid around a grain; 2 to 3 hold short waves back"))]
    pub drag_smoothing_ratio: f64,
    /// Largest random displacement of a particle in spacings `[-]`; the paper's density source wants a lattice.
    #[schemars(transform = between(0.0, 0.5, "0.001 breaks the symmetry of a lattice, 0.1 the lattice without overlaps"))]
    pub jitter: f64,
}

impl Vessel {
    /// Periods that hold both kernels twice.
    pub(super) fn check(&self, path: &str, numerics: &ProjectionNumerics) -> Result<(), ParameterError> {
        let least = (4.0 * self.drag_smoothing_ratio.max(numerics.smoothing_ratio)).ceil() as usize;
        for (name, value) in [("columns", self.columns), ("rows", self.rows)] {
            let remedy = "the box must hold the reach of the kernels twice; 12 is quick";
            rules::count(&format!("{path}.{name}"), value, least, 1000, remedy)?;
        }
        Ok(())
    }

    pub(super) fn lattice(&self) -> Lattice {
        Lattice { spacing: self.diameter, rows: self.rows, columns: self.columns, bottom: 0.0 }
    }

    /// Lengths of the periods `[m]`.
    pub(super) fn size(&self) -> Vector<2> {
        Vector::<2>::new(self.lattice().length(), self.lattice().height())
    }
}

/// Grains of one law in a vessel.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Experiment {
    /// Drag law.
    pub law: DragLaw,
    /// The grains and their fluid.
    pub grains: SettlingGrains,
    /// The box.
    pub vessel: Vessel,
    pub(super) seed: u64,
    /// Simulated time `[s]`.
    pub(super) duration: f64,
    pub(super) numerics: ProjectionNumerics,
}

/// Grains that do not touch: no stress between them.
const WITHOUT_STRENGTH: Rheology = Rheology::Newtonian(Newtonian { viscosity: 0.0 });

fn at_rest(position: Vec<Vector<2>>) -> ParticleSet<2> {
    ParticleSet { velocity: vec![Vector::zeros(); position.len()], position }
}

impl Experiment {
    /// Grains at rest, each filling a part of its particle, under a vertical acceleration `[m/s²]`; without a pressure of
    /// their own.
    pub(super) fn sediment(&self, position: Vec<Vector<2>>, filling: f64, gravity: f64) -> Sediment<2> {
        let diameter = self.vessel.diameter;
        Sediment {
            filling: vec![filling; position.len()],
            particles: at_rest(position),
            wall: Vec::new(),
            spacing: diameter,
            smoothing_ratio: ProjectionNumerics::default().smoothing_ratio,
            density: self.grains.grain_density,
            grain_diameter: diameter,
            drag_diameter: diameter,
            law: WITHOUT_STRENGTH,
            load: SedimentLoad::Stratified,
            pressure: SedimentPressure::None,
            drag: self.law,
            drag_form: DragForm::Exchange,
            drag_smoothing_length: self.vessel.drag_smoothing_ratio * diameter,
            gravity: Vector::<2>::new(0.0, gravity),
        }
    }

    /// Fluid at rest under a vertical acceleration `[m/s²]`, with its grains.
    pub(super) fn scene(
        &self,
        gravity: f64,
        sediment: Sediment<2>,
        solid_fraction: SolidFraction,
    ) -> IncompressibleScene<2> {
        let (vessel, size) = (self.vessel, self.vessel.size());
        IncompressibleScene {
            fluid: Fluid {
                particles: at_rest(vessel.lattice().displaced(vessel.jitter, self.seed)),
                wall: Vec::new(),
                spacing: vessel.diameter,
                density: self.grains.fluid_density,
                kinematic_viscosity: self.grains.kinematic_viscosity,
                turbulence: Turbulence::Laminar,
                bed: Bed::Slip,
                gravity: Vector::<2>::new(0.0, gravity),
            },
            sediment: Some(sediment),
            solid_fraction,
            domain: Domain { axes: [0, 1].map(|axis| AxisBoundary::Periodic { lower: 0.0, upper: size[axis] }) },
            numerics: self.numerics,
        }
    }
}
