//! What the runs are measured by: every quantity, once.

use crate::cases::channel;
use crate::metric::Quantity;

pub(super) const TRANSPORT: Quantity =
    Quantity::validated("transport", "-", "q*, the rate of bed load in units of √((s − 1) g d³)");
pub(super) const TRANSPORT_RATIO: Quantity = Quantity::verified(
    "transport_ratio",
    "-",
    "q* over that of the 1-D layer, or of the formula on the slope held out",
);
pub(super) const STREAM_VELOCITY: Quantity =
    Quantity::verified("stream_velocity", "-", "mean velocity of the water above the bed over that of clear water");
pub(super) const END_TIME: Quantity = Quantity::verified("end_time", "s", "when the printed set-up ended");
pub(super) const HIGHEST_PARTICLE: Quantity =
    Quantity::verified("highest_particle", "h", "greatest height of a particle of the printed set-up");
pub(super) const LAST_TRANSPORT: Quantity =
    Quantity::validated("last_transport", "-", "q* where the printed set-up ended");
pub(super) const DECAY_LENGTH: Quantity = Quantity::verified(
    "decay_length",
    "mm",
    "length over which the velocity of the grains falls by e below the top of the bed",
);
pub(super) const MOVES_ABOVE: Quantity =
    Quantity::verified("moves_above", "mm", "lowest height at which grains are faster than 1 cm/s");
pub(super) const GRAIN_CURVATURE_ABOVE: Quantity =
    Quantity::validated("grain_curvature_above", "u_*/d²", "curvature of the grains' profile above the top of the bed");
pub(super) const GRAIN_CURVATURE_BELOW: Quantity =
    Quantity::validated("grain_curvature_below", "u_*/d²", "the same below it");
pub(super) const DRAG_PEAK_HEIGHT: Quantity =
    Quantity::verified("drag_peak_height", "mm", "where the drag on the grains is greatest");
pub(super) const FLUID_VELOCITY_RMS: Quantity =
    Quantity::verified("fluid_velocity_rms", "u_*", "root mean square of the water's velocity less the 1-D layer's");
pub(super) const FLUID_VELOCITY_MEAN: Quantity =
    Quantity::verified("fluid_velocity_mean", "-", "depth mean of the water's velocity over the 1-D layer's");
pub(super) const GRAIN_VELOCITY_RMS: Quantity =
    Quantity::verified("grain_velocity_rms", "u_*", "root mean square of the grains' velocity less the 1-D layer's");
pub(super) const HELD_OUT_TRANSPORT_RATIO: Quantity =
    Quantity::validated("held_out_transport_ratio", "-", "q* over the formula's on a slope held out of the fits");
pub(super) const FITTED_YIELD_STRESS: Quantity =
    Quantity::verified("fitted_yield_stress", "Pa", "yield stress that fits the other slopes");
pub(super) const FITTED_VISCOSITY: Quantity =
    Quantity::verified("fitted_viscosity", "Pa·s", "plastic viscosity that fits the other slopes");
pub(super) const FIT_MISFIT: Quantity =
    Quantity::verified("fit_misfit", "-", "root mean square of ln(q*/q* of the formula) on the fitted slopes");
pub(super) const FIT_AT_BORDER: Quantity =
    Quantity::verified("fit_at_border", "-", "1 where a fit lies on the border of the grid");
pub(super) const SEMI_LOG_SLOPE: Quantity = Quantity::verified(
    "semi_log_slope",
    "-",
    "slope of the water's velocity over ln(z + z_0) in a range of heights, over u_*/κ",
);
pub(super) const LAYER_SLOPE_RATIO: Quantity =
    Quantity::validated("layer_slope_ratio", "-", "that slope next to the bed over that of the outer flow");
pub(super) const NEAR_BED_DEFICIT: Quantity = Quantity::validated(
    "near_bed_deficit",
    "u_*",
    "velocity of the water less clear water's half a grain above the bed",
);
pub(super) const OUTER_DEFICIT: Quantity = Quantity::validated("outer_deficit", "u_*", "the same at half the depth");
pub(super) const SHEARED_UP_TO: Quantity =
    Quantity::verified("sheared_up_to", "mm", "upper border of the layer that the moving grains shear");
pub(super) const SHEARED_FROM: Quantity = Quantity::verified("sheared_from", "mm", "its lower border");
pub(super) const NUMBER_OF_LAYERS: Quantity =
    Quantity::validated("number_of_layers", "-", "layers of different semi-logarithmic slope");
pub(super) const LAYER_SLOPE: Quantity = Quantity::verified("layer_slope", "-", "slope of a layer, over u_*/κ");
pub(super) const LAYER_BORDER: Quantity =
    Quantity::verified("layer_border", "d", "height between a layer and the next");
pub(super) const TRANSPORT_GROWTH: Quantity =
    Quantity::validated("transport_growth", "-", "q* on the steeper slope over that on the gentler");
pub(super) const SHEARED_THICKNESS_GROWTH: Quantity =
    Quantity::validated("sheared_thickness_growth", "-", "thickness of the sheared layer likewise");

pub(super) const ALL: &[Quantity] = &[
    channel::PARTICLES_LOST,
    channel::MOMENTUM_RESIDUAL,
    channel::VELOCITY_DRIFT,
    TRANSPORT,
    TRANSPORT_RATIO,
    STREAM_VELOCITY,
    END_TIME,
    HIGHEST_PARTICLE,
    LAST_TRANSPORT,
    DECAY_LENGTH,
    MOVES_ABOVE,
    GRAIN_CURVATURE_ABOVE,
    GRAIN_CURVATURE_BELOW,
    DRAG_PEAK_HEIGHT,
    FLUID_VELOCITY_RMS,
    FLUID_VELOCITY_MEAN,
    GRAIN_VELOCITY_RMS,
    HELD_OUT_TRANSPORT_RATIO,
    FITTED_YIELD_STRESS,
    FITTED_VISCOSITY,
    FIT_MISFIT,
    FIT_AT_BORDER,
    SEMI_LOG_SLOPE,
    LAYER_SLOPE_RATIO,
    NEAR_BED_DEFICIT,
    OUTER_DEFICIT,
    SHEARED_UP_TO,
    SHEARED_FROM,
    NUMBER_OF_LAYERS,
    LAYER_SLOPE,
    LAYER_BORDER,
    TRANSPORT_GROWTH,
    SHEARED_THICKNESS_GROWTH,
];
