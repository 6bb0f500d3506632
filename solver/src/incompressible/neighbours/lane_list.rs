//! Candidates within a phase in groups of eight particles, one a lane: chunk k of a group holds the k-th candidate of each.
//!
//! Candidates that are within reach at the search come first, those within the skin behind them: what a step reads of a
//! group ends soon after its last pair within reach. Rows shorter than the longest of their group are padded, and what a
//! pass finds there is masked by the number of candidates.

use super::{Grid, LEAST_GROUPS, Periods};
use crate::lanes::algebra::dot;
use crate::lanes::{CheckedIndices, InstructionSet, LANES, LaneChunks, LanePass, Lanes};
use crate::parallel::prelude::*;
use crate::run::ForeignState;
use crate::vector::Vector;
use serde::{Deserialize, Serialize};

/// Candidates of a set of targets among sources.
#[derive(Debug)]
pub struct LaneList<const D: usize> {
    /// Chunks from one group to the next.
    pub(crate) stride: usize,
    pub(crate) columns: CheckedIndices,
    /// Candidates of every target; none in lanes that are left.
    count: Vec<u32>,
    /// Candidates of the longest row of every group.
    width: Vec<u32>,
    pub(crate) targets: usize,
    /// Searches and restorations, by which others see that the list has changed.
    pub(crate) changes: u64,
    /// Coordinates of the sources in the order of their cells, and their indices, with room for eight behind them.
    coordinates: [Vec<f64>; D],
    index: Vec<u32>,
    /// Candidates of one target for every task: those within reach, and those within the skin.
    found: Vec<u32>,
    pub(crate) set: InstructionSet,
}

/// Whether the sources are the targets themselves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sources {
    /// The same particles: none is its own neighbour.
    Same,
    /// Other particles, such as those of the other phase.
    Other,
}

/// A list as it is saved.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(crate) struct SavedList {
    stride: usize,
    columns: CheckedIndices,
    count: Vec<u32>,
}

impl<const D: usize> LaneList<D> {
    pub(crate) fn new() -> Self {
        Self {
            stride: LANES,
            columns: CheckedIndices::default(),
            count: Vec::new(),
            width: Vec::new(),
            targets: 0,
            changes: 0,
            coordinates: std::array::from_fn(|_| Vec::new()),
            index: Vec::new(),
            found: Vec::new(),
            set: InstructionSet::best(),
        }
    }

    pub(crate) fn save(&self) -> SavedList {
        SavedList { stride: self.stride, columns: self.columns.clone(), count: self.count.clone() }
    }

    /// Restores a saved list, given its numbers of targets and sources.
    pub(crate) fn restore(&mut self, saved: SavedList, targets: usize, sources: usize) -> Result<(), ForeignState> {
        let SavedList { stride, columns, count } = saved;
        let groups = targets.div_ceil(LANES);
        ForeignState::check("rows of candidates", count.len(), groups * LANES)?;
        ForeignState::check("chunks of candidates", columns.len(), groups.saturating_mul(stride))?;
        ForeignState::check("sources of candidates", columns.bound(), sources.max(1))?;
        let whole = stride > 0 && count.iter().all(|&count| count as usize <= stride);
        ForeignState::check("whole lists of candidates", usize::from(whole), 1)?;
        self.width.clear();
        self.width.extend(count.as_chunks::<LANES>().0.iter().map(longest));
        (self.stride, self.columns, self.count, self.targets) = (stride, columns, count, targets);
        self.changes += 1;
        Ok(())
    }

    /// Finds all candidates within `reach` and `skin` `[m]`.
    #[expect(clippy::too_many_arguments, reason = "what a search is between, and how far it goes")]
    pub fn search(
        &mut self,
        targets: &[Vector<D>],
        sources: &[Vector<D>],
        which: Sources,
        grid: &Grid<D>,
        periods: &Periods<D>,
        reach: f64,
        skin: f64,
    ) {
        self.sort(sources, grid);
        self.targets = targets.len();
        let groups = targets.len().div_ceil(LANES);
        self.count.clear();
        self.count.resize(groups * LANES, 0);
        self.width.resize(groups, 0);
        loop {
            let Self { stride, columns, count, width, coordinates, index, found, set, .. } = self;
            let (stride, coordinates, index) = (*stride, &*coordinates, &*index);
            let room = 2 * (stride + LANES);
            found.resize(groups.div_ceil(LEAST_GROUPS) * room, 0);
            columns.refill(sources.len().max(1), |chunks| {
                chunks.resize(groups * stride, [0; LANES]);
                let chunks = chunks.par_chunks_mut(stride * LEAST_GROUPS);
                let rows = (count.par_chunks_mut(LANES * LEAST_GROUPS), width.par_chunks_mut(LEAST_GROUPS));
                (chunks, rows, found.par_chunks_mut(room)).enumerate().for_each(
                    |(task, (chunks, (count, width), found))| {
                        let first = task * LEAST_GROUPS * LANES;
                        let list = Sorted { targets, which, grid, periods, reach, skin, coordinates, index };
                        set.run(Fill { list, stride, first, chunks, count, width, found });
                    },
                );
            });
            let longest = self.width.iter().copied().max().unwrap_or(0) as usize;
            if longest <= stride {
                break;
            }
            // room for more, so that rows do not grow by one place at a time
            self.stride = longest + longest / 4 + 1;
        }
        self.changes += 1;
    }

    fn sort(&mut self, sources: &[Vector<D>], grid: &Grid<D>) {
        self.index.clear();
        self.index.extend_from_slice(&grid.index);
        for (axis, coordinates) in self.coordinates.iter_mut().enumerate() {
            coordinates.clear();
            coordinates.extend(self.index.iter().map(|&source| sources[source as usize][axis]));
            coordinates.extend([0.0; LANES]);
        }
        self.index.extend([0; LANES]);
    }

    /// The chunks of a group.
    #[inline(always)]
    pub(crate) fn group(&self, group: usize) -> LaneChunks<'_> {
        self.first_of(group, self.width[group] as usize)
    }

    /// The first few chunks of a group.
    #[inline(always)]
    pub(crate) fn first_of(&self, group: usize, chunks: usize) -> LaneChunks<'_> {
        let first = group * self.stride;
        self.columns.part(first..first + chunks)
    }

    /// The number of candidates in every lane of a group.
    #[inline(always)]
    pub(crate) fn counts<V: Lanes>(&self, group: usize) -> V {
        let mut counts = [0.0; LANES];
        for (count, &candidates) in counts.iter_mut().zip(&self.count[group * LANES..]) {
            *count = f64::from(candidates);
        }
        V::load(&counts)
    }

    /// The candidates of a target.
    #[inline(always)]
    pub fn of(&self, target: usize) -> impl Iterator<Item = usize> {
        let (group, lane) = (target / LANES, target % LANES);
        let chunks = self.first_of(group, self.count[target] as usize).raw();
        chunks.iter().map(move |chunk| chunk[lane] as usize)
    }
}

fn longest(counts: &[u32; LANES]) -> u32 {
    counts.iter().fold(0, |most, &count| most.max(count))
}

/// Inputs of a search.
struct Sorted<'a, const D: usize> {
    targets: &'a [Vector<D>],
    which: Sources,
    grid: &'a Grid<D>,
    periods: &'a Periods<D>,
    reach: f64,
    skin: f64,
    coordinates: &'a [Vec<f64>; D],
    index: &'a [u32],
}

impl<const D: usize> Sorted<'_, D> {
    /// The candidates of a target, packed into `near` and `far` as far as these go less eight; how many there are of each.
    #[inline(always)]
    fn find<V: Lanes>(&self, a: usize, near: &mut [u32], far: &mut [u32]) -> (usize, usize) {
        let target = &self.targets[a];
        let excluded = if self.which == Sources::Same { a as u32 } else { u32::MAX };
        let radius = self.reach + self.skin;
        let (reach_squared, radius_squared) = (V::splat(self.reach * self.reach), V::splat(radius * radius));
        let room = near.len() - LANES;
        let (mut of_near, mut of_far) = (0, 0);
        let (stretches, number) = self.grid.stretches(target);
        for &(start, end) in &stretches[..number] {
            for place in (start..end).step_by(LANES) {
                let mut separation = [V::splat(0.0); D];
                for axis in 0..D {
                    separation[axis] = V::splat(target[axis]) - V::load(eight(&self.coordinates[axis], place));
                }
                let separation = self.periods.shortest(separation);
                let square = dot(&separation, &separation);
                let left = end - place;
                let inside: u32 = if left < LANES { (1 << left) - 1 } else { u32::MAX };
                let all = square.less_mask(radius_squared) & inside;
                if all == 0 {
                    continue;
                }
                let within = square.less_mask(reach_squared);
                let indices = eight(self.index, place);
                of_near += V::pack(indices, all & within, excluded, eight_mut(near, of_near.min(room)));
                of_far += V::pack(indices, all & !within, excluded, eight_mut(far, of_far.min(room)));
            }
        }
        (of_near, of_far)
    }
}

/// Eight values from a place on, behind which there are as many.
#[inline(always)]
fn eight<T>(values: &[T], place: usize) -> &[T; LANES] {
    let Some(eight) = values[place..].first_chunk() else { unreachable!("there is room for eight behind the last") };
    eight
}

#[inline(always)]
fn eight_mut(values: &mut [u32], place: usize) -> &mut [u32; LANES] {
    let Some(eight) = values[place..].first_chunk_mut() else {
        unreachable!("there is room for eight behind the last")
    };
    eight
}

/// The rows of some groups.
struct Fill<'a, const D: usize> {
    list: Sorted<'a, D>,
    stride: usize,
    /// The first target.
    first: usize,
    chunks: &'a mut [[u32; LANES]],
    count: &'a mut [u32],
    width: &'a mut [u32],
    found: &'a mut [u32],
}

impl<const D: usize> LanePass for Fill<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Self { list, stride, first, chunks, count, width, found } = self;
        let (near, far) = found.split_at_mut(stride + LANES);
        for group in 0..width.len() {
            let chunks = &mut chunks[group * stride..(group + 1) * stride];
            let mut most = 0;
            for lane in 0..LANES {
                let a = first + group * LANES + lane;
                if a >= list.targets.len() {
                    break;
                }
                let (of_near, of_far) = list.find::<V>(a, near, far);
                let candidates = of_near + of_far;
                count[group * LANES + lane] = candidates as u32;
                most = most.max(candidates);
                if candidates <= stride {
                    for k in 0..of_near {
                        chunks[k][lane] = near[k];
                    }
                    for k in 0..of_far {
                        chunks[of_near + k][lane] = far[k];
                    }
                }
            }
            width[group] = most as u32;
            for lane in 0..LANES {
                let own = (first + group * LANES + lane).min(list.targets.len() - 1) as u32;
                let padding = if list.which == Sources::Same { own } else { 0 };
                for k in count[group * LANES + lane] as usize..most.min(stride) {
                    chunks[k][lane] = padding;
                }
            }
        }
    }
}
