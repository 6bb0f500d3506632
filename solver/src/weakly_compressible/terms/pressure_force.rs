//! The paper's pressure force (10): a_a = −Σ m_b (p_a/ρ_a² + p_b/ρ_b²) ∇_aW_ab.

use crate::lanes::Real;

/// p/ρ² `[m⁵/(kg s²)]` of one particle.
#[inline(always)]
#[must_use]
pub fn specific<R: Real>(pressure: R, density: R) -> R {
    pressure / (density * density)
}

/// The bracket of (10) `[m⁵/(kg s²)]`, to be multiplied by −m_b ∇W.
#[inline(always)]
#[must_use]
pub fn bracket<R: Real>(specific_a: R, specific_b: R) -> R {
    specific_a + specific_b
}
