//! Posterior prediction for every datum: a band of 95 %, for fitted data and for those held out.
//!
//! Predictions are those of the emulator at samples of the posterior. For what was held out an emulator of its own rests on
//! the best point and the ends of the intervals.

use super::assembly::compared;
use super::objective::Objective;
use super::repeated::Repeated;
use super::result::DatumComparison;
use crate::ToolError;
use crate::inference::posterior::{Posterior, predictive};
use crate::inference::{Answer, Emulator, Evaluated, Explored};

/// Half width of an interval of 95 % of a normal distribution, in standard deviations.
const HALF_WIDTH: f64 = 1.96;

/// Standard uncertainty by the parameters of a residual whose datum is at 0: bands end where runs do and are then one-sided, so that the
/// side towards the datum counts.
fn spread(residual: f64, [low, high]: [f64; 2]) -> f64 {
    let side = if residual > 0.0 { residual - low } else { high - residual };
    side.max(0.0) / HALF_WIDTH
}

/// Gives every fitted datum its band.
pub(super) fn of_fit(
    objective: &Objective<'_>,
    explored: &Explored,
    posterior: &Posterior,
    fit: &mut [DatumComparison],
) {
    let bands = predictive(&explored.emulator, posterior);
    let loss = objective.plan.loss;
    for (place, ((datum, band), known)) in fit.iter_mut().zip(bands).zip(objective.data_of(false)).enumerate() {
        let [low, high] = band.map(|root| known.of_residual(loss.residual(root) / objective.weight(place)));
        datum.predicted = Some((low, high));
    }
}

/// Gives every datum that was held out its band, as far as its runs succeed at the ends of the intervals.
pub(super) fn of_hold_out(
    objective: &Objective<'_>,
    answer: &Answer,
    posterior: &Posterior,
    hold_out: &mut [DatumComparison],
) -> Result<(), ToolError> {
    let plan = objective.plan;
    let (Some(explored), false) = (&answer.explored, hold_out.is_empty()) else { return Ok(()) };
    let mut points: Vec<Vec<f64>> = vec![answer.search.best.clone()];
    points.extend(explored.ends.iter().flatten().map(|end| end.point.clone()));
    let blocks: Vec<usize> = (0..plan.blocks.len()).filter(|&block| plan.blocks[block].held_out).collect();
    let values: Vec<Vec<f64>> = points.iter().map(|point| plan.values(point)).collect();
    let answers = objective.ask_at(&blocks, &values)?;
    let evaluated = |(point, answers): (&Vec<f64>, &[Repeated])| {
        let answer = |block: usize| blocks.iter().position(|&other| other == block).map(|place| &answers[place]);
        let data = compared(objective, true, answer, Clone::clone).ok();
        let residuals = data.map(|data| data.iter().map(|datum| datum.residual).collect());
        Evaluated::new(point.clone(), residuals)
    };
    let history: Vec<Evaluated> = points.iter().zip(answers.chunks(blocks.len())).map(evaluated).collect();
    // without points enough there is no band
    let Some(emulator) = Emulator::fit(&history, plan.budget.difference) else { return Ok(()) };
    let bands = predictive(&emulator, posterior);
    for (place, ((datum, band), known)) in hold_out.iter_mut().zip(bands).zip(objective.data_of(true)).enumerate() {
        // few points make an emulator that errs beyond them
        let met = history.iter().filter_map(|evaluated| Some(evaluated.residuals.as_ref()?[place]));
        let (least, most) = met.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, m), r| (l.min(r), m.max(r)));
        let band = band.map(|residual| residual.clamp(least, most));
        let [low, high] = band.map(|residual| known.of_residual(residual));
        datum.predicted = Some((low, high));
        datum.spread = spread(datum.residual, band);
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uncertainty_of_a_prediction_is_that_towards_its_datum() {
        assert!((spread(3.0, [1.04, 3.2]) - 1.0).abs() < 1e-12, "the side below");
        assert!((spread(-1.0, [-1.5, 0.96]) - 1.0).abs() < 1e-12, "the side above");
        assert!(spread(3.0, [4.0, 5.0]).abs() < 1e-12, "none where all predictions lie farther off");
    }
}
