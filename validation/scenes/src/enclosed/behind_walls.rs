//! Material behind walls when a scene is filled. A wall has one side, so that material behind it is a mistake of the file,
//! or the part that a wall cuts off a body that was drawn too large. Nothing of it is left out in silence.

use super::surfaces::NearestWall;
use crate::case::ParameterError;
use bagnold_solver::vector::Vector;

/// Command that shows the material behind walls.
const DRAW: &str = "see `bagnold show FILE.toml --picture setup.png`";

/// A site of the lattice that a body holds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Site<const D: usize> {
    /// Cell of the lattice along each axis.
    pub(super) cell: [i64; D],
    /// Place `[m]`.
    pub(super) place: Vector<D>,
    /// The body that holds it, by its place among all.
    pub(super) body: usize,
    /// The wall nearest to it, if one is near.
    pub(super) nearest: Option<NearestWall>,
}

/// Names and permissions by which material behind walls is judged.
pub(super) struct Permissions<'a> {
    /// Name of each wall, and then of each inlet, and whether material may stand on both sides of it.
    pub(super) walls: Vec<(&'a str, bool)>,
    /// Index of the first inlet among them, and the remedy for a reversed inlet.
    pub(super) inlets: (usize, &'a str),
    /// Largest share of a body that may be behind walls `[-]`.
    pub(super) most: f64,
    /// Remedy for a reversed wall.
    pub(super) turn: &'a str,
}

impl Permissions<'_> {
    /// Whether each site is behind a wall.
    ///
    /// # Errors
    /// A body of which more is behind walls than may be, or that stands on both sides of one, with the wall's name.
    pub(super) fn behind<const D: usize>(&self, sites: &[Site<D>]) -> Result<Vec<bool>, ParameterError> {
        let behind = self.nearest_behind(sites)?;
        let bodies = sites.iter().map(|site| site.body + 1).max().unwrap_or(0);
        let mut counts = vec![(0_usize, vec![0_usize; self.walls.len()]); bodies];
        for (site, wall) in sites.iter().zip(&behind) {
            let (all, of_walls) = &mut counts[site.body];
            *all += 1;
            if let Some(wall) = wall {
                of_walls[*wall] += 1;
            }
        }
        for (body, (all, of_walls)) in counts.iter().enumerate() {
            let share = of_walls.iter().sum::<usize>() as f64 / *all as f64;
            let worst = (0..of_walls.len()).max_by_key(|&wall| of_walls[wall]);
            if let Some(wall) = worst.filter(|_| share > self.most) {
                return Err(self.too_much(body, wall, share));
            }
        }
        Ok(behind.into_iter().map(|wall| wall.is_some()).collect())
    }

    /// The wall that each site is behind of, if any: a site is behind a wall that it is near to, or where it stands together with
    /// others that are, farther from the wall than that is thick. Of a wall that may have material on both sides it is behind where it
    /// is near only. Sites are sorted by their cells, the last axis first.
    fn nearest_behind<const D: usize>(&self, sites: &[Site<D>]) -> Result<Vec<Option<usize>>, ParameterError> {
        let key = |cell: &[i64; D]| std::array::from_fn::<i64, D, _>(|axis| cell[D - 1 - axis]);
        let find = |cell: &[i64; D]| sites.binary_search_by_key(&key(cell), |site| key(&site.cell)).ok();
        let mut behind: Vec<Option<usize>> =
            sites.iter().map(|site| site.nearest.filter(|wall| wall.distance < 0.0).map(|wall| wall.wall)).collect();
        let mut reached: Vec<usize> =
            (0..sites.len()).filter(|&index| behind[index].is_some_and(|wall| !self.walls[wall].1)).collect();
        while let Some(index) = reached.pop() {
            let site = &sites[index];
            for (axis, step) in (0..D).flat_map(|axis| [(axis, -1), (axis, 1)]) {
                let mut cell = site.cell;
                cell[axis] += step;
                let Some(next) = find(&cell).filter(|&next| behind[next].is_none()) else { continue };
                match (sites[next].nearest, site.nearest, behind[index]) {
                    (None, _, wall) => {
                        behind[next] = wall;
                        reached.push(next);
                    }
                    // what is far behind a wall goes on to the front of one
                    (Some(_), None, Some(wall)) => return Err(self.both_sides(site.body, wall)),
                    _ => {}
                }
            }
        }
        Ok(behind)
    }

    fn too_much(&self, body: usize, wall: usize, share: f64) -> ParameterError {
        let name = self.walls[wall].0;
        let (removed, meant) = ((1000.0 * share).round() / 10.0, (100.0 * share).ceil() / 100.0);
        let defect = format!("{removed} % behind walls (limit {:.0} %), mostly `{name}`", 100.0 * self.most);
        let turn = if wall < self.inlets.0 { self.turn } else { self.inlets.1 };
        let remedy = if meant < 1.0 {
            format!("{turn}, shorten the body, or set `cut_at_most = {meant:.2}`")
        } else {
            format!("{turn}, or move the body")
        };
        ParameterError::field(&format!("bodies[{body}]"), defect, "", &format!("{remedy}; {DRAW}"))
    }

    fn both_sides(&self, body: usize, wall: usize) -> ParameterError {
        let defect = format!("material on both sides of the wall `{}`", self.walls[wall].0);
        let remedy = format!("{}, set its `both_sides = true`, or shorten the body; {DRAW}", self.turn);
        ParameterError::field(&format!("bodies[{body}]"), defect, "", &remedy)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sites of 1 m in a row of so many columns and rows around a wall along y at x = 0 that is 2 m thick, with the flow at
    /// positive x. Where `gap` is given, there is no wall above that row.
    fn sites(columns: std::ops::Range<i64>, rows: i64, gap: Option<i64>) -> Vec<Site<2>> {
        let cells = (0..rows).flat_map(|row| columns.clone().map(move |column| [column, row]));
        cells
            .map(|cell| {
                let place = Vector::<2>::new(cell[0] as f64 + 0.5, cell[1] as f64 + 0.5);
                let is_near = place[0].abs() < 2.0 && gap.is_none_or(|gap| cell[1] < gap);
                Site { cell, place, body: 0, nearest: is_near.then_some(NearestWall { wall: 0, distance: place[0] }) }
            })
            .collect()
    }

    fn permissions(both_sides: bool, most: f64) -> Permissions<'static> {
        Permissions { walls: vec![("bed", both_sides)], inlets: (1, ""), most, turn: "turn the wall round" }
    }

    #[test]
    fn a_body_in_front_of_its_walls_is_whole() {
        let behind = permissions(false, 0.0).behind(&sites(0..8, 4, None)).expect("nothing is behind");
        assert_eq!(behind, [false; 32]);
    }

    #[test]
    fn points_far_behind_a_wall_are_behind_it() {
        let sites = sites(-8..8, 4, None);
        let behind = permissions(false, 0.5).behind(&sites).expect("half of it");
        assert!(sites.iter().zip(&behind).all(|(site, behind)| *behind == (site.place[0] < 0.0)));
        let error = permissions(false, 0.05).behind(&sites).expect_err("too much").to_string();
        assert_eq!(
            error,
            "`bodies[0]`: 50 % behind walls (limit 5 %), mostly `bed`; turn the wall round, shorten the body, or set `cut_at_most = 0.50`; \
             see `bagnold show FILE.toml --picture setup.png`"
        );
    }

    #[test]
    fn a_body_around_the_end_of_a_wall_is_on_both_sides() {
        let around = sites(-8..8, 6, Some(4));
        let error = permissions(false, 1.0).behind(&around).expect_err("both sides").to_string();
        assert!(error.starts_with("`bodies[0]`: material on both sides of the wall `bed`; "), "{error}");
        // where that is meant, only what is near to the wall makes room for it
        let behind = permissions(true, 1.0).behind(&around).expect("meant");
        let near = |site: &Site<2>| site.nearest.is_some() && site.place[0] < 0.0;
        assert!(around.iter().zip(&behind).all(|(site, behind)| *behind == near(site)));
    }
}
