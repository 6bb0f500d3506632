//! Friction and dilatancy of grains in a viscous liquid over the viscous number (Pailha & Pouliquen 2009).
//!
//! I = η γ̇/p′, τ = (μ_c + K1 I + tanψ) p′, tanψ = K3 (φ − φ_eq), φ_eq = φ_c − K2 I, dφ/dt = −φ D with D = γ̇ tanψ.
//! Under a given stress τ and a given effective pressure p′ the shear rate is linear in p′:
//! γ̇ = [τ − (μ_c + K3 (φ − φ_c)) p′]₊/(η (K1 + K2 K3)).

/// Law of friction and dilatancy over the viscous number I = η γ̇/p′.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ViscousNumberLaw {
    /// Friction coefficient μ_c at rest `[-]`.
    pub critical_friction: f64,
    /// Rise K1 of the friction coefficient with I `[-]`.
    pub friction_slope: f64,
    /// Equilibrium solid fraction φ_c at rest `[-]`.
    pub critical_fraction: f64,
    /// Fall K2 of the equilibrium solid fraction with I `[-]`.
    pub fraction_slope: f64,
    /// Dilatancy K3: tanψ per difference of solid fraction from equilibrium `[-]`.
    pub dilatancy: f64,
}

/// Shear and dilation of grains.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct GrainFlow {
    /// Shear rate γ̇ `[1/s]`.
    pub shear_rate: f64,
    /// Dilation rate D = γ̇ tanψ `[1/s]`.
    pub dilation_rate: f64,
    /// Derivative ∂D/∂p′ under the same stress `[1/(Pa s)]`.
    pub dilation_slope: f64,
}

impl ViscousNumberLaw {
    /// Constants of Pailha & Pouliquen (2009) for glass beads; none is fitted here.
    pub const GLASS_BEADS: Self = Self {
        critical_friction: 0.415,
        friction_slope: 90.5,
        critical_fraction: 0.582,
        fraction_slope: 25.0,
        dilatancy: 4.09,
    };

    /// Equilibrium solid fraction φ_eq at a viscous number `[-]`.
    #[must_use]
    pub fn equilibrium_fraction(&self, viscous_number: f64) -> f64 {
        self.critical_fraction - self.fraction_slope * viscous_number
    }

    /// tanψ of the dilatancy angle `[-]`.
    #[must_use]
    pub fn dilatancy_tangent(&self, viscous_number: f64, solid_fraction: f64) -> f64 {
        self.dilatancy * (solid_fraction - self.equilibrium_fraction(viscous_number))
    }

    /// Friction coefficient τ/p′ of flowing grains `[-]`.
    #[must_use]
    pub fn friction(&self, viscous_number: f64, solid_fraction: f64) -> f64 {
        let dilatancy = self.dilatancy_tangent(viscous_number, solid_fraction);
        self.critical_friction + self.friction_slope * viscous_number + dilatancy
    }

    /// Viscous number of a steady flow at a friction coefficient, where tanψ = 0 `[-]`; 0 below μ_c.
    #[must_use]
    pub fn steady_viscous_number(&self, friction: f64) -> f64 {
        (friction - self.critical_friction).max(0.0) / self.friction_slope
    }

    /// Flow under a shear stress `[Pa]` and an effective pressure `[Pa]` in a liquid of viscosity η `[Pa·s]`; rest below
    /// the yield stress.
    #[must_use]
    pub fn flow(&self, stress: f64, effective_pressure: f64, solid_fraction: f64, viscosity: f64) -> GrainFlow {
        // grains that are too loose to hold have none
        let yield_friction =
            (self.critical_friction + self.dilatancy * (solid_fraction - self.critical_fraction)).max(0.0);
        let excess = stress - yield_friction * effective_pressure;
        if excess <= 0.0 {
            return GrainFlow::default();
        }
        let resistance = viscosity * (self.friction_slope + self.fraction_slope * self.dilatancy);
        let (shear_rate, rate_slope) = (excess / resistance, -yield_friction / resistance);
        let viscous_number = viscosity * shear_rate / effective_pressure;
        let number_slope = (viscosity * rate_slope - viscous_number) / effective_pressure;
        let tangent = self.dilatancy_tangent(viscous_number, solid_fraction);
        let tangent_slope = self.dilatancy * self.fraction_slope * number_slope;
        GrainFlow {
            shear_rate,
            dilation_rate: shear_rate * tangent,
            dilation_slope: rate_slope * tangent + shear_rate * tangent_slope,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAW: ViscousNumberLaw = ViscousNumberLaw::GLASS_BEADS;

    #[test]
    fn the_flow_under_a_stress_has_this_stress_by_the_law() {
        for (pressure, fraction) in [(20.0, 0.56), (24.0, 0.585), (18.0, 0.6)] {
            let flow = LAW.flow(11.0, pressure, fraction, 0.1);
            let viscous_number = 0.1 * flow.shear_rate / pressure;
            assert!(flow.shear_rate > 0.0);
            assert!((LAW.friction(viscous_number, fraction) * pressure - 11.0).abs() < 1e-12);
            let dilation = flow.shear_rate * LAW.dilatancy_tangent(viscous_number, fraction);
            assert!((flow.dilation_rate - dilation).abs() < 1e-15);
        }
    }

    #[test]
    fn the_slope_of_the_dilation_rate_is_its_finite_difference() {
        let rate = |pressure: f64| LAW.flow(11.0, pressure, 0.585, 0.1);
        let difference = (rate(22.0 + 1e-4).dilation_rate - rate(22.0 - 1e-4).dilation_rate) / 2e-4;
        assert!((difference / rate(22.0).dilation_slope - 1.0).abs() < 1e-6);
    }

    #[test]
    fn grains_rest_below_the_yield_stress_and_keep_the_equilibrium_fraction_above() {
        assert_eq!(LAW.flow(9.0, 22.0, 0.585, 0.1), GrainFlow::default());
        let viscous_number = LAW.steady_viscous_number(0.5);
        let flow = LAW.flow(11.0, 22.0, LAW.equilibrium_fraction(viscous_number), 0.1);
        assert!((0.1 * flow.shear_rate / 22.0 / viscous_number - 1.0).abs() < 1e-12);
        assert!(flow.dilation_rate.abs() < 1e-15);
        assert_eq!(LAW.steady_viscous_number(0.4), 0.0);
    }
}
