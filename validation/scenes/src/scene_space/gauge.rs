//! Gauges: what is measured while a scene in space runs, as series over time.

use super::SpaceVector;
use crate::case::ParameterError;
use crate::enclosed::names::check_line;
use crate::enclosed::setting::{self, shown, vector};
use crate::enclosed::{DepthGauge, Measurand, Opening, Probe};
use crate::setup::front::FrontLine;
use bagnold_solver::parameter::{at_least, positive};
use bagnold_solver::vector::Vector;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Quantity that a gauge measures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum SpaceGauge {
    /// Front of the material along a line: the first place behind its start where, on the mean over a width, less
    /// than a thickness stands across it. A bed below more than half of the line at the start does not count.
    Front {
        /// Name of the gauge: letters, digits and hyphens, unlike those of other gauges.
        name: String,
        /// Start of the line x, y, z `[m]`.
        from: SpaceVector,
        /// End of the line x, y, z `[m]`.
        to: SpaceVector,
        /// Thickness `[m]`; below two spacings the front jumps by rows. An upright face reads half a spacing too far.
        #[schemars(transform = positive("give it in metres, such as two spacings"))]
        thickness: f64,
        /// Width across the line and gravity, half of it to either side `[m]`: as wide as the channel, or less.
        #[schemars(transform = positive("give it in metres, such as four spacings"))]
        width: f64,
    },
    /// Thickness of the material around a place, along gravity, another direction or the normal of a wall: its volume within
    /// a circle, over the circle's area.
    Depth {
        /// Name of the gauge: letters, digits and hyphens, unlike those of other gauges.
        name: String,
        /// The place x, y, z `[m]`, at least half a width from mirrors and walls.
        at: SpaceVector,
        /// Diameter of the circle `[m]`.
        #[schemars(transform = positive("give it in metres, such as four spacings"))]
        width: f64,
        /// Direction of the measurement, unless along gravity: x, y, z of any length `[-]`.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        direction: Option<SpaceVector>,
        /// Name of the wall along whose normal it is measured, unless along gravity: that of its nearest triangle.
        #[serde(default, skip_serializing_if = "Option::is_none")]
        normal_to: Option<String>,
    },
    /// Velocity, pressure and pore pressure at a place, by a line fitted to the particles around it.
    Probe {
        /// Name of the gauge: letters, digits and hyphens, unlike those of other gauges.
        name: String,
        /// The place x, y, z `[m]`; on a wall or the free surface the lines are continued to it. Without particles around it has no value.
        at: SpaceVector,
        /// Diameter of the circle whose particles count, in spacings `[-]`.
        #[serde(default = "setting::probe_width")]
        #[schemars(transform = at_least(2.0, "give 5, within which lie about 20 particles in 2-D"))]
        spacings: f64,
    },
    /// Force of the flow on a wall, along x, y and z.
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
    /// Mass that crosses a parallelogram towards the side from which its corners are seen against the clock: together,
    /// and per time.
    Flux {
        /// Name of the gauge: letters, digits and hyphens, unlike those of other gauges.
        name: String,
        /// A corner and the two next to it x, y, z `[m]`.
        corners: (SpaceVector, SpaceVector, SpaceVector),
    },
}

impl setting::SceneGauge<3> for SpaceGauge {
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

    fn along(&self) -> (Option<Vector<3>>, Option<&str>) {
        let Self::Depth { direction, normal_to, .. } = self else { return (None, None) };
        (direction.as_ref().map(vector), normal_to.as_deref())
    }

    fn measure(&self, down: &Vector<3>) -> Measurand<'_, 3> {
        match self {
            Self::Front { from, to, thickness, width, .. } => {
                let (from, to): (Vector<3>, Vector<3>) = (vector(from), vector(to));
                let across = down.cross(&(to - from)).normalize();
                let strip = Some((across, 0.5 * width));
                Measurand::Front(FrontLine { from, to, section: thickness * width, strip, side: None })
            }
            Self::Depth { at, width, .. } => {
                let section = std::f64::consts::FRAC_PI_4 * width * width;
                Measurand::Depth(DepthGauge { at: vector(at), direction: *down, width: *width, section })
            }
            Self::Probe { at, spacings, .. } => Measurand::Probe(Probe { at: vector(at), reach: 0.5 * spacings }),
            Self::Force { wall, .. } => Measurand::Force(wall),
            Self::Position { wall, .. } => Measurand::Position(wall),
            Self::Turn { wall, .. } => Measurand::Turn(wall),
            Self::Flux { corners, .. } => {
                let [corner, one, other] = edges(corners);
                let normal = one.cross(&other);
                let square = normal.norm_squared();
                let edges = vec![(other.cross(&normal), square), (normal.cross(&one), square)];
                Measurand::Flux(Opening { corner, normal, edges })
            }
        }
    }

    fn places(&self) -> Vec<Vector<3>> {
        match self {
            Self::Front { from, to, .. } => vec![vector(from), vector(to)],
            Self::Flux { corners, .. } => {
                let [corner, one, other] = edges(corners);
                vec![corner, corner + one, corner + other, corner + one + other]
            }
            Self::Depth { at, .. } | Self::Probe { at, .. } => vec![vector(at)],
            Self::Force { .. } | Self::Position { .. } | Self::Turn { .. } => Vec::new(),
        }
    }

    fn check(&self, spacing: f64, down: &Vector<3>) -> Result<(), ParameterError> {
        match self {
            Self::Front { from, to, .. } => {
                let to = vector::<3>(to);
                let line = to - vector::<3>(from);
                // a line along gravity has no thickness across it
                let length = if down.cross(&line).norm() > spacing { line.norm() } else { 0.0 };
                check_line(&to, length, spacing, ", across gravity")
            }
            Self::Flux { corners, .. } => {
                let [corner, one, other] = edges(corners);
                if one.cross(&other).norm() > spacing * spacing {
                    return Ok(());
                }
                let defect = format!("the corners from {} on are in line", shown(&corner));
                Err(ParameterError::field("corners", defect, "", "give one corner and its two neighbours"))
            }
            _ => Ok(()),
        }
    }
}

/// A corner of a parallelogram, and its edges to the two next to it `[m]`.
pub(super) fn edges((corner, next, last): &(SpaceVector, SpaceVector, SpaceVector)) -> [Vector<3>; 3] {
    let [corner, next, last] = [corner, next, last].map(vector::<3>);
    [corner, next - corner, last - corner]
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

    /// A block of 20 by 8 by 6 particles of 1 cm that flies along x with 1 m/s.
    fn block() -> Simulation<3> {
        let at = |k: usize| Vector::<3>::new((k % 20) as f64 + 0.5, (k / 20 % 8) as f64 + 0.5, (k / 160) as f64 + 0.5);
        let mut flow = Flow::at_rest((0..960).map(|k| at(k) * 0.01).collect(), 1000.0, 0.01);
        flow.velocity.fill(Vector::<3>::new(1.0, 0.0, 0.0));
        let liquid = EquationOfState { reference_density: 1000.0, bulk_modulus: 1e5, tension: Tension::Cut };
        let law = Rheology::Newtonian(Newtonian { viscosity: 1.0 });
        Simulation::new(Scene::unbounded(flow, 0.01, liquid, law)).expect("a scene")
    }

    #[test]
    fn a_block_that_flies_reaches_and_crosses_what_it_should() {
        let gauge = |text: &str| toml::from_str::<SpaceGauge>(text).expect("a gauge");
        let gauges = [
            gauge(
                "kind = \"front\"\nname = \"front\"\nfrom = [0.0, 0.04, 0.0]\nto = [1.0, 0.04, 0.0]\nthickness = 0.03\nwidth = 0.06",
            ),
            gauge("kind = \"depth\"\nname = \"depth\"\nat = [0.1, 0.04, 0.0]\nwidth = 0.04"),
            gauge(
                "kind = \"flux\"\nname = \"along\"\ncorners = [[0.15, -1.0, -1.0], [0.15, 1.0, -1.0], [0.15, -1.0, 1.0]]",
            ),
            gauge(
                "kind = \"flux\"\nname = \"half\"\ncorners = [[0.15, -1.0, -1.0], [0.15, -1.0, 1.0], [0.15, 0.04, -1.0]]",
            ),
        ];
        let (mut simulation, mut memory) = (block(), Memory::default());
        let down = Vector::<3>::new(0.0, 0.0, -1.0);
        let measures: Vec<_> = gauges.iter().map(|gauge| gauge.measure(&down)).collect();
        let unbounded = Periods::of(&[AxisBoundary::Open; 3]);
        let start = memory.read_all(&measures, &simulation, &simulation.snapshot(), (960, &unbounded));
        assert!((start[0] - 0.2).abs() < 0.01 && (start[3] / 0.06 - 1.0).abs() < 0.005, "{start:?}");
        assert!(start[1] <= start[0] && start[0] <= start[2] && start[2] - start[1] < 0.011, "{start:?}");
        assert_eq!(start[4..], [0.0; 4], "nothing has moved");
        while simulation.time() < 0.03 {
            simulation.step().expect("no divergence");
        }
        let end = memory.read_all(&measures, &simulation, &simulation.snapshot(), (960, &unbounded));
        let way = simulation.time();
        assert!((end[0] - start[0] - way).abs() < 0.006, "{} m after {way} m", end[0] - start[0]);
        // three layers of 48 particles of 1 g, and half of them the other way round
        assert!((end[4] - 0.144).abs() < 1e-12 && (end[5] - 0.144 / way).abs() < 1e-9, "{end:?}");
        assert!((end[6] + 0.072).abs() < 1e-12, "{end:?}");
        let probe = |at: &str| gauge(&format!("kind = \"probe\"\nname = \"probe\"\nat = {at}"));
        let probes = ["[0.13, 0.04, 0.03]", "[0.0, 0.04, 0.03]"].map(probe);
        let measures: Vec<_> = probes.iter().map(|gauge| gauge.measure(&down)).collect();
        let found = memory.read_all(&measures, &simulation, &simulation.snapshot(), (960, &unbounded));
        assert!((found[2] - 1.0).abs() < 1e-3, "{found:?}");
        assert!(found[5..].iter().all(|value| value.is_nan()), "the block has left: {found:?}");
    }
}
