use super::field::{FieldLaw, FieldStep};
use super::lanes_of_a_law_tests::ShearedLaw;
use super::{ElasticModuli, MuI, NonlocalMuI, PlasticLaw, Rheology, TrialStress};
use crate::vector::Tensor;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

const GLASS: MuI = MuI {
    static_friction: 0.3819,
    limiting_friction: 0.6435,
    reference_inertia: 0.279,
    grain_diameter: 0.5e-3,
    grain_density: 2450.0,
};

/// The equations of the law's head, solved by bisection over μ with the positive root of the quadratic equation of g: it shares
/// no algebra with the cubic. Returns τ and g.
fn bisected(law: &NonlocalMuI, trial: &TrialStress<f64>, field: &FieldStep<f64>) -> (f64, f64) {
    let &TrialStress { shear_stress, pressure, shear_modulus, time_step, .. } = trial;
    let range = law.limiting_friction - law.static_friction;
    let coefficient = range / law.reference_inertia * law.grain_diameter * (law.grain_density / pressure).sqrt();
    let (inverse, elastic) = (law.relaxation_time / time_step, shear_modulus * time_step / pressure);
    let trial_friction = shear_stress / pressure;
    let least = law.seed * (pressure / law.grain_density).sqrt() / law.grain_diameter;
    let before = if trial_friction > law.static_friction { field.value.max(least) } else { field.value };
    let source = inverse * before + field.gain;
    let fluidity = |friction: f64| {
        let growth = range * (friction - law.static_friction) / (law.limiting_friction - friction);
        let (linear, square) = (inverse + field.loss - growth, coefficient * friction);
        let root = (linear * linear + 4.0 * square * source).sqrt();
        if linear < 0.0 { 0.5 * (root - linear) / square } else { 2.0 * source / (root + linear) }
    };
    let (mut low, mut high) = (0.0, trial_friction.min(law.limiting_friction));
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if middle * (1.0 + elastic * fluidity(middle)) < trial_friction { low = middle } else { high = middle }
    }
    // of the two equations the one that does not cancel
    let relaxed = trial_friction / low - 1.0;
    (low * pressure, if relaxed > 1e-4 { relaxed / elastic } else { fluidity(low) })
}

#[test]
fn stress_and_fluidity_solve_their_equations_together() {
    let mut random = Pcg64Mcg::seed_from_u64(11);
    let mut beyond = 0;
    for _ in 0..4000 {
        let law = NonlocalMuI {
            cooperativity: 0.48,
            relaxation_time: libm::exp(random.random_range(-16.0..-5.0)),
            seed: 1e-6,
            static_friction: random.random_range(0.1..0.6),
            limiting_friction: random.random_range(0.61..1.3),
            reference_inertia: libm::exp(random.random_range(-3.0..1.5)),
            grain_diameter: libm::exp(random.random_range(-9.0..-3.0)),
            grain_density: random.random_range(1000.0..4000.0),
            ..NonlocalMuI::of(GLASS)
        };
        let pressure = libm::exp(random.random_range(-3.0..9.0));
        let stress = law.static_friction * pressure * libm::exp(random.random_range(-3.0..3.0));
        let modulus = libm::exp(random.random_range(5.0..14.0));
        let step = libm::exp(random.random_range(-14.0..-5.0));
        let value = libm::exp(random.random_range(-20.0..7.0));
        let loss = libm::exp(random.random_range(-9.0..2.0));
        let trial = TrialStress::new(stress, pressure, modulus, step);
        let field = FieldStep::new(value, loss * value * random.random_range(0.5..1.5), loss);
        let end = law.end_of_step(&trial, &field);
        let (expected, fluidity) = bisected(&law, &trial, &field);
        assert!((end.shear_stress - expected).abs() < 1e-9 * expected, "{end:?} against {expected}: {law:?} {trial:?}");
        assert!(
            (end.field - fluidity).abs() < 1e-6 * fluidity,
            "{end:?} against {fluidity}: {law:?} {trial:?} {field:?}"
        );
        assert!(end.shear_stress < law.limiting_friction * pressure && end.shear_stress <= stress && end.field >= 0.0);
        beyond += u32::from(stress > law.limiting_friction * pressure);
    }
    assert!(beyond > 500, "{beyond} trials are beyond the limiting friction");
}

#[test]
fn without_cooperation_and_relaxation_it_is_the_local_law() {
    let law = NonlocalMuI { cooperativity: 0.0, relaxation_time: 1e-15, seed: 0.0, ..NonlocalMuI::of(GLASS) };
    for ratio in [0.39, 0.5, 0.8, 3.0] {
        for value in [1e-3, 1.0, 100.0] {
            let trial = TrialStress::new(100.0 * ratio, 100.0, 2e4, 5e-5);
            let found = law.end_of_step(&trial, &FieldStep::alone(value)).shear_stress;
            let local = GLASS.admissible_shear_stress(&trial);
            assert!((found - local).abs() < 1e-6 * local, "{found} against {local} at {ratio}");
        }
    }
    assert!(law.field().diffusion.is_none());
}

#[test]
fn steady_shear_is_the_local_flow_whatever_the_relaxation_time() {
    for relaxation_time in [1e-6, 1e-4, 1e-3] {
        let law = Rheology::NonlocalMuI(NonlocalMuI { relaxation_time, ..NonlocalMuI::of(GLASS) });
        for rate in [0.1, 5.0, 200.0] {
            let (mut stress, mut field) = (Tensor::<2>::zeros(), 0.0);
            for _ in 0..60_000 {
                let shear = Tensor::<2>::new(0.0, rate, 0.0, 0.0);
                (stress, field) =
                    law.updated_state(&stress, &shear, 100.0, &FieldStep::alone(field), 2e4, 5e-5).stress_and_field();
            }
            let friction = GLASS.friction_coefficient(GLASS.inertial_number(rate, 100.0));
            assert!((stress[(0, 1)] / (100.0 * friction) - 1.0).abs() < 1e-6, "{stress} for {friction} at {rate}");
            assert!((field * friction / rate - 1.0).abs() < 1e-6, "{field} at {rate}");
            // what is sheared is not turned
            assert!(stress[(1, 1)].abs() < 1e-6 * stress[(0, 1)], "{stress}");
        }
    }
}

#[test]
fn rest_stays_at_rest_without_a_seed_and_starts_with_one() {
    let pushed = |seed: f64, ratio: f64| {
        let law = NonlocalMuI { seed, cooperativity: 0.0, ..NonlocalMuI::of(GLASS) };
        let (mut stress, mut field) = (100.0 * ratio, 0.0);
        for _ in 0..2000 {
            let trial = TrialStress::new(stress, 100.0, 2e4, 5e-5);
            let end = law.end_of_step(&trial, &FieldStep::alone(field));
            (stress, field) = (end.shear_stress, end.field);
        }
        (stress, field)
    };
    assert_eq!(pushed(0.0, 0.5), (50.0, 0.0));
    assert_eq!(pushed(1e-6, 0.38), (38.0, 0.0));
    let (stress, field) = pushed(1e-6, 0.5);
    assert!(stress < 40.0 && field > 0.0, "{stress} Pa, {field} 1/s");
}

#[test]
fn no_pressure_no_stress_and_no_fluidity_and_no_step_no_change() {
    let law = NonlocalMuI::of(GLASS);
    for pressure in [0.0, -5.0, f64::NAN] {
        for step in [0.0, 1e-4] {
            let end = law.end_of_step(&TrialStress::new(10.0, pressure, 2e4, step), &FieldStep::new(3.0, 1.0, 2.0));
            assert_eq!(end.shear_stress, 0.0);
            assert!(end.field == 0.0 || step == 0.0);
        }
    }
    let end = law.end_of_step(&TrialStress::new(10.0, 100.0, 2e4, 0.0), &FieldStep::new(3.0, 1.0, 2.0));
    assert_eq!((end.shear_stress, end.field), (10.0, 3.0));
}

#[test]
fn eight_lanes_of_every_instruction_set_give_the_bits_of_one_value() {
    let (expected, fields) = ShearedLaw {
        law: Rheology::NonlocalMuI(NonlocalMuI::of(GLASS)),
        pressure: [-5.0, 0.0, 1e-3, 1.0, 20.0, 300.0, 4e3, f64::NAN],
        moduli: ElasticModuli { shear: 2e4, bulk: 0.0 },
        time_step: 1e-4,
        steps: 30,
        initial_field: 1.0,
        exchange: (0.4, 0.3),
    }
    .check();
    assert!(expected[4].norm() > 1.0 && fields[4] > 0.1, "{expected:?} {fields:?}");
}
