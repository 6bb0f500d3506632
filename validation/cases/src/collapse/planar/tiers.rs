//! The tiers, the rules between parameters, and the runs that they ask for.

use super::parameters::{
    ColumnPlanarParameters, OtherNumerics, PlanarColumns, Regularised, SHOWN, Sensitivity, TALL, Variants,
};
use super::runs;
use crate::case::{ParameterError, Parameters, Tier};
use crate::collapse::{self, ColumnPurpose, ColumnRun, Release};
use crate::reference::collapse::ALUMINIUM_BAR_PILE;
use crate::reference::grains::{ALUMINIUM_BARS, GLASS_BEADS, LAGREE_GRAINS, TABLE_2_SAND};
use crate::setup::rules;
use bagnold_solver::weakly_compressible::numerics::Numerics;

/// The friction that the bars' angle φ gives to μ(I), whose stress is half the difference of the stresses in the plane and whose
/// pressure is their mean, if the angle is that of Mohr's circle: sin φ in the place of tan φ, to four digits `[-]`.
fn wedge_friction() -> f64 {
    (1e4 * libm::sin(ALUMINIUM_BAR_PILE.friction_angle.to_radians())).round() / 1e4
}

/// The friction that the bars' would tend to if it rose with the rate by as much as that of Lagrée's grains, to four digits `[-]`.
fn limiting_friction() -> f64 {
    let (own, other) = (ALUMINIUM_BARS.law, LAGREE_GRAINS.law);
    (1e4 * (own.static_friction + other.limiting_friction - other.static_friction)).round() / 1e4
}

impl Parameters for ColumnPlanarParameters {
    type Run = ColumnRun;

    fn of_tier(tier: Tier) -> Self {
        let pile_ratio = ALUMINIUM_BAR_PILE.height / ALUMINIUM_BAR_PILE.length;
        let quick = Self {
            resolution: 20,
            // enough for the exponents of tall columns, not for a run-out alone
            tall_resolution: 10,
            release: Release::with(Numerics::default()),
            // Table 2; figures 7–10
            sand: PlanarColumns {
                aspect_ratios: vec![0.7, 0.9, 1.5, 3.0, 5.0, 7.0, 10.0, 14.0],
                half_width: collapse::SAND_HALF_WIDTH,
                tall_half_width: 0.0292,
                ..PlanarColumns::of(&TABLE_2_SAND)
            },
            // Table 1; figures 7–9 are captioned glass beads
            glass: PlanarColumns {
                half_width: collapse::SAND_HALF_WIDTH,
                tall_half_width: 0.0292,
                ..PlanarColumns::of(&GLASS_BEADS)
            },
            lagree: PlanarColumns { aspect_ratios: vec![1.0, 3.0], ..PlanarColumns::of(&LAGREE_GRAINS) },
            bars: PlanarColumns {
                aspect_ratios: vec![pile_ratio],
                half_width: ALUMINIUM_BAR_PILE.length,
                ..PlanarColumns::of(&ALUMINIUM_BARS)
            },
            // 20 rows
            bars_resolution: 40,
            bars_frictions: Variants { values: vec![wedge_friction()], aspect_ratios: vec![pile_ratio] },
            bars_limiting_frictions: Variants { values: vec![limiting_friction()], aspect_ratios: vec![pile_ratio] },
            sand_inertias: Variants::default(),
            lagree_diameters: Variants::default(),
            // the spread over five seeds, which the gates of run-out and height take into account
            sensitivity: Sensitivity {
                aspect_ratios: vec![1.0],
                resolutions: vec![20],
                seeds: vec![1, 2, 3, 4, 5],
                // rows of a few particles at one instant scatter by 0.1
                profile_aspect_ratios: vec![3.0],
                profile_seeds: vec![2, 3, 4, 5],
                ..Sensitivity::default()
            },
            regularised: Regularised { aspect_ratios: vec![0.9], rate: 0.01 },
            other_numerics: OtherNumerics {
                eddy_aspect_ratios: vec![3.0],
                // the middle of what is usual
                smagorinsky_constant: 0.15,
                uncoupled_aspect_ratios: vec![0.9],
            },
        };
        let paper = Self {
            sand_inertias: Variants {
                values: vec![GLASS_BEADS.law.reference_inertia],
                aspect_ratios: vec![5.0, 7.0, 10.0, 14.0, 20.0],
            },
            // D/r_0 = 0.01 and 0.04: the source does not say which
            lagree_diameters: Variants { values: vec![1e-3, 4e-3], aspect_ratios: vec![0.5, 1.0, 2.0, 3.0, 7.0] },
            sensitivity: Sensitivity {
                aspect_ratios: vec![1.0, 3.0],
                resolutions: vec![40, 60, 90],
                seeds: vec![1, 2, 3, 4, 5],
                hourglass: vec![0.0, 0.2, 0.5],
                hourglass_seeds: vec![1, 2, 3],
                hourglass_resolutions: vec![20, 40],
                // taller ones take minutes each
                profile_aspect_ratios: vec![7.0, 10.0],
                profile_seeds: vec![2, 3],
            },
            regularised: Regularised { aspect_ratios: vec![1.0, 3.0], rate: 0.01 },
            other_numerics: OtherNumerics { eddy_aspect_ratios: vec![3.0, 7.0, 14.0], ..quick.other_numerics.clone() },
            resolution: 40,
            tall_resolution: 20,
            sand: PlanarColumns {
                aspect_ratios: vec![0.5, 0.7, 0.9, 1.0, 1.5, 2.0, 2.75, 3.0, 4.8, 5.0, 7.0, 10.0, 14.0, 20.0],
                ..quick.sand.clone()
            },
            glass: PlanarColumns { aspect_ratios: SHOWN.iter().map(|shown| shown.0).collect(), ..quick.glass.clone() },
            lagree: PlanarColumns {
                aspect_ratios: vec![0.5, 1.0, 2.0, 3.0, 7.0, 10.0, 14.0, 20.0],
                ..quick.lagree.clone()
            },
            bars_resolution: 80,
            ..quick.clone()
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => paper,
            Tier::Fine => Self {
                resolution: 80,
                tall_resolution: 40,
                sensitivity: Sensitivity { hourglass_resolutions: vec![20, 40, 80], ..paper.sensitivity.clone() },
                ..paper
            },
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        let altered = [
            ("sand", &self.sand, "sand_inertias", &self.sand_inertias),
            ("lagree", &self.lagree, "lagree_diameters", &self.lagree_diameters),
            ("bars", &self.bars, "bars_frictions", &self.bars_frictions),
            ("bars", &self.bars, "bars_limiting_frictions", &self.bars_limiting_frictions),
        ];
        for (name, columns, list, variants) in altered {
            if !variants.values.is_empty() && !variants.aspect_ratios.is_empty() {
                let remedy = format!("`{list}` alters a number of μ(I): choose it, or empty `{list}.values`");
                rules::only_mu_i(&format!("{name}.law"), &columns.law, &remedy)?;
            }
        }
        if !self.regularised.aspect_ratios.is_empty() {
            let remedy = "(35) regularises μ(I): choose it, or empty `regularised.aspect_ratios`";
            rules::only_mu_i("sand.law", &self.sand.law, remedy)?;
            rules::implicit_runs("numerics", &self.release.numerics, "regularised.aspect_ratios")?;
        }
        Ok(())
    }

    fn check_runs(&self, runs: &[&ColumnRun]) -> Result<(), ParameterError> {
        for (grains, columns) in self.materials() {
            if !runs.iter().any(|run| run.material.grains == grains) {
                continue;
            }
            let name = grains.name();
            let is_tall = |run: &&&ColumnRun| run.material.grains == grains && run.aspect_ratio > TALL;
            if columns.has_paper_width_of_tall_columns_alone() && runs.iter().any(|run| is_tall(&run)) {
                let rule = "your own as well as `half_width`: columns taller than a = 3 have it";
                let remedy = format!("set it to {}", columns.half_width);
                let field = format!("{name}.tall_half_width");
                return Err(ParameterError::field(&field, columns.tall_half_width, rule, &remedy));
            }
            rules::material(&format!("{name}.law"), &columns.law)?;
            columns.bulk.check(&columns.law).map_err(|error| error.within(name))?;
            rules::viscous_step("numerics", &self.release.numerics, &columns.law)?;
        }
        collapse::check_size(runs, |run| match run.purpose {
            ColumnPurpose::Convergence => "sensitivity.resolutions".to_owned(),
            ColumnPurpose::Hourglass => "sensitivity.hourglass_resolutions".to_owned(),
            ColumnPurpose::Law
            | ColumnPurpose::Regularised
            | ColumnPurpose::Eddies
            | ColumnPurpose::Uncoupled
            | ColumnPurpose::ProfileSeed => self.resolution_field(run.material.grains, run.aspect_ratio).to_owned(),
        })
    }

    fn runs(&self) -> Vec<ColumnRun> {
        runs::all(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collapse::Material;

    #[test]
    fn columns_are_as_wide_as_the_paper_prints() {
        let mut tall = 0;
        for tier in [Tier::Quick, Tier::Paper, Tier::Fine] {
            let parameters = ColumnPlanarParameters::of_tier(tier);
            let of_the_paper = |run: &&ColumnRun| [Material::SAND, Material::GLASS].contains(&run.material);
            for run in parameters.runs().iter().filter(of_the_paper) {
                let expected = if run.aspect_ratio > 3.0 { 0.0292 } else { 0.0972 };
                assert_eq!(run.half_width, expected, "{tier}, a = {}", run.aspect_ratio);
                tall += usize::from(run.aspect_ratio > 3.0);
            }
        }
        assert!(tall > 0, "a tier has tall columns");
    }
}
