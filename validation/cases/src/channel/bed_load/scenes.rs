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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{RunList, Tier};
    use bagnold_solver::incompressible::IncompressibleScene;

    /// The printed set-up, as a run starts from it but for the displacement of its particles.
    fn printed() -> IncompressibleScene<2> {
        let runs = RunList::<BedLoadFlow>::of_tier(Tier::Paper).flows().to_vec();
        let run = runs.into_iter().find(|run| run.formulation == BedLoadFormulation::Paper).expect("a run");
        BedLoadFlow { jitter: 0.0, ..run }.grains_channel(&|_| 0.0).scene()
    }

    /// Numbers of particles along the flow and over the height, with the least and largest of both coordinates, in multiples of a size.
    fn lattice(position: &[Vector<2>], size: f64) -> [(usize, i64, i64); 2] {
        [0, 1].map(|axis| {
            let mut cells: Vec<i64> = position.iter().map(|x| (x[axis] / size).floor() as i64).collect();
            let centred = position.iter().all(|x| ((x[axis] / size).rem_euclid(1.0) - 0.5).abs() < 1e-9);
            cells.sort_unstable();
            cells.dedup();
            assert!(centred, "particles stand in the middle of their cells");
            (cells.len(), cells[0], cells[cells.len() - 1])
        })
    }

    #[test]
    fn a_layer_of_water_lies_over_a_layer_of_grains() {
        let scene = printed();
        let heights = |position: &[Vector<2>]| {
            let of = || position.iter().map(|x| x[1]);
            (of().fold(f64::INFINITY, f64::min), of().fold(f64::NEG_INFINITY, f64::max))
        };
        let sediment = scene.sediment.as_ref().expect("grains");
        let (water, grains) = (heights(&scene.fluid.particles.position), heights(&sediment.particles.position));
        assert!(grains.1 < 0.0 && water.0 > 0.0, "{grains:?} below {water:?}");
        assert!((water.1 - water.0 - 0.044).abs() < 1e-9 && (grains.1 - grains.0 - 0.075).abs() < 1e-9);
    }

    #[test]
    fn water_starts_as_twenty_columns_of_twenty_three() {
        let fluid = printed().fluid;
        assert_eq!(fluid.particles.position.len(), 460);
        assert_eq!(lattice(&fluid.particles.position, 2e-3), [(20, 0, 19), (23, 0, 22)]);
    }

    #[test]
    fn grains_start_as_sixteen_rows_of_eight() {
        let sediment = printed().sediment.expect("grains");
        assert_eq!(sediment.particles.position.len(), 128);
        assert_eq!(lattice(&sediment.particles.position, 5e-3), [(8, 0, 7), (16, -16, -1)]);
    }

    #[test]
    fn dummy_particles_of_the_water_lie_outside_of_it() {
        let fluid = printed().fluid;
        let [(columns, ..), (_, _, highest)] = lattice(&fluid.wall, 2e-3);
        assert_eq!((columns, highest), (20, -1), "the first row is next to the water's lowest, below it");
    }

    #[test]
    fn dummy_rows_fill_the_support() {
        let [_, (rows, lowest, highest)] = lattice(&printed().fluid.wall, 2e-3);
        assert!(rows >= 2 && rows as f64 >= 2.4 - 0.5, "{rows} rows from {lowest} to {highest}");
        assert_eq!(highest - lowest, rows as i64 - 1, "without a gap");
    }
}
