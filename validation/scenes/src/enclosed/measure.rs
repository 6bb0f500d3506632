//! Measurands of gauges, for any number of axes.

use super::periods::Periods;
use super::shapes;
use crate::output::ABSENT;
use crate::setup::front::FrontLine;
use bagnold_solver::material::equation_of_state::Tension;
use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::simulation::Simulation;
use bagnold_solver::weakly_compressible::snapshot::Snapshot;

/// Places by which a particle's cell is divided at the rim of what is measured.
const PLACES: usize = 256;
/// Condition number of the spread of a probe's particles from which on no line is fitted `[-]`: around a surface it is near 10.
const IN_A_LINE: f64 = 1e3;
/// Component of an opening's normal along an axis that counts as none `[-]`.
const IN_PLANE: f64 = 1e-9;

/// Measurand of a gauge.
#[derive(Debug, Clone, PartialEq)]
pub enum Measurand<'a, const D: usize> {
    /// Front position of the material along a line.
    Front(FrontLine<D>),
    /// Thickness of the material along a direction.
    Depth(DepthGauge<D>),
    /// Velocity and pressures at a place.
    Probe(Probe<D>),
    /// Force of the flow on the wall of this name.
    Force(&'a str),
    /// Displacement of the wall of this name since the start.
    Position(&'a str),
    /// Torque of the flow on the wall of this name, which turns, about its axis, and its angle.
    Turn(&'a str),
    /// Mass that crosses an opening.
    Flux(Opening<D>),
}

/// A place around which the material's thickness along a direction is measured: its volume within a width, over the section.
#[derive(Debug, Clone, PartialEq)]
pub struct DepthGauge<const D: usize> {
    /// The place `[m]`.
    pub at: Vector<D>,
    /// The unit vector along which it is measured `[-]`.
    pub direction: Vector<D>,
    /// Width across the direction `[m]`: in space the diameter of a circle.
    pub width: f64,
    /// Section across the direction: in the plane the width `[m]`, in space the circle's area `[m²]`.
    pub section: f64,
}

impl<const D: usize> DepthGauge<D> {
    /// The thickness `[m]` of particles at a `spacing` `[m]`, each of which fills its cell of that edge; what repeats itself
    /// beyond periodic sides is met there too.
    pub(super) fn thickness(&self, spacing: f64, periods: &Periods<D>, snapshot: &Snapshot<D>) -> f64 {
        let extent = shapes::around(snapshot.position.iter().copied());
        let images = periods.images(periods.reach(&self.at, &self.direction, 0.5 * self.width, &extent));
        let cell: Vec<Vector<D>> = places_in_a_cell(spacing).iter().map(|part| self.across(part)).collect();
        let mut volume = 0.0;
        for ((place, mass), density) in snapshot.position.iter().zip(&snapshot.mass).zip(&snapshot.density) {
            let shares = images.iter().map(|way| self.share_inside(&(place + way), spacing, &cell));
            volume += shares.sum::<f64>() * mass / density;
        }
        volume / self.section
    }

    /// Share of a cell around a place that is nearer to the line through `at` than half the width `[-]`; of the places that
    /// fill the cell, the parts across the line are given.
    fn share_inside(&self, place: &Vector<D>, spacing: f64, cell: &[Vector<D>]) -> f64 {
        let (way, half) = (self.across(&(place - self.at)), 0.5 * self.width);
        let (from_rim, reach) = (way.norm() - half, 0.5 * spacing * (D as f64).sqrt());
        if from_rim.abs() >= reach {
            return if from_rim < 0.0 { 1.0 } else { 0.0 };
        }
        let mut inside = 0;
        for part in cell {
            // plain numbers: a development build optimises nothing here
            let mut square = 0.0;
            for (way, part) in way.as_slice().iter().zip(part.as_slice()) {
                square += (way + part) * (way + part);
            }
            inside += usize::from(square < half * half);
        }
        inside as f64 / cell.len() as f64
    }

    /// The part of a way across the direction `[m]`.
    fn across(&self, way: &Vector<D>) -> Vector<D> {
        way - self.direction * way.dot(&self.direction)
    }
}

/// A place at which velocity and pressures are measured.
#[derive(Debug, Clone, PartialEq)]
pub struct Probe<const D: usize> {
    /// The place `[m]`.
    pub at: Vector<D>,
    /// Distance within which particles count, in spacings `[-]`.
    pub reach: f64,
}

impl<const D: usize> Probe<D> {
    /// Pressure and pore pressure `[Pa]` and velocity `[m/s]` at the place, where the law's field is one: linear least squares with the weight 1 − r²/R².
    /// [`ABSENT`] without particles. Where tension is cut, the line is not continued below zero pressure.
    pub(super) fn values(&self, simulation: &Simulation<D>, periods: &Periods<D>, snapshot: &Snapshot<D>) -> Vec<f64> {
        let radius = self.reach * simulation.spacing();
        let is_wet = simulation.rheology().pore_liquid().is_some();
        let images = periods.images([1; D]);
        let near = |index: usize| {
            let ways = images.iter().map(move |way| snapshot.position[index] + way - self.at);
            ways.map(move |way| (index, way, 1.0 - way.norm_squared() / (radius * radius)))
        };
        let near: Vec<_> = (0..snapshot.position.len()).flat_map(near).filter(|(.., weight)| *weight > 0.0).collect();
        let total: f64 = near.iter().map(|(.., weight)| weight).sum();
        if near.is_empty() {
            return vec![ABSENT; D + 2];
        }
        let centre = near.iter().map(|(_, way, weight)| way * *weight).sum::<Vector<D>>() / total;
        let spread: Tensor<D> = near
            .iter()
            .map(|(_, way, weight)| (way - centre) * (way - centre).transpose() * *weight)
            .fold(Tensor::zeros(), |sum, part| sum + part);
        // of particles in a line the mean
        let inverse = spread.try_inverse().filter(|inverse| inverse.norm() * spread.norm() < IN_A_LINE);
        let inverse = inverse.unwrap_or_else(Tensor::zeros);
        let fitted = |value: &dyn Fn(usize) -> f64| {
            let mean = near.iter().map(|(index, _, weight)| weight * value(*index)).sum::<f64>() / total;
            let slope: Vector<D> =
                near.iter().map(|(index, way, weight)| (way - centre) * (weight * value(*index))).sum();
            mean - (inverse * slope).dot(&centre)
        };
        let pore = |index: usize| if is_wet { snapshot.field[index] } else { 0.0 };
        let is_cut = simulation.equation_of_state().tension == Tension::Cut && !is_wet;
        let least = if is_cut { 0.0 } else { f64::NEG_INFINITY };
        let pressures = [fitted(&|index| snapshot.pressure[index]).max(least), fitted(&pore)];
        pressures.into_iter().chain((0..D).map(|axis| fitted(&|index| snapshot.velocity[index][axis]))).collect()
    }
}

/// Places that fill a cell of an edge `[m]` evenly, from its middle `[m]`: multiples of the powers of the generalised golden
/// ratio (Roberts 2018), so that they lie in no rows that a rim could run along.
fn places_in_a_cell<const D: usize>(edge: f64) -> Vec<Vector<D>> {
    // the root of x^(D+1) = x + 1
    let ratio = (0..40).fold(1.5, |x: f64, _| libm::pow(1.0 + x, 1.0 / (D as f64 + 1.0)));
    let place = |k: usize| {
        Vector::<D>::from_fn(|axis, _| {
            let turned = 0.5 + k as f64 * libm::pow(ratio, -(axis as f64 + 1.0));
            (turned - turned.floor() - 0.5) * edge
        })
    };
    (1..=PLACES).map(place).collect()
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
    /// Mass `[kg]`, in the plane `[kg/m]`, that has crossed it along its normal since particles were at the places `before`
    /// with the velocities there at the time `last` `[s]`, less what went back. What an inlet has fed since began in its rows. What wraps at periodic sides crosses nothing by that,
    /// and an opening that it meets beyond them is the same opening.
    pub(super) fn crossed(
        &self,
        simulation: &Simulation<D>,
        periods: &Periods<D>,
        before: &[(Vector<D>, Vector<D>)],
        last: f64,
    ) -> f64 {
        let particles = simulation.particles();
        let mut sum = 0.0;
        for index in particles.by_identity() {
            let (identity, now) = (particles.identity[index], particles.velocity[index]);
            let known = before.get(identity as usize).map(|&(start, velocity)| (start, velocity, last));
            let fed = || simulation.entry(identity).map(|(start, time)| (start, now, time));
            let Some((start, velocity, time)) = known.or_else(fed) else { continue };
            let expected = start + (velocity + now) * (0.5 * (simulation.time() - time));
            let (end, turns) = periods.unwrapped(&particles.position[index], &expected);
            let crossings: f64 = if periods.are_any() {
                self.passed_with_images(periods, &start, &end, turns)
            } else {
                self.passed(&start, &end)
            };
            sum += particles.mass[index] * crossings;
        }
        sum
    }

    /// Net number of passages through it or an image on the way from `start` to `end`; backward ones count −1.
    /// Images beside each other in one plane are one opening, however wide it is.
    fn passed_with_images(&self, periods: &Periods<D>, start: &Vector<D>, end: &Vector<D>, turns: [i64; D]) -> f64 {
        let beside = |axis: usize| self.normal[axis].abs() < IN_PLANE * self.normal.norm();
        let reach = turns.map(|turn| turn.abs() + 1);
        let images = |of_plane: bool| {
            periods.images(std::array::from_fn(|axis| if beside(axis) == of_plane { reach[axis] } else { 0 }))
        };
        let planes = images(false).into_iter().map(|way| {
            // images beside each other have one plane, up to rounding
            let (first, last) = (self.side(&(start - way)), self.side(&(end - way)));
            if (first < 0.0) == (last < 0.0) && first.abs().min(last.abs()) > IN_PLANE * self.normal.norm() {
                return 0.0;
            }
            let passed =
                images(true).into_iter().map(|beside| self.passed(&(start - way - beside), &(end - way - beside)));
            passed.into_iter().find(|passed| *passed != 0.0).unwrap_or(0.0)
        });
        planes.sum()
    }

    /// 1 where the way from one place to another leads through it along its normal, −1 against it, 0 elsewhere.
    fn passed(&self, start: &Vector<D>, end: &Vector<D>) -> f64 {
        let (first, last) = (self.side(start), self.side(end));
        if (first < 0.0) == (last < 0.0) || first.is_nan() {
            return 0.0;
        }
        let met = start + (end - start) * (first / (first - last)) - self.corner;
        let is_inside = self.edges.iter().all(|(vector, divisor)| (0.0..=1.0).contains(&(met.dot(vector) / divisor)));
        match (is_inside, last >= 0.0) {
            (true, true) => 1.0,
            (true, false) => -1.0,
            (false, _) => 0.0,
        }
    }

    /// Distance of a place from its plane along the normal, times the normal's length.
    fn side(&self, place: &Vector<D>) -> f64 {
        self.normal.dot(&(place - self.corner))
    }
}
