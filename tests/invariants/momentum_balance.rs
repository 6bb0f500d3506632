//! No pair term makes momentum: Σ m Δv = 0 in every step of a fully periodic block, term by term.

use crate::invariants::patches::{
    Disorder, GRAINS, SPACING, SYRUP, block, exact_pairs, open_scene, periodic_scene, simulation,
};
use bagnold_solver::material::rheology::{Bingham, Newtonian, Rheology, SofteningDruckerPrager};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::numerics::{Contact, MomentumOperator, Numerics, ViscositySwitch};
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};

/// Steps of a run; some of them search the neighbours anew, most do not.
const STEPS: usize = 24;
/// Largest |Σ m Δv| / Σ m |Δv|.
const ROUNDING: f64 = 1e-12;

/// The chosen operator alone: neither damping nor coupling.
fn bare() -> Numerics {
    Numerics {
        contact: Contact::None,
        density_coupling: 0.0,
        artificial_viscosity: 0.0,
        hourglass: 0.0,
        verlet_skin: 0.03,
        ..exact_pairs()
    }
}

/// A compressed block without stress or motion; the pressure terms alone act.
const PRESSED: Disorder = Disorder { speed: 0.0, stress: 0.0, ..Disorder::FULL };
/// A moving block at the reference density: neither pressure nor stress.
const DUST: Disorder = Disorder { compression: (0.0, 0.0), ..Disorder::FULL };

/// Takes one step; returns the sum of the impulses and the sum of their magnitudes `[kg m/s]`.
fn impulses<const D: usize>(simulation: &mut Simulation<D>) -> (Vector<D>, f64)
where
    Simulation<D>: Compiled<D>,
{
    let before = simulation.snapshot();
    simulation.step().expect("a stable step");
    let after = simulation.snapshot();
    let mut sums = (Vector::zeros(), 0.0);
    for ((old, new), mass) in before.velocity.iter().zip(&after.velocity).zip(&before.mass) {
        sums.0 += (new - old) * *mass;
        sums.1 += (new - old).norm() * mass;
    }
    sums
}

/// Largest |Σ m Δv| / Σ m |Δv| over the steps of a run in 2-D and in 3-D.
fn imbalance(numerics: Numerics, rheology: Rheology, disorder: Disorder) -> f64 {
    fn run<const D: usize>(
        cells: [usize; D],
        numerics: Numerics,
        rheology: Rheology,
        disorder: Disorder,
    ) -> Result<f64, String>
    where
        Simulation<D>: Compiled<D>,
    {
        let scene = periodic_scene(cells, disorder, 11);
        let mut simulation = simulation(Scene { numerics, rheology, ..scene });
        let mut worst = 0.0_f64;
        for _ in 0..STEPS {
            let (sum, scale) = impulses(&mut simulation);
            if scale <= 0.0 {
                return Err("nothing moved: the term under test is absent".to_owned());
            }
            worst = worst.max(sum.norm() / scale);
        }
        let searches = simulation.neighbour_searches();
        if (3..STEPS as u64 - 3).contains(&searches) {
            return Ok(worst);
        }
        Err(format!("{searches} neighbour searches: the images are not tested both fresh and old"))
    }
    let plane = run([17, 14], numerics, rheology, disorder).expect("2-D");
    let space = run([8, 7, 9], numerics, rheology, disorder).expect("3-D");
    println!("imbalance {plane:.1e} in 2-D, {space:.1e} in 3-D");
    plane.max(space)
}

#[test]
fn the_single_divergence_of_pressure_and_stress_is_balanced() {
    assert!(imbalance(bare(), GRAINS, Disorder::FULL) < ROUNDING);
}

#[test]
fn the_artificial_stress_of_soil_that_holds_together_is_balanced() {
    // a cohesion that bears what the disordered velocities strain, so that pairs are under tension
    let soil = Rheology::SofteningDruckerPrager(SofteningDruckerPrager {
        peak_friction: 0.0,
        residual_friction: 0.0,
        peak_cohesion: 1e5,
        residual_cohesion: 1e5,
        softening_strain: 1.0,
        peak_dilation: 0.0,
        dilation_strain: None,
    });
    assert!(imbalance(bare(), soil, Disorder::FULL) < ROUNDING);
}

#[test]
fn the_uncorrected_divergence_is_balanced() {
    let numerics = Numerics { momentum_operator: MomentumOperator::UncorrectedDivergence, ..bare() };
    assert!(imbalance(numerics, GRAINS, Disorder::FULL) < ROUNDING);
}

#[test]
fn the_viscous_stress_in_the_divergence_is_balanced() {
    assert!(imbalance(bare(), SYRUP, Disorder::FULL) < ROUNDING);
}

#[test]
fn the_eddy_viscosity_is_balanced() {
    let numerics = Numerics { smagorinsky_constant: 0.5, ..bare() };
    assert!(imbalance(numerics, GRAINS, Disorder::FULL) < ROUNDING);
}

#[test]
fn the_pairwise_pressure_is_balanced() {
    let numerics = Numerics { momentum_operator: MomentumOperator::Pairwise, ..bare() };
    let inviscid = Rheology::Newtonian(Newtonian { viscosity: 0.0 });
    assert!(imbalance(numerics, inviscid, Disorder { speed: 0.5, ..PRESSED }) < ROUNDING);
}

#[test]
fn the_pairwise_viscosity_is_balanced_also_where_the_viscosity_varies() {
    let bingham = Rheology::Bingham(Bingham { plastic_viscosity: 5.0, yield_stress: 400.0, regularisation_rate: 5.0 });
    for density_coupling in [0.0, 1.0] {
        let numerics = Numerics { momentum_operator: MomentumOperator::Pairwise, density_coupling, ..bare() };
        assert!(imbalance(numerics, SYRUP, DUST) < ROUNDING);
        assert!(imbalance(numerics, bingham, Disorder::FULL) < ROUNDING);
    }
}

#[test]
fn the_artificial_viscosity_is_balanced() {
    let numerics = Numerics { artificial_viscosity: 0.5, ..bare() };
    assert!(imbalance(numerics, GRAINS, DUST) < ROUNDING);
    let pairwise = Numerics { momentum_operator: MomentumOperator::Pairwise, ..numerics };
    let inviscid = Rheology::Newtonian(Newtonian { viscosity: 0.0 });
    assert!(imbalance(pairwise, inviscid, DUST) < ROUNDING);
}

#[test]
fn the_switched_artificial_viscosity_is_balanced() {
    for momentum_operator in [MomentumOperator::Pairwise, MomentumOperator::SingleDivergence] {
        let numerics = Numerics { viscosity_switch: ViscositySwitch::MorrisMonaghan, momentum_operator, ..bare() };
        let found = imbalance(numerics, SYRUP, Disorder::FULL);
        assert!(found < ROUNDING, "{momentum_operator:?}: {found:.1e}");
    }
}

#[test]
fn the_hourglass_control_is_balanced_and_acts() {
    let damped = Numerics { hourglass: 1.0, ..bare() };
    assert!(imbalance(damped, GRAINS, Disorder::FULL) < ROUNDING);
    let velocity = |numerics| {
        let scene = periodic_scene([17, 14], Disorder::FULL, 11);
        let mut simulation = simulation(Scene { numerics, ..scene });
        simulation.step().expect("a stable step");
        simulation.snapshot().velocity
    };
    let (with, without) = (velocity(damped), velocity(bare()));
    let (mut sum, mut scale) = (Vector::<2>::zeros(), 0.0);
    let masses = block([17, 14], Disorder::FULL, 11).mass;
    for ((with, without), mass) in with.iter().zip(&without).zip(masses) {
        sum += (with - without) * mass;
        scale += (with - without).norm() * mass;
    }
    assert!(scale > 1e-3 && sum.norm() < 1e-11 * scale, "{sum} of {scale}");
}

#[test]
fn schwaigers_correction_is_not_antisymmetric() {
    // (13) scales the force on each particle by its own correction: the paper's operator does not conserve momentum
    let numerics = Numerics { momentum_operator: MomentumOperator::PairwiseCorrected, ..bare() };
    let found = imbalance(numerics, SYRUP, DUST);
    assert!(found > 1e-6 && found < 0.1, "{found:.1e}");
}

/// |Σ x × m Δv| / Σ |x| m |Δv| of one step of an open block about its middle.
fn angular_imbalance(numerics: Numerics, rheology: Rheology, disorder: Disorder) -> f64 {
    let cells = [16, 12];
    let scene = open_scene(block(cells, disorder, 5));
    let mut simulation = simulation(Scene { numerics, rheology, ..scene });
    let before = simulation.snapshot();
    simulation.step().expect("a stable step");
    let after = simulation.snapshot();
    let middle = Vector::<2>::new(8.0, 6.0) * SPACING;
    let (mut sum, mut scale) = (0.0, 0.0);
    for (index, place) in before.position.iter().enumerate() {
        let arm = place - middle;
        let impulse = (after.velocity[index] - before.velocity[index]) * before.mass[index];
        sum += arm[0] * impulse[1] - arm[1] * impulse[0];
        scale += arm.norm() * impulse.norm();
    }
    sum.abs() / scale
}

#[test]
fn central_pair_forces_conserve_angular_momentum_and_the_others_do_not() {
    let pairwise = Numerics { momentum_operator: MomentumOperator::Pairwise, ..bare() };
    let artificial = Numerics { artificial_viscosity: 0.5, ..bare() };
    let uncorrected = Numerics { momentum_operator: MomentumOperator::UncorrectedDivergence, ..bare() };
    let central = [
        ("(10) and (11)", angular_imbalance(pairwise, SYRUP, Disorder::FULL)),
        ("artificial viscosity (15)", angular_imbalance(artificial, GRAINS, DUST)),
        ("uncorrected divergence of a pressure", angular_imbalance(uncorrected, GRAINS, PRESSED)),
        // Σ_b V_b F r × σ_a E_a r is the skew part of σ_a E_a M_a, none where E commutes with M and σ = −pI; so a
        // stress makes angular momentum only where the neighbourhood is not full and E is blended
        ("single divergence of a pressure", angular_imbalance(bare(), GRAINS, PRESSED)),
    ];
    for (term, found) in central {
        assert!(found < ROUNDING, "{term}: {found:.1e}");
    }
    // shear stress and damping act across the line of centres
    let corrected = Numerics { momentum_operator: MomentumOperator::PairwiseCorrected, ..bare() };
    let across = [
        ("uncorrected divergence of a stress", angular_imbalance(uncorrected, GRAINS, Disorder::FULL)),
        ("single divergence of a viscous stress", angular_imbalance(bare(), SYRUP, DUST)),
        (
            "hourglass control",
            angular_imbalance(
                Numerics { hourglass: 1.0, ..uncorrected },
                GRAINS,
                Disorder { stress: 0.0, ..Disorder::FULL },
            ),
        ),
        ("Schwaiger's correction (13)", angular_imbalance(corrected, SYRUP, DUST)),
    ];
    for (term, found) in across {
        println!("{term}: {found:.1e}");
        assert!(found > 1e-9, "{term} conserves angular momentum after all: {found:.1e}");
    }
}
