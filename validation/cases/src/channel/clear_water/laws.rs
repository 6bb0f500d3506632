//! The law of the rough wall and the mixing length, which the flow is made with, as they are printed.

use crate::metric::Metric;
use crate::shared::printed_laws;
use bagnold_solver::material::turbulence::{MixingLength, MixingLengthShape, RoughWall};

/// The places are those of `reference-data/clear-water/laws.csv`.
pub(super) fn metrics() -> Vec<Metric> {
    let wall = RoughWall { sand_roughness: 5e-3 };
    let mixing = MixingLength { shape: MixingLengthShape::Parabolic, origin_offset: 0.0 };
    printed_laws::metrics(
        "clear-water/laws.csv",
        &[
            ("rough_wall", wall.velocity(5e-3, 0.1)),
            ("rough_wall_stress", wall.shear_stress(0.5, 2e-3, 1000.0)),
            ("parabolic_mixing_length", 1e3 * mixing.length(0.01, 0.046)),
        ],
    )
}

#[cfg(test)]
mod tests {
    use crate::metric::Verdict;

    #[test]
    fn wall_and_mixing_length_are_as_printed() {
        for metric in super::metrics() {
            assert_eq!(metric.verdict(), Verdict::Pass, "{} is off by {} %", metric.variant, metric.value);
        }
    }
}
