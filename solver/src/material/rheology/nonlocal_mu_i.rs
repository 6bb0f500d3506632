//! Nonlocal granular fluidity: the μ(I) law with a length, so that thin layers stop on steeper slopes than thick ones.
//!
//! Kamrin & Henann (2015), Soft Matter 11, in the dynamic form of their fluidity g `[1/s]`, with the friction law of the
//! local limit that this crate has, (31) of the collapse paper (Henann & Kamrin 2014, J. Mech. Phys. Solids 71):
//!
//! t_0 ∂g/∂t = A² D² ∇²g + R(μ) g − c μ g², R = Δμ (μ − μ_s)/(μ_2 − μ), c = (Δμ/I_0) D √(ρ_s/p), Δμ = μ_2 − μ_s,
//!
//! with μ = τ/p and the plastic shear rate γ̇ = g μ. Uniform and steady this is I = I_0 (μ − μ_s)/(μ_2 − μ): for A = 0 the
//! local law. A layer under a uniform μ flows if it is thicker than h_stop = π A D/√R(μ) where g vanishes at bed and surface,
//! and than half of that where only the bed holds it.
//!
//! The stress relaxes by ds/dt = 2 G ε′ − (G g/p) s. Over a step both equations are taken at its end, neighbours as they were:
//! with E = G Δt/p and the trial's μ*, μ = μ*/(1 + E g), and with T = t_0 + Δt Σ D w, S = t_0 g⁰ + Δt Σ D w g_b,
//!
//! Δt c μ g² + (T − Δt R(μ)) g = S.
//!
//! Put into each other and multiplied by (1 + x)(a + μ_2 x), where x = E g and a = μ_2 − μ*, they are a cubic equation
//! in x. On x > max(0, −a/μ_2), where 0 < μ < μ_2, the left side of the first form rises in μ, so there is one root; the
//! cubic is negative below it and positive above. Newton's method within that bracket, halved where it would leave it, finds it.
//! So g ≥ 0 and μ < μ_2 for every time step, and without t_0 and A this is the local law's return mapping.

use super::field::{FieldBoundary, FieldDiffusion, FieldLaw, FieldReturn, FieldStep, LawField};
use super::grain_parameters::law_of_grains;
use super::{MuI, PlasticLaw, TrialStress, rising_friction};
use crate::lanes::Real;
use crate::parameter::{ParameterProblem, above, between};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

law_of_grains! {
    /// Dry grains whose flow reaches over a few diameters: a fluidity that diffuses.
    pub struct NonlocalMuI {
        /// Amplitude A `[-]` of the cooperation among grains; 0 is the local law.
        #[schemars(transform = between(0.0, 2.0, "give 0.48 for glass beads, or 0 for the local law"))]
        pub cooperativity: f64,
        /// Relaxation time t_0 `[s]` of the fluidity; steady flows do not know it.
        #[schemars(transform = between(1e-7, 1e-2, "give 0.0001 s, shorter than any flow; a longer time delays the start of flow"))]
        pub relaxation_time: f64,
        /// The fluidity at the free surface.
        pub surface: FieldBoundary,
        /// Inertial number `[-]` of the fluidity that grains beyond μ_s have at least, without which nothing at rest would start.
        #[schemars(transform = between(0.0, 1e-3, "give 0.000001 so that material starts to flow when it yields; with 0 it stays at rest"))]
        pub seed: f64,
    }
}

/// Times the elastic damping's viscosity over p/g at which that damping ends `[-]`: it then never carries more than
/// 1/(4 · 100) of the stress.
const DAMPING_LIMIT: f64 = 100.0;
/// Vorticity over the plastic shear rate up to which the stress is not turned `[-]`. Among particles that mix it is not 1 as in
/// steady shear. A stress that relaxes over a strain of τ/G then misses a turn of 5 τ/G at most.
const UNTURNED: f64 = 10.0;
/// Least pressure that is divided by `[Pa]`.
const LEAST_PRESSURE: f64 = 1e-12;
/// Relative change of x at which the root is found `[-]`.
const TOLERANCE: f64 = 1e-12;
/// Iterations after which a root is taken as it is: more than halving the bracket takes from 1 to rounding.
const MOST_ITERATIONS: usize = 100;

impl NonlocalMuI {
    /// The nonlocal law of some grains with the published amplitude, where the fluidity vanishes at the surface.
    #[must_use]
    pub fn of(grains: MuI) -> Self {
        Self {
            static_friction: grains.static_friction,
            limiting_friction: grains.limiting_friction,
            reference_inertia: grains.reference_inertia,
            grain_diameter: grains.grain_diameter,
            grain_density: grains.grain_density,
            cooperativity: 0.48,
            relaxation_time: 1e-4,
            surface: FieldBoundary::Vanishing,
            seed: 1e-6,
        }
    }

    /// Limit without cooperation.
    #[must_use]
    pub fn local(&self) -> MuI {
        MuI {
            static_friction: self.static_friction,
            limiting_friction: self.limiting_friction,
            reference_inertia: self.reference_inertia,
            grain_diameter: self.grain_diameter,
            grain_density: self.grain_density,
        }
    }

    fn friction_range(&self) -> f64 {
        self.limiting_friction - self.static_friction
    }
}

/// The cubic equation of x = E g and the bracket of its root.
struct Cubic<R> {
    coefficients: [R; 4],
    low: R,
    high: R,
}

impl<R: Real> Cubic<R> {
    /// The root, from a first guess.
    #[inline(always)]
    fn root(&self, guess: R) -> R {
        let [constant, linear, square, cube] = self.coefficients;
        let (zero, half) = (R::splat(0.0), R::splat(0.5));
        let (mut low, mut high) = (self.low, self.high);
        let mut root = guess.max(low).min(high);
        for _ in 0..MOST_ITERATIONS {
            let value = ((cube * root + square) * root + linear) * root + constant;
            let slope = (R::splat(3.0) * cube * root + R::splat(2.0) * square) * root + linear;
            low = root.if_less(value, zero, low);
            high = high.if_less(value, zero, root);
            let newton = root - value / slope;
            let middle = half * (low + high);
            let next = newton.if_less(low, newton, middle);
            let next = next.if_less(newton, high, middle);
            let change = (next - root).max(root - next);
            let allowed = R::splat(TOLERANCE) * next;
            // a lane that has its root keeps it, whatever the others still do
            root = next.if_less(allowed, change, root);
            if !allowed.any_less(change) {
                break;
            }
        }
        root
    }
}

impl FieldLaw for NonlocalMuI {
    fn field(&self) -> LawField {
        let strength = (self.cooperativity * self.grain_diameter).powi(2);
        LawField {
            name: "fluidity",
            unit: "1/s",
            description: "granular fluidity: shear rate over stress ratio",
            initial: 0.0,
            bounds: (0.0, f64::MAX),
            diffusion: (strength > 0.0).then_some(FieldDiffusion {
                strength,
                wall: FieldBoundary::Vanishing,
                surface: self.surface,
            }),
        }
    }

    #[inline(always)]
    fn end_of_step<R: Real>(&self, trial: &TrialStress<R>, field: &FieldStep<R>) -> FieldReturn<R> {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        let pressure = trial.pressure.max(R::splat(LEAST_PRESSURE));
        let (static_friction, limiting_friction) = (R::splat(self.static_friction), R::splat(self.limiting_friction));
        if trial.time_step <= 0.0 {
            let shear_stress = trial.shear_stress.min(limiting_friction * pressure);
            return FieldReturn { shear_stress: shear_stress.where_less(zero, trial.pressure), field: field.value };
        }
        let step = R::splat(trial.time_step);
        let elastic = R::splat(trial.shear_modulus * trial.time_step) / pressure; // E
        let friction = trial.shear_stress / pressure; // μ*
        let rate = (pressure / R::splat(self.grain_density)).sqrt() / R::splat(self.grain_diameter);
        let seed = (R::splat(self.seed) * rate).where_less(static_friction, friction);
        let relaxation = R::splat(self.relaxation_time);
        let retained = relaxation + step * field.loss; // T
        let source = elastic * (relaxation * field.value.max(seed) + step * field.gain); // E S
        // Δt c μ* /E
        let quadratic =
            R::splat(trial.time_step * self.friction_range() / self.reference_inertia) * friction / (rate * elastic);
        let growth = R::splat(trial.time_step * self.friction_range());
        let margin = limiting_friction - friction; // a
        let square = retained * limiting_friction + growth * static_friction;
        let linear = retained * margin - source * limiting_friction - growth * (friction - static_friction);
        let constant = -(source * margin);
        let coefficients =
            [constant, linear + constant, square + linear + quadratic * margin, square + quadratic * limiting_friction];
        let low = (-(margin / limiting_friction)).max(zero);
        // from 1 on the cube outweighs all that is negative if its part does
        let negative = (-coefficients[0]).max(zero) + (-coefficients[1]).max(zero) + (-coefficients[2]).max(zero);
        let high = (negative / coefficients[3]).max(one).max(low + low);
        let root = Cubic { coefficients, low, high }.root(elastic * field.value);
        let shear_stress = trial.shear_stress / (one + root);
        let fluidity = root / elastic;
        FieldReturn {
            shear_stress: shear_stress.where_less(zero, trial.pressure),
            field: fluidity.where_less(zero, trial.pressure),
        }
    }

    #[inline(always)]
    fn elasticity<R: Real>(&self, _shear_stress: R, pressure: R, field: &FieldStep<R>, elastic_viscosity: f64) -> R {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        let flowing =
            R::splat(DAMPING_LIMIT * elastic_viscosity) * field.value / pressure.max(R::splat(LEAST_PRESSURE));
        (one - flowing).max(zero).where_less(zero, pressure)
    }

    /// 1 − 10 γ̇/|2ω| where it is positive: what creeps is not turned. In steady shear the Jaumann rate gives s_yy = −τ μ p/G however
    /// slow it is, which stops layers on slopes that are flatter by a tenth of a degree.
    #[inline(always)]
    fn turned_part<R: Real>(
        &self,
        trial: &TrialStress<R>,
        _before: &FieldStep<R>,
        end: &FieldReturn<R>,
        vorticity: R,
    ) -> R {
        let (zero, one) = (R::splat(0.0), R::splat(1.0));
        let rate = end.field * end.shear_stress / trial.pressure.max(R::splat(LEAST_PRESSURE));
        (one - R::splat(UNTURNED) * rate / vorticity.max(R::splat(f64::MIN_POSITIVE))).max(zero)
    }

    fn contact_friction(&self) -> f64 {
        self.static_friction
    }

    #[inline]
    fn viscosity(&self, shear_rate: f64, pressure: f64) -> f64 {
        self.local().viscosity(shear_rate, pressure)
    }

    fn field_in_flow(&self, shear_rate: f64, stress_ratio: f64) -> f64 {
        if stress_ratio > 0.0 { shear_rate.abs() / stress_ratio } else { 0.0 }
    }
}
