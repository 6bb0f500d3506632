//! Precision of the terms of a pair: each pair sum is one text for both precisions.
//!
//! Single precision takes half of the memory and twice the lanes for what is needed to seven digits only. Positions are integers
//! of 32 bits that wrap, in units of h/2²⁶. The distance of two neighbours is then an exact integer wherever they are, rounded once
//! to f32. All else of a pair is f32 as well, and up to 64 neighbours of a particle are summed so. Those sums are widened and
//! added in f64. What a particle keeps from step to step (position, velocity, density, stress) stays f64. Weights are
//! computed again in each pass, which costs less than to store them.

use crate::lanes::{LaneNumbers, Lanes, Number, Real, SingleLanes};
use std::fmt::Debug;

/// Units of position in a smoothing length `[-]`: 32 smoothing lengths before the integers wrap to either side.
const UNITS: f64 = (1_u64 << 26) as f64;

/// Chunks of eight neighbours that are summed in f32 before the sum goes to f64.
pub(super) const PART: usize = 8;

/// Numbers that records hold and pairs are made of.
pub(crate) trait Precision: Number + Debug + Default + Send + Sync {
    /// Eight of them, for the back end of lanes V.
    type Lanes<V: Lanes>: LaneNumbers<Number = Self>;
    /// Whether it is single precision: where that rounds in another order, both forms stand side by side.
    const SINGLE: bool;
    /// Chunks of eight neighbours in a part of a sum.
    const PART: usize;
    /// Numbers behind a position from which a pass computes weights anew: the volume, or none.
    const VOLUMES: usize = Self::SINGLE as usize;

    /// A coordinate `[m]` as it stands in a record; `smoothing_length` `[m]` gives the unit of integers.
    fn of_coordinate(position: f64, smoothing_length: f64) -> Self;
    /// a − b `[m]` of two coordinates.
    fn apart<V: Lanes>(a: Self::Lanes<V>, b: Self::Lanes<V>, smoothing_length: f64) -> Self::Lanes<V>;
    /// The lanes as f64, exactly.
    fn widen<V: Lanes>(lanes: Self::Lanes<V>) -> V;
    /// The nearest numbers of this precision.
    fn narrow<V: Lanes>(lanes: V) -> Self::Lanes<V>;
}

/// All in f64; the first pass of a step stores the weights of pairs for the others.
impl Precision for f64 {
    type Lanes<V: Lanes> = V;
    const SINGLE: bool = false;
    const PART: usize = usize::MAX;

    #[inline(always)]
    fn of_coordinate(position: f64, _: f64) -> f64 {
        position
    }

    #[inline(always)]
    fn apart<V: Lanes>(a: V, b: V, _: f64) -> V {
        a - b
    }

    #[inline(always)]
    fn widen<V: Lanes>(lanes: V) -> V {
        lanes
    }

    #[inline(always)]
    fn narrow<V: Lanes>(lanes: V) -> V {
        lanes
    }
}

/// Positions as integers, all else of a pair in f32.
impl Precision for f32 {
    type Lanes<V: Lanes> = V::Single;
    const SINGLE: bool = true;
    const PART: usize = PART;

    #[inline(always)]
    fn of_coordinate(position: f64, smoothing_length: f64) -> f32 {
        f32::from_bits((position * (UNITS / smoothing_length)) as i64 as u32)
    }

    #[inline(always)]
    fn apart<V: Lanes>(a: V::Single, b: V::Single, smoothing_length: f64) -> V::Single {
        a.fixed_difference(b) * V::Single::splat(smoothing_length / UNITS)
    }

    #[inline(always)]
    fn widen<V: Lanes>(lanes: V::Single) -> V {
        V::widen(lanes)
    }

    #[inline(always)]
    fn narrow<V: Lanes>(lanes: V) -> V::Single {
        lanes.narrow()
    }
}
