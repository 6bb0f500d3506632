//! The layer cut into cells, and one step of it towards the steady state.
//!
//! Velocities and fractions stand at the centres of the cells, stresses, pressures and mixing lengths at their faces.
//! A step solves (M/Δt + J) δ = R: R is what the forces on each phase in each cell leave over, J its derivative, and δ
//! the change of both velocities. Steady states are therefore those of R = 0 whatever Δt and J are.
//!
//! J is exact for the water and for the drag. For the grains it is the tangent plus a part of the way to the secant:
//! tangents alone overshoot where the friction yields (γ_r is small), secants alone crawl. Fractions follow the shear
//! rate at once. Fractions that follow it slowly swing for ever in the topmost grains as soon as the cells are small.

use super::block_tridiagonal::{BlockRow, solve};
use super::closures::{Between, StressResponse};
use super::dilation::Dilation;
use super::profile::LayerState;
use super::suspension::{Stirring, Suspension};
use super::{BedLoadLayer, GrainMotion, InitialVelocity};
use bagnold_solver::material::drag::SettlingTable;

/// Solid fraction below which suspended grains go with those below them `[-]`.
const SPARSE: f64 = 1e-6;

/// Both phases in their cells.
#[derive(Debug, Clone)]
pub(super) struct TwoPhaseColumn<'a> {
    layer: &'a BedLoadLayer,
    /// Cells whose grains are held still, from the base up.
    held: usize,
    /// φ `[-]`.
    fraction: Vec<f64>,
    /// u_f `[m/s]`.
    fluid: Vec<f64>,
    /// u_s `[m/s]`.
    grains: Vec<f64>,
    /// w(φ); none if eddies carry no grains.
    settling: Option<SettlingTable>,
}

/// Quantities at the faces, from the base to the surface.
#[derive(Debug, Default)]
struct Faces {
    pressure: Vec<f64>,
    length: Vec<f64>,
    fluid: Vec<StressResponse>,
    grains: Vec<StressResponse>,
}

/// Parameters of a time step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Stride {
    /// Δt `[s]`.
    pub(super) time_step: f64,
    /// Part of the way from the tangent to the secant of the grains' stress `[-]`.
    pub(super) towards_secant: f64,
}

/// Change of a column in a time step.
#[derive(Debug, Clone, Copy)]
pub(super) struct Change {
    /// Largest change of a velocity `[m/s]`.
    pub(super) velocity: f64,
    /// Largest change of a solid fraction `[-]`.
    pub(super) fraction: f64,
    /// Weight of the grains for which there was no room below the surface `[Pa]`.
    pub(super) left_over: f64,
}

impl<'a> TwoPhaseColumn<'a> {
    pub(super) fn new(layer: &'a BedLoadLayer, start: InitialVelocity) -> Self {
        let cells = layer.cells();
        let width = layer.cell_height;
        let ends = |k: usize| (layer.face(k), layer.face(k + 1));
        let fraction = (0..cells).map(|k| match &layer.grains {
            GrainMotion::Resting(given) | GrainMotion::Frozen(given) => given.mean(ends(k).0, ends(k).1),
            GrainMotion::Dilating if layer.face(k) + 0.5 * width < 0.0 => layer.closures.largest_fraction,
            GrainMotion::Dilating => 0.0,
        });
        let held = match layer.grains {
            GrainMotion::Resting(_) => cells,
            _ => (layer.stream.held_depth / width).round() as usize,
        };
        let speed = |k: usize| start.velocity(layer.face(k) + 0.5 * width, &layer.stream);
        let (fraction, fluid) = (fraction.collect(), (0..cells).map(speed).collect());
        let grains = (0..cells).map(|k| if k < held { 0.0 } else { speed(k) }).collect();
        let BedLoadLayer { stream, closures, .. } = layer;
        let settling = (closures.turbulent_schmidt > 0.0).then(|| {
            SettlingTable::new(&stream.settling_grains().settling(), closures.drag, closures.largest_fraction)
        });
        Self { layer, held, fraction, fluid, grains, settling }
    }

    /// One step.
    pub(super) fn step(&mut self, stride: Stride) -> Change {
        let (moved, left_over) = self.dilate();
        let faces = self.faces();
        let mut rows = self.balance(&faces, stride);
        solve(&mut rows);
        let mut largest = 0.0_f64;
        for (k, row) in rows.iter().enumerate() {
            self.fluid[k] += row.right[0];
            self.grains[k] += row.right[1];
            let change = row.right[0].abs() + row.right[1].abs();
            // a maximum would pass over what is not a number
            largest = if change.is_finite() { largest.max(change) } else { f64::INFINITY };
        }
        Change { velocity: largest, fraction: moved, left_over }
    }

    /// Rate of shear `[1/s]` at a face: both phases are at rest at the base, grains also where they are held.
    fn rate(&self, velocity: &[f64], face: usize, base: usize) -> f64 {
        let width = self.layer.cell_height;
        match face {
            _ if face == velocity.len() || face < base => 0.0,
            _ if face == base => 2.0 * velocity[face] / width,
            _ => (velocity[face] - velocity[face - 1]) / width,
        }
    }

    /// Lets the grains follow their shear rate; returns the largest change and the weight without room.
    fn dilate(&mut self) -> (f64, f64) {
        if !matches!(self.layer.grains, GrainMotion::Dilating) {
            return (0.0, 0.0);
        }
        let BedLoadLayer { stream, closures, .. } = self.layer;
        let (cell_height, largest_fraction) = (self.layer.cell_height, closures.largest_fraction);
        let submerged_weight = stream.submerged_weight();
        let weight = largest_fraction * stream.bed_depth * submerged_weight;
        let unit = closures.dilation * stream.inertia_unit();
        let cells = self.fraction.len();
        let shear = (0..cells).map(|k| {
            let lower = self.rate(&self.grains, k, self.held);
            let upper = if k + 1 < cells { self.rate(&self.grains, k + 1, self.held) } else { lower };
            unit * (0.5 * (lower + upper)).abs()
        });
        let shear: Vec<f64> = shear.collect();
        let mut fraction = vec![0.0; cells];
        let left_over = if self.settling.is_some() {
            let suspension = Suspension { cell_height, weight, submerged_weight, largest_fraction };
            suspension.fractions(&Stirring { shear: &shear, dispersion: &self.dispersion() }, &mut fraction).abs()
        } else {
            Dilation { cell_height, weight, submerged_weight, largest_fraction }.march(&shear, &mut fraction)
        };
        let mut largest = 0.0_f64;
        for (old, new) in self.fraction.iter_mut().zip(fraction) {
            largest = largest.max((new - *old).abs());
            *old = new;
        }
        (largest, left_over)
    }

    /// l `[m]` at the faces.
    fn lengths(&self) -> Vec<f64> {
        let BedLoadLayer { stream, closures, cell_height: width, .. } = self.layer;
        let (mut room, mut loosened) = (0.0, 0.0);
        (0..=self.fraction.len())
            .map(|face| {
                let rough_room = room + closures.grain_roughness.room(loosened, stream.grain_diameter);
                if let Some(own) = self.fraction.get(face) {
                    let share = own / closures.largest_fraction;
                    room += (1.0 - share) * width;
                    loosened += closures.grain_roughness.loosened(share, *width);
                }
                closures.mixing_length(self.layer.face(face), stream.flow_depth, rough_room)
            })
            .collect()
    }

    /// D = c ν_t/(Sc w(φ)) `[Pa]` at the faces, w the settling velocity by the drag law; all 0 if eddies carry no grains.
    fn dispersion(&self) -> Vec<f64> {
        let BedLoadLayer { stream, closures, .. } = self.layer;
        let cells = self.fraction.len();
        let Some(settling) = &self.settling else {
            return vec![0.0; cells + 1];
        };
        let length = self.lengths();
        (0..=cells)
            .map(|face| {
                let diffusivity = closures.diffusivity(length[face], self.rate(&self.fluid, face, 0));
                let below = self.fraction[face.saturating_sub(1)];
                let velocity = settling.at(0.5 * (below + self.fraction[face.min(cells - 1)]));
                if velocity > 0.0 { stream.submerged_weight() * diffusivity / velocity } else { 0.0 }
            })
            .collect()
    }

    /// p′ `[Pa]` at the faces: the weight above less what the water carries, ∫ D ∂_z φ dz.
    fn pressure(&self) -> Vec<f64> {
        let weight = self.layer.stream.submerged_weight() * self.layer.cell_height;
        let cells = self.fraction.len();
        let dispersion = self.dispersion();
        let mut pressure = vec![0.0; cells + 1];
        let mut carried = 0.0;
        let mut above = 0.0;
        for k in (0..cells).rev() {
            above += self.fraction[k] * weight;
            if k > 0 {
                // half of a face's share, as the other half is below it
                let share = 0.5 * dispersion[k] * (self.fraction[k - 1] - self.fraction[k]);
                pressure[k] = (above - carried - share).max(0.0);
                carried += 2.0 * share;
            } else {
                pressure[k] = (above - carried).max(0.0);
            }
        }
        pressure
    }

    fn faces(&self) -> Faces {
        let BedLoadLayer { stream, closures, .. } = self.layer;
        let cells = self.fraction.len();
        let mut faces = Faces { pressure: self.pressure(), length: self.lengths(), ..Faces::default() };
        for face in 0..=cells {
            let fraction = match face {
                0 => self.fraction[0],
                _ if face == cells => self.fraction[cells - 1],
                _ => 0.5 * (self.fraction[face] + self.fraction[face - 1]),
            };
            let water = Between {
                density: stream.fluid_density,
                viscosity: stream.kinematic_viscosity,
                solid_fraction: fraction,
            };
            let rate = self.rate(&self.fluid, face, 0);
            faces.fluid.push(closures.fluid_stress(rate, faces.length[face], &water));
            let (rate, pressure) = (self.rate(&self.grains, face, self.held), faces.pressure[face]);
            faces.grains.push(closures.grain_stress(rate, pressure, stream.inertia_unit(), &water));
        }
        faces
    }

    /// K `[kg/(m³ s)]` of a cell at a slip `[m/s]`.
    fn exchange(&self, cell: usize, slip: f64) -> f64 {
        let BedLoadLayer { stream, closures, .. } = self.layer;
        let (density, viscosity) = (stream.fluid_density, stream.kinematic_viscosity);
        let diameter = stream.drag_diameter * stream.grain_diameter;
        closures.drag.exchange_coefficient(self.fraction[cell], slip, diameter, density, viscosity)
    }

    /// Whether a cell has too few grains for a balance of their own: none, or the last of a suspension.
    fn is_empty(&self, cell: usize) -> bool {
        self.fraction[cell] <= if self.settling.is_some() { SPARSE } else { 0.0 }
    }

    /// Drag `[N/m³]` on the grains of a cell, and its derivative by the slip.
    fn drag(&self, cell: usize) -> (f64, f64) {
        let slip = self.fluid[cell] - self.grains[cell];
        let speed = slip.abs();
        let coefficient = self.exchange(cell, speed);
        let difference = 1e-4 * speed.max(1e-6);
        let beside = self.exchange(cell, speed + difference) * (speed + difference);
        (coefficient * slip, ((beside - coefficient * speed) / difference).max(coefficient))
    }

    /// (M/Δt + J) δ = R.
    fn balance(&self, faces: &Faces, stride: Stride) -> Vec<BlockRow> {
        let stream = &self.layer.stream;
        let width = self.layer.cell_height;
        let cells = self.fraction.len();
        // derivative of a stress by the difference of the velocities beside it, over the width; half a cell at a base
        let stiffness = |tangent: f64, face: usize, base: usize| match face {
            _ if face == cells || face < base => 0.0,
            _ if face == base => 2.0 * tangent / (width * width),
            _ => tangent / (width * width),
        };
        let water = |face: usize| stiffness(faces.fluid[face].tangent, face, 0);
        let solid = |face: usize| {
            let stress = faces.grains[face];
            let tangent = stress.tangent + stride.towards_secant * (stress.secant - stress.tangent).max(0.0);
            stiffness(tangent, face, self.held)
        };
        (0..cells)
            .map(|k| {
                let (drag, slope) = self.drag(k);
                let water_mass = (1.0 - self.fraction[k]) * stream.fluid_density;
                let grain_mass = self.fraction[k] * stream.grain_density;
                let divergence = |stress: &[StressResponse]| (stress[k + 1].value - stress[k].value) / width;
                let mut row = BlockRow {
                    lower: [-water(k), -solid(k)],
                    diagonal: [
                        [water_mass / stride.time_step + water(k) + water(k + 1) + slope, -slope],
                        [-slope, grain_mass / stride.time_step + solid(k) + solid(k + 1) + slope],
                    ],
                    upper: [-water(k + 1), -solid(k + 1)],
                    right: [
                        water_mass * stream.driving() + divergence(&faces.fluid) - drag,
                        grain_mass * stream.driving() + divergence(&faces.grains) + drag,
                    ],
                };
                if k < self.held || self.is_empty(k) {
                    // no balance of forces: at rest, or as fast as the grains below
                    let follows = k > self.held;
                    row.diagonal[0][1] = 0.0;
                    row.diagonal[1] = [0.0, 1.0];
                    row.upper[1] = 0.0;
                    row.lower[1] = if follows { -1.0 } else { 0.0 };
                    row.right[1] = if follows { self.grains[k - 1] - self.grains[k] } else { 0.0 };
                }
                row
            })
            .collect()
    }

    /// The profiles as they are now.
    pub(super) fn state(&self) -> LayerState {
        let faces = self.faces();
        let stream = &self.layer.stream;
        let width = self.layer.cell_height;
        let cells = self.fraction.len();
        let exchange: Vec<f64> = (0..cells).map(|k| self.exchange(k, (self.fluid[k] - self.grains[k]).abs())).collect();
        let mut grain_stress: Vec<f64> = faces.grains.iter().map(|stress| stress.value).collect();
        for k in (0..self.held).rev() {
            let force = self.fraction[k] * stream.grain_density * stream.driving()
                + exchange[k] * (self.fluid[k] - self.grains[k]);
            grain_stress[k] = grain_stress[k + 1] + force * width;
        }
        LayerState {
            stream: *stream,
            cell_height: width,
            height: (0..cells).map(|k| self.layer.face(k) + 0.5 * width).collect(),
            solid_fraction: self.fraction.clone(),
            fluid_velocity: self.fluid.clone(),
            grain_velocity: self.grains.clone(),
            exchange,
            face: (0..=cells).map(|face| self.layer.face(face)).collect(),
            grain_pressure: faces.pressure,
            fluid_stress: faces.fluid.iter().map(|stress| stress.value).collect(),
            grain_stress,
            mixing_length: faces.length,
        }
    }
}
