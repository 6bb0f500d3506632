//! Linear least squares between bounds.
//!
//! Source: Stark & Parker, "Bounded-variable least-squares", Computational Statistics 10 (1995) 129.

use nalgebra::{DMatrix, DVector};

/// Singular values below this share of the largest one count as zero.
const RANK_TOLERANCE: f64 = 1e-10;

/// Status of a variable: free, or at its lower or upper bound.
#[derive(Debug, Clone, Copy, PartialEq)]
enum BoundStatus {
    Free,
    Lower,
    Upper,
}

/// x with lower ≤ x ≤ upper that minimises |A x − b|²; where A does not determine it, a small one. `lower` ≤ `upper`.
pub fn box_least_squares(matrix: &DMatrix<f64>, right: &DVector<f64>, lower: &[f64], upper: &[f64]) -> DVector<f64> {
    let count = matrix.ncols();
    let (matrix, right) = reduced(matrix, right);
    let mut place = vec![BoundStatus::Free; count];
    let mut x = DVector::from_fn(count, |k, _| 0.0_f64.clamp(lower[k], upper[k]));
    for k in 0..count {
        if lower[k] == upper[k] {
            place[k] = BoundStatus::Lower;
        }
    }
    let mut blocked = vec![false; count];
    // every pass either frees a variable or binds one; the sum of squares never rises
    for _ in 0..10 * count + 20 {
        let target = unbounded(&matrix, &right, &x, &place);
        let mut share = 1.0_f64;
        for k in 0..count {
            let (from, to) = (x[k], target[k]);
            if place[k] == BoundStatus::Free && !(lower[k]..=upper[k]).contains(&to) {
                let bound = if to < lower[k] { lower[k] } else { upper[k] };
                share = share.min(((bound - from) / (to - from)).max(0.0));
            }
        }
        let mut bound_any = false;
        for k in 0..count {
            if place[k] != BoundStatus::Free {
                continue;
            }
            let moved = x[k] + share * (target[k] - x[k]);
            let room = 1e-14 * (upper[k] - lower[k]);
            if share < 1.0 && target[k] < lower[k] && moved <= lower[k] + room {
                (x[k], place[k], bound_any) = (lower[k], BoundStatus::Lower, true);
            } else if share < 1.0 && target[k] > upper[k] && moved >= upper[k] - room {
                (x[k], place[k], bound_any) = (upper[k], BoundStatus::Upper, true);
            } else {
                x[k] = moved.clamp(lower[k], upper[k]);
            }
        }
        if bound_any {
            continue;
        }
        let force = matrix.tr_mul(&(&right - &matrix * &x));
        let scale = 1e-12 * right.norm() * matrix.norm();
        let pull = |k: usize| match place[k] {
            BoundStatus::Lower => force[k],
            BoundStatus::Upper => -force[k],
            BoundStatus::Free => 0.0,
        };
        let candidate = (0..count)
            .filter(|k| lower[*k] < upper[*k] && !blocked[*k] && pull(*k) > scale)
            .max_by(|a, b| pull(*a).total_cmp(&pull(*b)));
        let Some(released) = candidate else { break };
        // rounding may send it straight back, so each variable is released a limited number of times
        blocked[released] = share < 1.0;
        place[released] = BoundStatus::Free;
    }
    x
}

/// The same problem with no more rows than columns.
fn reduced(matrix: &DMatrix<f64>, right: &DVector<f64>) -> (DMatrix<f64>, DVector<f64>) {
    if matrix.nrows() <= matrix.ncols() {
        return (matrix.clone(), right.clone());
    }
    let factors = matrix.clone().qr();
    let mut rotated = right.clone();
    factors.q_tr_mul(&mut rotated);
    (factors.r(), rotated.rows(0, matrix.ncols()).into_owned())
}

/// The free variables at their least squares, the bound ones where they are.
fn unbounded(matrix: &DMatrix<f64>, right: &DVector<f64>, x: &DVector<f64>, place: &[BoundStatus]) -> DVector<f64> {
    let free: Vec<usize> = (0..place.len()).filter(|k| place[*k] == BoundStatus::Free).collect();
    let mut result = x.clone();
    if free.is_empty() {
        return result;
    }
    let mut fixed = x.clone();
    for k in &free {
        fixed[*k] = 0.0;
    }
    let part = matrix.select_columns(&free);
    let solution =
        least_squares(part, &DMatrix::from_column_slice(right.len(), 1, (right - matrix * fixed).as_slice()));
    for (row, k) in free.iter().enumerate() {
        result[*k] = solution[(row, 0)];
    }
    result
}

/// The smallest X that minimises |A X − B|, by singular values; zero where A is.
pub(super) fn least_squares(matrix: DMatrix<f64>, right: &DMatrix<f64>) -> DMatrix<f64> {
    let columns = matrix.ncols();
    let factors = matrix.svd(true, true);
    let (Some(u), Some(vt)) = (&factors.u, &factors.v_t) else { return DMatrix::zeros(columns, right.ncols()) };
    let largest = factors.singular_values.max();
    let mut projected = u.tr_mul(right);
    for (row, value) in factors.singular_values.iter().enumerate() {
        let inverse = if *value > RANK_TOLERANCE * largest { 1.0 / value } else { 0.0 };
        projected.row_mut(row).scale_mut(inverse);
    }
    vt.tr_mul(&projected)
}
