//! Particle data of a state for other programs: the flow with the quantities that its law computes, and the walls.

use crate::observation::Frame;
use bagnold_solver::incompressible::IncompressibleSimulation;
use bagnold_solver::material::rheology::field::FieldStep;
use bagnold_solver::vector::{Vector, equivalent_shear_stress, shear_rate};
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};

/// A vector in three dimensions.
pub(super) fn flat<const D: usize>(v: &Vector<D>) -> [f64; 3] {
    [v[0], v[1], if D == 3 { v[2] } else { 0.0 }]
}

/// An array of all particles with its name and unit.
pub(super) fn named<T>(name: &str, unit: &str, values: Vec<T>) -> (String, String, Vec<T>) {
    (name.to_owned(), unit.to_owned(), values)
}

/// The place of every particle in the scene.
fn identities(count: usize) -> (String, String, Vec<f64>) {
    named("id", "-", (0..count).map(|id| id as f64).collect())
}

/// Particles of a weakly compressible flow: besides pressure, density and velocity the shear rate |γ̇|, the stress
/// ratio τ/p (0 without pressure), whether the yield stress is reached (1; 0 below it), for grains I = |γ̇| D/√(p/ρ_s), and what
/// the law keeps of each particle.
pub(super) fn of_flow<const D: usize>(simulation: &Simulation<D>) -> Frame
where
    Simulation<D>: Compiled<D>,
{
    let snapshot = simulation.snapshot();
    let law = simulation.rheology();
    let rates: Vec<f64> = snapshot.velocity_gradient.iter().map(shear_rate).collect();
    let stresses: Vec<f64> = snapshot.stress.iter().map(equivalent_shear_stress).collect();
    let under_load = |value: f64, pressure: f64| if pressure > 0.0 { value } else { 0.0 };
    let pressed = |values: &[f64], of: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
        values
            .iter()
            .zip(&snapshot.pressure)
            .map(|(value, pressure)| under_load(of(*value, *pressure), *pressure))
            .collect()
    };
    // a law without a yield surface has no such line: there only what flows freely is mobilised
    let kept = |index: usize| {
        let field = snapshot.field.get(index).copied().unwrap_or(0.0);
        FieldStep::alone(field).with_memory(snapshot.memory.get(index).copied().unwrap_or_default())
    };
    let elasticity = |(index, (stress, pressure)): (usize, (&f64, &f64))| {
        law.elasticity(*stress, pressure.max(0.0), &kept(index), simulation.elastic_viscosity())
    };
    let states = stresses.iter().zip(&snapshot.pressure).enumerate();
    let mobilised = states.map(|state| if elasticity(state) > 0.0 { 0.0 } else { 1.0 }).collect();
    let mut frame = Frame::of_flow(&snapshot);
    // what cannot be told of a body at rest, and is no field of the solver
    frame.scalars.retain(|(name, ..)| name != "viscosity");
    frame.scalars.insert(0, identities(snapshot.mass.len()));
    frame.scalars.push(named("stress_ratio", "-", pressed(&stresses, &|stress, pressure| stress / pressure)));
    frame.scalars.push(named("mobilised", "-", mobilised));
    if let (Some(diameter), Some(density)) = (law.grain_diameter(), law.grain_density()) {
        let inertia = |rate: f64, pressure: f64| rate * diameter / (pressure / density).sqrt();
        frame.scalars.push(named("inertial_number", "-", pressed(&rates, &inertia)));
    }
    if let Some(field) = law.field() {
        frame.scalars.push(named(field.name, field.unit, snapshot.field.clone()));
    }
    for (place, memory) in law.memories().iter().enumerate() {
        let values = snapshot.memory.iter().map(|values| values[place]).collect();
        frame.scalars.push(named(memory.name, memory.unit, values));
    }
    frame
}

/// Wall particles with the quantities extrapolated from the flow.
pub(super) fn of_walls<const D: usize>(simulation: &Simulation<D>) -> Option<Frame> {
    let particles = simulation.particles();
    let walls = particles.flow_count()..particles.flow_count() + particles.wall_count();
    if walls.is_empty() {
        return None;
    }
    Some(Frame {
        time: simulation.time(),
        position: particles.position[walls.clone()].iter().map(flat).collect(),
        scalars: vec![named("pressure", "Pa", particles.pressure[walls.clone()].to_vec())],
        vectors: vec![named("velocity", "m/s", particles.velocity[walls].iter().map(flat).collect())],
    })
}

/// Both phases of an incompressible flow.
pub(super) fn of_phases(simulation: &IncompressibleSimulation<2>) -> Frame {
    let snapshot = simulation.snapshot();
    let mut frame = Frame::of_phases(&snapshot);
    let masses = snapshot.fluid.mass.iter().chain(&snapshot.sediment.mass).copied().collect();
    frame.scalars.insert(0, identities(frame.position.len()));
    frame.scalars.push(named("mass", "kg", masses));
    frame
}

/// The particles of the floor under the fluid, which do not move.
pub(super) fn of_floor<const D: usize>(simulation: &IncompressibleSimulation<D>) -> Option<Frame> {
    let wall = &simulation.scene().fluid.wall;
    let position: Vec<[f64; 3]> = wall.iter().map(flat).collect();
    (!position.is_empty()).then(|| Frame {
        time: simulation.time(),
        position,
        scalars: Vec::new(),
        vectors: Vec::new(),
    })
}
