//! A solid fraction over the height that is given and not computed.

use super::profile::LayerState;
use crate::one_dimension::LayerError;

/// φ(z) as straight lines between points; two points at one height make a jump. Beyond its ends it is constant.
#[derive(Debug, Clone, PartialEq)]
pub struct SolidFractionProfile {
    points: Vec<(f64, f64)>,
    /// ∫ φ dz from the first point to each point `[m]`.
    integral: Vec<f64>,
}

impl SolidFractionProfile {
    /// Profile from points (z `[m]`, φ `[-]`) in rising order.
    ///
    /// # Errors
    /// No point, heights that fall, fractions outside [0, 1).
    pub fn new(points: Vec<(f64, f64)>) -> Result<Self, LayerError> {
        if points.is_empty() {
            return Err(LayerError::Parameter { field: "points of φ(z)", value: 0.0, rule: "at least 1" });
        }
        if let Some(pair) = points.windows(2).find(|pair| pair[1].0.is_nan() || pair[1].0 < pair[0].0) {
            let rule = "not below the height before it";
            return Err(LayerError::Parameter { field: "height of φ(z)", value: pair[1].0, rule });
        }
        if let Some(&(_, value)) = points.iter().find(|(_, fraction)| !(0.0..1.0).contains(fraction)) {
            return Err(LayerError::Parameter { field: "solid fraction", value, rule: "in [0, 1)" });
        }
        let mut integral = vec![0.0; points.len()];
        for k in 1..points.len() {
            let ((a, low), (b, high)) = (points[k - 1], points[k]);
            integral[k] = integral[k - 1] + 0.5 * (low + high) * (b - a);
        }
        Ok(Self { points, integral })
    }

    /// The same fraction below z = 0, nothing above.
    ///
    /// # Errors
    /// A fraction outside [0, 1).
    pub fn flat_bed(fraction: f64) -> Result<Self, LayerError> {
        Self::new(vec![(0.0, fraction), (0.0, 0.0)])
    }

    /// A function of the height, sampled at `count` + 1 points between two heights `[m]`.
    ///
    /// # Errors
    /// Values outside [0, 1).
    pub fn sampled(from: f64, to: f64, count: usize, fraction: impl Fn(f64) -> f64) -> Result<Self, LayerError> {
        let height = |k: usize| from + (to - from) * k as f64 / count as f64;
        Self::new((0..=count).map(|k| (height(k), fraction(height(k)))).collect())
    }

    /// Fraction of a computed layer, constant in each of its cells.
    pub fn of_cells(layer: &LayerState) -> Self {
        let half = 0.5 * layer.cell_height;
        let ends = |(&z, &fraction): (&f64, &f64)| [(z - half, fraction), (z + half, fraction)];
        let mut points: Vec<(f64, f64)> = layer.height.iter().zip(&layer.solid_fraction).flat_map(ends).collect();
        // the two names of a face may differ in the last bit
        for k in 1..points.len() {
            points[k].0 = points[k].0.max(points[k - 1].0);
        }
        Self::new(points).expect("a computed layer has rising heights and fractions below 1")
    }

    /// ∫ φ dz from the first point up to a height `[m]`.
    fn integral(&self, height: f64) -> f64 {
        let above = self.points.partition_point(|point| point.0 <= height);
        let (first, last) = (self.points[0], self.points[self.points.len() - 1]);
        if above == 0 {
            return (height - first.0) * first.1;
        }
        if above == self.points.len() {
            return self.integral[above - 1] + (height - last.0) * last.1;
        }
        let ((a, low), (b, high)) = (self.points[above - 1], self.points[above]);
        let part = (height - a) / (b - a);
        self.integral[above - 1] + (height - a) * (low + 0.5 * part * (high - low))
    }

    /// Mean between two heights `[m]`.
    pub fn mean(&self, lower: f64, upper: f64) -> f64 {
        (self.integral(upper) - self.integral(lower)) / (upper - lower)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_are_exact_integrals() {
        let bed = SolidFractionProfile::flat_bed(0.6).expect("valid");
        assert!((bed.mean(-2.0, -1.0) - 0.6).abs() < 1e-15);
        assert!((bed.mean(-1.0, 2.0) - 0.2).abs() < 1e-15);
        assert_eq!(bed.mean(1.0, 2.0), 0.0);
        let ramp = SolidFractionProfile::new(vec![(0.0, 0.0), (1.0, 0.5), (1.0, 0.2), (3.0, 0.2)]).expect("valid");
        // ∫ 0.5 z from ½ to 1 is 3/16, and 0.2 from there to 2
        assert!((ramp.mean(0.5, 2.0) - (0.1875 + 0.2) / 1.5).abs() < 1e-15);
    }

    #[test]
    fn impossible_fractions_are_refused() {
        assert!(SolidFractionProfile::new(Vec::new()).is_err());
        assert!(SolidFractionProfile::new(vec![(0.0, 0.5), (-1.0, 0.5)]).is_err());
        assert!(SolidFractionProfile::new(vec![(0.0, 1.0)]).is_err());
        assert!(SolidFractionProfile::flat_bed(f64::NAN).is_err());
    }
}
