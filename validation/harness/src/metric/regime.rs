//! In which regime a flow is, by numbers without units, and what is predicted of a value from flows of such regimes.

use serde::{Deserialize, Serialize};

/// Dimensionless numbers of a flow; numbers that a run does not provide are absent.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[must_use]
pub struct FlowRegime {
    /// Height over half width, or length, at the start `[-]`.
    pub aspect_ratio: Option<f64>,
    /// Slope θ of the bed `[°]`.
    pub slope_angle: Option<f64>,
    /// I = U D/(h √(g h)) of the whole flow `[-]`: with its largest root mean square of the speed U over its height h at the start, and
    /// the pressure below it.
    pub inertial_number: Option<f64>,
    /// Diameter of the grains over that height, or over the depth of the flow, D/h `[-]`.
    pub grain_ratio: Option<f64>,
}

/// Names of a regime's numbers, in the order of [`FlowRegime::numbers`].
pub const REGIME_NUMBERS: [&str; 4] = ["a = h/r", "θ [°]", "I", "D/h"];

impl FlowRegime {
    /// Regime of a stream: depth `[m]`, slope tanθ `[-]`, grain diameter `[m]`.
    pub fn of_stream(slope: f64, depth: f64, diameter: f64) -> Self {
        let slope_angle = Some(libm::atan(slope).to_degrees());
        Self { slope_angle, grain_ratio: Some(diameter / depth), ..Self::default() }
    }

    /// Adds what grains of a diameter `[m]` make of a flow that has the height `[m]` at the start and moves at the speed U
    /// `[m/s]` at its fastest, under gravity `[m/s²]`.
    pub fn of_grains(self, diameter: Option<f64>, height: f64, speed: f64, gravity: f64) -> Self {
        let positive = |value: f64| Some(value).filter(|value| value.is_finite() && *value > 0.0);
        let over_height = |diameter: f64| positive(diameter / height);
        let inertia = |diameter: f64| positive(speed * diameter / (height * (gravity * height).sqrt()));
        Self { inertial_number: diameter.and_then(inertia), grain_ratio: diameter.and_then(over_height), ..self }
    }

    /// a, θ `[°]`, I and D/h.
    pub const fn numbers(&self) -> [Option<f64>; 4] {
        [self.aspect_ratio, self.slope_angle, self.inertial_number, self.grain_ratio]
    }

    /// Whether no number of the regime is known.
    pub fn is_unknown(&self) -> bool {
        self.numbers().iter().all(Option::is_none)
    }
}

/// 95 % prediction interval of the true value, from the errors of comparable predictions beside measurements.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PredictionInterval {
    /// Lower bound with 95 % confidence, in the metric's unit.
    pub lower: f64,
    /// Upper bound.
    pub upper: f64,
    /// Comparisons that it rests on.
    pub comparisons: usize,
    /// Relative standard uncertainty by inputs that it holds, root mean square of those comparisons `[-]`; none where it is not known.
    pub input_uncertainty: Option<f64>,
    /// Length `[m]` that a dimensionless value counts; none for others.
    pub unit_length: Option<f64>,
    /// Quantity of the comparisons.
    pub quantity: String,
    /// The flow's own regime.
    pub regime: FlowRegime,
    /// Differences of the flow from those compared, which make the interval an extrapolation.
    pub warnings: Vec<String>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_numbers_of_a_flow_follow_from_its_lengths() {
        let regime = FlowRegime { aspect_ratio: Some(2.0), ..FlowRegime::default() };
        // U = √(g h): I = D/h
        let speed = (9.81_f64 * 0.1).sqrt();
        let flow = regime.of_grains(Some(1e-3), 0.1, speed, 9.81);
        assert!(flow.inertial_number.is_some_and(|inertia| (inertia - 0.01).abs() < 1e-12));
        assert!(flow.grain_ratio.is_some_and(|ratio| (ratio - 0.01).abs() < 1e-12));
        assert_eq!(flow.numbers()[..2], [Some(2.0), None]);
        // a liquid has no grains, and what stands no inertia
        assert_eq!(regime.of_grains(None, 0.1, speed, 9.81), regime);
        assert_eq!(regime.of_grains(Some(1e-3), 0.1, 0.0, 9.81).inertial_number, None);
        assert!(FlowRegime::default().is_unknown() && !regime.is_unknown());
    }
}
