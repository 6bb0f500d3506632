//! `bagnold run`: one case or study into one folder, with its page.

use super::arguments::Run;
use super::error::ProgramError;
use super::expectation::Expectation;
use super::places::Places;
use super::profile::Profile;
use super::progress::Progress;
use super::{Exit, print, say, study, summary, tell};
use crate::case::{
    CaseResult, Estimate, Monitor, OutputPlan, ParameterError, Prepared, Registry, Request, Requested, StateOutput,
    Tier, execute,
};
use crate::judge::{self, Measurements};
use crate::output::{FileError, OutputFolder};
use crate::report::{self, Baseline, History, KnownFailures, Provenance, Report};
use crate::result::{MetricsDocument, States, write_case};
use crate::store::{Store, provenance};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// Simulates, judges, writes and prints one case.
pub(super) fn run(
    command: &Run,
    registry: Registry,
    quiet: bool,
    output: &mut (dyn Write + Send),
) -> Result<Exit, ProgramError> {
    if let Some(file) = study::file(&command.target, registry) {
        return study::run(&file, command, registry, quiet, output);
    }
    let request = Request {
        target: &command.target,
        tier: command.tier,
        settings: &command.settings,
        only: &command.only,
        limits: command.allowance.limits(),
    };
    let Requested { prepared, tier, overlay, output: wanted, changed } = request.prepare(registry)?;
    let wanted = match command.output_every {
        Some(every) => Some(OutputPlan::new(every, command.output_fields.clone()).map_err(ParameterError::from)?),
        None => wanted,
    };
    let overlay: Vec<Measurements> =
        overlay.iter().chain(&command.overlay).map(|file| Measurements::read(file)).collect::<Result<_, _>>()?;
    let folder =
        command.out.clone().unwrap_or_else(|| PathBuf::from(format!("reports/runs/{}-{tier}", prepared.name())));
    if command.out.is_none() {
        OutputFolder::adopt(Path::new("reports"))?;
    }
    let claimed = OutputFolder::claim(&folder)?;
    let store = command.work.open_store();
    let expectation = announce("run", std::slice::from_ref(&prepared), &store, quiet || command.json);
    let known = Places::OfCases.known_failures()?;
    // accepted values are those of the case as it comes
    let baseline = if changed { Baseline::default() } else { Places::OfCases.accepted(prepared.name(), tier)? };
    let started = Instant::now();
    let mut profile = Profile::begin();
    let states = wanted.as_ref().map(|plan| States::of(prepared.as_ref(), plan, &claimed.staging().join("states")));
    let mut results = simulate_showing(vec![prepared], &store, quiet, states.as_ref(), Some(&expectation))?;
    states.map_or(Ok(()), States::finish).map_err(|error| FileError::unwritable(&folder, &error))?;
    profile.over("runs and their figures");
    for result in &mut results {
        judge::draw_measured(result, &overlay)?;
        if let Some(plan) = &wanted {
            result.parameters_toml += &format!("\n{}", plan.text());
            "bagnold run case.toml".clone_into(&mut result.command);
        }
    }

    let written = Written {
        command,
        title: results.first().map(|result| result.name.clone()).unwrap_or_default(),
        tier,
        baseline,
        known,
        measured: overlay.iter().collect(),
        // states on the way take a time of their own
        learns: wanted.is_none(),
    };
    written.publish(&results, Publication { claimed, store: &store, expectation, started, profile }, output)
}

/// What a command writes of its results.
pub(super) struct Written<'a> {
    pub(super) command: &'a Run,
    pub(super) title: String,
    pub(super) tier: Tier,
    pub(super) baseline: Baseline,
    pub(super) known: KnownFailures,
    /// Measurements of which the folder receives copies.
    pub(super) measured: Vec<&'a Measurements>,
    /// Whether the times of these runs tell how long others will take.
    pub(super) learns: bool,
}

/// Where it goes, and what its making has taken.
pub(super) struct Publication<'a> {
    pub(super) claimed: OutputFolder,
    pub(super) store: &'a Store,
    pub(super) expectation: Expectation,
    pub(super) started: Instant,
    pub(super) profile: Profile,
}

impl Written<'_> {
    /// Writes numbers, tables, states and the page, and prints the verdicts.
    pub(super) fn publish(
        self,
        results: &[CaseResult],
        publication: Publication<'_>,
        output: &mut (dyn Write + Send),
    ) -> Result<Exit, ProgramError> {
        let Self { command, known, .. } = self;
        let Publication { claimed, store, expectation, started, mut profile } = publication;
        let folder = claimed.folder().to_owned();
        let threads = rayon::current_num_threads();
        for result in results {
            let document = MetricsDocument::of(result, threads);
            write_case(claimed.staging(), result, &document)
                .and_then(|()| self.measured.iter().try_for_each(|own| own.keep(claimed.staging())))
                .map_err(|error| FileError::unwritable(&folder, &error))?;
            if command.json {
                print(output, &document.text());
            }
        }
        let page = Report {
            title: self.title,
            tier: self.tier,
            generated: Provenance::of_this_program(started.elapsed(), String::new()),
            cases: results.iter().map(super::report::case_report).collect(),
            baseline: self.baseline,
            against: None,
            history: History::default(),
            known_failures: known.clone(),
            papers: &[],
        };
        report::write_alone(&page, claimed.staging(), &store.drawings())?;
        claimed.publish()?;
        if self.learns {
            expectation.learn(results, store.root(), threads);
        }
        profile.over("page");
        if let Some(path) = &command.junit {
            report::write_junit(&page, path)?;
        }
        if !command.json {
            for result in results {
                say(output, &summary::of_case(result, |metric| super::report::is_known(&known, result, metric)));
            }
            if results.iter().any(|result| result.unexpected_divergences().next().is_some()) {
                let states = "of a run that diverged, NAME.pvd ends with the last good state, NAME-first-bad.pvd is the one after";
                say(output, &format!("{}: {states}\n", folder.join("snapshots").display()));
            }
            say(output, &format!("written to {}\n", folder.join("index.html").display()));
        }
        if command.profile {
            tell(profile.in_words(results, threads).trim_end_matches('\n'));
        }
        Ok(Exit::of(results, |result, metric| super::report::is_known(&known, result, metric)))
    }
}

/// Says on standard error what the runs of a command are expected to need.
pub(super) fn announce(command: &'static str, cases: &[Box<dyn Prepared>], store: &Store, quiet: bool) -> Expectation {
    if let Some(warning) = provenance::unoptimised() {
        tracing::warn!("{warning}");
    }
    let expectation = Expectation::of(command, cases);
    if !quiet {
        let estimate = cases.iter().map(|case| case.estimate()).fold(Estimate::default(), Estimate::and);
        tell(&expectation.in_words(&estimate, store.root(), rayon::current_num_threads()));
    }
    expectation
}

/// Simulates with a progress bar.
pub(super) fn simulate(
    cases: Vec<Box<dyn Prepared>>,
    store: &Store,
    quiet: bool,
    expectation: Option<&Expectation>,
) -> Result<Vec<CaseResult>, ParameterError> {
    simulate_showing(cases, store, quiet, None, expectation)
}

/// Simulates with a progress bar, and shows states on the way.
fn simulate_showing(
    cases: Vec<Box<dyn Prepared>>,
    store: &Store,
    quiet: bool,
    states: Option<&States>,
    expectation: Option<&Expectation>,
) -> Result<Vec<CaseResult>, ParameterError> {
    let showing = Showing { progress: Progress::new(&cases, quiet), states, expectation };
    let results = execute(cases, store, &showing);
    showing.progress.clear();
    results
}

/// A progress bar, who takes the states of the runs, and who takes their times.
struct Showing<'a> {
    progress: Progress,
    states: Option<&'a States>,
    expectation: Option<&'a Expectation>,
}

impl Monitor for Showing<'_> {
    fn started(&self, run: usize) {
        self.progress.started(run);
        if let Some(expectation) = self.expectation {
            expectation.started(run);
        }
    }

    fn advanced(&self, run: usize, simulated: f64, total: f64, particle_steps: f64) {
        self.progress.advanced(run, simulated, total, particle_steps);
    }

    fn resumed(&self, run: usize, simulated: f64) {
        self.progress.resumed(run, simulated);
    }

    fn finished(&self, run: usize) {
        self.progress.finished(run);
        if let Some(expectation) = self.expectation {
            expectation.finished(run);
        }
    }

    fn output(&self, run: usize) -> Option<&dyn StateOutput> {
        self.states?.run(run)
    }
}
