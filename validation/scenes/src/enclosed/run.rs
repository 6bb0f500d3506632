//! From the parameters to a scene of the solver, and what is watched while it runs.

use super::flow::{Dimension, SceneStart};
use super::gauges::Memory;
use super::periods::Periods;
use super::setting::{self, SceneBody, SceneGauge, SceneInlet, SceneWall};
use super::settling::{self, RestCriterion};
use super::sides::SceneSides;
use super::surfaces::{Surfaces, behind, first_behind};
use super::{BodyPreparation, SceneFlow, SceneObservation, series, shapes};
use crate::case::recording::{self, Ending, RestartableRun, SimulationStage, StartState};
use crate::case::{Flow, ParameterError, Progress, RunCost, RunList, Tier, cost};
use crate::checkpoint::Checkpoints;
use crate::metric::Variant;
use crate::observation::{Frame, Recorded};
use bagnold_number::four_digits;
use bagnold_solver::domain::Domain;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::enclosure::BoundarySet;
use bagnold_solver::weakly_compressible::enclosure::boundary_set::Exits;
use bagnold_solver::weakly_compressible::numerics::ViscousStep;
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use bagnold_solver::weakly_compressible::snapshot::Snapshot;
use bagnold_solver::weakly_compressible::time_step::TimeStepBounds;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Time at which particles are counted: for estimates.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Moment {
    Start,
    /// On average over the run.
    Mean,
    End,
}

/// State of the observer from sample to sample.
#[derive(Serialize, Deserialize)]
struct SceneObserver<const D: usize> {
    observation: SceneObservation<D>,
    memory: Memory<D>,
    pictures: Pictures,
    /// Time of the start `[s]`, and multiples of the interval that have passed since at the last sample; none before the first.
    passed: Option<(f64, u64)>,
}

/// Times H/c between two samples from which on the kinetic energy is seen in between `[-]`.
const COARSE: f64 = 1.25;
/// Times between two samples at which the kinetic energy is seen, at most.
const MOST_LOOKS: f64 = 64.0;

impl<const D: usize> SceneObserver<D> {
    /// Whether a sample is due now: at the start, at the first step after every multiple of an interval, and at the end `[s]`. Sees the kinetic
    /// energy if not.
    fn is_due(&mut self, simulation: &Simulation<D>, (end, interval): (f64, f64)) -> bool
    where
        Simulation<D>: Compiled<D>,
    {
        let (time, step) = (simulation.time(), simulation.time_step_bounds().step());
        let (origin, before) = self.passed.map_or((time, None), |(origin, number)| (origin, Some(number)));
        let number = ((time - origin) / interval + 1e-9).floor() as u64;
        let is_due = before.is_none_or(|before| number > before) || time >= end - 0.5 * step;
        if is_due {
            self.passed = Some((origin, number));
        } else {
            let particles = simulation.particles();
            let moving = particles.velocity[..particles.flow_count()].iter().zip(&particles.mass);
            let twice = moving.fold(0.0, |sum, (velocity, mass)| sum + mass * velocity.norm_squared());
            self.observation.energy.see(time, 0.5 * twice);
        }
        is_due
    }
}

/// Pictures on the way, at multiples of a period that is a power of two of intervals: of two runs that differ in their duration, the longer
/// has no picture that the shorter lacks.
#[derive(Serialize, Deserialize)]
struct Pictures {
    /// Time between two samples, and between two pictures `[s]`.
    interval: f64,
    period: f64,
    frames: Vec<Frame>,
}

impl Pictures {
    /// No samples yet, of which there will be at least a given number over a duration `[s]`.
    fn new(duration: f64, interval: f64, least: usize) -> Self {
        let mut period = interval;
        while 2.0 * period * least as f64 <= duration * (1.0 + 1e-9) {
            period *= 2.0;
        }
        Self { interval, period, frames: Vec::new() }
    }

    /// Number of periods at the sample of a time `[s]`.
    fn number(&self, time: f64) -> f64 {
        ((time + 0.5 * self.interval) / self.period).floor()
    }

    /// Whether a sample of a time `[s]` is the first of its period.
    fn is_due(&self, time: f64) -> bool {
        self.frames.last().is_none_or(|last| self.number(last.time) < self.number(time))
    }

    /// Takes the place of the pictures of a shorter run, with those of them that are its own.
    ///
    /// # Errors
    /// Pictures that the shorter run lacks.
    fn adopt(self, shorter: &mut Self) -> Result<(), String> {
        if shorter.period > self.period {
            return Err(format!("has a picture every {} s, not every {} s", shorter.period, self.period));
        }
        for frame in std::mem::replace(shorter, self).frames {
            if shorter.is_due(frame.time) {
                shorter.frames.push(frame);
            }
        }
        Ok(())
    }
}

impl<S: Dimension<D>, const D: usize> Flow for SceneFlow<S, D>
where
    Simulation<D>: Compiled<D>,
{
    const RUNS: &'static str = S::RUNS;
    const STATED: &'static [&'static str] = &["bodies", "walls", "inlets", "gauges", "measured"];
    type Observation = SceneObservation<D>;

    fn check(&self) -> Result<(), ParameterError> {
        self.checked()
    }

    fn doubts(&self) -> Vec<String> {
        let doubts = self.doubtful_parts().into_iter().chain(self.doubtful_yield()).chain(self.costly_viscosity());
        doubts.chain(self.thin_fronts(&RunList::<Self>::of_tier(Tier::Quick).base.gauges)).collect()
    }

    fn variant(&self) -> Variant {
        self.named()
    }

    fn cost(&self) -> RunCost {
        let mean = self.flow_particles(Moment::Mean);
        let crossings = match self.preparation {
            BodyPreparation::None => 0.0,
            BodyPreparation::Settled => settling::USUAL,
            BodyPreparation::Stressed => settling::USUAL_OF_LIQUID,
        };
        let settling = self.flow_particles(Moment::Start) * (crossings * self.crossing_time());
        let all_per_flow = (mean.max(1.0) + self.wall_particles()) / mean.max(1.0);
        let step = match self.numerics.viscous_step {
            ViscousStep::Explicit => 1.0,
            ViscousStep::Implicit => cost::IMPLICIT_STEP,
        };
        RunCost {
            particle_steps: (mean * self.duration + settling) / self.step_bounds().step(),
            seconds_per_particle_step: S::COST * cost::WEAKLY_COMPRESSIBLE * step * all_per_flow,
            preparation_seconds: cost::TRIANGLE
                * self.walls.iter().map(SceneWall::triangle_count).sum::<usize>() as f64,
            ..RunCost::weakly_compressible(self.flow_particles(Moment::End) + self.wall_particles(), 0.0)
        }
    }

    fn outline(&self) -> Option<SceneObservation<D>> {
        let none = SceneObservation::default();
        let columns = series::of_run(self, &none).iter().map(|one| one.columns.len()).sum();
        let gauges = vec![vec![0.0; 2]; columns];
        Some(SceneObservation { time: vec![0.0, self.duration], mass: vec![0.0; 2], gauges, ..none })
    }

    fn brief(&self) -> Option<String> {
        Some(self.summary())
    }

    fn trajectory(&self) -> Option<Self> {
        Some(Self { duration: 0.0, interval: 0.0, pictures: 0, ..self.clone() })
    }

    fn simulate(&self, progress: &Progress) -> Result<Recorded<SceneObservation<D>>, ParameterError> {
        let (made, cut_off) = self.scene()?;
        let begun = made.flow.position.len();
        if begun == 0 && self.inlets.is_empty() {
            let least = 2.0 * self.spacing;
            let defect = format!("no room for a particle in front of the walls (a body needs two spacings, {least} m)");
            let remedy = "widen a body, reduce the spacing, or reverse a wall";
            return Err(ParameterError::field("bodies", defect, "", remedy));
        }
        let (gravity, down, measures) = (self.pull(), self.down(), self.measures());
        // of grains in a liquid the whole weight, that of both, for the liquid bears its part
        let pull = (self.fall() / self.height()).max(setting::vector::<D>(&self.gravity).norm());
        let (likeness, state) = (self.likeness(), self.stored_state()?);
        let periods = Periods::of(&self.sides.axes());
        // an impact takes about a time H/c
        let crossings = self.interval / self.crossing_time();
        let looks = if crossings < COARSE { 1.0 } else { (2.0 * crossings).ceil().min(MOST_LOOKS) };
        let interval = self.interval / looks;
        let stage = SimulationStage { progress, end: self.duration, interval, window: 0.0, context: &likeness };
        let pictures = || Pictures::new(self.duration, self.interval, self.pictures);
        let known = |simulation: &Simulation<D>| begun + simulation.inflow().particles() as usize;
        let begin = |simulation: &Simulation<D>| SceneObserver {
            observation: SceneObservation::default(),
            memory: Memory::of(simulation, known(simulation)),
            pictures: pictures(),
            passed: None,
        };
        let RestartableRun { simulation, stop, kept: (last_good, watch), started } = recording::follow(
            stage,
            state.as_ref(),
            |beginning| match beginning {
                StartState::New => self.prepared(made.clone()),
                StartState::Continued | StartState::Described => Ok(made.clone()),
            },
            |simulation: &Simulation<D>| {
                if let Some(SceneStart { file, .. }) = &self.from {
                    progress.tell(&format!("starts at t = {} s, from {file}", four_digits(simulation.time())));
                }
                let (snapshot, mut watch) = (simulation.snapshot(), begin(simulation));
                let beds = watch.memory.find_beds(&measures, &down, simulation, &snapshot);
                for (gauge, _) in self.gauges.iter().zip(beds).filter(|(_, is_above)| *is_above) {
                    let name = gauge.name();
                    progress.tell(&format!("front `{name}` is that of the material above its line: below it is a bed"));
                }
                (snapshot, watch)
            },
            |(last_good, watch): &mut (Snapshot<D>, SceneObserver<D>), simulation| {
                if looks > 1.0 && !watch.is_due(simulation, (self.duration, self.interval)) {
                    return ControlFlow::Continue(());
                }
                *last_good = simulation.snapshot();
                let steps = simulation.steps() as f64 * last_good.mass.len() as f64;
                progress.advance(last_good.time, self.duration, steps);
                let values = watch.memory.read_all(&measures, simulation, last_good, (known(simulation), &periods));
                watch.observation.enter(simulation, last_good, (&gravity, pull), values);
                if watch.pictures.is_due(last_good.time) {
                    watch.pictures.frames.push(Frame::of_flow(last_good));
                }
                let is_over = simulation.inlets().iter().all(|inlet| inlet.rate.is_over(last_good.time));
                if last_good.mass.is_empty() && is_over { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            },
            |(_, watch)| pictures().adopt(&mut watch.pictures),
        )?;
        if let Some(state) = progress.ends.and_then(Checkpoints::newest) {
            progress.tell(&format!(
                "a state near its end, for --from, is {} (copy it: only the last two of a scene are kept)",
                state.display()
            ));
        }
        let mut ending = Ending::of(stop, last_good, started);
        "all material has left by open sides".clone_into(&mut ending.criterion);
        ending.frames = watch.pictures.frames;
        // the last state follows
        ending.frames.retain(|frame| frame.time + 0.5 * self.interval.min(self.duration) < self.duration);
        let mut observation = watch.observation;
        (observation.behind, observation.cut_off) = (behind(&simulation, S::SIDE), cut_off);
        Ok(ending.record(&simulation, |_| observation))
    }
}

impl<S: Dimension<D>, const D: usize> SceneFlow<S, D> {
    /// Particles of the bodies, and of what inlets have fed. Where there are open sides, what is beyond all that the scene's box holds
    /// is taken to have left by them.
    fn flow_particles(&self, moment: Moment) -> f64 {
        let cell = self.spacing.powi(D as i32);
        let bodies = self.bodies.iter().map(SceneBody::volume).sum::<f64>() / cell;
        if self.inlets.is_empty() {
            return bodies;
        }
        let fed = match moment {
            Moment::Start => 0.0,
            Moment::Mean => self.mean_fed_particles(),
            Moment::End => self.fed_particles(self.duration),
        };
        if self.sides.exits() == Exits::default() {
            return bodies + fed;
        }
        let (lower, upper) = self.sides.widen(self.extent());
        (bodies + fed).min((bodies).max(shapes::box_volume(&lower, &upper) / cell))
    }

    /// Dummy particles of the walls, and of the rows of inlets.
    fn wall_particles(&self) -> f64 {
        let walls: f64 = self.walls.iter().map(SceneWall::measure).sum();
        let openings: f64 = self.inlets.iter().map(|inlet| inlet.edges().iter().product::<f64>()).sum();
        (walls + openings) * self.depth_of_walls() / self.spacing.powi(D as i32)
    }

    /// The solver's own bounds of a step, with the largest viscosity and speed that the scene can come to.
    pub(super) fn step_bounds(&self) -> TimeStepBounds {
        let Self { numerics, spacing, material, .. } = self;
        let squared = self.fall();
        let equation_of_state = self.equation_of_state_over(squared);
        let (density, sound_speed) = (equation_of_state.reference_density, equation_of_state.sound_speed());
        let fall = squared.sqrt();
        let viscosity = material.largest_viscosity(density * fall * fall) / density;
        let smoothing_length = numerics.smoothing_ratio * spacing;
        TimeStepBounds::new(numerics, smoothing_length, sound_speed, self.expected_speed(), viscosity)
    }

    /// √(g H) with the height of the scene, and more under pressure `[m/s]`.
    fn fall_speed(&self) -> f64 {
        self.fall().sqrt()
    }

    /// Largest speed that falling, and bodies, walls and inlets relative to each other give `[m/s]`.
    pub(super) fn expected_speed(&self) -> f64 {
        self.relative_speed().max(2.0_f64.sqrt() * self.fall_speed())
    }

    /// Time that sound needs across the height of the scene `[s]`.
    fn crossing_time(&self) -> f64 {
        self.height() / self.equation_of_state().sound_speed()
    }

    /// The scene as the clock finds it at the start.
    ///
    /// # Errors
    /// Bodies that do not come to rest where they are to.
    fn prepared(&self, scene: Scene<D>) -> Result<Scene<D>, ParameterError>
    where
        Simulation<D>: Compiled<D>,
    {
        let fall = self.fall_speed();
        let (speed, peaks) = (self.rest_speed * fall, settling::LOW_PEAKS);
        let rest = RestCriterion { speed, peaks, fall, crossing: self.crossing_time() };
        let (scene, elapsed) = match self.preparation {
            BodyPreparation::None => return Ok(scene),
            BodyPreparation::Settled => settling::settled(scene, rest)?,
            BodyPreparation::Stressed => settling::stressed(scene, self.pulls().0, rest)?,
        };
        tracing::info!("bodies have settled within {elapsed:.4} s, before the run starts");
        Ok(scene)
    }

    /// Refuses material right behind a wall where another one is nearer: there the wall has no thickness to keep it away.
    fn check_backs(&self, enclosure: &BoundarySet<D>, places: &[Vector<D>]) -> Result<(), ParameterError> {
        let Some((wall, place)) = first_behind(&enclosure.walls, places, (self.spacing, S::SIDE)) else {
            return Ok(());
        };
        let place: Vec<String> = place.iter().map(|coordinate| four_digits(*coordinate)).collect();
        let (name, place) = (self.walls[wall].name(), place.join(", "));
        let defect = format!("material directly behind `{name}`, at ({place}) m, where it meets another wall");
        let remedy = "draw it as a closed wall, at least one spacing thick";
        Err(ParameterError::field(&format!("walls[{wall}]"), defect, "", remedy))
    }

    /// The scene, and the share of the sites of bodies that are behind walls `[-]`.
    ///
    /// # Errors
    /// A body of which walls take more than they may.
    pub(super) fn scene(&self) -> Result<(Scene<D>, f64), ParameterError> {
        let Self { spacing, numerics, material, .. } = *self;
        let (equation_of_state, enclosure) = (self.equation_of_state(), self.enclosure());
        let surfaces = Surfaces::of(&enclosure, self.depth_of_walls(), S::SIDE);
        self.check_openings(&enclosure.inlets, &surfaces)?;
        let (flow, cut_off) = self.fill(&surfaces, &equation_of_state)?;
        self.check_backs(&enclosure, &flow.position)?;
        let mut scene = Scene::unbounded(flow, spacing, equation_of_state, material);
        (scene.enclosure, scene.numerics, scene.side_walls) = (enclosure, numerics, self.side_walls);
        scene.domain = Domain { axes: self.sides.axes() };
        scene.gravity = self.pull();
        Ok((scene, cut_off))
    }
}
