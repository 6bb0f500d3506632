//! Reading the gauges of a scene, sample by sample.

use super::Measurand;
use super::periods::Periods;
use crate::setup::front::FrontLine;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::simulation::Simulation;
use bagnold_solver::weakly_compressible::snapshot::Snapshot;
use serde::{Deserialize, Serialize};

/// State of the gauges from sample to sample; in the plane, masses and impulses are those per metre of depth.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Memory<const D: usize> {
    /// Time of the last sample `[s]`.
    time: f64,
    /// Places `[m]` and velocities `[m/s]` of the particles then, by their identity; NaN of those that have left.
    places: Vec<(Vector<D>, Vector<D>)>,
    /// Impulses of the walls then `[kg m/s]`.
    impulses: Vec<Vector<D>>,
    /// Their moments then `[kg m²/s]`.
    moments: Vec<f64>,
    /// Mass that has crossed each gauge's opening `[kg]`.
    crossed: Vec<f64>,
    /// Side of a front gauge's line on which material counts, where a bed lies on the other; gauge by gauge.
    above_beds: Vec<Option<Vector<D>>>,
}

impl<const D: usize> Memory<D> {
    /// The values of all gauges now, column by column, with the snapshot of the simulation; remembers the state for the next
    /// sample. `known` particles have been there so far, between sides that repeat themselves by `periods`.
    pub(crate) fn read_all(
        &mut self,
        measures: &[Measurand<'_, D>],
        simulation: &Simulation<D>,
        snapshot: &Snapshot<D>,
        (known, periods): (usize, &Periods<D>),
    ) -> Vec<f64> {
        self.crossed.resize(measures.len(), 0.0);
        let read = |(k, measure)| self.read((k, measure), simulation, snapshot, periods);
        let values = measures.iter().enumerate().flat_map(read).collect();
        let (crossed, above_beds) = (std::mem::take(&mut self.crossed), std::mem::take(&mut self.above_beds));
        *self = Self { crossed, above_beds, ..Self::of(simulation, known) };
        values
    }

    /// Finds the fronts along a bed: those under most of whose lines, against gravity that pulls `down`, material lies now. They follow what
    /// lies above their lines. Returns whether each gauge is one.
    pub(crate) fn find_beds(
        &mut self,
        measures: &[Measurand<'_, D>],
        down: &Vector<D>,
        simulation: &Simulation<D>,
        snapshot: &Snapshot<D>,
    ) -> impl Iterator<Item = bool> {
        let above = |measure: &Measurand<'_, D>| {
            let Measurand::Front(line) = measure else { return None };
            let below = line.on_side(down)?;
            below.is_covered(simulation.spacing(), snapshot).then(|| below.side.map(|side| -side))?
        };
        self.above_beds = measures.iter().map(above).collect();
        self.above_beds.iter().map(Option::is_some)
    }

    /// The present state, of which `known` particles have been there so far.
    pub(crate) fn of(simulation: &Simulation<D>, known: usize) -> Self {
        let particles = simulation.particles();
        let mut places = vec![(Vector::repeat(f64::NAN), Vector::zeros()); known];
        for (index, &identity) in particles.identity.iter().enumerate() {
            places[identity as usize] = (particles.position[index], particles.velocity[index]);
        }
        let (impulses, moments) = (simulation.facet_wall_impulses(), simulation.facet_wall_moments());
        let (impulses, moments) = (impulses.to_vec(), moments.to_vec());
        Self { time: simulation.time(), places, impulses, moments, ..Self::default() }
    }

    /// The values of the gauge at this place among all, one a column.
    fn read(
        &mut self,
        (gauge, measure): (usize, &Measurand<'_, D>),
        simulation: &Simulation<D>,
        snapshot: &Snapshot<D>,
        periods: &Periods<D>,
    ) -> Vec<f64> {
        let elapsed = simulation.time() - self.time;
        let per_time = |change: f64| if elapsed > 0.0 { change / elapsed } else { 0.0 };
        let place_of = |wall: &str| simulation.facet_walls().iter().position(|own| own.name == wall);
        match measure {
            Measurand::Front(line) => {
                let side = self.above_beds.get(gauge).copied().flatten();
                FrontLine { side, ..line.clone() }.interval(simulation.spacing(), snapshot).to_vec()
            }
            Measurand::Depth(depth) => vec![depth.thickness(simulation.spacing(), periods, snapshot)],
            Measurand::Probe(probe) => probe.values(simulation, periods, snapshot),
            Measurand::Position(wall) => {
                let place = place_of(wall).map(|k| simulation.facet_wall_poses()[k].shift);
                place.unwrap_or_else(Vector::zeros).iter().copied().collect()
            }
            Measurand::Force(wall) => {
                let Some(k) = place_of(wall) else { return vec![0.0; D] };
                let before = self.impulses.get(k).copied().unwrap_or_else(Vector::zeros);
                // the wall feels the opposite of what it gives
                (before - simulation.facet_wall_impulses()[k]).iter().map(|&change| per_time(change)).collect()
            }
            Measurand::Turn(wall) => {
                let Some(k) = place_of(wall) else { return vec![0.0; 2] };
                let before = self.moments.get(k).copied().unwrap_or(0.0);
                let turn = simulation.facet_walls()[k].motion.turn.as_ref();
                let angle = turn.map_or(0.0, |turn| turn.angle(simulation.time()));
                vec![per_time(before - simulation.facet_wall_moments()[k]), angle]
            }
            Measurand::Flux(opening) => {
                let crossed = opening.crossed(simulation, periods, &self.places, self.time);
                self.crossed[gauge] += crossed;
                vec![self.crossed[gauge], per_time(crossed)]
            }
        }
    }
}
