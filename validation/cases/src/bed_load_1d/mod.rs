//! Steady bed load in one dimension: water over grains that dilate, with closures of the literature.

mod draws;
mod figures;
mod flow;
mod laws;
mod metrics;
mod onset_criterion;
mod prediction;
mod quantities;
mod records;
mod run;

pub use draws::{DrawnLayer, Draws};
pub use flow::{BedLoad1dFlow, BedMotion, GrainUnits, LayerStart, LayerStream, SimilarStream, SlopedStream};
pub use prediction::{BedLoadFlume, TransportPrediction};
pub use run::BedLoadLayerObservation;

use crate::case::{Case, DrawFigures, Flow, Judge, RecordOf, Tabulate};
use crate::metric::Quantity;
use crate::output::Table;
use crate::reference::one_dimension::bed_load::LayerPoint;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct BedLoad1d;

/// A run with its results.
type BedLoad1dRecord = RecordOf<BedLoad1dFlow>;

impl Case for BedLoad1d {
    const NAME: &'static str = "bed-load-1d";
    const AXES_BY_RUNS: bool = true;
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str = "1-D bed load over the depth: two phases with published closures, no particles";
    const DESCRIPTION: &'static str = "\
        Setup. Water flows down a slope and drags the upper grains of a bed along. Both phases are continua over the \
        depth, without particles. Grains have μ(I), a solid fraction that falls with I, and drag; water has a mixing \
        length that grows where grains leave room. No parameter is fitted to the transport. One parameter is chosen: the \
        length over which bed roughness fades. In the layers `grains=suspended` eddies also lift grains.\n\n\
        Judged. Transport on three slopes against a formula fitted to flume experiments. Two starts must reach one \
        steady state, balance and converge. Water over the moving bed against water over the same bed at rest. \
        Velocity of grains, transport of sheet flow and the onset of motion (Shields' curve) against measurements.\n\n\
        Observed only. Depth of the moving layer and the decay of grain velocity with depth. The layer is also the \
        reference of `bed-load`. Both share their closures, so their agreement verifies the particles and does not \
        validate the physics.";
    type Flow = BedLoad1dFlow;
    const QUANTITIES: &'static [Quantity] = quantities::QUANTITIES;
    const METRICS: Judge<Self::Flow> = |records| metrics::all(records).into_iter().chain(laws::metrics()).collect();
    const FIGURES: DrawFigures<Self::Flow> = figures::all;
    const TABLES: Tabulate<Self::Flow> =
        |records| records.iter().filter(|(run, _)| run.is_from_rest()).map(profile_table).collect();
}

/// Profiles of a layer, cell by cell; what stands at the faces is interpolated.
fn profile_table((run, record): &BedLoad1dRecord) -> Table {
    let state = &record.data.state;
    let points: Vec<LayerPoint> = state.height.iter().map(|&z| state.at(z)).collect();
    let of = |value: fn(&LayerPoint) -> f64| points.iter().map(value).collect::<Vec<f64>>();
    let columns = [
        ("z [m]", state.height.clone()),
        ("solid fraction [-]", of(|point| point.solid_fraction)),
        ("u_f [m/s]", of(|point| point.fluid_velocity)),
        ("u_s [m/s]", of(|point| point.grain_velocity)),
        ("K [kg/(m³ s)]", of(|point| point.exchange)),
        ("drag [N/m³]", state.drag()),
        ("p' [Pa]", of(|point| point.grain_pressure)),
        ("tau_f [Pa]", of(|point| point.fluid_stress)),
        ("tau_s [Pa]", of(|point| point.grain_stress)),
        ("mixing length [m]", of(|point| point.mixing_length)),
    ];
    let columns = columns.each_ref().map(|(heading, values)| (*heading, &values[..]));
    Table::of_columns(format!("profile-{}", run.variant().file_name()), &columns)
}
