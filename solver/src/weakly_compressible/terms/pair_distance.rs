//! The square of a pair's distance, kept from zero.

/// δ² `[m²]` that is added to r² in the denominators of (11) and (15), for a smoothing length h `[m]`: δ = 0.01 h.
#[inline(always)]
#[must_use]
pub fn regularisation(smoothing_length: f64) -> f64 {
    1e-4 * smoothing_length * smoothing_length
}

#[cfg(test)]
mod tests {
    #[test]
    fn the_length_is_a_hundredth_of_the_smoothing_length() {
        assert!((super::regularisation(0.3).sqrt() / 0.3 - 0.01).abs() < 1e-15);
    }
}
