//! How far a heap reaches: its thickness in rows of grains, and a toe of few rows by its mass.
//!
//! Every particle is a cell as wide as it is high, (m/ρ)^(1/D) along each axis. The bed under a heap is sorted by how many
//! cells stand on it: A(t) is the length (in space the area) of the bed that carries a thickness t or more, from the
//! thickest place outwards, and A is the place of the front at the thickness t, since a heap falls towards its front.
//! Where two rows end beside each other the thickness jumps by a row, so that A is read half a row below each whole number
//! of rows, and linearly between.
//!
//! A toe of one to three rows is not resolved: its grains lie with gaps between them, the farther the coarser they are,
//! and the place of the outermost ones is that of single grains. What is known of such a toe is its mass. It therefore
//! counts as a wedge (in space as a ring with the section of a wedge) that begins where the heap has four rows, and has the
//! volume of all that lies there in fewer. In space, where a ring holds many grains, it begins at two rows. A wedge of grains and a steep face thereby keep their place at every spacing.

use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::Snapshot;
use std::f64::consts::{FRAC_PI_4, PI};

/// Rows from which on a place of a heap is resolved, in the plane and in space.
const RESOLVED_ROWS: [usize; 2] = [4, 2];
/// Length of bare bed beyond which grains no longer belong to the heap, in spacings `[-]`.
const GAP: f64 = 2.0;
/// Parts of a spacing along each axis in which the bed of a heap in space is sampled: its cells end at curved fronts.
const PARTS: f64 = 4.0;
/// Most of them along an axis.
const MOST_PARTS: f64 = 4000.0;
/// Most rows that are told apart.
const MOST_ROWS: f64 = 1e6;

/// A piece of the bed and what stands on it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Patch {
    /// Distance of its inner end from the symmetry plane or axis `[m]`.
    place: f64,
    /// Length in the plane `[m]`, area in space `[m²]`.
    size: f64,
    /// Thickness of what stands on it `[m]`.
    thickness: f64,
}

/// The part of a heap between its thickest place and its front.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Toe {
    /// Spacing of the particles `[m]`.
    spacing: f64,
    /// Whether the heap is round.
    is_round: bool,
    /// The thickest place `[m]`; lengths count from it.
    start: f64,
    /// Rows from which on it is resolved, at most half of what a low heap has.
    resolved: usize,
    /// Sizes that carry a number of rows, from one row on, in falling order.
    sizes: Vec<f64>,
    /// Length of the wedge that begins where the heap is resolved `[m]`.
    wedge: f64,
}

impl Toe {
    /// The toe of what a snapshot shows beyond `start` `[m]`, where it is `height` `[m]` thick, up to the bed's end `[m]`.
    pub(super) fn of<const D: usize>(snapshot: &Snapshot<D>, start: f64, height: f64, bed_end: f64) -> Self {
        let cells: Vec<(Vector<D>, f64)> = snapshot
            .position
            .iter()
            .zip(snapshot.mass.iter().zip(&snapshot.density))
            .map(|(position, (mass, density))| (*position, libm::pow(mass / density, 1.0 / D as f64)))
            .filter(|(position, width)| position.iter().all(|x| x.is_finite()) && *width > 0.0 && width.is_finite())
            .collect();
        let spacing = cells.iter().map(|cell| cell.1).sum::<f64>() / cells.len().max(1) as f64;
        let is_round = D == 3;
        let start = if is_round { 0.0 } else { start };
        let mut patches =
            if is_round { patches_of_quarter(&cells, spacing, bed_end) } else { patches_of_line(&cells, start) };
        patches.retain(|patch| patch.place < bed_end);
        let end = end_of_heap(&mut patches, start, GAP * spacing);
        patches.retain(|patch| patch.place < end);
        Self::of_patches(&patches, spacing, start, height, is_round)
    }

    fn of_patches(patches: &[Patch], spacing: f64, start: f64, height: f64, is_round: bool) -> Self {
        let thickest = patches.iter().fold(0.0_f64, |most, patch| most.max(patch.thickness));
        let most = if thickest > 0.0 { (thickest / spacing + 0.5).min(MOST_ROWS) } else { 0.0 };
        let mut sizes = vec![0.0; most as usize];
        for patch in patches {
            let rows = (patch.thickness / spacing + 0.5) as usize;
            sizes.iter_mut().take(rows).for_each(|size| *size += patch.size);
        }
        let rows = (height / spacing).round().max(1.0) as usize;
        let resolved = RESOLVED_ROWS[usize::from(is_round)].min(rows.div_ceil(2));
        let mut toe = Self { spacing, is_round, start, resolved, sizes, wedge: 0.0 };
        let least = toe.thickness(resolved);
        let volume = patches.iter().filter(|patch| patch.thickness < least).map(|patch| patch.size * patch.thickness);
        toe.wedge = toe.length_of_wedge(volume.sum());
        toe
    }

    /// Thickness at which a number of rows is read `[m]`.
    fn thickness(&self, rows: usize) -> f64 {
        (rows as f64 - 0.5) * self.spacing
    }

    /// Distance up to which a number of rows lies `[m]`.
    fn place(&self, rows: usize) -> f64 {
        let size = self.sizes.get(rows - 1).copied().unwrap_or(0.0);
        if self.is_round { (size / FRAC_PI_4).sqrt() } else { self.start + size }
    }

    /// Length of a wedge that begins where the heap is resolved, at k rows, from the volume of what lies in fewer `[m]`: its
    /// section is H L/2 in the plane, in space the ring (π/2) H (r L/2 + L²/6) beyond a radius r, with H the thickness at which
    /// k rows are read. Whole rows of such a wedge end at A(½), A(3/2), …, and have k (k − 1)/(k − ½)² of its volume.
    fn length_of_wedge(&self, volume: f64) -> f64 {
        let (height, k) = (self.thickness(self.resolved), self.resolved as f64);
        let whole_rows = k * (k - 1.0) / ((k - 0.5) * (k - 0.5));
        // a heap of one row has no toe of fewer
        let volume = if self.resolved > 1 { volume / whole_rows } else { 0.0 };
        if height <= 0.0 {
            // nothing is there
            0.0
        } else if self.is_round {
            let half = 0.5 * self.place(self.resolved);
            3.0 * ((half * half + 4.0 * volume / (3.0 * PI * height)).sqrt() - half)
        } else {
            2.0 * volume / height
        }
    }

    /// Distance of the front at a thickness `[m]` from the symmetry plane or axis `[m]`.
    pub(super) fn front(&self, thickness: f64) -> f64 {
        let least = self.thickness(self.resolved);
        if self.sizes.is_empty() {
            return self.start;
        }
        if thickness < least {
            return self.place(self.resolved) + self.wedge * (1.0 - thickness / least);
        }
        let rows = ((thickness / self.spacing + 0.5) as usize).max(self.resolved);
        let share = thickness / self.spacing + 0.5 - rows as f64;
        self.place(rows) + share * (self.place(rows + 1) - self.place(rows))
    }

    /// How far the front moves where the thickness is known to a share of a row only `[m]`: the row over the slope of the toe.
    pub(super) fn length_of_row(&self) -> f64 {
        let height = self.thickness(self.resolved);
        if height > 0.0 { self.wedge * self.spacing / height } else { 0.0 }
    }
}

/// Pieces of the bed of a planar heap from a place on, between the ends of neighbouring cells.
fn patches_of_line<const D: usize>(cells: &[(Vector<D>, f64)], start: f64) -> Vec<Patch> {
    let mut ends: Vec<(f64, f64)> = Vec::with_capacity(2 * cells.len());
    for (position, width) in cells {
        let (lower, upper) = (position[0] - 0.5 * width, position[0] + 0.5 * width);
        // what reaches through the symmetry plane stands on this side as its image
        if lower < 0.0 {
            ends.extend([(0.0, *width), (-lower, -width)]);
        }
        ends.extend([(lower.max(0.0), *width), (upper.max(0.0), -width)]);
    }
    ends.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut thickness = 0.0;
    let mut patches = Vec::with_capacity(ends.len());
    for pair in ends.windows(2) {
        thickness += pair[0].1;
        let place = pair[0].0.max(start);
        let size = pair[1].0 - place;
        if size > 0.0 {
            patches.push(Patch { place, size, thickness });
        }
    }
    patches
}

/// Pieces of the bed of a quarter of a round heap: squares of a part of a spacing, by their distance from the axis.
fn patches_of_quarter<const D: usize>(cells: &[(Vector<D>, f64)], spacing: f64, bed_end: f64) -> Vec<Patch> {
    let far = cells.iter().fold(0.0_f64, |far, (x, width)| far.max(x[0] + width).max(x[D - 1] + width)).min(bed_end);
    let part = (spacing / PARTS).max(far / MOST_PARTS);
    let side = (far / part).ceil().clamp(1.0, MOST_PARTS) as usize;
    let mut thickness = vec![0.0; side * side];
    // centres of squares lie half a part off the planes, on either side of which a cell stands
    let covered = |place: f64, width: f64| {
        let least = ((place - 0.5 * width) / part - 0.5).ceil() as i64;
        let most = ((place + 0.5 * width) / part - 0.5).floor() as i64;
        (least..=most).map(|k| if k < 0 { -k - 1 } else { k } as usize).filter(move |k| *k < side)
    };
    for (position, width) in cells {
        for row in covered(position[D - 1], *width) {
            for column in covered(position[0], *width) {
                thickness[row * side + column] += width;
            }
        }
    }
    let centre = |k: usize| (k as f64 + 0.5) * part;
    let mut patches: Vec<Patch> = thickness
        .iter()
        .enumerate()
        .map(|(k, &thickness)| {
            let place = centre(k % side).hypot(centre(k / side));
            Patch { place, size: part * part, thickness }
        })
        .collect();
    patches.sort_by(|a, b| a.place.total_cmp(&b.place));
    patches
}

/// Where the first stretch of bare bed longer than a gap begins, from the first grains outwards `[m]`.
fn end_of_heap(patches: &mut [Patch], start: f64, gap: f64) -> f64 {
    let mut end = start;
    let mut has_begun = false;
    for patch in patches {
        // sums of widths that come and go leave rounding behind
        if patch.thickness < 1e-9 * gap {
            patch.thickness = 0.0;
            continue;
        }
        if has_begun && patch.place - end > gap {
            return end;
        }
        has_begun = true;
        end = patch.place + patch.size.min(gap);
    }
    f64::INFINITY
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns of cells of a spacing, one beside the other, with as many rows as a surface asks for; what is less than a
    /// row goes to the next column, so that thin parts lie with gaps.
    fn heap(spacing: f64, end: f64, surface: impl Fn(f64) -> f64) -> Snapshot<2> {
        let mut snapshot = Snapshot::default();
        let mut left = 0.5;
        for column in 0..(end / spacing).round() as usize {
            let x = (column as f64 + 0.5) * spacing;
            left += surface(x) / spacing;
            let rows = (left + 1e-9).floor();
            left -= rows;
            for row in 0..rows as usize {
                snapshot.position.push(Vector::<2>::new(x, (row as f64 + 0.5) * spacing));
                snapshot.mass.push(2.0 * spacing * spacing);
                snapshot.density.push(2.0);
            }
        }
        snapshot
    }

    fn toe(snapshot: &Snapshot<2>, height: f64) -> Toe {
        Toe::of(snapshot, 0.0, height, 10.0)
    }

    #[test]
    fn a_column_at_rest_ends_at_its_face() {
        for spacing in [0.05, 0.025] {
            for height in [0.1, 0.5, 1.0, 3.0] {
                let toe = toe(&heap(spacing, 1.0, |_| height), height);
                for thickness in [0.02, 0.05] {
                    assert!((toe.front(thickness) - 1.0).abs() < 1e-9, "{spacing} {height} {thickness}: {toe:?}");
                }
                assert!(toe.length_of_row() < 1e-9);
            }
        }
    }

    #[test]
    fn a_wedge_has_its_fronts_at_every_spacing() {
        // 0.6 − x/5, whose toe is as flat as that of a deposit
        for spacing in [0.05, 0.025, 0.0125, 0.00625] {
            let toe = toe(&heap(spacing, 3.0, |x| (0.6 - 0.2 * x).max(0.0)), 0.6);
            for (thickness, place) in [(0.02, 2.9), (0.05, 2.75), (0.2, 2.0)] {
                let error = toe.front(thickness) - place;
                // a grain is a ninth of the wedge of fewer than four rows, and its farthest one may lie a row off
                assert!(error.abs() < 0.6 * spacing, "{spacing}, at {thickness}: {error}");
            }
            // a row over the slope
            assert!((toe.length_of_row() / (5.0 * spacing) - 1.0).abs() < 0.1, "{}", toe.length_of_row());
        }
    }

    #[test]
    fn a_toe_of_single_grains_counts_by_its_mass() {
        // a block, then a row with every second grain missing, half a row thick and 1 long: the wedge of its mass begins at
        // the block, is 3.5 rows high and therefore 49/48 · 2/7 long
        let spacing = 0.05;
        let toe = toe(&heap(spacing, 2.0, |x| if x < 1.0 { 1.0 } else { 0.5 * spacing }), 1.0);
        let length = 49.0 / 48.0 * 2.0 / 7.0;
        assert!((toe.front(0.0) - 1.0 - length).abs() < 1e-9, "{toe:?}");
        assert!((toe.front(0.02) - 1.0 - length * (1.0 - 0.02 / 0.175)).abs() < 1e-9, "{toe:?}");
    }

    #[test]
    fn grains_beyond_a_gap_and_what_lies_behind_the_thickest_place_do_not_move_the_front() {
        let spacing = 0.05;
        let mut snapshot = heap(spacing, 1.0, |_| 0.5);
        for x in [1.3, 1.35, 4.0] {
            snapshot.position.push(Vector::<2>::new(x, 0.5 * spacing));
            snapshot.mass.push(2.0 * spacing * spacing);
            snapshot.density.push(2.0);
        }
        assert!((toe(&snapshot, 0.5).front(0.02) - 1.0).abs() < 1e-9);
        // a heap that has left the back of its channel
        snapshot.position.iter_mut().for_each(|x| x[0] += 2.0);
        let toe = Toe::of(&snapshot, 2.5, 0.5, 10.0);
        assert!((toe.front(0.02) - 3.0).abs() < 1e-9, "{toe:?}");
    }

    #[test]
    fn a_cylinder_and_a_cone_have_their_radii() {
        let spacing: f64 = 0.05;
        let heap = |end: f64, surface: &dyn Fn(f64) -> f64| {
            let mut snapshot = Snapshot::<3>::default();
            let count = (end / spacing) as usize;
            for cell in 0..count * count {
                let [x, z] = [cell % count, cell / count].map(|k| (k as f64 + 0.5) * spacing);
                for row in 0..(surface(x.hypot(z)) / spacing).round() as usize {
                    snapshot.position.push(Vector::<3>::new(x, (row as f64 + 0.5) * spacing, z));
                    snapshot.mass.push(2.0 * spacing.powi(3));
                    snapshot.density.push(2.0);
                }
            }
            snapshot
        };
        let cylinder = heap(1.5, &|r| if r < 1.0 { 0.8 } else { 0.0 });
        let front = Toe::of(&cylinder, 0.0, 0.8, 10.0).front(0.02);
        assert!((front - 1.0).abs() < 0.5 * spacing, "{front}");
        let cone = heap(2.5, &|r| (0.8 - 0.4 * r).max(0.0));
        let front = Toe::of(&cone, 0.0, 0.8, 10.0).front(0.02);
        assert!((front - 1.95).abs() < 0.5 * spacing, "{front}");
    }

    #[test]
    fn nothing_reaches_nowhere() {
        let toe = Toe::of(&Snapshot::<2>::default(), 0.0, 0.0, 1.0);
        assert_eq!((toe.front(0.02), toe.length_of_row()), (0.0, 0.0));
    }
}
