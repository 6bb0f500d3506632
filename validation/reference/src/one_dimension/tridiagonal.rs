//! Tridiagonal systems by elimination without pivoting.

/// Solves l_i x_{i−1} + d_i x_i + u_i x_{i+1} = r_i; of `lower` the first and of `upper` the last entry are not read. Stable for
/// diagonally dominant systems.
pub(crate) fn solve(lower: &[f64], diagonal: &[f64], upper: &[f64], right: &[f64]) -> Vec<f64> {
    let count = diagonal.len();
    let (mut pivots, mut values) = (diagonal.to_vec(), right.to_vec());
    for i in 1..count {
        let factor = lower[i] / pivots[i - 1];
        pivots[i] -= factor * upper[i - 1];
        values[i] -= factor * values[i - 1];
    }
    for i in (0..count).rev() {
        let above = if i + 1 < count { upper[i] * values[i + 1] } else { 0.0 };
        values[i] = (values[i] - above) / pivots[i];
    }
    values
}

#[cfg(test)]
mod tests {
    use super::solve;

    #[test]
    fn the_product_of_the_solution_is_the_right_side() {
        let (lower, diagonal, upper) = ([9.0, 1.0, -2.0, 0.5], [4.0, 5.0, -6.0, 3.0], [1.0, 2.0, -1.5, 9.0]);
        let x = solve(&lower, &diagonal, &upper, &[1.0, -2.0, 3.0, 0.25]);
        let row = |i: usize| {
            let below = if i > 0 { lower[i] * x[i - 1] } else { 0.0 };
            below + diagonal[i] * x[i] + if i < 3 { upper[i] * x[i + 1] } else { 0.0 }
        };
        for (i, expected) in [1.0, -2.0, 3.0, 0.25].into_iter().enumerate() {
            assert!((row(i) - expected).abs() < 1e-14, "{} for {expected}", row(i));
        }
    }
}
