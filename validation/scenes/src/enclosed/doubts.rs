//! Lengths of a scene that are possible but unlikely, because they were given in millimetres, and a start that is.

use super::filling::holder;
use super::flow::Dimension;
use super::lattice::groups;
use super::measure::Measurand;
use super::periods::Periods;
use super::setting::{SceneBody, SceneGauge, SceneInlet, SceneWall};
use super::sides::SceneSides;
use super::{BodyPreparation, SceneFlow};

use bagnold_number::four_digits;
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::vector::Vector;

/// Size `[m]` of a scene in which a duration shorter than a fall is doubted.
const LARGE: f64 = 10.0;
/// Most grains across a scene that is not doubted: 50 m of sand.
const MOST_GRAINS: f64 = 1e5;
/// Way of a body beyond a periodic side that is not told, in spacings `[-]`.
const ON_THE_SIDE: f64 = 0.5;
/// Rows of particles below which the end of a layer jumps along the front `[-]`, and what rounding may take from them.
const LEAST_ROWS: f64 = 2.0;
const ROUNDING: f64 = 1e-9;
/// Places at which a body's particles are looked for.
const MOST_SITES: usize = 100_000;
/// Farthest that one part of a scene reaches, over the farthest of all others `[-]`: a slip by 1000 is seen of parts down to a thirtieth.
const FARTHEST: f64 = 30.0;

impl<S: Dimension<D>, const D: usize> SceneFlow<S, D> {
    /// Warnings of lengths that are probably in millimetres, all of them or those of one part, and of a start without shear stress.
    pub(super) fn doubtful_parts(&self) -> Vec<String> {
        let found = self.stray().or_else(|| self.all_large()).into_iter().chain(self.sudden_release());
        let found = found.chain(self.cut_by_periods()).chain(self.without_particles()).chain(self.pulled_off());
        found.map(|doubt| format!("scene `{}`: {doubt}", self.name)).chain(self.wide_gauges()).collect()
    }

    /// A layer at rest on a rough slope, whose shear stress grows from zero while it already moves.
    fn sudden_release(&self) -> Option<String> {
        let is_unprepared = self.preparation == BodyPreparation::None && self.from.is_none();
        let rests = |body: &S::Body| body.velocity().norm() == 0.0;
        let bears_shear = self.material.strength_at_rest(0.0).is_some() && self.smooth_floor().is_none();
        (is_unprepared && bears_shear && self.is_pulled_along() && self.bodies.iter().any(rests)).then(|| {
            "a layer on a periodic slope starts without shear stress and moves too far at first; give `preparation = \"stressed\"`"
                .to_owned()
        })
    }

    /// Whether gravity pulls along a period.
    pub(super) fn is_pulled_along(&self) -> bool {
        Periods::of(&self.sides.axes()).split(&self.pull()).1.norm() > 0.0
    }

    /// Bodies of which a part is beyond a periodic side, and is left out without being an image of what is inside.
    fn cut_by_periods(&self) -> impl Iterator<Item = String> {
        let (axes, told) = (self.sides.axes(), ON_THE_SIDE * self.spacing);
        let of_body = move |(body, own): (usize, &S::Body)| {
            let (lower, upper) = own.extent();
            axes.into_iter().enumerate().filter_map(move |(axis, boundary)| {
                let AxisBoundary::Periodic { lower: left, upper: right } = boundary else { return None };
                let beyond = (left - lower[axis]).max(upper[axis] - right);
                // what fills the period may be drawn wider
                let is_whole = lower[axis] <= left && upper[axis] >= right;
                let what = format!(
                    "{} m of `bodies[{body}]` lie beyond a periodic side and are left out",
                    four_digits(beyond)
                );
                (!is_whole && beyond > told).then(|| what + "; end it there, and add a body at the other side")
            })
        };
        self.bodies.iter().enumerate().flat_map(of_body)
    }

    /// Walls whose load points away from all bodies, where nothing else holds them.
    fn pulled_off(&self) -> impl Iterator<Item = String> {
        let centre = |places: &[Vector<D>]| places.iter().sum::<Vector<D>>() / places.len() as f64;
        let bodies: Vec<Vector<D>> =
            self.bodies.iter().map(|body| body.extent()).flat_map(|(low, high)| [low, high]).collect();
        self.walls.iter().filter_map(move |wall| {
            let away = wall.load()?.direction.dot(&(centre(&bodies) - centre(&wall.hull()))) < 0.0;
            let remedy = "nothing holds the bodies without gravity; turn `load.direction`";
            (away && self.pull().norm() == 0.0)
                .then(|| format!("the load of wall `{}` points away from the bodies, and {remedy}", wall.name()))
        })
    }

    /// Bodies in which no place of a particle lies, but in those before them or beyond a side. A large one is not searched to its end,
    /// for its cost is not judged yet.
    fn without_particles(&self) -> impl Iterator<Item = String> {
        groups(&self.bodies, &self.sides, self.spacing).into_iter().flat_map(move |(lattice, bodies)| {
            bodies.into_iter().filter_map(move |body| {
                let mut sites = lattice.sites(self.sides.clip(self.bodies[body].extent()));
                let is_of_another =
                    |place: &Vector<D>| holder(&self.bodies, place) != Some(body) || !self.sides.hold(place);
                let is_empty = sites.by_ref().take(MOST_SITES).all(|(_, place)| is_of_another(&place));
                let why =
                    "it is thinner than a spacing, inside of others or beyond a side; reduce `spacing`, or correct it";
                (is_empty && sites.next().is_none())
                    .then(|| format!("`bodies[{body}]` has no particle of its own: {why}"))
            })
        })
    }

    /// The geometry as a whole: too many grains across it, or over before anything could fall.
    fn all_large(&self) -> Option<String> {
        let (lower, upper) = self.extent();
        let (size, gravity) = ((upper - lower).max(), self.pull().norm());
        let grains = self.material.grain_diameter().map(|diameter| size / diameter);
        let fall = (2.0 * self.height() / gravity).sqrt();
        let many = grains.filter(|grains| *grains > MOST_GRAINS).map(|grains| {
            format!("{} grains of `material.grain_diameter` fit across the scene's {size} m", four_digits(grains))
        });
        let short = (size > LARGE && gravity > 0.0 && self.duration < fall).then(|| {
            format!("`duration` is {} s, but a fall over the height takes {} s", self.duration, four_digits(fall))
        });
        let own = many.as_ref().map_or("raise `duration`, or ", |_| "correct `grain_diameter`, or ");
        let found: Vec<String> = many.into_iter().chain(short).collect();
        (!found.is_empty()).then(|| {
            format!(
                "{}; {own}give all lengths in metres if they are in millimetres, such as `spacing = {}`",
                found.join(", and "),
                four_digits(self.spacing * 1e-3)
            )
        })
    }

    /// The one part that reaches much farther than all others.
    fn stray(&self) -> Option<String> {
        let mut parts = self.reaches();
        parts.sort_by(|one, other| other.1.total_cmp(&one.1));
        let ((part, far), (_, near)) = (parts.first()?, parts.get(1)?);
        (*near > 0.0 && *far > FARTHEST * near).then(|| {
            let metres = far * 1e-3;
            let remedy = if metres > FARTHEST * near {
                "subtract a common offset from all coordinates".to_owned()
            } else {
                format!("give it in metres, {} if it is in millimetres", four_digits(metres))
            };
            format!("`{part}` reaches {} m, but all other parts {} m; {remedy}", four_digits(*far), four_digits(*near))
        })
    }

    /// Every part of the scene as a field, with its largest coordinate `[m]`.
    fn reaches(&self) -> Vec<(String, f64)> {
        let of = |places: &[Vector<D>]| places.iter().map(Vector::<D>::amax).fold(0.0, f64::max);
        let bodies = self.bodies.iter().enumerate().map(|(k, body)| {
            let (lower, upper) = body.extent();
            (format!("bodies[{k}]"), of(&[lower, upper]))
        });
        let walls = self.walls.iter().map(|wall| (wall.name().to_owned(), of(&wall.hull())));
        let inlets = self.inlets.iter().map(|inlet| (inlet.name().to_owned(), of(&inlet.corners())));
        let gauges = self.gauges.iter().map(|gauge| (gauge.name().to_owned(), of(&gauge.places())));
        let sides = self.sides.pairs().into_iter().zip(S::Sides::NAMES).flat_map(|((lower, upper), (low, high))| {
            [(lower, low), (upper, high)]
                .into_iter()
                .filter_map(|(side, name)| Some((format!("sides.{name}"), side.coordinate()?.abs())))
        });
        bodies.chain(walls).chain(inlets).chain(gauges).chain(sides).collect()
    }

    /// Cautions about fronts thinner than two rows of particles; gauges of the shipped scene are exempt.
    pub(super) fn thin_fronts(&self, shipped: &[S::Gauge]) -> impl Iterator<Item = String> {
        let least = LEAST_ROWS * self.spacing;
        self.gauges.iter().zip(self.measures()).filter_map(move |(gauge, measure)| {
            let Measurand::Front(line) = measure else { return None };
            let thickness = line.section / line.strip.map_or(1.0, |(_, half)| 2.0 * half);
            let [own, more, finer] = [thickness, least, thickness / LEAST_ROWS].map(four_digits);
            (thickness < (1.0 - ROUNDING) * least && !shipped.contains(gauge)).then(|| {
                format!(
                    "gauge `{}`: `thickness` is {own} m, less than two rows of particles, so that the front jumps by rows; \
                     give {more} m or more, or `spacing` = {finer}",
                    gauge.name()
                )
            })
        })
    }

    /// Gauges that measure over more than the scene.
    fn wide_gauges(&self) -> impl Iterator<Item = String> {
        let (lower, upper) = self.extent();
        let size = (upper - lower).max();
        self.gauges.iter().zip(self.measures()).filter_map(move |(gauge, measure)| {
            let (field, width) = match measure {
                Measurand::Front(line) => ("thickness", line.section / line.strip.map_or(1.0, |(_, half)| 2.0 * half)),
                Measurand::Depth(depth) => ("width", depth.width),
                _ => return None,
            };
            (width > size).then(|| {
                format!(
                    "gauge `{}`: `{field}` is {width} m, more than the scene's {} m; give it in metres, {} if it is in millimetres",
                    gauge.name(),
                    four_digits(size),
                    four_digits(width * 1e-3)
                )
            })
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::enclosed::{DomainSide, quick};
    use crate::scene::{Plane, PlaneBody, PlaneGauge, PlaneSides};
    use bagnold_solver::material::rheology::Rheology;

    fn unbounded() -> PlaneSides {
        let none = DomainSide::None;
        PlaneSides { left: none, right: none, bottom: none, top: none }
    }

    /// A column of a width, a height and a spacing `[m]`, with grains of a diameter `[m]`, over a duration `[s]`.
    fn doubt([width, height, spacing]: [f64; 3], diameter: f64, duration: f64) -> Option<String> {
        let mut scene = quick::<Plane, 2>();
        (scene.walls, scene.inlets, scene.duration, scene.spacing) = (Vec::new(), Vec::new(), duration, spacing);
        (scene.gauges, scene.sides) = (Vec::new(), unbounded());
        scene.bodies = vec![PlaneBody::Box { lower: (0.0, 0.0), upper: (width, height), velocity: (0.0, 0.0) }];
        if let Rheology::MuI(law) = &mut scene.material {
            law.grain_diameter = diameter;
        }
        scene.doubtful_parts().pop()
    }

    #[test]
    fn a_geometry_in_millimetres_is_doubted() {
        let both = doubt([100.0, 150.0, 1.5], 0.7e-3, 0.5).expect("doubted");
        assert!(both.contains("214286 grains") && both.contains("a fall over the height takes 5.530 s"), "{both}");
        assert!(
            both.ends_with(
                "correct `grain_diameter`, or give all lengths in metres if they are in millimetres, such as `spacing = 0.0015`"
            ),
            "{both}"
        );
        // each evidence alone: a long duration, and grains in the same wrong unit
        assert!(doubt([100.0, 150.0, 1.5], 0.7e-3, 20.0).is_some_and(|text| !text.contains("duration")));
        assert!(doubt([100.0, 150.0, 1.5], 0.7, 0.5).is_some_and(|text| !text.contains("grain")));
    }

    #[test]
    fn a_layer_without_shear_stress_on_a_rough_slope_is_doubted() {
        let (left, right) = (DomainSide::Periodic(0.0), DomainSide::Periodic(0.1));
        let mut layer = SceneFlow {
            gravity: (3.99, -8.96),
            bodies: vec![PlaneBody::Box { lower: (0.0, 0.0), upper: (0.1, 0.1), velocity: (0.0, 0.0) }],
            sides: PlaneSides { left, right, ..unbounded() },
            walls: Vec::new(),
            gauges: Vec::new(),
            ..quick::<Plane, 2>()
        };
        assert!(layer.doubtful_parts().concat().contains("starts without shear stress"));
        layer.preparation = BodyPreparation::Stressed;
        assert_eq!(layer.doubtful_parts(), Vec::<String>::new());
        let level = SceneFlow { gravity: (0.0, -9.81), preparation: BodyPreparation::None, ..layer };
        assert_eq!(level.doubtful_parts(), Vec::<String>::new());
    }

    #[test]
    fn a_body_across_a_periodic_side_is_doubted_unless_it_fills_the_period() {
        let doubt = |lower: f64, upper: f64| {
            doubts(|scene| {
                (scene.sides.left, scene.sides.right) = (DomainSide::Periodic(0.0), DomainSide::Periodic(0.2));
                scene.bodies = vec![PlaneBody::Box { lower: (lower, 0.0), upper: (upper, 0.1), velocity: (0.0, 0.0) }];
            })
        };
        assert!(doubt(-0.1, 0.1).contains("0.1 m of `bodies[0]` lie beyond a periodic side and are left out"));
        assert!(doubt(0.05, 0.25).contains("0.05 m of `bodies[0]`"));
        assert_eq!([doubt(0.0, 0.2), doubt(-0.1, 0.3), doubt(0.05, 0.15)].concat(), "");
    }

    #[test]
    fn a_body_without_a_particle_is_told_and_one_of_a_row_is_not() {
        let beside = |lower: f64, upper: f64| {
            let body = |(left, right)| PlaneBody::Box { lower: (left, 0.0), upper: (right, 0.1), velocity: (0.0, 0.0) };
            doubts(|scene| scene.bodies = vec![body((0.0, 0.2)), body((lower, upper))])
        };
        let told = "scene `step`: `bodies[1]` has no particle of its own: it is thinner than a spacing, inside of others or beyond \
                    a side; reduce `spacing`, or correct it";
        assert_eq!([beside(0.2, 0.204), beside(0.4, 0.402), beside(0.05, 0.15)], [told; 3]);
        assert_eq!([beside(0.2, 0.21), beside(0.4, 0.408), beside(0.1, 0.3)], [""; 3]);
        let beyond = doubts(|scene| {
            scene.sides.right = DomainSide::Open(0.5);
            scene.bodies.push(PlaneBody::Box { lower: (0.6, 0.0), upper: (0.7, 0.1), velocity: (0.0, 0.0) });
        });
        assert_eq!(beyond, told);
    }

    #[test]
    fn a_landslide_and_a_column_in_the_laboratory_are_not_doubted() {
        assert_eq!(doubt([400.0, 150.0, 2.0], 0.3, 30.0), None);
        assert_eq!(doubt([0.1, 0.15, 0.0015], 0.7e-3, 0.01), None);
        assert_eq!(doubt([2000.0, 600.0, 5.0], 0.3, 60.0), None);
    }

    /// A column of 0.2 m with a floor of 1 m, one of whose parts is changed.
    fn doubts(change: impl Fn(&mut SceneFlow<Plane, 2>)) -> String {
        let mut scene = quick::<Plane, 2>();
        (scene.walls, scene.inlets, scene.duration, scene.spacing) = (Vec::new(), Vec::new(), 30.0, 0.01);
        scene.sides = unbounded();
        scene.bodies = vec![PlaneBody::Box { lower: (0.0, 0.0), upper: (0.2, 0.2), velocity: (0.0, 0.0) }];
        let gauge = "kind = \"front\"\nname = \"front\"\nfrom = [0.0, 0.0]\nto = [1.0, 0.0]\nthickness = 0.02";
        scene.gauges = vec![toml::from_str(gauge).expect("a gauge")];
        change(&mut scene);
        scene.doubtful_parts().into_iter().chain(scene.thin_fronts(&[])).collect::<Vec<_>>().join("\n")
    }

    #[test]
    fn one_length_in_millimetres_is_named() {
        assert_eq!(doubts(|_| ()), "");
        let far = doubts(|scene| scene.sides.right = DomainSide::Open(900.0));
        let all = "reaches 900 m, but all other parts 1 m; give it in metres, 0.9 if it is in millimetres";
        assert!(far.ends_with(&format!("`sides.right` {all}")), "{far}");
        let map = doubts(|scene| scene.sides.right = DomainSide::Open(4.5e5));
        assert!(map.ends_with("all other parts 1 m; subtract a common offset from all coordinates"), "{map}");
        let body = |scene: &mut SceneFlow<Plane, 2>| {
            scene.bodies = vec![PlaneBody::Box { lower: (0.0, 0.0), upper: (200.0, 200.0), velocity: (0.0, 0.0) }];
        };
        assert!(doubts(body).contains("`bodies[0]` reaches 200 m"));
        assert!(doubts(front(10.0)).starts_with("gauge `front`: `thickness` is 10 m, more than the scene's 0.2 m"));
    }

    fn front(section: f64) -> impl Fn(&mut SceneFlow<Plane, 2>) {
        move |scene| {
            let PlaneGauge::Front { thickness, .. } = &mut scene.gauges[0] else { unreachable!("a front") };
            *thickness = section;
        }
    }

    #[test]
    fn a_front_of_less_than_two_rows_is_told_with_the_thickness_to_take() {
        assert_eq!(
            doubts(front(0.015)),
            "gauge `front`: `thickness` is 0.015 m, less than two rows of particles, so that the front jumps by rows; \
             give 0.02 m or more, or `spacing` = 0.0075"
        );
        assert_eq!(doubts(front(0.1 * 0.2)), "");
    }
}
