//! Columns against what they must conserve and against exact layers.

use super::super::ProjectionNumerics;
use super::super::scene::{Bed, DragForm, Fluid, ParticleSet, SedimentLoad, Turbulence};
use super::super::simulation::IncompressibleSimulation;
use super::super::stratification::Strata;
use super::*;
use crate::domain::Domain;
use crate::material::drag::DragLaw;
use crate::material::rheology::{Rheology, RootMuI};
use crate::material::suspension_viscosity::SuspensionViscosity;
use crate::material::turbulence::GrainRoughness;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

const SPACING: f64 = 1e-3;
const PACKING: f64 = 0.6;
const DENSITY: f64 = 2600.0;
const DIAMETER: f64 = 5e-3;

const LAW: Rheology = Rheology::RootMuI(RootMuI {
    static_friction: 0.35,
    limiting_friction: 0.97,
    reference_inertia: 0.69,
    grain_diameter: DIAMETER,
    grain_density: DENSITY,
    regularisation_rate: 5e-3,
});

/// A bed of 8 mm, the lower 4 mm held, under 12 mm of water of a velocity.
pub(in crate::incompressible) fn scene(
    length: f64,
    velocity: impl Fn(f64) -> f64,
    seed: u64,
) -> IncompressibleScene<2> {
    let columns = (length / SPACING).round() as i32;
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    let mut rows = |from: i32, to: i32, jitter: f64| -> Vec<Vector<2>> {
        let site = |i: i32, k: i32| Vector::<2>::new(f64::from(i) + 0.5, f64::from(k) + 0.5);
        let mut displaced =
            |x: Vector<2>| (x + Vector::<2>::from_fn(|_, _| jitter * (2.0 * random.random::<f64>() - 1.0))) * SPACING;
        (from..to).flat_map(|k| (0..columns).map(move |i| site(i, k))).map(&mut displaced).collect()
    };
    let water = rows(-8, 12, 1e-3);
    let grains = rows(-4, 0, 0.3);
    let at_rest = vec![Vector::zeros(); grains.len()];
    IncompressibleScene {
        fluid: Fluid {
            particles: ParticleSet {
                velocity: water.iter().map(|x| Vector::<2>::new(velocity(x[1]), 0.0)).collect(),
                position: water,
            },
            wall: rows(-12, -8, 0.0),
            spacing: SPACING,
            density: 1000.0,
            kinematic_viscosity: 1e-6,
            turbulence: Turbulence::Stratified,
            bed: Bed::NoSlip(-8e-3),
            gravity: Vector::<2>::new(0.3, -9.81),
        },
        sediment: Some(Sediment {
            filling: vec![PACKING; grains.len()],
            particles: ParticleSet { position: grains, velocity: at_rest },
            wall: rows(-11, -4, 0.0),
            spacing: SPACING,
            smoothing_ratio: 1.2,
            density: DENSITY,
            grain_diameter: DIAMETER,
            drag_diameter: DIAMETER,
            law: LAW,
            load: SedimentLoad::Stratified,
            pressure: SedimentPressure::Dilatant {
                dilatancy: Dilatancy {
                    dilation: 0.31,
                    packing: PACKING,
                    grain_diameter: DIAMETER,
                    grain_density: DENSITY,
                },
                fixed_filling: PACKING,
                columns: ColumnNumerics::default(),
                turbulent_schmidt: 0.0,
            },
            drag: DragLaw::DiFelice,
            drag_form: DragForm::Exchange,
            drag_smoothing_length: 1.2 * SPACING,
            gravity: Vector::<2>::new(0.3, -6.0),
        }),
        solid_fraction: SolidFraction::Averaged(Stratification::of(Strata {
            base: -8e-3,
            interval: 2.5e-4,
            solid_fraction: vec![0.0; 80],
            packing: PACKING,
            buoyant_weight: 15_696.0,
            bed_level: 0.0,
            depth: 12e-3,
            suspension_viscosity: SuspensionViscosity::default(),
            grain_roughness: GrainRoughness::default(),
            grain_diameter: DIAMETER,
        })),
        domain: Domain { axes: [AxisBoundary::Periodic { lower: 0.0, upper: length }, AxisBoundary::Open] },
        numerics: ProjectionNumerics { time_step: 1.5e-4, fluctuation_rate: 500.0, ..ProjectionNumerics::default() },
    }
}

/// The same with grains that eddies carry by a Schmidt number `[-]`, if it is not 0.
pub(in crate::incompressible) fn with_eddies(
    mut scene: IncompressibleScene<2>,
    schmidt: f64,
) -> IncompressibleScene<2> {
    let Some(Sediment { pressure: SedimentPressure::Dilatant { turbulent_schmidt, .. }, .. }) = &mut scene.sediment
    else {
        panic!("grains that dilate")
    };
    *turbulent_schmidt = schmidt;
    scene
}

pub(in crate::incompressible) fn shear_flow(height: f64) -> f64 {
    (60.0 * (height + 2e-3)).max(0.0)
}

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

/// Momentum of fluid and grains together changes by gravity and by the held grains alone: moving grains are not a wall.
#[test]
fn the_balance_of_both_phases_closes() {
    for eddies in [0.0, 0.7] {
        assert_closed_balance(eddies);
    }
}

fn assert_closed_balance(eddies: f64) {
    let mut scene = with_eddies(scene(0.02, shear_flow, 5), eddies);
    // without pressure gradients of φ: the fluid's momentum counts by its share of the space
    scene.numerics.shifting = 0.0;
    let mut state = super::super::state::State::of(scene).expect("a valid scene");
    for _ in 0..50 {
        super::super::step::step(&mut state).expect("a step");
        let system = &state.system;
        let columns = state.columns.as_ref().expect("columns");
        let time_step = state.last_step;
        // what the rows of the fluid have lost to everything but each other
        let held: f64 = (0..system.velocity.len())
            .map(|row| (system.of_constant[row] - system.inertia[row]) * system.velocity[row][0])
            .sum();
        let exchanged: f64 = (0..system.velocity.len())
            .map(|row| (columns.drag.hold[row] * system.velocity[row][0] - columns.drag.push[row]) * time_step)
            .sum();
        let on_grains: f64 = columns.drag.impulse.iter().sum::<f64>() * columns.grid.row.width;
        assert!((exchanged - on_grains).abs() < 1e-12 * on_grains.abs(), "{exchanged} and {on_grains}");
        assert!(held > exchanged, "the floor holds as well");
        // the pressure moves nothing along the floor but fluid against grains
        let change = |row: usize| state.phases.fluid.velocity[row][0] - system.velocity[row][0];
        let of_fluid: f64 = (0..system.velocity.len()).map(|row| system.inertia[row] * change(row)).sum();
        let of_grains: f64 = columns.pressed.iter().sum::<f64>() * columns.grid.row.width;
        let size: f64 = columns.pressed.iter().map(|impulse| impulse.abs()).sum::<f64>() * columns.grid.row.width;
        assert!(size > 0.0 && (of_fluid + of_grains).abs() < 1e-4 * size, "{of_fluid} and {of_grains} of {size}");
    }
    let Grains { position, velocity, .. } = &state.columns.as_ref().expect("columns").grains;
    assert!(position.iter().all(|x| x[1] > -4.5e-3 && x[1] < 6e-3));
    assert!(velocity.iter().all(|u| u[0] > -1e-3 && u[0] < 1.0));
}

#[test]
fn threads_change_no_bit() {
    let bytes = |threads: usize, eddies: f64| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let mut simulation =
                IncompressibleSimulation::new(with_eddies(scene(0.06, shear_flow, 9), eddies)).expect("a valid scene");
            for _ in 0..20 {
                simulation.step().expect("a step");
            }
            simulation.snapshot().to_bytes()
        })
    };
    for eddies in [0.0, 0.7] {
        assert!(bytes(1, eddies) == bytes(2, eddies));
    }
}

#[test]
fn columns_ask_for_what_holds_them() {
    let problem = |change: &dyn Fn(&mut IncompressibleScene<2>)| {
        let mut scene = scene(0.01, |_| 0.0, 1);
        change(&mut scene);
        IncompressibleSimulation::new(scene).err().map(|error| error.to_string()).expect("a refusal")
    };
    let loose = problem(&|scene| scene.sediment.as_mut().expect("a sediment").wall.clear());
    assert!(loose.contains("grains that hold the columns"), "{loose}");
    let unstirred = problem(&|s| *s = with_eddies(s.clone(), f64::NAN));
    assert!(unstirred.contains("`turbulent_schmidt` is NaN, but must be 0 or positive"), "{unstirred}");
    let overlapping = problem(&|scene| scene.solid_fraction = SolidFraction::Overlapping);
    assert!(overlapping.contains("that of the columns where grains dilate"), "{overlapping}");
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
