//! Rank correlation of known orders.

use bagnold_inference::statistics::rank_correlation;

#[test]
fn pairs_that_rise_together_have_one_and_opposite_ones_minus_one() {
    let rising: Vec<(f64, f64)> = (0..9).map(|k| (f64::from(k), f64::from(k).exp())).collect();
    assert!((rank_correlation(&rising).expect("a value") - 1.0).abs() < 1e-15);
    let falling: Vec<(f64, f64)> = rising.iter().map(|&(a, b)| (a, -b)).collect();
    assert!((rank_correlation(&falling).expect("a value") + 1.0).abs() < 1e-15);
}

/// Without equal values it is 1 − 6 Σd²/(n³ − n): here Σd² = 8 and n = 5.
#[test]
fn differences_of_ranks_give_the_textbook_value() {
    let pairs = [(10.0, 2.0), (20.0, 1.0), (30.0, 4.0), (40.0, 3.0), (50.0, 5.0)];
    assert!((rank_correlation(&pairs).expect("a value") - 0.8).abs() < 1e-15);
    let farther = [(10.0, 3.0), (20.0, 1.0), (30.0, 2.0), (40.0, 5.0), (50.0, 4.0)];
    assert!((rank_correlation(&farther).expect("a value") - (1.0 - 6.0 * 8.0 / 120.0)).abs() < 1e-15);
}

/// Ranks (0, 1.5, 1.5, 3) and (0, 1, 2, 3): Pearson's coefficient is 4.5/√(4.5 · 5).
#[test]
fn equal_values_share_a_rank() {
    let pairs = [(1.0, 1.0), (2.0, 2.0), (2.0, 3.0), (3.0, 4.0)];
    let expected = 4.5 / (4.5_f64 * 5.0).sqrt();
    assert!((rank_correlation(&pairs).expect("a value") - expected).abs() < 1e-15);
}

#[test]
fn empty_description_gives_no_text() {
    assert_eq!(rank_correlation(&[(1.0, 1.0), (2.0, 2.0)]), None);
    assert_eq!(rank_correlation(&[(1.0, 1.0), (1.0, 2.0), (1.0, 3.0)]), None);
    assert_eq!(rank_correlation(&[(1.0, 1.0), (f64::NAN, 2.0), (1.0, 3.0)]), None);
}
