//! Quantities of the case.

use crate::metric::quantities;

quantities! {
    []
    STEADY_VELOCITY_ERROR: verified("steady_velocity_error", "%", "surface velocity of the steady flow over I P h/(2η), minus 1"),
    CONSOLIDATION_ERROR:
        verified("consolidation_error", "%", "L2 error of the pore pressure against Terzaghi's series, over the L2 norm of the series"),
    OBSERVED_ORDER: verified("observed_order", "-", "order of convergence of the consolidation with the height of a cell"),
    TABLE_DEVIATION:
        verified("table_deviation", "-", "largest deviation from an independent implementation, over the allowed deviation"),
    MASS_ERROR: accounted("mass_error", "-", "largest change of the volume of grains, over their volume"),
    MOMENTUM_ERROR:
        accounted("momentum_error", "-", "largest imbalance of pressures or shear stress against the weight, over the weight on the floor"),
    WATER_ERROR: accounted("water_error", "-", "largest inflow of water by the surface minus growth of the pores, over that growth"),
    ONSET_TIME: validated("onset_time", "s", "time from tilting until the surface moves at 0.1 mm/s"),
    ACCELERATION_TIME: validated("acceleration_time", "s", "time from tilting until the surface moves at 0.3 mm/s"),
    ONSET_GROWTH: validated("onset_growth", "-", "onset time over that of the next looser layer, smallest of the dense layers"),
    END_VELOCITY: validated("end_velocity", "mm/s", "surface velocity at the end of the measured curve"),
    EARLY_PRESSURE: validated("early_pressure", "Pa", "excess pore pressure at the floor 20 s after tilting"),
    END_PRESSURE: validated("end_pressure", "Pa", "excess pore pressure at the floor at the end of the measured curve"),
    DRAINED_FRACTION:
        validated("drained_fraction", "-", "final solid fraction from the measured pore pressure by Darcy's law"),
}
