//! Places of numbers in the records that several files read.

use super::precision::Precision;
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
