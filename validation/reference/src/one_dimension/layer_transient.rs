//! The motion of a layer of dry grains on an incline in one dimension: an independent check of the particles.
//!
//! ∂u/∂t = g sinθ + ∂s/∂y with s = τ/ρ, τ = μ(I) p in the direction of the shear where it flows and |τ| ≤ μ_s p where
//! it does not, p = ρ g cosθ (h − y), u = 0 at the bed and τ = 0 at the surface.
//!
//! Velocities u_i stand at the centres of `cells` equal cells, stresses s_j at their lower faces. Implicit Euler gives
//! u_i = u_i⁰ + Δt [g sinθ + (s_{i+1} − s_i)/Δy]. The difference of two neighbours is Δy γ̇_j(s_j) with the *inverse*
//! of the friction law, γ̇(s) = 0 for |s| ≤ S_0 and ±R (|s| − S_0)/(S_2 − |s|) above, S_0 = μ_s p/ρ, S_2 = μ_2 p/ρ,
//! R = I_0 √(p/ρ_s)/D. So the stresses solve
//!
//! Δy γ̇_j(s_j) − (Δt/Δy)(s_{j+1} − 2 s_j + s_{j−1}) = u_j⁰ − u_{j−1}⁰,
//!
//! and at the bed, half a cell away from u_0, (Δy/2) γ̇_0(s_0) − (Δt/Δy)(s_1 − s_0) = u_0⁰ + Δt g sinθ. In stresses the
//! yield is a single-valued function, so nothing is regularised: unyielded faces have a shear rate of exactly 0. These
//! are the conditions for the minimum of a strictly convex energy with a barrier at |s| = S_2. A tridiagonal Newton
//! step with a line search converges from any admissible start. First order in Δt, second in Δy.

use super::tridiagonal::solve;
use super::{BagnoldProfile, LayerError};

/// Largest number of Newton steps in one time step; a handful is usual.
const NEWTON_STEPS: usize = 200;

/// Residual of the velocity differences, relative to the layer's velocity, at which a time step is solved.
const TOLERANCE: f64 = 1e-11;

/// A layer in motion.
#[derive(Clone, Debug)]
pub struct LayerTransient {
    layer: BagnoldProfile,
    time_step: f64,
    time: f64,
    /// u at cell centres `[m/s]`, from the bed up.
    velocity: Vec<f64>,
    /// s = τ/ρ at the cells' lower faces `[m²/s²]`.
    stress: Vec<f64>,
    faces: Vec<Face>,
}

/// The friction law at one height: S_0, S_2 `[m²/s²]`, R `[1/s]`, and the distance `[m]` over which u changes.
#[derive(Clone, Copy, Debug)]
struct Face {
    static_stress: f64,
    limiting_stress: f64,
    rate: f64,
    distance: f64,
}

impl Face {
    /// Shear rate `[1/s]` of a stress and its derivative.
    fn shear_rate(&self, stress: f64) -> (f64, f64) {
        let excess = stress.abs() - self.static_stress;
        if excess <= 0.0 {
            return (0.0, 0.0);
        }
        let margin = self.limiting_stress - stress.abs();
        let rate = self.rate * excess / margin;
        (rate.copysign(stress), self.rate * (self.limiting_stress - self.static_stress) / (margin * margin))
    }
}

impl LayerTransient {
    /// A layer at rest, divided into `cells` cells, advanced with a time step `[s]`.
    pub fn from_rest(layer: BagnoldProfile, cells: usize, time_step: f64) -> Result<Self, LayerError> {
        Self::from_profile(layer, cells, time_step, |_| 0.0)
    }

    /// A layer that starts with a velocity `[m/s]` as a function of height `[m]`.
    pub fn from_profile(
        layer: BagnoldProfile,
        cells: usize,
        time_step: f64,
        velocity: impl Fn(f64) -> f64,
    ) -> Result<Self, LayerError> {
        layer.check()?;
        LayerError::unless_several(cells)?;
        LayerError::unless_positive([("time_step", time_step)])?;
        let width = layer.layer_height / cells as f64;
        let velocity: Vec<f64> = (0..cells).map(|i| velocity((i as f64 + 0.5) * width)).collect();
        if let Some(&value) = velocity.iter().find(|u| !u.is_finite()) {
            return Err(LayerError::Parameter { field: "initial velocity", value, rule: "finite at every height" });
        }
        let faces = (0..cells).map(|j| {
            let pressure = layer.pressure(j as f64 * width);
            Face {
                static_stress: layer.grains.static_friction * pressure / layer.bulk_density(),
                limiting_stress: layer.grains.limiting_friction * pressure / layer.bulk_density(),
                rate: layer.grains.reference_inertia * (pressure / layer.grains.grain_density).sqrt()
                    / layer.grains.grain_diameter,
                distance: if j == 0 { 0.5 * width } else { width },
            }
        });
        let faces = faces.collect();
        Ok(Self { layer, time_step, time: 0.0, velocity, stress: vec![0.0; cells], faces })
    }

    /// Time `[s]` since the start.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Depth mean `[m/s]` of the velocity.
    pub fn depth_mean(&self) -> f64 {
        self.velocity.iter().sum::<f64>() / self.velocity.len() as f64
    }

    /// The velocity profile now.
    pub fn profile(&self) -> LayerProfile {
        let width = self.cell_width();
        let heights = (0..self.velocity.len()).map(|i| (i as f64 + 0.5) * width).collect();
        LayerProfile { time: self.time, heights, velocities: self.velocity.clone() }
    }

    /// Advances for a duration `[s]`, recording the depth mean at each step and the profile at the first step not
    /// before each of `profile_times` `[s]`, which must rise.
    pub fn run(&mut self, duration: f64, profile_times: &[f64]) -> Result<TransientHistory, LayerError> {
        let mut history =
            TransientHistory { times: vec![self.time], depth_means: vec![self.depth_mean()], profiles: Vec::new() };
        let mut wanted = profile_times.iter().copied().peekable();
        let end = self.time + duration;
        // Half a step of slack: sums of steps do not hit a time exactly.
        let slack = 0.5 * self.time_step;
        loop {
            while wanted.next_if(|time| *time <= self.time + slack).is_some() {
                history.profiles.push(self.profile());
            }
            if self.time + slack >= end || end.is_nan() {
                return Ok(history);
            }
            self.step()?;
            history.times.push(self.time);
            history.depth_means.push(self.depth_mean());
        }
    }

    /// Advances by one time step.
    pub fn step(&mut self) -> Result<(), LayerError> {
        let push = self.time_step * self.layer.gravity * libm::sin(self.layer.inclination);
        let differences: Vec<f64> = (0..self.faces.len())
            .map(|j| if j == 0 { self.velocity[0] + push } else { self.velocity[j] - self.velocity[j - 1] })
            .collect();
        let fastest = self.velocity.iter().fold(0.0f64, |fastest, u| fastest.max(u.abs()));
        let tolerance = TOLERANCE * (fastest + self.layer.gravity * self.time_step);
        let mut residual = self.residual(&self.stress, &differences);
        for _ in 0..NEWTON_STEPS {
            if largest(&residual) <= tolerance {
                self.finish_step();
                return Ok(());
            }
            let direction = self.newton_direction(&residual);
            let mut fraction = self.largest_fraction(&direction);
            let slope = dot(&residual, &direction);
            loop {
                let trial: Vec<f64> = self.stress.iter().zip(&direction).map(|(s, d)| s + fraction * d).collect();
                let trial_residual = self.residual(&trial, &differences);
                // The energy's slope along the line rises from below 0; half of it, reversed, is too far past the minimum.
                if dot(&trial_residual, &direction) <= 0.5 * slope.abs() || fraction < 1e-9 {
                    self.stress = trial;
                    residual = trial_residual;
                    break;
                }
                fraction *= 0.5;
            }
        }
        Err(LayerError::NotConverged { time: self.time, residual: largest(&residual) })
    }

    /// Velocities are the sums of shear from the bed up: exactly at rest below the lowest yielded face.
    fn finish_step(&mut self) {
        let mut velocity = 0.0;
        for (j, face) in self.faces.iter().enumerate() {
            velocity += face.distance * face.shear_rate(self.stress[j]).0;
            self.velocity[j] = velocity;
        }
        self.time += self.time_step;
    }

    fn cell_width(&self) -> f64 {
        self.layer.layer_height / self.velocity.len() as f64
    }

    /// Gradient of the energy `[m/s]`: what is missing in each velocity difference.
    fn residual(&self, stress: &[f64], differences: &[f64]) -> Vec<f64> {
        let coupling = self.time_step / self.cell_width();
        let above = |j: usize| stress.get(j + 1).copied().unwrap_or(0.0);
        (0..stress.len())
            .map(|j| {
                let below = if j == 0 { stress[0] } else { stress[j - 1] };
                let curvature = above(j) - 2.0 * stress[j] + below;
                self.faces[j].distance * self.faces[j].shear_rate(stress[j]).0 - coupling * curvature - differences[j]
            })
            .collect()
    }

    /// Solves the symmetric positive definite tridiagonal system of a Newton step.
    fn newton_direction(&self, residual: &[f64]) -> Vec<f64> {
        let coupling = self.time_step / self.cell_width();
        let stiffness =
            self.faces.iter().zip(&self.stress).map(|(face, stress)| face.distance * face.shear_rate(*stress).1);
        let both = |(j, stiffness): (usize, f64)| stiffness + if j == 0 { coupling } else { 2.0 * coupling };
        let diagonal: Vec<f64> = stiffness.enumerate().map(both).collect();
        let right: Vec<f64> = residual.iter().map(|residual| -residual).collect();
        let beside = vec![-coupling; residual.len()];
        solve(&beside, &diagonal, &beside, &right)
    }

    /// Fraction of a direction, at most 1, that uses up 90 % of the nearest margin to |s| = S_2.
    fn largest_fraction(&self, direction: &[f64]) -> f64 {
        let mut fraction = 1.0f64;
        for (j, face) in self.faces.iter().enumerate() {
            let margin = face.limiting_stress - self.stress[j] * direction[j].signum();
            if direction[j].abs() * fraction > 0.9 * margin {
                fraction = 0.9 * margin / direction[j].abs();
            }
        }
        fraction
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}

/// Largest magnitude; NaN counts as infinite, so that it never passes for convergence.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most, value| if value.is_nan() { f64::INFINITY } else { most.max(value.abs()) })
}

/// Velocities over the depth at one time.
#[derive(Clone, Debug, PartialEq)]
pub struct LayerProfile {
    /// Time `[s]`.
    pub time: f64,
    /// Heights above the bed `[m]`.
    pub heights: Vec<f64>,
    /// Velocities there `[m/s]`.
    pub velocities: Vec<f64>,
}

/// History of the depth-averaged velocity.
#[derive(Clone, Debug, PartialEq)]
pub struct TransientHistory {
    /// Times `[s]`, the start included.
    pub times: Vec<f64>,
    /// Depth means `[m/s]` at these times.
    pub depth_means: Vec<f64>,
    /// Profiles at the times asked for.
    pub profiles: Vec<LayerProfile>,
}

impl TransientHistory {
    /// First time `[s]` at which the depth mean has risen to a fraction `[-]` of a steady one `[m/s]`, interpolated
    /// between steps; with a fraction of 0.99 this is t_99.
    pub fn rise_time(&self, steady_depth_mean: f64, fraction: f64) -> Option<f64> {
        let level = fraction * steady_depth_mean;
        self.crossing_time(|mean| mean - level)
    }

    /// First time `[s]` at which the depth mean has fallen to a fraction `[-]` of its initial value, interpolated
    /// between steps: the arrest time, with a fraction of 0.001 unless said otherwise.
    pub fn arrest_time(&self, fraction: f64) -> Option<f64> {
        let level = fraction * self.depth_means.first()?;
        self.crossing_time(|mean| level - mean)
    }

    /// First zero of a function of the depth mean that starts below zero.
    fn crossing_time(&self, gap: impl Fn(f64) -> f64) -> Option<f64> {
        let next = self.depth_means.iter().position(|mean| gap(*mean) >= 0.0)?;
        let previous = next.checked_sub(1)?;
        let (before, after) = (gap(self.depth_means[previous]), gap(self.depth_means[next]));
        Some(self.times[previous] + (self.times[next] - self.times[previous]) * before / (before - after))
    }
}

#[cfg(test)]
#[path = "layer_transient_tests.rs"]
mod tests;
