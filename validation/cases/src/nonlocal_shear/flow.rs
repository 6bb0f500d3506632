//! The flows, and what is exact of them without particles.

use super::channel::STIFFNESS;
use crate::reference::one_dimension::{LayerError, NonlocalShear, NonlocalShearProfile, ShearStress};
use bagnold_solver::material::rheology::field::FieldBoundary;
use bagnold_solver::material::rheology::{MuI, NonlocalMuI, Rheology};
use bagnold_solver::weakly_compressible::walls::SideWalls;
use serde::Serialize;

/// Cells of the solution without particles.
const CELLS: usize = 2000;
/// Halvings of a bracket, which leave less than rounding of the solution.
const HALVINGS: usize = 40;
/// Largest friction below a plate, and in search of that of a chute, over μ_2 `[-]`: there the shear rate has no bound.
const MOST_FRICTION: f64 = 0.999;

/// A flow whose stresses the balance of momentum gives.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum ShearFlow {
    /// A vertical chute between two walls.
    Chute {
        /// Half the distance of the walls `[m]`.
        half_width: f64,
        /// Friction that its walls bear, ρ g W/p `[-]`.
        wall_friction: f64,
    },
    /// Grains under gravity below a plate that drags them.
    DraggedBed {
        /// Thickness `[m]`.
        depth: f64,
        /// Velocity of the plate `[m/s]`.
        plate_velocity: f64,
    },
    /// A heap between side walls, which flows at its surface over grains that they hold.
    Heap {
        /// Thickness down to a rough bed `[m]`.
        depth: f64,
        /// Inclination of the surface `[rad]`.
        inclination: f64,
        /// The side walls.
        side_walls: SideWalls,
        /// Whether its grains cooperate.
        cooperation: RheologyChoice,
    },
}

/// Rheology of a heap: nonlocal, or local for comparison.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum RheologyChoice {
    /// By the nonlocal law.
    Nonlocal,
    /// Not at all: the local law of the same grains.
    Local,
}

/// Grains that the flow is one of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShearedGrains {
    /// The law.
    pub law: NonlocalMuI,
    /// Mean pressure in a chute, pressure below a plate `[Pa]`.
    pub load: f64,
    /// Density of the bulk `[kg/m³]`.
    pub density: f64,
    /// Gravity `[m/s²]`; along a chute it is made to fit the friction of the walls.
    pub gravity: f64,
}

/// A steady flow without particles.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactShear {
    flow: ShearFlow,
    /// Its stresses.
    pub shear: NonlocalShear,
    /// Its profile over the distance from where it flows fastest.
    pub profile: NonlocalShearProfile,
}

impl ShearFlow {
    /// Its name in a variant.
    #[must_use]
    pub fn name(&self) -> &'static str {
        match self {
            Self::Chute { .. } => "chute",
            Self::DraggedBed { .. } => "dragged-bed",
            Self::Heap { cooperation: RheologyChoice::Nonlocal, .. } => "heap",
            Self::Heap { cooperation: RheologyChoice::Local, .. } => "local-heap",
        }
    }

    /// The law that its grains have.
    #[must_use]
    pub fn law(&self, law: NonlocalMuI) -> Rheology {
        match self {
            Self::Heap { cooperation: RheologyChoice::Local, .. } => Rheology::MuI(law.local()),
            _ => Rheology::NonlocalMuI(law),
        }
    }

    /// Distance of its walls, or of its surface from the bed `[m]`.
    #[must_use]
    pub fn width(&self) -> f64 {
        match *self {
            Self::Chute { half_width, .. } => 2.0 * half_width,
            Self::DraggedBed { depth, .. } | Self::Heap { depth, .. } => depth,
        }
    }

    /// Distance `[m]` from where it flows fastest, the middle of a chute, the plate or the surface, of a height above the lower wall `[m]`.
    #[must_use]
    pub fn distance(&self, height: f64) -> f64 {
        match *self {
            Self::Chute { half_width, .. } => (height - half_width).abs(),
            Self::DraggedBed { depth, .. } | Self::Heap { depth, .. } => depth - height,
        }
    }

    /// Gravity along the walls and across them `[m/s²]`.
    #[must_use]
    pub fn gravity(&self, grains: &ShearedGrains) -> [f64; 2] {
        match *self {
            Self::Chute { half_width, wall_friction } => {
                // the compression makes the grains denser by p/K
                let density = grains.density * (1.0 + 1.0 / STIFFNESS);
                [wall_friction * grains.load / (density * half_width), 0.0]
            }
            Self::DraggedBed { .. } => [0.0, -grains.gravity],
            Self::Heap { inclination, .. } => {
                [grains.gravity * libm::sin(inclination), -grains.gravity * libm::cos(inclination)]
            }
        }
    }

    /// Pressure at a height `[Pa]`.
    #[must_use]
    pub fn pressure(&self, grains: &ShearedGrains, height: f64) -> f64 {
        match *self {
            Self::Chute { .. } => grains.load,
            Self::DraggedBed { .. } => grains.load + grains.density * grains.gravity * self.distance(height),
            Self::Heap { .. } => -grains.density * self.gravity(grains)[1] * self.distance(height).max(0.0),
        }
    }

    /// The steady flow: of a chute at its friction, below a plate with the traction at which the plate moves as it does; none
    /// where there is no such flow.
    #[must_use]
    pub fn steady(&self, grains: &ShearedGrains) -> Option<ExactShear> {
        match *self {
            Self::Chute { wall_friction, .. } => self.under(grains, wall_friction),
            Self::DraggedBed { plate_velocity, .. } => {
                self.under(grains, self.friction_of(grains, plate_velocity).ok().flatten()?)
            }
            Self::Heap { inclination, .. } => {
                // beyond μ_2 no law of these grains bears the weight
                let slope = libm::tan(inclination);
                (slope < grains.law.limiting_friction).then(|| self.under(grains, slope)).flatten()
            }
        }
    }

    /// The steady flow whose walls, or plate, bear a friction `[-]`, or whose surface has that slope; none at rest.
    fn under(&self, grains: &ShearedGrains, friction: f64) -> Option<ExactShear> {
        let shear = self.stressed(grains, friction);
        let profile = match self {
            Self::Heap { cooperation: RheologyChoice::Local, .. } => local_profile(&shear),
            _ => shear.steady(CELLS).ok()?,
        };
        (profile.fastest > 0.0).then_some(ExactShear { flow: *self, shear, profile })
    }

    /// The stresses under a friction of the walls or the plate, or a slope of the surface `[-]`.
    fn stressed(&self, grains: &ShearedGrains, friction: f64) -> NonlocalShear {
        let (load, weight) = (grains.load, grains.density * grains.gravity);
        let (thickness, stress, near) = match *self {
            Self::Chute { half_width, .. } => {
                let stress = ShearStress::Chute { pressure: load, wall_friction: friction };
                (half_width, stress, FieldBoundary::NoFlux)
            }
            Self::DraggedBed { depth, .. } => {
                let stress = ShearStress::UnderGravity { load, traction: friction * load, weight };
                (depth, stress, FieldBoundary::Vanishing)
            }
            Self::Heap { depth, side_walls, .. } => {
                let across = -grains.density * self.gravity(grains)[1];
                let stress = ShearStress::Heap {
                    slope: friction,
                    weight: across,
                    side_friction: side_walls.friction_per_width(),
                };
                (depth, stress, grains.law.surface)
            }
        };
        NonlocalShear {
            grains: grains.law.local(),
            cooperativity: grains.law.cooperativity,
            thickness,
            stress,
            ends: [near, FieldBoundary::Vanishing],
        }
    }

    /// Friction of the walls or the plate `[-]` at which the flow is as fast as is asked for `[m/s]`; none beyond what it can be.
    ///
    /// # Errors
    /// A solution that does not converge.
    pub fn friction_of(&self, grains: &ShearedGrains, fastest: f64) -> Result<Option<f64>, LayerError> {
        let law = &grains.law;
        let (mut slow, mut fast) = (law.static_friction, MOST_FRICTION * law.limiting_friction);
        if self.stressed(grains, fast).steady(CELLS)?.fastest < fastest {
            return Ok(None);
        }
        for _ in 0..HALVINGS {
            let middle = 0.5 * (slow + fast);
            let reached = self.stressed(grains, middle).steady(CELLS)?.fastest;
            if reached < fastest { slow = middle } else { fast = middle }
        }
        Ok(Some(fast))
    }
}

impl ExactShear {
    /// Velocity `[m/s]` at a height above the lower wall `[m]`.
    #[must_use]
    pub fn velocity(&self, height: f64) -> f64 {
        self.profile.velocity(self.flow.distance(height))
    }

    /// Shear rate `[1/s]` at such a height.
    #[must_use]
    pub fn shear_rate(&self, height: f64) -> f64 {
        self.profile.shear_rate(self.flow.distance(height))
    }

    /// Shear stress s_xy `[Pa]` at such a height.
    #[must_use]
    pub fn shear_stress(&self, height: f64) -> f64 {
        let (pressure, friction) = self.shear.stress.at(self.flow.distance(height), self.shear.thickness);
        // the velocity of a chute falls from its middle to either wall
        let slows_upwards = matches!(self.flow, ShearFlow::Chute { half_width, .. } if height > half_width);
        if slows_upwards { -pressure * friction } else { pressure * friction }
    }

    /// Distance from where it flows fastest at which the local law changes from flow to rest, or in a chute from rest to flow `[m]`.
    #[must_use]
    pub fn yield_distance(&self) -> f64 {
        let yielding = self.shear.grains.static_friction;
        match self.shear.stress {
            ShearStress::Chute { wall_friction, .. } => self.shear.thickness * yielding / wall_friction,
            ShearStress::UnderGravity { load, traction, weight } => (traction / yielding - load) / weight,
            ShearStress::Heap { slope, side_friction, .. } => (slope - yielding) / side_friction,
        }
    }

    /// (distance from where it flows fastest `[m]`, velocity `[m/s]`) of the local law under the same stresses.
    #[must_use]
    pub fn local(&self) -> Vec<(f64, f64)> {
        let local = local_profile(&self.shear);
        local.distances.into_iter().zip(local.velocities).collect()
    }
}

/// The steady flow of the local law under stresses that the balance of momentum gives: its shear rate is that of I(μ), and the
/// velocity its integral from the far end.
fn local_profile(shear: &NonlocalShear) -> NonlocalShearProfile {
    let width = shear.thickness / CELLS as f64;
    let mut profile = NonlocalShearProfile {
        distances: (0..CELLS).map(|cell| (cell as f64 + 0.5) * width).collect(),
        frictions: Vec::with_capacity(CELLS),
        fluidities: Vec::with_capacity(CELLS),
        velocities: vec![0.0; CELLS],
        fastest: 0.0,
    };
    for &distance in &profile.distances {
        let (pressure, friction) = shear.stress.at(distance, shear.thickness);
        profile.frictions.push(friction);
        profile.fluidities.push(local_shear_rate(&shear.grains, pressure, friction) / friction.max(f64::MIN_POSITIVE));
    }
    for cell in (0..CELLS).rev() {
        let growth = width * profile.fluidities[cell] * profile.frictions[cell];
        profile.fastest += growth;
        profile.velocities[cell] = profile.fastest - 0.5 * growth;
    }
    profile
}

/// Shear rate of the local law `[1/s]`.
fn local_shear_rate(grains: &MuI, pressure: f64, friction: f64) -> f64 {
    let above = (friction - grains.static_friction).max(0.0);
    let inertia = grains.reference_inertia * above / (grains.limiting_friction - friction);
    inertia * (pressure / grains.grain_density).sqrt() / grains.grain_diameter
}

#[cfg(test)]
#[path = "flow_tests.rs"]
mod tests;
