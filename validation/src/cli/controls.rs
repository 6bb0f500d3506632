//! The controls of cases, run beside them: what of wrong physics and wrong inputs their gates reject.

use super::error::ProgramError;
use super::simulation::simulate;
use crate::case::{CaseResult, Limits, Registry, Request, Tier};
use crate::control::{ControlTrial, TriedControls};
use crate::store::Store;

/// The controls of these results that a report has: changes of parameters are run, the others are in the committed table. None at
/// another tier than the quick one.
pub(super) fn of_results(
    results: &[CaseResult],
    registry: Registry,
    limits: Limits,
    store: &Store,
    quiet: bool,
) -> Result<Vec<Vec<ControlTrial>>, ProgramError> {
    let mut trials: Vec<Vec<ControlTrial>> = Vec::new();
    let (mut prepared, mut places) = (Vec::new(), Vec::new());
    for (case, result) in results.iter().enumerate() {
        trials.push(Vec::new());
        let Some(own) = registry.find(&result.name).ok().filter(|_| result.tier == Tier::Quick) else { continue };
        let tried = TriedControls::shipped(&result.name);
        for control in own.controls() {
            if control.is_of_report() {
                let (settings, only) = (&control.set, &control.only);
                let request = Request { target: &result.name, tier: Some(Tier::Quick), settings, only, limits };
                prepared.push(request.prepare(registry)?.prepared);
                places.push((case, control));
            } else {
                trials[case].extend(tried.trial(&control));
            }
        }
    }
    let wrong = if prepared.is_empty() { Vec::new() } else { simulate(prepared, store, quiet, None, None)? };
    for ((case, control), wrong) in places.into_iter().zip(&wrong) {
        trials[case].push(wrong.trial(control, &results[case]));
    }
    Ok(trials)
}
