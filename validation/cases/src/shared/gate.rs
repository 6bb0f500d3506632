//! Gates in front of what collapses.

use bagnold_solver::weakly_compressible::Scene;
use bagnold_solver::weakly_compressible::walls::gate::Gate;

/// Closes a scene beyond a place `[m]` by a gate of some rows of particles that is lifted at a speed `[m/s]` clear of a height `[m]`.
pub(crate) fn close_by_gate(scene: &mut Scene<2>, position: f64, height: f64, speed: f64, rows: usize) {
    let spacing = scene.spacing;
    let above = rows as f64 * spacing;
    let gate = Gate { position, edge: 0.0, height: height + above, speed, lift: height + 2.0 * above, rows };
    let (faces, particles) = gate.build(spacing, scene.walls.len());
    scene.walls.extend(faces);
    scene.wall_particles.extend(particles);
}
