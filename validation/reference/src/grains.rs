//! Grains that papers tabulate, as `reference-data` lists them.

use crate::evidence::{MeasuredData, read_shipped, shipped_table};
use crate::input::FieldError;
use crate::metric::Confidence;
use bagnold_solver::material::rheology::MuI;
use std::sync::LazyLock;

/// Grains with the μ(I) law that a paper gives them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PublishedGrains {
    /// Constitutive law with diameter and density of the grains.
    pub law: MuI,
    /// Solid fraction φ `[-]`.
    pub solid_fraction: f64,
    /// Confidence in the values.
    pub confidence: Confidence,
}

/// Glass beads of Table 1 of the collapse paper, whose I_0 follows from (41).
pub static GLASS_BEADS: LazyLock<PublishedGrains> = LazyLock::new(|| {
    read_shipped("bagnold/friction.csv", |friction| {
        let printed = |name| friction.number_of("material", "glass beads", name);
        let more = shipped_table("bagnold/grains.csv")?;
        let added = |name| more.number_of("material", "glass beads", name);
        let law = MuI {
            static_friction: printed("static friction")?,
            limiting_friction: printed("limiting friction")?,
            reference_inertia: added("reference inertia")?,
            grain_diameter: printed("grain diameter")?,
            grain_density: added("grain density")?,
        };
        Ok(PublishedGrains { law, solid_fraction: added("solid fraction")?, confidence: friction.metadata.confidence })
    })
});

/// Sand of Table 2 of the collapse paper.
pub static TABLE_2_SAND: LazyLock<PublishedGrains> =
    LazyLock::new(|| read_shipped("column-planar/grains.csv", |table| PublishedGrains::read(table, "sand")));

/// The continuum of Lagrée, Staron & Popinet 2011.
pub static LAGREE_GRAINS: LazyLock<PublishedGrains> =
    LazyLock::new(|| read_shipped("column-planar/grains.csv", |table| PublishedGrains::read(table, "Lagrée et al.")));

/// The aluminium bars of Bui et al. 2008, whose friction does not depend on the rate: nothing else is known of it.
pub static ALUMINIUM_BARS: LazyLock<PublishedGrains> =
    LazyLock::new(|| read_shipped("column-planar/grains.csv", |table| PublishedGrains::read(table, "aluminium bars")));

/// Dependence of deposits and flows of the glass beads on their thickness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlowRule {
    /// Length scale L of h_stop over the grain diameter `[-]`.
    pub deposit_length: f64,
    /// β of Ū/√(g h) = β h/h_stop `[-]`.
    pub flow_coefficient: f64,
    /// Confidence in the coefficients.
    pub confidence: Confidence,
}

/// The flow rule of the glass beads of Table 1.
pub static GLASS_BEADS_FLOW_RULE: LazyLock<FlowRule> = LazyLock::new(|| {
    read_shipped("bagnold/friction.csv", |friction| {
        let printed = |name| friction.number_of("material", "glass beads", name);
        Ok(FlowRule {
            deposit_length: printed("length scale over diameter")?,
            flow_coefficient: printed("flow-rule slope")?,
            confidence: friction.metadata.confidence,
        })
    })
});

impl PublishedGrains {
    /// The grains of a table with a row of this material.
    pub fn read(table: &MeasuredData, material: &str) -> Result<Self, FieldError> {
        let number = |name| table.number_of("material", material, name);
        let law = MuI {
            static_friction: number("static friction")?,
            limiting_friction: number("limiting friction")?,
            reference_inertia: number("reference inertia")?,
            grain_diameter: number("grain diameter")?,
            grain_density: number("grain density")?,
        };
        let confidence = table.confidences()?[table.row("material", material)?];
        Ok(Self { law, solid_fraction: number("solid fraction")?, confidence })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inertia_of_the_glass_beads_follows_from_their_flow_rule() {
        // (41), I_0 = (5/2) β D/(L √(φ cosθ)) at 25°
        let rule = *GLASS_BEADS_FLOW_RULE;
        let root = (GLASS_BEADS.solid_fraction * libm::cos(25f64.to_radians())).sqrt();
        let inertia = 2.5 * rule.flow_coefficient / (rule.deposit_length * root);
        assert!((inertia - GLASS_BEADS.law.reference_inertia).abs() < 5e-4, "{inertia}");
    }

    #[test]
    fn the_papers_viscosity_is_the_second_term_of_34_under_the_whole_height() {
        // (μ_2 − μ_s) p/(ξ √p), ξ = I_0/(D √ρ_s), at a negligible shear rate; the paper prints 1.4 Pa·s for half of 14 cm
        let law = GLASS_BEADS.law;
        let viscosity = |height: f64| {
            let xi = law.reference_inertia / (law.grain_diameter * law.grain_density.sqrt());
            (law.limiting_friction - law.static_friction) * (law.grain_density * 9.81 * height).sqrt() / xi
        };
        assert!((viscosity(0.07) - 0.969).abs() < 1e-3, "{}", viscosity(0.07));
        assert!((viscosity(0.14) - 1.370).abs() < 1e-3, "{}", viscosity(0.14));
    }

    #[test]
    fn the_grains_have_the_numbers_that_the_paper_prints() {
        let glass = MuI {
            static_friction: 0.382,
            limiting_friction: 0.643,
            // lost in the scan, by (41)
            reference_inertia: 0.279,
            grain_diameter: 0.5e-3,
            grain_density: 2500.0,
        };
        let sand = MuI {
            static_friction: 0.589,
            limiting_friction: 1.248,
            reference_inertia: 2.65,
            grain_diameter: 0.32e-3,
            grain_density: 2600.0,
        };
        assert_eq!((GLASS_BEADS.law, GLASS_BEADS.solid_fraction), (glass, 0.6));
        assert_eq!((TABLE_2_SAND.law, TABLE_2_SAND.solid_fraction), (sand, 0.62));
        assert_eq!(GLASS_BEADS.solid_fraction * GLASS_BEADS.law.grain_density, 1500.0, "the bulk density");
        assert_eq!((GLASS_BEADS_FLOW_RULE.deposit_length, GLASS_BEADS_FLOW_RULE.flow_coefficient), (1.65, 0.136));
        // the coarse sand of Table 1, which no case runs at a tier
        let friction = shipped_table("bagnold/friction.csv").expect("readable");
        let columns = [
            ("grain diameter", 0.8e-3),
            ("length scale over diameter", 2.03),
            ("flow-rule offset", 0.77),
            ("flow-rule slope", 0.65),
            ("static friction", 0.509),
            ("limiting friction", 0.945),
        ];
        for (column, printed) in columns {
            assert_eq!(friction.number_of("material", "sand", column).expect(column), printed, "{column}");
        }
        assert_eq!(friction.number_of("material", "glass beads", "flow-rule offset").expect("γ"), 0.0);
    }

    #[test]
    fn every_material_is_read_to_the_last_bit() {
        let read = [*GLASS_BEADS, *TABLE_2_SAND, *LAGREE_GRAINS].map(|grains| grains.law.grain_diameter);
        assert_eq!(read, [0.5e-3, 0.32e-3, 2e-3]);
        assert_eq!(TABLE_2_SAND.law.limiting_friction, 1.248);
        assert_eq!(LAGREE_GRAINS.solid_fraction, 0.6);
        let table = shipped_table("column-planar/grains.csv").expect("readable");
        let error = PublishedGrains::read(&table, "gravel").expect_err("absent").to_string();
        assert!(
            error.contains("`material`: no row `gravel`; the rows are sand, Lagrée et al., aluminium bars"),
            "{error}"
        );
    }
}
