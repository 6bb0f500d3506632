use super::*;
use crate::one_dimension::LayerError;

const BEADS: SubmergedLayer = SubmergedLayer::GLASS_BEADS;

fn after(layer: &SubmergedLayer, solid_fraction: f64, time: f64) -> SubmergedColumn {
    let mut column = SubmergedColumn::new(layer, solid_fraction, 0.0);
    column.advance_to(time).expect("converges");
    column
}

#[test]
fn a_layer_flows_steadily_at_the_equilibrium_fraction() {
    let column = after(&BEADS, 0.578, 130.0);
    assert!((column.surface_velocity() / BEADS.steady_surface_velocity(0.578) - 1.0).abs() < 1e-4);
    assert!((column.mean_fraction() - BEADS.steady_fraction()).abs() < 1e-5);
    assert!(column.floor_pressure().abs() < 1e-2);
}

#[test]
fn loose_grains_push_water_out_and_dense_grains_draw_it_in() {
    assert!(after(&BEADS, 0.562, 0.03).floor_pressure() > 1.0);
    assert!(after(&BEADS, 0.584, 0.03).floor_pressure() < -1.0);
}

/// Terzaghi: a uniform pressure in a layer at rest, with a drained surface and an undrained floor, at T = c_v t/h² = 0.2.
#[test]
fn pore_pressure_of_a_layer_at_rest_drains_as_terzaghi_has_it() {
    let error = |cells| {
        let layer = SubmergedLayer { slope_angle: 0.0, cells, ..BEADS };
        let diffusivity = layer.permeability(0.578) / (layer.viscosity * layer.compressibility);
        let time = 0.2 * layer.depth * layer.depth / diffusivity;
        let start = 0.1 * layer.floor_overburden(0.578) / (2.0 * cells as f64);
        let mut column = SubmergedColumn::new(&SubmergedLayer { longest_step: time / 200.0, ..layer }, 0.578, start);
        column.advance_to(time).expect("converges");
        let term = |odd: f64| {
            let wave = 0.5 * odd * std::f64::consts::PI;
            2.0 / wave * libm::sin(wave) * libm::cos(wave * 0.5 / cells as f64) * libm::exp(-0.2 * wave * wave)
        };
        let exact = [1.0, 3.0, 5.0, 7.0].map(term).iter().sum::<f64>();
        column.floor_pressure() / start / exact - 1.0
    };
    let [coarse, fine] = [20, 40].map(|cells| error(cells).abs());
    assert!(fine < 1e-3, "{fine}");
    assert!((libm::log2(coarse / fine) - 2.0).abs() < 0.2, "{coarse} {fine}");
}

#[test]
fn steps_are_of_second_order_in_their_length() {
    let velocity = |longest_step| {
        let layer = SubmergedLayer { largest_fraction_change: 1.0, longest_step, ..BEADS };
        after(&layer, 0.578, 64.0 / 30.0).surface_velocity()
    };
    // the jump of the pore pressure at the start takes many short steps
    let [coarse, middle, fine] = [4.0, 2.0, 1.0].map(|step| velocity(step / 3840.0));
    let order = libm::log2((coarse - middle) / (middle - fine));
    assert!((order - 2.0).abs() < 0.2, "{order}");
}

#[test]
fn a_layer_without_a_solution_is_an_error() {
    let mut weightless = SubmergedColumn::new(&SubmergedLayer { gravity: 0.0, ..BEADS }, 0.58, 0.0);
    assert!(matches!(weightless.advance_to(1.0), Err(LayerError::NoPorePressure { .. })));
}
