//! What a run of millions costs: `cargo bench -p bagnold-benches --bench scale -- 50000 500000 5000000`, on all cores.
//!
//! For each size a column of grains in space: set-up, memory, steps with and without a search by wall clock and CPU time, and
//! the bytes of a saved state.

mod scenes;

use bagnold_solver::weakly_compressible::simulation::Simulation;
use cpu_time::ProcessTime;
use scenes::Law;
use std::time::Instant;

/// Sizes that are taken if none is named `[-]`.
const SIZES: [usize; 2] = [50_000, 500_000];
/// Steps before any is measured.
const WARM_UP: usize = 4;
/// Steps that are measured.
const STEPS: usize = 12;

fn main() {
    let named: Vec<usize> = std::env::args().filter_map(|argument| argument.parse().ok()).collect();
    for &size in if named.is_empty() { &SIZES[..] } else { &named } {
        of_size(size);
    }
}

fn of_size(size: usize) {
    let start = Instant::now();
    let before = resident();
    let scene = scenes::dam_break::<3>(size, Law::MuI { smoothing_ratio: 1.3 });
    let particles = scene.flow.position.len() as f64;
    let mut simulation = Simulation::new(scene).expect("a valid scene");
    for _ in 0..WARM_UP {
        simulation.step().expect("a stable step");
    }
    let memory = (resident() - before) / particles;
    println!(
        "{particles} particles, {} threads: ready after {:.1} s, {memory:.0} B a particle",
        rayon::current_num_threads(),
        start.elapsed().as_secs_f64()
    );
    let mut samples = Vec::new();
    for _ in 0..STEPS {
        let searches = simulation.neighbour_searches();
        let (wall, cpu) = (Instant::now(), ProcessTime::now());
        simulation.step().expect("a stable step");
        let (wall, cpu) = (wall.elapsed().as_secs_f64(), cpu.elapsed().as_secs_f64());
        samples.push((cpu * 1e9 / particles, wall * 1e9 / particles, simulation.neighbour_searches() > searches));
    }
    for (searched, name) in [(false, "steps without a search"), (true, "steps with a search")] {
        let chosen = || samples.iter().filter(move |sample| sample.2 == searched);
        let least = |value: fn(&(f64, f64, bool)) -> f64| chosen().map(value).fold(f64::INFINITY, f64::min);
        if chosen().next().is_some() {
            println!(
                "  {name} ({}): CPU {:.0}, wall {:.0} ns a particle",
                chosen().count(),
                least(|s| s.0),
                least(|s| s.1)
            );
        }
    }
}

/// Memory that the process has in use `[B]`; none that is known outside of Linux.
fn resident() -> f64 {
    let pages = std::fs::read_to_string("/proc/self/statm").ok();
    let pages = pages.and_then(|text| text.split_whitespace().nth(1)?.parse::<f64>().ok());
    pages.map_or(f64::NAN, |pages| 4096.0 * pages)
}
