//! Impulse that the wall particles of each facet wall give to the flow: their forces, pair by pair as the momentum pass takes them.
//! Only scenes with facet walls come here.

use super::flow_partner::{Constants, FlowPartner};
use super::layout::Momentum;
use super::pair_weights::{Weighing, Weights, widened};
use super::precision::Precision;
use super::records::Records;
use super::wall_partner::{WallGroup, WallPair};
use crate::lanes::algebra::{load, scaled, store_vector};
use crate::lanes::{LANES, LaneNumbers, LanePass, Lanes};
use crate::parallel::prelude::*;
use crate::vector::Vector;
use crate::weakly_compressible::{BLOCK, Model, NeighbourGroup, PairData, Particles};

use std::ops::Range;

/// The owner of particles that belong to no facet wall.
pub(crate) const NO_OWNER: u32 = u32::MAX;

/// Impulse of a wall on the flow, and its moment about the axis that the wall turns about.
#[derive(Debug, Clone, Copy)]
pub(crate) struct WallImpulse<const D: usize> {
    pub(crate) linear: Vector<D>,
    pub(crate) angular: f64,
}

impl<const D: usize> WallImpulse<D> {
    /// None yet.
    pub(crate) fn none() -> Self {
        Self { linear: Vector::zeros(), angular: 0.0 }
    }

    /// Adds an impulse `[kg m/s]` with a lever `[m]`.
    #[inline(always)]
    pub(crate) fn add(&mut self, impulse: Vector<D>, lever: &Vector<D>) {
        self.angular += impulse.dot(lever);
        self.linear += impulse;
    }
}

/// The facet walls that impulses are booked to.
pub(crate) struct Booking<'a, const D: usize> {
    /// The facet wall of every particle in the arrays.
    pub(crate) owners: &'a [u32],
    /// Number of facet walls.
    pub(crate) walls: usize,
    /// Impulses, block by block of flow particles and in each wall by wall `[kg m/s]`.
    pub(crate) impulses: &'a mut [WallImpulse<D>],
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
    out: &'a mut [WallImpulse<D>],
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(mut self) {
        let count = (self.particles.flow_count() - self.block * BLOCK).min(BLOCK);
        for offset in 0..count.div_ceil(LANES) {
            let group = self.model.list.group(self.block * (BLOCK / LANES) + offset);
            if group.wall.is_empty() {
                continue;
            }
            let first = self.block * BLOCK + offset * LANES;
            let places = first..(first + LANES).min(self.block * BLOCK + count);
            if self.model.pairs_in_single() {
                self.book_group::<V, _>(&self.pairs.single, &[], &group, places);
            } else {
                let weights = &self.pairs.weights[group.first_pair + group.flow.len()..];
                self.book_group::<V, _>(&self.pairs.momentum, weights, &group, places);
            }
        }
    }
}

impl<const D: usize> Pass<'_, D> {
    /// Books what walls give to the particles of a group; `weights` are those of its walls.
    #[inline(always)]
    fn book_group<V: Lanes, P: Precision>(
        &mut self,
        records: &Records<P>,
        weights: &[Weights<P>],
        group: &NeighbourGroup<'_>,
        places: Range<usize>,
    ) {
        let Self { model, particles, owners, time_step, .. } = *self;
        let count = places.len();
        let impulse = load::<V>(&particles.mass[places.clone()]) * V::splat(time_step);
        let density = load::<V>(&particles.density[places.clone()]);
        let constants = Constants::of(model);
        let quads = const { Momentum::<P, D>::QUADS };
        let own = FlowPartner::of::<P>(&records.load::<V>(quads, &group.own));
        let weighing = Weighing::<P, V, D> { kernel: &model.kernel, records, quads, place: own.position };
        let seen = WallGroup::of::<V, P>(model, particles, own, places);
        let seen = seen.bounded::<V, P>(&constants, records, weighing.pairs(group.wall, weights));
        let mut walls = weighing.pairs(group.wall, weights);
        while let Some(walls) = walls.next() {
            for (w, weight) in walls {
                let WallPair { traction, drag, unexplained } = seen.pair::<V, P>(&constants, records, &w);
                let weight = P::Lanes::<V>::load(weight);
                let (from_stress, from_control) = if P::SINGLE {
                    let (traction, unexplained) = (scaled(weight, &traction), scaled(weight * drag, &unexplained));
                    (
                        scaled(impulse / density, &widened::<V, P, D>(&traction)),
                        scaled(impulse, &widened::<V, P, D>(&unexplained)),
                    )
                } else {
                    let weight = impulse * P::widen(weight);
                    (
                        scaled(weight / density, &widened::<V, P, D>(&traction)),
                        scaled(weight * P::widen(drag), &widened::<V, P, D>(&unexplained)),
                    )
                };
                book(owners, particles, &w.raw()[..count], (&from_stress, &from_control), self.out);
            }
        }
    }
}

/// Adds what the wall particles `partners` give, lane by lane, to their facet walls.
#[inline(always)]
fn book<V: Lanes, const D: usize>(
    owners: &[u32],
    particles: &Particles<D>,
    partners: &[u32],
    (from_stress, from_control): (&[V; D], &[V; D]),
    out: &mut [WallImpulse<D>],
) {
    let (mut stress, mut control) = ([Vector::zeros(); LANES], [Vector::zeros(); LANES]);
    store_vector(from_stress, &mut stress);
    store_vector(from_control, &mut control);
    for (lane, partner) in partners.iter().enumerate() {
        let owner = owners[*partner as usize];
        if owner != NO_OWNER {
            let lever = &particles.walls.lever[*partner as usize - particles.flow_count()];
            out[owner as usize].add(stress[lane] + control[lane], lever);
        }
    }
}
