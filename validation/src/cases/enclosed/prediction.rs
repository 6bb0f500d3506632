//! Where the run-out of a scene truly lies, by how far the run-outs of measured flows were off.

use super::parameters::Setting;
use super::setting::{SceneBody, vector};
use super::{SceneObservation, SceneParameters};
use crate::cases::front::FrontLine;
use crate::metric::{FlowRegime, PredictionInterval};
use crate::reference::{ValidationSet, WAY_OF_FRONT};
use bagnold_solver::vector::Vector;

/// Root mean square of the speed at the end over √(g h) above which a front is still on its way `[-]`.
const AT_REST: f64 = 0.01;

/// The interval of a front along a line, from its series `[m]`: that of the way from where it stood. None for liquids, for scenes that are
/// fed, and for several bodies, of which nothing of the kind was measured.
pub(super) fn of_front<S: Setting<D>, const D: usize>(
    parameters: &SceneParameters<S, D>,
    data: &SceneObservation<D>,
    line: &FrontLine<D>,
    series: &[f64],
) -> Option<PredictionInterval> {
    let diameter = parameters.material.grain_diameter()?;
    let [body] = &parameters.bodies[..] else { return None };
    let (first, last) = (*series.first()?, *series.last()?);
    let way = last - first;
    if !parameters.inlets.is_empty() || way <= parameters.spacing {
        return None;
    }
    let gravity = vector::<D>(&parameters.gravity).norm();
    let (along, down) = ((line.to - line.from).normalize(), parameters.down());
    let normal = -(down - along * down.dot(&along)).normalize();
    let (low, high) = span(body, &normal);
    let height = high - low;
    let back = (span(body, &along).0 - line.from.dot(&along)).max(0.0);
    let length = first - back;
    let speed = data.rms_speed.iter().copied().fold(0.0, f64::max);
    let regime = FlowRegime {
        aspect_ratio: Some(height / length).filter(|ratio| body.is_box() && *ratio > 0.0 && ratio.is_finite()),
        slope_angle: Some(libm::asin(along.dot(&down).clamp(-1.0, 1.0)).to_degrees()),
        ..FlowRegime::default()
    }
    .of_grains(Some(diameter), height, speed, gravity);
    let mut found = ValidationSet::shipped().predict(&WAY_OF_FRONT, regime, way)?;
    (found.lower, found.upper) = (first + found.lower, first + found.upper);
    if data.rms_speed.last().is_none_or(|speed| *speed > AT_REST * (gravity * height).sqrt()) {
        found.warnings.push("the material still moves at the end: its front is not at rest yet".to_owned());
    }
    if last >= (line.to - line.from).norm() - parameters.spacing {
        found.warnings.push("the front has reached the end of the gauge's line".to_owned());
    }
    Some(found)
}

/// Least and greatest place of a body's box along a direction `[m]`.
fn span<const D: usize>(body: &impl SceneBody<D>, direction: &Vector<D>) -> (f64, f64) {
    let (lower, upper) = body.extent();
    let (one, other) = (direction.component_mul(&lower), direction.component_mul(&upper));
    (one.inf(&other).sum(), one.sup(&other).sum())
}
