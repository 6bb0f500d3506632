//! What the case measures, what it is held against, and how near.

use crate::metric::quantities;
use crate::setup::energy_ledger;

quantities! {
    [energy_ledger::ENERGY_RESIDUAL, energy_ledger::ENERGY_RISE, energy_ledger::WALL_WORK, energy_ledger::CORRECTION_WORK]
    PARTICLES_LOST: accounted("particles_lost", "-", "particles that ended behind a wall"),
    OVERFILLING: verified(
        "overfilling", "%", "total volume m/ρ of all particles over the volume of the channel, minus 1"
    ),
    PRESSURE_UNEVENNESS: verified(
        "pressure_unevenness", "%", "largest deviation of the pressure of a row from the momentum balance, over the mean"
    ),
    VELOCITY_L2: verified("velocity_l2", "%", "relative L2 error of the velocity profile, √(Σ(u − u_ref)²/Σu_ref²)"),
    WALL_LAYER: verified(
        "wall_layer", "diameters", "e-folding distance from the wall of the velocity relative to the middle"
    ),
    PLUG_VELOCITY_ERROR: verified("plug_velocity_error", "%", "u_middle/u_exact − 1 of a chute"),
    FRICTION_ERROR: verified(
        "friction_error", "%", "wall friction that gives the model the same velocity in the middle, over the imposed friction, minus 1"
    ),
    TRACTION_ERROR: verified("traction_error", "%", "mean shear stress over the exact stress at the velocity of the plate, minus 1"),
    SURFACE_VELOCITY_ERROR: verified("surface_velocity_error", "%", "u/u_exact − 1 of the uppermost row of a heap"),
    FLOWING_DEPTH: verified(
        "flowing_depth", "diameters", "depth at which the velocity of a heap is a hundredth of that of its surface"
    ),
    OBSERVED_ORDER: verified(
        "observed_order", "-", "order of convergence of velocity_l2 under the local law from one resolution to the next"
    ),
    DECAY_LENGTH: verified(
        "decay_length", "diameters", "e-folding length of the velocity below the depth at which the local law is at rest"
    ),
    TAIL_STRAIGHTNESS: verified(
        "tail_straightness", "-", "R² of a straight line through the logarithm of the velocity over that depth"
    ),
    DEEP_DECAY_LENGTH: validated(
        "deep_decay_length", "diameters", "e-folding length of the velocity in the deeper half of the tail"
    ),
}

/// Least R² of a tail `[-]`, and why.
pub(super) const STRAIGHT: (f64, &str) = (
    0.98,
    "0.98: an exponential leaves a fiftieth of the logarithm's variance at most; the law's own length falls with the depth, so \
     that it leaves some, and a velocity that ends at a sharp edge bends far more",
);
pub(super) const EXACT: &str = "steady flow of the nonlocal law in finite volumes over 2000 cells, without particles, at the pressure that the run has";
/// Depths below that at which the local law is at rest, between which the tail is measured, in diameters: the whole of it, and its
/// deeper half.
pub(super) const TAIL: (f64, f64) = (0.0, 5.0);
pub(super) const DEEP_TAIL: (f64, f64) = (2.5, 6.0);
/// What lengths of the decay and of the layer at a wall may be off by with [`COARSE`] particles per diameter `[-]`.
pub(super) const LENGTH_ERROR: f64 = 0.05;
pub(super) const COARSE: f64 = 2.0;
pub(super) const LENGTH_REASON: &str = "5 % where two particles are as long as a grain, the fewest that resolve a length of 1.2 diameters, and half of it with \
     twice as many: first order";
