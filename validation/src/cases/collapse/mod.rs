//! A column of dry grains that collapses on a rough horizontal bed: what the planar and the round case share.

mod column;
mod deposit;
pub(super) mod figures;
pub(super) mod metrics;

pub use column::{ColumnRun, Geometry};
pub use deposit::{BIN_WIDTH, Collapse, FRONT_THICKNESS, front};

use crate::observe::Recorded;
use crate::output::Table;

/// A run with what it left behind.
pub(super) type Record = (ColumnRun, Recorded<Collapse>);

/// Tables of one run: the deposit and the time series.
pub(super) fn tables(variant: &str, collapse: &Collapse) -> Vec<Table> {
    let stem = variant.replace(['=', ','], "-").replace('_', "-");
    let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    let series = |k: usize| {
        let energies = [collapse.kinetic_energy[k], collapse.potential_energy[k]];
        [collapse.time[k], collapse.front[k], collapse.height[k]].into_iter().chain(energies).collect()
    };
    vec![
        Table {
            name: format!("deposit-{stem}"),
            columns: names(&["x/r0 [-]", "thickness/r0 [-]"]),
            rows: collapse.deposit.iter().map(|&(x, thickness)| vec![x, thickness]).collect(),
        },
        Table {
            name: format!("series-{stem}"),
            columns: names(&[
                "t [s]",
                "front/r0 [-]",
                "height/r0 [-]",
                "kinetic energy [J/m]",
                "potential energy [J/m]",
            ]),
            rows: (0..collapse.time.len()).map(series).collect(),
        },
    ]
}
