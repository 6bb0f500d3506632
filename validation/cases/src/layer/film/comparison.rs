//! Other operators and walls, run beside the default so that a report can show what each of them costs.

use bagnold_solver::weakly_compressible::numerics::{Contact, MomentumOperator, Numerics, ViscousStep};
use bagnold_solver::weakly_compressible::walls::WallTreatment;
use serde::{Deserialize, Serialize};

/// A set of numerics to be compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NumericsSet {
    /// The case's own numerics.
    Default,
    /// Pressure by (10), viscosity by (11), no-slip by (18)–(20) with the pressure (22)(23); the case's kernel.
    Pairwise,
    /// The same with the viscosity corrected by (13)(14).
    PairwiseCorrected,
    /// The paper's own set with its kernel, its smoothing length and its artificial viscosity.
    Paper,
    /// The default with a wider skin of the neighbour lists, of which no result may depend.
    WideSkin,
}

/// The wider skin over the kernel's support `[-]`.
const WIDE_SKIN: f64 = 0.3;

impl NumericsSet {
    /// The sets that stand beside the default.
    pub const OTHERS: [Self; 3] = [Self::Pairwise, Self::PairwiseCorrected, Self::Paper];

    /// The numerics, made from those of the case.
    #[must_use]
    pub fn numerics(self, of_case: Numerics) -> Numerics {
        let pairwise = |momentum_operator| Numerics {
            momentum_operator,
            wall_treatment: WallTreatment::Paper,
            contact: Contact::None,
            hourglass: 0.0,
            // the explicit pairwise viscosity is stable up to about half the bound of the single divergence
            viscous_courant: of_case.viscous_courant.min(0.1),
            // and knows no other step
            viscous_step: ViscousStep::Explicit,
            ..of_case
        };
        match self {
            Self::Default => of_case,
            Self::Pairwise => pairwise(MomentumOperator::Pairwise),
            Self::PairwiseCorrected => pairwise(MomentumOperator::PairwiseCorrected),
            Self::Paper => Numerics { viscous_courant: 0.1, ..Numerics::paper() },
            Self::WideSkin => Numerics { verlet_skin: WIDE_SKIN, ..of_case },
        }
    }

    /// Its name in a variant.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Default => "default",
            Self::Pairwise => "pairwise",
            Self::PairwiseCorrected => "pairwise_corrected",
            Self::Paper => "paper",
            Self::WideSkin => "wide_skin",
        }
    }

    /// Its name in a figure.
    #[must_use]
    pub fn label(self) -> &'static str {
        match self {
            Self::Default => "single divergence, extrapolated walls (default)",
            Self::Pairwise => "(10) and (11), Morris–Adami walls",
            Self::PairwiseCorrected => "(10) and (13), Morris–Adami walls",
            Self::Paper => "the paper's set: as above, cubic spline, h/Δ = 1.3, switch (16)",
            Self::WideSkin => "default with a wider skin of the neighbour lists",
        }
    }
}
