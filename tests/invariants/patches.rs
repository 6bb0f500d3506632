//! The states that the invariants are tested on: seeded, disordered blocks of grains or liquid.

use crate::threads::alone;
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::{MuI, Newtonian, Rheology};
use bagnold_solver::vector::{Tensor, Vector, deviator, equivalent_shear_stress};
use bagnold_solver::weakly_compressible::enclosure::BoundarySet;
use bagnold_solver::weakly_compressible::numerics::{Numerics, PairPrecision};
use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::walls::Wall;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

/// Particle spacing `[m]`.
pub(crate) const SPACING: f64 = 0.01;
/// Reference density `[kg/m³]`.
pub(crate) const DENSITY: f64 = 1500.0;
/// Sound speed `[m/s]`.
pub(crate) const SOUND_SPEED: f64 = 20.0;

pub(crate) const EQUATION_OF_STATE: EquationOfState = EquationOfState {
    reference_density: DENSITY,
    bulk_modulus: DENSITY * SOUND_SPEED * SOUND_SPEED,
    tension: Tension::Cut,
};

pub(crate) const GRAINS: Rheology = Rheology::MuI(MuI {
    static_friction: 0.382,
    limiting_friction: 0.643,
    reference_inertia: 0.279,
    grain_diameter: 0.5e-3,
    grain_density: 2500.0,
});

pub(crate) const SYRUP: Rheology = Rheology::Newtonian(Newtonian { viscosity: 20.0 });

/// Deviation of a block from a lattice at rest.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Disorder {
    /// Largest displacement along each axis, in spacings `[-]`.
    pub(crate) jitter: f64,
    /// Largest velocity component `[m/s]`.
    pub(crate) speed: f64,
    /// Range of ρ/ρ0 − 1 `[-]`.
    pub(crate) compression: (f64, f64),
    /// Largest equivalent shear stress over pressure `[-]`.
    pub(crate) stress: f64,
    /// Largest relative deviation of a mass `[-]`.
    pub(crate) mass: f64,
}

impl Disorder {
    /// A lattice without pressure, at rest.
    pub(crate) const NONE: Self = Self { jitter: 0.0, speed: 0.0, compression: (0.0, 0.0), stress: 0.0, mass: 0.0 };
    /// Everything at once.
    pub(crate) const FULL: Self =
        Self { jitter: 0.2, speed: 0.5, compression: (0.002, 0.01), stress: 0.35, mass: 0.05 };
}

pub(crate) fn random(seed: u64) -> Pcg64Mcg {
    Pcg64Mcg::seed_from_u64(seed)
}

/// Uniform in (−1, 1).
pub(crate) fn symmetric(random: &mut Pcg64Mcg) -> f64 {
    2.0 * random.random::<f64>() - 1.0
}

/// A block of `cells` particles with its lower corner in the origin.
pub(crate) fn block<const D: usize>(cells: [usize; D], disorder: Disorder, seed: u64) -> Flow<D> {
    let mut random = random(seed);
    let mut flow = Flow::default();
    for index in 0..cells.iter().product() {
        let mut rest = index;
        let position = Vector::<D>::from_fn(|axis, _| {
            let cell = rest % cells[axis];
            rest /= cells[axis];
            (cell as f64 + 0.5 + disorder.jitter * symmetric(&mut random)) * SPACING
        });
        let share: f64 = random.random();
        let density =
            DENSITY * (1.0 + disorder.compression.0 + share * (disorder.compression.1 - disorder.compression.0));
        let general = Tensor::<D>::from_fn(|_, _| symmetric(&mut random));
        let stress = deviator(&(general + general.transpose()));
        let target = disorder.stress * random.random::<f64>() * EQUATION_OF_STATE.pressure(density);
        flow.position.push(position);
        flow.velocity.push(Vector::from_fn(|_, _| disorder.speed * symmetric(&mut random)));
        flow.density.push(density);
        flow.mass.push(DENSITY * SPACING.powi(D as i32) * (1.0 + disorder.mass * symmetric(&mut random)));
        flow.stress.push(stress * (target / equivalent_shear_stress(&stress)));
    }
    flow
}

/// The recipe with pairs in double precision, whose sums close to rounding. What single precision leaves of that is in
/// `pair_precision`.
pub(crate) fn exact_pairs() -> Numerics {
    Numerics { pair_precision: PairPrecision::Double, ..Numerics::default() }
}

/// Grains without gravity, walls or boundaries, with the recipe's numerics and pairs in double precision.
pub(crate) fn open_scene<const D: usize>(flow: Flow<D>) -> Scene<D> {
    Scene {
        flow,
        walls: Vec::new(),
        wall_particles: Vec::new(),
        enclosure: BoundarySet::default(),
        side_walls: None,
        domain: Domain { axes: [AxisBoundary::Open; D] },
        gravity: Vector::zeros(),
        spacing: SPACING,
        equation_of_state: EQUATION_OF_STATE,
        rheology: GRAINS,
        numerics: exact_pairs(),
    }
}

/// The same, periodic along every axis over `cells` spacings.
pub(crate) fn periodic_scene<const D: usize>(cells: [usize; D], disorder: Disorder, seed: u64) -> Scene<D> {
    let axes = cells.map(|cells| AxisBoundary::Periodic { lower: 0.0, upper: cells as f64 * SPACING });
    Scene { domain: Domain { axes }, ..open_scene(block(cells, disorder, seed)) }
}

/// A wall normal to the last axis, below the flow, at rest.
pub(crate) fn bed<const D: usize>() -> Wall<D> {
    Wall::still(D - 1, 0.0, 1.0)
}

pub(crate) fn simulation<const D: usize>(scene: Scene<D>) -> Simulation<D>
where
    Simulation<D>: Compiled<D>,
{
    alone();
    Simulation::new(scene).expect("a valid scene")
}

/// Takes `steps` steps.
pub(crate) fn advance<const D: usize>(simulation: &mut Simulation<D>, steps: usize)
where
    Simulation<D>: Compiled<D>,
{
    for _ in 0..steps {
        if let Err(divergence) = simulation.step() {
            panic!("{divergence}");
        }
    }
}

/// Largest difference of two sets of vectors, in their unit.
pub(crate) fn largest_difference<const D: usize>(a: &[Vector<D>], b: &[Vector<D>]) -> f64 {
    assert_eq!(a.len(), b.len());
    a.iter().zip(b).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}
