//! Dry grains that collapse: columns on a horizontal bed, which the planar and the round case share, and a reservoir on a
//! slope, which incline-collapse and flow-thickness share.

mod column;
mod external;
mod figures;
mod heap;
pub mod incline;
mod interior;
pub(super) mod metrics;
pub mod planar;
pub mod round;
mod slope;

pub(crate) use column::TALLEST_FINE;
pub use column::{Alteration, ColumnPurpose, ColumnRun, ExperimentGrains, Geometry, Material, Release};
pub use heap::{BIN_WIDTH, Collapse, FRONT_THICKNESS, Fronts};
pub use slope::{SlopeCollapse, SlopeFlow};

use crate::case::{ParameterError, Run};
use crate::observation::Recorded;
use crate::output::Table;

/// Half width of the columns of the collapse paper's sand, planar and round `[m]`.
pub(super) const SAND_HALF_WIDTH: f64 = 0.0972;

/// A run with what it left behind.
pub(super) type CollapseRecord = (ColumnRun, Recorded<Collapse>);

/// Tables of one run: the deposit and the time series.
pub(super) fn tables((run, record): &CollapseRecord) -> Vec<Table> {
    let collapse = &record.data;
    let stem = run.variant().file_name();
    let energy = |kind: &str| format!("{kind} energy [{}]", run.geometry.energy_unit());
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

/// Particles beyond which a column would take weeks or all memory.
const MOST_PARTICLES: f64 = 5e6;

/// Refuses columns of more than [`MOST_PARTICLES`] particles; `field` names the parameter that a run's resolution comes from.
pub(super) fn check_size(runs: &[&ColumnRun], field: impl Fn(&ColumnRun) -> String) -> Result<(), ParameterError> {
    let Some(run) = runs.iter().find(|run| run.particles() > MOST_PARTICLES) else { return Ok(()) };
    let rule = format!("chosen for at most {MOST_PARTICLES:.0e} particles per column");
    let remedy = format!(
        "the column of aspect ratio {} would have {:.1e}: choose a smaller resolution",
        run.aspect_ratio,
        run.particles()
    );
    Err(ParameterError::field(&field(run), run.resolution, &rule, &remedy))
}
