//! Tables of one run: profile and time series.

use super::ChannelObservation;
use crate::case::Run;
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::output::Table;

/// Tables of all runs of a case of water alone.
#[must_use]
pub fn tables_of_runs<R: Run>(records: &[(R, Recorded<ChannelObservation>)]) -> Vec<Table> {
    records.iter().flat_map(|(run, record)| tables(&run.variant(), &record.data)).collect()
}

/// Tables of one run.
#[must_use]
pub fn tables(variant: &Variant, data: &ChannelObservation) -> Vec<Table> {
    let stem = variant.file_name();
    let names = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    let series = &data.series;
    let profile = data.profile.points().into_iter().zip(data.profile.velocities());
    let mut tables = vec![
        Table {
            name: format!("profile-{stem}"),
            columns: names(&["z [m]", "u [m/s]", "standard error of u [m/s]", "p [Pa]", "samples [-]"]),
            rows: profile
                .map(|(point, velocity)| {
                    vec![point.height, point.velocity, velocity.standard_error, point.pressure, point.samples]
                })
                .collect(),
        },
        Table {
            name: format!("series-{stem}"),
            columns: names(&[
                "t [s]",
                "mean u [m/s]",
                "relative height [-]",
                "highest [-]",
                "rms vertical velocity [m/s]",
                "bed shear [Pa]",
                "pressure error [-]",
            ]),
            rows: (0..series.time.len())
                .map(|k| {
                    let columns = [
                        &series.time,
                        &series.mean_velocity,
                        &series.relative_height,
                        &series.highest,
                        &series.rms_vertical_velocity,
                        &series.bed_shear,
                        &series.pressure_error,
                    ];
                    columns.iter().map(|column| column[k]).collect()
                })
                .collect(),
        },
    ];
    // a run that diverged before its averaging window has no profile
    tables.retain(|table| !table.rows.is_empty());
    tables
}
