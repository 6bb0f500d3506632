//! Positions of the columns' nodes, and the hat weights by which particles and nodes share.
//!
//! Nodes lie Δ apart along the height and a column's width apart along the bed. A hat is 1 at its node and falls to 0 at
//! the next one, so that the weights of a particle sum to one: what it gives to the nodes is what it has.

use super::super::stratification::ColumnRow;

/// Nodes of all columns; node k of column c has the index c × nodes + k.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ColumnGrid {
    /// The columns along the bed.
    pub row: ColumnRow,
    /// Height of the lowest node `[m]`.
    pub(crate) base: f64,
    /// Distance Δ of two nodes `[m]`.
    pub(crate) cell: f64,
    /// Nodes of a column.
    pub(crate) nodes: usize,
    /// Lowest nodes of a column that are held; the topmost of them lies on the top of the held grains.
    pub(crate) held: usize,
}

impl ColumnGrid {
    /// Columns of nodes Δ apart that reach from below the held grains, which fill `held` (lower and upper end) `[m]`, up to
    /// a height `[m]`.
    pub(crate) fn over(row: ColumnRow, cell: f64, held: (f64, f64), top: f64) -> Self {
        let (lowest, highest) = held;
        // one more node, so that the lowest hat is whole
        let below = ((highest - lowest) / cell).ceil() as usize + 1;
        let base = highest - below as f64 * cell;
        let nodes = ((top - base) / cell).ceil().max((below + 1) as f64) as usize + 1;
        Self { row, base, cell, nodes, held: below + 1 }
    }

    /// Nodes of all columns.
    pub(crate) fn len(&self) -> usize {
        self.row.count * self.nodes
    }

    /// The same node in the columns before and after that of a node, around the period.
    pub(crate) fn beside(&self, node: usize) -> (usize, usize) {
        let all = self.len();
        ((node + all - self.nodes) % all, (node + self.nodes) % all)
    }

    /// Height of a node of any column `[m]`.
    pub(crate) fn height(&self, node: usize) -> f64 {
        self.base + node as f64 * self.cell
    }

    /// Indices of the nodes of a column.
    pub(crate) fn of_column(&self, column: usize) -> std::ops::Range<usize> {
        column * self.nodes..(column + 1) * self.nodes
    }

    /// The nodes around a place along the bed and a height `[m]` with their weights `[-]`; beyond the ends the last node.
    #[inline]
    pub(crate) fn weights(&self, along: f64, height: f64) -> [(usize, f64); 4] {
        let place = ((height - self.base) / self.cell).clamp(0.0, (self.nodes - 1) as f64);
        let lower = (place as usize).min(self.nodes - 2);
        let part = place - lower as f64;
        let [(a, of_a), (b, of_b)] = self.row.weights(along);
        let (a, b) = (a * self.nodes + lower, b * self.nodes + lower);
        [(a, of_a * (1.0 - part)), (a + 1, of_a * part), (b, of_b * (1.0 - part)), (b + 1, of_b * part)]
    }

    /// Visits the nodes that water at a place along the bed and a height reaches, with its weights > 0 `[-]`: the columns'
    /// hats, and a triangle of a half width over the height `[m]`.
    #[inline]
    pub(crate) fn around(&self, along: f64, height: f64, reach: f64, mut visit: impl FnMut(usize, f64)) {
        let first = ((height - reach - self.base) / self.cell).ceil().max(0.0) as usize;
        for (column, of_column) in self.row.weights(along) {
            if of_column == 0.0 {
                continue;
            }
            for k in first..self.nodes {
                let of_height = 1.0 - (height - self.height(k)).abs() / reach;
                if of_height <= 0.0 && self.height(k) > height {
                    break;
                }
                let weight = of_column * of_height;
                if weight > 0.0 {
                    visit(column * self.nodes + k, weight);
                }
            }
        }
    }

    /// A field of the nodes at a place along the bed and a height `[m]`.
    #[inline]
    pub(crate) fn at(&self, values: &[f64], along: f64, height: f64) -> f64 {
        self.weights(along, height).iter().fold(0.0, |sum, (node, weight)| sum + weight * values[*node])
    }
}

/// Integral of the hat 1 − |x| from −∞ to x `[-]`.
pub(crate) fn ramp(x: f64) -> f64 {
    let x = x.clamp(-1.0, 1.0);
    0.5 + x - 0.5 * x * x.abs()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(columns: usize) -> ColumnGrid {
        let row = ColumnRow { count: columns, width: 0.01, left: 0.0 };
        ColumnGrid::over(row, 5e-4, (-0.019, -0.012), 0.046)
    }

    #[test]
    fn the_topmost_held_node_lies_on_the_top_of_the_held_grains() {
        let grid = grid(1);
        assert!((grid.height(grid.held - 1) + 0.012).abs() < 1e-15);
        assert!(grid.height(0) < -0.019 && grid.height(grid.nodes - 1) >= 0.046);
    }

    #[test]
    fn weights_sum_to_one_and_carry_straight_lines() {
        for columns in [1, 2, 5] {
            let grid = grid(columns);
            let heights: Vec<f64> = (0..grid.len()).map(|node| grid.height(node % grid.nodes)).collect();
            for k in 0..200 {
                let (along, height) = (0.0123 * f64::from(k), -0.015 + 2.9e-4 * f64::from(k));
                let sum: f64 = grid.weights(along, height).iter().map(|(_, weight)| weight).sum();
                assert!((sum - 1.0).abs() < 1e-14);
                assert!((grid.at(&heights, along, height) - height).abs() < 1e-15);
            }
        }
    }

    #[test]
    fn beyond_its_ends_a_column_goes_on() {
        let grid = grid(1);
        let heights: Vec<f64> = (0..grid.len()).map(|node| grid.height(node)).collect();
        assert_eq!(grid.at(&heights, 0.0, -1.0), grid.height(0));
        assert!((grid.at(&heights, 0.0, 1.0) - grid.height(grid.nodes - 1)).abs() < 1e-15);
    }

    #[test]
    fn the_hat_has_the_area_one() {
        assert_eq!((ramp(-2.0), ramp(0.0), ramp(2.0)), (0.0, 0.5, 1.0));
        assert!((ramp(0.5) - 0.875).abs() < 1e-15);
    }
}
