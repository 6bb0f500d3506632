//! The free surface: where neighbours are missing.

use super::super::neighbours::{LEAST_TASK, Pair};
use super::super::numerics::ProjectionNumerics;
use super::super::phase::Phase;
use rayon::prelude::*;

/// Concentration of the particles, which of them lie at the surface (31), and how near it the others are.
pub(crate) fn find_surface<const D: usize>(phase: &mut Phase<D>, numerics: &ProjectionNumerics) {
    let Phase { free_pairs, wall_pairs, kernel, lattice, lattice_volume, .. } = phase;
    let (volume, own, threshold) = (*lattice_volume, kernel.value(0.0), numerics.surface_threshold);
    let scale = volume / (lattice.concentration * numerics.reference_concentration);
    (&mut phase.concentration, &mut phase.at_surface, &mut phase.deficit, &mut phase.moment)
        .into_par_iter()
        .enumerate()
        .with_min_len(LEAST_TASK)
        .for_each(|(a, (concentration, at_surface, deficit, moment))| {
            let (mut value, mut arms) = (own, 0.0);
            for pair in free_pairs.of(a).iter().chain(wall_pairs.of(a)) {
                value += pair.value;
                arms -= pair.gradient * pair.separation.norm_squared();
            }
            *concentration = scale * value;
            *at_surface = *concentration < threshold;
            *deficit = ((1.0 - *concentration) / (1.0 - threshold) - 0.5).clamp(0.0, 1.0);
            *moment = if *at_surface { lattice.gradient } else { volume * arms / D as f64 };
        });
    let deficit = &phase.deficit;
    phase.nearness.par_iter_mut().enumerate().with_min_len(LEAST_TASK).for_each(|(a, nearness)| {
        let sum = |sum, pair: &Pair<D>| sum + pair.value * deficit[pair.source as usize];
        let mean = volume * free_pairs.of(a).iter().fold(own * deficit[a], sum);
        *nearness = (numerics.surface_gain * mean).min(1.0);
    });
}
