//! The speed of sound of a scene, by one rule for bodies, walls, belts, inlets, falls and pressure. A flow, its quarter turns, its mirror
//! image and the view of it from a moving frame have one speed of sound.

use super::flow::Dimension;
use super::setting::{SceneBody, SceneInlet, SceneWall};
use super::sides::SceneSides;
use super::{SceneFlow, shapes};
use bagnold_number::four_digits;
use bagnold_solver::domain::AxisBoundary;
use bagnold_solver::material::equation_of_state::EquationOfState;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::facet_wall::Motion;

/// Stiffness where a scene gives none `[-]`: a fall over its height, and what meets at its largest relative speed, has Mach 0.2.
const USUAL_STIFFNESS: f64 = 50.0;
/// Cosine between gravity and the normal of a facet below which the facet is parallel to gravity `[-]`: a slope of 1 in 1000.
const PARALLEL: f64 = 1e-3;
/// Time over which bodies and inlets keep their velocity `[s]`: a power of two, so that the velocity is not rounded.
pub(super) const FOR_EVER: f64 = 1_099_511_627_776.0;
/// Share by which inlets are taken to be faster `[-]`, so that rounding leaves them below Mach 0.2.
const MARGIN: f64 = 1e-9;
/// Relative difference of two squared speeds that tables of displacements round to at most `[-]`.
const ROUNDING: f64 = 1e-12;

impl<S: Dimension<D>, const D: usize> SceneFlow<S, D> {
    /// Bulk modulus over the density and the scale of squared speeds `[-]`.
    pub(super) fn stiffness(&self) -> f64 {
        self.stiffness.unwrap_or(USUAL_STIFFNESS)
    }

    /// Equation of state of the material: its density under a pressure.
    pub(super) fn equation_of_state(&self) -> EquationOfState {
        self.equation_of_state_over(self.fall())
    }

    /// The same with g H + p/ρ `[m²/s²]`; from a state its own.
    pub(super) fn equation_of_state_over(&self, fall: f64) -> EquationOfState {
        let reference_density = self.bulk.density(&self.material);
        let of_state = self.from.as_ref().and_then(|from| from.bulk_modulus);
        let bulk_modulus = of_state.unwrap_or_else(|| self.stiffness() * reference_density * self.scale(fall));
        EquationOfState { reference_density, bulk_modulus, tension: self.tension }
    }

    /// The larger of g H + p/ρ and ½ u² `[m²/s²]`, with the largest relative speed u. A stiffness that the scene gives multiplies the
    /// former alone, unless it is zero.
    fn scale(&self, fall: f64) -> f64 {
        if self.stiffness.is_some() && fall > 0.0 { fall } else { fall.max(0.5 * self.relative_square()) }
    }

    /// Cause of the sound speed, in words.
    pub(super) fn sound_cause(&self) -> String {
        if self.from.is_some() {
            return "that of the state it starts from".to_owned();
        }
        let fall = self.fall();
        let cause = if self.scale(fall) > fall {
            format!("½ u², u = {} m/s between what can touch", four_digits(self.relative_speed()))
        } else {
            format!("g H + p/ρ, H = {} m, p = {} Pa", four_digits(self.height()), four_digits(self.start_pressure()))
        };
        format!("stiffness {} times {cause}", self.stiffness())
    }

    /// Weight of the scene's height, and pressure at the start or of loads, over the density `[m²/s²]`: the square of the speed that
    /// either gives.
    pub(super) fn fall(&self) -> f64 {
        self.pull().norm() * self.height() + self.start_pressure() / self.bulk.density(&self.material)
    }

    /// The larger of the pressure at the start and that of loads `[Pa]`.
    pub(super) fn start_pressure(&self) -> f64 {
        self.pressure.max(self.load_pressure())
    }

    /// Largest relative speed of what can touch `[m/s]`: bodies, the inflow of inlets, and walls.
    pub(super) fn relative_speed(&self) -> f64 {
        self.relative_square().sqrt()
    }

    /// Square `[m²/s²]`. Across a plane of symmetry material meets its mirror image.
    fn relative_square(&self) -> f64 {
        let (material, walls) = (self.motions_of_material(), self.motions_of_walls());
        let of_images = self.sides.axes().into_iter().enumerate().flat_map(|(axis, boundary)| {
            let is_mirror = matches!(boundary, AxisBoundary::Mirror { .. });
            material.iter().filter(move |_| is_mirror).map(move |motion| 4.0 * motion.velocity(0.0)[axis].powi(2))
        });
        let rim_speed = |wall: &S::Wall| wall.motion().turn.map_or(0.0, |_| wall.facet_wall().rim_speed());
        let rims = std::iter::repeat_n(0.0, material.len()).chain(self.walls.iter().map(rim_speed));
        let others: Vec<_> = material.iter().chain(&walls).zip(rims.chain(std::iter::repeat(0.0))).collect();
        let pairs = material.iter().enumerate().flat_map(|(k, one)| {
            let meeting = |(other, rim): &(&Motion<D>, f64)| {
                let square = largest_difference(one, other);
                square + rim * (2.0 * square.sqrt() + rim)
            };
            others[k + 1..].iter().map(meeting)
        });
        pairs.chain(of_images).fold(0.0, f64::max)
    }

    /// Velocity in the middle of those that walls have during the run, of bodies where nothing bounds them `[m/s]`: speeds are relative to it.
    /// Openings and planes of symmetry rest.
    pub(super) fn frame(&self) -> Vector<D> {
        let mut motions = self.motions_of_walls();
        motions.extend(self.sides.has_mirror().then(Motion::default));
        if motions.is_empty() {
            motions = self.motions_of_material();
        }
        let velocities = motions.iter().flat_map(|motion| {
            let later = motion.times.iter().copied().filter(|time| *time < self.duration);
            std::iter::once(0.0).chain(later).map(|time| motion.velocity(time))
        });
        let (lower, upper) = shapes::around(velocities);
        if motions.is_empty() { Vector::zeros() } else { (lower + upper) * 0.5 }
    }

    /// Motions of bodies and of the inflow, as they start.
    fn motions_of_material(&self) -> Vec<Motion<D>> {
        let bodies = self.bodies.iter().map(SceneBody::velocity);
        let fed = self.feeds().into_iter().map(|feed| feed.direction() * (feed.largest_speed() * (1.0 + MARGIN)));
        let steady = |velocity: Vector<D>| vec![Vector::zeros(), velocity * FOR_EVER];
        bodies
            .chain(fed)
            .map(|velocity| Motion { times: vec![0.0, FOR_EVER], displacements: steady(velocity), ..Motion::default() })
            .collect()
    }

    /// Motions of walls, and of the openings of inlets, which rest.
    fn motions_of_walls(&self) -> Vec<Motion<D>> {
        let openings = self.inlets.iter().map(|_| Motion::default());
        self.walls.iter().map(SceneWall::motion).chain(openings).collect()
    }

    /// Whether each wall rests: it moves like most walls, bodies and openings of the scene, of two that do like the first.
    fn resting_walls(&self) -> Vec<bool> {
        let (walls, material) = (self.motions_of_walls(), self.motions_of_material());
        let company = |one: &Motion<D>| walls.iter().chain(&material).filter(|other| is_common(one, other)).count();
        let frame = walls.iter().rev().max_by_key(|wall| company(wall));
        walls.iter().map(|wall| frame.is_some_and(|frame| is_common(frame, wall))).collect()
    }

    /// Height along gravity of the material, at the start or in inlets, and of what it can fall onto `[m]`; bodies count by their boxes.
    /// Resting walls count to their lowest corner, but facets that do not face upwards neither between or below floors nor beyond the sides
    /// of the domain. A wall that moves counts as a floor at its top, whatever its length and travel are.
    pub(super) fn height(&self) -> f64 {
        let up = -self.down();
        let of_inlets = self.inlets.iter().flat_map(SceneInlet::corners).map(|place| (up.dot(&place), up.dot(&place)));
        let spans = self.bodies.iter().map(|body| body.span(&up)).chain(of_inlets);
        let none = (f64::INFINITY, f64::NEG_INFINITY);
        let (mut lowest, highest) = spans.fold(none, |(low, high), span| (low.min(span.0), high.max(span.1)));
        let beside = |place: &Vector<D>| place - up * up.dot(place);
        let (mut low, mut high) = (Vector::<D>::repeat(f64::INFINITY), Vector::<D>::repeat(f64::NEG_INFINITY));
        let mut faces = Vec::new();
        for (wall, rests) in self.walls.iter().zip(self.resting_walls()) {
            let mut top = None;
            for facet in wall.facet_wall().facets {
                let heights = facet.corners.map(|corner| up.dot(&corner));
                if facet.normal.dot(&up) <= PARALLEL {
                    faces.extend(rests.then_some((facet, heights)));
                } else if rests {
                    lowest = heights.into_iter().fold(lowest, f64::min);
                    for corner in facet.corners {
                        (low, high) = (low.inf(&beside(&corner)), high.sup(&beside(&corner)));
                    }
                } else {
                    top = heights.into_iter().chain(top).reduce(f64::max);
                }
            }
            lowest = lowest.min(top.unwrap_or(f64::INFINITY));
        }
        // by the rounding of a place along gravity
        let slack = 1e-9 * self.spacing;
        let is_between_floors = |place: Vector<D>| {
            let place = beside(&place);
            (0..D).all(|axis| place[axis] >= low[axis] - slack && place[axis] <= high[axis] + slack)
        };
        let inside = |corner: Vector<D>| {
            let (raised, _) = self.sides.clip((corner, corner));
            self.sides.clip((raised, raised)).1
        };
        let floor = lowest;
        for (face, heights) in &faces {
            let below = face.corners.iter().zip(heights).filter(|(_, height)| **height < floor);
            for end in below.map(|(corner, _)| inside(*corner)) {
                if !is_between_floors(end + face.normal * (0.5 * self.spacing)) {
                    lowest = lowest.min(up.dot(&end));
                }
            }
        }
        highest - lowest
    }
}

/// Square of the largest relative speed of two motions `[m²/s²]`, while the tables of both last.
fn largest_difference<const D: usize>(one: &Motion<D>, other: &Motion<D>) -> f64 {
    let last = |motion: &Motion<D>| motion.times.last().copied().unwrap_or(f64::INFINITY);
    let end = last(one).min(last(other));
    let times = one.times.iter().chain(&other.times).filter(|time| **time < end);
    times.map(|time| (one.velocity(*time) - other.velocity(*time)).norm_squared()).fold(0.0, f64::max)
}

/// Whether two motions are one.
fn is_common<const D: usize>(one: &Motion<D>, other: &Motion<D>) -> bool {
    let fastest = [one, other].map(|motion| motion.largest_speed(&Vector::zeros())).into_iter().fold(0.0, f64::max);
    largest_difference(one, other) <= ROUNDING * fastest.powi(2)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::enclosed::{DomainSide, SceneStart, quick, setting};
    use crate::scene::{FlowSide, Plane, PlaneBody, PlaneInlet, PlaneSides, PlaneVector, WallLine};

    type Flow = SceneFlow<Plane, 2>;

    const GRAVITY: f64 = 9.81;

    fn body(lower: PlaneVector, upper: PlaneVector, velocity: PlaneVector) -> PlaneBody {
        PlaneBody::Box { lower, upper, velocity }
    }

    /// A wall with its flow on the left, which moves at a velocity for ten seconds.
    fn wall(name: &str, points: &[PlaneVector], velocity: PlaneVector) -> WallLine {
        let way = (10.0, 10.0 * velocity.0, 10.0 * velocity.1);
        let motion = if velocity == (0.0, 0.0) { Vec::new() } else { vec![(0.0, 0.0, 0.0), way] };
        WallLine {
            name: name.to_owned(),
            points: points.to_vec(),
            closed: false,
            flow: FlowSide::Left,
            surface: setting::rough(),
            both_sides: false,
            motion,
            load: None,
            turn: None,
        }
    }

    fn flow(bodies: Vec<PlaneBody>, walls: Vec<WallLine>) -> Flow {
        let mut flow = quick::<Plane, 2>();
        (flow.bodies, flow.walls, flow.gauges, flow.sides) = (bodies, walls, Vec::new(), PlaneSides::default());
        (flow.gravity, flow.spacing) = ((0.0, -GRAVITY), 0.01);
        flow
    }

    fn sound(flow: &Flow) -> f64 {
        flow.equation_of_state().sound_speed()
    }

    /// Sound of the default stiffness over a scale of squared speeds `[m/s]`.
    fn of(scale: f64) -> f64 {
        (50.0 * scale).sqrt()
    }

    fn assert_near(value: f64, expected: f64, what: &str) {
        assert!((value / expected - 1.0).abs() < 1e-9, "{what}: {value}, not {expected}");
    }

    /// A scene whose places and directions are mapped; a mirror image turns its walls.
    fn mapped(flow: &Flow, map: fn(PlaneVector) -> PlaneVector, mirrors: bool) -> Flow {
        let mut image = flow.clone();
        image.gravity = map(flow.gravity);
        for body in &mut image.bodies {
            let PlaneBody::Box { lower, upper, velocity } = body else { unreachable!("a box") };
            let (one, other) = (map(*lower), map(*upper));
            (*lower, *upper) = ((one.0.min(other.0), one.1.min(other.1)), (one.0.max(other.0), one.1.max(other.1)));
            *velocity = map(*velocity);
        }
        for wall in &mut image.walls {
            wall.points = wall.points.iter().map(|point| map(*point)).collect();
            wall.flow = if mirrors { FlowSide::Right } else { FlowSide::Left };
            for row in &mut wall.motion {
                (row.1, row.2) = map((row.1, row.2));
            }
        }
        image
    }

    /// A scene seen from a frame that moves: all bodies and walls have one more velocity.
    fn moving(flow: &Flow, velocity: PlaneVector) -> Flow {
        let mut seen = flow.clone();
        for body in &mut seen.bodies {
            let PlaneBody::Box { velocity: own, .. } = body else { unreachable!("a box") };
            *own = (own.0 + velocity.0, own.1 + velocity.1);
        }
        for wall in &mut seen.walls {
            if wall.motion.is_empty() {
                wall.motion = vec![(0.0, 0.0, 0.0), (10.0, 0.0, 0.0)];
            }
            for (time, x, y) in &mut wall.motion {
                (*x, *y) = (*x + *time * velocity.0, *y + *time * velocity.1);
            }
        }
        seen
    }

    /// A tank of 1 m with a lid that moves along itself: on top, or at the left.
    fn cavity(on_top: bool) -> Flow {
        let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)];
        let (tank, lid, along) = if on_top {
            ([corners[3], corners[0], corners[1], corners[2]], [(14.0, 1.0), (-1.0, 1.0)], (1.0, 0.0))
        } else {
            (corners, [(0.0, 1.4), (0.0, -12.0)], (0.0, 1.0))
        };
        flow(
            vec![body((0.0, 0.0), (1.0, 1.0), (0.0, 0.0))],
            vec![wall("tank", &tank, (0.0, 0.0)), wall("lid", &lid, along)],
        )
    }

    /// Grains that fall by 0.5 m onto a slope that ends 0.3 m lower, beside a block that comes at 6 m/s.
    fn fall() -> Flow {
        flow(
            vec![body((0.0, 0.5), (0.2, 0.7), (0.0, 0.0)), body((0.4, 0.5), (0.6, 0.7), (-6.0, 0.0))],
            vec![wall("slope", &[(-0.2, 0.0), (0.8, -0.3)], (0.0, 0.0))],
        )
    }

    #[test]
    fn turns_mirror_images_and_moving_frames_keep_the_sound_speed() {
        let slab = flow(
            vec![body((0.2, 0.0), (0.5, 0.04), (-2.0, 0.0))],
            vec![wall("belt", &[(-0.6, 0.0), (1.4, 0.0)], (0.0, 0.0))],
        );
        let mut slow = fall();
        slow.bodies.pop();
        for (what, scene, scale) in [
            ("lid on top", cavity(true), GRAVITY),
            ("lid at the left", cavity(false), GRAVITY),
            ("slab", slab, 2.0),
            ("block", fall(), 18.0),
            ("fall", slow, GRAVITY),
        ] {
            assert_near(sound(&scene), of(scale), what);
            let mut turned = scene.clone();
            for quarter in 1..4 {
                turned = mapped(&turned, |(x, y)| (-y, x), false);
                assert_near(sound(&turned), of(scale), &format!("{what}, {quarter} quarter turns"));
            }
            assert_near(sound(&mapped(&scene, |(x, y)| (-x, y), true)), of(scale), what);
            for velocity in [(3.0, 0.0), (0.0, -40.0), (-0.1, 0.7)] {
                assert_near(sound(&moving(&scene, velocity)), of(scale), &format!("{what} at {velocity:?}"));
            }
        }
    }

    #[test]
    fn a_sliding_slab_and_a_belt_below_it_have_one_sound_speed() {
        let pair = |speed: f64| {
            let slab = |velocity| vec![body((0.2, 0.0), (0.5, 0.04), velocity)];
            let belt = |velocity| vec![wall("belt", &[(-0.6, 0.0), (1.4, 0.0)], velocity)];
            let sliding = flow(slab((-speed, 0.0)), belt((0.0, 0.0)));
            [sound(&sliding), sound(&flow(slab((0.0, 0.0)), belt((speed, 0.0))))]
        };
        for (speed, scale) in [(0.5, 0.04 * GRAVITY), (2.0, 2.0), (8.0, 32.0)] {
            pair(speed).into_iter().for_each(|sound| assert_near(sound, of(scale), &format!("{speed} m/s")));
        }
        // the largest speed of a belt's table counts, with its direction
        let mut belt = flow(vec![body((0.2, 0.0), (0.5, 0.04), (1.0, 0.0))], Vec::new());
        belt.walls = vec![wall("belt", &[(-0.6, 0.0), (1.4, 0.0)], (0.0, 0.0))];
        belt.walls[0].motion = vec![(0.0, 0.0, 0.0), (1.0, 1.0, 0.0), (2.0, -2.0, 0.0), (3.0, -2.0, 0.0)];
        assert_near(sound(&belt), of(8.0), "−3 m/s against 1 m/s");
    }

    #[test]
    fn lengths_and_travels_of_walls_do_not_count() {
        let (body, rest) = (body((0.0, 0.0), (1.0, 0.3), (0.0, 0.0)), (0.0, 0.0));
        let floor = wall("floor", &[(0.0, 0.0), (1.0, 0.0)], rest);
        let sides = |depth: f64| {
            let left = wall("left", &[(0.0, 1.0), (0.0, -depth)], rest);
            vec![left, wall("right", &[(1.0, -depth), (1.0, 1.0)], rest), floor.clone()]
        };
        for depth in [0.0, 0.5, 20.0] {
            assert_near(flow(vec![body.clone()], sides(depth)).height(), 0.3, &format!("walls to −{depth} m"));
        }
        // beyond the edge of the floor, material falls along the wall
        let cliff = wall("cliff", &[(0.5, 0.0), (0.5, -0.7)], rest);
        let short = wall("floor", &[(0.0, 0.0), (0.5, 0.0)], rest);
        assert_near(flow(vec![body.clone()], vec![short, cliff]).height(), 1.0, "a cliff");
        // channel along gravity, through a period
        let mut channel = flow(vec![body.clone()], vec![wall("low", &[(-9.0, 0.0), (9.0, 0.0)], rest)]);
        channel.gravity = (1.0, 0.0);
        (channel.sides.left, channel.sides.right) = (DomainSide::Periodic(0.0), DomainSide::Periodic(1.0));
        assert_near(channel.height(), 1.0, "a channel");
        // a moving tray below a tank counts at its top, a gate that is drawn not at all
        let tank = |other: WallLine| flow(vec![body.clone()], vec![floor.clone(), other]).height();
        assert_near(tank(wall("tray", &[(1.2, -0.2), (1.0, -0.3), (4.0, -0.2)], (2.0, 0.0))), 0.5, "a tray");
        assert_near(tank(wall("gate", &[(1.0, -2.0), (1.0, 2.0)], (0.0, 1.0))), 0.3, "a gate");
    }

    #[test]
    fn a_stiffness_of_its_own_multiplies_the_fall_alone() {
        let mut scene = fall();
        scene.stiffness = Some(50.0);
        assert_near(sound(&scene), of(GRAVITY), "over g H");
        assert_near(scene.relative_speed(), 6.0, "relative speed");
        scene.gravity = (0.0, 0.0);
        assert_near(sound(&scene), of(18.0), "without gravity");
        scene.pressure = 20.0 * scene.bulk.density(&scene.material);
        assert_near(sound(&scene), of(20.0), "over p/ρ");
    }

    #[test]
    fn a_scene_from_a_state_keeps_the_bulk_modulus_of_the_state() {
        let mut scene = fall();
        let (file, sha256) = ("state".to_owned(), String::new());
        scene.from = Some(SceneStart { file, sha256, bulk_modulus: Some(1.2e5) });
        assert_eq!(scene.equation_of_state().bulk_modulus, 1.2e5);
        assert!(scene.summary().contains("that of the state it starts from"), "{}", scene.summary());
    }

    #[test]
    fn inflow_and_mirror_images_count_by_their_relative_speed() {
        let mut fed = flow(Vec::new(), vec![wall("bed", &[(-0.1, 0.0), (1.0, 0.0)], (0.0, 0.0))]);
        let density = fed.bulk.density(&fed.material);
        let feed = "name = \"feed\"\nfrom = [0.0, 0.1]\nto = [0.0, 0.0]";
        let mut inlet: PlaneInlet = toml::from_str(feed).expect("an inlet");
        inlet.rate = 0.1 * density * 4.0;
        fed.inlets = vec![inlet];
        assert!((sound(&fed) / 20.0 - 1.0).abs() < 1e-8 && fed.check_inlets().is_ok(), "{}", sound(&fed));
        fed.walls[0] = wall("bed", &[(-0.1, 0.0), (1.0, 0.0)], (-2.0, 0.0));
        assert!((sound(&fed) / 30.0 - 1.0).abs() < 1e-8, "{}", sound(&fed));
        fed.stiffness = Some(50.0);
        assert!(fed.check_inlets().expect_err("too fast").to_string().contains("raise `stiffness` to"));
        // half of two blocks that meet, and both
        let block = |left: f64, speed: f64| body((left, 0.0), (left + 0.1, 0.1), (speed, 0.0));
        let mut half = flow(vec![block(-0.2, 3.0)], Vec::new());
        half.sides.right = DomainSide::Mirror(0.0);
        let both = flow(vec![block(-0.2, 3.0), block(0.1, -3.0)], Vec::new());
        assert_near(sound(&half), of(18.0), "half");
        assert_near(sound(&both), of(18.0), "both");
    }
}
