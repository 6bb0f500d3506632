//! Cost of a neighbour search and of a step, per particle: `cargo bench -p bagnold-benches`.
//!
//! A step bench advances through the opening phase of a dam break, at rest at first: a search is rare and is measured
//! by `neighbour_list`. A bench is named by law, h/Δ, particles and threads.

mod scenes;

use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use rayon::{ThreadPool, ThreadPoolBuilder};
use scenes::Law;
use std::time::{Duration, Instant};

/// Particles of the step benches `[-]`.
const SIZES: [usize; 3] = [5_000, 50_000, 500_000];
/// Particles of the step bench in three dimensions `[-]`.
const SIZE_IN_SPACE: usize = 100_000;
/// Steps before a measurement starts, so that caches, lists and buffers are warm.
const WARM_UP: usize = 4;

fn pool(threads: usize) -> ThreadPool {
    ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool")
}

fn advance<const D: usize>(simulation: &mut Simulation<D>)
where
    Simulation<D>: Compiled<D>,
{
    if let Err(divergence) = simulation.step() {
        panic!("{divergence}");
    }
}

/// One bench of a step on 1 and on 2 threads.
fn step<const D: usize>(group: &mut BenchmarkGroup<'_, WallTime>, law: Law, size: usize, name: &str)
where
    Simulation<D>: Compiled<D>,
{
    let scene = scenes::dam_break::<D>(size, law);
    group.throughput(Throughput::Elements(scene.flow.position.len() as u64));
    for threads in [1, 2] {
        // set up when the bench is first run: a bench that is filtered out costs nothing
        let mut prepared = None;
        let id = BenchmarkId::new(name, format!("{size}_particles_{threads}_threads"));
        group.bench_function(id, |bencher| {
            let (pool, simulation) = prepared.get_or_insert_with(|| {
                let pool = pool(threads);
                let mut simulation = pool.install(|| Simulation::new(scene.clone()).expect("a valid scene"));
                pool.install(|| (0..WARM_UP).for_each(|_| advance(&mut simulation)));
                (pool, simulation)
            });
            bencher.iter(|| pool.install(|| advance(simulation)));
        });
    }
}

fn steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("step");
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    group.warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_millis(1500));
    for law in [Law::Newtonian, Law::MuI { smoothing_ratio: 1.3 }, Law::MuI { smoothing_ratio: 1.5 }] {
        for size in SIZES {
            step::<2>(&mut group, law, size, &law.name());
        }
    }
    let law = Law::MuI { smoothing_ratio: 1.3 };
    step::<3>(&mut group, law, SIZE_IN_SPACE, &format!("in_space_{}", law.name()));
    group.finish();
}

/// The cost of a search is that of the steps of a drifting block, which search every time, less that of the same
/// steps of the block at rest, which never do.
fn neighbour_list(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("neighbour_list");
    group.sample_size(10).sampling_mode(SamplingMode::Flat);
    group.warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_millis(1500));
    for smoothing_ratio in [1.3, 1.5] {
        let [drifting, resting] = scenes::drifting_and_resting(50_000, smoothing_ratio);
        group.throughput(Throughput::Elements(drifting.flow.position.len() as u64));
        for threads in [1, 2] {
            let pool = pool(threads);
            let mut simulations = [&drifting, &resting]
                .map(|scene| pool.install(|| Simulation::new(scene.clone()).expect("a valid scene")));
            // a new simulation has just searched, so its first step does not
            for simulation in &mut simulations {
                pool.install(|| advance(simulation));
            }
            let name =
                BenchmarkId::new(format!("h_over_dx_{smoothing_ratio}"), format!("50000_particles_{threads}_threads"));
            group.bench_function(name, |bencher| {
                bencher.iter_custom(|iterations| {
                    let searches = simulations[0].neighbour_searches();
                    let [with, without] = simulations.each_mut().map(|simulation| {
                        let start = Instant::now();
                        pool.install(|| (0..iterations).for_each(|_| advance(simulation)));
                        start.elapsed()
                    });
                    assert!(simulations[0].neighbour_searches() >= searches + iterations, "a search in every step");
                    with.saturating_sub(without)
                });
            });
        }
    }
    group.finish();
}

criterion_group!(benches, neighbour_list, steps);
criterion_main!(benches);
