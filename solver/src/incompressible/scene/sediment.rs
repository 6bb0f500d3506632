//! The sediment of an incompressible scene.

use super::super::{ColumnNumerics, ParticleSet, Stratification, height_axis};
use crate::material::dilatancy::Dilatancy;
use crate::material::drag::DragLaw;
use crate::material::rheology::Rheology;
use crate::vector::Vector;

/// Pressure in the sediment's law: the load that the grains carry, for the pore pressure carries no friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SedimentLoad {
    /// The weight in the water of packed grains up to a level.
    Packed {
        /// Level above which there is no overburden `[m]`.
        level: f64,
        /// Buoyant weight of the grains `[Pa/m]`.
        buoyant_weight: f64,
    },
    /// The overburden of the [`Stratification`]; none without one.
    Stratified,
}

impl SedimentLoad {
    /// Load `[Pa]` at a place `[m]`.
    #[inline]
    pub(in crate::incompressible) fn at<const D: usize>(
        &self,
        position: &Vector<D>,
        stratification: Option<&Stratification>,
    ) -> f64 {
        match *self {
            Self::Packed { level, buoyant_weight } => buoyant_weight * (level - position[height_axis(D)]).max(0.0),
            Self::Stratified => stratification.map_or(0.0, |layer| layer.at(position).overburden),
        }
    }
}

/// Source of the pressure that keeps sediment particles apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SedimentPressure {
    /// A pressure Poisson equation of its own, (11): each grain is incompressible.
    Incompressible,
    /// Nothing: the particles move as fluid and gravity make them.
    None,
    /// Nothing: the particles move along the bed only, and keep the solid fraction that is given.
    AlongBed,
    /// Dilatancy, as a constraint on columns: the grains carry their load at the fraction of their inertial number.
    Dilatant {
        /// The law of the fraction.
        dilatancy: Dilatancy,
        /// Volume of grains in a fixed particle over its lattice volume `[-]`.
        fixed_filling: f64,
        /// The columns that carry the mechanics.
        columns: ColumnNumerics,
        /// Turbulent Schmidt number Sc `[-]`, eddy viscosity over the diffusivity of grains; 0 for grains that eddies do not
        /// carry.
        turbulent_schmidt: f64,
    },
}

/// Form of the drag force of the fluid on a sediment particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DragForm {
    /// (30): one grain a particle, ½ C_d d |u_r| per mass of the fluid around it.
    Grain,
    /// K of the law at the particle's solid fraction, per volume.
    Exchange,
}

/// The sediment.
#[derive(Debug, Clone)]
pub struct Sediment<const D: usize> {
    /// Free particles.
    pub particles: ParticleSet<D>,
    /// Volume of grains in each free particle over its lattice volume `[-]`, shape `[free particles]`; 1 is a grain that
    /// fills its place.
    pub filling: Vec<f64>,
    /// Positions of fixed grains `[m]`.
    pub wall: Vec<Vector<D>>,
    /// Particle spacing `[m]`.
    pub spacing: f64,
    /// Smoothing length over particle spacing of the sediment's kernel `[-]`.
    pub smoothing_ratio: f64,
    /// Density of a grain `[kg/m³]`.
    pub density: f64,
    /// Grain diameter `[m]`.
    pub grain_diameter: f64,
    /// Diameter of the sphere that has the drag of a grain `[m]`.
    pub drag_diameter: f64,
    /// Shear resistance of the grains: any law, at the rate of a particle or pair and the load on it.
    pub law: Rheology,
    /// The load that stands for the law's pressure.
    pub load: SedimentLoad,
    /// Pressure.
    pub pressure: SedimentPressure,
    /// Drag law.
    pub drag: DragLaw,
    /// Form of the drag in the momentum equations.
    pub drag_form: DragForm,
    /// Smoothing length of the drag `[m]`.
    pub drag_smoothing_length: f64,
    /// Body force per mass, with buoyancy across the bed `[m/s²]`.
    pub gravity: Vector<D>,
}
