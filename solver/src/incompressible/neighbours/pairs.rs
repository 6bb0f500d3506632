//! Pairs between two phases: candidates that stay valid while nothing moves far against its neighbours, and from them, in
//! every step, the pairs within reach with their kernel values.

use super::{Grid, LEAST_TASK, Periods};
use crate::kernel::Kernel;
use crate::lanes::{InstructionSet, LANES, LanePass, Lanes};
use crate::parallel::prelude::*;
use crate::run::ForeignState;
use crate::vector::Vector;
use serde::{Deserialize, Serialize};

/// Pairs of targets with sources, each target's in a row of its own; all rows are equally long.
#[derive(Debug)]
pub struct Pairs<const D: usize> {
    /// A multiple of eight.
    pub(crate) stride: usize,
    /// Candidates of every target, and how many there are.
    candidate: Vec<u32>,
    candidates: Vec<u32>,
    /// Pairs within reach of every target, and how many there are.
    entry: Vec<Pair<D>>,
    count: Vec<u32>,
    set: InstructionSet,
}

/// One pair of a target a with a source b.
#[derive(Debug, Clone, Copy)]
pub struct Pair<const D: usize> {
    /// Index of the source.
    pub source: u32,
    /// x_a − x_b of the nearest images `[m]`.
    pub separation: Vector<D>,
    /// W `[1/m^D]`.
    pub value: f64,
    /// F = (1/r) dW/dr `[1/m^(D+2)]`, never positive.
    pub gradient: f64,
}

/// Candidates as they are saved; the pairs within reach are measured anew.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct SavedPairs {
    stride: usize,
    candidate: Vec<u32>,
    candidates: Vec<u32>,
}

impl<const D: usize> Pairs<D> {
    pub(crate) fn save(&self) -> SavedPairs {
        let Self { stride, candidate, candidates, .. } = self;
        SavedPairs { stride: *stride, candidate: candidate.clone(), candidates: candidates.clone() }
    }

    /// Restores saved candidates, given their numbers of targets and sources.
    pub(crate) fn restore(&mut self, saved: SavedPairs, targets: usize, sources: usize) -> Result<(), ForeignState> {
        let SavedPairs { stride, candidate, candidates } = saved;
        ForeignState::check("rows of pairs", candidates.len(), targets)?;
        ForeignState::check("places for pairs", candidate.len(), targets.saturating_mul(stride))?;
        let whole = stride.is_multiple_of(LANES)
            && stride > 0
            && candidates.iter().all(|&count| count as usize <= stride)
            // a row without sources is filled with the first place
            && candidate.iter().all(|&source| (source as usize) < sources.max(1));
        ForeignState::check("whole sets of pairs", usize::from(whole), 1)?;
        (self.stride, self.candidate, self.candidates) = (stride, candidate, candidates);
        self.count.resize(targets, 0);
        self.entry.resize(targets * stride, none());
        Ok(())
    }

    pub(crate) fn new() -> Self {
        Self {
            stride: LANES,
            candidate: Vec::new(),
            candidates: Vec::new(),
            entry: Vec::new(),
            count: Vec::new(),
            set: InstructionSet::best(),
        }
    }

    /// Finds all candidates within `radius` `[m]`.
    pub fn search(
        &mut self,
        targets: &[Vector<D>],
        sources: &[Vector<D>],
        grid: &Grid<D>,
        periods: &Periods<D>,
        radius: f64,
    ) {
        self.candidates.resize(targets.len(), 0);
        self.count.resize(targets.len(), 0);
        loop {
            self.candidate.resize(targets.len() * self.stride, 0);
            (self.candidate.par_chunks_mut(self.stride), &mut self.candidates, targets)
                .with_min_len(LEAST_TASK)
                .for_each(|(row, candidates, target)| {
                    let mut found = 0;
                    grid.visit_near(target, |source| {
                        let square = periods.distance_squared(target, &sources[source as usize]);
                        // written always and counted if near: no branch that the processor would guess wrong
                        if let Some(place) = row.get_mut(found) {
                            *place = source;
                        }
                        found += usize::from(square < radius * radius);
                    });
                    *candidates = found as u32;
                    // in order of the sources: neighbours in memory, and the factors of a row wait for the row before
                    // it last
                    let filled = found.min(row.len());
                    row[..filled].sort_unstable();
                    // any source does for the rest of the last eight
                    row[filled..].fill(0);
                });
            let longest = self.candidates.iter().copied().max().unwrap_or(0) as usize;
            if longest <= self.stride {
                break;
            }
            // room for more, so that rows do not grow by one place at a time
            self.stride = (longest + longest / 4 + 1).next_multiple_of(LANES);
        }
        self.entry.resize(targets.len() * self.stride, none());
    }

    /// Measures the candidates and keeps those within the kernel's reach.
    pub fn measure(&mut self, targets: &[Vector<D>], sources: &[Vector<D>], periods: &Periods<D>, kernel: &Kernel<D>) {
        let rows = LEAST_TASK * self.stride;
        (
            self.entry.par_chunks_mut(rows),
            self.count.par_chunks_mut(LEAST_TASK),
            self.candidate.par_chunks(rows),
            self.candidates.par_chunks(LEAST_TASK),
            targets.par_chunks(LEAST_TASK),
        )
            .for_each(|(entry, count, candidate, candidates, targets)| {
                let stride = self.stride;
                self.set.run(Measure {
                    stride,
                    entry,
                    count,
                    candidate,
                    candidates,
                    targets,
                    sources,
                    periods,
                    kernel,
                });
            });
    }

    /// The pairs of a target.
    #[inline(always)]
    pub fn of(&self, target: usize) -> &[Pair<D>] {
        let start = target * self.stride;
        &self.entry[start..start + self.count[target] as usize]
    }
}

/// A place for a pair, without one.
fn none<const D: usize>() -> Pair<D> {
    Pair { source: 0, separation: Vector::zeros(), value: 0.0, gradient: 0.0 }
}

/// The pairs of some targets.
struct Measure<'a, const D: usize> {
    stride: usize,
    entry: &'a mut [Pair<D>],
    count: &'a mut [u32],
    candidate: &'a [u32],
    candidates: &'a [u32],
    targets: &'a [Vector<D>],
    sources: &'a [Vector<D>],
    periods: &'a Periods<D>,
    kernel: &'a Kernel<D>,
}

impl<const D: usize> LanePass for Measure<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let reach_squared = self.kernel.support() * self.kernel.support();
        let rows = self.entry.chunks_mut(self.stride).zip(self.candidate.chunks(self.stride));
        let targets = self.targets.iter().zip(self.candidates).zip(self.count);
        for ((row, candidate), ((target, &candidates), count)) in rows.zip(targets) {
            let mut left = candidates as usize;
            let mut near = 0;
            for eight in candidate.as_chunks::<LANES>().0 {
                if left == 0 {
                    break;
                }
                let (separation, square) = self.periods.separations::<V>(target, self.sources, eight);
                let value = self.kernel.value(square).to_array();
                let gradient = self.kernel.gradient_weight(square, V::splat(1.0)).to_array();
                let square = square.to_array();
                let mut arms = [[0.0; LANES]; D];
                for axis in 0..D {
                    arms[axis] = separation[axis].to_array();
                }
                for lane in 0..left.min(LANES) {
                    let mut separation = Vector::zeros();
                    for axis in 0..D {
                        separation[axis] = arms[axis][lane];
                    }
                    // written always and counted if near: no branch that the processor would guess wrong;
                    // a row is as long as its candidates, and the last place is written last
                    row[near] = Pair { source: eight[lane], separation, value: value[lane], gradient: gradient[lane] };
                    near += usize::from(square[lane] < reach_squared);
                }
                left = left.saturating_sub(LANES);
            }
            *count = near as u32;
        }
    }
}
