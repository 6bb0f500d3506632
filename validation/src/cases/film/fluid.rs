//! One fluid of the film, as the solver takes it and as the exact solution does.

use crate::reference::{BinghamFilm, HerschelBulkleyFilm, Incline, NewtonianFilm};
use bagnold_solver::material::rheology::{Bingham, HerschelBulkley, Newtonian, Rheology};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which fluid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FluidKind {
    /// Newtonian.
    Newtonian,
    /// Bingham.
    Bingham,
    /// Herschel–Bulkley.
    HerschelBulkley,
}

/// A fluid with its parameters.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub enum Fluid {
    /// Newtonian.
    Newtonian(Newtonian),
    /// Bingham.
    Bingham(Bingham),
    /// Herschel–Bulkley.
    HerschelBulkley(HerschelBulkley),
}

impl Fluid {
    /// Its kind.
    #[must_use]
    pub fn kind(&self) -> FluidKind {
        match self {
            Self::Newtonian(_) => FluidKind::Newtonian,
            Self::Bingham(_) => FluidKind::Bingham,
            Self::HerschelBulkley(_) => FluidKind::HerschelBulkley,
        }
    }

    /// Its constitutive law.
    #[must_use]
    pub fn rheology(&self) -> Rheology {
        match *self {
            Self::Newtonian(law) => Rheology::Newtonian(law),
            Self::Bingham(law) => Rheology::Bingham(law),
            Self::HerschelBulkley(law) => Rheology::HerschelBulkley(law),
        }
    }

    /// Exact velocity `[m/s]` at a height `[m]`.
    #[must_use]
    pub fn velocity(&self, incline: Incline, height: f64) -> f64 {
        match self {
            Self::Newtonian(law) => NewtonianFilm { incline, viscosity: law.viscosity }.velocity(height),
            Self::Bingham(law) => bingham(incline, law).velocity(height),
            Self::HerschelBulkley(law) => herschel_bulkley(incline, law).velocity(height),
        }
    }

    /// Exact flux `[m²/s]`.
    #[must_use]
    pub fn flux(&self, incline: Incline) -> f64 {
        match self {
            Self::Newtonian(law) => NewtonianFilm { incline, viscosity: law.viscosity }.flux(),
            Self::Bingham(law) => bingham(incline, law).flux(),
            Self::HerschelBulkley(law) => herschel_bulkley(incline, law).flux(),
        }
    }

    /// Exact height of the plug's edge `[m]`; none for the Newtonian film.
    #[must_use]
    pub fn plug_edge(&self, incline: Incline) -> Option<f64> {
        match self {
            Self::Newtonian(_) => None,
            Self::Bingham(law) => Some(bingham(incline, law).plug_edge()),
            Self::HerschelBulkley(law) => Some(herschel_bulkley(incline, law).plug_edge()),
        }
    }

    /// Exponent n in τ − τ_y ∝ |du/dy|ⁿ `[-]`.
    #[must_use]
    pub fn flow_index(&self) -> f64 {
        match self {
            Self::HerschelBulkley(law) => law.flow_index,
            _ => 1.0,
        }
    }

    /// Viscosity `[Pa·s]` that sets the time over which the sheared part relaxes, ρ h²/η.
    #[must_use]
    pub fn relaxing_viscosity(&self, incline: Incline) -> f64 {
        match self {
            Self::Newtonian(law) => law.viscosity,
            Self::Bingham(law) => law.plastic_viscosity,
            Self::HerschelBulkley(law) => {
                let film = herschel_bulkley(incline, law);
                law.consistency * libm::pow(film.plug_velocity() / film.plug_edge(), law.flow_index - 1.0)
            }
        }
    }
}

fn bingham(incline: Incline, law: &Bingham) -> BinghamFilm {
    BinghamFilm { incline, yield_stress: law.yield_stress, plastic_viscosity: law.plastic_viscosity }
}

fn herschel_bulkley(incline: Incline, law: &HerschelBulkley) -> HerschelBulkleyFilm {
    let HerschelBulkley { yield_stress, consistency, flow_index, .. } = *law;
    HerschelBulkleyFilm { incline, yield_stress, consistency, flow_index }
}
