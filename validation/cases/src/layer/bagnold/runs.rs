//! The simulations that the case asks for.

use super::parameters::{ARREST_DURATION, BagnoldParameters, LayerStart};
use crate::case::{ExternalData, ExternalObservation, ParameterError, Progress, Run};
use crate::input::FieldError;
use crate::layer::{self, Layer, LayerObservation, PeriodicLayer, Preparation, bulk_modulus};
use crate::metric::{Value, Variant};
use crate::observation::Recorded;
use crate::reference::one_dimension::{BagnoldProfile, time_to_steadiness};
use crate::shared::Arrangement;
use bagnold_solver::material::rheology::{MuI, Rheology};
use bagnold_solver::weakly_compressible::numerics::{MomentumOperator, Numerics, ViscousStep};
use serde::Serialize;

/// What a run is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum BagnoldPurpose {
    /// Bagnold's steady profile.
    Steady,
    /// The same with other grains.
    OtherGrains,
    /// The same, one of several resolutions.
    Convergence,
    /// The same from a seed of the displacements, raised again by as much as it sinks.
    ConvergenceSeed,
    /// Slope below the static friction angle.
    Arrest,
    /// A level layer without pressure at first, which its weight compresses.
    Compression,
    /// Slope above the limiting friction angle.
    Runaway,
    /// Bagnold's steady profile with the regularised viscosity (35) and an implicit step.
    Regularised,
    /// The same as the paper steps it: its numerics, (35) explicitly.
    Printed,
}

/// One simulation.
#[derive(Debug, Clone, Serialize)]
pub struct BagnoldRun {
    /// What it is for.
    pub purpose: BagnoldPurpose,
    /// Slope angle `[°]`.
    pub slope_angle: f64,
    /// Start.
    pub start: LayerStart,
    /// Slope angle of the profile it starts with `[°]`.
    pub start_angle: f64,
    /// Arrangement of the particles.
    pub particles: Arrangement,
    /// The layer, with the rows of this run and its displacements.
    pub layer: PeriodicLayer,
    solid_fraction: f64,
    duration: f64,
    averaging_time: f64,
    grains: MuI,
    /// Name of the grains, where they are not the case's own.
    pub material: Option<String>,
    regularisation_rate: f64,
}

/// Share of the steady depth mean that a layer from rest has at the start of its averages, unless the recipe gives it longer.
const STEADY: f64 = 0.999;

fn profile_of(grains: &MuI, layer: &PeriodicLayer, solid_fraction: f64, angle: f64) -> BagnoldProfile {
    BagnoldProfile::of(grains, layer.layer_height, solid_fraction, layer.gravity, angle)
}

/// The paper's operators: (10) with (11), and with (13).
const PRINTED: [MomentumOperator; 2] = [MomentumOperator::Pairwise, MomentumOperator::PairwiseCorrected];

/// All runs in report order.
pub(super) fn all(parameters: &BagnoldParameters) -> Vec<BagnoldRun> {
    let Rheology::MuI(grains) = parameters.material else { return Vec::new() };
    let scale = parameters.duration_scale();
    let (own_rows, own_numerics) = (parameters.layer.resolution, parameters.layer.numerics);
    let new = |purpose, slope_angle: f64, start, particles, resolution, duration: f64| BagnoldRun {
        purpose,
        slope_angle,
        start,
        start_angle: if purpose == BagnoldPurpose::Arrest { parameters.arrest_start_angle } else { slope_angle },
        particles,
        layer: PeriodicLayer {
            resolution,
            jitter: particles.displacement(parameters.layer.jitter),
            ..parameters.layer
        },
        solid_fraction: parameters.solid_fraction,
        duration,
        averaging_time: parameters.averaging_time,
        grains,
        material: None,
        regularisation_rate: 0.0,
    };
    // the recipe's 3.5, 4, 4.5 and 5 s at 22, 23, 24 and 25°, or what the material needs
    let from_rest = |angle: f64| {
        let profile = profile_of(&grains, &parameters.layer, parameters.solid_fraction, angle);
        let steady = time_to_steadiness(&profile, STEADY).map(|time| time + parameters.averaging_time);
        let recipe = (3.5 + 0.5 * (angle - 22.0)).clamp(3.5, 5.0) * scale;
        recipe.max(parameters.duration_factor * steady.unwrap_or(0.0))
    };
    let from_profile = 2.0 * scale;
    let jittered =
        |purpose, angle, start, duration| new(purpose, angle, start, Arrangement::Jittered, own_rows, duration);
    let mut runs: Vec<BagnoldRun> = Vec::new();
    for &start in &parameters.starts {
        let duration = |angle| if start == LayerStart::Rest { from_rest(angle) } else { from_profile };
        let steady = parameters.slope_angles.iter();
        runs.extend(steady.map(|&angle| jittered(BagnoldPurpose::Steady, angle, start, duration(angle))));
    }
    runs.extend(parameters.other_grains.iter().map(|other| {
        let run = new(
            BagnoldPurpose::OtherGrains,
            other.slope_angle,
            LayerStart::Profile,
            Arrangement::Jittered,
            other.resolution,
            from_profile,
        );
        BagnoldRun { grains: other.grains, material: Some(other.name.clone()), ..run }
    }));
    let numerics = Numerics { viscous_step: ViscousStep::Implicit, ..own_numerics };
    runs.extend(parameters.regularised_slope_angles.iter().map(|&angle| {
        let run = jittered(BagnoldPurpose::Regularised, angle, LayerStart::Profile, from_profile);
        let layer = PeriodicLayer { numerics, ..run.layer };
        BagnoldRun { regularisation_rate: parameters.regularised_rate, layer, ..run }
    }));
    runs.extend(parameters.printed_rates.iter().flat_map(|&rate| {
        PRINTED.map(|momentum_operator| {
            let slope = parameters.convergence_slope_angle;
            let rows = parameters.printed_resolution;
            let run =
                new(BagnoldPurpose::Printed, slope, LayerStart::Profile, Arrangement::Jittered, rows, from_profile);
            let layer = PeriodicLayer { numerics: Numerics { momentum_operator, ..Numerics::paper() }, ..run.layer };
            BagnoldRun { regularisation_rate: rate, layer, ..run }
        })
    }));
    let (angle, study) = (parameters.convergence_slope_angle, &parameters.convergence_resolutions);
    let convergence = |start, particles, rows: usize, duration| {
        new(BagnoldPurpose::Convergence, angle, start, particles, rows, duration)
    };
    runs.extend(study.iter().map(|&rows| convergence(LayerStart::Profile, Arrangement::Lattice, rows, from_profile)));
    for &rows in study {
        let run = convergence(LayerStart::Rest, Arrangement::Jittered, rows, from_rest(angle));
        if !runs.iter().any(|other| other.variant() == run.variant()) {
            runs.push(run);
        }
    }
    for (&rows, &seed) in
        study.iter().flat_map(|rows| parameters.convergence_seeds.iter().map(move |seed| (rows, seed)))
    {
        let run = convergence(LayerStart::Rest, Arrangement::Jittered, rows, from_rest(angle));
        let layer = PeriodicLayer { seed, preparation: Preparation::Raised, ..run.layer };
        runs.push(BagnoldRun { purpose: BagnoldPurpose::ConvergenceSeed, layer, ..run });
    }
    let arrest = |&angle: &f64| jittered(BagnoldPurpose::Arrest, angle, LayerStart::Profile, ARREST_DURATION * scale);
    runs.extend(parameters.arrest_slope_angles.iter().map(arrest));
    // beside the layers that arrest, of which none needs a steady flow; displaced particles come closer as they order themselves, too
    if !parameters.arrest_slope_angles.is_empty() {
        let level = new(BagnoldPurpose::Compression, 0.0, LayerStart::Rest, Arrangement::Lattice, own_rows, 0.0);
        // a load that comes at once: half of the step, or its first steps cost the balance of energy more than its limit
        let numerics = Numerics { acoustic_courant: 0.5 * own_numerics.acoustic_courant, ..own_numerics };
        let layer = PeriodicLayer { preparation: Preparation::None, numerics, ..level.layer };
        runs.push(BagnoldRun { duration: level.sinking_time(), layer, ..level });
    }
    let runaway = |&angle: &f64| jittered(BagnoldPurpose::Runaway, angle, LayerStart::Rest, 20.0 * scale);
    runs.extend(parameters.runaway_slope_angles.iter().map(runaway));
    runs
}

impl Run for BagnoldRun {
    type Observation = LayerObservation;

    fn laws(&self) -> Vec<Rheology> {
        vec![self.law()]
    }

    fn variant(&self) -> Variant {
        let start = match self.start {
            LayerStart::Rest if self.purpose == BagnoldPurpose::Compression => Value::from("uncompressed"),
            LayerStart::Rest => Value::from("rest"),
            LayerStart::Profile if self.start_angle != self.slope_angle => {
                Value::from(format!("profile_{}", self.start_angle))
            }
            LayerStart::Profile => Value::from("profile"),
        };
        let run = Variant::of("slope_angle", self.slope_angle)
            .and("start", start)
            .and("particles", self.particles.name())
            .and("resolution", self.layer.resolution);
        match (&self.purpose, &self.material) {
            (BagnoldPurpose::Regularised, _) => run.and("regularisation_rate", self.regularisation_rate),
            (BagnoldPurpose::Printed, _) => run
                .and("numerics", self.layer.numerics.pairwise_operator().unwrap_or("default").replace('-', "_"))
                .and("regularisation_rate", self.regularisation_rate),
            (BagnoldPurpose::ConvergenceSeed, _) => run.and("preparation", "raised").and("seed", self.layer.seed),
            (_, Some(material)) => run.and("material", material.clone()),
            _ => run,
        }
    }

    fn particles(&self) -> f64 {
        self.layer.particles()
    }

    fn particle_steps(&self) -> f64 {
        let still = |_: f64| 0.0;
        let layer = self.layer(&still, &still);
        // a runaway layer stops long before its time is up
        let share = if self.purpose == BagnoldPurpose::Runaway { 0.4 } else { 1.0 };
        share * layer.expected_steps() * self.layer.particles()
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<LayerObservation>, ParameterError> {
        if let Some(reason) = self.beyond_limits() {
            tracing::warn!("{}: {reason}", self.variant());
        }
        let start = self.start_profile();
        let moving = self.start == LayerStart::Profile;
        let velocity = |y: f64| if moving { start.velocity(y).unwrap_or(0.0) } else { 0.0 };
        // A layer tilted until it fails carries the static friction when it starts. From no stress at all it would
        // first fall freely until the elastic shear is wound up, which at 22° is a sixth of its steady velocity.
        let friction = self.grains.static_friction.min(libm::tan(self.slope_angle.to_radians()));
        let shear_stress = |y: f64| if moving { start.shear_stress(y) } else { friction * start.pressure(y) };
        self.layer(&velocity, &shear_stress).run(progress)
    }
}

impl BagnoldRun {
    /// The exact steady profile at the run's slope angle.
    #[must_use]
    pub fn profile(&self) -> BagnoldProfile {
        self.profile_at(self.slope_angle)
    }

    /// The exact steady profile that the run started with.
    #[must_use]
    pub fn start_profile(&self) -> BagnoldProfile {
        self.profile_at(self.start_angle)
    }

    /// Its observation as another code gives it.
    pub(super) fn observe_external(
        &self,
        given: &ExternalData,
    ) -> Result<ExternalObservation<LayerObservation>, FieldError> {
        let nothing = |_: f64| 0.0;
        layer::foreign::observe(&self.layer(&nothing, &nothing), given)
    }

    /// Why what it leaves behind is not of a steady flow; none where it is.
    pub(super) fn unsteadiness(&self, data: &LayerObservation) -> Option<String> {
        let reason = data.unsteadiness(self.averaging_time)?;
        Some(self.beyond_limits().map_or(reason.clone(), |cause| format!("{reason}; {cause}")))
    }

    fn profile_at(&self, angle: f64) -> BagnoldProfile {
        profile_of(&self.grains, &self.layer, self.solid_fraction, angle)
    }

    /// 2ȳ/h `[-]` of the layer with ρ = ρ0 exp(x (1 − y/h)), x = ρ0 g h cosθ/K: a little below 1.
    #[must_use]
    pub fn exact_relative_height(&self) -> f64 {
        let density = self.density();
        let weight = density * self.layer.gravity * self.layer.layer_height * libm::cos(self.slope_angle.to_radians());
        let x = weight / self.bulk_modulus();
        2.0 * (libm::expm1(x) - x) / (x * libm::expm1(x))
    }

    /// The grains' law: regularised with the rate, or by return mapping where that is 0.
    fn law(&self) -> Rheology {
        if self.regularisation_rate > 0.0 {
            Rheology::RegularisedMuI(self.grains.regularised(self.regularisation_rate))
        } else {
            Rheology::MuI(self.grains)
        }
    }

    fn density(&self) -> f64 {
        self.solid_fraction * self.grains.grain_density
    }

    /// Sound speed `[m/s]`.
    #[must_use]
    pub fn sound_speed(&self) -> f64 {
        (self.bulk_modulus() / self.density()).sqrt()
    }

    /// Time 2 h/c `[s]` in which a liquid layer without pressure would sink as far as it does; grains are a little faster.
    fn sinking_time(&self) -> f64 {
        2.0 * self.layer.layer_height / self.sound_speed()
    }

    fn bulk_modulus(&self) -> f64 {
        let density = self.density();
        match self.purpose {
            // at 50 ρ0 g H particles leak once the mean passes half the sound speed
            BagnoldPurpose::Runaway => 200.0 * density * self.layer.gravity * self.layer.layer_height,
            _ => {
                let mean = |angle: f64| self.profile_at(angle).depth_mean().unwrap_or(0.0);
                let expected = mean(self.slope_angle).max(mean(self.start_angle));
                bulk_modulus(density, self.layer.gravity, self.layer.layer_height, expected)
            }
        }
    }

    fn layer<'a>(
        &self,
        velocity: &'a (dyn Fn(f64) -> f64 + Sync),
        shear_stress: &'a (dyn Fn(f64) -> f64 + Sync),
    ) -> Layer<'a> {
        Layer {
            bulk_modulus: self.bulk_modulus(),
            velocity,
            shear_stress,
            duration: self.duration,
            window: self.averaging_time.min(self.duration),
            interval: 2e-3,
            compressed: self.purpose != BagnoldPurpose::Compression,
            may_diverge: self.purpose == BagnoldPurpose::Printed,
            stop_above: if self.purpose == BagnoldPurpose::Runaway { 0.5 * self.sound_speed() } else { f64::INFINITY },
            ..self.layer.of(self.law(), self.density(), self.slope_angle)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Parameters, Tier};

    #[test]
    fn runs_from_rest_last_as_the_recipe_or_as_long_as_the_material_needs() {
        let quick = BagnoldParameters::of_tier(Tier::Quick);
        let durations = |parameters: &BagnoldParameters| {
            let runs = parameters.runs().into_iter().filter(|run| run.purpose == BagnoldPurpose::Steady);
            runs.map(|run| run.duration).collect::<Vec<_>>()
        };
        assert_eq!(durations(&quick), [3.5, 4.0, 4.5, 5.0], "glass beads");
        let Rheology::MuI(glass) = quick.material else { unreachable!("glass beads are of μ(I)") };
        let fine = MuI {
            static_friction: 0.359,
            limiting_friction: 0.547,
            reference_inertia: 0.637,
            grain_diameter: 0.296e-3,
            ..glass
        };
        let layer = PeriodicLayer { layer_height: 0.0123, ..quick.layer };
        let fine = BagnoldParameters {
            material: Rheology::MuI(fine),
            layer,
            slope_angles: vec![21.731],
            solid_fraction: 0.587,
            ..quick
        };
        // 99.9 % after 21.2 s by the resolved transient, and the window
        assert!(durations(&fine).iter().all(|duration| (21.0..22.5).contains(duration)), "{:?}", durations(&fine));
    }
}
