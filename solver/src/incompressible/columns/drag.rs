//! Drag between the fluid's particles and the nodes: every node exchanges K(φ, |ū − U|) Δ `[kg/(m² s)]`, shared by the
//! fluid particles around it by a triangle over the height.
//!
//! The water feels it in its implicit velocities, as something that holds it and moves with the node, β (U − u*); the node
//! gets the opposite of what came out of that solve.

use super::super::divergence::Quantity;
use super::super::{Failure, IncompressibleScene, Phase, Sediment, height_axis};
use super::{ColumnGrid, Nodes};
use crate::vector::Vector;

/// A fluid particle and a node that exchange momentum.
#[derive(Debug, Clone, Copy)]
struct Link {
    particle: u32,
    node: u32,
    /// Weight of the node's water `[-]`, then β `[kg/s]`.
    exchange: f64,
}

/// Exchange of momentum between the columns and the fluid in a step.
#[derive(Debug, Default)]
pub struct ColumnDrag {
    links: Vec<Link>,
    /// Σ of the weights of every node `[-]`.
    weight: Vec<f64>,
    /// Velocity of the fluid around every node along the bed `[m/s]`.
    fluid: Vec<f64>,
    /// Velocity of the fluid around every node across the bed `[m/s]`.
    pub(crate) fluid_lift: Vec<f64>,
    /// Σ β of every fluid particle `[kg/s]`.
    pub hold: Vec<f64>,
    /// Σ β U of every fluid particle `[N]`.
    pub push: Vec<f64>,
    /// Force of suspended grains across the bed on every fluid particle `[N]`.
    pub(crate) burden: Vec<f64>,
    /// Impulse of the fluid on every node in the last step `[kg/(m s)]`.
    pub impulse: Vec<f64>,
}

impl ColumnDrag {
    /// Room for the links of a number of fluid particles.
    pub(crate) fn reserve(&mut self, grid: &ColumnGrid, particles: usize, reach: f64) {
        let nodes_around = 2 * ((2.0 * reach / grid.cell) as usize + 1);
        self.links.reserve(nodes_around * particles);
        for array in [&mut self.weight, &mut self.fluid, &mut self.fluid_lift, &mut self.impulse] {
            array.resize(grid.len(), 0.0);
        }
        for array in [&mut self.hold, &mut self.push, &mut self.burden] {
            array.resize(particles, 0.0);
        }
    }

    /// Finds the water around every node and what the two exchange.
    ///
    /// # Errors
    /// A slip that the drag law does not cover.
    pub(crate) fn find<const D: usize>(
        &mut self,
        grid: &ColumnGrid,
        nodes: &Nodes,
        fluid: &Phase<D>,
        scene: &IncompressibleScene<D>,
        material: &Sediment<D>,
        reach: f64,
    ) -> Result<(), Failure> {
        self.find_water(grid, nodes, fluid, reach);
        self.hold.fill(0.0);
        self.push.fill(0.0);
        let (density, viscosity) = (scene.fluid.density, scene.fluid.kinematic_viscosity);
        let diameter = material.drag_diameter;
        let range = material.drag.reynolds_range();
        let volume = grid.cell * grid.row.width;
        let Self { links, weight, fluid: water, hold, push, .. } = self;
        for link in links {
            let (particle, node) = (link.particle as usize, link.node as usize);
            let velocity = nodes.velocity[node];
            let slip = (water[node] - velocity).abs();
            let reynolds = slip * diameter / viscosity;
            if !range.contains(&reynolds) {
                let quantity = Quantity::Reynolds;
                return Err(Failure { row: particle, quantity, value: reynolds, limit: *range.end() });
            }
            let fraction = nodes.bounded_fraction(node);
            let exchange = material.drag.exchange_coefficient(fraction, slip, diameter, density, viscosity);
            link.exchange *= exchange * volume / weight[node];
            hold[particle] += link.exchange;
            push[particle] += link.exchange * velocity;
        }
        Ok(())
    }

    /// Weights of the fluid particles around the nodes that have grains, and its mean velocity there.
    fn find_water<const D: usize>(&mut self, grid: &ColumnGrid, nodes: &Nodes, fluid: &Phase<D>, reach: f64) {
        let normal = height_axis(D);
        self.links.clear();
        for array in [&mut self.weight, &mut self.fluid, &mut self.fluid_lift] {
            array.fill(0.0);
        }
        for (particle, (position, velocity)) in fluid.position.iter().zip(&fluid.velocity).enumerate() {
            grid.around(position[0], position[normal], reach, |node, exchange| {
                if nodes.has_grains(node) {
                    self.weight[node] += exchange;
                    self.fluid[node] += exchange * velocity[0];
                    self.fluid_lift[node] += exchange * velocity[normal];
                    self.links.push(Link { particle: particle as u32, node: node as u32, exchange });
                }
            });
        }
        for (node, weight) in self.weight.iter().enumerate().filter(|(_, weight)| **weight > 0.0) {
            self.fluid[node] /= weight;
            self.fluid_lift[node] /= weight;
        }
    }

    /// Impulses on the nodes per area of a column, from the velocities that the fluid has got `[m/s]`.
    pub(crate) fn react<const D: usize>(
        &mut self,
        grid: &ColumnGrid,
        nodes: &Nodes,
        predicted: &[Vector<D>],
        time_step: f64,
    ) {
        self.impulse.fill(0.0);
        for link in &self.links {
            let node = link.node as usize;
            let slip = predicted[link.particle as usize][0] - nodes.velocity[node];
            self.impulse[node] += link.exchange * slip * time_step / grid.row.width;
        }
    }
}
