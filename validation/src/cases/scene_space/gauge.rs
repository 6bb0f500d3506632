//! Gauges: what is measured while a scene in space runs, as series over time.

use super::{Place, vector};
use crate::cases::enclosed::series::{Column, reached, volumes};
use bagnold_solver::parameter::positive;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::simulation::Simulation;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a gauge measures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum Gauge {
    /// How far the material reaches along a line: the first place behind its start where, on the mean over a width, less
    /// than a thickness stands across it.
    Front {
        /// Its name.
        name: String,
        /// Start of the line x, y, z `[m]`.
        from: Place,
        /// End of the line x, y, z `[m]`.
        to: Place,
        /// Thickness `[m]`.
        #[schemars(transform = positive("give it in metres, such as two spacings"))]
        thickness: f64,
        /// Width across the line and gravity, half of it to either side `[m]`: as wide as the channel, or less.
        #[schemars(transform = positive("give it in metres, such as four spacings"))]
        width: f64,
    },
    /// Thickness of the material along gravity around a place: its volume within a circle, over the circle's area.
    Depth {
        /// Its name.
        name: String,
        /// The place x, y, z `[m]`, at least half a width from mirrors and walls.
        at: Place,
        /// Diameter of the circle `[m]`.
        #[schemars(transform = positive("give it in metres, such as four spacings"))]
        width: f64,
    },
    /// Force of the flow on a wall, along x, y and z.
    Force {
        /// Its name.
        name: String,
        /// Name of the wall.
        wall: String,
    },
    /// Mass that crosses a parallelogram towards the side from which its corners are seen against the clock: together,
    /// and per time.
    Flux {
        /// Its name.
        name: String,
        /// A corner and the two next to it x, y, z `[m]`.
        corners: (Place, Place, Place),
    },
}

/// What gauges remember from sample to sample.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Memory {
    /// Time of the last sample `[s]`.
    time: f64,
    /// Places of the particles then `[m]`, by their place in the scene; NaN of those that have left.
    places: Vec<[f64; 3]>,
    /// Impulses of the walls then `[kg m/s]`.
    impulses: Vec<[f64; 3]>,
    /// Mass that has crossed each gauge's parallelogram `[kg]`.
    crossed: Vec<f64>,
}

impl Gauge {
    /// Its name.
    pub(super) fn name(&self) -> &str {
        let (Self::Front { name, .. } | Self::Depth { name, .. } | Self::Force { name, .. } | Self::Flux { name, .. }) =
            self;
        name
    }

    /// The columns of its series.
    pub(super) fn columns(&self) -> Vec<Column> {
        let column = |what: &str, axis: &'static str| Column { heading: what.to_owned(), axis };
        match self {
            Self::Front { .. } => vec![column("front [m]", "front [m]")],
            Self::Depth { .. } => vec![column("depth [m]", "depth [m]")],
            Self::Force { .. } => {
                ["x", "y", "z"].map(|axis| column(&format!("force along {axis} [N]"), "force [N]")).into()
            }
            Self::Flux { .. } => vec![
                column("mass that has crossed [kg]", "mass [kg]"),
                column("mean flux since the last row [kg/s]", "flux [kg/s]"),
            ],
        }
    }

    /// Its values now, one a column.
    fn read(&self, index: usize, simulation: &Simulation<3>, memory: &mut Memory, down: &Vector<3>) -> Vec<f64> {
        let elapsed = simulation.time() - memory.time;
        match self {
            Self::Front { from, to, thickness, width, .. } => {
                let (from, to) = (vector(from), vector(to));
                let across = down.cross(&(to - from)).normalize();
                let counts = |place: &Vector<3>| (place - from).dot(&across).abs() < 0.5 * width;
                vec![reached(simulation, &from, &to, thickness * width, counts)]
            }
            Self::Depth { at, width, .. } => {
                let at = vector(at);
                let inside = |place: Vector<3>| {
                    let way = place - at;
                    ((way - down * way.dot(down)).norm() < 0.5 * width).then_some(0)
                };
                let volume = volumes(simulation, inside).first().copied().unwrap_or(0.0);
                vec![volume / (std::f64::consts::FRAC_PI_4 * width * width)]
            }
            Self::Force { wall, .. } => {
                let Some(k) = simulation.shells().iter().position(|shell| shell.name == *wall) else {
                    return vec![0.0; 3];
                };
                let before = memory.impulses.get(k).copied().unwrap_or_default();
                let now = simulation.shell_impulses()[k];
                // the wall feels the opposite of what it gives
                let mean = |axis: usize| if elapsed > 0.0 { (before[axis] - now[axis]) / elapsed } else { 0.0 };
                (0..3).map(mean).collect()
            }
            Self::Flux { corners: (a, b, c), .. } => {
                let crossed = crossing(simulation, &memory.places, &[vector(a), vector(b), vector(c)]);
                memory.crossed[index] += crossed;
                vec![memory.crossed[index], if elapsed > 0.0 { crossed / elapsed } else { 0.0 }]
            }
        }
    }
}

/// The values of all gauges now, column by column; remembers the state for the next sample.
pub(super) fn read_all(
    gauges: &[Gauge],
    simulation: &Simulation<3>,
    begun: usize,
    memory: &mut Memory,
    down: &Vector<3>,
) -> Vec<f64> {
    memory.crossed.resize(gauges.len(), 0.0);
    let values = gauges.iter().enumerate().flat_map(|(k, gauge)| gauge.read(k, simulation, memory, down)).collect();
    let particles = simulation.particles();
    memory.places.clear();
    memory.places.resize(begun, [f64::NAN; 3]);
    for (index, &identity) in particles.identity.iter().enumerate() {
        memory.places[identity as usize] = particles.position[index].into();
    }
    memory.impulses = simulation.shell_impulses().iter().map(|impulse| (*impulse).into()).collect();
    memory.time = simulation.time();
    values
}

/// Mass `[kg]` that has crossed a parallelogram along its normal since the places were remembered, less what went back.
fn crossing(simulation: &Simulation<3>, before: &[[f64; 3]], [corner, next, last]: &[Vector<3>; 3]) -> f64 {
    let (one, other) = (next - corner, last - corner);
    let normal = one.cross(&other);
    let particles = simulation.particles();
    let mut sum = 0.0;
    for index in particles.by_identity() {
        let Some(&start) = before.get(particles.identity[index] as usize) else { continue };
        let (start, end) = (Vector::<3>::from(start), particles.position[index]);
        let (first, second) = (normal.dot(&(start - corner)), normal.dot(&(end - corner)));
        if (first < 0.0) == (second < 0.0) || first.is_nan() {
            continue;
        }
        let met = start + (end - start) * (first / (first - second)) - corner;
        // its coordinates along the edges
        let along = met.cross(&other).dot(&normal) / normal.norm_squared();
        let across = one.cross(&met).dot(&normal) / normal.norm_squared();
        if (0.0..=1.0).contains(&along) && (0.0..=1.0).contains(&across) {
            sum += particles.mass[index] * if second >= 0.0 { 1.0 } else { -1.0 };
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
    use bagnold_solver::material::rheology::{Newtonian, Rheology};
    use bagnold_solver::weakly_compressible::scene::{Flow, Scene};

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
        let gauge = |text: &str| toml::from_str::<Gauge>(text).expect("a gauge");
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
        let start = read_all(&gauges, &simulation, 960, &mut memory, &down);
        // twelve columns of six particles stand in the circle
        let depth = 12.0 * 6.0 * 1e-6 / (std::f64::consts::FRAC_PI_4 * 0.04 * 0.04);
        assert!((start[0] - 0.2).abs() < 0.01 && (start[1] - depth).abs() < 1e-12, "{start:?}");
        assert_eq!(start[2..], [0.0; 4], "nothing has moved");
        while simulation.time() < 0.03 {
            simulation.step().expect("no divergence");
        }
        let end = read_all(&gauges, &simulation, 960, &mut memory, &down);
        let way = simulation.time();
        assert!((end[0] - start[0] - way).abs() < 0.006, "{} m after {way} m", end[0] - start[0]);
        // three layers of 48 particles of 1 g, and half of them the other way round
        assert!((end[2] - 0.144).abs() < 1e-12 && (end[3] - 0.144 / way).abs() < 1e-9, "{end:?}");
        assert!((end[4] + 0.072).abs() < 1e-12, "{end:?}");
    }
}
