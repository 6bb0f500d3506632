//! One pore pressure for both phases: ∇·(φ u_s + (1 − φ) u_f) = 0, with −φ ∇p on the grains and −(1 − φ) ∇p on the fluid.
//!
//! The pressure lives on the fluid particles. With s = 1 − φ, the D and G of `pressure_poisson`, and
//! c_aj = v_j ∇_aW_aj for a sediment particle j of the grain volume v_j:
//!
//! - divergence (𝒟u)_a = s_a (D u_f)_a + Σ_j c_aj·(u_j − u_a), which is s ∇·u_f + ∇·(φ u_s) − u_f·∇φ
//! - impulse of the fluid particle −Δt V [G(s p) + p Σ_j c_aj]_a, which is −Δt V s ∇p
//! - impulse of the sediment particle Δt V Σ_a p_a c_aj, which is −Δt v_j ∇p
//!
//! The impulses are V 𝒟ᵀ p: every pair exchanges equal and opposite ones, and L = 𝒟 M⁻¹ V 𝒟ᵀ is positive. As for one
//! phase, σ L is added to a compact Laplacian A with the mobility s/ρ_f + φ/ρ_s, and (A + σ L) p = −(𝒟u*/Δt + s γ (1 − δ)/Δt²)
//! is solved.
//!
//! Without a stress between the grains, two phases that share one pressure and slip through each other are unstable at
//! short waves: their equations have complex characteristics. A drag kernel of two to three spacings holds that back for
//! a while: at φ = ½ and a slip of 100 spacings a second uneven velocities grow by e in 0.08 s with two, in 0.13 s with three.
//! Fluid particles keep their volume of the lattice, so that the form serves suspensions whose φ changes little.

mod step;

pub(crate) use step::Flux;

use super::correction::Correction;
use super::pressure_poisson::{LATTICE_ROWS, PressurePoisson};
use crate::domain::Domain;
use crate::incompressible::passes::drag_exchange::DragExchange;
use crate::incompressible::{LEAST_TASK, MOST_ITERATIONS, Phase, ProjectionNumerics};
use crate::linear::{ConjugateGradient, Criterion, Lattices, NotConverged};
use crate::parallel::prelude::*;
use crate::vector::Vector;

/// Divergence over that of the parts that it is made of, below which it is rounding `[-]`.
const ROUNDING: f64 = 1e-13;

/// Arrays of the mixture's pressure solve besides the operators of the fluid, reused from step to step.
#[derive(Debug, Default)]
pub struct Mixture<const D: usize> {
    /// Grain volumes of the sediment, the free particles first and then the fixed `[m^D]`.
    grain_volume: Vec<f64>,
    /// Σ_j c_aj of every fluid particle `[1/m]`.
    cross: Vec<Vector<D>>,
    /// V/(m s) of the fluid and V/m of the sediment particles `[m³/kg]`.
    fluid_mobility: Vec<f64>,
    sediment_mobility: Vec<f64>,
    /// s/ρ_f + φ/ρ_s of every fluid particle `[m³/kg]`.
    mobility: Vec<f64>,
    /// Excess of the compact Laplacian's diagonal over the sum of its links `[1/m²]`.
    held: Vec<f64>,
    /// s p `[Pa]`.
    weighted: Vec<f64>,
    /// Accelerations by a pressure `[m/s²]`.
    fluid_change: Vec<Vector<D>>,
    sediment_change: Vec<Vector<D>>,
    /// Reciprocal of the diagonal `[m³ Pa/s]`.
    pub inverse_diagonal: Vec<f64>,
    right_side: Vec<f64>,
    deviation: Vec<f64>,
    /// Accelerations by all pressure of the last step, the fluid's particles first `[m/s²]`.
    pub(crate) push: Vec<Vector<D>>,
    /// Uniform pressure gradient of the last step `[Pa/m]`; none where the flux is free.
    pub(crate) mean_gradient: Option<Vector<D>>,
    lattices: Lattices<D>,
    pub(crate) solver: ConjugateGradient<f64>,
}

/// Both phases and the operators between them, as a solve reads them.
pub struct Operators<'a, const D: usize> {
    /// Operators of the fluid.
    pub poisson: &'a PressurePoisson<D>,
    /// Pairs between the phases.
    pub exchange: &'a DragExchange<D>,
    /// s of every fluid particle `[-]`.
    pub voidage: &'a [f64],
    /// Σ V (−F) x² of the cross kernel over a lattice of sediment, by which c_aj is divided `[-]`.
    pub lattice_gradient: f64,
    /// Volume of a fluid particle `[m^D]`.
    pub fluid_volume: f64,
    /// σ `[-]`.
    pub stabilisation: f64,
}

impl<const D: usize> Mixture<D> {
    /// Coefficients at the present positions; the grain volumes are there.
    pub fn assemble(&mut self, operators: &Operators<'_, D>, fluid: &Phase<D>, sediment: &Phase<D>) {
        let count = fluid.len();
        for array in [&mut self.held, &mut self.weighted, &mut self.inverse_diagonal, &mut self.right_side] {
            array.resize(count, 0.0);
        }
        self.fluid_change.resize(count, Vector::zeros());
        self.sediment_change.resize(sediment.len(), Vector::zeros());
        let voidage = operators.voidage;
        let volume = operators.fluid_volume;
        self.fluid_mobility.clear();
        self.fluid_mobility.extend(fluid.mass.iter().zip(voidage).map(|(mass, s)| volume / (mass * s)));
        self.sediment_mobility.clear();
        self.sediment_mobility.extend(sediment.mass.iter().map(|mass| volume / mass));
        self.mobility.clear();
        self.mobility.extend(voidage.iter().map(|s| s / fluid.density + (1.0 - s) / sediment.density));
        self.cross.resize(count, Vector::zeros());
        let volumes = &self.grain_volume;
        self.cross.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(a, cross)| {
            *cross = operators.links(a, volumes).fold(Vector::zeros(), |sum, (_, gradient)| sum + gradient);
        });
        let Self { cross, fluid_mobility, sediment_mobility, mobility, .. } = self;
        (&mut self.inverse_diagonal, &mut self.held).enumerate().with_min_len(LEAST_TASK).for_each(
            |(a, (inverse, held))| {
                let (mut compact, mut wide) = (0.0, 0.0);
                for link in operators.poisson.links(a) {
                    let b = link.source as usize;
                    compact += 0.5 * link.laplacian * (mobility[a] + mobility[b]);
                    wide += voidage[a] * voidage[a] * link.gradient.norm_squared() * fluid_mobility[b];
                }
                *held = operators.poisson.held[a];
                let own = operators.poisson.own[a] * voidage[a] + cross[a];
                wide += own.norm_squared() * fluid_mobility[a];
                for (j, gradient) in operators.links(a, volumes) {
                    wide += sediment_mobility.get(j).map_or(0.0, |mobility| gradient.norm_squared() * mobility);
                }
                *inverse = 1.0 / (compact + *held * mobility[a] + operators.stabilisation * wide);
            },
        );
    }

    /// (𝒟u)_a `[1/s]`.
    pub fn divergence(
        &self,
        operators: &Operators<'_, D>,
        a: usize,
        fluid: &[Vector<D>],
        sediment: &[Vector<D>],
    ) -> f64 {
        let of_fluid = operators.voidage[a] * operators.poisson.divergence(a, fluid) - self.cross[a].dot(&fluid[a]);
        operators
            .links(a, &self.grain_volume)
            .fold(of_fluid, |sum, (j, gradient)| sum + sediment.get(j).map_or(0.0, |velocity| gradient.dot(velocity)))
    }

    /// Accelerations of both phases by a pressure `[Pa]`.
    fn find_changes(&mut self, operators: &Operators<'_, D>, p: &[f64]) {
        for ((weighted, p), s) in self.weighted.iter_mut().zip(p).zip(operators.voidage) {
            *weighted = s * p;
        }
        let Self { weighted, cross, fluid_mobility, sediment_mobility, grain_volume, .. } = self;
        self.fluid_change.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(a, change)| {
            *change = (operators.poisson.gradient(a, weighted) + cross[a] * p[a]) * -fluid_mobility[a];
        });
        let scale = 1.0 / operators.lattice_gradient;
        self.sediment_change.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(j, change)| {
            let mut sum = Vector::zeros();
            for pair in operators.exchange.of_sediment.of(j) {
                // ∇_aW_aj = −F (x_j − x_a)
                sum -= pair.separation * (pair.gradient * p[pair.source as usize]);
            }
            *change = sum * (scale * grain_volume[j] * sediment_mobility[j]);
        });
    }

    /// (A + σ L) p.
    pub fn apply(&mut self, operators: &Operators<'_, D>, p: &[f64], product: &mut [f64]) {
        self.find_changes(operators, p);
        let this = &*self;
        product.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(a, out)| {
            let mut compact = this.held[a] * this.mobility[a] * p[a];
            for link in operators.poisson.links(a) {
                let b = link.source as usize;
                compact += 0.5 * link.laplacian * (this.mobility[a] + this.mobility[b]) * (p[a] - p[b]);
            }
            let wide = this.divergence(operators, a, &this.fluid_change, &this.sediment_change);
            *out = compact + operators.stabilisation * wide;
        });
    }

    /// Solves for the pressures of the fluid particles `[Pa]` and leaves the accelerations that they make.
    fn solve(
        &mut self,
        operators: &Operators<'_, D>,
        fluid: &mut Phase<D>,
        (numerics, domain): (&ProjectionNumerics, &Domain<D>),
        predicted: (&[Vector<D>], &[Vector<D>]),
        time_step: f64,
    ) -> Result<(), NotConverged> {
        let mut right_side = std::mem::take(&mut self.right_side);
        let this = &*self;
        right_side.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(a, right)| {
            let missing = numerics.density_correction * Correction::Both.missing(fluid, a) / (time_step * time_step);
            let divergence = this.divergence(operators, a, predicted.0, predicted.1);
            *right = -(divergence / time_step + operators.voidage[a] * missing);
        });
        let gauge = operators.poisson.gauge;
        gauge.take_mean_out(&mut right_side);
        // a uniform flow on a lattice has no divergence but rounding, which no solve gets rid of
        let speed = predicted.0.iter().chain(predicted.1).fold(0.0_f64, |most, u| most.max(u.norm_squared())).sqrt();
        let rounding = ROUNDING * (speed / (fluid.spacing * time_step) + 1.0 / (time_step * time_step));
        if right_side.iter().all(|right| right.abs() <= rounding) {
            right_side.fill(0.0);
        }
        let criterion = Criterion { tolerance: numerics.pressure_tolerance, most_iterations: MOST_ITERATIONS };
        let mut solver = std::mem::take(&mut self.solver);
        let mut deviation = std::mem::take(&mut self.deviation);
        let mut inverse = std::mem::take(&mut self.inverse_diagonal);
        let mut lattices = std::mem::take(&mut self.lattices);
        let many = inverse.len() >= LATTICE_ROWS;
        if many {
            let row = |a: usize| (self.mobility[a], self.held[a] * self.mobility[a]);
            lattices.lay(&fluid.position, domain, fluid.spacing, inverse.iter().copied(), row);
        }
        let operator = |p: &[f64], product: &mut [f64]| {
            gauge.apply(p, product, &mut deviation, |p, product| self.apply(operators, p, product));
        };
        let outcome = if many {
            solver.solve(&mut fluid.pressure, &right_side, &mut lattices, None, criterion, operator)
        } else {
            solver.solve(&mut fluid.pressure, &right_side, &mut inverse, None, criterion, operator)
        };
        gauge.take_mean_out(&mut fluid.pressure);
        (self.solver, self.deviation, self.lattices) = (solver, deviation, lattices);
        (self.inverse_diagonal, self.right_side) = (inverse, right_side);
        outcome?;
        self.find_changes(operators, &fluid.pressure);
        Ok(())
    }
}

impl<const D: usize> Operators<'_, D> {
    /// The sediment particles around a fluid particle, with c_aj `[1/m]`.
    fn links<'a>(&'a self, a: usize, grain_volume: &'a [f64]) -> impl Iterator<Item = (usize, Vector<D>)> + 'a {
        let scale = 1.0 / self.lattice_gradient;
        self.exchange.of_fluid.of(a).iter().map(move |pair| {
            let j = pair.source as usize;
            (j, pair.separation * (scale * grain_volume[j] * pair.gradient))
        })
    }
}
