//! Dummy particles behind facet walls in the plane: rows at the particle spacing along every straight part.
//!
//! A plane wall is filled with rows of dummy particles that get pressure, stress and velocity from the flow, and nothing
//! but their places, normals and depths tells a pass that the wall is plane. So a wall of segments is backed by the same
//! rows, with the normal of its segment, and every pass treats both alike: a straight wall of several segments has the
//! particles of the plane one. At corners a place belongs to the segment that it is nearest to, as where plane walls
//! meet; what a row keeps is divided into equal shares of about a spacing squared, each with its own volume, so that the
//! space behind the wall is covered once whatever the angle. (A kernel integral over each half plane, the semi-analytic
//! way, would take a rule of its own for every corner, and other sums than those of the plane wall.)

use super::facet::Facet;
use super::facet_side::facet_side;
use super::facet_wall::{BackingParticle, FacetWall};
use crate::domain::{AxisBoundary, Domain};
use crate::vector::Vector;

/// Samples of a spacing along each direction, by which it is found what belongs to a row.
const SAMPLES: usize = 8;
/// Share of a spacing squared below which a piece of a row is left out `[-]`.
const SMALLEST: f64 = 0.02;
/// Difference of two distances in spacings below which they are equal `[-]`.
const EQUAL: f64 = 1e-6;
/// Sine of the angle up to which two segments are one straight part `[-]`.
const STRAIGHT: f64 = 1e-9;

/// Dummy particles that fill the space behind each facet wall in `rows` at the flow's `spacing` `[m]`, the first half a
/// spacing behind the surface. Facet walls at rest share their corners; each that moves stands alone. Nothing is laid beyond
/// periods and mirrors, and a polyline that ends on one continues behind it.
#[must_use]
pub fn lay(walls: &[FacetWall<2>], domain: &Domain<2>, spacing: f64, rows: usize) -> Vec<Vec<BackingParticle<2>>> {
    let mut backing = vec![Vec::new(); walls.len()];
    for group in together(walls) {
        let parts: Vec<Part> = group.iter().flat_map(|&wall| straight_parts(wall, &walls[wall])).collect();
        let reach = rows as f64 * spacing;
        let lines: Vec<Facet<2>> = parts.iter().map(|part| part.drawn_out(domain, reach)).collect();
        for (own, part) in parts.iter().enumerate() {
            let laying = Laying { lines: &lines, own, domain, spacing, rows };
            backing[part.wall].extend(laying.particles(part));
        }
    }
    backing
}

/// Facet walls that share their corners, by their places: all at rest, and each that moves alone.
pub(super) fn together<const D: usize>(walls: &[FacetWall<D>]) -> Vec<Vec<usize>> {
    let rest: Vec<usize> = (0..walls.len()).filter(|&k| walls[k].motion.is_rest()).collect();
    let moving = (0..walls.len()).filter(|&k| !walls[k].motion.is_rest()).map(|k| vec![k]);
    std::iter::once(rest).chain(moving).collect()
}

/// A straight part of a facet wall.
struct Part {
    wall: usize,
    line: Facet<2>,
    /// Whether nothing of its facet wall joins its ends.
    free: [bool; 2],
}

/// Consecutive segments of one direction are one part.
fn straight_parts(wall: usize, of: &FacetWall<2>) -> Vec<Part> {
    let mut parts: Vec<Part> = Vec::new();
    for facet in &of.facets {
        match parts.last_mut() {
            Some(Part { line, .. })
                if line.corners[1] == facet.corners[0]
                    && line.normal.perp(&facet.normal).abs() < STRAIGHT
                    && line.normal.dot(&facet.normal) > 0.0 =>
            {
                line.corners[1] = facet.corners[1];
            }
            _ => parts.push(Part { wall, line: *facet, free: [true; 2] }),
        }
    }
    let ends: Vec<[Vector<2>; 2]> = parts.iter().map(|part| part.line.corners).collect();
    for part in &mut parts {
        let [start, end] = part.line.corners;
        part.free = [!ends.iter().any(|other| other[1] == start), !ends.iter().any(|other| other[0] == end)];
    }
    parts
}

impl Part {
    /// Line, drawn out by `reach` `[m]` at free ends on a plane of the domain.
    fn drawn_out(&self, domain: &Domain<2>, reach: f64) -> Facet<2> {
        let [start, end] = self.line.corners;
        let along = (end - start).normalize() * reach;
        let mut line = self.line;
        if self.free[0] && on_a_plane(domain, &start, reach) {
            line.corners[0] -= along;
        }
        if self.free[1] && on_a_plane(domain, &end, reach) {
            line.corners[1] += along;
        }
        line
    }
}

/// Lower and upper plane of the domain along an axis.
fn planes(boundary: &AxisBoundary) -> [Option<f64>; 2] {
    match *boundary {
        AxisBoundary::Open => [None; 2],
        AxisBoundary::Periodic { lower, upper } => [Some(lower), Some(upper)],
        AxisBoundary::Mirror { lower, upper } => [lower, upper],
    }
}

/// Whether a place is between the planes of the domain.
pub(super) fn is_inside<const D: usize>(domain: &Domain<D>, place: &Vector<D>) -> bool {
    (0..D).all(|axis| {
        let [lower, upper] = planes(&domain.axes[axis]);
        lower.is_none_or(|plane| place[axis] > plane) && upper.is_none_or(|plane| place[axis] < plane)
    })
}

fn on_a_plane(domain: &Domain<2>, place: &Vector<2>, reach: f64) -> bool {
    let near = |axis: usize, plane: f64| (place[axis] - plane).abs() < 1e-6 * reach;
    (0..2).any(|axis| planes(&domain.axes[axis]).into_iter().flatten().any(|plane| near(axis, plane)))
}

/// Geometry among which the rows of a part are laid.
struct Laying<'a> {
    /// Lines of all parts.
    lines: &'a [Facet<2>],
    /// Index of the part's own line.
    own: usize,
    domain: &'a Domain<2>,
    spacing: f64,
    rows: usize,
}

/// Part of a strip across a row that the row keeps.
#[derive(Clone, Copy, Default)]
struct Strip {
    /// Middle along the part `[m]`.
    along: f64,
    /// Area `[m²]`, and its moment of the depth `[m³]`.
    area: f64,
    depth_moment: f64,
}

impl Laying<'_> {
    fn particles(&self, part: &Part) -> Vec<BackingParticle<2>> {
        let line = self.lines[self.own];
        let (start, across) = (line.corners[0], line.normal);
        let length = (line.corners[1] - start).norm();
        let direction = (line.corners[1] - start) / length;
        let reach = self.rows as f64 * self.spacing;
        let near: Vec<usize> = self.near(&line, 3.0 * reach);
        let strips = self.strips(length, reach);
        let mut particles = Vec::new();
        for row in 0..self.rows {
            let mut kept: Vec<Strip> = Vec::new();
            let mut pieces = Vec::new();
            for &(along, width) in &strips {
                let mut strip = Strip { along, ..Strip::default() };
                let share = width * self.spacing / SAMPLES as f64;
                for sample in 0..SAMPLES {
                    let depth = (row as f64 + (sample as f64 + 0.5) / SAMPLES as f64) * self.spacing;
                    let owned = share * self.owned(&near, &(start + direction * along - across * depth), reach);
                    strip.area += owned;
                    strip.depth_moment += owned * depth;
                }
                if strip.area > 0.0 {
                    kept.push(strip);
                } else {
                    pieces.extend(self.shares(&kept));
                    kept.clear();
                }
            }
            pieces.extend(self.shares(&kept));
            particles.extend(pieces.into_iter().map(|(along, depth, volume)| {
                let position = start + direction * along - across * depth;
                BackingParticle { position, normal: part.line.normal, depth, volume }
            }));
        }
        particles
    }

    /// Parts that can be nearest to a place within `range` `[m]` of a line.
    fn near(&self, line: &Facet<2>, range: f64) -> Vec<usize> {
        let box_of =
            |facet: &Facet<2>| (facet.corners[0].inf(&facet.corners[1]), facet.corners[0].sup(&facet.corners[1]));
        let (lower, upper) = box_of(line);
        let meets = |other: &Facet<2>| {
            let (other_lower, other_upper) = box_of(other);
            (0..2).all(|axis| other_lower[axis] < upper[axis] + range && other_upper[axis] > lower[axis] - range)
        };
        (0..self.lines.len()).filter(|&k| meets(&self.lines[k])).collect()
    }

    /// Middles and widths of strips across a part and `reach` beyond its ends `[m]`.
    fn strips(&self, length: f64, reach: f64) -> Vec<(f64, f64)> {
        let fine = self.spacing / SAMPLES as f64;
        let inner = (length / fine).round().max(1.0);
        let beyond = (reach / fine).ceil() as usize;
        let before = (0..beyond).rev().map(|k| (-(k as f64 + 0.5) * fine, fine));
        let along = (0..inner as usize).map(|k| ((k as f64 + 0.5) * (length / inner), length / inner));
        let after = (0..beyond).map(|k| (length + (k as f64 + 0.5) * fine, fine));
        before.chain(along).chain(after).collect()
    }

    /// Share of a place behind the wall that belongs to this part: on the bisector of a corner it belongs to both, so
    /// that mirror images of a corner have mirror images of its particles.
    fn owned(&self, near: &[usize], place: &Vector<2>, reach: f64) -> f64 {
        if !is_inside(self.domain, place) {
            return 0.0;
        }
        let found = facet_side(near.iter().map(|&k| (&self.lines[k], *place)));
        let Some(found) = found.filter(|found| found.distance < 0.0 && -found.distance < reach) else { return 0.0 };
        let owner = near[found.facet];
        let way = |k: usize| (place - self.lines[k].nearest(place)).norm();
        let apart = |a: f64, b: f64| (a - b).abs() > EQUAL * self.spacing;
        let depth = self.lines[owner].height(place);
        let owns =
            |k: usize| k == owner || !(apart(self.lines[k].height(place), depth) || apart(way(k), -found.distance));
        if owns(self.own) { 1.0 / near.iter().filter(|&&k| owns(k)).count() as f64 } else { 0.0 }
    }

    /// Strips side by side, divided into equal shares of about a spacing squared: place along the part and depth `[m]`,
    /// volume `[m²]`.
    fn shares(&self, strips: &[Strip]) -> Vec<(f64, f64, f64)> {
        let total: f64 = strips.iter().map(|strip| strip.area).sum();
        let square = self.spacing * self.spacing;
        if total < SMALLEST * square {
            return Vec::new();
        }
        let count = (total / square).round().max(1.0);
        let share = total / count;
        let mut shares = Vec::with_capacity(count as usize);
        let (mut area, mut along, mut depth) = (0.0, 0.0, 0.0);
        for strip in strips {
            let mut rest = strip.area;
            while rest > 0.0 {
                let taken = rest.min(share - area);
                area += taken;
                along += taken * (strip.along);
                depth += taken * (strip.depth_moment / strip.area);
                rest -= taken;
                if area >= share * (1.0 - 1e-9) {
                    shares.push((along / area, depth / area, share));
                    (area, along, depth) = (0.0, 0.0, 0.0);
                    rest = if rest > 1e-9 * share { rest } else { 0.0 };
                }
            }
        }
        shares
    }
}
