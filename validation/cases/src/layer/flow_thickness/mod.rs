//! How thick granular flow on a slope is, and at which slope it stops.

mod figures;
mod flow;
mod metrics;
mod start_stop;

pub use flow::{FlowThicknessFlow, FlowThicknessObservation};
pub use start_stop::{LayerFate, SlopeTrial, StartStop};

use crate::case::{Case, DrawFigures, Flow, Judge, RecordOf, Tabulate};
use crate::layer::LayerObservation;
use crate::metric::Quantity;
use crate::output::Table;
use crate::store::CodeOrigin;
use bagnold_solver::material::rheology::Rheology;

/// The case.
#[derive(Debug)]
pub struct FlowThickness;

type Record = RecordOf<FlowThicknessFlow>;

impl Case for FlowThickness {
    const NAME: &'static str = "flow-thickness";
    const AXES_BY_RUNS: bool = true;
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str = "the slope at which a layer of given thickness stops, and the flow rule";
    const DESCRIPTION: &'static str = "\
        Setup. (i) Layers start with the steady profile of a steeper slope, and a bisection finds the slope at which \
        each thickness stops. (ii) Steady layers flow on several slopes.\n\n\
        Judged. (i) The stopping slope under the local law against tan θ = μ_s, and against the measured h_stop(θ) \
        = L (μ_2 − tan θ)/(tan θ − μ_s). The latter fails for thin layers: a local law stops every thickness at one \
        slope. The stopping slope under the nonlocal law against the exact slope at which its first mode grows, and \
        its steady profile against a 1-D solution. (ii) Mean velocity against (42), Ū/√(gh) = β \
        h/h_stop. With (41) this is an identity of the law: it verifies the solver only.";
    type Flow = FlowThicknessFlow;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;
    const METRICS: Judge<Self::Flow> = metrics::all;
    const FIGURES: DrawFigures<Self::Flow> = figures::all;
    const TABLES: Tabulate<Self::Flow> = |records| records.iter().filter_map(trials).collect();
}

/// The trials of a search.
fn trials((run, record): &Record) -> Option<Table> {
    let FlowThicknessObservation::StartStop(found) = &record.data else { return None };
    let columns = ["slope [°]", "stops [-]", "t [s]", "mean u [m/s]"];
    let stops = |trial: &SlopeTrial| match trial.fate {
        LayerFate::Stops => 1.0,
        LayerFate::Flows => 0.0,
        LayerFate::Undecided => f64::NAN,
    };
    let row = |trial: &SlopeTrial| vec![trial.slope_angle, stops(trial), trial.time, trial.mean_velocity];
    let name = format!("trials-{}", run.variant().file_name());
    Some(Table::of_rows(name, &columns, found.trials.iter().map(row)))
}

/// The steady flows of the local law, or of the nonlocal one, among the records.
fn flows(records: &[Record], nonlocal: bool) -> impl Iterator<Item = (&FlowThicknessFlow, &LayerObservation)> {
    let is_own = move |flow: &FlowThicknessFlow| matches!(flow.material, Rheology::NonlocalMuI(_)) == nonlocal;
    records.iter().filter(move |(flow, _)| is_own(flow)).filter_map(|(flow, record)| match &record.data {
        FlowThicknessObservation::Steady(data) => Some((flow, data.as_ref())),
        FlowThicknessObservation::StartStop(_) => None,
    })
}

/// The searches among the records.
fn searches(records: &[Record]) -> impl Iterator<Item = (&FlowThicknessFlow, &StartStop)> {
    records.iter().filter_map(|(flow, record)| match &record.data {
        FlowThicknessObservation::StartStop(data) => Some((flow, data)),
        FlowThicknessObservation::Steady(_) => None,
    })
}
