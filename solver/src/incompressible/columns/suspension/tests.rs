//! Suspensions against the profiles of imposed eddies and settling velocities, which are known exactly.

use super::super::super::SedimentPressure;
use super::super::Columns;
use super::super::tests::columns_of;
use super::super::tests::moving_bed::{scene, shear_flow, with_eddies};
use crate::material::drag::SettlingTable;
use crate::vector::{Tensor, Vector};

/// Settling velocity `[m/s]` and Schmidt number `[-]` of the grains, and the height of their space `[m]`, 12 mm of water over
/// 4 mm that the free grains of the scene leave.
const SETTLING: f64 = 0.05;
const SCHMIDT: f64 = 0.7;
const HEIGHT: f64 = 0.016;

/// Physics of a suspension: true or wrong.
#[derive(Clone, Copy)]
struct Physics {
    schmidt: f64,
    settling: f64,
}

const RIGHT: Physics = Physics { schmidt: SCHMIDT, settling: SETTLING };
const NO_EDDIES: Physics = Physics { schmidt: 1e9, ..RIGHT };
const NO_SETTLING: Physics = Physics { settling: 1e-9, ..RIGHT };

/// Columns whose few grains are suspended, in balance with an eddy viscosity `[m²/s]` over the height above held grains
/// `[m]`; nodes lie a ratio of a spacing apart.
fn suspended(physics: Physics, node_ratio: f64, eddies: &dyn Fn(f64) -> f64) -> Columns<2> {
    let mut scene = with_eddies(scene(0.02, |_| 0.0, 3), physics.schmidt);
    let sediment = scene.sediment.as_mut().expect("a sediment");
    sediment.filling.fill(0.02);
    let SedimentPressure::Dilatant { columns, .. } = &mut sediment.pressure else { panic!("columns") };
    columns.node_ratio = node_ratio;
    let (mut columns, mut scene, fluid) = columns_of(scene);
    let gradients = vec![Tensor::<2>::zeros(); fluid.len()];
    for _ in 0..600 {
        columns.gather(&mut scene, &fluid, &gradients).expect("within the law");
        let Columns { grid, nodes, suspension: Some(suspension), grains, .. } = &mut columns else { panic!("eddies") };
        suspension.laws.settling = SettlingTable::uniform(physics.settling, suspension.laws.dilatancy.packing);
        let held = grid.height(grid.held - 1);
        for node in 0..grid.len() {
            // the topmost held node stands for the half cell above it
            let above = (grid.height(node % grid.nodes) - held).max(0.25 * grid.cell);
            suspension.diffusivity[node] = eddies(above).max(0.0) / physics.schmidt;
        }
        suspension.balance(grid, nodes);
        for position in &mut grains.position {
            position[1] += 2e-3 * suspension.lift(grid, position[0], position[1], 0.02);
        }
    }
    columns
}

/// Largest relative distance of φ*/φ*(lowest whole cell) from an exact profile over the height above held grains `[m]`, up to
/// a share of the space.
fn error(columns: &Columns<2>, exact: &dyn Fn(f64) -> f64, up_to: f64) -> f64 {
    let Columns { grid, nodes, .. } = columns;
    let held = grid.height(grid.held - 1);
    let above = |node: usize| grid.height(node) - held;
    let cells = (grid.held..grid.nodes).filter(|node| above(*node) < up_to * HEIGHT);
    let share = |node: usize| nodes.target[node] / nodes.target[grid.held];
    let exact = |node: usize| exact(above(node)) / exact(above(grid.held));
    cells.map(|node| (share(node) / exact(node) - 1.0).abs()).fold(0.0, f64::max)
}

/// Mean height of the particles above held grains `[m]`, and their share above a height `[-]`.
fn particles(columns: &Columns<2>, height: f64) -> (f64, f64) {
    let held = columns.grid.height(columns.grid.held - 1);
    let heights: Vec<f64> = columns.grains.position.iter().map(|x| x[1] - held).collect();
    let count = heights.len() as f64;
    (heights.iter().sum::<f64>() / count, heights.iter().filter(|z| **z > height).count() as f64 / count)
}

/// The finest cells are within 2 %, and halved cells quarter an error.
fn assert_converged(errors: &[f64; 3]) {
    let order = libm::log2(errors[1] / errors[2]);
    assert!(errors[2] < 0.02 && errors[1] < errors[0], "{errors:?}");
    assert!((order - 2.0).abs() < 0.3, "{errors:?}: order {order}");
}

/// A uniform ν_t whose suspension falls by e over 3 mm, and that profile.
const FALL: f64 = 3e-3;

fn uniform(_: f64) -> f64 {
    FALL * SETTLING * SCHMIDT
}

fn exponential(height: f64) -> f64 {
    libm::exp(-height / FALL)
}

#[test]
fn uniform_eddies_make_an_exponential_suspension() {
    let runs = [1.0, 0.5, 0.25].map(|node_ratio| suspended(RIGHT, node_ratio, &uniform));
    let errors = runs.each_ref().map(|columns| error(columns, &exponential, 0.9));
    assert_converged(&errors);
    // ∫ z φ dz/∫ φ dz of the exponential that ends at the top, and its part above a height
    let end = exponential(HEIGHT);
    let mean = FALL - HEIGHT * end / (1.0 - end);
    for height in [0.5 * FALL, FALL, 2.0 * FALL] {
        let (of_particles, above) = particles(&runs[2], height);
        assert!((of_particles / mean - 1.0).abs() < 0.02, "{of_particles} for {mean} m");
        let exact = (exponential(height) - end) / (1.0 - end);
        assert!((above - exact).abs() < 0.02, "{above} for {exact} above {height} m");
    }
}

/// ν_t = κ u_* z (1 − z/h) from a twentieth of the depth h upwards, with w Sc/(κ u_*) = 1, and Rouse's profile.
const BOTTOM: f64 = 0.05;

fn parabolic(height: f64) -> f64 {
    let depth = HEIGHT / (1.0 - BOTTOM);
    let z = height + BOTTOM * depth;
    SETTLING * SCHMIDT * z * (1.0 - z / depth)
}

fn rouse(height: f64) -> f64 {
    let depth = HEIGHT / (1.0 - BOTTOM);
    let z = height + BOTTOM * depth;
    (depth - z) / z
}

#[test]
fn parabolic_eddies_make_rouses_profile() {
    let runs = [0.5, 0.25, 0.125].map(|node_ratio| suspended(RIGHT, node_ratio, &parabolic));
    let errors = runs.each_ref().map(|columns| error(columns, &rouse, 0.85));
    assert_converged(&errors);
}

#[test]
fn no_eddies_no_settling_and_a_tenth_of_the_schmidt_number_are_seen() {
    for (eddies, exact) in
        [(&uniform as &dyn Fn(f64) -> f64, &exponential as &dyn Fn(f64) -> f64), (&parabolic, &rouse)]
    {
        for (wrong, least) in [(NO_EDDIES, 0.5), (NO_SETTLING, 0.5), (Physics { schmidt: 1.1 * SCHMIDT, ..RIGHT }, 0.1)]
        {
            let columns = suspended(wrong, 0.125, eddies);
            let error = error(&columns, exact, 0.85);
            assert!(error > least, "{error} with Sc {} and {} m/s", wrong.schmidt, wrong.settling);
        }
    }
    // all grains lie on the held ones without eddies
    assert!(particles(&suspended(NO_EDDIES, 0.5, &uniform), 0.0).0 < 0.1 * FALL);
}

/// Balance of a flow over a bed that moves: the water's pressure carries the grains that eddies lift, contacts the others.
#[test]
fn forces_on_grains_and_water_are_opposite_and_the_weight_is_carried() {
    let (mut columns, mut scene, fluid) = columns_of(with_eddies(scene(0.02, shear_flow, 5), 0.05));
    // 200/s above what is held
    let gradients: Vec<_> = fluid
        .position
        .iter()
        .map(|x| Tensor::<2>::new(0.0, if x[1] > -4e-3 { 200.0 } else { 0.0 }, 0.0, 0.0))
        .collect();
    let Columns { grains, .. } = &mut columns;
    for (velocity, position) in grains.velocity.iter_mut().zip(&grains.position) {
        *velocity = Vector::<2>::new(60.0 * (position[1] + 4e-3), 0.0);
    }
    columns.gather(&mut scene, &fluid, &gradients).expect("within the law");
    let Columns { grid, nodes, suspension: Some(suspension), drag, grains, .. } = &columns else { panic!("eddies") };
    let on_grains: f64 = suspension.force.iter().sum::<f64>() * grid.row.width;
    let on_water: f64 = drag.burden.iter().sum();
    assert!(on_grains > 0.0 && (on_grains + on_water).abs() < 1e-12 * on_grains, "{on_grains} and {on_water} N/m");
    let weight = grains.mass.iter().sum::<f64>() / 2600.0 * suspension.laws.submerged_weight;
    let base = |column: usize| {
        let node = column * grid.nodes + grid.held - 1;
        // from the middle of the half cell down to what is held
        nodes.middle[node] + 0.25 * grid.cell * suspension.laws.submerged_weight * nodes.target[node]
    };
    // of the topmost cell the upper half lies on nothing
    let top = |column: usize| {
        let node = grid.of_column(column).rev().find(|node| nodes.target[*node] > 0.0).expect("grains");
        0.5 * grid.cell * suspension.laws.submerged_weight * nodes.target[node] - nodes.middle[node]
    };
    let of_columns = |part: &dyn Fn(usize) -> f64| (0..grid.row.count).map(part).sum::<f64>() * grid.row.width;
    let (on_contacts, on_nothing) = (of_columns(&base), of_columns(&top));
    let carried = on_contacts + on_grains + on_nothing;
    assert!((carried / weight - 1.0).abs() < 1e-9, "{on_contacts}, {on_grains}, {on_nothing} of {weight} N/m");
    assert!(on_grains > 0.1 * weight && on_nothing < 0.02 * weight, "{on_grains}, {on_nothing} of {weight} N/m");
}
