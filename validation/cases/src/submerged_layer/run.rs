//! One run: a layer over time.

use crate::case::{ParameterError, Progress, Run};
use crate::checkpoint::is_interrupted;
use crate::metric::{FlowRegime, Variant};
use crate::observation::{Outcome, Recorded, state_hash};
use crate::reference::one_dimension::LayerError;
use crate::reference::one_dimension::submerged::{SubmergedColumn, SubmergedLayer, SubmergedProfile};
use crate::reference::submerged::TimeCurve;
use serde::{Deserialize, Serialize};
use std::time::Instant;

/// Number of equal intervals at whose ends a run is observed.
const INTERVALS: u32 = 520;

/// Times between the first of these that are observed as well `[s]`.
const EARLY: [f64; 2] = [0.2, 0.5];

/// Time of the profiles `[s]`.
pub(super) const PROFILE_TIME: f64 = 100.0;

/// Initial excess pore pressure of the consolidation, over the overburden of the highest cell `[-]`: any, as long as grains keep in contact.
const EXCESS: f64 = 0.1;

/// Shear rate that a layer reaches, for estimates `[1/s]`.
const USUAL_SHEAR_RATE: f64 = 0.3;

/// Change of the solid fraction in a run, for estimates `[-]`.
const USUAL_CHANGE: f64 = 0.02;

/// Purpose of a run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LayerPurpose {
    /// Comparison with the experiment.
    Experiment,
    /// Flow until it is steady.
    Steady,
    /// Consolidation of a layer at rest.
    Consolidation,
}

/// A layer over time.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SubmergedLayerRun {
    /// Purpose.
    pub purpose: LayerPurpose,
    /// The layer.
    pub layer: SubmergedLayer,
    /// Solid fraction at the start `[-]`.
    pub solid_fraction: f64,
    /// Simulated time `[s]`.
    pub duration: f64,
}

/// Observation of a run.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct SubmergedLayerObservation {
    /// Steps taken.
    pub steps: usize,
    /// Time since tilting `[s]`.
    pub time: Vec<f64>,
    /// Surface velocity `[m/s]`.
    pub surface_velocity: Vec<f64>,
    /// Excess pore pressure of the lowest cell `[Pa]`.
    pub floor_pressure: Vec<f64>,
    /// Mean solid fraction `[-]`.
    pub mean_fraction: Vec<f64>,
    /// Profiles of the experiment at 100 s and of other runs at their end.
    pub profile: Option<SubmergedProfile>,
    /// Excess pore pressure at the start `[Pa]`.
    pub initial_pressure: f64,
    /// Largest relative change of the volume of grains `[-]`.
    pub mass_error: f64,
    /// Largest imbalance of momentum over the weight on the floor `[-]`.
    pub momentum_error: f64,
    /// Largest imbalance of water over the growth of the pores `[-]`.
    pub water_error: f64,
}

impl SubmergedLayerObservation {
    /// Surface velocity over time `[mm/s]`.
    #[must_use]
    pub fn velocity_curve(&self) -> TimeCurve {
        let velocity = self.surface_velocity.iter().map(|velocity| 1e3 * velocity);
        TimeCurve { points: self.time.iter().copied().zip(velocity).collect() }
    }

    /// Excess pore pressure at the floor over time `[Pa]`.
    #[must_use]
    pub fn pressure_curve(&self) -> TimeCurve {
        TimeCurve { points: self.time.iter().copied().zip(self.floor_pressure.iter().copied()).collect() }
    }

    fn observe(&mut self, column: &SubmergedColumn) {
        self.steps = column.steps();
        self.time.push(column.time());
        self.surface_velocity.push(column.surface_velocity());
        self.floor_pressure.push(column.floor_pressure());
        self.mean_fraction.push(column.mean_fraction());
        self.mass_error = self.mass_error.max(column.mass_error());
        self.momentum_error = self.momentum_error.max(column.momentum_error());
        self.water_error = self.water_error.max(column.water_error());
    }
}

impl Run for SubmergedLayerRun {
    type Observation = SubmergedLayerObservation;

    fn regime(&self, _: &SubmergedLayerObservation) -> FlowRegime {
        let grain_ratio = Some(self.layer.grain_diameter / self.layer.depth);
        FlowRegime { slope_angle: Some(self.layer.slope_angle), grain_ratio, ..FlowRegime::default() }
    }

    fn variant(&self) -> Variant {
        match self.purpose {
            LayerPurpose::Experiment => Variant::of("solid_fraction", self.solid_fraction),
            LayerPurpose::Steady => Variant::of("flow", "steady"),
            LayerPurpose::Consolidation => Variant::of("flow", "consolidation").and("cells", self.layer.cells),
        }
    }

    fn particles(&self) -> f64 {
        self.layer.cells as f64
    }

    fn seconds_per_particle_step(&self) -> f64 {
        0.25e-6
    }

    fn particle_steps(&self) -> f64 {
        let layer = &self.layer;
        let cell = layer.depth / layer.cells as f64;
        let diffusion = layer.fraction_diffusion * layer.grain_diameter * layer.grain_diameter * USUAL_SHEAR_RATE;
        let steps = self.duration * (1.0 / layer.longest_step).max(5.0 * diffusion / (cell * cell));
        self.particles() * (steps + USUAL_CHANGE / layer.largest_fraction_change)
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<SubmergedLayerObservation>, ParameterError> {
        if progress.conditions().is_some() {
            return Err(ParameterError::Interrupted);
        }
        let started = Instant::now();
        let mut data = SubmergedLayerObservation::default();
        let outcome = match self.march(&mut data, progress) {
            Ok(()) => Outcome::Finished,
            Err(error) => Outcome::Diverged { message: error.to_string(), expected: false },
        };
        if is_interrupted() {
            return Err(ParameterError::Interrupted);
        }
        let pressure = data.profile.iter().flat_map(|profile| &profile.pore_pressure);
        let values = data.surface_velocity.iter().chain(&data.floor_pressure).chain(pressure);
        let bytes: Vec<u8> = values.flat_map(|value| value.to_le_bytes()).collect();
        Ok(Recorded {
            outcome,
            state_hash: state_hash(&bytes),
            particles: self.layer.cells,
            steps: data.steps as u64,
            simulated_time: data.time.last().copied().unwrap_or(0.0),
            wall_seconds: started.elapsed().as_secs_f64(),
            threads: 1,
            frames: Vec::new(),
            first_bad: None,
            data,
        })
    }
}

impl SubmergedLayerRun {
    /// Time over h²/c_v `[-]`.
    pub(super) fn time_factor(&self, time: f64) -> f64 {
        let depth = self.layer.depth;
        self.layer.consolidation_coefficient(self.solid_fraction) * time / (depth * depth)
    }

    /// Steps and observes until the end, an error or an interruption.
    fn march(&self, data: &mut SubmergedLayerObservation, progress: &dyn Progress) -> Result<(), LayerError> {
        if self.purpose == LayerPurpose::Consolidation {
            data.initial_pressure =
                EXCESS * self.layer.floor_overburden(self.solid_fraction) / (2.0 * self.particles());
        }
        let mut column = SubmergedColumn::new(&self.layer, self.solid_fraction, data.initial_pressure)?;
        for time in self.times() {
            if is_interrupted() {
                break;
            }
            column.advance_to(time)?;
            data.observe(&column);
            if self.purpose != LayerPurpose::Experiment || time <= PROFILE_TIME {
                data.profile = Some(column.profile());
            }
            progress.advance(time, self.duration, self.particles() * column.steps() as f64);
        }
        Ok(())
    }

    /// Times of observation `[s]`, the last of which is the end; the consolidation is observed at both ends only, for
    /// every time of observation ends a step.
    fn times(&self) -> Vec<f64> {
        if self.purpose == LayerPurpose::Consolidation {
            return vec![0.0, self.duration];
        }
        let interval = self.duration / f64::from(INTERVALS);
        let early = EARLY.into_iter().filter(|time| *time < interval);
        let equal = (1..=INTERVALS).map(|k| f64::from(k) * interval);
        std::iter::once(0.0).chain(early).chain(equal).collect()
    }
}
