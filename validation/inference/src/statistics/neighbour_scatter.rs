//! Scatter of points about an unknown smooth curve: about the line through their neighbours.

/// Standard deviation of independent scatter of the ordinates, from the distance of each inner point to the straight line through
/// its two neighbours, in the unit of y; none for fewer than three points of rising abscissa.
///
/// With the weights w and 1 − w of the neighbours that distance has the variance σ² (1 + w² + (1 − w)²). A curve's own bend
/// between neighbours counts as scatter, so that it is an upper bound.
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
