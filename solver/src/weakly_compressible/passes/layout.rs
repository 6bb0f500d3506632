//! Places of numbers in the records that several files read.

use super::precision::Precision;
use super::records::deviator_values;
use crate::weakly_compressible::PairDiffusion;
use std::marker::PhantomData;

/// Values of the geometry pass: position, volume, pressure.
pub(crate) const fn geometry(dimension: usize) -> usize {
    dimension + 2
}

/// Places in a record of the momentum equation. It begins with a position and, where weights are computed anew, a volume.
pub(super) struct Momentum<P, const D: usize>(PhantomData<P>);

impl<P: Precision, const D: usize> Momentum<P, D> {
    /// Density of the flow, depth of a wall.
    pub(super) const DENSITY: usize = D + P::VOLUMES;
    pub(super) const VELOCITY: usize = Self::DENSITY + 1;
    /// √(p/ρ0), of grains the share of it that the hourglass control takes.
    pub(super) const SPEED: usize = Self::VELOCITY + D;
    /// σE of the flow, σ of a wall.
    pub(super) const STRESS: usize = Self::SPEED + 1;
    /// Velocity gradient of the flow, in single precision the half form; of a wall its normal.
    pub(super) const LAST: usize = Self::STRESS + D * D;
    /// α of the flow, in double precision only.
    pub(super) const ALPHA: usize = Self::LAST + if P::SINGLE { D * (D + 1) / 2 } else { D * D };
    pub(super) const VALUES: usize = Self::ALPHA + 1 - P::VOLUMES;
    pub(super) const QUADS: usize = Self::VALUES.div_ceil(4);
}

/// Places in a record of continuity. It begins with a position and, where weights are computed anew, a volume.
pub(super) struct Continuity<P, const D: usize>(PhantomData<P>);

impl<P: Precision, const D: usize> Continuity<P, D> {
    pub(super) const VELOCITY: usize = D + P::VOLUMES;
    /// Place of the pressure; behind it are the values that the density alone does not need.
    pub(super) const PRESSURE: usize = Self::VELOCITY + D;
    /// Corrected pressure gradient; of a wall particle the velocity that the continuity of a liquid takes.
    pub(super) const GRADIENT: usize = Self::PRESSURE + 1;
    /// Other quantities that neighbours exchange.
    pub(super) const EXCHANGED: usize = Self::GRADIENT + D;

    /// Values where this is exchanged: a yielding share and a stress, the field behind them; or a pore pressure and a conductivity.
    pub(super) const fn values(exchanged: PairDiffusion) -> usize {
        Self::EXCHANGED
            + match exchanged {
                PairDiffusion::None => 0,
                PairDiffusion::StressRatio => 1 + deviator_values(D),
                PairDiffusion::Field => 2 + deviator_values(D),
                PairDiffusion::PorePressure => 2,
            }
    }
}
