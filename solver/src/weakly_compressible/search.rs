//! The neighbour search of a step: particles sorted by cell, images made anew, the list filled.

use crate::domain::Domain;
use crate::weakly_compressible::boundary::Images;
use crate::weakly_compressible::model::Model;
use crate::weakly_compressible::neighbours::CellGrid;
use crate::weakly_compressible::particles::{Particles, SortScratch};

/// The domain, the grids and the buffers of the sort, reused from search to search.
#[derive(Debug)]
pub(crate) struct Search<const D: usize> {
    domain: Domain<D>,
    flow_grid: CellGrid<D>,
    wall_grid: CellGrid<D>,
    scratch: SortScratch<D>,
    count: u64,
}

/// A particle with more neighbours than a list row can hold: the flow has collapsed onto itself.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Crowded {
    /// Its storage index.
    pub(crate) particle: usize,
}

impl<const D: usize> Search<D> {
    pub(crate) fn new(domain: Domain<D>) -> Self {
        Self { domain, flow_grid: CellGrid::new(), wall_grid: CellGrid::new(), scratch: SortScratch::new(), count: 0 }
    }

    /// Goes on counting from so many searches.
    pub(crate) fn count_from(&mut self, count: u64) {
        self.count = count;
    }

    /// Searches done.
    pub(crate) fn count(&self) -> u64 {
        self.count
    }

    /// Sorts the flow by cell, makes the images anew and fills the neighbour list.
    ///
    /// # Errors
    /// A particle with too many neighbours.
    pub(crate) fn run(
        &mut self,
        particles: &mut Particles<D>,
        images: &mut Images<D>,
        model: &mut Model<D>,
    ) -> Result<(), Crowded> {
        let radius = model.kernel.support() + model.skin();
        let (flow, real) = (particles.flow_count(), particles.real_count());
        particles.keep_real();
        self.keep_inside(particles);
        self.flow_grid.cover(particles.position[..flow].iter(), radius);
        self.flow_grid.sort(particles.position[..flow].iter().enumerate().map(|(index, x)| (index as u32, x)));
        particles.sort_flow(&self.flow_grid.index[..flow], &mut self.scratch);
        images.rebuild(&self.domain, &particles.position, radius);
        particles.append_images(images);
        let total = real + images.len();
        let entry = |index: usize| (index as u32, &particles.position[index]);
        let from_flow = |&k: &usize| images.source(k) < flow;
        let flow_images = (0..images.len()).filter(from_flow).map(|k| real + k);
        let wall_images = (0..images.len()).filter(|k| !from_flow(k)).map(|k| real + k);
        for grid in [&mut self.flow_grid, &mut self.wall_grid] {
            grid.cover(particles.position[..total].iter(), radius);
        }
        self.flow_grid.sort((0..flow).chain(flow_images).map(entry));
        self.wall_grid.sort((flow..real).chain(wall_images).map(entry));
        let grids = (&self.flow_grid, &self.wall_grid);
        self.count += 1;
        model
            .list
            .rebuild(&particles.position, flow, real, radius, grids, model.instruction_set)
            .map_err(|particle| Crowded { particle })
    }

    /// Brings the flow back through periods and mirrors; what a mirror pushes back is support.
    fn keep_inside(&self, particles: &mut Particles<D>) {
        for index in 0..particles.flow_count() {
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
    }
}
