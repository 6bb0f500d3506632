//! How the energy of a run by the weakly compressible model is judged: its ledger closes, and it never rises.

use crate::metric::{Limit, Metric, Variant, quantities};
use crate::observation::EnergyBook;

quantities! {
    shared pub(in crate::cases)
    ENERGY_RESIDUAL:
        accounted("energy_residual", "%", "largest change of the energy that its ledger does not explain, over a scale"),
    ENERGY_RISE: accounted("energy_rise", "%", "largest rise of the total energy above its least before, over a scale"),
    WALL_WORK: accounted("wall_work", "%", "work of walls over that scale: of those at rest an error, or slip along them"),
    CORRECTION_WORK:
        accounted("correction_work", "%", "energy fed in by the kernel correction of the forces, over that scale"),
}

/// What energies are compared with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(in crate::cases) enum EnergyScale {
    /// The work of gravity up to the end: 1 % may stay open.
    Gravity,
    /// An energy `[J]`, in two dimensions `[J/m]`, of a layer at rest, on which gravity does no work: 1e-3 of it may stay
    /// open.
    AtRest(f64),
}

/// Residual, rise, and the two entries that ought to be small; none without a ledger.
pub(in crate::cases) fn metrics(variant: &Variant, book: &EnergyBook, scale: EnergyScale) -> Vec<Metric> {
    if book.total.is_empty() {
        return Vec::new();
    }
    let (energy, open, scale) = match scale {
        EnergyScale::Gravity => (book.gravity.abs(), 1.0, "of the work of gravity"),
        EnergyScale::AtRest(energy) => (energy, 0.1, "of ρ0 g H² times the layer's length"),
    };
    let share = |value: f64| 100.0 * value / energy;
    vec![
        ENERGY_RESIDUAL
            .of(variant, share(book.residual()))
            .exactly(0.0, &format!("every term of the scheme books its work; in per cent {scale}"))
            .gated(Limit::AtMost(open), "what is left is the length of a step")
            .with_snapshot_tolerance(0.1, 1e-3),
        ENERGY_RISE
            .of(variant, share(book.rise()))
            .exactly(0.0, &format!("no wall and no term may feed energy into the flow; in per cent {scale}"))
            .gated(
                Limit::AtMost(0.1),
                "a thousandth for waves of sound, whose energy a symplectic step only keeps on average",
            )
            .with_snapshot_tolerance(0.2, 1e-3),
        WALL_WORK
            .of(variant, share(book.walls))
            .exactly(0.0, &format!("walls at rest do no work; in per cent {scale}"))
            .with_snapshot_tolerance(0.2, 0.1),
        CORRECTION_WORK
            .of(variant, share(book.correction))
            .exactly(0.0, &format!("the same stress does the same work on forces and on strain; in per cent {scale}"))
            .with_snapshot_tolerance(0.2, 0.1),
    ]
}
