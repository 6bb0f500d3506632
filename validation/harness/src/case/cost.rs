//! Cost of a particle-step, for estimates before a run: orders of magnitude for a small scene on one core.

/// Of the weakly compressible model in the plane `[s]`; a column in space costs four times as much.
pub const WEAKLY_COMPRESSIBLE: f64 = 0.7e-6;

/// Preparation of a triangle of a mesh `[s]`: trees, dummy particles behind it, output.
pub const TRIANGLE: f64 = 5e-5;

/// Cost of an implicit viscous step over that of an explicit one `[-]`, weakly compressible model: pairs in double
/// precision, and some ten iterations.
pub const IMPLICIT_STEP: f64 = 3.0;

/// Of the incompressible model `[s]`.
pub const INCOMPRESSIBLE: f64 = 1.5e-6;
