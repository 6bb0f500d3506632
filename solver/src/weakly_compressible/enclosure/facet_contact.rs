//! Contact with facet walls: a particle within half a spacing may not approach further, wherever it is on the wall. A particle behind
//! a wall has passed it. A particle that passes an edge of a wall is stopped only if its straight way would meet the wall: an edge that
//! kept every particle half a spacing away would narrow an opening by a spacing.

use super::facet::Facet;
use super::facet_grid::FacetGrid;
use super::facet_side::{FacetSide, facet_side};
use super::facet_wall::FacetWall;
use super::pose::Pose;
use crate::domain::Domain;
use crate::lanes::LANES;
use crate::parallel::prelude::*;
use crate::vector::Vector;
use crate::weakly_compressible::energy::{PushCause, PushStep};
use crate::weakly_compressible::passes::shell_impulse::WallImpulse;
use crate::weakly_compressible::{BLOCK, EnergyLedger, Model, Particles, Surface};

/// Sweeps over the facets that are touched; a corner of two or three walls seldom needs more, and one that does
/// brings to a stop.
const SWEEPS: usize = 4;
/// Largest speed of approach after a sweep, over the speed of the particle `[-]`: rounding.
const ROUNDING: f64 = 1e-12;
/// Largest excess of the distance of a touched rim over the nearest, relative to it `[-]`.
const TIE: f64 = 1e-9;

/// Facet walls in a step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Touch<'a, const D: usize> {
    pub(super) domain: &'a Domain<D>,
    pub(super) walls: &'a [FacetWall<D>],
    /// Grids to find their facets by, wall by wall.
    pub(super) grids: &'a [FacetGrid<D>],
    /// Pose of each wall.
    pub(super) poses: &'a [Pose<D>],
    /// Mean velocity `[m/s]` and rate `[rad/s]` of each in the step.
    pub(super) velocities: &'a [(Vector<D>, f64)],
    /// Distance within which a particle is touched `[m]`.
    pub(super) range: f64,
    /// Friction of rough ones `[-]`.
    pub(super) friction: f64,
}

/// A particle behind a facet wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Passed {
    /// The wall among all.
    pub(super) wall: usize,
    /// Distance, negative `[m]`.
    pub(super) distance: f64,
}

/// Facets that are nearest to a particle.
#[derive(Debug, Clone, Copy)]
struct Rim {
    /// Distance up to which a facet is one of them `[m]`.
    least: f64,
    /// Largest height over any of them `[m]`: negative where a wall ends and the particle is behind it.
    height: f64,
}

/// A facet that is touched.
struct Contact<const D: usize> {
    wall: usize,
    /// From the wall to the particle `[-]`.
    normal: Vector<D>,
}

impl<'a, const D: usize> Touch<'a, D> {
    /// Facets whose boxes hold a place, with their wall and the place in the wall's frame.
    fn near(self, position: Vector<D>) -> impl Iterator<Item = (usize, &'a Facet<D>, Vector<D>)> + Clone {
        self.walls.iter().enumerate().flat_map(move |(k, wall)| {
            let turns = wall.motion.turn.is_some();
            let image = |way| if turns { self.domain.shortest(way) } else { way };
            let mut place = self.poses[k].back(&position, image);
            if !wall.motion.is_rest() {
                self.domain.wrap(&mut place);
            }
            let near = move |facet: &&Facet<D>| facet.may_reach(&place, self.range);
            let listed = self.grids[k].near(&place).iter().map(|&index| &wall.facets[index as usize]);
            listed.filter(near).map(move |facet| (k, facet, place))
        })
    }

    /// Velocity of a wall at a place `[m/s]`.
    fn wall_velocity(self, wall: usize, place: &Vector<D>) -> Vector<D> {
        let (velocity, rate) = self.velocities[wall];
        velocity + self.poses[wall].lever(place) * rate
    }

    /// Stops the approach of a particle to all facet walls and rubs it, as plane walls do. `book` gets the change of velocity
    /// `[m/s]` that each facet wall causes. Returns the whole change.
    ///
    /// # Errors
    /// The facet wall that the particle is behind of.
    pub(super) fn respond(
        self,
        position: &Vector<D>,
        velocity: &Vector<D>,
        mut book: impl FnMut(usize, Vector<D>),
    ) -> Result<Vector<D>, Passed> {
        let mut change = Vector::zeros();
        let near = self.near(*position);
        let Some(FacetSide { distance, facet }) = facet_side(near.clone().map(|(_, facet, place)| (facet, place)))
        else {
            return Ok(change);
        };
        if distance < 0.0 && -distance < self.range {
            let wall = near.clone().nth(facet).map_or(0, |(wall, ..)| wall);
            return Err(Passed { wall, distance });
        }
        if distance.abs() >= self.range {
            return Ok(change);
        }
        let least = distance * (1.0 + TIE);
        let nearest = near.clone().filter(|(_, facet, place)| (place - facet.nearest(place)).norm() <= least);
        let height = nearest.map(|(_, facet, place)| facet.height(&place)).fold(f64::NEG_INFINITY, f64::max);
        let rim = Rim { least, height };
        for sweep in 0..=SWEEPS {
            let mut approached = false;
            for (wall, facet, place) in near.clone() {
                let relative = velocity + change - self.wall_velocity(wall, position);
                let Some(contact) = self.contact(wall, facet, (&place, &relative), rim) else { continue };
                let approach = relative.dot(&contact.normal);
                if approach < 0.0 && (sweep == 0 || -approach > ROUNDING * velocity.norm()) {
                    approached = true;
                    // the last sweep: a corner too narrow to slide in
                    let push = if sweep == SWEEPS { -relative } else { self.push(&contact, &relative, -approach) };
                    change += push;
                    book(wall, push);
                }
            }
            if !approached {
                break;
            }
        }
        Ok(change)
    }

    /// The contact with a facet of a particle at a place with a velocity relative to it: on its face along its normal, at its rim only where
    /// nothing is nearer, and unless the particle is behind all facets there only where it moves onto the face.
    fn contact(
        self,
        wall: usize,
        facet: &Facet<D>,
        (place, relative): (&Vector<D>, &Vector<D>),
        rim: Rim,
    ) -> Option<Contact<D>> {
        let way = place - facet.nearest(place);
        let (distance, height) = (way.norm(), facet.height(place));
        if distance >= self.range {
            return None;
        }
        let on_its_face = height.abs() >= (1.0 - TIE) * distance;
        let pose = &self.poses[wall];
        if on_its_face {
            return (height >= 0.0).then(|| Contact { wall, normal: pose.direction(&facet.normal) });
        }
        let meets = || self.meets(facet, place, &pose.direction_back(relative));
        let touched = distance <= rim.least && (rim.height < 0.0 || meets());
        touched.then(|| Contact { wall, normal: pose.direction(&(way / distance)) })
    }

    /// Whether a particle in front of a facet meets its face on a straight way within the range.
    fn meets(self, facet: &Facet<D>, place: &Vector<D>, relative: &Vector<D>) -> bool {
        let (height, approach) = (facet.height(place), -relative.dot(&facet.normal));
        if height < 0.0 || approach <= 0.0 {
            return false;
        }
        let met = place + relative * (height / approach);
        (met - place).norm() < self.range && (met - facet.nearest(&met)).norm() <= TIE * self.range
    }

    /// Change of velocity that ends an approach `[m/s]` and rubs along the wall.
    fn push(self, contact: &Contact<D>, relative: &Vector<D>, approach: f64) -> Vector<D> {
        let rough = self.walls[contact.wall].roughness == Surface::Rough;
        let friction = if rough { self.friction } else { 0.0 };
        let tangential = relative + contact.normal * approach;
        let speed = tangential.norm();
        let rubbed =
            if speed > 0.0 { tangential * ((friction * approach).min(speed) / speed) } else { Vector::zeros() };
        contact.normal * approach - rubbed
    }
}

/// Extremes among the contacts of a block.
#[derive(Debug, Clone, Copy)]
pub(super) struct Extremes {
    /// Largest speed squared of a particle that was touched `[m²/s²]`.
    pub(super) largest: f64,
    /// The first particle that was found behind a facet wall.
    pub(super) passed: Option<(usize, Passed)>,
}

/// Stops particles that approach a facet wall, after the velocities have been stepped. Adds the impulses, block by block of flow particles
/// and in each wall by wall `[kg m/s]`.
pub(super) fn run<const D: usize>(
    model: &Model<D>,
    particles: &mut Particles<D>,
    energy: &mut [EnergyLedger],
    touch: Touch<'_, D>,
    time_step: f64,
    impulses: &mut [WallImpulse<D>],
) -> Extremes {
    let flow = particles.flow_count();
    let (position, mass, acceleration) = (&particles.position[..flow], &particles.mass, &particles.acceleration);
    let (by_walls, by_damping, by_wall_control) =
        (&particles.by_walls, &particles.by_damping, &particles.by_wall_control);
    (
        particles.velocity[..flow].par_chunks_mut(BLOCK),
        particles.support_impulse.par_chunks_mut(BLOCK),
        energy,
        impulses.par_chunks_mut(touch.walls.len()),
    )
        .enumerate()
        .with_min_len(16)
        .map(|(block, (velocities, support_impulses, energy, out))| {
            let mut extremes = Extremes { largest: 0.0, passed: None };
            for (offset, (velocity, support_impulse)) in velocities.iter_mut().zip(support_impulses).enumerate() {
                let index = block * BLOCK + offset;
                if model.list.group(index / LANES).wall.raw().is_empty() {
                    continue;
                }
                let mass = mass[index];
                // work of the walls by moving
                let mut given = 0.0;
                let book = |wall: usize, push: Vector<D>| {
                    out[wall].add(push * mass, &touch.poses[wall].lever(&position[index]));
                    given += mass * push.dot(&touch.wall_velocity(wall, &position[index]));
                };
                match touch.respond(&position[index], velocity, book) {
                    Ok(push) => {
                        PushStep {
                            mass,
                            time_step,
                            gravity: &model.gravity,
                            velocity: *velocity,
                            push,
                            given,
                            acceleration: &acceleration[index],
                            by_walls: &by_walls[index],
                            by_damping: &by_damping[index],
                            by_wall_control: &by_wall_control[index],
                        }
                        .add_to(energy, PushCause::Contact);
                        *velocity += push;
                        *support_impulse += push * mass;
                        extremes.largest = extremes.largest.max(velocity.norm_squared());
                    }
                    Err(passed) => extremes.passed = extremes.passed.or(Some((index, passed))),
                }
            }
            extremes
        })
        .reduce(
            || Extremes { largest: 0.0, passed: None },
            |a, b| Extremes {
                largest: a.largest.max(b.largest),
                passed: match (a.passed, b.passed) {
                    (Some(first), Some(second)) => Some(if second.0 < first.0 { second } else { first }),
                    (first, second) => first.or(second),
                },
            },
        )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::domain::AxisBoundary;
    use crate::weakly_compressible::enclosure::facet_wall::Side;

    fn polyline(points: &[[f64; 2]]) -> Vec<FacetWall<2>> {
        let points: Vec<_> = points.iter().map(|&point| point.into()).collect();
        vec![FacetWall::polyline("wall", &points, Side::Left)]
    }

    fn after(walls: &[FacetWall<2>], place: [f64; 2], velocity: [f64; 2]) -> Result<Vector<2>, Passed> {
        let poses = vec![Pose::start(); walls.len()];
        let grids: Vec<_> = walls.iter().map(|wall| FacetGrid::new(&wall.facets, 0.5)).collect();
        let touch = Touch {
            domain: &Domain { axes: [AxisBoundary::Open; 2] },
            walls,
            grids: &grids,
            poses: &poses,
            velocities: &vec![(Vector::zeros(), 0.0); walls.len()],
            range: 0.5,
            friction: 0.4,
        };
        let mut booked = Vector::<2>::zeros();
        let velocity = Vector::from(velocity);
        let change = touch.respond(&place.into(), &velocity, |_, push| booked += push)?;
        assert!((booked - change).norm() < 1e-12);
        Ok(velocity + change)
    }

    #[test]
    fn a_straight_wall_of_segments_stops_and_rubs_as_a_plane_one() {
        let bed = polyline(&[[-3.0, 0.0], [-0.2, 0.0], [0.1, 0.0], [3.0, 0.0]]);
        for x in [-1.0, -0.25, -0.2, 0.0, 0.1, 0.3] {
            let found = after(&bed, [x, 0.3], [2.0, -1.0]).expect("in front");
            assert!((found - Vector::<2>::new(1.6, 0.0)).norm() < 1e-15, "{found} at {x}");
            assert!(after(&bed, [x, 0.3], [2.0, 1.0]).expect("in front") == Vector::<2>::new(2.0, 1.0));
            assert!(after(&bed, [x, 0.6], [2.0, -1.0]).expect("in front") == Vector::<2>::new(2.0, -1.0));
        }
        let passed = after(&bed, [0.4, -0.1], [0.0, 1.0]).expect_err("behind");
        assert!((passed.distance + 0.1).abs() < 1e-15 && passed.wall == 0);
    }

    #[test]
    fn nothing_moves_on_into_a_narrow_corner_or_a_sharp_edge() {
        let (cos, sin) = (15_f64.to_radians().cos(), 15_f64.to_radians().sin());
        let trough = [[-9.0 * cos, -9.0 * sin], [0.0, 0.0], [-9.0 * cos, 9.0 * sin]];
        for (y, velocity) in [(0.0, [10.0, 0.0]), (0.05, [10.0, 3.0]), (-0.1, [7.0, -7.0])] {
            let found = after(&polyline(&trough), [-0.8, y], velocity).expect("between the walls");
            for normal in [[-sin, cos], [-sin, -cos]].map(Vector::<2>::from) {
                assert!(found.dot(&normal) > -1e-9, "{found} from {velocity:?}");
            }
        }
        let edge: Vec<_> = trough.iter().rev().copied().collect();
        let found = after(&polyline(&edge), [0.3, 0.0], [-10.0, 0.0]).expect("before the edge");
        assert!(found.norm() < 1e-12, "{found}");
        assert!(after(&polyline(&edge), [-0.3, 0.0], [0.0, 0.0]).is_err());
    }

    #[test]
    fn a_particle_that_passes_the_edge_of_an_opening_is_not_stopped() {
        // a floor whose edge falls off to the left
        let lip = polyline(&[[0.0, -2.0], [0.0, 0.0], [2.0, 0.0]]);
        let passing = [[-1.0, -1.0], [0.1, -1.0], [1.0, 0.1]].map(|velocity| (velocity, false));
        for (velocity, stopped) in passing.into_iter().chain([([1.0, -1.0], true), ([1.0, -0.3], true)]) {
            let found = after(&lip, [-0.1, 0.05], velocity).expect("in front");
            assert_eq!(found != Vector::from(velocity), stopped, "{found} from {velocity:?}");
        }
    }
}
