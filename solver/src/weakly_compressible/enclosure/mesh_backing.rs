//! Dummy particles behind meshes in space: what [`super::backing`] does in the plane.
//!
//! Every flat part of a mesh is backed by the lattice of a plane wall, aligned with its longest edge, the first layer half
//! a spacing deep. A site belongs to the part that is nearest to it; where the cell of a site is shared, the part has what
//! its samples say, at their centroid. Parts narrower than a site, of which a curved surface is made, are backed together
//! by one lattice along the axes of the scene, whose particles have the distance to the surface as their depth and the
//! way there as their normal. So the space behind a mesh is covered once, whatever its shape.

use super::backing::{is_inside, together};
use super::facet::Facet;
use super::facet_grid::FacetGrid;
use super::facet_side::FacetSide;
use super::facet_tree::FacetTree;
use super::facet_wall::{BackingParticle, FacetWall};
use super::lattice_cell::{CORNERS, Cell, SAMPLES};
use super::mesh::{Frame, flat_parts};
use crate::domain::{AxisBoundary, Domain};
use crate::vector::Vector;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Share of a cell below which a piece is left out `[-]`.
const SMALLEST: f64 = 0.02;
/// Mean breadth in spacings below which a part is backed together with the others that are as narrow `[-]`.
const NARROW: f64 = 1.5;
/// Depth of a particle in spacings at least, where triangles fold so that its centroid is less deep `[-]`.
const LEAST_DEPTH: f64 = 0.05;

/// Dummy particles that fill the space behind each facet wall in `rows` at the flow's `spacing` `[m]`, the first half a spacing
/// behind the surface. Facet walls at rest share their edges; each that moves stands alone. Nothing is laid beyond periods and mirrors.
#[must_use]
pub fn lay(walls: &[FacetWall<3>], domain: &Domain<3>, spacing: f64, rows: usize) -> Vec<Vec<BackingParticle<3>>> {
    lay_counted(walls, domain, spacing, rows).0
}

/// The result of [`lay`], and the number of facets that were looked at in all, place by place: the cost.
#[must_use]
pub fn lay_counted(
    walls: &[FacetWall<3>],
    domain: &Domain<3>,
    spacing: f64,
    rows: usize,
) -> (Vec<Vec<BackingParticle<3>>>, usize) {
    let (mut backing, mut looked_at) = (vec![Vec::new(); walls.len()], 0);
    for group in together(walls) {
        let laying = Laying::of(walls, &group, domain, spacing, rows);
        let parts = (0..laying.parts.len()).into_par_iter().filter(|&part| !laying.parts[part].narrow);
        let mut particles: Vec<Vec<(usize, BackingParticle<3>)>> = parts.map(|part| laying.behind_part(part)).collect();
        particles.push(laying.behind_narrow_parts());
        for (wall, particle) in particles.into_iter().flatten() {
            backing[wall].push(particle);
        }
        looked_at += laying.looked_at.into_inner();
    }
    (backing, looked_at)
}

/// A flat part, or its image in a mirror or a period.
#[derive(Clone)]
struct Part {
    wall: usize,
    facets: Vec<usize>,
    narrow: bool,
}

/// Geometry among which particles are laid.
struct Laying<'a> {
    facets: Vec<Facet<3>>,
    /// The part of every facet.
    part_of: Vec<usize>,
    parts: Vec<Part>,
    tree: FacetTree,
    domain: &'a Domain<3>,
    spacing: f64,
    rows: usize,
    /// Facets that were looked at so far, place by place.
    looked_at: AtomicUsize,
}

/// Piece of a cell that belongs to one owner.
struct Piece {
    /// Centroid `[m]`.
    place: Vector<3>,
    /// `[m³]`.
    volume: f64,
    /// Whether it is the whole cell.
    whole: bool,
}

impl<'a> Laying<'a> {
    fn of(walls: &[FacetWall<3>], group: &[usize], domain: &'a Domain<3>, spacing: f64, rows: usize) -> Self {
        let (mut facets, mut part_of, mut parts) = (Vec::new(), Vec::new(), Vec::new());
        for &wall in group {
            let first = facets.len();
            facets.extend_from_slice(&walls[wall].facets);
            part_of.resize(facets.len(), 0);
            for own in flat_parts(&walls[wall].facets) {
                let of_part: Vec<_> = own.iter().map(|&k| walls[wall].facets[k]).collect();
                let narrow = Frame::of(&of_part).is_none_or(|frame| frame.breadth() < NARROW * spacing);
                for &k in &own {
                    part_of[first + k] = parts.len();
                }
                parts.push(Part { wall, facets: own.iter().map(|k| first + k).collect(), narrow });
            }
        }
        let tree = FacetTree::new::<3>(&[], spacing);
        let looked_at = AtomicUsize::new(0);
        let mut laying = Self { facets, part_of, parts, tree, domain, spacing, rows, looked_at };
        laying.add_images();
        laying.tree = FacetTree::new(&laying.facets, laying.reach() + 2.0 * spacing);
        laying
    }

    fn reach(&self) -> f64 {
        self.rows as f64 * self.spacing
    }

    /// Adds what mirrors and periods show of the parts near them, so that a wall does not end there.
    fn add_images(&mut self) {
        let near = 2.0 * self.reach();
        for axis in 0..3 {
            match self.domain.axes[axis] {
                AxisBoundary::Open => {}
                AxisBoundary::Periodic { lower, upper } => {
                    let shift = upper - lower;
                    let count = self.parts.len();
                    self.add_image(axis, count, |place| place < lower + near, |place| place + shift, false);
                    self.add_image(axis, count, |place| place > upper - near, |place| place - shift, false);
                }
                AxisBoundary::Mirror { lower, upper } => {
                    let count = self.parts.len();
                    for plane in [lower, upper].into_iter().flatten() {
                        let is_near = |place: f64| (place - plane).abs() < near;
                        self.add_image(axis, count, is_near, |place| 2.0 * plane - place, true);
                    }
                }
            }
        }
    }

    /// Adds the images of those among the first `count` parts that have a corner near.
    fn add_image(
        &mut self,
        axis: usize,
        count: usize,
        is_near: impl Fn(f64) -> bool,
        image: impl Fn(f64) -> f64,
        reflected: bool,
    ) {
        for part in 0..count {
            let Part { wall, facets, narrow } = self.parts[part].clone();
            let own: Vec<&Facet<3>> = facets.iter().map(|&k| &self.facets[k]).collect();
            if !own.iter().any(|facet| facet.corners.iter().any(|corner| is_near(corner[axis]))) {
                continue;
            }
            let images: Vec<Facet<3>> = own
                .into_iter()
                .map(|facet| {
                    let mut facet = *facet;
                    for corner in &mut facet.corners {
                        corner[axis] = image(corner[axis]);
                    }
                    if reflected {
                        facet.normal[axis] = -facet.normal[axis];
                    }
                    facet
                })
                .collect();
            let first = self.facets.len();
            self.part_of.resize(first + images.len(), self.parts.len());
            self.parts.push(Part { wall, facets: (first..first + images.len()).collect(), narrow });
            self.facets.extend(images);
        }
    }

    /// The particles behind a part that is broad enough for a lattice of its own.
    fn behind_part(&self, part: usize) -> Vec<(usize, BackingParticle<3>)> {
        let Part { wall, ref facets, .. } = self.parts[part];
        let of_part: Vec<_> = facets.iter().map(|&k| self.facets[k]).collect();
        let Some(frame) = Frame::of(&of_part) else { return Vec::new() };
        let counts = frame.lengths.map(|length| (length / self.spacing).round().max(1.0));
        let steps = [0, 1].map(|k| frame.along[k] * (frame.lengths[k] / counts[k]));
        let rows = self.rows as i64;
        let mut particles = Vec::new();
        for row in 0..rows {
            let depth = (row as f64 + 0.5) * self.spacing;
            for j in -rows..counts[1] as i64 + rows {
                for i in -rows..counts[0] as i64 + rows {
                    let site = steps[0] * (i as f64 + 0.5) + steps[1] * (j as f64 + 0.5);
                    let middle = frame.origin + site - frame.normal * depth;
                    let cell = Cell { middle, edges: [steps[0], steps[1], frame.normal * self.spacing] };
                    let Some(piece) = self.piece(&cell, |facet| self.part_of[facet] == part) else { continue };
                    let height = frame.normal.dot(&(piece.place - frame.origin));
                    let depth = if piece.whole { depth } else { (-height).max(LEAST_DEPTH * self.spacing) };
                    let Piece { place: position, volume, .. } = piece;
                    particles.push((wall, BackingParticle { position, normal: frame.normal, depth, volume }));
                }
            }
        }
        particles
    }

    /// The particles behind all parts that are narrower than a site, on one lattice.
    fn behind_narrow_parts(&self) -> Vec<(usize, BackingParticle<3>)> {
        let is_narrow = |facet: usize| self.parts[self.part_of[facet]].narrow;
        let narrow: Vec<Facet<3>> =
            (0..self.facets.len()).filter(|&facet| is_narrow(facet)).map(|facet| self.facets[facet]).collect();
        let cells: Vec<_> = FacetGrid::new(&narrow, self.reach() + 2.0 * self.spacing).occupied().collect();
        let edges = [0, 1, 2].map(|axis| Vector::<3>::ith(axis, self.spacing));
        let laid = cells.par_iter().map(|(lower, upper)| {
            let mut particles = Vec::new();
            // every site whose middle is in the cell
            let range = |axis: usize| {
                let site = |place: f64| (place / self.spacing - 0.5).ceil() as i64;
                site(lower[axis])..site(upper[axis])
            };
            for (z, y) in range(2).flat_map(|z| range(1).map(move |y| (z, y))) {
                for x in range(0) {
                    let middle = Vector::<3>::from([x, y, z].map(|k| (k as f64 + 0.5) * self.spacing));
                    let cell = Cell { middle, edges };
                    let piece = self.piece(&cell, is_narrow);
                    particles.extend(piece.and_then(|piece| self.behind_curve(&piece)));
                }
            }
            particles
        });
        laid.collect::<Vec<_>>().into_iter().flatten().collect()
    }

    /// The particle of a piece behind a curved surface.
    fn behind_curve(&self, piece: &Piece) -> Option<(usize, BackingParticle<3>)> {
        let position = piece.place;
        let facet = self.nearest(&position, f64::INFINITY)?.facet;
        let way = self.facets[facet].nearest(&position) - position;
        let depth = way.norm();
        let clear = depth > LEAST_DEPTH * self.spacing;
        let normal = if clear { way / depth } else { self.facets[facet].normal };
        let depth = depth.max(LEAST_DEPTH * self.spacing);
        Some((self.parts[self.part_of[facet]].wall, BackingParticle { position, normal, depth, volume: piece.volume }))
    }

    /// Piece of a cell that belongs to facets of a kind: behind them, no farther than the rows reach, inside the
    /// domain, and nearer to none of the others.
    fn piece(&self, cell: &Cell, is_own: impl Fn(usize) -> bool) -> Option<Piece> {
        let mut hint = self.nearest(&cell.middle, self.reach() + cell.radius())?.facet;
        let mut owned = |place: &Vector<3>| self.owner(&mut hint, place).is_some_and(&is_own);
        let last = SAMPLES - 1;
        let outer =
            (0..CORNERS).filter(|k| owned(&cell.sample([0, 1, 2].map(|axis| last * ((k >> axis) & 1))))).count();
        let volume = cell.volume();
        if outer == CORNERS {
            return Some(Piece { place: cell.middle, volume, whole: true });
        }
        if outer == 0 && !owned(&cell.middle) {
            return None;
        }
        let (mut count, mut sum) = (0.0, Vector::<3>::zeros());
        for k in 0..SAMPLES.pow(3) {
            let place = cell.sample([k % SAMPLES, k / SAMPLES % SAMPLES, k / (SAMPLES * SAMPLES)]);
            if owned(&place) {
                count += 1.0;
                sum += place - cell.middle;
            }
        }
        let share = count / SAMPLES.pow(3) as f64;
        let place = cell.middle + sum / f64::max(count, 1.0);
        (share >= SMALLEST).then_some(Piece { place, volume: share * volume, whole: false })
    }

    /// The facet that is nearest to a place, and its side, among those within a distance `[m]`.
    fn nearest(&self, place: &Vector<3>, distance: f64) -> Option<FacetSide> {
        self.tree.side_within(&self.facets, place, distance, |number| {
            self.looked_at.fetch_add(number, Ordering::Relaxed);
        })
    }

    /// The facet that a place behind the facet walls belongs to; `hint` is one near to it, for which the nearest then stands.
    fn owner(&self, hint: &mut usize, place: &Vector<3>) -> Option<usize> {
        let within = || self.reach().min((place - self.facets[*hint].nearest(place)).norm());
        let found = is_inside(self.domain, place).then(|| self.nearest(place, within())).flatten()?;
        *hint = found.facet;
        (found.distance < 0.0 && -found.distance < self.reach()).then_some(found.facet)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Volume behind the plane z = 0 of a cell with these edges whose middle is at a height `[m]`.
    fn behind(edges: [Vector<3>; 3], height: f64) -> Option<Piece> {
        let [a, b, c, d] =
            [[-9.0, -9.0], [9.0, -9.0], [9.0, 9.0], [-9.0, 9.0]].map(|[x, y]| Vector::<3>::new(x, y, 0.0));
        let (walls, domain) =
            ([FacetWall::mesh("bed", &[[a, b, c], [a, c, d]])], Domain { axes: [AxisBoundary::Open; 3] });
        let laying = Laying::of(&walls, &[0], &domain, 1.0, 4);
        laying.piece(&Cell { middle: Vector::<3>::new(0.0, 0.0, height), edges }, |_| true)
    }

    #[test]
    fn a_plane_cuts_a_cell_into_its_volume_and_centroid() {
        let [x, y, z] = [0, 1, 2].map(|axis| Vector::<3>::ith(axis, 1.0));
        for edges in [[x, y, z], [y, z, x], [z, x, y]] {
            assert!(behind(edges, 0.7).is_none() && behind(edges, -0.7).is_some_and(|piece| piece.whole));
            // a quarter and three quarters of the height
            for (height, share, place) in [(0.25, 0.25, -0.125), (-0.25, 0.75, -0.375)] {
                let piece = behind(edges, height).expect("a piece");
                assert!(!piece.whole && (piece.volume - share).abs() < 1e-14);
                assert!((piece.place - z * place).norm() < 1e-14, "{:?}", piece.place);
            }
        }
        // a cell on its corner: the plane cuts a tetrahedron off whose edges are 3/4 along those of the cell
        let edges =
            [x, y, z].map(|edge| nalgebra::Rotation3::rotation_between(&(x + y + z), &-z).expect("a turn") * edge);
        let piece = behind(edges, 0.75 / 3.0_f64.sqrt()).expect("a piece");
        let middle = z * (0.75 / 3.0_f64.sqrt());
        assert!((piece.volume - 0.75_f64.powi(3) / 6.0).abs() < 0.01, "{}", piece.volume);
        assert!((piece.place - middle - (edges[0] + edges[1] + edges[2]) * (0.5 - 0.75 / 4.0)).norm() < 1e-14);
    }

    /// Volume, and its moments over the height and around the period, behind a zigzag whose ridge is at a place along a period of 8.
    fn behind_zigzag(ridge: f64) -> [f64; 4] {
        let corner = |x: f64, y: f64| Vector::<3>::new(x, y, 0.5 * ((x - ridge).rem_euclid(8.0) - 4.0).abs());
        let facets = [0.0, 4.0].map(|x| {
            let [a, b, c, d] = [(x, 0.0), (x + 4.0, 0.0), (x + 4.0, 4.0), (x, 4.0)].map(|(x, y)| corner(x, y));
            [[a, b, c], [a, c, d]]
        });
        let walls = [FacetWall::mesh("bed", &facets.concat())];
        let axes = [AxisBoundary::Periodic { lower: 0.0, upper: 8.0 }, AxisBoundary::Open, AxisBoundary::Open];
        let mut moments = [0.0; 4];
        for own in lay(&walls, &Domain { axes }, 1.0, 3).concat() {
            let angle = std::f64::consts::TAU * (own.position[0] - ridge) / 8.0;
            let weights = [1.0, own.position[2], libm::cos(angle), libm::sin(angle)];
            moments.iter_mut().zip(weights).for_each(|(sum, weight)| *sum += own.volume * weight);
        }
        moments
    }

    #[test]
    fn a_ridge_at_a_period_is_backed_as_one_between() {
        let [at_the_period, between] = [0.0, 4.0].map(behind_zigzag);
        for (one, other) in at_the_period.into_iter().zip(between) {
            assert!((one - other).abs() < 1e-9, "{at_the_period:?}, {between:?}");
        }
        assert!(at_the_period[3].abs() < 1e-9 && at_the_period[0] > 8.0, "{at_the_period:?}");
    }
}
