//! Steady flows without particles.

use crate::reference::one_dimension::{NonlocalShear, NonlocalShearProfile, ShearStress};
use bagnold_solver::material::rheology::MuI;

/// Cells of the solution without particles.
pub(super) const CELLS: usize = 2000;
/// A steady flow without particles.
#[derive(Debug, Clone, PartialEq)]
pub struct ExactShear {
    /// Stresses of the exact flow.
    pub shear: NonlocalShear,
    /// Profile over the distance from where it flows fastest.
    pub profile: NonlocalShearProfile,
}

/// Distance `[m]` from where a chute, or a bed or heap of a thickness `[m]` flows fastest, of a height above the lower wall `[m]`.
pub(super) fn distance(is_chute: bool, thickness: f64, height: f64) -> f64 {
    if is_chute { (height - thickness).abs() } else { thickness - height }
}

impl ExactShear {
    fn is_chute(&self) -> bool {
        matches!(self.shear.stress, ShearStress::Chute { .. })
    }

    fn distance(&self, height: f64) -> f64 {
        distance(self.is_chute(), self.shear.thickness, height)
    }

    /// Velocity `[m/s]` at a height above the lower wall `[m]`.
    pub fn velocity(&self, height: f64) -> f64 {
        self.profile.velocity(self.distance(height))
    }

    /// Shear rate `[1/s]` at such a height.
    pub fn shear_rate(&self, height: f64) -> f64 {
        self.profile.shear_rate(self.distance(height))
    }

    /// Shear stress s_xy `[Pa]` at such a height.
    pub fn shear_stress(&self, height: f64) -> f64 {
        let (pressure, friction) = self.shear.stress.at(self.distance(height), self.shear.thickness);
        // the velocity of a chute falls from its middle to either wall
        let slows_upwards = self.is_chute() && height > self.shear.thickness;
        if slows_upwards { -pressure * friction } else { pressure * friction }
    }

    /// Distance from where it flows fastest at which the local law changes from flow to rest, or in a chute from rest to flow `[m]`.
    pub fn yield_distance(&self) -> f64 {
        let yielding = self.shear.grains.static_friction;
        match self.shear.stress {
            ShearStress::Chute { wall_friction, .. } => self.shear.thickness * yielding / wall_friction,
            ShearStress::UnderGravity { load, traction, weight } => (traction / yielding - load) / weight,
            ShearStress::Heap { slope, side_friction, .. } => (slope - yielding) / side_friction,
        }
    }

    /// (distance from where it flows fastest `[m]`, velocity `[m/s]`) of the local law under the same stresses.
    pub fn local(&self) -> Vec<(f64, f64)> {
        let local = local_profile(&self.shear);
        local.distances.into_iter().zip(local.velocities).collect()
    }
}

/// The steady flow of the local law under stresses that the balance of momentum gives: its shear rate is that of I(μ), and the
/// velocity its integral from the far end.
pub(super) fn local_profile(shear: &NonlocalShear) -> NonlocalShearProfile {
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
