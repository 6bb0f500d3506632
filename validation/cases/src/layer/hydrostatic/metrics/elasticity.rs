//! The grains below their yield: what a layer at rest is held by, and cannot tell, because its stress neither grows nor turns.

use super::{ELASTIC_SHEAR_ERROR, STRESS_ROTATION_ERROR};
use crate::metric::{Limit, Metric, Variant};
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::vector::Tensor;
use std::f64::consts::PI;

/// Pressure `[Pa]` and elastic shear modulus `[Pa]`: stresses of 1 Pa are far below the yield.
const PRESSURE: f64 = 1e3;
const SHEAR_MODULUS: f64 = 1e5;

/// Steps of an eighth of a turn.
const STEPS: u32 = 1000;

/// Both metrics of the grains' law; none for a law that carries no stress along.
pub(super) fn all(law: &Rheology) -> Vec<Metric> {
    if !law.is_plastic() {
        return Vec::new();
    }
    let variant = Variant::of("material", law.name().replace('-', "_"));
    vec![
        ELASTIC_SHEAR_ERROR
            .of(&variant, 100.0 * (sheared(law) - 1.0))
            .exactly(0.0, "τ = G γ in simple shear below the yield")
            .gated(
                Limit::Within(-1e-6, 1e-6),
                "1e-6 %: one small step of Hooke's law is exact but for rounding and 1e-8 % (strain squared)",
            )
            .with_snapshot_tolerance(0.0, 1e-6),
        STRESS_ROTATION_ERROR
            .of(&variant, 100.0 * turned(law))
            .exactly(0.0, "s = R s₀ Rᵀ after an eighth of a turn: a rigid rotation changes no stress but its direction")
            .gated(Limit::AtMost(0.5), "0.5 %: four times the 0.12 % expected of a thousand explicit steps of π/4000")
            .with_snapshot_tolerance(0.0, 1e-4),
    ]
}

/// Shear stress after a shear strain of 1e-5 over G γ `[-]`.
fn sheared(law: &Rheology) -> f64 {
    let (strain, time_step) = (1e-5, 1e-3);
    let gradient = Tensor::<2>::new(0.0, strain / time_step, 0.0, 0.0);
    let stress = law.updated_stress(&Tensor::<2>::zeros(), &gradient, PRESSURE, SHEAR_MODULUS, time_step);
    stress[(0, 1)] / (SHEAR_MODULUS * strain)
}

/// How far a shear stress is from what an eighth of a turn makes of it, over its size `[-]`.
fn turned(law: &Rheology) -> f64 {
    let start = Tensor::<2>::new(0.6, 0.8, 0.8, -0.6);
    let spin = 0.25 * PI;
    // v = ω × x: ∂_y u = −ω, ∂_x v = ω, over one second
    let gradient = Tensor::<2>::new(0.0, -spin, spin, 0.0);
    let step =
        |stress: Tensor<2>, _| law.updated_stress(&stress, &gradient, PRESSURE, SHEAR_MODULUS, 1.0 / f64::from(STEPS));
    let end = (0..STEPS).fold(start, step);
    // a deviator turns by twice the angle: (a, b) to (−b, a)
    let expected = Tensor::<2>::new(-0.8, 0.6, 0.6, 0.8);
    (end - expected).norm() / start.norm()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::Verdict;
    use crate::reference::grains::GLASS_BEADS;
    use bagnold_solver::material::rheology::Newtonian;

    #[test]
    fn grains_below_their_yield_are_elastic_and_their_stress_turns_with_them() {
        let metrics = all(&Rheology::MuI(GLASS_BEADS.law));
        assert_eq!(metrics.len(), 2);
        for metric in metrics {
            assert_eq!(metric.verdict(), Verdict::Pass, "{} = {}", metric.name, metric.value);
        }
        assert!(all(&Rheology::Newtonian(Newtonian { viscosity: 1.0 })).is_empty());
    }
}
