//! Errors planted on purpose, to find out which test of the program notices: `bagnold mutate`.
//!
//! Only a build with the feature `planted-errors` knows them. Such a program plants at most one, once, before its first
//! simulation; without the feature [`planted`] is `false` and [`factor`] is 1 at compile time, so that no instruction
//! and no bit of a result differs from a program without this file. What an error is stands in the one table below;
//! where it is planted, a line names it.

use crate::vector::Vector;

/// Declares the errors: name in the source, factor where the error is one, name on the command line, what is wrong.
macro_rules! errors {
    ($($error:ident $(* ($factor:expr))? $name:literal $says:literal)+) => {
        /// An error that can be planted.
        #[cfg_attr(not(feature = "planted-errors"), expect(unreachable_pub, reason = "public with the feature only"))]
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        #[repr(u8)]
        pub enum Planted {
            $(#[doc = $says] $error,)+
        }

        #[cfg(feature = "planted-errors")]
        impl Planted {
            /// All errors.
            pub const ALL: &[Self] = &[$(Self::$error,)+];

            /// Its name on the command line and in results.
            #[must_use]
            pub const fn name(self) -> &'static str {
                match self { $(Self::$error => $name,)+ }
            }

            /// What is wrong, half a sentence.
            #[must_use]
            pub const fn says(self) -> &'static str {
                match self { $(Self::$error => $says,)+ }
            }

            /// What a right value is multiplied by `[-]`; 1 where the error is no factor.
            const fn factor(self) -> f64 {
                match self { $(Self::$error => [$($factor,)? 1.0][0],)+ }
            }
        }
    };
}

errors! {
    // kernel, neighbours, boundaries
    KernelNormalisation * (1.02) "kernel-normalisation" "both kernels are normalised to 1.02"
    KernelGradient * (0.95) "kernel-gradient" "the kernels' gradient is 5 % too small for their values"
    NeighbourRadius "neighbour-radius" "the neighbour lists reach as far as the kernel, without their skin"
    PeriodicShift * (1.01) "periodic-shift" "periodic images stand 1 % of the period too far away"
    PeriodicWrap * (0.99) "periodic-wrap" "separations across a period are 1 % of it too long"
    MirrorTensorSign "mirror-tensor-sign" "tensors behind a mirror keep the sign of their shear"
    MirrorVectorSign "mirror-vector-sign" "vectors behind a mirror keep the sign of their normal component"
    // gravity
    GravityValue * (0.998_980_632_008_155) "gravity-value" "g = 9.80 m/s² instead of 9.81"
    GravityAlongBed * (1.02) "gravity-along-bed" "the component of gravity along the first axis is 2 % too large"
    // laws: equation of state, grains, viscous laws
    PressureHalved * (0.5) "pressure-halved" "the equation of state gives half of the pressure"
    SoundSpeed * (0.5) "sound-speed" "the sound speed is half of that of the bulk modulus"
    FrictionSwapped "friction-swapped" "μ_s and μ_2 of the μ(I) law are exchanged"
    InertialDensity * (0.6) "inertial-density" "the inertial number takes the bulk's density instead of the grains'"
    InertialRoot "inertial-root" "the inertial number takes p/ρ_s instead of its root"
    ReferenceInertia * (1.1) "reference-inertia" "I_0 of the μ(I) law is 10 % too large"
    ViscousReferenceRate * (2.0) "viscous-reference-rate" "the rate at which I = I_0 is doubled in the viscous forms of μ(I)"
    RootFriction * (0.9) "root-friction" "the friction of the μ(I) law of bed load is 10 % too small"
    YieldNorm * (std::f64::consts::SQRT_2) "yield-norm" "Bingham's yield stress is √2 too large: of √(S:S) instead of |γ̇|"
    ShearRateNorm * (std::f64::consts::FRAC_1_SQRT_2) "shear-rate-norm" "viscous laws take √(ε:ε) as the shear rate"
    FlowIndex * (1.1) "flow-index" "Herschel and Bulkley's exponent is 10 % too large"
    TrialModulus * (0.5) "trial-modulus" "the elastic trial adds G ε instead of 2 G ε"
    SpinSign * (-1.0) "spin-sign" "the stress below the yield turns against the spin"
    // laws: turbulence, suspensions, drag
    VonKarman * (1.097_560_975_609_756) "von-karman" "κ = 0.45 instead of 0.41"
    RoughnessLength * (0.909_090_909_090_909_1) "roughness-length" "z_0 = k_s/33 instead of k_s/30"
    Smagorinsky * (2.0) "smagorinsky" "Smagorinsky's C_s is doubled"
    MixingLengthRoot "mixing-length-root" "the mixing length lacks √(1 − z/h)"
    RoomAmongGrains "room-among-grains" "eddies find the room 1 − φ instead of 1 − φ/φ_max"
    IntrinsicViscosity * (0.6) "intrinsic-viscosity" "Einstein's 5/2 of the suspension viscosity is 3/2"
    Dilation * (0.5) "dilation" "grains dilate by half of B I"
    SchillerNaumannExponent * (0.95) "schiller-naumann-exponent" "Schiller and Naumann's exponent is 0.653 instead of 0.687"
    WenYuExponent * (0.95) "wen-yu-exponent" "Wen and Yu's exponent is −2.52 instead of −2.65"
    DiFeliceExponent * (0.95) "di-felice-exponent" "Di Felice's exponent is 5 % too small"
    MorsiAlexanderExponent "morsi-alexander-exponent" "Morsi and Alexander's K2/R² is K2/R^1.95"
    ErgunInertia * (0.857_142_857_142_857_1) "ergun-inertia" "Ergun's 1.75 is 1.5"
    // weakly compressible model
    ArtificialViscositySign "artificial-viscosity-sign" "the artificial viscosity brakes pairs that part instead of those that meet"
    HourglassSign * (-1.0) "hourglass-sign" "the hourglass control drives what it should damp"
    HourglassDirection "hourglass-direction" "the hourglass control acts across a pair instead of along it"
    DensityCouplingSign * (-1.0) "density-coupling-sign" "the density–pressure coupling has the opposite sign"
    StressDiffusionSign * (-1.0) "stress-diffusion-sign" "the stress ratio is concentrated instead of diffused"
    WallPressure * (0.0) "wall-pressure" "a wall has the pressure of the flow, not continued to its depth"
    WallStress * (0.0) "wall-stress" "a wall carries no shear stress"
    WallVelocity * (0.0) "wall-velocity" "the particles of a wall stand still instead of moving against the flow"
    WallContinuity * (0.0) "wall-continuity" "walls do not compress what runs into them"
    ForceCorrection "force-correction" "the forces lack their kernel correction"
    GradientCorrection "gradient-correction" "the kernel correction's off-diagonal terms have the opposite sign"
    ElasticDamping * (0.0) "elastic-damping" "elastic shear below the yield is not damped"
    OldVelocityMoves "old-velocity-moves" "particles move with the velocity before the step"
    ViscousResponse * (0.5) "viscous-response" "the implicit viscous step takes half of K"
    ContactFriction * (0.0) "contact-friction" "contacts with walls have no friction"
    // incompressible model
    PoissonSource * (0.5) "poisson-source" "the pressure Poisson equation has half of its divergence on the right"
    Stabilisation * (0.5) "stabilisation" "the stabilisation of the pressure Poisson equation is halved"
    DensityCorrection * (0.0) "density-correction" "the pressure does not correct the density"
    PressureMoments "pressure-moments" "pair weights of the pressure are not divided by the moments"
    SurfacePressure * (0.5) "surface-pressure" "half of what is missing at the surface counts as mirrored"
    ShiftingSign * (-1.0) "shifting-sign" "particles are shifted to where they are dense"
    BedMirror "bed-mirror" "the bed's particles stand still instead of moving against the water"
    DragReaction * (0.0) "drag-reaction" "the water does not feel the grains that it drags"
    Overburden * (1.625) "overburden" "the load on the grains lacks their buoyancy"
    PairRate * (std::f64::consts::FRAC_PI_4) "pair-rate" "the rate of a sediment pair lacks its 4/π"
    GrainFilling * (0.95) "grain-filling" "grains start with 5 % too little mass"
    WaterShare "water-share" "water between grains has the inertia of clear water"
}

#[cfg(feature = "planted-errors")]
mod chosen {
    use super::Planted;
    use std::sync::atomic::{AtomicU8, Ordering};

    /// The number of the planted error; none has the last.
    static PLANTED: AtomicU8 = AtomicU8::new(u8::MAX);

    /// Plants an error in this program, for good.
    pub fn plant(error: Planted) {
        PLANTED.store(error as u8, Ordering::Relaxed);
    }

    /// Whether an error is planted.
    #[inline(always)]
    pub(crate) fn planted(error: Planted) -> bool {
        PLANTED.load(Ordering::Relaxed) == error as u8
    }

    /// What the right value is multiplied by `[-]`: 1 unless the error is planted.
    #[inline(always)]
    pub(crate) fn factor(error: Planted) -> f64 {
        if planted(error) { error.factor() } else { 1.0 }
    }
}

#[cfg(not(feature = "planted-errors"))]
mod chosen {
    use super::Planted;

    /// Whether an error is planted: never.
    #[inline(always)]
    pub(crate) const fn planted(_: Planted) -> bool {
        false
    }

    /// What the right value is multiplied by `[-]`: 1.
    #[inline(always)]
    pub(crate) const fn factor(_: Planted) -> f64 {
        1.0
    }
}

#[cfg(feature = "planted-errors")]
pub use chosen::plant;
pub(crate) use chosen::{factor, planted};

/// Gravity `[m/s²]` as a model takes it.
pub(crate) fn gravity<const D: usize>(right: Vector<D>) -> Vector<D> {
    let mut gravity = right * factor(Planted::GravityValue);
    gravity[0] *= factor(Planted::GravityAlongBed);
    gravity
}
