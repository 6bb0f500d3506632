//! Linear systems with symmetric, positive definite operators that are given by their products.

mod conjugate_gradient;
mod descent;
mod incomplete_cholesky;
mod lane_rows;
mod lattices;
mod reductions;

#[cfg(test)]
mod tests;

pub(crate) use conjugate_gradient::{ConjugateGradient, Criterion, NotConverged};
pub(crate) use descent::{Descent, Stalled, descend};
pub(crate) use incomplete_cholesky::{IncompleteCholesky, Rows};
pub(crate) use lane_rows::{Coefficients, LaneRows, Row, Single, TASK_ROWS, TwoRows, single};
pub(crate) use lattices::Lattices;
