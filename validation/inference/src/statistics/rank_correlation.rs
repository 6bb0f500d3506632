//! Whether two quantities rise together, whatever the law between them.

/// Spearman's rank correlation of pairs: Pearson's coefficient of their ranks, equal values sharing the mean of theirs.
/// `None` for fewer than three pairs, values that are no numbers, or where all values of one quantity are equal.
#[must_use]
pub fn rank_correlation(pairs: &[(f64, f64)]) -> Option<f64> {
    if pairs.len() < 3 || pairs.iter().any(|(a, b)| !a.is_finite() || !b.is_finite()) {
        return None;
    }
    let (first, second): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
    let (first, second) = (ranks(&first), ranks(&second));
    let middle = 0.5 * (pairs.len() as f64 - 1.0);
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - middle) * (b - middle)).sum::<f64>();
    let spread = product(&first, &first) * product(&second, &second);
    (spread > 0.0).then(|| product(&first, &second) / spread.sqrt())
}

/// Ranks from 0.
fn ranks(values: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..values.len()).collect();
    order.sort_by(|&a, &b| values[a].total_cmp(&values[b]));
    let mut ranks = vec![0.0; values.len()];
    let mut begin = 0;
    for equal in order.chunk_by(|&a, &b| values[a] == values[b]) {
        let rank = begin as f64 + 0.5 * (equal.len() as f64 - 1.0);
        equal.iter().for_each(|&index| ranks[index] = rank);
        begin += equal.len();
    }
    ranks
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
