//! Linear systems with symmetric, positive definite operators that are given by their products.

mod conjugate_gradient;
mod reductions;

pub(crate) use conjugate_gradient::{ConjugateGradient, Criterion, NotConverged};
