//! The column of a submerged layer: its state and its steps in time.

use super::SubmergedLayer;
use super::law::GrainFlow;
use super::pore_pressure::{DarcyFlow, Storage};
use crate::one_dimension::LayerError;

/// Length of a stage over the step, 1 − 1/√2: two stages of it are of second order for stored water, and damp what is stiff.
const STAGE: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;

/// Shortest step `[s]`.
const SHORTEST_STEP: f64 = 1e-9;

/// A column in motion.
#[derive(Debug, Clone)]
pub struct SubmergedColumn {
    layer: SubmergedLayer,
    /// Volume of the grains of a cell over its base `[m]`.
    grains: f64,
    overburden: Vec<f64>,
    fraction: Vec<f64>,
    height: Vec<f64>,
    pore_pressure: Vec<f64>,
    flow: Vec<GrainFlow>,
    time: f64,
}

impl SubmergedColumn {
    /// A column of a uniform solid fraction and a uniform pore pressure `[Pa]`, tilted at once.
    #[must_use]
    pub fn new(layer: &SubmergedLayer, solid_fraction: f64, pore_pressure: f64) -> Self {
        let cells = layer.cells;
        let cell_height = layer.depth / cells as f64;
        let grains = solid_fraction * cell_height;
        let above = |k: usize| layer.buoyant_weight() * grains * (cells as f64 - k as f64 - 0.5);
        let mut column = Self {
            layer: *layer,
            grains,
            overburden: (0..cells).map(above).collect(),
            fraction: vec![solid_fraction; cells],
            height: vec![cell_height; cells],
            pore_pressure: vec![pore_pressure; cells],
            flow: Vec::new(),
            time: 0.0,
        };
        column.flow = column.darcy(&column.fraction, &column.height).grain_flow(&column.pore_pressure);
        column
    }

    /// Time `[s]`.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Velocity of the surface `[m/s]`.
    #[must_use]
    pub fn surface_velocity(&self) -> f64 {
        self.flow.iter().zip(&self.height).map(|(flow, height)| flow.shear_rate * height).sum()
    }

    /// Excess pore pressure of the lowest cell `[Pa]`.
    #[must_use]
    pub fn floor_pressure(&self) -> f64 {
        self.pore_pressure[0]
    }

    /// Mean solid fraction `[-]`.
    #[must_use]
    pub fn mean_fraction(&self) -> f64 {
        self.grains * self.height.len() as f64 / self.height.iter().sum::<f64>()
    }

    /// Steps until a time `[s]`.
    ///
    /// # Errors
    /// A step whose pore pressure does not converge.
    pub fn advance_to(&mut self, time: f64) -> Result<(), LayerError> {
        while self.time < time {
            let left = time - self.time;
            let step = self.short_step();
            if step < left {
                self.step(step)?;
            } else {
                self.step(left)?;
                self.time = time;
            }
        }
        Ok(())
    }

    /// Longest step that changes φ little `[s]`.
    fn short_step(&self) -> f64 {
        let changes =
            self.flow.iter().zip(&self.fraction).map(|(flow, fraction)| (fraction * flow.dilation_rate).abs());
        let step = self.layer.largest_fraction_change / changes.fold(0.0, f64::max);
        step.min(self.layer.longest_step).max(SHORTEST_STEP)
    }

    /// One step: φ by the midpoint rule, the pore pressure in balance with it.
    fn step(&mut self, step: f64) -> Result<(), LayerError> {
        let dilated = |flow: &[GrainFlow], step: f64| -> Vec<f64> {
            let pairs = self.fraction.iter().zip(flow);
            pairs.map(|(fraction, flow)| fraction * libm::exp(-step * flow.dilation_rate)).collect()
        };
        let (_, flow) = self.balanced(&dilated(&self.flow, 0.5 * step), &self.pore_pressure, 0.5 * step)?;
        let fraction = dilated(&flow, step);
        let (first, _) = self.balanced(&dilated(&flow, STAGE * step), &self.pore_pressure, STAGE * step)?;
        let pairs = self.pore_pressure.iter().zip(first);
        let carried: Vec<f64> = pairs.map(|(start, first)| start + (1.0 - STAGE) / STAGE * (first - start)).collect();
        (self.pore_pressure, self.flow) = self.balanced(&fraction, &carried, STAGE * step)?;
        self.height = self.heights(&fraction);
        self.fraction = fraction;
        self.time += step;
        Ok(())
    }

    fn heights(&self, fraction: &[f64]) -> Vec<f64> {
        fraction.iter().map(|fraction| self.grains / fraction).collect()
    }

    fn darcy<'a>(&'a self, fraction: &'a [f64], height: &'a [f64]) -> DarcyFlow<'a> {
        DarcyFlow { layer: &self.layer, overburden: &self.overburden, fraction, height }
    }

    /// Pore pressure in balance with the dilation that it causes and with water stored over a time `[s]` since a former
    /// pressure, which is the first guess as well; with the flow of the grains.
    fn balanced(&self, fraction: &[f64], before: &[f64], time: f64) -> Result<(Vec<f64>, Vec<GrainFlow>), LayerError> {
        let mut pressure = before.to_vec();
        let storage = Storage { rate: self.layer.compressibility / time, before };
        match self.darcy(fraction, &self.heights(fraction)).solve(&mut pressure, &storage) {
            Some(flow) => Ok((pressure, flow)),
            None => Err(LayerError::NoPorePressure { time: self.time }),
        }
    }
}
