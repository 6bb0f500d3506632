//! A reservoir of grains behind a gate on an incline: its scene and its run.

use super::reservoir::Reservoir;
use crate::case::recording::{self, Ending, ObservedRun, SimulationStage};
use crate::case::{ParameterError, Progress, Run, RunScales};
use crate::collapse::Collapse;
use crate::collapse::heap::{AT_REST, CollapseObserver, GrainBlock, STIFFNESS, Surveyor};
use crate::metric::{FlowRegime, Value, Variant};
use crate::observation::Recorded;
use crate::setup::{Lattice, acoustic_step};
use crate::shared::close_by_gate;
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::scene::Scene;
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

/// One simulation.
#[derive(Debug, Clone, Serialize)]
pub struct SlopeRun {
    /// Slope θ `[°]`.
    pub slope_angle: f64,
    /// Speed at which the gate is pulled up, normal to the slope `[m/s]`; 0 for no gate.
    pub gate_speed: f64,
    /// Constitutive law of the grains.
    pub law: Rheology,
    /// Bulk density `[kg/m³]`.
    pub bulk_density: f64,
    /// Rate α_r `[1/s]` of the law's regularised viscosity (35), with an implicit step; none for the law itself.
    pub regularisation_rate: Option<f64>,
    /// Where it happens, and how it is simulated.
    pub reservoir: Reservoir,
}

/// What a collapse on a slope leaves behind; lengths over the reservoir's length, times in `[s]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct SlopeCollapse {
    /// Front, energies, deposit and balances.
    pub collapse: Collapse,
    /// Thickness over r_0 in every bin of the channel at each time of the series, shape `[times][bins]` `[-]`.
    pub thickness: Vec<Vec<f64>>,
}

impl Run for SlopeRun {
    type Observation = SlopeCollapse;

    fn laws(&self) -> Vec<Rheology> {
        vec![self.rheology()]
    }

    fn variant(&self) -> Variant {
        let gate = if self.gate_speed > 0.0 { Value::from(self.gate_speed) } else { Value::from("none") };
        let collapse =
            Variant::of("slope_angle", self.slope_angle).and("gate", gate).and("resolution", self.reservoir.resolution);
        match self.regularisation_rate {
            None => collapse,
            Some(rate) => collapse.and("regularisation_rate", rate),
        }
    }

    fn regime(&self, observation: &SlopeCollapse) -> FlowRegime {
        let Reservoir { initial_height, reservoir_length, gravity, .. } = self.reservoir;
        let speed = observation.collapse.fastest(self.bulk_density * reservoir_length * initial_height);
        let aspect_ratio = Some(initial_height / reservoir_length);
        FlowRegime { aspect_ratio, slope_angle: Some(self.slope_angle), ..FlowRegime::default() }.of_grains(
            self.law.grain_diameter(),
            initial_height,
            speed,
            gravity,
        )
    }

    fn scales(&self) -> Option<RunScales> {
        let Reservoir { initial_height, reservoir_length, gravity, .. } = self.reservoir;
        Some(RunScales { length: reservoir_length, time: (initial_height / gravity).sqrt() })
    }

    fn particles(&self) -> f64 {
        (self.reservoir.resolution * self.rows()) as f64
    }

    fn particle_steps(&self) -> f64 {
        let sound_speed = (self.bulk_modulus() / self.bulk_density).sqrt();
        let step = acoustic_step(&self.reservoir.numerics, self.spacing(), sound_speed);
        self.reservoir.duration / step * self.particles()
    }

    fn trajectory(&self) -> Option<Self> {
        Some(Self { reservoir: Reservoir { duration: 0.0, ..self.reservoir }, ..self.clone() })
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<SlopeCollapse>, ParameterError> {
        let Reservoir { reservoir_length, channel_length, duration, .. } = self.reservoir;
        let surveyor = self.surveyor();
        let begin =
            |_: &_| (CollapseObserver::new(surveyor, FRAME_INTERVAL, PICTURES.to_vec(), EARLIEST_REST), Vec::new());
        let stage = SimulationStage { progress, end: duration, interval: INTERVAL, window: 0.0, context: &() };
        let end_of_channel = channel_length - 0.5 * reservoir_length;
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

impl SlopeRun {
    /// What measures it.
    pub(crate) fn surveyor(&self) -> Surveyor {
        Surveyor {
            half_width: self.reservoir.reservoir_length,
            spacing: self.spacing(),
            gravity: self.gravity(),
            bed_end: self.reservoir.channel_length,
            collapse: Collapse::default(),
        }
    }

    /// Particle spacing `[m]`.
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.reservoir.reservoir_length / self.reservoir.resolution as f64
    }

    /// Whether there are enough rows over the height for a gate.
    #[must_use]
    pub fn is_resolved(&self) -> bool {
        self.rows() >= 20
    }

    /// The law that is simulated: that of the grains, regularised where asked for.
    fn rheology(&self) -> Rheology {
        match (self.law, self.regularisation_rate) {
            (Rheology::MuI(grains), Some(rate)) => Rheology::RegularisedMuI(grains.regularised(rate)),
            (law, _) => law,
        }
    }

    fn rows(&self) -> usize {
        (self.reservoir.initial_height / self.spacing()).round().max(1.0) as usize
    }

    fn bulk_modulus(&self) -> f64 {
        STIFFNESS * self.bulk_density * self.reservoir.gravity * self.reservoir.initial_height
    }

    /// Gravity along the slope and across it `[m/s²]`.
    fn gravity(&self) -> [f64; 2] {
        let angle = self.slope_angle.to_radians();
        [self.reservoir.gravity * libm::sin(angle), -self.reservoir.gravity * libm::cos(angle)]
    }

    fn scene(&self) -> Scene<2> {
        let spacing = self.spacing();
        let Reservoir { resolution, jitter, seed, numerics, channel_length, .. } = self.reservoir;
        let lattice = Lattice { spacing, rows: self.rows(), columns: resolution, bottom: 0.0 };
        let height = lattice.height();
        let block = GrainBlock {
            spacing,
            height,
            gravity: Vector::<2>::from(self.gravity()),
            density: self.bulk_density,
            bulk_modulus: self.bulk_modulus(),
            rheology: self.rheology(),
            jitter,
            seed,
            numerics,
        };
        // the back of the reservoir is smooth
        let domain = Domain { axes: [AxisBoundary::Mirror { lower: Some(0.0), upper: None }, AxisBoundary::Open] };
        let mut scene = block.scene(lattice.sites(), domain, channel_length);
        if self.gate_speed > 0.0 {
            close_by_gate(&mut scene, self.reservoir.reservoir_length, height, self.gate_speed, GATE_ROWS);
        }
        scene
    }
}

impl SlopeCollapse {
    /// Thickness over r_0 at a place x/r_0 over time `[-]`, linear between the centres of two bins.
    #[must_use]
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

    /// Whether the grains came to rest before the end of the channel.
    #[must_use]
    pub fn came_to_rest(&self) -> bool {
        self.collapse.rest_time().is_finite()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn thickness_is_read_between_the_bins() {
        let collapse = SlopeCollapse { thickness: vec![vec![1.0, 0.5, 0.0], vec![0.2; 3]], ..SlopeCollapse::default() };
        let at = collapse.thickness_at(0.10);
        assert!((at[0] - 0.75).abs() < 1e-12 && (at[1] - 0.2).abs() < 1e-12, "{at:?}");
        assert_eq!(collapse.thickness_at(5.0), [0.0, 0.0]);
    }
}
