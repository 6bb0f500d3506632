//! Grids, Latin hypercubes and Sobol points.

use bagnold_inference::sampling::design::{full_grid, latin_hypercube, sobol};

#[test]
fn a_grid_has_all_combinations() {
    let points = full_grid(&[3, 1, 2]);
    assert_eq!(points.len(), 6);
    assert_eq!(points[0], [0.0, 0.5, 0.0]);
    assert_eq!(points[3], [0.5, 0.5, 1.0]);
    assert_eq!(points[5], [1.0, 0.5, 1.0]);
}

#[test]
fn a_latin_hypercube_fills_every_slice_once() {
    let points = latin_hypercube(13, 4, 7);
    for k in 0..4 {
        let mut slices: Vec<usize> = points.iter().map(|point| (13.0 * point[k]) as usize).collect();
        slices.sort_unstable();
        assert_eq!(slices, (0..13).collect::<Vec<_>>());
    }
    assert_eq!(points, latin_hypercube(13, 4, 7));
    assert_ne!(points, latin_hypercube(13, 4, 8));
}

/// Sixteen points of a Sobol sequence are a net: each of the 16 boxes 1 × 1/16, 1/2 × 1/8 … holds one.
#[test]
fn a_sobol_sequence_is_evenly_spread() {
    for seed in 0..5 {
        let points = sobol(16, 2, seed);
        for power in 0..5 {
            let (across, along) = (1 << power, 16 >> power);
            let cell = |p: &Vec<f64>| (p[0] * f64::from(across)) as i32 * along + (p[1] * f64::from(along)) as i32;
            let mut cells: Vec<i32> = points.iter().map(cell).collect();
            cells.sort_unstable();
            assert_eq!(cells, (0..16).collect::<Vec<_>>());
        }
    }
}

#[test]
fn a_sobol_sequence_is_continued() {
    assert_eq!(sobol(20, 3, 9)[..10], sobol(10, 3, 9));
    assert!(sobol(1000, 3, 9).iter().flatten().all(|u| (0.0..=1.0).contains(u)));
}
