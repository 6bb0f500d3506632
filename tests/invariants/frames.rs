//! A flow does not know how its frame is turned: a column of grains that collapses onto a bed of segments, free or beside a wall, turned
//! by 30° with its walls and gravity, and its mirror image.

use crate::invariants::patches::{
    DENSITY, Disorder, EQUATION_OF_STATE, SPACING, advance, block, exact_pairs, open_scene, simulation,
};
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::enclosure::facet_wall::{FacetWall, Side};
use bagnold_solver::weakly_compressible::numerics::Numerics;
use bagnold_solver::weakly_compressible::scene::Scene;

const GRAVITY: f64 = 9.81;
const CELLS: [usize; 2] = [12, 16];

/// The collapse with everything turned or mirrored by an orthogonal matrix.
fn collapse(frame: &Tensor<2>, corners: &[[f64; 2]], numerics: Numerics) -> Scene<2> {
    let mut scene = open_scene(block(CELLS, Disorder { jitter: 0.1, ..Disorder::NONE }, 3));
    scene.numerics = numerics;
    let height = CELLS[1] as f64 * SPACING;
    for (position, density) in scene.flow.position.iter_mut().zip(&mut scene.flow.density) {
        *density = EQUATION_OF_STATE.density(DENSITY * GRAVITY * (height - position[1]));
        *position = frame * *position;
    }
    scene.gravity = frame * Vector::<2>::new(0.0, -GRAVITY);
    let points: Vec<Vector<2>> = corners.iter().map(|&point| frame * Vector::<2>::from(point)).collect();
    // in a mirror left is right
    let side = if frame.determinant() > 0.0 { Side::Left } else { Side::Right };
    scene.enclosure.walls = vec![FacetWall::polyline("walls", &points, side)];
    scene
}

/// Largest distance of a particle from where the other frame has it, in spacings `[-]`.
fn apart(frame: &Tensor<2>, corners: &[[f64; 2]], numerics: Numerics, steps: usize) -> f64 {
    let mut straight = simulation(collapse(&Tensor::identity(), corners, numerics));
    let mut other = simulation(collapse(frame, corners, numerics));
    advance(&mut straight, steps);
    advance(&mut other, steps);
    let (straight, other) = (straight.snapshot(), other.snapshot());
    let farthest = straight.velocity.iter().map(|v| v.norm()).fold(0.0, f64::max);
    assert!(farthest > 0.1, "it must fall: {farthest} m/s");
    let distance = |(one, other): (&Vector<2>, &Vector<2>)| (frame * one - other).norm() / SPACING;
    straight.position.iter().zip(&other.position).map(distance).fold(0.0, f64::max)
}

#[test]
fn a_collapse_is_the_same_in_a_frame_that_is_turned_by_30_degrees_or_mirrored() {
    let (sin, cos) = 30_f64.to_radians().sin_cos();
    let turned = Tensor::<2>::new(cos, -sin, sin, cos);
    let mirrored = Tensor::<2>::new(-1.0, 0.0, 0.0, 1.0);
    let bed = [[-1.0, 0.0], [1.0, 0.0]];
    let corner = [[0.0, 0.32], [0.0, 0.0], [1.0, 0.0]];
    for (name, frame) in [("turned", turned), ("mirrored", mirrored), ("both", turned * mirrored)] {
        // rounding of f64, or of f32 among pairs, that steps of colliding particles amplify
        for (numerics, most) in [(exact_pairs(), 1e-10), (Numerics::default(), 1e-3)] {
            let distance = apart(&frame, &bed, numerics, 400);
            println!("{name}, {:?}: {distance:.1e} spacings", numerics.pair_precision);
            assert!(distance < most, "{name}, {:?}: {distance:.1e} spacings", numerics.pair_precision);
        }
        // the space behind a corner is filled from a lattice along the axes, which no other frame has
        let distance = apart(&frame, &corner, exact_pairs(), 400);
        println!("{name}, beside a wall: {distance:.1e} spacings");
        assert!(distance < 0.1, "{name}, beside a wall: {distance:.1e} spacings");
    }
}
