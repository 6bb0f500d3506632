//! What the collapses are judged by; those on slopes share some of it.

use crate::metric::quantities;
use crate::setup::energy_ledger;

quantities! {
    pub(crate) [energy_ledger::ENERGY_RESIDUAL, energy_ledger::ENERGY_RISE, energy_ledger::WALL_WORK, energy_ledger::CORRECTION_WORK]
    PARTICLES_LOST:
        accounted("particles_lost", "-", "particles that passed the bed, the symmetry plane or the bed's end"),
    MOMENTUM_RESIDUAL: accounted("momentum_residual", "-", "momentum less what gravity and the walls gave, over M g t"),
    RUN_OUT: validated("run_out", "-", "front of the deposit, or another measure of its extent, less r_0, over r_0"),
    FINAL_HEIGHT: validated("final_height", "-", "thickness of the innermost bin over r_0"),
    STOPPING_TIME: validated("stopping_time", "√(h0/g)", "time of 99 % of the front's way"),
    REST_TIME: verified("rest_time", "s", "when the kinetic energy had fallen to 5e-7 of the energy released; infinite for never"),
    DEPOSIT_SLOPE_ANGLE: verified("deposit_slope_angle", "°", "slope of a line through 20–80 % of the deposit"),
    FLANK_R_SQUARED: stated("flank_r_squared", "-", "share of the variance of the thickness over 20–80 % of the deposit that a line explains"),
    HEIGHT_BY_TOP:
        verified("height_by_top", "%", "highest particle beside the symmetry plane over the final height, less 1"),
    FRONT: validated("front", "-", "place of the front at a time, over r_0; beside other codes at a thickness of 0.05 r_0"),
    KINETIC_ENERGY: verified("kinetic_energy", "-", "kinetic energy over ½ M g h_0, at a time over √(h_0/g)"),
    ENERGY_GAIN:
        accounted("energy_gain", "%", "largest excess of the energy over that of the start, over the potential one"),
    FLOWING_LAYER_SHEAR_RATE:
        validated("flowing_layer_shear_rate", "1/s", "slope of a line through the flowing layer's velocity"),
    FLOWING_LAYER_R_SQUARED: stated("flowing_layer_r_squared", "-", "share of the variance of the flowing layer's velocity that a straight line over the height explains"),
    ENSEMBLE_FLOWING_LAYER_R_SQUARED: stated("ensemble_flowing_layer_r_squared", "-", "share of the variance of the flowing layer's velocity that a straight line over the height explains, mean over the seeds"),
    FASTEST_HEIGHT:
        stated("fastest_height", "-", "height of the fastest row of particles at the column's edge in mid-collapse, over that of the surface"),
    LINEAR_MISFIT_RATIO: stated(
        "linear_misfit_ratio", "-",
        "rms misfit of a straight line through the flowing layer's velocity over that of the better of Bagnold's profile and a parabola, of two constants each",
    ),
    TAIL_DECAY_LENGTH_OVER_DIAMETER: validated(
        "tail_decay_length_over_diameter", "-",
        "length over which the velocity below the flowing layer decays, over the grain diameter",
    ),
    TAIL_DECAY_LENGTH_OVER_SPACING:
        validated("tail_decay_length_over_spacing", "-", "length over which the velocity below the flowing layer decays, over the particle spacing"),
    TAIL_DECAY_LENGTH_STANDARD_ERROR: validated("tail_decay_length_standard_error", "spacings", "standard error of the length over which the velocity below the flowing layer decays"),
    SURFACE_DISTANCE:
        validated("surface_distance", "%", "root mean square of the deposit's thickness less the measured one, over the initial height"),
    FAILURE_LINE_DISTANCE:
        validated("failure_line_distance", "%", "root mean square of the length that did not move less the measured one, row by row, over r_0"),
    RUN_OUT_RATIO: validated("run_out_ratio", "-", "run-out over the measured one of the same aspect ratio"),
    MEDIAN_RUN_OUT_RATIO: validated("median_run_out_ratio", "-", "run-out over the measured one, median over the aspect ratios"),
    UNDISTURBED_SHARE: validated("undisturbed_share", "%", "part of the grains that stays in its place"),
    FAILURE_SURFACE_ANGLE: validated("failure_surface_angle", "°", "slope of the surface of what stays in its place"),
    ENSEMBLE_RUN_OUT: validated("ensemble_run_out", "-", "mean run-out over the seeds against the law of the same grains"),
    ENSEMBLE_MEAN: verified("ensemble_mean", "-", "mean over the seeds"),
    ENSEMBLE_STANDARD_ERROR: verified("ensemble_standard_error", "-", "standard error of the mean over the seeds"),
    OBSERVED_ORDER: verified("observed_order", "-", "order of convergence of the three finest means"),
    GRID_CONVERGENCE_INDEX: verified("grid_convergence_index", "%", "what the finest mean may be off by"),
    ENSEMBLE_SPREAD: verified("ensemble_spread", "%", "largest relative standard deviation over the seeds"),
    HOURGLASS_SPREAD: verified(
        "hourglass_spread", "%",
        "largest less smallest of a result over the hourglass coefficients, over the mean",
    ),
    EXPLICIT_STEPS: verified("explicit_steps", "-", "steps that an explicit viscous step would need"),
    REGULARISED_DIFFERENCE:
        verified("regularised_difference", "%", "a regularised column against the same one by return mapping"),
    FAST_UPSTREAM_RATIO:
        stated("fast_upstream_ratio", "-", "fast grains at the surface within the initial half width, at a second time over those at a first"),
    TOP_DISTORTION:
        stated("top_distortion", "%", "root mean square of the displacements of the upper quarter less their mean, over r_0"),
    FOOT_VELOCITY_RATIO:
        stated("foot_velocity_ratio", "-", "velocity of the lowest row near the front in mid-collapse over that of the fastest row there"),
    EDDY_CHANGE: stated("eddy_change", "%", "by how much an eddy viscosity moves a result"),
    EDDY_GAIN: stated("eddy_gain", "%", "how much nearer to Lube's law an eddy viscosity brings the run-out, of that law"),
    PRESSURE_NOISE_RATIO: stated("pressure_noise_ratio", "-",
        "pressure of particles less their neighbours' in mid-collapse, root mean square, without the coupling (27) over that with it"),
    VELOCITY_NOISE_RATIO: stated("velocity_noise_ratio", "-", "velocity of particles less their neighbours' over the mean speed in mid-collapse, root mean square, without the coupling (27) over that with it"),
    SCALING_EXPONENT: validated("scaling_exponent", "-", "exponent of a power law in the aspect ratio, tall columns"),
    SCALING_CONFIDENCE: validated("scaling_confidence", "-", "half width of the exponent's 95 % interval"),
    SCALING_COEFFICIENT: validated("scaling_coefficient", "-", "coefficient of the power law"),
    BREAK_POINT: validated("break_point", "-", "aspect ratio at which the power law meets the line of shallow columns"),
}

// of collapses on slopes only
quantities! {
    shared pub(crate)
    FRONT_DISPLACEMENT: validated("front_displacement", "m", "the front's way from the gate to the end of the deposit"),
}
