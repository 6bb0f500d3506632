//! Rules that the parameters of several cases share: those of a field alone, and those between fields.

use crate::case::ParameterError;
use bagnold_solver::incompressible::{Continuity, MeanFlux, ProjectionNumerics};
use bagnold_solver::material::rheology::{MuI, Rheology};
use bagnold_solver::parameter::{self, ParameterProblem, Rule, inside, positive, up_to};
use bagnold_solver::weakly_compressible::numerics::Numerics;
use bagnold_solver::weakly_compressible::walls::Surface;

/// Gravity `[m/s²]`.
pub fn gravity() -> Rule {
    positive("give it in m/s², such as 9.81")
}

/// Rows of particles over a layer.
pub fn rows() -> Rule {
    parameter::between(4.0, 1000.0, "give 20 for a quick run, 40 for an accurate one")
}

/// A slope angle `[°]`.
pub fn slope_angle() -> Rule {
    inside(-90.0, 90.0, "give the angle between the slope and the horizontal in degrees")
        .in_words("above −90° and below 90°")
}

/// Slope i of a bed that drives a flow `[-]`.
pub fn driving_slope() -> Rule {
    let remedy = "give the tangent of the slope, such as 0.03 for 3 %";
    up_to(0.2, remedy).in_words("positive and at most 0.2")
}

/// A value in [lower, upper].
pub fn between(field: &str, value: f64, lower: f64, upper: f64, remedy: &str) -> Result<(), ParameterError> {
    if value >= lower && value <= upper {
        return Ok(());
    }
    // computed bounds with the fewest digits that are still allowed
    let shown = |bound: f64| {
        let [short, long] = [4, 9].map(|digits| format!("{bound:.digits$e}").parse().unwrap_or(bound));
        if (lower..=upper).contains(&short) { short } else { long }
    };
    Err(ParameterError::field(field, value, &format!("between {} and {}", shown(lower), shown(upper)), remedy))
}

/// A count in [least, most].
pub fn count(field: &str, value: usize, least: usize, most: usize, remedy: &str) -> Result<(), ParameterError> {
    if (least..=most).contains(&value) {
        return Ok(());
    }
    Err(ParameterError::field(field, value, &format!("between {least} and {most}"), remedy))
}

/// Columns of particles along a period: the kernel with its skin must fit into it.
pub fn columns(field: &str, value: usize, numerics: &Numerics) -> Result<(), ParameterError> {
    let least = (2.0 * numerics.smoothing_ratio * (1.0 + numerics.verlet_skin)).ceil() as usize;
    count(field, value, least, 100_000, "give 12 for a quick run; the period must be wider than the kernel")
}

/// The rules between a constitutive law's own parameters.
pub fn material(path: &str, law: &Rheology) -> Result<(), ParameterError> {
    refuse(path, law.parameter_problem())
}

/// The grains of a case that is made for μ(I) only; `remedy` says why.
pub fn only_mu_i(path: &str, law: &Rheology, remedy: &str) -> Result<MuI, ParameterError> {
    match law {
        Rheology::MuI(grains) => Ok(*grains),
        other => {
            let name = format!("\"{}\"", other.name());
            Err(ParameterError::field(&format!("{path}.law"), name, "\"mu-i\"", remedy))
        }
    }
}

/// The continuity of the incompressible solver, which a case's own runs choose.
pub fn projection(path: &str, numerics: &ProjectionNumerics) -> Result<(), ParameterError> {
    let remedy = "choose it; only the suspensions of `settling` use the other";
    let refused =
        |field: &str, value, rule| Err(ParameterError::field(&format!("{path}.{field}"), value, rule, remedy));
    match (numerics.continuity, numerics.mean_flux) {
        (Continuity::Fluid, MeanFlux::Free) => Ok(()),
        (Continuity::Mixture, _) => refused("continuity", "mixture", "\"fluid\""),
        (Continuity::Fluid, MeanFlux::Zero) => refused("mean_flux", "zero", "\"free\""),
    }
}

/// The viscous step that a law allows.
pub fn viscous_step(path: &str, numerics: &Numerics, law: &Rheology) -> Result<(), ParameterError> {
    refuse(path, numerics.step_problem(law))
}

/// The operators and walls that a gate allows.
pub fn gate(path: &str, numerics: &Numerics) -> Result<(), ParameterError> {
    refuse(path, numerics.wall_problem(Surface::Smooth))
}

/// Columns of fluid particles along the period of a channel: no particle may see another one twice.
pub fn channel_columns(field: &str, value: usize, numerics: &ProjectionNumerics) -> Result<(), ParameterError> {
    let least = (4.0 * numerics.smoothing_ratio).ceil() as usize;
    count(field, value, least, 1000, "give 12 for a quick run; the period must be wider than the kernel")
}

/// Error of a parameter below a path, if there is one.
///
/// # Errors
/// The problem, with the path before its field.
pub fn refuse(path: &str, problem: Option<ParameterProblem>) -> Result<(), ParameterError> {
    problem.map_or(Ok(()), |problem| Err(problem.within(path).into()))
}
