//! The closures that the layer takes from the solver, or shares with its particles, as they are printed.

use crate::metric::Metric;
use crate::shared::printed_laws;
use bagnold_solver::material::dilatancy::Dilatancy;
use bagnold_solver::material::rheology::{RootMuI, ViscousLaw};
use bagnold_solver::material::suspension_viscosity::SuspensionViscosity;
use bagnold_solver::material::turbulence::StratifiedMixingLength;

/// The places are those of `reference-data/bed-load/laws.csv`.
pub(super) fn metrics() -> Vec<Metric> {
    let dilatancy = Dilatancy { dilation: 0.31, packing: 0.6, grain_diameter: 5e-3, grain_density: 2600.0 };
    let friction = RootMuI {
        static_friction: 0.35,
        limiting_friction: 0.97,
        reference_inertia: 0.69,
        grain_diameter: 5e-3,
        grain_density: 2600.0,
        regularisation_rate: 5e-3,
    };
    let mixing = StratifiedMixingLength { packing: 0.6, depth: 0.046 };
    printed_laws::metrics(
        "bed-load/laws.csv",
        &[
            ("suspension_viscosity", SuspensionViscosity::default().relative(0.2)),
            ("dilatancy", dilatancy.sheared_fraction(20.0, 26.0)),
            ("root_mu_i", friction.viscosity(20.0, 26.0)),
            ("stratified_mixing_length", 1e3 * mixing.length(0.01, mixing.room(0.3, 0.01))),
        ],
    )
}

#[cfg(test)]
mod tests {
    use crate::metric::Verdict;

    #[test]
    fn the_closures_are_as_printed() {
        for metric in super::metrics() {
            assert_eq!(metric.verdict(), Verdict::Pass, "{} is off by {} %", metric.variant, metric.value);
        }
    }
}
