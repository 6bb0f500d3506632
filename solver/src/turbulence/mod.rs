//! Closures for what the particles do not resolve.

mod smagorinsky;

pub use smagorinsky::Smagorinsky;
