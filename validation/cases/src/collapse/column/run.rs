//! One column: its scene and its run.

use super::material::Material;
use super::release::Release;
use crate::case::recording::{self, Ending, ObservedRun, SimulationStage};
use crate::case::{ParameterError, Progress, Run, RunScales, cost};
use crate::collapse::heap::{AT_REST, CollapseObserver, GrainBlock, STIFFNESS, Surveyor, radius};
use crate::collapse::{Collapse, CollapseRecord};
use crate::metric::{FlowRegime, Variant};
use crate::observation::Recorded;
use crate::setup::acoustic_step;
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::scene::Scene;
use bagnold_solver::weakly_compressible::simulation::{Compiled, Simulation};
use serde::Serialize;
use std::ops::ControlFlow;

/// Time over √(h_0/g) before which no column has fallen `[-]`.
pub(crate) const EARLIEST_REST: f64 = 2.0;
/// Points of the time series over √(h_0/g).
const POINTS: f64 = 40.0;
/// Pictures over the collapse, at these times over √(h_0/g) `[-]`; the deposit follows.
pub(crate) const PICTURES: [f64; 4] = [0.0, 0.75, 1.5, 2.5];
/// Time between the frames of the animation over √(h_0/g) `[-]`.
const FRAME_INTERVAL: f64 = 0.1;
/// Aspect ratio above which planar columns have a resolution of their own `[-]`.
pub(crate) const TALLEST_FINE: f64 = 5.0;

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
pub enum ColumnPurpose {
    /// To be compared with the published laws.
    Law,
    /// One of several resolutions and seeds.
    Convergence,
    /// One of several hourglass coefficients.
    Hourglass,
    /// The regularised law with an implicit viscous step, beside the return mapping.
    Regularised,
    /// With an eddy viscosity, beside the same column without.
    Eddies,
    /// Without the coupling of density and pressure, beside the same column with it.
    Uncoupled,
    /// Another seed of a column whose velocity profile is judged by the mean over seeds.
    ProfileSeed,
}

/// One simulation.
#[derive(Debug, Clone, Serialize)]
pub struct ColumnRun {
    /// What it is for.
    pub purpose: ColumnPurpose,
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
    /// Times of further pictures `[s]`, as a paper shows them.
    pub(crate) shown_times: Vec<f64>,
    /// How it is released and simulated.
    pub release: Release,
}

impl Run for ColumnRun {
    type Observation = Collapse;

    fn variant(&self) -> Variant {
        let column = Variant::of("material", self.material.to_string())
            .and("aspect_ratio", self.aspect_ratio)
            .and("resolution", self.resolution);
        match self.purpose {
            ColumnPurpose::Law => column,
            ColumnPurpose::Convergence | ColumnPurpose::ProfileSeed => column.and("seed", self.release.seed),
            ColumnPurpose::Hourglass => {
                column.and("hourglass", self.release.numerics.hourglass).and("seed", self.release.seed)
            }
            ColumnPurpose::Eddies => column.and("smagorinsky_constant", self.release.numerics.smagorinsky_constant),
            ColumnPurpose::Uncoupled => column.and("density_coupling", self.release.numerics.density_coupling),
            ColumnPurpose::Regularised => column.and("regularisation_rate", self.regularisation_rate.unwrap_or(0.0)),
        }
    }

    fn regime(&self, collapse: &Collapse) -> FlowRegime {
        let height = self.initial_height() * self.half_width;
        let section = match self.geometry {
            Geometry::Planar => self.half_width,
            Geometry::Round => std::f64::consts::FRAC_PI_4 * self.half_width * self.half_width,
        };
        let speed = collapse.fastest(self.bulk_density * section * height);
        let aspect_ratio = Some(self.initial_height());
        FlowRegime { aspect_ratio, slope_angle: Some(0.0), ..FlowRegime::default() }.of_grains(
            self.law.grain_diameter(),
            height,
            speed,
            self.release.gravity,
        )
    }

    fn scales(&self) -> Option<RunScales> {
        Some(RunScales { length: self.half_width, time: self.time_scale() })
    }

    fn particles(&self) -> f64 {
        let n = self.resolution as f64;
        let section = if self.geometry == Geometry::Planar { n } else { std::f64::consts::FRAC_PI_4 * n * n };
        section * self.rows() as f64
    }

    fn seconds_per_particle_step(&self) -> f64 {
        match self.geometry {
            Geometry::Planar => cost::WEAKLY_COMPRESSIBLE,
            Geometry::Round => 4.0 * cost::WEAKLY_COMPRESSIBLE,
        }
    }

    fn particle_steps(&self) -> f64 {
        let sound_speed = (self.bulk_modulus() / self.bulk_density).sqrt();
        let step = acoustic_step(&self.release.numerics, self.spacing(), sound_speed);
        // most columns rest well before their time is up
        let expected = 5.0_f64.min(self.release.duration) * self.time_scale() / step;
        expected * self.particles()
    }

    fn trajectory(&self) -> Option<Self> {
        Some(Self { release: Release { duration: 0.0, ..self.release }, ..self.clone() })
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
        (self.initial_height() * self.half_width / self.release.gravity).sqrt()
    }

    /// Whether only exponents are fitted to it: a tall column of the paper's sand that is too coarse for a law.
    pub(crate) fn is_for_exponents(&self) -> bool {
        self.material == Material::SAND
            && self.geometry == Geometry::Planar
            && self.aspect_ratio > TALLEST_FINE
            && self.resolution < 20
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
        let pressure = self.bulk_density * self.release.gravity * self.initial_height() * self.half_width;
        let viscosity = self.law.largest_viscosity(pressure);
        let smoothing_length = self.release.numerics.smoothing_ratio * self.spacing();
        time * viscosity
            / (self.release.numerics.viscous_courant * smoothing_length * smoothing_length * self.bulk_density)
    }

    /// Whether its law is the one that the published grains are given: with another one their experiments are shown, and
    /// do not gate.
    #[must_use]
    pub fn has_published_law(&self) -> bool {
        matches!(self.law, Rheology::MuI(_)) && !self.material.is_own(&self.law)
    }

    /// Whether its grains are published ones without a change.
    #[must_use]
    pub fn is_published(&self) -> bool {
        self.material.is_published() && self.has_published_law()
    }

    /// The run of this column by return mapping and the default numerics, with which one of another purpose is compared.
    pub(crate) fn partner<'a>(&self, records: &'a [CollapseRecord]) -> Option<&'a CollapseRecord> {
        records.iter().find(|(other, _)| {
            other.purpose == ColumnPurpose::Law
                && (other.material, other.aspect_ratio, other.resolution)
                    == (self.material, self.aspect_ratio, self.resolution)
        })
    }

    /// Whether the grains are a user's own: those of a published law with another law, whatever that is.
    #[must_use]
    pub fn is_of_own_grains(&self) -> bool {
        self.regularisation_rate.is_none() && self.material.is_own(&self.law)
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
        STIFFNESS * self.bulk_density * self.release.gravity * self.initial_height() * self.half_width
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

    /// Has measured nothing of it yet.
    pub(crate) fn surveyor(&self) -> Surveyor {
        Surveyor {
            half_width: self.half_width,
            spacing: self.spacing(),
            gravity: [0.0, -self.release.gravity],
            bed_end: self.bed_end(),
            collapse: Collapse::default(),
        }
    }

    fn scene<const D: usize>(&self) -> Scene<D> {
        let (spacing, n) = (self.spacing(), self.resolution);
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
        let symmetry = AxisBoundary::Mirror { lower: Some(0.0), upper: None };
        let mut domain = Domain { axes: [symmetry; D] };
        domain.axes[1] = AxisBoundary::Open;
        let Release { gravity, jitter, seed, numerics, .. } = self.release;
        let block = GrainBlock {
            spacing,
            height: self.rows() as f64 * spacing,
            gravity: Vector::<D>::from_fn(|axis, _| if axis == 1 { -gravity } else { 0.0 }),
            density: self.bulk_density,
            bulk_modulus: self.bulk_modulus(),
            rheology: self.law,
            jitter,
            seed,
            numerics,
        };
        let sites = (0..self.rows() * n.pow(D as u32 - 1)).map(site).filter(inside);
        let mut scene = block.scene(sites, domain, self.bed_end());
        if self.geometry == Geometry::Round {
            scene.wall_particles.retain(|particle| radius(&particle.position) < self.bed_end());
        }
        scene
    }

    fn run<const D: usize>(&self, progress: &dyn Progress) -> Result<Recorded<Collapse>, ParameterError>
    where
        Simulation<D>: Compiled<D>,
    {
        let (scale, duration) = (self.time_scale(), self.release.duration * self.time_scale());
        if self.regularisation_rate.is_some() {
            tracing::info!(
                "{}: implicit viscous step; an explicit one would need about {:.1e} steps",
                self.variant(),
                self.explicit_viscous_steps(duration)
            );
        }
        let begin = |_: &_| {
            CollapseObserver::new(self.surveyor(), FRAME_INTERVAL * scale, self.picture_times(), EARLIEST_REST * scale)
        };
        let stage = SimulationStage { progress, end: duration, interval: scale / POINTS, window: 0.0, context: &() };
        let watched = recording::watch(
            stage,
            |_| Ok(self.scene::<D>()),
            begin,
            |watch, snapshot| {
                let (_, rests) = watch.observe(snapshot);
                if rests { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
            },
        )?;
        let ObservedRun { simulation, ending, kept: mut watch } = watched;
        let criterion = format!("the deposit rests: kinetic energy below {AT_REST:.0e} of the energy released");
        let frames = std::mem::take(&mut watch.frames);
        let ending = Ending { criterion, frames, ..ending };
        Ok(ending.record(&simulation, |end| watch.finish_with_deposit(end)))
    }
}
