//! Gauges: what is measured while a scene runs, as series over time.

use super::Place;
use super::body::vector;
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
    /// How far the material reaches along a line: the first place behind its start where less than a thickness stands
    /// across it.
    Front {
        /// Its name.
        name: String,
        /// Start of the line x, y `[m]`.
        from: Place,
        /// End of the line x, y `[m]`.
        to: Place,
        /// Thickness `[m]`.
        #[schemars(transform = positive("give it in metres, such as two spacings"))]
        thickness: f64,
    },
    /// Thickness of the material along gravity around a place: its volume within a width, over that width.
    Depth {
        /// Its name.
        name: String,
        /// The place x, y `[m]`.
        at: Place,
        /// Width across gravity `[m]`.
        #[schemars(transform = positive("give it in metres, such as four spacings"))]
        width: f64,
    },
    /// Force of the flow on a wall, along x and y.
    Force {
        /// Its name.
        name: String,
        /// Name of the wall.
        wall: String,
    },
    /// Mass that crosses a line from its right to its left, seen along it: together, and per time.
    Flux {
        /// Its name.
        name: String,
        /// Start of the line x, y `[m]`.
        from: Place,
        /// End of the line x, y `[m]`.
        to: Place,
    },
}

/// What gauges remember from sample to sample.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(super) struct Memory {
    /// Time of the last sample `[s]`.
    time: f64,
    /// Places of the particles then `[m]`, by their place in the scene; NaN of those that have left.
    places: Vec<[f64; 2]>,
    /// Impulses of the walls then `[kg m/s]` per metre of depth.
    impulses: Vec<[f64; 2]>,
    /// Mass that has crossed each gauge's line `[kg/m]`.
    crossed: Vec<f64>,
}

impl Gauge {
    /// Its name.
    pub(super) fn name(&self) -> &str {
        let (Self::Front { name, .. } | Self::Depth { name, .. } | Self::Force { name, .. } | Self::Flux { name, .. }) =
            self;
        name
    }

    /// The line that it needs, if any.
    pub(super) fn line(&self) -> Option<(Place, Place)> {
        match self {
            Self::Front { from, to, .. } | Self::Flux { from, to, .. } => Some((*from, *to)),
            Self::Depth { .. } | Self::Force { .. } => None,
        }
    }

    /// The columns of its series.
    pub(super) fn columns(&self) -> Vec<Column> {
        let column = |what: &str, axis: &'static str| Column { heading: what.to_owned(), axis };
        match self {
            Self::Front { .. } => vec![column("front [m]", "front [m]")],
            Self::Depth { .. } => vec![column("depth [m]", "depth [m]")],
            Self::Force { .. } => {
                vec![column("force along x [N/m]", "force [N/m]"), column("force along y [N/m]", "force [N/m]")]
            }
            Self::Flux { .. } => vec![
                column("mass that has crossed [kg/m]", "mass [kg/m]"),
                column("mean flux since the last row [kg/(m s)]", "flux [kg/(m s)]"),
            ],
        }
    }

    /// Its values now, one a column.
    fn read(&self, index: usize, simulation: &Simulation<2>, memory: &mut Memory, down: &Vector<2>) -> Vec<f64> {
        let elapsed = simulation.time() - memory.time;
        match self {
            Self::Front { from, to, thickness, .. } => {
                vec![reached(simulation, &vector(from), &vector(to), *thickness, |_| true)]
            }
            Self::Depth { at, width, .. } => {
                let (across, at) = (Vector::<2>::new(-down[1], down[0]), vector(at));
                let volumes = volumes(simulation, |place| ((place - at).dot(&across).abs() < 0.5 * width).then_some(0));
                vec![volumes.first().copied().unwrap_or(0.0) / width]
            }
            Self::Force { wall, .. } => {
                let Some(k) = simulation.shells().iter().position(|shell| shell.name == *wall) else {
                    return vec![0.0; 2];
                };
                let before = memory.impulses.get(k).copied().unwrap_or_default();
                let now = simulation.shell_impulses()[k];
                // the wall feels the opposite of what it gives
                let mean = |axis: usize| if elapsed > 0.0 { (before[axis] - now[axis]) / elapsed } else { 0.0 };
                vec![mean(0), mean(1)]
            }
            Self::Flux { from, to, .. } => {
                let crossed = crossing(simulation, &memory.places, &vector(from), &vector(to));
                memory.crossed[index] += crossed;
                vec![memory.crossed[index], if elapsed > 0.0 { crossed / elapsed } else { 0.0 }]
            }
        }
    }
}

/// The values of all gauges now, column by column; remembers the state for the next sample.
pub(super) fn read_all(
    gauges: &[Gauge],
    simulation: &Simulation<2>,
    begun: usize,
    memory: &mut Memory,
    down: &Vector<2>,
) -> Vec<f64> {
    memory.crossed.resize(gauges.len(), 0.0);
    let values = gauges.iter().enumerate().flat_map(|(k, gauge)| gauge.read(k, simulation, memory, down)).collect();
    let particles = simulation.particles();
    memory.places.clear();
    memory.places.resize(begun, [f64::NAN; 2]);
    for (index, &identity) in particles.identity.iter().enumerate() {
        memory.places[identity as usize] = particles.position[index].into();
    }
    memory.impulses = simulation.shell_impulses().iter().map(|impulse| (*impulse).into()).collect();
    memory.time = simulation.time();
    values
}

/// Mass `[kg/m]` that has crossed a line to its left since the places were remembered, less what went back.
fn crossing(simulation: &Simulation<2>, before: &[[f64; 2]], from: &Vector<2>, to: &Vector<2>) -> f64 {
    let along = to - from;
    let side = |place: &Vector<2>| along.perp(&(place - from));
    let particles = simulation.particles();
    let mut sum = 0.0;
    for index in particles.by_identity() {
        let Some(&start) = before.get(particles.identity[index] as usize) else { continue };
        let (start, end) = (Vector::<2>::from(start), particles.position[index]);
        let (first, last) = (side(&start), side(&end));
        if (first < 0.0) == (last < 0.0) || first.is_nan() {
            continue;
        }
        let met = start + (end - start) * (first / (first - last));
        let part = (met - from).dot(&along) / along.norm_squared();
        if (0.0..=1.0).contains(&part) {
            sum += particles.mass[index] * if last >= 0.0 { 1.0 } else { -1.0 };
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

    /// A block of 20 by 8 particles of 1 cm that flies to the right with 1 m/s.
    fn block() -> Simulation<2> {
        let site = |k: usize| Vector::<2>::new((k % 20) as f64 + 0.5, (k / 20) as f64 + 0.5) * 0.01;
        let mut flow = Flow::at_rest((0..160).map(site).collect(), 1000.0, 0.01);
        flow.velocity.fill(Vector::<2>::new(1.0, 0.0));
        let liquid = EquationOfState { reference_density: 1000.0, bulk_modulus: 1e5, tension: Tension::Cut };
        let law = Rheology::Newtonian(Newtonian { viscosity: 1.0 });
        Simulation::new(Scene::unbounded(flow, 0.01, liquid, law)).expect("a scene")
    }

    #[test]
    fn a_block_that_flies_reaches_and_crosses_what_it_should() {
        let gauge = |text: &str| toml::from_str::<Gauge>(text).expect("a gauge");
        let gauges = [
            gauge("kind = \"front\"\nname = \"front\"\nfrom = [0.0, 0.0]\nto = [1.0, 0.0]\nthickness = 0.04"),
            gauge("kind = \"depth\"\nname = \"depth\"\nat = [0.1, 0.0]\nwidth = 0.04"),
            gauge("kind = \"flux\"\nname = \"down\"\nfrom = [0.15, 1.0]\nto = [0.15, -1.0]"),
            gauge("kind = \"flux\"\nname = \"beside\"\nfrom = [0.15, 1.0]\nto = [0.15, 0.5]"),
        ];
        let (mut simulation, mut memory) = (block(), Memory::default());
        let down = Vector::<2>::new(0.0, -1.0);
        let start = read_all(&gauges, &simulation, 160, &mut memory, &down);
        assert!((start[0] - 0.2).abs() < 0.01 && (start[1] - 0.08).abs() < 1e-12, "{start:?}");
        assert_eq!(start[2..], [0.0; 4], "nothing has moved");
        while simulation.time() < 0.03 {
            simulation.step().expect("no divergence");
        }
        let end = read_all(&gauges, &simulation, 160, &mut memory, &down);
        let way = simulation.time();
        assert!((end[0] - start[0] - way).abs() < 0.006, "{} m after {way} m", end[0] - start[0]);
        // three columns of eight particles of 0.1 kg/m
        assert!((end[2] - 2.4).abs() < 1e-9 && (end[3] - 2.4 / way).abs() < 1e-6, "{end:?}");
        assert_eq!(end[4..], [0.0; 2], "nothing crosses beside the line");
    }
}
