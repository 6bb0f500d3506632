//! Volumes of particles beside walls and outlines: what a body has in a cell that is cut belongs to the nearest particle.
//!
//! Whole cells leave the liquid along a wall that crosses the lattice short of half a row: pairs across that gap bear too little, and the
//! liquid slips by a third of a spacing.

use super::behind_walls::Site;
use super::lattice::SiteLattice;
use crate::checkpoint::is_interrupted;
use bagnold_solver::vector::Vector;
use std::collections::{BTreeSet, HashMap};

/// Samples along an edge of a cell, in the plane and in space.
const SAMPLES: [usize; 2] = [8, 4];

/// Part of a body that belongs to a particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Part<const D: usize> {
    /// Volume over that of a cell `[-]`.
    pub(super) volume: f64,
    /// Centre of mass `[m]`.
    pub(super) centre: Vector<D>,
}

/// Part of the particle at each site, where `is_inside` says whether a body has material at a place.
pub(super) fn parts<const D: usize>(
    lattice: &SiteLattice<D>,
    sites: &[Site<D>],
    is_inside: impl Fn(&Vector<D>) -> bool,
) -> Vec<Part<D>> {
    let particles: HashMap<[i64; D], usize> = sites.iter().enumerate().map(|(k, site)| (site.cell, k)).collect();
    let around = |cell: [i64; D], reach: i64| {
        let side = 2 * reach + 1;
        (0..side.pow(D as u32))
            .map(move |k| std::array::from_fn(|axis| cell[axis] + k / side.pow(axis as u32) % side - reach))
    };
    let is_inner = |cell: &[i64; D]| around(*cell, 1).all(|near| particles.contains_key(&near));
    // shares, and their moments about the sites
    let whole = |site: &Site<D>| (if is_inner(&site.cell) { 1.0 } else { 0.0 }, Vector::<D>::zeros());
    let mut sums: Vec<(f64, Vector<D>)> = sites.iter().map(whole).collect();
    let outer = sites.iter().zip(&sums).filter(|(_, sum)| sum.0 == 0.0);
    let beside: BTreeSet<[i64; D]> = outer.flat_map(|(site, _)| around(site.cell, 1)).collect();
    let edge = SAMPLES[D - 2];
    let samples = edge.pow(D as u32);
    for cell in beside {
        // the filling ends soon after an interruption, which its next part reports
        if is_inner(&cell) || is_interrupted() {
            continue;
        }
        // a place in the cell of a particle is nearest to it
        let own = particles.get(&cell).copied();
        let near: Vec<usize> = match own {
            Some(_) => Vec::new(),
            None => around(cell, 2).filter_map(|near| particles.get(&near).copied()).collect(),
        };
        if own.is_none() && near.is_empty() {
            continue;
        }
        for k in 0..samples {
            let within = |axis: usize| ((k / edge.pow(axis as u32) % edge) as f64 + 0.5) / edge as f64;
            let place = lattice.place(&Vector::from_fn(|axis, _| cell[axis] as f64 + within(axis)));
            if !is_inside(&place) {
                continue;
            }
            let off = |k: usize| place - sites[k].place;
            let nearest =
                || near.iter().copied().min_by(|&a, &b| off(a).norm_squared().total_cmp(&off(b).norm_squared()));
            if let Some(k) = own.or_else(nearest) {
                sums[k].0 += 1.0 / samples as f64;
                sums[k].1 += off(k) / samples as f64;
            }
        }
    }
    let part = |(site, (volume, moment)): (&Site<D>, (f64, Vector<D>))| Part {
        volume,
        centre: if volume == 1.0 { site.place } else { site.place + moment / volume },
    };
    sites.iter().zip(sums).map(part).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cells of 1 m up to a wall at 10.3 m, which leaves the cell behind it 0.3 m: the last particle has 1.3 m about 9.65 m.
    #[test]
    fn the_last_particle_has_the_cut_cell_and_starts_at_the_centre_of_both() {
        let lattice = SiteLattice::<2>::common(1.0);
        let cells = (0..10).flat_map(|i| (0..7).map(move |j| [i, j]));
        let site = |cell| Site { cell, place: lattice.middle(&cell), body: 0, nearest: None };
        let sites: Vec<Site<2>> = cells.map(site).collect();
        let own = parts(&lattice, &sites, |place| place[0] > 0.0 && place[0] < 10.3);
        let (edge, inner) = (&own[9 * 7 + 3], &own[8 * 7 + 3]);
        assert!((edge.volume - 1.3).abs() < 0.07 && (edge.centre[0] - 9.65).abs() < 0.05, "{edge:?}");
        assert!((edge.centre[1] - 3.5).abs() < 1e-12, "{edge:?}");
        assert_eq!((inner.volume, inner.centre), (1.0, sites[8 * 7 + 3].place), "away from the wall nothing changes");
    }
}
