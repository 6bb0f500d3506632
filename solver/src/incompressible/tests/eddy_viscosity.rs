//! Eddy viscosity of each closure in a uniform shear of perturbed particles, where the corrected gradient is exact.

use super::super::Turbulence;
use super::super::simulation::IncompressibleSimulation;
use super::super::state::State;
use super::super::step;
use super::water;
use crate::material::turbulence::{MixingLength, MixingLengthShape, Smagorinsky};
use crate::vector::{Tensor, Vector};

const SHEAR_RATE: f64 = 40.0;

/// Height `[m]` and eddy viscosity `[m²/s]` of every particle.
fn eddy_viscosities(turbulence: Turbulence) -> Vec<(f64, f64)> {
    let mut scene = water([12, 15], 0.2, false, 7);
    let particles = &mut scene.fluid.particles;
    particles.velocity = particles.position.iter().map(|x| Vector::<2>::new(SHEAR_RATE * x[1], 0.0)).collect();
    scene.fluid.turbulence = turbulence;
    let mut simulation = IncompressibleSimulation::new(scene).expect("a valid scene");
    step::measure(&mut simulation.state);
    let State { scene, phases, viscosities, .. } = &mut simulation.state;
    viscosities.find(scene, phases);
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

#[test]
fn the_gradient_of_a_linear_flow_is_exact_inside() {
    let gradient = Tensor::<2>::new(3.0, -40.0, 17.0, -5.0);
    let mut scene = water([12, 15], 0.2, false, 7);
    let particles = &mut scene.fluid.particles;
    particles.velocity = particles.position.iter().map(|x| gradient * x).collect();
    scene.fluid.turbulence = Turbulence::Smagorinsky(Smagorinsky { coefficient: 0.15 });
    let mut simulation = IncompressibleSimulation::new(scene).expect("a valid scene");
    step::measure(&mut simulation.state);
    let fluid = &simulation.state.phases.fluid;
    // across the period the flow jumps
    let inside = (0..fluid.len()).filter(|&a| fluid.position[a][0] > 0.03 && fluid.position[a][0] < 0.09);
    for found in inside.map(|a| fluid.velocity_gradient[a]) {
        assert!((found - gradient).norm() < 1e-11, "{found}");
    }
}
