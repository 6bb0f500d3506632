//! The second pass over the pairs of a phase: rows of its pressure Poisson equation and of its viscous friction, both from
//! the F that the first pass has measured, by one division a pair.
//!
//! Coefficients are rounded to single precision once, and both rows of a pair get the same number; sums over a row are
//! taken of the rounded numbers, so that they agree with it. The operators are those of `projection/pressure_poisson`.

use super::super::boundary::AT_SURFACE;
use super::super::phase::records;
use super::super::terms::viscous_pair;
use super::super::{
    LEAST_GROUPS, LEAST_TASK, Periods, Phase, ProjectionNumerics, Stratification, SurfaceTreatment, height_axis,
};
use super::pressure_rows::PressureRows;
use super::surroundings::separation;
use crate::kernel::Kernel;
use crate::lanes::algebra::dot;
use crate::lanes::{LANES, LaneIndices, LaneNumbers, LanePass, Lanes, Real, gather};
use crate::linear::Single;
use crate::material::turbulence::eddy_viscosity;
use crate::parallel::prelude::*;
use crate::vector::Vector;

/// Quads of a record: the position, the moment M `[-]`, with a negative sign where neighbours are lacking, the viscosity
/// `[Pa·s]`, and the anisotropy δ `[-]` from the field [`anisotropy`] on.
const fn quads(dimensions: usize) -> usize {
    (anisotropy(dimensions) + dimensions * dimensions).div_ceil(4)
}

/// First field of the anisotropy.
const fn anisotropy(dimensions: usize) -> usize {
    dimensions + 2
}

/// Inputs of the viscous rows of a phase.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Friction<'a> {
    /// Dynamic viscosity of every particle `[Pa·s]`.
    pub(crate) viscosity: &'a [f64],
    /// The law of a pair's middle, where it is not the mean of both.
    pub(crate) middle: Option<MiddleViscosity<'a>>,
    /// Δt `[s]`.
    pub(crate) time_step: f64,
}

/// η of a fluid pair in the middle between its particles, at the mean of their rates: the mixing length grows by more than
/// itself within a spacing, and its square as a mean of both ends would be far too large.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MiddleViscosity<'a> {
    pub(crate) layer: &'a Stratification,
    /// Shear rate of every particle `[1/s]`.
    pub(crate) rate: &'a [f64],
    /// Density `[kg/m³]` and kinematic viscosity `[m²/s]`.
    pub(crate) density: f64,
    pub(crate) kinematic_viscosity: f64,
}

/// Rows of the friction: Δt k_ab `[kg]`, their chunks in every group, and Σ_b Δt k_ab `[kg]`.
pub(crate) struct FrictionRows<'a> {
    pub(crate) couplings: &'a mut [Single],
    pub(crate) width: &'a mut [u32],
    pub(crate) coupled: &'a mut [f64],
}

/// Fills the rows of a phase's pressure and, of a fluid, those of its friction; finds how near the surface particles are.
pub(crate) fn fill_rows<const D: usize>(
    phase: &mut Phase<D>,
    periods: &Periods<D>,
    numerics: &ProjectionNumerics,
    pressure: PressureRows<'_, D>,
    friction: Option<(Friction<'_>, FrictionRows<'_>)>,
) {
    find_mean_anisotropy(phase, periods, numerics.even_pairs);
    let mut nearness = std::mem::take(&mut phase.nearness);
    let mut records = std::mem::take(&mut phase.records);
    let (of_friction, friction) = friction.unzip();
    let viscosity = |a: usize| of_friction.map_or(0.0, |friction| friction.viscosity[a]);
    let moment = |a: usize| if phase.deficit[a] > 0.0 { -phase.moment[a] } else { phase.moment[a] };
    records::pack(&mut records, quads(D), &phase.position, |a, behind| {
        (behind[0], behind[1]) = (moment(a), viscosity(a));
        behind[2..2 + D * D].copy_from_slice(phase.mean_anisotropy[a].as_slice());
    });
    let pairs = Pairs {
        phase,
        records: &records,
        periods,
        kernel: &phase.kernel,
        friction: of_friction,
        eliminated: numerics.surface == SurfaceTreatment::Eliminated,
        surface_gain: numerics.surface_gain,
    };
    let stride = phase.free.stride;
    let (chunks, rows) = (LEAST_GROUPS * stride, LEAST_GROUPS * LANES);
    let links = (pressure.links.par_chunks_mut(chunks), pressure.width.par_chunks_mut(LEAST_GROUPS));
    let (own, held) = (pressure.own.par_chunks_mut(rows), pressure.held.par_chunks_mut(rows));
    let of_pressure = (own, held, pressure.diagonal.par_chunks_mut(rows), nearness.par_chunks_mut(rows));
    let of_friction = friction.map(|friction| {
        let couplings = (friction.couplings.par_chunks_mut(chunks), friction.width.par_chunks_mut(LEAST_GROUPS));
        (couplings, friction.coupled.par_chunks_mut(rows)).into_items()
    });
    (links, of_pressure, of_friction).enumerate().for_each(
        |(task, ((links, width), (own, held, diagonal, nearness), friction))| {
            let pressure = PressureRows { links, width, own, diagonal, held };
            let friction = friction.map(|((couplings, width), coupled)| FrictionRows { couplings, width, coupled });
            let out = Out { first: task * LEAST_GROUPS, stride, nearness, pressure, friction };
            phase.free.set.run(Task { pairs: &pairs, out });
        },
    );
    (phase.nearness, phase.records) = (nearness, records);
}

/// Mean of δ over the neighbours by −F, times a share `[-]`. What a flow does to the places of all neighbours is left of it; of
/// the disorder of single particles little, which the pressure may go on to smooth.
fn find_mean_anisotropy<const D: usize>(phase: &mut Phase<D>, periods: &Periods<D>, share: f64) {
    let mut means = std::mem::take(&mut phase.mean_anisotropy);
    if share > 0.0 {
        let own = phase.kernel.gradient_weight(0.0, 1.0);
        means.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(a, mean)| {
            let start = (phase.anisotropy[a] * own, own);
            let (sum, weight) = phase
                .free_pairs(a, periods)
                .fold(start, |(sum, weight), (b, _, of_pair)| (sum + phase.anisotropy[b] * of_pair, weight + of_pair));
            *mean = sum * (share / weight);
        });
    }
    phase.mean_anisotropy = means;
}

/// Inputs of the pass over pairs.
struct Pairs<'a, const D: usize> {
    phase: &'a Phase<D>,
    records: &'a [[f64; 4]],
    periods: &'a Periods<D>,
    kernel: &'a Kernel<D>,
    friction: Option<Friction<'a>>,
    eliminated: bool,
    surface_gain: f64,
}

/// Outputs of the pass over pairs, from a first group on.
struct Out<'a, const D: usize> {
    first: usize,
    stride: usize,
    nearness: &'a mut [f64],
    pressure: PressureRows<'a, D>,
    friction: Option<FrictionRows<'a>>,
}

struct Task<'a, 'b, const D: usize> {
    pairs: &'a Pairs<'b, D>,
    out: Out<'a, D>,
}

impl<const D: usize> LanePass for Task<'_, '_, D> {
    #[inline(always)]
    fn run<V: Lanes>(mut self) {
        for group in 0..self.out.pressure.width.len() {
            self.group::<V>(group);
        }
    }
}

/// Row sums of a group of eight particles.
struct RowSums<V, const D: usize> {
    gradient: [V; D],
    laplacian: V,
    coupled: V,
    /// Σ W times the deficit, and the largest deficit of a neighbour.
    near: V,
    largest: V,
}

impl<const D: usize> Task<'_, '_, D> {
    #[inline(always)]
    fn group<V: Lanes>(&mut self, group: usize) {
        let pairs = self.pairs;
        let phase = pairs.phase;
        let volume = phase.lattice_volume;
        let global = self.out.first + group;
        let zero = V::splat(0.0);
        let own = records::of_group::<V>(pairs.records, quads(D), global, phase.len());
        let across = pairs.periods.across(&own[..D], pairs.kernel.support());
        let own_moment = own[D].max(-own[D]);
        let (gradient_scale, laplacian_scale) = (V::splat(2.0 * volume), V::Single::splat(-4.0 * volume));
        let active = phase.active[global] as usize;
        let weights = &phase.weight[global * self.out.stride..][..active];
        let links = &mut self.out.pressure.links[group * self.out.stride..][..active];
        let own_deficit =
            gather::<V>(&phase.deficit, &LaneIndices::new(&records::group_indices(global, phase.len()), phase.len()));
        let near = pairs.kernel.value(zero) * own_deficit;
        let mut sums = RowSums { gradient: [zero; D], laplacian: zero, coupled: zero, near, largest: zero };
        for (k, chunk) in phase.free.first_of(global, active).enumerate() {
            let other = records::load::<V>(pairs.records, quads(D), &chunk);
            let separation = separation(&own, &other, pairs.periods, across);
            let measured = V::Single::load(&weights[k]);
            let weight = measured / (own_moment + other[D].max(-other[D])).narrow();
            let even = evened(&own, &other, &separation);
            for axis in 0..D {
                let gradient = (even[axis] * gradient_scale).narrow() * weight;
                links[k].gradient[axis] = gradient.to_array();
                sums.gradient[axis] = sums.gradient[axis] + V::widen(gradient);
            }
            let laplacian = laplacian_scale * weight;
            links[k].laplacian = laplacian.to_array();
            sums.laplacian = sums.laplacian + V::widen(laplacian);
            let measured = V::widen(measured);
            if let (Some(friction), Some(rows)) = (&pairs.friction, &mut self.out.friction) {
                let both = match &friction.middle {
                    None => own[D + 1] + other[D + 1],
                    Some(middle) => middle.of_pairs::<V, D>(global, &own, &separation, measured, &chunk),
                };
                let coupling =
                    viscous_pair::of_weight(friction.time_step, (volume, volume), V::widen(weight), both).narrow();
                rows.couplings[group * self.out.stride + k] = Single(coupling.to_array());
                sums.coupled = sums.coupled + V::widen(coupling);
            }
            if other[D].less_mask(zero) != 0 {
                let deficit = gather::<V>(&phase.deficit, &chunk).where_less(measured, zero);
                sums.near = sums.near + pairs.kernel.value(dot(&separation, &separation)) * deficit;
                sums.largest = sums.largest.max(deficit);
            }
        }
        self.out.pressure.width[group] = active as u32;
        if let Some(rows) = &mut self.out.friction {
            rows.width[group] = active as u32;
        }
        self.store(group, &sums);
    }

    #[inline(always)]
    fn store<V: Lanes>(&mut self, group: usize, sums: &RowSums<V, D>) {
        let phase = self.pairs.phase;
        let volume = phase.lattice_volume;
        let near = (V::splat(self.pairs.surface_gain * volume) * sums.near).min(V::splat(1.0)).to_array();
        let (laplacian, coupled, largest) =
            (sums.laplacian.to_array(), sums.coupled.to_array(), sums.largest.to_array());
        let mut gradient = [[0.0; LANES]; D];
        for axis in 0..D {
            gradient[axis] = sums.gradient[axis].to_array();
        }
        let first = group * LANES;
        let rows = &mut self.out.pressure;
        for lane in 0..LANES.min(rows.diagonal.len() - first) {
            let (slot, a) = (first + lane, self.out.first * LANES + first + lane);
            let walls = phase.wall_sums[a];
            for axis in 0..D {
                rows.own[slot][axis] = gradient[axis][lane];
            }
            rows.own[slot][height_axis(D)] += 2.0 * volume / phase.moment[a] * walls.arm;
            // what is missing counts as mirrored neighbours with −P_b: from half a spacing below the surface twice
            // P_a away, from one and a half 4/3
            let complete = 2.0 * volume * (phase.lattice.diagonal + walls.weight);
            let missing = (complete - laplacian[lane]).max(0.0);
            let mirror = if self.pairs.eliminated {
                f64::from(largest[lane] > AT_SURFACE)
            } else {
                near[lane] * (4.0 / 3.0 + 2.0 / 3.0 * phase.deficit[a])
            };
            // what is no unknown has no diagonal
            let known = self.pairs.eliminated && phase.at_surface[a];
            rows.held[slot] = if known { 0.0 } else { mirror * missing };
            rows.diagonal[slot] = if known { 0.0 } else { laplacian[lane] + mirror * missing };
            self.out.nearness[slot] = near[lane];
            if let Some(rows) = &mut self.out.friction {
                rows.coupled[slot] = coupled[lane];
            }
        }
    }
}

/// (1 − ½ (δ_a + δ_b)) r `[m]` of eight pairs.
#[inline(always)]
fn evened<V: Lanes, const D: usize>(
    own: &[V; records::FIELDS],
    other: &[V; records::FIELDS],
    separation: &[V; D],
) -> [V; D] {
    let mut even = *separation;
    for j in 0..D {
        let half = V::splat(0.5) * separation[j];
        for i in 0..D {
            let field = anisotropy(D) + j * D + i;
            even[i] = even[i] - (own[field] + other[field]) * half;
        }
    }
    even
}

impl MiddleViscosity<'_> {
    /// η_a + η_b `[Pa·s]` of eight pairs, those within reach.
    #[inline(always)]
    fn of_pairs<V: Lanes, const D: usize>(
        &self,
        group: usize,
        own: &[V; records::FIELDS],
        separation: &[V; D],
        measured: V,
        partners: &LaneIndices<'_>,
    ) -> V {
        let own_indices = records::group_indices(group, self.rate.len());
        let rate = gather::<V>(self.rate, &LaneIndices::new(&own_indices, self.rate.len()));
        let rate = (V::splat(0.5) * (rate + gather::<V>(self.rate, partners))).to_array();
        let mut middle = [[0.0; LANES]; D];
        for axis in 0..D {
            middle[axis] = (own[axis] - V::splat(0.5) * separation[axis]).to_array();
        }
        let near = measured.less_mask(V::splat(0.0));
        let mut viscosity = [0.0; LANES];
        for lane in 0..LANES {
            if near >> lane & 1 == 1 {
                let place = Vector::<D>::from_fn(|axis, _| middle[axis][lane]);
                let (solid_fraction, mixing_length) = self.layer.mixing_at(&place);
                let eddy = eddy_viscosity(mixing_length, rate[lane]);
                viscosity[lane] = 2.0 * (1.0 - solid_fraction) * self.density * (self.kinematic_viscosity + eddy);
            }
        }
        V::load(&viscosity)
    }
}
