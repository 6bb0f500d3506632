//! Particles displaced from their sites, as dense as the material above them makes them.

use bagnold_solver::vector::{Tensor, Vector};
use bagnold_solver::weakly_compressible::scene::Flow;
use rand::{RngExt, SeedableRng};

/// Sites `[m]`, each with a place at random that is at most `reach` `[m]` away from it along each axis.
pub fn displaced<const D: usize>(
    sites: impl IntoIterator<Item = Vector<D>>,
    reach: f64,
    seed: u64,
) -> impl Iterator<Item = (Vector<D>, Vector<D>)> {
    let mut random = rand_pcg::Pcg64::seed_from_u64(seed);
    let mut shift = move || Vector::<D>::from_fn(|_, _| reach * (2.0 * random.random::<f64>() - 1.0));
    sites.into_iter().map(move |site| (site, site + shift()))
}

/// A flow at rest without stress, each particle displaced from its site by at most `reach` `[m]` along each axis.
///
/// The density `[kg/m³]` belongs to the site and the mass `[kg]`, per metre in the plane, to the density, so that the material
/// neither sinks nor swells when it is released.
pub fn displaced_flow<const D: usize>(
    sites: impl IntoIterator<Item = Vector<D>>,
    (reach, seed): (f64, u64),
    density: impl Fn(&Vector<D>) -> f64,
    mass: impl Fn(f64) -> f64,
) -> Flow<D> {
    let mut flow = Flow::default();
    for (site, place) in displaced(sites, reach, seed) {
        let density = density(&site);
        flow.position.push(place);
        flow.velocity.push(Vector::zeros());
        flow.density.push(density);
        flow.mass.push(mass(density));
        flow.stress.push(Tensor::zeros());
    }
    flow
}

/// Exact pressure `[Pa]` of a compressible material at rest at `depth` `[m]` below its surface.
pub fn hydrostatic_pressure(bulk_modulus: f64, reference_density: f64, gravity_across: f64, depth: f64) -> f64 {
    bulk_modulus * libm::expm1(reference_density * gravity_across * depth.max(0.0) / bulk_modulus)
}
