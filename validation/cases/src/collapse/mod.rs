//! Dry grains that collapse: columns on a horizontal bed, which the planar and the round case share, and a reservoir on a
//! slope, which incline-collapse and flow-thickness share.

mod column;
pub mod columns;
mod external;
mod figures;
mod heap;
pub mod incline;
mod interior;
pub(super) mod metrics;
mod slope;

pub use column::{Alteration, ColumnFlow, ExperimentGrains, Material};
pub use heap::{BIN_WIDTH, Collapse, FRONT_THICKNESS, Fronts};
pub use slope::{SlopeCollapse, SlopeFlow};

use crate::case::Flow;
use crate::observation::Recorded;
use crate::output::Table;

/// A run with its results.
pub(super) type CollapseRecord<const D: usize> = (ColumnFlow<D>, Recorded<Collapse>);

/// Tables of one run: the deposit and the time series.
pub(super) fn tables<const D: usize>((run, record): &CollapseRecord<D>) -> Vec<Table> {
    let collapse = &record.data;
    let stem = run.variant().file_name();
    let unit = if D == 2 { "J/m" } else { "J" };
    let energy = |kind: &str| format!("{kind} energy [{unit}]");
    let (kinetic, potential) = (energy("kinetic"), energy("potential"));
    let columns: [(&str, &[f64]); 6] = [
        ("t [s]", &collapse.time),
        ("front/r0 [-]", &collapse.front),
        ("front at 0.05 r0/r0 [-]", &collapse.rows_front),
        ("height/r0 [-]", &collapse.height),
        (&kinetic, &collapse.kinetic_energy),
        (&potential, &collapse.potential_energy),
    ];
    let deposit = collapse.deposit.iter().map(|&(x, thickness)| vec![x, thickness]);
    vec![
        Table::of_rows(format!("deposit-{stem}"), &["x/r0 [-]", "thickness/r0 [-]"], deposit),
        Table::of_columns(format!("series-{stem}"), &columns),
    ]
}
