use super::field::{FieldLaw, FieldStep};
use super::{ElasticModuli, Rheology, TrialStress, ViscousNumber};
use crate::material::pore_liquid::SKELETON_SHARE;
use crate::vector::{Tensor, equivalent_shear_stress};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Beads of Pailha & Pouliquen (2009).
const BEADS: ViscousNumber = ViscousNumber {
    critical_friction: 0.415,
    friction_slope: 90.5,
    critical_fraction: 0.582,
    fraction_slope: 25.0,
    dilatancy: 4.09,
    solid_fraction: 0.578,
    grain_diameter: 1.6e-4,
    grain_density: 2500.0,
    liquid_density: 1041.0,
    liquid_viscosity: 0.096,
    permeability_coefficient: 1.0 / 180.0,
};

/// The equations of the law's head hold at the end of a step of given volume, with D and I from their definitions.
#[test]
fn stress_pressure_and_fraction_solve_their_equations_together() {
    let mut random = Pcg64Mcg::seed_from_u64(5);
    let (mut flowing, mut opened) = (0, 0);
    for _ in 0..4000 {
        let (liquid_viscosity, dilatancy) = (libm::exp(random.random_range(-7.0..0.0)), random.random_range(0.0..40.0));
        let law = ViscousNumber { liquid_viscosity, dilatancy, ..BEADS };
        let shear_ratio = libm::exp(random.random_range(-7.0..0.4));
        let (bulk, step) = (libm::exp(random.random_range(8.0..13.0)), libm::exp(random.random_range(-13.0..-6.0)));
        let modulus = SKELETON_SHARE * bulk;
        let growth = random.random_range(-0.04..0.06);
        let effective = modulus * 1e-3 * random.random_range(-0.5..2.0);
        let pore = modulus * 1e-3 * random.random_range(-1.0..1.0);
        let stress = modulus * 1e-3 * random.random_range(0.0..1.0);
        let trial = TrialStress::new(stress, effective + pore, shear_ratio * bulk, step).with_bulk_modulus(bulk);
        let field = FieldStep::alone(pore).with_memory([growth, 0.0, 0.0]);
        let end = law.end_of_step(&trial, &field);
        let [after, ..] = law.memory_after(&trial, &field, &end);
        // the density stays: (1 + growth)/(1 + p′/K_s) is that of the opened skeleton, or of the trial
        let pressure = (modulus + effective) * (1.0 + after) / (1.0 + growth) - modulus;
        assert!(pressure > -1e-9 * modulus, "no tension is left: {pressure}");
        let rate = (stress - end.shear_stress) / (shear_ratio * bulk * step);
        let start = effective.max(0.0);
        let kept = (1.0 + after) * (modulus + start) / (modulus + pressure);
        let fraction = law.solid_fraction / kept;
        opened += u32::from(effective < 0.0);
        if rate * step < 1e-9 {
            assert!((pressure - start).abs() < 1e-7 * modulus, "nothing dilates at rest: {pressure} from {start}");
            continue;
        }
        let number = law.liquid_viscosity * rate / pressure;
        let tangent = law.dilatancy * (fraction - law.critical_fraction + law.fraction_slope * number);
        // grains that are too loose to hold flow without friction of contacts
        let of_contacts = (law.critical_friction + law.dilatancy * (fraction - law.critical_fraction)).max(0.0);
        let friction = of_contacts + (law.friction_slope + law.fraction_slope * law.dilatancy) * number;
        let expected = friction * pressure;
        assert!((end.shear_stress - expected).abs() < 1e-6 * (stress + expected.abs()), "{trial:?} {field:?} {end:?}");
        let dilated = start + (modulus + start) * rate * tangent * step;
        assert!(
            (pressure - dilated).abs() < 1e-6 * (pressure + start),
            "{pressure} for {dilated}: {trial:?} {field:?}"
        );
        flowing += 1;
    }
    assert!(flowing > 2000 && opened > 500, "{flowing} flow, {opened} have opened");
}

/// Simple shear at a constant effective pressure: the fraction comes to that of equilibrium and friction to that of steady flow, whatever the
/// liquid bears; without a pressure to dilate against, the volume is free.
#[test]
fn sheared_grains_come_to_the_friction_of_their_viscous_number() {
    let (law, rate, effective, pore) = (Rheology::ViscousNumber(BEADS), 0.5, 40.0, -7.0);
    let number = BEADS.liquid_viscosity * rate / effective;
    for growth in [0.0, -0.03, 0.03] {
        let (mut stress, mut memory) = (Tensor::<2>::zeros(), [growth, 0.0, 0.0]);
        let gradient = Tensor::<2>::new(0.0, rate, 0.0, 0.0);
        let moduli = ElasticModuli { shear: 2e4, bulk: 4e4 };
        for _ in 0..200_000 {
            let field = FieldStep::alone(pore).with_memory(memory);
            let end = law.updated_state_of_volume(&stress, &gradient, effective + pore, &field, moduli, 1e-4);
            // the volume follows at once, so that the pressure is the given one again
            memory = end.memory;
            stress = end.stress;
        }
        let friction = equivalent_shear_stress(&stress) / effective;
        let fraction = BEADS.solid_fraction / (1.0 + memory[0]);
        let equilibrium = BEADS.critical_fraction - BEADS.fraction_slope * number;
        assert!((fraction - equilibrium).abs() < 2e-5, "{fraction} for {equilibrium} from {growth}");
        assert!((friction - (0.415 + 90.5 * number)).abs() < 2e-3, "{friction} from {growth}");
    }
}

#[test]
fn a_step_of_no_length_changes_nothing_and_a_heavy_liquid_is_refused() {
    let trial = TrialStress::new(30.0, 20.0, 1e4, 0.0).with_bulk_modulus(1e5);
    let field = FieldStep::alone(5.0).with_memory([0.01, 0.2, 0.0]);
    let end = BEADS.end_of_step(&trial, &field);
    assert_eq!((end.shear_stress, end.field), (30.0, 5.0));
    assert_eq!(BEADS.memory_after(&trial, &field, &end), field.memory);
    let heavy = Rheology::ViscousNumber(ViscousNumber { liquid_density: 2600.0, ..BEADS });
    let message = heavy.parameter_problem().expect("refused").to_string();
    assert!(message.contains("`liquid_density` is 2600, but must be below `grain_density`"), "{message}");
}
