//! Cost of a step with pairs in double and in single precision: `cargo bench -p bagnold-benches --bench precision`.
//!
//! Both take turns, step by step, in one process, so that what else the machine does meets both alike. What is printed is CPU
//! time per particle: the least and the median of steps without a search, the least of steps with one, and the mean of all; and
//! what memory a particle takes.

mod scenes;

use bagnold_solver::weakly_compressible::numerics::{Numerics, PairPrecision};
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use cpu_time::ProcessTime;
use rayon::ThreadPoolBuilder;
use scenes::Law;

/// Steps before any is measured: in the first the list grows to its size.
const WARM_UP: usize = 6;
const PRECISIONS: [PairPrecision; 2] = [PairPrecision::Double, PairPrecision::Single];

/// CPU time of a step `[ns]` a particle, and whether it searched.
type Sample = (f64, bool);

fn compare<const D: usize>(smoothing_ratio: f64, size: usize, steps: usize, threads: usize)
where
    Simulation<D>: Compiled<D>,
{
    let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
    let scene = scenes::dam_break::<D>(size, Law::MuI { smoothing_ratio });
    let particles = scene.flow.position.len();
    let mut memory = [f64::NAN; 2];
    let mut simulations = PRECISIONS.map(|pair_precision| {
        let numerics = Numerics { pair_precision, ..scene.numerics };
        let before = resident();
        let mut simulation =
            pool.install(|| Simulation::new(Scene { numerics, ..scene.clone() }).expect("a valid scene"));
        for _ in 0..WARM_UP {
            pool.install(|| simulation.step()).expect("a stable step");
        }
        memory[usize::from(pair_precision == PairPrecision::Single)] = (resident() - before) / particles as f64;
        simulation
    });
    let mut samples: [Vec<Sample>; 2] = Default::default();
    for _ in 0..steps {
        for (simulation, samples) in simulations.iter_mut().zip(&mut samples) {
            let searches = simulation.neighbour_searches();
            let start = ProcessTime::now();
            pool.install(|| simulation.step()).expect("a stable step");
            let cost = start.elapsed().as_secs_f64() * 1e9 / particles as f64;
            samples.push((cost, simulation.neighbour_searches() > searches));
        }
    }
    let figures = samples.map(|samples| Figures::of(&samples));
    println!("{D}-D, h/Δ {smoothing_ratio}, {particles} particles, {threads} threads, {steps} steps each");
    for ((precision, figures), memory) in PRECISIONS.iter().zip(&figures).zip(memory) {
        let Figures { least, median, with_search, mean } = figures;
        println!(
            "  {precision:?}: least {least:.0}, median {median:.0}, with search {with_search:.0}, mean {mean:.0} ns; \
             {memory:.0} B resident"
        );
    }
    let [double, single] = &figures;
    let (least, median, mean) = (single.least / double.least, single.median / double.median, single.mean / double.mean);
    println!("  single over double: least {least:.3}, median {median:.3}, mean {mean:.3}");
}

/// Memory that the process has in use `[B]`; none that is known outside of Linux.
fn resident() -> f64 {
    let pages = std::fs::read_to_string("/proc/self/statm").ok();
    let pages = pages.and_then(|text| text.split_whitespace().nth(1)?.parse::<f64>().ok());
    pages.map_or(f64::NAN, |pages| 4096.0 * pages)
}

struct Figures {
    least: f64,
    median: f64,
    with_search: f64,
    mean: f64,
}

impl Figures {
    fn of(samples: &[Sample]) -> Self {
        let chosen = |searched: bool| {
            let mut costs: Vec<f64> =
                samples.iter().filter(|sample| sample.1 == searched).map(|sample| sample.0).collect();
            costs.sort_by(f64::total_cmp);
            costs
        };
        let (without, with) = (chosen(false), chosen(true));
        let first = |costs: &[f64]| costs.first().copied().unwrap_or(f64::NAN);
        Self {
            least: first(&without),
            median: without.get(without.len() / 2).copied().unwrap_or(f64::NAN),
            with_search: first(&with),
            mean: samples.iter().map(|sample| sample.0).sum::<f64>() / samples.len() as f64,
        }
    }
}

fn main() {
    // memory is told by what the process grows by: the largest first, which finds none that is free
    for threads in [1, 2] {
        compare::<3>(1.3, 100_000, 16, threads);
        for (smoothing_ratio, size, steps) in [(1.3, 50_000, 40), (1.5, 50_000, 40), (1.5, 5_000, 200)] {
            compare::<2>(smoothing_ratio, size, steps, threads);
        }
    }
}
