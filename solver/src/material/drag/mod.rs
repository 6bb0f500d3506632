//! Drag between grains and a fluid. A law knows nothing of particles: it turns a slip into a coefficient.
//!
//! Two quantities, both finite without slip because they are made from C_d R and not from C_d:
//! - C_d R `[-]` of one grain alone, R = |u_f − u_s| d/ν: the drag per frontal area is ½ ρ_f C_d |u_r|² with
//!   C_d |u_r| = (C_d R) ν/d;
//! - the exchange coefficient K `[kg/(m³ s)]` of many grains: f = K (u_f − u_s) `[N/m³]` acts on the grains, −f on the
//!   fluid. The laws are written for phases that share the pressure gradient by volume, so that grains settle with
//!   φ (1 − φ)(ρ_s − ρ_f) g = K |u_r|.
//!
//! | law | of | R in K | K without slip |
//! |---|---|---|---|
//! | Morsi–Alexander, Schiller–Naumann | a grain alone: dilute only | abs(u_r) d/ν | 18 φ μ/d² |
//! | Wen–Yu | a suspension | ε abs(u_r) d/ν | 18 φ μ ε^−2.65/d² |
//! | Di Felice | a suspension or bed | ε abs(u_r) d/ν | 17.28 φ μ ε^−2.7/d² |
//! | Ergun | a packed bed | – | 150 φ² μ/(ε d²) |
//! | Gidaspow | Ergun for ε < 0.8, else Wen–Yu | ε abs(u_r) d/ν | |
//!
//! φ is the volume fraction of the grains and ε = 1 − φ that of the fluid.

mod di_felice;
mod ergun;
mod gidaspow;
mod morsi_alexander;
mod schiller_naumann;
mod settling;

pub use settling::{Settling, SettlingTable};
mod suspension;
mod wen_yu;

#[cfg(test)]
mod tests;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::RangeInclusive;
use suspension::Suspension;

/// A drag law, chosen by name, for example `drag = "di-felice"`.
#[derive(Serialize, Deserialize, JsonSchema, Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[serde(rename_all = "kebab-case")]
pub enum DragLaw {
    /// Morsi & Alexander (1972): one grain, a table of fits up to R = 50 000.
    MorsiAlexander,
    /// Schiller & Naumann (1933): one grain.
    SchillerNaumann,
    /// Wen & Yu (1966): Schiller–Naumann in a suspension.
    WenYu,
    /// Ergun (1952): a packed bed.
    Ergun,
    /// Gidaspow (1994): Ergun in a bed, Wen–Yu in a suspension.
    Gidaspow,
    /// Di Felice (1994): one formula from a grain alone to a bed.
    DiFelice,
}

impl DragLaw {
    /// All laws.
    pub const ALL: [Self; 6] =
        [Self::MorsiAlexander, Self::SchillerNaumann, Self::WenYu, Self::Ergun, Self::Gidaspow, Self::DiFelice];

    /// The law's name in parameters and in results.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::MorsiAlexander => "morsi-alexander",
            Self::SchillerNaumann => "schiller-naumann",
            Self::WenYu => "wen-yu",
            Self::Ergun => "ergun",
            Self::Gidaspow => "gidaspow",
            Self::DiFelice => "di-felice",
        }
    }

    /// C_d R `[-]` of one grain alone at a Reynolds number R = |u_r| d/ν ≥ 0 `[-]`: finite at R = 0.
    ///
    /// None for Ergun's law, which describes beds and has no single grain; that of a suspension is its dilute limit.
    #[inline]
    #[must_use]
    pub fn drag_times_reynolds(self, reynolds: f64) -> Option<f64> {
        match self {
            Self::MorsiAlexander => Some(morsi_alexander::drag_times_reynolds(reynolds)),
            Self::SchillerNaumann | Self::WenYu | Self::Gidaspow => {
                Some(schiller_naumann::drag_times_reynolds(reynolds))
            }
            Self::DiFelice => Some(di_felice::drag_times_reynolds(reynolds)),
            Self::Ergun => None,
        }
    }

    /// Drag coefficient C_d `[-]` of one grain alone at a Reynolds number `[-]`; ∞ at R = 0, None as for
    /// [`DragLaw::drag_times_reynolds`].
    #[inline]
    #[must_use]
    pub fn drag_coefficient(self, reynolds: f64) -> Option<f64> {
        self.drag_times_reynolds(reynolds).map(|product| product / reynolds)
    }

    /// Exchange coefficient K `[kg/(m³ s)]`, the force on the grains per volume is K (u_f − u_s).
    ///
    /// `solid_fraction` φ `[-]` in [0, 1), `slip` |u_f − u_s| ≥ 0 `[m/s]` of the phases' own (not superficial) velocities,
    /// `grain_diameter` `[m]`, `fluid_density` `[kg/m³]`, `kinematic_viscosity` `[m²/s]`, the molecular one. 0 at φ = 0.
    #[inline]
    #[must_use]
    pub fn exchange_coefficient(
        self,
        solid_fraction: f64,
        slip: f64,
        grain_diameter: f64,
        fluid_density: f64,
        kinematic_viscosity: f64,
    ) -> f64 {
        let suspension = Suspension { solid_fraction, slip, grain_diameter, fluid_density, kinematic_viscosity };
        match self {
            Self::MorsiAlexander => {
                suspension.exchange(morsi_alexander::drag_times_reynolds(suspension.grain_reynolds()))
            }
            Self::SchillerNaumann => {
                suspension.exchange(schiller_naumann::drag_times_reynolds(suspension.grain_reynolds()))
            }
            Self::WenYu => wen_yu::exchange_coefficient(&suspension),
            Self::Ergun => ergun::exchange_coefficient(&suspension),
            Self::Gidaspow => gidaspow::exchange_coefficient(&suspension),
            Self::DiFelice => di_felice::exchange_coefficient(&suspension),
        }
    }

    /// Reynolds numbers `[-]` that the law is given for: a solver stops a run that leaves them.
    ///
    /// Only Morsi and Alexander's table ends, at 50 000. The others continue along their asymptotes; that the drag of a
    /// sphere drops near 3·10⁵, where its boundary layer becomes turbulent, is in none of them.
    #[must_use]
    pub fn reynolds_range(self) -> RangeInclusive<f64> {
        match self {
            Self::MorsiAlexander => 0.0..=morsi_alexander::LARGEST_REYNOLDS,
            Self::SchillerNaumann | Self::WenYu | Self::Ergun | Self::Gidaspow | Self::DiFelice => 0.0..=f64::INFINITY,
        }
    }
}
