//! What a layer leaves behind: time series of depth means, depth profiles averaged over a window, pressure noise.

use super::{BINS, Layer, PeriodicLayer};
use crate::metric::unsteadiness;
use crate::observation::EnergyBook;
use crate::statistics::relative_l2;
use bagnold_solver::weakly_compressible::Snapshot;
use serde::{Deserialize, Serialize};

/// Depth means over time; every array has the shape `[samples]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct TimeSeries {
    /// Time `[s]`.
    pub time: Vec<f64>,
    /// Mass-weighted mean of the velocity along the slope `[m/s]`.
    pub mean_velocity: Vec<f64>,
    /// Root mean square of the speed `[m/s]`.
    pub rms_speed: Vec<f64>,
    /// Twice the mass-weighted mean height over the nominal height `[-]`.
    pub relative_height: Vec<f64>,
    /// Root mean square of p less its local linear fit, over ρ0 g cosθ H `[-]`; empty where not asked for.
    pub pressure_noise: Vec<f64>,
}

impl TimeSeries {
    /// Points of a curve over time, (t `[s]`, value).
    pub fn curve<'a>(&'a self, array: &'a [f64]) -> impl Iterator<Item = (f64, f64)> + 'a {
        self.time.iter().copied().zip(array.iter().copied())
    }
}

/// Depth profile in bins of equal height, averaged over particles and time; every array has the shape `[bins]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct DepthProfile {
    /// Mean height of the samples `[m]`.
    pub height: Vec<f64>,
    /// Velocity along the slope `[m/s]`.
    pub velocity: Vec<f64>,
    /// Pressure `[Pa]`.
    pub pressure: Vec<f64>,
    /// Stress across the slope p − s_yy `[Pa]`.
    pub normal_stress: Vec<f64>,
    /// Shear stress s_xy `[Pa]`.
    pub shear_stress: Vec<f64>,
    /// Samples (particles × times) in the bin.
    pub samples: Vec<f64>,
}

impl DepthProfile {
    /// The bins that hold samples, from below.
    pub fn filled(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.height.len()).filter(|&bin| self.samples[bin] > 0.0)
    }

    /// (value, height over `depth`) of the filled bins, as profiles are drawn.
    pub fn drawn<'a>(&'a self, array: &'a [f64], depth: f64) -> impl Iterator<Item = (f64, f64)> + 'a {
        self.filled().map(move |bin| (array[bin], self.height[bin] / depth))
    }

    /// (bin, du/dy `[1/s]`) by central differences between the filled bins on either side.
    pub fn shear_rates(&self) -> Vec<(usize, f64)> {
        let bins: Vec<usize> = self.filled().collect();
        let rate = |lower: usize, upper: usize| {
            (self.velocity[upper] - self.velocity[lower]) / (self.height[upper] - self.height[lower])
        };
        bins.windows(3).map(|bins| (bins[1], rate(bins[0], bins[2]))).collect()
    }

    /// Relative L2 of the filled bins' velocities against exact ones at their heights `[-]`.
    pub fn velocity_l2(&self, exact: impl Fn(f64) -> f64) -> f64 {
        relative_l2(self.filled().map(|bin| (self.velocity[bin], exact(self.height[bin]))))
    }
}

/// All that a layer's run leaves behind.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct LayerObservation {
    /// Depth means over the whole run.
    pub series: TimeSeries,
    /// Profile over the last window.
    pub profile: DepthProfile,
    /// The energy ledger.
    pub energy: EnergyBook,
    /// Particles that ended outside the layer's neighbourhood: below the bed, or above twice the height.
    pub particles_lost: usize,
}

impl LayerObservation {
    /// Why the profile over the last `window` `[s]` is not that of a steady flow; none where it is.
    pub fn unsteadiness(&self, window: f64) -> Option<String> {
        let mean = self.series.curve(&self.series.mean_velocity);
        unsteadiness("the depth mean of the velocity", mean, window)
    }
}

/// Collects observations during a run.
#[derive(Debug, Serialize, Deserialize)]
pub struct LayerProbe {
    height: f64,
    length: f64,
    reach: f64,
    weight: f64,
    pub(super) window_start: f64,
    noise: bool,
    series: TimeSeries,
    sums: Vec<[f64; 6]>,
    lost: usize,
    energy: EnergyBook,
}

impl LayerProbe {
    pub(super) fn new(layer: &Layer<'_>) -> Self {
        let PeriodicLayer { layer_height, gravity, columns, numerics, .. } = layer.layer;
        let across = gravity * libm::cos(layer.inclination);
        Self {
            height: layer_height,
            length: columns as f64 * layer.spacing(),
            reach: 2.0 * numerics.smoothing_ratio * layer.spacing(),
            weight: layer.reference_density * across * layer_height,
            window_start: layer.duration - layer.window,
            noise: layer.inclination == 0.0,
            series: TimeSeries::default(),
            sums: vec![[0.0; 6]; BINS],
            lost: 0,
            energy: EnergyBook::default(),
        }
    }

    /// Latest depth mean of the velocity `[m/s]`.
    pub(super) fn mean_velocity(&self) -> f64 {
        self.series.mean_velocity.last().copied().unwrap_or(0.0)
    }

    pub(super) fn observe(&mut self, snapshot: &Snapshot<2>) {
        let mass: f64 = snapshot.mass.iter().sum();
        let (mut momentum, mut height, mut square) = (0.0, 0.0, 0.0);
        for ((m, v), x) in snapshot.mass.iter().zip(&snapshot.velocity).zip(&snapshot.position) {
            momentum += m * v[0];
            height += m * x[1];
            square += m * v.norm_squared();
        }
        if let Some(account) = &snapshot.energy {
            self.energy.enter(snapshot.time, account, 0.0);
        }
        self.series.time.push(snapshot.time);
        self.series.mean_velocity.push(momentum / mass);
        self.series.relative_height.push(2.0 * height / mass / self.height);
        self.series.rms_speed.push((square / mass).sqrt());
        self.lost = snapshot.position.iter().filter(|x| !(x[1] > 0.0 && x[1] < 2.0 * self.height)).count();
        if snapshot.time >= self.window_start {
            self.observe_profile(snapshot);
        }
        if self.noise && snapshot.time >= self.window_start {
            self.series.pressure_noise.push(self.pressure_noise(snapshot));
        }
    }

    fn observe_profile(&mut self, snapshot: &Snapshot<2>) {
        for a in 0..snapshot.position.len() {
            let y = snapshot.position[a][1];
            let pressure = snapshot.pressure[a];
            let normal = pressure - snapshot.stress[a][(1, 1)];
            let bin = ((y / self.height * BINS as f64).max(0.0) as usize).min(BINS - 1);
            let values = [y, snapshot.velocity[a][0], pressure, normal, snapshot.stress[a][(0, 1)], 1.0];
            self.sums[bin].iter_mut().zip(values).for_each(|(sum, value)| *sum += value);
        }
    }

    /// Root mean square over all particles of p less the linear fit through the neighbours within 2h, over the
    /// pressure scale ρ0 g cosθ H.
    fn pressure_noise(&self, snapshot: &Snapshot<2>) -> f64 {
        let place: Vec<[f64; 2]> = snapshot.position.iter().map(|x| [x[0], x[1]]).collect();
        let n = place.len();
        let mut sum = 0.0;
        for (a, centre) in place.iter().enumerate() {
            // normal equations of p ≈ c0 + c1 x + c2 y around particle a; the matrix is symmetric
            let (mut weight, mut first, mut second, mut right) = (0.0, [0.0; 2], [0.0; 3], [0.0; 3]);
            for (b, x) in place.iter().enumerate() {
                let dy = x[1] - centre[1];
                // most particles lie higher or lower, and the nearest image is what costs
                if dy.abs() >= self.reach {
                    continue;
                }
                let mut dx = x[0] - centre[0];
                dx -= self.length * (dx / self.length).round();
                if dx * dx + dy * dy < self.reach * self.reach {
                    let (dx, dy, pressure) = (dx / self.reach, dy / self.reach, snapshot.pressure[b]);
                    weight += 1.0;
                    first = [first[0] + dx, first[1] + dy];
                    second = [second[0] + dx * dx, second[1] + dx * dy, second[2] + dy * dy];
                    right = [right[0] + pressure, right[1] + dx * pressure, right[2] + dy * pressure];
                }
            }
            let matrix = nalgebra::Matrix3::new(
                weight, first[0], first[1], first[0], second[0], second[1], first[1], second[1], second[2],
            );
            let fit = matrix.lu().solve(&nalgebra::Vector3::from(right)).map_or(snapshot.pressure[a], |c| c[0]);
            sum += (snapshot.pressure[a] - fit).powi(2);
        }
        (sum / n as f64).sqrt() / self.weight
    }

    pub(super) fn finish(self) -> LayerObservation {
        let column = |k: usize| self.sums.iter().map(|sums| sums[k] / sums[5]).collect::<Vec<f64>>();
        LayerObservation {
            profile: DepthProfile {
                height: column(0),
                velocity: column(1),
                pressure: column(2),
                normal_stress: column(3),
                shear_stress: column(4),
                samples: self.sums.iter().map(|sums| sums[5]).collect(),
            },
            energy: self.energy,
            particles_lost: self.lost,
            series: self.series,
        }
    }
}
