//! Sparse rows in groups of eight, one row a lane: chunk k of a group holds the k-th entry of each of its rows.
//!
//! A product then loads eight coefficients at once and no sum waits for its last addition. Short rows of a group are
//! padded with zeros times their own unknown, which change nothing unless that is no number already.
//!
//! A product waits for its coefficients to come from memory. They are stored in single precision, which halves the way;
//! sums and unknowns are double. Both rows of a pair hold the same rounded number, so symmetry and balance are exact.

use crate::lanes::{CheckedIndices, InstructionSet, LANES, LaneChunks, LaneIndices, LaneNumbers, LanePass, Lanes};
use crate::parallel::prelude::*;
use crate::vector::Vector;

/// Groups that a task of a parallel fill has at least: a fill costs some ten products.
const FILLED_GROUPS: usize = 64;

/// Rows of a task of a product, a multiple of eight: less is done before another thread has woken.
pub(crate) const TASK_ROWS: usize = 2048;

/// The coefficients of a chunk, one a lane.
pub(crate) trait Coefficients: Copy + Send + Sync {
    /// The coefficients of one entry.
    type Entry: Copy;
    /// Zeros.
    const ZERO: Self;
    /// Those of a lane.
    fn entry(&self, lane: usize) -> Self::Entry;
    /// Changes those of a lane.
    fn set(&mut self, lane: usize, entry: Self::Entry);
}

/// One coefficient an entry, in single precision.
#[derive(Debug, Clone, Copy)]
#[repr(align(32))]
pub(crate) struct Single(pub(crate) [f32; LANES]);

impl Coefficients for Single {
    type Entry = f64;
    const ZERO: Self = Self([0.0; LANES]);

    #[inline(always)]
    fn entry(&self, lane: usize) -> f64 {
        f64::from(self.0[lane])
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, entry: f64) {
        self.0[lane] = entry as f32;
    }
}

/// Value of a coefficient in single precision: sums over a row are taken of these, so that row and sum agree.
#[inline(always)]
pub(crate) fn single(coefficient: f64) -> f64 {
    f64::from(coefficient as f32)
}

/// Columns and coefficients of a square operator, without its diagonal.
#[derive(Debug)]
pub(crate) struct LaneRows<C> {
    pub(crate) rows: usize,
    pub(crate) stride: usize,
    columns: CheckedIndices,
    coefficients: Vec<C>,
    /// Entries of every row, those of lanes without a row included; without padding, where rows were filled one by one.
    count: Vec<u32>,
    /// Chunks of every group.
    width: Vec<u32>,
    /// Version of the pattern that the columns come from.
    pattern: u64,
    set: InstructionSet,
}

/// A group that is being filled.
pub(crate) struct RowGroup<'a, C> {
    columns: &'a mut [[u32; LANES]],
    coefficients: &'a mut [C],
    filled: &'a mut [u32],
}

/// A row that is being filled.
pub(crate) struct Row<'a, C> {
    columns: &'a mut [[u32; LANES]],
    coefficients: &'a mut [C],
    lane: usize,
    filled: usize,
}

impl<C: Coefficients> Row<'_, C> {
    /// Adds an entry.
    #[inline(always)]
    pub(crate) fn push(&mut self, column: u32, entry: C::Entry) {
        self.columns[self.filled][self.lane] = column;
        self.coefficients[self.filled].set(self.lane, entry);
        self.filled += 1;
    }
}

impl<C: Coefficients> RowGroup<'_, C> {
    /// Lets `fill` fill the row of a lane.
    #[inline(always)]
    pub(crate) fn row<R>(&mut self, lane: usize, fill: impl FnOnce(&mut Row<'_, C>) -> R) -> R {
        let mut row = Row { columns: self.columns, coefficients: self.coefficients, lane: lane % LANES, filled: 0 };
        let result = fill(&mut row);
        self.filled[lane] = row.filled as u32;
        result
    }

    /// Pads the rows of the group to equal length, which is returned.
    fn pad(&mut self, first: usize, rows: usize) -> u32 {
        let width = self.filled.iter().copied().max().unwrap_or(0);
        for lane in 0..LANES {
            for place in self.filled[lane]..width {
                self.columns[place as usize][lane] = (first + lane).min(rows - 1) as u32;
                self.coefficients[place as usize].set(lane, C::ZERO.entry(lane));
            }
        }
        width
    }
}

impl<C: Coefficients> Default for LaneRows<C> {
    fn default() -> Self {
        Self {
            rows: 0,
            stride: 1,
            columns: CheckedIndices::default(),
            coefficients: Vec::new(),
            count: Vec::new(),
            width: Vec::new(),
            pattern: 0,
            set: InstructionSet::best(),
        }
    }
}

impl<C: Coefficients> LaneRows<C> {
    /// Fills `rows` rows of at most `stride` entries. `fill` gets the first row of a group, the group and what `beside`
    /// has for it.
    pub(crate) fn fill<S>(
        &mut self,
        rows: usize,
        stride: usize,
        beside: impl Items<Item = S>,
        fill: impl Fn(usize, &mut RowGroup<'_, C>, S) + Sync,
    ) {
        let groups = rows.div_ceil(LANES);
        (self.rows, self.stride) = (rows, stride);
        self.coefficients.resize(groups * stride, C::ZERO);
        self.width.resize(groups, 0);
        self.count.clear();
        self.count.resize(groups * LANES, 0);
        let Self { columns, coefficients, count, width, .. } = self;
        columns.refill(rows, |columns| {
            columns.resize(groups * stride, [0; LANES]);
            let chunks = (columns.par_chunks_mut(stride), coefficients.par_chunks_mut(stride));
            (chunks, count.par_chunks_mut(LANES), width, beside).enumerate().with_min_len(FILLED_GROUPS).for_each(
                |(group, ((columns, coefficients), filled, width, beside))| {
                    let mut rows_of_group = RowGroup { columns, coefficients, filled };
                    fill(group * LANES, &mut rows_of_group, beside);
                    *width = rows_of_group.pad(group * LANES, rows);
                },
            );
        });
    }

    /// Takes the columns of a pattern with `stride` chunks from one group to the next, if it is of another version than the
    /// one that was taken last; returns the coefficients, a group after the other at this stride, and the number of chunks
    /// of every group, to be filled.
    pub(crate) fn with_pattern(
        &mut self,
        (rows, stride): (usize, usize),
        columns: &CheckedIndices,
        version: u64,
    ) -> (&mut [C], &mut [u32]) {
        if self.pattern != version {
            let groups = rows.div_ceil(LANES);
            (self.rows, self.stride, self.pattern) = (rows, stride, version);
            self.columns.copy_from(columns);
            self.coefficients.resize(groups * stride, C::ZERO);
            self.width.resize(groups, 0);
            self.count.clear();
        }
        (&mut self.coefficients, &mut self.width)
    }

    /// Columns and coefficients of a row.
    #[inline(always)]
    pub(crate) fn row(&self, row: usize) -> impl Iterator<Item = (u32, C::Entry)> {
        let (first, lane) = (row / LANES * self.stride, row % LANES);
        let count = self.count.get(row).unwrap_or(&self.width[row / LANES]);
        let chunks = first..first + *count as usize;
        let columns = self.columns.part(chunks.clone()).raw().iter();
        columns.zip(&self.coefficients[chunks]).map(move |(columns, entries)| (columns[lane], entries.entry(lane)))
    }

    /// The chunks of the group of a row.
    #[inline(always)]
    pub(crate) fn group(&self, first: usize) -> Chunks<'_, C> {
        let group = first / LANES;
        let chunks = group * self.stride..group * self.stride + self.width[group] as usize;
        Chunks { columns: self.columns.part(chunks.clone()), coefficients: &self.coefficients[chunks] }
    }

    /// Runs a pass over lanes.
    pub(crate) fn run(&self, pass: impl LanePass) {
        self.set.run(pass);
    }
}

/// The chunks of a group.
pub(crate) struct Chunks<'a, C> {
    columns: LaneChunks<'a>,
    coefficients: &'a [C],
}

impl<'a, C> Iterator for Chunks<'a, C> {
    type Item = (LaneIndices<'a>, &'a C);

    #[inline(always)]
    fn next(&mut self) -> Option<Self::Item> {
        let (first, rest) = self.coefficients.split_first()?;
        self.coefficients = rest;
        Some((self.columns.next()?, first))
    }
}

/// Products of rows by two operators of the same unknowns, of which the first has the first few rows only.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TwoRows<'a> {
    pub(crate) first: &'a LaneRows<Single>,
    pub(crate) all: &'a LaneRows<Single>,
}

impl TwoRows<'_> {
    /// diagonal · u − Σ coefficient · u of the columns.
    pub(crate) fn subtract_from_diagonal<const D: usize>(
        &self,
        diagonal: &[f64],
        u: &[Vector<D>],
        product: &mut [Vector<D>],
    ) {
        product.par_chunks_mut(TASK_ROWS).enumerate().for_each(|(task, out)| {
            self.all.run(Product { rows: *self, diagonal, u, first: task * TASK_ROWS, out });
        });
    }
}

struct Product<'a, const D: usize> {
    rows: TwoRows<'a>,
    diagonal: &'a [f64],
    u: &'a [Vector<D>],
    first: usize,
    out: &'a mut [Vector<D>],
}

impl<const D: usize> LanePass for Product<'_, D> {
    #[inline(always)]
    fn run<V: Lanes>(self) {
        for (group, out) in self.out.chunks_mut(LANES).enumerate() {
            let first = self.first + group * LANES;
            let mut sums = [V::splat(0.0); D];
            if first < self.rows.first.rows {
                for (columns, coefficients) in self.rows.first.group(first) {
                    add(&mut sums, self.u, &columns, coefficients);
                }
            }
            for (columns, coefficients) in self.rows.all.group(first) {
                add(&mut sums, self.u, &columns, coefficients);
            }
            for axis in 0..D {
                let sums = sums[axis].to_array();
                for (lane, out) in out.iter_mut().enumerate() {
                    out[axis] = self.u[first + lane][axis] * self.diagonal[first + lane] - sums[lane];
                }
            }
        }
    }
}

#[inline(always)]
fn add<V: Lanes, const D: usize>(sums: &mut [V; D], u: &[Vector<D>], columns: &LaneIndices<'_>, coefficients: &Single) {
    let coefficient = V::widen(V::Single::load(&coefficients.0));
    let u = crate::lanes::gather_vectors::<V, D>(u, columns);
    for axis in 0..D {
        sums[axis] = sums[axis] + u[axis] * coefficient;
    }
}
