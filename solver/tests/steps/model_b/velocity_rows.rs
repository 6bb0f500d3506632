//! The implicit velocities against plain sums over all pairs: what they solve is the balance of momentum of every particle.

use super::pairs::by_force;
use super::{grains, random, symmetric, water};
use bagnold_solver::incompressible::{Bed, IncompressibleSimulation, Turbulence};
use bagnold_solver::internals::incompressible::{Sources, state};
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::material::turbulence::Smagorinsky;
use bagnold_solver::vector::Vector;
use std::f64::consts::PI;

#[test]
fn implicit_velocities_close_the_balance_of_every_particle() {
    let (mut scene, mut random) = (water([12, 15], 0.2, false, 7), random(8));
    let mut sediment = grains([6, 5], 0.2, 4);
    for u in scene.fluid.particles.velocity.iter_mut().chain(&mut sediment.particles.velocity) {
        *u = Vector::<2>::from_fn(|_, _| 0.1 * symmetric(&mut random));
    }
    scene.fluid.bed = Bed::NoSlip(0.0);
    scene.fluid.kinematic_viscosity = 1e-2;
    scene.fluid.turbulence = Turbulence::Smagorinsky(Smagorinsky { coefficient: 1.0 });
    sediment.gravity = Vector::<2>::new(0.5, -6.0);
    (scene.numerics.velocity_tolerance, scene.sediment) = (1e-13, Some(sediment.clone()));
    let mut simulation = IncompressibleSimulation::new(scene.clone()).expect("a valid scene");
    simulation.step().expect("a step");
    let state = state(&simulation);
    let (fluid, solid) = (&state.phases.fluid, state.phases.sediment.as_ref().expect("a sediment"));
    let (time_step, solved, rows) = (state.last_step, &state.system.velocity, fluid.len());
    let (water, bed, loose) = (&scene.fluid.particles, &scene.fluid.wall, &sediment.particles);
    let of = |targets, sources, which, reach| by_force(targets, sources, which, &scene.domain, reach);
    let friction = of(&water.position, &water.position, Sources::Same, fluid.kernel.support());
    let below = of(&water.position, bed, Sources::Other, fluid.kernel.support());
    let rubbing = of(&loose.position, &loose.position, Sources::Same, solid.kernel.support());
    let dragging = of(&loose.position, &water.position, Sources::Other, state.exchange.reach());
    let mut forces = vec![Vector::<2>::zeros(); solved.len()];
    for a in 0..rows {
        let viscosity = &state.viscosities.fluid;
        for (b, r) in friction[a].iter().map(|(b, r)| (*b as usize, r)) {
            let weight = fluid.lattice_volume.powi(2) * fluid.kernel.gradient_factor_at(r.norm());
            let both = (viscosity[a] + viscosity[b]) / (fluid.moment[a] + fluid.moment[b]);
            forces[a] += (solved[a] - solved[b]) * (2.0 * weight * both);
        }
        for (_, r) in &below[a] {
            let height = water.position[a][1].max(0.1 * super::SPACING);
            let mirrored = (1.0 + (r[1] - height).max(0.0) / height).min(6.0);
            let weight = fluid.lattice_volume.powi(2) * fluid.kernel.gradient_factor_at(r.norm());
            forces[a] += solved[a] * (2.0 * weight * mirrored * viscosity[a] / fluid.moment[a]);
        }
    }
    for (s, (row, velocity)) in (rows..).zip(&loose.velocity).enumerate() {
        for (b, r) in rubbing[s].iter().map(|(b, r)| (*b as usize, r)) {
            let weight = solid.lattice_volume.powi(2) * solid.kernel.gradient_factor_at(r.norm());
            let rate = 4.0 / PI * (velocity - loose.velocity[b]).norm() / r.norm();
            let both = 2.0 * sediment.law.viscosity(rate, 0.0) / (solid.moment[s] + solid.moment[b]);
            forces[row] += (solved[row] - solved[rows + b]) * (2.0 * weight * both);
        }
        let value = |r: &Vector<2>| state.exchange.kernel().value_at(r.norm());
        let around: f64 = dragging[s].iter().map(|(_, r)| value(r)).sum();
        let mean =
            dragging[s].iter().fold(Vector::<2>::zeros(), |sum, (b, r)| sum + water.velocity[*b as usize] * value(r));
        let reynolds = (mean / around - velocity).norm() * sediment.grain_diameter / scene.fluid.kinematic_viscosity;
        let factor = 0.5
            * scene.fluid.kinematic_viscosity
            * DragLaw::SchillerNaumann.drag_times_reynolds(reynolds).expect("a grain");
        for (b, r) in dragging[s].iter().map(|(b, r)| (*b as usize, r)) {
            let force = (solved[b] - solved[row]) * (fluid.mass[b] * value(r) * factor);
            forces[row] += force;
            forces[b] -= force;
        }
    }
    let of_water = water.velocity.iter().map(|u| (u, &scene.fluid.gravity)).zip(&fluid.mass);
    let of_grains = loose.velocity.iter().map(|u| (u, &sediment.gravity)).zip(&solid.mass);
    for (row, ((before, gravity), mass)) in of_water.chain(of_grains).enumerate() {
        let change = before + (gravity + forces[row] / *mass) * time_step - solved[row];
        // coefficients are single precision
        assert!(change.norm() < 1e-6, "row {row}: {change} of {}", solved[row] - before);
    }
}

/// Without weight, walls and pressure the grains gain what the drag that is shown has given them, along the water.
#[test]
fn the_drag_that_is_shown_is_what_the_grains_gain() {
    let mut scene = water([12, 12], 0.2, true, 7);
    scene.fluid.particles.velocity.fill(Vector::<2>::new(0.3, 0.1));
    scene.sediment = Some(grains([6, 6], 0.2, 4));
    scene.numerics.velocity_tolerance = 1e-13;
    let mut simulation = IncompressibleSimulation::new(scene).expect("a valid scene");
    simulation.step().expect("a step");
    let (system, first) = (&state(&simulation).system, state(&simulation).phases.fluid.len());
    let gained: Vector<2> = (first..system.velocity.len()).map(|row| system.velocity[row] * system.inertia[row]).sum();
    let given: Vector<2> = simulation.drag().iter().sum();
    assert!(given[0] > 0.0 && given[1] > 0.0, "{given}");
    let difference = (given * state(&simulation).last_step - gained).norm();
    assert!(difference < 1e-10 * gained.norm(), "{given} and {gained}");
}
