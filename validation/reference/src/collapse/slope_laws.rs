//! Laws of granular flow and deposit on an incline: run-out of a collapse, thickness of flow and of deposit.
//!
//! Angles in `[rad]`, lengths in the unit of what is given.

use crate::evidence::read_shipped;
use crate::grains::{GLASS_BEADS, GLASS_BEADS_FLOW_RULE};
use crate::metric::Confidence;
use std::sync::LazyLock;

/// Published values of the experiment on a slope (Mangeney et al. 2010).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SlopeExperiment {
    /// Coefficients k of the run-out law `[-]`: the lower and the upper quotation.
    pub run_out_coefficients: (f64, f64),
    /// Confidence in the coefficients.
    pub confidence: Confidence,
    /// Angle of repose of its beads `[°]`.
    pub repose_angle: f64,
}

/// The experiment, from `reference-data/incline-collapse`.
pub static SLOPE_EXPERIMENT: LazyLock<SlopeExperiment> = LazyLock::new(|| {
    let (run_out_coefficients, confidence) = read_shipped("incline-collapse/run-out.csv", |table| {
        let coefficient = |quotation| table.number_of("quotation", quotation, "coefficient");
        Ok(((coefficient("lower")?, coefficient("upper")?), table.metadata.confidence))
    });
    let repose_angle =
        read_shipped("incline-collapse/experiment.csv", |table| table.number_of("what", "angle of repose", "value"));
    SlopeExperiment { run_out_coefficients, confidence, repose_angle }
});

/// Displacement of the front of a collapse on a slope, x_f = h_0 · 2k/(tanδ − tanθ), with friction tanδ and a
/// coefficient k (Mangeney et al. 2010, as two later works quote it). None from θ = δ on: no deposit.
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
    /// The incline under the glass beads of Table 1.
    pub fn of_glass_beads() -> Self {
        let law = GLASS_BEADS.law;
        Self {
            length_scale: GLASS_BEADS_FLOW_RULE.deposit_length * law.grain_diameter,
            static_friction: law.static_friction,
            limiting_friction: law.limiting_friction,
        }
    }

    /// Thickness h_stop(θ) `[m]` of the deposit that a steady flow leaves; none outside of μ_s < tanθ < μ_2.
    pub fn deposit_thickness(&self, slope_angle: f64) -> Option<f64> {
        let tangent = libm::tan(slope_angle);
        (tangent > self.static_friction && tangent < self.limiting_friction)
            .then(|| self.length_scale * (self.limiting_friction - tangent) / (tangent - self.static_friction))
    }

    /// Angle `[rad]` at which a deposit of a given thickness `[m]` stops: h_stop solved for θ.
    pub fn stopping_angle(&self, thickness: f64) -> f64 {
        let (l, h) = (self.length_scale, thickness);
        libm::atan((l * self.limiting_friction + h * self.static_friction) / (l + h))
    }

    /// Thickness `[m]` of the flow of a collapse from a height h_0 `[m]`, (44) as reconstructed:
    /// h_s = h_0^{3/5} [L (μ_2 − tanθ)/(tanθ − μ_s)]^{2/5}.
    pub fn flow_thickness(&self, initial_height: f64, slope_angle: f64) -> Option<f64> {
        let deposit = self.deposit_thickness(slope_angle)?;
        Some(libm::pow(initial_height, 0.6) * libm::pow(deposit, 0.4))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::evidence::shipped_table;

    #[test]
    fn the_tabulated_thicknesses_come_out() {
        let column =
            |file: &str, name: &str| shipped_table(file).expect("readable").numbers(name).expect("there").to_vec();
        let angles = column("flow-thickness/estimate.csv", "slope angle");
        assert_eq!(angles, column("bagnold/thickness.csv", "slope angle"));
        let flows = column("flow-thickness/estimate.csv", "flow thickness");
        let deposits = column("bagnold/thickness.csv", "deposit thickness");
        for ((angle, flow), deposit) in angles.into_iter().zip(flows).zip(deposits) {
            let found = (
                RoughIncline::of_glass_beads().flow_thickness(0.14, angle.to_radians()),
                RoughIncline::of_glass_beads().deposit_thickness(angle.to_radians()),
            );
            let (Some(thickness), Some(left)) = found else { panic!("{found:?}") };
            assert!((thickness - flow).abs() < 1e-4, "{thickness} m at {angle}°");
            assert!((left - 1e-3 * deposit).abs() < 1e-5, "{left} m at {angle}°");
            assert!((RoughIncline::of_glass_beads().stopping_angle(left).to_degrees() - angle).abs() < 1e-9);
        }
        assert_eq!(RoughIncline::of_glass_beads().deposit_thickness(0.3), None);
        assert_eq!(RoughIncline::of_glass_beads().flow_thickness(0.14, 0.6), None);
        // the paper: about 5 cm at 22°
        let stated = column("flow-thickness/statements.csv", "thickness")[0];
        let computed =
            RoughIncline::of_glass_beads().flow_thickness(0.14, 22f64.to_radians()).map(|thickness| 100.0 * thickness);
        assert!(computed.is_some_and(|computed| (computed - stated).abs() < 0.5), "{computed:?}");
        assert_eq!(SLOPE_EXPERIMENT.run_out_coefficients, (0.4, 0.5));
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
