//! Initial particles: on the sites of lattices that bodies hold, as dense as the material above them makes them.

use super::behind_walls::{Permissions, Site};
use super::cut_cells::{self, Part};
use super::flow::Dimension;
use super::geostatic::GeostaticStress;
use super::lattice::{SiteLattice, groups};
use super::setting::{SceneBody, SceneInlet, SceneWall};
use super::sides::SceneSides;
use super::surfaces::{NearestWall, Surfaces, is_taken};
use super::{BodyPreparation, SceneFlow, shapes};
use crate::case::ParameterError;
use crate::checkpoint::is_interrupted;
use crate::setup::displaced_flow;
use bagnold_solver::material::equation_of_state::EquationOfState;
use bagnold_solver::material::pore_liquid::SKELETON_SHARE;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::scene::Flow;

/// Steps by which depths are felt, a spacing `[-]`.
const STEPS: f64 = 8.0;

impl<S: Dimension<D>, const D: usize> SceneFlow<S, D> {
    /// Particles on the sites of lattices that bodies hold and that are free of walls, under the pressure of the material above
    /// them; and the share of the sites of bodies that are behind walls `[-]`.
    ///
    /// # Errors
    /// A body of which walls take more than they may; an interruption.
    pub(super) fn fill(
        &self,
        walls: &Surfaces<D>,
        equation_of_state: &EquationOfState,
    ) -> Result<(Flow<D>, f64), ParameterError> {
        let Self { spacing, jitter, ref bodies, .. } = *self;
        let groups = groups(bodies, &self.sides, spacing);
        let (across, along) = self.pulls();
        let pull = across.norm();
        let up = if pull > 0.0 { -across / pull } else { -self.down() };
        let weight = equation_of_state.reference_density * pull;
        let (mut all, mut hidden, mut free) = (0, 0, Vec::new());
        for (lattice, members) in &groups {
            let sites = self.held(lattice, members, walls);
            let permissions = self.permissions(self.cut_at_most);
            let behind = permissions.behind(&sites)?;
            let is_free = |site: &Site<D>| !site.nearest.is_some_and(|nearest| is_taken(&nearest, lattice.shortest()));
            all += sites.len();
            hidden += behind.iter().filter(|is_behind| **is_behind).count();
            let pairs = sites.into_iter().zip(behind);
            let own: Vec<Site<D>> =
                pairs.filter(|(site, behind)| !behind && is_free(site)).map(|(site, _)| site).collect();
            let parts = cut_cells::parts(lattice, &own, |place| {
                let is_held = holder(bodies, place).is_some_and(|body| members.contains(&body));
                let is_in_front = |wall: NearestWall| wall.distance > 0.0 || permissions.walls[wall.wall].1;
                is_held && self.sides.hold(place) && walls.nearest(place).is_none_or(is_in_front)
            });
            // a sliver that is thinner than a sample has no particle
            let filled = own.into_iter().zip(parts).filter(|(_, part)| part.volume > 0.0);
            free.extend(filled.map(|(site, part)| (part, *lattice, site.body)));
        }
        let share = if all == 0 { 0.0 } else { hidden as f64 / all as f64 };
        let is_stressed = self.preparation == BodyPreparation::Stressed;
        let slope = if is_stressed { along / pull } else { Vector::zeros() };
        let start = GeostaticStress { lateral_ratio: self.lateral_pressure_ratio, up, slope };
        // grains in a liquid have a share of the mixture's stiffness
        let (mut skeleton, grains) = (*equation_of_state, 1.0 - self.pore_pressure_ratio);
        if self.material.pore_liquid().is_some() {
            skeleton.bulk_modulus *= SKELETON_SHARE;
        }
        // takes minutes in a body of many thousand rows
        let overburden = |(part, ..): &(Part<D>, SiteLattice<D>, usize)| {
            let load = || weight * depth(bodies, &part.centre, &up, spacing);
            if is_interrupted() { Err(ParameterError::Interrupted) } else { Ok(load()) }
        };
        let loads: Vec<f64> = free.iter().map(overburden).collect::<Result<_, _>>()?;
        let sites = free.iter().map(|(part, ..)| part.centre);
        let mut flow = displaced_flow(sites, (jitter * spacing, self.seed), |_| 0.0, |_| 0.0);
        let density = |load: &f64| skeleton.density(self.pressure + grains * start.pressure(*load));
        flow.density = loads.iter().map(density).collect();
        if self.pore_pressure_ratio > 0.0 {
            flow.field = loads.iter().map(|load| self.pore_pressure_ratio * load).collect();
        }
        if is_stressed {
            let strength = |load| self.material.strength_at_rest(self.pressure + load).unwrap_or(0.0);
            flow.stress = loads.iter().map(|load| start.shear(*load, strength(*load))).collect();
        } else if self.lateral_pressure_ratio != 1.0 {
            flow.stress = loads.iter().map(|load| start.deviator(grains * load)).collect();
        }
        let mass = |((part, lattice, _), density): (&(Part<D>, SiteLattice<D>, usize), &f64)| {
            part.volume * lattice.mass(*density)
        };
        flow.mass = free.iter().zip(&flow.density).map(mass).collect();
        flow.velocity = free.iter().map(|(.., body)| bodies[*body].velocity()).collect();
        Ok((flow, share))
    }

    /// The sites of a lattice that some bodies hold.
    fn held(&self, lattice: &SiteLattice<D>, members: &[usize], walls: &Surfaces<D>) -> Vec<Site<D>> {
        let bodies = &self.bodies;
        let corners = members.iter().flat_map(|&body| <[Vector<D>; 2]>::from(bodies[body].extent()));
        let held = lattice.sites(shapes::around(corners)).filter_map(|(cell, place)| {
            let body = holder(bodies, &place).filter(|body| members.contains(body) && self.sides.hold(&place))?;
            Some(Site { cell, place, body, nearest: walls.nearest(&place) })
        });
        held.collect()
    }

    fn permissions(&self, most: f64) -> Permissions<'_> {
        Permissions {
            walls: self.barriers().collect(),
            inlets: (self.walls.len(), S::Inlet::TURN),
            most,
            turn: S::Wall::TURN,
        }
    }

    /// All sites that bodies hold, with what becomes of each, also where walls take more of a body than they may.
    pub(super) fn survey(&self, walls: &Surfaces<D>) -> Vec<(Vector<D>, SiteFate)> {
        let mut fates = Vec::new();
        for (lattice, members) in &groups(&self.bodies, &self.sides, self.spacing) {
            let sites = self.held(lattice, members, walls);
            // of a body on both sides of a wall it is not known what is behind, but where it is near
            let near = |site: &Site<D>| site.nearest.is_some_and(|wall| wall.distance < 0.0);
            let behind = self.permissions(1.0).behind(&sites).unwrap_or_else(|_| sites.iter().map(near).collect());
            fates.extend(sites.iter().zip(behind).map(|(site, behind)| {
                let is_near = site.nearest.is_some_and(|nearest| is_taken(&nearest, lattice.shortest()));
                let fate = match (behind, is_near) {
                    (true, _) => SiteFate::Behind,
                    (false, true) => SiteFate::AtAWall,
                    (false, false) => SiteFate::Particle,
                };
                (site.place, fate)
            }));
        }
        fates
    }
}

/// Fate of a site that a body holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SiteFate {
    /// A particle starts there.
    Particle,
    /// It is too near to a wall.
    AtAWall,
    /// It is behind a wall.
    Behind,
}

/// The first body that holds a place, if any does, by its place among all.
pub(super) fn holder<const D: usize>(bodies: &[impl SceneBody<D>], place: &Vector<D>) -> Option<usize> {
    bodies.iter().position(|body| body.holds(place))
}

/// Depth of a place below the surface of the material, against the direction `up`: as far as bodies reach `[m]`.
pub(crate) fn depth<const D: usize>(
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
    use crate::enclosed::quick;
    use crate::scene::{Plane, PlaneBody};
    use crate::scene_space::{Space, SpaceBody};
    use bagnold_solver::material::equation_of_state::Tension;
    use bagnold_solver::weakly_compressible::enclosure::BoundarySet;
    use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};

    /// Volume of the particles that fill bodies without walls: their masses over their densities.
    fn filled<S: Dimension<D>, const D: usize>(bodies: Vec<S::Body>, spacing: f64) -> f64
    where
        Simulation<D>: Compiled<D>,
    {
        let scene = SceneFlow { bodies, spacing, walls: Vec::new(), ..quick::<S, D>() };
        let law = EquationOfState { reference_density: 1000.0, bulk_modulus: 1e6, tension: Tension::Cut };
        let (flow, _) = scene.fill(&Surfaces::of(&BoundarySet::default(), spacing, S::SIDE), &law).expect("filled");
        flow.mass.iter().zip(&flow.density).map(|(mass, density)| mass / density).sum()
    }

    #[test]
    fn boxes_have_their_mass_whatever_the_spacing_is() {
        let flat = |lower, upper| PlaneBody::Box { lower, upper, velocity: (0.0, 0.0) };
        let velocity = (0.0, 0.0, 0.0);
        for spacing in [0.0025, 0.0031, 0.0047, 0.0063] {
            let plane = filled::<Plane, 2>(vec![flat((0.01, 0.0), (0.11, 0.03125))], spacing) / (0.1 * 0.03125);
            let two = vec![flat((0.01, 0.0), (0.11, 0.03125)), flat((0.01, 0.03125), (0.0701, 0.0523))];
            let two = filled::<Plane, 2>(two, spacing) / (0.1 * 0.03125 + 0.0601 * (0.0523 - 0.03125));
            let space = vec![SpaceBody::Box { lower: (0.0, 0.0, 0.0), upper: (0.04, 0.033, 0.03125), velocity }];
            let space = filled::<Space, 3>(space, spacing) / (0.04 * 0.033 * 0.03125);
            for share in [plane, two, space] {
                assert!((share - 1.0).abs() < 1e-9, "{spacing} m: {plane}, {two} and {space}");
            }
        }
        // a disc and a polygon have theirs within the samples of a cell
        let disc = PlaneBody::Disc { centre: (0.03, 0.04), radius: 0.02, velocity: (0.0, 0.0) };
        let points = vec![(0.0, 0.0), (0.1, 0.02), (0.07, 0.0523), (0.0, 0.03125)];
        let polygon = PlaneBody::Polygon { points, velocity: (0.0, 0.0) };
        for body in [disc, polygon] {
            let share = filled::<Plane, 2>(vec![body.clone()], 0.0025) / body.volume();
            assert!((share - 1.0).abs() < 2e-3, "{share} of {body:?}");
        }
        // what is beyond a side does not count: the tier's plane of symmetry is at 0
        let cut = filled::<Plane, 2>(vec![flat((-0.013, 0.0), (0.0501, 0.03125))], 0.0025) / (0.0501 * 0.03125);
        assert!((cut - 1.0).abs() < 1e-9, "{cut}");
    }
}
