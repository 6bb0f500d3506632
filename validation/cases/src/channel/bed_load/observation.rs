//! What a run leaves behind.

use super::flow::BedLoadFlow;
use crate::channel::{BlockProfile, Channel, ChannelObservation, ProfilePoint};
use crate::reference::one_dimension::bed_load::LayerState;
use crate::statistics::{BLOCKS, FittedValue};
use bagnold_solver::incompressible::IncompressibleSimulation;
use bagnold_solver::vector::Vector;
use serde::{Deserialize, Serialize};

/// Water and grains of one run.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct BedLoadObservation {
    /// Observation of the water.
    pub channel: ChannelObservation,
    /// q* at every sample `[-]`.
    pub transport: Vec<f64>,
    /// Mean velocity of the water above z = 0 at every sample `[m/s]`.
    pub stream_velocity: Vec<f64>,
    /// Velocities of the grains over the window; without pressures, which are all 0.
    pub sediment: BlockProfile,
    /// What the particles of the same bins and blocks of time carry, shape `[bins][blocks of time]`.
    pub carried: Vec<Vec<Carried>>,
    /// Length of the period `[m]`.
    pub length: f64,
    /// The 1-D layer of a `continuum` run.
    pub layer: Option<LayerState>,
}

/// Sums over the samples (particles × times) of one bin in one block of time.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Carried {
    /// Volumes of the grains in the particles `[m²]`.
    pub volume: f64,
    /// Forces of the water on the grains along the bed `[N/m]`.
    pub force: f64,
}

/// Watches the grains at every sample.
#[derive(Serialize, Deserialize)]
pub(super) struct BedLoadObserver {
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

impl BedLoadObserver {
    pub(super) fn new(run: &BedLoadFlow, channel: &Channel<'_>) -> Self {
        let spacing = channel.sediment.as_ref().map_or(channel.fluid.spacing, |sediment| sediment.spacing);
        let stream = run.stream();
        // a row of grains lies in the middle of its bin
        let bins = ((stream.bed_depth + stream.flow_depth) / spacing).ceil() as usize;
        let profile = BlockProfile::new(-stream.bed_depth, spacing, bins);
        Self {
            unit: stream.transport_unit(),
            length: channel.fluid.length(),
            grain_density: run.grain_density,
            inside: (-stream.bed_depth, stream.flow_depth + stream.bed_depth),
            window_start: None,
            window: run.averaging_time,
            grains_lost: 0,
            observation: BedLoadObservation {
                carried: vec![vec![Carried::default(); BLOCKS]; bins],
                sediment: profile,
                length: channel.fluid.length(),
                ..BedLoadObservation::default()
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
            data.sediment.observe(share, position, velocity, &none);
            let block = BlockProfile::block(share);
            for ((x, mass), force) in position.iter().zip(masses).zip(simulation.drag()) {
                if let Some(bin) = data.sediment.bin_at(x[1]) {
                    let carried = &mut data.carried[bin][block];
                    carried.volume += mass / self.grain_density;
                    carried.force += force[0];
                }
            }
        }
    }

    pub(super) fn finish(self, mut channel: ChannelObservation, layer: Option<&LayerState>) -> BedLoadObservation {
        channel.particles_lost += self.grains_lost;
        BedLoadObservation { channel, layer: layer.cloned(), ..self.observation }
    }
}

impl BedLoadObservation {
    /// Mean of q* over the averaging window, with its statistical error `[-]`.
    pub(super) fn mean_transport(&self) -> FittedValue {
        self.channel.average(&self.transport)
    }

    /// Drag per volume over height: (z `[m]`, `[N/m³]`).
    pub fn drag_profile(&self) -> Vec<(f64, f64)> {
        self.per_volume(|carried| carried.force)
    }

    /// Solid fraction over height: (z `[m]`, φ `[-]`).
    pub fn solid_fraction(&self) -> Vec<(f64, f64)> {
        self.per_volume(|carried| carried.volume)
    }

    /// Mean over time of what the particles of each bin carry, per volume of the bin, over height `[m]`.
    fn per_volume(&self, part: impl Fn(&Carried) -> f64) -> Vec<(f64, f64)> {
        let times = self.sediment.times as f64;
        let volume = self.sediment.bin * self.length;
        let sums = self.carried.iter().map(|blocks| blocks.iter().map(&part).fold(0.0, |sum, value| sum + value));
        let filled =
            self.sediment.sums.iter().zip(sums).filter(|(blocks, _)| blocks.iter().any(|sum| sum.samples > 0.0));
        let points = self.sediment.points();
        let mean = |(point, (_, sum)): (&ProfilePoint, (_, f64))| {
            (point.height, sum / point.samples * point.samples / (times * volume))
        };
        points.iter().zip(filled).map(mean).collect()
    }
}
