//! What the runs are measured by: every quantity, once.

use crate::channel;
use crate::metric::quantities;

quantities! {
    [channel::PARTICLES_LOST, channel::VELOCITY_ITERATIONS, channel::PRESSURE_ITERATIONS, channel::MOMENTUM_RESIDUAL, channel::VELOCITY_DRIFT]
    TRANSPORT: validated("transport", "-", "q*, the rate of bed load in units of √((s − 1) g d³)"),
    PREDICTED_TRANSPORT: validated("predicted_transport", "-", "q* of grains that dilate, whose closures are not fitted to transport"),
    TRANSPORT_RATIO:
        verified("transport_ratio", "-", "q* over q* of the 1-D layer, or of the formula on the validation slope"),
    STREAM_VELOCITY:
        verified("stream_velocity", "-", "mean velocity of the water above the bed over that of the logarithmic law of a rough bed"),
    FORGETS_START: verified(
        "forgets_start", "-",
        "mean stream velocity: difference between runs from two starts, over that of the starts",
    ),
    END_TIME: verified("end_time", "s", "end time of the printed set-up"),
    HIGHEST_PARTICLE: verified("highest_particle", "h", "greatest height of a particle of the printed set-up"),
    LAST_TRANSPORT: validated("last_transport", "-", "q* at the end of the printed set-up"),
    DECAY_LENGTH: verified(
        "decay_length", "mm",
        "e-folding length of the grain velocity below the top of the bed",
    ),
    MOVES_ABOVE: verified("moves_above", "mm", "lowest height at which grains are faster than 1 cm/s"),
    GRAIN_CURVATURE_ABOVE:
        stated("grain_curvature_above", "u_*/d²", "curvature of the grains' profile above the top of the bed"),
    GRAIN_CURVATURE_BELOW: stated("grain_curvature_below", "u_*/d²", "curvature of the grains' profile below the top of the bed"),
    DRAG_PEAK_HEIGHT: verified("drag_peak_height", "mm", "height of the largest drag on the grains"),
    DRAG_TOP_RATIO: stated("drag_top_ratio", "-", "drag on the topmost row of grains over the drag on the row below"),
    DRAG_RATIO: verified("drag_ratio", "-", "drag on the grains over the drag in the 1-D layer"),
    FLUID_VELOCITY_RMS:
        verified("fluid_velocity_rms", "u_*", "√⟨(u_f − u_layer)²⟩ over the depth"),
    FLUID_VELOCITY_MEAN:
        verified("fluid_velocity_mean", "-", "depth-averaged water velocity over that of the 1-D layer"),
    GRAIN_VELOCITY_RMS:
        verified("grain_velocity_rms", "u_*", "√⟨(u_s − u_layer)²⟩ over the moving grains"),
    HELD_OUT_TRANSPORT_RATIO:
        validated("held_out_transport_ratio", "-", "q* over q* of the formula on the validation slope"),
    FITTED_YIELD_STRESS: verified("fitted_yield_stress", "Pa", "yield stress that fits the other slopes"),
    FITTED_VISCOSITY: verified("fitted_viscosity", "Pa·s", "plastic viscosity that fits the other slopes"),
    FIT_MISFIT: verified("fit_misfit", "-", "root mean square of ln(q*/q* of the formula) on the fitted slopes"),
    FIT_AT_BORDER: verified("fit_at_border", "-", "1 where a fit lies on the border of the grid"),
    SEMI_LOG_SLOPE: verified(
        "semi_log_slope", "-",
        "slope of the water's velocity over ln(z + z_0) in a range of heights, over u_*/κ",
    ),
    LAYER_SLOPE_RATIO: stated("layer_slope_ratio", "-", "slope of the water's velocity over ln z next to the bed over that of the outer flow, over the same ratio above the same bed at rest"),
    NEAR_BED_DEFICIT:
        stated("near_bed_deficit", "u_*", "water velocity half a grain above the bed minus the velocity over the same bed with all grains fixed"),
    RELATIVE_DEFICIT: stated("relative_deficit", "u_*", "near-bed deficit minus outer deficit"),
    OUTER_DEFICIT: stated("outer_deficit", "u_*", "water velocity at half the depth minus the velocity over the same bed with all grains fixed"),
    SHEARED_UP_TO: verified("sheared_up_to", "mm", "upper border of the layer that the moving grains shear"),
    SHEARED_FROM: verified("sheared_from", "mm", "lower border of the layer that the moving grains shear"),
    NUMBER_OF_LAYERS: stated("number_of_layers", "-", "layers of different semi-logarithmic slope"),
    LAYER_SLOPE: verified("layer_slope", "-", "slope of a layer, over u_*/κ"),
    LAYER_BORDER: verified("layer_border", "d", "height between a layer and the next"),
    TRANSPORT_GROWTH: stated("transport_growth", "-", "q* on the steeper slope over that on the gentler"),
    SHEARED_THICKNESS_GROWTH: stated("sheared_thickness_growth", "-", "thickness of the sheared layer on the steeper slope over that on the gentler"),
}
