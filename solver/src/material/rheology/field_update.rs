//! From a scalar law with a field to a stress tensor: the elastic trial, the law's return of both, and the spin.

use super::field::{FieldLaw, FieldReturn, FieldStep, StateReturn};
use super::{ElasticModuli, TrialStress};
use crate::lanes::Real;
use crate::lanes::algebra::{accumulate, deviatoric_rate, invariant, matrix_product};

/// Pressure, elastic moduli and length of a step.
#[derive(Clone, Copy)]
pub(super) struct Step<R> {
    /// `[Pa]`
    pub(super) pressure: R,
    /// `[Pa]`
    pub(super) moduli: ElasticModuli,
    /// `[s]`
    pub(super) time_step: f64,
}

/// Deviatoric stress `[Pa]`, field and memory after an elastic trial and the law's return.
///
/// As the return of a law without a field, but how much of the trial is turned by the spin is the law's to say: s = (τ/τ*) (s* + w Δt (ω s* − s* ω)).
#[inline(always)]
pub(super) fn with_field<R: Real, L: FieldLaw, const D: usize>(
    law: &L,
    previous: &[[R; D]; D],
    velocity_gradient: &[[R; D]; D],
    field: &FieldStep<R>,
    step: Step<R>,
) -> StateReturn<[[R; D]; D], R> {
    let Step { pressure, moduli: ElasticModuli { shear: shear_modulus, bulk }, time_step } = step;
    let zero = R::splat(0.0);
    let rate = deviatoric_rate(velocity_gradient);
    let mut trial_stress = *previous;
    for i in 0..D {
        accumulate(&mut trial_stress[i], R::splat(2.0 * shear_modulus * time_step), &rate[i]);
    }
    let mut vorticity = zero;
    for i in 0..D {
        for j in 0..i {
            let difference = velocity_gradient[i][j] - velocity_gradient[j][i];
            vorticity = vorticity + difference * difference;
        }
    }
    let trial_shear_stress = invariant(0.5, &trial_stress);
    let trial = TrialStress::new(trial_shear_stress, pressure, shear_modulus, time_step).with_bulk_modulus(bulk);
    let end: FieldReturn<R> = law.end_of_step(&trial, field);
    let half = R::splat(0.5 * time_step) * law.turned_part(&trial, field, &end, vorticity.sqrt());
    let mut spin = trial_stress;
    for i in 0..D {
        for j in 0..D {
            spin[i][j] = half * (velocity_gradient[i][j] - velocity_gradient[j][i]);
        }
    }
    let (ahead, behind) = (matrix_product(&spin, &trial_stress), matrix_product(&trial_stress, &spin));
    let scale = (end.shear_stress / trial_shear_stress).if_less(zero, trial_shear_stress, R::splat(1.0));
    // no pressure, no stress; nor has a particle whose state is lost
    let least = if law.bears_tension() { f64::NEG_INFINITY } else { 0.0 };
    let mut stress = trial_stress;
    for i in 0..D {
        for j in 0..D {
            let turned = trial_stress[i][j] + (ahead[i][j] - behind[i][j]);
            stress[i][j] = (scale * turned).where_less(R::splat(least), pressure);
        }
    }
    StateReturn { stress, field: end.field, memory: law.memory_after(&trial, field, &end) }
}
