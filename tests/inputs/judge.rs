//! Judgement of a generated input.

use crate::inputs::changes::{Input, inputs};
use bagnold_harness::case::{Changes, PreparedCase, Silent, Tier, execute};
use bagnold_harness::metric::Verdict;
use bagnold_harness::store::{Store, StorePolicy};
use bagnold_validation::REGISTRY;
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use std::panic::AssertUnwindSafe;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::time::Duration;

/// A refusal, or the check of what is taken, must not take longer.
const PATIENCE: Duration = Duration::from_secs(5);

/// Expected time on one core above which an input is taken as given and not computed `[s]`.
const WORTH_COMPUTING: f64 = 0.3;

/// A run that is expected to take a third of a second and takes longer than this on a busy machine is endless.
const LONGEST_RUN: Duration = Duration::from_secs(120);

/// Longest message `[characters]`.
const LONGEST_MESSAGE: usize = 1500;

/// Number of inputs that are tried, unless `BAGNOLD_INPUTS` sets another.
const USUAL: u32 = 120;

#[derive(Debug, Default)]
struct Tally {
    refused: usize,
    taken: usize,
    computed: usize,
    offences: Vec<String>,
}

/// Does something on a thread of its own; an offence if it panics or takes too long.
fn watched<T: Send + 'static>(patience: Duration, work: impl FnOnce() -> T + Send + 'static) -> Result<T, String> {
    let (sender, receiver) = channel();
    std::thread::spawn(move || {
        // a receiver that has given up is not an error
        let _ = sender.send(std::panic::catch_unwind(AssertUnwindSafe(work)));
    });
    match receiver.recv_timeout(patience) {
        Ok(Ok(value)) => Ok(value),
        Ok(Err(_)) => Err("panicked".to_owned()),
        Err(RecvTimeoutError::Timeout) => Err(format!("took longer than {} s", patience.as_secs())),
        Err(RecvTimeoutError::Disconnected) => Err("ended without a word".to_owned()),
    }
}

fn prepared(input: &Input) -> Result<Box<dyn PreparedCase>, String> {
    let changes = Changes { settings: &input.settings, ..Changes::default() };
    let case = REGISTRY.find(input.case).map_err(|error| error.to_string())?;
    case.prepare(Tier::Quick, &changes).map_err(|error| error.to_string())
}

/// Whether a message names a field that the input sets, or one that holds it or lies within; of a field that the input makes
/// necessary it says that it is missing.
fn names_a_field(message: &str, input: &Input) -> bool {
    if message.contains("`: missing; ") {
        return true;
    }
    let quoted: Vec<&str> = message.split('`').skip(1).step_by(2).collect();
    input.settings.iter().filter_map(|setting| setting.split('=').next()).any(|path| {
        quoted.iter().any(|name| {
            let name = name.trim_start_matches("--set ").split(['=', '[']).next().unwrap_or_default();
            name == path || name.starts_with(&format!("{path}.")) || path.starts_with(&format!("{name}."))
        })
    })
}

fn refusal(message: &str, input: &Input, tally: &mut Tally) {
    tally.refused += 1;
    if !names_a_field(message, input) {
        tally.offences.push(format!("{input:?}: names no field: {message}"));
    }
    if message.chars().count() > LONGEST_MESSAGE {
        tally.offences.push(format!("{input:?}: says {} characters", message.chars().count()));
    }
}

/// Simulates and judges; `None` for a refusal, else the gates that hold without a number.
fn computed(prepared: Box<dyn PreparedCase>) -> Result<Vec<String>, String> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().map_err(|error| error.to_string())?;
    let results = pool.install(|| execute(vec![prepared], &Store::open(StorePolicy::Bypass), &Silent));
    let results = results.map_err(|error| error.to_string())?;
    let metrics = results.iter().flat_map(|result| &result.metrics);
    let hollow = metrics.filter(|metric| metric.verdict() == Verdict::Pass && !metric.value.is_finite());
    Ok(hollow.map(|metric| format!("{} {} passes with {}", metric.name, metric.variant, metric.value)).collect())
}

fn judge(input: &Input, tally: &mut Tally) {
    let of_thread = input.clone();
    let prepared = match watched(PATIENCE, move || prepared(&of_thread)) {
        Err(offence) => return tally.offences.push(format!("{input:?}: {offence}")),
        Ok(Err(message)) => return refusal(&message, input, tally),
        Ok(Ok(prepared)) => prepared,
    };
    tally.taken += 1;
    if prepared.estimate_of_all().core_seconds > WORTH_COMPUTING {
        return;
    }
    tally.computed += 1;
    match watched(LONGEST_RUN, move || computed(prepared)) {
        Err(offence) => tally.offences.push(format!("{input:?}: {offence} as it ran")),
        Ok(Err(message)) => refusal(&message, input, tally),
        Ok(Ok(hollow)) => {
            tally.offences.extend(hollow.into_iter().map(|metric| format!("{input:?}: {metric}")));
        }
    }
}

pub(crate) fn count() -> u32 {
    std::env::var("BAGNOLD_INPUTS").ok().and_then(|text| text.parse().ok()).unwrap_or(USUAL)
}

/// A runner whose inputs are the same every time.
pub(crate) fn runner() -> TestRunner {
    let config = Config { failure_persistence: None, ..Config::default() };
    TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha))
}

#[test]
fn every_input_is_refused_by_name_or_taken_and_nothing_passes_without_a_number() {
    let mut runner = runner();
    let strategy = inputs();
    let mut tally = Tally::default();
    for _ in 0..count() {
        let input = strategy.new_tree(&mut runner).expect("an input").current();
        judge(&input, &mut tally);
    }
    println!(
        "{} inputs: {} refused, {} taken, {} of them computed, {} offences",
        count(),
        tally.refused,
        tally.taken,
        tally.computed,
        tally.offences.len()
    );
    assert!(tally.refused > 0 && tally.taken > 0, "{tally:?}");
    assert!(tally.offences.is_empty(), "{}", tally.offences.join("\n"));
}
