//! Dry grains flowing down an incline: Bagnold's profile (36)–(37), the way to it, arrest and runaway.

mod errors;
mod figures;
mod limits;
mod metrics;
mod parameters;
mod runs;
mod tiers;

pub use parameters::{BagnoldParameters, LayerStart, OtherGrains};
pub use runs::{BagnoldPurpose, BagnoldRun};

use crate::case::{Case, ExternalData, ExternalObservation, ExternalSchema, RecordOf};
use crate::figure::Figure;
use crate::input::FieldError;
use crate::layer::{self, LayerObservation};
use crate::metric::{Metric, Quantity};
use crate::output::Table;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct Bagnold;

type BagnoldRecord = RecordOf<BagnoldParameters>;

impl Case for Bagnold {
    const NAME: &'static str = "bagnold";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str =
        "μ(I) grains on an incline: Bagnold's velocity profile, its approach, arrest below and runaway above";
    const DESCRIPTION: &'static str = "A layer of glass beads with the μ(I) rheology on an incline, periodic along the slope, over a no-slip bed. \
        From rest the displaced particles are settled first and carry the shear stress of the static friction limit. \
        Between the static and the limiting friction angle the steady velocity follows Bagnold's profile (36)–(37), \
        exact for the model; the way to it from rest is compared with an independent one-dimensional solver. \
        Below that band the layer must come to rest, above it must accelerate without end. \
        Bagnold's flow makes an error of the friction coefficient eight (25°) to twenty (22°) times as large in the \
        velocity (dln I/dln μ), so the implied stress error \
        |μ(I)/tanθ − 1| stands beside the velocity error.";
    const EXTERNAL_SCHEMA: ExternalSchema = layer::foreign::EXTERNAL_SCHEMA;
    type Parameters = BagnoldParameters;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;

    fn metrics(parameters: &BagnoldParameters, records: &[BagnoldRecord]) -> Vec<Metric> {
        metrics::all(parameters, records)
    }

    fn figures(parameters: &BagnoldParameters, records: &[BagnoldRecord]) -> Vec<Figure> {
        figures::all(parameters, records)
    }

    fn from_external(
        run: &BagnoldRun,
        given: &ExternalData,
    ) -> Result<Option<ExternalObservation<LayerObservation>>, FieldError> {
        run.observe_external(given).map(Some)
    }

    fn tables(_: &BagnoldParameters, records: &[BagnoldRecord]) -> Vec<Table> {
        layer::tables_of_runs(records)
    }
}
