//! Expected time of a command: from its earlier runs on this machine, else from runs on another machine.

use super::machine;
use crate::case::{CaseResult, PreparedCase, speed_up, wall_time};
use crate::metric::Variant;
use crate::store::{AllSpeeds, Speeds, instruction_set, profile};
use bagnold_solver::material::rheology::open::registered;
use indicatif::HumanDuration;
use std::path::Path;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Times on the machine that the shipped estimates come from: `speeds.json` of its store after `bagnold report`.
const SHIPPED: &str = include_str!("speeds.json");

/// One run: its case, its name, and its time on one core that follows from its parameters `[s]`.
struct ExpectedRun {
    case: &'static str,
    variant: Variant,
    nominal: f64,
    cost: f64,
}

/// The runs of a command, in the order of their numbers, and the watch that is held beside them.
pub(super) struct Expectation {
    command: &'static str,
    begun: Instant,
    cases: Vec<&'static str>,
    runs: Vec<ExpectedRun>,
    /// Start of each run, and its duration `[s]` once it is done.
    times: Mutex<Vec<(Option<Instant>, Option<f64>)>>,
}

impl Expectation {
    /// Expectation for the runs of some cases, for a command of this name.
    pub(super) fn of(command: &'static str, cases: &[Box<dyn PreparedCase>]) -> Self {
        let of_case = |case: &dyn PreparedCase| -> Vec<ExpectedRun> {
            let run = |run: usize| ExpectedRun {
                case: case.name(),
                variant: case.variant(run),
                nominal: case.estimate(run).core_seconds,
                cost: case.estimate(run).particle_steps,
            };
            (0..case.run_count()).map(run).collect()
        };
        let runs: Vec<ExpectedRun> = cases.iter().map(AsRef::as_ref).flat_map(of_case).collect();
        let times = Mutex::new(runs.iter().map(|_| (None, None)).collect());
        Self { command, begun: Instant::now(), cases: cases.iter().map(|case| case.name()).collect(), runs, times }
    }

    /// Expected time, in words.
    pub(super) fn in_words(&self, root: &Path, threads: usize) -> String {
        in_words(self.runs.len(), self.seconds(AllSpeeds::read(root).of(&build()), threads), threads)
    }

    /// Wall time `[s]` by what is known of this machine; what was never measured here is taken over from the shipped times, by
    /// the speed of a small flow on both machines.
    fn seconds(&self, known: &Speeds, threads: usize) -> f64 {
        let is_known = |run: &ExpectedRun| known.ratio(run.case, &run.variant).is_some();
        let is_all_known =
            self.runs.iter().all(is_known) && self.cases.iter().all(|case| known.beside(case, self.command).is_some());
        let shipped: Speeds = serde_json::from_str(SHIPPED).unwrap_or_default();
        let measured = if is_all_known { None } else { machine::microseconds_each() };
        self.seconds_by(
            known,
            &shipped,
            measured.filter(|_| shipped.machine > 0.0).map_or(1.0, |m| m / shipped.machine),
            threads,
        )
    }

    fn seconds_by(&self, known: &Speeds, shipped: &Speeds, machine: f64, threads: usize) -> f64 {
        let core_seconds = |run: &ExpectedRun| {
            let shipped = || shipped.ratio(run.case, &run.variant).unwrap_or(1.0) * machine;
            run.nominal * known.ratio(run.case, &run.variant).unwrap_or_else(shipped)
        };
        let mut order: Vec<&ExpectedRun> = self.runs.iter().collect();
        order.sort_by(|a, b| b.cost.total_cmp(&a.cost));
        let runs: Vec<f64> = order.into_iter().map(core_seconds).collect();
        let beside = |case: &&str| {
            // the shipped time is that of all runs of the quick tier; some of them have less to draw, but not by their cost
            let asked: f64 = self.runs.iter().filter(|run| run.case == *case).map(|run| run.nominal).sum();
            let share = |whole: f64| if whole > 0.0 { (asked / whole).min(1.0).sqrt() } else { 1.0 };
            let whole = shipped.nominal(case);
            let shipped = || shipped.beside(case, self.command).unwrap_or(0.0) * share(whole) * machine;
            known.beside(case, self.command).unwrap_or_else(shipped)
        };
        wall_time(&runs, threads) + self.cases.iter().map(beside).sum::<f64>()
    }

    /// Notes that a run begins.
    pub(super) fn started(&self, run: usize) {
        if let Some(time) = self.lock().get_mut(run) {
            time.0 = Some(Instant::now());
        }
    }

    /// Notes that a run is finished.
    pub(super) fn finished(&self, run: usize) {
        if let Some(time) = self.lock().get_mut(run) {
            time.1 = time.0.map(|begun| begun.elapsed().as_secs_f64());
        }
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Vec<(Option<Instant>, Option<f64>)>> {
        self.times.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Keeps what the command took, now that it is done. Estimates are no reason to fail.
    pub(super) fn learn(&self, results: &[CaseResult], root: &Path, threads: usize) {
        let mut all = AllSpeeds::read(root);
        let known = all.of(&build());
        let summaries = results.iter().flat_map(|result| &result.runs);
        let (mut taken, mut fresh) = (Vec::new(), false);
        for ((run, (_, seconds)), summary) in self.runs.iter().zip(self.lock().iter()).zip(summaries) {
            let Some(seconds) = *seconds else { continue };
            let core_seconds = seconds * speed_up(summary.threads);
            // the time of a run that came from the store says nothing of it
            if !summary.from_store && summary.variant == run.variant {
                known.learn(run.case, &run.variant, run.nominal, core_seconds);
                fresh = true;
            }
            taken.push((run.cost, core_seconds));
        }
        if !fresh {
            return;
        }
        taken.sort_by(|a, b| b.0.total_cmp(&a.0));
        let runs: Vec<f64> = taken.into_iter().map(|(_, seconds)| seconds).collect();
        let beside = (self.begun.elapsed().as_secs_f64() - wall_time(&runs, threads)).max(0.0);
        for case in &self.cases {
            known.learn_beside(case, self.command, beside / self.cases.len() as f64);
        }
        if let Err(error) = all.write(root) {
            tracing::debug!("{}: what the runs took is not kept: {error}", root.display());
        }
    }
}

/// Number of runs and their time `[s]` on a given number of threads.
fn in_words(runs: usize, seconds: f64, threads: usize) -> String {
    let count = |number: usize, what: &str| format!("{number} {what}{}", if number == 1 { "" } else { "s" });
    let time = HumanDuration(Duration::from_secs_f64(seconds.clamp(1.0, 1e12)));
    format!("{}, about {time} on {} of this machine if nothing is stored", count(runs, "run"), count(threads, "thread"))
}

/// Properties of the build that distinguish speeds in one store. User-defined laws are slower than built-in ones.
fn build() -> String {
    let laws = if registered().is_empty() { "" } else { ", with laws of its own" };
    format!("{}, {}{laws}", profile(), instruction_set())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn expectation(nominal: &[f64]) -> Expectation {
        let run = |(k, &nominal): (usize, &f64)| ExpectedRun {
            case: "film",
            variant: Variant::of("resolution", k),
            nominal,
            cost: 1e6 * nominal,
        };
        Expectation {
            command: "run",
            begun: Instant::now(),
            cases: vec!["film"],
            runs: nominal.iter().enumerate().map(run).collect(),
            times: Mutex::new(Vec::new()),
        }
    }

    #[test]
    fn an_expected_time_has_the_unit_that_suits_it() {
        let expected = "1 run, about 30 seconds on 1 thread of this machine if nothing is stored";
        assert_eq!(in_words(1, 30.0, 1), expected);
        assert!(in_words(2, 600.0, 2).starts_with("2 runs, about 10 minutes on 2 threads"));
    }

    #[test]
    fn local_speed_replaces_the_shipped_speed() {
        let (mut known, mut shipped) = (Speeds::default(), Speeds::default());
        let expected = expectation(&[4.0, 2.0]);
        assert_eq!(expected.seconds_by(&known, &shipped, 1.0, 1), 6.0, "nothing is known: the nominal times");
        shipped.learn("film", &Variant::of("resolution", 0), 1.0, 0.5);
        shipped.learn_beside("film", "run", 1.0);
        // a machine that is half as fast as the other one
        assert_eq!(expected.seconds_by(&known, &shipped, 2.0, 1), 8.0);
        known.learn("film", &Variant::of("resolution", 1), 1.0, 10.0);
        known.learn_beside("film", "run", 0.25);
        assert_eq!(expected.seconds_by(&known, &shipped, 2.0, 1), 60.25, "another run of the case goes before");
        known.learn("film", &Variant::of("resolution", 0), 1.0, 0.25);
        assert_eq!(expected.seconds_by(&known, &shipped, 2.0, 1), 21.25);
        assert_eq!(
            expected.seconds_by(&known, &shipped, 2.0, 2),
            20.25,
            "the longest run alone, though it begins last"
        );
    }

    #[test]
    fn a_part_of_the_runs_has_a_part_of_the_figures() {
        let (known, mut shipped) = (Speeds::default(), Speeds::default());
        shipped.learn("film", &Variant::of("resolution", 0), 8.0, 8.0);
        shipped.learn_beside("film", "run", 20.0);
        assert_eq!(expectation(&[2.0]).seconds_by(&known, &shipped, 1.0, 1), 12.0, "half for a quarter of the cost");
        assert_eq!(expectation(&[16.0]).seconds_by(&known, &shipped, 1.0, 1), 36.0, "no more than of the whole case");
    }

    #[test]
    fn the_shipped_times_can_be_read_and_name_every_case() {
        let shipped: Speeds = serde_json::from_str(SHIPPED).expect("readable");
        assert!(shipped.machine > 0.0);
        for case in crate::REGISTRY.cases() {
            assert!(shipped.ratio(case.name(), &Variant::default()).is_some(), "{}", case.name());
            for command in ["run", "report"] {
                assert!(shipped.beside(case.name(), command).is_some(), "{} {command}", case.name());
            }
        }
    }
}
