//! The drag between the phases as pairs: equal and opposite forces β_ab (u_b − u_a).
//!
//! The slip is the pair's own, as printed, or that of the grain against the mean of the fluid around it, which the shear
//! within the kernel does not enlarge.

use super::super::divergence::Quantity;
use super::super::neighbours::{Grid, Pairs, SavedPairs};
use super::super::terms::drag_pair;
use super::super::{DragForm, DragSlip, Failure, IncompressibleScene, LEAST_TASK, Periods, Phase, Sediment};
use crate::domain::Domain;
use crate::kernel::{Kernel, KernelShape};
use crate::parallel::prelude::*;
use crate::run::ForeignState;
use crate::vector::Vector;

/// Pairs between the phases, and what a step needs of them.
#[derive(Debug)]
pub struct DragExchange<const D: usize> {
    /// Sediment particles, the free ones first and then the fixed, with the fluid around them.
    pub of_sediment: Pairs<D>,
    /// Fluid particles with the sediment around them, indexed as above.
    pub of_fluid: Pairs<D>,
    /// Positions of the sediment, free and fixed `[m]`.
    sediment: Vec<Vector<D>>,
    /// β_ab/(m_b W) of every sediment particle, from its mean slip `[m²/s]` in 2-D.
    mean_factor: Vec<f64>,
    /// |u_f − u_s| of every sediment particle `[m/s]`.
    slip: Vec<f64>,
    kernel: Kernel<D>,
    grid: Grid<D>,
}

impl<const D: usize> DragExchange<D> {
    pub(crate) fn new(smoothing_length: f64) -> Self {
        Self {
            of_sediment: Pairs::new(),
            of_fluid: Pairs::new(),
            sediment: Vec::new(),
            mean_factor: Vec::new(),
            slip: Vec::new(),
            kernel: Kernel::new(KernelShape::CubicSpline, smoothing_length),
            grid: Grid::new(),
        }
    }

    /// Kernel of the drag.
    pub fn kernel(&self) -> &Kernel<D> {
        &self.kernel
    }

    /// Candidates of both sides.
    pub(crate) fn save(&self) -> (SavedPairs, SavedPairs) {
        (self.of_sediment.save(), self.of_fluid.save())
    }

    /// Restores saved candidates of both sides.
    pub(crate) fn restore(
        &mut self,
        (of_sediment, of_fluid): (SavedPairs, SavedPairs),
        fluid: usize,
        sediment: &Phase<D>,
    ) -> Result<(), ForeignState> {
        let grains = sediment.len() + sediment.wall.len();
        self.copy_positions(sediment);
        self.of_sediment.restore(of_sediment, grains, fluid)?;
        self.of_fluid.restore(of_fluid, fluid, grains)
    }

    /// Largest distance of a pair `[m]`.
    pub fn reach(&self) -> f64 {
        self.kernel.support()
    }

    /// Finds the candidates of the pairs between the phases.
    pub(crate) fn search(
        &mut self,
        fluid: &Phase<D>,
        sediment: &Phase<D>,
        domain: &Domain<D>,
        periods: &Periods<D>,
        skin: f64,
    ) {
        let radius = self.reach() + skin;
        self.copy_positions(sediment);
        self.grid.sort(&fluid.position, domain, radius);
        self.of_sediment.search(&self.sediment, &fluid.position, &self.grid, periods, radius);
        self.grid.sort(&self.sediment, domain, radius);
        self.of_fluid.search(&fluid.position, &self.sediment, &self.grid, periods, radius);
    }

    /// Measures the pairs between the phases.
    pub(crate) fn measure(&mut self, fluid: &Phase<D>, sediment: &Phase<D>, periods: &Periods<D>) {
        self.copy_positions(sediment);
        self.of_sediment.measure(&self.sediment, &fluid.position, periods, &self.kernel);
        self.of_fluid.measure(&fluid.position, &self.sediment, periods, &self.kernel);
    }

    fn copy_positions(&mut self, sediment: &Phase<D>) {
        self.sediment.clear();
        self.sediment.extend(sediment.position.iter().chain(&sediment.wall));
    }

    /// β_ab/(m_b W) of a pair of a sediment particle whose own slip would be `slip` `[m/s]`.
    #[inline(always)]
    pub(crate) fn factor(
        &self,
        particle: usize,
        material: &Sediment<D>,
        slip: impl FnOnce() -> f64,
        scene: &IncompressibleScene<D>,
    ) -> f64 {
        match scene.numerics.drag_slip {
            DragSlip::Mean => self.mean_factor[particle],
            DragSlip::Pair => grain_factor(material, slip(), scene.fluid.kinematic_viscosity),
        }
    }

    /// Finds the slip of every grain against the mean of the fluid around it and its factor.
    ///
    /// # Errors
    /// A grain whose Reynolds number its drag law does not cover.
    pub(crate) fn find_mean_factors(
        &mut self,
        fluid: &Phase<D>,
        sediment: &Phase<D>,
        scene: &IncompressibleScene<D>,
        material: &Sediment<D>,
    ) -> Result<(), Failure> {
        self.mean_factor.resize(self.sediment.len(), 0.0);
        self.slip.resize(self.sediment.len(), 0.0);
        let (of_sediment, positions) = (&self.of_sediment, &self.sediment);
        (&mut self.mean_factor, &mut self.slip).enumerate().with_min_len(LEAST_TASK).for_each(|(a, (factor, slip))| {
            let (mut sum, mut weight) = (Vector::zeros(), 0.0);
            for pair in of_sediment.of(a) {
                sum += fluid.velocity[pair.source as usize] * pair.value;
                weight += pair.value;
            }
            let own = sediment.velocity.get(a).copied().unwrap_or_else(Vector::zeros);
            *slip = if weight > 0.0 { (sum / weight - own).norm() } else { 0.0 };
            *factor = match material.drag_form {
                DragForm::Grain => grain_factor(material, *slip, scene.fluid.kinematic_viscosity),
                DragForm::Exchange => {
                    let around = (weight * fluid.lattice_volume).max(scene.numerics.least_fluid);
                    exchange_factor(scene, material, sediment.lattice_volume, &positions[a], *slip, around)
                }
            };
        });
        self.check_reynolds(fluid.len(), material, scene.fluid.kinematic_viscosity)
    }

    /// The largest Reynolds number of a grain must lie within the range of the law.
    fn check_reynolds(&self, first_row: usize, material: &Sediment<D>, viscosity: f64) -> Result<(), Failure> {
        let mut largest = (0.0, 0);
        for (particle, slip) in self.slip.iter().enumerate() {
            let reynolds = slip * material.drag_diameter / viscosity;
            if reynolds > largest.0 || reynolds.is_nan() {
                largest = (reynolds, particle);
            }
        }
        let (reynolds, grain) = largest;
        let range = material.drag.reynolds_range();
        if range.contains(&reynolds) {
            return Ok(());
        }
        let (row, limit) = (first_row + grain, *range.end());
        Err(Failure { row, quantity: Quantity::Reynolds, value: reynolds, limit })
    }
}

/// The factor of a sediment particle of a volume `[m^D]` by the exchange coefficient at its place `[m]` and slip `[m/s]`,
/// with Σ V W `[-]` of the fluid around it.
fn exchange_factor<const D: usize>(
    scene: &IncompressibleScene<D>,
    material: &Sediment<D>,
    volume: f64,
    position: &Vector<D>,
    slip: f64,
    fluid_around: f64,
) -> f64 {
    let fraction = scene.solid_fraction.stratification().map_or(0.0, |layer| layer.solid_fraction_at(position));
    let (density, viscosity) = (scene.fluid.density, scene.fluid.kinematic_viscosity);
    let exchange = material.drag.exchange_coefficient(fraction, slip, material.drag_diameter, density, viscosity);
    drag_pair::exchange_factor(volume, exchange, density, fluid_around)
}

/// ½ C_d d |u| of (30) `[m²/s]`; Ergun's law, which has no single grain, gives none.
fn grain_factor<const D: usize>(material: &Sediment<D>, slip: f64, kinematic_viscosity: f64) -> f64 {
    let reynolds = slip * material.drag_diameter / kinematic_viscosity;
    let product = material.drag.drag_times_reynolds(reynolds).unwrap_or(0.0);
    0.5 * product * kinematic_viscosity
}
