//! The drag between the phases as pairs: equal and opposite forces β_ab (u_b − u_a).
//!
//! The printed form (30) gives the force on grain a as Σ_b ½ m_b C_d d |u_ba| W u_ba over the fluid's particles b, hence
//! β_ab = ½ m_b C_d d |u_ab| W with C_d d |u_ab| = (C_d R) ν. The slip is the pair's own, as printed, or that of the
//! grain against the mean of the fluid around it, which the shear within the kernel does not enlarge. In the
//! volume-fraction form a particle of volume V_a feels V_a K (u_f − u_a), shared by W over the fluid around it.

use super::grid::Grid;
use super::numerics::DragSlip;
use super::pairs::{LEAST_TASK, Pairs, Periods, Sources};
use super::phase::{Phase, height_axis};
use super::scene::{DragForm, IncompressibleScene, Sediment, SolidFraction};
use crate::domain::Domain;
use crate::kernel::{Kernel, KernelShape};
use crate::vector::Vector;
use rayon::prelude::*;

/// Pairs between the phases, and what a step needs of them.
#[derive(Debug)]
pub(super) struct DragExchange<const D: usize> {
    /// Sediment particles, the free ones first and then the fixed, with the fluid around them.
    pub(super) of_sediment: Pairs<D>,
    /// Fluid particles with the sediment around them, indexed as above.
    pub(super) of_fluid: Pairs<D>,
    /// Positions of the sediment, free and fixed `[m]`.
    sediment: Vec<Vector<D>>,
    /// β_ab/(m_b W) of every sediment particle, from its mean slip `[m²/s]` in 2-D.
    mean_factor: Vec<f64>,
    /// |u_f − u_s| of every sediment particle `[m/s]`.
    slip: Vec<f64>,
    /// Largest Reynolds number of a grain in this step, and which.
    pub(super) largest_reynolds: (f64, usize),
    kernel: Kernel<D>,
    grid: Grid<D>,
}

impl<const D: usize> DragExchange<D> {
    pub(super) fn new(smoothing_length: f64) -> Self {
        Self {
            of_sediment: Pairs::new(),
            of_fluid: Pairs::new(),
            sediment: Vec::new(),
            mean_factor: Vec::new(),
            slip: Vec::new(),
            largest_reynolds: (0.0, 0),
            kernel: Kernel::new(KernelShape::CubicSpline, smoothing_length),
            grid: Grid::new(),
        }
    }

    pub(super) fn kernel(&self) -> &Kernel<D> {
        &self.kernel
    }

    /// Largest distance of a pair `[m]`.
    pub(super) fn reach(&self) -> f64 {
        self.kernel.support()
    }

    /// Finds the candidates of the pairs between the phases.
    pub(super) fn search(
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
        self.of_sediment.search(&self.sediment, &fluid.position, Sources::Other, &self.grid, periods, radius);
        self.grid.sort(&self.sediment, domain, radius);
        self.of_fluid.search(&fluid.position, &self.sediment, Sources::Other, &self.grid, periods, radius);
    }

    /// Measures the pairs between the phases.
    pub(super) fn measure(&mut self, fluid: &Phase<D>, sediment: &Phase<D>, periods: &Periods<D>) {
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
    pub(super) fn factor(
        &self,
        particle: usize,
        material: &Sediment<D>,
        slip: impl FnOnce() -> f64,
        scene: &IncompressibleScene<D>,
    ) -> f64 {
        match scene.numerics.drag_slip {
            DragSlip::Mean => self.mean_factor[particle],
            DragSlip::Pair => printed_factor(material, slip(), scene.fluid.kinematic_viscosity),
        }
    }

    /// Finds the slip of every grain against the mean of the fluid around it, its Reynolds number and its factor.
    pub(super) fn find_mean_factors(
        &mut self,
        fluid: &Phase<D>,
        sediment: &Phase<D>,
        scene: &IncompressibleScene<D>,
        material: &Sediment<D>,
    ) {
        self.mean_factor.resize(self.sediment.len(), 0.0);
        self.slip.resize(self.sediment.len(), 0.0);
        let (of_sediment, positions) = (&self.of_sediment, &self.sediment);
        let layer = scene.solid_fraction.stratification();
        let averaged = matches!(scene.solid_fraction, SolidFraction::Averaged(_));
        let viscosity = scene.fluid.kinematic_viscosity;
        let normal = height_axis(D);
        (&mut self.mean_factor, &mut self.slip).into_par_iter().enumerate().with_min_len(LEAST_TASK).for_each(
            |(a, (factor, slip))| {
                let (mut sum, mut weight) = (Vector::zeros(), 0.0);
                for pair in of_sediment.of(a) {
                    sum += fluid.velocity[pair.source as usize] * pair.value;
                    weight += pair.value;
                }
                let own = sediment.velocity.get(a).copied().unwrap_or_else(Vector::zeros);
                *slip = if weight > 0.0 { (sum / weight - own).norm() } else { 0.0 };
                *factor = match material.drag_form {
                    DragForm::Grain(_) => printed_factor(material, *slip, viscosity),
                    DragForm::Exchange => {
                        let fraction = layer.map_or(0.0, |layer| layer.at(positions[a][normal]).solid_fraction);
                        let diameter = material.grain_diameter;
                        let density = scene.fluid.density;
                        let exchange =
                            material.drag.exchange_coefficient(fraction, *slip, diameter, density, viscosity);
                        let volume = match sediment.mass.get(a) {
                            // K is that of the mean fraction, so the volume must be that too: all grains have the same
                            Some(mass) if averaged => mass / (sediment.density * fraction.max(LEAST_FRACTION)),
                            _ => sediment.volume.get(a).copied().unwrap_or(sediment.lattice_volume),
                        };
                        // shared by the fluid around: Σ_b m_b W is the fluid's density where its particles are all there
                        volume * exchange / (density * (weight * fluid.lattice_volume).max(LEAST_FLUID))
                    }
                };
            },
        );
        self.largest_reynolds = (0.0, 0);
        for (particle, slip) in self.slip.iter().enumerate() {
            let reynolds = slip * material.grain_diameter / viscosity;
            if reynolds > self.largest_reynolds.0 || reynolds.is_nan() {
                self.largest_reynolds = (reynolds, particle);
            }
        }
    }
}

/// Σ V W of the fluid around a sediment particle below which its drag is not shared out in full `[-]`: where a particle
/// leaves the water, the force must fall with the water that there is.
const LEAST_FLUID: f64 = 0.3;

/// Mean solid fraction below which a grain's drag is that of a grain alone `[-]`.
const LEAST_FRACTION: f64 = 1e-3;

/// ½ C_d d |u| of (30) `[m²/s]`; Ergun's law, which has no single grain, gives none.
fn printed_factor<const D: usize>(material: &Sediment<D>, slip: f64, kinematic_viscosity: f64) -> f64 {
    let reynolds = slip * material.grain_diameter / kinematic_viscosity;
    let product = material.drag.drag_times_reynolds(reynolds).unwrap_or(0.0);
    let factor = match material.drag_form {
        DragForm::Grain(factor) => factor,
        DragForm::Exchange => 1.0,
    };
    0.5 * factor * product * kinematic_viscosity
}
