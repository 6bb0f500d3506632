//! Settling grains: the drag laws, a grain alone and a uniform suspension against the roots of their balances.

mod drag_curves;
mod figures;
mod flow;
mod metrics;
mod probe;
mod scene;

pub use flow::SettlingFlow;
pub use probe::{SettlingObservation, SettlingSeries};

use crate::case::{Case, DrawFigures, Flow, Judge, RecordOf, Tabulate};
use crate::metric::Quantity;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct Settling;

type SettlingRecord = RecordOf<SettlingFlow>;

impl Case for Settling {
    const NAME: &'static str = "settling";
    const AXES_BY_RUNS: bool = true;
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str = "a single grain and a uniform suspension settle in a fluid, with every drag law";
    const DESCRIPTION: &'static str = "\
        Setup, one grain (`paper`, `stabilised`). A grain settles in a doubly periodic box of fluid. An upward body \
        force on the fluid balances the weight of the grain. `paper` uses the operators of the bed-load paper and \
        drag per pair of particles; `stabilised` uses the default operators and the mean fluid velocity near the \
        grain.\n\n\
        Setup, suspension (`continuum`). A suspension of given, uniform solid fraction settles in a periodic column \
        under gravity. One pore pressure makes the mixture flux divergence-free. A uniform pressure gradient removes \
        the mean flux, as the floor of a vessel would.\n\n\
        Judged. The mean slip velocity must balance drag and submerged weight. It is the slip that the drag is \
        computed from: |⟨u_f⟩ − u_s|, or for pair drag the U with C_d(U) U² = |⟨C_d |u_ba| u_ba⟩|. Momentum of both \
        phases must close to rounding in every step. At φ = 0.002 the suspension must settle like a single sphere. \
        Hindered settling against measurements.\n\n\
        Observed only. Hindered settling against Richardson & Zaki. The scatter of grain velocities: two phases with \
        one pressure are ill-posed at short waves, and the drag kernel (two or three spacings wide) suppresses this \
        for the duration of the run only.";
    type Flow = SettlingFlow;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;
    const METRICS: Judge<Self::Flow> = metrics::all;
    const FIGURES: DrawFigures<Self::Flow> = figures::all;
    const TABLES: Tabulate<Self::Flow> =
        |records| records.iter().map(|(run, record)| record.data.series.table(&run.variant())).collect();
}
