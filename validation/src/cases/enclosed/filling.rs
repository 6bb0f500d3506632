//! Where particles start: on the sites of a lattice that bodies hold, as dense as the material above them makes them.

use super::behind_walls::{Permissions, Site};
use super::parameters::Setting;
use super::setting::{SceneBody, SceneWall, vector};
use super::sides::SceneSides;
use super::surfaces::{Surfaces, is_taken};
use super::{SceneParameters, shapes};
use crate::case::ParameterError;
use crate::setup::displaced_flow;
use bagnold_solver::material::equation_of_state::EquationOfState;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::scene::Flow;

/// Steps by which depths are felt, a spacing `[-]`.
const STEPS: f64 = 8.0;

impl<S: Setting<D>, const D: usize> SceneParameters<S, D> {
    /// Particles on the sites of a lattice through the origin that bodies hold and that are free of walls, under the
    /// pressure of the material above them; and the share of the sites of bodies that walls take `[-]`.
    ///
    /// # Errors
    /// A body of which walls take more than they may.
    pub(super) fn fill(
        &self,
        walls: &Surfaces<D>,
        equation_of_state: &EquationOfState,
    ) -> Result<(Flow<D>, f64), ParameterError> {
        let Self { spacing, jitter, ref bodies, .. } = *self;
        for remark in misfits(bodies, spacing) {
            tracing::warn!("{remark}");
        }
        let gravity = vector(&self.gravity);
        let (up, weight) = (-gravity.normalize(), equation_of_state.reference_density * gravity.norm());
        let corners = bodies.iter().flat_map(|body| <[Vector<D>; 2]>::from(body.extent()));
        let held = lattice(shapes::around(corners), spacing).filter_map(|(cell, place)| {
            let body = holder(bodies, &place).filter(|_| self.sides.hold(&place))?;
            Some(Site { cell, place, body, nearest: walls.nearest(&place) })
        });
        let sites: Vec<Site<D>> = held.collect();
        let permissions = Permissions {
            walls: self.walls.iter().map(|wall| (wall.name(), wall.may_have_two_sides())).collect(),
            most: self.cut_at_most,
            turn: S::Wall::TURN,
        };
        let behind = permissions.behind(&sites)?;
        let is_free = |site: &Site<D>| !site.nearest.is_some_and(|nearest| is_taken(&nearest, spacing));
        let free: Vec<&Site<D>> = sites
            .iter()
            .zip(&behind)
            .filter(|(site, behind)| !**behind && is_free(site))
            .map(|(site, _)| site)
            .collect();
        let share = (sites.len() - free.len()) as f64 / sites.len() as f64;
        let flow = displaced_flow(
            free.iter().map(|site| site.place),
            (jitter * spacing, self.seed),
            |site| equation_of_state.density(weight * depth(bodies, site, &up, spacing)),
            |density| (0..D).fold(density, |mass, _| mass * spacing),
        );
        Ok((Flow { velocity: free.iter().map(|site| bodies[site.body].velocity()).collect(), ..flow }, share))
    }
}

/// Cells of a lattice through the origin that cover a box, and their middles `[m]`; the first axis runs fastest.
fn lattice<const D: usize>(
    (lower, upper): (Vector<D>, Vector<D>),
    spacing: f64,
) -> impl Iterator<Item = ([i64; D], Vector<D>)> {
    let cell = |coordinate: f64| (coordinate / spacing).floor() as i64;
    let (first, last) = (<[f64; D]>::from(lower).map(cell), <[f64; D]>::from(upper).map(cell));
    let is_empty = (0..D).any(|axis| first[axis] > last[axis]);
    std::iter::successors((!is_empty).then_some(first), move |cells| {
        let mut next = *cells;
        for axis in 0..D {
            if next[axis] < last[axis] {
                next[axis] += 1;
                return Some(next);
            }
            next[axis] = first[axis];
        }
        None
    })
    .map(move |cells| (cells, Vector::<D>::from(cells.map(|cell| cell as f64 + 0.5)) * spacing))
}

/// Share of a body's mass that its particles may have too much or too little before it is said `[-]`.
const MISFIT: f64 = 0.02;

/// What is to be said of bodies that are no whole number of spacings: their particles have another mass than they.
fn misfits<const D: usize>(bodies: &[impl SceneBody<D>], spacing: f64) -> Vec<String> {
    let of_cells = |body: &_| {
        let cells = lattice(SceneBody::extent(body), spacing).filter(|(_, place)| SceneBody::holds(body, place));
        cells.count() as f64 * spacing.powi(D as i32)
    };
    let mut remarks = Vec::new();
    for (number, body) in bodies.iter().enumerate() {
        let share = of_cells(body) / body.volume();
        // a body without a particle is refused elsewhere
        if share > 0.0 && (share - 1.0).abs() > MISFIT {
            remarks.push(format!(
                "`bodies[{number}]`: its particles have {:.1} % of its mass, what the lattice of {spacing} m from the origin holds of it; put plane \
                 faces on whole numbers of spacings, or make the spacing smaller",
                100.0 * share
            ));
        }
    }
    remarks
}

/// The first body that holds a place, if any does, by its place among all.
fn holder<const D: usize>(bodies: &[impl SceneBody<D>], place: &Vector<D>) -> Option<usize> {
    bodies.iter().position(|body| body.holds(place))
}

/// Depth of a place below the surface of the material, against the direction `up`: as far as bodies reach `[m]`.
pub(in crate::cases) fn depth<const D: usize>(
    bodies: &[impl SceneBody<D>],
    place: &Vector<D>,
    up: &Vector<D>,
    spacing: f64,
) -> f64 {
    let step = spacing / STEPS;
    let mut steps = 0.0;
    while holder(bodies, &(place + up * ((steps + 0.5) * step))).is_some() {
        steps += 1.0;
    }
    steps * step
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases::scene::PlaneBody;

    #[test]
    fn a_body_of_broken_spacings_is_said_to_lose_mass() {
        let new = |height: f64| PlaneBody::Box { lower: (0.0, 0.0), upper: (0.1, height), velocity: (0.0, 0.0) };
        assert_eq!(misfits(&[new(0.03)], 0.0025), Vec::<String>::new());
        // 12.5 rows: the middle of the last lies on the edge and is not held
        let remarks = misfits(&[new(0.03), new(0.03125)], 0.0025);
        assert!(remarks.len() == 1 && remarks[0].starts_with("`bodies[1]`: its particles have 96.0 %"), "{remarks:?}");
    }

    #[test]
    fn the_sites_of_a_box_run_along_its_first_axis() {
        let corners = (Vector::<3>::new(-0.1, 0.0, 0.25), Vector::<3>::new(0.15, 0.12, 0.32));
        let sites: Vec<[f64; 3]> =
            lattice(corners, 0.1).map(|(_, site)| (site * 20.0).map(f64::round).into()).collect();
        let row = |y, z| [[-1.0, y, z], [1.0, y, z], [3.0, y, z]];
        assert_eq!(sites, [row(1.0, 5.0), row(3.0, 5.0), row(1.0, 7.0), row(3.0, 7.0)].concat());
        let none = shapes::around::<2>([]);
        assert_eq!(lattice(none, 0.1).count(), 0);
    }
}
