//! The channel of the formulations with one particle a grain, and the water of all.

use super::flow::{BedLoadFlow, BedLoadFormulation};
use crate::channel::{AveragingWindowEnd, Channel};
use crate::setup::Lattice;
use bagnold_solver::incompressible as solver;
use bagnold_solver::incompressible::{Bed, ParticleSet, Sediment};
use bagnold_solver::vector::Vector;

impl BedLoadFlow {
    pub(super) fn grains_channel<'a>(&self, velocity: &'a (dyn Fn(f64) -> f64 + Sync)) -> Channel<'a> {
        let Self { depth, gravity, fluid_density, grain_density, grain_diameter, .. } = *self;
        let grains = &self.particles;
        let rows = |length: f64, spacing: f64| (length / spacing).round() as usize;
        let printed = self.formulation == BedLoadFormulation::Paper;
        // the printed set-up has water above the bed only, on the grains as on a floor
        let below = if printed { 0.0 } else { grains.bed_depth };
        let fluid = Lattice {
            spacing: grains.spacing,
            rows: rows(depth + below, grains.spacing),
            columns: rows(grains.length, grains.spacing),
            bottom: -below,
        };
        let bed = Lattice {
            spacing: grain_diameter,
            rows: rows(grains.bed_depth, grain_diameter),
            columns: rows(grains.length, grain_diameter),
            bottom: -grains.bed_depth,
        };
        let mut free = bed.displaced(self.jitter, self.seed.wrapping_add(1));
        let mut wall: Vec<Vector<2>> = bed.below(4).sites().collect();
        if self.formulation == BedLoadFormulation::AtRest {
            wall.append(&mut free);
        }
        let buoyant_weight = (grain_density - fluid_density) * gravity;
        let sediment = Sediment {
            filling: vec![1.0; free.len()],
            particles: ParticleSet { velocity: vec![Vector::zeros(); free.len()], position: free },
            wall,
            spacing: grain_diameter,
            smoothing_ratio: grains.numerics.smoothing_ratio,
            density: grain_density,
            grain_diameter,
            drag_diameter: grain_diameter,
            law: grains.material,
            load: solver::SedimentLoad::Packed { level: -grain_diameter, buoyant_weight },
            pressure: solver::SedimentPressure::Incompressible,
            drag: grains.drag,
            drag_form: solver::DragForm::Grain,
            drag_smoothing_length: grains.drag_smoothing_length,
            gravity: Vector::<2>::new(gravity * self.slope, -buoyant_weight / grain_density),
        };
        Channel {
            turbulence: grains.turbulence.over(depth, grains.origin_offset),
            bed: Bed::NoSlip(fluid.bottom),
            sediment: Some(sediment),
            numerics: grains.numerics,
            may_diverge: printed,
            ..self.water(fluid, velocity)
        }
    }

    /// The run's water without turbulence and sediment.
    pub(super) fn water<'a>(&self, fluid: Lattice, velocity: &'a (dyn Fn(f64) -> f64 + Sync)) -> Channel<'a> {
        Channel {
            slope: self.slope,
            kinematic_viscosity: self.kinematic_viscosity,
            jitter: self.jitter,
            seed: self.seed,
            until: AveragingWindowEnd::Time(self.duration),
            window: self.averaging_time,
            ..Channel::of(fluid, self.fluid_density, self.gravity, velocity)
        }
    }
}
