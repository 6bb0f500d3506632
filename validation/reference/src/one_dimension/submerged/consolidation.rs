//! Terzaghi's consolidation: decay of a uniform excess pore pressure in a layer with a drained surface and an undrained
//! floor.

use std::f64::consts::PI;

/// Terms of the series; at a time factor of 0.01 the last is below 1e-16.
const TERMS: u32 = 20;

/// Excess pore pressure over that of the start `[-]`, at a height over the depth `[-]` and a time factor c_v t/h² `[-]`.
#[must_use]
pub fn drained_pressure(height: f64, time_factor: f64) -> f64 {
    let term = |m: u32| {
        let odd = f64::from(2 * m + 1);
        let sign = if m.is_multiple_of(2) { 1.0 } else { -1.0 };
        let decay = libm::exp(-0.25 * odd * odd * PI * PI * time_factor);
        4.0 / (PI * odd) * sign * libm::cos(0.5 * odd * PI * height) * decay
    };
    (0..TERMS).rev().map(term).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_of_the_pressure_has_drained_at_the_tabulated_time_factor() {
        // T = 0.197 for a degree of consolidation of 50 %, 0.848 for 90 %
        let mean = |time_factor| {
            (0..1000).map(|k| drained_pressure((f64::from(k) + 0.5) / 1e3, time_factor)).sum::<f64>() / 1e3
        };
        assert!((mean(0.197) - 0.5).abs() < 1e-3, "{}", mean(0.197));
        assert!((mean(0.848) - 0.1).abs() < 1e-3, "{}", mean(0.848));
        assert!(drained_pressure(1.0, 0.2).abs() < 1e-12);
    }
}
