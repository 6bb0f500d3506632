//! Grains released by a gate on an incline.

mod figures;
mod inside;
mod metrics;
mod passage;

use crate::case::{Animate, Case, DrawFigures, ExternalSchema, Flow, FromExternal, Judge, RecordOf, Tabulate};
use crate::collapse::{self, SlopeFlow};
use crate::metric::Quantity;
use crate::output::Table;
use crate::store::CodeOrigin;

/// The case.
#[derive(Debug)]
pub struct InclineCollapse;

type Record = RecordOf<SlopeFlow>;

impl Case for InclineCollapse {
    const NAME: &'static str = "incline-collapse";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str =
        "grains released by a lift gate on a slope: front, thickness and final run-out against experiments";
    const DESCRIPTION: &'static str = "\
        Setup. A reservoir of glass beads (14 cm high, 20 cm long, smooth back) stands behind a smooth lift gate on a \
        rough slope. The gate is lifted normal to the slope. Front: point where the thickness falls to 0.02 r_0, \
        defined as in `column-planar`.\n\n\
        Judged. Front and kinetic energy over time against another code; no measured front is available. Below the friction angle, \
        the final run-out against x_f = h_0 2k/(tan δ − tan θ) with k = 0.4 to 0.5 and tan δ = μ_s, the fit of \
        Mangeney et al. (2010) as quoted by later works.\n\n\
        Observed only. Thickness at stations, in the paper tier, beside (44) of the paper, which describes a steady \
        discharge of β √(g h_0³) per width that the study `fed-slope` feeds; a released block discharges less and less. \
        Profiles of viscosity and shear over the depth. Run-outs above the friction angle, where the \
        local μ(I) law has no deposit and the flow thins as long as the channel lasts. The fit under any other law \
        than μ(I); the wall contact friction then replaces μ_s.";
    const EXTERNAL_SCHEMA: ExternalSchema = collapse::external::slope::EXTERNAL_SCHEMA;
    type Flow = SlopeFlow;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;
    const METRICS: Judge<Self::Flow> = |records| {
        records.iter().flat_map(|record| [metrics::of_run(record), passage::metrics(record)].concat()).collect()
    };
    const FIGURES: DrawFigures<Self::Flow> = figures::all;
    const ANIMATIONS: Animate<Self::Flow> = figures::animations;
    const FROM_EXTERNAL: FromExternal<Self::Flow> =
        |run, given| collapse::external::slope::observe(run, given).map(Some);
    const TABLES: Tabulate<Self::Flow> = |records| records.iter().map(table).collect();
}

/// Time series of one run.
fn table((run, record): &Record) -> Table {
    let data = &record.data.collapse;
    let columns: [(&str, &[f64]); 4] = [
        ("t [s]", &data.time),
        ("front/r0 [-]", &data.front),
        ("kinetic energy [J/m]", &data.kinetic_energy),
        ("potential energy [J/m]", &data.potential_energy),
    ];
    Table::of_columns(format!("series-{}", run.variant().file_name()), &columns)
}
