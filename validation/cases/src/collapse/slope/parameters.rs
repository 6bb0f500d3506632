//! Collapses on a slope: what `incline-collapse` judges and `flow-thickness` begins with.

use super::reservoir::Reservoir;
use super::run::SlopeRun;
use crate::case::{ParameterError, Parameters, Tier};
use crate::reference::grains::GLASS_BEADS;
use crate::setup::{Bulk, rules};
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::parameter::{between, each, not_negative, positive};
use bagnold_solver::weakly_compressible::numerics::{Numerics, ViscousStep};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What to do about a slope that leads upwards.
const DOWN: &str = "the grains run down the slope: give its angle in degrees";

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct InclineCollapseParameters {
    /// The reservoir.
    #[serde(flatten)]
    pub reservoir: Reservoir,
    /// Slopes `[°]`.
    #[schemars(transform = each(rules::slope_angle()))]
    #[schemars(transform = each(not_negative(DOWN)))]
    pub slope_angles: Vec<f64>,
    /// Speed of the gate, pulled up normal to the slope `[m/s]`; 1.3 in the paper, 2.3 in Ionescu et al. (2015), 0 for no gate.
    #[schemars(transform = between(0.0, 100.0, "the paper pulls it at 1.3 m/s; 0 is no gate"))]
    pub gate_speed: f64,
    /// Slope at which other gates are tried `[°]`.
    #[schemars(transform = rules::slope_angle())]
    #[schemars(transform = not_negative(DOWN))]
    pub gate_slope_angle: f64,
    /// Speeds of the other gates `[m/s]`, 0 for no gate; empty for none.
    #[schemars(transform = each(between(0.0, 100.0, "the experiment pulls it at 2.3 m/s; 0 is no gate")))]
    pub other_gate_speeds: Vec<f64>,
    /// Slopes at which the collapse is repeated with the regularised viscosity (35), implicitly `[°]`.
    #[schemars(transform = each(rules::slope_angle()))]
    #[schemars(transform = each(not_negative(DOWN)))]
    pub regularised_slope_angles: Vec<f64>,
    /// Its rate α_r `[1/s]`.
    #[schemars(transform = positive("0.01 1/s in the paper"))]
    pub regularisation_rate: f64,
    /// Density of the grains in bulk.
    #[serde(flatten)]
    pub bulk: Bulk,
    /// Constitutive law of the grains.
    pub material: Rheology,
}

/// Longest time of a regularised collapse `[s]`: it never rests.
const REGULARISED_DURATION: f64 = 2.0;

impl Parameters for InclineCollapseParameters {
    type Run = SlopeRun;

    fn of_tier(tier: Tier) -> Self {
        let resolution = match tier {
            Tier::Quick => 30,
            Tier::Paper => 60,
            Tier::Fine => 120,
        };
        let quick = Self {
            reservoir: Reservoir {
                gravity: 9.81,
                initial_height: 0.14,
                reservoir_length: 0.20,
                channel_length: 3.0,
                resolution,
                jitter: 0.05,
                seed: 1,
                duration: 4.0,
                numerics: Numerics::default(),
            },
            slope_angles: vec![10.0, 16.0, 22.0],
            gate_speed: 1.3,
            gate_slope_angle: 22.0,
            other_gate_speeds: Vec::new(),
            regularised_slope_angles: Vec::new(),
            regularisation_rate: 0.01,
            bulk: Bulk::of_grains(GLASS_BEADS.solid_fraction),
            // Table 1, glass beads
            material: Rheology::MuI(GLASS_BEADS.law),
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper | Tier::Fine => Self {
                slope_angles: vec![0.0, 10.0, 16.0, 22.0, 23.0, 24.0, 25.0],
                other_gate_speeds: vec![2.3, 0.0],
                regularised_slope_angles: vec![16.0, 22.0],
                ..quick
            },
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        let Reservoir { initial_height, reservoir_length, channel_length, resolution, numerics, .. } = &self.reservoir;
        let (least, most) = (3.0 * reservoir_length, 1000.0 * reservoir_length);
        let remedy = "the channel must hold the reservoir, the gate and the run-out";
        rules::between("channel_length", *channel_length, least, most, remedy)?;
        let rows = (initial_height / reservoir_length * *resolution as f64).round();
        if !(4.0..=1000.0).contains(&rows) {
            let rule = "such that the reservoir is 4 to 1000 rows of particles high";
            let remedy = format!(
                "its height, `initial_height` over `reservoir_length` times this, is {rows}: choose a {} resolution",
                if rows < 4.0 { "larger" } else { "smaller" }
            );
            return Err(ParameterError::field("resolution", resolution, rule, &remedy));
        }
        rules::material("material", &self.material)?;
        self.bulk.check(&self.material)?;
        if !self.regularised_slope_angles.is_empty() {
            let remedy = "(35) regularises μ(I): choose it, or empty `regularised_slope_angles`";
            rules::only_mu_i("material", &self.material, remedy)?;
            rules::implicit_runs("numerics", numerics, "regularised_slope_angles")?;
        }
        if self.runs().iter().any(|run| run.gate_speed > 0.0) {
            rules::gate("numerics", numerics)?;
        }
        rules::viscous_step("numerics", numerics, &self.material)
    }

    fn runs(&self) -> Vec<SlopeRun> {
        let slopes = self.slope_angles.iter().map(|&angle| self.run(angle, self.gate_speed));
        let gates = self.other_gate_speeds.iter().filter(|&&speed| speed != self.gate_speed);
        let gates = gates.map(|&speed| self.run(self.gate_slope_angle, speed));
        let Reservoir { duration, numerics, .. } = self.reservoir;
        let regularised = self.regularised_slope_angles.iter().map(|&angle| SlopeRun {
            regularisation_rate: Some(self.regularisation_rate),
            reservoir: Reservoir {
                duration: REGULARISED_DURATION.min(duration),
                numerics: Numerics { viscous_step: ViscousStep::Implicit, ..numerics },
                ..self.reservoir
            },
            ..self.run(angle, self.gate_speed)
        });
        slopes.chain(gates).chain(regularised).collect()
    }
}

impl InclineCollapseParameters {
    /// A run at a slope `[°]` with a gate `[m/s]`.
    pub(crate) fn run(&self, slope_angle: f64, gate_speed: f64) -> SlopeRun {
        SlopeRun {
            slope_angle,
            gate_speed,
            law: self.material,
            bulk_density: self.bulk.density(&self.material),
            regularisation_rate: None,
            reservoir: self.reservoir,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reservoir_channel_and_gate_are_those_of_the_experiment() {
        for (tier, slopes) in [(Tier::Quick, vec![22.0]), (Tier::Paper, vec![22.0, 23.0, 24.0, 25.0])] {
            let parameters = InclineCollapseParameters::of_tier(tier);
            let Reservoir { initial_height, reservoir_length, channel_length, .. } = parameters.reservoir;
            assert_eq!((initial_height, reservoir_length, channel_length), (0.14, 0.2, 3.0));
            assert!((initial_height / reservoir_length - 0.7).abs() < 1e-12);
            assert_eq!(parameters.gate_speed, 1.3);
            assert!(
                slopes.iter().all(|slope| parameters.slope_angles.contains(slope)),
                "{:?}",
                parameters.slope_angles
            );
        }
    }
}
