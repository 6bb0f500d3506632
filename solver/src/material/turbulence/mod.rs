//! Closures for what the particles do not resolve.

mod mixing_length;
mod rough_wall;
mod smagorinsky;

pub use mixing_length::{MixingLength, MixingLengthShape};
pub use rough_wall::RoughWall;
pub use smagorinsky::Smagorinsky;

/// Von Kármán's constant κ `[-]`.
pub const VON_KARMAN: f64 = 0.41;
