//! Prediction intervals of run-out and height in a scene of grains, from the errors of validated flows.

use super::flow::Dimension;
use super::measure::DepthGauge;
use super::setting::{SceneBody, SceneWall, vector};
use super::{SceneFlow, SceneObservation};
use crate::evidence::{ValidationSet, WAY_OF_FRONT};
use crate::metric::{FlowRegime, PredictionInterval};
use crate::setup::front::FrontLine;

/// Root mean square of the speed at the end over √(g h) above which a front is still on its way `[-]`.
const AT_REST: f64 = 0.01;
/// Least cosine of the angle between gravity and the direction of a height `[-]`.
const PARALLEL: f64 = 0.99;
/// The quantity that columns' heights are compared by.
const FINAL_HEIGHT: &str = "final_height";

/// Distance of a depth gauge from the back of a body over the body's length up to which it measures the height there `[-]`.
const AT_THE_BACK: f64 = 0.2;

/// A body of grains that collapses along a line.
struct Column {
    regime: FlowRegime,
    /// Height across the line `[m]`.
    height: f64,
    /// Back and its front at the start, from the line's `[m]`.
    back: f64,
    front: f64,
}

/// The body that a front along a line comes from, which stood at a place `[m]` at the start. None for liquids, for scenes that are fed, for
/// bodies that are thrown or stand on no wall at rest, and for several bodies, of which nothing of the kind was measured.
fn column<S: Dimension<D>, const D: usize>(
    parameters: &SceneFlow<S, D>,
    data: &SceneObservation<D>,
    line: &FrontLine<D>,
    front: f64,
) -> Option<Column> {
    let diameter = parameters.material.grain_diameter()?;
    let [body] = &parameters.bodies[..] else { return None };
    let holds = parameters.doubtful_yield().is_none();
    let stands = body.velocity().norm() == 0.0 && parameters.walls.iter().any(|wall| wall.motion().is_rest());
    if !stands || !parameters.inlets.is_empty() || parameters.material.pore_liquid().is_some() || !holds {
        return None;
    }
    let gravity = vector::<D>(&parameters.gravity).norm();
    let (along, down) = ((line.to - line.from).normalize(), parameters.down());
    let normal = -(down - along * down.dot(&along)).normalize();
    let (low, high) = body.span(&normal);
    let height = high - low;
    let back = (body.span(&along).0 - line.from.dot(&along)).max(0.0);
    let speed = data.rms_speed.iter().copied().fold(0.0, f64::max);
    let aspect_ratio = height / (front - back);
    let regime = FlowRegime {
        aspect_ratio: Some(aspect_ratio).filter(|ratio| body.is_box() && *ratio > 0.0 && ratio.is_finite()),
        slope_angle: Some(libm::asin(along.dot(&down).clamp(-1.0, 1.0)).to_degrees()),
        ..FlowRegime::default()
    }
    .of_grains(Some(diameter), height, speed, gravity);
    Some(Column { regime, height, back, front })
}

/// Warning for the interval of a flow that still moves at the end.
fn unfinished<S: Dimension<D>, const D: usize>(
    parameters: &SceneFlow<S, D>,
    data: &SceneObservation<D>,
    column: &Column,
) -> Option<String> {
    let fall = (vector::<D>(&parameters.gravity).norm() * column.height).sqrt();
    let moves = data.rms_speed.last().is_none_or(|speed| *speed > AT_REST * fall);
    moves.then(|| "the material still moves at the end: this is no deposit yet".to_owned())
}

/// The interval of a front along a line, from its series `[m]`: that of the way from where it stood.
pub(super) fn of_front<S: Dimension<D>, const D: usize>(
    parameters: &SceneFlow<S, D>,
    data: &SceneObservation<D>,
    line: &FrontLine<D>,
    series: &[f64],
) -> Option<PredictionInterval> {
    let (first, last) = (*series.first()?, *series.last().filter(|last| last.is_finite())?);
    let column = column(parameters, data, line, first)?;
    let way = last - column.front;
    if way.is_nan() || way <= parameters.spacing {
        return None;
    }
    let mut found = ValidationSet::shipped().predict(&WAY_OF_FRONT, column.regime, way)?;
    (found.lower, found.upper) = (first + found.lower, first + found.upper);
    found.warnings.extend(unfinished(parameters, data, &column));
    if last >= (line.to - line.from).norm() - parameters.spacing {
        found.warnings.push("the front has reached the end of the gauge's line".to_owned());
    }
    Some(found)
}

/// The interval of a thickness `[m]` along gravity at the back of a body whose front another gauge follows: that of the final height.
pub(super) fn of_depth<S: Dimension<D>, const D: usize>(
    parameters: &SceneFlow<S, D>,
    data: &SceneObservation<D>,
    depth: &DepthGauge<D>,
    (line, fronts): (&FrontLine<D>, &[f64]),
    value: f64,
) -> Option<PredictionInterval> {
    let column = column(parameters, data, line, *fronts.first()?)?;
    let along = (line.to - line.from).normalize();
    let place = (depth.at - line.from).dot(&along);
    let is_back = (place - column.back).abs() <= AT_THE_BACK * (column.front - column.back);
    if !is_back || depth.direction.dot(&parameters.down()).abs() < PARALLEL || value.is_nan() {
        return None;
    }
    let mut found = ValidationSet::shipped().predict(&[FINAL_HEIGHT], column.regime, value)?;
    found.warnings.extend(unfinished(parameters, data, &column));
    Some(found)
}
