//! The steady film of any law on an incline: in closed form where there is one, or integrated over the depth.

use crate::film::{BinghamFilm, EddyFilm, HerschelBulkleyFilm, Incline, LawFilm, NewtonianFilm};
use bagnold_solver::material::rheology::{Newtonian, Rheology};

/// The steady film of a law on an incline.
#[derive(Debug, Clone, Copy)]
pub enum SteadyFilm {
    /// Of a Newtonian liquid.
    Newtonian(NewtonianFilm),
    /// Of a Newtonian liquid with eddies.
    Eddies(EddyFilm),
    /// Of a Bingham fluid.
    Bingham(BinghamFilm),
    /// Of a Herschel–Bulkley fluid.
    HerschelBulkley(HerschelBulkleyFilm),
    /// Of any other law.
    Integrated(LawFilm),
}

impl SteadyFilm {
    /// The film of a law.
    pub fn of(law: Rheology, incline: Incline) -> Self {
        match law {
            Rheology::Newtonian(law) => Self::Newtonian(NewtonianFilm { incline, viscosity: law.viscosity }),
            Rheology::Bingham(law) => Self::Bingham(BinghamFilm {
                incline,
                yield_stress: law.yield_stress,
                plastic_viscosity: law.plastic_viscosity,
            }),
            Rheology::HerschelBulkley(law) => Self::HerschelBulkley(HerschelBulkleyFilm {
                incline,
                yield_stress: law.yield_stress,
                consistency: law.consistency,
                flow_index: law.flow_index,
            }),
            law => Self::Integrated(LawFilm { incline, law }),
        }
    }

    /// The film of a Newtonian liquid with eddies of a positive mixing length `[m]`.
    pub fn with_eddies(liquid: Newtonian, incline: Incline, mixing_length: f64) -> Self {
        Self::Eddies(EddyFilm { incline, viscosity: liquid.viscosity, mixing_length })
    }

    /// Exact velocity `[m/s]` at a height `[m]`.
    pub fn velocity(&self, height: f64) -> f64 {
        match self {
            Self::Newtonian(film) => film.velocity(height),
            Self::Eddies(film) => film.velocity(height),
            Self::Bingham(film) => film.velocity(height),
            Self::HerschelBulkley(film) => film.velocity(height),
            Self::Integrated(film) => film.velocity(height),
        }
    }

    /// Exact flux `[m²/s]`.
    pub fn flux(&self) -> f64 {
        match self {
            Self::Newtonian(film) => film.flux(),
            Self::Eddies(film) => film.flux(),
            Self::Bingham(film) => film.flux(),
            Self::HerschelBulkley(film) => film.flux(),
            Self::Integrated(film) => film.flux(),
        }
    }

    /// Exact height of the plug's edge `[m]`; none where the closed forms know of no plug.
    pub fn plug_edge(&self) -> Option<f64> {
        match self {
            Self::Bingham(film) => Some(film.plug_edge()),
            Self::HerschelBulkley(film) => Some(film.plug_edge()),
            Self::Newtonian(_) | Self::Eddies(_) | Self::Integrated(_) => None,
        }
    }

    /// Exponent n in τ − τ_y ∝ |du/dy|ⁿ `[-]`.
    pub fn flow_index(&self) -> f64 {
        if let Self::HerschelBulkley(film) = self { film.flow_index } else { 1.0 }
    }

    /// Viscosity `[Pa·s]` that sets the time over which the sheared part relaxes, ρ h²/η.
    pub fn relaxing_viscosity(&self) -> f64 {
        match self {
            Self::Newtonian(film) => film.viscosity,
            Self::Eddies(film) => film.viscosity,
            Self::Bingham(film) => film.plastic_viscosity,
            Self::HerschelBulkley(film) => {
                film.consistency * libm::pow(film.plug_velocity() / film.plug_edge(), film.flow_index - 1.0)
            }
            Self::Integrated(film) => film.viscosity_at_bed(),
        }
    }
}
