//! The neighbour search of a step: particles sorted by cell, images made anew, the list filled.

use crate::domain::Domain;
use crate::material::rheology::field::Memory;
use crate::parallel::prelude::*;
use crate::weakly_compressible::neighbours::CellGrid;
use crate::weakly_compressible::{Images, Model, Particles};

/// The domain, the grids and the buffers of the sort, reused from search to search.
#[derive(Debug)]
pub(crate) struct Search<const D: usize> {
    pub(crate) domain: Domain<D>,
    flow_grid: CellGrid<D>,
    wall_grid: CellGrid<D>,
    /// Images of the flow and of walls.
    flow_images: Vec<u32>,
    wall_images: Vec<u32>,
    /// Room for the sort of identities.
    identities: Vec<u32>,
    /// And of what a law keeps beside its field.
    memories: Vec<Memory<f64>>,
    /// Searches done.
    pub(crate) count: u64,
}

impl<const D: usize> Search<D> {
    pub(crate) fn new(domain: Domain<D>) -> Self {
        Self {
            domain,
            flow_grid: CellGrid::new(),
            wall_grid: CellGrid::new(),
            flow_images: Vec::new(),
            wall_images: Vec::new(),
            identities: Vec::new(),
            memories: Vec::new(),
            count: 0,
        }
    }

    /// Sorts the flow by cell, makes the images anew and fills the neighbour list.
    ///
    /// # Errors
    /// The storage index of a particle with more neighbours than a list row can hold: the flow has collapsed onto itself.
    pub(crate) fn run(
        &mut self,
        particles: &mut Particles<D>,
        images: &mut Images<D>,
        model: &mut Model<D>,
    ) -> Result<(), usize> {
        let radius = model.kernel.support() + model.skin();
        let (flow, real) = (particles.flow_count(), particles.real_count());
        particles.keep_real();
        self.keep_inside(particles);
        self.flow_grid.cover(&particles.position[..flow], radius);
        self.flow_grid.sort(&particles.position, flow, |entry| entry);
        particles.sort_flow(&self.flow_grid.index[..flow], &mut self.identities, &mut self.memories);
        images.rebuild(&self.domain, &particles.position, radius);
        particles.append_images(images);
        self.flow_images.clear();
        self.wall_images.clear();
        for k in 0..images.len() {
            let list = if images.source(k) < flow { &mut self.flow_images } else { &mut self.wall_images };
            list.push((real + k) as u32);
        }
        let positions = &particles.position;
        for grid in [&mut self.flow_grid, &mut self.wall_grid] {
            grid.cover(&positions[..real + images.len()], radius);
        }
        let (flow_images, wall_images) = (&self.flow_images, &self.wall_images);
        let of_flow = |entry: usize| if entry < flow { entry } else { flow_images[entry - flow] as usize };
        let walls = real - flow;
        let of_walls = |entry: usize| if entry < walls { flow + entry } else { wall_images[entry - walls] as usize };
        self.flow_grid.sort(positions, flow + flow_images.len(), of_flow);
        self.wall_grid.sort(positions, walls + wall_images.len(), of_walls);
        for grid in [&mut self.flow_grid, &mut self.wall_grid] {
            grid.take_coordinates(positions);
        }
        let grids = (&self.flow_grid, &self.wall_grid);
        self.count += 1;
        model.list.rebuild(&particles.position, flow, real, radius, grids, model.instruction_set)
    }

    /// Brings the flow back through periods and mirrors, and walls through periods; what a mirror pushes back is support.
    fn keep_inside(&self, particles: &mut Particles<D>) {
        let flow = particles.flow_count();
        let Particles { position, velocity, velocity_gradient, stress, mass, support_impulse, .. } = particles;
        let moved = (
            &mut position[..flow],
            &mut velocity[..flow],
            &mut velocity_gradient[..flow],
            &mut stress[..flow],
            &mass[..],
            support_impulse,
        );
        moved.with_min_len(4096).for_each(|(position, velocity, velocity_gradient, stress, &mass, support_impulse)| {
            self.domain.wrap(position);
            let before = *velocity;
            self.domain.reflect(position, velocity, velocity_gradient, stress);
            let pushed_back = (*velocity - before) * mass;
            *support_impulse += pushed_back;
        });
        // what a moving wall takes out of the period comes in on its other side
        position[flow..].iter_mut().for_each(|position| self.domain.wrap(position));
    }
}
