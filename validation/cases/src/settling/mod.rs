//! Settling grains: the drag laws, a grain alone and a uniform suspension against the roots of their balances.

mod beads;
mod drag_curves;
mod experiment;
mod figures;
mod formulation;
mod grain;
mod laws;
mod metrics;
mod parameters;
mod probe;
mod quantities;
mod runs;
mod suspension;
mod tiers;

pub use experiment::{Experiment, Vessel};
pub use formulation::GrainFormulation;
pub use grain::GrainRun;
pub use parameters::{SettlingParameters, SingleGrain, SuspendedGrains, SuspendingFluid};
pub use probe::{SettlingObservation, SettlingSeries};
pub use runs::SettlingRun;
pub use suspension::SuspensionRun;

use crate::case::{Case, RecordOf, Run};
use crate::figure::Figure;
use crate::metric::{Metric, Quantity};
use crate::output::Table;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct Settling;

type SettlingRecord = RecordOf<SettlingParameters>;

impl Case for Settling {
    const NAME: &'static str = "settling";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str = "a grain alone and a uniform suspension sink in a fluid, by every drag law";
    const DESCRIPTION: &'static str = "One grain sinks through a box of fluid that is periodic in both directions and that is pushed up by as much as \
        the grain weighs. Its slip against the fluid around it, in the mean over a window after the start, must be the \
        root of the balance of submerged weight and drag; the momentum of both phases must close in every step to \
        rounding. Formulation paper: the bed-load paper's operators and the drag from each pair's own slip; stabilised: \
        the default operators and the drag from the grain's slip against the mean of the fluid around it. The slip that \
        is judged is the one that the drag is taken from: in the mean form |⟨u_f⟩ − u_s|, in the pair form the U whose \
        drag is the mean of the pairs' drag, C_d(U) U² = |⟨C_d |u_ba| u_ba⟩|. Where the fluid moves unevenly within the \
        kernel U lies above the slip of the means, by half the variance in Newton's regime; that one and the root mean \
        square are observed. Formulation continuum: a uniform suspension sinks in a periodic column under the full \
        gravity. One pore pressure makes the flux of the mixture free of divergence and pushes both phases, and a \
        uniform pressure gradient takes out its mean, as the floor of a vessel does. Slip and sinking velocity must be \
        those of the balance of the submerged weight and K; at φ = 0.002 they are those of a sphere alone. The solid \
        fraction is given and stays uniform: with slip and without a stress between the grains, two phases of one \
        pressure are unstable at short waves. The kernel of the drag, two or three spacings wide, holds them back for \
        the time of a run, not for ever; the unevenness of the grains' velocities is observed.";
    type Parameters = SettlingParameters;
    const QUANTITIES: &'static [Quantity] = quantities::QUANTITIES;

    fn metrics(_: &SettlingParameters, records: &[SettlingRecord]) -> Vec<Metric> {
        metrics::all(records)
    }

    fn figures(_: &SettlingParameters, records: &[SettlingRecord]) -> Vec<Figure> {
        figures::all(records)
    }

    fn tables(_: &SettlingParameters, records: &[SettlingRecord]) -> Vec<Table> {
        records.iter().map(|(run, record)| record.data.series.table(&run.variant())).collect()
    }
}
