//! Mutation testing. A file lists mutations (`record`); a copy of the program holds them all (`copy`). One at a time is tried in
//! the cases that ought to detect it (`trial`, `judgement`).
//!
//! A case with an error is compared with the same case of the same program without one, so that neither accepted values
//! that are out of date nor gates that fail anyway count. What is asked is who would have noticed:
//! - a *gate* that held and fails now, or a run that diverges, or a program that stops: `bagnold report` fails on its own;
//! - only the *snapshot*: values move by more than they may against those accepted before;
//! - *nothing*.
//!
//! A snapshot tells that something changed, not that it is wrong; who accepts it, accepts the error. So the gates are what
//! counts: [`LEAST_CAUGHT`] and [`LEAST_GATED`] are what a set of gates must reach.
//!
//! Errors written by hand are those that somebody thought of. A second kind is drawn by chance from all that rules give (`generator`,
//! `draw`): its shares estimate those of any error of that kind in the lines that the quick tier executes.

mod copy;
mod draw;
mod generator;
mod judgement;
mod page;
mod record;
mod trial;

pub use copy::{CHOICE, TestProgram, TestTarget, build, build_tests};
pub use draw::{Draw, DrawProgress, TracedCase};
pub use judgement::{Broken, Detection, MutationComparison, MutationOutcome, holds, judge, shares_caught, tally};
pub use page::{drawn_line, drawn_page, page, table};
pub use record::{FILE, Mutation, Mutations, SourceReplacement};
pub use trial::{MutantRun, Scope, run_trial};

/// Share of the errors that something must notice `[-]`.
pub const LEAST_CAUGHT: f64 = 0.95;

/// Share of the errors that a gate must notice `[-]`.
pub const LEAST_GATED: f64 = 0.85;
