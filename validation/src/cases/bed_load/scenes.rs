//! The channel of each formulation.

use super::parameters::{Continuum, Grains, Materials, Stage};
use super::runs::{BedLoadRun, Formulation};
use crate::cases::channel::{Channel, Lattice, Until};
use crate::reference::bed_load_layer::LayerState;
use bagnold_solver::incompressible as solver;
use bagnold_solver::incompressible::{Bed, ParticleSet, ProjectionNumerics, Sediment, Turbulence};
use bagnold_solver::material::dilatancy::Dilatancy;
use bagnold_solver::material::rheology::{CoulombBingham, Rheology, RootMuI};
use bagnold_solver::vector::Vector;

impl BedLoadRun {
    pub(super) fn grains_channel<'a>(&self, grains: &Grains, velocity: &'a (dyn Fn(f64) -> f64 + Sync)) -> Channel<'a> {
        let Materials { depth, gravity, fluid_density, grain_density, grain_diameter, .. } = self.materials;
        let rows = |length: f64, spacing: f64| (length / spacing).round() as usize;
        let printed = matches!(self.formulation, Formulation::Paper(_));
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
        let buoyant_weight = (grain_density - fluid_density) * gravity;
        let sediment = Sediment {
            particles: ParticleSet {
                position: bed.displaced(self.jitter, self.seed.wrapping_add(1)),
                velocity: vec![Vector::zeros(); bed.len()],
            },
            filling: vec![1.0; bed.len()],
            wall: bed.below(4).sites().collect(),
            spacing: grain_diameter,
            smoothing_ratio: grains.numerics.smoothing_ratio,
            density: grain_density,
            grain_diameter,
            law: Rheology::CoulombBingham(CoulombBingham {
                yield_stress: grains.material.yield_stress,
                friction: grains.overburden_friction,
                plastic_viscosity: grains.material.viscosity,
                regularisation_rate: grains.material.regularisation_rate,
                largest_viscosity: grains.material.largest_viscosity,
            }),
            load: solver::SedimentLoad::Packed { level: -grain_diameter, buoyant_weight },
            pressure: solver::SedimentPressure::Incompressible,
            drag: grains.drag,
            drag_form: solver::DragForm::Grain(grains.drag_factor),
            drag_smoothing_length: grains.drag_smoothing_length,
            gravity: Vector::<2>::new(gravity * self.slope, -buoyant_weight / grain_density),
        };
        Channel {
            fluid,
            turbulence: grains.turbulence.over(depth, grains.origin_offset),
            bed: Bed::NoSlip(fluid.bottom),
            sediment: Some(sediment),
            solid_fraction: solver::SolidFraction::Overlapping,
            numerics: grains.numerics,
            may_diverge: printed,
            ..self.bare_channel(fluid, velocity)
        }
    }

    pub(super) fn continuum_channel<'a>(
        &self,
        continuum: &Continuum,
        stage: Stage,
        (share, spacing): (f64, f64),
        numerics: ProjectionNumerics,
        layer: &LayerState,
        velocity: &'a (dyn Fn(f64) -> f64 + Sync),
    ) -> Channel<'a> {
        let Materials { depth, gravity, fluid_density, grain_density, grain_diameter, .. } = self.materials;
        let columns = (continuum.length / spacing).round() as usize;
        let fluid = Lattice {
            spacing,
            rows: ((depth + continuum.bed_depth) / spacing).round() as usize,
            columns,
            bottom: -continuum.bed_depth,
        };
        let closures = &continuum.closures;
        let packing = closures.largest_fraction;
        let held = continuum.held_depth - continuum.bed_depth;
        let stratification = solver::Stratification::of(solver::Strata {
            base: layer.face[0],
            interval: layer.cell_height,
            solid_fraction: layer.solid_fraction.clone(),
            packing,
            buoyant_weight: (grain_density - fluid_density) * gravity,
            bed_level: 0.0,
            depth,
            suspension_viscosity: closures.suspension_viscosity,
        });
        let lattice = Lattice { bottom: fluid.bottom - 3.0 * spacing, rows: fluid.rows + 3, ..fluid };
        let jitter = if stage == Stage::Dilating { continuum.sediment_jitter } else { 0.0 };
        let (mut free, mut wall, mut filling) = (ParticleSet::default(), Vec::new(), Vec::new());
        for (site, place) in lattice.sites().zip(lattice.displaced(jitter, self.seed.wrapping_add(1))) {
            let point = layer.at(site[1]);
            // the bed at rest, or the layer's own grains
            let fraction = match stage {
                Stage::Dilating => {
                    if site[1] < 0.0 {
                        packing
                    } else {
                        0.0
                    }
                }
                Stage::Porous | Stage::Frozen => point.solid_fraction,
            };
            if site[1] < held || (stage == Stage::Porous && fraction > continuum.least_fraction) {
                wall.push(site);
            } else if fraction > continuum.least_fraction {
                free.position.push(place);
                free.velocity.push(Vector::<2>::new(share * point.grain_velocity, 0.0));
                filling.push(fraction);
            }
        }
        let solid_fraction = if stage == Stage::Dilating {
            solver::SolidFraction::Averaged(stratification)
        } else {
            solver::SolidFraction::Given(stratification)
        };
        let buoyancy = if stage == Stage::Dilating { 1.0 - fluid_density / grain_density } else { 0.0 };
        let sediment = Sediment {
            particles: free,
            filling,
            wall,
            spacing,
            smoothing_ratio: if stage == Stage::Dilating {
                continuum.smoothing_ratio
            } else {
                numerics.smoothing_ratio
            },
            density: grain_density,
            grain_diameter,
            law: Rheology::RootMuI(RootMuI {
                static_friction: closures.static_friction,
                limiting_friction: closures.limiting_friction,
                reference_inertia: closures.reference_inertia,
                grain_diameter,
                grain_density,
                regularisation_rate: closures.regularisation_rate,
            }),
            load: solver::SedimentLoad::Stratified,
            pressure: match stage {
                Stage::Porous | Stage::Frozen => solver::SedimentPressure::AlongBed,
                Stage::Dilating => solver::SedimentPressure::Dilatant {
                    dilatancy: Dilatancy {
                        dilation: closures.dilation,
                        packing,
                        grain_diameter,
                        grain_density,
                        bounds: continuum.pressure_bounds,
                    },
                    fixed_filling: packing,
                },
            },
            drag: closures.drag,
            drag_form: solver::DragForm::Exchange,
            drag_smoothing_length: numerics.smoothing_ratio * spacing,
            gravity: Vector::<2>::new(gravity * self.slope, -buoyancy * gravity),
        };
        Channel {
            fluid,
            turbulence: Turbulence::Stratified,
            bed: Bed::NoSlip(fluid.bottom),
            sediment: Some(sediment),
            solid_fraction,
            numerics,
            ..self.bare_channel(fluid, velocity)
        }
    }

    fn bare_channel<'a>(&self, fluid: Lattice, velocity: &'a (dyn Fn(f64) -> f64 + Sync)) -> Channel<'a> {
        Channel {
            fluid,
            slope: self.slope,
            gravity: self.materials.gravity,
            density: self.materials.fluid_density,
            kinematic_viscosity: self.materials.kinematic_viscosity,
            turbulence: Turbulence::Laminar,
            bed: Bed::Slip,
            jitter: self.jitter,
            seed: self.seed,
            velocity,
            sediment: None,
            solid_fraction: solver::SolidFraction::Overlapping,
            numerics: ProjectionNumerics::default(),
            until: Until::Time(self.duration),
            window: self.averaging_time,
            interval: 0.005,
            frames: 2,
            may_diverge: false,
        }
    }
}
