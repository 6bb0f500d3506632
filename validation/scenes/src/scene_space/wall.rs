//! Walls of a scene in space: triangles from a file, quadrilaterals and boxes; and the sides of its domain.

use super::SpaceVector;
use super::openings::Openings;
use crate::case::ParameterError;
use crate::enclosed::setting::{self, shown, vector};
use crate::enclosed::{DomainSide, GivenLoad, GivenTurn, shapes, sides};
use crate::input::PackedTriangles;
use crate::output::caution;
use bagnold_number::four_digits;
use bagnold_solver::parameter::above;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::facet_wall::{FacetWall, Motion};
use bagnold_solver::weakly_compressible::enclosure::largest_fan;
use bagnold_solver::weakly_compressible::enclosure::wall_turn::WallTurn;
use bagnold_solver::weakly_compressible::walls::Surface;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A wall. Its corners are seen against the clock from the side of the flow, and behind it is nothing. Where walls meet, they
/// end at their common edge.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpaceWall {
    /// Name by which gauges and messages call the wall: letters, digits and hyphens, unlike those of other walls and inlets.
    pub name: String,
    /// STL file of its triangles, whose path begins at the case file; empty without one. The triangles are read with
    /// the case file; where `triangles` are given, this says where they come from.
    #[serde(default)]
    pub mesh: String,
    /// Unit of the file: "m", "cm", "mm" or "in".
    #[serde(default = "metres")]
    pub unit: String,
    /// Factor of the size of the mesh `[-]`, beside its unit.
    #[serde(default = "unscaled")]
    #[schemars(transform = above(0.0, "give 1 to keep the size in the file"))]
    pub scale: f64,
    /// Angles `[°]` by which the mesh is turned about x, then y, then z, about the origin.
    #[serde(default)]
    pub rotate: SpaceVector,
    /// Displacement of the mesh `[m]` after its turn.
    #[serde(default, rename = "move")]
    pub shift: SpaceVector,
    /// Triangles, each by its corners x, y, z `[m]`.
    #[serde(default)]
    pub triangles: Vec<(SpaceVector, SpaceVector, SpaceVector)>,
    /// Triangles of a mesh of more than 10 000, as the program writes them: base64, least byte first. The number of corners has 4
    /// bytes, x, y and z of a corner `[m]` 8 each. Three places of corners follow for every triangle, of 4 bytes.
    #[serde(default, skip_serializing_if = "PackedTriangles::is_empty")]
    pub packed: PackedTriangles,
    /// Plane quadrilaterals, each by its corners x, y, z `[m]` in their order.
    #[serde(default)]
    pub quads: Vec<(SpaceVector, SpaceVector, SpaceVector, SpaceVector)>,
    /// Boxes along the axes with the flow around them, each by its lower and its upper corner x, y, z `[m]`.
    #[serde(default)]
    pub boxes: Vec<(SpaceVector, SpaceVector)>,
    /// Whether the flow sticks to it or slides.
    #[serde(default = "setting::rough")]
    pub surface: Surface,
    /// Whether material may stand behind it, farther away than it is thick.
    #[serde(default)]
    pub both_sides: bool,
    /// Motion: time `[s]`, displacement along x, y and z `[m]`, linear between the rows; empty for a wall at rest.
    #[serde(default)]
    pub motion: Vec<(f64, f64, f64, f64)>,
    /// Load, under which the wall moves freely along one direction; none where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub load: Option<GivenLoad<SpaceVector>>,
    /// Turn about a axis; none where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turn: Option<GivenTurn<(SpaceVector, SpaceVector)>>,
}

/// Triangles around one corner at most: particles near it look at all of them.
const LARGEST_FAN: usize = 10_000;

fn metres() -> String {
    "m".to_owned()
}

fn unscaled() -> f64 {
    1.0
}

impl SpaceWall {
    /// All its triangles `[m]`.
    fn corners(&self) -> Vec<[Vector<3>; 3]> {
        self.unpacked().chain(self.packed.triangles().iter().map(|corners| corners.map(Vector::from))).collect()
    }

    /// All its triangles but those of a large mesh `[m]`.
    fn unpacked(&self) -> impl Iterator<Item = [Vector<3>; 3]> {
        let given = self.triangles.iter().map(|(a, b, c)| [vector(a), vector(b), vector(c)]);
        let quads = self.quads.iter().map(|(a, b, c, d)| [vector(a), vector(b), vector(c), vector(d)]);
        let boxes = self.boxes.iter().flat_map(|(lower, upper)| faces(&vector(lower), &vector(upper)));
        given.chain(quads.chain(boxes).flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]))
    }

    /// Lower and upper corner of its box `[m]`.
    fn bounds(&self) -> (Vector<3>, Vector<3>) {
        let packed = self.packed.bounds().into_iter().flatten().map(Vector::from);
        shapes::around(self.unpacked().flatten().chain(packed))
    }
}

impl setting::SceneWall<3> for SpaceWall {
    const FACETS: &'static str = "triangles";
    const GIVEN_BY: &'static str = "corners";
    const TURN: &'static str = "reverse the wall's corners";

    fn name(&self) -> &str {
        &self.name
    }

    fn may_have_two_sides(&self) -> bool {
        self.both_sides
    }

    fn openings(&self) -> Option<String> {
        if self.mesh.is_empty() {
            return None;
        }
        let openings = Openings::of(&self.corners());
        if openings.turned > 0 {
            caution(&format!(
                "wall `{}`: neighbouring triangles are seen from opposite sides at {} edges; turn one of both",
                self.name, openings.turned
            ));
        }
        if openings.rings.iter().any(|ring| ring.len() == 3) {
            caution(&format!("wall `{}`: a triangle is probably missing; close the mesh", self.name));
        }
        openings.in_words()
    }

    fn facet_wall(&self) -> FacetWall<3> {
        let mut facet_wall = FacetWall::mesh(&self.name, &self.corners());
        facet_wall.roughness = self.surface;
        facet_wall.motion = self.motion();
        facet_wall
    }

    fn motion(&self) -> Motion<3> {
        Motion {
            times: self.motion.iter().map(|row| row.0).collect(),
            displacements: self.motion.iter().map(|row| Vector::<3>::new(row.1, row.2, row.3)).collect(),
            turn: self.turn.as_ref().map(around),
            load: None,
        }
    }

    fn load(&self) -> Option<GivenLoad<Vector<3>>> {
        self.load.as_ref().map(GivenLoad::with_vector)
    }

    /// The corners of its box: a mesh has many.
    fn hull(&self) -> Vec<Vector<3>> {
        let (lower, upper) = self.bounds();
        faces(&lower, &upper)[..2].concat()
    }

    fn triangle_count(&self) -> usize {
        self.unpacked().count() + self.packed.triangles().len()
    }

    fn measure(&self) -> f64 {
        self.unpacked().map(|[a, b, c]| 0.5 * (b - a).cross(&(c - a)).norm()).sum::<f64>() + self.packed.area()
    }

    /// Refuses walls without an area, quadrilaterals that are not plane and empty boxes.
    fn check(&self, spacing: f64, bodies: f64) -> Result<(), ParameterError> {
        let refused = |field: &str, value: String, rule: &str, remedy: &str| {
            Err(ParameterError::field(field, value, rule, remedy))
        };
        if !self.mesh.is_empty() && self.triangles.is_empty() && self.packed.is_empty() {
            let defect = format!("\"{}\" has not been read", self.mesh);
            return refused("mesh", defect, "", "name it in a case file, or give `triangles`");
        }
        if let Some(text) = self.packed.damage() {
            return refused("packed", format!("{text} is damaged"), "", "leave it out, so that `mesh` is read again");
        }
        let (lower, upper) = self.bounds();
        let size = (upper - lower).max();
        // a file in millimetres is 1000 times too large
        if !self.mesh.is_empty() && bodies > 0.0 && !(bodies / 200.0..=200.0 * bodies).contains(&size) {
            let rule = format!("comparable to the bodies, {} m wide", four_digits(bodies));
            let units = [("cm", 0.01), ("mm", 0.001), ("in", 0.0254)];
            let near = |(_, length): &(&str, f64)| (bodies / 20.0..=20.0 * bodies).contains(&(size * length));
            let unit = units.iter().rfind(|unit| near(unit)).map_or("mm", |(name, _)| name);
            let remedy = format!("set `unit = \"{unit}\"` or `scale`: the file is probably in another unit");
            return refused("mesh", format!("{} m wide", four_digits(size)), &rule, &remedy);
        }
        for (k, (a, b, c, d)) in self.quads.iter().enumerate() {
            let [a, b, c, d] = [a, b, c, d].map(vector::<3>);
            let across = (c - a).cross(&(d - b));
            let height = across.dot(&(b - a)).abs();
            if height > 1e-6 * across.norm() * (c - a).norm() {
                let field = format!("quads[{k}]");
                return refused(&field, "not planar".to_owned(), "", "give two `triangles` instead");
            }
            if (b - a).cross(&(c - a)).dot(&(c - a).cross(&(d - a))) < 0.0 {
                let remedy = "give the corners in their order around it, or two `triangles` instead";
                return refused(&format!("quads[{k}]"), "edges that cross or turn back".to_owned(), "", remedy);
            }
        }
        for (k, (lower, upper)) in self.boxes.iter().enumerate() {
            if !shapes::has_inside::<3>(&vector(lower), &vector(upper)) {
                let upper = shown(&vector::<3>(upper));
                let defect = format!("upper corner {upper} m not above the lower one along x, y and z");
                return refused(&format!("boxes[{k}]"), defect, "", "give the smaller coordinates first");
            }
        }
        if let Some(turn) = &self.turn {
            turn.check()?;
            let (from, to) = turn.about;
            if vector::<3>(&to) == vector::<3>(&from) {
                let value = format!("{} m twice", shown(&vector::<3>(&from)));
                return refused("turn.about", value, "two points of the axis", "move one of them along the axis");
            }
        }
        let triangles = self.corners();
        if let Some((at, count)) = largest_fan(&triangles).filter(|(_, count)| *count > LARGEST_FAN) {
            let value = format!("a fan of {count} triangles around {} m", shown(&at));
            let rule = format!("a surface with at most {LARGEST_FAN} triangles around a corner");
            return refused("mesh", value, &rule, "remesh it evenly: edges far below the spacing have no effect");
        }
        let area = self.measure();
        if !(area > spacing * spacing && area.is_finite()) {
            let defect = format!("the wall's {} triangles are smaller than a square of the spacing", triangles.len());
            return refused("quads", defect, "", "give `mesh`, `triangles`, `quads` or `boxes` in metres");
        }
        Ok(())
    }
}

/// The turn for the solver about an axis by two of its points.
fn around(turn: &GivenTurn<(SpaceVector, SpaceVector)>) -> WallTurn<3> {
    let [from, to] = [turn.about.0, turn.about.1].map(|point| vector::<3>(&point));
    let axis = (to - from).normalize();
    let across = Vector::ith(axis.iamin(), 1.0);
    let first = (across - axis * axis.dot(&across)).normalize();
    turn.around(from, [first, axis.cross(&first)])
}

/// The faces of a box, seen from without.
fn faces(lower: &Vector<3>, upper: &Vector<3>) -> [[Vector<3>; 4]; 6] {
    let corner = |x: usize, y: usize, z: usize| {
        let pick = |axis: usize, end: usize| if end == 0 { lower[axis] } else { upper[axis] };
        Vector::<3>::new(pick(0, x), pick(1, y), pick(2, z))
    };
    let at = |corners: [[usize; 3]; 4]| corners.map(|[x, y, z]| corner(x, y, z));
    [
        at([[0, 0, 0], [0, 0, 1], [0, 1, 1], [0, 1, 0]]),
        at([[1, 0, 0], [1, 1, 0], [1, 1, 1], [1, 0, 1]]),
        at([[0, 0, 0], [1, 0, 0], [1, 0, 1], [0, 0, 1]]),
        at([[0, 1, 0], [0, 1, 1], [1, 1, 1], [1, 1, 0]]),
        at([[0, 0, 0], [0, 1, 0], [1, 1, 0], [1, 0, 0]]),
        at([[0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]),
    ]
}

/// The sides of the domain.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpaceSides {
    /// Side at the smallest x.
    pub left: DomainSide,
    /// Side at the largest x.
    pub right: DomainSide,
    /// Side at the smallest y.
    pub front: DomainSide,
    /// Side at the largest y.
    pub back: DomainSide,
    /// Side at the smallest z.
    pub bottom: DomainSide,
    /// Side at the largest z.
    pub top: DomainSide,
}

impl sides::SceneSides<3> for SpaceSides {
    const NAMES: [(&'static str, &'static str); 3] = [("left", "right"), ("front", "back"), ("bottom", "top")];

    fn pairs(&self) -> [sides::SidePair; 3] {
        [(self.left, self.right), (self.front, self.back), (self.bottom, self.top)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::enclosed::setting::SceneWall as _;

    impl SpaceWall {
        /// A rough wall of quadrilaterals at rest.
        fn of_quads(name: &str, quads: Vec<(SpaceVector, SpaceVector, SpaceVector, SpaceVector)>) -> Self {
            Self {
                name: name.to_owned(),
                mesh: String::new(),
                unit: metres(),
                scale: unscaled(),
                rotate: SpaceVector::default(),
                shift: SpaceVector::default(),
                triangles: Vec::new(),
                packed: PackedTriangles::default(),
                quads,
                boxes: Vec::new(),
                surface: Surface::Rough,
                both_sides: false,
                motion: Vec::new(),
                load: None,
                turn: None,
            }
        }
    }

    #[test]
    fn the_faces_of_a_box_look_outwards_and_close_it() {
        let wall =
            SpaceWall { boxes: vec![((0.0, 0.0, 0.0), (1.0, 2.0, 3.0))], ..SpaceWall::of_quads("box", Vec::new()) };
        let middle = Vector::<3>::new(0.5, 1.0, 1.5);
        let facet_wall = wall.facet_wall();
        assert_eq!(facet_wall.facets.len(), 12);
        assert!(facet_wall.facets.iter().all(|facet| facet.height(&middle) < -0.4));
        assert!((wall.measure() - 22.0).abs() < 1e-12 && wall.check(0.1, 1.0).is_ok());
    }

    #[test]
    fn invalid_walls_name_the_field() {
        let o = (0.0, 0.0, 0.0);
        let bent = SpaceWall::of_quads("bent", vec![(o, (1.0, 0.0, 0.0), (1.0, 1.0, 0.2), (0.0, 1.0, 0.0))]);
        assert!(bent.check(0.1, 1.0).expect_err("bent").to_string().starts_with("`quads[0]`: not planar"));
        let crossed = SpaceWall::of_quads("x", vec![(o, (1.0, 1.0, 0.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0))]);
        let message = crossed.check(0.1, 1.0).expect_err("crossed").to_string();
        assert!(message.starts_with("`quads[0]`: edges that cross or turn back; give"), "{message}");
        let unread = SpaceWall { mesh: "a.stl".to_owned(), ..SpaceWall::of_quads("unread", Vec::new()) };
        assert_eq!(
            unread.check(0.1, 1.0).expect_err("unread").to_string(),
            "`mesh`: \"a.stl\" has not been read; name it in a case file, or give `triangles`"
        );
        let at = |k: u32| (libm::cos(1e-4 * f64::from(k)), libm::sin(1e-4 * f64::from(k)), 0.0);
        let fan = |count| SpaceWall {
            triangles: (0..count).map(|k| (o, at(k), at(k + 1))).collect(),
            ..SpaceWall::of_quads("fan", Vec::new())
        };
        assert!(fan(10_000).check(0.1, 1.0).is_ok() && fan(10_000).triangle_count() == 10_000);
        assert_eq!(
            fan(10_001).check(0.1, 1.0).expect_err("a fan").to_string(),
            "`mesh` is a fan of 10001 triangles around (0, 0, 0) m, but must be a surface with at most 10000 triangles around a corner; \
             remesh it evenly: edges far below the spacing have no effect"
        );
        assert!(SpaceWall::of_quads("none", Vec::new()).check(0.1, 1.0).is_err());
        let inverse =
            SpaceWall { boxes: vec![((1.0, 0.0, 0.0), (0.0, 1.0, 1.0))], ..SpaceWall::of_quads("box", Vec::new()) };
        assert!(
            inverse
                .check(0.1, 1.0)
                .expect_err("no inside")
                .to_string()
                .starts_with("`boxes[0]`: upper corner (0, 1, 1) m")
        );
    }
}
