//! A parameter is declared once, on its field: the doc comment with the unit, the type, and the rule of its range.
//!
//! `#[derive(JsonSchema)]` makes a JSON Schema (2020-12) of a struct; a [`Rule`] as a field's `transform` adds the range
//! and what to do about a value outside it. One checker, [`first_fault`], walks values along that schema:
//!
//! ```
//! use bagnold_solver::parameter::{positive, range_problem};
//!
//! /// A wall.
//! #[derive(serde::Serialize, schemars::JsonSchema)]
//! struct Wall {
//!     /// Sand roughness k_s `[m]`.
//!     #[schemars(transform = positive("give it in metres"))]
//!     sand_roughness: f64,
//! }
//! let problem = range_problem(&Wall { sand_roughness: -0.005 }).expect("refused");
//! assert_eq!(
//!     problem.to_string(),
//!     "`sand_roughness` is -0.005, but must be positive and finite; give it in metres"
//! );
//! ```
//!
//! The unit of a number bounds it where no rule does: a length of 1e308 m is refused wherever it stands, and so is an
//! angle of 1e-308°.
//!
//! A rule that compares fields is a function of the struct that holds them.

mod check;
mod magnitude;
mod problem;
mod rules;
mod schema;
mod shape;
#[cfg(test)]
mod tests;

pub use check::{Fault, first_fault, rule_in_words};
pub use magnitude::LARGEST_LENGTH;
pub use problem::{ParameterProblem, defect, shortened};
pub use rules::{Rule, above, at_least, between, filled, inside, not_negative, positive, up_to};
pub use schema::{range_problem, schema_of};
pub use shape::{Shape, Variant, description};
