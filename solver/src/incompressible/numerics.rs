//! The numerical choices of an incompressible run; the default is the recipe, [`ProjectionNumerics::paper`] the
//! bed-load paper's own set.

use crate::parameter::between;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Iterations after which a solve is given up: a bound on the machine's time, which no result depends on.
pub(crate) const MOST_ITERATIONS: usize = 2000;

/// Quantity that the pressure Poisson equation drives to zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PressureSource {
    /// Divergence of the predicted velocity, with a weak correction of the density.
    Divergence,
    /// Deviation of the predicted density (5) from the reference, equation (11).
    Density,
}

/// Condition at the free surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum SurfaceTreatment {
    /// Particles at the surface are unknowns; what is missing of their neighbours has P = 0.
    Completed,
    /// Particles at the surface have P = 0, (31).
    Eliminated,
}

/// Viscosity of a pair of sediment particles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum PairLaw {
    /// From the pair's own shear rate |u_ab|/r and the smaller load of the two: what lies on a weaker particle slides.
    PairRate,
    /// From the pair's own shear rate, as rows that slide over each other have it, and the mean load of the two: that of the
    /// plane between them.
    PairRateMeanLoad,
    /// Arithmetic mean of the particles' viscosities, as (18) has it.
    ArithmeticMean,
    /// Harmonic mean of the particles' viscosities.
    HarmonicMean,
}

/// Slip between the phases in the drag of a pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum DragSlip {
    /// The velocity difference of the pair, as in (30).
    Pair,
    /// The grain's velocity against the mean of the fluid around it.
    Mean,
}

/// Flux that the pore pressure makes free of divergence.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Continuity {
    /// That of the fluid alone, ∇·u_f = 0.
    Fluid,
    /// That of both phases, ∇·(φ u_s + (1 − φ) u_f) = 0; the pressure pushes the grains as well.
    Mixture,
}

/// Treatment of the mixture's mean flux along periods, which no pressure of the particles reaches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum MeanFlux {
    /// Nothing: it follows from the forces.
    Free,
    /// A uniform pressure gradient takes it out, as the floor of a vessel does.
    Zero,
}

/// Remedy for numerics out of range.
const DEFAULTS: &str = "see the default numerics with `bagnold show`";

/// Numerical parameters of the projection step.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ProjectionNumerics {
    /// Smoothing length over particle spacing h/l_0 `[-]`, cubic spline.
    #[schemars(transform = between(1.0, 2.0, DEFAULTS))]
    pub smoothing_ratio: f64,
    /// Largest time step `[s]`.
    #[schemars(transform = between(1e-9, 1.0, DEFAULTS))]
    pub time_step: f64,
    /// Most of a spacing that the fastest particle may go in a step, a Courant number `[-]`.
    #[schemars(transform = between(1e-3, 0.5, DEFAULTS))]
    pub courant: f64,
    /// Share s of D G that is added to the compact Laplacian A of (12) `[-]`; 0 is the paper's operator.
    #[schemars(transform = between(0.0, 10.0, DEFAULTS))]
    pub stabilisation: f64,
    /// Share of the mean anisotropy of neighbours that gradients of pairs are rid of `[-]`: 1 for deep streams, where the pressure of
    /// the paper's operator, 0, carries shear among particles that the flow has lined up; 0 brings water at rest.
    #[schemars(transform = between(0.0, 1.0, DEFAULTS))]
    pub even_pairs: f64,
    /// Right-hand side of the pressure Poisson equation.
    pub pressure_source: PressureSource,
    /// Share γ of the density error that a step corrects beside the divergence `[-]`.
    #[schemars(transform = between(0.0, 1.0, DEFAULTS))]
    pub density_correction: f64,
    /// Σ V W of relaxed particles at their reference density over that of the lattice `[-]`.
    #[schemars(transform = between(0.9, 1.1, DEFAULTS))]
    pub reference_concentration: f64,
    /// β of the surface criterion (31) `[-]`.
    #[schemars(transform = between(0.5, 0.99, DEFAULTS))]
    pub surface_threshold: f64,
    /// Treatment of the surface.
    pub surface: SurfaceTreatment,
    /// Coefficient of particle shifting in the fluid `[-]`; 0 switches it off.
    #[schemars(transform = between(0.0, 10.0, DEFAULTS))]
    pub shifting: f64,
    /// Sediment pairs.
    pub pair_law: PairLaw,
    /// Slip of the drag.
    pub drag_slip: DragSlip,
    /// Flux that is free of divergence.
    pub continuity: Continuity,
    /// The mixture's mean flux.
    pub mean_flux: MeanFlux,
    /// Mean deficit of neighbours around a particle whose inverse makes it one beside the surface `[-]`.
    #[schemars(transform = between(1.0, 1e3, DEFAULTS))]
    pub surface_gain: f64,
    /// Most that a particle is shifted in a step, in spacings `[-]`.
    #[schemars(transform = between(0.0, 1.0, DEFAULTS))]
    pub largest_shift: f64,
    /// Norm of the correction of a velocity gradient beyond which the neighbours of a particle do not tell it `[-]`.
    #[schemars(transform = between(2.0, 1e6, DEFAULTS))]
    pub largest_correction: f64,
    /// Least height of a particle above a wall that it sticks to, in spacings `[-]`.
    #[schemars(transform = between(1e-3, 0.5, DEFAULTS))]
    pub least_wall_height: f64,
    /// Largest velocity of a mirrored wall particle over its partner's `[-]`.
    #[schemars(transform = between(1.0, 1e3, DEFAULTS))]
    pub largest_mirror: f64,
    /// Time T of the mean velocity gradient that a mixing length takes `[s]`: a quarter of h/u_*, in which large eddies turn over,
    /// outlasts the random motion of particles that pass each other; 0 takes every particle's own gradient.
    #[schemars(transform = between(0.0, 1e3, DEFAULTS))]
    pub mean_flow_time: f64,
    /// Rate 1/T_q at which the fluid's velocity across the bed relaxes to its mean between grains `[1/s]`; 0 switches it
    /// off.
    #[schemars(transform = between(0.0, 1e6, DEFAULTS))]
    pub fluctuation_rate: f64,
    /// Solid fraction φ_q from which on it does so at the full rate `[-]`.
    #[schemars(transform = between(1e-6, 1.0, DEFAULTS))]
    pub fluctuation_fraction: f64,
    /// Σ V W of the fluid around a sediment particle below which its drag is not shared out in full `[-]`: where a
    /// particle leaves the water, the force must fall with the water that there is.
    #[schemars(transform = between(1e-3, 1.0, DEFAULTS))]
    pub least_fluid: f64,
    /// Skin of the candidate search over the reach of the fluid's kernel `[-]`.
    #[schemars(transform = between(0.01, 1.0, DEFAULTS))]
    pub search_skin: f64,
    /// Relative residual of the pressure Poisson equation `[-]`.
    #[schemars(transform = between(1e-12, 0.5, DEFAULTS))]
    pub pressure_tolerance: f64,
    /// Relative residual of the implicit velocities `[-]`.
    #[schemars(transform = between(1e-14, 0.1, DEFAULTS))]
    pub velocity_tolerance: f64,
}

/// Numerical parameters of the columns of grains that dilate.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ColumnNumerics {
    /// Distance of two nodes over the spacing of the sediment `[-]`.
    #[schemars(transform = between(0.1, 1.0, DEFAULTS))]
    pub node_ratio: f64,
    /// Least width of a column in grain diameters `[-]`: a fraction is one of several grains.
    #[schemars(transform = between(0.5, 1e3, DEFAULTS))]
    pub width_ratio: f64,
    /// Height over which a node reaches the fluid's particles to either side, in their spacings `[-]`.
    #[schemars(transform = between(0.6, 4.0, DEFAULTS))]
    pub drag_reach: f64,
    /// Time T in which φ tends to that of the dilatancy `[s]`.
    #[schemars(transform = between(1e-4, 10.0, DEFAULTS))]
    pub dilation_time: f64,
    /// Time in which the velocity of a particle tends to that of its nodes `[s]`.
    #[schemars(transform = between(1e-9, 1e9, DEFAULTS))]
    pub relaxation_time: f64,
    /// Share of the way from the tangent to the secant in the first iteration of the friction `[-]`.
    #[schemars(transform = between(1e-3, 1.0, DEFAULTS))]
    pub secant_share: f64,
    /// Change of a velocity at which the friction is solved `[m/s]`.
    #[schemars(transform = between(1e-14, 1e-4, DEFAULTS))]
    pub friction_tolerance: f64,
}

impl Default for ColumnNumerics {
    fn default() -> Self {
        Self {
            node_ratio: 0.5,
            width_ratio: 2.0,
            drag_reach: 1.0,
            dilation_time: 0.02,
            relaxation_time: 0.05,
            secant_share: 0.1,
            friction_tolerance: 1e-8,
        }
    }
}

impl Default for ProjectionNumerics {
    fn default() -> Self {
        Self {
            smoothing_ratio: 1.2,
            time_step: 2.5e-4,
            courant: 0.3,
            stabilisation: 0.5,
            even_pairs: 0.0,
            pressure_source: PressureSource::Divergence,
            density_correction: 0.01,
            reference_concentration: 0.997,
            surface_threshold: 0.95,
            surface: SurfaceTreatment::Completed,
            shifting: 0.5,
            pair_law: PairLaw::PairRate,
            drag_slip: DragSlip::Mean,
            continuity: Continuity::Fluid,
            mean_flux: MeanFlux::Free,
            surface_gain: 8.0,
            largest_shift: 0.05,
            largest_correction: 30.0,
            least_wall_height: 0.1,
            largest_mirror: 6.0,
            mean_flow_time: 0.1,
            fluctuation_rate: 0.0,
            fluctuation_fraction: 0.1,
            least_fluid: 0.3,
            search_skin: 0.3,
            pressure_tolerance: 1e-2,
            velocity_tolerance: 1e-6,
        }
    }
}

impl ProjectionNumerics {
    /// The paper's own set: operators (12) and (13) alone, the density source (11), no shifting.
    #[must_use]
    pub fn paper() -> Self {
        Self {
            stabilisation: 0.0,
            pressure_source: PressureSource::Density,
            density_correction: 1.0,
            shifting: 0.0,
            surface: SurfaceTreatment::Eliminated,
            pair_law: PairLaw::ArithmeticMean,
            drag_slip: DragSlip::Pair,
            courant: 0.1,
            mean_flow_time: 0.0,
            ..Self::default()
        }
    }
}
