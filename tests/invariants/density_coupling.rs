//! The density–pressure coupling (27): blind to linear pressures, exact on a checkerboard, makes no mass.

use crate::invariants::patches::{
    Disorder, EQUATION_OF_STATE, SOUND_SPEED, SPACING, block, open_scene, periodic_scene, simulation,
};
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::kernel::{Kernel, KernelShape};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::numerics::Numerics;
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};

/// Change of every density by the coupling in the first step `[kg/m³]`, and the densities before it.
fn effect<const D: usize>(scene: &Scene<D>) -> (Vec<f64>, Vec<f64>)
where
    Simulation<D>: Compiled<D>,
{
    let densities = |density_coupling| {
        let numerics = Numerics { density_coupling, ..scene.numerics };
        let mut simulation = simulation(Scene { numerics, ..scene.clone() });
        simulation.step().expect("a stable step");
        simulation.snapshot().density
    };
    let change = densities(1.0).iter().zip(densities(0.0)).map(|(with, without)| with - without).collect();
    (change, scene.flow.density.clone())
}

fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most, value| most.max(value.abs()))
}

/// A jittered layer, periodic across, with free surfaces on both sides, whose pressure is a function of the height
/// in spacings.
fn layer<const D: usize>(cells: [usize; D], pressure: impl Fn(f64) -> f64) -> Scene<D> {
    let mut scene = periodic_scene(cells, Disorder { jitter: 0.2, ..Disorder::NONE }, 3);
    scene.domain.axes[D - 1] = AxisBoundary::Open;
    for (position, density) in scene.flow.position.iter().zip(&mut scene.flow.density) {
        *density = EQUATION_OF_STATE.density(pressure(position[D - 1] / SPACING));
    }
    scene
}

#[test]
fn a_linear_pressure_is_not_felt_also_at_a_free_surface() {
    fn check<const D: usize>(cells: [usize; D])
    where
        Simulation<D>: Compiled<D>,
    {
        let linear = largest(effect(&layer(cells, |height| 3000.0 - 150.0 * height)).0);
        let curved = largest(effect(&layer(cells, |height| 3000.0 - 10.0 * height * height)).0);
        // the difference of two densities of 1500 kg/m³ has no more digits
        assert!(linear < 2e-12, "{D}-D: {linear:.1e} kg/m³");
        assert!(curved > 1e-4, "{D}-D: a curved pressure is felt, {curved:.1e} kg/m³");
    }
    check([20, 14]);
    check([7, 8, 10]);
}

#[test]
fn the_coupling_makes_no_mass() {
    let scene = periodic_scene([16, 15], Disorder { speed: 0.0, ..Disorder::FULL }, 9);
    let (change, density) = effect(&scene);
    let volume = scene.flow.mass.iter().zip(&density).map(|(mass, density)| mass / density);
    let (mut sum, mut scale) = (0.0, 0.0);
    for (change, volume) in change.iter().zip(volume) {
        sum += change * volume;
        scale += change.abs() * volume;
    }
    // rounding of ρ = 1500 kg/m³ in changes of the order 0.1 kg/m³
    assert!(sum.abs() < 1e-12 * scale, "{sum:.1e} of {scale:.1e} kg");
}

#[test]
fn a_checkerboard_is_damped_at_the_rate_of_its_pair_sum() {
    let cells = [16, 16];
    let mut scene = periodic_scene(cells, Disorder::NONE, 1);
    scene.numerics.artificial_viscosity = 0.0;
    let amplitude = 0.5;
    let colour = |index: usize| if (index % cells[0] + index / cells[0]).is_multiple_of(2) { 1.0 } else { -1.0 };
    let mean = EQUATION_OF_STATE.density(2000.0);
    for (index, density) in scene.flow.density.iter_mut().enumerate() {
        *density = mean + amplitude * colour(index);
    }
    let uncoupled = Scene { numerics: Numerics { density_coupling: 0.0, ..scene.numerics }, ..scene.clone() };
    let kept = {
        let mut simulation = simulation(uncoupled);
        simulation.step().expect("a stable step");
        let density = simulation.snapshot().density;
        largest(density.iter().zip(&scene.flow.density).map(|(after, before)| after - before))
    };
    // velocities stay zero by symmetry, so nothing but the coupling can see the pattern
    assert!(kept < 1e-9, "{kept:.1e} kg/m³");
    // by hand: dρ = Δt² Σ V F 2 (p_a − p_b) over the neighbours of the other colour; G = 0 by symmetry
    let kernel = Kernel::<2>::new(KernelShape::WendlandC2, 1.5 * SPACING);
    let time_step = 0.4 * 1.5 * SPACING / SOUND_SPEED;
    let difference = 2.0 * amplitude * SOUND_SPEED * SOUND_SPEED;
    let (change, density) = effect(&scene);
    for (index, found) in change.iter().enumerate() {
        let other = mean - amplitude * colour(index);
        let volume = scene.flow.mass[index] / other;
        let mut expected = 0.0;
        for i in -3_i32..=3 {
            for j in -3_i32..=3 {
                if (i + j).rem_euclid(2) == 1 {
                    let distance = f64::from(i * i + j * j).sqrt() * SPACING;
                    expected += volume * kernel.gradient_factor_at(distance) * 2.0 * difference * colour(index);
                }
            }
        }
        expected *= time_step * time_step;
        assert!((found - expected).abs() < 1e-9 * expected.abs(), "{found} for {expected}");
        assert!(expected * colour(index) < -0.1 * amplitude, "damped: {expected} on {}", density[index] - mean);
    }
}

#[test]
fn an_open_block_at_uniform_pressure_is_left_alone() {
    let mut scene = open_scene(block([12, 12], Disorder { jitter: 0.3, ..Disorder::NONE }, 2));
    scene.flow.density.fill(EQUATION_OF_STATE.density(1000.0));
    scene.domain = Domain { axes: [AxisBoundary::Mirror { lower: Some(0.0), upper: None }, AxisBoundary::Open] };
    scene.gravity = Vector::<2>::new(0.0, -9.81);
    let found = largest(effect(&scene).0);
    assert!(found < 2e-12, "{found:.1e} kg/m³");
}
