//! What closures are replaced by, one at a time.

use crate::reference::one_dimension::bed_load::{Closures, MixingLengthClosure};
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::material::turbulence::GrainRoughness;
use bagnold_solver::parameter::{between, each, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What each closure is replaced by, one at a time; empty lists for none.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
pub struct Sensitivities {
    /// μ_2 `[-]`.
    #[schemars(transform = each(positive("give μ_2, such as 0.97")))]
    pub limiting_friction: Vec<f64>,
    /// μ_s `[-]`.
    #[schemars(transform = each(positive("give μ_s, such as 0.35")))]
    pub static_friction: Vec<f64>,
    /// I_0 `[-]`.
    #[schemars(transform = each(positive("give I_0, such as 0.69")))]
    pub reference_inertia: Vec<f64>,
    /// φ_max `[-]`.
    #[schemars(transform = each(between(0.1, 0.74, "grains at rest fill 0.5 to 0.64 of the space")))]
    pub largest_fraction: Vec<f64>,
    /// B `[-]`.
    #[schemars(transform = each(between(0.0, 100.0, "grains loosen in shear: give B, such as 0.31, or 0 for grains that do not")))]
    pub dilation: Vec<f64>,
    /// Heights of cells `[m]`.
    #[schemars(transform = each(positive("give it in metres, such as 2.5e-4")))]
    pub cell_height: Vec<f64>,
    /// Length over which the roughness of the bed fades, in grain diameters `[-]`.
    #[schemars(transform = each(positive("give it in grain diameters, such as 0.03")))]
    pub bed_roughness_fade_length: Vec<f64>,
    /// Drag laws.
    pub drag: Vec<DragLaw>,
    /// Mixing lengths.
    pub mixing_length: Vec<MixingLengthClosure>,
}

/// A replaced closure.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Replaced {
    /// μ_2 `[-]`.
    LimitingFriction(f64),
    /// μ_s `[-]`.
    StaticFriction(f64),
    /// I_0 `[-]`.
    ReferenceInertia(f64),
    /// φ_max `[-]`.
    LargestFraction(f64),
    /// B `[-]`.
    Dilation(f64),
    /// Height of a cell `[m]`.
    CellHeight(f64),
    /// Length over which the roughness of the bed fades, in grain diameters `[-]`.
    BedRoughnessFadeLength(f64),
    /// Drag law.
    Drag(DragLaw),
    /// Mixing length.
    MixingLength(MixingLengthClosure),
}

impl Sensitivities {
    /// The one closure that is no literature's, over the range in which it may lie: a hundredth of a grain, and as much room as a layer
    /// of moving grains has.
    pub(super) fn chosen() -> Self {
        Self { bed_roughness_fade_length: vec![0.01, 0.1, 0.3], ..Self::default() }
    }

    /// The range of the literature for each closure; Gidaspow's drag, which jumps at φ = 0.2, has no steady state.
    pub(super) fn literature() -> Self {
        Self {
            limiting_friction: vec![0.64, 0.8, 1.2],
            static_friction: vec![0.3, 0.4],
            reference_inertia: vec![0.3, 1.0],
            largest_fraction: vec![0.55, 0.64],
            dilation: vec![0.0, 0.15, 0.62],
            cell_height: vec![1e-3, 5e-4, 1.25e-4],
            bed_roughness_fade_length: Self::chosen().bed_roughness_fade_length,
            drag: vec![DragLaw::SchillerNaumann, DragLaw::MorsiAlexander, DragLaw::WenYu, DragLaw::Ergun],
            mixing_length: vec![MixingLengthClosure::Root, MixingLengthClosure::Linear],
        }
    }

    /// All replacements, closure by closure.
    pub(super) fn all(&self) -> Vec<Replaced> {
        let values =
            |values: &[f64], replaced: fn(f64) -> Replaced| values.iter().map(|v| replaced(*v)).collect::<Vec<_>>();
        let mut all = values(&self.limiting_friction, Replaced::LimitingFriction);
        all.extend(values(&self.static_friction, Replaced::StaticFriction));
        all.extend(values(&self.reference_inertia, Replaced::ReferenceInertia));
        all.extend(values(&self.largest_fraction, Replaced::LargestFraction));
        all.extend(values(&self.dilation, Replaced::Dilation));
        all.extend(values(&self.cell_height, Replaced::CellHeight));
        all.extend(values(&self.bed_roughness_fade_length, Replaced::BedRoughnessFadeLength));
        all.extend(self.drag.iter().map(|law| Replaced::Drag(*law)));
        all.extend(self.mixing_length.iter().map(|length| Replaced::MixingLength(*length)));
        all
    }
}

impl Replaced {
    /// The closures and the height of a cell with the replacement.
    pub(super) fn apply(self, closures: Closures, cell_height: f64) -> (Closures, f64) {
        let changed = match self {
            Self::LimitingFriction(limiting_friction) => Closures { limiting_friction, ..closures },
            Self::StaticFriction(static_friction) => Closures { static_friction, ..closures },
            Self::ReferenceInertia(reference_inertia) => Closures { reference_inertia, ..closures },
            Self::LargestFraction(largest_fraction) => Closures { largest_fraction, ..closures },
            Self::Dilation(dilation) => Closures { dilation, ..closures },
            Self::CellHeight(_) => closures,
            Self::BedRoughnessFadeLength(bed_roughness_fade_length) => Closures {
                grain_roughness: GrainRoughness { bed_roughness_fade_length, ..closures.grain_roughness },
                ..closures
            },
            Self::Drag(drag) => Closures { drag, ..closures },
            Self::MixingLength(mixing_length) => Closures { mixing_length, ..closures },
        };
        (changed, if let Self::CellHeight(height) = self { height } else { cell_height })
    }

    /// Name of the closure as in the parameters.
    pub(super) fn closure(self) -> &'static str {
        match self {
            Self::LimitingFriction(_) => "limiting_friction",
            Self::StaticFriction(_) => "static_friction",
            Self::ReferenceInertia(_) => "reference_inertia",
            Self::LargestFraction(_) => "largest_fraction",
            Self::Dilation(_) => "dilation",
            Self::CellHeight(_) => "cell_height",
            Self::BedRoughnessFadeLength(_) => "bed_roughness_fade_length",
            Self::Drag(_) => "drag",
            Self::MixingLength(_) => "mixing_length",
        }
    }

    /// Its value, if it is a number.
    pub(super) fn value(self) -> Option<f64> {
        match self {
            Self::LimitingFriction(value)
            | Self::StaticFriction(value)
            | Self::ReferenceInertia(value)
            | Self::LargestFraction(value)
            | Self::Dilation(value)
            | Self::CellHeight(value)
            | Self::BedRoughnessFadeLength(value) => Some(value),
            Self::Drag(_) | Self::MixingLength(_) => None,
        }
    }

    /// Its value as in the parameters.
    pub(super) fn value_text(self) -> String {
        match self {
            Self::Drag(law) => law.name().to_owned(),
            Self::MixingLength(length) => length.name().to_owned(),
            _ => self.value().map_or_else(String::new, |value| value.to_string()),
        }
    }
}
