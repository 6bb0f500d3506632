//! Fields carried by walls: hydrostatic pressures and linear profiles continued behind the surface.

use crate::invariants::patches::{Disorder, EQUATION_OF_STATE, SPACING, bed, block, open_scene, simulation};
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::walls::{Wall, wall};

const GRAVITY: f64 = 9.81;
/// Depth behind a surface up to which wall particles see the flow's first row: 2h less its largest distance.
const WET: f64 = 2.2 * SPACING;

/// A jittered layer on a bed, periodic across, with the pressure of a layer of its height on a slope `angle` [rad].
fn layer<const D: usize>(cells: [usize; D], jitter: f64, angle: f64) -> Scene<D> {
    let height = cells[D - 1] as f64 * SPACING;
    let mut scene = open_scene(block(cells, Disorder { jitter, ..Disorder::NONE }, 31));
    for axis in 0..D - 1 {
        scene.domain.axes[axis] = AxisBoundary::Periodic { lower: 0.0, upper: cells[axis] as f64 * SPACING };
    }
    (scene.gravity[0], scene.gravity[D - 1]) = (GRAVITY * angle.sin(), -GRAVITY * angle.cos());
    for (position, density) in scene.flow.position.iter().zip(&mut scene.flow.density) {
        *density = EQUATION_OF_STATE.density(1500.0 * GRAVITY * angle.cos() * (height - position[D - 1]));
    }
    scene.walls = vec![bed()];
    let extent = (Vector::zeros(), Vector::repeat(height));
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, extent, SPACING, 4);
    scene
}

/// (position, pressure, velocity) of every wall particle.
fn carried<const D: usize>(simulation: &Simulation<D>) -> Vec<(Vector<D>, f64, Vector<D>)> {
    let particles = simulation.particles();
    (particles.flow_count()..particles.real_count())
        .map(|w| (particles.position[w], particles.pressure[w], particles.velocity[w]))
        .collect()
}

#[test]
fn a_linear_pressure_is_continued_into_the_bed() {
    fn check<const D: usize>(cells: [usize; D], angle: f64)
    where
        Simulation<D>: Compiled<D>,
    {
        let height = cells[D - 1] as f64 * SPACING;
        let weight = 1500.0 * GRAVITY * angle.cos();
        let simulation = simulation(layer(cells, 0.2, angle));
        let mut wet = 0;
        for (place, pressure, _) in carried(&simulation) {
            let depth = -place[D - 1];
            if depth < WET {
                let exact = weight * (height + depth);
                // the increment takes ρ_f instead of ρ0, which is larger by p/K, over at most the kernel's reach
                let excess = weight * 3.0 * SPACING * (weight * height / EQUATION_OF_STATE.bulk_modulus);
                let error = pressure - exact;
                assert!(error > -1e-9 && error < excess, "{D}-D: {error} Pa at {place}, at most {excess}");
                wet += 1;
            } else if depth > 3.0 * SPACING {
                assert_eq!(pressure, 0.0, "out of reach");
            }
        }
        assert!(wet > 20);
    }
    check([14, 12], 0.0);
    check([14, 12], 0.45);
    check([7, 8, 9], 0.3);
}

#[test]
fn a_layer_without_pressure_leaves_the_bed_without_pressure() {
    let mut scene = layer([14, 12], 0.2, 0.0);
    scene.flow.density.fill(1500.0);
    for (place, pressure, _) in carried(&simulation(scene)) {
        // the recipe's min(1, p/(½ ρ0 g Δ)): without it weightless particles ride on a frictionless cushion
        assert_eq!(pressure, 0.0, "at {place}");
    }
}

#[test]
fn a_shear_flow_is_continued_to_the_other_side_of_a_moving_bed() {
    fn check<const D: usize>(cells: [usize; D])
    where
        Simulation<D>: Compiled<D>,
    {
        let (rate, belt) = (7.0, 0.6);
        let mut scene = layer(cells, 0.2, 0.0);
        scene.walls[0].velocity[0] = belt;
        for (position, velocity) in scene.flow.position.iter().zip(&mut scene.flow.velocity) {
            velocity[0] = belt + rate * position[D - 1];
            velocity[D - 1] = -2.0 * rate * position[D - 1];
        }
        for (place, _, velocity) in carried(&simulation(scene)) {
            let depth = -place[D - 1];
            let mut expected = Vector::<D>::zeros();
            expected[0] = belt;
            if depth < WET {
                expected[0] -= rate * depth;
                expected[D - 1] += 2.0 * rate * depth;
            }
            if !(WET..=3.3 * SPACING).contains(&depth) {
                assert!((velocity - expected).norm() < 1e-13, "{D}-D: {velocity} for {expected} at {place}");
            }
        }
    }
    check([14, 12]);
    check([7, 8, 9]);
}

#[test]
fn a_side_wall_meets_the_bed_in_a_corner() {
    let cells = [16, 14];
    let height = 14.0 * SPACING;
    let rate = 5.0;
    let mut scene = layer(cells, 0.0, 0.0);
    scene.domain.axes[0] = AxisBoundary::Open;
    scene.walls.push(Wall::still(0, 0.0, 1.0));
    let extent = (Vector::zeros(), Vector::<2>::repeat(height));
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, extent, SPACING, 4);
    for (position, velocity) in scene.flow.position.iter().zip(&mut scene.flow.velocity) {
        velocity[1] = rate * position[0];
    }
    let owners: Vec<usize> = scene.wall_particles.iter().map(|particle| particle.wall).collect();
    let simulation = simulation(scene);
    let weight = 1500.0 * GRAVITY;
    let (mut on_the_side, mut in_the_corner) = (0, 0);
    for ((place, pressure, velocity), wall) in carried(&simulation).into_iter().zip(owners) {
        let [x, y] = place.into();
        let inner = y > 3.1 * SPACING && y < height - 3.1 * SPACING;
        if x < 0.0 && -x < WET && inner {
            // gravity has no part along the wall's normal; the rows on both sides of a lattice row balance, but for
            // their volumes m/ρ, which differ by Δp/K over the kernel's reach
            assert_eq!(wall, 1);
            let reach = weight * 3.0 * SPACING;
            let tolerance = reach * (2.0 * reach / EQUATION_OF_STATE.bulk_modulus);
            assert!((pressure - weight * (height - y)).abs() < tolerance, "{pressure} Pa at {place}");
            assert!((velocity - Vector::<2>::new(0.0, rate * x)).norm() < 1e-13, "{velocity} at {place}");
            on_the_side += 1;
        } else if x < 0.0 && y < 0.0 && x.hypot(y) < WET {
            // the mean of what it sees, plus the increment normal to the surface that owns it: never more than the
            // hydrostatic value below the bed, never less than the lightest particle within reach
            let (least, most) = (weight * (height - 3.0 * SPACING), weight * (height + WET) * 1.01);
            assert!(pressure > least && pressure < most, "{pressure} Pa at {place}");
            in_the_corner += 1;
        }
    }
    assert!(on_the_side > 10 && in_the_corner > 1, "{on_the_side} and {in_the_corner}");
}
