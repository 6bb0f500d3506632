//! One run: a layer and what it is computed for.

use super::onset_criterion::moves_by_some_criterion;
use super::replacements::Replaced;
use super::suspension_inputs::{self, SuspendedFlow, SuspensionInput};
use crate::case::{ParameterError, Progress, Run};
use crate::checkpoint::is_interrupted;
use crate::metric::{FlowRegime, Variant};
use crate::observation::{Outcome, Recorded, state_hash};
use crate::reference::bed_load::MeasuredBedLoad;
use crate::reference::one_dimension::LayerError;
use crate::reference::one_dimension::bed_load::{
    Approach, BedLoadLayer, Closures, GrainMotion, InitialVelocity, LayerState, SAME_STATE, SolidFractionProfile,
    Stream,
};
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// Largest difference between the steady states from two starts `[-]`, and why.
pub(super) const ONE_STATE: f64 = 1e-6;
pub(super) const ONE_STATE_REASON: &str = "a steady state does not remember its start: what is left is how near to steady both are, at most 8e-8 of all layers";

/// Half the height over which the given fraction falls from φ_max to 0 in studies of the order, in grain diameters.
const TRANSITION: f64 = 1.2;

/// Steps that a layer takes, for estimates.
const USUAL_STEPS: f64 = 350.0;

/// Shields numbers at which a layer is computed, over that of the curve `[-]`.
pub(super) const SCANNED: [f64; 6] = [0.55, 0.75, 1.0, 1.3, 1.7, 2.3];
/// Where the least of them still carries more than a criterion asks for, the scan goes on below by this factor, as from 0.75 to 0.55.
const NEXT_BELOW: f64 = 0.75;
/// But not below this: nobody has measured an onset at a tenth of the curve.
const LOWEST_SCANNED: f64 = 0.1;

/// What a layer is computed for.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LayerPurpose {
    /// The layer with the case's closures, from rest.
    Literature,
    /// The same from a fast start at this speed `[m/s]`.
    FastStart(f64),
    /// The water over the bed at rest that the moving bed is compared with.
    BedAtRest,
    /// The order of convergence with dilation.
    DilatingOrder,
    /// The order of convergence with a given fraction.
    FrozenOrder,
    /// A replaced closure.
    Sensitivity(Replaced),
    /// A layer whose lengths are counted in grains.
    Similar,
    /// Layers about the onset of motion.
    Onset,
    /// A layer that others have simulated or measured.
    Measured(MeasuredBedLoad),
    /// A layer whose grains eddies also carry.
    Suspended(SuspendedFlow, SuspensionInput),
}

impl LayerPurpose {
    /// What the grains do, in a variant.
    pub(super) fn grains(self) -> &'static str {
        if self == Self::FrozenOrder { "frozen" } else { "dilating" }
    }
}

/// One layer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BedLoad1dRun {
    /// What for.
    pub purpose: LayerPurpose,
    /// The stream.
    pub stream: Stream,
    /// Closures.
    pub closures: Closures,
    /// Height of a cell `[m]`.
    pub cell_height: f64,
    /// Change of a step below which it counts as steady `[-]`.
    pub steady_change: f64,
}

/// What a run leaves behind.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BedLoadLayerObservation {
    /// The profiles.
    pub state: LayerState,
    /// Largest change of a velocity in the last step, over u_* `[-]`.
    pub velocity_change: f64,
    /// Largest change of φ in the last step `[-]`.
    pub fraction_change: f64,
    /// Difference between the states from rest and from a fast start, where the run has both `[-]`; else 0.
    pub start_difference: f64,
    /// The state from the fast start, if the run has both and they are two.
    pub second: Option<LayerState>,
    /// Shields numbers and transports of an onset `[-]`.
    pub scan: Vec<(f64, f64)>,
    /// The same with half the rate of the regularisation: what differs is the creep of a bed that should rest.
    pub scan_at_half_rate: Vec<(f64, f64)>,
}

impl Run for BedLoad1dRun {
    type Observation = BedLoadLayerObservation;

    fn regime(&self, _: &BedLoadLayerObservation) -> FlowRegime {
        let stream = &self.stream;
        let regime = FlowRegime::of_stream(stream.slope, stream.flow_depth, stream.grain_diameter);
        // at the onset many streams stand for one
        if self.purpose == LayerPurpose::Onset { FlowRegime { slope_angle: None, ..regime } } else { regime }
    }

    fn variant(&self) -> Variant {
        let slope = Variant::of("slope", self.stream.slope);
        match self.purpose {
            LayerPurpose::Literature => slope.and("start", "rest"),
            LayerPurpose::FastStart(_) => slope.and("start", "fast"),
            LayerPurpose::BedAtRest => slope.and("grains", "at-rest"),
            LayerPurpose::DilatingOrder | LayerPurpose::FrozenOrder => {
                slope.and("grains", self.purpose.grains()).and("cell_height", self.cell_height)
            }
            LayerPurpose::Sensitivity(replaced) => slope.and(replaced.closure(), replaced.value_text()),
            // a sweep's points differ in its parameters only
            LayerPurpose::Similar => Variant::of("layer", "similar"),
            LayerPurpose::Onset => Variant::of("diameter", self.stream.grain_diameter),
            LayerPurpose::Measured(of) => {
                let schmidt = self.closures.turbulent_schmidt;
                Variant::of("layer", of.name()).and("turbulent_schmidt", schmidt)
            }
            LayerPurpose::Suspended(flow, input) => suspension_inputs::variant(flow, input, &self.stream),
        }
    }

    fn particles(&self) -> f64 {
        (self.stream.flow_depth + self.stream.bed_depth) / self.cell_height
    }

    fn seconds_per_particle_step(&self) -> f64 {
        0.5e-6
    }

    fn particle_steps(&self) -> f64 {
        let layers = match self.purpose {
            // both starts, and one of half the rate
            LayerPurpose::Onset => 3.0 * SCANNED.len() as f64,
            _ if self.has_both_starts() => 2.0,
            _ => 1.0,
        };
        layers * USUAL_STEPS * (self.stream.flow_depth + self.stream.bed_depth) / self.cell_height
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<BedLoadLayerObservation>, ParameterError> {
        if progress.conditions().is_some() {
            return Err(ParameterError::Interrupted);
        }
        let started = Instant::now();
        let start = match self.purpose {
            LayerPurpose::FastStart(speed) => InitialVelocity::Moving(speed),
            _ => InitialVelocity::Rest,
        };
        let layer = self.layer().map_err(refused)?;
        let approach = approach(&layer, start)?;
        let fast = self.has_both_starts().then(|| self::approach(&layer, layer.fast_start())).transpose()?;
        let mut done = Done::of(&approach, fast.as_ref());
        let (mut scan, mut scan_at_half_rate) = (Vec::new(), Vec::new());
        if self.purpose == LayerPurpose::Onset {
            scan = self.scan(&approach, &mut done)?;
            scan_at_half_rate = self.scan_at_half_rate(&scan, &mut done)?;
        }
        if is_interrupted() {
            return Err(ParameterError::Interrupted);
        }
        let simulated_time = approach.steps as f64 * approach.time_step;
        let cells = approach.state.height.len();
        progress.advance(simulated_time, simulated_time, (cells * done.steps) as f64);
        let outcome = match done.unsteady {
            None if done.difference > SAME_STATE => Outcome::Stopped {
                criterion: format!(
                    "two steady states, from rest and from a fast start, differ by {:.1e}",
                    done.difference
                ),
            },
            None => Outcome::Stopped {
                criterion: format!("a step changes u/u_* and φ by less than {:e}", self.steady_change),
            },
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
                velocity_change: approach.velocity_change,
                fraction_change: approach.fraction_change,
                start_difference: done.difference,
                second,
                scan,
                scan_at_half_rate,
                state: approach.state,
            },
        })
    }
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

impl BedLoad1dRun {
    /// Whether the run itself seeks its state from two starts; those of a slope and of an order are runs of their own.
    fn has_both_starts(&self) -> bool {
        matches!(
            self.purpose,
            LayerPurpose::BedAtRest
                | LayerPurpose::Sensitivity(_)
                | LayerPurpose::Similar
                | LayerPurpose::Onset
                | LayerPurpose::Measured(_)
                | LayerPurpose::Suspended(_, SuspensionInput::Own)
        )
    }

    /// Shields numbers and transports about the onset, from both starts; that of the run itself is known. It begins below every
    /// criterion, or at [`LOWEST_SCANNED`].
    fn scan(&self, own: &Approach, done: &mut Done) -> Result<Vec<(f64, f64)>, ParameterError> {
        let mut scan = Vec::new();
        for factor in SCANNED {
            let stream = scaled(&self.stream, factor);
            if stream == self.stream {
                scan.push((stream.shields_number(), own.state.transport()));
            } else {
                scan.push(self.scanned(stream, done)?);
            }
        }
        let mut factor = NEXT_BELOW * SCANNED[0];
        while moves_by_some_criterion(scan[0]) && factor >= LOWEST_SCANNED {
            scan.insert(0, self.scanned(scaled(&self.stream, factor), done)?);
            factor *= NEXT_BELOW;
        }
        Ok(scan)
    }

    /// The transports of a scan's Shields numbers with half the rate of the regularisation, from rest.
    fn scan_at_half_rate(&self, scan: &[(f64, f64)], done: &mut Done) -> Result<Vec<(f64, f64)>, ParameterError> {
        let closures = Closures { regularisation_rate: 0.5 * self.closures.regularisation_rate, ..self.closures };
        let own = self.stream.shields_number();
        let transport = |&(shields_number, _): &(f64, f64)| {
            let stream = scaled(&self.stream, shields_number / own);
            let layer = BedLoadLayer { stream, closures, ..self.layer().map_err(refused)? };
            let slow = approach(&layer, InitialVelocity::Rest)?;
            done.add(Done::of(&slow, None));
            Ok((shields_number, slow.state.transport()))
        };
        scan.iter().map(transport).collect()
    }

    /// Shields number and transport of a stream, from both starts.
    fn scanned(&self, stream: Stream, done: &mut Done) -> Result<(f64, f64), ParameterError> {
        let layer = BedLoadLayer { stream, ..self.layer().map_err(refused)? };
        let slow = approach(&layer, InitialVelocity::Rest)?;
        done.add(Done::of(&slow, Some(&approach(&layer, layer.fast_start())?)));
        Ok((stream.shields_number(), slow.state.transport()))
    }

    /// The layer.
    fn layer(&self) -> Result<BedLoadLayer, LayerError> {
        let grains = match self.purpose {
            LayerPurpose::FrozenOrder => GrainMotion::Frozen(smooth_bed(&self.stream, self.closures.largest_fraction)?),
            LayerPurpose::BedAtRest => {
                GrainMotion::Resting(SolidFractionProfile::flat_bed(self.closures.largest_fraction)?)
            }
            _ => GrainMotion::Dilating,
        };
        let Self { stream, closures, cell_height, steady_change, .. } = *self;
        Ok(BedLoadLayer { stream, closures, grains, cell_height, steady_change })
    }
}

/// A bed whose fraction falls smoothly (with two continuous derivatives) across z = 0.
fn smooth_bed(stream: &Stream, largest_fraction: f64) -> Result<SolidFractionProfile, LayerError> {
    let half = TRANSITION * stream.grain_diameter;
    SolidFractionProfile::sampled(-half, half, 4096, |z| {
        let x = (0.5 * (z / half + 1.0)).clamp(0.0, 1.0);
        largest_fraction * (1.0 - x * x * x * (10.0 - x * (15.0 - 6.0 * x)))
    })
}

/// Refuses a layer whose bed slides on its base.
pub(super) fn check_sliding(field: &str, value: f64, run: &BedLoad1dRun) -> Result<(), ParameterError> {
    match run.layer().and_then(|layer| layer.check()) {
        Err(LayerError::BedSlides { slope, limit, remedy }) => {
            let rule = format!("for a slope below {limit:.5}, where the bed slides (here {slope:.5})");
            Err(ParameterError::field(field, value, &rule, &remedy))
        }
        _ => Ok(()),
    }
}

/// What the solver refuses although each parameter is in its range.
fn refused(error: LayerError) -> ParameterError {
    match error {
        LayerError::Parameter { field, value, rule } => {
            ParameterError::field(field, value, rule, "`bagnold show bed-load-1d` prints a valid value")
        }
        other => ParameterError::field(
            "closures",
            "given",
            &format!("such that a layer can be computed ({other})"),
            "change them",
        ),
    }
}

/// A stream with so many times the Shields number: the slope follows.
fn scaled(stream: &Stream, factor: f64) -> Stream {
    Stream { slope: factor * stream.slope, ..*stream }
}
