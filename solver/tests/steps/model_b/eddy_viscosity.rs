//! Eddy viscosity of each closure in a uniform shear of perturbed particles, where the corrected gradient is exact.

use super::{random, symmetric, water};
use bagnold_solver::incompressible::{IncompressibleSimulation, Turbulence};
use bagnold_solver::internals::incompressible::{State, measure, state, state_mut};
use bagnold_solver::material::turbulence::{MixingLength, MixingLengthShape, Smagorinsky};
use bagnold_solver::vector::{Tensor, Vector, shear_rate};

const SHEAR_RATE: f64 = 40.0;

/// Height `[m]` and eddy viscosity `[m²/s]` of every particle.
fn eddy_viscosities(turbulence: Turbulence) -> Vec<(f64, f64)> {
    let mut scene = water([12, 15], 0.2, false, 7);
    let particles = &mut scene.fluid.particles;
    particles.velocity = particles.position.iter().map(|x| Vector::<2>::new(SHEAR_RATE * x[1], 0.0)).collect();
    scene.fluid.turbulence = turbulence;
    let mut simulation = IncompressibleSimulation::new(scene).expect("a valid scene");
    measure(state_mut(&mut simulation));
    let State { scene, phases, viscosities, .. } = state_mut(&mut simulation);
    viscosities.find(scene, phases, scene.numerics.time_step);
    let (density, molecular) = (1000.0, 1e-6);
    let eddy = |viscosity: &f64| viscosity / density - molecular;
    phases.fluid.position.iter().map(|x| x[1]).zip(viscosities.fluid.iter().map(eddy)).collect()
}

#[test]
fn smagorinsky_mixes_by_the_spacing_at_every_height() {
    // (C_s Δ)² γ̇ with Δ = 10 mm: (1.5 mm)² × 40/s
    for (height, eddy) in eddy_viscosities(Turbulence::Smagorinsky(Smagorinsky { coefficient: 0.15 })) {
        assert!((eddy - 9e-5).abs() < 1e-12, "z = {height} m: {eddy} m²/s");
    }
}

#[test]
fn a_mixing_length_grows_with_the_height() {
    let law = MixingLength { shape: MixingLengthShape::Linear, origin_offset: 0.0 };
    for (height, eddy) in eddy_viscosities(Turbulence::MixingLength { level: 0.0, depth: 0.15, law }) {
        let expected = (0.41 * height).powi(2) * SHEAR_RATE;
        assert!((eddy - expected).abs() < 1e-9 * expected, "z = {height} m: {eddy} or {expected} m²/s");
    }
}

/// Mean shear rate of the eddies `[1/s]`, and of the particles' own gradients, where particles move at random in a shear: for
/// four times the time of the mean.
fn random_motion(shear: f64) -> (f64, f64) {
    let mut scene = water([12, 15], 0.2, false, 7);
    scene.fluid.turbulence = Turbulence::Stratified;
    let steps = (4.0 * scene.numerics.mean_flow_time / scene.numerics.time_step) as usize;
    let mut simulation = IncompressibleSimulation::new(scene).expect("a valid scene");
    let (mut random, mut own) = (random(11), 0.0);
    for _ in 0..steps {
        let fluid = &mut state_mut(&mut simulation).phases.fluid;
        for (u, x) in fluid.velocity.iter_mut().zip(&fluid.position) {
            *u = Vector::<2>::new(0.8 + shear * x[1], 0.0) + Vector::<2>::from_fn(|_, _| 2e-2 * symmetric(&mut random));
        }
        measure(state_mut(&mut simulation));
        let State { scene, phases, viscosities, .. } = state_mut(&mut simulation);
        viscosities.find(scene, phases, scene.numerics.time_step);
        own = phases.fluid.velocity_gradient.iter().map(shear_rate).sum::<f64>() / phases.fluid.len() as f64;
    }
    let rate = &state(&simulation).viscosities.fluid_rate;
    (rate.iter().sum::<f64>() / rate.len() as f64, own)
}

#[test]
fn random_motion_of_particles_makes_no_eddies() {
    let (rate, own) = random_motion(0.0);
    assert!(own > 0.3 && rate < 0.05 * own, "{rate} of {own} 1/s");
    let shear = 0.5;
    let (rate, own) = random_motion(shear);
    // a mean over 800 steps, of 180 particles: its standard error is 0.6 %
    assert!(own > 1.15 * shear && (rate / shear - 1.0).abs() < 0.02, "{rate} and {own} of {shear} 1/s");
}

#[test]
fn the_gradient_of_a_linear_flow_is_exact_inside() {
    let gradient = Tensor::<2>::new(3.0, -40.0, 17.0, -5.0);
    let mut scene = water([12, 15], 0.2, false, 7);
    let particles = &mut scene.fluid.particles;
    particles.velocity = particles.position.iter().map(|x| gradient * x).collect();
    scene.fluid.turbulence = Turbulence::Smagorinsky(Smagorinsky { coefficient: 0.15 });
    let mut simulation = IncompressibleSimulation::new(scene).expect("a valid scene");
    measure(state_mut(&mut simulation));
    let fluid = &state(&simulation).phases.fluid;
    // across the period the flow jumps
    let inside = (0..fluid.len()).filter(|&a| fluid.position[a][0] > 0.03 && fluid.position[a][0] < 0.09);
    for found in inside.map(|a| fluid.velocity_gradient[a]) {
        assert!((found - gradient).norm() < 1e-11, "{found}");
    }
}
