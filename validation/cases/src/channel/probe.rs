//! What a channel leaves behind: time series, and over the averaging window a profile and the balance of momentum.

use super::stationarity::Stationarity;
use super::{AveragingWindowEnd, Channel};
use crate::statistics::BlockProfile;
use bagnold_solver::incompressible::IncompressibleSimulation;
use bagnold_solver::vector::Vector;
use serde::{Deserialize, Serialize};

/// Bins above the nominal surface.
const SPARE_BINS: usize = 2;

/// The fluid over time; every array has the shape `[samples]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ChannelSeries {
    /// Time `[s]`.
    pub time: Vec<f64>,
    /// Depth mean U of the velocity along the floor `[m/s]`.
    pub mean_velocity: Vec<f64>,
    /// Twice the mean height above the floor over the nominal depth `[-]`.
    pub relative_height: Vec<f64>,
    /// Height of the highest particle above the floor over the nominal depth `[-]`.
    pub highest: Vec<f64>,
    /// Root mean square of the velocity across the floor `[m/s]`.
    pub rms_vertical_velocity: Vec<f64>,
    /// Friction on walls and fixed grains per area of the floor, the mean since the sample before `[Pa]`.
    pub bed_shear: Vec<f64>,
    /// Root mean square of p − ρ g (h − z) over that of ρ g (h − z), over the particles `[-]`.
    pub pressure_error: Vec<f64>,
}

impl ChannelSeries {
    /// Points of a curve over time: (t `[s]`, value over `scale`).
    pub fn curve(&self, array: &[f64], scale: f64) -> Vec<(f64, f64)> {
        self.time.iter().copied().zip(array.iter().map(|value| value / scale)).collect()
    }

    /// The samples of an array at times in a window `[s]`.
    pub fn within(&self, array: &[f64], window: (f64, f64)) -> Vec<f64> {
        let samples = self.time.iter().zip(array);
        samples.filter(|(time, _)| **time >= window.0 && **time <= window.1).map(|(_, value)| *value).collect()
    }
}

/// Momentum along the floor over the averaging window, of all phases, per metre of width.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct MomentumBalance {
    /// Momentum at the beginning of the window `[kg/s]`.
    pub before: f64,
    /// Momentum at the end of the window `[kg/s]`.
    pub after: f64,
    /// Impulse of the body force `[kg/s]`.
    pub driven: f64,
    /// Impulse of walls and fixed grains `[kg/s]`, negative where they hold the flow back.
    pub held: f64,
}

impl MomentumBalance {
    /// Momentum without a known cause, over the impulse of the body force `[-]`.
    pub fn residual(&self) -> f64 {
        (self.after - self.before - self.driven - self.held) / self.driven
    }
}

/// All that a channel's run leaves behind.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct ChannelObservation {
    /// The whole run, from the first sample after the start.
    pub series: ChannelSeries,
    /// First and last time of the averaging window `[s]`; empty where the run did not get there.
    pub window: (f64, f64),
    /// The fluid over the window.
    pub profile: BlockProfile,
    /// Momentum over the window.
    pub momentum: MomentumBalance,
    /// Time at which the criterion was met `[s]`.
    pub stationary_since: Option<f64>,
    /// Particles that ended outside: of the fluid, those below the floor or above twice the depth.
    pub particles_lost: usize,
    /// Iterations a step of the implicit velocities and of the pressure; none for another program.
    pub iterations: [Option<f64>; 2],
    /// Largest amplitude of the longest wave along the period in the velocity along the floor, over its depth mean `[-]`.
    pub longest_wave: f64,
}

/// Collects observations during a run; sees every step.
#[derive(Debug, Serialize, Deserialize)]
pub(super) struct ChannelProbe {
    floor: f64,
    depth: f64,
    length: f64,
    weight: f64,
    /// End of the run, which a longer one moves.
    pub(super) until: AveragingWindowEnd,
    window_length: f64,
    interval: f64,
    /// Samples that were due.
    due: u64,
    last_time: f64,
    /// Impulses along the floor since the start and until the last sample `[kg/s]`.
    driven: f64,
    held: f64,
    held_at_sample: f64,
    time_at_sample: f64,
    window_start: Option<f64>,
    stationarity: Stationarity,
    observation: ChannelObservation,
}

impl ChannelProbe {
    pub(super) fn new(channel: &Channel<'_>) -> Self {
        let fluid = &channel.fluid;
        Self {
            floor: fluid.bottom,
            depth: fluid.height(),
            length: fluid.length(),
            weight: channel.density * channel.gravity,
            until: channel.until,
            window_length: channel.window,
            interval: channel.interval,
            due: 0,
            last_time: 0.0,
            driven: 0.0,
            held: 0.0,
            held_at_sample: 0.0,
            time_at_sample: 0.0,
            window_start: None,
            stationarity: Stationarity::new(channel.until, channel.gravity * channel.slope),
            observation: ChannelObservation {
                profile: BlockProfile::new(fluid.bottom, fluid.spacing, fluid.rows + SPARE_BINS),
                ..ChannelObservation::default()
            },
        }
    }

    /// Whether the latest sample lies in the averaging window.
    pub(super) fn in_window(&self) -> bool {
        self.window_start.is_some()
    }

    /// Whether the averaging window is over.
    pub(super) fn is_done(&self) -> bool {
        self.window_start.is_some_and(|start| self.last_time >= start + self.window_length)
    }

    /// Whether the criterion has been met.
    pub(super) fn is_stationary(&self) -> bool {
        self.stationarity.reached.is_some()
    }

    /// Observes a step; true where it was a sample.
    pub(super) fn observe(&mut self, simulation: &IncompressibleSimulation<2>) -> bool {
        let time = simulation.time();
        if simulation.steps() == 0 {
            return false;
        }
        let step = time - self.last_time;
        self.last_time = time;
        self.held += simulation.holding_force()[0] * step;
        self.driven += body_force(simulation) * step;
        let due = (time / self.interval + 1e-9).floor() as u64;
        if due <= self.due {
            return false;
        }
        self.due = due;
        self.sample(simulation);
        true
    }

    fn sample(&mut self, simulation: &IncompressibleSimulation<2>) {
        let time = simulation.time();
        let (position, velocity) = simulation.fluid();
        let pressure = simulation.fluid_pressure();
        let n = position.len() as f64;
        let top = self.floor + self.depth;
        let (mut along, mut across, mut height, mut highest) = (0.0, 0.0, 0.0, f64::NEG_INFINITY);
        let (mut error, mut scale) = (0.0, 0.0);
        for ((x, v), p) in position.iter().zip(velocity).zip(pressure) {
            along += v[0];
            across += v[1] * v[1];
            height += x[1] - self.floor;
            highest = x[1].max(highest);
            let exact = self.weight * (top - x[1]);
            error += (p - exact) * (p - exact);
            scale += exact * exact;
        }
        let mean_velocity = along / n;
        let wave = position.iter().zip(velocity).fold(Vector::<2>::zeros(), |sum, (x, v)| {
            let (sine, cosine) = libm::sincos(std::f64::consts::TAU * x[0] / self.length);
            sum + Vector::<2>::new(cosine, sine) * v[0]
        });
        self.observation.longest_wave = self.observation.longest_wave.max(2.0 * wave.norm() / along.abs());
        let (cost, steps) = (simulation.cost(), simulation.steps() as f64);
        self.observation.iterations =
            [cost.velocity_iterations, cost.fluid_pressure_iterations].map(|all| Some(all as f64 / steps));
        let series = &mut self.observation.series;
        series.time.push(time);
        series.mean_velocity.push(mean_velocity);
        series.relative_height.push(2.0 * height / n / self.depth);
        series.highest.push((highest - self.floor) / self.depth);
        series.rms_vertical_velocity.push((across / n).sqrt());
        series.bed_shear.push((self.held_at_sample - self.held) / (time - self.time_at_sample) / self.length);
        series.pressure_error.push((error / scale).sqrt());
        (self.held_at_sample, self.time_at_sample) = (self.held, time);
        let inside = |x: &&Vector<2>| x[1] > self.floor && x[1] < self.floor + 2.0 * self.depth;
        self.observation.particles_lost = position.len() - position.iter().filter(inside).count();

        self.stationarity.observe(time, mean_velocity);
        self.open_window(simulation);
        if let Some(start) = self.window_start {
            let share = (time - start) / self.window_length;
            self.observation.profile.observe(share, position, velocity, pressure);
            self.observation.window.1 = time;
            let balance = &mut self.observation.momentum;
            balance.after = momentum(simulation);
            (balance.driven, balance.held) = (self.driven, self.held);
        }
    }

    /// Begins the averaging window where it is time for it.
    fn open_window(&mut self, simulation: &IncompressibleSimulation<2>) {
        let time = simulation.time();
        let is_time = match self.until {
            AveragingWindowEnd::Time(end) => time >= end - self.window_length - 0.5 * self.interval,
            AveragingWindowEnd::Stationary { at_most, .. } => self.stationarity.reached.is_some() || time >= at_most,
        };
        if is_time && self.window_start.is_none() {
            self.window_start = Some(time);
            self.observation.window = (time, time);
            self.observation.momentum.before = momentum(simulation);
            // impulses count from here
            (self.driven, self.held_at_sample, self.held) = (0.0, 0.0, 0.0);
        }
    }

    pub(super) fn finish(mut self) -> ChannelObservation {
        self.observation.stationary_since = self.stationarity.reached;
        self.observation
    }
}

/// Momentum of all phases along the floor, per metre of width `[kg/s]`: every particle with its own mass, of which a
/// fluid's counts as far as grains leave it room.
fn momentum(simulation: &IncompressibleSimulation<2>) -> f64 {
    let of_fluid = fluid_masses(simulation).zip(simulation.fluid().1);
    let of_sediment = simulation.sediment_masses().iter().copied().zip(simulation.sediment().1);
    of_fluid.chain(of_sediment).fold(0.0, |sum, (mass, velocity)| sum + mass * velocity[0])
}

/// Body force on all phases along the floor, per metre of width `[N/m]`.
fn body_force(simulation: &IncompressibleSimulation<2>) -> f64 {
    let scene = simulation.scene();
    let fluid = fluid_masses(simulation).fold(0.0, |sum, mass| sum + mass);
    let sediment = simulation.sediment_masses().iter().fold(0.0, |sum, mass| sum + mass);
    let of_sediment = scene.sediment.as_ref().map_or(0.0, |material| sediment * material.gravity[0]);
    fluid * scene.fluid.gravity[0] + of_sediment
}

/// Masses of the fluid's particles as their momentum equation has them `[kg]`.
fn fluid_masses(simulation: &IncompressibleSimulation<2>) -> impl Iterator<Item = f64> + '_ {
    simulation.fluid_masses().iter().zip(simulation.voidage()).map(|(mass, voidage)| mass * voidage)
}
