//! Tables of one run: profile and time series.

use super::ChannelObservation;
use crate::case::Flow;
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::output::Table;

/// Tables of all runs of a case of water alone.
pub fn tables_of_runs<R: Flow>(records: &[(R, Recorded<ChannelObservation>)]) -> Vec<Table> {
    records.iter().flat_map(|(run, record)| tables(&run.variant(), &record.data)).collect()
}

/// Tables of one run.
pub fn tables(variant: &Variant, data: &ChannelObservation) -> Vec<Table> {
    let stem = variant.file_name();
    let (series, profile) = (&data.series, data.profile.points().into_iter().zip(data.profile.velocities()));
    let headings = ["z [m]", "u [m/s]", "standard error of u [m/s]", "p [Pa]", "samples [-]"];
    let rows = profile.map(|(point, velocity)| {
        vec![point.height, point.velocity, velocity.standard_error, point.pressure, point.samples]
    });
    let columns: [(&str, &[f64]); 7] = [
        ("t [s]", &series.time),
        ("mean u [m/s]", &series.mean_velocity),
        ("relative height [-]", &series.relative_height),
        ("highest [-]", &series.highest),
        ("rms vertical velocity [m/s]", &series.rms_vertical_velocity),
        ("bed shear [Pa]", &series.bed_shear),
        ("pressure error [-]", &series.pressure_error),
    ];
    let mut tables = vec![
        Table::of_rows(format!("profile-{stem}"), &headings, rows),
        Table::of_columns(format!("series-{stem}"), &columns),
    ];
    // a run that diverged before its averaging window has no profile
    tables.retain(|table| !table.rows.is_empty());
    tables
}
