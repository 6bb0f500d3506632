//! Cost of the nonlocal law's step over that of the local law's: `cargo bench -p bagnold-benches --bench nonlocal`.
//!
//! Two layers of the same beads with the same particles flow down a slope, one under each law, in turns of some steps each, so that
//! what else the machine does falls on both. The CPU time of a turn is that of its steps without a search: what the laws differ in.
//! Of each round there is a row, of all the medians. The program fails if the median of the ratio exceeds the limit. An
//! argument, such as 20000, is the number of particles.

mod scenes;

use bagnold_solver::material::rheology::{MuI, NonlocalMuI, Rheology};
use bagnold_solver::weakly_compressible::simulation::Simulation;
use cpu_time::ProcessTime;
use rayon::{ThreadPool, ThreadPoolBuilder};

/// Particles, unless a number is given.
const PARTICLES: usize = 10_000;
/// Steps before any is measured: lists, buffers and the fluidity grow to their sizes.
const WARM_UP: usize = 200;
/// Steps of a turn, and the least number without a search among them.
const STEPS: u32 = 100;
const LEAST_STEPS: u32 = 20;
/// Rounds, one turn of each law.
const ROUNDS: usize = 9;
/// Largest median of the ratio: what the law was planned to cost.
const LIMIT: f64 = 1.4;

const BEADS: MuI = MuI {
    static_friction: 0.382,
    limiting_friction: 0.643,
    reference_inertia: 0.279,
    grain_diameter: 0.5e-3,
    grain_density: 2500.0,
};

fn main() {
    let size = std::env::args().skip(1).find_map(|argument| argument.parse().ok()).unwrap_or(PARTICLES);
    let pool = ThreadPoolBuilder::new().num_threads(1).build().expect("a thread pool");
    let laws = [Rheology::MuI(BEADS), Rheology::NonlocalMuI(NonlocalMuI::of(BEADS))];
    let mut flows = laws.map(|law| {
        let scene = scenes::on_a_slope(size, BEADS, law);
        let mut simulation = pool.install(|| Simulation::new(scene).expect("a valid scene"));
        pool.install(|| (0..WARM_UP).for_each(|_| simulation.step().expect("a stable step")));
        simulation
    });
    let particles = flows[0].particles().flow_count();
    println!("round,local_ns,nonlocal_ns,ratio   ({particles} particles, CPU time per particle and step)");
    let (mut costs, mut ratios) = ([Vec::new(), Vec::new()], Vec::new());
    for round in 1..=ROUNDS {
        // the law that begins changes from round to round
        let mut cost = [0.0; 2];
        for turn in 0..2 {
            let law = (round + turn) % 2;
            cost[law] = 1e9 * turn_of(&mut flows[law], &pool) / particles as f64;
        }
        println!("{round},{:.1},{:.1},{:.3}", cost[0], cost[1], cost[1] / cost[0]);
        ratios.push(cost[1] / cost[0]);
        costs.iter_mut().zip(cost).for_each(|(costs, cost)| costs.push(cost));
    }
    let steps = flows.each_ref().map(|flow| flow.time() / flow.steps() as f64);
    let [local, nonlocal] = costs.map(median);
    let ratio = median(ratios);
    println!(
        "median,{local:.1},{nonlocal:.1},{ratio:.3}   (limit {LIMIT}; mean steps {:.3e} and {:.3e} s)",
        steps[0], steps[1]
    );
    if ratio > LIMIT {
        std::process::exit(1);
    }
}

/// Mean CPU time of a step without a search `[s]`.
fn turn_of(simulation: &mut Simulation<2>, pool: &ThreadPool) -> f64 {
    let (mut spent, mut count) = (0.0, 0_u32);
    for _ in 0..STEPS {
        let (searches, start) = (simulation.neighbour_searches(), ProcessTime::now());
        pool.install(|| simulation.step()).expect("a stable step");
        if simulation.neighbour_searches() == searches {
            (spent, count) = (spent + start.elapsed().as_secs_f64(), count + 1);
        }
    }
    if count < LEAST_STEPS {
        eprintln!(
            "{count} of {STEPS} steps were without a search: a layer of so many particles is too fast; take fewer"
        );
        std::process::exit(2);
    }
    spent / f64::from(count)
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values[values.len() / 2]
}
