//! Laws of granular flow and deposit on an incline: run-out of a collapse, thickness of flow and of deposit.
//!
//! Angles in `[rad]`, lengths in the unit of what is given.

/// Displacement of the front of a collapse on a slope, x_f = h_0 · 2k/(tanδ − tanθ), with friction tanδ and a
/// coefficient k of 0.4 to 0.5 (Mangeney et al. 2010, as two later works quote it). None from θ = δ on: no deposit.
#[must_use]
pub fn slope_run_out(initial_height: f64, slope_angle: f64, friction: f64, k: f64) -> Option<f64> {
    let excess = friction - libm::tan(slope_angle);
    (excess > 0.0).then(|| initial_height * 2.0 * k / excess)
}

/// A rough incline under grains whose deposits obey h_stop(θ) = L (μ_2 − tanθ)/(tanθ − μ_s).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RoughIncline {
    /// Length scale L of the deposit law `[m]`.
    pub length_scale: f64,
    /// Friction coefficient μ_s `[-]`.
    pub static_friction: f64,
    /// Friction coefficient μ_2 `[-]`.
    pub limiting_friction: f64,
}

impl RoughIncline {
    /// Thickness h_stop(θ) `[m]` of the deposit that a steady flow leaves; none outside of μ_s < tanθ < μ_2.
    #[must_use]
    pub fn deposit_thickness(&self, slope_angle: f64) -> Option<f64> {
        let tangent = libm::tan(slope_angle);
        (tangent > self.static_friction && tangent < self.limiting_friction)
            .then(|| self.length_scale * (self.limiting_friction - tangent) / (tangent - self.static_friction))
    }

    /// Angle `[rad]` at which a deposit of a given thickness `[m]` stops: h_stop solved for θ.
    #[must_use]
    pub fn stopping_angle(&self, thickness: f64) -> f64 {
        let (l, h) = (self.length_scale, thickness);
        libm::atan((l * self.limiting_friction + h * self.static_friction) / (l + h))
    }

    /// Thickness `[m]` of the flow of a collapse from a height h_0 `[m]`, (44) as reconstructed:
    /// h_s = h_0^{3/5} [L (μ_2 − tanθ)/(tanθ − μ_s)]^{2/5}.
    #[must_use]
    pub fn flow_thickness(&self, initial_height: f64, slope_angle: f64) -> Option<f64> {
        let deposit = self.deposit_thickness(slope_angle)?;
        Some(libm::pow(initial_height, 0.6) * libm::pow(deposit, 0.4))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GLASS: RoughIncline =
        RoughIncline { length_scale: 1.65 * 0.5e-3, static_friction: 0.382, limiting_friction: 0.643 };

    #[test]
    fn the_figures_of_the_model_notes_come_out() {
        for (angle, flow, deposit) in
            [(22.0_f64, 4.66e-2, 8.95e-3), (23.0, 3.46e-2, 4.24e-3), (24.0, 2.83e-2, 2.58e-3), (25.0, 2.41e-2, 1.73e-3)]
        {
            let found = (GLASS.flow_thickness(0.14, angle.to_radians()), GLASS.deposit_thickness(angle.to_radians()));
            let (Some(thickness), Some(left)) = found else { panic!("{found:?}") };
            assert!((thickness - flow).abs() < 1e-4, "{thickness} m at {angle}°");
            assert!((left - deposit).abs() < 1e-5, "{left} m at {angle}°");
            assert!((GLASS.stopping_angle(left).to_degrees() - angle).abs() < 1e-9);
        }
        assert_eq!(GLASS.deposit_thickness(0.3), None);
        assert_eq!(GLASS.flow_thickness(0.14, 0.6), None);
    }

    #[test]
    fn a_front_runs_without_end_at_the_friction_angle() {
        let at = |degrees: f64| slope_run_out(0.14, degrees.to_radians(), 0.382, 0.5);
        assert_eq!(at(0.0), Some(0.14 / 0.382));
        let steep = at(20.0).unwrap_or(0.0);
        assert!(steep > 7.0 && steep < 8.0, "{steep}");
        assert_eq!(at(21.0), None);
    }
}
