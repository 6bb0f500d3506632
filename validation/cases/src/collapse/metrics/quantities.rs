//! What the collapses are judged by; those on slopes share some of it.

use crate::metric::quantities;
use crate::setup::energy_ledger;

quantities! {
    pub(crate) [energy_ledger::ENERGY_RESIDUAL, energy_ledger::ENERGY_RISE, energy_ledger::WALL_WORK, energy_ledger::CORRECTION_WORK]
    PARTICLES_LOST:
        accounted("particles_lost", "-", "particles that passed the bed, the symmetry plane or the bed's end"),
    MOMENTUM_RESIDUAL: accounted("momentum_residual", "-", "largest over the pictures of |P − J − M g t|/(M g t), Euclidean norm: momentum P, impulse J of bed, symmetry planes, gate and contacts, mass M, time t"),
    RUN_OUT: validated("run_out", "-", "(r_∞ − r_0)/r_0, counted from the initial edge; r_∞ is the front at a thickness of 0.02 r_0. Thickness is counted in rows of particles; a toe of fewer than four rows (3-D: two) is replaced by a wedge of the same volume"),
    FINAL_HEIGHT: validated("final_height", "-", "thickness of the innermost bin over r_0"),
    STOPPING_TIME: validated("stopping_time", "√(h0/g)", "time at which the front has covered 99 % of its distance"),
    REST_TIME: verified("rest_time", "s", "time at which kinetic energy falls below 5e-7 of the energy released; infinite if it does not"),
    DEPOSIT_SLOPE_ANGLE: verified("deposit_slope_angle", "°", "slope of a line through 20–80 % of the deposit"),
    FLANK_R_SQUARED: stated("flank_r_squared", "-", "R² of a straight line through the thickness over 20–80 % of the deposit"),
    HEIGHT_BY_TOP:
        verified("height_by_top", "%", "highest particle at the symmetry plane over the final height, minus 1"),
    FRONT: validated("front", "-", "position of the front at a time, over r_0; compared with other codes at a thickness of 0.05 r_0"),
    KINETIC_ENERGY: verified("kinetic_energy", "-", "kinetic energy over ½ M g h_0, at a time over √(h_0/g)"),
    ENERGY_GAIN:
        accounted("energy_gain", "%", "largest rise of energy above its initial value, over the initial potential energy"),
    FLOWING_LAYER_R_SQUARED: stated("flowing_layer_r_squared", "-", "R² of a straight line through the velocity of the flowing layer over height"),
    ENSEMBLE_FLOWING_LAYER_R_SQUARED: stated("ensemble_flowing_layer_r_squared", "-", "R² of a straight line through the velocity of the flowing layer over height, mean over the seeds"),
    FASTEST_HEIGHT:
        stated("fastest_height", "-", "height of the fastest row of particles at the column's edge in mid-collapse, over that of the surface"),
    LINEAR_MISFIT_RATIO: stated(
        "linear_misfit_ratio", "-",
        "rms misfit of a straight line through the flowing layer's velocity over that of the better of Bagnold's profile and a parabola, of two constants each",
    ),
    TAIL_DECAY_LENGTH_OVER_SPACING:
        validated("tail_decay_length_over_spacing", "-", "decay length of the velocity below the flowing layer, over the particle spacing"),
    SURFACE_DISTANCE:
        validated("surface_distance", "%", "√⟨(h − h_measured)²⟩ of the deposit over the initial height"),
    FAILURE_LINE_DISTANCE:
        validated("failure_line_distance", "%", "√⟨(l − l_measured)²⟩ of the undisturbed length, row by row, over r_0"),
    RUN_OUT_RATIO: validated("run_out_ratio", "-", "run-out over the measured one of the same aspect ratio"),
    MEDIAN_RUN_OUT_RATIO: validated("median_run_out_ratio", "-", "run-out over the measured one, median over the aspect ratios"),
    UNDISTURBED_SHARE: validated("undisturbed_share", "%", "share of the grains that is not displaced"),
    FAILURE_SURFACE_ANGLE: validated("failure_surface_angle", "°", "slope of the surface of the undisturbed grains"),
    ENSEMBLE_RUN_OUT: validated("ensemble_run_out", "-", "mean run-out over the seeds against the law of the same grains"),
    OBSERVED_ORDER: verified("observed_order", "-", "order of convergence of the three finest means"),
    GRID_CONVERGENCE_INDEX: verified("grid_convergence_index", "%", "grid convergence index of the finest mean"),
    HOURGLASS_SPREAD: verified(
        "hourglass_spread", "%",
        "range of a result over the hourglass coefficients, over its mean",
    ),
    EXPLICIT_STEPS: verified("explicit_steps", "-", "steps that an explicit viscous step would need"),
    REGULARISED_DIFFERENCE:
        verified("regularised_difference", "%", "difference between a regularised column and one by return mapping"),
    FAST_UPSTREAM_RATIO:
        stated("fast_upstream_ratio", "-", "fast grains at the surface within the initial half width, at a second time over those at a first"),
    TOP_DISTORTION:
        stated("top_distortion", "%", "root mean square of the displacements of the upper quarter less their mean, over r_0"),
    FOOT_VELOCITY_RATIO:
        stated("foot_velocity_ratio", "-", "velocity of the lowest row near the front in mid-collapse over that of the fastest row there"),
    EDDY_CHANGE: stated("eddy_change", "%", "relative change of a result by an eddy viscosity"),
    EDDY_GAIN: stated("eddy_gain", "%", "reduction of the distance to Lube's law by an eddy viscosity, over the law"),
    PRESSURE_NOISE_RATIO: stated("pressure_noise_ratio", "-",
        "√⟨(p − p_neighbours)²⟩ in mid-collapse without the coupling (27), over its value with the coupling"),
    VELOCITY_NOISE_RATIO: stated("velocity_noise_ratio", "-", "√⟨(u − u_neighbours)²⟩ over the mean speed in mid-collapse without the coupling (27), over its value with the coupling"),
    SCALING_EXPONENT: validated("scaling_exponent", "-", "exponent of a power law in the aspect ratio, tall columns"),
    SCALING_CONFIDENCE: validated("scaling_confidence", "-", "half width of the exponent's 95 % interval"),
    BREAK_POINT: validated("break_point", "-", "aspect ratio at which the power law meets the line of shallow columns"),
}

// of collapses on slopes only
quantities! {
    shared pub(crate)
    FRONT_DISPLACEMENT: validated("front_displacement", "m", "distance from the gate to the front of the deposit"),
}
