//! A column of water that collapses on smooth and on rough beds.

mod figures;
mod flow;
mod foreign;
mod metrics;

pub use flow::{ColumnObservation, Release, WaterColumnFlow};

use crate::case::{Case, DrawFigures, ExternalSchema, FromExternal, Judge, RecordOf, Tabulate};
use crate::metric::Quantity;
use crate::output::Table;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct WaterColumn;

type Record = RecordOf<WaterColumnFlow>;

impl Case for WaterColumn {
    const NAME: &'static str = "water-column";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str =
        "a column of water that collapses on a bed: energy balance, and front and height against measurements";
    const DESCRIPTION: &'static str = "\
        Setup. A column of water (1 mPa·s), twice as high as wide, is released beside a symmetry plane by the weakly \
        compressible model, on smooth and on rough beds, with and without tension. Water shows energy that a \
        wall feeds in, which grains would dissipate. A square column stands behind a gate that is lifted at 4.53 \
        m/s. The momentum equation uses the uncorrected divergence, which is adjoint to the continuity equation.\n\n\
        Judged. The energy balance closes and total energy does not rise. The front of the gated column against \
        Lobovský et al. (2014). The height at the wall against Martin & Moyce (1952).\n\n\
        Observed only. The front compared with that of Martin & Moyce, which starts later. With kernel-corrected forces the \
        same column gains 1.4 % of the work of gravity.";
    type Flow = WaterColumnFlow;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;
    const EXTERNAL_SCHEMA: ExternalSchema = foreign::EXTERNAL_SCHEMA;
    const METRICS: Judge<Self::Flow> = metrics::all;
    const FIGURES: DrawFigures<Self::Flow> = figures::all;
    const FROM_EXTERNAL: FromExternal<Self::Flow> = foreign::observe;
    const TABLES: Tabulate<Self::Flow> = |records| {
        let of_run = |(run, record): &Record| {
            let name = format!("front-{}", crate::case::Flow::variant(run).file_name());
            Table::of_columns(name, &[("t √(2g/a) [-]", &record.data.time[..]), ("x/a [-]", &record.data.front[..])])
        };
        records.iter().map(of_run).collect()
    };
}
