//! Turbulent flow of clear water over a fixed rough bed against the logarithmic law.

mod figures;
mod flow;
mod laws;
mod metrics;

pub use flow::{ClearWaterFlow, Period};

use crate::case::{Case, DrawFigures, ExternalSchema, FromExternal, Judge, RecordOf, Tabulate};
use crate::channel;
use crate::metric::Quantity;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct ClearWater;

type ClearWaterRecord = RecordOf<ClearWaterFlow>;

impl Case for ClearWater {
    const NAME: &'static str = "clear-water";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str = "turbulent clear water over a fixed rough bed against the logarithmic law";
    const DESCRIPTION: &'static str = "\
        Setup. Water flows over a fixed bed of 5 mm grains on slopes of 2, 3 and 5 %. A mixing length stands for \
        unresolved turbulence, and the bed follows the law of a rough wall. This closure reproduces the logarithmic \
        law exactly in uniform flow. The paper tier starts 20 % too slow and averages a stationary flow: the depth \
        average changes by less than 0.5 % over U/(2 g i), three times in a row. The quick tier starts from the \
        logarithmic law and must keep it.\n\n\
        Judged. Velocity profile, its slope over the logarithm of height, depth average and bed friction against the \
        law; the momentum balance.\n\n\
        Observed only. Pressure and depth. Velocities of a run that starts apart from the law and does not become \
        stationary.";
    const EXTERNAL_SCHEMA: ExternalSchema = channel::foreign::EXTERNAL_SCHEMA;
    type Flow = ClearWaterFlow;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;
    const METRICS: Judge<Self::Flow> =
        |records| records.iter().flat_map(metrics::of_run).chain(laws::metrics()).collect();
    const FIGURES: DrawFigures<Self::Flow> = |records| vec![figures::profiles(records)];
    const FROM_EXTERNAL: FromExternal<Self::Flow> = |_, given| channel::foreign::observe(given).map(Some);
    const TABLES: Tabulate<Self::Flow> = channel::tables_of_runs;
}
