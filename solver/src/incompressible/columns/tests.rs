//! Columns against what they must conserve and against exact layers.

pub(super) mod moving_bed;

use super::*;
use moving_bed::{DENSITY, PACKING, scene, shear_flow};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

pub(super) fn columns_of(mut scene: IncompressibleScene<2>) -> (Columns<2>, IncompressibleScene<2>, Phase<2>) {
    let water = &scene.fluid;
    let fluid = Phase::new(&water.particles, &water.wall, water.spacing, water.density, 1.2);
    let columns = Columns::of(&mut scene).expect("dilating grains");
    (columns, scene, fluid)
}

/// Momentum along the bed `[kg/s]`.
fn momentum(columns: &Columns<2>) -> f64 {
    let Grains { velocity, mass, .. } = &columns.grains;
    velocity.iter().zip(mass).fold(0.0, |sum, (velocity, mass)| sum + velocity[0] * mass)
}

#[test]
fn nodes_have_the_mass_and_the_momentum_of_the_particles() {
    for length in [0.01, 0.03] {
        let (mut columns, mut scene, fluid) = columns_of(scene(length, shear_flow, 3));
        let mut random = Pcg64Mcg::seed_from_u64(4);
        for velocity in &mut columns.grains.velocity {
            velocity[0] = random.random::<f64>();
        }
        columns.gather(&mut scene, &fluid, &fluid.velocity_gradient).expect("within the law");
        let Columns { grid, nodes, grains, .. } = &columns;
        assert_eq!(grid.row.count, (length / 0.01).round() as usize);
        let mass: f64 = nodes.mass.iter().sum::<f64>() * grid.row.width;
        // to the top of what is held, where the hat of a node is half in it
        let held = (grid.held as f64 - 0.5) * grid.cell * length * PACKING * DENSITY;
        let free: f64 = grains.mass.iter().sum();
        assert!((mass / (held + free) - 1.0).abs() < 1e-13, "{mass} of {} kg/m", held + free);
        // what is near held nodes has its momentum there; the rest is on the free nodes
        let of_nodes: f64 = (0..grid.len())
            .filter(|node| node % grid.nodes >= grid.held)
            .map(|node| nodes.mass[node] * nodes.velocity[node] * grid.row.width)
            .sum();
        let of_particles: f64 = (0..grains.len())
            .flat_map(|a| grid.weights(grains.position[a][0], grains.position[a][1]).map(|entry| (a, entry)))
            .filter(|(_, (node, _))| node % grid.nodes >= grid.held)
            .map(|(a, (_, weight))| weight * grains.mass[a] * grains.velocity[a][0])
            .sum();
        assert!((of_nodes / of_particles - 1.0).abs() < 1e-13, "{of_nodes} of {of_particles} kg/s");
    }
}

#[test]
fn drag_is_equal_and_opposite_and_the_balance_of_the_grains_closes() {
    let (mut columns, mut scene, fluid) = columns_of(scene(0.02, shear_flow, 5));
    let material = scene.sediment.clone().expect("a sediment");
    let time_step = 1.5e-4;
    for _ in 0..200 {
        let before = momentum(&columns);
        columns.gather(&mut scene, &fluid, &fluid.velocity_gradient).expect("within the law");
        columns.advance(&material, &fluid.velocity, time_step).expect("solved");
        let width = columns.grid.row.width;
        let on_grains: f64 = columns.drag.impulse.iter().sum::<f64>() * width;
        let ColumnDrag { hold, push, .. } = &columns.drag;
        let on_water = fluid
            .velocity
            .iter()
            .zip(hold.iter().zip(push))
            .fold(0.0, |sum, (u, (hold, push))| sum + (push - hold * u[0]) * time_step);
        assert!((on_grains + on_water).abs() < 1e-13 * on_grains.abs());
        let driven: f64 = columns.grains.mass.iter().sum::<f64>() * material.gravity[0] * time_step;
        let expected = before + driven + on_grains + columns.held_impulse;
        assert!((momentum(&columns) - expected).abs() < 1e-13 * on_grains.abs(), "{} {expected}", momentum(&columns));
    }
    assert!(momentum(&columns) > 0.0);
}

#[test]
fn the_drag_on_the_grains_is_what_their_nodes_get() {
    let (mut columns, mut scene, fluid) = columns_of(scene(0.02, shear_flow, 5));
    // clear of what is held, whose nodes have impulses of their own
    for position in &mut columns.grains.position {
        position[1] += 1e-3;
    }
    columns.gather(&mut scene, &fluid, &fluid.velocity_gradient).expect("within the law");
    columns.drag.react(&columns.grid, &columns.nodes, &fluid.velocity, 1.5e-4);
    let held = |node: &usize| node % columns.grid.nodes < columns.grid.held;
    let nodes = (0..columns.grid.len()).filter(|node| !held(node));
    let on_nodes = nodes.map(|node| columns.drag.impulse[node]).sum::<f64>() * columns.grid.row.width / 1.5e-4;
    let on_grains: Vector<2> = columns.drag_forces(1.5e-4).sum();
    assert!(on_nodes > 0.0 && (on_grains[0] / on_nodes - 1.0).abs() < 1e-13, "{on_grains} of {on_nodes} N/m");
}

/// Grains at rest under still water lie as they were laid: no eddy finds room among them.
#[test]
fn a_resting_bed_leaves_no_room() {
    let (mut columns, mut scene, fluid) = columns_of(scene(0.01, |_| 0.0, 7));
    let mut material = scene.sediment.clone().expect("a sediment");
    material.gravity[0] = 0.0;
    for _ in 0..4000 {
        columns.gather(&mut scene, &fluid, &fluid.velocity_gradient).expect("within the law");
        columns.advance(&material, &fluid.velocity, 1.5e-4).expect("solved");
    }
    let layer = scene.solid_fraction.stratification().expect("strata");
    // ∫ (1 − φ/φ_max) dz up to where all grains are below, less the height above the bed's top
    let strata = layer.strata();
    let cells = strata.solid_fraction.len();
    let top = strata.base + cells as f64 * strata.interval;
    let room: f64 = strata.solid_fraction[columns.grid.held..]
        .iter()
        .map(|fraction| (1.0 - fraction / PACKING) * strata.interval)
        .sum();
    let above = top - 0.0;
    assert!((room - above).abs() < 1e-5, "{} mm of room in the bed", 1e3 * (room - above));
    let length = layer.at(&Vector::<2>::new(0.0, -1.5e-3)).mixing_length;
    // what is left is the roughness, 0.2 d, and below the bed's level the root of 1 − z/h
    let roughness = 0.41 * (1.0 + 1.5 / 12.0_f64).sqrt() * 1e-3;
    assert!((length / roughness - 1.0).abs() < 0.05, "{length} or {roughness} m of eddies in a bed at rest");
    let fastest = columns.grains.velocity.iter().fold(0.0_f64, |most, v| most.max(v.norm()));
    assert!(fastest < 1e-4, "{fastest} m/s");
}

/// A mound in a stream keeps its grains to the last bit and sinks; no node has less than none.
#[test]
fn a_mound_keeps_its_grains() {
    let mut scene = scene(0.06, shear_flow, 11);
    let sediment = scene.sediment.as_mut().expect("a sediment");
    if let SedimentPressure::Dilatant { columns, .. } = &mut sediment.pressure {
        columns.width_ratio = 0.5;
    }
    let (mut columns, mut scene, fluid) = columns_of(scene);
    let material = scene.sediment.clone().expect("a sediment");
    // grains of the upper rows gather about the middle
    for position in &mut columns.grains.position {
        if position[1] > -2e-3 {
            position[0] = 0.03 + 0.5 * (position[0] - 0.03);
        }
    }
    let mass = columns.grains.mass.clone();
    let crest = |columns: &Columns<2>| {
        let Columns { grid, nodes, .. } = columns;
        let of_column =
            |column: usize| nodes.fraction[grid.of_column(column)].iter().sum::<f64>() * grid.cell / PACKING;
        let heights: Vec<f64> = (0..grid.row.count).map(of_column).collect();
        let most = heights.iter().copied().fold(0.0, f64::max);
        most - heights.iter().sum::<f64>() / heights.len() as f64
    };
    columns.gather(&mut scene, &fluid, &fluid.velocity_gradient).expect("within the law");
    let first = crest(&columns);
    for _ in 0..2000 {
        columns.advance(&material, &fluid.velocity, 1.5e-4).expect("solved");
        columns.grains.wrap(&scene.domain);
        columns.gather(&mut scene, &fluid, &fluid.velocity_gradient).expect("within the law");
        assert!(columns.nodes.fraction.iter().all(|fraction| *fraction >= 0.0));
    }
    assert_eq!(columns.grains.mass, mass);
    let last = crest(&columns);
    println!("crest {} to {} mm", 1e3 * first, 1e3 * last);
    assert!(last < 0.9 * first, "the crest stays: {} to {} mm", 1e3 * first, 1e3 * last);
}
