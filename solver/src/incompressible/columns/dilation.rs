//! Dilation as a constraint on the motion across the bed: a column swells or shrinks towards φ* = φ_max/(1 + B I),
//!
//! ∂_z w = (φ − φ*)/(T max(φ, φ*)), w = 0 at the top of the held grains.
//!
//! Grains keep their order and do not jostle. T is a numerical time: where the flow is steady φ is φ* whatever it is.

use super::grid::ColumnGrid;

/// w `[m/s]` at the face above every node of a column, by its φ and what that tends to `[-]`, shape `[nodes]`, within T `[s]`.
pub(crate) fn find_lifts(grid: &ColumnGrid, (fraction, target): (&[f64], &[f64]), time: f64, lifts: &mut [f64]) {
    let mut lift = 0.0;
    for (node, face) in lifts.iter_mut().enumerate() {
        let (fraction, target) = (fraction[node], target[node]);
        let larger = fraction.max(target);
        if node + 1 >= grid.held && larger > 0.0 {
            // the lower half of the topmost held cell is filled by what is held
            let height = if node + 1 == grid.held { 0.5 * grid.cell } else { grid.cell };
            lift += (fraction - target) / larger / time * height;
        }
        *face = lift;
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::stratification::ColumnRow;
    use super::*;

    #[test]
    fn a_column_at_its_fraction_rests_and_a_dense_one_swells() {
        let grid = ColumnGrid::over(ColumnRow { count: 1, width: 0.01, left: 0.0 }, 5e-4, (-0.005, -0.002), 0.01);
        let mut lifts = vec![f64::NAN; grid.nodes];
        let of = |fraction: f64, lifts: &mut [f64]| {
            let (fraction, target) = (vec![fraction; grid.nodes], vec![0.5; grid.nodes]);
            find_lifts(&grid, (&fraction, &target), 0.02, lifts);
        };
        of(0.5, &mut lifts);
        assert!(lifts.iter().all(|lift| *lift == 0.0));
        of(0.6, &mut lifts);
        assert!(lifts[..grid.held - 1].iter().all(|lift| *lift == 0.0));
        // ∂_z w = 0.1/0.6/0.02 s over the height above the held grains
        for node in grid.held - 1..grid.nodes {
            let expected = 0.1 / 0.6 / 0.02 * (grid.height(node) + 0.5 * grid.cell + 0.002);
            assert!((lifts[node] - expected).abs() < 1e-14, "{node}: {} or {expected}", lifts[node]);
        }
    }
}
