//! The flow: a reservoir of grains behind a gate on an incline.

use crate::case::recording::{self, Ending, ObservedRun, SimulationStage};
use crate::case::{Flow, ParameterError, Progress, RunCost, RunScales};
use crate::collapse::Collapse;
use crate::collapse::heap::{AT_REST, CollapseObserver, GrainBlock, STIFFNESS, Surveyor};
use crate::metric::{FlowRegime, Value, Variant};
use crate::observation::Recorded;
use crate::reference::grains::GLASS_BEADS;
use crate::setup::{Bulk, Lattice, acoustic_step, rules};
use crate::shared::close_by_gate;
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::parameter::{between, not_negative, positive};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::{Numerics, Scene};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Time before which no reservoir has emptied `[s]`.
pub(crate) const EARLIEST_REST: f64 = 0.4;
/// Interval of the time series `[s]`.
const INTERVAL: f64 = 0.02;
/// Times of the pictures `[s]`; the last state follows.
const PICTURES: [f64; 5] = [0.0, 0.12, 0.2, 0.4, 0.8];
/// Time between the frames of the animation `[s]`.
const FRAME_INTERVAL: f64 = 0.04;
/// Rows of particles through the gate: its two sides must not see each other.
const GATE_ROWS: usize = 4;

/// A reservoir of grains that is released on a slope.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct SlopeFlow {
    /// Slope angle θ `[°]`.
    #[schemars(transform = rules::slope_angle())]
    #[schemars(transform = not_negative("give the angle in degrees of a slope that falls along the run-out"))]
    pub slope_angle: f64,
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Height of the reservoir h_0 `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.14"))]
    pub initial_height: f64,
    /// Length of the reservoir r_0 `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.2"))]
    pub reservoir_length: f64,
    /// Length of the channel from the back of the reservoir `[m]`.
    pub channel_length: f64,
    /// Speed of the gate, pulled up normal to the slope `[m/s]`; 1.3 in the paper, 2.3 in Ionescu et al. (2015), 0 for no gate.
    #[schemars(transform = between(0.0, 100.0, "give 1.3 m/s as in the paper, or 0 for no gate"))]
    pub gate_speed: f64,
    /// Particles over the length of the reservoir.
    #[schemars(transform = rules::rows())]
    pub resolution: usize,
    /// Largest random displacement of a particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "give 0.05 to break the lattice without overlaps"))]
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Longest simulated time `[s]`; a deposit at rest ends a run before.
    #[schemars(transform = between(0.01, 1000.0, "give 1.5 s, after which deposits on mild slopes are at rest"))]
    pub duration: f64,
    /// Numerical scheme of the weakly compressible model.
    pub numerics: Numerics,
    /// Density of the grains in bulk.
    #[serde(flatten)]
    pub bulk: Bulk,
    /// Constitutive law of the grains.
    pub material: Rheology,
}

impl Default for SlopeFlow {
    fn default() -> Self {
        Self {
            slope_angle: 22.0,
            gravity: 9.81,
            initial_height: 0.14,
            reservoir_length: 0.20,
            channel_length: 3.0,
            gate_speed: 1.3,
            resolution: 30,
            jitter: 0.05,
            seed: 1,
            duration: 4.0,
            numerics: Numerics::default(),
            bulk: Bulk::of_grains(GLASS_BEADS.solid_fraction),
            // Table 1, glass beads
            material: Rheology::MuI(GLASS_BEADS.law),
        }
    }
}

impl Flow for SlopeFlow {
    const RUNS: &'static str = include_str!("../../../runs/incline-collapse.toml");
    type Observation = SlopeCollapse;

    fn check(&self) -> Result<(), ParameterError> {
        let (least, most) = (3.0 * self.reservoir_length, 1000.0 * self.reservoir_length);
        let remedy = "give a channel that holds the reservoir, the gate and the run-out";
        rules::between("channel_length", self.channel_length, least, most, remedy)?;
        let rows = (self.initial_height / self.reservoir_length * self.resolution as f64).round();
        if !(4.0..=1000.0).contains(&rows) {
            let remedy = if rows < 4.0 { "raise it" } else { "reduce it" };
            let defect =
                format!("{} gives a reservoir {rows} rows of particles high; allowed are 4 to 1000", self.resolution);
            return Err(ParameterError::field("resolution", defect, "", remedy));
        }
        rules::material("material", &self.material)?;
        self.bulk.check(&self.material)?;
        if self.gate_speed > 0.0 {
            rules::gate("numerics", &self.numerics)?;
        }
        rules::viscous_step("numerics", &self.numerics, &self.material)
    }

    fn variant(&self) -> Variant {
        let gate = if self.gate_speed > 0.0 { Value::from(self.gate_speed) } else { Value::from("none") };
        let collapse =
            Variant::of("slope_angle", self.slope_angle).and("gate", gate).and("resolution", self.resolution);
        match self.material {
            Rheology::RegularisedMuI(law) => collapse.and("regularisation_rate", law.regularisation_rate),
            _ => collapse,
        }
    }

    fn regime(&self, observation: &SlopeCollapse) -> FlowRegime {
        let speed = observation.collapse.fastest(self.density() * self.reservoir_length * self.initial_height);
        let aspect_ratio = Some(self.initial_height / self.reservoir_length);
        let regime = FlowRegime { aspect_ratio, slope_angle: Some(self.slope_angle), ..FlowRegime::default() };
        regime.of_grains(self.material.grain_diameter(), self.initial_height, speed, self.gravity)
    }

    fn scales(&self) -> Option<RunScales> {
        Some(RunScales { length: self.reservoir_length, time: (self.initial_height / self.gravity).sqrt() })
    }

    fn cost(&self) -> RunCost {
        let sound_speed = (self.bulk_modulus() / self.density()).sqrt();
        let step = acoustic_step(&self.numerics, self.spacing(), sound_speed);
        RunCost::weakly_compressible((self.resolution * self.rows()) as f64, self.duration / step)
    }

    fn trajectory(&self) -> Option<Self> {
        Some(Self { duration: 0.0, ..self.clone() })
    }

    fn simulate(&self, progress: &Progress) -> Result<Recorded<SlopeCollapse>, ParameterError> {
        let surveyor = self.surveyor();
        let begin =
            |_: &_| (CollapseObserver::new(surveyor, FRAME_INTERVAL, PICTURES.to_vec(), EARLIEST_REST), Vec::new());
        let stage = SimulationStage { progress, end: self.duration, interval: INTERVAL, window: 0.0, context: &() };
        let end_of_channel = self.channel_length - 0.5 * self.reservoir_length;
        let watched = recording::watch(
            stage,
            |_| Ok(self.scene()),
            begin,
            |(watch, thickness), snapshot| {
                let (profile, rests) = watch.observe(snapshot);
                thickness.push(profile.iter().map(|bin| bin.1).collect::<Vec<f64>>());
                let arrived = snapshot.position.iter().any(|x| x[0] > end_of_channel);
                if rests || arrived { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            },
        )?;
        let ObservedRun { simulation, ending, kept: (mut watch, thickness) } = watched;
        let criterion = format!(
            "the deposit rests (kinetic energy below {AT_REST:.0e} of the energy released), or a grain nears the end of \
             the channel"
        );
        let frames = std::mem::take(&mut watch.frames);
        let ending = Ending { criterion, frames, ..ending };
        Ok(ending.record(&simulation, |end| SlopeCollapse { collapse: watch.finish(end), thickness }))
    }
}

/// Results of a collapse on a slope; lengths over the reservoir's length, times in `[s]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct SlopeCollapse {
    /// Front, energies, deposit and balances.
    pub collapse: Collapse,
    /// Thickness over r_0 in every bin of the channel at each time of the series, shape `[times][bins]` `[-]`.
    pub thickness: Vec<Vec<f64>>,
}

impl SlopeFlow {
    /// Surveyor that measures the collapse.
    pub(crate) fn surveyor(&self) -> Surveyor {
        Surveyor {
            half_width: self.reservoir_length,
            spacing: self.spacing(),
            gravity: self.gravity(),
            bed_end: self.channel_length,
            collapse: Collapse::default(),
        }
    }

    /// Particle spacing `[m]`.
    pub fn spacing(&self) -> f64 {
        self.reservoir_length / self.resolution as f64
    }

    /// Whether there are enough rows over the height for a gate.
    pub fn is_resolved(&self) -> bool {
        self.rows() >= 20
    }

    /// Whether its law is (35), which never comes to rest.
    pub fn is_regularised(&self) -> bool {
        matches!(self.material, Rheology::RegularisedMuI(_))
    }

    /// Bulk density `[kg/m³]`.
    pub fn density(&self) -> f64 {
        self.bulk.density(&self.material)
    }

    fn rows(&self) -> usize {
        (self.initial_height / self.spacing()).round().max(1.0) as usize
    }

    fn bulk_modulus(&self) -> f64 {
        STIFFNESS * self.density() * self.gravity * self.initial_height
    }

    /// Gravity along the slope and across it `[m/s²]`.
    fn gravity(&self) -> [f64; 2] {
        let angle = self.slope_angle.to_radians();
        [self.gravity * libm::sin(angle), -self.gravity * libm::cos(angle)]
    }

    fn scene(&self) -> Scene<2> {
        let Self { resolution, jitter, seed, numerics, channel_length, .. } = *self;
        let spacing = self.spacing();
        let lattice = Lattice { spacing, rows: self.rows(), columns: resolution, bottom: 0.0 };
        let height = lattice.height();
        let block = GrainBlock {
            spacing,
            height,
            gravity: Vector::<2>::from(self.gravity()),
            density: self.density(),
            bulk_modulus: self.bulk_modulus(),
            rheology: self.material,
            jitter,
            seed,
            numerics,
        };
        // the back of the reservoir is smooth
        let domain = Domain { axes: [AxisBoundary::Mirror { lower: Some(0.0), upper: None }, AxisBoundary::Open] };
        let mut scene = block.scene(lattice.sites(), domain, channel_length);
        if self.gate_speed > 0.0 {
            close_by_gate(&mut scene, self.reservoir_length, height, self.gate_speed, GATE_ROWS);
        }
        scene
    }
}

impl SlopeCollapse {
    /// Thickness over r_0 at a place x/r_0 over time `[-]`, linear between the centres of two bins.
    pub fn thickness_at(&self, place: f64) -> Vec<f64> {
        let position = place / crate::collapse::BIN_WIDTH - 0.5;
        let bin = position.max(0.0) as usize;
        let share = position - bin as f64;
        let value = |profile: &Vec<f64>| {
            let [Some(here), Some(next)] = [profile.get(bin), profile.get(bin + 1)] else { return 0.0 };
            here + share * (next - here)
        };
        self.thickness.iter().map(value).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{RunList, Tier};

    #[test]
    fn reservoir_channel_and_gate_are_those_of_the_experiment() {
        for (tier, slopes) in [(Tier::Quick, vec![22.0]), (Tier::Paper, vec![22.0, 23.0, 24.0, 25.0])] {
            let list = RunList::<SlopeFlow>::of_tier(tier);
            let SlopeFlow { initial_height, reservoir_length, channel_length, gate_speed, .. } = list.base;
            assert_eq!((initial_height, reservoir_length, channel_length, gate_speed), (0.14, 0.2, 3.0, 1.3));
            assert!((initial_height / reservoir_length - 0.7).abs() < 1e-12);
            let run =
                |slope: &f64| list.flows().iter().any(|flow| flow.slope_angle == *slope && flow.gate_speed == 1.3);
            assert!(slopes.iter().all(run), "{tier}");
        }
    }

    #[test]
    fn thickness_is_read_between_the_bins() {
        let collapse = SlopeCollapse { thickness: vec![vec![1.0, 0.5, 0.0], vec![0.2; 3]], ..SlopeCollapse::default() };
        let at = collapse.thickness_at(0.10);
        assert!((at[0] - 0.75).abs() < 1e-12 && (at[1] - 0.2).abs() < 1e-12, "{at:?}");
        assert_eq!(collapse.thickness_at(5.0), [0.0, 0.0]);
    }
}
