//! How the runs are judged: each by its formulation, all together by statements and fits.

use super::BedLoadRecord;
use super::fit::{self, held_out};
use super::metrics::{continuum, printed, transport};
use super::quantities::{FIT_AT_BORDER, FIT_MISFIT, FITTED_VISCOSITY, FITTED_YIELD_STRESS, HELD_OUT_TRANSPORT_RATIO};
use super::run::BedLoadFormulation;
use super::statements;
use crate::metric::{Limit, Metric};
use crate::reference::bed_load::{MEASURED_BAND, TransportFormula};

pub(super) fn all(records: &[BedLoadRecord]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (run, record) in records {
        match &run.formulation {
            BedLoadFormulation::Paper(_) => printed(&mut metrics, run, record),
            BedLoadFormulation::Stabilised(grains) => statements::stabilised(&mut metrics, run, record, grains),
            BedLoadFormulation::Fit { .. } => metrics.push(transport(run, record)),
            BedLoadFormulation::Continuum(own) => continuum(&mut metrics, run, record, own),
        }
    }
    statements::say_what_is_missing(records);
    statements::growth(&mut metrics, records);
    for held in held_out(records) {
        let variant = fit::variant(&held);
        metrics.push(
            HELD_OUT_TRANSPORT_RATIO
                .of(&variant, held.ratio)
                .against(Some(1.0), TransportFormula::WongParker.name(), TransportFormula::WongParker.confidence())
                .gated(
                    Limit::Within(MEASURED_BAND.0, MEASURED_BAND.1),
                    "yield stress and viscosity are those that fit the two other slopes",
                )
                .with_snapshot_tolerance(0.05, 0.0),
        );
        let values = [
            (FITTED_YIELD_STRESS, held.yield_stress),
            (FITTED_VISCOSITY, held.viscosity),
            (FIT_MISFIT, held.misfit),
            (FIT_AT_BORDER, f64::from(u8::from(held.at_border))),
        ];
        for (quantity, value) in values {
            metrics.push(quantity.of(&variant, value).with_snapshot_tolerance(0.1, 0.05));
        }
    }
    metrics
}
