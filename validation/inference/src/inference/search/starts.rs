//! Other starts: points spread over the cube, and a descent wherever they promise a minimum that is not known.
//!
//! All points are evaluated in one batch. On the emulator of everything evaluated so far descents cost nothing, so many are
//! made; where one ends away from all known minima, the model itself descends from there, and the emulator learns from it.
//! (Linkage of starts to minima: Rinnooy Kan & Timmer, Mathematical Programming 39 (1987) 27.)

use super::barrier::is_parted;
use super::{Budget, Evaluated, Halt, LocalMinimum, Recorder, Termination, trust_region};
use crate::inference::{Emulator, Evaluate, chi_squared};
use crate::sampling::design::sobol;

/// Descents on the emulator for each start of the model.
const DESCENTS: usize = 6;

/// Starts that are followed although the emulator promises nothing new, because it misses them.
const DOUBTFUL: usize = 1;

/// Error of the emulator, as a share of the residuals, above which a start is followed whatever it says.
const MISSED: f64 = 0.2;

/// Finds minima beside those that are known; whether every start was followed to its end within the budget.
pub(super) fn follow<M: Evaluate>(
    recorder: &mut Recorder<'_, M>,
    minima: &mut Vec<LocalMinimum>,
    budget: &Budget,
) -> Result<bool, Halt<M::Error>> {
    let dimensions = minima[0].point.len();
    // the design of the model is the beginning of that of its emulator
    let places = sobol(DESCENTS * budget.starts, dimensions, budget.seed);
    match recorder.residuals(&places[..budget.starts]) {
        Err(Halt::BudgetSpent) => return Ok(false),
        other => other?,
    };
    descend_from(recorder, minima, budget, &places, &places[..budget.starts], f64::INFINITY)
}

/// Descends to minima that the emulator promises downhill of some places, with a χ² up to `worst`, and from a start that it
/// misses; whether all descents came to their ends within the budget.
pub(super) fn descend_from<M: Evaluate>(
    recorder: &mut Recorder<'_, M>,
    minima: &mut Vec<LocalMinimum>,
    budget: &Budget,
    places: &[Vec<f64>],
    starts: &[Vec<f64>],
    worst: f64,
) -> Result<bool, Halt<M::Error>> {
    let mut tried: Vec<LocalMinimum> = Vec::new();
    let mut doubtful = DOUBTFUL;
    loop {
        let promised = next(recorder, minima, &tried, places, budget).filter(|lead| lead.chi_squared <= worst);
        let start = promised.or_else(|| {
            doubtful = doubtful.checked_sub(1)?;
            misunderstood(recorder, minima, &tried, starts, budget)
        });
        let Some(start) = start else { break };
        let descent = trust_region::run(recorder, &start.point, budget, minima);
        tried.push(start);
        match descent {
            Ok(descent) if descent.stopped == Some(Termination::Converged) => {
                let found = descent.minimum;
                let emulator = Emulator::fit(recorder.history(), budget.difference);
                let one = |known: &LocalMinimum| {
                    let parted = |emulator| is_parted(emulator, &found.point, &known.point);
                    known.is_at(&found.point) || !emulator.as_ref().is_none_or(parted)
                };
                match minima.iter_mut().find(|known| one(known)) {
                    Some(known) if known.chi_squared <= found.chi_squared => {}
                    Some(known) => *known = found,
                    None => minima.push(found),
                }
            }
            Ok(_) => {}
            Err(Halt::BudgetSpent) => return Ok(false),
            Err(halt) => return Err(halt),
        }
    }
    Ok(true)
}

/// The lowest minimum of the emulator that is neither known nor was tried.
fn next<M: Evaluate>(
    recorder: &Recorder<'_, M>,
    minima: &[LocalMinimum],
    tried: &[LocalMinimum],
    places: &[Vec<f64>],
    budget: &Budget,
) -> Option<LocalMinimum> {
    let emulator = Emulator::fit(recorder.history(), budget.difference)?;
    let mut leads: Vec<LocalMinimum> = Vec::new();
    for place in places {
        let lead = emulator.minimum_near(place);
        if !minima.iter().chain(tried).chain(&leads).any(|known| known.is_at(&lead.point)) {
            leads.push(lead);
        }
    }
    leads.sort_by(|a, b| a.chi_squared.total_cmp(&b.chi_squared));
    let parted =
        |lead: &LocalMinimum| minima.iter().chain(tried).all(|known| is_parted(&emulator, &lead.point, &known.point));
    leads.into_iter().find(parted)
}

/// The lowest start that the emulator of all other points misses by more than a fifth: what it promises of the way from there
/// means nothing.
fn misunderstood<M: Evaluate>(
    recorder: &Recorder<'_, M>,
    minima: &[LocalMinimum],
    tried: &[LocalMinimum],
    starts: &[Vec<f64>],
    budget: &Budget,
) -> Option<LocalMinimum> {
    let history = recorder.history();
    let missed = |start: &&Evaluated| {
        let others: Vec<Evaluated> = history.iter().filter(|other| other.point != start.point).cloned().collect();
        let (Some(emulator), Some(residuals)) = (Emulator::fit(&others, budget.difference), &start.residuals) else {
            return true;
        };
        let predicted = emulator.predict(&start.point);
        let off: f64 = predicted.iter().zip(residuals).map(|(a, b)| (a - b) * (a - b)).sum();
        off > MISSED * MISSED * (chi_squared(residuals) + residuals.len() as f64)
    };
    history
        .iter()
        .filter(|evaluated| starts.contains(&evaluated.point))
        .filter(|start| !minima.iter().chain(tried).any(|known| known.is_at(&start.point)))
        .filter(missed)
        .filter_map(|start| Some(LocalMinimum { point: start.point.clone(), chi_squared: start.chi_squared? }))
        .min_by(|a, b| a.chi_squared.total_cmp(&b.chi_squared))
}
