//! Cost of a particle-step, for estimates before a run: orders of magnitude for a small scene on one core.

/// Time for the weakly compressible model in the plane `[s]`; a column in space costs four times as much.
pub const WEAKLY_COMPRESSIBLE: f64 = 0.7e-6;

/// Preparation of a triangle of a mesh `[s]`: trees, dummy particles behind it, output.
pub const TRIANGLE: f64 = 5e-5;

/// Cost of an implicit viscous step over that of an explicit one `[-]`, weakly compressible model: pairs in double
/// precision, and some ten iterations.
pub const IMPLICIT_STEP: f64 = 3.0;

/// Time for the incompressible model `[s]`.
pub const INCOMPRESSIBLE: f64 = 1.5e-6;

/// Resources that a run is expected to take.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunCost {
    /// Particles, or cells, that it holds at once `[-]`: what its memory is estimated from. 0, if nothing is known.
    pub particles: f64,
    /// Particle-steps, for scheduling the longest first and for the progress bar `[-]`.
    pub particle_steps: f64,
    /// Time of a particle-step on one core `[s]`.
    pub seconds_per_particle_step: f64,
    /// Memory that a particle takes while the run goes on `[bytes]`.
    pub bytes_per_particle: f64,
    /// Time of one core before the first step `[s]`.
    pub preparation_seconds: f64,
}

impl RunCost {
    /// A run of the weakly compressible model in the plane, with given numbers of particles and steps.
    pub fn weakly_compressible(particles: f64, steps: f64) -> Self {
        Self {
            particles,
            particle_steps: particles * steps,
            seconds_per_particle_step: WEAKLY_COMPRESSIBLE,
            bytes_per_particle: BYTES_WHILE_RUNNING,
            preparation_seconds: 0.0,
        }
    }

    /// A run of the incompressible model, with given numbers of particles and steps.
    pub fn incompressible(particles: f64, steps: f64) -> Self {
        Self { seconds_per_particle_step: INCOMPRESSIBLE, ..Self::weakly_compressible(particles, steps) }
    }
}

/// Memory per particle during its run: state, neighbours, pair weights, solves `[bytes]`. Still water of 160 000 particles
/// takes some 2.3 kB each.
pub(in crate::case) const BYTES_WHILE_RUNNING: f64 = 3e3;
