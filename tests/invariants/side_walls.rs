//! Side walls of a plane flow: Coulomb's law of one block between two plates, exactly, and their place in every balance.

use crate::invariants::patches::{
    DENSITY, Disorder, EQUATION_OF_STATE, SPACING, SYRUP, advance, bed, block, exact_pairs, open_scene, periodic_scene,
    simulation,
};
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::numerics::{Contact, MomentumOperator, Numerics};
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::walls::{SideWalls, wall};

const WALLS: SideWalls = SideWalls { width: 0.1, friction: 0.3 };
/// ρ/ρ0 of the blocks `[-]`.
const COMPRESSION: f64 = 1.005;

/// Grains of one pressure without bounds, moving as one `[m/s]` between the plates.
fn pressed_block(velocity: Vector<2>) -> Scene<2> {
    let mut scene = periodic_scene([14, 14], Disorder::NONE, 1);
    scene.flow.density.fill(COMPRESSION * DENSITY);
    scene.flow.velocity.fill(velocity);
    scene.side_walls = Some(WALLS);
    scene
}

/// 2 μ_w p/(ρ W) `[m/s²]` of the blocks.
fn retardation() -> f64 {
    let density = COMPRESSION * DENSITY;
    2.0 * WALLS.friction * EQUATION_OF_STATE.pressure(density) / (density * WALLS.width)
}

/// A block that slides stops after v²/2a and t = v/a.
#[test]
fn a_sliding_block_stops_where_the_equation_of_its_motion_says() {
    let start = Vector::<2>::new(0.12, -0.05);
    let speed = start.norm();
    let expected = speed * speed / (2.0 * retardation());
    let errors = [0.4, 0.2, 0.1, 0.05].map(|acoustic_courant| {
        let mut scene = pressed_block(start);
        scene.numerics.acoustic_courant = acoustic_courant;
        let (middle, mut simulation) = (7 * 14 + 7, simulation(scene));
        let place = simulation.snapshot().position[middle];
        let (mut time, mut step) = (0.0, 0.0);
        while simulation.snapshot().velocity.iter().any(|velocity| velocity.norm() > 0.0) {
            simulation.step().expect("a stable step");
            (step, time) = (simulation.time() - time, simulation.time());
        }
        let way = simulation.snapshot().position[middle] - place;
        let error = way.norm() / expected - 1.0;
        println!("step {step:.3e} s: way {:.6e} m, {error:+.5} off; time {time:.6e} s", way.norm());
        // it goes where it went, and rests within the step in which the equation has it rest
        assert!((way.normalize() - start.normalize()).norm() < 1e-9);
        let rest = speed / retardation();
        assert!(time >= rest - 1e-9 && time <= rest + 1.001 * step, "{time} for {rest}");
        // what a step with the velocity of its end leaves out: half of what the last one had
        assert!((error * rest / step + 1.0).abs() < 0.02, "{error}");
        error
    });
    for pair in errors.windows(2) {
        let order = f64::log2(pair[0] / pair[1]);
        assert!((order - 1.0).abs() < 0.03, "order {order} of {errors:?}");
    }
}

/// Below the limit of friction nothing moves, not by one bit; above it what is left of gravity accelerates the block.
#[test]
fn a_block_is_held_up_to_the_limit_and_slides_beyond_it() {
    let along = Vector::<2>::new(0.8, -0.6);
    for share in [0.5, 0.99] {
        let mut held = pressed_block(Vector::zeros());
        held.gravity = along * (share * retardation());
        let start = held.flow.position.clone();
        let mut simulation = simulation(held);
        advance(&mut simulation, 200);
        let state = simulation.snapshot();
        assert!(state.velocity.iter().all(|velocity| velocity.norm() == 0.0), "at {share} of the limit");
        assert!(state.position == start, "at {share} of the limit");
    }
    let mut sliding = pressed_block(Vector::zeros());
    sliding.gravity = along * (1.25 * retardation());
    let mut simulation = simulation(sliding);
    advance(&mut simulation, 200);
    let expected = along * (0.25 * retardation() * simulation.time());
    for velocity in simulation.snapshot().velocity {
        assert!((velocity - expected).norm() < 1e-6 * expected.norm(), "{velocity} for {expected}");
    }
}

/// Without gravity and other walls the momentum changes by what the side walls give, whatever else goes on, and never rises.
#[test]
fn side_walls_give_the_impulse_that_the_flow_loses() {
    let mut scene = periodic_scene([17, 14], Disorder::FULL, 11);
    scene.numerics = Numerics { contact: Contact::None, ..exact_pairs() };
    for velocity in &mut scene.flow.velocity {
        velocity[0] += 0.4;
    }
    let momentum = |scene: &Scene<2>, velocity: &[Vector<2>]| -> Vector<2> {
        velocity.iter().zip(&scene.flow.mass).map(|(velocity, mass)| velocity * *mass).sum()
    };
    for momentum_operator in [MomentumOperator::SingleDivergence, MomentumOperator::Pairwise] {
        let mut scene = scene.clone();
        scene.side_walls = Some(WALLS);
        scene.numerics.momentum_operator = momentum_operator;
        if momentum_operator == MomentumOperator::Pairwise {
            scene.rheology = SYRUP;
        }
        let before = momentum(&scene, &scene.flow.velocity);
        let mut simulation = simulation(scene.clone());
        advance(&mut simulation, 60);
        let lost = momentum(&scene, &simulation.snapshot().velocity) - before;
        let given = simulation.side_wall_impulse();
        assert!(simulation.neighbour_searches() > 2, "the particles are sorted anew in the run");
        assert!(lost[0] < -0.05 * before[0], "{lost} of {before}");
        assert!((lost - given).norm() < 1e-11 * given.norm(), "{lost} and {given}");
    }
}

/// Mean way along the slope in spacings `[-]`, and the share of particles without any velocity `[-]`, over a second run as long as the
/// one in which a disordered layer came to rest at 15°.
fn crept(side_walls: Option<SideWalls>, density_coupling: f64) -> (f64, f64) {
    const ROWS: usize = 16;
    let mut scene = periodic_scene([ROWS, ROWS], Disorder { jitter: 0.1, ..Disorder::NONE }, 3);
    let height = ROWS as f64 * SPACING;
    scene.domain.axes[1] = AxisBoundary::Open;
    scene.walls = vec![bed()];
    let extent = (Vector::zeros(), Vector::repeat(1.5 * height));
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, extent, SPACING, 4);
    let slope = 15.0_f64.to_radians();
    scene.gravity = 9.81 * Vector::<2>::new(slope.sin(), -slope.cos());
    for (position, density) in scene.flow.position.iter().zip(&mut scene.flow.density) {
        let pressure = -DENSITY * scene.gravity[1] * (height - position[1]).max(0.0);
        *density = EQUATION_OF_STATE.density(pressure);
    }
    scene.numerics = Numerics { density_coupling, ..Numerics::default() };
    scene.side_walls = side_walls;
    let mut simulation = simulation(scene);
    advance(&mut simulation, 2000);
    let before = simulation.snapshot();
    advance(&mut simulation, 2000);
    let after = simulation.snapshot();
    let count = after.position.len() as f64;
    let way: f64 = after.position.iter().zip(&before.position).map(|(after, before)| after[0] - before[0]).sum();
    let still = after.velocity.iter().filter(|velocity| velocity.norm() == 0.0).count() as f64;
    (way / count / SPACING, still / count)
}

/// Friction of side walls does not make grains creep: the whole layer comes to rest to the last bit. The
/// density–pressure coupling alone goes on in it, as it does without side walls, since the pressure of grains that
/// walls hold is not smooth.
#[test]
fn a_layer_at_rest_does_not_creep_by_its_side_walls() {
    assert_eq!(crept(Some(WALLS), 0.0), (0.0, 1.0));
    let (free, held) = (crept(None, 1.0), crept(Some(WALLS), 1.0));
    println!("mean way in spacings and share at rest: {free:?} without, {held:?} with side walls");
    assert!(free.0.abs() < 5e-4 && held.0.abs() < 5e-4, "{held:?} and {free:?}");
    assert!(held.1 > 0.4 && free.1 < 0.1, "{held:?} and {free:?}");
}

/// Material that sinks between the plates at one velocity hangs on them: dp/dy = ρ g − 2 μ_w p/W, so that its pressure tends to
/// ρ g W/(2 μ_w) with the depth (Janssen). It sinks with a bed that is drawn down, and begins with the pressure of its whole weight.
#[test]
fn settling_between_side_walls_has_janssen_pressure() {
    let (columns, rows, speed) = (12, 40, 0.1);
    let height = rows as f64 * SPACING;
    let mut scene = periodic_scene([columns, rows], Disorder { jitter: 0.05, ..Disorder::NONE }, 9);
    scene.domain.axes[1] = AxisBoundary::Open;
    let mut bed = bed();
    (bed.velocity[1], bed.travel) = (-speed, 1.0);
    scene.walls = vec![bed];
    let extent = (Vector::zeros(), Vector::repeat(1.5 * height));
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, extent, SPACING, 4);
    scene.gravity[1] = -9.81;
    scene.flow.velocity.fill(Vector::<2>::new(0.0, -speed));
    for (position, density) in scene.flow.position.iter().zip(&mut scene.flow.density) {
        *density = EQUATION_OF_STATE.density(DENSITY * 9.81 * (height - position[1]).max(0.0));
    }
    scene.numerics = Numerics::default();
    // friction does not damp the column's vibrations about its steady motion, a viscosity does
    scene.rheology = Rheology::Newtonian(Newtonian { viscosity: 400.0 });
    let side_walls = SideWalls { width: 0.25, friction: 0.4 };
    scene.side_walls = Some(side_walls);
    let mass = scene.flow.mass[0];
    let mut simulation = simulation(scene);
    let mut sums = vec![(0.0, 0.0); rows];
    while simulation.time() < 1.6 {
        simulation.step().expect("a stable step");
        if simulation.time() > 1.2 {
            let state = simulation.snapshot();
            // rows keep their order; the weight above a row is known whatever its height
            for (index, pressure) in state.pressure.iter().enumerate() {
                let sum = &mut sums[index / columns];
                *sum = (sum.0 + pressure, sum.1 + 1.0);
            }
        }
    }
    let depth = side_walls.width / (2.0 * side_walls.friction);
    let weight = mass / (SPACING * SPACING) * 9.81;
    let mut worst = 0.0_f64;
    for (row, (sum, count)) in sums.into_iter().enumerate() {
        let above = height - (row as f64 + 0.5) * SPACING;
        let expected = weight * depth * (1.0 - (-above / depth).exp());
        let found = sum / count;
        worst = worst.max((found - expected).abs() / (weight * SPACING));
    }
    println!("pressures are {worst:.3} of a row's weight off at most");
    // at which height in its row a displaced particle has its pressure is known to half of that
    assert!(worst < 0.5, "{worst}");
}

#[test]
fn invalid_side_walls_are_refused() {
    let message = |side_walls| {
        let mut scene = open_scene(block([6, 6], Disorder::NONE, 1));
        scene.side_walls = Some(side_walls);
        scene.check().expect_err("refused").to_string()
    };
    assert_eq!(
        message(SideWalls { width: 0.0, ..WALLS }),
        "`side_walls.width` is 0, but must be positive and finite; give the inner width of the channel in metres, or leave `side_walls` out"
    );
    assert_eq!(
        message(SideWalls { friction: -0.1, ..WALLS }),
        "`side_walls.friction` is -0.1, but must be between 0 and 2; give the tangent of the friction angle: 0.3 for 17°"
    );
    let angle = message(SideWalls { friction: 22.0, ..WALLS });
    assert!(angle.starts_with("`side_walls.friction` is 22, but must be between 0 and 2"), "{angle}");
    let mut space = open_scene(block([6, 6, 6], Disorder::NONE, 1));
    space.side_walls = Some(WALLS);
    assert_eq!(
        space.check().expect_err("refused").to_string(),
        "`side_walls`: for two-dimensional scenes only; leave it out, and give the side walls under `walls`"
    );
}
