//! Scene from which an incompressible simulation starts.

mod check;
mod mixture;
mod sediment;

pub use sediment::{DragForm, Sediment, SedimentLoad, SedimentPressure};

use super::{ProjectionNumerics, Stratification};
use crate::domain::Domain;
use crate::material::turbulence::{MixingLength, RoughWall, Smagorinsky};
use crate::vector::Vector;

/// Axis that is normal to the bed in `D` dimensions.
pub(crate) const fn height_axis(dimensions: usize) -> usize {
    dimensions - 1
}

/// Free particles at the start; all arrays have the shape `[particles]`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ParticleSet<const D: usize> {
    /// Positions `[m]`.
    pub position: Vec<Vector<D>>,
    /// Velocities `[m/s]`.
    pub velocity: Vec<Vector<D>>,
}

/// Bed below the fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Bed {
    /// Nothing: wall particles, if there are any, hold it back along their normal only.
    Slip,
    /// A wall at this height `[m]` to which it sticks.
    NoSlip(f64),
    /// A rough wall at this height `[m]`, by its law.
    Rough {
        /// Height of the wall `[m]`.
        level: f64,
        /// Depth of the law's origin below it `[m]`.
        origin_offset: f64,
        /// The law.
        law: RoughWall,
    },
}

/// Closure of the turbulence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Turbulence {
    /// Laminar flow, without an eddy viscosity.
    Laminar,
    /// A mixing length over the height above a level `[m]`.
    MixingLength {
        /// Level `[m]`.
        level: f64,
        /// Depth of the flow `[m]`.
        depth: f64,
        /// The law.
        law: MixingLength,
    },
    /// Mixing below the scale of the particles.
    Smagorinsky(Smagorinsky),
    /// The mixing length of the [`Stratification`].
    Stratified,
}

/// The fluid.
#[derive(Debug, Clone)]
pub struct Fluid<const D: usize> {
    /// Free particles.
    pub particles: ParticleSet<D>,
    /// Wall particles `[m]`.
    pub wall: Vec<Vector<D>>,
    /// Particle spacing l_0 `[m]`.
    pub spacing: f64,
    /// Density `[kg/m³]`.
    pub density: f64,
    /// Kinematic viscosity ν `[m²/s]`.
    pub kinematic_viscosity: f64,
    /// Turbulence.
    pub turbulence: Turbulence,
    /// Lower boundary of the water.
    pub bed: Bed,
    /// Body force per mass `[m/s²]`.
    pub gravity: Vector<D>,
}

/// Partition of the space between fluid and sediment.
#[derive(Debug, Clone, PartialEq)]
pub enum SolidFraction {
    /// They overlap: grains displace no fluid.
    Overlapping,
    /// A given φ(z).
    Given(Stratification),
    /// φ is that of the columns of grains that dilate, renewed at every step; the strata that are given here say how high
    /// the columns reach and all but φ.
    Averaged(Stratification),
}

impl SolidFraction {
    /// The stratification, if there is one.
    #[must_use]
    pub fn stratification(&self) -> Option<&Stratification> {
        match self {
            Self::Overlapping => None,
            Self::Given(stratification) | Self::Averaged(stratification) => Some(stratification),
        }
    }
}

/// Both phases and the numerics.
#[derive(Debug, Clone)]
pub struct IncompressibleScene<const D: usize> {
    /// The fluid.
    pub fluid: Fluid<D>,
    /// The sediment.
    pub sediment: Option<Sediment<D>>,
    /// Partition of the space between fluid and sediment.
    pub solid_fraction: SolidFraction,
    /// Boundaries: periodic or open.
    pub domain: Domain<D>,
    /// Numerical scheme.
    pub numerics: ProjectionNumerics,
}
