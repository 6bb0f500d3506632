//! Checks of an incompressible scene before it is simulated.

use super::{IncompressibleScene, ParticleSet, Sediment, SedimentLoad, SedimentPressure, SolidFraction};
use crate::domain::AxisBoundary;
use crate::parameter::{ParameterProblem, range_problem};
use crate::run::SceneError;

impl<const D: usize> IncompressibleScene<D> {
    /// Checks that the scene can be simulated.
    ///
    /// # Errors
    /// The first rule that is broken.
    pub fn check(&self) -> Result<(), SceneError> {
        let fluid = &self.fluid;
        check_set(&fluid.particles)?;
        refuse(range_problem(&self.numerics))?;
        let mut lengths = vec![("spacing", fluid.spacing), ("density", fluid.density)];
        lengths.push(("kinematic_viscosity", fluid.kinematic_viscosity));
        let mut least_period = 4.0 * self.numerics.smoothing_ratio * fluid.spacing;
        if let Some(sediment) = &self.sediment {
            lengths.extend(sediment.check()?);
            least_period = least_period
                .max(4.0 * sediment.smoothing_ratio * sediment.spacing)
                .max(4.0 * sediment.drag_smoothing_length);
        }
        self.check_mixture()?;
        self.check_columns()?;
        if let Some(layer) = self.solid_fraction.stratification() {
            let strata = layer.strata();
            for &value in &strata.solid_fraction {
                if !(0.0..1.0).contains(&value) {
                    let (rule, remedy) =
                        ("at least 0 and below 1", "give 0 to 0.64, the share of the space that grains fill");
                    refuse(Some(ParameterProblem::new("solid_fraction", value, rule, remedy)))?;
                }
            }
            refuse(strata.suspension_viscosity.parameter_problem())?;
            lengths.extend([("packing", strata.packing), ("interval", strata.interval), ("depth", strata.depth)]);
        }
        for (field, value) in lengths {
            if !(value > 0.0 && value.is_finite()) {
                refuse(Some(ParameterProblem::new(field, value, "positive and finite", "give it in SI units")))?;
            }
        }
        SceneError::check_periods(&self.domain, least_period)
    }

    /// Requirements of columns of grains on the scene, and their existence where φ is taken from them.
    fn check_columns(&self) -> Result<(), SceneError> {
        let dilates = |sediment: &Sediment<D>| matches!(sediment.pressure, SedimentPressure::Dilatant { .. });
        let dilating = self.sediment.as_ref().filter(|sediment| dilates(sediment));
        let averaged = matches!(self.solid_fraction, SolidFraction::Averaged(_));
        let (field, value, rule) = match dilating {
            Some(sediment) if sediment.wall.is_empty() => ("sediment wall", "empty", "grains that hold the columns"),
            Some(_) if !averaged => ("solid_fraction", "given", "that of the columns where grains dilate"),
            Some(_) if !matches!(self.domain.axes[0], AxisBoundary::Periodic { .. }) => {
                ("domain", "open along the bed", "periodic along the bed where grains dilate")
            }
            None if averaged => ("solid_fraction", "averaged", "given where no grains dilate"),
            _ => return Ok(()),
        };
        refuse(Some(ParameterProblem::new(field, value, rule, "change one of the two")))
    }
}

impl<const D: usize> Sediment<D> {
    /// Checks the sediment, except what must be positive and finite, which is returned.
    fn check(&self) -> Result<impl IntoIterator<Item = (&'static str, f64)> + use<D>, SceneError> {
        if self.wall.is_empty() || !self.particles.position.is_empty() {
            check_set(&self.particles)?;
        }
        refuse(self.law.parameter_problem())?;
        refuse(self.law.field().map(|field| {
            let rule = format!("a law without a field, because this model does not advect the {}", field.name);
            ParameterProblem::new("law", self.law.name(), &rule, "choose a local law, such as \"root-mu-i\"")
        }))?;
        if let SedimentLoad::Packed { buoyant_weight, .. } = self.load
            && !(buoyant_weight >= 0.0 && buoyant_weight.is_finite())
        {
            let (rule, remedy) = ("0 or positive, and finite", "give it in SI units");
            refuse(Some(ParameterProblem::new("buoyant_weight", buoyant_weight, rule, remedy)))?;
        }
        if let SedimentPressure::Dilatant { columns, turbulent_schmidt, .. } = self.pressure {
            refuse(range_problem(&columns))?;
            if !(turbulent_schmidt >= 0.0 && turbulent_schmidt.is_finite()) {
                let (rule, remedy) =
                    ("0 or positive, and finite", "give 0.4 to 1 for suspensions, 0 for no dispersion");
                refuse(Some(ParameterProblem::new("turbulent_schmidt", turbulent_schmidt, rule, remedy)))?;
            }
        }
        let (expected, found) = (self.particles.position.len(), self.filling.len());
        if found != expected {
            return Err(SceneError::Length { array: "filling", found, expected });
        }
        Ok([
            ("sediment spacing", self.spacing),
            ("sediment smoothing_ratio", self.smoothing_ratio),
            ("sediment density", self.density),
            ("grain_diameter", self.grain_diameter),
            ("drag_diameter", self.drag_diameter),
            ("drag_smoothing_length", self.drag_smoothing_length),
        ])
    }
}

fn refuse(problem: Option<ParameterProblem>) -> Result<(), SceneError> {
    problem.map_or(Ok(()), |problem| Err(problem.into()))
}

fn check_set<const D: usize>(particles: &ParticleSet<D>) -> Result<(), SceneError> {
    let (expected, found) = (particles.position.len(), particles.velocity.len());
    if expected == 0 {
        return Err(SceneError::Empty);
    }
    if found != expected {
        return Err(SceneError::Length { array: "velocity", found, expected });
    }
    for (particle, (position, velocity)) in particles.position.iter().zip(&particles.velocity).enumerate() {
        for (quantity, value) in [("position", position.sum()), ("velocity", velocity.sum())] {
            if !value.is_finite() {
                return Err(SceneError::Value { quantity, particle, value, rule: "finite" });
            }
        }
    }
    Ok(())
}
