//! Contact as insurance: a particle closer to a wall than half a spacing may not approach it further.

use super::wall::{Surface, Wall};
use crate::vector::Vector;

/// Stops the approach of a particle to the walls and takes friction `friction` `[-]` times the normal impulse from
/// its tangential velocity. Returns the change of velocity `[m/s]`.
#[inline(always)]
#[must_use]
pub fn impulse<const D: usize>(
    walls: &[Wall<D>],
    position: &Vector<D>,
    velocity: &Vector<D>,
    range: f64,
    friction: f64,
) -> Vector<D> {
    let mut change = Vector::zeros();
    for wall in walls {
        let approach = wall.side * (velocity[wall.axis] + change[wall.axis] - wall.velocity[wall.axis]);
        if wall.distance(position) < range && approach < 0.0 && wall.faces(position) {
            let friction = if wall.roughness == Surface::Rough { friction } else { 0.0 };
            let mut tangential = velocity + change - wall.velocity;
            tangential[wall.axis] = 0.0;
            let speed = tangential.norm();
            if speed > 0.0 {
                change -= tangential * ((friction * -approach).min(speed) / speed);
            }
            change[wall.axis] -= wall.side * approach;
        }
    }
    change
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_approaching_particle_is_stopped_and_rubbed() {
        let bed = Wall::<2>::still(1, 0.0, 1.0);
        let position = Vector::<2>::new(0.0, 0.3);
        let velocity = Vector::<2>::new(2.0, -1.0);
        let after = velocity + impulse(&[bed], &position, &velocity, 0.5, 0.4);
        assert!((after - Vector::<2>::new(1.6, 0.0)).norm() < 1e-15);
        assert_eq!(impulse(&[bed], &position, &Vector::<2>::new(2.0, 1.0), 0.5, 0.4), Vector::<2>::zeros());
        assert_eq!(impulse(&[bed], &Vector::<2>::new(0.0, 0.6), &velocity, 0.5, 0.4), Vector::<2>::zeros());
    }
}
