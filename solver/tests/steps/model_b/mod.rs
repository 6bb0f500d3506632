//! Tests of the internals of a step: pairs against brute force, operators against their definitions.

mod columns;
mod eddy_viscosity;
mod mixture;
mod pairs;
mod pressure_operators;
mod restart;
mod velocity_rows;

use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::incompressible::{
    Bed, DragForm, Fluid, IncompressibleScene, ParticleSet, ProjectionNumerics, Sediment, SedimentLoad,
    SedimentPressure, SolidFraction, Turbulence,
};
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::material::rheology::{CoulombBingham, Rheology};
use bagnold_solver::vector::Vector;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

const SPACING: f64 = 0.01;

fn random(seed: u64) -> Pcg64Mcg {
    Pcg64Mcg::seed_from_u64(seed)
}

/// Uniform in (−1, 1).
fn symmetric(random: &mut Pcg64Mcg) -> f64 {
    2.0 * random.random::<f64>() - 1.0
}

fn lattice(cells: [usize; 2], spacing: f64, jitter: f64, random: &mut Pcg64Mcg) -> Vec<Vector<2>> {
    let place = |k: usize| Vector::<2>::new((k % cells[0]) as f64 + 0.5, (k / cells[0]) as f64 + 0.5);
    let mut moved = |k| (place(k) + Vector::<2>::from_fn(|_, _| jitter * symmetric(random))) * spacing;
    (0..cells[0] * cells[1]).map(&mut moved).collect()
}

/// Water at rest, periodic along the bed; a bed at height 0 if it is not periodic across too.
fn water(cells: [usize; 2], jitter: f64, closed: bool, seed: u64) -> IncompressibleScene<2> {
    let position = lattice(cells, SPACING, jitter, &mut random(seed));
    let velocity = vec![Vector::zeros(); position.len()];
    let wall = if closed {
        Vec::new()
    } else {
        let below = |x: Vector<2>| x - Vector::<2>::new(0.0, 4.0 * SPACING);
        lattice([cells[0], 4], SPACING, 0.0, &mut random(0)).into_iter().map(below).collect()
    };
    let period = |cells: usize| AxisBoundary::Periodic { lower: 0.0, upper: cells as f64 * SPACING };
    let across = if closed { period(cells[1]) } else { AxisBoundary::Open };
    IncompressibleScene {
        fluid: Fluid {
            particles: ParticleSet { position, velocity },
            wall,
            spacing: SPACING,
            density: 1000.0,
            kinematic_viscosity: 1e-6,
            turbulence: Turbulence::Laminar,
            bed: Bed::Slip,
            gravity: Vector::<2>::new(0.0, if closed { 0.0 } else { -9.81 }),
        },
        sediment: None,
        solid_fraction: SolidFraction::Overlapping,
        domain: Domain { axes: [period(cells[0]), across] },
        numerics: ProjectionNumerics::default(),
    }
}

/// Loose grains, twice as far apart as the water's particles.
fn grains(cells: [usize; 2], jitter: f64, seed: u64) -> Sediment<2> {
    let position = lattice(cells, 2.0 * SPACING, jitter, &mut random(seed));
    let count = position.len();
    Sediment {
        particles: ParticleSet { position, velocity: vec![Vector::zeros(); count] },
        filling: vec![1.0; count],
        wall: Vec::new(),
        spacing: 2.0 * SPACING,
        smoothing_ratio: ProjectionNumerics::default().smoothing_ratio,
        density: 2600.0,
        grain_diameter: 2.0 * SPACING,
        drag_diameter: 2.0 * SPACING,
        law: Rheology::CoulombBingham(CoulombBingham {
            yield_stress: 1.0,
            friction: 0.0,
            plastic_viscosity: 0.3,
            regularisation_rate: 0.01,
            largest_viscosity: 1e4,
        }),
        load: SedimentLoad::Packed { level: 0.0, buoyant_weight: 0.0 },
        pressure: SedimentPressure::Incompressible,
        drag: DragLaw::SchillerNaumann,
        drag_form: DragForm::Grain,
        drag_smoothing_length: 1.5 * SPACING,
        gravity: Vector::zeros(),
    }
}
