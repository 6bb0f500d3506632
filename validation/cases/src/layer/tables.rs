//! A layer's profile and series as tables.

use super::{DepthProfile, LayerObservation};
use crate::case::Flow;
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::output::Table;

/// Tables of all runs of a case.
pub fn tables_of_runs<R: Flow>(records: &[(R, Recorded<LayerObservation>)]) -> Vec<Table> {
    records.iter().flat_map(|(run, record)| tables(&run.variant(), &record.data)).collect()
}

/// Tables of one run: depth profile and time series.
fn tables(variant: &Variant, data: &LayerObservation) -> Vec<Table> {
    let stem = variant.file_name();
    let (profile, series) = (&data.profile, &data.series);
    let row = |bin: usize| {
        let DepthProfile { height, velocity, pressure, normal_stress, shear_stress, samples } = profile;
        [height, velocity, pressure, normal_stress, shear_stress, samples].map(|column| column[bin]).to_vec()
    };
    let headings = ["y [m]", "u [m/s]", "p [Pa]", "p - s_yy [Pa]", "s_xy [Pa]", "samples [-]"];
    let columns: [(&str, &[f64]); 4] = [
        ("t [s]", &series.time),
        ("mean u [m/s]", &series.mean_velocity),
        ("rms speed [m/s]", &series.rms_speed),
        ("relative height [-]", &series.relative_height),
    ];
    let mut tables = vec![
        Table::of_rows(format!("profile-{stem}"), &headings, profile.filled().map(row)),
        Table::of_columns(format!("series-{stem}"), &columns),
    ];
    // a run that diverged before its averaging window has no profile
    tables.retain(|table| !table.rows.is_empty());
    tables
}
