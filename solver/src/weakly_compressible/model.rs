//! Material, numerics and neighbour list: all that a pass needs beside the particles.

use crate::kernel::Kernel;
use crate::lanes::algebra::{deviatoric_rate, invariant};
use crate::lanes::{InstructionSet, Lanes, Real};
use crate::material::equation_of_state::{EquationOfState, Tension};
use crate::material::pore_liquid::{PoreLiquid, SKELETON_SHARE};
use crate::material::rheology::field::{FieldBoundary, FieldDiffusion, FieldStep, LawField};
use crate::material::rheology::{ElasticModuli, Rheology};
use crate::material::turbulence::{Smagorinsky, dynamic_eddy_viscosity};
use crate::vector::Vector;
use crate::weakly_compressible::terms::artificial_stress::ArtificialStress;
use crate::weakly_compressible::terms::artificial_viscosity::SWITCH_LOWEST;
use crate::weakly_compressible::terms::stress_diffusion::steepness;
use crate::weakly_compressible::{MomentumOperator, Numerics, VerletList, ViscositySwitch};

/// Properties of a run that do not change from step to step. Only the neighbour list does: a search fills it anew.
#[derive(Debug)]
pub struct Model<const D: usize> {
    /// Neighbour list.
    pub list: VerletList,
    /// Kernel.
    pub kernel: Kernel<D>,
    /// Equation of state.
    pub equation_of_state: EquationOfState,
    /// Constitutive law.
    pub rheology: Rheology,
    /// Numerics.
    pub numerics: Numerics,
    /// Gravity `[m/s²]`.
    pub gravity: Vector<D>,
    pub(crate) spacing: f64,
    pub(crate) contact_friction: f64,
    pub(crate) instruction_set: InstructionSet,
    /// Field that the law keeps of each particle.
    pub(crate) field: Option<LawField>,
    /// Σ −2 V F over a lattice `[1/m²]`.
    pub full_weight: f64,
    /// W(0) where tension is cut, so that grains may fly apart, else 0 `[1/m^D]`.
    pub(crate) lone_density_per_mass: f64,
    /// Whether plastic flow changes the volume, so that the pressure depends on the field also.
    pub(crate) dilates: bool,
    /// Liquid that bears a part of the pressure, which is the law's field.
    pub(crate) pore_liquid: Option<PoreLiquid>,
    /// Whether walls turn.
    pub(crate) turns: bool,
    /// Artificial stress of a cohesive law.
    pub artificial_stress: Option<ArtificialStress>,
}

/// Quantities that diffuse among pairs in the pass of continuity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PairDiffusion {
    /// Nothing.
    None,
    /// The ratio of stress and pressure among yielding particles.
    StressRatio,
    /// That and the law's field.
    Field,
    /// The pressure of a pore liquid alone, by the conductivities of both particles.
    PorePressure,
}

/// Whether the velocity gradient is made.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum GradientUse {
    /// Gradient and stress are updated.
    Stress,
    /// Gradient and apparent viscosity are updated, for the pairwise operators.
    Viscosity,
    /// The density alone is updated: a Newtonian fluid with pairwise viscosity.
    None,
}

impl<const D: usize> Model<D> {
    /// Coefficient α of the artificial viscosity that particles begin with `[-]`.
    pub(crate) fn initial_artificial_viscosity(&self) -> f64 {
        match self.numerics.viscosity_switch {
            ViscositySwitch::Constant => self.numerics.artificial_viscosity,
            ViscositySwitch::MorrisMonaghan => SWITCH_LOWEST,
        }
    }

    /// Use of the velocity gradient in the momentum operator and in the law.
    pub(crate) fn gradient_use(&self) -> GradientUse {
        match self.numerics.momentum_operator {
            MomentumOperator::SingleDivergence | MomentumOperator::UncorrectedDivergence | MomentumOperator::ByLaw => {
                GradientUse::Stress
            }
            MomentumOperator::Pairwise
                if matches!(self.rheology, Rheology::Newtonian(_)) && self.numerics.density_coupling == 0.0 =>
            {
                GradientUse::None
            }
            MomentumOperator::Pairwise | MomentumOperator::PairwiseCorrected => GradientUse::Viscosity,
        }
    }

    /// Whether the flow may slide along a rough wall as far as its volume is concerned: a liquid, whose boundary layer can
    /// be thinner than a spacing, but no grains.
    pub fn slides(&self) -> bool {
        !self.rheology.is_solid() && self.gradient_use() == GradientUse::Stress
    }

    /// Reach of the neighbour list beyond the kernel `[m]`.
    pub(crate) fn skin(&self) -> f64 {
        self.numerics.verlet_skin * self.kernel.support()
    }

    /// Elastic shear modulus G `[Pa]` of laws by return mapping.
    pub(crate) fn shear_modulus(&self) -> f64 {
        self.numerics.shear_modulus_ratio * self.equation_of_state.bulk_modulus
    }

    /// Moduli of a step whose volume is given.
    pub fn moduli(&self) -> ElasticModuli {
        ElasticModuli { shear: self.shear_modulus(), bulk: self.equation_of_state.bulk_modulus }
    }

    /// Pressure `[Pa]` at a density `[kg/m³]` and what the law keeps: that of the equation of state at ρ exp(e), with the plastic volume strain e.
    /// With a pore liquid the sum of its pressure and that of the skeleton, K_s (ρ φ_0/(ρ_0 φ) − 1).
    #[inline(always)]
    pub fn pressure<R: Real>(&self, density: R, kept: &FieldStep<R>) -> R {
        if self.pore_liquid.is_none() {
            return self.equation_of_state.pressure(density * self.rheology.loosening(kept.value));
        }
        let pore = kept.pore();
        let reference = R::splat(self.equation_of_state.reference_density);
        let strain = (density - reference + density * pore.growth) / reference;
        R::splat(SKELETON_SHARE * self.equation_of_state.bulk_modulus) * strain + pore.pressure
    }

    /// Whether the law changes the pressure in its step, by dilation or through the pore liquid.
    pub(crate) fn law_moves_pressure(&self) -> bool {
        self.dilates || self.pore_liquid.is_some()
    }

    /// Density `[kg/m³]` below which tension is cut, at a field of the law; zero where it is kept.
    #[inline(always)]
    pub(crate) fn free_density<R: Real>(&self, field: R) -> R {
        match self.equation_of_state.tension {
            Tension::Cut if self.pore_liquid.is_none() => {
                R::splat(self.equation_of_state.reference_density) / self.rheology.loosening(field)
            }
            _ => R::splat(0.0),
        }
    }

    /// ζ ρ0 c_s h `[Pa·s]`: viscosity that damps elastic waves below the yield. Without it an arrested layer
    /// swings for ever; a flowing one does not feel it.
    pub(crate) fn elastic_viscosity(&self) -> f64 {
        self.numerics.elastic_damping
            * self.equation_of_state.reference_density
            * self.equation_of_state.sound_speed()
            * self.numerics.shear_modulus_ratio.sqrt()
            * self.kernel.smoothing_length()
    }

    /// Viscosity beside the law's `[Pa·s]` of eight particles, of elastic damping and eddies, at a velocity gradient
    /// `[1/s]`, a stress and a pressure `[Pa]`, a density `[kg/m³]` and what the law keeps; none where there is neither.
    #[inline(always)]
    pub(crate) fn added_viscosity<V: Lanes>(
        &self,
        gradient: &[[V; D]; D],
        stress: &[[V; D]; D],
        pressure: V,
        density: V,
        field: &FieldStep<V>,
    ) -> Option<V> {
        let (elastic_viscosity, mixing_area) = (self.elastic_viscosity(), self.mixing_area());
        let damped = elastic_viscosity > 0.0 && self.rheology.is_plastic();
        if !damped && mixing_area <= 0.0 {
            return None;
        }
        let mut viscosity = V::splat(0.0);
        if damped {
            let elasticity = self.rheology.elasticity(invariant(0.5, stress), pressure, field, elastic_viscosity);
            viscosity = elasticity * V::splat(elastic_viscosity);
        }
        if mixing_area > 0.0 {
            let shear_rate = invariant(2.0, &deviatoric_rate(gradient));
            viscosity = viscosity + dynamic_eddy_viscosity(density, mixing_area, shear_rate);
        }
        Some(viscosity)
    }

    /// δ c h `[m²/s]`: diffusivity of the stress ratio among yielding particles; that of a steep law is larger.
    pub(crate) fn stress_diffusivity(&self) -> f64 {
        let coefficient = self.numerics.stress_diffusion * steepness(self.rheology.contact_friction());
        coefficient * self.equation_of_state.sound_speed() * self.kernel.smoothing_length()
    }

    /// σ of the density–pressure coupling (27) `[-]`. None in soil that holds together: there the pressure is one of the stresses in
    /// balance and as uneven as they are at faces and corners, where the coupling never vanishes; it would make slopes at rest creep.
    #[inline(always)]
    pub(crate) fn density_coupling(&self) -> f64 {
        if self.rheology.is_cohesive() { 0.0 } else { self.numerics.density_coupling }
    }

    /// Whether the terms of pairs are single precision.
    pub fn pairs_in_single(&self) -> bool {
        self.numerics.pairs_in_single()
    }

    /// Quantities that diffuse among pairs: the stress ratio of a law that carries its stress along, and a field of the
    /// law.
    #[inline(always)]
    pub(crate) fn pair_diffusion(&self) -> PairDiffusion {
        if self.pore_liquid.is_some() {
            PairDiffusion::PorePressure
        } else if self.field_diffusion().is_some() {
            PairDiffusion::Field
        } else if self.stress_diffuses() {
            PairDiffusion::StressRatio
        } else {
            PairDiffusion::None
        }
    }

    /// Whether the stress ratio diffuses: where a law carries its stress along and has no cohesion, which would make the ratio of
    /// yielding neighbours differ. A law with a length of its own does not need it against waves, but its fluidity answers to the mean of a convex function of the stress ratio, which uneven particles raise.
    #[inline(always)]
    pub(crate) fn stress_diffuses(&self) -> bool {
        self.rheology.strength_is_friction()
            && self.pore_liquid.is_none()
            && self.numerics.stress_diffusion > 0.0
            && self.gradient_use() == GradientUse::Stress
    }

    /// Energy of both pressures of a mixture `[J/m³]`, p′²/2K_s + p_f²/2K_f, from the total pressure and that of the liquid `[Pa]`.
    #[inline(always)]
    pub(crate) fn pore_energy<R: Real>(&self, pressure: R, liquid: R) -> R {
        let modulus = self.equation_of_state.bulk_modulus;
        let effective = pressure - liquid;
        R::splat(0.5 / (SKELETON_SHARE * modulus)) * (effective * effective)
            + R::splat(0.5 / ((1.0 - SKELETON_SHARE) * modulus)) * (liquid * liquid)
    }

    /// Conductivity of a pore liquid over that at the start `[-]`, from the plastic growth of the volume `[-]`.
    pub(crate) fn relative_conductivity(&self, growth: f64) -> f64 {
        self.pore_liquid.map_or(1.0, |pore| {
            pore.conductivity(pore.solid_fraction / (1.0 + growth)) / pore.conductivity(pore.solid_fraction)
        })
    }

    /// Diffusion of the law's field, if it diffuses.
    #[inline(always)]
    pub fn field_diffusion(&self) -> Option<FieldDiffusion> {
        self.field.and_then(|field| field.diffusion)
    }

    /// Whether a field vanishes at the free surface, which has to be found then.
    pub(crate) fn field_meets_surface(&self) -> bool {
        self.field_diffusion().is_some_and(|diffusion| diffusion.surface == FieldBoundary::Vanishing)
    }

    /// Elastic part of a particle, from an equivalent shear stress and a pressure `[Pa]`, and its field and memory.
    #[inline(always)]
    pub fn elasticity(&self, shear_stress: f64, pressure: f64, field: &FieldStep<f64>) -> f64 {
        self.rheology.elasticity(shear_stress, pressure, field, self.elastic_viscosity())
    }

    /// (C_s Δ)² `[m²]` of the eddy viscosity (5).
    pub(crate) fn mixing_area(&self) -> f64 {
        Smagorinsky { coefficient: self.numerics.smagorinsky_constant }.mixing_length(self.spacing).powi(2)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::rheology::SofteningDruckerPrager;
    use crate::weakly_compressible::scene::{Flow, Scene};
    use crate::weakly_compressible::state::State;

    #[test]
    fn the_stress_ratio_diffuses_only_where_friction_alone_bounds_a_stress() {
        let diffusion = |cohesion, numerics| {
            let rheology = Rheology::SofteningDruckerPrager(SofteningDruckerPrager {
                peak_friction: 0.6,
                residual_friction: 0.4,
                peak_cohesion: cohesion,
                residual_cohesion: 0.0,
                softening_strain: 0.1,
                peak_dilation: 0.0,
                dilation_strain: None,
            });
            let equation_of_state =
                EquationOfState { reference_density: 1500.0, bulk_modulus: 6e5, tension: Tension::Cut };
            let flow = Flow::at_rest(vec![Vector::<2>::zeros()], 1500.0, 0.01);
            let scene = Scene { numerics, ..Scene::unbounded(flow, 0.01, equation_of_state, rheology) };
            State::new(scene, &[]).model.pair_diffusion()
        };
        let usual = Numerics::default();
        assert_eq!(diffusion(0.0, usual), PairDiffusion::StressRatio);
        assert_eq!(diffusion(10.0, usual), PairDiffusion::None);
        assert_eq!(diffusion(0.0, Numerics { stress_diffusion: 0.0, ..usual }), PairDiffusion::None);
        let pairwise = Numerics { momentum_operator: MomentumOperator::Pairwise, ..usual };
        assert_eq!(diffusion(0.0, pairwise), PairDiffusion::None);
    }
}
