//! Formulation `continuum`: grains as volume fractions, beside the 1-D layer of the same closures.
//!
//! Its law of friction is that of the layer, which knows no other: it is part of the closures and cannot be chosen.

use super::flow::{BedLoadFlow, BedLoadFormulation, Continuum, LAYER_CELL, StartState};
use super::kept::KeptState;
use crate::case::ParameterError;
use crate::channel::Channel;
use crate::checkpoint::is_interrupted;
use crate::reference::one_dimension::LayerError;
use crate::reference::one_dimension::bed_load::{
    BedLoadLayer, GrainMotion, LayerState, STEADY, SolidFractionProfile, SteadyStates,
};
use crate::setup::Lattice;
use crate::shared::OverHeight;
use bagnold_solver::incompressible as solver;
use bagnold_solver::incompressible::{Bed, ParticleSet, ProjectionNumerics, Sediment, Turbulence};
use bagnold_solver::material::dilatancy::Dilatancy;
use bagnold_solver::material::rheology::{Rheology, RootMuI};
use bagnold_solver::vector::Vector;

/// Rows of held grains below the water's floor, as many as a kernel reaches.
const WALL_ROWS: usize = 3;

/// The row of a lattice that a height `[m]` lies in.
fn row_of(height: f64, lattice: Lattice) -> usize {
    (((height - lattice.bottom) / lattice.spacing) as usize).min(lattice.rows - 1)
}

/// The grains of a scene.
#[derive(Default)]
struct Placed {
    free: ParticleSet<2>,
    filling: Vec<f64>,
    wall: Vec<Vector<2>>,
}

impl BedLoadFlow {
    pub(super) fn continuum_numerics(&self) -> ProjectionNumerics {
        let of_case = self.continuum.numerics;
        ProjectionNumerics { time_step: of_case.time_step * self.spacing() / 1e-3, ..of_case }
    }

    /// Particles of the sediment along a spacing of the water.
    fn refinement(&self) -> usize {
        if self.dilates() { self.continuum.sediment_refinement as usize } else { 1 }
    }

    /// Whether grains dilate where they may move.
    pub(super) fn dilates(&self) -> bool {
        self.formulation == BedLoadFormulation::Dilating
    }

    /// The 1-D layer that the run is verified against.
    pub(super) fn layer(&self) -> Result<LayerState, ParameterError> {
        let (stream, closures) = (self.stream(), self.continuum.closures);
        let layer = |grains| BedLoadLayer { stream, closures, grains, cell_height: LAYER_CELL, steady_change: STEADY };
        let refused = |error: LayerError| {
            let remedy = "change them until bed-load-1d finds one steady state";
            ParameterError::field("continuum.closures", error.to_string(), "", remedy)
        };
        let one_state = |layer: BedLoadLayer| {
            layer.steady_states_unless(&is_interrupted).and_then(SteadyStates::single).map_err(refused)
        };
        if self.rests() {
            let bed = SolidFractionProfile::flat_bed(closures.largest_fraction).map_err(refused)?;
            return one_state(layer(GrainMotion::Resting(bed)));
        }
        let dilating = one_state(layer(GrainMotion::Dilating))?;
        if self.formulation == BedLoadFormulation::Porous {
            return one_state(layer(GrainMotion::Resting(SolidFractionProfile::of_cells(&dilating))));
        }
        Ok(dilating)
    }

    pub(super) fn continuum_channel<'a>(&self, layer: &LayerState, velocity: OverHeight<'a>) -> Channel<'a> {
        let continuum = &self.continuum;
        // the spacing that divides the height, so that the surface lies where it should
        let height = self.depth + continuum.bed_depth;
        let rows = (height / self.spacing()).round();
        let spacing = height / rows;
        let columns = (continuum.length / spacing).round() as usize;
        let fluid = Lattice { spacing, rows: rows as usize, columns, bottom: -continuum.bed_depth };
        let stratification = self.stratification(layer);
        let mut sediment = self.sediment(fluid, layer);
        let mut particles = None;
        if let (StartState::Kept, Some(KeptState { water, grains })) = (self.continuum.start_state, KeptState::of(self))
        {
            (particles, sediment.particles) = (Some(water), grains);
        }
        Channel {
            turbulence: Turbulence::Stratified,
            bed: Bed::NoSlip(fluid.bottom),
            particles,
            sediment: Some(sediment),
            solid_fraction: if self.dilates() {
                solver::SolidFraction::Averaged(stratification)
            } else {
                solver::SolidFraction::Given(stratification)
            },
            numerics: self.continuum_numerics(),
            ..self.water(fluid, velocity)
        }
    }

    fn stratification(&self, layer: &LayerState) -> solver::Stratification {
        let closures = &self.continuum.closures;
        solver::Stratification::of(solver::Strata {
            base: layer.face[0],
            interval: layer.cell_height,
            solid_fraction: layer.solid_fraction.clone(),
            packing: closures.largest_fraction,
            buoyant_weight: (self.grain_density - self.fluid_density) * self.gravity,
            bed_level: 0.0,
            depth: self.depth,
            suspension_viscosity: closures.suspension_viscosity,
            grain_roughness: closures.grain_roughness,
            grain_diameter: self.grain_diameter,
        })
    }

    /// The bed at rest where it dilates, or the layer's own grains; held where they rest and at the base.
    fn placed(&self, fluid: Lattice, layer: &LayerState) -> Placed {
        let Continuum { closures, least_fraction, held_depth, bed_depth, .. } = &self.continuum;
        let held = held_depth - bed_depth;
        let part = self.refinement();
        let spacing = fluid.spacing / part as f64;
        let (rows, columns) = (part * fluid.rows + WALL_ROWS, part * fluid.columns);
        let lattice = Lattice { spacing, rows, columns, bottom: fluid.bottom - WALL_ROWS as f64 * spacing };
        let jitter = if self.dilates() { self.continuum.sediment_jitter } else { 0.0 };
        let mut placed = Placed::default();
        let of_rows = self.rows_of_grains(&SolidFractionProfile::of_cells(layer), lattice);
        for (site, place) in lattice.sites().zip(lattice.displaced(jitter, self.seed.wrapping_add(1))) {
            let point = layer.at(site[1]);
            let fraction = match self.formulation {
                // the top row has what lies below the bed's level, so that no grain is lost or won
                BedLoadFormulation::Dilating => closures.largest_fraction * (0.5 - site[1] / spacing).clamp(0.0, 1.0),
                BedLoadFormulation::Porous => point.solid_fraction,
                _ => of_rows[row_of(site[1], lattice)],
            };
            if site[1] < held || (self.formulation == BedLoadFormulation::Porous && fraction > *least_fraction) {
                placed.wall.push(site);
            } else if fraction > *least_fraction {
                placed.free.position.push(place);
                placed.free.velocity.push(Vector::<2>::new(self.start() * point.grain_velocity, 0.0));
                placed.filling.push(fraction);
            }
        }
        placed
    }

    /// The layer's mean fraction over each row `[-]`, since φ is far from straight over one and the topmost grains end inside one.
    ///
    /// A few hundredths of grains in a row of their own have nothing to rub against but the row below, and are dragged off by
    /// the water: the topmost row with more takes them.
    fn rows_of_grains(&self, of_layer: &SolidFractionProfile, lattice: Lattice) -> Vec<f64> {
        let (half, sparse) = (0.5 * lattice.spacing, self.continuum.sparse_row_fraction);
        let mut rows: Vec<f64> = (0..lattice.rows)
            .map(|row| lattice.bottom + (row as f64 + 0.5) * lattice.spacing)
            .map(|middle| of_layer.mean(middle - half, middle + half))
            .collect();
        let mut carried = 0.0;
        for fraction in rows.iter_mut().rev() {
            let own = *fraction + carried;
            if own > sparse {
                *fraction = own;
                break;
            }
            (*fraction, carried) = (0.0, own);
        }
        rows
    }

    /// The law of the grains, at a given fraction or dilating.
    pub(super) fn continuum_law(&self) -> Rheology {
        let closures = &self.continuum.closures;
        Rheology::RootMuI(RootMuI {
            static_friction: closures.static_friction,
            limiting_friction: closures.limiting_friction,
            reference_inertia: closures.reference_inertia,
            grain_diameter: self.grain_diameter,
            grain_density: self.grain_density,
            regularisation_rate: closures.regularisation_rate,
        })
    }

    fn sediment(&self, fluid: Lattice, layer: &LayerState) -> Sediment<2> {
        let Placed { free, filling, wall } = self.placed(fluid, layer);
        let Self { gravity, fluid_density, grain_density, grain_diameter, .. } = *self;
        let (closures, numerics, dilates) = (&self.continuum.closures, self.continuum_numerics(), self.dilates());
        let packing = closures.largest_fraction;
        let buoyancy = if dilates { 1.0 - fluid_density / grain_density } else { 0.0 };
        Sediment {
            particles: free,
            filling,
            wall,
            spacing: fluid.spacing / self.refinement() as f64,
            smoothing_ratio: numerics.smoothing_ratio,
            density: grain_density,
            grain_diameter,
            drag_diameter: self.continuum.drag_diameter * grain_diameter,
            law: self.continuum_law(),
            load: solver::SedimentLoad::Stratified,
            pressure: if dilates {
                let dilatancy = Dilatancy { dilation: closures.dilation, packing, grain_diameter, grain_density };
                solver::SedimentPressure::Dilatant {
                    dilatancy,
                    fixed_filling: packing,
                    columns: self.continuum.columns,
                    turbulent_schmidt: closures.turbulent_schmidt,
                }
            } else {
                solver::SedimentPressure::AlongBed
            },
            drag: closures.drag,
            drag_form: solver::DragForm::Exchange,
            drag_smoothing_length: numerics.smoothing_ratio * fluid.spacing,
            gravity: Vector::<2>::new(gravity * self.slope, -buoyancy * gravity),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::bed_load::MeasuredBedLoad;
    use crate::reference::one_dimension::bed_load::Stream;
    use bagnold_solver::incompressible::DrivenGrains;

    /// q* of the grains over the layer's where the water is the layer's own, a mean over the last half of a duration `[s]`, for each physics of
    /// the grains, which may differ from the layer's.
    fn transport_ratios<const N: usize>(
        flow: &BedLoadFlow,
        (slope, spacing, start, duration): (f64, f64, f64, f64),
        physics: [&dyn Fn(&mut Continuum); N],
    ) -> [f64; N] {
        let formulation = BedLoadFormulation::Dilating;
        let continuum = Continuum { spacing, start, ..flow.continuum.clone() };
        let run =
            BedLoadFlow { formulation, slope, duration, averaging_time: 0.5 * duration, continuum, ..flow.clone() };
        let (grains, cell_height, steady_change) = (GrainMotion::Dilating, LAYER_CELL, STEADY);
        let (stream, closures) = (run.stream(), run.continuum.closures);
        let layer = BedLoadLayer { stream, closures, grains, cell_height, steady_change };
        // a run needs the states from both starts to be one: a third of the time of these tests
        let layer = layer.steady(layer.fast_start()).expect("a steady layer");
        let water = |z: f64| layer.at(z).fluid_velocity;
        physics.map(|change| {
            let mut own = run.clone();
            change(&mut own.continuum);
            let channel = own.continuum_channel(&layer, &water);
            let (length, time_step) = (channel.fluid.length(), channel.numerics.time_step);
            let mut grains = DrivenGrains::new(channel.scene()).expect("a valid scene");
            let (mut sum, mut count) = (0.0, 0.0);
            for step in 0..(run.duration / time_step) as usize {
                assert!(grains.step(time_step), "step {step}");
                if step as f64 * time_step > run.duration - run.averaging_time {
                    let grains = grains.masses().iter().zip(grains.grains().1);
                    sum += grains.fold(0.0, |sum, (m, u)| sum + m * u[0]) / run.grain_density / length;
                    count += 1.0;
                }
            }
            sum / count / run.stream().transport_unit() / layer.transport()
        })
    }

    #[test]
    fn a_sparse_topmost_row_gives_its_grains_to_the_row_below() {
        let rows = |sparse: f64| {
            let formulation = BedLoadFormulation::Frozen;
            let mut run = BedLoadFlow { formulation, slope: 0.02, ..BedLoadFlow::default() };
            run.continuum.sparse_row_fraction = sparse;
            let layer = run.layer().expect("a steady layer");
            let lattice = Lattice { spacing: 7e-4, rows: 60, columns: 1, bottom: -0.0161 };
            run.rows_of_grains(&SolidFractionProfile::of_cells(&layer), lattice)
        };
        let (plain, gathered) = (rows(0.0), rows(0.03));
        let top = gathered.iter().rposition(|fraction| *fraction > 0.0).expect("grains");
        assert!(plain[top + 1] > 0.0 && plain[top + 1] < 0.03 && gathered[top] > 0.03, "{plain:?}");
        assert_eq!(plain[..top], gathered[..top]);
        let difference = plain.iter().sum::<f64>() - gathered.iter().sum::<f64>();
        assert!(difference.abs() < 1e-12, "{difference}");
    }

    #[test]
    fn grains_alone_carry_what_the_layer_carries_in_the_layers_water() {
        for (slope, spacing, start) in [(0.02, 7e-4, 1.0), (0.03, 1e-3, 1.0), (0.03, 1e-3, 1.4), (0.05, 1e-3, 1.0)] {
            let [ratio] = transport_ratios(&BedLoadFlow::default(), (slope, spacing, start, 1.0), [&|_| {}]);
            assert!((ratio - 1.0).abs() < 0.02, "slope {slope}, {spacing} m, start {start}: {ratio}");
        }
    }

    /// The sheet flow of Revil-Baudard et al. 2015: light grains of 3 mm, which eddies carry.
    #[test]
    fn suspended_grains_carry_what_the_layer_carries_and_wrong_eddies_do_not() {
        let Stream { flow_depth: depth, grain_density, grain_diameter, slope, .. } =
            MeasuredBedLoad::SheetFlow.stream();
        let mut flow = BedLoadFlow { depth, grain_density, grain_diameter, ..BedLoadFlow::default() };
        let continuum = &mut flow.continuum;
        (continuum.bed_depth, continuum.held_depth, continuum.length) = (0.03, 0.006, 0.024);
        (continuum.drag_diameter, continuum.closures.turbulent_schmidt) = (0.5, 0.7);
        let [right, wrong @ ..] = transport_ratios(
            &flow,
            (slope, 3e-3, 1.0, 0.6),
            [
                &|_| {},
                &|without_eddies| without_eddies.closures.turbulent_schmidt = 0.0,
                &|lower_end| lower_end.closures.turbulent_schmidt = 0.4,
                // a third of the settling velocity
                &|light| light.drag_diameter = 0.15,
            ],
        );
        assert!((right - 1.0).abs() < 0.1, "{right}");
        assert!(wrong.iter().all(|ratio| (ratio - 1.0).abs() > 0.2), "{wrong:?}");
    }
}
