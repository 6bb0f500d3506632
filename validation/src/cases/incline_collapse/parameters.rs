//! The case's parameters and their tiers.

use crate::case::{ParameterError, Parameters, Tier};
use crate::cases::collapse::SlopeRun;
use crate::cases::rules;
use crate::reference::GLASS_BEADS;
use bagnold_solver::material::rheology::{MuI, Rheology};
use bagnold_solver::parameter::{between, each, not_negative, positive};
use bagnold_solver::weakly_compressible::numerics::{Numerics, ViscousStep};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct InclineCollapseParameters {
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
    /// Width W of the channel `[m]`, whose side walls add the friction 0.18 h_0/W; 0 for none.
    #[schemars(transform = not_negative("give it in metres, such as 0.1, or 0 for no side walls"))]
    pub channel_width: f64,
    /// Slopes `[°]`.
    #[schemars(transform = each(rules::slope_angle()))]
    pub slope_angles: Vec<f64>,
    /// Speed of the gate, pulled up normal to the slope `[m/s]`; 1.3 in the paper, 2.3 in Ionescu et al. (2015), 0 for no gate.
    #[schemars(transform = between(0.0, 100.0, "the paper pulls it at 1.3 m/s; 0 is no gate"))]
    pub gate_speed: f64,
    /// Slope at which other gates are tried `[°]`.
    #[schemars(transform = rules::slope_angle())]
    pub gate_slope_angle: f64,
    /// Speeds of the other gates `[m/s]`, 0 for no gate; empty for none.
    #[schemars(transform = each(between(0.0, 100.0, "the experiment pulls it at 2.3 m/s; 0 is no gate")))]
    pub other_gate_speeds: Vec<f64>,
    /// Slopes at which the collapse is repeated with the regularised viscosity (35), implicitly `[°]`.
    #[schemars(transform = each(rules::slope_angle()))]
    pub regularised_slope_angles: Vec<f64>,
    /// Its rate α_r `[1/s]`.
    #[schemars(transform = positive("0.01 1/s in the paper"))]
    pub regularisation_rate: f64,
    /// Particles over the length of the reservoir.
    #[schemars(transform = rules::rows())]
    pub resolution: usize,
    /// Largest random displacement of a particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "0.05 breaks the lattice without overlaps"))]
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Longest simulated time `[s]`; a deposit at rest ends a run before.
    #[schemars(transform = between(0.01, 1000.0, "deposits on mild slopes rest after about 1.5 s"))]
    pub duration: f64,
    /// Solid fraction φ `[-]`.
    #[schemars(transform = between(0.01, 0.74, "grains fill 0.5 to 0.64 of the space"))]
    pub solid_fraction: f64,
    /// Grains.
    pub material: MuI,
    /// Numerics.
    pub numerics: Numerics,
}

/// Longest time of a regularised collapse `[s]`: it never rests.
const REGULARISED_DURATION: f64 = 2.0;

impl Parameters for InclineCollapseParameters {
    type Run = SlopeRun;

    fn of_tier(tier: Tier) -> Self {
        let quick = Self {
            gravity: 9.81,
            initial_height: 0.14,
            reservoir_length: 0.20,
            channel_length: 3.0,
            channel_width: 0.0,
            slope_angles: vec![10.0, 16.0, 22.0],
            gate_speed: 1.3,
            gate_slope_angle: 22.0,
            other_gate_speeds: Vec::new(),
            regularised_slope_angles: Vec::new(),
            regularisation_rate: 0.01,
            resolution: 30,
            jitter: 0.05,
            seed: 1,
            duration: 4.0,
            solid_fraction: GLASS_BEADS.solid_fraction,
            // Table 1, glass beads
            material: GLASS_BEADS.law,
            numerics: Numerics::default(),
        };
        let paper = Self {
            slope_angles: vec![0.0, 10.0, 16.0, 22.0, 23.0, 24.0, 25.0],
            other_gate_speeds: vec![2.3, 0.0],
            regularised_slope_angles: vec![16.0, 22.0],
            resolution: 60,
            ..quick.clone()
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => paper,
            Tier::Fine => Self { resolution: 120, ..paper },
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        let (least, most) = (3.0 * self.reservoir_length, 1000.0 * self.reservoir_length);
        let remedy = "the channel must hold the reservoir, the gate and the run-out";
        rules::between("channel_length", self.channel_length, least, most, remedy)?;
        let rows = (self.initial_height / self.reservoir_length * self.resolution as f64).round();
        if !(4.0..=1000.0).contains(&rows) {
            let rule = "such that the reservoir is 4 to 1000 rows of particles high";
            let remedy = format!(
                "its height, `initial_height` over `reservoir_length` times this, is {rows}: choose a {} resolution",
                if rows < 4.0 { "larger" } else { "smaller" }
            );
            return Err(ParameterError::field("resolution", self.resolution, rule, &remedy));
        }
        rules::material("material", &Rheology::MuI(self.material))?;
        if self.runs().iter().any(|run| run.gate_speed > 0.0) {
            rules::gate("numerics", &self.numerics)?;
        }
        if !self.regularised_slope_angles.is_empty() {
            rules::implicit_runs("numerics", &self.numerics, "regularised_slope_angles")?;
        }
        rules::viscous_step("numerics", &self.numerics, &Rheology::MuI(self.material))
    }

    fn runs(&self) -> Vec<SlopeRun> {
        let slopes = self.slope_angles.iter().map(|&angle| self.run(angle, self.gate_speed));
        let gates = self.other_gate_speeds.iter().filter(|&&speed| speed != self.gate_speed);
        let gates = gates.map(|&speed| self.run(self.gate_slope_angle, speed));
        let regularised = self.regularised_slope_angles.iter().map(|&angle| SlopeRun {
            regularisation_rate: Some(self.regularisation_rate),
            duration: REGULARISED_DURATION.min(self.duration),
            numerics: Numerics { viscous_step: ViscousStep::Implicit, ..self.numerics },
            ..self.run(angle, self.gate_speed)
        });
        slopes.chain(gates).chain(regularised).collect()
    }
}

impl InclineCollapseParameters {
    /// A run at a slope `[°]` with a gate `[m/s]`.
    pub(in crate::cases) fn run(&self, slope_angle: f64, gate_speed: f64) -> SlopeRun {
        SlopeRun {
            slope_angle,
            gate_speed,
            resolution: self.resolution,
            initial_height: self.initial_height,
            reservoir_length: self.reservoir_length,
            law: self.material,
            regularisation_rate: None,
            channel_width: self.channel_width,
            channel_length: self.channel_length,
            gravity: self.gravity,
            solid_fraction: self.solid_fraction,
            jitter: self.jitter,
            seed: self.seed,
            duration: self.duration,
            numerics: self.numerics,
        }
    }
}
