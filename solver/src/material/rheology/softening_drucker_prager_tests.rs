use super::field::{FieldLaw, FieldStep};
use super::lanes_of_a_law_tests::ShearedLaw;
use super::{ElasticModuli, MuI, PlasticLaw, Rheology, SofteningDruckerPrager, TrialStress};
use crate::vector::{Tensor, double_contraction, equivalent_shear_stress};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// 70 and 45 Pa under 100 Pa.
const SOIL: SofteningDruckerPrager = SofteningDruckerPrager {
    peak_friction: 0.6,
    residual_friction: 0.4,
    peak_cohesion: 10.0,
    residual_cohesion: 5.0,
    softening_strain: 0.25,
    peak_dilation: 0.0,
    dilation_strain: None,
};
const PRESSURE: f64 = 100.0;
const MODULI: ElasticModuli = ElasticModuli { shear: 2e3, bulk: 0.0 };

/// τ `[Pa]` at a shear strain γ `[-]` under [`PRESSURE`], written down from the peak and the residual strength: elastic to the peak, down
/// a line whose plastic part is κ_r long, residual.
fn curve(shear: f64, peak: f64, residual: f64, modulus: f64, softening_strain: f64) -> f64 {
    let (at_peak, at_residual) = (peak / modulus, softening_strain + residual / modulus);
    if shear < at_peak {
        modulus * shear
    } else if shear < at_residual {
        peak + (residual - peak) * (shear - at_peak) / (at_residual - at_peak)
    } else {
        residual
    }
}

/// Stress `[Pa]` and field after every step of a constant velocity gradient `[1/s]`, with steps of 1/256 s.
fn path<const D: usize>(gradient: &Tensor<D>, modulus: f64, steps: usize) -> Vec<(Tensor<D>, f64)> {
    let law = Rheology::SofteningDruckerPrager(SOIL);
    let (mut stress, mut strain) = (Tensor::<D>::zeros(), 0.0);
    let mut path = Vec::new();
    for _ in 0..steps {
        let field = FieldStep::alone(strain);
        (stress, strain) =
            law.updated_state(&stress, gradient, PRESSURE, &field, modulus, 1.0 / 256.0).stress_and_field();
        path.push((stress, strain));
    }
    path
}

fn check_path<const D: usize>(gradient: &Tensor<D>, modulus: f64, allowed: f64) {
    let mut before = 0.0;
    for (count, (stress, strain)) in path(gradient, modulus, 512).into_iter().enumerate() {
        let rate = (gradient + gradient.transpose()) / 2.0;
        let shear = (2.0 * double_contraction(&rate, &rate)).sqrt() * (count + 1) as f64 / 256.0;
        let (found, expected) = (equivalent_shear_stress(&stress), curve(shear, 70.0, 45.0, modulus, 0.25));
        assert!((found - expected).abs() < allowed * 70.0, "{found} for {expected} at {shear} with {modulus} Pa");
        // what is not elastic is plastic, and never comes back
        assert!((strain - (shear - expected / modulus)).abs() < (1.0 + shear) * allowed.max(1e-14) && strain >= before);
        before = strain;
    }
    assert!(before > 0.3, "{before} is beyond the softening");
}

/// H = 100 Pa. In pure shear nothing turns, and no step is too long.
#[test]
fn pure_shear_and_triaxial_compression_follow_the_exact_curve() {
    for modulus in [125.0, 200.0, 2e4, 1e7] {
        check_path(&Tensor::<2>::new(0.375, 0.0, 0.0, -0.375), modulus, 1e-13);
        // |γ̇| is √3 times the axial rate
        check_path(&Tensor::<3>::new(0.2, 0.0, 0.0, 0.0, 0.2, 0.0, 0.0, 0.0, -0.4), modulus, 1e-13);
    }
}

/// The elastic stress turns up to the yield, by an angle of Y/G: its normal stress is τ²/G, of the τ that is taken by steps of
/// first order.
#[test]
fn simple_shear_follows_the_exact_curve_up_to_the_turn_of_the_elastic_stress() {
    for modulus in [2e4, 1e6] {
        let turn: f64 = 70.0 / modulus;
        check_path(&Tensor::<2>::new(0.0, 0.75, 0.0, 0.0), modulus, 2.0 * turn * turn + 1e-13);
    }
    let (stress, _) = path(&Tensor::<2>::new(0.0, 0.75, 0.0, 0.0), 2e4, 512)[511];
    assert!((stress[(0, 1)] - 45.0).abs() < 45.0 * 1e-5 && stress[(1, 1)].abs() < 0.2, "{stress}");
}

/// At H ≥ G strength drops to its residual at once, in whatever step the peak is passed.
#[test]
fn softening_faster_than_unloading_drops_to_the_residual() {
    for modulus in [100.0, 40.0] {
        for (count, (stress, strain)) in
            path(&Tensor::<2>::new(0.375, 0.0, 0.0, -0.375), modulus, 1200).iter().enumerate()
        {
            let shear = 0.75 * (count + 1) as f64 / 256.0;
            let expected = if modulus * shear <= 70.0 { modulus * shear } else { 45.0 };
            assert!((equivalent_shear_stress(stress) - expected).abs() < 1e-11, "{stress} for {expected} at {shear}");
            assert!((strain - (shear - expected / modulus)).abs() < 1e-12);
        }
    }
}

/// Work of the stresses over a path = elastic energy τ²/2G + ∫ Y dκ, the area under the line and its end. Both kinks are at the end of a
/// step, so that the trapezium of every step is exact.
#[test]
fn plastic_work_is_the_area_under_the_strength() {
    // γ at the kinks: 70/256 and 0.25 + 45/256, multiples of a step's 1/256
    let (modulus, gradient) = (256.0, Tensor::<2>::new(0.5, 0.0, 0.0, -0.5));
    let (mut work, mut before) = (0.0, Tensor::<2>::zeros());
    for (stress, strain) in path(&gradient, modulus, 256) {
        work += 0.5 * double_contraction(&(stress + before), &gradient) / 256.0;
        let softened = strain.min(0.25);
        let plastic = softened * (70.0 - 50.0 * softened) + (strain - softened) * 45.0;
        let elastic = equivalent_shear_stress(&stress).powi(2) / (2.0 * modulus);
        assert!((work - plastic - elastic).abs() < 1e-12 * work, "{work} for {plastic} and {elastic} at {strain}");
        before = stress;
    }
    assert!(work > 40.0);
}

/// The implicit equation by bisection over Δκ, whose strength is written once more.
fn bisected(law: &SofteningDruckerPrager, trial: &TrialStress<f64>, strain: f64) -> (f64, f64) {
    let strength = |strain: f64| {
        let softened = (strain / law.softening_strain).min(1.0);
        let friction = law.peak_friction + softened * (law.residual_friction - law.peak_friction);
        friction * trial.pressure + law.peak_cohesion + softened * (law.residual_cohesion - law.peak_cohesion)
    };
    if trial.shear_stress <= strength(strain) {
        return (trial.shear_stress, strain);
    }
    let (mut low, mut high) = (0.0, trial.shear_stress / trial.shear_modulus);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        let excess = trial.shear_stress - trial.shear_modulus * middle - strength(strain + middle);
        if excess > 0.0 { low = middle } else { high = middle }
    }
    (trial.shear_stress - trial.shear_modulus * low, strain + low)
}

#[test]
fn stress_and_strain_solve_their_equation_together() {
    let mut random = Pcg64Mcg::seed_from_u64(5);
    let mut branches = [0; 4];
    for _ in 0..8000 {
        let (friction, cohesion) = (random.random_range(0.0..1.2), libm::exp(random.random_range(-4.0..6.0)));
        let law = SofteningDruckerPrager {
            peak_friction: friction,
            residual_friction: friction * random.random::<f64>(),
            peak_cohesion: cohesion,
            residual_cohesion: cohesion * random.random::<f64>(),
            softening_strain: libm::exp(random.random_range(-7.0..1.0)),
            ..SOIL
        };
        let pressure = libm::exp(random.random_range(-3.0..9.0));
        let modulus = libm::exp(random.random_range(3.0..12.0));
        let strain = law.softening_strain * random.random_range(0.0..1.3);
        let stress = law.strength(pressure, strain) * libm::exp(random.random_range(-0.5..1.0));
        let trial = TrialStress::new(stress, pressure, modulus, 1e-4);
        let end = law.end_of_step(&trial, &FieldStep::alone(strain));
        let (expected, after) = bisected(&law, &trial, strain);
        assert!(
            (end.shear_stress - expected).abs() < 1e-11 * stress,
            "{end:?} for {expected}: {law:?} {trial:?} {strain}"
        );
        assert!(
            (end.field - after).abs() < 1e-11 * (after + stress / modulus),
            "{end:?} for {after}: {law:?} {trial:?}"
        );
        assert!(end.shear_stress <= stress && end.field >= strain);
        let steep = law.strength(pressure, 0.0) - law.strength(pressure, 9e9) > modulus * law.softening_strain;
        branches[match (end.field > strain, end.field < law.softening_strain) {
            (false, _) => 0,
            (true, true) => 1,
            (true, false) if steep && strain < law.softening_strain => 2,
            _ => 3,
        }] += 1;
    }
    assert!(branches.iter().all(|&count| count > 300), "elastic, softening, dropped, residual: {branches:?}");
}

#[test]
fn without_softening_and_cohesion_it_is_coulomb_friction() {
    let grains = MuI {
        static_friction: 0.382,
        limiting_friction: 0.382,
        reference_inertia: 0.279,
        grain_diameter: 0.5e-3,
        grain_density: 2500.0,
    };
    let law = SofteningDruckerPrager::from(grains);
    for ratio in [0.1, 0.38, 0.39, 0.8, 3.0] {
        let trial = TrialStress::new(100.0 * ratio, 100.0, 2e4, 5e-5);
        let (found, coulomb) =
            (law.end_of_step(&trial, &FieldStep::alone(0.3)).shear_stress, grains.admissible_shear_stress(&trial));
        assert!((found - coulomb).abs() < 1e-14 * coulomb, "{found} against {coulomb} at {ratio}");
    }
    assert_eq!(law.contact_friction(), grains.contact_friction());
    assert!((law.viscosity(2.0, 100.0) - grains.viscosity(2.0, 100.0)).abs() < 1e-13);
    assert!(law.strength_is_friction() && law.is_solid() && !SOIL.strength_is_friction());
    // clay without drainage has no friction, and yet no liquid's boundary layer
    let clay = SofteningDruckerPrager { peak_friction: 0.0, residual_friction: 0.0, ..SOIL };
    assert!(clay.is_solid() && clay.contact_friction() == 0.0);
}

#[test]
fn no_pressure_no_stress_and_no_step_no_strain() {
    for pressure in [0.0, -0.0, f64::NAN] {
        for step in [0.0, 1e-4] {
            let end = SOIL.end_of_step(&TrialStress::new(500.0, pressure, 2e4, step), &FieldStep::alone(0.1));
            assert_eq!((end.shear_stress, end.field), (0.0, 0.1));
            assert_eq!(SOIL.elasticity(0.0, pressure, &FieldStep::alone(0.1), 1.0), 0.0);
            assert_eq!(SOIL.viscosity(1.0, pressure), 0.0);
        }
    }
    let end = SOIL.end_of_step(&TrialStress::new(500.0, 100.0, 2e4, 0.0), &FieldStep::alone(0.0));
    assert_eq!((end.shear_stress, end.field), (70.0, 0.0));
    assert_eq!((SOIL.field_in_flow(2.0, 0.4), SOIL.field_in_flow(0.0, 0.4)), (0.25, 0.0));
}

/// The ends of what the parameters' rules allow, in all combinations, with steps from none to all of the strength.
#[test]
fn every_allowed_input_gives_a_finite_state_without_hardening() {
    for peak_friction in [0.0, 4e-15, 0.6, 1.0] {
        for peak_cohesion in [0.0, 4e-12, 10.0, 1e15] {
            for kept in [0.0, 0.5, 1.0] {
                for softening_strain in [1e-15, 0.1, 1e9] {
                    let law = SofteningDruckerPrager {
                        peak_friction,
                        residual_friction: kept * peak_friction,
                        peak_cohesion,
                        residual_cohesion: kept * peak_cohesion,
                        softening_strain,
                        ..SOIL
                    };
                    assert_eq!(Rheology::SofteningDruckerPrager(law).parameter_problem(), None, "{law:?}");
                    for (pressure, modulus) in [(1e-12, 1e-9), (100.0, 2e4), (1e15, 1e15)] {
                        for (stress, strain) in [(0.0, 0.0), (1e-12, 1e-15), (70.0, 0.05), (1e20, 0.0), (1e15, 1e9)] {
                            let trial = TrialStress::new(stress, pressure, modulus, 1e-5);
                            let end = law.end_of_step(&trial, &FieldStep::alone(strain));
                            assert!((0.0..=stress).contains(&end.shear_stress), "{end:?} {law:?} {trial:?}");
                            assert!(end.field >= strain && end.field.is_finite(), "{end:?} {law:?} {trial:?}");
                            assert!(law.viscosity(stress, pressure).is_finite());
                            let part = law.elasticity(end.shear_stress, pressure, &FieldStep::alone(end.field), 1.0);
                            assert!((0.0..=1.0).contains(&part), "{part} {law:?}");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn strength_that_rises_with_the_strain_is_refused() {
    let problem = |law| {
        let problem = Rheology::SofteningDruckerPrager(law).parameter_problem().expect("refused");
        (problem.field, problem.rule)
    };
    let friction = SofteningDruckerPrager { residual_friction: 0.7, ..SOIL };
    assert_eq!(problem(friction), ("residual_friction".to_owned(), "at most `peak_friction`".to_owned()));
    let cohesion = SofteningDruckerPrager { residual_cohesion: 11.0, ..SOIL };
    assert_eq!(problem(cohesion), ("residual_cohesion".to_owned(), "at most `peak_cohesion`".to_owned()));
    for bad in [f64::NAN, f64::INFINITY, -1.0] {
        let strain = SofteningDruckerPrager { softening_strain: bad, ..SOIL };
        assert_eq!(problem(strain).0, "softening_strain");
        assert_eq!(problem(SofteningDruckerPrager { peak_cohesion: bad, ..SOIL }).0, "peak_cohesion");
    }
}

/// The cone goes on to its apex at p = −k/μ, 10/0.6 Pa here, and there is no strength beyond it; friction does not soften under tension.
#[test]
fn a_cohesion_bears_tension_up_to_the_apex_of_the_cone() {
    for (pressure, peak, residual) in [(-5.0, 7.0, 3.0), (-14.0, 1.6, 0.0), (-17.0, 0.0, 0.0), (-1e9, 0.0, 0.0)] {
        assert!(
            (SOIL.strength(pressure, 0.0) - peak).abs() < 1e-14
                && (SOIL.strength(pressure, 1.0) - residual).abs() < 1e-14
        );
        for (strain, strength) in [(0.0, peak), (1.0, residual)] {
            let held =
                SOIL.end_of_step(&TrialStress::new(0.5 * strength, pressure, 2e4, 1e-4), &FieldStep::alone(strain));
            assert_eq!((held.shear_stress, held.field), (0.5 * strength, strain));
            let end = SOIL.end_of_step(&TrialStress::new(20.0, pressure, 2e9, 1e-4), &FieldStep::alone(strain));
            assert!((end.shear_stress - strength).abs() < 1e-6 && end.field > strain, "{end:?} for {strength}");
        }
    }
    let firm = SofteningDruckerPrager { residual_cohesion: 10.0, ..SOIL };
    assert_eq!(firm.strength(-5.0, 0.0), firm.strength(-5.0, 1.0));
    let (law, stress) = (Rheology::SofteningDruckerPrager(SOIL), Tensor::<2>::new(1.0, 2.0, 2.0, -1.0));
    let rest = Tensor::<2>::zeros();
    assert_eq!(law.updated_stress(&stress, &rest, -5.0, 2e4, 1e-4), stress);
    assert_eq!(law.updated_stress(&stress, &rest, 0.0, 2e4, 1e-4), rest);
}

#[test]
fn eight_lanes_of_every_instruction_set_give_the_bits_of_one_value() {
    let (expected, fields) = ShearedLaw {
        law: Rheology::SofteningDruckerPrager(SOIL),
        pressure: [-5.0, 0.0, 1e-3, 1.0, 20.0, 300.0, 4e3, f64::NAN],
        moduli: MODULI,
        time_step: 1e-3,
        steps: 60,
        initial_field: 0.0,
        exchange: (0.0, 0.0),
    }
    .check();
    // softening, and elastic under a great pressure
    assert!(fields[3] > 0.1 && fields[4] > 0.1 && fields[6] == 0.0 && expected[6].norm() > 100.0, "{fields:?}");
}
