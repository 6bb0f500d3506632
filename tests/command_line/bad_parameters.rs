//! Parameters of cases that cannot be: exit code 2 and a message that names the field, and nothing is written.

use crate::bad_input::refused;
use crate::program::Place;

#[test]
fn a_layer_of_water_and_grains_that_cannot_be() {
    let place = Place::new();
    let cases = [
        (
            "slopes=[0.0]",
            "`slopes[0]` is 0, but must be positive and finite; give tanθ, such as 0.03; without a slope nothing flows",
        ),
        (
            "slopes=[0.02, -0.03]",
            "`slopes[1]` is -0.03, but must be positive and finite; give tanθ, such as 0.03; without a slope nothing flows",
        ),
        (
            "slopes=[0.5]",
            "`slopes[0]` is 0.5, but must be between 0 and 0.2; on steeper slopes the bed itself would slide",
        ),
        (
            "slopes=[0.03, 0.15]",
            "`slopes[1]` is 0.15, but must be for a slope below 0.10804, where the bed slides (here 0.15000); deepen the bed to more than 0.1643 m, or choose a gentler slope",
        ),
        (
            "similar.shields_number=9.0",
            "`similar.shields_number` is 9, but must be for a slope below 0.06348, where the bed slides (here 0.72000); no bed of these grains lies on such a slope: choose a gentler one",
        ),
        (
            "onset.relative_depth=12.33",
            "`onset.relative_depth` is 12.33, but must be a whole multiple of a cell; choose whole numbers",
        ),
        (
            "closures.grain_roughness.bed_roughness_fade_length=0.0",
            "`closures.grain_roughness.bed_roughness_fade_length` is 0, but must be positive and finite; a few hundredths: a layer of grains that moves has more",
        ),
        (
            "closures.largest_fraction=1.0",
            "`closures.largest_fraction` is 1, but must be between 0.1 and 0.74; grains at rest fill 0.5 to 0.64 of the space",
        ),
        (
            "closures.limiting_friction=0.3",
            "`closures.limiting_friction` is 0.3, but must be greater than the static friction; friction grows from μ_s at rest to μ_2 in fast shear",
        ),
        (
            "closures.dilation=-0.31",
            "`closures.dilation` is -0.31, but must be between 0 and 100; grains loosen in shear: give B, such as 0.31, or 0 for grains that do not",
        ),
        ("closures.karman=nan", "`closures.karman` is NaN, but must be positive and finite; give κ, 0.41"),
        ("water.depth=0.0", "`water.depth` is 0, but must be positive and finite; give it in metres, such as 0.046"),
        (
            "grains.bed_depth=-0.04",
            "`grains.bed_depth` is -0.04, but must be positive and finite; give it in metres, such as 0.04",
        ),
        (
            "grains.density=900.0",
            "`grains.density` is 900, but must be greater than the density of the water; grains that float are no bed load",
        ),
        (
            "cell_height=3e-4",
            "`cell_height` is 0.0003, but must be such that the depths of water, bed and held grains are whole multiples of it, at most 1e5 in all; 2.5e-4 divides all depths that are given in quarters of a millimetre",
        ),
    ];
    for (setting, message) in cases {
        refused(&place, &["bed-load-1d", "--set", setting], message);
    }
}

#[test]
fn grains_that_do_not_settle() {
    let place = Place::new();
    let cases = [
        (
            "grain_density=900.0",
            "`grain_density` is 900, but must be greater than the density of the water; grains that float do not settle",
        ),
        (
            "grain.diameter=-0.005",
            "`grain.diameter` is -0.005, but must be positive and finite; give it in metres; 0.005 for 5 mm",
        ),
        (
            "suspension.diameter=0.0",
            "`suspension.diameter` is 0, but must be positive and finite; give it in metres; 0.005 for 5 mm",
        ),
        (
            "suspension.solid_fractions=[0.3, 1.0]",
            "`suspension.solid_fractions[1]` is 1, but must be between 0.01 and 0.64; grains fill up to 0.64 of the space",
        ),
        (
            "suspension.dilute_fraction=0.1",
            "`suspension.dilute_fraction` is 0.1, but must be between 0 and 0.005; 0.002 hinders by less than 1 %; 0 for none",
        ),
        (
            "grain.laws=[\"ergun\"]",
            "`grain.laws[0]` is ergun, but must be a law of one grain that covers its Reynolds number; leave out \"ergun\", and \"morsi-alexander\" above R = 50 000",
        ),
        (
            "grain.columns=4",
            "`grain.columns` is 4, but must be between 8 and 1000; the box must hold the reach of the kernels twice; 12 is quick",
        ),
        (
            "numerics.velocity_tolerance=1.0",
            "`numerics.velocity_tolerance` is 1, but must be between 1e-14 and 0.1; see the default numerics with `bagnold show`",
        ),
        (
            "numerics.continuity=\"mixture\"",
            "`numerics.continuity` is mixture, but must be \"fluid\"; only suspensions share their pressure, and `settling` chooses it for them",
        ),
        (
            "numerics.mean_flux=\"zero\"",
            "`numerics.mean_flux` is zero, but must be \"free\"; only suspensions share their pressure, and `settling` chooses it for them",
        ),
        (
            "numerics.pressure_source=\"density\"",
            "`numerics.pressure_source` is density, but must be \"divergence\" with suspensions; single grains have the paper's operators by the formulation \"paper\"; or empty `suspension.laws`",
        ),
        (
            "numerics.surface=\"eliminated\"",
            "`numerics.surface` is eliminated, but must be \"completed\" with suspensions; single grains have the paper's operators by the formulation \"paper\"; or empty `suspension.laws`",
        ),
    ];
    for (setting, message) in cases {
        refused(&place, &["settling", "--set", setting], message);
    }
    refused(
        &place,
        &[
            "settling",
            "--set",
            "suspension.solid_fractions=[0.1]",
            "--set",
            "suspension.laws=[\"di-felice\", \"ergun\"]",
        ],
        "`suspension.laws[1]` is ergun, but must be a law for one of the solid fractions; \"ergun\" begins at 0.2; leave it out, or add a denser suspension",
    );
}

#[test]
fn a_start_angle_without_a_steady_flow() {
    let place = Place::new();
    for angle in ["20", "33"] {
        refused(
            &place,
            &["flow-thickness", "--set", &format!("start_angle={angle}")],
            &format!(
                "`start_angle` is {angle}, but must be between 20.90685689 and 32.74101753; trials start with a steady flow, which is between arctan μ_s and arctan μ_2 only"
            ),
        );
    }
}

#[test]
fn a_reservoir_of_too_few_or_too_many_rows() {
    let place = Place::new();
    let message = |resolution: usize, rows: usize, choice: &str| {
        format!(
            "`resolution` is {resolution}, but must be such that the reservoir is 4 to 1000 rows of particles high; its height, `initial_height` over `reservoir_length` times this, is {rows}: choose a {choice} resolution"
        )
    };
    // the field that was changed comes first
    let lowered = format!("`initial_height` is 0.01, and so {}", message(30, 1, "larger"));
    refused(&place, &["incline-collapse", "--set", "initial_height=0.01"], &lowered);
    refused(
        &place,
        &["incline-collapse", "--set", "initial_height=2.0", "--set", "resolution=900"],
        &message(900, 9000, "smaller"),
    );
}

#[test]
fn a_channel_without_a_slope() {
    let place = Place::new();
    let rule = "must be positive and at most 0.2; without a slope there is no friction velocity √(g h i); give its tangent, such as 0.03 for 3 %";
    refused(&place, &["clear-water", "--set", "slopes=[0.03, 0]"], &format!("`slopes[1]` is 0, but {rule}"));
    refused(&place, &["clear-water", "--set", "slopes=[nan]"], &format!("`slopes[0]` is NaN, but {rule}"));
    refused(&place, &["water-film", "--set", "slope=-0.03"], &format!("`slope` is -0.03, but {rule}"));
    refused(
        &place,
        &["clear-water", "--set", "slopes=[]"],
        "`slopes` is [], but must be at least one slope; 3 % is 0.03",
    );
    refused(
        &place,
        &["clear-water", "--set", "slopes=[0.03, 0.03]"],
        "`slopes[1]` is 0.03, but must be unique; name every slope once",
    );
}

#[test]
fn a_roughness_that_no_wall_has() {
    let place = Place::new();
    for (value, shown) in [("-5e-3", "-0.005"), ("0", "0"), ("inf", "inf"), ("nan", "NaN")] {
        refused(
            &place,
            &["clear-water", "--set", &format!("sand_roughness={value}")],
            &format!(
                "`sand_roughness` is {shown}, but must be positive and finite; give it in metres; about the grain diameter"
            ),
        );
    }
    refused(
        &place,
        &["clear-water", "--set", "sand_roughness=0.1"],
        "`sand_roughness` is 0.1, but must be between 0 and 0.048; the logarithmic law begins at k_s/30, which must lie below the first row of particles",
    );
}

#[test]
fn a_gate_with_operators_or_walls_that_know_no_smooth_ones() {
    let place = Place::new();
    let operators = "must be \"single-divergence\" or \"uncorrected-divergence\" with a smooth wall, such as a gate; the pairwise operators know rough walls only; choose one of these, or leave the gate out";
    let walls = "must be \"extrapolated\" with a smooth wall, such as a gate; the paper's walls are rough; choose this, or leave the gate out";
    for (field, value, rule) in [
        ("numerics.momentum_operator", "pairwise", operators),
        ("numerics.momentum_operator", "pairwise-corrected", operators),
        ("numerics.wall_treatment", "paper", walls),
    ] {
        let message = |path: &str| format!("`{path}{field}` is {value}, but {rule}");
        refused(&place, &["incline-collapse", "--set", &format!("{field}=\"{value}\"")], &message(""));
        let setting = format!("collapse.{field}=\"{value}\"");
        let slope = "collapse.slope_angles=[24.0]";
        refused(&place, &["flow-thickness", "--set", slope, "--set", &setting], &message("collapse."));
    }
}

#[test]
fn an_implicit_step_without_a_viscous_law_or_its_divergence() {
    let place = Place::new();
    let plastic = |path: &str| {
        format!(
            "`{path}numerics.viscous_step` is implicit, but must be explicit with a law by return mapping; its stress bounds no time step; regularise the law, or choose \"explicit\""
        )
    };
    for case in ["hydrostatic", "bagnold", "column-planar", "column-round", "incline-collapse"] {
        refused(&place, &[case, "--set", "numerics.viscous_step=\"implicit\""], &plastic(""));
    }
    refused(
        &place,
        &[
            "flow-thickness",
            "--set",
            "collapse.slope_angles=[24.0]",
            "--set",
            "collapse.numerics.viscous_step=\"implicit\"",
        ],
        &plastic("collapse."),
    );
    refused(
        &place,
        &["film", "--set", "numerics.viscous_step=\"implicit\"", "--set", "numerics.momentum_operator=\"pairwise\""],
        "`numerics.viscous_step` is implicit, but must be explicit with the pairwise momentum operators; choose the operator \"single-divergence\", or \"explicit\"",
    );
    // the implicit runs that a list asks for
    refused(
        &place,
        &["column-planar", "--set", "numerics.momentum_operator=\"pairwise\""],
        "`numerics.momentum_operator` is pairwise, but must be \"single-divergence\" or \"uncorrected-divergence\" with the implicit runs of `regularised.aspect_ratios`; choose one of these, or empty that list",
    );
}

#[test]
fn a_moving_bed_that_cannot_be() {
    let place = Place::new();
    let cases = [
        (
            "stabilised.slopes=[0.0]",
            "`stabilised.slopes[0]` is 0, but must be positive and at most 0.2; without a slope there is no friction velocity √(g h i); give its tangent, such as 0.03 for 3 %",
        ),
        (
            "stabilised.material.yield_stress=-5.0",
            "`stabilised.material.yield_stress` is -5, but must be finite and not negative; give the yield stress in Pa, or 0 for grains without cohesion",
        ),
        (
            "continuum.closures.largest_fraction=1.0",
            "`continuum.closures.largest_fraction` is 1, but must be between 0.1 and 0.74; grains at rest fill 0.5 to 0.64 of the space",
        ),
        (
            "materials.grain_density=900.0",
            "`materials.grain_density` is 900, but must be between 1010 and 100000; grains that float are no bed load",
        ),
        (
            "stabilised.bed_depth=0.032",
            "`stabilised.bed_depth` is 0.032, but must be a whole multiple of the grain diameter, 0.005 m; choose lengths that divide each other",
        ),
        (
            "fit.yield_stresses=[9.0]",
            "`fit.yield_stresses` is [9.0], but must be empty or two or more rising values; the fits interpolate between them",
        ),
        (
            "stabilised.averaging_time=3.0",
            "`stabilised.averaging_time` is 3, but must be between 0.05 and 1; the window lies within the run",
        ),
        (
            "stabilised.drag=\"ergun\"",
            "`stabilised.drag` is ergun, but must be a law of one grain; Ergun's is one of packed grains; `continuum` has it",
        ),
        (
            "continuum.closures.mixing_length=\"root\"",
            "`continuum.closures.mixing_length` is root, but must be integral; the particles know no other; bed-load-1d \
             compares all",
        ),
        (
            "continuum.closures.karman=0.4",
            "`continuum.closures.karman` is 0.4, but must be 0.41; the particles know no other; bed-load-1d takes any",
        ),
        (
            "continuum.closures.turbulent_schmidt=0.7",
            "`continuum.closures.turbulent_schmidt` is 0.7, but must be 0 unless all runs are `dilating`; eddies carry no grains \
             of a given fraction",
        ),
        (
            "continuum.columns.node_ratio=0.0",
            "`continuum.columns.node_ratio` is 0, but must be between 0.1 and 1; see the default numerics with `bagnold show`",
        ),
        (
            "continuum.runs=[{ stage = \"dilating\", slopes = [0.03], pair_laws = [\"pair-rate\"], starts = [1.0], spacings = \
             [0.001], duration = 1.0, averaging_time = 0.5 }]",
            "`continuum.runs[0].pair_laws` is [PairRate], but must be empty where grains dilate; they have columns instead of \
             pairs",
        ),
        (
            "continuum.closures.limiting_friction=0.3",
            "`continuum.closures.limiting_friction` is 0.3, but must be greater than the static friction; friction grows \
             from μ_s at rest to μ_2 in fast shear",
        ),
        (
            "continuum.bed_depth=0.0161",
            "`continuum.bed_depth` is 0.0161, but must be a whole multiple of a cell of the 1-D layer, 0.00025 m; choose \
             lengths that divide each other",
        ),
    ];
    for (setting, message) in cases {
        refused(&place, &["bed-load", "--set", setting], message);
    }
    let two = ["bed-load", "--tier", "fine", "--set", "fit.slopes=[0.02, 0.05]"];
    refused(
        &place,
        &two,
        "`fit.slopes` is [0.02, 0.05], but must be three or more; two are fitted for each that is held out",
    );
}

#[test]
fn a_channel_that_is_too_short_and_times_that_do_not_fit() {
    let place = Place::new();
    for case in ["still-water", "water-film", "clear-water"] {
        for columns in ["0", "4"] {
            refused(
                &place,
                &[case, "--set", &format!("columns={columns}")],
                &format!(
                    "`columns` is {columns}, but must be between 5 and 1000; the period must hold twice the reach of the kernel; 12 is quick"
                ),
            );
        }
    }
    refused(
        &place,
        &["clear-water", "--set", "period.fixed.averaging_time=2"],
        "`period.fixed.averaging_time` is 2, but must be between 0.2 and 1.5; the window lies in the second half",
    );
    refused(
        &place,
        &["still-water", "--set", "averaging_time=inf"],
        "`averaging_time` is inf, but must be of a size between 1e-12 and 1e9 s; check the number: its unit is s",
    );
    refused(
        &place,
        &["still-water", "--set", "numerics.time_step=0"],
        "`numerics.time_step` is 0, but must be between 1e-9 and 1; see the default numerics with `bagnold show`",
    );
}
