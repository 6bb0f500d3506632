//! Incompressible runs: momentum of two phases, hydrostatics, determinism, the ends of a run and of a scene.

use crate::invariants::two_phases::{GRAIN, GRAVITY, SPACING, advance, bed, periodic_box, simulation, water};
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::incompressible::{
    IncompressibleScene, IncompressibleSimulation, ParticleSet, SedimentPressure, SolidFraction, Strata, Stratification,
};
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::material::suspension_viscosity::SuspensionViscosity;
use bagnold_solver::material::turbulence::GrainRoughness;
use bagnold_solver::vector::Vector;
use rayon::ThreadPoolBuilder;

/// Σ m u of both phases and Σ m |u| `[kg m/s]`.
fn momentum(simulation: &IncompressibleSimulation<2>) -> (Vector<2>, f64) {
    let snapshot = simulation.snapshot();
    let (mut sum, mut size) = (Vector::zeros(), 0.0);
    for phase in [&snapshot.fluid, &snapshot.sediment] {
        for (mass, u) in phase.mass.iter().zip(&phase.velocity) {
            sum += u * *mass;
            size += mass * u.norm();
        }
    }
    (sum, size)
}

#[test]
fn momentum_of_two_phases_without_walls_changes_by_the_weight_alone() {
    for (velocity_tolerance, pressure_tolerance) in [(1e-2, 1e-2), (1e-8, 1e-2), (1e-8, 1e-8)] {
        let mut scene = periodic_box([24, 24], 0.1, 0.05, 3);
        scene.fluid.gravity = Vector::<2>::new(0.4, -0.7);
        let sediment = scene.sediment.as_mut().expect("grains");
        sediment.gravity = Vector::<2>::new(0.1, -1.3);
        let volume = |spacing: f64, count: usize| spacing * spacing * count as f64;
        let weight = scene.fluid.gravity * (1000.0 * volume(SPACING, 24 * 24))
            + sediment.gravity * (2600.0 * volume(GRAIN, 12 * 12));
        (scene.numerics.velocity_tolerance, scene.numerics.pressure_tolerance) =
            (velocity_tolerance, pressure_tolerance);
        let mut simulation = simulation(scene);
        let slip = |simulation: &IncompressibleSimulation<2>| {
            let drag = simulation.drag();
            drag.iter().map(Vector::norm).sum::<f64>()
        };
        for step in 0..40 {
            let (before, time) = (momentum(&simulation), simulation.time());
            advance(&mut simulation, 1);
            let (after, span) = (momentum(&simulation), simulation.time() - time);
            let error = (after.0 - before.0 - weight * span).norm();
            let size = (weight * span).norm();
            assert!(error < 1e-10 * size, "step {step}, tolerance {velocity_tolerance}: {error:.1e} of {size:.1e}");
        }
        assert!(slip(&simulation) > 0.0, "the phases do exchange momentum");
    }
}

#[test]
fn grains_that_run_together_are_stopped_by_their_own_pressure_and_not_without() {
    // u = sin(2πx/L) along x is a gradient, of which continuity leaves nothing but what lets grains come apart
    let energy = |pressure: SedimentPressure| {
        let mut scene = periodic_box([24, 24], 0.02, 0.0, 3);
        scene.fluid.gravity = Vector::zeros();
        let grains = sediment(&mut scene);
        grains.pressure = pressure;
        for (x, u) in grains.particles.position.iter().zip(&mut grains.particles.velocity) {
            u[0] = 0.01 * (std::f64::consts::TAU * x[0] / (24.0 * SPACING)).sin();
        }
        let mut simulation = simulation(scene);
        let kinetic = |simulation: &IncompressibleSimulation<2>| {
            simulation.snapshot().sediment.velocity.iter().map(Vector::norm_squared).sum::<f64>()
        };
        let before = kinetic(&simulation);
        advance(&mut simulation, 1);
        kinetic(&simulation) / before
    };
    let (with, without) = (energy(SedimentPressure::Incompressible), energy(SedimentPressure::None));
    println!("{with:.3} of the kinetic energy is left with the pressure, {without:.3} without");
    assert!(with < 0.25 && without > 0.9, "{with} and {without}");
}

#[test]
fn pressure_of_a_settled_jittered_column_is_hydrostatic() {
    let rows = 24;
    let mut simulation = simulation(water([14, rows], 0.1, 5));
    let height = f64::from(rows) * SPACING;
    simulation.run(0.5, 1.0, |_| std::ops::ControlFlow::Continue(()));
    // means over 50 steps: single pressures fluctuate with the tolerance
    let (mut error, mut size, mut mean) = (0.0, 0.0, 0.0);
    for _ in 0..50 {
        advance(&mut simulation, 1);
        for (x, p) in simulation.fluid().0.iter().zip(simulation.fluid_pressure()) {
            let exact = 1000.0 * GRAVITY * (height - x[1]);
            error += (p - exact).powi(2);
            mean += p - exact;
            size += exact * exact;
        }
    }
    let count = f64::from(50 * 14 * rows);
    let (rms, bias) = ((error / size).sqrt(), mean / count / (0.5 * 1000.0 * GRAVITY * height));
    println!("rms {rms:.4}, bias {bias:.4}");
    assert!(rms < 0.01 && bias.abs() < 0.01, "rms {rms}, bias {bias}");
}

#[test]
fn two_phases_are_the_same_to_the_last_bit_on_any_number_of_threads() {
    // more rows than two blocks of factors and than three parts of a parallel loop
    let scene = bed([40, 46], 6, 9);
    let bytes = |threads: usize, change: bool| {
        let mut scene = scene.clone();
        if change {
            let bits = &mut scene.fluid.particles.position[7][0];
            *bits = bits.next_up();
        }
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
        pool.install(|| {
            let mut simulation = simulation(scene);
            assert!(simulation.free_particles() >= 1400);
            advance(&mut simulation, 200);
            assert!(simulation.cost().searches > 3, "candidates are searched anew in the run");
            simulation.snapshot().to_bytes()
        })
    };
    let expected = bytes(1, false);
    for threads in [2, 3, 1] {
        assert!(bytes(threads, false) == expected, "{threads} threads change the state");
    }
    assert!(bytes(1, true) != expected, "the comparison can fail");
}

#[test]
fn many_particles_are_the_same_to_the_last_bit_on_any_number_of_threads_and_continued() {
    // more rows than those from which on lattices precondition the pressure, and than two blocks of sums
    let scene = bed([96, 50], 6, 9);
    let steps = 12;
    let on = |threads: usize, saved: usize| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
        pool.install(|| {
            let mut first = simulation(scene.clone());
            assert!(first.fluid().0.len() >= 4700, "{} particles", first.fluid().0.len());
            advance(&mut first, saved);
            let written = postcard::to_stdvec(&first.save()).expect("written");
            let read = postcard::from_bytes(&written).expect("read");
            let mut second = IncompressibleSimulation::continued(scene.clone(), read).expect("the same scene");
            advance(&mut second, steps - saved);
            assert!(second.cost().fluid_pressure_iterations > steps as u64, "the pressure is solved for");
            (second.snapshot().to_bytes(), second.cost())
        })
    };
    let expected = on(1, 0);
    for (threads, saved) in [(2, 0), (3, 5)] {
        assert!(on(threads, saved) == expected, "{threads} threads, saved after {saved} steps");
    }
}

#[test]
fn a_grain_beyond_the_drag_table_ends_the_run() {
    let mut scene = periodic_box([16, 16], 0.02, 0.0, 4);
    scene.fluid.kinematic_viscosity = 1e-6;
    let sediment = scene.sediment.as_mut().expect("grains");
    sediment.particles =
        ParticleSet { position: vec![Vector::<2>::new(0.016, 0.016)], velocity: vec![Vector::<2>::new(0.0, 20.0)] };
    sediment.filling = vec![1.0];
    let fluid = scene.fluid.particles.position.len();
    let divergence = simulation(scene).step().expect_err("R = 20 · 0.004/1e-6");
    assert_eq!((divergence.quantity, divergence.particle as usize), ("Reynolds number", fluid));
    assert_eq!(
        divergence.to_string(),
        "diverged at t = 0.000000 s (step 0): the Reynolds number of particle 256 at (1.6000e-2, 1.6000e-2) m is \
         8.0000e4 of a grain, above the 5.0000e4 at which its drag law ends"
    );
}

#[test]
fn grains_without_slip_feel_no_drag_and_no_infinity() {
    let scene = periodic_box([16, 16], 0.02, 0.0, 4);
    let mut simulation = simulation(IncompressibleScene {
        fluid: bagnold_solver::incompressible::Fluid { gravity: Vector::zeros(), ..scene.fluid.clone() },
        ..scene
    });
    advance(&mut simulation, 3);
    let snapshot = simulation.snapshot();
    assert_eq!(snapshot.sediment.velocity.len(), 64);
    for u in snapshot.sediment.velocity.iter().chain(&snapshot.fluid.velocity).chain(&snapshot.drag) {
        assert!(u.norm().is_finite());
    }
}

/// The message of a scene that one change has spoilt; both ways to refuse it agree.
fn message(spoil: impl FnOnce(&mut IncompressibleScene<2>)) -> String {
    let mut scene = bed([16, 16], 4, 2);
    assert_eq!(scene.check(), Ok(()));
    spoil(&mut scene);
    let found = scene.check().expect_err("a bad scene");
    let refused = IncompressibleSimulation::new(scene).map(drop).expect_err("a bad scene");
    assert_eq!(refused.to_string(), found.to_string());
    found.to_string()
}

fn sediment(scene: &mut IncompressibleScene<2>) -> &mut bagnold_solver::incompressible::Sediment<2> {
    scene.sediment.as_mut().expect("a sediment")
}

#[test]
fn phases_without_particles() {
    assert_eq!(message(|scene| scene.fluid.particles = ParticleSet::default()), "the scene has no flow particles");
    let empty = |scene: &mut IncompressibleScene<2>| {
        sediment(scene).particles = ParticleSet::default();
        (sediment(scene).wall, sediment(scene).filling) = (Vec::new(), Vec::new());
    };
    assert_eq!(message(empty), "the scene has no flow particles");
}

#[test]
fn invalid_states_and_parameters() {
    assert_eq!(
        message(|scene| scene.fluid.particles.position[5][1] = f64::NAN),
        "the position of particle 5 is NaN, but must be finite"
    );
    assert_eq!(
        message(|scene| sediment(scene).particles.velocity[3][0] = f64::INFINITY),
        "the velocity of particle 3 is inf, but must be finite"
    );
    let negative = |scene: &mut IncompressibleScene<2>| {
        let Rheology::CoulombBingham(law) = &mut sediment(scene).law else { unreachable!("Bingham's law") };
        law.yield_stress = -1.0;
    };
    assert_eq!(
        message(negative),
        "`yield_stress` is -1, but must be finite and not negative; give the yield stress in Pa, or 0 for grains without cohesion"
    );
    let full = |scene: &mut IncompressibleScene<2>| {
        let layer = Stratification::of(Strata {
            base: 0.0,
            interval: 0.01,
            solid_fraction: vec![0.6, 1.0, 0.0],
            packing: 0.64,
            buoyant_weight: 15_696.0,
            bed_level: 0.0,
            depth: 0.03,
            suspension_viscosity: SuspensionViscosity::default(),
            grain_roughness: GrainRoughness::default(),
            grain_diameter: 0.02,
        });
        scene.solid_fraction = SolidFraction::Given(layer);
    };
    assert_eq!(
        message(full),
        "`solid_fraction` is 1, but must be at least 0 and below 1; give 0 to 0.64, the share of the space that grains fill"
    );
    assert_eq!(
        message(|scene| sediment(scene).filling.truncate(1)),
        "the flow's filling has 1 entries, but there are 32 positions"
    );
}

#[test]
fn a_period_that_is_shorter_than_two_reaches() {
    let short = |scene: &mut IncompressibleScene<2>| {
        scene.domain.axes[0] = AxisBoundary::Periodic { lower: 0.0, upper: 0.019 };
    };
    // two reaches of the grains: 2 · 2 · 1.2 · 4 mm
    assert_eq!(
        message(short),
        "the period along axis 0 is 0.019 m, but must be at least 0.0192 m, the reach of the kernel; make the domain \
         longer or the particles smaller"
    );
}
