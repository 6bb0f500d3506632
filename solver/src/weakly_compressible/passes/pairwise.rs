//! The paper's momentum equation: a_a = g + pressure force (10) + artificial viscosity (15) + viscous force (11), with
//! its correction (13)(14) where it is chosen. Kept so that a report can show what it does.

use super::PairData;
use super::records::{self, LaneRecord, Records};
use crate::lanes::algebra::{
    accumulate, accumulate_outer, difference, dot, scaled, store_vector, zero_tensor, zero_vector,
};
use crate::lanes::{LANES, LaneIndices, LanePass, Lanes, gather, gather_vectors};
use crate::parallel::prelude::*;
use crate::vector::Vector;
use crate::weakly_compressible::terms::{
    artificial_viscosity, pair_distance, pair_viscosity, pressure_force, wall_slip,
};
use crate::weakly_compressible::{BLOCK, Model, MomentumOperator, NeighbourGroup, Particles, ViscositySwitch};

/// Values of a record: the layout of [`Partner`].
const fn values(dimension: usize) -> usize {
    2 * dimension + 4
}

/// Neighbour data of a flow particle.
struct Partner<V, const D: usize> {
    position: [V; D],
    velocity: [V; D],
    volume: V,
    density: V,
    /// p/ρ² `[m⁵/(kg s²)]`.
    specific_pressure: V,
    viscosity: V,
}

impl<V: Lanes, const D: usize> Partner<V, D> {
    #[inline(always)]
    fn load(records: &Records, indices: &LaneIndices<'_>) -> Self {
        let record: LaneRecord<V> = records.load(const { values(D).div_ceil(4) }, indices);
        Self {
            position: records::vector(&record, 0),
            velocity: records::vector(&record, D),
            volume: records::scalar(&record, 2 * D),
            density: records::scalar(&record, 2 * D + 1),
            specific_pressure: records::scalar(&record, 2 * D + 2),
            viscosity: records::scalar(&record, 2 * D + 3),
        }
    }
}

/// Accelerations `[m/s²]` of the flow particles. What walls and mirrors have of it is not kept: (13) is not a sum
/// over pairs, so these operators have no momentum balance to close.
pub(crate) fn run<const D: usize>(model: &Model<D>, particles: &mut Particles<D>, pairs: &mut PairData<D>) {
    let shared = &*particles;
    pairs.momentum.fill(shared.position.len(), values(D), model.kernel.smoothing_length(), |index, record| {
        record.position(&shared.position[index]);
        record.vector(&shared.velocity[index]);
        record.scalar(shared.volume[index]);
        record.scalar(shared.density[index]);
        record.scalar(pressure_force::specific(shared.pressure[index], shared.density[index]));
        record.scalar(shared.viscosity[index]);
    });
    let PairData { weights, momentum, .. } = pairs;
    let mut acceleration = std::mem::take(&mut particles.acceleration);
    let region = model.list.region;
    weights.resize(acceleration.len().div_ceil(BLOCK) * region, [0.0; LANES]);
    let shared = &*particles;
    (acceleration.par_chunks_mut(BLOCK), weights.par_chunks_mut(region)).enumerate().with_min_len(4).for_each(
        |(block, (out, weights))| {
            model.instruction_set.run(Pass { model, particles: shared, records: momentum, block, out, weights });
        },
    );
    particles.acceleration = acceleration;
}

struct Pass<'a, const D: usize> {
    model: &'a Model<D>,
    particles: &'a Particles<D>,
    records: &'a Records,
    block: usize,
    out: &'a mut [Vector<D>],
    weights: &'a mut [[f64; LANES]],
}

/// Inputs of the pair loops.
#[derive(Clone, Copy)]
struct Inputs<'a, const D: usize> {
    model: &'a Model<D>,
    particles: &'a Particles<D>,
    records: &'a Records,
    group: NeighbourGroup<'a>,
}

/// Forces on eight particles.
struct Forces<V, const D: usize> {
    /// Pressure and artificial viscosity `[m/s²]`.
    pressure: [V; D],
    /// (11) `[N/m³]`.
    viscous: [V; D],
}

impl<const D: usize> LanePass for Pass<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { model, particles, records, block, out, weights } = self;
        let region_start = block * model.list.region;
        for (offset, out) in out.chunks_mut(LANES).enumerate() {
            let group = model.list.group(block * (BLOCK / LANES) + offset);
            let inputs = Inputs { model, particles, records, group };
            let weights = &mut weights[group.first_pair - region_start..];
            let own = Partner::<V, D>::load(records, &group.own);
            let mut forces = Forces { pressure: zero_vector::<V, D>(), viscous: zero_vector::<V, D>() };
            let (flow_weights, wall_weights) = weights.split_at_mut(group.flow.len());
            flow_forces(inputs, flow_weights, &own, &mut forces);
            wall_forces(inputs, wall_weights, &own, &mut forces);
            if model.numerics.momentum_operator == MomentumOperator::PairwiseCorrected {
                let first = block * BLOCK + offset * LANES;
                // Γ of (14) is the moment matrix, whose blended inverse is the gradient correction
                let correction = particles.correction.load::<V>(first / LANES);
                let (gradient, deficit) = viscous_sums(inputs, weights, &own);
                forces.viscous = pair_viscosity::corrected(&forces.viscous, &gradient, &deficit, &correction);
            }
            let mut acceleration = forces.pressure;
            for i in 0..D {
                let viscous = forces.viscous[i] / own.density;
                acceleration[i] = forces.pressure[i] + viscous + V::splat(model.gravity[i]);
            }
            store_vector(&acceleration, out);
        }
    }
}

#[inline(always)]
fn flow_forces<V: Lanes, const D: usize>(
    inputs: Inputs<'_, D>,
    weights: &mut [[f64; LANES]],
    own: &Partner<V, D>,
    forces: &mut Forces<V, D>,
) {
    let Inputs { model, particles, records, group } = inputs;
    let smoothing_length = model.kernel.smoothing_length();
    let regularisation = V::splat(pair_distance::regularisation(smoothing_length));
    let speed_length = smoothing_length * model.equation_of_state.sound_speed();
    let alpha_a: V = gather(&particles.artificial_viscosity, &group.own);
    for (b, stored) in group.flow.zip(weights) {
        let other = Partner::<V, D>::load(records, &b);
        let r = difference(&own.position, &other.position);
        let slip = difference(&own.velocity, &other.velocity);
        let distance_squared = dot(&r, &r);
        let weight = model.kernel.gradient_weight(distance_squared, other.volume);
        *stored = weight.to_array();
        let regular = distance_squared + regularisation;
        let approach = dot(&r, &slip);
        // one division for the harmonic mean of the viscosities over r² and for 1/(ρ̄ r²)
        let density_sum = own.density + other.density;
        let viscosity_sum = own.viscosity + other.viscosity + V::splat(1e-30);
        let common = V::splat(1.0) / (viscosity_sum * regular * density_sum);
        let inverse_regular_density = common * viscosity_sum * V::splat(2.0);
        let harmonic = own.viscosity * other.viscosity * (common * density_sum);
        let alpha = match model.numerics.viscosity_switch {
            ViscositySwitch::Constant => V::splat(model.numerics.artificial_viscosity * speed_length),
            ViscositySwitch::MorrisMonaghan => {
                let alpha: V = gather(&particles.artificial_viscosity, &b);
                artificial_viscosity::mean_strength(alpha_a, alpha, speed_length)
            }
        };
        let push = artificial_viscosity::pair_factor(alpha, approach, approach, inverse_regular_density);
        let bracket = pressure_force::bracket(own.specific_pressure, other.specific_pressure);
        let rub = pair_viscosity::pair_factor::<V, D>(weight, harmonic, approach);
        accumulate(&mut forces.pressure, weight * other.density * (push - bracket), &r);
        accumulate(&mut forces.viscous, rub, &r);
    }
}

#[inline(always)]
fn wall_forces<V: Lanes, const D: usize>(
    inputs: Inputs<'_, D>,
    weights: &mut [[f64; LANES]],
    own: &Partner<V, D>,
    forces: &mut Forces<V, D>,
) {
    let Inputs { model, particles, group, .. } = inputs;
    let regularisation = V::splat(pair_distance::regularisation(model.kernel.smoothing_length()));
    for (w, stored) in group.wall.zip(weights) {
        let position = gather_vectors::<V, D>(&particles.position, &w);
        let volume: V = gather(&particles.volume, &w);
        let pressure: V = gather(&particles.pressure, &w);
        let r = difference(&own.position, &position);
        let distance_squared = dot(&r, &r);
        let weight = model.kernel.gradient_weight(distance_squared, volume);
        *stored = weight.to_array();
        let density = model.equation_of_state.density_of_wall(pressure);
        let slip = wall_difference::<V, D>(inputs, &w, &r, &own.velocity);
        let bracket = pressure_force::bracket(own.specific_pressure, pressure_force::specific(pressure, density));
        let (approach, regular) = (dot(&r, &slip), distance_squared + regularisation);
        let rub = pair_viscosity::wall_factor::<V, D>(weight, own.viscosity, approach, regular);
        accumulate(&mut forces.pressure, -(weight * density * bracket), &r);
        accumulate(&mut forces.viscous, rub, &r);
    }
}

/// v_aw of (18)–(20), relative to the wall.
#[inline(always)]
fn wall_difference<V: Lanes, const D: usize>(
    inputs: Inputs<'_, D>,
    w: &LaneIndices<'_>,
    r: &[V; D],
    velocity_a: &[V; D],
) -> [V; D] {
    let Inputs { model, particles, .. } = inputs;
    let places = w.places_from(particles.flow_count());
    let w = &places.indices();
    let normal = gather_vectors::<V, D>(&particles.walls.normal, w);
    let wall_velocity = gather_vectors::<V, D>(&particles.walls.velocity, w);
    let depth: V = gather(&particles.walls.depth, w);
    let beta = wall_slip::factor(r, &normal, depth, model.kernel.smoothing_length(), wall_slip::PAPER_LIMIT);
    scaled(beta, &difference(velocity_a, &wall_velocity))
}

/// Viscous sums of (13) beside (11): Σ V (μ_b + μ_a)(v_b − v_a) ⊗ ∇W, since with (9)
/// ∇(μv) − v_a∇μ = L Σ V μ_b (v_b − v_a) ∇W and μ_a∇v likewise, and Σ V ∇W.
#[inline(always)]
fn viscous_sums<V: Lanes, const D: usize>(
    inputs: Inputs<'_, D>,
    weights: &[[f64; LANES]],
    own: &Partner<V, D>,
) -> ([[V; D]; D], [V; D]) {
    let Inputs { particles, records, group, .. } = inputs;
    let mut deficit = zero_vector::<V, D>();
    let mut gradient = zero_tensor::<V, D>();
    let (flow_weights, wall_weights) = weights.split_at(group.flow.len());
    for (b, weight) in group.flow.zip(flow_weights) {
        let other = Partner::<V, D>::load(records, &b);
        let r = difference(&own.position, &other.position);
        let slip = difference(&own.velocity, &other.velocity);
        let weight = V::load(weight);
        accumulate(&mut deficit, weight, &r);
        accumulate_outer(&mut gradient, -weight * (other.viscosity + own.viscosity), &slip, &r);
    }
    for (w, weight) in group.wall.zip(wall_weights) {
        let position = gather_vectors::<V, D>(&particles.position, &w);
        let r = difference(&own.position, &position);
        let weight = V::load(weight);
        let slip = wall_difference::<V, D>(inputs, &w, &r, &own.velocity);
        accumulate(&mut deficit, weight, &r);
        accumulate_outer(&mut gradient, -weight * (own.viscosity + own.viscosity), &slip, &r);
    }
    (gradient, deficit)
}
