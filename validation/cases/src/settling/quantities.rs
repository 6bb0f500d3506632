//! What the case measures.

use crate::metric::quantities;

quantities! {
    []
    TERMINAL_VELOCITY_ERROR:
        verified("terminal_velocity_error", "%", "slip that the drag is taken from over that of a grain alone, less 1"),
    SLIP_OF_MEANS_ERROR: verified("slip_of_means_error", "%", "|⟨u_f⟩ − u_s| over the root of the balance, less 1"),
    ROOT_MEAN_SQUARE_SLIP_ERROR:
        verified("root_mean_square_slip_error", "%", "√⟨|u_f − u_s|²⟩ over the root of the balance, less 1"),
    SLIP_ERROR: verified("slip_error", "%", "slip of a suspension over the root, less 1"),
    SINKING_ERROR: verified("sinking_error", "%", "velocity at which a suspension sinks over the root's, less 1"),
    SINKING_OVER_RICHARDSON_ZAKI:
        validated("sinking_over_richardson_zaki", "-", "velocity at which a suspension sinks over Richardson and Zaki's"),
    SINKING_OVER_MEASURED:
        validated("sinking_over_measured", "-", "velocity at which a law lets a dense suspension of beads sink over the measured one"),
    DEPOSIT_RISE_OVER_MEASURED:
        validated("deposit_rise_over_measured", "-", "velocity at which their deposit then rises over the measured one"),
    UNEVENNESS: verified("unevenness", "%", "scatter of the grains' velocities over the slip"),
    DRAG_CURVE_ERROR: validated(
        "drag_curve_error", "%", "largest deviation of a law's drag of one sphere from the standard drag curve",
    ),
    LAW_SLIP_ERROR:
        verified("law_slip_error", "%", "largest deviation of a law's slip from that of the printed law"),
    MOMENTUM_ERROR:
        accounted("momentum_error", "-", "what does not close of a step's momentum, over the grains' weight"),
}
