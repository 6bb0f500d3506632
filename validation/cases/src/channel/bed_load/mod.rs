//! Bed load on three slopes in three formulations.

mod continuum;
mod figures;
mod fit;
mod flow;
mod foreign;
mod kept;
mod metrics;
mod observation;
mod profiles;
mod run;
mod scenes;

pub use flow::{BedLoadFlow, BedLoadFormulation, Continuum, GrainParticles};
pub use observation::BedLoadObservation;

use crate::case::{Case, DrawFigures, ExternalSchema, Flow, FromExternal, Judge, RecordOf, Tabulate};
use crate::channel;
use crate::metric::Quantity;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct BedLoad;

type BedLoadRecord = RecordOf<BedLoadFlow>;

impl Case for BedLoad {
    const NAME: &'static str = "bed-load";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str = "water over a mobile bed: profiles, drag and transport, in three formulations";
    const DESCRIPTION: &'static str = "\
        Setup. Turbulent water flows over a bed of 5 mm grains, in three formulations. `stabilised` has one particle \
        per grain, a yield stress proportional to the weight of the grains, and two parameters that are fitted on \
        two slopes. `continuum` resolves the grain layer by its solid fraction, with closures from the literature, \
        in three stages: fixed grains, moving grains at a given fraction, dilating grains. `paper` is the printed \
        set-up. The run `at-rest` holds all grains fixed; a second start differs in its velocity.\n\n\
        Judged. Conservation in all tiers. `continuum` against the 1-D layer of `bed-load-1d` (verification). At the \
        quick tier, pairs of runs start slower and faster than a kept state and are judged at the flow between them \
        that would not change. In the paper tier, transport of `stabilised` on the third slope, and whether the two starts still differ \
        (`forgets_start`).\n\n\
        Observed only. All metrics of `paper`, which fails in documented ways. Transport and profiles of runs that \
        still depend on their start.";
    const EXTERNAL_SCHEMA: ExternalSchema = foreign::EXTERNAL_SCHEMA;
    type Flow = BedLoadFlow;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;
    const METRICS: Judge<Self::Flow> = metrics::all;
    const FIGURES: DrawFigures<Self::Flow> = figures::all;
    const FROM_EXTERNAL: FromExternal<Self::Flow> = |run, given| foreign::observe(run, given).map(Some);
    const TABLES: Tabulate<Self::Flow> = |records| {
        let of_run = |(run, record): &BedLoadRecord| {
            let variant = run.variant();
            let mut tables = channel::tables(&variant, &record.data.channel);
            tables.extend(profiles::grain_table(&variant, &record.data));
            tables.extend(kept::table(run, &record.frames));
            tables
        };
        records.iter().flat_map(of_run).collect()
    };
}
