//! Observed orders of convergence of the discrete operators, on fields whose derivatives are known.

mod implicit_viscosity;
mod manufactured;
mod projection;
mod taylor_green;
mod velocity_gradient;

/// Observed order between successive resolutions, each twice as fine as the one before.
fn orders(errors: &[f64]) -> Vec<f64> {
    errors.windows(2).map(|pair| (pair[0] / pair[1]).log2()).collect()
}
