//! Whether two minima are one: what separates them on the emulator.

use crate::inference::Emulator;
use crate::inference::descent::descend_held;

/// Rise of χ² between two minima below which they are one: no experiment tells them apart.
const BARRIER: f64 = 1.0;

/// Steps from one to the other.
const STEPS: usize = 10;

/// Whether χ² of the emulator rises between two points above the higher one to where no experiment confuses them. The
/// coordinate in which they differ most is moved in steps, all others are at their best, as along a valley.
pub(super) fn is_parted(emulator: &Emulator, from: &[f64], to: &[f64]) -> bool {
    let apart = |k: &usize| (from[*k] - to[*k]).abs();
    let along = (0..from.len()).max_by(|a, b| apart(a).total_cmp(&apart(b))).unwrap_or(0);
    let mut place = from.to_vec();
    let mut highest = f64::NEG_INFINITY;
    for step in 1..STEPS {
        let value = from[along] + (to[along] - from[along]) * step as f64 / STEPS as f64;
        let bottom = descend_held(emulator, &place, along, value);
        highest = highest.max(bottom.chi_squared);
        place = bottom.point;
    }
    highest - emulator.chi_squared(from).max(emulator.chi_squared(to)) > BARRIER
}
