//! Which grains a column is made of.

use crate::reference::grains::{ALUMINIUM_BARS, GLASS_BEADS, LAGREE_GRAINS, PublishedGrains, TABLE_2_SAND};
use bagnold_solver::material::rheology::Rheology;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// The grains of a published experiment.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ExperimentGrains {
    /// Sand of Table 2.
    Sand,
    /// Glass beads of Table 1.
    Glass,
    /// Grains of Lagrée et al.
    Lagree,
    /// Aluminium bars of Bui et al.
    Bars,
}

/// The number of μ(I) in which grains differ from their originals.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Alteration {
    /// None: the grains are the originals, or a user's own.
    Nothing,
    /// I_0.
    ReferenceInertia,
    /// Diameter.
    GrainDiameter,
    /// Friction, whatever the rate.
    Friction,
    /// μ_2, to which friction rises with the rate.
    LimitingFriction,
}

impl Alteration {
    /// Name in variants and symbol in legends.
    fn names(self) -> Option<(&'static str, &'static str)> {
        match self {
            Self::Nothing => None,
            Self::ReferenceInertia => Some(("inertia", "I_0")),
            Self::GrainDiameter => Some(("diameter", "D")),
            Self::Friction => Some(("friction", "μ")),
            Self::LimitingFriction => Some(("limiting_friction", "μ_2")),
        }
    }

    /// The number in a law; 0 where there is none.
    pub(super) fn value_in(self, law: &Rheology) -> f64 {
        let Rheology::MuI(law) = law else { return 0.0 };
        match self {
            Self::Nothing => 0.0,
            Self::ReferenceInertia => law.reference_inertia,
            Self::GrainDiameter => law.grain_diameter,
            Self::Friction => law.static_friction,
            Self::LimitingFriction => law.limiting_friction,
        }
    }
}

/// Grains as published, or with one number altered.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Material {
    /// The published grains.
    pub grains: ExperimentGrains,
    /// Altered quantity.
    pub altered: Alteration,
    /// Altered number; 0 for none.
    pub value: f64,
}

impl ExperimentGrains {
    /// Name in files and variants.
    pub fn name(self) -> &'static str {
        match self {
            Self::Sand => "sand",
            Self::Glass => "glass",
            Self::Lagree => "lagree",
            Self::Bars => "bars",
        }
    }

    /// Values that their source gives.
    pub(super) fn as_published(self) -> &'static PublishedGrains {
        match self {
            Self::Sand => &TABLE_2_SAND,
            Self::Glass => &GLASS_BEADS,
            Self::Lagree => &LAGREE_GRAINS,
            Self::Bars => &ALUMINIUM_BARS,
        }
    }
}

impl Material {
    /// Sand as published.
    pub const SAND: Self = Self::published(ExperimentGrains::Sand);
    /// Glass beads as published.
    pub const GLASS: Self = Self::published(ExperimentGrains::Glass);
    /// Grains of Lagrée et al. as published.
    pub const LAGREE: Self = Self::published(ExperimentGrains::Lagree);
    /// Aluminium bars as published.
    pub const BARS: Self = Self::published(ExperimentGrains::Bars);

    /// Grains as published.
    pub const fn published(grains: ExperimentGrains) -> Self {
        Self { grains, altered: Alteration::Nothing, value: 0.0 }
    }

    /// Whether they are as published.
    pub fn is_published(self) -> bool {
        self.altered == Alteration::Nothing
    }

    /// Whether a law is a user's own, in the place of the published one; grains that the case itself alters are none.
    pub fn is_own(self, law: &Rheology) -> bool {
        self.is_published() && *law != Rheology::MuI(self.grains.as_published().law)
    }

    /// What a legend calls them where they have this law: one of a user's own makes grains of his own.
    pub fn title_with(self, law: &Rheology) -> String {
        if self.is_own(law) { format!("own grains as {}", self.grains.name()) } else { self.title() }
    }

    /// Name of the grains in a legend.
    pub fn title(self) -> String {
        let grains = match (self.grains, self.is_published()) {
            (ExperimentGrains::Sand, true) => "sand of Table 2",
            (ExperimentGrains::Glass, true) => "glass beads of Table 1",
            (ExperimentGrains::Lagree, true) => "grains of Lagrée et al.",
            (ExperimentGrains::Lagree, false) => "Lagrée et al.",
            (ExperimentGrains::Bars, true) => "aluminium bars",
            (other, false) => other.name(),
        };
        match self.altered.names() {
            None => grains.to_owned(),
            Some((_, symbol)) => format!("{grains}, {symbol} = {}", self.value),
        }
    }
}

/// The name in a variant: `sand`, `sand_inertia_0.279`, `lagree_diameter_0.001`.
impl fmt::Display for Material {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.grains.name())?;
        match self.altered.names() {
            None => Ok(()),
            Some((name, _)) => write!(formatter, "_{name}_{}", self.value),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bagnold_solver::material::rheology::MuI;

    #[test]
    fn grains_with_a_user_defined_law_are_not_compared_with_the_table() {
        let published = TABLE_2_SAND.law;
        let own = MuI { static_friction: published.static_friction + 0.01, ..published };
        assert_eq!(Material::SAND.title_with(&Rheology::MuI(published)), "sand of Table 2");
        assert_eq!(Material::SAND.title_with(&Rheology::MuI(own)), "own grains as sand");
        let altered = Material { altered: Alteration::ReferenceInertia, value: 0.279, ..Material::SAND };
        assert_eq!(altered.title_with(&Rheology::MuI(own)), "sand, I_0 = 0.279");
    }

    #[test]
    fn materials_have_a_name_for_files_and_one_for_readers() {
        for (material, name, title) in [
            (Material::SAND, "sand", "sand of Table 2"),
            (Material::BARS, "bars", "aluminium bars"),
            (
                Material { altered: Alteration::Friction, value: 0.34, ..Material::BARS },
                "bars_friction_0.34",
                "bars, μ = 0.34",
            ),
            (Material::GLASS, "glass", "glass beads of Table 1"),
            (Material::LAGREE, "lagree", "grains of Lagrée et al."),
            (
                Material { altered: Alteration::ReferenceInertia, value: 0.279, ..Material::SAND },
                "sand_inertia_0.279",
                "sand, I_0 = 0.279",
            ),
            (
                Material { altered: Alteration::GrainDiameter, value: 0.001, ..Material::LAGREE },
                "lagree_diameter_0.001",
                "Lagrée et al., D = 0.001",
            ),
        ] {
            assert_eq!((material.to_string().as_str(), material.title().as_str()), (name, title));
        }
    }
}
