//! Rules between parameters of cases: exit code 2, a message that names the field, and nothing written. A rule of one field stands
//! in its attribute; `tests/inputs/bounds.rs` tells when it is lost.

use crate::command_line::bad_input::refused;
use crate::command_line::program::Place;

#[test]
fn a_layer_of_water_and_grains_that_cannot_be() {
    let place = Place::new();
    let cases = [
        (
            r#"stream={given="shields-number",shields_number=9.0,relative_depth=20.0,relative_bed_depth=6.0,cells_per_diameter=12.0}"#,
            "`stream.shields_number`: 9 gives the slope 0.7200, but the bed slides above 0.0635; choose a gentler slope, on which a bed of these grains is stable",
        ),
        (
            r#"stream={given="onset",relative_depth=12.33,relative_bed_depth=4.0,cells_per_diameter=10.0}"#,
            "`stream.relative_depth` is 12.33, but must be a whole multiple of a cell; give whole numbers of cells and diameters",
        ),
        (
            "grain_density=900.0",
            "`grain_density` is 900, but must be greater than the water density; give it in kg/m³; floating grains form no bed load",
        ),
        (
            "stream.cell_height=3e-4",
            "`stream.cell_height` is 0.0003, but must be a length that divides the depths of water, bed and held grains into at most 1e5 whole cells; give 2.5e-4 for depths in multiples of a quarter of a millimetre",
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
            "`grain_density` is 900, but must be greater than the fluid density; give it in kg/m³; floating grains do not settle",
        ),
        (
            "law=ergun",
            "`law` is ergun, but must be a law for a single grain of its Reynolds number; choose another law than \"ergun\", or \"morsi-alexander\" above a Reynolds number of 50 000",
        ),
        (
            "columns=4",
            "`columns` is 4, but must be between 8 and 1000; give 12 for a quick run; the box must be wider than both kernels",
        ),
        (
            "numerics.mean_flux=\"free\"",
            "`numerics.mean_flux` is free, but must be \"zero\" in a suspension; choose it, or set `numerics.continuity = \"fluid\"` for a single grain",
        ),
        (
            "numerics.pressure_source=\"density\"",
            "`numerics.pressure_source` is density, but must be \"divergence\" in a suspension; choose it, or set `numerics.continuity = \"fluid\"` for a single grain",
        ),
        (
            "numerics.surface=\"eliminated\"",
            "`numerics.surface` is eliminated, but must be \"completed\" in a suspension; choose it, or set `numerics.continuity = \"fluid\"` for a single grain",
        ),
    ];
    for (setting, message) in cases {
        refused(&place, &["settling", "--set", setting], message);
    }
    refused(
        &place,
        &["still-water", "--set", "numerics.continuity=\"mixture\""],
        "`numerics.continuity` is mixture, but must be \"fluid\"; choose it; only the suspensions of `settling` use the other",
    );
    refused(
        &place,
        &["settling", "--vary", "law=di-felice,ergun", "--set", "solid_fraction=0.1"],
        "`law` is ergun, but must be a law for this `solid_fraction`; choose another; \"ergun\" holds from 0.2 on; changed from the tier's defaults: `solid_fraction` is 0.1, `vary` is [{ path = \"law\", values = [\"di-felice\", \"ergun\"] }]",
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
                "`start_angle` is {angle}, but must be between 20.907 and 32.741; give an angle of steady flow, between arctan μ_s and arctan μ_2"
            ),
        );
    }
}

#[test]
fn a_reservoir_of_too_few_or_too_many_rows() {
    let place = Place::new();
    let message = |resolution: usize, rows: usize, choice: &str| {
        format!(
            "`resolution`: {resolution} gives a reservoir {rows} rows of particles high; allowed are 4 to 1000; {choice} it"
        )
    };
    let lowered = format!("{}; changed from the tier's defaults: `initial_height` is 0.01", message(30, 1, "raise"));
    refused(&place, &["incline-collapse", "--set", "initial_height=0.01"], &lowered);
    refused(
        &place,
        &["incline-collapse", "--set", "initial_height=2.0", "--set", "resolution=900"],
        &message(900, 9000, "reduce"),
    );
}

#[test]
fn a_channel_without_a_slope() {
    let place = Place::new();
    let rule = "must be positive and at most 0.2; give the tangent of the slope, such as 0.03 for 3 %";
    refused(&place, &["clear-water", "--vary", "slope=0.03,0"], &format!("`vary[0].slope` is 0, but {rule}"));
    refused(&place, &["clear-water", "--set", "slope=nan"], &format!("`slope` is NaN, but {rule}"));
    refused(&place, &["water-film", "--set", "slope=-0.03"], &format!("`slope` is -0.03, but {rule}"));
}

#[test]
fn a_roughness_above_the_first_row_of_particles() {
    let place = Place::new();
    refused(
        &place,
        &["clear-water", "--set", "sand_roughness=0.1"],
        "`sand_roughness` is 0.1, but must be between 0 and 0.048; reduce it: the logarithmic law begins at k_s/30, which must lie below the first row of particles",
    );
}

#[test]
fn a_gate_with_operators_or_walls_that_know_no_smooth_ones() {
    let place = Place::new();
    let operators = "must be \"single-divergence\" or \"uncorrected-divergence\" with a smooth wall, such as a gate; the pairwise operators support rough walls only; choose one of these, or leave the gate out";
    let walls = "must be \"extrapolated\" with a smooth wall, such as a gate; the paper's walls are always rough; choose \"extrapolated\", or leave the gate out";
    for (field, value, rule) in [
        ("numerics.momentum_operator", "pairwise", operators),
        ("numerics.momentum_operator", "pairwise-corrected", operators),
        ("numerics.wall_treatment", "paper", walls),
    ] {
        let message = format!("`{field}` is {value}, but {rule}");
        refused(&place, &["incline-collapse", "--set", &format!("{field}=\"{value}\"")], &message);
    }
}

#[test]
fn an_implicit_step_without_a_viscous_law_or_its_divergence() {
    let place = Place::new();
    let plastic = "`numerics.viscous_step` is implicit, but must be explicit with an elastoplastic law; choose \"explicit\", or a regularised law";
    for case in ["hydrostatic", "bagnold", "flow-thickness", "column-planar", "column-round", "incline-collapse"] {
        refused(&place, &[case, "--set", "numerics.viscous_step=\"implicit\""], plastic);
    }
    refused(
        &place,
        &["film", "--set", "numerics.viscous_step=\"implicit\"", "--set", "numerics.momentum_operator=\"pairwise\""],
        "`numerics.viscous_step` is implicit, but must be explicit with the pairwise momentum operators; choose the operator \"single-divergence\", or \"explicit\"",
    );
    // the implicit run of the list
    refused(
        &place,
        &["column-planar", "--set", "numerics.momentum_operator=\"pairwise\""],
        "`numerics.viscous_step` is implicit, but must be explicit with the pairwise momentum operators; choose the operator \"single-divergence\", or \"explicit\"; changed from the tier's defaults: `numerics.momentum_operator` is \"pairwise\"",
    );
}

#[test]
fn a_value_of_all_runs_that_one_of_the_list_does_not_bear() {
    let place = Place::new();
    let rule = "`material.limiting_friction` is 0.6, but must be finite and at least `static_friction`; give the friction of fast flow, or `static_friction` itself for a law without rate dependence";
    let setting = "material.static_friction=0.8";
    let message = format!("{rule}; changed from the tier's defaults: `material.static_friction` is 0.8");
    refused(&place, &["column-planar", "--set", setting], &message);
    // the angle stands for the coefficient
    let told = place.run(&["column-planar", "--set", "material.friction_angle=40"]).code(2);
    let told = String::from_utf8_lossy(&told.get_output().stderr).into_owned();
    assert!(told.contains(rule), "{told}");
}

#[test]
fn a_moving_bed_that_cannot_be() {
    let place = Place::new();
    let cases = [
        (
            "slope=0.0",
            "`slope` is 0, but must be positive and at most 0.2; give the tangent of the slope, such as 0.03 for 3 %",
        ),
        (
            "particles.bed_depth=0.032",
            "`particles.bed_depth` is 0.032, but must be a whole multiple of the grain diameter, 0.005 m; choose lengths that divide each other",
        ),
        (
            "averaging_time=3.0",
            "`averaging_time` is 3, but must be between 0.05 and 1; shorten the averaging window, or lengthen `duration`",
        ),
        (
            "particles.drag=\"ergun\"",
            "`particles.drag` is ergun, but must be a law for single grains; choose another; `continuum` has Ergun's law",
        ),
        (
            "continuum.closures.mixing_length=\"root\"",
            "`continuum.closures.mixing_length` is root, but must be integral; choose it: the particle model has only this one; bed-load-1d \
             compares all",
        ),
        (
            "continuum.closures.karman=0.4",
            "`continuum.closures.karman` is 0.4, but must be 0.41; give it: the particle model has this constant; bed-load-1d accepts others",
        ),
        (
            "continuum.closures.limiting_friction=0.3",
            "`continuum.closures.limiting_friction` is 0.3, but must be greater than the static friction; raise it: friction grows \
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
    // only runs of the paper tier have grains of a given fraction
    let schmidt = ["bed-load", "--tier", "paper", "--set", "continuum.closures.turbulent_schmidt=0.7"];
    let message = "`continuum.closures.turbulent_schmidt` is 0.7, but must be 0 unless grains dilate; give 0: eddies do not \
                   disperse other grains";
    refused(&place, &schmidt, message);
}

#[test]
fn a_channel_that_is_too_short_and_times_that_do_not_fit() {
    let place = Place::new();
    for case in ["water-film", "clear-water"] {
        refused(
            &place,
            &[case, "--set", "columns=4"],
            "`columns` is 4, but must be between 5 and 1000; give 12 for a quick run; the period must be wider than the kernel",
        );
    }
    refused(
        &place,
        &["clear-water", "--set", "period.fixed.averaging_time=2"],
        "`period.fixed.averaging_time` is 2, but must be between 0.2 and 1.5; give at most half of the duration",
    );
}
