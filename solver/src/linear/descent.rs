//! The iteration of conjugate gradients, for whatever holds the vectors and knows the operator.

/// A system A x = b on its way to the solution: vectors, operator and preconditioner M.
pub(crate) trait Descent {
    /// Square of the residual's norm, in the norm that the solve ends by.
    fn square(&mut self) -> f64;
    /// z ← M⁻¹ r; returns r·z.
    fn descent(&mut self) -> f64;
    /// p ← z + growth · p.
    fn turn(&mut self, growth: f64);
    /// A p; returns p·A p.
    fn curvature(&mut self) -> f64;
    /// x ← x + step · p, r ← r − step · A p.
    fn advance(&mut self, step: f64);
}

/// An iteration that did not reach its goal.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stalled {
    /// Square of the residual's norm.
    pub(crate) square: f64,
}

/// Descends until the square of the residual is at most `goal`; returns the number of iterations.
///
/// # Errors
/// More than `most` iterations, sums that are no numbers, or an operator that is not positive.
#[inline(always)]
pub(crate) fn descend(system: &mut impl Descent, goal: f64, most: usize) -> Result<usize, Stalled> {
    let (mut before, mut iterations) = (0.0, 0);
    loop {
        let square = system.square();
        // written so that a NaN reaches the refusal below
        if square <= goal {
            return Ok(iterations);
        }
        let descent = system.descent();
        if iterations == most || !descent.is_finite() || !square.is_finite() {
            return Err(Stalled { square });
        }
        system.turn(if iterations > 0 { descent / before } else { 0.0 });
        let curvature = system.curvature();
        if curvature.is_nan() || curvature <= 0.0 {
            // the residual is still a number and tells where
            return Err(Stalled { square });
        }
        system.advance(descent / curvature);
        before = descent;
        iterations += 1;
    }
}
