//! What a run leaves behind.

use super::runs::BedLoadRun;
use crate::cases::channel::{BlockProfile, Channel, ChannelObservation};
use crate::reference::bed_load_layer::LayerState;
use bagnold_solver::incompressible::IncompressibleSimulation;
use bagnold_solver::vector::Vector;
use serde::{Deserialize, Serialize};

/// Water and grains of one run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BedLoadObservation {
    /// The water.
    pub channel: ChannelObservation,
    /// q* at every sample `[-]`, and the mean velocity of the water above z = 0 `[m/s]`.
    pub transport: Vec<f64>,
    /// Mean velocity of the water above z = 0 at every sample `[m/s]`.
    pub stream_velocity: Vec<f64>,
    /// Velocities of the grains over the window, and volumes of grains in a particle `[m²]` in the place of pressures.
    pub sediment: BlockProfile,
    /// Forces of the water on the grains over the window `[N/m]`, in the place of velocities.
    pub drag: BlockProfile,
    /// Length of the period `[m]`.
    pub length: f64,
    /// The 1-D layer of a `continuum` run.
    pub layer: Option<LayerState>,
}

/// Watches the grains at every sample.
pub(super) struct Observer {
    unit: f64,
    length: f64,
    grain_density: f64,
    /// Heights between which grains belong `[m]`.
    inside: (f64, f64),
    window_start: Option<f64>,
    window: f64,
    /// Grains outside at the last sample.
    grains_lost: usize,
    observation: BedLoadObservation,
}

impl Observer {
    pub(super) fn new(run: &BedLoadRun, channel: &Channel<'_>) -> Self {
        let spacing = channel.sediment.as_ref().map_or(channel.fluid.spacing, |sediment| sediment.spacing);
        let bin = spacing.min(0.5 * run.materials.grain_diameter);
        let stream = run.stream();
        let bins = ((stream.bed_depth + stream.flow_depth) / bin).ceil() as usize;
        let profile = BlockProfile::new(-stream.bed_depth, bin, bins);
        Self {
            unit: stream.transport_unit(),
            length: channel.fluid.length(),
            grain_density: run.materials.grain_density,
            inside: (-stream.bed_depth, stream.flow_depth + stream.bed_depth),
            window_start: None,
            window: run.averaging_time,
            grains_lost: 0,
            observation: BedLoadObservation {
                channel: ChannelObservation {
                    series: Default::default(),
                    window: (0.0, 0.0),
                    profile: BlockProfile::default(),
                    momentum: Default::default(),
                    marks: Vec::new(),
                    stationary_since: None,
                    particles_lost: 0,
                },
                transport: Vec::new(),
                stream_velocity: Vec::new(),
                sediment: profile.clone(),
                drag: profile,
                length: channel.fluid.length(),
                layer: None,
            },
        }
    }

    pub(super) fn observe(&mut self, simulation: &IncompressibleSimulation<2>, in_window: bool) {
        let (position, velocity) = simulation.sediment();
        let masses = simulation.sediment_masses();
        let flux = velocity.iter().zip(masses).fold(0.0, |sum, (v, mass)| sum + v[0] * mass);
        let (lowest, highest) = self.inside;
        let is_inside = |x: &&Vector<2>| x[1] > lowest && x[1] < highest;
        self.grains_lost = position.len() - position.iter().filter(is_inside).count();
        let data = &mut self.observation;
        data.transport.push(flux / self.grain_density / self.length / self.unit);
        let (sum, count) = simulation
            .fluid()
            .0
            .iter()
            .zip(simulation.fluid().1)
            .filter(|(x, _)| x[1] > 0.0)
            .fold((0.0, 0.0), |(sum, count), (_, u)| (sum + u[0], count + 1.0));
        data.stream_velocity.push(sum / count);
        if in_window && !position.is_empty() {
            let start = *self.window_start.get_or_insert(simulation.time());
            let share = (simulation.time() - start) / self.window;
            let none = vec![0.0; position.len()];
            let volumes: Vec<f64> = masses.iter().map(|mass| mass / self.grain_density).collect();
            data.sediment.observe(share, position, velocity, &volumes);
            let drag: Vec<Vector<2>> = simulation.drag();
            data.drag.observe(share, position, &drag, &none);
        }
    }

    pub(super) fn finish(self, mut channel: ChannelObservation, layer: Option<&LayerState>) -> BedLoadObservation {
        channel.particles_lost += self.grains_lost;
        BedLoadObservation { channel, layer: layer.cloned(), ..self.observation }
    }
}

impl BedLoadObservation {
    /// q* within the averaging window `[-]`.
    #[must_use]
    pub fn transport_in_window(&self) -> Vec<f64> {
        self.channel.series.within(&self.transport, self.channel.window)
    }

    /// Drag per volume over height: (z `[m]`, `[N/m³]`).
    #[must_use]
    pub fn drag_profile(&self) -> Vec<(f64, f64)> {
        let times = self.drag.times as f64;
        let volume = self.drag.bin * self.length;
        let points = self.drag.points();
        points.iter().map(|point| (point.height, point.velocity * point.samples / (times * volume))).collect()
    }

    /// Solid fraction over height: (z `[m]`, φ `[-]`).
    #[must_use]
    pub fn solid_fraction(&self) -> Vec<(f64, f64)> {
        let times = self.sediment.times as f64;
        let volume = self.sediment.bin * self.length;
        let points = self.sediment.points();
        points.iter().map(|point| (point.height, point.pressure * point.samples / (times * volume))).collect()
    }
}
