//! The steady balance of a fluidity over cells of equal width: A² d² g″ + R g − b g² = 0.
//!
//! Newton's method from above, where the balance is concave in g: every iterate stays above the solution, and the matrix of
//! −A² d² g″ + (2 b g − R) g_new = b g² has a positive inverse, so that a fluidity of 10⁻²⁰ far below the flow is as exact in its digits as
//! that of the flow itself.

use super::LayerError;
use super::tridiagonal::solve;
use bagnold_solver::material::rheology::MuI;
use bagnold_solver::material::rheology::field::FieldBoundary;

/// Largest number of Newton steps.
const NEWTON_STEPS: usize = 400;
/// Change over the largest value at which the fluidity is solved: Newton's steps shrink as squares, and rounding of the Laplacian over
/// thousands of cells leaves no less.
const TOLERANCE: f64 = 1e-8;
/// A flow whose largest g falls below this part of the local law's is at rest.
const AT_REST: f64 = 1e-12;

/// Growth R `[-]` of a small fluidity of grains under a friction coefficient μ `[-]`.
pub(crate) fn growth(grains: &MuI, friction: f64) -> f64 {
    let (low, high) = (grains.static_friction, grains.limiting_friction);
    (high - low) * (friction - low) / (high - friction)
}

/// Length ξ = A d/√|R| `[m]` over which a fluidity decays under a uniform μ below μ_s.
pub(crate) fn cooperativity_length(grains: &MuI, cooperativity: f64, friction: f64) -> f64 {
    cooperativity * grains.grain_diameter / growth(grains, friction).abs().sqrt()
}

/// The positive g of every cell `[1/s]`, or zero where there is none: of grains with an amplitude A of their cooperation, in cells of a
/// width `[m]`, from the pressure `[Pa]` and the friction coefficient `[-]` of each, and what g is before the first and behind the last.
pub(crate) fn steady_fluidity(
    (grains, cooperativity): (&MuI, f64),
    width: f64,
    stresses: &[(f64, f64)],
    ends: [FieldBoundary; 2],
) -> Result<Vec<f64>, LayerError> {
    let cells = stresses.len();
    let range = grains.limiting_friction - grains.static_friction;
    let coupling = (cooperativity * grains.grain_diameter / width).powi(2);
    let growth: Vec<f64> = stresses.iter().map(|stress| growth(grains, stress.1)).collect();
    let damping = |&(pressure, friction): &(f64, f64)| {
        let rate = (pressure / grains.grain_density).sqrt() / grains.grain_diameter;
        range / grains.reference_inertia * friction / rate
    };
    let damping: Vec<f64> = stresses.iter().map(damping).collect();
    let local = growth.iter().zip(&damping).map(|(growth, b)| growth.max(0.0) / b).fold(0.0, f64::max);
    let still = || Ok(vec![0.0; cells]);
    if local <= 0.0 {
        return still();
    }
    let beside = vec![-coupling; cells];
    let mut fluidity = vec![2.0 * local; cells];
    for _ in 0..NEWTON_STEPS {
        let diagonal: Vec<f64> = (0..cells)
            .map(|cell| {
                let faces = faces(ends, cell, cells);
                faces * coupling - growth[cell] + 2.0 * damping[cell] * fluidity[cell]
            })
            .collect();
        let right: Vec<f64> = damping.iter().zip(&fluidity).map(|(b, g)| b * g * g).collect();
        let next = solve(&beside, &diagonal, &beside, &right);
        let mut largest = 0.0_f64;
        for (fluidity, next) in fluidity.iter_mut().zip(&next) {
            largest = largest.max((next - *fluidity).abs());
            *fluidity = next.max(0.3 * *fluidity);
        }
        let highest = fluidity.iter().copied().fold(0.0, f64::max);
        if highest <= AT_REST * local {
            return still();
        }
        if largest <= TOLERANCE * highest {
            return Ok(fluidity);
        }
    }
    Err(LayerError::NotSteady { reason: "the fluidity still changes".to_owned(), steps: NEWTON_STEPS })
}

/// The factor of a cell's own g in its Laplacian: a face at which g vanishes is half a cell away.
pub(crate) fn faces(ends: [FieldBoundary; 2], cell: usize, cells: usize) -> f64 {
    let face = |end: FieldBoundary, outermost: bool| match end {
        _ if !outermost => 1.0,
        FieldBoundary::Vanishing => 2.0,
        FieldBoundary::NoFlux => 0.0,
    };
    face(ends[0], cell == 0) + face(ends[1], cell + 1 == cells)
}
