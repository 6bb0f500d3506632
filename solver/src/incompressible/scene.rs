//! What an incompressible simulation starts from.

use super::numerics::ProjectionNumerics;
use crate::boundary::{AxisBoundary, Domain};
use crate::drag::DragLaw;
use crate::scene::SceneError;
use crate::turbulence::{MixingLength, RoughWall};
use crate::vector::Vector;

/// Free particles at the start; all arrays have the shape `[particles]`.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ParticleSet<const D: usize> {
    /// Positions `[m]`.
    pub position: Vec<Vector<D>>,
    /// Velocities `[m/s]`.
    pub velocity: Vec<Vector<D>>,
}

/// What the fluid flows over.
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
    /// None.
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
    /// Bed.
    pub bed: Bed,
    /// Body force per mass `[m/s²]`.
    pub gravity: Vector<D>,
}

/// How the sediment yields.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SedimentYield {
    /// τ_Y `[Pa]`.
    pub yield_stress: f64,
    /// μ_s `[Pa·s]`.
    pub viscosity: f64,
    /// Friction on the overburden `[-]`; 0 is the paper's Bingham law.
    pub overburden_friction: f64,
    /// Level above which there is no overburden `[m]`.
    pub overburden_level: f64,
    /// Buoyant weight that loads it `[Pa/m]`.
    pub buoyant_weight: f64,
    /// Regularisation rate `[1/s]`.
    pub regularisation_rate: f64,
    /// Largest viscosity `[Pa·s]`.
    pub largest_viscosity: f64,
}

/// The sediment.
#[derive(Debug, Clone)]
pub struct Sediment<const D: usize> {
    /// Free particles.
    pub particles: ParticleSet<D>,
    /// Fixed grains `[m]`.
    pub wall: Vec<Vector<D>>,
    /// Particle spacing `[m]`.
    pub spacing: f64,
    /// Density of a grain `[kg/m³]`.
    pub density: f64,
    /// Grain diameter `[m]`.
    pub grain_diameter: f64,
    /// Yield.
    pub strength: SedimentYield,
    /// Drag law.
    pub drag: DragLaw,
    /// Smoothing length of the drag `[m]`.
    pub drag_smoothing_length: f64,
    /// Factor of the drag `[-]`.
    pub drag_factor: f64,
    /// Body force per mass `[m/s²]`.
    pub gravity: Vector<D>,
}

/// Both phases and the numerics.
#[derive(Debug, Clone)]
pub struct IncompressibleScene<const D: usize> {
    /// The fluid.
    pub fluid: Fluid<D>,
    /// The sediment.
    pub sediment: Option<Sediment<D>>,
    /// Boundaries: periodic or open.
    pub domain: Domain<D>,
    /// Numerics.
    pub numerics: ProjectionNumerics,
}

impl<const D: usize> IncompressibleScene<D> {
    /// Checks that the scene can be simulated.
    ///
    /// # Errors
    /// The first rule that is broken.
    pub fn check(&self) -> Result<(), SceneError> {
        let fluid = &self.fluid;
        check_set(&fluid.particles)?;
        let parameter = |(field, value, rule, remedy)| Err(SceneError::Parameter { field, value, rule, remedy });
        if let Some(problem) = self.numerics.parameter_problem() {
            return parameter(problem);
        }
        let positive = |value: f64| value > 0.0 && value.is_finite();
        let mut values = vec![("spacing", fluid.spacing), ("density", fluid.density)];
        values.push(("kinematic_viscosity", fluid.kinematic_viscosity));
        let mut least = 2.0 * self.reach(fluid.spacing);
        if let Some(sediment) = &self.sediment {
            check_set(&sediment.particles)?;
            values.extend([
                ("sediment spacing", sediment.spacing),
                ("sediment density", sediment.density),
                ("grain_diameter", sediment.grain_diameter),
                ("drag_smoothing_length", sediment.drag_smoothing_length),
                ("regularisation_rate", sediment.strength.regularisation_rate),
                ("largest_viscosity", sediment.strength.largest_viscosity),
            ]);
            let strength = &sediment.strength;
            let signless = [("yield_stress", strength.yield_stress), ("viscosity", strength.viscosity)];
            for (field, value) in signless {
                if !(value >= 0.0 && value.is_finite()) {
                    return parameter((field, value, "0 or positive, and finite", "give it in SI units"));
                }
            }
            least = least.max(2.0 * self.reach(sediment.spacing)).max(4.0 * sediment.drag_smoothing_length);
        }
        for (field, value) in values {
            if !positive(value) {
                return parameter((field, value, "positive and finite", "give it in SI units"));
            }
        }
        for (axis, boundary) in self.domain.axes.iter().enumerate() {
            if let AxisBoundary::Periodic { lower, upper } = boundary {
                let length = upper - lower;
                if length.is_nan() || length < least {
                    return Err(SceneError::Period { axis, length, least });
                }
            }
        }
        Ok(())
    }

    fn reach(&self, spacing: f64) -> f64 {
        2.0 * self.numerics.smoothing_ratio * spacing
    }
}

fn check_set<const D: usize>(particles: &ParticleSet<D>) -> Result<(), SceneError> {
    let (expected, found) = (particles.position.len(), particles.velocity.len());
    if expected == 0 {
        return Err(SceneError::Empty);
    }
    if found != expected {
        return Err(SceneError::Length { array: "velocity", found, expected });
    }
    for (particle, (position, velocity)) in particles.position.iter().zip(&particles.velocity).enumerate() {
        for (quantity, value) in [("position", position.sum()), ("velocity", velocity.sum())] {
            if !value.is_finite() {
                return Err(SceneError::Value { quantity, particle, value, rule: "finite" });
            }
        }
    }
    Ok(())
}
