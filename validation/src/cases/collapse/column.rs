//! One column: its scene and its run.

use super::block::Block;
use super::camera::Camera;
use super::deposit::{Collapse, Surveyor, front, radius};
use super::material::Material;
use crate::case::{ParameterError, Progress, Run};
use crate::cases::recording::Ending;
use crate::metric::Variant;
use crate::observation::{Frame, Recorded};
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::material::equation_of_state::{EquationOfState, Tension};
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::boundary::Wall;
use bagnold_solver::weakly_compressible::boundary::wall::fill;
use bagnold_solver::weakly_compressible::numerics::Numerics;
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use serde::Serialize;
use std::ops::ControlFlow;

/// Agitation (kinetic over released potential energy) below which the deposit rests and the run ends `[-]`.
const AT_REST: f64 = 5e-7;
/// Time over √(h_0/g) before which no column has fallen `[-]`.
const EARLIEST_REST: f64 = 2.0;
/// Bulk modulus over ρ0 g h_0 `[-]`.
const STIFFNESS: f64 = 50.0;
/// Points of the time series over √(h_0/g).
const POINTS: f64 = 40.0;
/// Pictures over the collapse, at these times over √(h_0/g) `[-]`; the deposit follows.
pub(super) const PICTURES: [f64; 4] = [0.0, 0.75, 1.5, 2.5];
/// Time between the frames of the moving picture over √(h_0/g) `[-]`.
const FRAME_INTERVAL: f64 = 0.1;

/// The column's cross-section.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Geometry {
    /// Infinitely long; half of it is simulated, in two dimensions.
    Planar,
    /// A cylinder; a quarter of it is simulated, in three dimensions.
    Round,
}

impl Geometry {
    /// Unit of an energy: of a metre of a planar column, of a quarter of a round one.
    #[must_use]
    pub fn energy_unit(self) -> &'static str {
        match self {
            Self::Planar => "J/m",
            Self::Round => "J",
        }
    }
}

/// What a column is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Purpose {
    /// To be compared with the published laws.
    Law,
    /// One of several resolutions and seeds.
    Convergence,
    /// One of several hourglass coefficients.
    Hourglass,
    /// The regularised law with an implicit viscous step, beside the return mapping.
    Regularised,
}

/// One simulation.
#[derive(Debug, Clone, Serialize)]
pub struct ColumnRun {
    /// What it is for.
    pub purpose: Purpose,
    /// Cross-section.
    pub geometry: Geometry,
    /// The grains.
    pub material: Material,
    /// h_0/r_0 `[-]`.
    pub aspect_ratio: f64,
    /// Particles over the half width.
    pub resolution: usize,
    /// Half width r_0 `[m]`.
    pub half_width: f64,
    /// Constitutive law.
    pub law: Rheology,
    /// Bulk density `[kg/m³]`.
    pub bulk_density: f64,
    /// Rate α_r `[1/s]` of the regularised viscosity (35) that stands for the case's law; none for that law itself.
    pub regularisation_rate: Option<f64>,
    pub(in crate::cases) gravity: f64,
    pub(in crate::cases) jitter: f64,
    pub(in crate::cases) seed: u64,
    pub(in crate::cases) duration: f64,
    /// Times of further pictures `[s]`, as a paper shows them.
    pub(in crate::cases) shown_times: Vec<f64>,
    pub(in crate::cases) numerics: Numerics,
}

impl Run for ColumnRun {
    type Observation = Collapse;

    fn variant(&self) -> Variant {
        let column = Variant::of("material", self.material.to_string())
            .and("aspect_ratio", self.aspect_ratio)
            .and("resolution", self.resolution);
        match self.purpose {
            Purpose::Law => column,
            Purpose::Convergence => column.and("seed", self.seed),
            Purpose::Hourglass => column.and("hourglass", self.numerics.hourglass),
            Purpose::Regularised => column.and("regularisation_rate", self.regularisation_rate.unwrap_or(0.0)),
        }
    }

    fn particle_steps(&self) -> f64 {
        let step = self.numerics.acoustic_courant * self.numerics.smoothing_ratio * self.spacing() / self.sound_speed();
        // most columns rest well before their time is up
        let expected = 5.0_f64.min(self.duration) * self.time_scale() / step;
        expected * self.particles()
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<Collapse>, ParameterError> {
        match self.geometry {
            Geometry::Planar => self.run::<2>(progress),
            Geometry::Round => self.run::<3>(progress),
        }
    }
}

impl ColumnRun {
    /// Particle spacing `[m]`.
    #[must_use]
    pub fn spacing(&self) -> f64 {
        self.half_width / self.resolution as f64
    }

    /// Initial height over the half width as the particles give it `[-]`: a whole number of rows.
    #[must_use]
    pub fn initial_height(&self) -> f64 {
        self.rows() as f64 / self.resolution as f64
    }

    /// √(h_0/g) `[s]`.
    #[must_use]
    pub fn time_scale(&self) -> f64 {
        (self.initial_height() * self.half_width / self.gravity).sqrt()
    }

    /// Whether there are enough rows over the height for a gate.
    #[must_use]
    pub fn is_resolved(&self) -> bool {
        self.rows() >= 20
    }

    /// Steps that the regularised law would need for a time `[s]` with an explicit viscous step (29); 0 without it.
    #[must_use]
    pub fn explicit_viscous_steps(&self, time: f64) -> f64 {
        if self.regularisation_rate.is_none() {
            return 0.0;
        }
        let pressure = self.bulk_density * self.gravity * self.initial_height() * self.half_width;
        let viscosity = self.law.largest_viscosity(pressure);
        let smoothing_length = self.numerics.smoothing_ratio * self.spacing();
        time * viscosity / (self.numerics.viscous_courant * smoothing_length * smoothing_length * self.bulk_density)
    }

    /// Whether its law is the one that the published grains are given: with another one their experiments are shown, and
    /// do not gate.
    #[must_use]
    pub fn has_published_law(&self) -> bool {
        matches!(self.law, Rheology::MuI(_))
    }

    /// Particles, about.
    #[must_use]
    pub fn particles(&self) -> f64 {
        let n = self.resolution as f64;
        let section = if self.geometry == Geometry::Planar { n } else { std::f64::consts::FRAC_PI_4 * n * n };
        section * self.rows() as f64
    }

    /// Times of all pictures but the deposit's `[s]`.
    fn picture_times(&self) -> Vec<f64> {
        let mut times: Vec<f64> = PICTURES.iter().map(|time| time * self.time_scale()).collect();
        times.extend(&self.shown_times);
        times.sort_by(f64::total_cmp);
        times
    }

    fn rows(&self) -> usize {
        (self.aspect_ratio * self.resolution as f64).round().max(1.0) as usize
    }

    /// Elastic over potential energy of the start `[-]`: under hydrostatic pressure p²/(2K) has the mean ρ0 g h_0/(6·50),
    /// the potential energy above the bed ρ0 g h_0/2.
    #[must_use]
    pub fn elastic_share(&self) -> f64 {
        1.0 / (3.0 * STIFFNESS)
    }

    /// K = 50 ρ0 g h_0 `[Pa]`.
    fn bulk_modulus(&self) -> f64 {
        STIFFNESS * self.bulk_density * self.gravity * self.initial_height() * self.half_width
    }

    fn sound_speed(&self) -> f64 {
        (self.bulk_modulus() / self.bulk_density).sqrt()
    }

    /// End of the bed `[m]`: well beyond the longest published run-out.
    fn bed_end(&self) -> f64 {
        let a = self.aspect_ratio;
        match self.geometry {
            Geometry::Planar => self.half_width * (2.0 + 1.5 * (2.7 * a).min(3.7 * libm::pow(a, 0.7))),
            // in space the bed costs more than the grains
            Geometry::Round => self.half_width * (1.5 + 1.3 * (1.35 * a).min(1.6 * a.sqrt())),
        }
    }

    fn scene<const D: usize>(&self) -> Scene<D> {
        let spacing = self.spacing();
        let height = self.rows() as f64 * spacing;
        let equation_of_state = EquationOfState {
            reference_density: self.bulk_density,
            bulk_modulus: self.bulk_modulus(),
            tension: Tension::Cut,
        };
        let n = self.resolution;
        let site = |cell: usize| {
            // along the first axis, then along the third, then upwards
            let along = |axis: usize| match axis {
                0 => cell % n,
                1 => cell / n.pow(D as u32 - 1),
                _ => cell / n % n,
            };
            Vector::<D>::from_fn(|axis, _| (along(axis) as f64 + 0.5) * spacing)
        };
        let inside = |site: &Vector<D>| {
            D == 2 || site[0] * site[0] + site[D - 1] * site[D - 1] <= self.half_width * self.half_width
        };
        let block = Block {
            spacing,
            height,
            gravity_across: self.gravity,
            equation_of_state,
            jitter: self.jitter,
            seed: self.seed,
        };
        let flow = block.fill((0..self.rows() * n.pow(D as u32 - 1)).map(site).filter(inside));
        let symmetry = AxisBoundary::Mirror { lower: Some(0.0), upper: None };
        let mut domain = Domain { axes: [symmetry; D] };
        domain.axes[1] = AxisBoundary::Open;
        let bed = Wall::still(1, 0.0, 1.0);
        let layers = (2.0 * self.numerics.smoothing_ratio).ceil() as usize + 1;
        let mut far = Vector::<D>::repeat(self.bed_end());
        far[1] = height;
        let extent = (Vector::<D>::zeros(), far);
        let mut gravity = Vector::<D>::zeros();
        gravity[1] = -self.gravity;
        let mut wall_particles = fill(&[bed], &domain, extent, spacing, layers);
        if self.geometry == Geometry::Round {
            let reach = self.bed_end();
            wall_particles.retain(|particle| radius(&particle.position) < reach);
        }
        Scene {
            flow,
            wall_particles,
            walls: vec![bed],
            domain,
            gravity,
            spacing,
            equation_of_state,
            rheology: self.law,
            numerics: self.numerics,
        }
    }

    fn run<const D: usize>(&self, progress: &dyn Progress) -> Result<Recorded<Collapse>, ParameterError>
    where
        Simulation<D>: Compiled<D>,
    {
        let started = std::time::Instant::now();
        if self.regularisation_rate.is_some() {
            tracing::info!(
                "{}: implicit viscous step; an explicit one would need about {:.1e} steps",
                self.variant(),
                self.explicit_viscous_steps(self.duration * self.time_scale())
            );
        }
        let mut simulation = Simulation::new(self.scene::<D>())?;
        let particles = simulation.particles().flow_count();
        let (scale, duration) = (self.time_scale(), self.duration * self.time_scale());
        let mut surveyor = Surveyor {
            half_width: self.half_width,
            spacing: self.spacing(),
            gravity: [0.0, -self.gravity],
            bed_end: self.bed_end(),
            collapse: Collapse::default(),
        };
        let r = self.half_width;
        let mut camera = Camera::new(FRAME_INTERVAL * scale, self.spacing());
        let mut frames = Vec::new();
        let times = self.picture_times();
        let mut pictured = 0;
        let mut last_good = simulation.snapshot();
        let reason = simulation.run(duration, scale / POINTS, |simulation| {
            let snapshot = simulation.snapshot();
            let thickness = surveyor.observe(&snapshot);
            camera.watch(&snapshot, thickness.iter().map(|(x, h)| (x * r, h * r)), front(&thickness) * r);
            let due = times.iter().filter(|&&time| snapshot.time >= time).count();
            if due > pictured {
                pictured = due;
                frames.push(Frame::of_flow(&snapshot));
            }
            progress.advance(snapshot.time, duration, simulation.steps() as f64 * particles as f64);
            let rests = snapshot.time > EARLIEST_REST * scale && surveyor.agitation() < AT_REST;
            last_good = snapshot;
            if rests { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        let ending = Ending {
            reason,
            last_good,
            criterion: format!("the deposit rests: kinetic energy below {AT_REST:.0e} of the energy released"),
            may_diverge: false,
            frames,
            started,
        };
        Ok(ending.record(&simulation, |end| {
            let mut collapse = surveyor.finish(end);
            let deposit = &collapse.deposit;
            camera.take(end, deposit.iter().map(|(x, h)| (x * r, h * r)), front(deposit) * r);
            collapse.motion = camera.motion;
            collapse
        }))
    }
}
