//! Scatter of points about an unknown smooth curve: about the line through their neighbours.

/// Standard deviation of independent scatter of the ordinates, from the distance of each inner point to the straight line through
/// its two neighbours, in the unit of y; none for fewer than three points of rising abscissa.
///
/// With the weights w and 1 − w of the neighbours that distance has the variance σ² (1 + w² + (1 − w)²). A curve's own bend
/// between neighbours counts as scatter, so that it is an upper bound.
#[must_use]
pub fn neighbour_scatter(points: &[(f64, f64)]) -> Option<f64> {
    let square = |three: &[(f64, f64)]| {
        let [(x0, y0), (x, y), (x1, y1)] = [three[0], three[1], three[2]];
        let weight = (x - x0) / (x1 - x0);
        let distance = y - (1.0 - weight) * y0 - weight * y1;
        distance * distance / (1.0 + weight * weight + (1.0 - weight) * (1.0 - weight))
    };
    let squares: Vec<f64> = points.windows(3).map(square).collect();
    let mean = squares.iter().sum::<f64>() / squares.len() as f64;
    mean.is_finite().then(|| mean.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
