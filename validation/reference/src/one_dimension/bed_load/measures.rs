//! Measures of a layer: transport, depths, scales, slopes, and residuals of the balances.

use super::profile::LayerState;
use bagnold_inference::statistics::linear_fit;

impl LayerState {
    /// Transport rate q* = ∫ φ u_s dz/√((s − 1) g d³) `[-]`.
    pub fn transport(&self) -> f64 {
        let sum: f64 = self.solid_fraction.iter().zip(&self.grain_velocity).map(|(fraction, u)| fraction * u).sum();
        sum * self.cell_height / self.stream.transport_unit()
    }

    /// Mean of u_f over z > 0 `[m/s]`.
    pub fn mean_fluid_velocity(&self) -> f64 {
        let above = self.height.partition_point(|z| *z < 0.0);
        let velocities = &self.fluid_velocity[above..];
        velocities.iter().sum::<f64>() / velocities.len() as f64
    }

    /// Height `[m]` above which the grains are faster than a speed `[m/s]`; none if none are.
    pub fn moves_above(&self, speed: f64) -> Option<f64> {
        let top = self.height.partition_point(|z| *z < self.top_of_grains());
        let k = self.grain_velocity[..top].iter().rposition(|u| *u <= speed)? + 1;
        let (below, above) = (self.grain_velocity[k - 1], *self.grain_velocity[..top].get(k)?);
        Some(self.height[k - 1] + self.cell_height * (speed - below) / (above - below))
    }

    /// Height `[m]` up to which there are grains.
    pub fn top_of_grains(&self) -> f64 {
        let last = self.solid_fraction.iter().rposition(|fraction| *fraction > 1e-6);
        last.map_or(self.face[0], |k| {
            // the last cell is filled in part; the one below tells how densely
            let full = if k > 0 { self.solid_fraction[k - 1] } else { self.solid_fraction[k] };
            self.face[k] + self.cell_height * (self.solid_fraction[k] / full).min(1.0)
        })
    }

    /// Length `[m]` over which u_s falls by e below z = 0: least squares of ln u_s while it exceeds a part of its value
    /// at z = 0.
    pub fn decay_length(&self, part: f64) -> Option<f64> {
        let surface = self.at(0.0).grain_velocity;
        let below = self.height.partition_point(|z| *z < 0.0);
        let points: Vec<(f64, f64)> = (0..below)
            .rev()
            .take_while(|&k| self.grain_velocity[k] > part * surface)
            .map(|k| (self.height[k], libm::log(self.grain_velocity[k])))
            .collect();
        linear_fit(&points).map(|fit| 1.0 / fit.slope)
    }

    /// Slope du_f/d ln z between two heights `[m]` over u_*/κ `[-]`: 1 in clear water.
    pub fn logarithmic_slope(&self, from: f64, to: f64, karman: f64) -> Option<f64> {
        let inside = |z: f64| z >= from && z <= to;
        let points: Vec<(f64, f64)> = self
            .height
            .iter()
            .zip(&self.fluid_velocity)
            .filter(|(z, _)| inside(**z))
            .map(|(z, u)| (libm::log(*z), *u))
            .collect();
        linear_fit(&points).map(|fit| fit.slope * karman / self.stream.shear_velocity())
    }

    /// Height of the largest drag per volume, and the range in which it exceeds a part of that `[m]`.
    pub fn drag_peak(&self, part: f64) -> DragPeak {
        let drag = self.drag();
        let (peak, largest) =
            drag.iter().enumerate().fold((0, 0.0), |best, (k, &f)| if f > best.1 { (k, f) } else { best });
        let inside = |k: &usize| drag[*k] > part * largest;
        let from = (0..=peak).rev().take_while(inside).last().unwrap_or(peak);
        let to = (peak..drag.len()).take_while(inside).last().unwrap_or(peak);
        DragPeak { height: self.height[peak], value: largest, from: self.height[from], to: self.height[to] }
    }

    /// Largest error of τ_f + τ_s = g sinθ ∫_z ρ dz over ρ_f g h i `[-]`.
    pub fn stress_balance_error(&self) -> f64 {
        let stream = &self.stream;
        let mut carried = 0.0;
        let mut largest = (self.fluid_stress[self.height.len()] + self.grain_stress[self.height.len()]).abs();
        for k in (0..self.height.len()).rev() {
            let fraction = self.solid_fraction[k];
            let density = fraction * stream.grain_density + (1.0 - fraction) * stream.fluid_density;
            carried += density * stream.driving() * self.cell_height;
            largest = largest.max((self.fluid_stress[k] + self.grain_stress[k] - carried).abs());
        }
        largest / stream.bed_stress()
    }

    /// Largest error of K (u_f − u_s) = −∂_z τ_s − φ ρ_s g sinθ over the largest drag `[-]`.
    pub fn drag_balance_error(&self) -> f64 {
        let stream = &self.stream;
        let drag = self.drag();
        let error = |k: usize| {
            let divergence = (self.grain_stress[k + 1] - self.grain_stress[k]) / self.cell_height;
            (drag[k] + divergence + self.solid_fraction[k] * stream.grain_density * stream.driving()).abs()
        };
        let largest = drag.iter().fold(0.0_f64, |largest, f| largest.max(f.abs()));
        (0..drag.len()).map(error).fold(0.0, f64::max) / largest
    }

    /// Relative L2 difference of u_f and of φ u_s from those of a layer with smaller cells, the larger of the two `[-]`.
    /// Means over this layer's cells are compared, above a height `[m]`.
    pub fn difference(&self, finer: &Self, above: f64) -> f64 {
        let ratio = (self.cell_height / finer.cell_height).round() as usize;
        let mean = |values: &[f64], k: usize| values[k * ratio..(k + 1) * ratio].iter().sum::<f64>() / ratio as f64;
        let flux = |layer: &Self| -> Vec<f64> {
            layer.solid_fraction.iter().zip(&layer.grain_velocity).map(|(fraction, u)| fraction * u).collect()
        };
        let relative = |own: &[f64], other: &[f64]| {
            let (mut error, mut scale) = (0.0, 0.0);
            for k in (0..own.len()).filter(|&k| self.height[k] > above) {
                let other = mean(other, k);
                error += (own[k] - other) * (own[k] - other);
                scale += other * other;
            }
            if scale > 0.0 { (error / scale).sqrt() } else { 0.0 }
        };
        relative(&self.fluid_velocity, &finer.fluid_velocity).max(relative(&flux(self), &flux(finer)))
    }
}

/// Peak and range of the drag.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DragPeak {
    /// Height of the peak `[m]`.
    pub height: f64,
    /// Drag there `[N/m³]`.
    pub value: f64,
    /// Lowest height of the range `[m]`.
    pub from: f64,
    /// Highest height of the range `[m]`.
    pub to: f64,
}
