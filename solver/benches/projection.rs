//! Cost of an incompressible step, per particle: `cargo bench -p bagnold-benches --bench projection`.
//!
//! A step bench advances through a run: clear water over a rough bed, and the same over 80 mm of 5 mm grains with water
//! between. What the linear solves take is printed after each.

use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::incompressible::{
    Bed, DragForm, Fluid, IncompressibleScene, IncompressibleSimulation, ParticleSet, ProjectionNumerics, Sediment,
    SedimentLoad, SedimentPressure, SolidFraction, SolverCost, Turbulence,
};
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::material::rheology::{CoulombBingham, Rheology};
use bagnold_solver::material::turbulence::{MixingLength, MixingLengthShape, RoughWall, VON_KARMAN};
use bagnold_solver::vector::Vector;
use criterion::{BenchmarkId, Criterion, SamplingMode, Throughput, criterion_group, criterion_main};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use rayon::ThreadPoolBuilder;
use std::time::Duration;

const GRAVITY: f64 = 9.81;
const SLOPE: f64 = 0.03;
/// Depth of the water above the bed `[m]`.
const DEPTH: f64 = 0.046;
/// Period along the bed `[m]`.
const PERIOD: f64 = 0.04;
/// Spacing of the fluid `[m]`.
const SPACING: f64 = 0.002;
/// Grain diameter and spacing of the sediment `[m]`.
const GRAIN: f64 = 0.005;
const LAW: MixingLength = MixingLength { shape: MixingLengthShape::Parabolic, origin_offset: 6e-4 };
const WALL: RoughWall = RoughWall { sand_roughness: GRAIN };
/// Steps before a measurement starts: an opening phase has other pressures and buffers grow.
const WARM_UP: usize = 400;

/// A lattice from `bottom` to `top` with a slight jitter, and four rows of wall particles below it.
fn lattice(bottom: f64, top: f64, spacing: f64, random: &mut Pcg64Mcg) -> (Vec<Vector<2>>, Vec<Vector<2>>) {
    let (columns, rows) = ((PERIOD / spacing).round() as i32, ((top - bottom) / spacing).round() as i32);
    let place = |column, row| Vector::<2>::new(f64::from(column) + 0.5, f64::from(row) + 0.5) * spacing;
    let set = |rows: std::ops::Range<i32>| rows.flat_map(|row| (0..columns).map(move |column| (column, row)));
    let mut jitter = || 1e-3 * spacing * (2.0 * random.random::<f64>() - 1.0);
    let origin = Vector::<2>::new(0.0, bottom);
    let free = set(0..rows).map(|(column, row)| origin + place(column, row) + Vector::<2>::new(jitter(), jitter()));
    (free.collect(), set(-4..0).map(|(column, row)| origin + place(column, row)).collect())
}

/// Water over a rough bed, or over a bed of grains `thickness` deep `[m]`.
fn scene(thickness: f64) -> IncompressibleScene<2> {
    let mut random = Pcg64Mcg::seed_from_u64(11);
    let (position, wall) = lattice(-thickness, DEPTH, SPACING, &mut random);
    let friction_velocity = (GRAVITY * DEPTH * SLOPE).sqrt();
    let speed = |z: f64| {
        let logarithm = ((z.max(0.0) + LAW.origin_offset) / (GRAIN / 30.0)).ln();
        if z > 0.0 { 0.9 * friction_velocity / VON_KARMAN * logarithm } else { 0.0 }
    };
    let velocity = position.iter().map(|x| Vector::<2>::new(speed(x[1]), 0.0)).collect();
    let bed = if thickness > 0.0 {
        Bed::NoSlip(-thickness)
    } else {
        Bed::Rough { level: 0.0, origin_offset: LAW.origin_offset, law: WALL }
    };
    let sediment = (thickness > 0.0).then(|| {
        let (position, wall) = lattice(-thickness, 0.0, GRAIN, &mut random);
        let count = position.len();
        Sediment {
            particles: ParticleSet { position, velocity: vec![Vector::zeros(); count] },
            filling: vec![1.0; count],
            wall,
            spacing: GRAIN,
            smoothing_ratio: ProjectionNumerics::default().smoothing_ratio,
            density: 2600.0,
            grain_diameter: GRAIN,
            law: Rheology::CoulombBingham(CoulombBingham {
                yield_stress: 7.4,
                friction: 0.6,
                plastic_viscosity: 0.3,
                regularisation_rate: 0.01,
                largest_viscosity: 1e4,
            }),
            load: SedimentLoad::Packed { level: -GRAIN, buoyant_weight: 1600.0 * GRAVITY },
            pressure: SedimentPressure::Incompressible,
            drag: DragLaw::MorsiAlexander,
            drag_form: DragForm::Grain(1.0),
            drag_smoothing_length: 3e-3,
            gravity: Vector::<2>::new(GRAVITY * SLOPE, -GRAVITY * 1600.0 / 2600.0),
        }
    });
    IncompressibleScene {
        fluid: Fluid {
            particles: ParticleSet { position, velocity },
            wall,
            spacing: SPACING,
            density: 1000.0,
            kinematic_viscosity: 1e-6,
            turbulence: Turbulence::MixingLength { level: 0.0, depth: DEPTH, law: LAW },
            bed,
            gravity: Vector::<2>::new(GRAVITY * SLOPE, -GRAVITY),
        },
        sediment,
        solid_fraction: SolidFraction::Overlapping,
        domain: Domain { axes: [AxisBoundary::Periodic { lower: 0.0, upper: PERIOD }, AxisBoundary::Open] },
        numerics: ProjectionNumerics::default(),
    }
}

fn advance(simulation: &mut IncompressibleSimulation<2>) {
    if let Err(divergence) = simulation.step() {
        panic!("{divergence}");
    }
}

fn print_cost(before: SolverCost, after: SolverCost, steps: u64) {
    let mean = |count: fn(&SolverCost) -> u64| (count(&after) - count(&before)) as f64 / steps as f64;
    println!(
        "iterations a step: {:.1} of the velocities, {:.1} of the fluid's pressure, {:.1} of the sediment's; \
         {:.2} searches a step",
        mean(|cost| cost.velocity_iterations),
        mean(|cost| cost.fluid_pressure_iterations),
        mean(|cost| cost.sediment_pressure_iterations),
        mean(|cost| cost.searches),
    );
}

fn steps(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("projection");
    group.sample_size(20).sampling_mode(SamplingMode::Flat);
    group.warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_secs(4));
    for (name, thickness) in [("clear_water", 0.0), ("sediment_bed", 0.08)] {
        for threads in [1, 2] {
            // set up when the bench is first run: a bench that is filtered out costs nothing
            let mut prepared = None;
            let scene = scene(thickness);
            let particles = scene.fluid.particles.position.len()
                + scene.sediment.as_ref().map_or(0, |sediment| sediment.particles.position.len());
            group.throughput(Throughput::Elements(particles as u64));
            let id = BenchmarkId::new(name, format!("{particles}_particles_{threads}_threads"));
            group.bench_function(id, |bencher| {
                let (pool, simulation, _) = prepared.get_or_insert_with(|| {
                    let pool = ThreadPoolBuilder::new().num_threads(threads).build().expect("a thread pool");
                    let mut simulation = IncompressibleSimulation::new(scene.clone()).expect("a valid scene");
                    pool.install(|| (0..WARM_UP).for_each(|_| advance(&mut simulation)));
                    let start = (simulation.cost(), simulation.steps());
                    (pool, simulation, start)
                });
                bencher.iter(|| pool.install(|| advance(simulation)));
            });
            if let Some((_, simulation, (cost, steps))) = &prepared {
                print_cost(*cost, simulation.cost(), (simulation.steps() - steps).max(1));
            }
        }
    }
    group.finish();
}

criterion_group!(benches, steps);
criterion_main!(benches);
