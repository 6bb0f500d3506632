//! Boxes along the axes and balls, in as many dimensions as there are.

use bagnold_solver::vector::Vector;

/// Whether a box has an inside.
pub(crate) fn has_inside<const D: usize>(lower: &Vector<D>, upper: &Vector<D>) -> bool {
    (upper - lower).iter().all(|edge| *edge > 0.0)
}

/// Area of a box `[m²]` in the plane, its volume `[m³]` in space.
pub(crate) fn box_volume<const D: usize>(lower: &Vector<D>, upper: &Vector<D>) -> f64 {
    (upper - lower).iter().product()
}

/// Whether a box holds a place; its upper faces are those of what is beyond.
pub(crate) fn box_holds<const D: usize>(lower: &Vector<D>, upper: &Vector<D>, place: &Vector<D>) -> bool {
    (0..D).all(|axis| place[axis] >= lower[axis] && place[axis] < upper[axis])
}

/// Whether a ball, in the plane a disc, holds a place.
pub(crate) fn ball_holds<const D: usize>(centre: &Vector<D>, radius: f64, place: &Vector<D>) -> bool {
    (place - centre).norm_squared() <= radius * radius
}

/// Lower and upper corner of the box around a ball `[m]`.
pub(crate) fn around_ball<const D: usize>(centre: &Vector<D>, radius: f64) -> (Vector<D>, Vector<D>) {
    (centre - Vector::<D>::repeat(radius), centre + Vector::<D>::repeat(radius))
}

/// Lower and upper corner of the box around some places `[m]`; without places it is infinite and inside out.
pub(crate) fn around<const D: usize>(places: impl IntoIterator<Item = Vector<D>>) -> (Vector<D>, Vector<D>) {
    let none = (Vector::<D>::repeat(f64::INFINITY), Vector::<D>::repeat(f64::NEG_INFINITY));
    places.into_iter().fold(none, |(lower, upper), place| (lower.inf(&place), upper.sup(&place)))
}
