//! Cost of an incompressible step, per particle and step, searches included:
//! `cargo bench -p bagnold-benches --bench projection -- [still clear bed columns] [1400 5000 20000 80000] [1 2 threads …]`.
//!
//! A bench goes on from step to step of a run that has settled for a while, and prints CPU time, wall-clock time, what the
//! linear solves took and the searches. Numbers up to 64 are threads, larger ones sizes.

mod water;

use bagnold_solver::incompressible::{IncompressibleSimulation, SolverCost};
use cpu_time::ProcessTime;
use std::time::Instant;
use water::{Kind, scene};

/// Refinements with the name of their size, steps before a measurement starts (an opening phase has other pressures, and
/// buffers grow), and steps that are measured.
const SIZES: [(usize, u32, usize, usize); 4] =
    [(1400, 1, 800, 800), (5000, 2, 600, 400), (20_000, 4, 300, 100), (80_000, 8, 100, 24)];
const MOST_THREADS: usize = 64;

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let numbers: Vec<usize> = arguments.iter().filter_map(|argument| argument.parse().ok()).collect();
    let chosen = |number: usize| numbers.contains(&number);
    let threads: Vec<usize> = numbers.iter().copied().filter(|&number| number <= MOST_THREADS).collect();
    let named = |kind: &Kind| arguments.iter().any(|argument| argument == kind.name());
    let every_kind = !Kind::ALL.iter().any(named);
    let every_size = !SIZES.iter().any(|size| chosen(size.0));
    for kind in Kind::ALL.into_iter().filter(|kind| every_kind || named(kind)) {
        for (_, refinement, settling, steps) in SIZES.into_iter().filter(|size| every_size || chosen(size.0)) {
            for &threads in if threads.is_empty() { &[1][..] } else { &threads } {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
                pool.install(|| measure(kind, refinement, settling, steps, threads));
            }
        }
    }
}

fn advance(simulation: &mut IncompressibleSimulation<2>) {
    if let Err(divergence) = simulation.step() {
        panic!("{divergence}");
    }
}

fn measure(kind: Kind, refinement: u32, settling: usize, steps: usize, threads: usize) {
    let mut simulation = IncompressibleSimulation::new(scene(kind, refinement, 11)).expect("a valid scene");
    (0..settling).for_each(|_| advance(&mut simulation));
    let particles = simulation.free_particles();
    let before = simulation.cost();
    let (mut least, mut total, mut total_wall) = (f64::INFINITY, 0.0, 0.0);
    for _ in 0..steps {
        let (wall, cpu) = (Instant::now(), ProcessTime::now());
        advance(&mut simulation);
        let cpu = cpu.elapsed().as_secs_f64();
        least = least.min(cpu);
        total += cpu;
        total_wall += wall.elapsed().as_secs_f64();
    }
    let per_step = 1e6 / particles as f64;
    let mean = per_step / steps as f64;
    let after = simulation.cost();
    let iterations = |count: fn(&SolverCost) -> u64| (count(&after) - count(&before)) as f64 / steps as f64;
    println!(
        "{:8} {particles:6} particles, {threads} threads: CPU least {:.3} mean {:.3}, wall mean {:.3} µs per particle-step; \
         iterations {:.1} velocities, {:.1} pressure, {:.1} sediment's; {:.3} searches",
        kind.name(),
        least * per_step,
        total * mean,
        total_wall * mean,
        iterations(|cost| cost.velocity_iterations),
        iterations(|cost| cost.fluid_pressure_iterations),
        iterations(|cost| cost.sediment_pressure_iterations),
        iterations(|cost| cost.searches),
    );
}
