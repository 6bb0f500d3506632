//! Check of scenes that use the mixture's continuity.

use super::super::{Continuity, IncompressibleScene, MeanFlux, PressureSource, SedimentPressure, SurfaceTreatment};
use crate::parameter::ParameterProblem;
use crate::run::SceneError;

impl<const D: usize> IncompressibleScene<D> {
    /// Requirements of the mixture's continuity on the other choices.
    pub(super) fn check_mixture(&self) -> Result<(), SceneError> {
        let numerics = &self.numerics;
        let choice = |field, value, rule, remedy| Err(ParameterProblem::new(field, value, rule, remedy).into());
        if numerics.continuity == Continuity::Fluid {
            return match numerics.mean_flux {
                MeanFlux::Free => Ok(()),
                MeanFlux::Zero => choice(
                    "mean_flux",
                    "zero",
                    "\"free\" unless the continuity is that of the mixture",
                    "change one of the two",
                ),
            };
        }
        let without_pressure = self.sediment.as_ref().is_some_and(|s| s.pressure == SedimentPressure::None);
        let problem = if self.solid_fraction.stratification().is_none() {
            Some("\"fluid\" where grains displace no fluid")
        } else if !without_pressure {
            Some("\"fluid\" unless there is a sediment without a pressure of its own")
        } else if numerics.pressure_source != PressureSource::Divergence {
            Some("\"fluid\" with the density source")
        } else if numerics.surface != SurfaceTreatment::Completed {
            Some("\"fluid\" where particles at the surface are eliminated")
        } else {
            None
        };
        problem.map_or(Ok(()), |rule| choice("continuity", "mixture", rule, "change one of the two"))
    }
}
