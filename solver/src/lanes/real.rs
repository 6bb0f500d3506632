//! Arithmetic that a formula requires of a number, so that one formula serves a single value and eight lanes alike.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Number type: one f64, eight lanes of f64 with the same rounding, or eight lanes of f32.
pub trait Real:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// The same value in every lane, rounded to its precision.
    fn splat(value: f64) -> Self;
    /// Square root.
    fn sqrt(self) -> Self;
    /// `if a < b { self } else { other }`.
    fn if_less(self, a: Self, b: Self, other: Self) -> Self;
    /// Whether `self < other` in any lane.
    fn any_less(self, other: Self) -> bool;
    /// A function of single values, lane by lane: slow, for what is not written for lanes.
    fn lane_by_lane<const N: usize>(values: [Self; N], function: &dyn Fn([f64; N]) -> f64) -> Self;
    /// `if self > other { self } else { other }`: a NaN in `self` gives `other`.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.if_less(other, self, other)
    }
    /// `if self < other { self } else { other }`: a NaN in `self` gives `other`.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.if_less(self, other, other)
    }
    /// `self` where `a < b`, zero elsewhere.
    #[inline(always)]
    fn where_less(self, a: Self, b: Self) -> Self {
        self.if_less(a, b, Self::splat(0.0))
    }
}

impl Real for f64 {
    #[inline(always)]
    fn splat(value: f64) -> Self {
        value
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }

    #[inline(always)]
    fn if_less(self, a: Self, b: Self, other: Self) -> Self {
        if a < b { self } else { other }
    }

    #[inline(always)]
    fn any_less(self, other: Self) -> bool {
        self < other
    }

    #[inline(always)]
    fn lane_by_lane<const N: usize>(values: [Self; N], function: &dyn Fn([f64; N]) -> f64) -> Self {
        function(values)
    }
}

/// A number of one precision. f32 is not [`Real`], so that a formula of plain numbers is one of f64.
pub trait Number: Copy + Into<f64> {
    /// The nearest number of this precision.
    fn of(value: f64) -> Self;
}

impl Number for f64 {
    #[inline(always)]
    fn of(value: f64) -> Self {
        value
    }
}

impl Number for f32 {
    #[inline(always)]
    fn of(value: f64) -> Self {
        value as f32
    }
}
