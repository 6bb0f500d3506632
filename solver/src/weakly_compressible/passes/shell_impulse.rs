//! Impulse that the wall particles of each facet wall give to the flow: their forces, pair by pair as the momentum pass takes them.
//! Only scenes with facet walls come here.

use super::PairData;
use super::flow_partner::{Constants, FlowPartner};
use super::single::momentum::WallGroup;
use super::wall_partner::{WallPair, WallPartner};
use crate::lanes::algebra::{load, scaled, store_vector};
use crate::lanes::{LANES, LanePass, Lanes};
use crate::parallel::prelude::*;
use crate::vector::Vector;
use crate::weakly_compressible::model::Model;
use crate::weakly_compressible::neighbours::BLOCK;
use crate::weakly_compressible::particles::Particles;

/// The owner of particles that belong to no facet wall.
pub(crate) const NO_OWNER: u32 = u32::MAX;

/// The facet walls that impulses are booked to.
pub(crate) struct Booking<'a, const D: usize> {
    /// The facet wall of every particle in the arrays.
    pub(crate) owners: &'a [u32],
    /// Number of facet walls.
    pub(crate) walls: usize,
    /// Impulses, block by block of flow particles and in each wall by wall `[kg m/s]`.
    pub(crate) impulses: &'a mut [Vector<D>],
}

/// Adds the impulses of the wall particles in a step.
pub(crate) fn run<const D: usize>(
    model: &Model<D>,
    particles: &Particles<D>,
    pairs: &PairData<D>,
    time_step: f64,
    booking: Booking<'_, D>,
) {
    let Booking { owners, walls, impulses } = booking;
    impulses.par_chunks_mut(walls).enumerate().with_min_len(4).for_each(|(block, out)| {
        model.instruction_set.run(Pass { model, particles, pairs, owners, block, time_step, out });
    });
}

struct Pass<'a, const D: usize> {
    model: &'a Model<D>,
    particles: &'a Particles<D>,
    pairs: &'a PairData<D>,
    owners: &'a [u32],
    block: usize,
    time_step: f64,
    out: &'a mut [Vector<D>],
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { model, particles, pairs, owners, block, time_step, out } = self;
        let constants = Constants::of(model);
        let count = (particles.flow_count() - block * BLOCK).min(BLOCK);
        for offset in 0..count.div_ceil(LANES) {
            let group = model.list.group(block * (BLOCK / LANES) + offset);
            let owned = group.wall.raw();
            if owned.is_empty() {
                continue;
            }
            let first = block * BLOCK + offset * LANES;
            let places = first..(first + LANES).min(block * BLOCK + count);
            let impulse = load::<V>(&particles.mass[places.clone()]) * V::splat(time_step);
            let count = places.len();
            if model.pairs_in_single() {
                let density = load::<V>(&particles.density[places.clone()]);
                let seen = WallGroup::of::<V>(particles, &pairs.single, &group, places);
                for (w, partners) in group.wall.zip(owned) {
                    let (weight, pair) = seen.pair(model, &constants, &pairs.single, &w);
                    let WallPair { traction, drag, unexplained } = pair;
                    let from_stress = widened::<V, D>(impulse / density, &scaled(weight, &traction));
                    let from_control = widened::<V, D>(impulse, &scaled(weight * drag, &unexplained));
                    book(owners, &partners[..count], &from_stress, &from_control, out);
                }
                continue;
            }
            let own = FlowPartner::<V, D>::load(&pairs.momentum, &group.own);
            let correction = particles.force_correction.load::<V>(first / LANES);
            let (_, weights) = pairs.weights[group.first_pair..].split_at(group.flow.len());
            for ((w, weight), partners) in group.wall.zip(weights).zip(owned) {
                let wall = WallPartner::<V, D>::load(&pairs.momentum, &w);
                let WallPair { traction, drag, unexplained } = WallPair::of(&constants, &own, &wall, &correction);
                let weight = impulse * V::load(weight);
                let from_stress = scaled(weight / own.density, &traction);
                let from_control = scaled(weight * drag, &unexplained);
                book(owners, &partners[..count], &from_stress, &from_control, out);
            }
        }
    }
}

/// f a of a vector in single precision.
#[inline(always)]
fn widened<V: Lanes, const D: usize>(factor: V, vector: &[V::Single; D]) -> [V; D] {
    let mut lanes = [V::splat(0.0); D];
    for i in 0..D {
        lanes[i] = factor * V::widen(vector[i]);
    }
    lanes
}

/// Adds what the wall particles `partners` give, lane by lane, to their facet walls.
#[inline(always)]
fn book<V: Lanes, const D: usize>(
    owners: &[u32],
    partners: &[u32],
    from_stress: &[V; D],
    from_control: &[V; D],
    out: &mut [Vector<D>],
) {
    let (mut stress, mut control) = ([Vector::zeros(); LANES], [Vector::zeros(); LANES]);
    store_vector(from_stress, &mut stress);
    store_vector(from_control, &mut control);
    for (lane, partner) in partners.iter().enumerate() {
        let owner = owners[*partner as usize];
        if owner != NO_OWNER {
            out[owner as usize] += stress[lane] + control[lane];
        }
    }
}
