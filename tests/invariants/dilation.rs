//! Particles of soil that dilates as it yields: sheared at a given volume, falling, and with associated flow.

use crate::invariants::determinism::{self, column};
use crate::invariants::patches::{DENSITY, Disorder, EQUATION_OF_STATE, bed, block, open_scene, simulation};
use crate::invariants::restart;
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::material::rheology::{Rheology, SofteningDruckerPrager};
use bagnold_solver::vector::{Vector, equivalent_shear_stress};
use bagnold_solver::weakly_compressible::numerics::Numerics;
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::walls::wall;

const SAND: SofteningDruckerPrager = SofteningDruckerPrager {
    peak_friction: 0.6,
    residual_friction: 0.5,
    peak_cohesion: 0.0,
    residual_cohesion: 0.0,
    softening_strain: 0.1,
    peak_dilation: 0.3,
    dilation_strain: Some(0.08),
};

/// e of [`SAND`], written down once more.
fn volume_strain(strain: f64) -> f64 {
    0.012 * (1.0 - (1.0 - strain / 0.08).max(0.0).powi(2))
}

/// A block under a uniform pressure whose particles move as u = γ̇ y, whatever acts on them, as in `softening`: the volume stays, and the pressure
/// rises with K (exp(e) − 1) until the dilation ends, with the stress on the strength at that pressure.
#[test]
fn sheared_particles_press_the_harder_until_dilation_ends() {
    let (cells, rate) = (18, 2.0);
    let mut scene = open_scene(block([cells; 2], Disorder { compression: (0.005, 0.005), ..Disorder::NONE }, 3));
    scene.rheology = Rheology::SofteningDruckerPrager(SAND);
    scene.flow.field = vec![0.0; cells * cells];
    let moduli =
        (Numerics::default().shear_modulus_ratio * EQUATION_OF_STATE.bulk_modulus, EQUATION_OF_STATE.bulk_modulus);
    let (start, centre) = (EQUATION_OF_STATE.pressure(scene.flow.density[0]), cells * cells / 2 + cells / 2);
    let (mut shear, mut pressure) = (0.0, start);
    while shear < 0.16 {
        for (velocity, position) in scene.flow.velocity.iter_mut().zip(&scene.flow.position) {
            *velocity = Vector::<2>::new(rate * position[1], 0.0);
        }
        let mut sheared = simulation(scene.clone());
        sheared.step().expect("a stable step");
        shear += rate * sheared.time();
        let state = sheared.snapshot();
        let (strain, stress) = (state.field[centre], equivalent_shear_stress(&state.stress[centre]));
        let expected = moduli.1 * (state.density[centre] * volume_strain(strain).exp() / DENSITY - 1.0);
        let found = state.pressure[centre];
        assert!((found - expected).abs() < 1e-9 * expected, "{found} for {expected}");
        let strength = (0.6 - 0.1 * (strain / 0.1).min(1.0)) * expected;
        if strain > 0.0 {
            assert!((stress / strength - 1.0).abs() < 1e-9, "{stress} for {strength} at {strain}");
        }
        let turn = (strength / moduli.0).powi(2);
        assert!((strain + stress / moduli.0 - shear).abs() < turn + 1e-12, "{strain} and {stress} at {shear}");
        pressure = state.pressure[centre];
        for (position, velocity) in scene.flow.position.iter_mut().zip(&scene.flow.velocity) {
            *position += velocity * sheared.time();
        }
        scene.flow.stress.fill(state.stress[centre]);
        scene.flow.field.fill(strain);
    }
    let largest = (moduli.1 + start) * 0.012_f64.exp() - moduli.1;
    println!("{start:.0} Pa have become {pressure:.0}");
    assert!((pressure / largest - 1.0).abs() < 1e-3 && pressure > 3.0 * start, "{pressure} for {largest}");
}

/// A column on a rough bed beside a symmetry plane that moves apart.
pub(crate) fn falling(law: SofteningDruckerPrager) -> Scene<2> {
    let mut scene = open_scene(block([8, 12], Disorder::FULL, 3));
    scene.rheology = Rheology::SofteningDruckerPrager(law);
    scene.domain.axes[0] = AxisBoundary::Mirror { lower: Some(0.0), upper: None };
    scene.gravity[1] = -9.81;
    scene.walls = vec![bed()];
    let extent = (Vector::zeros(), Vector::repeat(0.3));
    scene.wall_particles = wall::fill(&scene.walls, &scene.domain, extent, scene.spacing, 4);
    scene
}

/// Plastic work of the ledger: Σ V ∫ (τ dκ − p de), up to p/2K of the second part, and the elastic energy that is lost
/// with the pressure; with that entry the ledger closes.
#[test]
fn dilation_takes_its_part_of_the_plastic_work_of_the_ledger() {
    let law = SofteningDruckerPrager { peak_cohesion: 200.0, residual_cohesion: 50.0, ..SAND };
    let mut simulation = simulation(falling(law));
    let start = simulation.energy().expect("a ledger");
    let modulus = Numerics::default().shear_modulus_ratio * EQUATION_OF_STATE.bulk_modulus;
    let (mut sheared, mut dilated, mut lost) = (0.0, 0.0, 0.0);
    let mut before = simulation.snapshot();
    for _ in 0..400 {
        simulation.step().expect("a stable step");
        let state = simulation.snapshot();
        for index in 0..state.mass.len() {
            let volume = state.mass[index] / state.density[index];
            let [was, is] = [&before, &state].map(|state| equivalent_shear_stress(&state.stress[index]));
            sheared += volume * 0.5 * (was + is) * (state.field[index] - before.field[index]);
            let swelling = volume_strain(state.field[index]) - volume_strain(before.field[index]);
            // of the new density before the step's dilation and with it
            let loosened = state.density[index] * volume_strain(before.field[index]).exp();
            let pressure = EQUATION_OF_STATE.pressure(loosened) + state.pressure[index];
            dilated += volume * 0.5 * pressure * swelling;
            if state.pressure[index] <= 0.0 {
                lost += volume * was * was / (2.0 * modulus);
            }
        }
        before = state;
    }
    let end = simulation.energy().expect("a ledger");
    let plastic = end.ledger.plastic - start.ledger.plastic;
    let open = end.residual_since(&start) / end.ledger.dissipated();
    println!(
        "{plastic:.5} J/m plastic of {sheared:.5} by shear and {dilated:.5} by dilation, {lost:.5} lost; {open:.4} open"
    );
    assert!(dilated > 0.05 * sheared, "{dilated} of {sheared}");
    assert!(((sheared - dilated + lost) / plastic - 1.0).abs() < 0.01 && open.abs() < 0.02, "{open}");
}

#[test]
fn dilating_soil_is_the_same_on_any_number_of_threads_and_continued() {
    let firm = SofteningDruckerPrager { peak_cohesion: 100.0, residual_cohesion: 20.0, ..SAND };
    let with = |law| Scene { rheology: Rheology::SofteningDruckerPrager(law), ..column([60, 50]) };
    determinism::check(&with(SAND));
    restart::check(&with(firm));
    determinism::check(&Scene { rheology: Rheology::SofteningDruckerPrager(SAND), ..column([13, 12, 14]) });
}

mod long {
    use super::*;

    #[test]
    #[ignore = "long: bash tests/long.sh"]
    fn firm_soil_is_the_same_on_any_number_of_threads_and_soft_soil_continued() {
        let with = |law| Scene { rheology: Rheology::SofteningDruckerPrager(law), ..column([60, 50]) };
        determinism::check(&with(SofteningDruckerPrager { peak_cohesion: 100.0, residual_cohesion: 20.0, ..SAND }));
        restart::check(&with(SAND));
    }
}
