//! Excess pore pressure of a column whose grains dilate: Darcy's law with the permeability of Kozeny and Carman.
//!
//! ∂_z(k/η ∂_z p_f) = D(p′) + S ∂p_f/∂t, k = d² (1 − φ)³/(180 φ²), p′ = P − p_f under the overburden P. The surface drains
//! (p_f = 0), the floor does not. Finite volumes, Newton's method, one tridiagonal system per iteration.

use super::SubmergedLayer;
use super::law::GrainFlow;
use crate::one_dimension::tridiagonal;

/// Smallest effective pressure over the overburden `[-]`: the law has no meaning where grains lose contact.
const LEAST_EFFECTIVE: f64 = 1e-3;

/// Part of the effective pressure that one iteration leaves at least `[-]`.
const LEAST_LEFT: f64 = 0.05;

/// Change of an iteration, over the overburden of the lowest cell, below which the pressure has converged `[-]`.
const CONVERGED: f64 = 1e-9;

const LARGEST_ITERATIONS: usize = 60;

/// State of a column that its pore pressure follows from; arrays of cells from the floor upwards.
pub(super) struct DarcyFlow<'a> {
    pub(super) layer: &'a SubmergedLayer,
    /// Overburden P `[Pa]`.
    pub(super) overburden: &'a [f64],
    /// Solid fraction φ `[-]`.
    pub(super) fraction: &'a [f64],
    /// Height of a cell `[m]`.
    pub(super) height: &'a [f64],
}

/// Water stored by a compressible skeleton during a step.
pub(super) struct Storage<'a> {
    /// Compressibility over the length of the step `[1/(Pa s)]`.
    pub(super) rate: f64,
    /// Pore pressure at the start of the step `[Pa]`.
    pub(super) before: &'a [f64],
}

impl DarcyFlow<'_> {
    /// Flow of the grains at a pore pressure.
    pub(super) fn grain_flow(&self, pore_pressure: &[f64]) -> Vec<GrainFlow> {
        let layer = self.layer;
        let slope = layer.slope();
        let of_cell = |k: usize| {
            let overburden = self.overburden[k];
            let effective = (overburden - pore_pressure[k]).max(LEAST_EFFECTIVE * overburden);
            layer.law.flow(slope * overburden, effective, self.fraction[k], layer.viscosity)
        };
        (0..pore_pressure.len()).map(of_cell).collect()
    }

    /// Flux of water per difference of pressure across the upper face of each cell `[m/(Pa s)]`.
    fn conductance(&self) -> Vec<f64> {
        let resistance: Vec<f64> = (self.fraction.iter().zip(self.height))
            .map(|(&fraction, height)| 0.5 * height * self.layer.viscosity / self.layer.permeability(fraction))
            .collect();
        let upper = |k: usize| 1.0 / (resistance[k] + resistance.get(k + 1).copied().unwrap_or(0.0));
        (0..resistance.len()).map(upper).collect()
    }

    /// Replaces a first guess of the pore pressure by the solution; the flow of the grains at it, or none without
    /// convergence.
    pub(super) fn solve(&self, pore_pressure: &mut [f64], storage: &Storage<'_>) -> Option<Vec<GrainFlow>> {
        let cells = pore_pressure.len();
        let conductance = self.conductance();
        let lower: Vec<f64> = (0..cells).map(|k| if k > 0 { conductance[k - 1] } else { 0.0 }).collect();
        for _ in 0..LARGEST_ITERATIONS {
            let flow = self.grain_flow(pore_pressure);
            let (mut diagonal, mut residual) = (Vec::with_capacity(cells), Vec::with_capacity(cells));
            for k in 0..cells {
                let above = pore_pressure.get(k + 1).copied().unwrap_or(0.0);
                let below = if k > 0 { pore_pressure[k - 1] } else { 0.0 };
                let inflow = conductance[k] * (above - pore_pressure[k]) - lower[k] * (pore_pressure[k] - below);
                let filled = storage.rate * (pore_pressure[k] - storage.before[k]);
                residual.push((flow[k].dilation_rate + filled) * self.height[k] - inflow);
                // ∂D/∂p_f = −∂D/∂p′
                let source = (flow[k].dilation_slope - storage.rate) * self.height[k];
                diagonal.push(source - conductance[k] - lower[k]);
            }
            let change = tridiagonal::solve(&lower, &diagonal, &conductance, &residual);
            let mut part: f64 = 1.0;
            for k in 0..cells {
                let effective = self.overburden[k] - pore_pressure[k];
                if part * change[k] > (1.0 - LEAST_LEFT) * effective {
                    part = (1.0 - LEAST_LEFT) * effective / change[k];
                }
            }
            if change.iter().any(|change| !change.is_finite()) {
                return None;
            }
            let mut largest: f64 = 0.0;
            for (pressure, change) in pore_pressure.iter_mut().zip(&change) {
                *pressure += part * change;
                largest = largest.max(change.abs());
            }
            if largest < CONVERGED * self.overburden[0] {
                return Some(self.grain_flow(pore_pressure));
            }
        }
        None
    }
}
