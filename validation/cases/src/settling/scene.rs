//! The scenes: a grain beside the lattice of its fluid, and a suspension of two lattices.

use super::flow::SettlingFlow;
use crate::reference::settling::SettlingGrains;
use bagnold_solver::domain::Domain;
use bagnold_solver::incompressible::{
    Bed, DragForm, Fluid, IncompressibleScene, ParticleSet, ProjectionNumerics, Sediment, SedimentLoad,
    SedimentPressure, SolidFraction, Strata, Stratification, Turbulence,
};
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::material::suspension_viscosity::SuspensionViscosity;
use bagnold_solver::material::turbulence::GrainRoughness;
use bagnold_solver::vector::Vector;

/// Grains that do not touch: no stress between them.
const WITHOUT_STRENGTH: Rheology = Rheology::Newtonian(Newtonian { viscosity: 0.0 });

fn at_rest(position: Vec<Vector<2>>) -> ParticleSet<2> {
    ParticleSet { velocity: vec![Vector::zeros(); position.len()], position }
}

impl SettlingFlow {
    /// Fluid and grains at rest.
    pub(super) fn scene(&self) -> IncompressibleScene<2> {
        if self.is_suspension() { self.suspension() } else { self.grain_alone() }
    }

    fn grain_alone(&self) -> IncompressibleScene<2> {
        let SettlingGrains { gravity, fluid_density, grain_density, grain_diameter, .. } = self.grains;
        let submerged = gravity * (1.0 - fluid_density / grain_density);
        // the fluid is pushed up by as much as the grain weighs, so that both together stay where they are
        let push = submerged * grain_density / (fluid_density * self.lattice().len() as f64);
        // beside the lattice's planes of symmetry
        let place = self.size() * 0.5 + Vector::<2>::new(0.13, 0.31) * grain_diameter;
        let grain = Sediment {
            pressure: SedimentPressure::Incompressible,
            drag_form: DragForm::Grain,
            ..self.sediment(vec![place], 1.0, -submerged)
        };
        self.with_fluid(push, grain, SolidFraction::Overlapping)
    }

    fn suspension(&self) -> IncompressibleScene<2> {
        let SettlingGrains { gravity, fluid_density, grain_density, grain_diameter, .. } = self.grains;
        let column = self.lattice();
        // the phases' lattices lie beside each other, and so do their displacements
        let beside = Vector::<2>::new(0.25, -0.25) * grain_diameter;
        let places = column.displaced(self.jitter, self.seed.wrapping_add(1)).into_iter().map(|x| x + beside).collect();
        let stratification = Stratification::of(Strata {
            base: 0.0,
            interval: column.height(),
            solid_fraction: vec![self.solid_fraction],
            packing: 1.0,
            buoyant_weight: (grain_density - fluid_density) * gravity,
            bed_level: 0.0,
            depth: column.height(),
            suspension_viscosity: SuspensionViscosity::default(),
            grain_roughness: GrainRoughness::default(),
            grain_diameter,
        });
        let sediment = self.sediment(places, self.solid_fraction, -gravity);
        self.with_fluid(-gravity, sediment, SolidFraction::Given(stratification))
    }

    /// Grains at rest, each filling a part of its particle, under a vertical acceleration `[m/s²]`; without a pressure of
    /// their own.
    fn sediment(&self, position: Vec<Vector<2>>, filling: f64, gravity: f64) -> Sediment<2> {
        let diameter = self.grains.grain_diameter;
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
            drag_smoothing_length: self.drag_smoothing_ratio * diameter,
            gravity: Vector::<2>::new(0.0, gravity),
        }
    }

    /// Grains in their fluid, which is at rest under a vertical acceleration `[m/s²]`.
    fn with_fluid(&self, gravity: f64, sediment: Sediment<2>, solid_fraction: SolidFraction) -> IncompressibleScene<2> {
        let size = self.size();
        IncompressibleScene {
            fluid: Fluid {
                particles: at_rest(self.lattice().displaced(self.jitter, self.seed)),
                wall: Vec::new(),
                spacing: self.grains.grain_diameter,
                density: self.grains.fluid_density,
                kinematic_viscosity: self.grains.kinematic_viscosity,
                turbulence: Turbulence::Laminar,
                bed: Bed::Slip,
                gravity: Vector::<2>::new(0.0, gravity),
            },
            sediment: Some(sediment),
            solid_fraction,
            domain: Domain::periodic([0.0; 2], [size[0], size[1]]),
            numerics: self.numerics,
        }
    }
}
