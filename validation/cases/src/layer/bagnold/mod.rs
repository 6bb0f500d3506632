//! Dry grains flowing down an incline: Bagnold's profile (36)–(37), the way to it, arrest and runaway.

mod errors;
mod figures;
mod flow;
mod limits;
mod metrics;

pub use flow::{BagnoldFlow, Fate, LayerStart};

use crate::case::{Case, DrawFigures, ExternalSchema, FromExternal, Judge, RecordOf, Tabulate};
use crate::layer;
use crate::metric::Quantity;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct Bagnold;

type Record = RecordOf<BagnoldFlow>;

impl Case for Bagnold {
    const NAME: &'static str = "bagnold";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str =
        "μ(I) grains on an incline: Bagnold's velocity profile, its approach, arrest below and runaway above";
    const DESCRIPTION: &'static str = "\
        Setup. A layer of glass beads with the μ(I) rheology lies on an incline, periodic along the slope, over a \
        no-slip bed. Perturbed particles at rest are relaxed first and carry the shear stress of the static friction \
        limit.\n\n\
        Judged. Between the static and the limiting friction angle, the steady velocity against Bagnold's profile, \
        equations (36)–(37), exact for the model. The approach to it from rest against an independent 1-D solver. \
        Below that range the layer must stop; above it, it must accelerate. Density against the compression of a \
        level layer (continuity). The stress error |μ(I)/tan θ − 1|: an error of the friction coefficient appears in \
        the velocity 8 (25°) to 20 (22°) times as large (dln I/dln μ).\n\n\
        Observed only. The time to reach the steady velocity.";
    const EXTERNAL_SCHEMA: ExternalSchema = layer::foreign::EXTERNAL_SCHEMA;
    type Flow = BagnoldFlow;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;
    const METRICS: Judge<Self::Flow> = metrics::all;
    const FIGURES: DrawFigures<Self::Flow> = figures::all;
    const FROM_EXTERNAL: FromExternal<Self::Flow> =
        |run, given| layer::foreign::observe(&run.layer(&|_| 0.0, &|_| 0.0), given).map(Some);
    const TABLES: Tabulate<Self::Flow> = layer::tables_of_runs;
}
