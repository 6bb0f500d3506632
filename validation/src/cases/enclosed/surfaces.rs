//! Where places stand with regard to the walls of a scene.

use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::boundary::facet::Facet;
use bagnold_solver::weakly_compressible::boundary::facet_grid::FacetGrid;
use bagnold_solver::weakly_compressible::boundary::shell::Shell;
use bagnold_solver::weakly_compressible::simulation::Simulation;

/// Sites nearer to a wall than this are left free, in spacings `[-]`.
const FREE: f64 = 0.4;
/// Particles that are behind a wall by less than this have passed it, in spacings `[-]`.
const PASSED: f64 = 0.5;

/// Facets that stand together, with a grid to find them by.
struct FacetSurface<const D: usize> {
    facets: Vec<Facet<D>>,
    grid: FacetGrid<D>,
}

impl<const D: usize> FacetSurface<D> {
    fn of(facets: Vec<Facet<D>>, range: f64) -> Self {
        Self { grid: FacetGrid::new(&facets, range), facets }
    }

    /// Distance of a place `[m]`, negative behind; none where it is farther than the range.
    fn distance(&self, place: &Vector<D>) -> Option<f64> {
        self.grid.standing(&self.facets, place).map(|found| found.distance)
    }
}

/// What walls at rest make up together, and each that moves, at the start.
pub(super) struct Surfaces<const D: usize>(Vec<FacetSurface<D>>);

impl<const D: usize> Surfaces<D> {
    /// The surfaces of some walls, by which places are found up to a distance `[m]`: as far as the walls are thick.
    pub(super) fn of(shells: &[Shell<D>], range: f64) -> Self {
        let (rest, moving): (Vec<_>, Vec<_>) = shells.iter().partition(|shell| shell.motion.is_rest());
        let rest = rest.into_iter().flat_map(|shell| shell.facets.clone()).collect();
        let all = std::iter::once(rest).chain(moving.into_iter().map(|shell| shell.facets.clone()));
        Self(all.map(|facets| FacetSurface::of(facets, range)).collect())
    }

    /// Whether a site of a lattice at a spacing `[m]` is in front of all walls, or farther behind them than they are thick.
    pub(super) fn are_free(&self, site: &Vector<D>, spacing: f64) -> bool {
        self.0.iter().all(|surface| surface.distance(site).is_none_or(|distance| distance > FREE * spacing))
    }
}

/// Particles that are behind a wall by less than half a spacing: they have passed it.
pub(super) fn behind<const D: usize>(simulation: &Simulation<D>) -> u64 {
    let range = PASSED * simulation.spacing();
    let surfaces: Vec<_> =
        simulation.shells().iter().map(|shell| FacetSurface::of(shell.facets.clone(), range)).collect();
    let particles = simulation.particles();
    let count = particles.position[..particles.flow_count()].iter().filter(|place| {
        let mut shells = surfaces.iter().zip(simulation.shell_displacements());
        shells.any(|(surface, moved)| surface.distance(&(*place - moved)).is_some_and(|distance| distance < 0.0))
    });
    count.count() as u64
}
