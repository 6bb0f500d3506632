//! Pairs between two sets of particles: candidates that stay valid while nothing moves far against its neighbours,
//! and from them, in every step, the pairs within reach with their kernel values.

use super::grid::Grid;
use crate::boundary::{AxisBoundary, Domain};
use crate::kernel::Kernel;
use crate::vector::Vector;
use rayon::prelude::*;

/// Particles a task of a parallel loop has at least.
pub(super) const LEAST_TASK: usize = 512;

/// Pairs of targets with sources, each target's in a row of its own; all rows are equally long.
#[derive(Debug, Default)]
pub(super) struct Pairs<const D: usize> {
    stride: usize,
    /// Candidates of every target, and how many there are.
    candidate: Vec<u32>,
    candidates: Vec<u32>,
    /// Pairs within reach of every target, and how many there are.
    entry: Vec<Pair<D>>,
    count: Vec<u32>,
    /// Candidates as they are found, before the rows are known to be long enough.
    found: Vec<u32>,
}

/// One pair of a target a with a source b.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair<const D: usize> {
    /// Index of the source.
    pub(super) source: u32,
    /// x_a − x_b of the nearest images `[m]`.
    pub(super) separation: Vector<D>,
    /// |x_a − x_b|² `[m²]`.
    pub(super) distance_squared: f64,
    /// W `[1/m^D]`.
    pub(super) value: f64,
    /// F = (1/r) dW/dr `[1/m^(D+2)]`, never positive.
    pub(super) gradient: f64,
}

/// The separation of two particles by the shortest way.
#[derive(Debug, Clone, Copy)]
pub(super) struct Periods<const D: usize> {
    length: Vector<D>,
    inverse: Vector<D>,
}

impl<const D: usize> Periods<D> {
    pub(super) fn of(domain: &Domain<D>) -> Self {
        let length = Vector::from_fn(|axis, _| match domain.axes[axis] {
            AxisBoundary::Periodic { lower, upper } => upper - lower,
            AxisBoundary::Open | AxisBoundary::Mirror { .. } => 0.0,
        });
        Self { length, inverse: length.map(|l| if l > 0.0 { 1.0 / l } else { 0.0 }) }
    }

    #[inline(always)]
    fn shortest(&self, mut separation: Vector<D>) -> Vector<D> {
        for axis in 0..D {
            let turns = separation[axis] * self.inverse[axis];
            let whole = f64::from(i32::from(turns > 0.5) - i32::from(turns < -0.5));
            separation[axis] -= whole * self.length[axis];
        }
        separation
    }
}

/// Whether the sources are the targets themselves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Sources {
    /// The same particles: none is its own neighbour.
    Same,
    /// Others.
    Other,
}

impl<const D: usize> Pairs<D> {
    /// Finds all candidates within `radius` `[m]`.
    pub(super) fn search(
        &mut self,
        targets: &[Vector<D>],
        sources: &[Vector<D>],
        which: Sources,
        grid: &Grid<D>,
        periods: &Periods<D>,
        radius: f64,
    ) {
        self.found.clear();
        self.candidates.clear();
        for (index, target) in targets.iter().enumerate() {
            let before = self.found.len();
            grid.visit_near(target, |source| {
                let separation = periods.shortest(target - sources[source as usize]);
                let itself = which == Sources::Same && source as usize == index;
                if !itself && separation.norm_squared() < radius * radius {
                    self.found.push(source);
                }
            });
            // in order of the sources: neighbours in memory, and the factors of a row wait for the row before it last
            self.found[before..].sort_unstable();
            self.candidates.push((self.found.len() - before) as u32);
        }
        let longest = self.candidates.iter().copied().max().unwrap_or(0).max(1) as usize;
        if longest > self.stride {
            // room for more, so that rows do not grow by one place at a time
            self.stride = longest + longest / 4 + 1;
            self.found.reserve((targets.len() * self.stride).saturating_sub(self.found.len()));
        }
        self.count.resize(targets.len(), 0);
        self.candidate.resize(targets.len() * self.stride, 0);
        let none = Pair { source: 0, separation: Vector::zeros(), distance_squared: 0.0, value: 0.0, gradient: 0.0 };
        self.entry.resize(targets.len() * self.stride, none);
        let mut found = self.found.as_slice();
        for (row, &count) in self.candidate.chunks_mut(self.stride).zip(&self.candidates) {
            let (this, after) = found.split_at(count as usize);
            row[..count as usize].copy_from_slice(this);
            found = after;
        }
    }

    /// Measures the candidates and keeps those within the kernel's reach.
    pub(super) fn measure(
        &mut self,
        targets: &[Vector<D>],
        sources: &[Vector<D>],
        periods: &Periods<D>,
        kernel: &Kernel<D>,
    ) {
        let reach_squared = kernel.support() * kernel.support();
        (
            self.entry.par_chunks_mut(self.stride),
            self.candidate.par_chunks(self.stride),
            &self.candidates,
            &mut self.count,
            targets,
        )
            .into_par_iter()
            .with_min_len(LEAST_TASK)
            .for_each(|(row, candidate, &candidates, count, target)| {
                let mut near = 0;
                for &source in &candidate[..candidates as usize] {
                    let separation = periods.shortest(target - sources[source as usize]);
                    let distance_squared = separation.norm_squared();
                    // written always and counted if near: no branch that the processor would guess wrong;
                    // a row is as long as its candidates, and the last place is written last
                    row[near] = Pair { source, separation, distance_squared, value: 0.0, gradient: 0.0 };
                    near += usize::from(distance_squared < reach_squared);
                }
                for pair in &mut row[..near] {
                    pair.value = kernel.value(pair.distance_squared);
                    pair.gradient = kernel.gradient_weight(pair.distance_squared, 1.0);
                }
                *count = near as u32;
            });
    }

    /// The pairs of a target.
    #[inline(always)]
    pub(super) fn of(&self, target: usize) -> &[Pair<D>] {
        let start = target * self.stride;
        &self.entry[start..start + self.count[target] as usize]
    }

    /// Length of a row, in arrays that run parallel to the pairs too.
    pub(super) fn stride(&self) -> usize {
        self.stride
    }
}
