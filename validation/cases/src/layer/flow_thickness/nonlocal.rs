//! The same layers under the nonlocal law: how it is chosen, and what is exact of it.

use crate::reference::one_dimension::{BagnoldProfile, NonlocalLayer};
use crate::shared::Arrangement;
use bagnold_solver::material::rheology::field::FieldBoundary;
use bagnold_solver::material::rheology::{MuI, NonlocalMuI, Rheology};
use bagnold_solver::parameter::{between, each, entry, positive, unique};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Layers under the nonlocal law beside those of the local one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NonlocalLayers {
    /// How the grains cooperate.
    pub cooperation: NonlocalParameters,
    /// What the fluidity is at the free surface, one search each for every thickness; empty for the local law alone.
    pub surfaces: Vec<FieldBoundary>,
    /// Rows of particles over a layer.
    #[schemars(transform = crate::setup::rules::rows())]
    pub rows: usize,
    /// Searches: (thickness `[m]`, slope at which it stops `[°]`, slope at which it flows `[°]`) where the fluidity vanishes at the
    /// surface.
    #[schemars(transform = each(entry(0, positive("give it in metres, such as 0.01"))))]
    pub vanishing_searches: Vec<(f64, f64, f64)>,
    /// Searches: (thickness `[m]`, slope at which it stops `[°]`, slope at which it flows `[°]`) where no fluidity crosses the surface.
    #[schemars(transform = each(entry(0, positive("give it in metres, such as 0.01"))))]
    pub no_flux_searches: Vec<(f64, f64, f64)>,
    /// Width of the bracket of slopes that ends a search `[°]`.
    #[schemars(transform = between(1e-3, 90.0, "0.3° is what the model's own angle is judged by"))]
    pub stopping_tolerance: f64,
    /// Steady flows whose profile is judged where the fluidity vanishes at the surface: thicknesses over h_stop `[-]`.
    #[schemars(transform = each(between(1.01, 100.0, "a layer flows above its h_stop; 1.5 and 3 show a profile")))]
    pub profiles: Vec<f64>,
    /// Starts of these flows: rows on the lattice, or displaced by `jitter` and settled.
    #[schemars(transform = unique("name every start once"))]
    pub profile_arrangements: Vec<Arrangement>,
    /// Rows of particles over these flows.
    #[schemars(transform = crate::setup::rules::rows())]
    pub profile_rows: usize,
    /// Slope of these flows `[°]`.
    #[schemars(transform = crate::setup::rules::slope_angle())]
    pub profile_angle: f64,
    /// Simulated time of these flows `[s]`.
    #[schemars(transform = between(0.01, 1000.0, "0.5 s shows a steady flow"))]
    pub profile_duration: f64,
}

/// What the nonlocal law has beside μ(I), but for the surface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct NonlocalParameters {
    /// Amplitude A `[-]`.
    #[schemars(transform = between(1e-3, 2.0, "0.48 for glass beads; without it these are the layers of the local law"))]
    pub cooperativity: f64,
    /// Relaxation time t_0 `[s]`.
    #[schemars(transform = between(1e-7, 1e-2, "0.0001 decides fast whether a layer stops"))]
    pub relaxation_time: f64,
    /// Inertial number of the least fluidity beyond μ_s `[-]`.
    #[schemars(transform = between(0.0, 1e-3, "0.000001"))]
    pub seed: f64,
}

/// The nonlocal law of a layer.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct NonlocalChoice {
    pub(super) cooperation: NonlocalParameters,
    pub(super) surface: FieldBoundary,
}

impl NonlocalChoice {
    /// The law of some grains.
    pub(super) fn law(&self, grains: MuI) -> Rheology {
        let NonlocalParameters { cooperativity, relaxation_time, seed } = self.cooperation;
        let surface = self.surface;
        Rheology::NonlocalMuI(NonlocalMuI { cooperativity, relaxation_time, seed, surface, ..NonlocalMuI::of(grains) })
    }

    /// The model's own layer, of the size and slope of one of the local law.
    pub(super) fn exact(&self, local: BagnoldProfile) -> NonlocalLayer {
        NonlocalLayer { layer: local, cooperativity: self.cooperation.cooperativity, surface: self.surface }
    }

    /// The surface as a variant has it.
    pub(super) fn surface_name(&self) -> &'static str {
        match self.surface {
            FieldBoundary::Vanishing => "vanishing",
            FieldBoundary::NoFlux => "no-flux",
        }
    }
}
