//! Solid walls: planes filled with dummy particles, which stand still or travel with their wall.

use crate::domain::{AxisBoundary, Domain};
use crate::vector::Vector;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Pressure, stress and velocity of the dummy particles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum WallTreatment {
    /// Pressure, stress and velocity extrapolated from the flow (the recipe).
    Extrapolated,
    /// The paper's: Morris no-slip (18)–(20) with Adami pressure (21)–(23).
    Paper,
}

/// Whether a wall holds the flow back along its surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Surface {
    /// The flow sticks to it.
    Rough,
    /// The flow slips along it without friction.
    Smooth,
}

/// A plane wall normal to one axis.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Wall<const D: usize> {
    /// Axis that the wall is normal to.
    pub axis: usize,
    /// Coordinate of its surface along that axis `[m]`.
    pub surface: f64,
    /// +1 where the flow lies above the surface, −1 where below `[-]`.
    pub side: f64,
    /// Velocity of the wall `[m/s]`.
    pub velocity: Vector<D>,
    /// Rough or smooth.
    pub roughness: Surface,
    /// Distance that the wall still moves at its velocity, taking its particles with it, before it stands still `[m]`.
    /// At 0 a rough wall with a velocity is a belt: it drags, and its particles stay.
    pub travel: f64,
    /// Lower and upper corner of the region in which a wall of finite size touches the flow `[m]`; it travels along.
    pub region: Option<(Vector<D>, Vector<D>)>,
}

impl<const D: usize> Wall<D> {
    /// A rough wall of unlimited size that stands still.
    #[must_use]
    pub fn still(axis: usize, surface: f64, side: f64) -> Self {
        let velocity = Vector::zeros();
        Self { axis, surface, side, velocity, roughness: Surface::Rough, travel: 0.0, region: None }
    }

    /// Moves the wall for a time `[s]`, stopping it where its travel ends. Returns its displacement `[m]`.
    pub(crate) fn advance(&mut self, time: f64) -> Vector<D> {
        if self.travel <= 0.0 {
            return Vector::zeros();
        }
        let distance = self.velocity.norm() * time;
        let part = (self.travel / distance).min(1.0);
        let displacement = self.velocity * (time * part);
        self.surface += displacement[self.axis];
        if let Some((lower, upper)) = &mut self.region {
            *lower += displacement;
            *upper += displacement;
        }
        self.travel -= distance;
        if self.travel <= 0.0 {
            self.travel = 0.0;
            self.velocity = Vector::zeros();
        }
        displacement
    }

    /// Whether a position is where the wall can touch it.
    #[inline(always)]
    #[must_use]
    pub fn faces(&self, position: &Vector<D>) -> bool {
        match &self.region {
            None => true,
            Some((lower, upper)) => {
                let mut inside = true;
                for axis in 0..D {
                    inside &= position[axis] >= lower[axis] && position[axis] <= upper[axis];
                }
                inside
            }
        }
    }

    /// Unit normal into the flow `[-]`.
    #[must_use]
    pub fn normal(&self) -> Vector<D> {
        let mut normal = Vector::zeros();
        normal[self.axis] = self.side;
        normal
    }

    /// Distance of a position from the surface `[m]`, positive on the flow's side.
    #[inline(always)]
    #[must_use]
    pub fn distance(&self, position: &Vector<D>) -> f64 {
        self.side * (position[self.axis] - self.surface)
    }
}

/// Rows of dummy particles behind a wall: as many as the kernel reaches, and one for what moves between two searches.
#[must_use]
pub fn rows(smoothing_ratio: f64) -> usize {
    (2.0 * smoothing_ratio).ceil() as usize + 1
}

/// One dummy particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WallParticle<const D: usize> {
    /// Position `[m]`.
    pub position: Vector<D>,
    /// Index of its wall, the nearest where two meet.
    pub wall: usize,
}

/// Fills the walls with `layers` rows of dummy particles at the flow's `spacing` `[m]`, the first row half a
/// spacing behind the surface.
///
/// `extent` `[m]` gives lower and upper corner of the region that the flow can reach: walls extend along it,
/// and around corners where walls meet. Periodic axes are filled over exactly one period.
#[must_use]
pub fn fill<const D: usize>(
    walls: &[Wall<D>],
    domain: &Domain<D>,
    extent: (Vector<D>, Vector<D>),
    spacing: f64,
    layers: usize,
) -> Vec<WallParticle<D>> {
    let (lower, upper) = filled_extent(walls, domain, extent, layers as f64 * spacing);
    let cells: [usize; D] =
        std::array::from_fn(|axis| ((upper[axis] - lower[axis]) / spacing).round().max(1.0) as usize);
    let particle = |index: usize| {
        let mut rest = index;
        let position = Vector::<D>::from_fn(|axis, _| {
            let cell = rest % cells[axis];
            rest /= cells[axis];
            let step = match domain.axes[axis] {
                AxisBoundary::Periodic { .. } => (upper[axis] - lower[axis]) / cells[axis] as f64,
                _ => spacing,
            };
            lower[axis] + (cell as f64 + 0.5) * step
        });
        // the nearest surface owns the particle; a position on the flow's side of every wall is no wall particle
        let behind = walls.iter().enumerate().filter(|(_, wall)| wall.distance(&position) < 0.0);
        let owner = behind.min_by(|a, b| a.1.distance(&position).abs().total_cmp(&b.1.distance(&position).abs()));
        owner.map(|(wall, _)| WallParticle { position, wall })
    };
    (0..cells.iter().product()).filter_map(particle).collect()
}

/// Lower and upper corner `[m]` of what walls of a `depth` `[m]` fill together with the flow between them.
fn filled_extent<const D: usize>(
    walls: &[Wall<D>],
    domain: &Domain<D>,
    extent: (Vector<D>, Vector<D>),
    depth: f64,
) -> (Vector<D>, Vector<D>) {
    let (mut lower, mut upper) = extent;
    for axis in 0..D {
        match domain.axes[axis] {
            AxisBoundary::Periodic { lower: start, upper: end } => (lower[axis], upper[axis]) = (start, end),
            AxisBoundary::Mirror { lower: start, upper: end } => {
                lower[axis] = start.unwrap_or(lower[axis]);
                upper[axis] = end.unwrap_or(upper[axis]);
            }
            AxisBoundary::Open => {}
        }
        for wall in walls.iter().filter(|wall| wall.axis == axis) {
            if wall.side > 0.0 {
                lower[axis] = wall.surface - depth;
            } else {
                upper[axis] = wall.surface + depth;
            }
        }
    }
    (lower, upper)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_periodic_bed_has_its_first_row_half_a_spacing_below() {
        let axes = [AxisBoundary::Periodic { lower: 0.0, upper: 1.0 }, AxisBoundary::Open];
        let bed = Wall::<2>::still(1, 0.0, 1.0);
        let extent = (Vector::<2>::new(0.0, 0.0), Vector::<2>::new(1.0, 2.0));
        let particles = fill(&[bed], &Domain { axes }, extent, 0.1, 4);
        assert_eq!(particles.len(), 40);
        let top = particles.iter().map(|p| p.position[1]).fold(f64::NEG_INFINITY, f64::max);
        assert!((top + 0.05).abs() < 1e-12);
    }

    #[test]
    fn rows_reach_as_far_as_the_kernel_and_one_spacing_more() {
        for ratio in [1.2, 1.3, 1.5, 2.0] {
            let beyond = rows(ratio) as f64 - crate::kernel::SUPPORT * ratio;
            assert!((1.0..2.0).contains(&beyond), "{beyond} rows more than h/Δ = {ratio} asks for");
        }
    }

    #[test]
    fn a_corner_is_filled_and_belongs_to_the_nearest_surface() {
        let bed = Wall::<2>::still(1, 0.0, 1.0);
        let left = Wall::<2>::still(0, 0.0, 1.0);
        let extent = (Vector::<2>::zeros(), Vector::<2>::new(1.0, 1.0));
        let particles = fill(&[bed, left], &Domain { axes: [AxisBoundary::Open; 2] }, extent, 0.1, 3);
        // 13 × 13 cells less the 10 × 10 of the flow
        assert_eq!(particles.len(), 69);
        let deep = particles.iter().find(|p| (p.position - Vector::<2>::new(-0.25, -0.05)).norm() < 1e-9);
        assert_eq!(deep.map(|p| p.wall), Some(0));
    }
}
