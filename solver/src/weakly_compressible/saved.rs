//! A simulation as it is kept between two programs: all that its next step follows from, and that the scene does not say.
//!
//! The neighbour list is kept with the particles in their sorted order, because sums run in its order and a new search
//! would be that of other positions. What every step makes anew before it reads it (records, pair weights, the viscous
//! system) is left out.

use crate::run::{ContinueError, ForeignState};
use crate::vector::Vector;
use crate::weakly_compressible::enclosure::boundary_state::Books;
use crate::weakly_compressible::simulation::Compiled;
use crate::weakly_compressible::{EnergyLedger, Images, Particles, Scene, Simulation, State, VerletList, Wall};
use serde::{Deserialize, Serialize};
use std::borrow::Cow;

/// Distance over the spacing from which on a wall particle is not where its wall is `[-]`: rounding of its way is far less.
const MISPLACED: f64 = 1e-3;

/// A simulation between two steps, for a file; made by [`Simulation::save`].
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct SavedSimulation<'a, const D: usize> {
    particles: Cow<'a, Particles<D>>,
    images: Cow<'a, Images<D>>,
    walls: Cow<'a, [Wall<D>]>,
    books: Cow<'a, Books<D>>,
    side_wall_impulse: Vector<D>,
    list: Cow<'a, VerletList>,
    energy: EnergyLedger,
    searches: u64,
    viscous_iterations: u64,
    time: f64,
    steps: u64,
    largest_speed: f64,
    relative_speed: f64,
    diffusivity: f64,
    displacement: f64,
}

impl<const D: usize> Simulation<D> {
    /// The simulation as it stands, to be written and continued.
    #[must_use]
    pub fn save(&self) -> SavedSimulation<'_, D> {
        let State { particles, images, walls, enclosure, model, energy, search, viscous, .. } = &self.state;
        SavedSimulation {
            particles: Cow::Borrowed(particles),
            images: Cow::Borrowed(images),
            walls: Cow::Borrowed(walls),
            books: Cow::Borrowed(&enclosure.books),
            side_wall_impulse: self.state.side_wall_impulse,
            list: Cow::Borrowed(&model.list),
            energy: *energy,
            searches: search.count,
            viscous_iterations: viscous.iterations,
            time: self.state.time,
            steps: self.state.steps,
            largest_speed: self.state.largest_speed,
            relative_speed: self.state.relative_speed,
            diffusivity: self.state.diffusivity,
            displacement: self.state.displacement,
        }
    }

    /// A saved simulation, to be continued bit by bit as if it had never been interrupted. `scene` is the one that it was
    /// begun with; of its flow only the number of particles counts.
    ///
    /// # Errors
    /// A scene that breaks a rule, a state that is not one of this scene.
    pub fn continued(scene: Scene<D>, saved: SavedSimulation<'_, D>) -> Result<Self, ContinueError>
    where
        Self: Compiled<D>,
    {
        let (backing, scene_spacing) = (Self::backing(&scene)?, scene.spacing);
        let mut state = State::new(scene, &backing);
        let (particles, images) = (saved.particles.into_owned(), saved.images.into_owned());
        let (list, walls) = (saved.list.into_owned(), saved.walls.into_owned());
        let (flow, real) = (particles.flow_count(), particles.real_count());
        let books = saved.books.into_owned();
        let facet_walls = state.enclosure.walls.len();
        let begun = books.check_rows(&state.enclosure.inlets, state.particles.flow_count())?;
        let departed = books.outflow.particles() as usize;
        ForeignState::check("flow particles", flow.saturating_add(departed), begun)?;
        ContinueError::check_time(saved.time)?;
        ForeignState::check("wall particles", particles.wall_count(), state.particles.wall_count())?;
        ForeignState::check("walls", walls.len(), state.walls.len())?;
        ForeignState::check("walls of segments", books.impulses.len(), facet_walls)?;
        ForeignState::check("walls under loads", books.travels.len(), facet_walls)?;
        ForeignState::check("moments of walls", books.moments.len(), facet_walls)?;
        let begun_at = state.enclosure.poses.clone();
        state.enclosure.restore(books, saved.time);
        let moved: Vec<_> = begun_at.iter().zip(&state.enclosure.poses).collect();
        let moved = &moved[..facet_walls - state.enclosure.inlets.len()];
        let is_at_its_place = |&index: &usize| {
            let wall = (particles.wall[index] as usize).checked_sub(walls.len());
            let (Some((start, now)), Some(place)) =
                (wall.and_then(|wall| moved.get(wall)), particles.position.get(particles.flow_count() + index))
            else {
                return true;
            };
            let begun = state.particles.position[state.particles.flow_count() + index];
            let expected = now.place(&(begun - start.shift));
            state.search.domain.shortest(place - expected).norm() < MISPLACED * scene_spacing
        };
        let count = particles.wall_count();
        let placed = (0..count).filter(is_at_its_place).count();
        ForeignState::check("wall particles where its walls have moved", placed, count)?;
        let whole = particles.are_complete(images.len(), begun, &state.model.rheology)
            && images.belong_to(real)
            && particles.wall.iter().all(|&wall| (wall as usize) < walls.len() + facet_walls)
            && state.enclosure.books.outflow.sides.len() == 2 * D
            && list.belongs_to(flow, real, real + images.len() + 1);
        ForeignState::check("whole sets of arrays", usize::from(whole), 1)?;
        state.particles = particles;
        state.images = images;
        state.walls = walls;
        state.model.list = list;
        state.energy = saved.energy;
        state.side_wall_impulse = saved.side_wall_impulse;
        state.search.count = saved.searches;
        state.viscous.iterations = saved.viscous_iterations;
        state.time = saved.time;
        state.steps = saved.steps;
        state.largest_speed = saved.largest_speed;
        state.relative_speed = saved.relative_speed;
        state.diffusivity = saved.diffusivity;
        state.displacement = saved.displacement;
        state.enclosure.assign_owners(&state.particles, &state.images);
        Ok(Self { state })
    }
}
