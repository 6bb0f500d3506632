//! A simulation: state, step control, neighbour search, and the loop with its stop reasons.

use crate::domain::Domain;
use crate::kernel::Kernel;
use crate::lanes::InstructionSet;
use crate::material::equation_of_state::EquationOfState;
use crate::material::rheology::Rheology;
use crate::run::observed_run::{self, Stepping};
use crate::run::{Divergence, SceneError, StopReason};
use crate::vector::Vector;
use crate::weakly_compressible::boundary::Images;
use crate::weakly_compressible::divergence::Quantity;
use crate::weakly_compressible::model::Model;
use crate::weakly_compressible::neighbours::{CellGrid, LARGEST_ROW, VerletList};
use crate::weakly_compressible::numerics::ViscositySwitch;
use crate::weakly_compressible::particles::{Particles, SortScratch};
use crate::weakly_compressible::scene::Scene;
use crate::weakly_compressible::snapshot::Snapshot;
use crate::weakly_compressible::terms::artificial_viscosity::SWITCH_LOWEST;
use crate::weakly_compressible::time_step::TimeStepBounds;
use crate::weakly_compressible::viscous_solve::ViscousSystem;
use std::ops::ControlFlow;

/// A running simulation in D = 2 or 3 dimensions.
#[derive(Debug)]
pub struct Simulation<const D: usize> {
    pub(crate) particles: Particles<D>,
    pub(crate) images: Images<D>,
    pub(crate) model: Model<D>,
    pub(crate) time: f64,
    pub(crate) steps: u64,
    pub(crate) largest_speed: f64,
    pub(crate) kinematic_viscosity: f64,
    /// Upper bound of any particle's displacement since the neighbour search `[m]`.
    pub(crate) displacement: f64,
    /// Displacement of each wall in a step `[m]`.
    pub(crate) wall_displacements: Vec<Vector<D>>,
    domain: Domain<D>,
    flow_grid: CellGrid<D>,
    wall_grid: CellGrid<D>,
    scratch: SortScratch<D>,
    searches: u64,
    pub(crate) viscous: ViscousSystem<D>,
}

/// The dimensions whose loops are compiled with the solver, once, and not again in every crate that takes a step.
///
/// The loops are generic in the number of axes, and Rust compiles a generic function where it is used. These two methods
/// are not generic: they keep the hot code in this crate, under its own level of optimisation.
pub trait Compiled<const D: usize>: Sized {
    /// Sets up a simulation.
    ///
    /// # Errors
    /// A scene that breaks a rule, or whose particles lie on top of each other.
    fn compiled_new(scene: Scene<D>) -> Result<Self, SceneError>;

    /// Takes one step.
    ///
    /// # Errors
    /// The divergence, if the state left its range.
    fn compiled_step(&mut self) -> Result<(), Divergence<D>>;
}

macro_rules! compiled {
    ($($dimensions:literal),+) => {$(
        impl Compiled<$dimensions> for Simulation<$dimensions> {
            fn compiled_new(scene: Scene<$dimensions>) -> Result<Self, SceneError> {
                Self::set_up(scene)
            }

            fn compiled_step(&mut self) -> Result<(), Divergence<$dimensions>> {
                self.take_step()
            }
        }
    )+};
}

compiled!(2, 3);

impl<const D: usize> Simulation<D>
where
    Self: Compiled<D>,
{
    /// Sets up a simulation.
    ///
    /// # Errors
    /// A scene that breaks a rule, or whose particles lie on top of each other.
    pub fn new(scene: Scene<D>) -> Result<Self, SceneError> {
        Self::compiled_new(scene)
    }

    /// Takes one step as long as the bounds allow.
    ///
    /// # Errors
    /// The divergence, if the state left its range.
    pub fn step(&mut self) -> Result<(), Divergence<D>> {
        self.compiled_step()
    }

    /// Runs until `end` `[s]`, calling `observe` at the start, then at the first step after every multiple of
    /// `interval` `[s]`, and at the end. The observer ends the run with [`ControlFlow::Break`].
    pub fn run(&mut self, end: f64, interval: f64, observe: impl FnMut(&Self) -> ControlFlow<()>) -> StopReason<D> {
        observed_run::run(self, end, interval, observe)
    }
}

impl<const D: usize> Stepping<D> for Simulation<D>
where
    Self: Compiled<D>,
{
    fn now(&self) -> f64 {
        self.time
    }

    fn steps_taken(&self) -> u64 {
        self.steps
    }

    fn next_step(&self) -> f64 {
        self.time_step_bounds().step()
    }

    fn take_one(&mut self) -> Result<(), Divergence<D>> {
        self.step()
    }
}

impl<const D: usize> Simulation<D> {
    fn set_up(scene: Scene<D>) -> Result<Self, SceneError> {
        scene.check()?;
        let numerics = scene.numerics;
        let reference_density = scene.equation_of_state.reference_density;
        let mut particles =
            Particles::new(&scene.flow, &scene.walls, &scene.wall_particles, scene.spacing, reference_density);
        let initial = match numerics.viscosity_switch {
            ViscositySwitch::Constant => numerics.artificial_viscosity,
            ViscositySwitch::MorrisMonaghan => SWITCH_LOWEST,
        };
        particles.artificial_viscosity.fill(initial);
        particles.viscosity.fill(scene.rheology.viscosity(0.0, 0.0));
        let wall_displacements = vec![Vector::zeros(); scene.walls.len()];
        let mut simulation = Self {
            particles,
            images: Images::new(),
            model: Model {
                wall_planes: scene.walls,
                list: VerletList::default(),
                kernel: Kernel::new(numerics.kernel, numerics.smoothing_ratio * scene.spacing),
                equation_of_state: scene.equation_of_state,
                rheology: scene.rheology,
                numerics,
                gravity: scene.gravity,
                spacing: scene.spacing,
                contact_friction: scene.rheology.contact_friction(),
                instruction_set: InstructionSet::best(),
            },
            time: 0.0,
            steps: 0,
            largest_speed: 0.0,
            kinematic_viscosity: 0.0,
            displacement: f64::INFINITY,
            wall_displacements,
            domain: scene.domain,
            flow_grid: CellGrid::new(),
            wall_grid: CellGrid::new(),
            scratch: SortScratch::new(),
            searches: 0,
            viscous: ViscousSystem::new(),
        };
        let crowded = |divergence: Divergence<D>| SceneError::Value {
            quantity: divergence.quantity,
            particle: divergence.particle as usize,
            value: divergence.value,
            rule: "in the range that the model allows",
        };
        simulation.search_neighbours().map_err(crowded)?;
        simulation.prime().map_err(crowded)?;
        Ok(simulation)
    }

    /// Uses another instruction set: the speed changes, the result does not.
    pub fn use_instruction_set(&mut self, instruction_set: InstructionSet) {
        self.model.instruction_set = instruction_set;
    }

    fn take_step(&mut self) -> Result<(), Divergence<D>> {
        if self.displacement > 0.5 * self.skin() {
            self.search_neighbours()?;
        }
        self.advance(self.time_step_bounds().step())
    }

    /// The bounds of the next step.
    #[must_use]
    pub fn time_step_bounds(&self) -> TimeStepBounds {
        TimeStepBounds::new(
            &self.model.numerics,
            self.model.kernel.smoothing_length(),
            self.model.equation_of_state.sound_speed(),
            self.largest_speed,
            self.kinematic_viscosity,
        )
    }

    /// Expected number of steps for `duration` `[s]` with the largest viscosity that the law can show at the
    /// present pressures; to be said before an explicit viscous run starts.
    #[must_use]
    pub fn estimated_steps(&self, duration: f64) -> f64 {
        let flow = self.particles.flow_count();
        let pressure = self.particles.pressure[..flow].iter().fold(0.0_f64, |most, &p| most.max(p));
        let viscosity =
            self.model.rheology.largest_viscosity(pressure) / self.model.equation_of_state.reference_density;
        let bounds = TimeStepBounds::new(
            &self.model.numerics,
            self.model.kernel.smoothing_length(),
            self.model.equation_of_state.sound_speed(),
            self.largest_speed,
            viscosity.max(self.kinematic_viscosity),
        );
        duration / bounds.step()
    }

    /// Time `[s]`.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Steps taken.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.steps
    }

    /// Neighbour searches done, the first included.
    #[must_use]
    pub fn neighbour_searches(&self) -> u64 {
        self.searches
    }

    /// Iterations of all implicit viscous steps: what they have cost.
    #[must_use]
    pub fn viscous_iterations(&self) -> u64 {
        self.viscous.iterations()
    }

    /// The particles.
    #[must_use]
    pub fn particles(&self) -> &Particles<D> {
        &self.particles
    }

    /// The neighbour list.
    #[must_use]
    pub fn neighbours(&self) -> &VerletList {
        &self.model.list
    }

    /// Particle spacing Δ `[m]`.
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.model.spacing
    }

    /// Equation of state.
    #[must_use]
    pub fn equation_of_state(&self) -> &EquationOfState {
        &self.model.equation_of_state
    }

    /// Constitutive law.
    #[must_use]
    pub fn rheology(&self) -> &Rheology {
        &self.model.rheology
    }

    /// A copy of the state in the order of the scene.
    #[must_use]
    pub fn snapshot(&self) -> Snapshot<D> {
        Snapshot::new(self)
    }

    fn skin(&self) -> f64 {
        self.model.numerics.verlet_skin * self.model.kernel.support()
    }

    pub(crate) fn divergence(&self, index: usize, quantity: Quantity, value: f64) -> Divergence<D> {
        Divergence {
            time: self.time,
            step: self.steps,
            particle: self.particles.identity.get(index).copied().unwrap_or(index as u32),
            position: self.particles.position[index],
            quantity: quantity.name(),
            value,
            unit: quantity.unit(),
            rule: quantity.rule(),
        }
    }

    /// Sorts the flow by cell, makes the images anew and fills the neighbour list.
    fn search_neighbours(&mut self) -> Result<(), Divergence<D>> {
        let radius = self.model.kernel.support() + self.skin();
        let particles = &mut self.particles;
        let (flow, real) = (particles.flow_count(), particles.real_count());
        particles.keep_real();
        for index in 0..flow {
            self.domain.wrap(&mut particles.position[index]);
            let before = particles.velocity[index];
            self.domain.reflect(
                &mut particles.position[index],
                &mut particles.velocity[index],
                &mut particles.velocity_gradient[index],
                &mut particles.stress[index],
            );
            let pushed_back = (particles.velocity[index] - before) * particles.mass[index];
            particles.support_impulse[index] += pushed_back;
        }
        self.flow_grid.cover(particles.position[..flow].iter(), radius);
        self.flow_grid.sort(particles.position[..flow].iter().enumerate().map(|(index, x)| (index as u32, x)));
        particles.sort_flow(&self.flow_grid.index[..flow], &mut self.scratch);
        self.images.rebuild(&self.domain, &particles.position, radius);
        particles.append_images(&self.images);
        let total = real + self.images.len();
        let entry = |index: usize| (index as u32, &particles.position[index]);
        let from_flow = |&k: &usize| self.images.source(k) < flow;
        let flow_images = (0..self.images.len()).filter(from_flow).map(|k| real + k);
        let wall_images = (0..self.images.len()).filter(|k| !from_flow(k)).map(|k| real + k);
        for grid in [&mut self.flow_grid, &mut self.wall_grid] {
            grid.cover(particles.position[..total].iter(), radius);
        }
        self.flow_grid.sort((0..flow).chain(flow_images).map(entry));
        self.wall_grid.sort((flow..real).chain(wall_images).map(entry));
        let grids = (&self.flow_grid, &self.wall_grid);
        let filled =
            self.model.list.rebuild(&particles.position, flow, real, radius, grids, self.model.instruction_set);
        self.displacement = 0.0;
        self.searches += 1;
        filled.map_err(|crowded| {
            self.divergence(crowded, Quantity::Neighbours { limit: LARGEST_ROW }, LARGEST_ROW as f64)
        })
    }
}
