//! Suspension: grains that eddies lift against their settling.
//!
//! Eddies mix grains with a diffusivity ε = ν_t/Sc; grains sink through the water at the hindered velocity w(φ) of their own
//! drag law. Averaged drag (Hsu et al. 2004, Chauchat 2018) adds a force to the weight that grains in contact carry:
//!
//! ```text
//! ∂_z p′ = −c φ − D ∂_z φ,    D = c ε/w(φ),    c = (ρ_s − ρ_f) g cosθ,    p′ = (B γ d)² ρ_s (φ/(φ_max − φ))²
//! ```
//!
//! Without contacts it is the balance of fluxes w φ = −ε ∂_z φ, whose solution is Rouse's profile where ν_t is parabolic.
//! Without eddies it is the weight of the grains above. The water carries what contacts do not, ∫ D ∂_z φ dz; the pressure
//! at the base therefore follows from the amount of grains.
//!
//! Cells march upwards from the base: trapezia for the weight, differences for ∂_z φ, second order.

use super::dilation::share;

/// Inputs besides shear and eddies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Suspension {
    /// Height of a cell `[m]`.
    pub(super) cell_height: f64,
    /// Weight of all grains in the water `[Pa]`.
    pub(super) weight: f64,
    /// Submerged weight c of a solid fraction of 1 `[N/m³]`.
    pub(super) submerged_weight: f64,
    /// φ_max `[-]`.
    pub(super) largest_fraction: f64,
}

/// Conditions of the march, from the base up.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stirring<'a> {
    /// B γ d √ρ_s `[√Pa]` in the cells.
    pub(super) shear: &'a [f64],
    /// D `[Pa]` at the faces, that of the base first.
    pub(super) dispersion: &'a [f64],
}

/// Share of the weight to which the amount of grains is met `[-]`.
const ROUNDING: f64 = 1e-14;

/// Largest number of marches in search of the base pressure; ten are usual.
const MARCHES: usize = 60;

impl Suspension {
    /// Solid fractions of the given amount of grains; returns the weight `[Pa]` that is missing or left over.
    ///
    /// The base pressure is sought between 0 and the whole weight by false position (Illinois).
    pub(super) fn fractions(&self, stirring: &Stirring, fraction: &mut [f64]) -> f64 {
        let mut excess = |base: f64| self.march(base, stirring, fraction) - self.weight;
        let (mut low, mut below) = (0.0, -self.weight);
        let (mut high, mut above) = (self.weight, excess(self.weight));
        let mut found = above;
        let mut last_was_high = None;
        for _ in 0..MARCHES {
            if found.abs() <= ROUNDING * self.weight || above <= 0.0 {
                break;
            }
            let middle = (low * above - high * below) / (above - below);
            found = excess(middle);
            let is_high = found > 0.0;
            // a side that stays twice running loses half of its value
            let kept = if last_was_high == Some(is_high) { 0.5 } else { 1.0 };
            if is_high {
                (high, above, below) = (middle, found, kept * below);
            } else {
                (low, below, above) = (middle, found, kept * above);
            }
            last_was_high = Some(is_high);
        }
        found
    }

    /// Solid fractions over a base pressure `[Pa]`; returns the weight of the grains `[Pa]`.
    pub(super) fn march(&self, base: f64, stirring: &Stirring, fraction: &mut [f64]) -> f64 {
        let half = 0.5 * self.cell_height * self.submerged_weight;
        // p′ at the middle of the cell below and φ there
        let (mut pressure, mut lower, mut weight) = (base, 0.0, 0.0);
        for (k, fraction) in fraction.iter_mut().enumerate() {
            let dispersion = if k == 0 { 0.0 } else { stirring.dispersion[k] };
            let below = pressure + (dispersion - half) * lower;
            let carried = half + dispersion;
            *fraction = if below > 0.0 {
                self.largest_fraction * share(below, stirring.shear[k], carried * self.largest_fraction)
            } else {
                0.0
            };
            pressure = (below - carried * *fraction).max(0.0);
            lower = *fraction;
            weight += 2.0 * half * lower;
        }
        weight
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settling::SettlingGrains;
    use bagnold_solver::material::drag::{DragLaw, SettlingTable};

    /// Grains of 0.2 mm of sand, by their settling velocity `[m/s]`, and a stream of 0.1 m with u_* = 0.05 m/s.
    const SETTLING: f64 = 0.025;
    const DEPTH: f64 = 0.1;
    const SHEAR_VELOCITY: f64 = 0.05;
    const KARMAN: f64 = 0.41;
    const WEIGHT: f64 = 16_186.5;
    /// Height of the lowest cell over the depth.
    const BOTTOM: f64 = 0.05;

    /// Eddies and settling of a suspension.
    #[derive(Clone, Copy)]
    struct Physics {
        schmidt: f64,
        settling: f64,
    }

    const RIGHT: Physics = Physics { schmidt: 0.7, settling: SETTLING };

    impl Physics {
        /// z/h and φ/φ_a of the cells, φ_a that of the lowest.
        fn profile(self, cells: usize) -> Vec<(f64, f64)> {
            let cell_height = (1.0 - BOTTOM) * DEPTH / cells as f64;
            let face = |k: usize| BOTTOM * DEPTH + k as f64 * cell_height;
            let eddies = |z: f64| KARMAN * SHEAR_VELOCITY * z * (1.0 - z / DEPTH);
            let dispersion: Vec<f64> =
                (0..=cells).map(|k| WEIGHT * eddies(face(k)).max(0.0) / (self.schmidt * self.settling)).collect();
            let suspension =
                Suspension { cell_height, weight: f64::NAN, submerged_weight: WEIGHT, largest_fraction: 0.6 };
            let mut fraction = vec![0.0; cells];
            let stirring = Stirring { shear: &vec![0.0; cells], dispersion: &dispersion };
            let weight = suspension.march(0.5 * cell_height * WEIGHT * 0.01, &stirring, &mut fraction);
            let sum: f64 = fraction.iter().sum();
            assert!((weight / (sum * cell_height * WEIGHT) - 1.0).abs() < 1e-12);
            (0..cells).map(|k| ((face(k) + 0.5 * cell_height) / DEPTH, fraction[k] / fraction[0])).collect()
        }

        /// Largest relative distance from Rouse's profile with the right physics, up to 0.9 of the depth.
        fn error(self, cells: usize) -> f64 {
            let profile = self.profile(cells);
            let exponent = RIGHT.settling * RIGHT.schmidt / (KARMAN * SHEAR_VELOCITY);
            let part = |z: f64| (1.0 - z) / z;
            let exact = |z: f64| libm::pow(part(z) / part(profile[0].0), exponent);
            let below = profile.iter().filter(|(z, _)| *z < 0.9);
            below.map(|(z, share)| (share / exact(*z) - 1.0).abs()).fold(0.0, f64::max)
        }
    }

    #[test]
    fn eddies_and_settling_make_rouses_profile() {
        let errors = [40, 80, 160, 320].map(|cells| RIGHT.error(cells));
        assert!(errors[0] < 2e-3 && errors[3] < 2e-5, "{errors:?}");
        for pair in errors.windows(2) {
            let order = libm::log2(pair[0] / pair[1]);
            assert!((order - 2.0).abs() < 0.3, "{errors:?}: order {order}");
        }
    }

    #[test]
    fn without_eddies_or_settling_rouses_profile_is_missed() {
        let no_eddies = Physics { schmidt: 1e9, ..RIGHT };
        let no_settling = Physics { settling: 1e-9, ..RIGHT };
        assert!(no_eddies.error(160) > 0.5, "{}", no_eddies.error(160));
        assert!(no_settling.error(160) > 0.5, "{}", no_settling.error(160));
        // uniform without settling, nothing above the lowest cell without eddies
        assert!(no_settling.profile(160).iter().all(|(_, share)| (share - 1.0).abs() < 1e-6));
        assert!(no_eddies.profile(160)[1..].iter().all(|(_, share)| *share == 0.0));
    }

    #[test]
    fn a_tenth_of_the_schmidt_number_is_seen() {
        let wrong = Physics { schmidt: 1.1 * RIGHT.schmidt, ..RIGHT };
        assert!(wrong.error(160) > 0.05, "{}", wrong.error(160));
    }

    /// Where D is constant and grains do not touch, φ falls exponentially over D/c.
    #[test]
    fn uniform_eddies_make_an_exponential_suspension() {
        let (cells, cell_height, dispersion) = (344, 2.5e-4, 30.0);
        let suspension = Suspension { cell_height, weight: 2.0, submerged_weight: 15_696.0, largest_fraction: 0.6 };
        let mut fraction = vec![f64::NAN; cells];
        let stirring = Stirring { shear: &vec![0.0; cells], dispersion: &vec![dispersion; cells + 1] };
        let left = suspension.fractions(&stirring, &mut fraction);
        assert!(left.abs() < 1e-13, "{left}");
        let step: f64 = 15_696.0 * cell_height / dispersion;
        for cell in [10, 40, 80] {
            let exact = libm::exp(-step * f64::from(cell));
            let computed = fraction[cell as usize] / fraction[0];
            assert!((computed / exact - 1.0).abs() < 1.1 * f64::from(cell) * step * step * step / 12.0, "{cell}");
        }
    }

    /// Grains in contact without eddies are those of the march over the weight.
    #[test]
    fn without_eddies_the_weight_lies_on_contacts() {
        use super::super::dilation::Dilation;
        let (cells, cell_height, weight, submerged_weight, largest_fraction) = (344, 2.5e-4, 376.0, 15_696.0, 0.6);
        let shear = vec![5.0; cells];
        let mut contacts = vec![0.0; cells];
        Dilation { cell_height, weight, submerged_weight, largest_fraction }.march(&shear, &mut contacts);
        let mut suspended = vec![0.0; cells];
        let stirring = Stirring { shear: &shear, dispersion: &vec![0.0; cells + 1] };
        let suspension = Suspension { cell_height, weight, submerged_weight, largest_fraction };
        assert!(suspension.fractions(&stirring, &mut suspended).abs() < 1e-11);
        // the topmost grains differ: the march over the weight gives what is left to its last cell
        let top = contacts.iter().rposition(|fraction| *fraction > 0.1).expect("grains");
        for k in 0..top {
            assert!((contacts[k] - suspended[k]).abs() < 1e-4, "{k}: {} {}", contacts[k], suspended[k]);
        }
    }

    #[test]
    fn the_table_has_the_velocities_of_the_law() {
        let grains = SettlingGrains {
            grain_diameter: 1.5e-3,
            grain_density: 1192.0,
            fluid_density: 1000.0,
            kinematic_viscosity: 1e-6,
            gravity: 9.81,
        };
        let table = SettlingTable::new(&grains.settling(), DragLaw::DiFelice, 0.6);
        for fraction in [1e-6, 0.0371, 0.2, 0.333, 0.599] {
            let exact = grains.hindered_velocity(DragLaw::DiFelice, fraction).expect("settles");
            assert!((table.at(fraction) / exact - 1.0).abs() < 1e-4, "{fraction}: {} {exact}", table.at(fraction));
        }
    }
}
