//! The states that incompressible runs are tested on: seeded water and grains.

use crate::threads::alone;
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::incompressible::{
    Bed, DragForm, Fluid, IncompressibleScene, IncompressibleSimulation, ParticleSet, ProjectionNumerics, Sediment,
    SedimentLoad, SedimentPressure, SolidFraction, Turbulence,
};
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::material::rheology::{CoulombBingham, Rheology};
use bagnold_solver::vector::Vector;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Spacing of the water `[m]`; that of the grains is twice as large.
pub(crate) const SPACING: f64 = 0.002;
pub(crate) const GRAIN: f64 = 2.0 * SPACING;
pub(crate) const GRAVITY: f64 = 9.81;

pub(crate) fn random(seed: u64) -> Pcg64Mcg {
    Pcg64Mcg::seed_from_u64(seed)
}

/// Uniform in (−1, 1).
pub(crate) fn symmetric(random: &mut Pcg64Mcg) -> f64 {
    2.0 * random.random::<f64>() - 1.0
}

/// A lattice of `cells` from row `first` on, jittered by a part of the spacing.
fn lattice(cells: [i32; 2], first: i32, spacing: f64, jitter: f64, random: &mut Pcg64Mcg) -> Vec<Vector<2>> {
    let places = (first..first + cells[1]).flat_map(|row| (0..cells[0]).map(move |column| (column, row)));
    let mut place = |(column, row)| {
        let centre = Vector::<2>::new(f64::from(column) + 0.5, f64::from(row) + 0.5);
        (centre + Vector::<2>::from_fn(|_, _| jitter * symmetric(random))) * spacing
    };
    places.map(&mut place).collect()
}

fn period(cells: i32) -> AxisBoundary {
    AxisBoundary::Periodic { lower: 0.0, upper: f64::from(cells) * SPACING }
}

/// Water at rest over a slip wall at height 0, periodic along it.
pub(crate) fn water(cells: [i32; 2], jitter: f64, seed: u64) -> IncompressibleScene<2> {
    let mut random = random(seed);
    let position = lattice(cells, 0, SPACING, jitter, &mut random);
    IncompressibleScene {
        fluid: Fluid {
            particles: ParticleSet { velocity: vec![Vector::zeros(); position.len()], position },
            wall: lattice([cells[0], 4], -4, SPACING, 0.0, &mut random),
            spacing: SPACING,
            density: 1000.0,
            kinematic_viscosity: 1e-6,
            turbulence: Turbulence::Laminar,
            bed: Bed::Slip,
            gravity: Vector::<2>::new(0.0, -GRAVITY),
        },
        sediment: None,
        solid_fraction: SolidFraction::Overlapping,
        domain: Domain { axes: [period(cells[0]), AxisBoundary::Open] },
        numerics: ProjectionNumerics::default(),
    }
}

/// Grains at rest on fixed ones, `rows` of them, below water of `cells`; the bed slopes by 3 %.
pub(crate) fn bed(cells: [i32; 2], rows: i32, seed: u64) -> IncompressibleScene<2> {
    let mut scene = water(cells, 0.02, seed);
    let mut random = random(seed + 1);
    scene.fluid.bed = Bed::NoSlip(0.0);
    scene.fluid.gravity[0] = 0.03 * GRAVITY;
    for (x, u) in scene.fluid.particles.position.iter().zip(&mut scene.fluid.particles.velocity) {
        u[0] = 4.0 * (x[1] - f64::from(rows) * GRAIN).max(0.0);
    }
    let position = lattice([cells[0] / 2, rows], 0, GRAIN, 0.02, &mut random);
    let mut grains = grains(position);
    grains.wall = lattice([cells[0] / 2, 4], -4, GRAIN, 0.0, &mut random);
    grains.gravity = Vector::<2>::new(0.03 * GRAVITY, -GRAVITY * 1600.0 / 2600.0);
    scene.sediment = Some(grains);
    scene
}

fn grains(position: Vec<Vector<2>>) -> Sediment<2> {
    let count = position.len();
    Sediment {
        particles: ParticleSet { position, velocity: vec![Vector::zeros(); count] },
        filling: vec![1.0; count],
        wall: Vec::new(),
        spacing: GRAIN,
        smoothing_ratio: ProjectionNumerics::default().smoothing_ratio,
        density: 2600.0,
        grain_diameter: GRAIN,
        drag_diameter: GRAIN,
        law: Rheology::CoulombBingham(CoulombBingham {
            yield_stress: 5.0,
            friction: 0.6,
            plastic_viscosity: 0.3,
            regularisation_rate: 0.01,
            largest_viscosity: 1e4,
        }),
        load: SedimentLoad::Packed { level: 0.0, buoyant_weight: 1600.0 * GRAVITY },
        pressure: SedimentPressure::Incompressible,
        drag: DragLaw::MorsiAlexander,
        drag_form: DragForm::Grain,
        drag_smoothing_length: 1.5 * SPACING,
        gravity: Vector::zeros(),
    }
}

/// Both phases in a box that is periodic along both axes, without walls; random velocities up to `speed` `[m/s]`.
pub(crate) fn periodic_box(cells: [i32; 2], jitter: f64, speed: f64, seed: u64) -> IncompressibleScene<2> {
    let mut scene = water(cells, jitter, seed);
    let mut random = random(seed + 1);
    scene.fluid.wall.clear();
    scene.fluid.kinematic_viscosity = 1e-4;
    scene.domain.axes[1] = period(cells[1]);
    scene.sediment = Some(grains(lattice([cells[0] / 2, cells[1] / 2], 0, GRAIN, jitter, &mut random)));
    let sediment = scene.sediment.as_mut().map(|sediment| &mut sediment.particles);
    for set in std::iter::once(&mut scene.fluid.particles).chain(sediment) {
        for u in &mut set.velocity {
            *u = Vector::<2>::from_fn(|_, _| speed * symmetric(&mut random));
        }
    }
    scene
}

pub(crate) fn simulation(scene: IncompressibleScene<2>) -> IncompressibleSimulation<2> {
    alone();
    IncompressibleSimulation::new(scene).expect("a valid scene")
}

/// Takes `steps` steps.
pub(crate) fn advance(simulation: &mut IncompressibleSimulation<2>, steps: usize) {
    for _ in 0..steps {
        if let Err(divergence) = simulation.step() {
            panic!("{divergence}");
        }
    }
}
