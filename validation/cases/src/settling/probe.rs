//! What a settling run leaves behind: slip over time, and how far momentum closes in every step.

use crate::case::recording::{Ending, RestartableRun, SimulationStage, follow};
use crate::case::{ParameterError, Progress};
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::output::Table;
use crate::reference::settling::SettlingGrains;
use crate::statistics::block_average;
use bagnold_solver::incompressible::{
    DragSlip, IncompressibleScene, IncompressibleSimulation, IncompressibleSnapshot, Sediment,
};
use bagnold_solver::kernel::{Kernel, KernelShape};
use bagnold_solver::run::SceneError;
use bagnold_solver::vector::Vector;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Part of the run that is averaged, at its end `[-]`.
const WINDOW: f64 = 0.6;

/// Samples of a run.
const SAMPLES: f64 = 500.0;

/// Settling over time; every array has the shape `[samples]`.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct SettlingSeries {
    /// Time `[s]`.
    pub time: Vec<f64>,
    /// Slip that the drag is taken from `[m/s]`.
    pub slip: Vec<f64>,
    /// Velocity at which the grains sink `[m/s]`.
    pub sinking: Vec<f64>,
    /// Root mean square of the grains' velocities less their mean `[m/s]`; 0 of a grain alone.
    pub unevenness: Vec<f64>,
}

impl SettlingSeries {
    pub(super) fn table(&self, variant: &Variant) -> Table {
        let columns: [(&str, &[f64]); 4] = [
            ("t [s]", &self.time),
            ("slip [m/s]", &self.slip),
            ("sinking velocity [m/s]", &self.sinking),
            ("unevenness [m/s]", &self.unevenness),
        ];
        Table::of_columns(format!("series-{}", variant.file_name()), &columns)
    }

    /// Mean of an array over the window at the run's end, and its standard error.
    pub fn mean(&self, array: &[f64]) -> (f64, f64) {
        let end = self.time.last().copied().unwrap_or_default();
        let samples = self.time.iter().zip(array).filter(|(time, _)| **time >= (1.0 - WINDOW) * end);
        let samples: Vec<f64> = samples.map(|(_, value)| *value).collect();
        block_average(&samples).map_or((f64::NAN, f64::NAN), |mean| (mean.value, mean.standard_error))
    }
}

/// All that a run leaves behind.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct SettlingObservation {
    /// Over time.
    pub series: SettlingSeries,
    /// Largest |Δ Σ m u − Δt F| of a step over Δt |Σ m g| of the grains `[-]`: F is gravity on both phases, less the
    /// uniform pressure gradient that carries a suspension.
    pub momentum_error: f64,
}

/// Watches a run; sees every step.
pub(super) struct Probe {
    grains: SettlingGrains,
    kernel: Kernel<2>,
    size: Vector<2>,
    interval: f64,
}

/// What has been seen of a run.
#[derive(Serialize, Deserialize)]
struct SettlingObserver {
    /// Momentum of both phases after the last step, and its time `[s]`.
    momentum: Vector<2>,
    time: f64,
    observation: SettlingObservation,
    last_good: IncompressibleSnapshot<2>,
}

impl Probe {
    /// Runs a scene of some grains, periodic over lengths `[m]`, for a time `[s]`.
    pub(super) fn run(
        scene: &IncompressibleScene<2>,
        grains: SettlingGrains,
        size: Vector<2>,
        duration: f64,
        progress: &Progress,
    ) -> Result<Recorded<SettlingObservation>, ParameterError> {
        let probe = Self {
            grains,
            kernel: Kernel::new(KernelShape::CubicSpline, sediment(scene).drag_smoothing_length),
            size,
            interval: duration / SAMPLES,
        };
        // momentum is that of every step
        let interval = 1e-3 * scene.numerics.time_step;
        let stage = SimulationStage { progress, end: duration, interval, window: 0.0, context: &() };
        let begin = |simulation: &IncompressibleSimulation<2>| SettlingObserver {
            momentum: Vector::zeros(),
            time: 0.0,
            observation: SettlingObservation::default(),
            last_good: simulation.snapshot(),
        };
        let followed = follow(
            stage,
            None,
            |_| Ok::<_, SceneError>(scene.clone()),
            begin,
            |seen, simulation| {
                if probe.observe(seen, simulation) {
                    seen.last_good = simulation.snapshot();
                    let particles = simulation.free_particles() as f64;
                    progress.advance(simulation.time(), duration, simulation.steps() as f64 * particles);
                }
                ControlFlow::Continue(())
            },
            |_| Ok(()),
        )?;
        let RestartableRun { simulation, stop, kept: SettlingObserver { last_good, observation, .. }, started } =
            followed;
        Ok(Ending::of(stop, last_good, started).record(&simulation, |_| observation))
    }

    /// Observes a step; true where it was a sample.
    fn observe(&self, seen: &mut SettlingObserver, simulation: &IncompressibleSimulation<2>) -> bool {
        let [momentum, force, weight] = momentum(simulation);
        let (before, step) = (seen.momentum, simulation.time() - seen.time);
        (seen.momentum, seen.time) = (momentum, simulation.time());
        if simulation.steps() == 0 {
            return false;
        }
        let error = (momentum - before - force * step).norm() / (weight.norm() * step);
        let SettlingObservation { series, momentum_error } = &mut seen.observation;
        *momentum_error = momentum_error.max(error);
        if seen.time < self.interval * (series.time.len() + 1) as f64 * (1.0 - 1e-9) {
            return false;
        }
        let [mean, drag, sinking] = self.around_grains(simulation);
        series.time.push(seen.time);
        series.slip.push(match simulation.scene().numerics.drag_slip {
            DragSlip::Mean => mean,
            // U of C_d(U) U² = |⟨C_d |u_ba| u_ba⟩|
            DragSlip::Pair => self.grains.slip_of_drag(sediment(simulation.scene()).drag, drag).unwrap_or(f64::NAN),
        });
        series.sinking.push(sinking);
        series.unevenness.push(unevenness(simulation.sediment().1));
        true
    }

    /// |⟨u_f⟩ − u_s| `[m/s]` and |⟨C_d R (u_f − u_s)⟩| `[m/s]` with means over the fluid around each grain, of all grains,
    /// and the velocity at which they sink `[m/s]`.
    fn around_grains(&self, simulation: &IncompressibleSimulation<2>) -> [f64; 3] {
        let law = sediment(simulation.scene()).drag;
        let ((place, fluid), (grain_place, grain)) = (simulation.fluid(), simulation.sediment());
        let [mut mean, mut mean_drag, mut sinking] = [0.0; 3];
        let place: Vec<[f64; 2]> = place.iter().map(|x| [x[0], x[1]]).collect();
        let (width, height) = (self.size[0], self.size[1]);
        // with room for rounding: the kernel alone says where it ends
        let out_of_reach = (1.001 * self.kernel.support()).powi(2);
        // the nearest image of a distance along an axis
        let nearest = |way: f64, size: f64| way - size * (way / size).round();
        for (centre, own) in grain_place.iter().zip(grain) {
            let centre = [centre[0], centre[1]];
            let (mut weight, mut slip, mut drag) = (0.0, [0.0; 2], [0.0; 2]);
            for (x, u) in place.iter().zip(fluid) {
                let dx = nearest(x[0] - centre[0], width);
                let dy = nearest(x[1] - centre[1], height);
                let square_of_way = dx * dx + dy * dy;
                // most of the fluid is out of reach, and kernel and drag law are what costs
                if square_of_way > out_of_reach {
                    continue;
                }
                let value = self.kernel.value(square_of_way);
                if value == 0.0 {
                    continue;
                }
                let pair = [u.x - own.x, u.y - own.y];
                let pair_square = pair[0] * pair[0] + pair[1] * pair[1];
                let product = law.drag_times_reynolds(self.grains.reynolds(pair_square.sqrt())).unwrap_or(f64::NAN);
                weight += value;
                for axis in 0..2 {
                    slip[axis] += pair[axis] * value;
                    drag[axis] += pair[axis] * (value * product);
                }
            }
            let share = 1.0 / grain.len() as f64;
            mean += share * (Vector::from(slip) / weight).norm();
            mean_drag += share * (Vector::from(drag) / weight).norm();
            sinking -= share * own[1];
        }
        [mean, mean_drag, sinking]
    }
}

/// Momentum of both phases, the forces on them from outside, and the weight of the grains, per metre of width.
fn momentum(simulation: &IncompressibleSimulation<2>) -> [Vector<2>; 3] {
    let (scene, material) = (simulation.scene(), sediment(simulation.scene()));
    let fluid = (simulation.fluid().1, simulation.voidage(), &scene.fluid.gravity);
    let grains = (simulation.sediment().1, &material.filling[..], &material.gravity);
    let gradient = simulation.mean_pressure_gradient();
    let of = |(velocity, share, gravity): (&[Vector<2>], &[f64], &Vector<2>), density: f64, spacing: f64| {
        // plain coordinates: this is done at every step
        let (mut along, mut across, mut volume) = (0.0, 0.0, 0.0);
        for (velocity, share) in velocity.iter().zip(share) {
            let mass = share * density * spacing * spacing;
            along += velocity.x * mass;
            across += velocity.y * mass;
            volume += share * spacing * spacing;
        }
        let momentum = Vector::<2>::new(along, across);
        (momentum, gravity * (density * volume), gradient * volume)
    };
    let (of_fluid, fluid_weight, on_fluid) = of(fluid, scene.fluid.density, scene.fluid.spacing);
    let (of_grains, weight, on_grains) = of(grains, material.density, material.spacing);
    // where the phases overlap the gradient is zero
    [of_fluid + of_grains, fluid_weight + weight - on_fluid - on_grains, weight]
}

/// Root mean square of velocities less their mean `[m/s]`.
fn unevenness(velocity: &[Vector<2>]) -> f64 {
    let count = velocity.len() as f64;
    let mean = velocity.iter().fold(Vector::<2>::zeros(), |sum, u| sum + u) / count;
    (velocity.iter().map(|u| (u - mean).norm_squared()).sum::<f64>() / count).sqrt()
}

fn sediment(scene: &IncompressibleScene<2>) -> &Sediment<2> {
    scene.sediment.as_ref().expect("a settling run has grains")
}
