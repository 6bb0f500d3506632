use super::*;

/// Glass beads in a viscous liquid on 25°, of an initial solid fraction.
fn beads(solid_fraction: f64) -> SubmergedLayer {
    SubmergedLayer {
        slope_angle: 25.0,
        gravity: 9.81,
        depth: 4.9e-3,
        solid_fraction,
        grain_diameter: 160e-6,
        grain_density: 2500.0,
        liquid_density: 1041.0,
        viscosity: 0.096,
        law: ViscousNumberLaw::GLASS_BEADS,
        permeability_coefficient: SubmergedLayer::KOZENY_CARMAN,
        fraction_diffusion: 1.0,
        compressibility: 0.0,
        cells: 40,
        largest_fraction_change: 5e-5,
        longest_step: 0.5,
    }
}

fn after(layer: &SubmergedLayer, time: f64) -> SubmergedColumn {
    let mut column = SubmergedColumn::new(layer, 0.0).expect("valid");
    column.advance_to(time).expect("converges");
    column
}

#[test]
fn a_layer_flows_steadily_at_the_equilibrium_fraction() {
    let layer = beads(0.578);
    let column = after(&layer, 4000.0);
    assert!((column.surface_velocity() / layer.steady_surface_velocity() - 1.0).abs() < 1e-4);
    let viscous_number = layer.law.steady_viscous_number(layer.slope());
    assert!((column.mean_fraction() - layer.law.equilibrium_fraction(viscous_number)).abs() < 1e-5);
    assert!(column.floor_pressure().abs() < 1e-2);
}

#[test]
fn loose_grains_push_water_out_and_dense_grains_draw_it_in() {
    assert!(after(&beads(0.562), 1.0).floor_pressure() > 1.0);
    assert!(after(&beads(0.584), 1.0).floor_pressure() < -1.0);
}

#[test]
fn grains_momentum_and_water_are_kept() {
    for fraction in [0.562, 0.592] {
        let column = after(&beads(fraction), 60.0);
        assert!(column.mass_error() < 1e-13, "{}", column.mass_error());
        assert!(column.momentum_error() < 1e-13, "{}", column.momentum_error());
        assert!(column.water_error() < 1e-9, "{}", column.water_error());
    }
}

#[test]
fn a_nearly_rigid_skeleton_moves_like_a_rigid_one() {
    let rigid = SubmergedLayer { fraction_diffusion: 0.0, ..beads(0.578) };
    let velocity = |compressibility| after(&SubmergedLayer { compressibility, ..rigid }, 60.0).surface_velocity();
    assert!((velocity(1e-5) / velocity(0.0) - 1.0).abs() < 5e-3, "{} {}", velocity(1e-5), velocity(0.0));
}

#[test]
fn steps_are_of_second_order_in_their_length() {
    let velocity = |part: f64| {
        let layer = SubmergedLayer {
            fraction_diffusion: 0.0,
            largest_fraction_change: 1.0,
            longest_step: 4.0 * part,
            ..beads(0.578)
        };
        after(&layer, 64.0).surface_velocity()
    };
    let [coarse, middle, fine] = [1.0, 0.5, 0.25].map(velocity);
    let order = libm::log2((coarse - middle) / (middle - fine));
    assert!((order - 2.0).abs() < 0.2, "{order}");
}

#[test]
fn a_dense_layer_converges_with_its_cells_only_if_shear_diffuses_the_fraction() {
    let spread = |fraction_diffusion| {
        let velocity =
            |cells| after(&SubmergedLayer { fraction_diffusion, cells, ..beads(0.592) }, 100.0).surface_velocity();
        (velocity(40) / velocity(20) - 1.0).abs()
    };
    assert!(spread(1.0) < 0.5 * spread(0.0), "{} {}", spread(1.0), spread(0.0));
}

#[test]
fn a_parameter_out_of_range_is_named() {
    let refused = |layer: SubmergedLayer| layer.check().expect_err("out of range").to_string();
    assert!(refused(SubmergedLayer { cells: 1, ..beads(0.58) }).contains("cells is 1"));
    assert!(refused(SubmergedLayer { grain_density: 900.0, ..beads(0.58) }).contains("grain_density is 900"));
    assert!(refused(beads(1.2)).contains("solid_fraction is 1.2"));
}
