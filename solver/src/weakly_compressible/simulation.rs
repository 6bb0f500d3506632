//! A simulation: what a user sets up, steps, runs and reads.

use crate::lanes::InstructionSet;
use crate::material::equation_of_state::EquationOfState;
use crate::material::rheology::Rheology;
use crate::run::observed_run::{self, Stepping};
use crate::run::{Divergence, Observer, RunProgress, SceneError, StopReason, Watching};
use crate::vector::Vector;
use crate::weakly_compressible::enclosure::boundary_set::OutflowBySide;
use crate::weakly_compressible::enclosure::facet::Facet;
use crate::weakly_compressible::enclosure::facet_side::FacetSide;
use crate::weakly_compressible::enclosure::facet_tree::FacetTree;
use crate::weakly_compressible::enclosure::facet_wall::{BackingParticle, FacetWall};
use crate::weakly_compressible::enclosure::inlet::{Inflow, Inlet};
use crate::weakly_compressible::enclosure::pose::Pose;
use crate::weakly_compressible::enclosure::{backing, mesh_backing};
use crate::weakly_compressible::energy::EnergyAccount;
use crate::weakly_compressible::neighbours::MOST_PARTICLES;
use crate::weakly_compressible::time_step::TimeStepBounds;
use crate::weakly_compressible::walls::wall;
use crate::weakly_compressible::{GradientUse, Particles, Scene, Snapshot, State, VerletList};
use std::ops::ControlFlow;

/// A running simulation in D = 2 or 3 dimensions.
#[derive(Debug)]
pub struct Simulation<const D: usize> {
    pub(crate) state: State<D>,
}

/// The dimensions whose loops are compiled with the solver, once, and not again in every crate that takes a step.
///
/// The loops are generic in the number of axes, and Rust compiles a generic function where it is used. These methods
/// are not generic: they keep the hot code in this crate, under its own level of optimisation.
pub trait Compiled<const D: usize>: Sized {
    /// Searches the first neighbours and computes what the first step starts from.
    ///
    /// # Errors
    /// A quantity out of its range, as where particles lie on top of each other.
    fn compiled_start(&mut self) -> Result<(), Divergence<D>>;

    /// Dummy particles behind the facets of a checked scene, wall by wall, in a given number of rows.
    fn compiled_backing(scene: &Scene<D>, rows: usize) -> Vec<Vec<BackingParticle<D>>>;

    /// The state of a checked scene with these dummy particles.
    fn compiled_state(scene: Scene<D>, backing: &[Vec<BackingParticle<D>>]) -> Self;

    /// Takes one step.
    ///
    /// # Errors
    /// The divergence, if the state left its range.
    fn compiled_step(&mut self) -> Result<(), Divergence<D>>;

    /// The bounds of the next step.
    fn compiled_time_step_bounds(&self) -> TimeStepBounds;

    /// A copy of the state in the order of the scene.
    fn compiled_snapshot(&self) -> Snapshot<D>;

    /// Energies and where they came from.
    fn compiled_energy(&self) -> Option<EnergyAccount>;

    /// Side of facets on which a place is, by their tree.
    fn compiled_side(tree: &FacetTree, facets: &[Facet<D>], place: &Vector<D>) -> Option<FacetSide>;
}

macro_rules! compiled {
    ($($dimensions:literal by $backing:ident),+) => {$(
        impl Compiled<$dimensions> for Simulation<$dimensions> {
            fn compiled_start(&mut self) -> Result<(), Divergence<$dimensions>> {
                self.state.search_neighbours()?;
                self.state.prime()
            }

            fn compiled_backing(scene: &Scene<$dimensions>, rows: usize) -> Vec<Vec<BackingParticle<$dimensions>>> {
                $backing::lay(&scene.enclosure.walls, &scene.domain, scene.spacing, rows)
            }

            fn compiled_state(
                scene: Scene<$dimensions>,
                backing: &[Vec<BackingParticle<$dimensions>>],
            ) -> Self {
                Self { state: State::new(scene, backing) }
            }

            fn compiled_step(&mut self) -> Result<(), Divergence<$dimensions>> {
                self.take_step()
            }

            fn compiled_time_step_bounds(&self) -> TimeStepBounds {
                self.state.bounds_with(self.state.diffusivity)
            }

            fn compiled_snapshot(&self) -> Snapshot<$dimensions> {
                self.copy()
            }

            fn compiled_energy(&self) -> Option<EnergyAccount> {
                self.account()
            }

            fn compiled_side(
                tree: &FacetTree,
                facets: &[Facet<$dimensions>],
                place: &Vector<$dimensions>,
            ) -> Option<FacetSide> {
                tree.side(facets, place)
            }
        }
    )+};
}

compiled!(2 by backing, 3 by mesh_backing);

impl<const D: usize> Simulation<D>
where
    Self: Compiled<D>,
{
    /// Sets up a simulation, with dummy particles behind the facets of its scene.
    ///
    /// # Errors
    /// A scene that breaks a rule, or whose particles lie on top of each other.
    pub fn new(scene: Scene<D>) -> Result<Self, SceneError> {
        let backing = Self::backing(&scene)?;
        let mut simulation = Self::compiled_state(scene, &backing);
        simulation.compiled_start().map_err(|divergence| SceneError::Value {
            quantity: divergence.quantity,
            particle: divergence.particle as usize,
            value: divergence.value,
            rule: "in the range that the model allows",
        })?;
        Ok(simulation)
    }

    /// Dummy particles behind the facets of a scene and in the rows of its inlets, wall by wall.
    ///
    /// # Errors
    /// A scene that breaks a rule, or has more particles than the neighbour list can address.
    pub(crate) fn backing(scene: &Scene<D>) -> Result<Vec<Vec<BackingParticle<D>>>, SceneError> {
        scene.check()?;
        let rows = wall::rows(scene.numerics.smoothing_ratio);
        let mut backing = Self::compiled_backing(scene, rows);
        backing.extend(scene.enclosure.inlets.iter().map(|inlet| inlet.backing(rows)));
        let flow = scene.flow.position.len();
        let dummies = scene.wall_particles.len() + backing.iter().map(Vec::len).sum::<usize>();
        if flow + dummies > MOST_PARTICLES {
            return Err(SceneError::TooLarge(flow));
        }
        Ok(backing)
    }

    /// Takes one step as long as the bounds allow.
    ///
    /// # Errors
    /// The divergence, if the state left its range.
    pub fn step(&mut self) -> Result<(), Divergence<D>> {
        self.compiled_step()
    }

    /// The bounds of the next step.
    #[must_use]
    pub fn time_step_bounds(&self) -> TimeStepBounds {
        self.compiled_time_step_bounds()
    }

    /// A copy of the state in the order of the scene.
    #[must_use]
    pub fn snapshot(&self) -> Snapshot<D> {
        self.compiled_snapshot()
    }

    /// Energies and where they came from; with the single divergence only, whose terms book their work.
    #[must_use]
    pub fn energy(&self) -> Option<EnergyAccount> {
        self.compiled_energy()
    }

    /// Runs until `end` `[s]`, calling `observe` at the start, then at the first step after every multiple of
    /// `interval` `[s]`, and at the end. The observer ends the run with [`ControlFlow::Break`].
    pub fn run(&mut self, end: f64, interval: f64, observe: impl FnMut(&Self) -> ControlFlow<()>) -> StopReason<D> {
        self.follow(&mut RunProgress::new(end, interval), &mut Watching(observe))
    }

    /// Runs along a course, from its start or from where the simulation that is continued was saved.
    pub fn follow(&mut self, course: &mut RunProgress, observer: &mut impl Observer<Self>) -> StopReason<D> {
        observed_run::run(self, course, observer)
    }
}

impl<const D: usize> Stepping<D> for Simulation<D>
where
    Self: Compiled<D>,
{
    fn now(&self) -> f64 {
        self.state.time
    }

    fn steps_taken(&self) -> u64 {
        self.state.steps
    }

    fn next_step(&self) -> f64 {
        self.time_step_bounds().step()
    }

    fn take_one(&mut self) -> Result<(), Divergence<D>> {
        self.step()
    }
}

impl<const D: usize> Simulation<D> {
    /// Uses another instruction set: the speed changes, the result does not.
    pub fn use_instruction_set(&mut self, instruction_set: InstructionSet) {
        self.state.model.instruction_set = instruction_set;
    }

    fn take_step(&mut self) -> Result<(), Divergence<D>> {
        if self.state.feed()? || self.state.displacement > 0.5 * self.state.model.skin() {
            self.state.search_neighbours()?;
        }
        self.state.advance(self.state.bounds_with(self.state.diffusivity).step())
    }

    /// Expected number of steps for `duration` `[s]` with the largest viscosity that the law can show at the
    /// present pressures; to be said before an explicit viscous run starts.
    #[must_use]
    pub fn estimated_steps(&self, duration: f64) -> f64 {
        let State { particles, model, .. } = &self.state;
        let flow = particles.flow_count();
        let pressure = particles.pressure[..flow].iter().fold(0.0_f64, |most, &p| most.max(p));
        let viscosity = model.rheology.largest_viscosity(pressure) / model.equation_of_state.reference_density;
        duration / self.state.bounds_with(viscosity.max(self.state.diffusivity)).step()
    }

    /// Time `[s]`.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// Steps taken.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.state.steps
    }

    /// Neighbour searches done, the first included.
    #[must_use]
    pub fn neighbour_searches(&self) -> u64 {
        self.state.search.count
    }

    /// Iterations of all implicit viscous steps: what they have cost.
    #[must_use]
    pub fn viscous_iterations(&self) -> u64 {
        self.state.viscous.iterations
    }

    /// The particles.
    #[must_use]
    pub fn particles(&self) -> &Particles<D> {
        &self.state.particles
    }

    /// The neighbour list.
    #[must_use]
    pub fn neighbours(&self) -> &VerletList {
        &self.state.model.list
    }

    /// Impulse that each facet wall of the scene, and then the rows of each inlet, has given to the flow since the start `[kg m/s]`,
    /// contacts included.
    #[must_use]
    pub fn facet_wall_impulses(&self) -> &[Vector<D>] {
        &self.state.enclosure.books.impulses
    }

    /// Moments of these impulses about the axes that walls turn about `[kg m²/s]`; zero of other walls.
    #[must_use]
    pub fn facet_wall_moments(&self) -> &[f64] {
        &self.state.enclosure.books.moments
    }

    /// Pose of each facet wall, and then of the rows of each inlet.
    #[must_use]
    pub fn facet_wall_poses(&self) -> &[Pose<D>] {
        &self.state.enclosure.poses
    }

    /// Velocity that speeds are relative to `[m/s]`.
    #[must_use]
    pub fn frame(&self) -> Vector<D> {
        self.state.enclosure.frame
    }

    /// The facet walls of the scene, then the rows of each inlet, where they were at the start.
    #[must_use]
    pub fn facet_walls(&self) -> &[FacetWall<D>] {
        &self.state.enclosure.walls
    }

    /// Outflow through open sides.
    #[must_use]
    pub fn outflow(&self) -> &OutflowBySide<D> {
        &self.state.enclosure.books.outflow
    }

    /// Impulse that implicit viscous steps have left out of the flow's since the start `[kg m/s]`: what their tolerance leaves unsolved.
    /// Zero without facet walls or open sides, where it is not kept.
    #[must_use]
    pub fn unsolved_impulse(&self) -> Vector<D> {
        self.state.enclosure.books.unsolved
    }

    /// Impulse that side walls have given to the flow since the start `[kg m/s]`, per metre of depth.
    #[must_use]
    pub fn side_wall_impulse(&self) -> Vector<D> {
        self.state.side_wall_impulse
    }

    /// The inlets.
    #[must_use]
    pub fn inlets(&self) -> &[Inlet<D>] {
        &self.state.enclosure.inlets
    }

    /// Inflow through inlets.
    #[must_use]
    pub fn inflow(&self) -> &Inflow<D> {
        &self.state.enclosure.books.inflow
    }

    /// Entry of a particle that an inlet has fed: the start of its way, a row behind the opening where it moved with
    /// its row `[m]`, and the time at which it became free `[s]`; none for a particle of the initial state.
    #[must_use]
    pub fn entry(&self, identity: u32) -> Option<(Vector<D>, f64)> {
        self.state.enclosure.entry(identity)
    }

    /// Particle spacing Δ `[m]`.
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.state.model.spacing
    }

    /// Equation of state.
    #[must_use]
    pub fn equation_of_state(&self) -> &EquationOfState {
        &self.state.model.equation_of_state
    }

    /// Viscosity that damps elastic shear `[Pa·s]`.
    #[must_use]
    pub fn elastic_viscosity(&self) -> f64 {
        self.state.model.elastic_viscosity()
    }

    /// Bulk modulus `[Pa]`.
    #[must_use]
    pub fn bulk_modulus(&self) -> f64 {
        self.state.model.equation_of_state.bulk_modulus
    }

    /// Constitutive law.
    #[must_use]
    pub fn rheology(&self) -> &Rheology {
        &self.state.model.rheology
    }

    fn copy(&self) -> Snapshot<D> {
        let State { particles, model, .. } = &self.state;
        Snapshot::new(self.state.time, particles, model, self.account())
    }

    fn account(&self) -> Option<EnergyAccount> {
        let State { particles, model, energy, .. } = &self.state;
        (model.gradient_use() == GradientUse::Stress).then(|| EnergyAccount::of(particles, model, *energy))
    }
}
