//! A column of grains collapses under its weight: `cargo run --example column -p bagnold-solver`.
//!
//! Half of a planar column 0.2 m high stands beside its symmetry plane on a rough bed. Released at once, it slumps and
//! comes to rest; what is printed is how far its front has run, and how high it still stands.

use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::{MuI, Rheology};
use bagnold_solver::run::StopReason;
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::enclosure::BoundarySet;
use bagnold_solver::weakly_compressible::numerics::Numerics;
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use bagnold_solver::weakly_compressible::simulation::Simulation;
use bagnold_solver::weakly_compressible::walls::{Wall, wall};
use std::ops::ControlFlow;

/// Half width and height `[m]`: an aspect ratio of 2.
const COLUMN: (f64, f64) = (0.1, 0.2);
/// Particle spacing `[m]`.
const SPACING: f64 = 0.01;
const GRAVITY: f64 = 9.81;

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    // The material: its bulk density, its pressure, its stress. Dry grains carry no tension. The bulk modulus is not that
    // of glass, but large enough for nearly constant density: sound ten times as fast as the fall of the column.
    let density = 1500.0;
    let bulk_modulus = density * 100.0 * 2.0 * GRAVITY * COLUMN.1;
    let equation_of_state = EquationOfState { reference_density: density, bulk_modulus, tension: Tension::Cut };
    let rheology = Rheology::MuI(MuI {
        static_friction: 0.382,
        limiting_friction: 0.643,
        reference_inertia: 0.279,
        grain_diameter: 0.5e-3,
        grain_density: 2500.0,
    });

    // The particles: a lattice at rest, each with its share of the mass, as dense as the weight above it asks.
    let mut flow = Flow::default();
    for row in 0..(COLUMN.1 / SPACING).round() as usize {
        for column in 0..(COLUMN.0 / SPACING).round() as usize {
            let position = Vector::<2>::new((column as f64 + 0.5) * SPACING, (row as f64 + 0.5) * SPACING);
            flow.density.push(equation_of_state.density(density * GRAVITY * (COLUMN.1 - position[1])));
            flow.position.push(position);
            flow.velocity.push(Vector::zeros());
            flow.mass.push(density * SPACING * SPACING);
            flow.stress.push(Tensor::zeros());
        }
    }

    // The room: a symmetry plane at x = 0 and a rough bed at y = 0, filled with particles as far as grains can get.
    let domain = Domain { axes: [AxisBoundary::Mirror { lower: Some(0.0), upper: None }, AxisBoundary::Open] };
    let walls = vec![Wall::still(1, 0.0, 1.0)];
    let reach = Vector::<2>::new(8.0 * COLUMN.0, 2.0 * COLUMN.1);
    let wall_particles = wall::fill(&walls, &domain, (Vector::zeros(), reach), SPACING, 4);
    let gravity = Vector::<2>::new(0.0, -GRAVITY);
    let numerics = Numerics::default();
    let spacing = SPACING;
    let enclosure = BoundarySet::default();
    let scene = Scene {
        flow,
        walls,
        wall_particles,
        enclosure,
        side_walls: None,
        domain,
        gravity,
        spacing,
        equation_of_state,
        rheology,
        numerics,
    };

    // The run: one second, looked at ten times.
    let mut simulation = Simulation::new(scene)?;
    let furthest = |simulation: &Simulation<2>, axis: usize| {
        let places = simulation.snapshot().position;
        places.iter().map(|position| position[axis]).fold(0.0, f64::max) + 0.5 * SPACING
    };
    let reason = simulation.run(1.0, 0.1, |simulation| {
        println!("t = {:.1} s: the front is at {:.3} m", simulation.time(), furthest(simulation, 0));
        ControlFlow::Continue(())
    });
    if let StopReason::Diverged(divergence) = reason {
        return Err(divergence.into());
    }
    let run_out = (furthest(&simulation, 0) - COLUMN.0) / COLUMN.0;
    println!("run-out {run_out:.2} half widths, height {:.3} m", furthest(&simulation, 1));
    Ok(())
}
