//! Series of gauges: their columns, what they are compared with, and how they are written.

use super::flow::Dimension;
use super::measured::MeasuredSeries;
use super::setting::SceneGauge;
use super::{Measurand, SceneFlow, SceneObservation, SceneRecord};
use crate::output::Table;

/// One column of a series.
pub(super) struct GaugeColumn {
    /// Name and unit.
    pub(super) heading: String,
    /// Label of its axis.
    pub(super) axis: String,
}

/// Measured series of a gauge in a run.
pub(super) struct GaugeSeries<'a, const D: usize> {
    /// Name of the gauge.
    pub(super) gauge: &'a str,
    /// Measurand of the gauge.
    pub(super) measure: Measurand<'a, D>,
    /// Columns of the gauge in tables of results.
    pub(super) columns: Vec<GaugeColumn>,
    /// Values of the gauges, shape `[columns][samples]`.
    pub(super) values: &'a [Vec<f64>],
    /// Measured series with which its first column is compared.
    pub(super) measured: Vec<&'a MeasuredSeries>,
}

/// The series of all gauges in a run, gauge by gauge.
pub(super) fn of_run<'a, S: Dimension<D>, const D: usize>(
    parameters: &'a SceneFlow<S, D>,
    data: &'a SceneObservation<D>,
) -> Vec<GaugeSeries<'a, D>> {
    let mut next = 0;
    let with_values = |(gauge, measure): (&'a S::Gauge, Measurand<'a, D>)| {
        let (gauge, columns) = (gauge.name(), columns::<S, D>(&measure));
        let values = data.gauges.get(next..next + columns.len()).unwrap_or_default();
        next += columns.len();
        let measured = parameters.measured.iter().filter(|measured| measured.gauge == gauge).collect();
        GaugeSeries { gauge, measure, columns, values, measured }
    };
    parameters.gauges.iter().zip(parameters.measures()).map(with_values).collect()
}

/// The columns of a gauge's series.
fn columns<S: Dimension<D>, const D: usize>(measure: &Measurand<'_, D>) -> Vec<GaugeColumn> {
    let (force, mass, flux) = (S::FORCE_UNIT, S::MASS_UNIT, S::FLUX_UNIT);
    let column = |what: &str, axis: &str, unit: &str| GaugeColumn {
        heading: format!("{what} [{unit}]"),
        axis: format!("{axis} [{unit}]"),
    };
    let along = |what: &str, unit: &str| -> Vec<GaugeColumn> {
        ["x", "y", "z"].iter().take(D).map(|axis| column(&format!("{what} along {axis}"), what, unit)).collect()
    };
    match measure {
        Measurand::Front(_) => {
            let half = |word: &str| column(&format!("front at half a row {word}"), "interval of the front", "m");
            vec![column("front", "front", "m"), half("more"), half("less")]
        }
        Measurand::Depth(_) => vec![column("depth", "depth", "m")],
        Measurand::Probe(_) => {
            let pressures = [column("pressure", "pressure", "Pa"), column("pore pressure", "pressure", "Pa")];
            pressures.into_iter().chain(along("velocity", "m/s")).collect()
        }
        Measurand::Force(_) => along("force", force),
        Measurand::Position(_) => along("displacement", "m"),
        Measurand::Turn(_) => {
            vec![column("torque", "torque", &force.replacen('N', "N m", 1)), column("angle", "angle", "rad")]
        }
        Measurand::Flux(_) => {
            vec![column("mass that has crossed", "mass", mass), column("mean flux since the last row", "flux", flux)]
        }
    }
}

/// The series of each run as a table: time, mass, and a column a gauge's column.
pub(crate) fn tables<S: Dimension<D>, const D: usize>(records: &[SceneRecord<S, D>]) -> Vec<Table> {
    let mass = format!("mass in the scene [{}]", S::MASS_UNIT);
    let of_run = |(flow, record): &SceneRecord<S, D>| {
        let (data, series) = (&record.data, of_run(flow, &record.data));
        let heading = |gauge: &str, column: &GaugeColumn| format!("{gauge}: {}", column.heading);
        let headings: Vec<String> =
            series.iter().flat_map(|one| one.columns.iter().map(|column| heading(one.gauge, column))).collect();
        let mut columns = vec![("t [s]", &data.time[..]), (&mass, &data.mass)];
        columns.extend(headings.iter().map(String::as_str).zip(data.gauges.iter().map(Vec::as_slice)));
        Table::of_columns(format!("gauges-{}", flow.named().file_name()), &columns)
    };
    records.iter().map(of_run).collect()
}
