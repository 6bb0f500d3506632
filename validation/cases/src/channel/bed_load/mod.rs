//! Bed load on three slopes in three formulations.

mod checks;
mod continuum;
mod figures;
mod fit;
mod foreign;
mod judgement;
mod metrics;
mod observation;
mod parameters;
mod profiles;
mod quantities;
mod run;
mod runs;
mod scenes;
mod statements;
mod tiers;

pub use observation::BedLoadObservation;
pub use parameters::{BedLoadParameters, Beside, Continuum, Fit, GrainParticles, Materials, Stage, StageRuns};
pub use run::{BedLoadFormulation, BedLoadRun, ContinuumRun, GrainKind};

use crate::case::{Case, ExternalData, ExternalObservation, ExternalSchema, RecordOf, Run};
use crate::channel;
use crate::figure::Figure;
use crate::input::FieldError;
use crate::metric::{Metric, Quantity};
use crate::output::Table;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct BedLoad;

type BedLoadRecord = RecordOf<BedLoadParameters>;

impl Case for BedLoad {
    const NAME: &'static str = "bed-load";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str = "water over a bed that moves: profiles, drag and transport, in three formulations";
    const DESCRIPTION: &'static str = "Turbulent water over a bed of 5 mm grains. `stabilised` has one particle a grain, a yield stress that grows with \
        the grains' weight, and two parameters that are fitted on two slopes and judged on the third. `continuum` \
        resolves the grains' layer by its solid fraction, with closures of the literature; it is verified \
        against the 1-D layer of bed-load-1d in three stages: grains at rest, grains that move at a given fraction, grains \
        that dilate. `paper` is the set-up as printed, which fails in documented ways: its metrics are observations. Water \
        over moving grains is compared with `at-rest`, the same run with all grains held. A second start shows whether a run \
        has forgotten its own (`forgets_start`). The quick tier is too short for that: it judges conservation, and whether \
        dilating grains keep the layer's water and make its transport.";
    const EXTERNAL_SCHEMA: ExternalSchema = foreign::EXTERNAL_SCHEMA;
    type Parameters = BedLoadParameters;
    const QUANTITIES: &'static [Quantity] = quantities::QUANTITIES;

    fn metrics(_: &BedLoadParameters, records: &[BedLoadRecord]) -> Vec<Metric> {
        judgement::all(records)
    }

    fn figures(_: &BedLoadParameters, records: &[BedLoadRecord]) -> Vec<Figure> {
        figures::all(records)
    }

    fn from_external(
        run: &BedLoadRun,
        given: &ExternalData,
    ) -> Result<Option<ExternalObservation<BedLoadObservation>>, FieldError> {
        foreign::observe(run, given).map(Some)
    }

    fn tables(_: &BedLoadParameters, records: &[BedLoadRecord]) -> Vec<Table> {
        let of_run = |(run, record): &BedLoadRecord| {
            let variant = run.variant();
            let mut tables = channel::tables(&variant, &record.data.channel);
            tables.extend(profiles::grain_table(&variant, &record.data));
            tables
        };
        records.iter().flat_map(of_run).collect()
    }
}
