//! The profiles of a layer, on their cells and at any height.

use super::stream::Stream;
use serde::{Deserialize, Serialize};

/// A layer's state. Cell quantities have one value per cell, face quantities one more, both from the base up.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LayerState {
    /// The stream.
    pub stream: Stream,
    /// Height of a cell `[m]`.
    pub cell_height: f64,
    /// z of the cells' centres `[m]`.
    pub height: Vec<f64>,
    /// φ `[-]` in the cells.
    pub solid_fraction: Vec<f64>,
    /// u_f `[m/s]` in the cells.
    pub fluid_velocity: Vec<f64>,
    /// u_s `[m/s]` in the cells; above the grains that of the topmost.
    pub grain_velocity: Vec<f64>,
    /// K `[kg/(m³ s)]` in the cells: the drag on the grains per volume is K (u_f − u_s).
    pub exchange: Vec<f64>,
    /// z of the faces `[m]`.
    pub face: Vec<f64>,
    /// p′ `[Pa]` at the faces.
    pub grain_pressure: Vec<f64>,
    /// τ_f `[Pa]` at the faces.
    pub fluid_stress: Vec<f64>,
    /// τ_s `[Pa]` at the faces; where grains are held, what holds them.
    pub grain_stress: Vec<f64>,
    /// l `[m]` at the faces.
    pub mixing_length: Vec<f64>,
}

/// Everything at one height.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerPoint {
    /// φ `[-]`.
    pub solid_fraction: f64,
    /// u_f `[m/s]`.
    pub fluid_velocity: f64,
    /// u_s `[m/s]`.
    pub grain_velocity: f64,
    /// K `[kg/(m³ s)]`.
    pub exchange: f64,
    /// p′ `[Pa]`.
    pub grain_pressure: f64,
    /// τ_f `[Pa]`.
    pub fluid_stress: f64,
    /// τ_s `[Pa]`.
    pub grain_stress: f64,
    /// l `[m]`.
    pub mixing_length: f64,
}

impl LayerState {
    /// Everything at a height `[m]`, by straight lines between cells or faces; at the ends the last value, but both
    /// velocities fall to zero at the base.
    pub fn at(&self, z: f64) -> LayerPoint {
        let cell = |values: &[f64]| line(&self.height, values, z);
        let face = |values: &[f64]| line(&self.face, values, z);
        let half_a_cell = (2.0 * (z - self.face[0]) / self.cell_height).clamp(0.0, 1.0);
        LayerPoint {
            solid_fraction: cell(&self.solid_fraction),
            fluid_velocity: half_a_cell * cell(&self.fluid_velocity),
            grain_velocity: half_a_cell * cell(&self.grain_velocity),
            exchange: cell(&self.exchange),
            grain_pressure: face(&self.grain_pressure),
            fluid_stress: face(&self.fluid_stress),
            grain_stress: face(&self.grain_stress),
            mixing_length: face(&self.mixing_length),
        }
    }

    /// Drag on the grains per volume `[N/m³]` in the cells.
    pub fn drag(&self) -> Vec<f64> {
        let slip = self.fluid_velocity.iter().zip(&self.grain_velocity).map(|(fluid, grains)| fluid - grains);
        self.exchange.iter().zip(slip).map(|(exchange, slip)| exchange * slip).collect()
    }

    /// The bits of everything that was computed.
    pub fn to_bytes(&self) -> Vec<u8> {
        let cells = [&self.solid_fraction, &self.fluid_velocity, &self.grain_velocity, &self.exchange];
        let faces = [&self.grain_pressure, &self.fluid_stress, &self.grain_stress, &self.mixing_length];
        cells.into_iter().chain(faces).flatten().flat_map(|value| value.to_le_bytes()).collect()
    }
}

/// Straight lines between points in rising order; the end values beyond the ends.
fn line(places: &[f64], values: &[f64], place: f64) -> f64 {
    let above = places.partition_point(|other| *other <= place);
    if above == 0 || above == places.len() {
        return values[above.min(places.len() - 1)];
    }
    let part = (place - places[above - 1]) / (places[above] - places[above - 1]);
    values[above - 1] + part * (values[above] - values[above - 1])
}
