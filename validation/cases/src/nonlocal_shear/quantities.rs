//! What the case measures, what it is held against, and how near.

use crate::metric::quantities;
use crate::setup::energy_ledger;

quantities! {
    [energy_ledger::ENERGY_RESIDUAL, energy_ledger::ENERGY_RISE, energy_ledger::WALL_WORK, energy_ledger::CORRECTION_WORK]
    PARTICLES_LOST: accounted("particles_lost", "-", "particles that ended behind a wall"),
    OVERFILLING: verified(
        "overfilling", "%", "volume m/ρ of all particles over that of the channel, less 1, by which they bear more on the walls than their own pressure"
    ),
    PRESSURE_UNEVENNESS: verified(
        "pressure_unevenness", "%", "largest deviation of a row's pressure from that of the balance of momentum, over the mean"
    ),
    VELOCITY_L2: verified("velocity_l2", "%", "relative L2 of the velocity profile"),
    WALL_LAYER: verified(
        "wall_layer", "diameters", "distance from the wall within which the velocity less that of the middle falls by e"
    ),
    PLUG_VELOCITY_ERROR: verified("plug_velocity_error", "%", "velocity in the middle of a chute over the exact one, less 1"),
    FRICTION_ERROR: verified(
        "friction_error", "%", "friction of the walls at which the model would have the same velocity in the middle, over theirs, less 1"
    ),
    TRACTION_ERROR: verified("traction_error", "%", "mean shear stress over that of the plate's velocity, less 1"),
    SURFACE_VELOCITY_ERROR: verified("surface_velocity_error", "%", "velocity of the uppermost row of a heap over the exact one there, less 1"),
    FLOWING_DEPTH: verified(
        "flowing_depth", "diameters", "depth at which the velocity of a heap is a hundredth of that of its surface"
    ),
    OBSERVED_ORDER: verified(
        "observed_order", "-", "order of convergence of velocity_l2 under the local law from one resolution to the next"
    ),
    DECAY_LENGTH: verified(
        "decay_length", "diameters", "length over which the velocity falls by e, below the depth at which the local law is at rest"
    ),
    TAIL_STRAIGHTNESS: verified(
        "tail_straightness", "-", "R² of a straight line through the logarithm of the velocity over that depth"
    ),
    DEEP_DECAY_LENGTH: validated(
        "deep_decay_length", "diameters", "length over which the velocity falls by e in the deeper half of the tail"
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
