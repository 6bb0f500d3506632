//! Cost of runs with millions of particles, on all cores:
//! `cargo bench -p bagnold-benches --bench scale -- 50000 500000 5000000`.
//!
//! For each size a column of grains in space: set-up, memory, steps with and without a search by wall clock and CPU time, and
//! the bytes of a saved state.

mod scenes;

use bagnold_solver::weakly_compressible::SavedSimulation;
use bagnold_solver::weakly_compressible::simulation::Simulation;
use cpu_time::ProcessTime;
use scenes::Law;
use std::fs::File;
use std::io::{BufReader, BufWriter, Read, Write};
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
    checkpoint(&simulation, particles);
}

/// Writes the simulation to a file as a checkpoint holds it, reads it back, and takes it away.
fn checkpoint(simulation: &Simulation<3>, particles: f64) {
    let path = std::env::temp_dir().join(format!("bagnold-scale-{}.postcard", std::process::id()));
    let start = Instant::now();
    let file = BufWriter::with_capacity(1 << 20, File::create(&path).expect("a file"));
    let file = postcard::to_io(&simulation.save(), file).expect("written").into_inner().expect("written");
    file.sync_all().expect("on the disk");
    let (written, size) = (start.elapsed().as_secs_f64(), file.metadata().expect("its size").len() as f64);
    drop(file);
    let start = Instant::now();
    let mut bytes = Vec::new();
    BufReader::new(File::open(&path).expect("the file")).read_to_end(&mut bytes).expect("read");
    let read: SavedSimulation<'_, 3> = postcard::from_bytes(&bytes).expect("what was written");
    println!(
        "  a checkpoint: {:.2} GB, {:.0} B a particle, written in {written:.1} s, read in {:.1} s",
        size * 1e-9,
        size / particles,
        start.elapsed().as_secs_f64()
    );
    drop(read);
    std::fs::remove_file(&path).expect("gone");
    std::io::stdout().flush().expect("printed");
}

/// Memory that the process has in use `[B]`; none that is known outside of Linux.
fn resident() -> f64 {
    let pages = std::fs::read_to_string("/proc/self/statm").ok();
    let pages = pages.and_then(|text| text.split_whitespace().nth(1)?.parse::<f64>().ok());
    pages.map_or(f64::NAN, |pages| 4096.0 * pages)
}
