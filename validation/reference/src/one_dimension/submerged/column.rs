//! The column of a submerged layer: its state, its steps in time and its balances.

use super::SubmergedLayer;
use super::law::GrainFlow;
use super::pore_pressure::{DarcyFlow, Storage};
use crate::one_dimension::LayerError;
use serde::{Deserialize, Serialize};

/// Part of Δz²/(A d² γ̇) that a step takes at most `[-]`: stability of the explicit diffusion.
const DIFFUSION_STEP: f64 = 0.2;

/// Length of a stage over the step, 1 − 1/√2: two stages of it are of second order for stored water, and damp what is stiff.
const STAGE: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;

/// Largest number of steps; a few thousand are usual.
const LARGEST_STEPS: usize = 5_000_000;

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
    steps: usize,
}

/// Profiles over the depth, at the middles of cells from the floor upwards.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SubmergedProfile {
    /// Time `[s]`.
    pub time: f64,
    /// Distance from the floor `[m]`.
    pub height: Vec<f64>,
    /// Solid fraction `[-]`.
    pub solid_fraction: Vec<f64>,
    /// Excess pore pressure `[Pa]`.
    pub pore_pressure: Vec<f64>,
    /// Effective pressure `[Pa]`.
    pub effective_pressure: Vec<f64>,
    /// Shear rate `[1/s]`.
    pub shear_rate: Vec<f64>,
    /// Velocity down the slope `[m/s]`.
    pub velocity: Vec<f64>,
}

impl SubmergedColumn {
    /// A column of a uniform solid fraction and, with a compressible skeleton, a uniform pore pressure `[Pa]`, tilted at once.
    ///
    /// # Errors
    /// No pore pressure that balances the first flow.
    pub fn new(layer: &SubmergedLayer, solid_fraction: f64, pore_pressure: f64) -> Result<Self, LayerError> {
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
            steps: 0,
        };
        if layer.compressibility > 0.0 {
            column.flow = column.darcy(&column.fraction, &column.height).grain_flow(&column.pore_pressure);
        } else {
            (column.pore_pressure, column.flow) = column.balanced(&column.fraction, &column.pore_pressure, 1.0)?;
        }
        Ok(column)
    }

    /// Time `[s]`.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Steps taken.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.steps
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
    /// A step whose pore pressure does not converge, or too many steps.
    pub fn advance_to(&mut self, time: f64) -> Result<(), LayerError> {
        while self.time < time {
            if self.steps == LARGEST_STEPS {
                return Err(LayerError::StepsUsedUp { time: self.time, steps: self.steps });
            }
            let left = time - self.time;
            let step = self.stable_step();
            if step < left {
                self.step(step)?;
            } else {
                self.step(left)?;
                self.time = time;
            }
        }
        Ok(())
    }

    /// Longest step that changes φ little and keeps its diffusion stable `[s]`.
    fn stable_step(&self) -> f64 {
        let (mut change, mut shear_rate): (f64, f64) = (0.0, 0.0);
        for (flow, fraction) in self.flow.iter().zip(&self.fraction) {
            change = change.max((fraction * flow.dilation_rate).abs());
            shear_rate = shear_rate.max(flow.shear_rate);
        }
        let mut step = self.layer.longest_step;
        if change > 0.0 {
            step = step.min(self.layer.largest_fraction_change / change);
        }
        let diffusivity = self.diffusivity(shear_rate);
        if diffusivity > 0.0 {
            let cell_height = self.layer.depth / self.layer.cells as f64;
            step = step.min(DIFFUSION_STEP * cell_height * cell_height / diffusivity);
        }
        step.max(SHORTEST_STEP)
    }

    fn diffusivity(&self, shear_rate: f64) -> f64 {
        self.layer.fraction_diffusion * self.layer.grain_diameter * self.layer.grain_diameter * shear_rate
    }

    /// One step: φ by the midpoint rule, the pore pressure in balance with it.
    fn step(&mut self, step: f64) -> Result<(), LayerError> {
        let cells = self.fraction.len();
        let dilated = |flow: &[GrainFlow], step: f64| -> Vec<f64> {
            (0..cells).map(|k| self.fraction[k] * libm::exp(-step * flow[k].dilation_rate)).collect()
        };
        let (pressure, flow) = self.balanced(&dilated(&self.flow, 0.5 * step), &self.pore_pressure, 0.5 * step)?;
        let mut flux = vec![0.0; cells + 1];
        for k in 1..cells {
            let shear_rate = self.flow[k].shear_rate.max(self.flow[k - 1].shear_rate);
            let distance = 0.5 * (self.height[k] + self.height[k - 1]);
            flux[k] = self.diffusivity(shear_rate) * (self.fraction[k] - self.fraction[k - 1]) / distance;
        }
        let mut fraction = dilated(&flow, step);
        for k in 0..cells {
            fraction[k] += step * (flux[k + 1] - flux[k]) / self.height[k];
        }
        let next = if self.layer.compressibility > 0.0 {
            let (first, _) = self.balanced(&dilated(&flow, STAGE * step), &self.pore_pressure, STAGE * step)?;
            let pairs = self.pore_pressure.iter().zip(first);
            let carried: Vec<f64> =
                pairs.map(|(start, first)| start + (1.0 - STAGE) / STAGE * (first - start)).collect();
            self.balanced(&fraction, &carried, STAGE * step)?
        } else {
            self.balanced(&fraction, &pressure, step)?
        };
        (self.pore_pressure, self.flow) = next;
        let height = self.heights(&fraction);
        (self.fraction, self.height) = (fraction, height);
        self.time += step;
        self.steps += 1;
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

    /// Profiles now.
    #[must_use]
    pub fn profile(&self) -> SubmergedProfile {
        let (mut floor, mut speed) = (0.0, 0.0);
        let (mut place, mut velocity) = (Vec::new(), Vec::new());
        for (flow, height) in self.flow.iter().zip(&self.height) {
            place.push(floor + 0.5 * height);
            velocity.push(speed + 0.5 * height * flow.shear_rate);
            floor += height;
            speed += height * flow.shear_rate;
        }
        SubmergedProfile {
            time: self.time,
            height: place,
            solid_fraction: self.fraction.clone(),
            pore_pressure: self.pore_pressure.clone(),
            effective_pressure: self.overburden.iter().zip(&self.pore_pressure).map(|(all, pore)| all - pore).collect(),
            shear_rate: self.flow.iter().map(|flow| flow.shear_rate).collect(),
            velocity,
        }
    }

    /// Grains of the column over those at the start, less one `[-]`.
    #[must_use]
    pub fn mass_error(&self) -> f64 {
        let grains: f64 = self.fraction.iter().zip(&self.height).map(|(fraction, height)| fraction * height).sum();
        (grains / (self.grains * self.height.len() as f64) - 1.0).abs()
    }

    /// Largest error of both balances of momentum, over the overburden of the floor `[-]`: p′ + p_f is the weight of the
    /// grains above, and where grains flow the law's friction carries its part down the slope.
    #[must_use]
    pub fn momentum_error(&self) -> f64 {
        let profile = self.profile();
        let slope = self.layer.slope();
        let (mut weight, mut largest): (f64, f64) = (0.0, 0.0);
        for k in (0..self.height.len()).rev() {
            let own = self.layer.buoyant_weight() * self.fraction[k] * self.height[k];
            let overburden = weight + 0.5 * own;
            weight += own;
            let effective = profile.effective_pressure[k];
            largest = largest.max((effective + self.pore_pressure[k] - overburden).abs());
            if profile.shear_rate[k] > 0.0 {
                let viscous_number = self.layer.viscosity * profile.shear_rate[k] / effective;
                let friction = self.layer.law.friction(viscous_number, self.fraction[k]);
                largest = largest.max((friction * effective - slope * overburden).abs());
            }
        }
        largest / weight
    }

    /// Water that enters by the surface less the growth of the pores, over the sum of its magnitudes `[-]`; 0 at rest.
    #[must_use]
    pub fn water_error(&self) -> f64 {
        let top = self.pore_pressure.len() - 1;
        let conductance = self.darcy(&self.fraction, &self.height).conductance();
        let entering = -conductance[top] * self.pore_pressure[top];
        let (mut growth, mut scale) = (0.0, 0.0);
        for (flow, height) in self.flow.iter().zip(&self.height) {
            growth += flow.dilation_rate * height;
            scale += flow.dilation_rate.abs() * height;
        }
        if scale > 0.0 { (entering - growth).abs() / scale } else { 0.0 }
    }
}
