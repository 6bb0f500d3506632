//! What an incompressible simulation starts from.

use super::numerics::ProjectionNumerics;
use super::stratification::Stratification;
use crate::domain::{AxisBoundary, Domain};
use crate::material::drag::DragLaw;
use crate::material::turbulence::{MixingLength, RoughWall, Smagorinsky};
use crate::parameter::ParameterProblem;
use crate::run::SceneError;
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
    /// Bed.
    pub bed: Bed,
    /// Body force per mass `[m/s²]`.
    pub gravity: Vector<D>,
}

/// How the sediment yields.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SedimentLaw {
    /// Bingham, with a yield stress that may grow with the grains' overburden.
    Bingham(SedimentYield),
    /// μ(I) on the overburden of a [`Stratification`].
    MuI(GranularFriction),
}

/// Bingham's law (21) in the norm |γ̇| = √(2 ε:ε), with Coulomb friction on the overburden.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SedimentYield {
    /// Yield stress τ_y `[Pa]`.
    pub yield_stress: f64,
    /// Plastic viscosity `[Pa·s]`.
    pub viscosity: f64,
    /// Friction on the overburden `[-]`; 0 is the paper's law.
    pub overburden_friction: f64,
    /// Level above which there is no overburden `[m]`.
    pub overburden_level: f64,
    /// Buoyant weight of the grains `[Pa/m]`.
    pub buoyant_weight: f64,
    /// Shear rate below which the material creeps instead of standing still `[1/s]`.
    pub regularisation_rate: f64,
    /// Largest viscosity `[Pa·s]`.
    pub largest_viscosity: f64,
}

/// τ = μ(I) p′ γ̇/√(γ̇² + γ_r²) with μ = μ_s + (μ_2 − μ_s) I/(I + I_0), I = γ̇ d √(ρ_s/p′).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GranularFriction {
    /// Static friction μ_s `[-]`.
    pub static_friction: f64,
    /// Limiting friction μ_2 `[-]`.
    pub limiting_friction: f64,
    /// Reference inertia I_0 `[-]`.
    pub reference_inertia: f64,
    /// Regularisation rate γ_r `[1/s]`.
    pub regularisation_rate: f64,
}

/// What keeps the sediment apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SedimentPressure {
    /// A pressure Poisson equation of its own, (11): each grain is incompressible.
    Incompressible,
    /// Nothing: the particles move as fluid and gravity make them.
    None,
    /// Nothing: the particles move along the bed only, and keep the solid fraction that is given.
    AlongBed,
    /// The pressure of sheared grains, p = ρ_s (d γ̇ B φ/(φ_max − φ))², the inverse of φ = φ_max/(1 + B I).
    Dilatant {
        /// B `[-]`.
        dilation: f64,
        /// φ_max `[-]`.
        packing: f64,
        /// Volume of grains in a fixed particle over its lattice volume `[-]`.
        fixed_filling: f64,
    },
}

/// Which force a sediment particle feels from the fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum DragForm {
    /// (30): one grain a particle, ½ C_d d |u_r| per mass of the fluid around it, times a factor `[-]`.
    Grain(f64),
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
    /// Fixed grains `[m]`.
    pub wall: Vec<Vector<D>>,
    /// Particle spacing `[m]`.
    pub spacing: f64,
    /// Smoothing length over particle spacing of the sediment's kernel `[-]`.
    pub smoothing_ratio: f64,
    /// Density of a grain `[kg/m³]`.
    pub density: f64,
    /// Grain diameter `[m]`.
    pub grain_diameter: f64,
    /// Law.
    pub law: SedimentLaw,
    /// Pressure.
    pub pressure: SedimentPressure,
    /// Drag law.
    pub drag: DragLaw,
    /// Its form.
    pub drag_form: DragForm,
    /// Smoothing length of the drag `[m]`.
    pub drag_smoothing_length: f64,
    /// Body force per mass, with buoyancy across the bed `[m/s²]`.
    pub gravity: Vector<D>,
}

/// How the phases share the space.
#[derive(Debug, Clone, PartialEq)]
pub enum SolidFraction {
    /// They overlap: grains displace no fluid.
    Overlapping,
    /// A given φ(z).
    Given(Stratification),
    /// φ(z) is the mean along the bed of the sediment particles, renewed at every step.
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
    /// How the phases share the space.
    pub solid_fraction: SolidFraction,
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
        if let Some(problem) = self.numerics.parameter_problem() {
            return Err(problem.into());
        }
        let parameter = |(field, value, rule, remedy): (&str, f64, &str, &str)| {
            Err(ParameterProblem::new(field, value, rule, remedy).into())
        };
        let positive = |value: f64| value > 0.0 && value.is_finite();
        let mut values = vec![("spacing", fluid.spacing), ("density", fluid.density)];
        values.push(("kinematic_viscosity", fluid.kinematic_viscosity));
        let mut least = 2.0 * self.reach(fluid.spacing);
        if let Some(sediment) = &self.sediment {
            if sediment.wall.is_empty() || !sediment.particles.position.is_empty() {
                check_set(&sediment.particles)?;
            }
            values.extend([
                ("sediment spacing", sediment.spacing),
                ("sediment smoothing_ratio", sediment.smoothing_ratio),
                ("sediment density", sediment.density),
                ("grain_diameter", sediment.grain_diameter),
                ("drag_smoothing_length", sediment.drag_smoothing_length),
            ]);
            let signless = match sediment.law {
                SedimentLaw::Bingham(law) => {
                    values.push(("regularisation_rate", law.regularisation_rate));
                    values.push(("largest_viscosity", law.largest_viscosity));
                    [("yield_stress", law.yield_stress), ("viscosity", law.viscosity)]
                }
                SedimentLaw::MuI(law) => {
                    values.push(("regularisation_rate", law.regularisation_rate));
                    values.push(("reference_inertia", law.reference_inertia));
                    [("static_friction", law.static_friction), ("limiting_friction", law.limiting_friction)]
                }
            };
            for (field, value) in signless {
                if !(value >= 0.0 && value.is_finite()) {
                    return parameter((field, value, "0 or positive, and finite", "give it in SI units"));
                }
            }
            let (expected, found) = (sediment.particles.position.len(), sediment.filling.len());
            if found != expected {
                return Err(SceneError::Length { array: "filling", found, expected });
            }
            least =
                least.max(4.0 * sediment.smoothing_ratio * sediment.spacing).max(4.0 * sediment.drag_smoothing_length);
        }
        self.check_mixture()?;
        if let Some(layer) = self.solid_fraction.stratification() {
            for &value in &layer.solid_fraction {
                if !(0.0..1.0).contains(&value) {
                    return parameter(("solid_fraction", value, "in [0, 1)", "grains fill 0 to 0.64 of the space"));
                }
            }
            values.extend([("packing", layer.packing), ("interval", layer.interval), ("depth", layer.depth)]);
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

    /// Product of the periods along the bed: its area `[m]` in 2-D, `[m²]` in 3-D.
    pub(super) fn bed_area(&self) -> f64 {
        let along = self.domain.axes.iter().take(D - 1);
        along.fold(1.0, |area, boundary| match boundary {
            AxisBoundary::Periodic { lower, upper } => area * (upper - lower),
            AxisBoundary::Open | AxisBoundary::Mirror { .. } => area,
        })
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
