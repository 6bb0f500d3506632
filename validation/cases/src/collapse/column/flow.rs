//! The flow: a column of grains that collapses on a horizontal bed.

use super::material::{Alteration, ExperimentGrains, Material};
use crate::case::recording::{self, Ending, ObservedRun, SimulationStage};
use crate::case::{Flow, ParameterError, Progress, RunCost, RunScales, cost};
use crate::collapse::heap::{AT_REST, CollapseObserver, GrainBlock, STIFFNESS, Surveyor, radius};
use crate::collapse::{Collapse, CollapseRecord};
use crate::metric::{FlowRegime, Variant};
use crate::observation::Recorded;
use crate::reference::grains::TABLE_2_SAND;
use crate::setup::{Bulk, acoustic_step, rules};
use bagnold_solver::domain::{AxisBoundary, Domain};
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::parameter::{between, positive};
use bagnold_solver::vector::Vector;
use bagnold_solver::weakly_compressible::simulation::Compiled;
use bagnold_solver::weakly_compressible::{Numerics, Scene, Simulation};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::ops::ControlFlow;

/// Half width of the columns of the collapse paper's sand, planar and round `[m]`.
const SAND_HALF_WIDTH: f64 = 0.0972;
/// Time over √(h_0/g) before which no column has fallen `[-]`.
pub(crate) const EARLIEST_REST: f64 = 2.0;
/// Points of the time series over √(h_0/g).
const POINTS: f64 = 40.0;
/// Pictures over the collapse, at these times over √(h_0/g) `[-]`; the deposit follows.
pub(crate) const PICTURES: [f64; 4] = [0.0, 0.75, 1.5, 2.5];
/// The paper's figures 7–9 of planar columns: aspect ratio and times `[s]`.
const SHOWN: [(f64, &[f64]); 3] =
    [(0.9, &[0.07, 0.11, 0.3]), (2.75, &[0.04, 0.12, 0.34, 0.53]), (4.8, &[0.04, 0.2, 0.4])];
/// Time between the frames of the animation over √(h_0/g) `[-]`.
const FRAME_INTERVAL: f64 = 0.1;
/// Particles beyond which a column would take weeks or all memory.
const MOST_PARTICLES: f64 = 5e6;

/// A column of grains: planar in two dimensions, round in three.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ColumnFlow<const D: usize> {
    /// Grains whose experiments and laws it is compared with; with another law than theirs it is of a user's own.
    pub grains: ExperimentGrains,
    /// What the law differs in from that of these grains where that is the question.
    pub altered: Alteration,
    /// Aspect ratio a = h_0/r_0 `[-]`.
    #[schemars(transform = between(0.1, 100.0, "give 0.3 to 20, the range of the published laws"))]
    pub aspect_ratio: f64,
    /// Half width or radius r_0 `[m]`.
    #[schemars(transform = positive("give it in metres, such as 0.1"))]
    pub half_width: f64,
    /// Particles over the half width.
    #[schemars(transform = rules::rows())]
    pub resolution: usize,
    /// Gravity `[m/s²]`.
    #[schemars(transform = rules::gravity())]
    pub gravity: f64,
    /// Largest random displacement of a particle in spacings `[-]`.
    #[schemars(transform = between(0.0, 0.5, "give 0.05 to break the lattice without overlaps"))]
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
    /// Number in an ensemble that is judged by its mean, with displacements by `seed` + number − 1; 0 for a column by itself.
    pub ensemble_member: u32,
    /// Longest simulated time over √(h_0/g) `[-]`; a deposit at rest ends a run before.
    #[schemars(transform = between(0.1, 1000.0, "give 5 to 12, after which a column is at rest"))]
    pub duration: f64,
    /// Numerical scheme of the weakly compressible model.
    pub numerics: Numerics,
    /// Density in bulk.
    #[serde(flatten)]
    pub bulk: Bulk,
    /// Constitutive law of the grains.
    pub material: Rheology,
}

impl<const D: usize> Default for ColumnFlow<D> {
    fn default() -> Self {
        // in space 1.3 holds 80 neighbours, 1.5 holds 120
        let (aspect_ratio, resolution, smoothing_ratio) = if D == 2 { (0.9, 20, 1.5) } else { (1.7, 12, 1.3) };
        Self {
            grains: ExperimentGrains::Sand,
            altered: Alteration::Nothing,
            aspect_ratio,
            half_width: SAND_HALF_WIDTH,
            resolution,
            gravity: 9.81,
            jitter: 0.05,
            seed: 1,
            ensemble_member: 0,
            duration: 15.0,
            numerics: Numerics { smoothing_ratio, ..Numerics::default() },
            bulk: Bulk::of_grains(TABLE_2_SAND.solid_fraction),
            material: Rheology::MuI(TABLE_2_SAND.law),
        }
    }
}

impl<const D: usize> Flow for ColumnFlow<D> {
    const RUNS: &'static str = if D == 2 {
        include_str!("../../../runs/column-planar.toml")
    } else {
        include_str!("../../../runs/column-round.toml")
    };
    type Observation = Collapse;

    fn check(&self) -> Result<(), ParameterError> {
        if self.altered != Alteration::Nothing {
            let remedy = "`altered` names a number of μ(I): choose it, or altered = \"nothing\"";
            rules::only_mu_i("material", &self.material, remedy)?;
        }
        rules::material("material", &self.material)?;
        self.bulk.check(&self.material)?;
        rules::viscous_step("numerics", &self.numerics, &self.material)?;
        if self.particle_count() <= MOST_PARTICLES {
            return Ok(());
        }
        let (resolution, ratio) = (self.resolution, self.aspect_ratio);
        let defect = format!(
            "{resolution} gives {:.1e} particles for the aspect ratio {ratio}, above the limit of {MOST_PARTICLES:.0e}",
            self.particle_count()
        );
        Err(ParameterError::field("resolution", defect, "", "reduce it"))
    }

    fn variant(&self) -> Variant {
        let numerics = &self.numerics;
        let column = Variant::of("material", self.made_of().to_string())
            .and("aspect_ratio", self.aspect_ratio)
            .and("resolution", self.resolution);
        let others = [
            ("smagorinsky_constant", numerics.smagorinsky_constant, self.has_eddies()),
            ("density_coupling", numerics.density_coupling, !self.is_coupled()),
            ("hourglass", numerics.hourglass, self.has_other_hourglass()),
        ];
        let column = match self.material {
            Rheology::RegularisedMuI(law) => column.and("regularisation_rate", law.regularisation_rate),
            _ => column,
        };
        let named = others.into_iter().filter(|other| other.2);
        let column = named.fold(column, |column, (name, value, _)| column.and(name, value));
        if self.ensemble_member > 0 { column.and("seed", self.seed_of_displacements()) } else { column }
    }

    fn regime(&self, collapse: &Collapse) -> FlowRegime {
        let height = self.initial_height() * self.half_width;
        let r = self.half_width;
        let section = if D == 2 { r } else { std::f64::consts::FRAC_PI_4 * r * r };
        let speed = collapse.fastest(self.density() * section * height);
        let aspect_ratio = Some(self.initial_height());
        let regime = FlowRegime { aspect_ratio, slope_angle: Some(0.0), ..FlowRegime::default() };
        regime.of_grains(self.material.grain_diameter(), height, speed, self.gravity)
    }

    fn scales(&self) -> Option<RunScales> {
        Some(RunScales { length: self.half_width, time: self.time_scale() })
    }

    fn cost(&self) -> RunCost {
        let sound_speed = (self.bulk_modulus() / self.density()).sqrt();
        let step = acoustic_step(&self.numerics, self.spacing(), sound_speed);
        // most columns rest well before their time is up
        let expected = 5.0_f64.min(self.duration) * self.time_scale() / step;
        let dearer = if D == 2 { 1.0 } else { 4.0 };
        RunCost {
            seconds_per_particle_step: dearer * cost::WEAKLY_COMPRESSIBLE,
            ..RunCost::weakly_compressible(self.particle_count(), expected)
        }
    }

    fn trajectory(&self) -> Option<Self> {
        Some(Self { duration: 0.0, ..self.clone() })
    }

    fn simulate(&self, progress: &Progress) -> Result<Recorded<Collapse>, ParameterError> {
        if D == 2 { self.run::<2>(progress) } else { self.run::<3>(progress) }
    }
}

impl<const D: usize> ColumnFlow<D> {
    /// Material of the column.
    pub fn made_of(&self) -> Material {
        let Self { grains, altered, material, .. } = self;
        Material { grains: *grains, altered: *altered, value: altered.value_in(material) }
    }

    /// Bulk density `[kg/m³]`.
    pub fn density(&self) -> f64 {
        self.bulk.density(&self.material)
    }

    fn particle_count(&self) -> f64 {
        let n = self.resolution as f64;
        let section = if D == 2 { n } else { std::f64::consts::FRAC_PI_4 * n * n };
        section * self.rows() as f64
    }

    fn seed_of_displacements(&self) -> u64 {
        self.seed + u64::from(self.ensemble_member.saturating_sub(1))
    }

    /// Particle spacing `[m]`.
    pub fn spacing(&self) -> f64 {
        self.half_width / self.resolution as f64
    }

    /// Initial height over the half width as the particles give it `[-]`: a whole number of rows.
    pub fn initial_height(&self) -> f64 {
        self.rows() as f64 / self.resolution as f64
    }

    /// √(h_0/g) `[s]`.
    pub fn time_scale(&self) -> f64 {
        (self.initial_height() * self.half_width / self.gravity).sqrt()
    }

    /// Whether there are enough rows over the height for a gate.
    pub fn is_resolved(&self) -> bool {
        self.rows() >= 20
    }

    /// Steps that the regularised law would need for a time `[s]` with an explicit viscous step (29); 0 without it.
    pub fn explicit_viscous_steps(&self, time: f64) -> f64 {
        if !self.is_regularised() {
            return 0.0;
        }
        let pressure = self.density() * self.gravity * self.initial_height() * self.half_width;
        let viscosity = self.material.largest_viscosity(pressure);
        let smoothing_length = self.numerics.smoothing_ratio * self.spacing();
        time * viscosity / (self.numerics.viscous_courant * smoothing_length * smoothing_length * self.density())
    }

    /// Whether its law is the one that the published grains are given: with another one their experiments are shown, and
    /// do not gate.
    pub fn has_published_law(&self) -> bool {
        matches!(self.material, Rheology::MuI(_)) && !self.is_of_own_grains()
    }

    /// Whether its grains are published ones without a change.
    pub fn is_published(&self) -> bool {
        self.altered == Alteration::Nothing && self.has_published_law()
    }

    /// Whether the grains are a user's own: those of a published law with another law, whatever that is.
    pub fn is_of_own_grains(&self) -> bool {
        self.made_of().is_own(&self.material)
    }

    /// Whether its law is (35), which never comes to rest.
    pub fn is_regularised(&self) -> bool {
        matches!(self.material, Rheology::RegularisedMuI(_))
    }

    /// Whether eddies add to the viscosity.
    pub fn has_eddies(&self) -> bool {
        self.numerics.smagorinsky_constant > 0.0
    }

    /// Whether density and pressure are coupled by (27).
    pub fn is_coupled(&self) -> bool {
        self.numerics.density_coupling > 0.0
    }

    /// Whether its hourglass coefficient is not the default.
    fn has_other_hourglass(&self) -> bool {
        self.numerics.hourglass != Numerics::default().hourglass
    }

    /// Whether it shows the effect of the hourglass coefficient, as one run of an ensemble.
    pub(crate) fn varies_hourglass(&self) -> bool {
        self.ensemble_member > 0 && self.has_other_hourglass()
    }

    /// Whether it is one of an ensemble that ends while the column still falls, and so is judged by its velocity only.
    pub(crate) fn tells_velocity_alone(&self) -> bool {
        self.ensemble_member > 0 && self.duration < EARLIEST_REST
    }

    /// Whether it is one of an ensemble that is judged by the deposit.
    pub(crate) fn is_of_ensemble(&self) -> bool {
        self.ensemble_member > 0 && !self.varies_hourglass() && !self.tells_velocity_alone()
    }

    /// The same column by return mapping, without eddies and with coupled density and pressure, for one that is not: none of others.
    pub(crate) fn partner<'a>(&self, records: &'a [CollapseRecord<D>]) -> Option<&'a CollapseRecord<D>> {
        let is_plain = |run: &Self| !run.is_regularised() && !run.has_eddies() && run.is_coupled();
        let column = |run: &Self| (run.made_of(), run.aspect_ratio, run.resolution, run.ensemble_member);
        let is_it = |run: &Self| is_plain(run) && column(run) == column(self);
        records.iter().find(|(other, _)| !is_plain(self) && is_it(other))
    }

    /// Whether it is judged by itself, neither as one of an ensemble nor beside its partner.
    pub(crate) fn stands_for_itself(&self, records: &[CollapseRecord<D>]) -> bool {
        self.ensemble_member == 0 && self.partner(records).is_none()
    }

    /// Times `[s]` at which the paper shows pictures of such a column.
    pub(crate) fn shown_times(&self) -> &'static [f64] {
        let is_of_paper = D == 2 && matches!(self.made_of(), Material::SAND | Material::GLASS);
        let shown = SHOWN.iter().find(|(aspect_ratio, _)| is_of_paper && *aspect_ratio == self.aspect_ratio);
        shown.map_or(&[], |(_, times)| times)
    }

    /// Times of all pictures but the deposit's `[s]`.
    fn picture_times(&self) -> Vec<f64> {
        let mut times: Vec<f64> = PICTURES.iter().map(|time| time * self.time_scale()).collect();
        times.extend(self.shown_times());
        times.sort_by(f64::total_cmp);
        times
    }

    fn rows(&self) -> usize {
        (self.aspect_ratio * self.resolution as f64).round().max(1.0) as usize
    }

    /// Initial ratio of elastic and potential energy `[-]`: under hydrostatic pressure p²/(2K) has the mean ρ0 g h_0/(6·50),
    /// the potential energy above the bed ρ0 g h_0/2.
    pub fn elastic_share(&self) -> f64 {
        1.0 / (3.0 * STIFFNESS)
    }

    /// K = 50 ρ0 g h_0 `[Pa]`.
    fn bulk_modulus(&self) -> f64 {
        STIFFNESS * self.density() * self.gravity * self.initial_height() * self.half_width
    }

    /// End of the bed `[m]`: well beyond the longest published run-out, which is that of sand; in space less friction carries grains farther.
    fn bed_end(&self) -> f64 {
        let a = self.aspect_ratio;
        let sand = TABLE_2_SAND.law.static_friction;
        let farther = (sand / self.material.strength_at_rest(1.0).unwrap_or(sand)).clamp(1.0, 4.0);
        // in space the bed costs more than the grains
        let end = if D == 2 {
            2.0 + 1.5 * (2.7 * a).min(3.7 * libm::pow(a, 0.7))
        } else {
            1.5 + 1.3 * farther * (1.35 * a).min(1.6 * a.sqrt())
        };
        self.half_width * end
    }

    /// Surveyor before its first measurement.
    pub(crate) fn surveyor(&self) -> Surveyor {
        Surveyor {
            half_width: self.half_width,
            spacing: self.spacing(),
            gravity: [0.0, -self.gravity],
            bed_end: self.bed_end(),
            collapse: Collapse::default(),
        }
    }

    fn scene<const N: usize>(&self) -> Scene<N> {
        let (spacing, n) = (self.spacing(), self.resolution);
        let site = |cell: usize| {
            // along the first axis, then along the third, then upwards
            let along = |axis: usize| match axis {
                0 => cell % n,
                1 => cell / n.pow(N as u32 - 1),
                _ => cell / n % n,
            };
            Vector::<N>::from_fn(|axis, _| (along(axis) as f64 + 0.5) * spacing)
        };
        let inside = |site: &Vector<N>| {
            N == 2 || site[0] * site[0] + site[N - 1] * site[N - 1] <= self.half_width * self.half_width
        };
        let symmetry = AxisBoundary::Mirror { lower: Some(0.0), upper: None };
        let mut domain = Domain { axes: [symmetry; N] };
        domain.axes[1] = AxisBoundary::Open;
        let Self { gravity, jitter, numerics, .. } = *self;
        let block = GrainBlock {
            spacing,
            height: self.rows() as f64 * spacing,
            gravity: Vector::<N>::from_fn(|axis, _| if axis == 1 { -gravity } else { 0.0 }),
            density: self.density(),
            bulk_modulus: self.bulk_modulus(),
            rheology: self.material,
            jitter,
            seed: self.seed_of_displacements(),
            numerics,
        };
        let sites = (0..self.rows() * n.pow(N as u32 - 1)).map(site).filter(inside);
        let mut scene = block.scene(sites, domain, self.bed_end());
        if D == 3 {
            scene.wall_particles.retain(|particle| radius(&particle.position) < self.bed_end());
        }
        scene
    }

    fn run<const N: usize>(&self, progress: &Progress) -> Result<Recorded<Collapse>, ParameterError>
    where
        Simulation<N>: Compiled<N>,
    {
        let (scale, duration) = (self.time_scale(), self.duration * self.time_scale());
        if self.is_regularised() {
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
            |_| Ok(self.scene::<N>()),
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{RunList, Tier};

    const TIERS: [Tier; 3] = [Tier::Quick, Tier::Paper, Tier::Fine];

    #[test]
    fn columns_are_as_wide_as_the_paper_prints() {
        let mut tall = 0;
        for tier in TIERS {
            let list = RunList::<ColumnFlow<2>>::of_tier(tier);
            let of_the_paper = |run: &&ColumnFlow<2>| [Material::SAND, Material::GLASS].contains(&run.made_of());
            for run in list.flows().iter().filter(of_the_paper) {
                let expected = if run.aspect_ratio > 3.0 { 0.0292 } else { 0.0972 };
                assert_eq!(run.half_width, expected, "{tier}, a = {}", run.aspect_ratio);
                tall += usize::from(run.aspect_ratio > 3.0);
            }
        }
        assert!(tall > 0, "a tier has tall columns");
    }

    fn check_grains<const D: usize>() {
        for run in TIERS.into_iter().flat_map(|tier| RunList::<ColumnFlow<D>>::of_tier(tier).flows().to_vec()) {
            let published = run.grains.as_published();
            assert_eq!(run.bulk.solid_fraction, published.solid_fraction, "{}", run.variant());
            assert!(run.is_regularised() || !run.is_of_own_grains(), "{}: {:?}", run.variant(), run.material);
        }
    }

    #[test]
    fn lists_have_the_numbers_of_the_tables() {
        check_grains::<2>();
        check_grains::<3>();
    }
}
