use super::*;
use crate::one_dimension::LayerError;

const BEADS: SubmergedLayer = SubmergedLayer::EXPERIMENT;

fn after(layer: &SubmergedLayer, solid_fraction: f64, time: f64) -> SubmergedColumn {
    let mut column = SubmergedColumn::new(layer, solid_fraction, 0.0).expect("valid");
    column.advance_to(time).expect("converges");
    column
}

#[test]
fn a_layer_flows_steadily_at_the_equilibrium_fraction() {
    let column = after(&BEADS, 0.578, 4000.0);
    assert!((column.surface_velocity() / BEADS.steady_surface_velocity(0.578) - 1.0).abs() < 1e-4);
    assert!((column.mean_fraction() - BEADS.steady_fraction()).abs() < 1e-5);
    assert!(column.floor_pressure().abs() < 1e-2);
}

#[test]
fn loose_grains_push_water_out_and_dense_grains_draw_it_in() {
    assert!(after(&BEADS, 0.562, 1.0).floor_pressure() > 1.0);
    assert!(after(&BEADS, 0.584, 1.0).floor_pressure() < -1.0);
}

#[test]
fn grains_momentum_and_water_are_kept() {
    for fraction in [0.562, 0.592] {
        let column = after(&BEADS, fraction, 60.0);
        assert!(column.mass_error() < 1e-13, "{}", column.mass_error());
        assert!(column.momentum_error() < 1e-13, "{}", column.momentum_error());
        assert!(column.water_error() < 1e-9, "{}", column.water_error());
    }
}

#[test]
fn a_nearly_rigid_skeleton_moves_like_a_rigid_one() {
    let velocity = |compressibility| {
        let layer = SubmergedLayer { fraction_diffusion: 0.0, compressibility, ..BEADS };
        after(&layer, 0.578, 60.0).surface_velocity()
    };
    assert!((velocity(1e-5) / velocity(0.0) - 1.0).abs() < 5e-3, "{} {}", velocity(1e-5), velocity(0.0));
    assert!((velocity(1e-12) / velocity(0.0) - 1.0).abs() < 1e-6, "{} {}", velocity(1e-12), velocity(0.0));
}

#[test]
fn steps_are_of_second_order_in_their_length() {
    let velocity = |longest_step| {
        let layer = SubmergedLayer { fraction_diffusion: 0.0, largest_fraction_change: 1.0, longest_step, ..BEADS };
        after(&layer, 0.578, 64.0).surface_velocity()
    };
    let [coarse, middle, fine] = [4.0, 2.0, 1.0].map(velocity);
    let order = libm::log2((coarse - middle) / (middle - fine));
    assert!((order - 2.0).abs() < 0.2, "{order}");
}

#[test]
fn a_dense_layer_converges_with_its_cells_only_if_shear_diffuses_the_fraction() {
    let spread = |fraction_diffusion| {
        let of = |cells| SubmergedLayer { fraction_diffusion, cells, ..BEADS };
        let velocity = |cells| after(&of(cells), 0.592, 100.0).surface_velocity();
        (velocity(40) / velocity(20) - 1.0).abs()
    };
    assert!(spread(1.0) < 0.5 * spread(0.0), "{} {}", spread(1.0), spread(0.0));
}

#[test]
fn a_layer_without_a_solution_is_an_error() {
    let weightless = SubmergedLayer { gravity: 0.0, ..BEADS };
    assert!(matches!(SubmergedColumn::new(&weightless, 0.58, 0.0), Err(LayerError::NoPorePressure { .. })));
}
