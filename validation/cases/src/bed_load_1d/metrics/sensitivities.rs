//! Layers that differ from the judged ones in one input.

use super::super::BedLoad1dRecord;
use super::super::flow::BedLoad1dFlow;
use super::super::quantities::{START_DIFFERENCE, TRANSPORT_SENSITIVITY};
use super::super::records::{InputSpread, of, on_slope, second_variant};
use crate::case::Flow;
use crate::metric::Metric;
use crate::observation::Outcome;
use crate::reference::bed_load::TransportFormula;
use crate::reference::one_dimension::bed_load::LayerState;

/// Transport with an input replaced over that without, and of a layer with two states also from the fast start.
pub(super) fn metrics(records: &[BedLoad1dRecord]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (own_run, own) in of(records, BedLoad1dFlow::is_from_rest) {
        let is_beside = |run: &BedLoad1dFlow| run.is_sensitivity() && run.stream().slope == own_run.stream().slope;
        for (run, record) in records.iter().filter(|(run, _)| is_beside(run)) {
            if matches!(record.outcome, Outcome::Diverged { .. }) {
                continue;
            }
            let ratio = TRANSPORT_SENSITIVITY.of(&run.variant(), record.data.state.transport() / own.transport());
            let ratio = ratio.exactly(1.0, "the layer with the literature's closures");
            metrics.push(ratio.with_snapshot_tolerance(1e-3, 0.0));
            if let Some(second) = &record.data.second {
                metrics.push(TRANSPORT_SENSITIVITY.of(&second_variant(run), second.transport() / own.transport()));
                metrics.push(START_DIFFERENCE.of(&run.variant(), record.data.start_difference));
            }
        }
    }
    metrics
}

/// Standard uncertainty of a layer's transport over the formula's from its inputs, each over the values that it was replaced by, taken
/// for the ends of an even spread `[-]`, with what they are; 0 where none was.
pub(super) fn model_input_uncertainty(
    records: &[BedLoad1dRecord],
    run: &BedLoad1dFlow,
    own: &LayerState,
) -> (f64, String) {
    let expected = TransportFormula::WongParker.transport(run.stream().shields_number());
    let mut spread = InputSpread::default();
    for (place, (name, value)) in run.inputs().into_iter().enumerate() {
        let replaced = on_slope(records, run, BedLoad1dFlow::is_sensitivity);
        for (_, state) in replaced.filter(|(other, _)| other.inputs()[place].1 != value) {
            spread.add(name, own.transport() / expected, state.transport() / expected);
        }
    }
    (spread.standard(), spread.words())
}
