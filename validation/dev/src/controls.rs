//! `bagnold-dev controls`: tries the controls that a report does not run, errors of the solver and dear inputs, and renews the
//! committed tables of what became of them.

use crate::arguments::ControlsArguments;
use crate::case::{CaseResult, Registry, Request, Tier, share_out};
use crate::control::{Control, ControlTrial, Found, TriedControls};
use crate::error::DevError;
use crate::evidence::PAPERS;
use crate::metric::{Metric, Verdict};
use crate::mutate::{PATIENCE, Program, named, sources};
use crate::mutation::{Mutations, Scope, build};
use crate::output::{FileError, write_whole};
use crate::store::Store;
use bagnold_validation::cli::{CountBar, Exit, Session, simulate_announced};
use std::time::Duration;

/// Tries the controls of the cases asked for and writes, or compares, their tables.
pub(crate) fn controls(command: &ControlsArguments, session: &mut Session<'_>) -> Result<Exit, DevError> {
    let workspace = sources()?;
    let cases: Vec<&str> = if command.cases.is_empty() {
        session.registry.iter().map(|case| case.name()).collect()
    } else {
        command
            .cases
            .iter()
            .map(|name| session.registry.find(name.trim()).map(|case| case.name()))
            .collect::<Result<_, _>>()?
    };
    let mutations = Mutations::read(&workspace)?;
    let staging = workspace.join("target").join("mutations");
    session.note("building a copy of the program that holds all mutations");
    let program = Program::new(build(&workspace, &mutations)?, &staging)?;
    let mut same = true;
    for name in cases {
        let mut own: Vec<Control> = session.registry.find(name)?.controls();
        own.retain(|control| !control.is_of_report());
        if own.is_empty() {
            continue;
        }
        let mut trials = of_solver(name, &own, &program, &mutations, session.quiet)?;
        trials.extend(of_inputs(name, &own, session.registry, &command.work.open_store(), session.quiet)?);
        let table = TriedControls::by_this_program(&trials);
        if command.check {
            let agrees = TriedControls::shipped(name).agrees(&table);
            same &= agrees;
            session.say(&format!("{} {name}: {} controls\n", if agrees { "same   " } else { "DIFFERS" }, trials.len()));
            continue;
        }
        let path = workspace.join("validation/harness/controls").join(TriedControls::file(name));
        let unwritable = |error: std::io::Error| DevError::from(FileError::unwritable(&path, &error));
        let text = table.text().map_err(|error| unwritable(std::io::Error::other(error)))?;
        write_whole(&path, text.as_bytes()).map_err(unwritable)?;
        session.say(&format!("{name}: {} controls, written to {}\n", trials.len(), path.display()));
    }
    Ok(if same { Exit::Held } else { Exit::GateFailed })
}

/// Each error of the solver through a case, cut to the runs that matter.
fn of_solver(
    case: &str,
    controls: &[Control],
    program: &Program,
    mutations: &Mutations,
    quiet: bool,
) -> Result<Vec<ControlTrial>, DevError> {
    let errors = controls.iter().filter_map(|control| Some((control, control.solver.as_ref()?)));
    let errors: Vec<(&Control, usize)> = errors
        .map(|(control, error)| Ok((control, mutations.number(named(mutations, error)?))))
        .collect::<Result<_, DevError>>()?;
    if errors.is_empty() {
        return Ok(Vec::new());
    }
    let scope: Scope = mutations.scope(case);
    let right = program.run("0", &scope, Duration::MAX);
    let right = right.map_err(|reason| DevError::trial(case, &reason))?;
    let limit = Duration::from_secs_f64(10.0 * right.wall_seconds + PATIENCE);
    let bar = CountBar::new("controls", errors.len(), 0, quiet);
    share_out(errors, |(control, number): (&Control, usize)| -> Result<_, DevError> {
        bar.say(&control.name);
        // a program that stops has noticed, but its gates have not
        let wrong = program.run(&number.to_string(), &scope, limit).ok();
        let diverged = wrong.as_ref().is_none_or(|wrong| !wrong.diverged.is_empty());
        let wrong = wrong.map(|wrong| wrong.metrics).unwrap_or_default();
        let trial = ControlTrial {
            found: found(case, &right.metrics, &wrong),
            control: control.clone(),
            diverged,
            tried_at: None,
        };
        bar.step();
        Ok(trial)
    })
}

/// Each dear change of parameters, against the case as it comes.
fn of_inputs(
    case: &str,
    controls: &[Control],
    registry: Registry,
    store: &Store,
    quiet: bool,
) -> Result<Vec<ControlTrial>, DevError> {
    let mut requests = vec![Request { target: case, tier: Some(Tier::Quick), ..Request::default() }];
    let mut dear: Vec<&Control> = Vec::new();
    for control in controls.iter().filter(|control| control.solver.is_none()) {
        let (settings, only) = (&control.set, &control.only);
        requests.push(Request { target: case, tier: Some(Tier::Quick), settings, only, ..Request::default() });
        dear.push(control);
    }
    if dear.is_empty() {
        return Ok(Vec::new());
    }
    let prepared = requests.iter().map(|request| Ok(request.prepare(registry)?.prepared));
    let results = simulate_announced("controls", prepared.collect::<Result<_, DevError>>()?, store, quiet)?;
    let [right, wrong @ ..] = &results[..] else { return Ok(Vec::new()) };
    let trial = |(control, wrong): (&&Control, &CaseResult)| {
        let mut trial = wrong.trial((*control).clone(), right);
        let is_it = |metric: &&Metric, found: &Found| metric.name == found.metric && metric.variant == found.variant;
        let of_right = |found: &Found| right.metrics.iter().find(|metric| is_it(metric, found));
        trial.found.retain(|found| of_right(found).is_some_and(|metric| is_asked(case, metric)));
        trial
    };
    Ok(dear.iter().zip(wrong).map(trial).collect())
}

/// The right metrics that anything asks for, as they are with an error.
fn found(case: &str, right: &[Metric], wrong: &[Metric]) -> Vec<Found> {
    let with_error =
        |metric: &Metric| wrong.iter().find(|other| other.name == metric.name && other.variant == metric.variant);
    let asked = right.iter().filter(|metric| is_asked(case, metric));
    asked.map(|metric| Found::of(metric, with_error(metric))).collect()
}

/// Whether a gate judges a number of the right case or an element of a paper names it.
fn is_asked(case: &str, metric: &Metric) -> bool {
    let names = PAPERS.iter().flat_map(|paper| &paper.elements).flat_map(|element| &element.metrics);
    metric.verdict() != Verdict::Observed
        || names.filter(|name| name.case == case).any(|name| name.names(&metric.name, &metric.variant))
}
