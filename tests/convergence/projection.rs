//! A manufactured field for the incompressible model: u = a + ∇χ with a free of divergence. Projections have to leave a, by pressures
//! that add up to ρ χ/Δt.
//!
//! The stabilised operator is (1 + s) times the Laplacian of a smooth pressure, so that a step takes 1/(1 + s) of what is left of ∇χ: a
//! lag of a step or two, and nothing in a steady flow. Several short steps show what the operators do in space.

use crate::convergence::orders;
use crate::invariants::two_phases::simulation;
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::incompressible::{
    Bed, Fluid, IncompressibleScene, ParticleSet, ProjectionNumerics, SolidFraction, Turbulence,
};
use bagnold_solver::vector::Vector;
use rand::{RngExt, SeedableRng};
use std::f64::consts::TAU;

const DENSITY: f64 = 1000.0;
/// Size of both parts of the velocity `[m/s]`.
const SPEED: f64 = 1.0;
/// One step `[s]`, so short that nothing moves.
const TIME_STEP: f64 = 1e-9;

/// The part free of divergence `[m/s]`.
fn solenoidal(x: &Vector<2>) -> Vector<2> {
    Vector::<2>::new((TAU * x[1]).sin(), (TAU * x[0]).sin()) * SPEED
}

/// χ, whose gradient is the other part `[m²/s]`.
fn potential(x: &Vector<2>) -> f64 {
    SPEED / TAU * (TAU * x[0]).cos() * (TAU * x[1]).cos()
}

fn gradient(x: &Vector<2>) -> Vector<2> {
    let (sx, cx) = (TAU * x[0]).sin_cos();
    let (sy, cy) = (TAU * x[1]).sin_cos();
    Vector::<2>::new(-sx * cy, -cx * sy) * SPEED
}

/// Root mean square errors of the velocity that is left after some steps, and of the sum of their pressures without its mean, over
/// the size of a and of ρ χ/Δt.
fn errors(cells: usize, jitter: f64, stabilisation: f64, steps: usize) -> (f64, f64) {
    let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(cells as u64);
    let spacing = 1.0 / cells as f64;
    let position: Vec<Vector<2>> = (0..cells * cells)
        .map(|index| {
            let mut place = |cell: usize| (cell as f64 + 0.5 + jitter * (2.0 * random.random::<f64>() - 1.0)) * spacing;
            Vector::<2>::new(place(index % cells), place(index / cells))
        })
        .collect();
    let velocity = position.iter().map(|x| solenoidal(x) + gradient(x)).collect();
    let period = AxisBoundary::Periodic { lower: 0.0, upper: 1.0 };
    let scene = IncompressibleScene {
        fluid: Fluid {
            particles: ParticleSet { position: position.clone(), velocity },
            wall: Vec::new(),
            spacing,
            density: DENSITY,
            kinematic_viscosity: 1e-9,
            turbulence: Turbulence::Laminar,
            bed: Bed::Slip,
            gravity: Vector::zeros(),
        },
        sediment: None,
        solid_fraction: SolidFraction::Overlapping,
        domain: Domain { axes: [period; 2] },
        numerics: ProjectionNumerics {
            time_step: TIME_STEP,
            stabilisation,
            density_correction: 0.0,
            shifting: 0.0,
            pressure_tolerance: 1e-10,
            velocity_tolerance: 1e-10,
            ..ProjectionNumerics::default()
        },
    };
    let mut simulation = simulation(scene);
    let mut pressure = vec![0.0; position.len()];
    for _ in 0..steps {
        simulation.step().expect("a stable step");
        for (sum, p) in pressure.iter_mut().zip(simulation.fluid_pressure()) {
            *sum += p;
        }
    }
    let (_, velocity) = simulation.fluid();
    let time_step = simulation.time() / steps as f64;
    let mean = pressure.iter().sum::<f64>() / pressure.len() as f64;
    let (mut left, mut flow, mut off, mut size) = (0.0, 0.0, 0.0, 0.0);
    for ((x, u), p) in position.iter().zip(velocity).zip(&pressure) {
        left += (u - solenoidal(x)).norm_squared();
        flow += solenoidal(x).norm_squared();
        let exact = DENSITY * potential(x) / time_step;
        off += (p - mean - exact).powi(2);
        size += exact.powi(2);
    }
    ((left / flow).sqrt(), (off / size).sqrt())
}

fn of_second_order(name: &str, errors: [f64; 3]) {
    println!("{name}: {errors:.5?} {:.2?}", orders(&errors));
    let last = orders(&errors)[1];
    assert!((last - 2.0).abs() < 0.2, "{name}: {errors:?}, order {last}");
}

#[test]
fn velocities_and_pressures_are_of_second_order_on_a_lattice() {
    let found = [16, 32, 64].map(|cells| errors(cells, 0.0, 0.0, 1));
    of_second_order("velocity", found.map(|pair| pair.0));
    of_second_order("pressure", found.map(|pair| pair.1));
    // stabilised projections go on until nothing is left of ∇χ: the gradient that they subtract is the transpose of the divergence
    let stabilisation = ProjectionNumerics::default().stabilisation;
    let found = [16, 32, 64].map(|cells| errors(cells, 0.0, stabilisation, 12));
    of_second_order("stabilised pressure", found.map(|pair| pair.1));
    let left = (stabilisation / (1.0 + stabilisation)).powi(12);
    println!("{left:.1e} by hand, {found:?}");
    assert!(found[2].0 < 2.0 * left, "{} of the velocity, {left} by hand", found[2].0);
}

#[test]
fn a_stabilised_projection_takes_its_share_of_what_is_left() {
    let stabilisation = ProjectionNumerics::default().stabilisation;
    let share = |steps| errors(64, 0.0, stabilisation, steps).1;
    for (steps, left) in
        [(1, stabilisation / (1.0 + stabilisation)), (2, (stabilisation / (1.0 + stabilisation)).powi(2))]
    {
        let found = share(steps);
        println!("{steps} steps leave {found:.4} of the pressure, by hand {left:.4}");
        assert!((found - left).abs() < 0.005, "{steps}: {found}, not {left}");
    }
}

#[test]
fn among_displaced_particles_that_do_not_move_projections_do_not_converge() {
    let stabilisation = ProjectionNumerics::default().stabilisation;
    let found = [16, 32, 64].map(|cells| errors(cells, 0.1, stabilisation, 12).0);
    println!("{found:.4?} {:.2?}", orders(&found));
    // jitter times the field over spacing, as every sum over pairs that keeps momentum; see `manufactured`
    let last = orders(&found)[1];
    assert!((last + 1.0).abs() < 0.2, "{found:?}, order {last}");
}
