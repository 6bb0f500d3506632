//! The drag laws themselves, whatever runs were asked for: against the standard drag curve of a sphere, and against slips
//! of suspensions computed outside of the program. The runs are judged by roots of the same functions that drove them,
//! so that they cannot tell a wrong law from a right one.

use super::{DRAG_CURVE_ERROR, LAW_SLIP_ERROR};
use crate::metric::{Confidence, Limit, Metric, Variant};
use crate::reference::settling::{HINDERED_SLIPS, STANDARD_DRAG, SettlingGrains};
use bagnold_solver::material::drag::DragLaw;

/// Laws of one sphere that claim the standard curve: up to which Reynolds number, and within how much `[%]`.
const CURVES: [(DragLaw, f64, f64, &str); 2] = [
    (DragLaw::SchillerNaumann, 500.0, 5.0, "5 %: stated by Clift, Grace & Weber for this fit up to Re = 800"),
    (
        DragLaw::MorsiAlexander,
        40_000.0,
        6.0,
        "6 %: fits to the same experiments differ by 5 %, steps between formula ranges add 1 %",
    ),
];

pub(super) fn all() -> Vec<Metric> {
    let curves = CURVES.iter().map(|&(law, end, limit, reason)| {
        let deviations =
            STANDARD_DRAG.points.iter().filter(|(reynolds, _)| *reynolds <= end).map(|&(reynolds, drag)| {
                law.drag_coefficient(reynolds).map_or(f64::NAN, |coefficient| 100.0 * (coefficient / drag - 1.0))
            });
        DRAG_CURVE_ERROR
            .of(&Variant::of("law", law.name()), largest(deviations))
            .against(Some(0.0), "standard drag curve of a sphere, Clift, Grace & Weber 1978", STANDARD_DRAG.confidence)
            .gated(Limit::AtMost(limit), reason)
            .with_snapshot_tolerance(0.0, 1e-3)
    });
    let slips = DragLaw::ALL.into_iter().map(|law| {
        LAW_SLIP_ERROR
            .of(&Variant::of("law", law.name()), largest(slip_deviations(law)))
            .against(Some(0.0), "the printed law, solved outside of this program", Confidence::High)
            .gated(Limit::AtMost(5e-5), "5e-5 %: half of the table's seventh digit; the formula is the same")
            .with_snapshot_tolerance(0.0, 1e-5)
    });
    curves.chain(slips).collect()
}

/// Slips of a law less those of the table, over them `[%]`.
fn slip_deviations(law: DragLaw) -> impl Iterator<Item = f64> {
    HINDERED_SLIPS.iter().filter(move |row| row.law == law.name()).map(move |row| {
        // with d = ν = ρ_f = 1 and ρ_s = 2 the Archimedes number is g, and a slip is its Reynolds number
        let grains = SettlingGrains {
            grain_diameter: 1.0,
            grain_density: 2.0,
            fluid_density: 1.0,
            kinematic_viscosity: 1.0,
            gravity: row.archimedes_number,
        };
        let slip = grains.hindered_slip(law, row.solid_fraction);
        slip.map_or(f64::NAN, |slip| 100.0 * (slip / row.reynolds - 1.0))
    })
}

/// The largest magnitude; not a number if one of them is none, or if there are none.
fn largest(deviations: impl Iterator<Item = f64>) -> f64 {
    let all: Vec<f64> = deviations.map(f64::abs).collect();
    let known = !all.is_empty() && all.iter().all(|deviation| deviation.is_finite());
    if known { all.into_iter().fold(0.0, f64::max) } else { f64::NAN }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::Verdict;

    #[test]
    fn every_law_is_as_printed() {
        let metrics = all();
        assert_eq!(metrics.len(), CURVES.len() + DragLaw::ALL.len());
        for metric in metrics {
            assert_eq!(metric.verdict(), Verdict::Pass, "{} [{}] = {} %", metric.name, metric.variant, metric.value);
        }
    }

    #[test]
    fn the_largest_deviation_counts() {
        assert_eq!(largest([1.0, -3.0, 2.0].into_iter()), 3.0);
        assert!(largest([1.0, f64::NAN].into_iter()).is_nan());
        assert!(largest(std::iter::empty()).is_nan());
    }
}
