//! Runs: the steady state of a layer from one start or two, and transports about the onset of motion.

use super::draws::Draws;
use super::flow::{BedLoad1dFlow, BedMotion, LayerStart, LayerStream};
use super::onset_criterion::moves_by_some_criterion;
use crate::case::{Flow, ParameterError, Progress, RunCost};
use crate::checkpoint::is_interrupted;
use crate::metric::{FlowRegime, Variant};
use crate::observation::{Outcome, Recorded, state_hash};
use crate::reference::one_dimension::LayerError;
use crate::reference::one_dimension::bed_load::{
    Approach, BedLoadLayer, Closures, InitialVelocity, LayerState, SAME_STATE, Stream,
};
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// Steps that a layer takes, for estimates.
const USUAL_STEPS: f64 = 350.0;

/// Shields numbers at which a layer is computed, over that of the curve `[-]`.
const SCANNED: [f64; 6] = [0.55, 0.75, 1.0, 1.3, 1.7, 2.3];
/// Where the least of them still carries more than a criterion asks for, the scan goes on below by this factor, as from 0.75 to 0.55.
const NEXT_BELOW: f64 = 0.75;
/// But not below this: nobody has measured an onset at a tenth of the curve.
const LOWEST_SCANNED: f64 = 0.1;

/// Results of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BedLoadLayerObservation {
    /// Profiles of the layer over the depth.
    pub state: LayerState,
    /// Difference between the states from rest and from a fast start, where the run has both `[-]`; else 0.
    pub start_difference: f64,
    /// The state from the fast start, if the run has both and they are two.
    pub second: Option<LayerState>,
    /// Shields numbers and transports of an onset `[-]`.
    pub scan: Vec<(f64, f64)>,
    /// The same with half the rate of the regularisation: what differs is the creep of a bed that should rest.
    pub scan_at_half_rate: Vec<(f64, f64)>,
    /// Layers of drawn closures.
    pub draws: Draws,
}

impl Flow for BedLoad1dFlow {
    const RUNS: &'static str = include_str!("../../runs/bed-load-1d.toml");
    type Observation = BedLoadLayerObservation;

    fn regime(&self, _: &BedLoadLayerObservation) -> FlowRegime {
        let stream = self.stream();
        let regime = FlowRegime::of_stream(stream.slope, stream.flow_depth, stream.grain_diameter);
        // at the onset many streams stand for one
        if self.seeks_onset() { FlowRegime { slope_angle: None, ..regime } } else { regime }
    }

    fn check(&self) -> Result<(), ParameterError> {
        self.checked()
    }

    fn variant(&self) -> Variant {
        let layer = match (self.stream, self.published()) {
            (LayerStream::Onset(_), _) => return Variant::of("diameter", self.grain_diameter),
            // a sweep's points differ in its parameters only
            (LayerStream::ShieldsNumber(_), _) => return Variant::of("layer", "similar"),
            (_, Some(name)) if !self.is_suspended() => {
                return Variant::of("layer", name).and("turbulent_schmidt", self.closures.turbulent_schmidt);
            }
            (_, Some(name)) => {
                let layer = Variant::of("layer", name).and("grains", "suspended");
                return if self.start == LayerStart::Both { layer } else { self.with_changes(layer) };
            }
            (LayerStream::Slope(own), None) => Variant::of("slope", own.slope),
        };
        match (self.motion, self.start) {
            (BedMotion::AtRest, _) => layer.and("grains", "at-rest"),
            (BedMotion::Frozen, _) => layer.and("grains", "frozen").and("cell_height", self.cell_height()),
            _ if self.closure_draws > 0 => layer.and("closures", "drawn"),
            (_, LayerStart::Rest) => layer.and("start", "rest"),
            (_, LayerStart::Moving { .. }) => layer.and("start", "fast"),
            (_, LayerStart::Both) if self.is_suspended() => layer.and("grains", "suspended"),
            (_, LayerStart::Both) => self.with_changes(layer),
        }
    }

    fn cost(&self) -> RunCost {
        let stream = self.stream();
        let cells = (stream.flow_depth + stream.bed_depth) / self.cell_height();
        let layers = match self.start {
            // both starts, and one of half the rate
            _ if self.seeks_onset() => 3.0 * SCANNED.len() as f64,
            LayerStart::Both => 2.0,
            _ => 1.0 + 2.0 * self.closure_draws as f64,
        };
        RunCost { seconds_per_particle_step: 0.5e-6, ..RunCost::weakly_compressible(cells, layers * USUAL_STEPS) }
    }

    fn simulate(&self, progress: &Progress) -> Result<Recorded<BedLoadLayerObservation>, ParameterError> {
        solve(self, progress)
    }
}

/// Seeks the steady state of a layer.
fn solve(flow: &BedLoad1dFlow, progress: &Progress) -> Result<Recorded<BedLoadLayerObservation>, ParameterError> {
    if progress.conditions.is_some() {
        return Err(ParameterError::Interrupted);
    }
    let started = Instant::now();
    let start = match flow.start {
        LayerStart::Moving { speed } => InitialVelocity::Moving(speed),
        LayerStart::Rest | LayerStart::Both => InitialVelocity::Rest,
    };
    let layer = flow.layer().map_err(refused)?;
    let approach = approach(&layer, start)?;
    let fast = (flow.start == LayerStart::Both).then(|| self::approach(&layer, layer.fast_start())).transpose()?;
    let mut done = Done::of(&approach, fast.as_ref());
    let (mut scan, mut scan_at_half_rate) = (Vec::new(), Vec::new());
    if flow.seeks_onset() {
        scan = self::scan(&layer, &approach, &mut done)?;
        scan_at_half_rate = self::scan_at_half_rate(&layer, &scan, &mut done)?;
    }
    if is_interrupted() {
        return Err(ParameterError::Interrupted);
    }
    let simulated_time = approach.steps as f64 * approach.time_step;
    let cells = approach.state.height.len();
    progress.advance(simulated_time, simulated_time, (cells * done.steps) as f64);
    let outcome = match done.unsteady {
        None if done.difference > SAME_STATE => Outcome::Stopped {
            criterion: format!("two steady states, from rest and from a fast start, differ by {:.1e}", done.difference),
        },
        None => {
            Outcome::Stopped { criterion: format!("a step changes u/u_* and φ by less than {:e}", flow.steady_change) }
        }
        Some(reason) => Outcome::Diverged {
            message: format!("no steady state after {} steps: {reason}", done.steps),
            expected: false,
        },
    };
    let second = fast.filter(|_| done.difference > SAME_STATE).map(|fast| fast.state);
    Ok(Recorded {
        outcome,
        state_hash: state_hash(&approach.state.to_bytes()),
        particles: cells,
        steps: done.steps as u64,
        simulated_time,
        wall_seconds: started.elapsed().as_secs_f64(),
        threads: 1,
        frames: Vec::new(),
        first_bad: None,
        data: BedLoadLayerObservation {
            start_difference: done.difference,
            second,
            scan,
            scan_at_half_rate,
            draws: Draws::of(flow)?,
            state: approach.state,
        },
    })
}

/// What several layers of one run have come to.
struct Done {
    steps: usize,
    difference: f64,
    unsteady: Option<String>,
}

impl Done {
    fn of(slow: &Approach, fast: Option<&Approach>) -> Self {
        Self {
            steps: slow.steps + fast.map_or(0, |fast| fast.steps),
            difference: fast.map_or(0.0, |fast| slow.state.start_difference(&fast.state)),
            unsteady: slow.unsteady.clone().or_else(|| fast.and_then(|fast| fast.unsteady.clone())),
        }
    }

    fn add(&mut self, other: Self) {
        self.steps += other.steps;
        self.difference = self.difference.max(other.difference);
        self.unsteady = self.unsteady.take().or(other.unsteady);
    }
}

/// The steps of a layer from a start to its steady state.
fn approach(layer: &BedLoadLayer, start: InitialVelocity) -> Result<Approach, ParameterError> {
    layer.approach_unless(start, &is_interrupted).map_err(refused)
}

/// Shields numbers and transports about the onset, from both starts; that of the run itself is known. It begins below every
/// criterion, or at [`LOWEST_SCANNED`].
fn scan(layer: &BedLoadLayer, own: &Approach, done: &mut Done) -> Result<Vec<(f64, f64)>, ParameterError> {
    let mut scan = Vec::new();
    for factor in SCANNED {
        let scaled = scaled(layer, factor);
        if scaled == *layer {
            scan.push((layer.stream.shields_number(), own.state.transport()));
        } else {
            scan.push(scanned(&scaled, done)?);
        }
    }
    let mut factor = NEXT_BELOW * SCANNED[0];
    while moves_by_some_criterion(scan[0]) && factor >= LOWEST_SCANNED {
        scan.insert(0, scanned(&scaled(layer, factor), done)?);
        factor *= NEXT_BELOW;
    }
    Ok(scan)
}

/// The transports of a scan's Shields numbers with half the rate of the regularisation, from rest.
fn scan_at_half_rate(
    layer: &BedLoadLayer,
    scan: &[(f64, f64)],
    done: &mut Done,
) -> Result<Vec<(f64, f64)>, ParameterError> {
    let closures = Closures { regularisation_rate: 0.5 * layer.closures.regularisation_rate, ..layer.closures };
    let own = layer.stream.shields_number();
    let transport = |&(shields_number, _): &(f64, f64)| {
        let slow = approach(&BedLoadLayer { closures, ..scaled(layer, shields_number / own) }, InitialVelocity::Rest)?;
        done.add(Done::of(&slow, None));
        Ok((shields_number, slow.state.transport()))
    };
    scan.iter().map(transport).collect()
}

/// Shields number and transport of a layer, from both starts.
fn scanned(layer: &BedLoadLayer, done: &mut Done) -> Result<(f64, f64), ParameterError> {
    let slow = approach(layer, InitialVelocity::Rest)?;
    done.add(Done::of(&slow, Some(&approach(layer, layer.fast_start())?)));
    Ok((layer.stream.shields_number(), slow.state.transport()))
}

/// What the solver refuses although each parameter is in its range.
fn refused(error: LayerError) -> ParameterError {
    match error {
        LayerError::Parameter { field, value, rule } => {
            ParameterError::field(field, value, rule, "`bagnold show bed-load-1d` prints a valid value")
        }
        other => ParameterError::field("closures", other, "", "change them"),
    }
}

/// A layer with a multiple of the Shields number, from which the slope follows.
fn scaled(layer: &BedLoadLayer, factor: f64) -> BedLoadLayer {
    let stream = Stream { slope: factor * layer.stream.slope, ..layer.stream };
    BedLoadLayer { stream, ..layer.clone() }
}
