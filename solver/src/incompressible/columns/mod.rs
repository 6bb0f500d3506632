//! Grains that dilate, by columns.
//!
//! Particles carry mass and momentum ([`grains`]); vertical columns at least some grains wide, with nodes closer than the
//! particles ([`grid`]), carry the mechanics. Pair sums cannot: dilation parts the rows of grains and leaves their spacing
//! along the bed, so that at a small φ a row is a rigid raft that no neighbour reaches, at any resolution. A step:
//!
//! 1. [`nodes`]: particles to nodes; φ, the overburden p′ and φ* = φ_max/(1 + B I); φ to the [`Stratification`]. Where eddies
//!    carry grains, [`suspension`] gives p′ and φ*.
//! 2. [`drag`]: what nodes and water exchange, implicit in the water's velocities, the opposite on the nodes.
//! 3. [`friction`]: the law of the grains at p′, implicit on each column; −∂p′/∂x between columns.
//! 4. [`dilation`], or [`suspension`]: the motion across the bed, from the constraint that φ tends to φ*.
//! 5. Nodes to particles: each takes the change of velocity that its nodes have had, and relaxes towards their velocity.
//!    Mass is exact because particles have it, momentum because the weights of both ways are the same.
//!
//! A column's mean is over its width, so a bed may be as uneven as its columns resolve.

mod dilation;
pub(super) mod drag;
mod driven;
mod fluctuation;
mod friction;
mod grains;
mod grid;
mod nodes;
mod suspension;
#[cfg(test)]
pub(super) mod tests;

pub use driven::DrivenGrains;
pub(super) use fluctuation::relax_fluctuation;
pub use grains::Grains;

use super::divergence::Quantity;
use super::stratification::ColumnRow;
use super::{
    ColumnNumerics, Failure, IncompressibleScene, Phase, Sediment, SedimentPressure, SolidFraction, Stratification,
    height_axis,
};
use crate::domain::AxisBoundary;
use crate::material::dilatancy::Dilatancy;
use crate::run::ForeignState;
use crate::vector::{Tensor, Vector};
use dilation::find_lifts;
use drag::ColumnDrag;
use friction::{Chain, FrictionSolve};
use grid::ColumnGrid;
use nodes::{NodeLaws, Nodes};
use suspension::{Suspension, SuspensionLaws};

/// Places `[m]`, velocities `[m/s]` and impulses of the pressure on nodes `[kg/(m s)]`.
pub(super) type Saved<const D: usize> = (Vec<Vector<D>>, Vec<Vector<D>>, Vec<f64>);

/// The grains of a scene that dilate, and their columns.
#[derive(Debug)]
pub struct Columns<const D: usize> {
    /// The grains.
    pub grains: Grains<D>,
    /// Exchange with the fluid.
    pub drag: ColumnDrag,
    /// The columns.
    pub grid: ColumnGrid,
    nodes: Nodes,
    dilatancy: Dilatancy,
    numerics: ColumnNumerics,
    /// Grains that eddies carry, if they do.
    suspension: Option<Suspension>,
    friction: FrictionSolve,
    /// Impulse of the fluid's pressure on the grains of every node, which the next step brings `[kg/(m s)]`.
    pub pressed: Vec<f64>,
    chain: Chain,
    /// Velocities of the nodes after the step `[m/s]`.
    velocity: Vec<f64>,
    /// Velocities across the bed at the faces above the nodes `[m/s]`.
    lift: Vec<f64>,
    /// Impulse of held grains on fluid and free grains in the last step `[kg m/s]`, per metre of width in 2-D.
    held_impulse: f64,
}

impl<const D: usize> Columns<D> {
    /// The columns of a scene whose grains dilate, and its strata on their nodes in place of those that are given.
    pub(super) fn of(scene: &mut IncompressibleScene<D>) -> Option<Self> {
        let material = scene.sediment.as_ref()?;
        let SedimentPressure::Dilatant { dilatancy, fixed_filling, columns: numerics, turbulent_schmidt } =
            material.pressure
        else {
            return None;
        };
        let strata = scene.solid_fraction.stratification()?.strata();
        let normal = height_axis(D);
        let half = 0.5 * material.spacing;
        let held = material.wall.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), place| {
            (low.min(place[normal] - half), high.max(place[normal] + half))
        });
        let row = column_row(scene, material, &numerics)?;
        let top = strata.base + strata.interval * strata.solid_fraction.len() as f64;
        let grid = ColumnGrid::over(row, numerics.node_ratio * material.spacing, held, top);
        let wall = (material.wall.as_slice(), material.spacing, fixed_filling);
        let nodes = Nodes::with_fixed(&grid, &dilatancy, wall);
        let grains = Grains::of(material);
        let suspension = (turbulent_schmidt > 0.0).then(|| {
            let laws = SuspensionLaws::of(scene, material, dilatancy, strata.buoyant_weight);
            Suspension::new(laws, turbulent_schmidt, &grid)
        });
        let mut new = Self {
            grains,
            drag: ColumnDrag::default(),
            nodes,
            dilatancy,
            numerics,
            suspension,
            friction: FrictionSolve::default(),
            pressed: vec![0.0; grid.len()],
            chain: Chain::default(),
            velocity: vec![0.0; grid.len()],
            lift: vec![0.0; grid.len()],
            held_impulse: 0.0,
            grid,
        };
        new.friction.reserve(grid.nodes);
        new.chain.reserve(grid.nodes);
        let fluid = &scene.fluid;
        new.drag.reserve(&grid, fluid.particles.position.len(), numerics.drag_reach * fluid.spacing);
        let on_nodes = Stratification::on_columns(strata, row, grid.base - 0.5 * grid.cell, grid.cell, grid.nodes);
        scene.solid_fraction = SolidFraction::Averaged(on_nodes);
        Some(new)
    }

    /// Grains and the impulses that their next step brings.
    pub(super) fn save(&self) -> Saved<D> {
        (self.grains.position.clone(), self.grains.velocity.clone(), self.pressed.clone())
    }

    /// Continues from saved grains.
    pub(super) fn restore(&mut self, (position, velocity, pressed): Saved<D>) -> Result<(), ForeignState> {
        ForeignState::check("grains", position.len(), self.grains.len())?;
        ForeignState::check("velocities of grains", velocity.len(), self.grains.len())?;
        ForeignState::check("nodes of columns", pressed.len(), self.pressed.len())?;
        (self.grains.position, self.grains.velocity, self.pressed) = (position, velocity, pressed);
        Ok(())
    }

    /// Particles to nodes, φ to the stratification, and the drag that follows, with the mean velocity gradients of the fluid
    /// `[1/s]`.
    ///
    /// # Errors
    /// A slip that the drag law does not cover.
    pub(super) fn gather(
        &mut self,
        scene: &mut IncompressibleScene<D>,
        fluid: &Phase<D>,
        gradients: &[Tensor<D>],
    ) -> Result<(), Failure> {
        let reach = self.numerics.drag_reach * scene.fluid.spacing;
        if let SolidFraction::Averaged(layer) = &mut scene.solid_fraction {
            let strata = layer.strata();
            let laws = NodeLaws {
                dilatancy: &self.dilatancy,
                buoyant_weight: strata.buoyant_weight,
                suspension_viscosity: &strata.suspension_viscosity,
                fluid_viscosity: scene.fluid.density * scene.fluid.kinematic_viscosity,
            };
            self.nodes.gather(&self.grid, &self.grains, laws);
            layer.renew(|fraction| fraction.copy_from_slice(&self.nodes.fraction));
            if let Some(suspension) = &mut self.suspension {
                suspension.find_eddies(&self.grid, fluid, gradients, layer, reach);
                suspension.balance(&self.grid, &mut self.nodes);
                suspension.burden(&self.grid, fluid, reach, &mut self.drag.burden);
            }
        }
        let Some(material) = &scene.sediment else { return Ok(()) };
        self.drag.find(&self.grid, &self.nodes, fluid, scene, material, reach)
    }

    /// Moves the grains by a step, given the velocities that the drag has left the fluid with `[m/s]`.
    ///
    /// # Errors
    /// Friction that is not solved, a grain that would move by more than its spacing.
    pub(super) fn advance(
        &mut self,
        material: &Sediment<D>,
        predicted: &[Vector<D>],
        time_step: f64,
    ) -> Result<(), Failure> {
        self.drag.react(&self.grid, &self.nodes, predicted, time_step);
        self.held_impulse = 0.0;
        self.velocity.copy_from_slice(&self.nodes.velocity);
        for column in 0..self.grid.row.count {
            self.rub(column, material, time_step)?;
            let range = self.grid.of_column(column);
            let fractions = (&self.nodes.fraction[range.clone()], &self.nodes.target[range.clone()]);
            find_lifts(&self.grid, fractions, self.numerics.dilation_time, &mut self.lift[range]);
        }
        self.scatter(material, time_step)
    }

    /// Hands the grains their share −φ ∂p/∂x of what the pressure has done along the bed: the fluid, whose inertia is that of
    /// its share of the space, has felt the rest. `predicted` is the fluid's velocity before the pressure `[m/s]`.
    pub(super) fn press(&mut self, fluid: &Phase<D>, voidage: &[f64], predicted: &[Vector<D>]) {
        let Self { grid, nodes, pressed, .. } = self;
        pressed.fill(0.0);
        for (a, voidage) in voidage.iter().enumerate().filter(|(_, voidage)| **voidage < 1.0) {
            let impulse = (1.0 - voidage) * fluid.mass[a] * (fluid.velocity[a][0] - predicted[a][0]);
            let weights = grid.weights(fluid.position[a][0], fluid.position[a][height_axis(D)]);
            let fraction = weights.iter().fold(0.0, |sum, (node, weight)| sum + weight * nodes.fraction[*node]);
            if fraction > 0.0 {
                for (node, weight) in weights {
                    pressed[node] += impulse / grid.row.width * weight * nodes.fraction[node] / fraction;
                }
            }
        }
    }

    /// Gravity, the fluid and friction along the bed in a column.
    fn rub(&mut self, column: usize, material: &Sediment<D>, time_step: f64) -> Result<(), Failure> {
        let Self { grid, nodes, numerics, pressed, drag, .. } = self;
        let range = grid.of_column(column);
        let lowest = range.start + grid.held;
        let width = grid.row.width;
        let of_fluid = |node: usize| drag.impulse[node] + pressed[node];
        // the fluid pushes what is held as well
        self.held_impulse -= width * (range.start..lowest).map(of_fluid).sum::<f64>();
        let Some(top) = nodes.top(grid, column).filter(|top| *top >= grid.held) else { return Ok(()) };
        let free = lowest..range.start + top + 1;
        let chain = &mut self.chain;
        chain.clear();
        let mut below = lowest - 1;
        for node in free.clone() {
            // nothing rubs in the gaps between suspended grains
            if self.suspension.is_some() && !nodes.has_grains(node) {
                continue;
            }
            let driven = self.velocity[node] + material.gravity[0] * time_step;
            let pushed = nodes.push_of_columns(grid, node) * time_step;
            chain.momentum.push(nodes.mass[node] * driven + of_fluid(node) + pushed);
            chain.mass.push(nodes.mass[node]);
            chain.distance.push(if node == below + 1 { grid.cell } else { (node - below) as f64 * grid.cell });
            chain.load_below.push(nodes.load[node - 1]);
            chain.added_below.push(nodes.added[node - 1]);
            chain.velocity.push(self.velocity[node]);
            chain.node.push(node);
            below = node;
        }
        let held = self.friction.solve(&material.law, time_step, chain, numerics).map_err(|change| {
            let limit = numerics.friction_tolerance;
            Failure { row: 0, quantity: Quantity::GrainFriction, value: change, limit }
        })?;
        self.held_impulse -= held * time_step * width;
        for (node, velocity) in chain.node.iter().zip(&chain.velocity) {
            self.velocity[*node] = *velocity;
        }
        // what is above the grains moves as they do
        let highest = self.velocity[free.end - 1];
        self.velocity[free.end..range.end].fill(highest);
        Ok(())
    }

    /// Nodes to particles, and their motion.
    fn scatter(&mut self, material: &Sediment<D>, time_step: f64) -> Result<(), Failure> {
        let Self { grid, nodes, numerics, velocity, lift, grains, held_impulse, suspension, .. } = self;
        let normal = height_axis(D);
        let share = (time_step / numerics.relaxation_time).min(1.0);
        for particle in 0..grains.len() {
            let (along, height) = (grains.position[particle][0], grains.position[particle][normal]);
            let (mut new, mut change, mut of_held) = (0.0, 0.0, 0.0);
            for (node, weight) in grid.weights(along, height) {
                new += weight * velocity[node];
                change += weight * (velocity[node] - nodes.velocity[node]);
                of_held += if node % grid.nodes < grid.held { weight } else { 0.0 };
            }
            let before = grains.velocity[particle][0];
            let own = before + change;
            // held nodes take the weight along the bed and the momentum of what is near them
            let taken = material.gravity[0] * time_step + share * before;
            *held_impulse -= grains.mass[particle] * of_held * taken;
            let up = match suspension {
                Some(suspension) => suspension.lift(grid, along, height, numerics.dilation_time),
                // each face lies half a cell above its node
                None => grid.at(lift, along, height - 0.5 * grid.cell),
            };
            grains.velocity[particle][0] = own + share * (new - own);
            grains.velocity[particle][normal] = up;
            let mut way = Vector::<D>::zeros();
            way[0] = new * time_step;
            way[normal] = up * time_step;
            grains.displace(particle, way)?;
        }
        Ok(())
    }

    /// Mean velocity of the fluid across the bed around a place `[m/s]`.
    pub(super) fn mean_fluid_lift(&self, position: &Vector<D>) -> f64 {
        self.grid.at(&self.drag.fluid_lift, position[0], position[height_axis(D)])
    }

    /// Force of held grains on the fluid and on free grains along the bed in the last step, of a length `[s]`, `[N]`.
    pub(super) fn holding_force(&self, time_step: f64) -> f64 {
        self.held_impulse / time_step
    }

    /// Force of the fluid on every free particle in the last step, of a length `[s]`, `[N]`.
    pub(super) fn drag_forces(&self, time_step: f64) -> impl Iterator<Item = Vector<D>> + '_ {
        let Self { grid, nodes, drag, grains, .. } = self;
        grains.position.iter().zip(&grains.mass).map(move |(place, mass)| {
            let mut force = Vector::zeros();
            for (node, weight) in grid.weights(place[0], place[height_axis(D)]) {
                if nodes.mass[node] > 0.0 {
                    force[0] += weight * mass / nodes.mass[node] * drag.impulse[node] / time_step;
                }
            }
            force
        })
    }
}

/// Columns of at least the width that is asked for.
fn column_row<const D: usize>(
    scene: &IncompressibleScene<D>,
    material: &Sediment<D>,
    numerics: &ColumnNumerics,
) -> Option<ColumnRow> {
    let AxisBoundary::Periodic { lower, upper } = scene.domain.axes[0] else { return None };
    let length = upper - lower;
    let count = (length / (numerics.width_ratio * material.grain_diameter)).max(1.0) as usize;
    Some(ColumnRow { count, width: length / count as f64, left: lower })
}
