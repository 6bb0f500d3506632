//! Constitutive laws. A law knows nothing of particles: it turns a local state into a deviatoric stress.
//!
//! Two kinds of law share one enum: viscous laws (shear rate, pressure → viscosity) and plastic laws with a
//! memory of the stress (trial stress → admissible stress). A new law is one file and one line in `laws!`, or, without a
//! fork, a type of a user's own crate that [`open::register`] makes known by its name.
//!
//! The pressure is what the model has: the weakly compressible one evaluates a law at the pressure of its equation of state
//! and the local shear rate of a particle, the incompressible one at the load on the grains (their overburden, for the pore
//! pressure carries no friction) and the rate of a particle or of a pair.
//!
//! Everywhere |γ̇| = √(2 ε′:ε′) `[1/s]` and τ = √(½ s:s) `[Pa]`, so that in simple shear |γ̇| = |du/dy| and
//! τ = |s_xy|. A source that measures the strain rate by |S| = √(S:S) = |γ̇|/√2 means by its yield stress √2
//! times the one here.
//!
//! # A law with a field of its own
//!
//! Some laws carry more than the stress: a fluidity that diffuses, the plastic strain that a material has softened by. Such a
//! law is a [`FieldLaw`]; [`field`] says what it declares and what the model does with it.

mod bingham;
mod coulomb_bingham;
#[cfg(test)]
mod dilation_tests;
pub mod field;
mod field_update;
mod grain_parameters;
mod herschel_bulkley;
#[cfg(test)]
mod lanes_of_a_law_tests;
mod mu_i;
mod newtonian;
mod nonlocal_mu_i;
#[cfg(test)]
mod nonlocal_mu_i_tests;
pub mod open;
mod plastic_dilation;
mod regularisation;
mod regularised_mu_i;
mod root_mu_i;
mod softening_drucker_prager;
#[cfg(test)]
mod softening_drucker_prager_tests;
mod stress_update;
#[cfg(test)]
mod tests;
mod viscous_number;
#[cfg(test)]
mod viscous_number_tests;

pub use bingham::Bingham;
pub use coulomb_bingham::CoulombBingham;
pub use herschel_bulkley::HerschelBulkley;
pub use mu_i::MuI;
pub use newtonian::Newtonian;
pub use nonlocal_mu_i::NonlocalMuI;
pub use regularised_mu_i::RegularisedMuI;
pub use root_mu_i::RootMuI;
pub use softening_drucker_prager::SofteningDruckerPrager;
pub use viscous_number::ViscousNumber;

use field::{FieldLaw, FieldStep, LawField, StateReturn};
use open::{OpenField, OpenPlastic, OpenViscous};

use crate::lanes::algebra::{deviatoric_rate, invariant, load_tensor, store_tensor};
use crate::lanes::{LANES, Lanes, Real};
use crate::material::pore_liquid::PoreLiquid;
use crate::parameter::{ParameterProblem, range_problem};
use crate::vector::Tensor;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A law whose deviatoric stress follows from the present strain rate alone: s = 2 η(|γ̇|, p) ε′.
pub trait ViscousLaw {
    /// Dynamic viscosity η `[Pa·s]` at a shear rate |γ̇| = √(2 ε′:ε′) `[1/s]` and a pressure `[Pa]`.
    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64;

    /// Upper bound `[Pa·s]` of the viscosity over all shear rates at a pressure `[Pa]`: what limits an explicit time step.
    fn largest_viscosity(&self, pressure: f64) -> f64;

    /// Friction coefficient `[-]` of a contact with a rough wall: none of a liquid. A material without it may slide along
    /// rough walls as far as its volume is concerned, because its boundary layer may be thinner than a spacing.
    fn contact_friction(&self) -> f64 {
        0.0
    }
}

/// The state that a return mapping starts from: that of an elastic step.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct TrialStress<R> {
    /// Equivalent shear stress of the elastic trial `[Pa]`.
    pub shear_stress: R,
    /// Pressure `[Pa]`.
    pub pressure: R,
    /// Elastic shear modulus `[Pa]`.
    pub shear_modulus: f64,
    /// Elastic bulk modulus `[Pa]` where the volume of the step is given; 0 where the pressure is.
    pub bulk_modulus: f64,
    /// Time step `[s]`.
    pub time_step: f64,
}

impl<R> TrialStress<R> {
    /// A trial from shear stress, pressure and shear modulus `[Pa]` and a time step `[s]`, at a given pressure.
    #[inline(always)]
    pub fn new(shear_stress: R, pressure: R, shear_modulus: f64, time_step: f64) -> Self {
        Self { shear_stress, pressure, shear_modulus, bulk_modulus: 0.0, time_step }
    }

    /// The same at a given volume, with the elastic bulk modulus `[Pa]` that answers to dilation.
    #[inline(always)]
    #[must_use]
    pub fn with_bulk_modulus(self, bulk_modulus: f64) -> Self {
        Self { bulk_modulus, ..self }
    }

    /// The trial of one particle, with its shear stress and pressure `[Pa]`.
    #[inline(always)]
    fn at(&self, shear_stress: f64, pressure: f64) -> TrialStress<f64> {
        let &Self { shear_modulus, bulk_modulus, time_step, .. } = self;
        TrialStress { shear_stress, pressure, shear_modulus, bulk_modulus, time_step }
    }
}

impl<R: Real> TrialStress<R> {
    /// Pressure `[Pa]` after a plastic volume strain `[-]` that the step adds: that of the equation of state p = K (ρ exp(e)/ρ0 − 1), which the
    /// weakly compressible model has. The trial's own where the pressure is given.
    #[inline(always)]
    #[must_use]
    pub fn dilated_pressure(&self, volume_strain: R) -> R {
        if self.bulk_modulus <= 0.0 {
            return self.pressure;
        }
        let growth = R::lane_by_lane([volume_strain], &|[strain]| libm::expm1(strain));
        self.pressure + (R::splat(self.bulk_modulus) + self.pressure) * growth
    }
}

/// Elastic moduli of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElasticModuli {
    /// Shear modulus `[Pa]`.
    pub shear: f64,
    /// Bulk modulus `[Pa]` where the volume of the step is given; 0 where the pressure is.
    pub bulk: f64,
}

/// A law that carries the stress along: elastic up to a yield stress, then a plastic shear rate.
///
/// The formulas of the stress update are written for any [`Real`], a single value or eight lanes. A cohesion is allowed: the
/// yield stress need not vanish with the pressure. (The weakly compressible model cuts tension, and no particle carries a
/// shear stress at p ≤ 0.)
pub trait PlasticLaw {
    /// Equivalent shear stress `[Pa]` at the end of a time step: the trial up to the yield stress.
    fn admissible_shear_stress<R: Real>(&self, trial: &TrialStress<R>) -> R;

    /// Equivalent shear stress `[Pa]` up to which the material is elastic, at a pressure `[Pa]`.
    fn yield_stress<R: Real>(&self, pressure: R) -> R;

    /// Friction coefficient `[-]` of a contact with a rough wall, a question of its own: a cohesion is no friction.
    fn contact_friction(&self) -> f64;

    /// Apparent viscosity τ/|γ̇| `[Pa·s]` of the steady flow at a shear rate `[1/s]` and a pressure `[Pa]`;
    /// finite also at rest. For diagnostics: the stress update does not use it.
    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64;
}

macro_rules! laws {
    (
        viscous: [$($viscous:ident = $viscous_name:literal),* $(,)?],
        plastic: [$($plastic:ident = $plastic_name:literal),* $(,)?],
        with_field: [$($keeper:ident = $keeper_name:literal),* $(,)?] $(,)?
    ) => {
        rheology!(
            viscous: [$($viscous,)* OpenViscous],
            plastic: [$($plastic,)* OpenPlastic],
            with_field: [$($keeper,)* OpenField]
        );

        /// The laws of this crate as files have them.
        #[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq)]
        #[serde(tag = "law")]
        enum BuiltIn {
            $(#[serde(rename = $viscous_name)] $viscous($viscous),)*
            $(#[serde(rename = $plastic_name)] $plastic($plastic),)*
            $(#[serde(rename = $keeper_name)] $keeper($keeper),)*
        }

        /// Their names.
        const BUILT_IN_NAMES: &[&str] = &[$($viscous_name,)* $($plastic_name,)* $($keeper_name,)*];

        impl From<BuiltIn> for Rheology {
            fn from(law: BuiltIn) -> Self {
                match law {
                    $(BuiltIn::$viscous(law) => Self::$viscous(law),)*
                    $(BuiltIn::$plastic(law) => Self::$plastic(law),)*
                    $(BuiltIn::$keeper(law) => Self::$keeper(law),)*
                }
            }
        }

        impl Rheology {
            /// Name, as its `law` key has it.
            #[must_use]
            pub fn name(&self) -> &'static str {
                match *self {
                    $(Self::$viscous(_) => $viscous_name,)*
                    $(Self::$plastic(_) => $plastic_name,)*
                    $(Self::$keeper(_) => $keeper_name,)*
                    Self::OpenViscous(law) => law.name(),
                    Self::OpenPlastic(law) => law.name(),
                    Self::OpenField(law) => law.name(),
                }
            }

            /// The law as files have it, or the one of a user's own crate.
            fn written(&self) -> Result<BuiltIn, open::Written> {
                match *self {
                    $(Self::$viscous(law) => Ok(BuiltIn::$viscous(law)),)*
                    $(Self::$plastic(law) => Ok(BuiltIn::$plastic(law)),)*
                    $(Self::$keeper(law) => Ok(BuiltIn::$keeper(law)),)*
                    Self::OpenViscous(law) => Err(law.written()),
                    Self::OpenPlastic(law) => Err(law.written()),
                    Self::OpenField(law) => Err(law.written()),
                }
            }
        }
    };
}

macro_rules! rheology {
    (viscous: [$($viscous:ident),*], plastic: [$($plastic:ident),*], with_field: [$($keeper:ident),*]) => {
        /// The constitutive law of one material, chosen by its `law` key, for example `law = "mu-i"`.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub enum Rheology {
            $(#[doc = concat!("Viscous: [`", stringify!($viscous), "`].")] $viscous($viscous),)*
            $(#[doc = concat!("Plastic: [`", stringify!($plastic), "`].")] $plastic($plastic),)*
            $(#[doc = concat!("With a field of its own: [`", stringify!($keeper), "`].")] $keeper($keeper),)*
        }

        impl Rheology {
            /// Deviatoric stress `[Pa]` after a time step `[s]`, shape `[D, D]`; of a law with a field, from its initial value.
            ///
            /// `previous` is the deviatoric stress `[Pa]` before the step (viscous laws do not look at it),
            /// `velocity_gradient` `[1/s]` has `[i][j] = ∂v_i/∂x_j`, pressure and shear modulus are in `[Pa]`.
            /// A plastic law has no stress at `pressure` ≤ 0; a viscous one has whatever its viscosity gives.
            #[inline]
            #[must_use]
            pub fn updated_stress<const D: usize>(
                &self,
                previous: &Tensor<D>,
                velocity_gradient: &Tensor<D>,
                pressure: f64,
                shear_modulus: f64,
                time_step: f64,
            ) -> Tensor<D> {
                match self {
                    $(Self::$viscous(law) => stress_update::viscous(law, velocity_gradient, pressure),)*
                    $(Self::$plastic(law) => {
                        let (previous, gradient) = (components(previous), components(velocity_gradient));
                        let stress =
                            stress_update::plastic(law, &previous, &gradient, pressure, shear_modulus, time_step);
                        Tensor::from_fn(|i, j| stress[i][j])
                    })*
                    $(Self::$keeper(law) => {
                        let field = FieldStep::alone(law.field().initial);
                        self.updated_state(previous, velocity_gradient, pressure, &field, shear_modulus, time_step).stress
                    })*
                }
            }

            /// Deviatoric stress `[Pa]` and what the law keeps after a time step, as [`Rheology::updated_stress`]; a law that
            /// keeps nothing leaves it as it was. The pressure is given: dilation does not change it.
            #[must_use]
            pub fn updated_state<const D: usize>(
                &self,
                previous: &Tensor<D>,
                velocity_gradient: &Tensor<D>,
                pressure: f64,
                field: &FieldStep<f64>,
                shear_modulus: f64,
                time_step: f64,
            ) -> StateReturn<Tensor<D>, f64> {
                let moduli = ElasticModuli { shear: shear_modulus, bulk: 0.0 };
                self.updated_state_of_volume(previous, velocity_gradient, pressure, field, moduli, time_step)
            }

            /// [`Rheology::updated_state`] at a given volume: `pressure` `[Pa]` is that of the new density with the field before the step, and
            /// what dilates raises it, to [`TrialStress::dilated_pressure`].
            #[must_use]
            pub fn updated_state_of_volume<const D: usize>(
                &self,
                previous: &Tensor<D>,
                velocity_gradient: &Tensor<D>,
                pressure: f64,
                field: &FieldStep<f64>,
                moduli: ElasticModuli,
                time_step: f64,
            ) -> StateReturn<Tensor<D>, f64> {
                match self {
                    $(Self::$keeper(law) => {
                        let (previous, gradient) = (components(previous), components(velocity_gradient));
                        let step = field_update::Step { pressure, moduli, time_step };
                        let end = field_update::with_field(law, &previous, &gradient, field, step);
                        let stress = Tensor::from_fn(|i, j| end.stress[i][j]);
                        StateReturn { stress, field: end.field, memory: end.memory }
                    })*
                    law => {
                        let stress = law.updated_stress(previous, velocity_gradient, pressure, moduli.shear, time_step);
                        StateReturn { stress, field: field.value, memory: field.memory }
                    }
                }
            }

            /// [`Rheology::updated_state_of_volume`] of eight particles, one a lane.
            #[inline(always)]
            pub(crate) fn updated_states<V: Lanes, const D: usize>(
                &self,
                previous: &[[V; D]; D],
                velocity_gradient: &[[V; D]; D],
                pressure: V,
                field: &FieldStep<V>,
                moduli: ElasticModuli,
                time_step: f64,
            ) -> StateReturn<[[V; D]; D], V> {
                match self {
                    $(Self::$viscous(law) => {
                        let mut gradients = [Tensor::<D>::zeros(); LANES];
                        store_tensor(velocity_gradient, &mut gradients);
                        let pressure = pressure.to_array();
                        let mut stresses = gradients;
                        for lane in 0..LANES {
                            stresses[lane] = stress_update::viscous(law, &gradients[lane], pressure[lane]);
                        }
                        StateReturn { stress: load_tensor(&stresses), field: field.value, memory: field.memory }
                    })*
                    $(Self::$plastic(law) => {
                        let stress =
                            stress_update::plastic(law, previous, velocity_gradient, pressure, moduli.shear, time_step);
                        StateReturn { stress, field: field.value, memory: field.memory }
                    })*
                    $(Self::$keeper(law) => {
                        let step = field_update::Step { pressure, moduli, time_step };
                        field_update::with_field(law, previous, velocity_gradient, field, step)
                    })*
                }
            }

            /// Apparent viscosity `[Pa·s]` at a shear rate `[1/s]` and a pressure `[Pa]`, finite for every law.
            #[inline]
            #[must_use]
            pub fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64 {
                match self {
                    $(Self::$viscous(law) => law.viscosity(shear_rate, pressure),)*
                    $(Self::$plastic(law) => law.viscosity(shear_rate, pressure),)*
                    $(Self::$keeper(law) => law.viscosity(shear_rate, pressure),)*
                }
            }

            /// Viscosity `[Pa·s]` that bounds an explicit time step at a pressure `[Pa]`; 0 for plastic laws,
            /// which only the acoustic bound limits.
            #[inline]
            #[must_use]
            pub fn largest_viscosity(&self, pressure: f64) -> f64 {
                match self {
                    $(Self::$viscous(law) => law.largest_viscosity(pressure),)*
                    _ => 0.0,
                }
            }

            /// Viscosity `[Pa·s]` that is left of a viscous law without pressure, and its share of the whole `[-]`, of eight particles with
            /// these velocity gradients `[1/s]` and viscosities `[Pa·s]`: all of a liquid's, none of grains' whose stress is friction, nor
            /// of a law that carries its stress along.
            #[inline(always)]
            pub(crate) fn viscosity_without_pressure<V: Lanes, const D: usize>(
                &self,
                velocity_gradient: &[[V; D]; D],
                viscosities: &[f64],
            ) -> (V, V) {
                let (mut left, mut share) = ([0.0; LANES], [0.0; LANES]);
                match self {
                    $(Self::$viscous(law) => {
                        let shear_rates = invariant(2.0, &deviatoric_rate(velocity_gradient)).to_array();
                        for (lane, &viscosity) in viscosities.iter().enumerate() {
                            if viscosity > 0.0 {
                                left[lane] = law.viscosity(shear_rates[lane], 0.0).min(viscosity);
                                share[lane] = left[lane] / viscosity;
                            }
                        }
                    })*
                    _ => {}
                }
                (V::load(&left), V::load(&share))
            }

            /// Whether the law carries the stress from step to step.
            #[inline]
            #[must_use]
            pub fn is_plastic(&self) -> bool {
                !matches!(self, $(Self::$viscous(_))|*)
            }

            /// Elastic part of a plastic material, by its distance below the yield `[-]`: 1 where the equivalent shear
            /// stress `[Pa]` is more than one per cent below the yield stress at a pressure `[Pa]`, falling to 0 at the
            /// yield; 0 for viscous laws and without pressure. A law with a field judges by that too;
            /// `elastic_viscosity` `[Pa·s]` is that of the damping which the elastic part feels.
            #[inline(always)]
            #[must_use]
            pub fn elasticity<R: Real>(
                &self,
                shear_stress: R,
                pressure: R,
                field: &FieldStep<R>,
                elastic_viscosity: f64,
            ) -> R {
                let (zero, one) = (R::splat(0.0), R::splat(1.0));
                match self {
                    $(Self::$viscous(_) => zero,)*
                    $(Self::$plastic(law) => {
                        let yield_stress = law.yield_stress(pressure);
                        let distance = R::splat(100.0) * (one - shear_stress / yield_stress);
                        distance.max(zero).min(one).where_less(zero, yield_stress)
                    })*
                    $(Self::$keeper(law) => law.elasticity(shear_stress, pressure, field, elastic_viscosity),)*
                }
            }

            /// Friction coefficient `[-]` of a contact with a rough wall; 0 for liquids.
            #[must_use]
            pub fn contact_friction(&self) -> f64 {
                match self {
                    $(Self::$viscous(law) => law.contact_friction(),)*
                    $(Self::$plastic(law) => law.contact_friction(),)*
                    $(Self::$keeper(law) => law.contact_friction(),)*
                }
            }

            /// Whether the material stands by itself, and so holds to rough walls with all of its volume; a liquid does not.
            #[must_use]
            pub fn is_solid(&self) -> bool {
                match self {
                    $(Self::$viscous(law) => law.contact_friction() > 0.0,)*
                    $(Self::$plastic(law) => law.contact_friction() > 0.0,)*
                    $(Self::$keeper(law) => law.is_solid(),)*
                }
            }

            /// Whether the law carries a stress along whose bound is proportional to the pressure.
            #[inline]
            #[must_use]
            pub fn strength_is_friction(&self) -> bool {
                match self {
                    $(Self::$viscous(_) => false,)*
                    $(Self::$plastic(_) => true,)*
                    $(Self::$keeper(law) => law.strength_is_friction(),)*
                }
            }

            /// Whether the law carries a stress along that it bears without a pressure: soil that holds together.
            #[inline]
            #[must_use]
            pub fn is_cohesive(&self) -> bool {
                self.is_plastic() && !self.strength_is_friction()
            }

            /// The field that the law keeps of each particle beside the stress, if it keeps one.
            #[must_use]
            pub fn field(&self) -> Option<LawField> {
                match self {
                    $(Self::$keeper(law) => Some(law.field()),)*
                    _ => None,
                }
            }

            /// Memory that the law keeps beside its field, in the order in which particles have it.
            #[must_use]
            pub fn memories(&self) -> &[LawField] {
                match self {
                    $(Self::$keeper(law) => law.memories(),)*
                    _ => &[],
                }
            }

            /// Liquid in the pores of the material, if its law has one.
            #[must_use]
            pub fn pore_liquid(&self) -> Option<PoreLiquid> {
                match self {
                    $(Self::$keeper(law) => law.pore_liquid(),)*
                    _ => None,
                }
            }

            /// Whether plastic flow changes the volume.
            #[inline]
            #[must_use]
            pub fn dilates(&self) -> bool {
                match self {
                    $(Self::$keeper(law) => law.dilates(),)*
                    _ => false,
                }
            }

            /// Plastic volume strain e `[-]` that goes with a value of the law's field: the logarithm of the volume without pressure over that
            /// of the reference density.
            #[inline(always)]
            #[must_use]
            pub fn plastic_volume_strain<R: Real>(&self, field: R) -> R {
                match self {
                    $(Self::$keeper(law) => law.plastic_volume_strain(field),)*
                    _ => R::splat(0.0),
                }
            }

            /// The law's field in a flow at a shear rate `[1/s]` under a ratio of shear stress and pressure `[-]`; none for a law
            /// without.
            #[must_use]
            pub fn field_in_flow(&self, shear_rate: f64, stress_ratio: f64) -> Option<f64> {
                match self {
                    $(Self::$keeper(law) => Some(law.field_in_flow(shear_rate, stress_ratio)),)*
                    _ => None,
                }
            }
        }
    };
}

impl Rheology {
    /// exp(e) `[-]`: the volume without pressure at a value of the law's field, over that of the reference density. 1 of a law that does not dilate.
    #[inline(always)]
    #[must_use]
    pub fn loosening<R: Real>(&self, field: R) -> R {
        if !self.dilates() {
            return R::splat(1.0);
        }
        R::lane_by_lane([self.plastic_volume_strain(field)], &|[strain]| libm::exp(strain))
    }

    /// The first parameter outside its range, or a pair of them that makes no law, if any.
    #[must_use]
    pub fn parameter_problem(&self) -> Option<ParameterProblem> {
        range_problem(self).or_else(|| match self {
            Self::MuI(law) => law.friction_problem(),
            Self::RegularisedMuI(law) => law.friction_problem(),
            Self::RootMuI(law) => law.friction_problem(),
            Self::NonlocalMuI(law) => law.friction_problem(),
            Self::SofteningDruckerPrager(law) => law.strength_problem(),
            Self::ViscousNumber(law) => law.density_problem(),
            Self::Newtonian(_) | Self::Bingham(_) | Self::CoulombBingham(_) | Self::HerschelBulkley(_) => None,
            // the maker of an open law has judged its parameters
            Self::OpenViscous(_) | Self::OpenPlastic(_) | Self::OpenField(_) => None,
        })
    }

    /// Shear stress `[Pa]` that material which has not yet flowed bears at a pressure `[Pa]`; none for a law that carries no stress along.
    #[must_use]
    pub fn strength_at_rest(&self, pressure: f64) -> Option<f64> {
        match self {
            Self::SofteningDruckerPrager(law) => Some(law.strength(pressure, 0.0)),
            law => law.is_plastic().then(|| law.contact_friction() * pressure),
        }
    }

    /// Density ρ_s `[kg/m³]` of the grains, where the law has such a parameter; one of a user's own crate has it as
    /// `grain_density`.
    #[must_use]
    pub fn grain_density(&self) -> Option<f64> {
        match self {
            Self::MuI(law) => Some(law.grain_density),
            Self::RegularisedMuI(law) => Some(law.grain_density),
            Self::RootMuI(law) => Some(law.grain_density),
            Self::NonlocalMuI(law) => Some(law.grain_density),
            _ => self.open_parameter("grain_density"),
        }
    }

    /// Diameter `[m]` of the grains, likewise as `grain_diameter`.
    #[must_use]
    pub fn grain_diameter(&self) -> Option<f64> {
        match self {
            Self::MuI(law) => Some(law.grain_diameter),
            Self::RegularisedMuI(law) => Some(law.grain_diameter),
            Self::RootMuI(law) => Some(law.grain_diameter),
            Self::NonlocalMuI(law) => Some(law.grain_diameter),
            Self::ViscousNumber(law) => Some(law.grain_diameter),
            _ => self.open_parameter("grain_diameter"),
        }
    }

    /// A parameter of a law of a user's own crate.
    fn open_parameter(&self, name: &str) -> Option<f64> {
        let parameters = match self {
            Self::OpenViscous(law) => law.parameters(),
            Self::OpenPlastic(law) => law.parameters(),
            Self::OpenField(law) => law.parameters(),
            _ => return None,
        };
        parameters.iter().find(|parameter| parameter.0 == name).map(|parameter| parameter.1)
    }
}

/// Friction (31) that falls with the rate is refused: μ_s ≤ μ_2.
fn rising_friction(static_friction: f64, limiting_friction: f64) -> Option<ParameterProblem> {
    // Written so that NaN is refused.
    let rises = limiting_friction >= static_friction && limiting_friction.is_finite();
    (!rises).then(|| {
        let remedy = "give the friction of fast flow, or `static_friction` itself for a law without rate dependence";
        ParameterProblem::new("limiting_friction", limiting_friction, "finite and at least `static_friction`", remedy)
    })
}

/// The components of a tensor, indexed `[row][column]`.
#[inline(always)]
fn components<const D: usize>(tensor: &Tensor<D>) -> [[f64; D]; D] {
    let mut components = [[0.0; D]; D];
    for i in 0..D {
        for j in 0..D {
            components[i][j] = tensor[(i, j)];
        }
    }
    components
}

laws! {
    viscous: [
        Newtonian = "newtonian",
        Bingham = "bingham",
        CoulombBingham = "coulomb-bingham",
        HerschelBulkley = "herschel-bulkley",
        RegularisedMuI = "regularised-mu-i",
        RootMuI = "root-mu-i",
    ],
    plastic: [MuI = "mu-i"],
    with_field: [NonlocalMuI = "nonlocal-mu-i", SofteningDruckerPrager = "softening-drucker-prager", ViscousNumber = "viscous-number"],
}
