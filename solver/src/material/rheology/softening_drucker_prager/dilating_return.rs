//! The return of Drucker and Prager's strength where plastic flow dilates and so raises the pressure.
//!
//! Plastic dilation in a step of given volume is compressed elastically. With the trial τ* and p* (elastic, at κ⁰),
//!
//! τ* − G Δκ = Y(κ⁰ + Δκ, p), p = p* + (K + p*) (exp(e(κ⁰ + Δκ) − e(κ⁰)) − 1),
//!
//! the second with the equation of state p = K (ρ exp(e)/ρ0 − 1). The excess g(Δκ), left side less right side, is positive at 0 and not at τ*/G. Between
//! the kinks at κ_r and κ_d, Y is concave in Δκ but for the curvature of the exponential, so that Newton's steps from 0, which end at
//! the next kink at the latest, find the first root: the one to which the strain grows as the load does. Where g rises (the material softens faster than
//! it unloads) there is none before the next kink. A bracket halves what tension makes of Y elsewhere; every step gains one bit or more.

use super::{SofteningDruckerPrager, where_held};
use crate::lanes::Real;
use crate::material::rheology::TrialStress;
use crate::material::rheology::field::FieldReturn;

/// Most evaluations: those of a bracket that is halved down to rounding.
const MOST: usize = 80;

/// Relative distance from a kink within which it counts as reached `[-]`.
const KINK: f64 = 4.0 * f64::EPSILON;

/// The excess g `[Pa]` and its derivative `[Pa]`.
struct Excess {
    value: f64,
    slope: f64,
}

impl SofteningDruckerPrager {
    /// Shear stress and plastic shear strain at the end of a step at a given volume, from the strain before.
    pub(super) fn dilating_end_of_step<R: Real>(&self, trial: &TrialStress<R>, before: R) -> FieldReturn<R> {
        let (zero, dilation) = (R::splat(0.0), self.dilation());
        let strain =
            R::lane_by_lane([trial.shear_stress, trial.pressure, before], &|[shear_stress, pressure, before]| {
                // what has come apart stays as it was
                if pressure == 0.0 || pressure.is_nan() {
                    0.0
                } else {
                    self.dilating_strain(&trial.at(shear_stress, pressure), before)
                }
            });
        let after = before + strain;
        let swelling = dilation.volume_strain(after) - dilation.volume_strain(before);
        let strength = self.strength(trial.dilated_pressure(swelling), after);
        let yields = strength.min(trial.shear_stress).if_less(zero, strain, trial.shear_stress);
        FieldReturn { shear_stress: where_held(yields, trial.pressure, zero), field: after }
    }

    /// Δκ `[-]` of a step from a plastic shear strain `[-]`, which dilates at a given volume.
    pub(super) fn dilating_strain(&self, trial: &TrialStress<f64>, before: f64) -> f64 {
        let &TrialStress { shear_stress, shear_modulus, .. } = trial;
        let (mut low, mut high) = (0.0, shear_stress / shear_modulus);
        let mut strain = 0.0;
        for _ in 0..MOST {
            let excess = self.excess(trial, before, strain);
            if strain == 0.0 && (excess.value.is_nan() || excess.value <= 0.0) {
                return 0.0;
            }
            let rises = excess.slope >= 0.0;
            let step = -excess.value / excess.slope;
            let settled = !rises && step.abs() <= 4.0 * f64::EPSILON * (before + strain);
            if settled || excess.value.abs() <= 2.0 * f64::EPSILON * shear_stress {
                break;
            }
            let mut next = if rises { f64::INFINITY } else { strain + step };
            if excess.value > 0.0 {
                low = strain;
                next = next.min(self.next_kink(before + strain) - before);
            } else {
                high = strain;
            }
            if !(next > low && next < high) {
                next = 0.5 * (low + high);
            }
            // low and high are neighbours
            if next == strain {
                break;
            }
            strain = next;
        }
        strain
    }

    fn excess(&self, trial: &TrialStress<f64>, before: f64, strain: f64) -> Excess {
        let (dilation, after) = (self.dilation(), before + strain);
        let swelling = dilation.volume_strain(after) - dilation.volume_strain(before);
        let pressure = trial.dilated_pressure(swelling);
        let (residual, lost) = self.residual_and_lost(pressure);
        // the slope behind a kink that the strain has come to but for rounding
        let ahead = after * (1.0 + KINK);
        let retained = self.retained(self.strain_left(after));
        let strength = residual + lost * retained;
        // of Y by the pressure
        let peak_friction = if residual + lost > 0.0 { self.peak_friction } else { 0.0 };
        let residual_friction = match residual {
            none if none <= 0.0 => 0.0,
            _ if lost > 0.0 => self.residual_friction,
            _ => peak_friction.min(self.residual_friction),
        };
        let friction = residual_friction + (peak_friction - residual_friction) * retained;
        let rising = friction * (trial.bulk_modulus + pressure) * dilation.ratio(ahead);
        let falling = if ahead < self.softening_strain { lost / self.softening_strain } else { 0.0 };
        Excess {
            value: trial.shear_stress - trial.shear_modulus * strain - strength,
            slope: falling - rising - trial.shear_modulus,
        }
    }

    /// The next strain `[-]` beyond one at which strength or dilation ends to fall.
    fn next_kink(&self, strain: f64) -> f64 {
        let kinks = [self.softening_strain, self.dilation().strain];
        kinks.into_iter().filter(|&kink| kink > strain * (1.0 + KINK)).fold(f64::INFINITY, f64::min)
    }
}
