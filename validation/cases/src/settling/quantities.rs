//! What the case measures.

use crate::metric::quantities;

quantities! {
    []
    TERMINAL_VELOCITY_ERROR:
        verified("terminal_velocity_error", "%", "slip velocity that enters the drag, over the exact slip of a single grain, minus 1"),
    SLIP_OF_MEANS_ERROR: verified("slip_of_means_error", "%", "|⟨u_f⟩ − u_s| over the exact slip, minus 1"),
    ROOT_MEAN_SQUARE_SLIP_ERROR:
        verified("root_mean_square_slip_error", "%", "√⟨|u_f − u_s|²⟩ over the exact slip, minus 1"),
    SLIP_ERROR: verified("slip_error", "%", "slip of a suspension over the exact slip, minus 1"),
    SINKING_ERROR: verified("sinking_error", "%", "settling velocity of a suspension over the exact one, minus 1"),
    SINKING_OVER_RICHARDSON_ZAKI:
        validated("sinking_over_richardson_zaki", "-", "settling velocity of a suspension over that of Richardson & Zaki"),
    SINKING_OVER_MEASURED:
        validated("sinking_over_measured", "-", "settling velocity of a dense suspension of beads by a drag law, over the measured velocity"),
    DEPOSIT_RISE_OVER_MEASURED:
        validated("deposit_rise_over_measured", "-", "rise velocity of the deposit of these beads by a drag law, over the measured velocity"),
    UNEVENNESS: verified("unevenness", "%", "scatter of the grains' velocities over the slip"),
    DRAG_CURVE_ERROR: validated(
        "drag_curve_error", "%", "largest deviation of a law's drag of one sphere from the standard drag curve",
    ),
    LAW_SLIP_ERROR:
        verified("law_slip_error", "%", "largest deviation of a law's slip from that of the printed law"),
    MOMENTUM_ERROR:
        accounted("momentum_error", "-", "momentum imbalance of a step, over the weight of the grains"),
}
