//! Limits of one core, which `docs/dev/performance.md` holds the passes against: `cargo bench -p bagnold-benches --bench ceiling`.
//!
//! The lanes multiply and add in registers, in f64 and in f32, and a sum of two arrays, far larger than any cache, is written to a third.
//! The best of some rounds counts, by CPU time, so that what else the machine does matters little.

use bagnold_solver::lanes::{InstructionSet, LANES, LaneNumbers, LanePass, Lanes};
use cpu_time::ProcessTime;
use std::hint::black_box;

const ROUNDS: usize = 15;
/// Multiplications and additions of each sum.
const TERMS: usize = 2_000_000;
/// Sums that do not wait for each other: as many as fill the registers.
const SUMS: [usize; 2] = [6, 12];
/// Values of an array.
const VALUES: usize = 1 << 24;

struct Terms<const SINGLE: bool>;

impl<const SINGLE: bool> LanePass for Terms<SINGLE> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        if SINGLE {
            sum::<V::Single, { SUMS[1] }>();
        } else {
            sum::<V, { SUMS[0] }>();
        }
    }
}

#[inline(always)]
fn sum<N: LaneNumbers, const COUNT: usize>() {
    let (factor, term) = (N::splat(black_box(0.999)), N::splat(black_box(0.001)));
    let mut sums = [N::splat(black_box(1.0)); COUNT];
    for _ in 0..TERMS {
        for sum in &mut sums {
            *sum = *sum * factor + term;
        }
    }
    for sum in sums {
        black_box(sum.to_array());
    }
}

/// The least time of a round `[s]`.
fn least(mut round: impl FnMut()) -> f64 {
    let mut time = || {
        let start = ProcessTime::now();
        round();
        start.elapsed().as_secs_f64()
    };
    (0..ROUNDS).map(|_| time()).fold(f64::INFINITY, f64::min)
}

fn main() {
    let set = InstructionSet::best();
    let operations = |sums: usize| (2 * LANES * TERMS * sums) as f64 * 1e-9;
    println!("{}, one core", set.name());
    println!("f64: {:.1} Gflop/s", operations(SUMS[0]) / least(|| set.run(Terms::<false>)));
    println!("f32: {:.1} Gflop/s", operations(SUMS[1]) / least(|| set.run(Terms::<true>)));
    let (one, other, mut out) = (vec![1.0; VALUES], vec![2.0; VALUES], vec![0.0; VALUES]);
    let seconds = least(|| {
        for ((out, one), other) in out.iter_mut().zip(&one).zip(&other) {
            *out = one + 3.0 * other;
        }
        black_box(&mut out);
    });
    println!("memory: {:.1} GB/s", (24 * VALUES) as f64 * 1e-9 / seconds);
}
