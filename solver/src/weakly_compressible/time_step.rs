//! The explicit time step (29): acoustic, advective and viscous bounds.

use crate::weakly_compressible::{Numerics, ViscousStep};

/// The three bounds of a step and which of them binds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeStepBounds {
    /// C h/c `[s]`.
    pub acoustic: f64,
    /// C h/v_max `[s]`, infinite at rest.
    pub advective: f64,
    /// C h²/ν_max `[s]` with the largest diffusivity, infinite where nothing diffuses explicitly.
    pub viscous: f64,
}

impl TimeStepBounds {
    /// The bounds for smoothing length h `[m]`, sound speed c `[m/s]`, largest speed `[m/s]` and largest
    /// diffusivity `[m²/s]`: a kinematic viscosity, or what stands for that of a pore liquid.
    #[must_use]
    pub fn new(
        numerics: &Numerics,
        smoothing_length: f64,
        sound_speed: f64,
        largest_speed: f64,
        diffusivity: f64,
    ) -> Self {
        let bound = |coefficient: f64, rate: f64| if rate > 0.0 { coefficient / rate } else { f64::INFINITY };
        Self {
            acoustic: numerics.acoustic_courant * smoothing_length / sound_speed,
            advective: bound(numerics.advective_courant * smoothing_length, largest_speed),
            viscous: match numerics.viscous_step {
                ViscousStep::Explicit => {
                    bound(numerics.viscous_courant * smoothing_length * smoothing_length, diffusivity)
                }
                ViscousStep::Implicit => f64::INFINITY,
            },
        }
    }

    /// The step `[s]`: the smallest bound.
    #[must_use]
    pub fn step(&self) -> f64 {
        self.acoustic.min(self.advective).min(self.viscous)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smallest_bound_binds() {
        let numerics = Numerics::default();
        let bounds = TimeStepBounds::new(&numerics, 0.01, 20.0, 0.0, 0.0);
        assert_eq!(
            (bounds.step(), bounds.advective, bounds.viscous),
            (0.4 * 0.01 / 20.0, f64::INFINITY, f64::INFINITY)
        );
        // an implicit viscous step has no bound
        let implicit = Numerics { viscous_step: ViscousStep::Implicit, ..numerics };
        assert_eq!(TimeStepBounds::new(&implicit, 0.01, 20.0, 0.0, 38e3).step(), bounds.step());
        // the figures of the model notes: η = 38 kPa·s at h = 3 mm needs a step below 1e-7 s
        let bounds = TimeStepBounds::new(&numerics, 0.003, 8.0, 1.0, 38e3 / 1500.0);
        assert!(bounds.step() == bounds.viscous && bounds.step() < 1e-7);
        // C ρ h²/η with C = 0.2
        assert!((bounds.viscous / (0.2 * 1500.0 * 0.003 * 0.003 / 38e3) - 1.0).abs() < 1e-12);
    }
}
