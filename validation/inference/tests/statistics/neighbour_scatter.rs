//! Scatter of neighbours about a smooth curve.

use bagnold_inference::statistics::neighbour_scatter;

#[test]
fn points_on_a_line_do_not_scatter_and_others_do_by_their_deviation() {
    let line: Vec<(f64, f64)> = [0.0, 1.0, 1.5, 4.0].map(|x| (x, 2.0 - 3.0 * x)).to_vec();
    assert!(neighbour_scatter(&line).expect("four points") < 1e-12);
    assert_eq!(neighbour_scatter(&line[..2]), None);
    // ± s in turn, evenly spaced: each is 2 s from the line through its neighbours, and 4/1.5 s² is its mean square
    let turns: Vec<(f64, f64)> = (0..50).map(|k| (f64::from(k), if k % 2 == 0 { 0.1 } else { -0.1 })).collect();
    assert!((neighbour_scatter(&turns).expect("points") - 0.1 * (4.0_f64 / 1.5).sqrt()).abs() < 1e-12);
    // a generator's even spread of half width 1 has the deviation 1/√3
    let mut state = 1_u64;
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let spread: Vec<(f64, f64)> = (0..4000).map(|k| (f64::from(k), 0.01 * f64::from(k) + next())).collect();
    assert!((neighbour_scatter(&spread).expect("points") * 3.0_f64.sqrt() - 1.0).abs() < 0.05);
}
