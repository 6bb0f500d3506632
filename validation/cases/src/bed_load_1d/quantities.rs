//! Quantities of the case.

use crate::metric::quantities;
use crate::shared::printed_laws;

quantities! {
    [printed_laws::LAW_ERROR]
    VELOCITY_DEFICIT: stated(
        "velocity_deficit", "u_*",
        "water velocity at a height minus the velocity over the same bed with all grains fixed",
    ),
    LAYER_SLOPE_RATIO: stated(
        "layer_slope_ratio", "-",
        "slope du/d(ln z) of the water from 0.5 to 3 mm above the bed, over the slope above the same bed with all grains fixed",
    ),
    FRACTION_DIFFERENCE: validated("fraction_difference", "-", "√⟨(φ − φ_published)²⟩ over the published heights"),
    GRAIN_VELOCITY_DIFFERENCE: validated(
        "grain_velocity_difference", "%",
        "√⟨(u_s − u_published)²⟩ over the largest published velocity",
    ),
    FLUID_VELOCITY_DIFFERENCE:
        validated("fluid_velocity_difference", "%", "√⟨(u_f − u_published)²⟩ over the largest published velocity"),
    TURBULENT_STRESS_DIFFERENCE: validated(
        "turbulent_stress_difference", "%",
        "√⟨(τ_f − τ_published)²⟩ over the bed stress",
    ),
    ROWS_IN_MOTION: stated("rows_in_motion", "-", "number of packed rows formed by all grains faster than 1 cm/s"),
    POWER_LAW_MISFIT_RATIO: stated(
        "power_law_misfit_ratio", "-",
        "rms misfit of the water's velocity among moving grains to a power of the height over that to its logarithm",
    ),
    POWER_LAW_MISFIT: stated("power_law_misfit", "%", "rms misfit of the water's velocity among moving grains to a power of the height, over the largest velocity there"),
    LOWEST_LAYER_EXPONENT: validated("lowest_layer_exponent", "-", "exponent of the power of the height that fits the water's velocity in the lowest layer"),
    TRANSPORT_OVER_MEASURED: validated(
        "transport_over_measured", "-",
        "q* over the median of measured runs at nearly equal Shields number",
    ),
    DUCT_VELOCITY_DIFFERENCE: validated(
        "duct_velocity_difference", "%",
        "√⟨(u_f − u_published)²⟩ over the largest published velocity, heights from the level below which grains rest",
    ),
    TRANSPORT_RATIO: validated("transport_ratio", "-", "q* over q* of the formula or of a published layer"),
    MEAN_FLUID_VELOCITY: verified("mean_fluid_velocity", "m/s", "depth mean of the water's velocity"),
    STRESS_BALANCE_ERROR: verified("stress_balance_error", "-", "largest imbalance of the stresses of both phases with the weight component above, over the bed stress"),
    DRAG_BALANCE_ERROR:
        verified("drag_balance_error", "-", "largest imbalance of drag, grain stress and grain weight, over the bed stress"),
    START_DIFFERENCE:
        verified("start_difference", "-", "difference between the steady states from rest and from a fast start"),
    OBSERVED_ORDER: verified("observed_order", "-", "order of convergence with the height of a cell"),
    MOVES_ABOVE: verified("moves_above", "mm", "lowest height at which grains are faster than 1 cm/s"),
    TOP_OF_GRAINS: verified("top_of_grains", "mm", "height up to which there are grains"),
    DECAY_LENGTH: verified("decay_length", "mm", "e-folding length of the grain velocity in the bed"),
    GRAIN_CURVATURE: stated("grain_curvature", "u_*/d²", "curvature of the grains' velocity over the height, above or below the bed's level"),
    DRAG_PEAK_HEIGHT: verified("drag_peak_height", "mm", "height of the largest drag on the grains"),
    DRAG_FROM: verified("drag_from", "mm", "lower end of the range in which the drag on the grains exceeds a tenth of its peak"),
    DRAG_TO: verified("drag_to", "mm", "upper end of the range in which the drag on the grains exceeds a tenth of its peak"),
    LOGARITHMIC_SLOPE:
        stated("logarithmic_slope", "-", "slope of the water's velocity over ln z in a range of heights, over u_*/κ"),
    MOTION_DEPTH_GROWTH:
        stated("motion_depth_growth", "-", "least ratio of the depth of motion from a slope to the next"),
    DECAY_LENGTH_GROWTH: stated("decay_length_growth", "-", "least ratio of the decay length from a slope to the next"),
    DRAG_DEPTH_GROWTH: stated("drag_depth_growth", "-", "least ratio, from a slope to the next, of the depth down to which the drag exceeds a tenth of its peak"),
    ONSET_OVER_MEASURED:
        validated("onset_over_measured", "-", "Shields number at the onset of motion over the median of thresholds measured with grains of this size"),
}
