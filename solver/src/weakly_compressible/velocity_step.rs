//! Velocities in a step: the kick, the contact with walls, and the work of both. Eight particles at once, as in the passes.

use crate::lanes::algebra::{
    accumulate, difference, dot, load, load_vector, scaled, splat_vector, store_vector, sum_of, zero_vector,
};
use crate::lanes::{LANES, LanePass, Lanes};
use crate::parallel::prelude::*;
use crate::run::Divergence;
use crate::vector::Vector;
use crate::weakly_compressible::divergence::{LARGEST_MACH_NUMBER, Quantity};
use crate::weakly_compressible::energy::{VelocityStep, VelocityWork};
use crate::weakly_compressible::numerics::Contact;
use crate::weakly_compressible::walls::contact;
use crate::weakly_compressible::{BLOCK, EnergyLedger, Particles, State, Wall};

impl<const D: usize> State<D> {
    /// New velocities, with what walls stop and what each force has worked.
    ///
    /// # Errors
    /// A particle faster than the model allows.
    pub(crate) fn update_velocity(&mut self, time_step: f64) -> Result<(), Divergence<D>> {
        let flow = self.particles.flow_count();
        let largest_speed = LARGEST_MACH_NUMBER * self.model.equation_of_state.sound_speed();
        let limit = largest_speed.powi(2);
        let range = match self.model.numerics.contact {
            Contact::HalfSpacing => 0.5 * self.model.spacing,
            Contact::None => f64::NEG_INFINITY,
        };
        let contact = Touch { walls: &self.walls, range, friction: self.model.contact_friction };
        self.pairs.open_ledger(flow);
        let (gravity, set, frame) = (self.model.gravity, self.model.instruction_set, self.enclosure.frame);
        let mut velocity = std::mem::take(&mut self.particles.velocity);
        let mut support_impulse = std::mem::take(&mut self.particles.support_impulse);
        let particles = &self.particles;
        let (largest, relative, bad) =
            (velocity[..flow].par_chunks_mut(BLOCK), support_impulse.par_chunks_mut(BLOCK), &mut self.pairs.energy)
                .enumerate()
                .with_min_len(16)
                .map(|(block, (velocity, support_impulse, energy))| {
                    let mut extremes = (0.0_f64, 0.0_f64, usize::MAX);
                    let (first, extremes_of_block) = (block * BLOCK, &mut extremes);
                    let out = Output { velocity, support_impulse, energy, extremes: extremes_of_block };
                    set.run(Kick { particles, contact, gravity, frame, time_step, limit, first, out });
                    extremes
                })
                .reduce(|| (0.0, 0.0, usize::MAX), |a, b| (a.0.max(b.0), a.1.max(b.1), a.2.min(b.2)));
        (self.particles.velocity, self.particles.support_impulse) = (velocity, support_impulse);
        self.pairs.close_ledger(&mut self.energy);
        (self.largest_speed, self.relative_speed) = (largest.sqrt(), relative.sqrt());
        if bad != usize::MAX {
            let speed = (self.particles.velocity[bad] - frame).norm();
            return Err(self.divergence(bad, Quantity::Speed { limit: largest_speed }, speed));
        }
        Ok(())
    }
}

/// Plane walls that particles may touch.
#[derive(Clone, Copy)]
struct Touch<'a, const D: usize> {
    walls: &'a [Wall<D>],
    /// Distance within which a wall is touched `[m]`.
    range: f64,
    friction: f64,
}

impl<const D: usize> Touch<'_, D> {
    /// Changes of the velocities `[m/s]` of particles that the walls touch; nothing if there are none.
    #[inline(always)]
    fn impulses<V: Lanes>(&self, position: &[V; D], velocity: &[V; D], count: usize) -> Option<[V; D]> {
        let mut near = 0;
        for wall in self.walls {
            let distance = V::splat(wall.side) * (position[wall.axis] - V::splat(wall.surface));
            near |= distance.less_mask(V::splat(self.range));
        }
        near &= (1 << count) - 1;
        if near == 0 {
            return None;
        }
        let (mut positions, mut velocities) = ([Vector::zeros(); LANES], [Vector::zeros(); LANES]);
        store_vector(position, &mut positions);
        store_vector(velocity, &mut velocities);
        let mut changes = [Vector::zeros(); LANES];
        for lane in 0..count {
            if (near >> lane) & 1 == 1 {
                let (position, velocity) = (&positions[lane], &velocities[lane]);
                changes[lane] = contact::impulse(self.walls, position, velocity, self.range, self.friction);
            }
        }
        Some(load_vector::<V, D>(&changes))
    }
}

struct Output<'a, const D: usize> {
    velocity: &'a mut [Vector<D>],
    support_impulse: &'a mut [Vector<D>],
    energy: &'a mut EnergyLedger,
    /// Largest speed squared, and relative to the frame `[m²/s²]`; the first particle beyond the limit.
    extremes: &'a mut (f64, f64, usize),
}

/// A block of particles from `first` on.
struct Kick<'a, const D: usize> {
    particles: &'a Particles<D>,
    contact: Touch<'a, D>,
    gravity: Vector<D>,
    /// Velocity that speeds are relative to `[m/s]`.
    frame: Vector<D>,
    time_step: f64,
    /// Largest relative speed squared that is no divergence `[m²/s²]`.
    limit: f64,
    first: usize,
    out: Output<'a, D>,
}

impl<const D: usize> LanePass for Kick<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { particles, contact, gravity, frame, time_step, limit, first, out } = self;
        let step = V::splat(time_step);
        let mut work = VelocityWork::<V>::new();
        let frame = splat_vector(&frame);
        let (mut largest, mut largest_relative) = (V::splat(0.0), V::splat(0.0));
        for (group, (velocity, support_impulse)) in
            out.velocity.chunks_mut(LANES).zip(out.support_impulse.chunks_mut(LANES)).enumerate()
        {
            let start = first + group * LANES;
            let here = start..start + velocity.len();
            let mass = load::<V>(&particles.mass[here.clone()]);
            let before = load_vector::<V, D>(velocity);
            let mut after = before;
            accumulate(&mut after, step, &load_vector::<V, D>(&particles.acceleration[here.clone()]));
            let position = load_vector::<V, D>(&particles.position[here.clone()]);
            let change = contact.impulses(&position, &after, velocity.len());
            let change = match change {
                Some(change) => change,
                None => zero_vector(),
            };
            let end = sum_of(&after, &change);
            store_vector(&end, velocity);
            let support = load_vector::<V, D>(&particles.support[here.clone()]);
            let given = scaled(mass, &sum_of(&scaled(step, &support), &change));
            store_vector(&sum_of(&load_vector::<V, D>(support_impulse), &given), support_impulse);
            VelocityStep {
                mass,
                time_step,
                gravity: &gravity,
                before: &before,
                end: &end,
                contact: &change,
                by_walls: &load_vector::<V, D>(&particles.by_walls[here.clone()]),
                by_damping: &load_vector::<V, D>(&particles.by_damping[here.clone()]),
                by_wall_control: &load_vector::<V, D>(&particles.by_wall_control[here]),
            }
            .add_to(&mut work);
            largest = dot(&end, &end).max(largest);
            let relative = difference(&end, &frame);
            let square = dot(&relative, &relative);
            largest_relative = square.max(largest_relative);
            // a NaN is bad as well
            let fine = square.less_mask(V::splat(limit)) | ((1 << LANES) - (1 << velocity.len()));
            if fine != (1 << LANES) - 1 && out.extremes.2 == usize::MAX {
                let squares = square.to_array();
                let bad = (0..velocity.len()).find(|&lane| squares[lane].is_nan() || squares[lane] > limit);
                out.extremes.2 = bad.map_or(usize::MAX, |lane| start + lane);
            }
        }
        work.add_to(out.energy);
        for (square, relative) in largest.to_array().into_iter().zip(largest_relative.to_array()) {
            (out.extremes.0, out.extremes.1) = (out.extremes.0.max(square), out.extremes.1.max(relative));
        }
    }
}
