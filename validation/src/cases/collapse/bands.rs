//! Where the results of columns must lie, and why there.

use super::column::{ColumnRun, Geometry};
use super::material::Material;
use crate::metric::Limit;
use crate::reference::{Author, CollapseLaw, PLANAR_COLLAPSE};

/// The band of a relative `tolerance` around a value, narrowed by twice the ensemble's spread.
pub(super) fn band(expected: f64, tolerance: f64, spread: f64) -> Limit {
    let left = (tolerance - 2.0 * spread).max(0.0);
    Limit::Within((1.0 - left) * expected, (1.0 + left) * expected)
}

/// How far the run-out of Lagrée's grains may lie from his own law `[-]`, and why.
pub(super) const SAME_LAW: f64 = 0.15;
pub(super) const SAME_LAW_REASON: &str = "the same material law solved by another method, within 15 %: its fit is printed with two \
    digits, and with 20 particles over r_0 the front's thickness of 0.02 r_0 is less than a row, so that the run-out is 5 % longer than \
    with 80";

/// Where a result must lie, and why there.
pub(super) type AcceptanceBand = Option<(Limit, &'static str)>;

/// Where the run-out of published grains must lie.
pub(super) fn run_out(run: &ColumnRun, law: &CollapseLaw, spread: f64) -> AcceptanceBand {
    let a = run.initial_height();
    if !run.has_published_law() {
        return None;
    }
    match (run.geometry, run.material) {
        (Geometry::Round, _) if run.is_resolved() => Some((
            band(law.value(a)?, 0.2, spread),
            "the project's aim: within 20 % of Lube's law for round columns at 20 rows and more, less twice the spread over \
             the seeds",
        )),
        (Geometry::Planar, Material::SAND) if run.resolution >= 20 => {
            let experiments =
                [Author::Lube, Author::Lajeunesse].map(|author| author.law(&PLANAR_COLLAPSE.run_out).value(a));
            let [Some(one), Some(other)] = experiments else { return None };
            let (short, long) = (one.min(other), one.max(other));
            Some((
                Limit::Within((1.0 + 2.0 * spread) * short, (1.0 - 2.0 * spread) * long),
                "between Lube's and Lajeunesse's laws for planar columns, less twice the spread over the seeds: two \
                 experiments with grains and walls of their own, of which neither tells how far its points lie from its law",
            ))
        }
        // coarser columns scatter by 3 % from seed to seed: there the mean over an ensemble is judged
        (Geometry::Planar, Material::LAGREE) if run.resolution >= 40 => {
            Some((band(law.value(a)?, SAME_LAW, spread), SAME_LAW_REASON))
        }
        _ => None,
    }
}

/// Where the height of published grains must lie.
pub(super) fn height(run: &ColumnRun, law: &CollapseLaw, spread: f64) -> AcceptanceBand {
    let a = run.initial_height();
    let expected = law.value(a).filter(|_| run.has_published_law())?;
    let is_round = run.geometry == Geometry::Round;
    let (tolerance, reason) = match (run.material, a) {
        (Material::SAND, ..=0.7) if !is_round => {
            (0.03, "undisturbed within 3 % up to a = 0.7, less twice the spread over the seeds")
        }
        (Material::SAND, _) if !is_round || a > 1.15 => (
            0.15,
            "15 % less twice the spread over the seeds: by how much the two planar experiments' exponents, 0.4 and 1/3, differ up \
             to a = 10",
        ),
        (Material::LAGREE, _) if run.is_resolved() => (
            0.1,
            "the same material law solved by another method, within 10 % less twice the spread over the seeds: two rows of 20",
        ),
        _ => return None,
    };
    Some((band(expected, tolerance, spread), reason))
}
