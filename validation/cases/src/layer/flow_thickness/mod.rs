//! How thick granular flow on a slope is, and at which slope it stops.

mod figures;
mod metrics;
mod nonlocal;
mod parameters;
mod start_stop;

pub use nonlocal::{NonlocalChoice, NonlocalLayers, NonlocalParameters};
pub use parameters::FlowThicknessParameters;
pub use start_stop::{LayerAtSlope, LayerFate, SlopeTrial, StartStop, StartStopRun};

use crate::case::{Case, ParameterError, Progress, RecordOf, Run};
use crate::collapse::{SlopeCollapse, SlopeFlow};
use crate::figure::Figure;
use crate::layer::LayerObservation;
use crate::metric::{Metric, Quantity, Variant};
use crate::observation::Recorded;
use crate::output::Table;
use crate::store::CodeOrigin;
use bagnold_solver::material::rheology::Rheology;
use serde::{Deserialize, Serialize};
use start_stop::InitialMotion;

/// The case.
#[derive(Debug)]
pub struct FlowThickness;

/// A steady flow, from its exact profile.
#[derive(Debug, Clone, Serialize)]
pub struct SteadyRun {
    /// The layer.
    pub layer: LayerAtSlope,
    /// Slope `[°]`.
    pub slope_angle: f64,
}

/// One simulation, or one search.
#[derive(Debug, Clone, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum FlowThicknessRun {
    /// A collapse on a slope.
    Collapse(SlopeFlow),
    /// The slope at which a layer stops.
    StartStop(StartStopRun),
    /// A steady flow.
    Steady(SteadyRun),
}

/// What it leaves behind.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FlowThicknessObservation {
    /// Thickness in time, and all balances.
    Collapse(SlopeCollapse),
    /// The trials.
    StartStop(StartStop),
    /// Profile and time series.
    Steady(LayerObservation),
}

type FlowThicknessRecord = RecordOf<FlowThicknessParameters>;

impl Run for FlowThicknessRun {
    type Observation = FlowThicknessObservation;

    fn laws(&self) -> Vec<Rheology> {
        match self {
            Self::Collapse(run) => vec![run.material],
            Self::StartStop(run) => vec![Rheology::MuI(run.layer.material)],
            Self::Steady(run) => vec![Rheology::MuI(run.layer.material)],
        }
    }

    fn variant(&self) -> Variant {
        match self {
            Self::Collapse(run) => run.variant(),
            Self::StartStop(run) => run.layer.variant(None),
            Self::Steady(run) => run.layer.variant(Some(run.slope_angle)),
        }
    }

    fn particles(&self) -> f64 {
        match self {
            Self::Collapse(run) => run.cost().particles,
            Self::StartStop(run) => run.layer.particles(),
            Self::Steady(run) => run.layer.particles(),
        }
    }

    fn particle_steps(&self) -> f64 {
        match self {
            Self::Collapse(run) => run.cost().particle_steps,
            // most trials end early
            Self::StartStop(run) => run.rounds() / 3.0 * run.layer.particle_steps(),
            Self::Steady(run) => run.layer.particle_steps(),
        }
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<FlowThicknessObservation>, ParameterError> {
        Ok(match self {
            Self::Collapse(run) => run.simulate(progress)?.map(FlowThicknessObservation::Collapse),
            Self::StartStop(run) => run.simulate(progress)?.map(FlowThicknessObservation::StartStop),
            Self::Steady(run) => {
                let exact = run.layer.exact(run.slope_angle);
                let start = exact
                    .and_then(InitialMotion::of_nonlocal)
                    .unwrap_or_else(|| InitialMotion::of(run.layer.profile(run.slope_angle)));
                run.layer.layer(run.slope_angle, &start).run(progress)?.map(FlowThicknessObservation::Steady)
            }
        })
    }
}

impl Case for FlowThickness {
    const NAME: &'static str = "flow-thickness";
    const ORIGIN: CodeOrigin = CodeOrigin::PACKAGE;
    const SUMMARY: &'static str = "thickness of flow on a slope, the slope at which a layer stops, and the flow rule";
    const DESCRIPTION: &'static str = "\
        Setup. (i) Grains are released on slopes of 22 to 25°, as in `incline-collapse`; thickness at a station is \
        the volume in a bin of 2 cm over its width. (ii) Layers start with the steady profile of a steeper slope, \
        and a bisection finds the slope at which each thickness stops. (iii) Steady layers flow on several slopes.\n\n\
        Judged. (ii) The stopping slope under the local law against tan θ = μ_s, and against the measured h_stop(θ) \
        = L (μ_2 − tan θ)/(tan θ − μ_s). The latter fails for thin layers: a local law stops every thickness at one \
        slope. The stopping slope under the nonlocal law against the exact slope at which its first mode grows, and \
        its steady profile against a solution without particles. (iii) Mean velocity against (42), Ū/√(gh) = β \
        h/h_stop. With (41) this is an identity of the law: it verifies the solver only.\n\n\
        Observed only. (i), in the paper tier: thickness at stations beside (44) of the paper. Equation (44) describes a steady \
        discharge of β √(g h_0³) per width, which the study `fed-slope` feeds; a released block discharges less and \
        less.";
    type Parameters = FlowThicknessParameters;
    const QUANTITIES: &'static [Quantity] = metrics::QUANTITIES;

    fn metrics(parameters: &FlowThicknessParameters, records: &[FlowThicknessRecord]) -> Vec<Metric> {
        metrics::all(parameters, records)
    }

    fn figures(parameters: &FlowThicknessParameters, records: &[FlowThicknessRecord]) -> Vec<Figure> {
        figures::all(parameters, records)
    }

    fn tables(_: &FlowThicknessParameters, records: &[FlowThicknessRecord]) -> Vec<Table> {
        records.iter().filter_map(trials).collect()
    }
}

/// The trials of a search.
fn trials((run, record): &FlowThicknessRecord) -> Option<Table> {
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
fn flows_of(records: &[FlowThicknessRecord], nonlocal: bool) -> impl Iterator<Item = (&SteadyRun, &LayerObservation)> {
    flows(records).filter(move |(run, _)| run.layer.nonlocal.is_some() == nonlocal)
}

/// The collapses among the records.
fn collapses(records: &[FlowThicknessRecord]) -> impl Iterator<Item = (&SlopeFlow, &SlopeCollapse)> {
    records.iter().filter_map(|(run, record)| match (run, &record.data) {
        (FlowThicknessRun::Collapse(run), FlowThicknessObservation::Collapse(data)) => Some((run, data)),
        _ => None,
    })
}

/// The searches among the records.
fn searches(records: &[FlowThicknessRecord]) -> impl Iterator<Item = (&StartStopRun, &StartStop)> {
    records.iter().filter_map(|(run, record)| match (run, &record.data) {
        (FlowThicknessRun::StartStop(run), FlowThicknessObservation::StartStop(data)) => Some((run, data)),
        _ => None,
    })
}

/// The steady flows among the records.
fn flows(records: &[FlowThicknessRecord]) -> impl Iterator<Item = (&SteadyRun, &LayerObservation)> {
    records.iter().filter_map(|(run, record)| match (run, &record.data) {
        (FlowThicknessRun::Steady(run), FlowThicknessObservation::Steady(data)) => Some((run, data)),
        _ => None,
    })
}
