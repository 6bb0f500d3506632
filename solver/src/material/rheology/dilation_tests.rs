//! One point of soil that dilates: at a given volume, at a given pressure, and with associated flow.

use super::field::{FieldLaw, FieldStep};
use super::lanes_of_a_law_tests::ShearedLaw;
use super::{ElasticModuli, Rheology, SofteningDruckerPrager, TrialStress};
use crate::vector::{Tensor, equivalent_shear_stress};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Dense sand: e comes to 0.03.
const SAND: SofteningDruckerPrager = SofteningDruckerPrager {
    peak_friction: 0.6,
    residual_friction: 0.45,
    peak_cohesion: 10.0,
    residual_cohesion: 5.0,
    softening_strain: 0.25,
    peak_dilation: 0.3,
    dilation_strain: Some(0.2),
};
/// Associated flow of a strength that stays.
const ASSOCIATED: SofteningDruckerPrager = SofteningDruckerPrager {
    peak_friction: 0.35,
    residual_friction: 0.35,
    peak_cohesion: 0.0,
    residual_cohesion: 0.0,
    softening_strain: 1.0,
    peak_dilation: 0.35,
    dilation_strain: None,
};
const MODULI: ElasticModuli = ElasticModuli { shear: 2e4, bulk: 5e4 };
const PRESSURE: f64 = 100.0;

/// β, e, μ and k at a plastic shear strain, written down once more.
fn properties(law: &SofteningDruckerPrager, strain: f64) -> (f64, f64, f64, f64) {
    let softened = (strain / law.softening_strain).min(1.0);
    let end = law.dilation_strain.unwrap_or(1e12);
    let left = (1.0 - strain / end).max(0.0);
    (
        law.peak_dilation * left,
        0.5 * law.peak_dilation * end * (1.0 - left) * (1.0 + left),
        law.peak_friction + softened * (law.residual_friction - law.peak_friction),
        law.peak_cohesion + softened * (law.residual_cohesion - law.peak_cohesion),
    )
}

/// Stress, plastic shear strain and pressure along pure shear at a given volume, by steps of a shear strain.
fn held_volume(law: SofteningDruckerPrager, steps: usize, shear: f64) -> Vec<(f64, f64, f64)> {
    let rheology = Rheology::SofteningDruckerPrager(law);
    let rate = Tensor::<2>::new(0.5 * shear, 0.0, 0.0, -0.5 * shear);
    let (mut stress, mut strain, mut pressure) = (Tensor::<2>::zeros(), 0.0, PRESSURE);
    let mut path = Vec::new();
    for _ in 0..steps {
        let field = FieldStep::alone(strain);
        (stress, strain) =
            rheology.updated_state_of_volume(&stress, &rate, pressure, &field, MODULI, 1.0).stress_and_field();
        pressure = (MODULI.bulk + PRESSURE) * rheology.loosening(strain) - MODULI.bulk;
        path.push((equivalent_shear_stress(&stress), strain, pressure));
    }
    path
}

/// The pressure rises by K (exp(e) − 1) and p's share of it until κ = κ_d, and then stays; the stress is on the strength; elastic and plastic strain are the strain.
#[test]
fn at_a_given_volume_the_pressure_rises_until_dilation_ends() {
    for steps in [6, 60, 6000] {
        let path = held_volume(SAND, steps, 0.6 / steps as f64);
        for (count, &(stress, strain, pressure)) in path.iter().enumerate() {
            let shear = 0.6 * (count + 1) as f64 / steps as f64;
            let (_, swelling, friction, cohesion) = properties(&SAND, strain);
            let expected = PRESSURE + (MODULI.bulk + PRESSURE) * libm::expm1(swelling);
            assert!((pressure - expected).abs() < 1e-11 * MODULI.bulk, "{pressure} for {expected}");
            let rounding = 1e-12 * (MODULI.bulk + MODULI.shear * shear);
            if strain > 0.0 {
                assert!((stress - friction * expected - cohesion).abs() < rounding, "{stress} at {strain}, {pressure}");
            }
            assert!((stress + MODULI.shear * (strain - shear)).abs() < rounding, "{stress} {strain} at {shear}");
        }
        let (stress, strain, pressure) = path[steps - 1];
        let largest = (MODULI.bulk + PRESSURE) * libm::exp(0.03) - MODULI.bulk;
        assert!(strain > 0.25 && (pressure - largest).abs() < 1e-11 * MODULI.bulk, "{pressure} for {largest}");
        assert!((stress - 0.45 * largest - 5.0).abs() < 1e-8);
    }
}

/// The rate equations of the same point, G (dγ − dκ) = dY along the strength, by the midpoint rule: another route to the same curve.
#[test]
fn at_a_given_volume_the_path_is_that_of_the_rate_equations() {
    let found = held_volume(SAND, 300, 1e-3);
    let slope = |strain: f64| {
        let (dilation, swelling, friction, _) = properties(&SAND, strain);
        let pressure = (MODULI.bulk + PRESSURE) * libm::exp(swelling) - MODULI.bulk;
        let softening = if strain < 0.25 { (0.15 * pressure + 5.0) / 0.25 } else { 0.0 };
        MODULI.shear / (MODULI.shear - softening + friction * dilation * (MODULI.bulk + pressure))
    };
    let error = |parts: usize| {
        let start = (0.6 * PRESSURE + 10.0) / MODULI.shear;
        let width = (0.3 - start) / parts as f64;
        let strain = (0..parts).fold(0.0, |strain, _| strain + width * slope(strain + 0.5 * width * slope(strain)));
        (strain - found[299].1).abs()
    };
    let (coarse, fine) = (error(100), error(25_600));
    // the slope jumps at κ_r: first order
    assert!(fine < 5e-7 && coarse / fine > 100.0, "{coarse:.2e}, {fine:.2e}");
}

/// At a given pressure the volume strain is ∫ β dκ; and the density that keeps the pressure gives the same step at a given volume.
#[test]
fn at_a_given_pressure_the_volume_grows_by_the_integral_of_the_dilation() {
    let rheology = Rheology::SofteningDruckerPrager(SAND);
    let rate = Tensor::<2>::new(5e-4, 0.0, 0.0, -5e-4);
    let (mut stress, mut strain, mut volume) = (Tensor::<2>::zeros(), 0.0, 0.0);
    for _ in 0..400 {
        let field = FieldStep::alone(strain);
        let (drained, after) =
            rheology.updated_state(&stress, &rate, PRESSURE, &field, MODULI.shear, 1.0).stress_and_field();
        // the middle of a step is exact but where the dilation ends
        volume += (after - strain) * properties(&SAND, 0.5 * (strain + after)).0;
        let expansion: f64 = rheology.plastic_volume_strain(after) - rheology.plastic_volume_strain(strain);
        let trial = (MODULI.bulk + PRESSURE) * libm::exp(-expansion) - MODULI.bulk;
        let (held, same) =
            rheology.updated_state_of_volume(&stress, &rate, trial, &field, MODULI, 1.0).stress_and_field();
        assert!(
            (held - drained).norm() < 1e-9 * (1.0 + drained.norm()) && (same - after).abs() < 1e-12,
            "{same} for {after}"
        );
        (stress, strain) = (drained, after);
    }
    let found: f64 = rheology.plastic_volume_strain(strain);
    assert!(strain > 0.3 && (found - 0.03).abs() < 1e-15 && (volume - 0.03).abs() < 1e-6, "{found}, {volume}");
    assert!((equivalent_shear_stress(&stress) - 50.0).abs() < 1e-9);
}

/// Hill's principle: with associated flow the end of a step is that point of the admissible stresses that is nearest to the trial in the measure
/// of elastic energy, τ²/G + p²/K, so that the plastic strain is normal to the yield surface. With less dilation it is not.
#[test]
fn associated_flow_is_normal_to_the_yield_surface() {
    let moduli = ElasticModuli { shear: 2e9, bulk: 5e9 };
    let distance = |(stress, pressure): (f64, f64), trial: &TrialStress<f64>| {
        (stress - trial.shear_stress).powi(2) / moduli.shear + (pressure - trial.pressure).powi(2) / moduli.bulk
    };
    for cohesion in [0.0, 40.0] {
        for (dilation, nearest) in [(0.35, true), (0.2, false)] {
            let law = SofteningDruckerPrager {
                peak_cohesion: cohesion,
                residual_cohesion: cohesion,
                peak_dilation: dilation,
                ..ASSOCIATED
            };
            let trial = TrialStress::new(200.0, PRESSURE, moduli.shear, 1.0).with_bulk_modulus(moduli.bulk);
            let end = law.end_of_step(&trial, &FieldStep::alone(0.1));
            let pressure = trial.dilated_pressure(dilation * (end.field - 0.1));
            assert!((end.shear_stress - 0.35 * pressure - cohesion).abs() < 1e-14 * moduli.bulk);
            let found = distance((end.shear_stress, pressure), &trial);
            let best = (0..4000)
                .map(|place| 0.1 * f64::from(place))
                .map(|pressure| distance((0.35 * pressure + cohesion, pressure), &trial))
                .fold(f64::INFINITY, f64::min);
            // the places are 0.1 Pa apart, and the equation of state is linear up to p/K
            assert_eq!(found < best * (1.0 + 1e-6), nearest, "{found:e} for {best:e} with {dilation}");
        }
    }
}

/// ∫ τ dκ = ∫ p β dκ of associated flow without cohesion: nothing is dissipated, all work is stored. Dilation stores V K (1 + s) ln(1 + s), s = p/K,
/// which is p and a part p/2K.
#[test]
fn associated_flow_without_cohesion_dissipates_nothing() {
    let (mut work, mut sheared, mut stored) = (0.0, 0.0, 0.0);
    let (mut before, mut strain_before, mut pressure_before) = (0.0, 0.0, PRESSURE);
    let log = |pressure: f64| (MODULI.bulk + pressure) * libm::log1p(pressure / MODULI.bulk);
    for (stress, strain, pressure) in held_volume(ASSOCIATED, 4000, 1e-5) {
        work += 0.5 * (stress + before) * 1e-5;
        sheared += 0.5 * (stress + before) * (strain - strain_before);
        stored += 0.5 * (log(pressure) + log(pressure_before)) * 0.35 * (strain - strain_before);
        (before, strain_before, pressure_before) = (stress, strain, pressure);
    }
    let relative = pressure_before / MODULI.bulk;
    let dissipated = (sheared - stored) / sheared;
    println!("p/K comes to {relative:.4}, dissipated {dissipated:.2e} of the shear's plastic work");
    assert!(dissipated.abs() < 0.5 * relative && strain_before > 0.01, "{dissipated}");
    // elastic energies of the state: shear, and exp(e) ψ(ρ exp(e)) less the one at the start, of a volume that stays
    let compression = |relative: f64| (1.0 + relative) * libm::log1p(relative) - relative;
    let energy = before * before / (2.0 * MODULI.shear)
        + MODULI.bulk * (compression(relative) - compression(PRESSURE / MODULI.bulk));
    assert!(((work - sheared + stored) / energy - 1.0).abs() < 1e-4, "{work}, {sheared}, {stored}, {energy}");
}

/// The implicit equation by bisection, for laws whose excess falls everywhere.
fn bisected(law: &SofteningDruckerPrager, trial: &TrialStress<f64>, before: f64) -> f64 {
    let (mut low, mut high) = (0.0, trial.shear_stress / trial.shear_modulus);
    let swelling = properties(law, before).1;
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        let (_, after, friction, cohesion) = properties(law, before + middle);
        let pressure = (trial.bulk_modulus + trial.pressure) * libm::exp(after - swelling) - trial.bulk_modulus;
        let excess = trial.shear_stress - trial.shear_modulus * middle - friction * pressure - cohesion;
        if excess > 0.0 { low = middle } else { high = middle }
    }
    low
}

#[test]
fn stress_strain_and_pressure_solve_their_equations_together() {
    let mut random = Pcg64Mcg::seed_from_u64(9);
    let mut passed = [0; 3];
    for _ in 0..4000 {
        let friction = random.random_range(0.05..0.9);
        let law = SofteningDruckerPrager {
            peak_friction: friction,
            residual_friction: friction * random.random_range(0.5..1.0),
            peak_cohesion: random.random_range(0.0..100.0),
            residual_cohesion: 0.0,
            softening_strain: libm::exp(random.random_range(-3.0..1.0)),
            peak_dilation: friction * random.random_range(0.0..0.5),
            dilation_strain: Some(libm::exp(random.random_range(-4.0..-1.0))),
        };
        let pressure = libm::exp(random.random_range(0.0..6.0));
        let moduli = ElasticModuli { shear: 3e4, bulk: libm::exp(random.random_range(9.0..12.0)) };
        let before = random.random_range(0.0..0.3);
        let stress = law.strength(pressure, before) * libm::exp(random.random_range(0.0..3.0));
        let trial = TrialStress::new(stress, pressure, moduli.shear, 1e-4).with_bulk_modulus(moduli.bulk);
        let end = law.end_of_step(&trial, &FieldStep::alone(before));
        let expected = bisected(&law, &trial, before);
        let allowed = 1e-11 * (before + expected) + 1e-14 * (moduli.bulk + stress) / moduli.shear;
        assert!((end.field - before - expected).abs() < allowed, "{end:?} for {expected}: {law:?} {trial:?} {before}");
        assert!(
            (end.shear_stress + moduli.shear * (end.field - before) - stress).abs() < 1e-10 * (moduli.bulk + stress)
        );
        let ended = law.dilation_strain.expect("an end");
        passed[usize::from(before > ended) + usize::from(end.field > ended)] += 1;
    }
    assert!(passed.iter().all(|&count| count > 80), "while it dilates, across its end, behind it: {passed:?}");
}

/// Without an end of the elastic range, where the strength falls faster than the stress unloads, and under tension.
#[test]
fn every_allowed_input_gives_a_finite_state() {
    for (peak_friction, kept) in [(0.0, 1.0), (0.6, 1.0), (0.6, 0.5), (1.0, 0.9)] {
        for (dilation, dilation_strain) in [(4e-15, None), (0.5, None), (0.5, Some(1e-12)), (0.4, Some(0.3))] {
            for (peak_cohesion, softening_strain) in [(0.0, 1.0), (10.0, 1e-15), (1e9, 0.1)] {
                let law = SofteningDruckerPrager {
                    peak_friction,
                    residual_friction: kept * peak_friction,
                    peak_cohesion,
                    residual_cohesion: kept * peak_cohesion,
                    softening_strain,
                    peak_dilation: dilation * peak_friction,
                    dilation_strain,
                };
                assert_eq!(Rheology::SofteningDruckerPrager(law).parameter_problem(), None, "{law:?}");
                for (pressure, modulus) in [(1e-12, 1e-9), (100.0, 2e4), (-5.0, 2e4), (-1e9, 1e4), (1e12, 1e12)] {
                    for (stress, strain) in [(0.0, 0.0), (1e-12, 1e-15), (70.0, 0.05), (1e3, 0.0)] {
                        let stress = stress * modulus * 1e-4;
                        let trial = TrialStress::new(stress, pressure, modulus, 1e-5).with_bulk_modulus(2.5 * modulus);
                        let end = law.end_of_step(&trial, &FieldStep::alone(strain));
                        assert!((0.0..=stress).contains(&end.shear_stress), "{end:?} {law:?} {trial:?}");
                        assert!(end.field >= strain && end.field.is_finite(), "{end:?} {law:?} {trial:?}");
                    }
                }
            }
        }
    }
    for pressure in [0.0, f64::NAN] {
        let trial = TrialStress::new(500.0, pressure, 2e4, 1e-4).with_bulk_modulus(5e4);
        let end = SAND.end_of_step(&trial, &FieldStep::alone(0.1));
        assert_eq!((end.shear_stress, end.field), (0.0, 0.1));
    }
}

#[test]
fn dilation_that_makes_no_law_is_refused() {
    let problem = |law| {
        let problem = Rheology::SofteningDruckerPrager(law).parameter_problem().expect("refused");
        assert!(!problem.remedy.is_empty());
        (problem.field, problem.rule)
    };
    let more = SofteningDruckerPrager { peak_dilation: 0.61, ..SAND };
    assert_eq!(problem(more), ("peak_dilation".to_owned(), "at most `peak_friction`".to_owned()));
    let (field, rule) = problem(SofteningDruckerPrager { peak_dilation: 0.5, dilation_strain: None, ..SAND });
    assert!(field == "peak_dilation" && rule.contains("residual_friction"), "{rule}");
    for bad in [f64::NAN, -0.1, 12.0] {
        assert_eq!(problem(SofteningDruckerPrager { peak_dilation: bad, ..SAND }).0, "peak_dilation");
    }
    for bad in [f64::NAN, f64::INFINITY, -0.1, 0.0, 2.0] {
        assert_eq!(problem(SofteningDruckerPrager { dilation_strain: Some(bad), ..SAND }).0, "dilation_strain");
    }
    assert_eq!(Rheology::SofteningDruckerPrager(SAND).parameter_problem(), None);
}

#[test]
fn a_law_without_dilation_is_read_and_written_as_before() {
    let file = "law = \"softening-drucker-prager\"\npeak_friction = 0.6\nresidual_friction = 0.45\npeak_cohesion = 10.0\nresidual_cohesion = 5.0\nsoftening_strain = 0.25\n";
    let read: Rheology = toml::from_str(file).expect("a law");
    let still = SofteningDruckerPrager { peak_dilation: 0.0, dilation_strain: None, ..SAND };
    assert_eq!(read, Rheology::SofteningDruckerPrager(still));
    assert_eq!(toml::to_string(&read).expect("toml"), file);
    let dilates = Rheology::SofteningDruckerPrager(SAND);
    let written = toml::to_string(&dilates).expect("toml");
    assert!(written.ends_with("peak_dilation = 0.3\ndilation_strain = 0.2\n"), "{written}");
    assert_eq!(toml::from_str::<Rheology>(&written).expect("a law"), dilates);
}

#[test]
fn eight_lanes_of_every_instruction_set_give_the_bits_of_one_value() {
    let (expected, fields) = ShearedLaw {
        law: Rheology::SofteningDruckerPrager(SAND),
        pressure: [-5.0, 0.0, 1e-3, 1.0, 20.0, 300.0, 4e4, f64::NAN],
        moduli: MODULI,
        time_step: 1e-3,
        steps: 60,
        initial_field: 0.0,
        exchange: (0.0, 0.0),
    }
    .check();
    assert!(fields[3] > 0.1 && fields[4] > 0.1 && fields[6] == 0.0 && expected[6].norm() > 100.0, "{fields:?}");
}
