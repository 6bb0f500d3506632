//! What the collapses are judged by; those on slopes share some of it.

use crate::metric::Quantity;

pub(in crate::cases) const PARTICLES_LOST: Quantity =
    Quantity::verified("particles_lost", "-", "particles that passed the bed, the symmetry plane or the bed's end");
pub(in crate::cases) const MASS_CHANGE: Quantity =
    Quantity::verified("mass_change", "-", "relative change of the mass");
pub(in crate::cases) const MOMENTUM_RESIDUAL: Quantity =
    Quantity::verified("momentum_residual", "-", "momentum less what gravity and the walls gave, over M g t");
pub(in crate::cases) const KINETIC_ENERGY_SHARE: Quantity = Quantity::verified(
    "kinetic_energy_share",
    "-",
    "kinetic energy at the end over the potential energy that was released",
);
pub(in crate::cases) const DEPOSIT_SLOPE_ANGLE: Quantity =
    Quantity::validated("deposit_slope_angle", "°", "slope of a line through 20–80 % of the deposit");
pub(super) const RUN_OUT: Quantity =
    Quantity::validated("run_out", "-", "front of the deposit, or another measure of its extent, less r_0, over r_0");
pub(super) const FINAL_HEIGHT: Quantity =
    Quantity::validated("final_height", "-", "thickness of the innermost bin over r_0");
pub(super) const STOPPING_TIME: Quantity =
    Quantity::validated("stopping_time", "√(h0/g)", "time of 99 % of the front's way");
pub(super) const HEIGHT_BY_TOP: Quantity = Quantity::verified(
    "height_by_top",
    "%",
    "highest particle beside the symmetry plane over the final height, less 1",
);
pub(super) const ENERGY_GAIN: Quantity = Quantity::verified(
    "energy_gain",
    "%",
    "largest excess of the energy over that of the start, over the potential one",
);
pub(super) const FLOWING_LAYER_SHEAR_RATE: Quantity =
    Quantity::validated("flowing_layer_shear_rate", "1/s", "slope of a line through the flowing layer's velocity");
pub(super) const FLOWING_LAYER_R_SQUARED: Quantity =
    Quantity::validated("flowing_layer_r_squared", "-", "share of the variance that this line explains");
pub(super) const TAIL_DECAY_LENGTH_OVER_DIAMETER: Quantity = Quantity::validated(
    "tail_decay_length_over_diameter",
    "-",
    "length over which the velocity below the flowing layer decays, over the grain diameter",
);
pub(super) const TAIL_DECAY_LENGTH_OVER_SPACING: Quantity =
    Quantity::validated("tail_decay_length_over_spacing", "-", "the same length over the particle spacing");
pub(super) const TAIL_DECAY_LENGTH_STANDARD_ERROR: Quantity =
    Quantity::validated("tail_decay_length_standard_error", "spacings", "its standard error");
pub(super) const UNDISTURBED_SHARE: Quantity =
    Quantity::validated("undisturbed_share", "%", "part of the grains that stays in its place");
pub(super) const FAILURE_SURFACE_ANGLE: Quantity =
    Quantity::validated("failure_surface_angle", "°", "slope of the surface of what stays in its place");
pub(super) const ENSEMBLE_MEAN: Quantity = Quantity::verified("ensemble_mean", "-", "mean over the seeds");
pub(super) const ENSEMBLE_STANDARD_ERROR: Quantity =
    Quantity::verified("ensemble_standard_error", "-", "standard error of the mean over the seeds");
pub(super) const OBSERVED_ORDER: Quantity =
    Quantity::verified("observed_order", "-", "order of convergence of the three finest means");
pub(super) const GRID_CONVERGENCE_INDEX: Quantity =
    Quantity::verified("grid_convergence_index", "%", "what the finest mean may be off by");
pub(super) const ENSEMBLE_SPREAD: Quantity =
    Quantity::verified("ensemble_spread", "%", "largest relative standard deviation over the seeds");
pub(super) const HOURGLASS_SPREAD: Quantity = Quantity::verified(
    "hourglass_spread",
    "%",
    "largest less smallest run-out over the hourglass coefficients, over the mean",
);
pub(super) const EXPLICIT_STEPS: Quantity =
    Quantity::verified("explicit_steps", "-", "steps that an explicit viscous step would need");
pub(super) const REGULARISED_DIFFERENCE: Quantity =
    Quantity::verified("regularised_difference", "%", "a regularised column against the same one by return mapping");
pub(super) const SCALING_EXPONENT: Quantity =
    Quantity::validated("scaling_exponent", "-", "exponent of a power law in the aspect ratio, tall columns");
pub(super) const SCALING_CONFIDENCE: Quantity =
    Quantity::validated("scaling_confidence", "-", "half width of the exponent's 95 % interval");
pub(super) const SCALING_COEFFICIENT: Quantity =
    Quantity::validated("scaling_coefficient", "-", "coefficient of the power law");
pub(super) const BREAK_POINT: Quantity =
    Quantity::validated("break_point", "-", "aspect ratio at which the power law meets the line of shallow columns");

/// Of a column, planar or round.
pub(in crate::cases) const OF_COLUMNS: &[Quantity] = &[
    PARTICLES_LOST,
    MASS_CHANGE,
    MOMENTUM_RESIDUAL,
    RUN_OUT,
    FINAL_HEIGHT,
    STOPPING_TIME,
    KINETIC_ENERGY_SHARE,
    DEPOSIT_SLOPE_ANGLE,
    HEIGHT_BY_TOP,
    ENERGY_GAIN,
    FLOWING_LAYER_SHEAR_RATE,
    FLOWING_LAYER_R_SQUARED,
    TAIL_DECAY_LENGTH_OVER_DIAMETER,
    TAIL_DECAY_LENGTH_OVER_SPACING,
    TAIL_DECAY_LENGTH_STANDARD_ERROR,
    UNDISTURBED_SHARE,
    FAILURE_SURFACE_ANGLE,
    ENSEMBLE_MEAN,
    ENSEMBLE_STANDARD_ERROR,
    OBSERVED_ORDER,
    GRID_CONVERGENCE_INDEX,
    ENSEMBLE_SPREAD,
    HOURGLASS_SPREAD,
    EXPLICIT_STEPS,
    REGULARISED_DIFFERENCE,
    SCALING_EXPONENT,
    SCALING_CONFIDENCE,
    SCALING_COEFFICIENT,
    BREAK_POINT,
];
