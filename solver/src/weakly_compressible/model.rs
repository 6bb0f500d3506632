//! What stays the same from step to step, and the passes that it parameterises.

use crate::kernel::Kernel;
use crate::lanes::InstructionSet;
use crate::material::equation_of_state::EquationOfState;
use crate::material::rheology::Rheology;
use crate::vector::Vector;
use crate::weakly_compressible::boundary::Wall;
use crate::weakly_compressible::boundary::wall_extrapolation::WallExtrapolation;
use crate::weakly_compressible::neighbours::VerletList;
use crate::weakly_compressible::numerics::{MomentumOperator, Numerics};
use crate::weakly_compressible::operators::geometry::Geometry;
use crate::weakly_compressible::terms::continuity::{Continuity, GradientUse};
use crate::weakly_compressible::terms::{momentum::Momentum, pairwise::Pairwise};
use crate::weakly_compressible::viscous_solve::ViscousSolve;

/// Material, numerics and neighbour list: all that a pass needs beside the particles.
#[derive(Debug)]
pub(crate) struct Model<const D: usize> {
    pub(crate) wall_planes: Vec<Wall<D>>,
    pub(crate) list: VerletList,
    pub(crate) kernel: Kernel<D>,
    pub(crate) equation_of_state: EquationOfState,
    pub(crate) rheology: Rheology,
    pub(crate) numerics: Numerics,
    pub(crate) gravity: Vector<D>,
    pub(crate) spacing: f64,
    pub(crate) contact_friction: f64,
    pub(crate) instruction_set: InstructionSet,
}

impl<const D: usize> Model<D> {
    /// What the momentum operator and the law need of the velocity gradient.
    pub(crate) fn gradient_use(&self) -> GradientUse {
        match self.numerics.momentum_operator {
            MomentumOperator::SingleDivergence | MomentumOperator::UncorrectedDivergence => GradientUse::Stress,
            MomentumOperator::Pairwise
                if matches!(self.rheology, Rheology::Newtonian(_)) && self.numerics.density_coupling == 0.0 =>
            {
                GradientUse::None
            }
            MomentumOperator::Pairwise | MomentumOperator::PairwiseCorrected => GradientUse::Viscosity,
        }
    }

    pub(crate) fn continuity(&self, time_step: f64) -> Continuity<'_, D> {
        Continuity {
            kernel: self.kernel,
            list: &self.list,
            instruction_set: self.instruction_set,
            equation_of_state: self.equation_of_state,
            rheology: &self.rheology,
            shear_modulus: self.numerics.shear_modulus_ratio * self.equation_of_state.bulk_modulus,
            density_coupling: self.numerics.density_coupling,
            viscosity_switch: self.numerics.viscosity_switch,
            time_step,
            gradient: self.gradient_use(),
        }
    }

    pub(crate) fn walls(&self) -> WallExtrapolation<'_, D> {
        WallExtrapolation {
            kernel: self.kernel,
            list: &self.list,
            instruction_set: self.instruction_set,
            gravity: self.gravity,
            spacing: self.spacing,
            reference_density: self.equation_of_state.reference_density,
            treatment: self.numerics.wall_treatment,
        }
    }

    pub(crate) fn geometry(&self) -> Geometry<'_, D> {
        Geometry {
            kernel: self.kernel,
            list: &self.list,
            instruction_set: self.instruction_set,
            momentum_operator: self.numerics.momentum_operator,
            rheology: &self.rheology,
            elastic_viscosity: self.numerics.elastic_damping
                * self.equation_of_state.reference_density
                * self.equation_of_state.sound_speed()
                * self.numerics.shear_modulus_ratio.sqrt()
                * self.kernel.smoothing_length(),
            mixing_area: self.mixing_area(),
        }
    }

    /// (C_s Δ)² `[m²]` of the eddy viscosity (5).
    fn mixing_area(&self) -> f64 {
        (self.numerics.smagorinsky_constant * self.spacing).powi(2)
    }

    pub(crate) fn viscous_solve(&self, time_step: f64) -> ViscousSolve<'_, D> {
        ViscousSolve {
            list: &self.list,
            instruction_set: self.instruction_set,
            mixing_area: self.mixing_area(),
            smoothing_length: self.kernel.smoothing_length(),
            tolerance: self.numerics.viscous_tolerance,
            time_step,
        }
    }

    pub(crate) fn momentum(&self) -> Momentum<'_, D> {
        Momentum {
            kernel: self.kernel,
            list: &self.list,
            instruction_set: self.instruction_set,
            gravity: self.gravity,
            reference_density: self.equation_of_state.reference_density,
            sound_speed: self.equation_of_state.sound_speed(),
            artificial_viscosity: self.numerics.artificial_viscosity,
            viscosity_switch: self.numerics.viscosity_switch,
            hourglass: self.numerics.hourglass,
        }
    }

    pub(crate) fn pairwise(&self) -> Pairwise<'_, D> {
        Pairwise {
            kernel: self.kernel,
            list: &self.list,
            instruction_set: self.instruction_set,
            momentum_operator: self.numerics.momentum_operator,
            gravity: self.gravity,
            reference_density: self.equation_of_state.reference_density,
            bulk_modulus: self.equation_of_state.bulk_modulus,
            sound_speed: self.equation_of_state.sound_speed(),
            artificial_viscosity: self.numerics.artificial_viscosity,
            viscosity_switch: self.numerics.viscosity_switch,
        }
    }
}
