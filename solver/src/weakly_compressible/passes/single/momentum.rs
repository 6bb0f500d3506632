//! The pair sums of the momentum equation in single precision, for a constant coefficient of the artificial viscosity.

use super::super::flow_partner::{Constants, FlowPartner};
use super::super::momentum::Forces;
use super::super::records::{self, LaneRecord};
use super::super::wall_partner::{WallPair, WallPartner};
use super::{Near, PART, SingleRecords, apart, flush_vector, narrow_tensor, nearness};
use crate::lanes::LANES;
use crate::lanes::algebra::{accumulate, difference, dot, load_tensor, zero_vector};
use crate::lanes::{LaneIndices, Lanes, Real, SingleLanes};
use crate::weakly_compressible::model::Model;
use crate::weakly_compressible::neighbours::NeighbourGroup;
use crate::weakly_compressible::particles::Particles;
use crate::weakly_compressible::terms::{artificial_viscosity, hourglass, pair_distance, stress_divergence};
use crate::weakly_compressible::wall_fields::mirrored_lanes;
use std::ops::Range;

/// Places in a record: of the flow position, volume, density, velocity, √(p/ρ0), σE and the half form of the velocity
/// gradient; of walls position, volume, depth, velocity, √(p/ρ0), σ and normal.
struct Place<const D: usize>;

impl<const D: usize> Place<D> {
    const VOLUME: usize = D;
    const DENSITY: usize = D + 1;
    const VELOCITY: usize = D + 2;
    const SPEED: usize = 2 * D + 2;
    const STRESS: usize = 2 * D + 3;
    const LAST: usize = 2 * D + 3 + D * D;
    const QUADS: usize = (Self::LAST + if D == 2 { 3 } else { D * (D + 1) / 2 }).div_ceil(4);
}

/// Records of flow and walls.
pub(in super::super) fn fill<const D: usize>(model: &Model<D>, particles: &Particles<D>, records: &mut SingleRecords) {
    let inverse_density = 1.0 / model.equation_of_state.reference_density;
    let smoothing_length = model.kernel.smoothing_length();
    records.fill(particles.position.len(), Place::<D>::QUADS, smoothing_length, |index, record| {
        let wall = particles.is_wall(index).then(|| index - particles.flow_count());
        let walls = &particles.walls;
        record.position(&particles.position[index]);
        record.scalar(particles.volume[index]);
        record.scalar(wall.map_or(particles.density[index], |wall| walls.depth[wall]));
        record.vector(wall.map_or(&particles.velocity[index], |wall| &walls.velocity[wall]));
        record.scalar(hourglass::pressure_speed(particles.pressure[index], inverse_density));
        record.tensor(&particles.corrected_stress[index]);
        match wall {
            Some(wall) => record.vector(&walls.normal[wall]),
            None => record.half_form(&particles.velocity_gradient[index]),
        }
    });
}

/// What the flow does to a group.
#[inline(always)]
pub(in super::super) fn flow_forces<V: Lanes, const D: usize>(
    model: &Model<D>,
    constants: &Constants,
    particles: &Particles<D>,
    records: &SingleRecords,
    group: &NeighbourGroup<'_>,
    forces: &mut Forces<V, D>,
) {
    let quads = const { Place::<D>::QUADS };
    let half = V::Single::splat(0.5);
    let regularisation = V::Single::splat(pair_distance::regularisation(constants.smoothing_length));
    let strength = V::Single::splat(constants.artificial_viscosity * constants.speed_length);
    let own = records.load::<V::Single>(quads, &group.own);
    let place = records::vector::<V::Single, D>(&own, 0);
    let velocity = records::vector::<V::Single, D>(&own, Place::<D>::VELOCITY);
    let density = records::scalar(&own, Place::<D>::DENSITY);
    let speed = records::scalar(&own, Place::<D>::SPEED);
    let stress = records::tensor::<V::Single, D>(&own, Place::<D>::STRESS);
    let none = zero_vector::<V::Single, D>();
    let (mut divergence, mut damping) = (none, none);
    let (mut mirror_divergence, mut mirror_damping) = (none, none);
    let mut near = Near::<V::Single, D>::none();
    let mut chunks = group.flow;
    while !chunks.is_empty() {
        let part = chunks.take_first(PART);
        nearness(&model.kernel, records, quads, &place, part, &mut near);
        for (slot, b) in part.enumerate() {
            let Near { r, square, weight } = near[slot & (PART - 1)];
            let other = records.load::<V::Single>(quads, &b);
            let slip = difference(&velocity, &records::vector::<V::Single, D>(&other, Place::<D>::VELOCITY));
            let other_density = records::scalar(&other, Place::<D>::DENSITY);
            let regular = square + regularisation;
            let density_sum = density + other_density;
            // one division serves 1/(ρ̄ r²) of (15), 2/(ρ_a + ρ_b) of the hourglass control and 1/r² of its direction
            let inverse = V::Single::splat(2.0) / (density_sum * regular);
            let approach = dot(&r, &slip);
            let push = artificial_viscosity::pair_factor(strength, approach, inverse);
            let speed_sum = speed + records::scalar(&other, Place::<D>::SPEED);
            let drag = hourglass::twice_viscosity(constants.hourglass_strength, speed_sum) * (inverse * regular);
            let along = (approach - explained::<V::Single, D>(&own, &other, &r)) * (half * inverse * density_sum);
            let mut pull = (weight * other_density) * (push + drag * along);
            let theirs = records::tensor::<V::Single, D>(&other, Place::<D>::STRESS);
            let traction = stress_divergence::traction(&stress, &theirs, &r);
            if let Some(artificial_stress) = &constants.artificial_stress {
                let factor = artificial_stress.factor(square, dot(&traction, &r) / regular);
                pull = pull + weight * factor / density;
            }
            accumulate(&mut divergence, weight, &traction);
            accumulate(&mut damping, pull, &r);
            if group.has_images {
                let mirrored = mirrored_lanes::<V>(&particles.mirrored, particles.real_count(), &b).narrow();
                accumulate(&mut mirror_divergence, mirrored * weight, &traction);
                accumulate(&mut mirror_damping, mirrored * pull, &r);
            }
        }
        flush_vector(&mut forces.divergence, &mut divergence);
        flush_vector(&mut forces.damping, &mut damping);
        if group.has_images {
            flush_vector(&mut forces.mirror_divergence, &mut mirror_divergence);
            flush_vector(&mut forces.mirror_damping, &mut mirror_damping);
        }
    }
}

/// r·½(∇v_a + ∇v_b) r `[m²/s]`.
#[inline(always)]
fn explained<S: Real, const D: usize>(own: &LaneRecord<S>, other: &LaneRecord<S>, r: &[S; D]) -> S {
    let both = |place: usize| records::scalar(own, place) + records::scalar(other, place);
    let mut explained = both(Place::<D>::LAST) * (r[0] * r[0]);
    for i in 1..D {
        explained = explained + both(Place::<D>::LAST + i) * (r[i] * r[i]);
    }
    let mut next = Place::<D>::LAST + D;
    for i in 0..D {
        for j in i + 1..D {
            explained = explained + both(next) * (r[i] * r[j]);
            next += 1;
        }
    }
    explained
}

/// A group as its walls see it, and what it is made of.
pub(in super::super) struct WallGroup<S, const D: usize> {
    own: FlowPartner<S, D>,
    correction: [[S; D]; D],
    unit: S,
}

impl<S: SingleLanes, const D: usize> WallGroup<S, D> {
    /// Of the particles at `places`.
    #[inline(always)]
    pub(in super::super) fn of<V: Lanes<Single = S>>(
        particles: &Particles<D>,
        records: &SingleRecords,
        group: &NeighbourGroup<'_>,
        places: Range<usize>,
    ) -> Self {
        let record = records.load::<S>(const { Place::<D>::QUADS }, &group.own);
        let own = FlowPartner {
            position: records::vector(&record, 0),
            velocity: records::vector(&record, Place::<D>::VELOCITY),
            density: records::scalar(&record, Place::<D>::DENSITY),
            pressure_speed: records::scalar(&record, Place::<D>::SPEED),
            alpha: S::splat(0.0),
            corrected_stress: records::tensor(&record, Place::<D>::STRESS),
            velocity_gradient: narrow_tensor(&load_tensor::<V, D>(&particles.velocity_gradient[places.clone()])),
        };
        let correction = narrow_tensor(&particles.force_correction.load::<V>(places.start / LANES));
        Self { own, correction, unit: S::splat(records.unit) }
    }

    /// Weights V F `[1/m²]` of the group with eight wall particles, and the parts of their forces.
    #[inline(always)]
    pub(in super::super) fn pair(
        &self,
        model: &Model<D>,
        constants: &Constants,
        records: &SingleRecords,
        indices: &LaneIndices<'_>,
    ) -> (S, WallPair<S, D>) {
        let record = records.load::<S>(const { Place::<D>::QUADS }, indices);
        let wall = WallPartner {
            position: records::vector(&record, 0),
            velocity: records::vector(&record, Place::<D>::VELOCITY),
            depth: records::scalar(&record, Place::<D>::DENSITY),
            pressure_speed: records::scalar(&record, Place::<D>::SPEED),
            stress: records::tensor(&record, Place::<D>::STRESS),
            normal: records::vector(&record, Place::<D>::LAST),
        };
        let r = apart(&self.own.position, &wall.position, self.unit);
        let weight = model.kernel.gradient_weight(dot(&r, &r), records::scalar(&record, Place::<D>::VOLUME));
        (weight, WallPair::at(constants, &self.own, &wall, &self.correction, &r))
    }
}

/// What walls do to a group.
#[inline(always)]
pub(in super::super) fn wall_forces<V: Lanes, const D: usize>(
    model: &Model<D>,
    constants: &Constants,
    particles: &Particles<D>,
    records: &SingleRecords,
    group: &NeighbourGroup<'_>,
    places: Range<usize>,
    forces: &mut Forces<V, D>,
) {
    let mut chunks = group.wall;
    if chunks.is_empty() {
        return;
    }
    let seen = WallGroup::of::<V>(particles, records, group, places);
    let none = zero_vector::<V::Single, D>();
    let (mut divergence, mut control) = (none, none);
    while !chunks.is_empty() {
        for w in chunks.take_first(PART) {
            let (weight, WallPair { traction, drag, unexplained }) = seen.pair(model, constants, records, &w);
            accumulate(&mut divergence, weight, &traction);
            accumulate(&mut control, weight * drag, &unexplained);
        }
        flush_vector(&mut forces.wall_divergence, &mut divergence);
        flush_vector(&mut forces.wall_control, &mut control);
    }
}
