//! Solid fraction of grains that dilate with their inertial number: φ = φ_max/(1 + B I), I = γ d √ρ_s/√p′.
//!
//! The pressure at the base is the weight of all grains. From there the march goes up, cell by cell: p′ in the middle of
//! a cell and γ give φ, whose weight leads to the next cell, until nothing is left. The last cell takes what remains, so
//! that no grain is lost.

/// Inputs of the march besides the shear.
#[derive(Debug, Clone, Copy)]
pub(super) struct Dilation {
    /// Height of a cell `[m]`.
    pub(super) cell_height: f64,
    /// Weight of all grains in the water `[Pa]`.
    pub(super) weight: f64,
    /// Submerged weight of a solid fraction of 1 `[N/m³]`.
    pub(super) submerged_weight: f64,
    /// φ_max `[-]`.
    pub(super) largest_fraction: f64,
}

/// Part of the weight that is no cell of its own, but the rounding of those below.
const ROUNDING: f64 = 1e-13;

impl Dilation {
    /// Solid fractions from B γ d √ρ_s `[√Pa]` of each cell; returns the weight `[Pa]` for which there was no room.
    pub(super) fn march(&self, shear: &[f64], fraction: &mut [f64]) -> f64 {
        let weight_of_cell = self.cell_height * self.submerged_weight;
        let mut below = self.weight;
        for (shear, fraction) in shear.iter().zip(fraction) {
            let share = share(below, *shear, 0.5 * weight_of_cell * self.largest_fraction);
            *fraction = (share * self.largest_fraction).min(below / weight_of_cell);
            below = (below - *fraction * weight_of_cell).max(0.0);
            if below < ROUNDING * self.weight {
                *fraction += below / weight_of_cell;
                below = 0.0;
            }
        }
        below
    }
}

/// x = φ/φ_max of a cell over a pressure: the root of x (r + a) = r with r² = p − c x, what the grains carry in its middle.
pub(super) fn share(below: f64, looseness: f64, carried: f64) -> f64 {
    if looseness <= 0.0 && carried <= below {
        return 1.0;
    }
    // the left side rises with x and the right one falls
    let root = |x: f64| (below - carried * x).max(0.0).sqrt();
    let is_below = |x: f64| x * (root(x) + looseness) < root(x);
    let (mut low, mut high, mut halvings) = (0.0, 1.0, HALVINGS);
    // Newton's steps lead to an interval that so many halvings would have led to, if it holds the root; else it is sought anew
    let lower = (newton(below, looseness, carried) / NARROW).floor().min(1.0 / NARROW - 1.0) * NARROW;
    if (lower == 0.0 || is_below(lower)) && (lower + NARROW == 1.0 || !is_below(lower + NARROW)) {
        (low, high, halvings) = (lower, lower + NARROW, HALVINGS - NARROWED);
    }
    for _ in 0..halvings {
        let middle = 0.5 * (low + high);
        if is_below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

/// x by Newton's steps of r from √p: r² + c r/(r + a) rises to p.
fn newton(below: f64, looseness: f64, carried: f64) -> f64 {
    let mut r = below.max(0.0).sqrt();
    for _ in 0..NEWTON_STEPS {
        let sum = r + looseness;
        let step = (below - r * r - carried * r / sum) / (2.0 * r + carried * looseness / (sum * sum));
        r = (r + step).max(0.0);
    }
    r / (r + looseness)
}

/// Halvings of [0, 1] that exhaust the digits.
const HALVINGS: usize = 56;

/// The width 2⁻ⁿ of the interval that Newton's steps lead to, and n: wide beside their rounding.
const NARROW: f64 = 1.0 / (1_u64 << NARROWED) as f64;
const NARROWED: usize = 46;

/// Number of Newton's steps; five are usual.
const NEWTON_STEPS: usize = 8;

#[cfg(test)]
mod tests {
    use super::*;
    use bagnold_solver::material::dilatancy::Dilatancy;

    const BED: Dilation =
        Dilation { cell_height: 2.5e-4, weight: 376.0, submerged_weight: 15_696.0, largest_fraction: 0.6 };

    /// The root by nothing but halvings.
    fn halved(below: f64, looseness: f64, carried: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1.0);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (low + high);
            let root = (below - carried * middle).max(0.0).sqrt();
            if middle * (root + looseness) < root { low = middle } else { high = middle }
        }
        0.5 * (low + high)
    }

    #[test]
    fn newtons_steps_lead_to_the_bits_of_halvings() {
        let mut seed = 1_u64;
        let mut next = || {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 11) as f64 / (1_u64 << 53) as f64
        };
        for _ in 0..100_000 {
            // from beds at rest to grains that fly, from weights of many cells to less than one
            let looseness = libm::exp(40.0 * next() - 30.0);
            let below = libm::exp(20.0 * next() - 12.0);
            let carried = libm::exp(12.0 * next() - 6.0);
            let (fast, sure) = (share(below, looseness, carried), halved(below, looseness, carried));
            assert!(fast.to_bits() == sure.to_bits(), "{fast} for {sure}: {below} Pa, {looseness}, {carried} Pa");
        }
    }

    fn marched(looseness: f64) -> (Vec<f64>, f64) {
        let mut fraction = vec![f64::NAN; 344];
        let left = BED.march(&[looseness; 344], &mut fraction);
        (fraction, left)
    }

    #[test]
    fn no_grain_is_lost() {
        for looseness in [0.0, 0.3, 5.0, 40.0] {
            let (fraction, left) = marched(looseness);
            let weight: f64 = fraction.iter().map(|fraction| fraction * 15_696.0 * 2.5e-4).sum();
            assert!(((weight + left) / 376.0 - 1.0).abs() < 1e-13, "{looseness}: {weight} and {left} Pa");
        }
    }

    #[test]
    fn grains_at_rest_keep_their_bed() {
        let (fraction, left) = marched(0.0);
        assert_eq!(left, 0.0);
        // 376 Pa/(0.6 · 15 696 N/m³) = 39.925 mm: 159.7 cells
        assert!(fraction[..159].iter().all(|fraction| *fraction == 0.6));
        assert!((fraction[159] / 0.6 - 0.7).abs() < 0.01, "{}", fraction[159]);
        assert!(fraction[160..].iter().all(|fraction| *fraction == 0.0));
    }

    /// x = φ/φ_max of a cell is the solver's law at the pressure in its middle.
    #[test]
    fn a_cell_has_the_fraction_of_the_law_in_the_solver() {
        let (dilation, diameter, density) = (0.31, 5e-3, 2600.0_f64);
        let law = Dilatancy { dilation, packing: 0.6, grain_diameter: diameter, grain_density: density };
        for (below, rate) in [(376.0, 0.4), (40.0, 30.0), (5.0, 3.0)] {
            let share = share(below, dilation * rate * diameter * density.sqrt(), 1.177);
            let pressure = below - 1.177 * share;
            let expected = law.solid_fraction(rate * diameter * (density / pressure).sqrt());
            assert!((0.6 * share - expected).abs() < 1e-14, "{below} Pa, {rate} 1/s: {} or {expected}", 0.6 * share);
        }
    }

    #[test]
    fn uniform_shear_has_its_exact_profile() {
        // dp/dz = −c r/(r + a) with r² = p: 2 (r + a) dr = −c dz, (r + a)² falls linearly
        let (fraction, left) = marched(5.0);
        assert_eq!(left, 0.0);
        let root = 376f64.sqrt();
        for cell in [0, 40, 100, 150] {
            let z = (f64::from(cell) + 0.5) * 2.5e-4;
            let looser = ((root + 5.0) * (root + 5.0) - 0.6 * 15_696.0 * z).sqrt();
            let exact = 0.6 * (looser - 5.0) / looser;
            assert!((fraction[cell as usize] - exact).abs() < 1e-4, "{z}: {} {exact}", fraction[cell as usize]);
        }
    }
}
