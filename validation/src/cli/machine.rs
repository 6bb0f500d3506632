//! Speed of this machine, from a flow that takes a moment.

use super::profile::processor_seconds;
use bagnold_solver::domain::Domain;
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use bagnold_solver::weakly_compressible::simulation::Simulation;
use rustix::time::ClockId;
use std::f64::consts::TAU;

/// Rows of the flow.
const ROWS: usize = 20;
/// Steps that are timed together.
const STEPS: usize = 4;
/// Time that may be spent `[s]`.
const ALLOWED: f64 = 0.04;

/// Time of the processor for a particle-step of a small flow on one thread `[µs]`, the fastest of several: what else runs at
/// the moment does not count. `None` if nothing could be measured.
pub(super) fn microseconds_each() -> Option<f64> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().ok()?;
    pool.install(measure)
}

fn measure() -> Option<f64> {
    let spacing = 1.0 / ROWS as f64;
    let place = |k: usize| Vector::<2>::new((k % ROWS) as f64 + 0.5, (k / ROWS) as f64 + 0.5) * spacing;
    let mut flow = Flow::at_rest((0..ROWS * ROWS).map(place).collect(), 1000.0, spacing);
    flow.velocity = flow.position.iter().map(|x| Vector::<2>::new((TAU * x[1]).sin(), 0.0)).collect();
    let liquid = EquationOfState { reference_density: 1000.0, bulk_modulus: 1e5, tension: Tension::Kept };
    let law = Rheology::Newtonian(Newtonian { viscosity: 50.0 });
    let domain = Domain::periodic([0.0; 2], [1.0; 2]);
    let mut simulation = Simulation::new(Scene { domain, ..Scene::unbounded(flow, spacing, liquid, law) }).ok()?;
    let begun = processor_seconds(ClockId::ThreadCPUTime);
    let mut fastest = f64::INFINITY;
    while processor_seconds(ClockId::ThreadCPUTime) - begun < ALLOWED {
        let last = processor_seconds(ClockId::ThreadCPUTime);
        for _ in 0..STEPS {
            simulation.step().ok()?;
        }
        fastest = fastest.min(processor_seconds(ClockId::ThreadCPUTime) - last);
    }
    Some(1e6 * fastest / (STEPS * ROWS * ROWS) as f64).filter(|each| *each > 0.0 && each.is_finite())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_machine_is_measured_in_a_moment() {
        let speed = microseconds_each().expect("a flow that continues");
        assert!((0.01..1000.0).contains(&speed), "{speed} µs a particle and step");
    }
}
