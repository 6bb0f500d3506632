//! Drag between a sediment particle and a fluid particle: a force β_ab (u_b − u_a), β_ab = m_b W times a factor.
//!
//! The printed form (30) gives the force on grain a as Σ_b ½ m_b C_d d |u_ba| W u_ba over the fluid's particles b, hence
//! β_ab = ½ m_b C_d d |u_ab| W with C_d d |u_ab| = (C_d R) ν. In the volume-fraction form a particle of volume V_a feels
//! V_a K (u_f − u_a), shared by W over the fluid around it.

/// Δt β_ab `[kg]` of a fluid particle's mass `[kg]`, W `[1/m^D]` and the factor `[m^D/s]`.
#[inline(always)]
pub(crate) fn coefficient(time_step: f64, fluid_mass: f64, value: f64, factor: f64) -> f64 {
    time_step * fluid_mass * value * factor
}

/// V_a K/(ρ_f Σ_b V_b W) `[m^D/s]`: the exchange of a particle of the volume V_a `[m^D]`, shared by the fluid around it, where
/// Σ_b V_b W `[-]` is 1 if its particles are all there.
pub(crate) fn exchange_factor(volume: f64, exchange: f64, fluid_density: f64, fluid_around: f64) -> f64 {
    volume * exchange / (fluid_density * fluid_around)
}
