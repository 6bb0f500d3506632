//! Action of a wall particle on a flow particle in the momentum equation: read by the pass of the forces, and by the
//! one that books them to facet walls.

use super::flow_partner::{Constants, FlowPartner};
use super::layout::Momentum;
use super::pair_weights::PairParts;
use super::precision::Precision;
use super::records::{self, LaneRecord, Records};
use crate::lanes::algebra::{difference, dot, load_tensor, matrix_product, product, scaled};
use crate::lanes::{LANES, LaneIndices, LaneNumbers, Lanes, Real, gather_tensors};
use crate::weakly_compressible::terms::{hourglass, no_slip, stress_divergence, wall_slip};
use crate::weakly_compressible::{Model, Particles};
use std::ops::Range;

/// Neighbour data of a wall particle: records of the length of [`FlowPartner`]'s with a layout of their own.
pub(super) struct WallPartner<V, const D: usize> {
    pub(super) position: [V; D],
    /// Velocity of the wall itself.
    pub(super) velocity: [V; D],
    /// Depth behind the surface `[m]`.
    pub(super) depth: V,
    /// √(p/ρ0) `[m/s]`.
    pub(super) pressure_speed: V,
    /// σ `[Pa]`.
    pub(super) stress: [[V; D]; D],
    pub(super) normal: [V; D],
    /// 1 of a smooth wall, 0 of a rough one `[-]`.
    pub(super) smoothness: V,
}

impl<V: Real, const D: usize> WallPartner<V, D> {
    #[inline(always)]
    fn of<P: Precision>(record: &LaneRecord<V>) -> Self {
        Self {
            position: records::vector(record, 0),
            velocity: records::vector(record, Momentum::<P, D>::VELOCITY),
            depth: records::scalar(record, Momentum::<P, D>::DENSITY),
            pressure_speed: records::scalar(record, Momentum::<P, D>::SPEED),
            stress: records::tensor(record, Momentum::<P, D>::STRESS),
            normal: records::vector(record, Momentum::<P, D>::LAST),
            smoothness: records::scalar(record, Momentum::<P, D>::LAST + D),
        }
    }
}

/// The parts of a pair's force, both still to be multiplied by the pair's weight V F.
pub(super) struct WallPair<V, const D: usize> {
    /// Traction `[Pa m]`: over ρ_a an acceleration.
    pub(super) traction: [V; D],
    /// 2 ν `[m²/s]` of the hourglass control.
    pub(super) drag: V,
    /// Velocity that it acts on `[m/s]`.
    pub(super) unexplained: [V; D],
}

/// A group of particles as walls see it.
pub(super) struct WallGroup<'a, V, const D: usize> {
    particles: &'a Particles<D>,
    own: FlowPartner<V, D>,
    correction: [[V; D]; D],
    viscous: ViscousPart<V, D>,
}

/// Part of a particle's stress that needs no pressure: [`no_slip`] takes it.
struct ViscousPart<V, const D: usize> {
    /// Share of the stress `[-]`: 1 of a liquid, 0 of grains.
    share: V,
    /// That share of s E `[Pa]`.
    stress: [[V; D]; D],
    /// Twice its viscosity `[Pa·s]`.
    twice_viscosity: V,
}

impl<'a, S: Real, const D: usize> WallGroup<'a, S, D> {
    /// Of the particles at `places`, whose velocity gradient is whole, unlike in a record.
    #[inline(always)]
    pub(super) fn of<V: Lanes, P: Precision<Lanes<V> = S>>(
        model: &Model<D>,
        particles: &'a Particles<D>,
        mut own: FlowPartner<S, D>,
        places: Range<usize>,
    ) -> Self {
        let whole = particles.force_correction.load::<V>(places.start / LANES);
        let gradient = load_tensor::<V, D>(&particles.velocity_gradient[places.clone()]);
        let viscosities = &particles.viscosity[places.clone()];
        let (viscosity, share) = model.rheology.viscosity_without_pressure(&gradient, viscosities);
        let stress = matrix_product(&load_tensor::<V, D>(&particles.stress[places]), &whole);
        let mut viscous = ViscousPart {
            share: P::narrow(share),
            stress: own.velocity_gradient,
            twice_viscosity: P::narrow(viscosity + viscosity),
        };
        let mut correction = own.velocity_gradient;
        for i in 0..D {
            for j in 0..D {
                own.velocity_gradient[i][j] = P::narrow(gradient[i][j]);
                correction[i][j] = P::narrow(whole[i][j]);
                viscous.stress[i][j] = P::narrow(share * stress[i][j]);
            }
        }
        Self { particles, own, correction, viscous }
    }

    /// With no more resistance of all wall partners together than an explicit step bears.
    #[inline(always)]
    pub(super) fn bounded<V: Lanes, P: Precision<Lanes<V> = S>>(
        mut self,
        constants: &Constants,
        records: &Records<P>,
        mut pairs: PairParts<'_, P, V, D>,
    ) -> Self
    where
        S: LaneNumbers<Number = P>,
    {
        let none = S::splat(0.0);
        if !none.any_less(self.viscous.twice_viscosity) {
            return self;
        }
        let mut resistance = none;
        while let Some(pairs) = pairs.next() {
            for (w, weight) in pairs {
                let wall = WallPartner::of::<P>(&records.load::<V>(const { Momentum::<P, D>::QUADS }, &w));
                let r = records.apart::<V, D>(&self.own.position, &wall.position);
                let beta =
                    wall_slip::factor(&r, &wall.normal, wall.depth, constants.smoothing_length, wall_slip::LIMIT);
                let rough = S::splat(1.0) - wall.smoothness;
                resistance = resistance - S::load(weight) * rough * no_slip::response(beta);
            }
        }
        let borne = no_slip::borne(resistance, constants.viscous_step);
        self.viscous.twice_viscosity = self.viscous.twice_viscosity * borne;
        self
    }

    /// Parts of the forces of eight wall particles.
    #[inline(always)]
    pub(super) fn pair<V: Lanes, P: Precision<Lanes<V> = S>>(
        &self,
        constants: &Constants,
        records: &Records<P>,
        indices: &LaneIndices<'_>,
    ) -> WallPair<S, D> {
        let Self { particles, own, correction, viscous } = self;
        let wall = WallPartner::of::<P>(&records.load::<V>(const { Momentum::<P, D>::QUADS }, indices));
        let r = records.apart::<V, D>(&own.position, &wall.position);
        let beta = wall_slip::factor(&r, &wall.normal, wall.depth, constants.smoothing_length, wall_slip::LIMIT);
        let (mut slip, mut gradient) = (difference(&own.velocity, &wall.velocity), own.velocity_gradient);
        if constants.turns {
            // seen from the wall, whose velocity is that of its surface in front of its particle
            let places = indices.places_from(particles.flow_count());
            let spin = gather_tensors::<V, D>(&particles.walls.spin, &places.indices());
            let way = difference(&r, &scaled(wall.depth, &wall.normal));
            for i in 0..D {
                let spin = spin[i].map(|part| P::narrow(part));
                slip[i] = slip[i] - dot(&spin, &way);
                gradient[i] = difference(&gradient[i], &spin);
            }
        }
        let slip = scaled(beta, &slip);
        let mut traction = stress_divergence::wall_traction(&own.corrected_stress, &wall.stress, correction, &r);
        let corrected = product(correction, &r);
        let rough = S::splat(1.0) - wall.smoothness;
        let wall_pressure = S::splat(constants.reference_density) * wall.pressure_speed * wall.pressure_speed;
        let shear = no_slip::slip_at_middle(&slip, beta, &gradient, &wall.normal, &r);
        let rub = no_slip::traction(viscous.twice_viscosity, &shear, &wall.normal, &r, &corrected);
        for i in 0..D {
            let extrapolated = dot(&wall.stress[i], &corrected) + wall_pressure * corrected[i];
            let replaced = dot(&viscous.stress[i], &r) + viscous.share * extrapolated;
            traction[i] = traction[i] + rough * (rub[i] - replaced);
        }
        // a wall of grains takes the share of the flow
        let speed_sum = own.pressure_speed + if constants.of_grains { own.pressure_speed } else { wall.pressure_speed };
        let drag = hourglass::twice_viscosity(constants.hourglass_strength, speed_sum);
        let unexplained = hourglass::unexplained_at_wall(&slip, &gradient, &r, &wall.normal);
        WallPair { traction, drag, unexplained }
    }
}
