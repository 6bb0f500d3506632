//! What gauges measure, whatever the number of axes.

use crate::cases::front::{FrontLine, volumes};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::simulation::Simulation;
use bagnold_solver::weakly_compressible::snapshot::Snapshot;

/// What a gauge measures.
#[derive(Debug, Clone, PartialEq)]
pub enum Measurand<'a, const D: usize> {
    /// How far the material reaches.
    Front(FrontLine<D>),
    /// Thickness of the material along gravity.
    Depth(DepthGauge<D>),
    /// Force of the flow on a wall.
    Force {
        /// Name of the wall.
        wall: &'a str,
    },
    /// Mass that crosses an opening.
    Flux(Opening<D>),
}

/// A place around which the material's thickness along gravity is measured: its volume within a width, over the section.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthGauge<const D: usize> {
    /// The place `[m]`.
    pub at: Vector<D>,
    /// The unit vector along gravity `[-]`.
    pub down: Vector<D>,
    /// Width across gravity `[m]`: in space the diameter of a circle.
    pub width: f64,
    /// What is measured across gravity: in the plane the width `[m]`, in space the circle's area `[m²]`.
    pub section: f64,
}

impl<const D: usize> DepthGauge<D> {
    /// The thickness `[m]`.
    pub(super) fn thickness(&self, snapshot: &Snapshot<D>) -> f64 {
        let inside = |place: Vector<D>| {
            let way = place - self.at;
            ((way - self.down * way.dot(&self.down)).norm() < 0.5 * self.width).then_some(0)
        };
        volumes(snapshot, inside).first().copied().unwrap_or(0.0) / self.section
    }
}

/// An opening that mass crosses: a line in the plane, a parallelogram in space.
#[derive(Debug, Clone, PartialEq)]
pub struct Opening<const D: usize> {
    /// A corner `[m]`.
    pub corner: Vector<D>,
    /// Across it, to where what crosses counts; of any length.
    pub normal: Vector<D>,
    /// Coordinates along the edges that begin at the corner, each as a vector and a divisor: what lies r from the corner has
    /// the coordinate r·vector/divisor, which is from 0 to 1 within the opening.
    pub edges: Vec<(Vector<D>, f64)>,
}

impl<const D: usize> Opening<D> {
    /// Mass `[kg]`, in the plane `[kg/m]`, that has crossed it along its normal since particles were at the places `before`,
    /// less what went back.
    pub(super) fn crossed(&self, simulation: &Simulation<D>, before: &[Vector<D>]) -> f64 {
        let particles = simulation.particles();
        let side = |place: &Vector<D>| self.normal.dot(&(place - self.corner));
        let mut sum = 0.0;
        for index in particles.by_identity() {
            let Some(&start) = before.get(particles.identity[index] as usize) else { continue };
            let end = particles.position[index];
            let (first, last) = (side(&start), side(&end));
            if (first < 0.0) == (last < 0.0) || first.is_nan() {
                continue;
            }
            let met = start + (end - start) * (first / (first - last)) - self.corner;
            if self.edges.iter().all(|(vector, divisor)| (0.0..=1.0).contains(&(met.dot(vector) / divisor))) {
                sum += particles.mass[index] * if last >= 0.0 { 1.0 } else { -1.0 };
            }
        }
        sum
    }
}
