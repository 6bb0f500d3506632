//! A tree of boxes over facets: finds the nearest of them for the set-up, in a time that hardly grows with their number.

use super::facet::Facet;
use super::facet_fan::{self, Fan};
use super::facet_side::{FacetSide, TIE, facet_side};
use crate::vector::{Tensor, Vector};

/// Most facets of a leaf.
const LEAF: usize = 4;
/// Halvings of a triangle at most, and boxes beside two for each facet: memory.
const DEEPEST: u8 = 14;
const PIECES: usize = 1 << 20;
/// Distance over the largest coordinate by which a box may seem farther than a facet in it `[-]`: rounding.
const ROUNDING: f64 = 1e-12;

/// Boxes around facets, around pairs of boxes, and so on; in the plane they are flat. It is not generic, so that it is compiled here.
#[derive(Debug, Clone, PartialEq)]
pub struct FacetTree {
    /// Distance up to which the facets around a place are found `[m]`.
    range: f64,
    /// Distance that is nothing among the coordinates of the facets `[m]`.
    slack: f64,
    /// A box before the boxes in it.
    nodes: Vec<Node>,
    /// Places of the facets, leaf by leaf.
    facets: Vec<u32>,
    /// Fans of many triangles, to whose corners many places are nearest.
    fans: Vec<Fan>,
}

/// Three corners `[m]`; the last two are one in the plane.
type Triangle = [Vector<3>; 3];

#[derive(Debug, Clone, PartialEq)]
struct Node {
    turned: TurnedBox,
    content: Content,
}

/// A box along the axes, or along a triangle in it if that one is smaller: boxes of slivers that lie askew hold little else.
#[derive(Debug, Clone, PartialEq)]
struct TurnedBox {
    /// Directions of its edges, row by row `[-]`.
    along: Tensor<3>,
    /// Lower and upper corner along them `[m]`.
    corners: [Vector<3>; 2],
}

impl TurnedBox {
    fn of<'a>(triangles: impl Iterator<Item = &'a Triangle>, along: Tensor<3>) -> Self {
        let none = [Vector::<3>::repeat(f64::INFINITY), Vector::<3>::repeat(f64::NEG_INFINITY)];
        let corners = triangles.flatten().map(|corner| along * corner);
        Self { along, corners: corners.fold(none, |[low, high], corner| [low.inf(&corner), high.sup(&corner)]) }
    }

    fn lengths(&self) -> Vector<3> {
        self.corners[1] - self.corners[0]
    }

    /// Half of its surface `[m²]`, which orders flat ones, too.
    fn surface(&self) -> f64 {
        let [x, y, z] = self.lengths().into();
        x * y + y * z + z * x
    }
}

/// Directions along the longest edge of a triangle, across it, and normal to it `[-]`; none for a segment.
fn directions(triangle: &Triangle) -> Option<Tensor<3>> {
    let [a, b, c] = longest_first(*triangle);
    let along = (b - a).try_normalize(0.0)?;
    let across = (b - a).cross(&(c - a)).cross(&along).try_normalize(0.0)?;
    Some(Tensor::<3>::from_rows(&[along, across, along.cross(&across)].map(|row| row.transpose())))
}

/// The triangle from the start of its longest edge on.
fn longest_first([a, b, c]: Triangle) -> Triangle {
    let turns = [[a, b, c], [b, c, a], [c, a, b]];
    let length = |turn: &Triangle| (turn[1] - turn[0]).norm_squared();
    turns.into_iter().fold(turns[0], |long, turn| if length(&turn) > length(&long) { turn } else { long })
}

#[derive(Debug, Clone, PartialEq)]
enum Content {
    /// Start and end among the facets of the tree.
    Facets(u32, u32),
    /// The second of two boxes; the first follows on their own.
    Boxes(u32),
}

/// Adds the halves of a triangle's longest edges, down to a size `[m]`: the one box of a long thin triangle holds much beside it.
fn add_pieces(corners: &Triangle, size: f64, depth: u8, pieces: &mut Vec<Triangle>) {
    let [a, b, c] = *corners;
    let extent = a.sup(&b).sup(&c) - a.inf(&b).inf(&c);
    if depth == 0 || b == c || extent.amax() <= size {
        pieces.push(*corners);
        return;
    }
    let [a, b, c] = longest_first(*corners);
    let middle = (a + b) * 0.5;
    add_pieces(&[a, middle, c], size, depth - 1, pieces);
    add_pieces(&[middle, b, c], size, depth - 1, pieces);
}

impl FacetTree {
    /// The tree by which facets nearer than `range` `[m]` are found.
    #[must_use]
    pub fn new<const D: usize>(facets: &[Facet<D>], range: f64) -> Self {
        let corner = |facet: &Facet<D>, k: usize| facet_fan::of(&facet.corners[k.min(D - 1)]);
        let triangles: Vec<_> = facets.iter().map(|facet| [0, 1, 2].map(|k| corner(facet, k))).collect();
        Self { fans: Fan::all(facets), ..Self::of_triangles(&triangles, range) }
    }

    /// The tree of triangles; segments have their last corner twice.
    fn of_triangles(triangles: &[Triangle], range: f64) -> Self {
        let (mut pieces, mut owners): (Vec<Triangle>, Vec<u32>) = (Vec::new(), Vec::new());
        let mut size = if range > 0.0 { range } else { f64::INFINITY };
        let most = PIECES + 2 * triangles.len();
        let mut is_whole = false;
        while !is_whole {
            pieces.clear();
            owners.clear();
            is_whole = triangles.iter().zip(0..).all(|(corners, owner)| {
                add_pieces(corners, size, DEEPEST, &mut pieces);
                owners.resize(pieces.len(), owner);
                pieces.len() <= most
            });
            size *= 2.0;
        }
        let mut tree = Self { range, slack: 0.0, nodes: Vec::new(), facets: Vec::new(), fans: Vec::new() };
        let mut order: Vec<u32> = (0..pieces.len() as u32).collect();
        if !pieces.is_empty() {
            tree.divide(&pieces, &mut order, 0);
            let [lower, upper] = tree.nodes[0].turned.corners;
            tree.slack = ROUNDING * (lower.amax().max(upper.amax()) + range);
        }
        Self { facets: order.into_iter().map(|piece| owners[piece as usize]).collect(), ..tree }
    }

    /// Adds the box of some pieces, and what is in it, halved along its longest edge; pieces with one middle by their places.
    fn divide(&mut self, pieces: &[Triangle], order: &mut [u32], start: usize) {
        let of = |piece: &u32| &pieces[*piece as usize];
        let straight = TurnedBox::of(order.iter().map(of), Tensor::<3>::identity());
        let axis = straight.lengths().imax();
        let along_one = directions(of(&order[0])).map(|along| TurnedBox::of(order.iter().map(of), along));
        let turned = along_one.filter(|one| one.surface() < straight.surface()).unwrap_or(straight);
        let own = self.nodes.len();
        let content = Content::Facets(start as u32, (start + order.len()) as u32);
        self.nodes.push(Node { turned, content });
        if order.len() <= LEAF {
            return;
        }
        let middle = |piece: &u32| of(piece).iter().map(|corner| corner[axis]).sum::<f64>();
        let half = order.len() / 2;
        order.select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)).then(a.cmp(b)));
        let (first, second) = order.split_at_mut(half);
        self.divide(pieces, first, start);
        self.nodes[own].content = Content::Boxes(self.nodes.len() as u32);
        self.divide(pieces, second, start + half);
    }

    /// Distance of a place from a box `[m]`, less rounding.
    fn distance(&self, node: usize, place: &Vector<3>) -> f64 {
        let TurnedBox { along, corners: [lower, upper] } = &self.nodes[node].turned;
        let place = along * place;
        (lower - place).sup(&(place - upper)).sup(&Vector::zeros()).norm() - self.slack
    }

    /// The facets that are nearest to a place within a distance `[m]`, in their order, by what `distance_of` says of each; and how
    /// many it was asked for.
    fn nearest(&self, place: &Vector<3>, within: f64, distance_of: &dyn Fn(u32) -> f64) -> (Vec<u32>, usize) {
        let (mut near, mut looked_at, mut least) = (Vec::new(), 0, within);
        let mut waiting = Vec::new();
        if !self.nodes.is_empty() {
            waiting.push((self.distance(0, place), 0));
        }
        while let Some((from, node)) = waiting.pop() {
            if from > least * (1.0 + 2.0 * TIE) {
                continue;
            }
            match self.nodes[node].content {
                Content::Boxes(second) => {
                    let [one, other] = [node + 1, second as usize].map(|node| (self.distance(node, place), node));
                    waiting.extend(if one.0 < other.0 { [other, one] } else { [one, other] });
                }
                Content::Facets(start, end) => {
                    let own = &self.facets[start as usize..end as usize];
                    looked_at += own.len();
                    for &facet in own {
                        let from = distance_of(facet);
                        if from <= least * (1.0 + TIE) {
                            least = least.min(from);
                            near.push((facet, from));
                        }
                    }
                }
            }
        }
        near.retain(|(_, from)| *from <= least * (1.0 + TIE));
        near.sort_unstable_by_key(|(facet, _)| *facet);
        near.dedup_by_key(|(facet, _)| *facet);
        (near.into_iter().map(|(facet, _)| facet).collect(), looked_at)
    }

    /// Side of the facets on which a place is, among those within a distance `[m]` of it that is no more than the range; none where all
    /// are farther. `look` gets the number of facets that were looked at.
    #[must_use]
    pub fn side_within<const D: usize>(
        &self,
        facets: &[Facet<D>],
        place: &Vector<D>,
        distance: f64,
        look: impl FnOnce(usize),
    ) -> Option<FacetSide> {
        let (at, within) = (facet_fan::of(place), distance.min(self.range));
        let distance_of = |facet: u32| (place - facets[facet as usize].nearest(place)).norm();
        let tip = self.fans.iter().find_map(|fan| Some((fan, fan.distance(&at).filter(|least| *least <= within)?)));
        if let Some((fan, least)) = tip {
            let of_other = |k: u32| if fan.has(&facets[k as usize]) { f64::INFINITY } else { distance_of(k) };
            let (others, looked_at) = self.nearest(&at, least, &of_other);
            if others.is_empty() {
                look(looked_at);
                return (least < self.range).then(|| fan.side(facets, place));
            }
        }
        let (near, looked_at) = self.nearest(&at, within, &distance_of);
        look(looked_at);
        let found = facet_side(near.iter().map(|&facet| (&facets[facet as usize], *place)))?;
        (found.distance.abs() < self.range).then(|| FacetSide { facet: near[found.facet] as usize, ..found })
    }

    /// Side of the facets on which a place is; none where all are farther than the range.
    #[must_use]
    pub fn side<const D: usize>(&self, facets: &[Facet<D>], place: &Vector<D>) -> Option<FacetSide> {
        self.side_within(facets, place, self.range, |_| ())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};

    fn agrees<const D: usize>(facets: &[Facet<D>], range: f64, seed: u64) {
        let tree = FacetTree::new(facets, range);
        let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(seed);
        let (mut found, mut looked_at) = (0, 0);
        for index in 0..300 {
            let anywhere = Vector::<D>::from_fn(|_, _| 2.0 * random.random::<f64>() - 0.5);
            // also places at which several facets are equally near
            let corner = facets[index % facets.len()].corners[index % D];
            let place = [anywhere, corner, corner.add_scalar(0.4 * range)][index % 3];
            let all = facet_side(facets.iter().map(|facet| (facet, place)));
            let expected = all.filter(|facet_side| facet_side.distance.abs() < range);
            assert_eq!(tree.side_within(facets, &place, range, |number| looked_at += number), expected, "{place}");
            found += usize::from(expected.is_some());
        }
        assert!(found > 150 && looked_at < 100 * facets.len(), "{found}, {looked_at}");
    }

    #[test]
    fn it_finds_what_a_look_at_all_facets_finds() {
        let mut random = rand_pcg::Pcg64Mcg::seed_from_u64(3);
        for (size, thin) in [(0.05, 1.0), (0.3, 1.0), (0.3, 1e-3)] {
            let mut corner = |middle: f64| middle + size * (random.random::<f64>() - 0.5);
            let segments: Vec<_> = (0..400)
                .filter_map(|k| {
                    let (x, y) = (f64::from(k % 7) / 7.0, f64::from(k) / 400.0);
                    Facet::segment([corner(x), corner(y)].into(), [corner(x), corner(y)].into())
                })
                .collect();
            let triangles: Vec<_> = (0..800)
                .filter_map(|k| {
                    let at = [f64::from(k % 7) / 7.0, f64::from(k % 11) / 11.0, f64::from(k) / 800.0];
                    let [a, b, c] = [(); 3].map(|()| Vector::<3>::from(at.map(&mut corner)));
                    Facet::triangle([a, b, a + (b - a) * 0.5 + (c - a) * thin])
                })
                .collect();
            agrees(&segments, 0.1, 1);
            agrees(&triangles, 0.07, 2);
        }
        // a fan around one corner, and the same triangle many times
        let at = |angle: f64| Vector::<3>::new(libm::cos(angle), libm::sin(angle), 0.2);
        let fan = (0..300).filter_map(|k| {
            let angle = f64::from(k) * std::f64::consts::TAU / 300.0;
            Facet::triangle([Vector::zeros(), at(angle), at(angle + std::f64::consts::TAU / 300.0)])
        });
        agrees(&fan.collect::<Vec<_>>(), 0.2, 4);
        let one = Facet::triangle([Vector::zeros(), at(0.0), at(1.0)]).expect("a triangle");
        assert_eq!(FacetTree::new(&[one; 100], 0.2).side(&[one; 100], &at(0.5)).map(|found| found.facet), Some(0));
        assert_eq!(FacetTree::new::<2>(&[], 0.1).side::<2>(&[], &Vector::zeros()), None);
    }

    #[test]
    fn around_a_fan_of_slivers_few_are_looked_at() {
        let (count, range) = (2_000_u32, 0.12);
        let at = |k: u32| {
            let angle = f64::from(k % count) * std::f64::consts::TAU / f64::from(count);
            Vector::<3>::new(libm::cos(angle), libm::sin(angle), 0.1)
        };
        let fan: Vec<_> = (0..count).filter_map(|k| Facet::triangle([Vector::zeros(), at(k), at(k + 1)])).collect();
        let tree = FacetTree::new(&fan, range);
        let mut looked_at = 0;
        for k in 0..50 {
            let (radius, angle) = (0.05 + 0.9 * f64::from(k) / 50.0, 2.4 * f64::from(k));
            let place = Vector::<3>::new(radius * libm::cos(angle), radius * libm::sin(angle), 0.1 * radius - 0.05);
            let found = tree.side_within(&fan, &place, range, |number| looked_at += number);
            assert!(found.is_some_and(|side| (side.distance + 0.05 / 1.01_f64.sqrt()).abs() < 1e-6), "{found:?}");
        }
        assert!(looked_at < 50 * 60, "{looked_at} of {count} slivers for 50 places");
    }
}
