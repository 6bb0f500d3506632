//! An incompressible simulation: state, candidate search, and the loop with its stop reasons.

use super::averaged_gradient::AveragedGradient;
use super::drag_exchange::DragExchange;
use super::granular_pressure::GranularPressure;
use super::layers::Layers;
use super::mixture::Mixture;
use super::pairs::Periods;
use super::phase::Phase;
use super::pressure_poisson::PressurePoisson;
use super::scene::IncompressibleScene;
use super::snapshot::{IncompressibleSnapshot, PhaseSnapshot};
use super::velocity_solve::VelocitySystem;
use crate::run::SceneError;
use crate::run::StopReason;
use crate::run::divergence::{Divergence, Quantity};
use crate::run::observed_run::{self, Stepping};
use crate::vector::Vector;
use std::ops::ControlFlow;

/// A running simulation of a fluid, alone or with sediment.
#[derive(Debug)]
pub struct IncompressibleSimulation<const D: usize> {
    pub(super) scene: IncompressibleScene<D>,
    pub(super) fluid: Phase<D>,
    pub(super) sediment: Option<Phase<D>>,
    pub(super) exchange: DragExchange<D>,
    pub(super) system: VelocitySystem<D>,
    pub(super) fluid_poisson: PressurePoisson<D>,
    pub(super) sediment_poisson: PressurePoisson<D>,
    pub(super) mixture: Mixture<D>,
    /// Dynamic viscosity of every fluid particle `[Pa·s]`.
    pub(super) fluid_viscosity: Vec<f64>,
    /// Share of the space that the fluid has at every fluid particle `[-]`.
    pub(super) fluid_share: Vec<f64>,
    /// Apparent viscosity of every sediment particle `[Pa·s]`.
    pub(super) sediment_viscosity: Vec<f64>,
    /// Yield stress or overburden of every sediment particle `[Pa]`.
    pub(super) load: Vec<f64>,
    pub(super) granular: GranularPressure,
    pub(super) sediment_rates: AveragedGradient<D>,
    pub(super) shifts: Vec<Vector<D>>,
    pub(super) periods: Periods<D>,
    pub(super) time: f64,
    pub(super) steps: u64,
    pub(super) last_step: f64,
    searches: u64,
    layers: Layers<D>,
}

/// What the linear solves and the searches of a run have cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SolverCost {
    /// Iterations of the implicit velocities.
    pub velocity_iterations: u64,
    /// Iterations of the fluid's or the mixture's pressure Poisson equation.
    pub fluid_pressure_iterations: u64,
    /// Iterations of the sediment's pressure Poisson equation.
    pub sediment_pressure_iterations: u64,
    /// Searches of candidate pairs.
    pub searches: u64,
}

/// Skin of the candidate search over the fluid kernel's reach `[-]`.
const SKIN: f64 = 0.3;

/// The plane: not generic, so that the loops are compiled here and not in every crate that takes a step.
impl IncompressibleSimulation<2> {
    /// Sets up a simulation.
    ///
    /// # Errors
    /// A scene that breaks a rule.
    pub fn new(scene: IncompressibleScene<2>) -> Result<Self, SceneError> {
        Self::set_up(scene)
    }

    /// Takes one step of at most the time step of the numerics.
    ///
    /// # Errors
    /// The divergence: a particle that would move by more than its spacing, a solve that does not converge, a Reynolds
    /// number that the drag law does not cover.
    pub fn step(&mut self) -> Result<(), Divergence<2>> {
        self.take_step()
    }

    /// Runs until `end` `[s]`, calling `observe` at the start, then at the first step after every multiple of
    /// `interval` `[s]`, and at the end. The observer ends the run with [`ControlFlow::Break`].
    pub fn run(&mut self, end: f64, interval: f64, observe: impl FnMut(&Self) -> ControlFlow<()>) -> StopReason<2> {
        observed_run::run(self, end, interval, observe)
    }
}

impl Stepping<2> for IncompressibleSimulation<2> {
    fn now(&self) -> f64 {
        self.time
    }

    fn steps_taken(&self) -> u64 {
        self.steps
    }

    fn next_step(&self) -> f64 {
        self.last_step
    }

    fn take_one(&mut self) -> Result<(), Divergence<2>> {
        self.step()
    }
}

impl<const D: usize> IncompressibleSimulation<D> {
    fn set_up(scene: IncompressibleScene<D>) -> Result<Self, SceneError> {
        scene.check()?;
        let ratio = scene.numerics.smoothing_ratio;
        let fluid =
            Phase::new(&scene.fluid.particles, &scene.fluid.wall, scene.fluid.spacing, scene.fluid.density, ratio);
        let sediment = scene.sediment.as_ref().map(|material| {
            Phase::new(
                &material.particles,
                &material.wall,
                material.spacing,
                material.density,
                material.smoothing_ratio,
            )
        });
        let sediment = sediment.map(|phase| match &scene.sediment {
            Some(material) => phase.filled(&material.filling),
            None => phase,
        });
        let (free_fluid, free_sediment) = (fluid.len(), sediment.as_ref().map_or(0, Phase::len));
        let drag_length =
            scene.sediment.as_ref().map_or(scene.fluid.spacing, |material| material.drag_smoothing_length);
        let mut simulation = Self {
            exchange: DragExchange::new(drag_length),
            periods: Periods::of(&scene.domain),
            fluid_viscosity: vec![0.0; free_fluid],
            sediment_viscosity: vec![0.0; free_sediment],
            fluid_share: vec![1.0; free_fluid],
            load: vec![0.0; free_sediment],
            system: VelocitySystem::new(),
            fluid_poisson: PressurePoisson::new(),
            sediment_poisson: PressurePoisson::new(),
            mixture: Mixture::new(),
            granular: GranularPressure::default(),
            sediment_rates: AveragedGradient::default(),
            shifts: Vec::new(),
            time: 0.0,
            steps: 0,
            last_step: scene.numerics.time_step,
            searches: 0,
            layers: Layers::new(),
            scene,
            fluid,
            sediment,
        };
        simulation.search();
        Ok(simulation)
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

    /// What the run has cost.
    #[must_use]
    pub fn cost(&self) -> SolverCost {
        SolverCost {
            velocity_iterations: self.system.iterations(),
            fluid_pressure_iterations: self.fluid_poisson.iterations() + self.mixture.iterations(),
            sediment_pressure_iterations: self.sediment_poisson.iterations(),
            searches: self.searches,
        }
    }

    /// Free particles of both phases.
    #[must_use]
    pub fn free_particles(&self) -> usize {
        self.fluid.len() + self.sediment.as_ref().map_or(0, Phase::len)
    }

    /// The scene.
    #[must_use]
    pub fn scene(&self) -> &IncompressibleScene<D> {
        &self.scene
    }

    /// Positions `[m]` and velocities `[m/s]` of the fluid, shape `[particles]`.
    #[must_use]
    pub fn fluid(&self) -> (&[Vector<D>], &[Vector<D>]) {
        (&self.fluid.position, &self.fluid.velocity)
    }

    /// Pressures of the fluid `[Pa]`.
    #[must_use]
    pub fn fluid_pressure(&self) -> &[f64] {
        &self.fluid.pressure
    }

    /// Positions `[m]` and velocities `[m/s]` of the free sediment, shape `[particles]`; empty without sediment.
    #[must_use]
    pub fn sediment(&self) -> (&[Vector<D>], &[Vector<D>]) {
        self.sediment.as_ref().map_or((&[], &[]), |sediment| (&sediment.position, &sediment.velocity))
    }

    /// Share of the space that the fluid had at every fluid particle in the last step `[-]`.
    #[must_use]
    pub fn fluid_share(&self) -> &[f64] {
        &self.fluid_share
    }

    /// Masses of the free sediment `[kg]`, per metre of width in 2-D.
    #[must_use]
    pub fn sediment_masses(&self) -> &[f64] {
        self.sediment.as_ref().map_or(&[], |sediment| &sediment.mass)
    }

    /// Force of walls and fixed grains on the fluid and the sediment in the last step `[N]`, per metre of width in 2-D:
    /// friction and drag, without what the walls' pressure gives.
    #[must_use]
    pub fn holding_force(&self) -> Vector<D> {
        let system = &self.system;
        let mut impulse = Vector::zeros();
        for ((velocity, sum), inertia) in system.velocity.iter().zip(&system.of_constant).zip(&system.inertia) {
            impulse -= velocity * (sum - inertia);
        }
        impulse / self.last_step
    }

    /// Force of the fluid on every free sediment particle in the last step `[N]`, per metre of width in 2-D.
    #[must_use]
    pub fn drag(&self) -> Vec<Vector<D>> {
        let system = &self.system;
        let free_fluid = self.fluid.len();
        let rows = free_fluid..system.couplings.len();
        let of_row = |row: usize| {
            let from_fluid = system.couplings.row(row).filter(|(partner, _)| (*partner as usize) < free_fluid);
            let force = |sum, (partner, coefficient): (u32, f64)| {
                sum + (system.velocity[partner as usize] - system.velocity[row]) * coefficient
            };
            from_fluid.fold(Vector::zeros(), force) / self.last_step
        };
        rows.map(of_row).collect()
    }

    /// A copy of the state in the order of the scene.
    #[must_use]
    pub fn snapshot(&self) -> IncompressibleSnapshot<D> {
        IncompressibleSnapshot {
            time: self.time,
            fluid: PhaseSnapshot::of(&self.fluid),
            sediment: self.sediment.as_ref().map(PhaseSnapshot::of).unwrap_or_default(),
            drag: self.drag(),
        }
    }

    /// Largest speed of any particle `[m/s]`.
    pub(super) fn largest_speed(&self) -> f64 {
        let largest = |velocities: &[Vector<D>]| velocities.iter().fold(0.0_f64, |most, v| most.max(v.norm_squared()));
        let sediment = self.sediment.as_ref().map_or(0.0, |sediment| largest(&sediment.velocity));
        largest(&self.fluid.velocity).max(sediment).sqrt()
    }

    /// A divergence at a row of the velocity system: the fluid's particles first, then the sediment's.
    pub(super) fn divergence(&self, row: usize, quantity: Quantity, value: f64, limits: (f64, f64)) -> Divergence<D> {
        let free_fluid = self.fluid.len();
        let position = match &self.sediment {
            Some(sediment) if row >= free_fluid => sediment.position[row - free_fluid],
            _ => self.fluid.position[row.min(free_fluid - 1)],
        };
        Divergence { time: self.time, step: self.steps, particle: row as u32, position, quantity, value, limits }
    }

    /// Measures all pairs, after a search if one may be missing.
    pub(super) fn measure(&mut self) {
        self.search_if_due();
        self.fluid.measure(&self.periods);
        if let Some(sediment) = &mut self.sediment {
            sediment.measure(&self.periods);
            self.exchange.measure(&self.fluid, sediment, &self.periods);
        }
    }

    /// Searches the candidates anew if a pair may be missing.
    pub(super) fn search_if_due(&mut self) {
        let skin = self.skin();
        if self.layers.moved_apart(std::iter::once(&self.fluid).chain(&self.sediment), skin) {
            self.search();
        }
    }

    fn skin(&self) -> f64 {
        SKIN * self.fluid.kernel.support()
    }

    fn search(&mut self) {
        let skin = self.skin();
        for phase in std::iter::once(&mut self.fluid).chain(&mut self.sediment) {
            // cells are those of the period
            for position in &mut phase.position {
                self.scene.domain.wrap(position);
            }
        }
        self.fluid.search(&self.scene.domain, &self.periods, skin);
        let mut reach = self.fluid.kernel.support();
        if let Some(sediment) = &mut self.sediment {
            sediment.search(&self.scene.domain, &self.periods, skin);
            self.exchange.search(&self.fluid, sediment, &self.scene.domain, &self.periods, skin);
            reach = reach.max(sediment.kernel.support()).max(self.exchange.reach());
        }
        let phases = std::iter::once(&self.fluid).chain(&self.sediment);
        self.layers.sort(phases, &self.scene.domain, reach + 2.0 * skin);
        self.searches += 1;
    }
}
