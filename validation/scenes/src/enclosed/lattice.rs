//! The lattices whose sites bodies are filled with: the common one through the origin, and one of its own for each box that the
//! common one does not fit, so that a box has its own mass whatever its sides and the spacing are.

use super::setting::SceneBody;
use super::sides::SceneSides;
use bagnold_solver::vector::Vector;

/// Distance of a face from a multiple of the spacing that is taken for none, in spacings `[-]`.
const ON_THE_LATTICE: f64 = 1e-6;

/// Sites in the middles of cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SiteLattice<const D: usize> {
    /// A corner of a cell `[m]`.
    origin: Vector<D>,
    /// Edges of a cell along the axes `[m]`.
    edges: Vector<D>,
}

impl<const D: usize> SiteLattice<D> {
    /// Common lattice: cubes of an edge `[m]` around the origin.
    pub(super) fn common(spacing: f64) -> Self {
        Self { origin: Vector::zeros(), edges: Vector::repeat(spacing) }
    }

    /// Whole cells that fill a box, as near to a spacing `[m]` as they can be; none where the common lattice does so, and for a
    /// box thinner than two spacings, which is no body of particles.
    ///
    /// The cells of a box of two spacings are stretched by less than 25 % to that, from 5.5 spacings on by less than 10 %.
    pub(super) fn of_box((lower, upper): (Vector<D>, Vector<D>), spacing: f64) -> Option<Self> {
        let is_multiple = |coordinate: f64| {
            let cells = coordinate / spacing;
            (cells - cells.round()).abs() <= ON_THE_LATTICE
        };
        let mut own = Self::common(spacing);
        for axis in 0..D {
            let length = upper[axis] - lower[axis];
            if length < (2.0 - ON_THE_LATTICE) * spacing {
                return None;
            }
            if !(is_multiple(lower[axis]) && is_multiple(upper[axis])) {
                own.origin[axis] = lower[axis];
                own.edges[axis] = length / (length / spacing).round();
            }
        }
        (own != Self::common(spacing)).then_some(own)
    }

    /// The shortest edge of a cell `[m]`.
    pub(super) fn shortest(&self) -> f64 {
        self.edges.min()
    }

    /// Mass `[kg]` of a cell, per metre in the plane, at a density `[kg/m³]`.
    pub(super) fn mass(&self, density: f64) -> f64 {
        self.edges.iter().fold(density, |mass, edge| mass * edge)
    }

    /// Cells that cover a box, and their middles `[m]`; the first axis runs fastest.
    pub(super) fn sites(self, (lower, upper): (Vector<D>, Vector<D>)) -> impl Iterator<Item = ([i64; D], Vector<D>)> {
        let cells = |corner: Vector<D>| -> [i64; D] {
            std::array::from_fn(|axis| ((corner[axis] - self.origin[axis]) / self.edges[axis]).floor() as i64)
        };
        let (first, last) = (cells(lower), cells(upper));
        let is_empty = (0..D).any(|axis| first[axis] > last[axis]);
        std::iter::successors((!is_empty).then_some(first), move |cells| {
            let mut next = *cells;
            for axis in 0..D {
                if next[axis] < last[axis] {
                    next[axis] += 1;
                    return Some(next);
                }
                next[axis] = first[axis];
            }
            None
        })
        .map(move |cells| (cells, self.middle(&cells)))
    }

    /// Middle of a cell `[m]`.
    pub(super) fn middle(&self, cell: &[i64; D]) -> Vector<D> {
        self.place(&Vector::from(cell.map(|edge| edge as f64 + 0.5)))
    }

    /// Place of coordinates in edges of cells `[m]`.
    pub(super) fn place(&self, coordinates: &Vector<D>) -> Vector<D> {
        self.origin + coordinates.component_mul(&self.edges)
    }
}

/// Places of all bodies by their lattices between some sides: those on the common one first, then one after the other those on their
/// own.
pub(super) fn groups<const D: usize>(
    bodies: &[impl SceneBody<D>],
    sides: &impl SceneSides<D>,
    spacing: f64,
) -> Vec<(SiteLattice<D>, Vec<usize>)> {
    let (mut common, mut own) = (Vec::new(), Vec::new());
    for (number, body) in bodies.iter().enumerate() {
        let fitted = body.is_box().then(|| SiteLattice::of_box(sides.clip(body.extent()), spacing)).flatten();
        match fitted {
            Some(lattice) => own.push((lattice, vec![number])),
            None => common.push(number),
        }
    }
    if !common.is_empty() {
        own.insert(0, (SiteLattice::common(spacing), common));
    }
    own
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_sites_of_a_box_run_along_its_first_axis() {
        let corners = (Vector::<3>::new(-0.1, 0.0, 0.25), Vector::<3>::new(0.15, 0.12, 0.32));
        let sites: Vec<[f64; 3]> =
            SiteLattice::common(0.1).sites(corners).map(|(_, site)| (site * 20.0).map(f64::round).into()).collect();
        let row = |y, z| [[-1.0, y, z], [1.0, y, z], [3.0, y, z]];
        assert_eq!(sites, [row(1.0, 5.0), row(3.0, 5.0), row(1.0, 7.0), row(3.0, 7.0)].concat());
        let none = super::super::shapes::around::<2>([]);
        assert_eq!(SiteLattice::common(0.1).sites(none).count(), 0);
    }

    #[test]
    fn a_box_on_the_lattice_keeps_it_and_another_stretches_its_cells() {
        let of_box = |lower: [f64; 2], upper: [f64; 2]| SiteLattice::of_box((lower.into(), upper.into()), 0.0025);
        assert_eq!(of_box([-0.1, 0.0], [0.1, 0.03]), None, "0.03/0.0025 is 12 to rounding");
        let taller = of_box([0.0, 0.0], [0.1, 0.03125]).expect("12.5 rows");
        assert!((taller.edges[1] - 0.03125 / 13.0).abs() < 1e-15 && taller.edges[0] == 0.0025, "{taller:?}");
        let shifted = of_box([0.0, 0.001], [0.1, 0.031]).expect("shifted");
        assert!((shifted.origin[1] - 0.001).abs() < 1e-15 && (shifted.edges[1] - 0.0025).abs() < 1e-15, "{shifted:?}");
        assert_eq!(of_box([0.001, 0.001], [0.1, 0.003]), None, "thinner than a spacing");
        for length in [2.2, 2.5, 3.49, 5.5, 7.5, 31.2] {
            let fitted = of_box([0.0, 0.0], [0.0025 * length, 0.03]).expect("no whole number");
            let stretched = (fitted.edges[0] / 0.0025 - 1.0).abs();
            assert!(stretched < if length < 5.5 { 0.25 } else { 0.1 }, "{length} spacings: {stretched}");
        }
    }
}
