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

/// Two segments of a polyline that cross, each by the number of its first corner; segments that touch do not.
pub(crate) fn crossing(corners: &[Vector<2>], closed: bool) -> Option<(usize, usize)> {
    let corner = |k: usize| corners[k % corners.len()];
    let count = if closed { corners.len() } else { corners.len().saturating_sub(1) };
    let end = |k: usize| corner(k).sup(&corner(k + 1))[0];
    let start = |k: usize| corner(k).inf(&corner(k + 1))[0];
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|one, other| start(*one).total_cmp(&start(*other)));
    // whether the ends of one lie on both sides of the other, by more than rounding
    let parts = |one: usize, other: usize| {
        let (from, along) = (corner(one), corner(one + 1) - corner(one));
        let height = |place: Vector<2>| along.perp(&(place - from)) / along.norm() / (place - from).norm();
        let (first, second) = (height(corner(other)), height(corner(other + 1)));
        first.abs().min(second.abs()) > 1e-9 && first * second < 0.0
    };
    order.iter().enumerate().find_map(|(place, &one)| {
        let near = order[place + 1..].iter().take_while(|other| start(**other) <= end(one));
        near.copied()
            .find(|&other| parts(one, other) && parts(other, one))
            .map(|other| (one.min(other), one.max(other)))
    })
}

/// Lower and upper corner of the box around some places `[m]`; without places it is infinite and inside out.
pub(crate) fn around<const D: usize>(places: impl IntoIterator<Item = Vector<D>>) -> (Vector<D>, Vector<D>) {
    let none = (Vector::<D>::repeat(f64::INFINITY), Vector::<D>::repeat(f64::NEG_INFINITY));
    places.into_iter().fold(none, |(lower, upper), place| (lower.inf(&place), upper.sup(&place)))
}
