//! Morsi & Alexander (1972), J. Fluid Mech. 55, 193: C_d = K1/R + K2/R² + K3 of a sphere alone, in rows up to R = 50 000.
//!
//! The rows are those of the bed-load paper's (29); in the last one K2 is 5.4167e6 (one print has 5.4157e6). They meet
//! within 0.4 %, at R = 10 000 within 2.3 % only: there the coefficient falls. Beyond the table the last row continues, as
//! a number to stop by and not as a drag. R → 0 is Stokes' drag, C_d R = 24 exactly below R = 0.1.

/// Reynolds number `[-]` at which the table ends.
pub(super) const LARGEST_REYNOLDS: f64 = 50_000.0;

/// Stokes' drag: C_d R `[-]` below the first joint.
const STOKES: f64 = 24.0;
const STOKES_END: f64 = 0.1;

/// Rows from 0.1 on: the Reynolds number at which the row ends, K1, K2, K3, all `[-]`.
const ROWS: [(f64, f64, f64, f64); 7] = [
    (1.0, 22.73, 0.0903, 3.69),
    (10.0, 29.1667, -3.8889, 1.222),
    (100.0, 46.5, -116.67, 0.6167),
    (1000.0, 98.33, -2778.0, 0.3644),
    (5000.0, 148.62, -4.75e4, 0.357),
    (10_000.0, -490.546, 57.87e4, 0.46),
    (LARGEST_REYNOLDS, -1662.5, 5.4167e6, 0.5191),
];

/// C_d R `[-]` at a Reynolds number `[-]`: K1 + K2/R + K3 R.
#[inline]
pub(super) fn drag_times_reynolds(reynolds: f64) -> f64 {
    if reynolds < STOKES_END {
        return STOKES;
    }
    let mut row = 0;
    while row + 1 < ROWS.len() && reynolds >= ROWS[row].0 {
        row += 1;
    }
    let (_, k1, k2, k3) = ROWS[row];
    k1 + k2 / reynolds + k3 * reynolds
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::drag::schiller_naumann;

    fn drag_coefficient(reynolds: f64) -> f64 {
        drag_times_reynolds(reynolds) / reynolds
    }

    #[test]
    fn gives_the_check_value() {
        // 98.33/200 − 2778/200² + 0.3644 = 0.49165 − 0.06945 + 0.3644
        assert!((drag_coefficient(200.0) - 0.7866).abs() < 1e-12);
    }

    #[test]
    fn rows_meet() {
        let joints = [STOKES_END].into_iter().chain(ROWS[..6].iter().map(|row| row.0));
        for joint in joints {
            let jump = drag_coefficient(joint) / drag_coefficient(joint.next_down()) - 1.0;
            let limit = if joint == 10_000.0 { 0.0234 } else { 0.004 };
            assert!(jump.abs() < limit, "R = {joint}: {jump}");
        }
    }

    #[test]
    fn a_wrong_digit_in_the_last_row_would_show() {
        // −0.16625 + 0.054167 + 0.5191 at 10 000, −0.03325 + 0.00216668 + 0.5191 at 50 000
        assert!((drag_coefficient(10_000.0) - 0.407_017).abs() < 1e-12);
        assert!((drag_coefficient(50_000.0) - 0.488_016_68).abs() < 1e-12);
    }

    #[test]
    fn agrees_with_the_other_fit_of_the_same_drag() {
        // Two fits of the standard drag curve differ by a few per cent: a wrong row would differ by much more.
        let mut reynolds = 1e-3;
        while reynolds < 1000.0 {
            let ratio = drag_times_reynolds(reynolds) / schiller_naumann::drag_times_reynolds(reynolds);
            assert!((ratio - 1.0).abs() < 0.08, "R = {reynolds}: {ratio}");
            reynolds *= 1.1;
        }
    }
}
