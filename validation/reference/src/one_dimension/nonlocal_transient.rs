//! The motion of a layer of nonlocal granular fluidity in one dimension, with the elastic shear of the particle model.
//!
//! ∂u/∂t = g₀ sinθ + (∂τ/∂y)/ρ, ∂τ/∂t = G (∂u/∂y − g τ/p), t_0 ∂g/∂t = A² d² g″ + R(μ) g − c μ g², μ = τ/p, over cells of equal
//! width; the stress is relaxed at the end of a step, and the fluidity takes its diffusion, its decay and its square at the end
//! and its growth at the start, so that it stays positive. A wave needs 2.5 steps across a cell.

use super::fluidity_balance::{faces, growth};
use super::tridiagonal::solve;
use crate::one_dimension::{LayerError, NonlocalLayer};

/// Part of the way from μ_s to μ_2 above which the growth does not rise, while the explicit growth runs ahead of the stress.
const STEEPEST: f64 = 0.98;
/// Courant number of shear waves.
const COURANT: f64 = 0.4;

/// A layer in motion.
#[derive(Clone, Debug)]
pub(crate) struct NonlocalTransient {
    layer: NonlocalLayer,
    relaxation_time: f64,
    shear_modulus: f64,
    width: f64,
    /// u, τ and g at the cells' centres, from the bed up.
    velocity: Vec<f64>,
    stress: Vec<f64>,
    fluidity: Vec<f64>,
    pressure: Vec<f64>,
}

impl NonlocalTransient {
    /// A layer that starts with the steady profile of the local law on another slope `[rad]`, in a number of cells, with the
    /// relaxation time `[s]` of its fluidity and a shear modulus `[Pa]`.
    ///
    /// # Errors
    /// A parameter out of its range, or a slope without such a profile.
    pub(crate) fn from_bagnold(
        layer: NonlocalLayer,
        cells: usize,
        start: f64,
        relaxation_time: f64,
        shear_modulus: f64,
    ) -> Result<Self, LayerError> {
        layer.layer.check()?;
        for (field, value) in [("relaxation_time", relaxation_time), ("shear_modulus", shear_modulus)] {
            if value.is_nan() || value <= 0.0 {
                return Err(LayerError::Parameter { field, value, rule: "greater than 0" });
            }
        }
        let profile = crate::one_dimension::BagnoldProfile { inclination: start, ..layer.layer };
        let Some(inertia) = profile.inertial_number() else {
            let rule = "between the arctangents of static_friction and limiting_friction";
            return Err(LayerError::Parameter { field: "start", value: start, rule });
        };
        let (width, friction) = (layer.layer.layer_height / cells as f64, libm::tan(start));
        let heights = (0..cells).map(|cell| (cell as f64 + 0.5) * width);
        let pressure: Vec<f64> = heights.clone().map(|height| layer.layer.pressure(height)).collect();
        let rate =
            |pressure: &f64| (pressure / layer.layer.grains.grain_density).sqrt() / layer.layer.grains.grain_diameter;
        Ok(Self {
            relaxation_time,
            shear_modulus,
            width,
            velocity: heights.map(|height| profile.velocity(height).unwrap_or(0.0)).collect(),
            stress: pressure.iter().map(|pressure| friction * pressure).collect(),
            fluidity: pressure.iter().map(|pressure| inertia * rate(pressure) / friction).collect(),
            pressure,
            layer,
        })
    }

    /// Depth mean of the velocity `[m/s]`.
    pub(crate) fn depth_mean(&self) -> f64 {
        self.velocity.iter().sum::<f64>() / self.velocity.len() as f64
    }

    /// Advances the run by a time `[s]`.
    pub(crate) fn advance(&mut self, duration: f64) {
        let density = self.layer.layer.bulk_density();
        let longest = COURANT * self.width / (self.shear_modulus / density).sqrt();
        let steps = (duration / longest).ceil().max(1.0);
        for _ in 0..steps as usize {
            self.step(duration / steps);
        }
    }

    fn step(&mut self, time_step: f64) {
        let cells = self.velocity.len();
        let layer = self.layer.layer;
        let driving = layer.gravity * libm::sin(layer.inclination);
        // at the bed the stress goes on along a line, at the surface there is none
        let face = |face: usize| match face {
            0 => 1.5 * self.stress[0] - 0.5 * self.stress[1],
            face if face == cells => 0.0,
            face => 0.5 * (self.stress[face - 1] + self.stress[face]),
        };
        let forces: Vec<f64> = (0..cells).map(|cell| (face(cell + 1) - face(cell)) / self.width).collect();
        for (velocity, force) in self.velocity.iter_mut().zip(forces) {
            *velocity += time_step * (driving + force / layer.bulk_density());
        }
        let around = |cell: isize| match cell {
            -1 => -self.velocity[0],
            cell if cell as usize == cells => 2.0 * self.velocity[cells - 1] - self.velocity[cells - 2],
            cell => self.velocity[cell as usize],
        };
        let rates: Vec<f64> =
            (0..cells as isize).map(|cell| (around(cell + 1) - around(cell - 1)) / (2.0 * self.width)).collect();
        self.relax_fluidity(time_step);
        for cell in 0..cells {
            let (modulus, pressure) = (self.shear_modulus, self.pressure[cell]);
            self.stress[cell] = (self.stress[cell] + time_step * modulus * rates[cell])
                / (1.0 + time_step * modulus * self.fluidity[cell] / pressure);
        }
    }

    fn relax_fluidity(&mut self, time_step: f64) {
        let (layer, cells) = (self.layer.layer, self.fluidity.len());
        let coupling = (self.layer.cooperativity * layer.grains.grain_diameter / self.width).powi(2);
        let range = layer.grains.limiting_friction - layer.grains.static_friction;
        let inverse = self.relaxation_time / time_step;
        let (mut diagonal, mut right) = (vec![0.0; cells], vec![0.0; cells]);
        for cell in 0..cells {
            let (pressure, fluidity) = (self.pressure[cell], self.fluidity[cell]);
            let friction = self.stress[cell] / pressure;
            let growth = growth(&layer.grains, friction.min(layer.grains.static_friction + STEEPEST * range));
            let rate = (pressure / layer.grains.grain_density).sqrt() / layer.grains.grain_diameter;
            let square = range / layer.grains.reference_inertia * friction.abs() / rate;
            diagonal[cell] =
                inverse + faces(self.layer.ends(), cell, cells) * coupling - growth.min(0.0) + square * fluidity;
            right[cell] = (inverse + growth.max(0.0)) * fluidity;
        }
        self.fluidity = solve(&vec![-coupling; cells], &diagonal, &vec![-coupling; cells], &right);
    }
}
