//! Layers whose lengths are counted in grains, as runs.

use super::grain_units::GrainUnits;
use super::parameters::BedLoad1dParameters;
use super::run::{BedLoad1dRun, LayerPurpose, check_sliding};
use crate::case::ParameterError;
use crate::reference::bed_load::critical_shields_number;
use crate::reference::one_dimension::bed_load::{Closures, STEADY, Stream};

/// A stream of a Shields number over grains of a diameter `[m]`, with the materials of the case.
fn stream(lengths: &GrainUnits, parameters: &BedLoad1dParameters, shields_number: f64, diameter: f64) -> Stream {
    let excess = parameters.grains.density / parameters.water.density - 1.0;
    Stream {
        flow_depth: lengths.relative_depth * diameter,
        bed_depth: lengths.relative_bed_depth * diameter,
        held_depth: 0.0,
        grain_diameter: diameter,
        ..parameters.stream(shields_number * excess / lengths.relative_depth)
    }
}

/// The runs of both.
pub(super) fn runs(parameters: &BedLoad1dParameters) -> Vec<BedLoad1dRun> {
    let BedLoad1dParameters { similar, onset, closures, .. } = parameters;
    let of = |lengths: &GrainUnits, purpose, shields_number, diameter, closures| BedLoad1dRun {
        purpose,
        stream: stream(lengths, parameters, shields_number, diameter),
        closures,
        cell_height: diameter / lengths.cells_per_diameter,
        steady_change: STEADY,
    };
    let mut runs = Vec::new();
    if similar.shields_number > 0.0 {
        runs.push(of(&similar.lengths, LayerPurpose::Similar, similar.shields_number, similar.diameter, *closures));
    }
    let closures = Closures { regularisation_rate: onset.regularisation_rate, ..*closures };
    for &diameter in &onset.diameters {
        let shields_number =
            critical_shields_number(stream(&onset.lengths, parameters, 1.0, diameter).dimensionless_diameter());
        runs.push(of(&onset.lengths, LayerPurpose::Onset, shields_number, diameter, closures));
    }
    runs
}

/// Checks both.
pub(super) fn check(parameters: &BedLoad1dParameters) -> Result<(), ParameterError> {
    parameters.similar.lengths.check("similar")?;
    parameters.onset.lengths.check("onset")?;
    for run in runs(parameters) {
        if run.purpose == LayerPurpose::Similar {
            check_sliding("similar.shields_number", parameters.similar.shields_number, &run)?;
        }
    }
    Ok(())
}
