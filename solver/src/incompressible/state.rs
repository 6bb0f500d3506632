//! All that a run carries from step to step.

use super::columns::{Columns, Grains};
use super::passes::drag_exchange::DragExchange;
use super::passes::search::Search;
use super::passes::viscosities::Viscosities;
use super::projection::Projection;
use super::velocity_solve::VelocitySystem;
use super::{Failure, IncompressibleScene, Phase, Phases};
use crate::run::{Divergence, SceneError};
use crate::vector::Vector;

/// Both phases, the storage of the passes, and the time.
#[derive(Debug)]
pub struct State<const D: usize> {
    /// The scene.
    pub scene: IncompressibleScene<D>,
    /// Both phases.
    pub phases: Phases<D>,
    /// Pairs between the phases.
    pub exchange: DragExchange<D>,
    /// Schedule of the searches.
    pub search: Search<D>,
    /// Viscosities of the laws.
    pub viscosities: Viscosities<D>,
    /// Grains that dilate, if there are any; they are no phase of pairs.
    pub columns: Option<Columns<D>>,
    /// Implicit velocities.
    pub system: VelocitySystem<D>,
    /// Pressure projection with its work arrays.
    pub projection: Projection<D>,
    pub(super) shifts: Vec<Vector<D>>,
    /// Time `[s]`.
    pub(super) time: f64,
    pub(super) steps: u64,
    /// Δt of the last step, or the largest before the first `[s]`.
    pub last_step: f64,
}

/// Fields common to every kind of sediment; arrays have the shape `[free particles]`.
#[derive(Debug, Clone, Copy)]
pub(super) struct SedimentParticles<'s, const D: usize> {
    pub(super) position: &'s [Vector<D>],
    pub(super) velocity: &'s [Vector<D>],
    pub(super) mass: &'s [f64],
    /// Pressure `[Pa]` and concentration `[-]`, which grains of columns have none of.
    pub(super) of_phase: Option<(&'s [f64], &'s [f64])>,
}

impl<const D: usize> State<D> {
    /// The sediment, be it a phase of pairs or grains of columns; empty where there is none.
    pub(super) fn sediment(&self) -> SedimentParticles<'_, D> {
        match (&self.columns, &self.phases.sediment) {
            (Some(Columns { grains: Grains { position, velocity, mass, .. }, .. }), _) => {
                SedimentParticles { position, velocity, mass, of_phase: None }
            }
            (None, Some(Phase { position, velocity, mass, pressure, concentration, .. })) => {
                SedimentParticles { position, velocity, mass, of_phase: Some((pressure, concentration)) }
            }
            (None, None) => SedimentParticles { position: &[], velocity: &[], mass: &[], of_phase: None },
        }
    }

    /// Puts all particles back into their periods.
    pub(super) fn wrap(&mut self) {
        self.phases.wrap(&self.scene.domain);
        if let Some(columns) = &mut self.columns {
            columns.grains.wrap(&self.scene.domain);
        }
    }

    /// The state at the start of a scene, with its candidates searched.
    ///
    /// # Errors
    /// A scene that breaks a rule.
    pub(super) fn of(mut scene: IncompressibleScene<D>) -> Result<Self, SceneError> {
        scene.check()?;
        let columns = Columns::of(&mut scene);
        let (water, numerics) = (&scene.fluid, &scene.numerics);
        let fluid = Phase::new(&water.particles, &water.wall, water.spacing, water.density, numerics.smoothing_ratio);
        let sediment = scene.sediment.as_ref().filter(|_| columns.is_none()).map(|material| {
            let (spacing, density) = (material.spacing, material.density);
            Phase::new(&material.particles, &material.wall, spacing, density, material.smoothing_ratio)
                .filled(&material.filling)
        });
        let phases = Phases { fluid, sediment };
        let drag_length = scene.sediment.as_ref().map_or(water.spacing, |material| material.drag_smoothing_length);
        let mut state = Self {
            exchange: DragExchange::new(drag_length),
            search: Search::new(&scene.domain, numerics.search_skin),
            viscosities: Viscosities::new(&phases),
            columns,
            system: VelocitySystem::default(),
            projection: Projection::default(),
            shifts: Vec::new(),
            time: 0.0,
            steps: 0,
            last_step: numerics.time_step,
            phases,
            scene,
        };
        state.search.search(&state.scene.domain, &mut state.phases, &mut state.exchange);
        Ok(state)
    }

    /// Largest speed of any particle `[m/s]`.
    pub(super) fn largest_speed(&self) -> f64 {
        let of_columns = self.columns.as_ref().map_or(0.0, |columns| columns.grains.largest_speed());
        self.phases.largest_speed().max(of_columns)
    }

    /// A failure with its place and time.
    pub(super) fn divergence(&self, failure: Failure) -> Divergence<D> {
        let Failure { row, quantity, value, limit } = failure;
        let (quantity, unit, rule) = quantity.texts(limit);
        let (fluid, sediment) = (&self.phases.fluid.position, self.sediment());
        let grain = row.checked_sub(fluid.len()).and_then(|grain| sediment.position.get(grain));
        let position = grain.copied().unwrap_or_else(|| fluid[row.min(fluid.len() - 1)]);
        Divergence { time: self.time, step: self.steps, particle: row as u32, position, quantity, value, unit, rule }
    }
}
