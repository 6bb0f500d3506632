//! Layers that differ from the judged ones in one input.

use super::super::BedLoad1dRecord;
use super::super::flow::BedLoad1dFlow;
use super::super::records::{InputSpread, on_slope};
use crate::reference::bed_load::TransportFormula;
use crate::reference::one_dimension::bed_load::LayerState;

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
