//! Reactions of walls and planes of symmetry on the flow by the response K of an implicit step. They come beside the
//! forces of the old state: for balances, where the flow is enclosed.
//!
//! Of (−K δ)_a = V_a [Σ_b w_ab (s_a L_a + s_b L_b) r + Σ_w w_aw β s_a L_a r] the pairs of the flow cancel each other. The sum over wall
//! particles is theirs, wall by wall, and what images behind a mirror give is that plane's.

use super::ViscousSolve;
use super::system::{GROUPS, ViscousSystem};
use super::update::load_columns;
use crate::lanes::algebra::{accumulate, difference, product, scaled, store_vector, zero_tensor, zero_vector};
use crate::lanes::{LANES, LanePass, Lanes, gather, gather_vectors};
use crate::parallel::prelude::*;
use crate::vector::Vector;
use crate::weakly_compressible::passes::shell_impulse::{Booking, NO_OWNER, WallImpulse};
use crate::weakly_compressible::passes::{layout, records};
use crate::weakly_compressible::terms::{no_slip, wall_slip};
use crate::weakly_compressible::wall_fields::mirrored_lanes;
use crate::weakly_compressible::{BLOCK, Images, Particles};

impl<const D: usize> ViscousSolve<'_, D> {
    /// Adds the reaction to the increment that was solved for: to `impulses` what facet walls give, and to the support of each
    /// particle all of it.
    pub(crate) fn book_reaction(
        &self,
        particles: &mut Particles<D>,
        images: &Images<D>,
        system: &mut ViscousSystem<D>,
        booking: Booking<'_, D>,
    ) {
        let flow = particles.flow_count();
        self.show_increments(system, flow);
        self.product_stresses(system, flow, images);
        let mut support = std::mem::take(&mut particles.support);
        let (shared, system) = (&*particles, &*system);
        let Booking { owners, walls, impulses } = booking;
        // no facet wall still leaves a slot to a block
        let width = walls.max(1);
        (support.par_chunks_mut(BLOCK), impulses.par_chunks_mut(width)).enumerate().with_min_len(4).for_each(
            |(block, (support, out))| {
                let pass = ReactionPass { constants: self, particles: shared, system, owners, block, support, out };
                self.model.instruction_set.run(pass);
            },
        );
        particles.support = support;
    }
}

struct ReactionPass<'a, const D: usize> {
    constants: &'a ViscousSolve<'a, D>,
    particles: &'a Particles<D>,
    system: &'a ViscousSystem<D>,
    owners: &'a [u32],
    block: usize,
    support: &'a mut [Vector<D>],
    out: &'a mut [WallImpulse<D>],
}

impl<const D: usize> LanePass for ReactionPass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { constants, particles, system, owners, block, support, out } = self;
        let quads = const { (D * D).div_ceil(4) };
        let places = const { layout::geometry(D).div_ceil(4) };
        let smoothing_length = constants.model.kernel.smoothing_length();
        for offset in 0..support.len().div_ceil(LANES) {
            let group = constants.model.list.group(block * GROUPS + offset);
            let count = (support.len() - offset * LANES).min(LANES);
            let coefficients = &system.coefficients[block * GROUPS + offset];
            let impulse_volume = V::load(&coefficients.impulse_volume);
            let own = records::tensor::<V, D>(&system.stresses.load::<V>(quads, &group.own), 0);
            let increment = records::vector::<V, D>(&system.velocities.load::<V>(1, &group.own), 0);
            let mut correction = zero_tensor::<V, D>();
            for i in 0..D {
                correction[i] = load_columns(&coefficients.correction[i]);
            }
            let (shared, hold) = (V::load(&coefficients.shared), V::load(&coefficients.hold));
            let mut all = zero_vector::<V, D>();
            if group.has_images {
                for (b, pair) in group.flow.zip(&system.pair_vectors[group.first_pair..]) {
                    let mirrored: V = mirrored_lanes(&particles.mirrored, particles.real_count(), &b);
                    let other = records::tensor::<V, D>(&system.stresses.load::<V>(quads, &b), 0);
                    let pair = load_columns::<V, D>(pair);
                    accumulate(&mut all, mirrored, &product(&own, &pair));
                    accumulate(&mut all, mirrored, &product(&other, &pair));
                }
            }
            let owned = group.wall.raw();
            let weights = &constants.pairs.weights[group.first_pair..];
            let (_, wall_weights) = weights.split_at(group.flow.len());
            let place = records::vector::<V, D>(&constants.pairs.geometry.load::<V>(places, &group.own), 0);
            for ((w, weight), partners) in group.wall.zip(wall_weights).zip(owned) {
                let record = constants.pairs.geometry.load_start::<V>(places, const { D.div_ceil(4) }, &w);
                let fields = w.places_from(particles.flow_count());
                let w = fields.indices();
                let normal = gather_vectors::<V, D>(&particles.walls.normal, &w);
                let depth: V = gather(&particles.walls.depth, &w);
                let r = difference(&place, &records::vector::<V, D>(&record, 0));
                let factor = wall_slip::factor(&r, &normal, depth, smoothing_length, wall_slip::LIMIT);
                let smoothness: V = gather(&particles.walls.smoothness, &w);
                let rough = V::load(weight) * (V::splat(1.0) - smoothness);
                let mut given = product(&own, &scaled(shared * rough * factor, &r));
                let stretch = no_slip::stretch(&normal, &r, &product(&correction, &r));
                accumulate(&mut given, rough * hold * no_slip::response(factor) * stretch, &increment);
                accumulate(&mut all, V::splat(1.0), &given);
                let mut impulses = [Vector::zeros(); LANES];
                store_vector(&scaled(impulse_volume, &given), &mut impulses);
                for (impulse, partner) in impulses.iter().zip(&partners[..count]) {
                    let owner = owners.get(*partner as usize).copied().unwrap_or(NO_OWNER);
                    if owner != NO_OWNER {
                        let lever = &particles.walls.lever[*partner as usize - particles.flow_count()];
                        out[owner as usize].add(*impulse, lever);
                    }
                }
            }
            let mut impulses = [Vector::zeros(); LANES];
            let factor = impulse_volume / (V::load(&coefficients.mass) * V::splat(constants.time_step));
            store_vector(&scaled(factor, &all), &mut impulses);
            for (support, impulse) in support[offset * LANES..].iter_mut().zip(&impulses) {
                *support += impulse;
            }
        }
    }
}
