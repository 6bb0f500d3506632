//! Fields of the nodes, gathered from the particles: mass, velocity, φ, the overburden p′ and what φ tends to.

use super::super::height_axis;
use super::grains::Grains;
use super::grid::{ColumnGrid, ramp};
use crate::material::dilatancy::Dilatancy;
use crate::material::suspension_viscosity::SuspensionViscosity;
use crate::vector::Vector;

/// Fields of all nodes; arrays have the shape `[columns × nodes]`.
#[derive(Debug, Default)]
pub(crate) struct Nodes {
    /// Mass of fixed grains per area `[kg/m²]`.
    pub(crate) fixed_mass: Vec<f64>,
    /// Mass per area `[kg/m²]`.
    pub(crate) mass: Vec<f64>,
    /// Velocity along the bed `[m/s]`; of a node without grains that of the next one below.
    pub(crate) velocity: Vec<f64>,
    /// φ `[-]`.
    pub(crate) fraction: Vec<f64>,
    /// φ* `[-]`.
    pub(crate) target: Vec<f64>,
    /// p′ at the face above every node `[Pa]`.
    pub(crate) load: Vec<f64>,
    /// Viscosity that the water between the grains adds to their friction at the face above every node `[Pa·s]`.
    pub(crate) added: Vec<f64>,
    /// p′ in the middle of every node `[Pa]`.
    pub(crate) middle: Vec<f64>,
    /// Shear rate of every node `[1/s]`.
    pub(crate) rate: Vec<f64>,
    /// φ_max `[-]`.
    pub(crate) packing: f64,
}

/// Laws that turn the masses of nodes into their fields.
#[derive(Debug, Clone, Copy)]
pub(crate) struct NodeLaws<'a> {
    pub(crate) dilatancy: &'a Dilatancy,
    /// (ρ_s − ρ_f) g cosθ `[Pa/m]`.
    pub(crate) buoyant_weight: f64,
    pub(crate) suspension_viscosity: &'a SuspensionViscosity,
    /// ρ_f ν `[Pa·s]`.
    pub(crate) fluid_viscosity: f64,
}

impl Nodes {
    /// Nodes with the fixed grains: rows of a spacing `[m]`, each of which fills its height with a fraction φ `[-]`.
    pub(crate) fn with_fixed<const D: usize>(
        grid: &ColumnGrid,
        dilatancy: &Dilatancy,
        (wall, spacing, filling): (&[Vector<D>], f64, f64),
    ) -> Self {
        let count = grid.len();
        let density = dilatancy.grain_density;
        let mut new = Self { fixed_mass: vec![0.0; count], packing: dilatancy.packing, ..Self::default() };
        let fields = [&mut new.mass, &mut new.velocity, &mut new.fraction, &mut new.target];
        for array in fields.into_iter().chain([&mut new.load, &mut new.added, &mut new.middle, &mut new.rate]) {
            array.resize(count, 0.0);
        }
        // a row's mass per height, spread over its height
        let line = density * filling * spacing.powi(D as i32 - 1) / grid.row.width;
        let lowest = wall.iter().fold(f64::INFINITY, |low, place| low.min(place[height_axis(D)]));
        for place in wall {
            let height = place[height_axis(D)];
            // below the lowest row it continues likewise: no eddy finds room there
            let goes_on = height < lowest + 0.5 * spacing;
            for (column, weight) in grid.row.weights(place[0]) {
                for node in 0..grid.nodes {
                    let lower = (height - 0.5 * spacing - grid.height(node)) / grid.cell;
                    let below = if goes_on { 0.0 } else { ramp(lower) };
                    let share = ramp(lower + spacing / grid.cell) - below;
                    new.fixed_mass[column * grid.nodes + node] += weight * share * grid.cell * line;
                }
            }
        }
        new
    }

    /// Whether a node has grains.
    #[inline]
    pub(crate) fn has_grains(&self, node: usize) -> bool {
        self.mass[node] > 0.0
    }

    /// φ, at most φ_max `[-]`.
    #[inline]
    pub(crate) fn bounded_fraction(&self, node: usize) -> f64 {
        self.fraction[node].min(self.packing)
    }

    /// Highest node of a column that has grains, if any, as an index within the column.
    pub(crate) fn top(&self, grid: &ColumnGrid, column: usize) -> Option<usize> {
        self.mass[grid.of_column(column)].iter().rposition(|mass| *mass > 0.0)
    }

    /// Gathers the particles and finds what follows from where they are.
    pub(crate) fn gather<const D: usize>(&mut self, grid: &ColumnGrid, grains: &Grains<D>, laws: NodeLaws<'_>) {
        let normal = height_axis(D);
        self.mass.copy_from_slice(&self.fixed_mass);
        self.velocity.fill(0.0);
        for ((position, velocity), mass) in grains.position.iter().zip(&grains.velocity).zip(&grains.mass) {
            for (node, weight) in grid.weights(position[0], position[normal]) {
                let own = weight * mass / grid.row.width;
                self.mass[node] += own;
                self.velocity[node] += own * velocity[0];
            }
        }
        let density = laws.dilatancy.grain_density;
        let half_load = 0.5 * grid.cell * laws.buoyant_weight;
        for column in 0..grid.row.count {
            let first = grid.of_column(column).start;
            let mut load = 0.0;
            for node in grid.of_column(column).rev() {
                self.load[node] = load;
                load += self.mass[node] * laws.buoyant_weight / density;
                self.fraction[node] = self.mass[node] / (density * grid.cell);
                self.middle[node] = self.load[node] + half_load * self.fraction[node];
            }
            for node in grid.of_column(column) {
                self.velocity[node] = if node < first + grid.held {
                    0.0
                } else if self.mass[node] > 0.0 {
                    self.velocity[node] / self.mass[node]
                } else {
                    self.velocity[node - 1]
                };
            }
            for node in first..grid.of_column(column).end - 1 {
                let fraction = 0.5 * (self.bounded_fraction(node) + self.bounded_fraction(node + 1));
                let added = laws.suspension_viscosity.relative(fraction) - 1.0;
                self.added[node] = (1.0 - fraction) * laws.fluid_viscosity * added;
            }
            self.find_targets(grid, column, laws);
        }
    }

    /// Velocities of nodes without grains between those that have some, by straight lines, and the rates that follow: where
    /// grains are suspended, nothing slides in the gaps between them.
    pub(crate) fn bridge(&mut self, grid: &ColumnGrid, column: usize) {
        let range = grid.of_column(column);
        let Some(top) = self.top(grid, column) else { return };
        let mut last = range.start + grid.held - 1;
        for node in last + 1..=range.start + top {
            if self.has_grains(node) {
                let slope = (self.velocity[node] - self.velocity[last]) / (node - last) as f64;
                for gap in last + 1..node {
                    self.velocity[gap] = self.velocity[last] + slope * (gap - last) as f64;
                }
                last = node;
            }
        }
        let highest = self.velocity[last];
        self.velocity[last..range.end].fill(highest);
        for node in range.start + 1..range.end - 1 {
            self.rate[node] = 0.5 * (self.velocity[node + 1] - self.velocity[node - 1]).abs() / grid.cell;
        }
    }

    /// Force per area of a column `[Pa]` on a node along the bed, −Δ ∂p′/∂x: what makes heaps of grains run apart. Two
    /// columns press on each other by the smaller of their loads, since what stands free is not pressed.
    pub(crate) fn push_of_columns(&self, grid: &ColumnGrid, node: usize) -> f64 {
        let (before, after) = grid.beside(node);
        let between = |other: usize| self.middle[node].min(self.middle[other]);
        (between(before) - between(after)) * grid.cell / grid.row.width
    }

    /// φ* from the mean of the rates at both faces and the load in the middle of each node.
    fn find_targets(&mut self, grid: &ColumnGrid, column: usize, laws: NodeLaws<'_>) {
        let law = laws.dilatancy;
        let nodes = grid.of_column(column);
        let mut below = 0.0;
        for node in nodes.clone() {
            // above the grains there is no rate
            let above = if node + 1 < nodes.end && self.load[node] > 0.0 {
                (self.velocity[node + 1] - self.velocity[node]) / grid.cell
            } else {
                0.0
            };
            let rate = 0.5 * (below + above);
            self.rate[node] = rate.abs();
            self.target[node] = law.sheared_fraction(self.rate[node], self.middle[node]);
            below = above;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::stratification::ColumnRow;
    use super::*;

    #[test]
    fn only_the_lowest_row_of_fixed_grains_goes_on_below() {
        let (spacing, density, filling) = (1e-3, 2600.0, 0.6);
        let row = ColumnRow { count: 1, width: 10.0 * spacing, left: 0.0 };
        let grid = ColumnGrid::over(row, 0.5 * spacing, (0.0, 3.0 * spacing), 6.0 * spacing);
        let dilatancy = Dilatancy { dilation: 0.3, packing: 0.6, grain_diameter: 5e-3, grain_density: density };
        // the second row lies somewhat low
        let heights = [0.5, 1.4, 2.5];
        let wall =
            heights.iter().flat_map(|z| (0..10).map(move |x| Vector::<2>::new(f64::from(x) + 0.5, *z) * spacing));
        let nodes = Nodes::with_fixed(&grid, &dilatancy, (&wall.collect::<Vec<_>>(), spacing, filling));
        let below = 0.5 * grid.cell - grid.base;
        let (mass, expected) = (nodes.fixed_mass.iter().sum::<f64>(), density * filling * (3.0 * spacing + below));
        assert!((mass / expected - 1.0).abs() < 1e-13, "{mass} of {expected} kg/m²");
    }
}
