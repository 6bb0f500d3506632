//! `bagnold sweep`: many runs of one plan, here or on a cluster.

use super::arguments::{Cluster, Engine, SweepAction, SweepArguments};
use super::count::CountBar;
use super::error::ProgramError;
use super::{Exit, Session, folder_of};
use crate::evaluation::EvaluationRecord;
use crate::sweep::slurm::{self, SlurmRequest};
use crate::sweep::{SweepFolder, SweepMonitor, SweepPlan, SweepProgress, SweepRun, gather, run_entry, run_locally};
use std::path::{Path, PathBuf};

/// Plans, runs, submits or collects a sweep.
pub(super) fn sweep(command: &SweepArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    match (&command.action, &command.file) {
        (Some(SweepAction::Template), _) => {
            session.say(slurm::TEMPLATE);
            Ok(Exit::Held)
        }
        (Some(SweepAction::Task { folder, entry, work }), _) => super::in_pool(work.threads, || {
            let sweep = SweepFolder::open(folder)?;
            let record = run_entry(&sweep, sweep.manifest().entry(*entry)?, session.registry, &work.open_store())?;
            Ok(if record.failure.is_some() { Exit::Diverged } else { Exit::Held })
        }),
        (Some(SweepAction::Collect { folder, resubmit, cluster }), _) => collect(folder, *resubmit, cluster, session),
        (None, Some(file)) => begin(file, command, session),
        (None, None) => Ok(Exit::BadInput),
    }
}

/// Remedy for a repeated run of a finished sweep.
const ANEW: &str = "to run them again, name another folder with --out";

fn begin(file: &Path, command: &SweepArguments, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let manifest = SweepPlan::read(file)?.manifest(session.registry, command.allowance.limits())?;
    let folder = folder_of(command.out.as_ref(), "reports/sweeps", file);
    if command.engine == Engine::Slurm {
        request(&command.cluster, command.work.store.clone()).test()?;
    }
    // what is there is resumed, and what is done is shown again
    let sweep = SweepFolder::begin(&folder, &manifest)?;
    match command.engine {
        Engine::Local => {
            if sweep.missing().is_empty() {
                session.say(&format!("all {} runs are finished already; {ANEW}\n", manifest.entries.len()));
                return finish(&sweep, session);
            }
            let all = manifest.entries.len();
            let watch = CountBar::new("runs", all, all - sweep.missing().len(), session.quiet);
            run_locally(&sweep, session.registry, &command.work.open_store(), &watch)?;
            drop(watch);
            finish(&sweep, session)
        }
        Engine::Slurm => {
            submit(&sweep, &request(&command.cluster, command.work.store.clone()), session)?;
            session.say(&format!("then: bagnold sweep collect {}\n", folder.display()));
            Ok(Exit::Held)
        }
    }
}

fn collect(folder: &Path, resubmit: bool, cluster: &Cluster, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let sweep = SweepFolder::open(folder)?;
    if resubmit {
        submit(&sweep, &request(cluster, None), session)?;
    }
    finish(&sweep, session)
}

/// Submits what is neither done nor queued.
fn submit(sweep: &SweepFolder, request: &SlurmRequest, session: &mut Session<'_>) -> Result<(), ProgramError> {
    let (jobs, runs): (Vec<String>, Vec<usize>) = slurm::submit(sweep, request)?.into_iter().unzip();
    let text = match runs.iter().sum() {
        0 => "nothing to submit\n".to_owned(),
        runs => format!("submitted {runs} runs as Slurm job {}\n", jobs.join(", ")),
    };
    session.say(&text);
    Ok(())
}

/// Request of the options.
fn request(cluster: &Cluster, store: Option<PathBuf>) -> SlurmRequest {
    let cpus = cluster.cpus.map(|cpus| cpus.to_string());
    let options = [
        ("partition", &cluster.partition),
        ("time", &cluster.time),
        ("mem", &cluster.memory),
        ("cpus-per-task", &cpus),
    ];
    let given = options.into_iter().filter_map(|(name, value)| Some((name.to_owned(), value.clone()?)));
    SlurmRequest {
        options: given.collect(),
        throttle: cluster.throttle,
        store,
        template: cluster.template.clone(),
        ..SlurmRequest::default()
    }
}

/// Gathers and says how far the sweep is.
fn finish(sweep: &SweepFolder, session: &mut Session<'_>) -> Result<Exit, ProgramError> {
    let SweepProgress { done, failed, missing, without_value } = gather(sweep, session.registry)?;
    let all = sweep.manifest().entries.len();
    let mut text = format!("{done} of {all} runs done");
    if failed > 0 {
        text += &format!(", {failed} failed (reasons in failures.csv)");
    }
    if missing > 0 {
        text += &format!(", {missing} missing");
    }
    if without_value > 0 {
        text += &format!("; {without_value} values are not numbers (column `reason` of results.csv)");
    }
    session.say(&format!("{text}\nwritten to {}\n", sweep.path().join("results.csv").display()));
    Ok(match (missing, failed) {
        (1.., _) => Exit::GateFailed,
        (0, 1..) => Exit::Diverged,
        (0, 0) => Exit::Held,
    })
}

impl SweepMonitor for CountBar {
    fn begun(&self, entry: &SweepRun) {
        self.say(&entry.folder);
    }

    fn ended(&self, entry: &SweepRun, record: &EvaluationRecord) {
        if let Some(reason) = &record.failure {
            tracing::warn!("{}: {reason}", entry.folder);
        }
        self.step();
    }
}
