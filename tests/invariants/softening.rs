//! Particles of a material that softens: sheared at a prescribed rate, falling, and without its softening.

use crate::invariants::dilation::falling;
use crate::invariants::fields::collapsed;
use crate::invariants::patches::{Disorder, EQUATION_OF_STATE, GRAINS, block, open_scene, simulation};
use bagnold_solver::material::rheology::{MuI, Rheology, SofteningDruckerPrager};
use bagnold_solver::vector::{Vector, equivalent_shear_stress};
use bagnold_solver::weakly_compressible::numerics::Numerics;

const SOIL: SofteningDruckerPrager = SofteningDruckerPrager {
    peak_friction: 0.6,
    residual_friction: 0.4,
    peak_cohesion: 200.0,
    residual_cohesion: 50.0,
    softening_strain: 0.1,
    peak_dilation: 0.0,
    dilation_strain: None,
};

/// A block under a uniform pressure whose particles move as u = γ̇ y, whatever acts on them: each step starts from a new simulation with the
/// prescribed velocities and density, and the stress and strain of the particle in the middle. There, where no edge reaches within a step, they
/// follow the exact curve of one point.
#[test]
fn sheared_particles_follow_the_curve_of_one_point() {
    let (cells, rate) = (18, 2.0);
    let mut scene = open_scene(block([cells; 2], Disorder { compression: (0.005, 0.005), ..Disorder::NONE }, 3));
    scene.rheology = Rheology::SofteningDruckerPrager(SOIL);
    scene.flow.field = vec![0.0; cells * cells];
    let modulus = scene.numerics.shear_modulus_ratio * EQUATION_OF_STATE.bulk_modulus;
    let middle: Vec<usize> =
        (0..cells * cells).filter(|k| [k % cells, k / cells].iter().all(|&n| (7..11).contains(&n))).collect();
    let (mut shear, mut worst, mut turn, mut most) = (0.0, 0.0_f64, 0.0, 0.0_f64);
    while shear < 0.16 {
        for (velocity, position) in scene.flow.velocity.iter_mut().zip(&scene.flow.position) {
            *velocity = Vector::<2>::new(rate * position[1], 0.0);
        }
        let mut sheared = simulation(scene.clone());
        sheared.step().expect("a stable step");
        shear += rate * sheared.time();
        let state = sheared.snapshot();
        for &index in &middle {
            let (pressure, strain) = (state.pressure[index], state.field[index]);
            let (peak, residual) = (0.6 * pressure + 200.0, 0.4 * pressure + 50.0);
            let (at_peak, at_residual) = (peak / modulus, 0.1 + residual / modulus);
            let expected = if shear < at_peak {
                modulus * shear
            } else {
                peak + (residual - peak) * ((shear - at_peak) / (at_residual - at_peak)).min(1.0)
            };
            let found = equivalent_shear_stress(&state.stress[index]);
            worst = worst.max((found / expected - 1.0).abs());
            assert!((strain - (shear - expected / modulus)).abs() < at_peak * at_peak, "{strain} at {shear}");
            (turn, most) = (at_peak, most.max(strain));
        }
        for (position, velocity) in scene.flow.position.iter_mut().zip(&scene.flow.velocity) {
            *position += velocity * sheared.time();
        }
        // uniform, so that what an edge makes of its stress does not come in from step to step
        let centre = middle[middle.len() / 2];
        scene.flow.stress.fill(state.stress[centre]);
        scene.flow.field.fill(state.field[centre]);
    }
    println!("worst {worst:.2e} of the stress; the square of the elastic turn is {:.2e}", turn * turn);
    assert!(worst < turn * turn && most > 0.14, "{worst}, {most}");
}

/// Plastic work of the ledger: Σ V ∫ τ dκ, with the strains of the particles, and the elastic energy that they lose
/// with their pressure; with that entry the ledger closes.
#[test]
fn the_strain_of_the_particles_is_the_plastic_work_of_the_ledger() {
    let mut simulation = simulation(falling(SOIL));
    let start = simulation.energy().expect("a ledger");
    let modulus = Numerics::default().shear_modulus_ratio * EQUATION_OF_STATE.bulk_modulus;
    let (mut by_strain, mut lost) = (0.0, 0.0);
    let mut before = simulation.snapshot();
    for _ in 0..400 {
        simulation.step().expect("a stable step");
        let state = simulation.snapshot();
        for index in 0..state.mass.len() {
            let volume = state.mass[index] / state.density[index];
            let [was, is] = [&before, &state].map(|state| equivalent_shear_stress(&state.stress[index]));
            let strain = state.field[index] - before.field[index];
            assert!(strain >= 0.0, "{strain} of particle {index}");
            by_strain += volume * 0.5 * (was + is) * strain;
            if state.pressure[index] <= 0.0 {
                lost += volume * was * was / (2.0 * modulus);
            }
        }
        before = state;
    }
    let end = simulation.energy().expect("a ledger");
    let plastic = end.ledger.plastic - start.ledger.plastic;
    let open = end.residual_since(&start) / end.ledger.dissipated();
    println!("{plastic:.5} J/m plastic, {by_strain:.5} by strain, {lost:.5} lost with the pressure; {open:.4} open");
    assert!(plastic > 0.2 * end.ledger.dissipated() && by_strain > lost, "{:?}", end.ledger);
    assert!(((by_strain + lost) / plastic - 1.0).abs() < 0.01 && open.abs() < 0.02, "{open}");
}

/// A column of a material that does not soften runs out as under μ(I) whose friction does not rise.
#[test]
fn without_softening_a_column_runs_out_as_under_friction_without_a_rate() {
    let Rheology::MuI(grains) = GRAINS else { unreachable!("grains") };
    let grains = MuI { limiting_friction: grains.static_friction, ..grains };
    let friction = collapsed(Rheology::MuI(grains));
    let law = SofteningDruckerPrager::from(grains);
    let unsoftened = collapsed(Rheology::SofteningDruckerPrager(law));
    let cohesive = collapsed(Rheology::SofteningDruckerPrager(SofteningDruckerPrager {
        peak_cohesion: 200.0,
        residual_cohesion: 200.0,
        ..law
    }));
    println!("friction {friction:.4}, unsoftened {unsoftened:.4}, with cohesion {cohesive:.4}");
    assert!((unsoftened / friction - 1.0).abs() < 0.005, "{unsoftened} for {friction}");
    assert!(cohesive < 0.8 * friction, "{cohesive} for {friction}");
}
