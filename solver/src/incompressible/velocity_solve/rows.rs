//! The rows of M + Δt K beside those of the fluid's viscous pairs: the sediment's friction, the bed's, the drag; and what
//! all rows begin with.

use super::super::boundary;
use super::super::columns::drag::ColumnDrag;
use super::super::passes::drag_exchange::DragExchange;
use super::super::passes::viscosities::Viscosities;
use super::super::terms::{drag_pair, viscous_pair};
use super::super::{IncompressibleScene, Periods, Phase, Phases, Sediment, height_axis};
use super::VelocitySystem;
use super::pair_law::{self, End};
use crate::lanes::LANES;
use crate::linear::{Row as Links, Single, single};
use crate::parallel::prelude::*;
use crate::vector::Vector;

/// A row that is being filled.
struct Row<'a, 'b> {
    links: &'a mut Links<'b, Single>,
    coupled: f64,
    held: f64,
}

impl Row<'_, '_> {
    /// A pair with a free particle: Δt k_ab `[kg]`.
    #[inline(always)]
    fn couple(&mut self, partner: usize, coefficient: f64) {
        let coefficient = single(coefficient);
        self.links.push(partner as u32, coefficient);
        self.coupled += coefficient;
    }
}

/// All that the rows of a step are made of.
#[derive(Debug, Clone, Copy)]
pub(crate) struct VelocityRows<'a, const D: usize> {
    pub(crate) scene: &'a IncompressibleScene<D>,
    pub(crate) phases: &'a Phases<D>,
    pub(crate) exchange: &'a DragExchange<D>,
    pub(crate) periods: &'a Periods<D>,
    pub(crate) viscosities: &'a Viscosities<D>,
    /// Drag exchange of the fluid with columns of grains, if there are any.
    pub(crate) columns: Option<&'a ColumnDrag>,
    /// Δt `[s]`.
    pub(crate) time_step: f64,
}

/// Inertia, velocity and forces that a row begins with.
struct Begin<const D: usize> {
    inertia: f64,
    velocity: Vector<D>,
    gravity: Vector<D>,
    /// Push of the moving grains of columns along the bed, Σ β U, and of those that it carries across it `[N]`.
    push: (f64, f64),
}

impl<const D: usize> VelocityRows<'_, D> {
    /// Fills the rows of M + Δt K and the momenta before the solve.
    pub(crate) fn assemble(&self, system: &mut VelocitySystem<D>) {
        let Phases { fluid, sediment } = self.phases;
        let rows = fluid.len() + sediment.as_ref().map_or(0, Phase::len);
        let of_sediment = |s: &Phase<D>| s.free.stride + self.exchange.of_sediment.stride;
        let stride = self.exchange.of_fluid.stride.max(sediment.as_ref().map_or(0, of_sediment));
        system.resize(rows);
        let VelocitySystem {
            coupled: of_fluid,
            beside: couplings,
            diagonal,
            of_constant,
            inertia,
            momentum,
            velocity,
            ..
        } = system;
        let beside = (
            diagonal.par_chunks_mut(LANES),
            of_constant.par_chunks_mut(LANES),
            inertia.par_chunks_mut(LANES),
            momentum.par_chunks_mut(LANES),
            velocity.par_chunks_mut(LANES),
        );
        couplings.fill(rows, stride, beside.into_items(), |first, group, beside| {
            let (diagonal, sum, inertia, momentum, velocity) = beside;
            for lane in 0..diagonal.len() {
                let (coupled, held, begin) = group.row(lane, |links| {
                    let mut row = Row { links, coupled: 0.0, held: 0.0 };
                    let begin = self.fill(first + lane, &mut row);
                    (row.coupled, row.held, begin)
                });
                (inertia[lane], velocity[lane]) = (begin.inertia, begin.velocity);
                sum[lane] = inertia[lane] + held;
                diagonal[lane] = sum[lane] + coupled + of_fluid.get(first + lane).copied().unwrap_or(0.0);
                momentum[lane] = (velocity[lane] + begin.gravity * self.time_step) * inertia[lane];
                momentum[lane][0] += begin.push.0 * self.time_step;
                momentum[lane][height_axis(D)] += begin.push.1 * self.time_step;
            }
        });
    }

    fn fill(&self, index: usize, row: &mut Row<'_, '_>) -> Begin<D> {
        let Phases { fluid, sediment } = self.phases;
        match (sediment, &self.scene.sediment) {
            (Some(sediment), Some(material)) if index >= fluid.len() => {
                let a = index - fluid.len();
                self.sediment_row(a, sediment, material, row);
                let (inertia, velocity) = (sediment.mass[a], sediment.velocity[a]);
                Begin { inertia, velocity, gravity: material.gravity, push: (0.0, 0.0) }
            }
            _ => {
                self.fluid_row(index, row);
                let inertia = fluid.mass[index] * self.viscosities.voidage[index];
                let push = self.columns.map_or((0.0, 0.0), |drag| (drag.push[index], drag.burden[index]));
                Begin { inertia, velocity: fluid.velocity[index], gravity: self.scene.fluid.gravity, push }
            }
        }
    }

    fn fluid_row(&self, a: usize, row: &mut Row<'_, '_>) {
        let (fluid, viscosity) = (&self.phases.fluid, &self.viscosities.fluid);
        let Self { scene, time_step, .. } = *self;
        if let Some(drag) = self.columns {
            row.held += time_step * drag.hold[a];
        }
        row.held += boundary::friction(scene.fluid.bed, fluid, a, viscosity[a], time_step);
        let (Some(sediment), Some(material)) = (&self.phases.sediment, &scene.sediment) else { return };
        for pair in self.exchange.of_fluid.of(a) {
            let b = pair.source as usize;
            let own = || sediment.velocity.get(b).copied().unwrap_or_else(Vector::zeros);
            let slip = || (own() - fluid.velocity[a]).norm();
            let of_pair = self.exchange.factor(b, material, slip, scene);
            let coefficient = drag_pair::coefficient(time_step, fluid.mass[a], pair.value, of_pair);
            if b < sediment.len() {
                row.couple(fluid.len() + b, coefficient);
            } else {
                row.held += coefficient;
            }
        }
    }

    fn sediment_row(&self, a: usize, sediment: &Phase<D>, material: &Sediment<D>, row: &mut Row<'_, '_>) {
        let (fluid, viscosities) = (&self.phases.fluid, self.viscosities);
        let end = |b: usize| End { load: viscosities.load[b], viscosity: viscosities.sediment[b] };
        let volumes = (sediment.lattice_volume, sediment.lattice_volume);
        for (b, separation, gradient) in sediment.free_pairs(a, self.periods) {
            let moments = sediment.moment[a] + sediment.moment[b];
            let rate = (sediment.sliding_rate, sediment.velocity[a] - sediment.velocity[b]);
            let both = self.pair_viscosity(material, (end(a), end(b)), rate, &separation)
                + self.added(&sediment.position[a], &separation);
            let coefficient = viscous_pair::coefficient(self.time_step, volumes, moments, gradient, both);
            row.couple(fluid.len() + b, coefficient);
        }
        let layer = self.scene.solid_fraction.stratification();
        for (b, separation, gradient) in sediment.wall_pairs(a, self.periods) {
            let load = material.load.at(&sediment.wall[b], layer);
            let ends = (end(a), End { load, viscosity: viscosities.sediment[a] });
            let rate = (sediment.sliding_rate, sediment.velocity[a]);
            let both =
                self.pair_viscosity(material, ends, rate, &separation) + self.added(&sediment.position[a], &separation);
            let moments = 2.0 * sediment.moment[a];
            row.held += viscous_pair::coefficient(self.time_step, volumes, moments, gradient, both);
        }
        for pair in self.exchange.of_sediment.of(a) {
            let b = pair.source as usize;
            let slip = || (fluid.velocity[b] - sediment.velocity[a]).norm();
            let of_pair = self.exchange.factor(a, material, slip, self.scene);
            row.couple(b, drag_pair::coefficient(self.time_step, fluid.mass[b], pair.value, of_pair));
        }
    }

    /// Twice the viscosity `[Pa·s]` that the water between the grains of a pair adds to their friction, in the middle.
    #[inline]
    fn added(&self, position: &Vector<D>, separation: &Vector<D>) -> f64 {
        let fluid = &self.scene.fluid;
        self.scene.solid_fraction.stratification().map_or(0.0, |layer| {
            let stratum = layer.at(&(position - separation * 0.5));
            2.0 * (1.0 - stratum.solid_fraction) * fluid.density * fluid.kinematic_viscosity * stratum.added_viscosity
        })
    }

    /// η_a + η_b `[Pa·s]` of a sediment particle with another or with a wall, at the rate of sliding rows over that of pairs
    /// `[-]` and a difference of velocities `[m/s]`.
    #[inline]
    fn pair_viscosity(
        &self,
        material: &Sediment<D>,
        ends: (End, End),
        rate: (f64, Vector<D>),
        separation: &Vector<D>,
    ) -> f64 {
        let (sliding_rate, difference) = rate;
        let own_rate = || (difference.norm_squared() / separation.norm_squared()).sqrt();
        pair_law::viscosities::<D>(&material.law, self.scene.numerics.pair_law, ends, sliding_rate, own_rate)
    }
}
