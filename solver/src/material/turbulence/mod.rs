//! Closures for what the particles do not resolve.

mod grain_roughness;
mod mixing_length;
mod rough_wall;
mod smagorinsky;
mod stratified;

pub use grain_roughness::GrainRoughness;
pub use mixing_length::{MixingLength, MixingLengthShape};
pub use rough_wall::RoughWall;
pub use smagorinsky::Smagorinsky;
pub use stratified::StratifiedMixingLength;

use crate::lanes::Real;

/// Von Kármán's constant κ `[-]`.
pub const VON_KARMAN: f64 = 0.41;

/// Prandtl's eddy viscosity ν_t = l² |γ̇| `[m²/s]` of a mixing length `[m]` at a shear rate `[1/s]`.
#[inline]
#[must_use]
pub fn eddy_viscosity(mixing_length: f64, shear_rate: f64) -> f64 {
    // times 1 changes no bit
    dynamic_eddy_viscosity(1.0, mixing_length * mixing_length, shear_rate)
}

/// The same as a dynamic viscosity ρ l² |γ̇| `[Pa·s]`, at a density `[kg/m³]` and the square of the mixing length `[m²]`.
#[inline(always)]
#[must_use]
pub fn dynamic_eddy_viscosity<R: Real>(density: R, mixing_area: f64, shear_rate: R) -> R {
    density * R::splat(mixing_area) * shear_rate
}
