//! How the runs are judged: each by its formulation, all together by statements and fits.

use super::BedLoadRecord;
use super::fit::{self, held_out};
use super::metrics::{balances, continuum, forgets_start, has_forgotten, printed, transport};
use super::quantities::{FIT_AT_BORDER, FIT_MISFIT, FITTED_VISCOSITY, FITTED_YIELD_STRESS, HELD_OUT_TRANSPORT_RATIO};
use super::run::{BedLoadFormulation, GrainKind};
use super::statements;
use crate::metric::{Limit, Metric};
use crate::reference::bed_load::{MEASURED_BAND, TransportFormula};

pub(super) fn all(records: &[BedLoadRecord]) -> Vec<Metric> {
    let mut metrics = Vec::new();
    for (run, record) in records {
        match &run.formulation {
            BedLoadFormulation::Grains(GrainKind::Paper, _) => printed(&mut metrics, run, record),
            BedLoadFormulation::Grains(GrainKind::Stabilised, grains) => {
                statements::stabilised(&mut metrics, records, run, record, grains);
            }
            BedLoadFormulation::Grains(GrainKind::AtRest, _) => balances(&mut metrics, run, record),
            BedLoadFormulation::Grains(GrainKind::OtherStart, _) => {
                balances(&mut metrics, run, record);
                metrics.push(transport(run, record, false));
            }
            BedLoadFormulation::Grains(GrainKind::Fit(_), _) => metrics.push(transport(run, record, true)),
            BedLoadFormulation::Continuum(own) => {
                continuum(&mut metrics, run, record, own, has_forgotten(records, run));
            }
        }
    }
    forgets_start(&mut metrics, records);
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
