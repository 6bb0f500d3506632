//! Places in front of the walls of a scene, and behind them.

use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::facet::Facet;
use bagnold_solver::weakly_compressible::enclosure::facet_side::FacetSide;
use bagnold_solver::weakly_compressible::enclosure::facet_tree::FacetTree;
use bagnold_solver::weakly_compressible::enclosure::facet_wall::FacetWall;
use bagnold_solver::weakly_compressible::enclosure::pose::Pose;
use bagnold_solver::weakly_compressible::enclosure::{BoundarySet, Inlet};
use bagnold_solver::weakly_compressible::simulation::Simulation;

/// Sites nearer to a wall than this are left free, in spacings `[-]`.
const FREE: f64 = 0.4;
/// Particles that are behind a wall by less than this have passed it, in spacings `[-]`.
const PASSED: f64 = 0.5;

/// Search for the side of facets on which a place is.
pub type SideSearch<const D: usize> = fn(&FacetTree, &[Facet<D>], &Vector<D>) -> Option<FacetSide>;

/// Facets that stand together, with a tree to find them by.
struct FacetSurface<const D: usize> {
    search: SideSearch<D>,
    facets: Vec<Facet<D>>,
    /// The wall that each facet is of, by its place among all.
    walls: Vec<usize>,
    tree: FacetTree,
}

/// The wall that is nearest to a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct NearestWall {
    /// Position among all.
    pub(super) wall: usize,
    /// Distance from it `[m]`, negative behind.
    pub(super) distance: f64,
}

impl<const D: usize> FacetSurface<D> {
    fn of<'a>(walls: impl Iterator<Item = (usize, &'a FacetWall<D>)>, range: f64, search: SideSearch<D>) -> Self {
        let (walls, facets): (Vec<usize>, Vec<Facet<D>>) =
            walls.flat_map(|(index, wall)| wall.facets.iter().map(move |facet| (index, *facet))).unzip();
        Self { search, tree: FacetTree::new(&facets, range), facets, walls }
    }

    /// The wall nearest to a place; none where all are farther than the range.
    fn nearest(&self, place: &Vector<D>) -> Option<NearestWall> {
        let found = (self.search)(&self.tree, &self.facets, place)?;
        Some(NearestWall { wall: self.walls[found.facet], distance: found.distance })
    }
}

/// Surfaces at the start: one of all walls at rest, and one of each moving wall or inlet's rows.
pub(super) struct Surfaces<const D: usize>(Vec<FacetSurface<D>>);

impl<const D: usize> Surfaces<D> {
    /// The surfaces of walls and then of the rows of inlets, by which places are found up to a distance `[m]`: as far as the walls are
    /// thick.
    pub(super) fn of(BoundarySet { walls, inlets, .. }: &BoundarySet<D>, range: f64, search: SideSearch<D>) -> Self {
        let surface = |one| FacetSurface::of(std::iter::once(one), range, search);
        let (rest, moving): (Vec<_>, Vec<_>) = walls.iter().enumerate().partition(|(_, wall)| wall.motion.is_rest());
        let rows: Vec<_> = inlets.iter().map(Inlet::wall).collect();
        let rest = std::iter::once(FacetSurface::of(rest.into_iter(), range, search));
        let rows = rows.iter().enumerate().map(|(inlet, rows)| (walls.len() + inlet, rows));
        let moving = moving.into_iter().chain(rows).map(surface);
        Self(rest.chain(moving).collect())
    }

    /// The wall that a site is in front of by the least, or behind of by the most; none where all are farther than they are
    /// thick.
    pub(super) fn nearest(&self, site: &Vector<D>) -> Option<NearestWall> {
        let found = self.0.iter().filter_map(|surface| surface.nearest(site));
        found.min_by(|a, b| a.distance.total_cmp(&b.distance))
    }
}

/// The first of some places that is behind a wall at the start by less than half a spacing `[m]`, and the number of the wall.
pub(super) fn first_behind<const D: usize>(
    walls: &[FacetWall<D>],
    places: &[Vector<D>],
    (spacing, search): (f64, SideSearch<D>),
) -> Option<(usize, Vector<D>)> {
    let each = walls.iter().enumerate().map(|one| FacetSurface::of(std::iter::once(one), PASSED * spacing, search));
    each.enumerate().find_map(|(wall, surface)| {
        let is_behind = |place: &&Vector<D>| surface.nearest(place).is_some_and(|wall| wall.distance < 0.0);
        places.iter().find(is_behind).map(|place| (wall, *place))
    })
}

/// Whether a site of a lattice at a spacing `[m]` is too near to its nearest wall for a particle, or behind it.
pub(super) fn is_taken(nearest: &NearestWall, spacing: f64) -> bool {
    nearest.distance <= FREE * spacing
}

/// Particles that are behind a wall by less than half a spacing: they have passed it.
pub(super) fn behind<const D: usize>(simulation: &Simulation<D>, search: SideSearch<D>) -> u64 {
    let range = PASSED * simulation.spacing();
    let walls = simulation.facet_walls().iter().enumerate();
    let surfaces: Vec<_> = walls.map(|one| FacetSurface::of(std::iter::once(one), range, search)).collect();
    let particles = simulation.particles();
    let count = particles.position[..particles.flow_count()].iter().filter(|place| {
        let mut walls = surfaces.iter().zip(simulation.facet_wall_poses());
        let start = |pose: &Pose<D>| pose.back(place, |way| way);
        walls.any(|(surface, pose)| surface.nearest(&start(pose)).is_some_and(|wall| wall.distance < 0.0))
    });
    count.count() as u64
}
