//! Forces in a step: accelerations by the operator that is chosen, and by an implicit viscosity.

use crate::run::Divergence;
use crate::weakly_compressible::divergence::Quantity;
use crate::weakly_compressible::passes::{geometry, momentum, pairwise};
use crate::weakly_compressible::viscous_solve::{MOST_ITERATIONS, NotConverged, ViscousSolve};
use crate::weakly_compressible::{GradientUse, MomentumOperator, State, ViscousStep};

impl<const D: usize> State<D> {
    /// Accelerations at the present positions and velocities.
    ///
    /// # Errors
    /// An implicit viscosity whose solve does not converge.
    pub(crate) fn find_accelerations(&mut self, time_step: f64) -> Result<(), Divergence<D>> {
        match self.model.numerics.momentum_operator {
            MomentumOperator::SingleDivergence | MomentumOperator::UncorrectedDivergence | MomentumOperator::ByLaw => {
                geometry::run(&self.model, &mut self.particles, &mut self.pairs);
                self.images.copy_vectors(&mut self.particles.pressure_gradient);
                self.images.copy_tensors(&mut self.particles.corrected_stress);
                self.images.copy_tensors(&mut self.particles.velocity_gradient);
                self.images.copy_scalars(&mut self.particles.artificial_viscosity);
                momentum::run(&self.model, &mut self.particles, &mut self.pairs);
                if self.model.numerics.viscous_step == ViscousStep::Implicit {
                    self.accelerate_by_viscosity(time_step)?;
                }
            }
            MomentumOperator::Pairwise | MomentumOperator::PairwiseCorrected => {
                if self.model.gradient_use() != GradientUse::None {
                    geometry::run(&self.model, &mut self.particles, &mut self.pairs);
                    self.images.copy_vectors(&mut self.particles.pressure_gradient);
                }
                self.images.copy_scalars(&mut self.particles.viscosity);
                self.images.copy_scalars(&mut self.particles.artificial_viscosity);
                pairwise::run(&self.model, &mut self.particles, &mut self.pairs);
            }
        }
        Ok(())
    }

    /// Accelerations that answer to the viscosity at the new velocity.
    fn accelerate_by_viscosity(&mut self, time_step: f64) -> Result<(), Divergence<D>> {
        let solve = ViscousSolve { model: &self.model, pairs: &self.pairs, time_step };
        match solve.run(&mut self.particles, &self.images, &mut self.viscous) {
            Ok(()) => {
                self.energy.viscous -= self.viscous.work;
                self.book_reaction(time_step);
                Ok(())
            }
            Err(NotConverged { worst }) => {
                let tolerance = self.model.numerics.viscous_tolerance;
                let quantity = Quantity::ViscousResidual { tolerance, most_iterations: MOST_ITERATIONS };
                Err(self.divergence(worst, quantity, self.viscous.residual))
            }
        }
    }

    /// Books what walls and planes of symmetry have given by the response of an implicit step, where the flow is enclosed.
    fn book_reaction(&mut self, time_step: f64) {
        if self.enclosure.is_empty() {
            return;
        }
        let flow = self.particles.flow_count();
        let solve = ViscousSolve { model: &self.model, pairs: &self.pairs, time_step };
        let booking = self.enclosure.booking(flow);
        solve.book_reaction(&mut self.particles, &self.images, &mut self.viscous, booking);
        self.enclosure.close_reaction(self.viscous.left(flow));
    }
}
