//! Rules that the parameters of several cases share.

use crate::case::ParameterError;
use bagnold_solver::incompressible::{Continuity, MeanFlux, ProjectionNumerics};
use bagnold_solver::material::rheology::{ParameterProblem, Rheology};
use bagnold_solver::weakly_compressible::boundary::Surface;
use bagnold_solver::weakly_compressible::numerics::{ChoiceProblem, Numerics};

/// A positive, finite value.
pub(super) fn positive(field: &str, value: f64, remedy: &str) -> Result<(), ParameterError> {
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    Err(ParameterError::field(field, value, "positive and finite", remedy))
}

/// A value in [lower, upper].
pub(super) fn between(field: &str, value: f64, lower: f64, upper: f64, remedy: &str) -> Result<(), ParameterError> {
    if value >= lower && value <= upper {
        return Ok(());
    }
    Err(ParameterError::field(field, value, &format!("between {} and {}", shown(lower), shown(upper)), remedy))
}

/// A computed bound without the digits that rounding left behind.
fn shown(bound: f64) -> f64 {
    format!("{bound:.9e}").parse().unwrap_or(bound)
}

/// A slope angle `[°]`.
pub(super) fn slope_angle(field: &str, value: f64) -> Result<(), ParameterError> {
    if value > -90.0 && value < 90.0 {
        return Ok(());
    }
    Err(ParameterError::field(
        field,
        value,
        "inside (−90°, 90°)",
        "give the angle between the slope and the horizontal in degrees",
    ))
}

/// Rows of particles over a layer.
pub(super) fn rows(field: &str, value: usize) -> Result<(), ParameterError> {
    if (4..=1000).contains(&value) {
        return Ok(());
    }
    Err(ParameterError::field(field, value, "between 4 and 1000", "20 is quick, 40 is accurate"))
}

/// Columns of particles along a period: the kernel with its skin must fit into it.
pub(super) fn columns(field: &str, value: usize, numerics: &Numerics) -> Result<(), ParameterError> {
    let least = (2.0 * numerics.smoothing_ratio * (1.0 + numerics.verlet_skin)).ceil() as usize;
    if value >= least && value <= 100_000 {
        return Ok(());
    }
    let rule = format!("between {least} and 100000");
    Err(ParameterError::field(field, value, &rule, "the period must hold the reach of the kernel; 12 is quick"))
}

/// The ranges of a constitutive law's own parameters.
pub(super) fn material(path: &str, law: &Rheology) -> Result<(), ParameterError> {
    self::law(path, law.parameter_problem())
}

/// The ranges of any other law's parameters.
pub(super) fn law(path: &str, problem: Option<ParameterProblem>) -> Result<(), ParameterError> {
    problem.map_or(Ok(()), |(field, value, rule, remedy)| {
        Err(ParameterError::field(&format!("{path}.{field}"), value, rule, remedy))
    })
}

/// The ranges of the numerics.
pub(super) fn numerics(path: &str, numerics: &Numerics) -> Result<(), ParameterError> {
    numerics.parameter_problem().map_or(Ok(()), |(field, value, rule, remedy)| {
        Err(ParameterError::field(&format!("{path}.{field}"), value, rule, remedy))
    })
}

/// The ranges of the numerics of the incompressible solver.
pub(super) fn projection(path: &str, numerics: &ProjectionNumerics) -> Result<(), ParameterError> {
    numerics.parameter_problem().map_or(Ok(()), |(field, value, rule, remedy)| {
        Err(ParameterError::field(&format!("{path}.{field}"), value, rule, remedy))
    })?;
    let remedy = "only suspensions share their pressure, and `settling` chooses it for them";
    let refused =
        |field: &str, value, rule| Err(ParameterError::field(&format!("{path}.{field}"), value, rule, remedy));
    match (numerics.continuity, numerics.mean_flux) {
        (Continuity::Fluid, MeanFlux::Free) => Ok(()),
        (Continuity::Mixture, _) => refused("continuity", "mixture", "\"fluid\""),
        (Continuity::Fluid, MeanFlux::Zero) => refused("mean_flux", "zero", "\"free\""),
    }
}

/// The viscous step that a law allows.
pub(super) fn viscous_step(path: &str, numerics: &Numerics, law: &Rheology) -> Result<(), ParameterError> {
    choice(path, numerics.step_problem(law))
}

/// The operators and walls that a gate allows.
pub(super) fn gate(path: &str, numerics: &Numerics) -> Result<(), ParameterError> {
    choice(path, numerics.wall_problem(Surface::Smooth))
}

/// The operators that the implicit runs allow which a list of the parameters asks for.
pub(super) fn implicit_runs(path: &str, numerics: &Numerics, list: &str) -> Result<(), ParameterError> {
    let Some(operator) = numerics.pairwise_operator() else { return Ok(()) };
    let rule = format!("\"single-divergence\" or \"uncorrected-divergence\" with the implicit runs of `{list}`");
    Err(ParameterError::field(
        &format!("{path}.momentum_operator"),
        operator,
        &rule,
        "choose one of these, or empty that list",
    ))
}

/// Columns of fluid particles along the period of a channel: no particle may see another one twice.
pub(super) fn channel_columns(field: &str, value: usize, numerics: &ProjectionNumerics) -> Result<(), ParameterError> {
    let least = (4.0 * numerics.smoothing_ratio).ceil() as usize;
    if (least..=1000).contains(&value) {
        return Ok(());
    }
    let rule = format!("between {least} and 1000");
    Err(ParameterError::field(field, value, &rule, "the period must hold twice the reach of the kernel; 12 is quick"))
}

/// Slope i of a bed that drives a flow.
pub(super) fn driving_slope(field: &str, value: f64) -> Result<(), ParameterError> {
    if value > 0.0 && value <= 0.2 {
        return Ok(());
    }
    let remedy = "without a slope there is no friction velocity √(g h i); give its tangent, such as 0.03 for 3 %";
    Err(ParameterError::field(field, value, "positive and at most 0.2", remedy))
}

fn choice(path: &str, problem: Option<ChoiceProblem>) -> Result<(), ParameterError> {
    problem.map_or(Ok(()), |(field, value, rule, remedy)| {
        Err(ParameterError::field(&format!("{path}.{field}"), value, rule, remedy))
    })
}
