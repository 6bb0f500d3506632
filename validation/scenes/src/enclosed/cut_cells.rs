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
        let near: Vec<usize> = around(cell, 2).filter_map(|near| particles.get(&near).copied()).collect();
        for k in 0..samples {
            let within = |axis: usize| ((k / edge.pow(axis as u32) % edge) as f64 + 0.5) / edge as f64;
            let place = lattice.place(&Vector::from_fn(|axis, _| cell[axis] as f64 + within(axis)));
            let off = |k: usize| place - sites[k].place;
            let nearest = near.iter().copied();
            let nearest = nearest.min_by(|&a, &b| off(a).norm_squared().total_cmp(&off(b).norm_squared()));
            if let Some(k) = nearest.filter(|_| is_inside(&place)) {
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
