//! Suspension: grains that eddies lift against their settling.
//!
//! Averaged drag (Hsu et al. 2004, Chauchat 2018) pushes grains down the gradient of φ. The eddies' force per volume is
//!
//! ```text
//! F = −D ∂_z φ,    D = c ε/w(φ),    ε = ν_t/Sc,    c = (ρ_s − ρ_f) g cosθ,
//! ```
//!
//! with the settling velocity w(φ) of the drag law. Contacts carry what is left of the weight, ∂_z p′ = F − c φ, and the
//! water gets −F: its pressure carries what eddies lift. ν_t is the water's own, l² |γ|, as a mean of the particles around a
//! node.
//!
//! A column of a given amount of grains has one balance: from a pressure at its base upwards, cell by cell, p′ and the shear
//! give φ; the pressure is sought that leaves no grain over. Grains tend to their height in the balance in the time of the
//! dilation, but no faster than a grain settles. They keep their order, so that a suspension of few particles stays smooth;
//! its way to the balance is not resolved.

#[cfg(test)]
mod tests;

use super::super::{IncompressibleScene, Phase, Sediment, Stratification, height_axis};
use super::{ColumnGrid, Nodes};
use crate::material::dilatancy::Dilatancy;
use crate::material::drag::{Settling, SettlingTable};
use crate::material::turbulence::eddy_viscosity;
use crate::vector::{Tensor, shear_rate};

/// Relative change of the amount of grains to which it is met, and of a cell's pressure at which it is found `[-]`.
const ROUNDING: f64 = 1e-13;

/// Largest number of marches in search of the base pressure, and of Newton's steps in a cell; ten are usual.
const ITERATIONS: usize = 60;

/// p′ over the weight of the column below which contacts are not distinguished `[-]`: no row of the friction is empty.
const LEAST_LOAD: f64 = 1e-12;

/// Laws of a suspension.
#[derive(Debug, Clone)]
pub(crate) struct SuspensionLaws {
    /// c `[Pa/m]`.
    pub(crate) submerged_weight: f64,
    /// w(φ) up to φ_max.
    pub(crate) settling: SettlingTable,
    /// φ_max, B and the grains.
    pub(crate) dilatancy: Dilatancy,
}

impl SuspensionLaws {
    pub(crate) fn of<const D: usize>(
        scene: &IncompressibleScene<D>,
        material: &Sediment<D>,
        dilatancy: Dilatancy,
        submerged_weight: f64,
    ) -> Self {
        let settling = Settling {
            submerged_weight,
            grain_diameter: material.drag_diameter,
            fluid_density: scene.fluid.density,
            kinematic_viscosity: scene.fluid.kinematic_viscosity,
        };
        let settling = SettlingTable::new(&settling, material.drag, dilatancy.packing);
        Self { submerged_weight, settling, dilatancy }
    }

    /// √p′ `[√Pa]` and φ `[-]` in the middle of a cell of a shear rate `[1/s]`: the root r of r² + C r/(r + S) = `below`,
    /// with φ = φ_max r/(r + S), S = B γ d √ρ_s and `carried` C, what a fraction φ_max takes of the pressure `[Pa]`.
    fn cell(&self, rate: f64, below: f64, carried: f64) -> (f64, f64) {
        let Dilatancy { dilation, packing, grain_diameter, grain_density } = self.dilatancy;
        let looseness = dilation * rate * grain_diameter * grain_density.sqrt();
        if below <= 0.0 {
            return (0.0, 0.0);
        }
        let share = below / carried;
        if looseness <= 0.0 {
            return ((below - carried).max(0.0).sqrt(), packing * share.min(1.0));
        }
        let (mut low, mut high) = (0.0, below.sqrt());
        let mut root = if share < 1.0 { looseness * share / (1.0 - share) } else { (below - carried).sqrt() }.min(high);
        for _ in 0..ITERATIONS {
            let sum = root + looseness;
            let excess = root * root + carried * root / sum - below;
            if excess > 0.0 {
                high = root
            } else {
                low = root
            }
            let newton = root - excess / (2.0 * root + carried * looseness / (sum * sum));
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            let change = (next - root).abs();
            root = next;
            if change <= ROUNDING * root {
                break;
            }
        }
        (root, packing * root / (root + looseness))
    }
}

/// Eddies and suspended grains of all columns; arrays have the shape `[columns × nodes]`.
#[derive(Debug)]
pub(crate) struct Suspension {
    pub(crate) laws: SuspensionLaws,
    turbulent_schmidt: f64,
    /// Σ of the weights of the water around a node `[-]`.
    weight: Vec<f64>,
    /// ε `[m²/s]`.
    pub(crate) diffusivity: Vec<f64>,
    /// √p′ in the middle of a node `[√Pa]`.
    root: Vec<f64>,
    /// Force of the eddies on the grains of a node per area `[Pa]`.
    pub(crate) force: Vec<f64>,
    /// Grains up to the face above a node where they are, ∫ φ dz `[m]`.
    present: Vec<f64>,
    /// And in the balance.
    balanced: Vec<f64>,
}

impl Suspension {
    pub(crate) fn new(laws: SuspensionLaws, turbulent_schmidt: f64, grid: &ColumnGrid) -> Self {
        let zeros = || vec![0.0; grid.len()];
        let (weight, diffusivity, root, force) = (zeros(), zeros(), zeros(), zeros());
        Self { laws, turbulent_schmidt, weight, diffusivity, root, force, present: zeros(), balanced: zeros() }
    }

    /// Finds ε of the nodes from the water's velocity gradients `[1/s]` and mixing lengths.
    pub(crate) fn find_eddies<const D: usize>(
        &mut self,
        grid: &ColumnGrid,
        fluid: &Phase<D>,
        gradients: &[Tensor<D>],
        layer: &Stratification,
        reach: f64,
    ) {
        let Self { weight, diffusivity, .. } = self;
        weight.fill(0.0);
        diffusivity.fill(0.0);
        for (position, gradient) in fluid.position.iter().zip(gradients) {
            let rate = shear_rate(gradient);
            grid.around(position[0], position[height_axis(D)], reach, |node, own| {
                weight[node] += own;
                diffusivity[node] += own * rate;
            });
        }
        for ((diffusivity, weight), length) in diffusivity.iter_mut().zip(weight).zip(&layer.mixing_length) {
            if *weight > 0.0 {
                *diffusivity = eddy_viscosity(*length, *diffusivity / *weight) / self.turbulent_schmidt;
            }
        }
    }

    /// Finds the balance of every column: p′, φ* and the force of the eddies.
    pub(crate) fn balance(&mut self, grid: &ColumnGrid, nodes: &mut Nodes) {
        let density = self.laws.dilatancy.grain_density;
        for column in 0..grid.row.count {
            let range = grid.of_column(column);
            let mut amount = 0.0;
            for node in range.clone() {
                amount += (nodes.mass[node] - nodes.fixed_mass[node]) / density;
                self.present[node] = amount;
            }
            nodes.bridge(grid, column);
            self.seek(grid, nodes, range.start, amount);
            self.load(grid, nodes, range.start, amount);
        }
    }

    /// Seeks the base pressure of an amount of grains `[m]` between 0 and their weight by false position (Illinois).
    fn seek(&mut self, grid: &ColumnGrid, nodes: &mut Nodes, first: usize, amount: f64) {
        let weight = self.laws.submerged_weight * amount;
        let (mut low, mut below) = (0.0, -amount);
        let (mut high, mut above) = (weight, self.march(grid, nodes, first, weight) - amount);
        let (mut found, mut last_was_high) = (above, None);
        for _ in 0..ITERATIONS {
            if found.abs() <= ROUNDING * amount || above <= 0.0 {
                break;
            }
            let middle = (low * above - high * below) / (above - below);
            found = self.march(grid, nodes, first, middle) - amount;
            let is_high = found > 0.0;
            // a side that stays twice running loses half of its value
            let kept = if last_was_high == Some(is_high) { 0.5 } else { 1.0 };
            if is_high {
                (high, above, below) = (middle, found, kept * below);
            } else {
                (low, below, above) = (middle, found, kept * above);
            }
            last_was_high = Some(is_high);
        }
    }

    /// Height of a node's cell `[m]`: of the topmost held one the upper half is free.
    fn height(grid: &ColumnGrid, first: usize, node: usize) -> f64 {
        if node + 1 == first + grid.held { 0.5 * grid.cell } else { grid.cell }
    }

    /// D `[Pa]` between a node and the next one below, at the settling velocity of a solid fraction `[-]`.
    fn dispersion(&self, node: usize, fraction: f64) -> f64 {
        let (below, own) = (self.diffusivity[node - 1], self.diffusivity[node]);
        // none beside a node without eddies
        let diffusivity = if below > 0.0 && own > 0.0 { 2.0 * below * own / (below + own) } else { 0.0 };
        self.laws.submerged_weight * diffusivity / self.laws.settling.at(fraction)
    }

    /// Marches up over a base pressure `[Pa]`: φ* and √p′ of the nodes, and the forces; returns the amount of grains `[m]`.
    fn march(&mut self, grid: &ColumnGrid, nodes: &mut Nodes, first: usize, base: f64) -> f64 {
        let lowest = first + grid.held - 1;
        let weight = self.laws.submerged_weight;
        let (mut pressure, mut lower, mut slope, mut amount, mut lift) = (base, 0.0, 0.0, 0.0, 0.0);
        for node in lowest..first + grid.nodes {
            let height = Self::height(grid, first, node);
            let half = 0.5 * height * weight;
            // w at the face from the two nodes below
            let dispersion = if node == lowest { 0.0 } else { self.dispersion(node, lower + 0.5 * slope) };
            let below = pressure + dispersion * lower;
            let carried = half + dispersion;
            let (root, own) = self.laws.cell(nodes.rate[node.max(lowest + 1)], below, carried * nodes.packing);
            let force = dispersion * (lower - own);
            if node > lowest {
                self.force[node - 1] = 0.5 * (lift + force);
                slope = own - lower;
            }
            (self.root[node], nodes.target[node], lower, lift) = (root, own, own, force);
            pressure = root * root - half * own;
            amount += own * height;
            self.balanced[node] = amount;
        }
        self.force[first + grid.nodes - 1] = 0.5 * lift;
        amount
    }

    /// p′ in the middle and at the upper face of the nodes of a column.
    fn load(&self, grid: &ColumnGrid, nodes: &mut Nodes, first: usize, amount: f64) {
        let weight = self.laws.submerged_weight;
        let least = LEAST_LOAD * weight * amount;
        let (lowest, end) = (first + grid.held - 1, first + grid.nodes);
        for node in lowest..end {
            let middle = self.root[node] * self.root[node];
            let half = |node: usize| 0.5 * Self::height(grid, first, node) * weight * nodes.target[node];
            let above = if node + 1 < end { self.root[node + 1] * self.root[node + 1] + half(node + 1) } else { 0.0 };
            nodes.middle[node] = middle.max(least);
            // half of a face's force is below it
            nodes.load[node] = (0.5 * (middle - half(node) + above)).max(least);
        }
    }

    /// The opposite of the force on the fluid's particles `[N]`.
    pub(crate) fn burden<const D: usize>(&self, grid: &ColumnGrid, fluid: &Phase<D>, reach: f64, burden: &mut [f64]) {
        for (position, burden) in fluid.position.iter().zip(burden) {
            *burden = 0.0;
            grid.around(position[0], position[height_axis(D)], reach, |node, own| {
                *burden -= own / self.weight[node] * self.force[node] * grid.row.width;
            });
        }
    }

    /// Velocity across the bed of a grain at a place `[m/s]`: towards its height in the balance within a time `[s]`.
    pub(crate) fn lift(&self, grid: &ColumnGrid, along: f64, height: f64, time: f64) -> f64 {
        let held = grid.height(grid.held - 1);
        let place = ((height - grid.base) / grid.cell + 0.5).clamp(grid.held as f64 - 1.0, grid.nodes as f64 - 1e-9);
        let cell = place as usize;
        let base = |cell: usize| (grid.height(cell) - 0.5 * grid.cell).max(held);
        let mut way = 0.0;
        for (column, share) in grid.row.weights(along) {
            let of = |values: &[f64], cell: usize| values[column * grid.nodes + cell];
            // the amount below, by straight lines within cells
            let under = |values: &[f64], cell: usize| if cell < grid.held { 0.0 } else { of(values, cell - 1) };
            let part = ((height - base(cell)) / (grid.height(cell) + 0.5 * grid.cell - base(cell))).clamp(0.0, 1.0);
            let amount = under(&self.present, cell) + part * (of(&self.present, cell) - under(&self.present, cell));
            let cells = &self.balanced[column * grid.nodes + grid.held - 1..(column + 1) * grid.nodes];
            let goal = (grid.held - 1 + cells.partition_point(|up| *up < amount)).min(grid.nodes - 1);
            let (from, to) = (under(&self.balanced, goal), of(&self.balanced, goal));
            let part = if to > from { ((amount - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
            way += share * (base(goal) + part * (grid.height(goal) + 0.5 * grid.cell - base(goal)) - height);
        }
        let fastest = self.laws.settling.at(0.0);
        (way / time).clamp(-fastest, fastest)
    }
}
