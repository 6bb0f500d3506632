//! From a scalar law to a stress tensor: the viscous stress, and the elastic trial with radial return.

use super::{PlasticLaw, TrialStress, ViscousLaw};
use crate::lanes::Real;
use crate::lanes::algebra::{accumulate, deviatoric_rate, invariant, matrix_product};
use crate::vector::{Tensor, deviator, double_contraction, strain_rate};

/// Deviatoric stress s = 2 η ε′ `[Pa]`, equation (30), of a velocity gradient `[1/s]` at a pressure `[Pa]`.
#[inline]
pub(super) fn viscous<L: ViscousLaw, const D: usize>(
    law: &L,
    velocity_gradient: &Tensor<D>,
    pressure: f64,
) -> Tensor<D> {
    let rate = deviator(&strain_rate(velocity_gradient));
    let shear_rate = (2.0 * double_contraction(&rate, &rate)).sqrt();
    rate * (2.0 * law.viscosity(shear_rate, pressure))
}

/// Deviatoric stress `[Pa]` after an elastic trial and a radial return.
///
/// Trial s* = s + 2 G Δt ε′. Where τ* = √(½ s*:s*) yields, s = s* τ/τ* with the law's admissible τ. Elsewhere the
/// trial is turned by the spin ω = ½(∇v − ∇vᵀ), s = s* + Δt (ω s* − s* ω). Not turned while yielding: the Jaumann
/// rate in steady shear gives a normal stress s_yy = −τ²/G, a bias of the flow that does not converge.
#[inline(always)]
pub(super) fn plastic<R: Real, L: PlasticLaw, const D: usize>(
    law: &L,
    previous: &[[R; D]; D],
    velocity_gradient: &[[R; D]; D],
    pressure: R,
    shear_modulus: f64,
    time_step: f64,
) -> [[R; D]; D] {
    let rate = deviatoric_rate(velocity_gradient);
    let mut trial = *previous;
    for i in 0..D {
        accumulate(&mut trial[i], R::splat(2.0 * shear_modulus * time_step), &rate[i]);
    }
    let mut spin = trial;
    for i in 0..D {
        for j in 0..D {
            spin[i][j] = R::splat(0.5 * time_step) * (velocity_gradient[i][j] - velocity_gradient[j][i]);
        }
    }
    let (ahead, behind) = (matrix_product(&spin, &trial), matrix_product(&trial, &spin));
    let trial_shear_stress = invariant(0.5, &trial);
    let yield_stress = law.yield_stress(pressure);
    let admissible =
        law.admissible_shear_stress(&TrialStress::new(trial_shear_stress, pressure, shear_modulus, time_step));
    let scale = admissible / trial_shear_stress;
    let mut stress = trial;
    for i in 0..D {
        for j in 0..D {
            let turned = trial[i][j] + (ahead[i][j] - behind[i][j]);
            let returned = scale * trial[i][j];
            // No pressure, no stress. A NaN has none either: a lost particle then carries no stress instead of
            // spreading NaN through its neighbours.
            stress[i][j] =
                returned.if_less(yield_stress, trial_shear_stress, turned).where_less(R::splat(0.0), pressure);
        }
    }
    stress
}

#[cfg(test)]
mod tests {
    use crate::material::rheology::{MuI, Newtonian, Rheology};
    use crate::vector::{Tensor, equivalent_shear_stress};

    const GLASS: MuI = MuI {
        static_friction: 0.382,
        limiting_friction: 0.643,
        reference_inertia: 0.279,
        grain_diameter: 0.5e-3,
        grain_density: 2500.0,
    };
    const PRESSURE: f64 = 100.0;
    const MODULUS: f64 = 2.0e4;

    fn shear(rate: f64) -> Tensor<2> {
        Tensor::<2>::new(0.0, rate, 0.0, 0.0)
    }

    #[test]
    fn steady_shear_converges_to_the_friction_law() {
        let law = Rheology::MuI(GLASS);
        for rate in [0.1, 5.0, 200.0] {
            let mut stress = Tensor::<2>::zeros();
            for _ in 0..40_000 {
                stress = law.updated_stress(&stress, &shear(rate), PRESSURE, MODULUS, 5e-5);
            }
            let expected = GLASS.friction_coefficient(GLASS.inertial_number(rate, PRESSURE)) * PRESSURE;
            assert!(
                (stress[(0, 1)] - expected).abs() < 1e-9 * expected,
                "rate {rate}: {} for {expected}",
                stress[(0, 1)]
            );
            assert!(stress[(1, 1)].abs() < 1e-2 * expected, "normal stress {}", stress[(1, 1)]);
            assert!((law.viscosity(rate, PRESSURE) * rate - expected).abs() < 1e-12 * expected);
        }
    }

    #[test]
    fn rigid_rotation_keeps_the_invariant_and_turns_the_axes() {
        let law = Rheology::MuI(GLASS);
        let rotation = Tensor::<2>::new(0.0, -3.0, 3.0, 0.0);
        let start = Tensor::<2>::new(10.0, 4.0, 4.0, -10.0);
        let (quarter_turn, trace) = (std::f64::consts::FRAC_PI_2 / 3.0, 0.0);
        let drift = |steps: u32| {
            let mut stress = start;
            for _ in 0..steps {
                stress = law.updated_stress(&stress, &rotation, PRESSURE, MODULUS, quarter_turn / f64::from(steps));
            }
            assert!((stress.trace() - trace).abs() < 1e-12);
            // A quarter turn changes the sign of every component of a plane deviator.
            assert!((stress + start).norm() < 0.2, "{stress}");
            equivalent_shear_stress(&stress) / equivalent_shear_stress(&start) - 1.0
        };
        let one_step = {
            let turned =
                |step: f64| equivalent_shear_stress(&law.updated_stress(&start, &rotation, PRESSURE, MODULUS, step));
            (turned(1e-3) / turned(0.0) - 1.0, turned(5e-4) / turned(0.0) - 1.0)
        };
        assert!((one_step.0 / one_step.1 - 4.0).abs() < 1e-3, "second order in a step: {one_step:?}");
        let (coarse, fine) = (drift(1000), drift(2000));
        assert!(coarse < 6e-3 && (coarse / fine - 2.0).abs() < 0.02, "first order over a turn: {coarse}, {fine}");
    }

    #[test]
    fn no_pressure_no_plastic_stress() {
        let held = Tensor::<2>::new(10.0, 4.0, 4.0, -10.0);
        for pressure in [0.0, -1.0, f64::NAN] {
            assert_eq!(
                Rheology::MuI(GLASS).updated_stress(&held, &shear(1.0), pressure, MODULUS, 1e-4),
                Tensor::<2>::zeros()
            );
        }
    }

    #[test]
    fn a_plane_state_is_the_same_in_three_dimensions() {
        // True where the plane strain is traceless; otherwise tr(ε)/D differs and so does the deviator.
        let plane = Tensor::<2>::new(1.5, 4.0, -2.0, -1.5);
        let solid = Tensor::<3>::new(1.5, 4.0, 0.0, -2.0, -1.5, 0.0, 0.0, 0.0, 0.0);
        for law in [
            Rheology::MuI(GLASS),
            Rheology::RegularisedMuI(GLASS.regularised(0.01)),
            Rheology::Newtonian(Newtonian { viscosity: 3.0 }),
        ] {
            let (mut in_plane, mut in_space) = (Tensor::<2>::zeros(), Tensor::<3>::zeros());
            for _ in 0..500 {
                in_plane = law.updated_stress(&in_plane, &plane, PRESSURE, MODULUS, 1e-5);
                in_space = law.updated_stress(&in_space, &solid, PRESSURE, MODULUS, 1e-5);
            }
            assert!((in_space.fixed_view::<2, 2>(0, 0) - in_plane).norm() < 1e-11 * in_plane.norm());
            assert!(in_space.row(2).norm() == 0.0 && in_space.column(2).norm() == 0.0);
        }
    }

    #[test]
    fn a_viscous_stress_ignores_volume_change_and_history() {
        let law = Rheology::Newtonian(Newtonian { viscosity: 3.0 });
        let held = Tensor::<2>::new(10.0, 4.0, 4.0, -10.0);
        let swelling = Tensor::<2>::new(7.0, 0.0, 0.0, 7.0);
        assert_eq!(law.updated_stress(&held, &swelling, PRESSURE, MODULUS, 1e-5), Tensor::<2>::zeros());
        let stress = law.updated_stress(&held, &shear(2.0), -5.0, MODULUS, 1e-5);
        assert!((stress[(0, 1)] - 6.0).abs() < 1e-14 && (stress[(1, 0)] - 6.0).abs() < 1e-14);
        assert!(!law.is_plastic() && law.largest_viscosity(PRESSURE) == 3.0);
    }

    #[test]
    fn plastic_laws_do_not_bound_the_explicit_step() {
        assert!(Rheology::MuI(GLASS).is_plastic());
        assert_eq!(Rheology::MuI(GLASS).largest_viscosity(1e5), 0.0);
    }
}
