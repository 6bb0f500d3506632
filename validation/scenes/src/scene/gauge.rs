//! Gauges: what is measured while a scene runs, as series over time.

use super::PlaneVector;
use crate::case::ParameterError;
use crate::enclosed::names::check_line;
use crate::enclosed::setting::{self, vector};
use crate::enclosed::{DepthGauge, Measurand, Opening, Probe};
use crate::setup::front::FrontLine;
use bagnold_solver::parameter::{at_least, positive};
use bagnold_solver::vector::Vector;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Quantity that a gauge measures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum PlaneGauge {
    /// Front of the material along a line: the first place behind its start where less than a thickness stands
    /// across it. A bed below more than half of the line at the start does not count.
    Front {
        /// Name of the gauge: letters, digits and hyphens, unlike those of other gauges.
        name: String,
        /// Start of the line x, y `[m]`.
        from: PlaneVector,
        /// End of the line x, y `[m]`.
        to: PlaneVector,
        /// Thickness `[m]`; below two spacings the front jumps by rows. An upright face reads half a spacing too far.
        #[schemars(transform = positive("give it in metres, such as two spacings"))]
        thickness: f64,
    },
    /// Thickness of the material around a place, along gravity, another direction or the normal of a wall: its volume within a
    /// width, over that width.
    Depth {
        /// Name of the gauge: letters, digits and hyphens, unlike those of other gauges.
        name: String,
        /// The place x, y `[m]`.
        at: PlaneVector,
        /// Width across the direction `[m]`.
        #[schemars(transform = positive("give it in metres, such as four spacings"))]
        width: f64,
        /// Direction of the measurement, unless along gravity: x, y of any length `[-]`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        direction: Option<PlaneVector>,
        /// Name of the wall along whose normal it is measured, unless along gravity: that of its nearest segment.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        normal_to: Option<String>,
    },
    /// Velocity, pressure and pore pressure at a place, by a line fitted to the particles around it.
    Probe {
        /// Name of the gauge: letters, digits and hyphens, unlike those of other gauges.
        name: String,
        /// The place x, y `[m]`; on a wall or the free surface the lines are continued to it. Without particles around it has no value.
        at: PlaneVector,
        /// Diameter of the circle whose particles count, in spacings `[-]`.
        #[serde(default = "setting::probe_width")]
        #[schemars(transform = at_least(2.0, "give 5, within which lie about 20 particles"))]
        spacings: f64,
    },
    /// Force of the flow on a wall, along x and y.
    Force {
        /// Name of the gauge: letters, digits and hyphens, unlike those of other gauges.
        name: String,
        /// Name of the wall.
        wall: String,
    },
    /// Displacement of a wall since the start.
    Position {
        /// Name of the gauge: letters, digits and hyphens, unlike those of other gauges.
        name: String,
        /// Name of the wall.
        wall: String,
    },
    /// Torque of the flow on a wall that turns, about its point or axis as the angle counts, and that angle.
    Turn {
        /// Name of the gauge: letters, digits and hyphens, unlike those of other gauges.
        name: String,
        /// Name of the wall.
        wall: String,
    },
    /// Mass that crosses a line from its right to its left, seen along it: together, and per time.
    Flux {
        /// Name of the gauge: letters, digits and hyphens, unlike those of other gauges.
        name: String,
        /// Start of the line x, y `[m]`.
        from: PlaneVector,
        /// End of the line x, y `[m]`.
        to: PlaneVector,
    },
}

impl setting::SceneGauge<2> for PlaneGauge {
    fn name(&self) -> &str {
        let (Self::Front { name, .. }
        | Self::Depth { name, .. }
        | Self::Probe { name, .. }
        | Self::Force { name, .. }
        | Self::Position { name, .. }
        | Self::Turn { name, .. }
        | Self::Flux { name, .. }) = self;
        name
    }

    fn along(&self) -> (Option<Vector<2>>, Option<&str>) {
        let Self::Depth { direction, normal_to, .. } = self else { return (None, None) };
        (direction.as_ref().map(vector), normal_to.as_deref())
    }

    fn measure(&self, down: &Vector<2>) -> Measurand<'_, 2> {
        match self {
            Self::Front { from, to, thickness, .. } => {
                let (from, to) = (vector(from), vector(to));
                Measurand::Front(FrontLine { from, to, section: *thickness, strip: None, side: None })
            }
            Self::Depth { at, width, .. } => {
                Measurand::Depth(DepthGauge { at: vector(at), direction: *down, width: *width, section: *width })
            }
            Self::Probe { at, spacings, .. } => Measurand::Probe(Probe { at: vector(at), reach: 0.5 * spacings }),
            Self::Force { wall, .. } => Measurand::Force(wall),
            Self::Position { wall, .. } => Measurand::Position(wall),
            Self::Turn { wall, .. } => Measurand::Turn(wall),
            Self::Flux { from, to, .. } => {
                let (corner, to): (Vector<2>, Vector<2>) = (vector(from), vector(to));
                let along = to - corner;
                let normal = Vector::<2>::new(-along[1], along[0]);
                Measurand::Flux(Opening { corner, normal, edges: vec![(along, along.norm_squared())] })
            }
        }
    }

    fn places(&self) -> Vec<Vector<2>> {
        match self {
            Self::Front { from, to, .. } | Self::Flux { from, to, .. } => vec![vector(from), vector(to)],
            Self::Depth { at, .. } | Self::Probe { at, .. } => vec![vector(at)],
            Self::Force { .. } | Self::Position { .. } | Self::Turn { .. } => Vec::new(),
        }
    }

    fn check(&self, spacing: f64, _: &Vector<2>) -> Result<(), ParameterError> {
        match self {
            Self::Front { from, to, .. } | Self::Flux { from, to, .. } => {
                let to = vector::<2>(to);
                check_line(&to, (to - vector::<2>(from)).norm(), spacing, "")
            }
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::enclosed::gauges::Memory;
    use crate::enclosed::periods::Periods;
    use crate::enclosed::setting::SceneGauge as _;
    use bagnold_solver::domain::AxisBoundary;
    use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
    use bagnold_solver::material::rheology::{Newtonian, Rheology};
    use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
    use bagnold_solver::weakly_compressible::simulation::Simulation;

    /// A block of 20 by 8 particles of 1 cm that flies to the right with 1 m/s.
    fn block() -> Simulation<2> {
        Simulation::new(block_scene()).expect("a scene")
    }

    fn block_scene() -> Scene<2> {
        let site = |k: usize| Vector::<2>::new((k % 20) as f64 + 0.5, (k / 20) as f64 + 0.5) * 0.01;
        let mut flow = Flow::at_rest((0..160).map(site).collect(), 1000.0, 0.01);
        flow.velocity.fill(Vector::<2>::new(1.0, 0.0));
        let liquid = EquationOfState { reference_density: 1000.0, bulk_modulus: 1e5, tension: Tension::Cut };
        let law = Rheology::Newtonian(Newtonian { viscosity: 1.0 });
        Scene::unbounded(flow, 0.01, liquid, law)
    }

    #[test]
    fn a_block_that_flies_reaches_and_crosses_what_it_should() {
        let gauge = |text: &str| toml::from_str::<PlaneGauge>(text).expect("a gauge");
        let gauges = [
            gauge("kind = \"front\"\nname = \"front\"\nfrom = [0.0, 0.0]\nto = [1.0, 0.0]\nthickness = 0.04"),
            gauge("kind = \"depth\"\nname = \"depth\"\nat = [0.1, 0.0]\nwidth = 0.04"),
            gauge("kind = \"flux\"\nname = \"down\"\nfrom = [0.15, 1.0]\nto = [0.15, -1.0]"),
            gauge("kind = \"flux\"\nname = \"beside\"\nfrom = [0.15, 1.0]\nto = [0.15, 0.5]"),
        ];
        let (mut simulation, mut memory) = (block(), Memory::default());
        let down = Vector::<2>::new(0.0, -1.0);
        let measures: Vec<_> = gauges.iter().map(|gauge| gauge.measure(&down)).collect();
        let unbounded = Periods::of(&[AxisBoundary::Open; 2]);
        let start = memory.read_all(&measures, &simulation, &simulation.snapshot(), (160, &unbounded));
        assert!((start[0] - 0.2).abs() < 0.01 && (start[3] - 0.08).abs() < 1e-12, "{start:?}");
        assert!(start[1] <= start[0] && start[0] <= start[2] && start[2] - start[1] < 0.011, "{start:?}");
        assert_eq!(start[4..], [0.0; 4], "nothing has moved");
        while simulation.time() < 0.03 {
            simulation.step().expect("no divergence");
        }
        let end = memory.read_all(&measures, &simulation, &simulation.snapshot(), (160, &unbounded));
        let way = simulation.time();
        assert!((end[0] - start[0] - way).abs() < 0.006, "{} m after {way} m", end[0] - start[0]);
        // three columns of eight particles of 0.1 kg/m
        assert!((end[4] - 2.4).abs() < 1e-9 && (end[5] - 2.4 / way).abs() < 1e-6, "{end:?}");
        assert_eq!(end[6..], [0.0; 2], "nothing crosses beside the line");
    }

    #[test]
    fn a_front_along_a_bed_is_that_of_what_lies_above_it() {
        // a column of 5 by 4 particles of 1 cm on a bed of 40 by 4
        let site = |k: usize| if k < 160 { (k % 40, k / 40) } else { ((k - 160) % 5, 4 + (k - 160) / 5) };
        let place = |(x, y): (usize, usize)| Vector::<2>::new(x as f64 + 0.5, y as f64 + 0.5) * 0.01;
        let mut scene = block_scene();
        scene.flow = Flow::at_rest((0..180).map(|k| place(site(k))).collect(), 1000.0, 0.01);
        let simulation = Simulation::new(scene).expect("a scene");
        let (down, unbounded) = (Vector::<2>::new(0.0, -1.0), Periods::of(&[AxisBoundary::Open; 2]));
        let front = |from: &str, to: &str| {
            let text = format!("kind = \"front\"\nname = \"front\"\nfrom = {from}\nto = {to}\nthickness = 0.02");
            let gauge = toml::from_str::<PlaneGauge>(&text).expect("a gauge");
            let (measures, snapshot) = ([gauge.measure(&down)], simulation.snapshot());
            let mut memory = Memory::default();
            let follows = memory.find_beds(&measures, &down, &simulation, &snapshot).any(|is_above| is_above);
            (follows, memory.read_all(&measures, &simulation, &snapshot, (180, &unbounded))[0])
        };
        let (above, on_surface) = front("[0.0, 0.04]", "[0.4, 0.04]");
        assert!(above && (on_surface - 0.05).abs() < 0.01, "{on_surface} m");
        // along the floor all counts, and against gravity there is no bed
        let (above, on_floor) = front("[0.0, 0.0]", "[0.6, 0.0]");
        assert!(!above && (on_floor - 0.4).abs() < 0.01, "{on_floor} m");
        let (above, upwards) = front("[0.02, 0.0]", "[0.02, 0.2]");
        assert!(!above && (upwards - 0.08).abs() < 0.01, "{upwards} m");
    }

    /// Velocities that are linear in space, on which the fit is exact also at a corner.
    #[test]
    fn a_probe_reads_the_lines_of_a_moving_block() {
        let mut scene = block_scene();
        for (velocity, place) in scene.flow.velocity.iter_mut().zip(&scene.flow.position) {
            *velocity = Vector::<2>::new(1.0 + 3.0 * place[1], -2.0 * place[0]);
        }
        let simulation = Simulation::new(scene).expect("a scene");
        for (at, expected) in [("[0.1, 0.04]", [1.12, -0.2]), ("[0.0, 0.08]", [1.24, 0.0])] {
            let found = probed(at, &simulation);
            assert!((found[2] - expected[0]).abs() < 1e-12 && (found[3] - expected[1]).abs() < 1e-12, "{found:?}");
            assert_eq!(found[..2], [0.0; 2], "no pressure, and no liquid in the pores");
        }
        let nothing = probed("[3.0, 3.0]", &simulation);
        assert!(nothing.len() == 4 && nothing.iter().all(|value| value.is_nan()), "{nothing:?}");
    }

    /// The values of a probe at a place in a simulation without periodic sides.
    fn probed(at: &str, simulation: &Simulation<2>) -> Vec<f64> {
        let text = format!("kind = \"probe\"\nname = \"probe\"\nat = {at}");
        let gauge = toml::from_str::<PlaneGauge>(&text).expect("a gauge");
        let measures = [gauge.measure(&Vector::<2>::new(0.0, -1.0))];
        let unbounded = Periods::of(&[AxisBoundary::Open; 2]);
        Memory::default().read_all(&measures, simulation, &simulation.snapshot(), (160, &unbounded))
    }

    /// Grains that are pressed less and less towards the place they come to: the line through their pressures ends below zero there.
    #[test]
    fn a_probe_that_is_being_wetted_reads_no_tension_that_the_law_has_not() {
        let with = |tension: Tension| {
            let mut scene = block_scene();
            scene.equation_of_state.tension = tension;
            for (density, place) in scene.flow.density.iter_mut().zip(&scene.flow.position) {
                *density += 10.0 * (0.195 - place[0]);
            }
            let simulation = Simulation::new(scene).expect("a scene");
            [probed("[0.205, 0.04]", &simulation)[0], probed("[0.19, 0.04]", &simulation)[0]]
        };
        let ([cut, inside], [kept, same]) = (with(Tension::Cut), with(Tension::Kept));
        assert!((inside - 5.0).abs() < 1e-6 && inside == same, "1 Pa/mm: {inside} and {same} Pa");
        assert!(cut == 0.0 && (kept + 10.0).abs() < 1e-6, "{cut} and {kept} Pa");
    }

    /// A layer of 8 rows of 1 cm that is 20 columns long and comes in again at the other side, and slides there with 1 m/s.
    fn sliding_layer() -> Simulation<2> {
        let mut scene = block_scene();
        scene.domain.axes[0] = AxisBoundary::Periodic { lower: 0.0, upper: 0.2 };
        Simulation::new(scene).expect("a scene")
    }

    #[test]
    fn periodic_wrap_crosses_no_line() {
        let gauge = |text: &str| toml::from_str::<PlaneGauge>(text).expect("a gauge");
        let gauges = [
            gauge("kind = \"flux\"\nname = \"inside\"\nfrom = [0.15, 1.0]\nto = [0.15, -1.0]"),
            gauge("kind = \"flux\"\nname = \"at-the-side\"\nfrom = [0.2, 1.0]\nto = [0.2, -1.0]"),
            gauge("kind = \"flux\"\nname = \"along\"\nfrom = [-1.0, 0.04]\nto = [1.0, 0.04]"),
        ];
        let down = Vector::<2>::new(0.0, -1.0);
        let measures: Vec<_> = gauges.iter().map(|gauge| gauge.measure(&down)).collect();
        let (mut simulation, mut memory) = (sliding_layer(), Memory::default());
        let periods = Periods::of(&[AxisBoundary::Periodic { lower: 0.0, upper: 0.2 }, AxisBoundary::Open]);
        memory.read_all(&measures, &simulation, &simulation.snapshot(), (160, &periods));
        // samples of a little more than a period and a half, and of less
        for sample in [0.31, 0.37, 0.53] {
            while simulation.time() < sample {
                simulation.step().expect("no divergence");
            }
            let values = memory.read_all(&measures, &simulation, &simulation.snapshot(), (160, &periods));
            // whole columns of 0.8 kg/m have crossed
            for crossed in [values[0], values[2]] {
                assert!((crossed - 80.0 * simulation.time()).abs() < 0.81, "{crossed} at {} s", simulation.time());
            }
            assert_eq!(values[4], 0.0, "nothing crosses a line along which all slides");
        }
    }

    #[test]
    fn the_thickness_of_a_layer_between_periodic_sides_is_not_cut_at_them() {
        let simulation = sliding_layer();
        let snapshot = simulation.snapshot();
        let axes = [AxisBoundary::Periodic { lower: 0.0, upper: 0.2 }, AxisBoundary::Open];
        let thickness = |direction: Vector<2>| {
            let text = "kind = \"depth\"\nname = \"depth\"\nat = [0.19, 0.0]\nwidth = 0.03";
            let gauge = toml::from_str::<PlaneGauge>(text).expect("a gauge");
            let mut memory = Memory::default();
            let measures = [gauge.measure(&direction)];
            memory.read_all(&measures, &simulation, &snapshot, (160, &Periods::of(&axes)))[0]
        };
        assert!((thickness(Vector::<2>::new(0.0, -1.0)) - 0.08).abs() < 1e-12);
        for degrees in [20.0_f64, 45.0, 70.0, -45.0] {
            let angle = degrees.to_radians();
            let slanted = thickness(Vector::<2>::new(angle.sin(), -angle.cos()));
            assert!((slanted * angle.cos() / 0.08 - 1.0).abs() < 0.005, "{slanted} m at {degrees}°");
        }
    }
}
