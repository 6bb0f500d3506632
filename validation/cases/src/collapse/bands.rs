//! Where the results of columns must lie, and why there. A band stands where its reference puts it: what is known of the scatter
//! over seeds and of the spacing belongs to the metric as its uncertainty and moves no limit, so that a limit is the same
//! whichever runs were made, and a law's own value lies within its band.

use super::column::{ColumnRun, Geometry};
use super::material::{ExperimentGrains, Material};
use crate::metric::Limit;
use crate::reference::collapse::{CollapseLaw, CollapseLawSource, PLANAR_COLLAPSE, ROUND_COLLAPSE};

/// The band of a relative `tolerance` around a value.
pub(super) fn band(expected: f64, tolerance: f64) -> Limit {
    Limit::Within((1.0 - tolerance) * expected, (1.0 + tolerance) * expected)
}

/// How far the run-out of Lagrée's grains may lie from his own law `[-]`, and why.
pub(super) const SAME_LAW: f64 = 0.15;
pub(super) const SAME_LAW_REASON: &str = "the same material law solved by another method, within 15 %: its fit is printed with two \
    digits, and its source tells no thickness at which the front is read";

/// How far the height of the sand's heaps may lie from Lube's law `[-]`.
pub(super) const HEIGHT: f64 = 0.15;

/// The laws of run-out and height whose geometry a run has, and whose material it has or comes closest to.
pub(super) fn laws_of(run: &ColumnRun) -> (&'static CollapseLaw, &'static CollapseLaw) {
    let (laws, author) = match run.geometry {
        Geometry::Planar if run.material.grains == ExperimentGrains::Lagree => {
            (&*PLANAR_COLLAPSE, CollapseLawSource::Lagree)
        }
        Geometry::Planar => (&*PLANAR_COLLAPSE, CollapseLawSource::Lube),
        Geometry::Round => (&*ROUND_COLLAPSE, CollapseLawSource::Lube),
    };
    (author.law(&laws.run_out), author.law(&laws.height))
}

/// Where a result must lie, and why there.
pub(super) type AcceptanceBand = Option<(Limit, &'static str)>;

/// Where the run-out of published grains must lie.
pub(super) fn run_out(run: &ColumnRun, law: &CollapseLaw) -> AcceptanceBand {
    let a = run.initial_height();
    if !run.has_published_law() {
        return None;
    }
    match (run.geometry, run.material) {
        (Geometry::Round, _) if run.is_resolved() => Some((
            band(law.value(a)?, 0.2),
            "the project's aim: within 20 % of Lube's law for round columns at 20 rows and more",
        )),
        (Geometry::Planar, Material::SAND) if run.resolution >= 20 => {
            let experiments = [CollapseLawSource::Lube, CollapseLawSource::Lajeunesse]
                .map(|author| author.law(&PLANAR_COLLAPSE.run_out).value(a));
            let [Some(one), Some(other)] = experiments else { return None };
            let (short, long) = (one.min(other), one.max(other));
            Some((
                Limit::Within(short, long),
                "between Lube's and Lajeunesse's laws for planar columns: two experiments with grains and walls of their own, of \
                 which neither tells how far its points lie from its law",
            ))
        }
        // coarser columns scatter by 3 % from seed to seed: there the mean over an ensemble is judged
        (Geometry::Planar, Material::LAGREE) if run.resolution >= 40 => {
            Some((band(law.value(a)?, SAME_LAW), SAME_LAW_REASON))
        }
        _ => None,
    }
}

/// Where the height of published grains must lie.
pub(super) fn height(run: &ColumnRun, law: &CollapseLaw) -> AcceptanceBand {
    let a = run.initial_height();
    let expected = law.value(a).filter(|_| run.has_published_law())?;
    let is_round = run.geometry == Geometry::Round;
    let (tolerance, reason) = match (run.material, a) {
        (Material::SAND, ..=0.7) if !is_round => (0.03, "undisturbed within 3 % up to a = 0.7"),
        (Material::SAND, _) if !is_round || a > 1.15 => {
            (HEIGHT, "15 %: by how much the two planar experiments' exponents, 0.4 and 1/3, differ up to a = 10")
        }
        (Material::LAGREE, _) if run.is_resolved() => {
            (0.1, "the same material law solved by another method, within 10 %: two rows of 20")
        }
        _ => return None,
    };
    Some((band(expected, tolerance), reason))
}

#[cfg(test)]
mod tests {
    use super::super::column::ColumnPurpose;
    use super::super::release::Release;
    use super::*;
    use crate::reference::grains::{GLASS_BEADS, LAGREE_GRAINS, TABLE_2_SAND};
    use bagnold_solver::material::rheology::Rheology;
    use bagnold_solver::weakly_compressible::numerics::Numerics;

    /// Columns of every geometry and published grains, over the aspect ratios and resolutions of all tiers and between them.
    fn columns() -> Vec<ColumnRun> {
        let grains =
            [(Material::SAND, &TABLE_2_SAND), (Material::GLASS, &GLASS_BEADS), (Material::LAGREE, &LAGREE_GRAINS)];
        let mut columns = Vec::new();
        for geometry in [Geometry::Planar, Geometry::Round] {
            for (material, published) in grains {
                for aspect_ratio in [0.5, 0.7, 0.9, 1.0, 1.2, 1.5, 1.7, 2.0, 2.75, 3.0, 4.8, 5.0, 7.0, 10.0, 14.0, 20.0]
                {
                    columns.extend([12, 20, 40, 80].map(|resolution| ColumnRun {
                        purpose: ColumnPurpose::Law,
                        geometry,
                        material,
                        aspect_ratio,
                        resolution,
                        half_width: 0.1,
                        law: Rheology::MuI(published.law),
                        bulk_density: 1500.0,
                        regularisation_rate: None,
                        shown_times: Vec::new(),
                        release: Release::with(Numerics::default()),
                    }));
                }
            }
        }
        columns
    }

    #[test]
    fn the_value_of_every_law_that_gates_passes_its_own_gate() {
        let mut judged = 0;
        for run in columns() {
            let a = run.initial_height();
            let (run_out_law, height_law) = laws_of(&run);
            let of_sand = (run.geometry, run.material) == (Geometry::Planar, Material::SAND);
            // the band of the sand's run-out is made of two laws
            let other = of_sand.then(|| CollapseLawSource::Lajeunesse.law(&PLANAR_COLLAPSE.run_out));
            for law in [Some(run_out_law), other].into_iter().flatten() {
                if let (Some((limit, _)), Some(value)) = (run_out(&run, run_out_law), law.value(a)) {
                    assert!(limit.holds(value), "{}, a = {a}: run-out {value} is outside of {limit:?}", law.source);
                    judged += 1;
                }
            }
            // and the width of its height is that up to which the two experiments differ up to a = 10
            let other =
                (of_sand && a > 0.7 && a <= 10.0).then(|| CollapseLawSource::Lajeunesse.law(&PLANAR_COLLAPSE.height));
            for law in [Some(height_law), other].into_iter().flatten() {
                if let (Some((limit, _)), Some(value)) = (height(&run, height_law), law.value(a)) {
                    assert!(limit.holds(value), "{}, a = {a}: height {value} is outside of {limit:?}", law.source);
                    judged += 1;
                }
            }
        }
        assert!(judged > 200, "{judged} values of laws were judged");
    }
}
