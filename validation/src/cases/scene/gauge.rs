//! Gauges: what is measured while a scene runs, as series over time.

use super::PlaneVector;
use crate::case::ParameterError;
use crate::cases::enclosed::names::check_line;
use crate::cases::enclosed::setting::{self, vector};
use crate::cases::enclosed::{DepthGauge, Measurand, Opening};
use crate::cases::front::FrontLine;
use bagnold_solver::parameter::positive;
use bagnold_solver::vector::Vector;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What a gauge measures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum PlaneGauge {
    /// How far the material reaches along a line: the first place behind its start where less than a thickness stands
    /// across it.
    Front {
        /// Its name.
        name: String,
        /// Start of the line x, y `[m]`.
        from: PlaneVector,
        /// End of the line x, y `[m]`.
        to: PlaneVector,
        /// Thickness `[m]`.
        #[schemars(transform = positive("give it in metres, such as two spacings"))]
        thickness: f64,
    },
    /// Thickness of the material along gravity around a place: its volume within a width, over that width.
    Depth {
        /// Its name.
        name: String,
        /// The place x, y `[m]`.
        at: PlaneVector,
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
        from: PlaneVector,
        /// End of the line x, y `[m]`.
        to: PlaneVector,
    },
}

impl setting::SceneGauge<2> for PlaneGauge {
    fn name(&self) -> &str {
        let (Self::Front { name, .. } | Self::Depth { name, .. } | Self::Force { name, .. } | Self::Flux { name, .. }) =
            self;
        name
    }

    fn measure(&self, down: &Vector<2>) -> Measurand<'_, 2> {
        match self {
            Self::Front { from, to, thickness, .. } => {
                Measurand::Front(FrontLine { from: vector(from), to: vector(to), section: *thickness, strip: None })
            }
            Self::Depth { at, width, .. } => {
                Measurand::Depth(DepthGauge { at: vector(at), down: *down, width: *width, section: *width })
            }
            Self::Force { wall, .. } => Measurand::Force { wall },
            Self::Flux { from, to, .. } => {
                let (corner, to): (Vector<2>, Vector<2>) = (vector(from), vector(to));
                let along = to - corner;
                let normal = Vector::<2>::new(-along[1], along[0]);
                Measurand::Flux(Opening { corner, normal, edges: vec![(along, along.norm_squared())] })
            }
        }
    }

    fn check(&self, spacing: f64, _: &Vector<2>) -> Result<(), ParameterError> {
        match self {
            Self::Front { from, to, .. } | Self::Flux { from, to, .. } => {
                let to = vector::<2>(to);
                check_line(&to, (to - vector::<2>(from)).norm(), spacing, "")
            }
            Self::Depth { .. } | Self::Force { .. } => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cases::enclosed::gauges::Memory;
    use crate::cases::enclosed::setting::SceneGauge as _;
    use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
    use bagnold_solver::material::rheology::{Newtonian, Rheology};
    use bagnold_solver::weakly_compressible::scene::{Flow, Scene};
    use bagnold_solver::weakly_compressible::simulation::Simulation;

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
        let start = memory.read_all(&measures, &simulation, &simulation.snapshot(), 160);
        assert!((start[0] - 0.2).abs() < 0.01 && (start[1] - 0.08).abs() < 1e-12, "{start:?}");
        assert_eq!(start[2..], [0.0; 4], "nothing has moved");
        while simulation.time() < 0.03 {
            simulation.step().expect("no divergence");
        }
        let end = memory.read_all(&measures, &simulation, &simulation.snapshot(), 160);
        let way = simulation.time();
        assert!((end[0] - start[0] - way).abs() < 0.006, "{} m after {way} m", end[0] - start[0]);
        // three columns of eight particles of 0.1 kg/m
        assert!((end[2] - 2.4).abs() < 1e-9 && (end[3] - 2.4 / way).abs() < 1e-6, "{end:?}");
        assert_eq!(end[4..], [0.0; 2], "nothing crosses beside the line");
    }
}
