//! The same bits from the same case, whatever the number of threads. Nothing is taken from the store.

use bagnold_harness::case::{CaseResult, Changes, Silent, Tier, execute};
use bagnold_harness::store::{Store, StorePolicy};
use bagnold_validation::REGISTRY;

/// One run from rest at 24°.
const SHORT: &[&str] = &["variants=[]"];

/// 120 particles.
const SMALL: &[&str] = &["resolution=10", "columns=12", "duration_factor=0.05", "averaging_time=0.05"];

/// Few rows flow in few steps; 8400 particles are enough for every parallel loop to be split.
const WIDE: &[&str] =
    &["resolution=6", "columns=1400", "preparation=none", "duration_factor=0.02", "averaging_time=0.02"];

fn run(settings: &[&[&str]], threads: usize) -> CaseResult {
    let settings: Vec<String> = settings.concat().into_iter().map(str::to_owned).collect();
    let changes = Changes { file: None, settings: &settings, ..Changes::default() };
    let prepared = REGISTRY.find("bagnold").and_then(|case| case.prepare(Tier::Quick, &changes)).expect("valid input");
    let store = Store::open(StorePolicy::Bypass);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
    let mut results = pool.install(|| execute(vec![prepared], &store, &Silent)).expect("a valid scene");
    let result = results.pop().expect("one case");
    assert_eq!(result.runs.len(), 1);
    assert!(!result.runs[0].from_store);
    assert_eq!(result.runs[0].threads, threads, "the run has all threads to itself");
    assert_eq!(result.unexpected_divergences().count(), 0);
    assert!(result.runs[0].steps > 20, "{} steps", result.runs[0].steps);
    result
}

/// All metrics with all their digits. A run so short has not come to the times of some, which are then not a number and so equal
/// to nothing, not even to themselves.
fn digits(result: &CaseResult) -> String {
    format!("{:?}", result.metrics)
}

#[test]
fn one_and_two_threads_end_in_the_same_bits() {
    let [one, two] = [1, 2].map(|threads| run(&[SHORT, WIDE], threads));
    assert_eq!(one.state_hash, two.state_hash);
    assert_eq!(one.runs[0].steps, two.runs[0].steps);
    assert_eq!(digits(&one), digits(&two));
    assert_eq!(one.frames, two.frames);
}

#[test]
fn two_runs_in_one_process_end_in_the_same_bits() {
    let [first, second] = [(), ()].map(|()| run(&[SHORT, SMALL], 1));
    assert_eq!(first.state_hash, second.state_hash);
    assert_eq!(digits(&first), digits(&second));
    assert_eq!(first.frames, second.frames);
}

#[test]
fn other_displacements_end_in_other_bits() {
    let [first, second] = ["seed=1", "seed=2"].map(|seed| run(&[SHORT, SMALL, &[seed]], 1));
    assert_ne!(first.state_hash, second.state_hash);
}
