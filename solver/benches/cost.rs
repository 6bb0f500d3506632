//! Cost of a step in a flow that moves, per particle: `cargo bench -p bagnold-benches --bench cost -- plain-50k space-100k@2`.
//!
//! Each case is a block of disordered particles that spreads over its bed, so that the list is searched every few steps as in a
//! collapse that has developed. Of each there is a row: CPU time of steps without a search (least and median), what a search adds
//! (difference of the least), the mean of all steps, searches included, by CPU time and by wall clock, and resident memory, all
//! per particle. A name may end in `@THREADS`. Without names, a few cases that take seconds are measured.
//!
//! Two versions of the solver are compared by `compare.sh`, which runs this bench for both in turns.

mod scenes;

use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use cpu_time::ProcessTime;
use rayon::ThreadPoolBuilder;
use scenes::Law;
use std::time::Instant;

/// Steps before any is measured: the list and the buffers grow to their sizes.
const WARM_UP: usize = 6;
/// Particle-steps that are measured, and the least number of steps.
const PARTICLE_STEPS: usize = 2_000_000;
const LEAST_STEPS: usize = 12;
/// Measured if none is named.
const CASES: [&str; 5] = ["plain-50k", "mui20-50k", "mui28-50k", "mui28-5k", "space-100k"];

fn main() {
    let named: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    println!("case,threads,particles,step_ns,step_median_ns,search_ns,mean_ns,mean_wall_ns,steps_a_search,memory_B");
    let cases = if named.is_empty() { CASES.map(str::to_owned).to_vec() } else { named };
    for case in &cases {
        match measure(case) {
            Some(row) => println!("{case},{row}"),
            None => {
                eprintln!("`{case}` is no case: one is LAW-SIZE or LAW-SIZE@THREADS, LAW plain, mui20, mui28 or space");
                std::process::exit(2);
            }
        }
    }
}

fn measure(case: &str) -> Option<String> {
    let (name, threads) = case.split_once('@').unwrap_or((case, "1"));
    let (law, size) = name.split_once('-')?;
    let (threads, size) = (threads.parse().ok()?, size_of(size)?);
    match law {
        "plain" => Some(steps::<2>(Law::Newtonian, size, threads)),
        "mui20" => Some(steps::<2>(Law::MuI { smoothing_ratio: 1.3 }, size, threads)),
        "mui28" => Some(steps::<2>(Law::MuI { smoothing_ratio: 1.5 }, size, threads)),
        "space" => Some(steps::<3>(Law::MuI { smoothing_ratio: 1.3 }, size, threads)),
        _ => None,
    }
}

/// `5k` or `5000`.
fn size_of(text: &str) -> Option<usize> {
    match text.strip_suffix('k') {
        Some(thousands) => Some(1000 * thousands.parse::<usize>().ok()?),
        None => text.parse().ok(),
    }
}

fn steps<const D: usize>(law: Law, size: usize, threads: usize) -> String
where
    Simulation<D>: Compiled<D>,
{
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
    let scene = scenes::spreading::<D>(size, law);
    let particles = scene.flow.position.len();
    let before = resident();
    let mut simulation = pool.install(|| Simulation::new(scene).expect("a valid scene"));
    let mut step = || {
        let searches = simulation.neighbour_searches();
        let (wall, cpu) = (Instant::now(), ProcessTime::now());
        pool.install(|| simulation.step()).expect("a stable step");
        let searched = simulation.neighbour_searches() > searches;
        Sample { cpu: cpu.elapsed().as_secs_f64(), wall: wall.elapsed().as_secs_f64(), searched }
    };
    for _ in 0..WARM_UP {
        step();
    }
    let memory = (resident() - before) / particles as f64;
    let samples: Vec<Sample> = (0..LEAST_STEPS.max(PARTICLE_STEPS / particles)).map(|_| step()).collect();
    let per_particle = 1e9 / particles as f64;
    let sorted = |searched: bool| {
        let mut costs: Vec<f64> = samples.iter().filter(|s| s.searched == searched).map(|s| s.cpu).collect();
        costs.sort_by(f64::total_cmp);
        costs
    };
    let (without, with) = (sorted(false), sorted(true));
    let least = |costs: &[f64]| costs.first().map_or(f64::NAN, |cost| cost * per_particle);
    let median = without.get(without.len() / 2).map_or(f64::NAN, |cost| cost * per_particle);
    let mean = |cost: fn(&Sample) -> f64| samples.iter().map(cost).sum::<f64>() / samples.len() as f64 * per_particle;
    format!(
        "{threads},{particles},{:.1},{median:.1},{:.1},{:.1},{:.1},{:.2},{memory:.0}",
        least(&without),
        least(&with) - least(&without),
        mean(|sample| sample.cpu),
        mean(|sample| sample.wall),
        samples.len() as f64 / with.len() as f64
    )
}

/// Times of one step `[s]`, and whether it searched neighbours.
struct Sample {
    cpu: f64,
    wall: f64,
    searched: bool,
}

/// Memory that the process has in use `[B]`; none that is known outside of Linux.
fn resident() -> f64 {
    let pages = std::fs::read_to_string("/proc/self/statm").ok();
    let pages = pages.and_then(|text| text.split_whitespace().nth(1)?.parse::<f64>().ok());
    pages.map_or(f64::NAN, |pages| 4096.0 * pages)
}
