//! Closures for what the particles do not resolve.

mod mixing_length;
mod rough_wall;
mod smagorinsky;
mod stratified;

pub use mixing_length::{MixingLength, MixingLengthShape};
pub use rough_wall::RoughWall;
pub use smagorinsky::Smagorinsky;
pub use stratified::StratifiedMixingLength;

/// Von Kármán's constant κ `[-]`.
pub const VON_KARMAN: f64 = 0.41;

/// Prandtl's eddy viscosity ν_t = l² |γ̇| `[m²/s]` of a mixing length `[m]` at a shear rate `[1/s]`.
#[inline]
#[must_use]
pub fn eddy_viscosity(mixing_length: f64, shear_rate: f64) -> f64 {
    mixing_length * mixing_length * shear_rate
}
