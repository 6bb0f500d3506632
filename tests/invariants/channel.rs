//! Grains of the nonlocal law between two rough walls, compressed until they carry a pressure, and what their rows have in the mean.

use crate::nonlocal_layers::{BEADS, SOLID_FRACTION, at_rest};
use crate::patches::{Disorder, SPACING, block, open_scene, simulation};
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::{NonlocalMuI, Rheology};
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::boundary::{Wall, wall};
use bagnold_solver::weakly_compressible::numerics::Numerics;
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::Simulation;

/// Bulk modulus over the largest pressure `[-]`.
pub(crate) const STIFFNESS: f64 = 50.0;
const COLUMNS: usize = 8;

/// Grains that fill the space between a wall at y = 0 and one at some width, compressed so that they carry a pressure.
pub(crate) struct Channel<'a> {
    /// Distance of the walls `[m]`.
    pub(crate) width: f64,
    /// Rows of particles across.
    pub(crate) rows: usize,
    /// Gravity `[m/s²]`.
    pub(crate) gravity: Vector<2>,
    /// Pressure at a height `[Pa]`.
    pub(crate) pressure: &'a (dyn Fn(f64) -> f64 + Sync),
    /// Velocity of the upper wall `[m/s]`.
    pub(crate) upper_wall: f64,
    /// Velocity `[m/s]`, shear rate `[1/s]` and shear stress `[Pa]` at a height at the start.
    pub(crate) start: &'a (dyn Fn(f64) -> (f64, f64, f64) + Sync),
}

/// What the rows of a run have in the mean over time.
pub(crate) struct Measured {
    /// Heights `[m]`.
    pub(crate) height: Vec<f64>,
    /// Velocities `[m/s]`.
    pub(crate) velocity: Vec<f64>,
    /// Mean pressure of all rows `[Pa]`.
    pub(crate) pressure: f64,
    /// Largest deviation of a row's pressure from that mean and what its place adds, over the mean `[-]`.
    pub(crate) unevenness: f64,
    /// Mean shear stress of all rows `[Pa]`.
    pub(crate) shear_stress: f64,
    /// Mass over volume `[kg/m³]`.
    pub(crate) density: f64,
}

impl Channel<'_> {
    fn simulation(&self) -> Simulation<2> {
        let spacing = self.width / self.rows as f64;
        let density = SOLID_FRACTION * BEADS.grain_density;
        let most = (self.pressure)(0.0).max((self.pressure)(self.width));
        let material =
            EquationOfState { reference_density: density, bulk_modulus: STIFFNESS * most, tension: Tension::Cut };
        let mut flow = block([COLUMNS, self.rows], Disorder { jitter: 0.1, ..Disorder::NONE }, 7);
        for index in 0..flow.position.len() {
            flow.position[index] *= spacing / SPACING;
            flow.density[index] = material.density((self.pressure)(flow.position[index][1]));
            flow.mass[index] = flow.density[index] * spacing * spacing;
        }
        let mut scene = Scene { spacing, equation_of_state: material, ..open_scene(flow) };
        scene.numerics = Numerics::default();
        let length = COLUMNS as f64 * spacing;
        scene.domain.axes[0] = AxisBoundary::Periodic { lower: 0.0, upper: length };
        scene.walls = vec![Wall::still(1, 0.0, 1.0), Wall::still(1, self.width, -1.0)];
        let extent = (Vector::zeros(), Vector::<2>::new(length, self.width));
        scene.wall_particles = wall::fill(&scene.walls, &scene.domain, extent, spacing, 4);
        scene.gravity[1] = self.gravity[1];
        let mut scene = at_rest(scene, self.width);
        // disorder fills space a few parts in a thousand better or worse than a lattice, of which the pressure makes K/p times as much
        let flow = &mut scene.flow;
        let count = flow.position.len() as f64;
        let found = flow.density.iter().map(|&density| material.pressure(density)).sum::<f64>() / count;
        let due = flow.position.iter().map(|x| (self.pressure)(x[1])).sum::<f64>() / count;
        let factor = material.density(due) / material.density(found);
        flow.density.iter_mut().for_each(|density| *density *= factor);
        flow.mass.iter_mut().for_each(|mass| *mass *= factor);
        scene.gravity = self.gravity;
        scene.walls[1].velocity[0] = self.upper_wall;
        let rheology = Rheology::NonlocalMuI(NonlocalMuI::of(BEADS));
        for index in 0..scene.flow.position.len() {
            let y = scene.flow.position[index][1];
            let (velocity, shear_rate, shear_stress) = (self.start)(y);
            scene.flow.velocity[index][0] = velocity;
            let mut stress = Tensor::<2>::zeros();
            (stress[(0, 1)], stress[(1, 0)]) = (shear_stress, shear_stress);
            scene.flow.stress[index] = stress;
            let stress_ratio = shear_stress.abs() / (self.pressure)(y);
            scene.flow.field.extend(rheology.field_in_flow(shear_rate, stress_ratio));
        }
        simulation(Scene { rheology, ..scene })
    }

    /// Means over the last part of a run of some duration `[s]`.
    pub(crate) fn measured(&self, duration: f64) -> Measured {
        let mut simulation = self.simulation();
        let rows = self.rows;
        let (mut height, mut velocity, mut pressure) = (vec![0.0; rows], vec![0.0; rows], vec![0.0; rows]);
        let (mut count, mut shear_stress, mut total) = (vec![0.0; rows], 0.0, 0.0);
        let mut next = 0.5 * duration;
        let mut mass = 0.0;
        while simulation.time() < duration {
            simulation.step().expect("a stable step");
            if simulation.time() < next {
                continue;
            }
            next += 0.005 * duration;
            let state = simulation.snapshot();
            mass = state.mass.iter().sum::<f64>();
            for index in 0..state.position.len() {
                let y = state.position[index][1];
                let row = ((y / self.width * rows as f64) as usize).min(rows - 1);
                height[row] += y;
                velocity[row] += state.velocity[index][0];
                pressure[row] += state.pressure[index];
                count[row] += 1.0;
                shear_stress += state.stress[index][(0, 1)];
                total += 1.0;
            }
        }
        for row in 0..rows {
            height[row] /= count[row];
            velocity[row] /= count[row];
            pressure[row] /= count[row];
        }
        let mean = pressure.iter().sum::<f64>() / rows as f64;
        let due = |y: f64| (self.pressure)(y) - (self.pressure)(0.5 * self.width);
        let uneven = height.iter().zip(&pressure).map(|(&y, p)| (p - mean - due(y)).abs()).fold(0.0, f64::max);
        Measured {
            height,
            velocity,
            pressure: mean,
            unevenness: uneven / mean,
            shear_stress: shear_stress / total,
            density: mass / (self.width * COLUMNS as f64 * self.width / rows as f64),
        }
    }
}
