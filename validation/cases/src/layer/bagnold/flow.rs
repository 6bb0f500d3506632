//! The flow: a layer of dry grains on an incline.

use crate::case::{Flow, ParameterError, Progress, RunCost};
use crate::input::check_name;
use crate::layer::{Layer, LayerObservation, PeriodicLayer, Preparation, bulk_modulus};
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::reference::grains::GLASS_BEADS;
use crate::reference::one_dimension::{BagnoldProfile, time_to_steadiness};
use crate::setup::rules;
use crate::shared::{Arrangement, OverHeight};
use bagnold_solver::material::rheology::{MuI, RegularisedMuI, Rheology};
use bagnold_solver::parameter::{between, not_negative, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Initial state of a layer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum LayerStart {
    /// At rest, with the shear stress at its static limit.
    Rest,
    /// With the steady velocity and shear stress of the slope angle, or of `start_angle` on a slope without steady flow.
    Profile,
    /// At rest and without pressure: its weight compresses it.
    Uncompressed,
}

impl LayerStart {
    /// Name in variants.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Rest => "rest",
            Self::Profile => "profile",
            Self::Uncompressed => "uncompressed",
        }
    }
}

/// Outcome of a layer on its slope.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fate {
    /// It comes to rest: the slope is not above the static friction angle.
    Arrest,
    /// It flows steadily.
    Steady,
    /// It accelerates without end: the slope is above the limiting friction angle.
    Runaway,
}

/// A layer of grains on an incline.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BagnoldFlow {
    /// Geometry, resolution and numerics of the layer.
    #[serde(flatten)]
    pub layer: PeriodicLayer,
    /// Slope angle `[°]`. Layers flow steadily between the friction angles of the material.
    #[schemars(transform = rules::slope_angle())]
    #[schemars(transform = not_negative("give the angle in degrees of a slope that the layer flows down"))]
    pub slope_angle: f64,
    /// Initial velocity and density of the layer.
    pub start: LayerStart,
    /// Slope angle of the profile that a layer starts with on a slope without steady flow `[°]`.
    #[schemars(transform = rules::slope_angle())]
    pub start_angle: f64,
    /// Arrangement of the particles.
    pub arrangement: Arrangement,
    /// Solid fraction φ `[-]`: the bulk density is φ times the grain density.
    #[schemars(transform = between(0.0, 1.0, "give 0.5 to 0.64 for grains, or 1 for a law with a bulk density"))]
    pub solid_fraction: f64,
    /// Simulated time over the recipe's, 3.5 … 5 s at 22 … 25° from rest for 10 mm `[-]`.
    #[schemars(transform = positive("give 1 for the duration of the reference figures"))]
    pub duration_factor: f64,
    /// Averaging window before the end `[s]`.
    #[schemars(transform = positive("give it in seconds, such as 0.5"))]
    pub averaging_time: f64,
    /// Material, which must be of μ(I), perhaps regularised. The particles' own Reynolds number γ̇ Δ² ρ/η = (I Δ/D)²/(μ φ) is to
    /// stay below 0.1: above it the unevenness of the flow between particles is not damped within a strain, and the layer sinks.
    pub material: Rheology,
    /// Name of other grains than the case's own, with which what holds for one material is shown to hold for all; "" for none.
    pub material_name: String,
}

impl Default for BagnoldFlow {
    fn default() -> Self {
        Self {
            layer: PeriodicLayer::settled(0.01, 20, 12),
            slope_angle: 24.0,
            start: LayerStart::Rest,
            start_angle: 24.0,
            arrangement: Arrangement::Jittered,
            solid_fraction: GLASS_BEADS.solid_fraction,
            duration_factor: 1.0,
            averaging_time: 0.5,
            // glass beads of Table 1 (Forterre & Pouliquen 2003); I_0 from (41) at 25°, kept at every angle
            material: Rheology::MuI(GLASS_BEADS.law),
            material_name: String::new(),
        }
    }
}

/// Share of the steady depth mean that a layer from rest has at the start of its averages, unless the recipe gives it longer.
const STEADY: f64 = 0.999;

impl Flow for BagnoldFlow {
    const RUNS: &'static str = include_str!("../../../runs/bagnold.toml");
    type Observation = LayerObservation;

    fn check(&self) -> Result<(), ParameterError> {
        self.layer.check()?;
        if !self.is_regularised() {
            let remedy = "choose it: the case's reference, Bagnold's profile, is exact for this law only";
            rules::only_mu_i("material", &self.material, remedy)?;
        }
        rules::material("material", &self.material)?;
        rules::viscous_step("numerics", &self.layer.numerics, &self.material)?;
        if !self.material_name.is_empty() {
            check_name("material_name", &self.material_name)?;
        }
        if self.start == LayerStart::Profile && self.start_profile().inertial_number().is_none() {
            let grains = self.grains();
            let band = [grains.static_friction, grains.limiting_friction].map(|mu| libm::atan(mu).to_degrees());
            let rule = format!("between {:.2}° and {:.2}°, the friction angles of the material", band[0], band[1]);
            let remedy = "choose an angle with a steady flow, whose profile is the start";
            return Err(ParameterError::field("start_angle", self.start_angle, &rule, remedy));
        }
        if self.start == LayerStart::Uncompressed {
            return Ok(());
        }
        let remedy = "shorten the averaging window, or raise `duration_factor`";
        rules::between("averaging_time", self.averaging_time, 0.0, self.recipe(), remedy)
    }

    fn variant(&self) -> Variant {
        let start = match self.start {
            LayerStart::Profile if self.fate() != Fate::Steady => format!("profile_{}", self.start_angle),
            start => start.name().to_owned(),
        };
        let run = Variant::of("slope_angle", self.slope_angle)
            .and("start", start)
            .and("particles", self.arrangement.name())
            .and("resolution", self.layer.resolution);
        let operator = self.layer.numerics.pairwise_operator().map(|name| name.replace('-', "_"));
        let run = operator.into_iter().fold(run, |run, operator| run.and("numerics", operator));
        let run = match self.material {
            Rheology::RegularisedMuI(law) => run.and("regularisation_rate", law.regularisation_rate),
            _ if self.material_name.is_empty() => run,
            _ => run.and("material", self.material_name.clone()),
        };
        match self.layer.preparation {
            Preparation::Raised => run.and("preparation", "raised").and("seed", self.layer.seed),
            _ => run,
        }
    }

    fn cost(&self) -> RunCost {
        let still = |_: f64| 0.0;
        // a runaway layer stops long before its time is up
        let share = if self.fate() == Fate::Runaway { 0.4 } else { 1.0 };
        RunCost::weakly_compressible(self.layer.particles(), share * self.layer(&still, &still).expected_steps())
    }

    fn simulate(&self, progress: &Progress) -> Result<Recorded<LayerObservation>, ParameterError> {
        if let Some(reason) = self.beyond_limits() {
            tracing::warn!("{}: {reason}", self.variant());
        }
        let start = self.start_profile();
        let velocity = |y: f64| match self.start {
            LayerStart::Profile => start.velocity(y).unwrap_or(0.0),
            LayerStart::Rest | LayerStart::Uncompressed => 0.0,
        };
        // A layer tilted until it fails carries the static friction when it starts. From no stress at all it would
        // first fall freely until the elastic shear is wound up, which at 22° is a sixth of its steady velocity.
        let friction = start.grains.static_friction.min(libm::tan(start.inclination));
        let shear_stress = |y: f64| match self.start {
            LayerStart::Profile => start.shear_stress(y),
            LayerStart::Rest => friction * start.pressure(y),
            LayerStart::Uncompressed => 0.0,
        };
        self.layer(&velocity, &shear_stress).run(progress)
    }
}

impl BagnoldFlow {
    /// Outcome of the layer.
    pub fn fate(&self) -> Fate {
        let profile = self.profile();
        match profile.inertial_number() {
            Some(_) => Fate::Steady,
            None if libm::tan(profile.inclination) <= profile.grains.static_friction => Fate::Arrest,
            None => Fate::Runaway,
        }
    }

    /// Whether its law is (35), which is not the exact one.
    pub fn is_regularised(&self) -> bool {
        matches!(self.material, Rheology::RegularisedMuI(_))
    }

    /// Whether it has the operators of the paper, whose result is what they do.
    pub fn is_compared(&self) -> bool {
        self.layer.numerics.pairwise_operator().is_some()
    }

    /// Whether it is judged by Bagnold's profile with the case's own grains.
    pub(super) fn is_steady(&self) -> bool {
        let is_exact = !self.is_regularised() && !self.is_compared() && self.material_name.is_empty();
        is_exact && self.start != LayerStart::Uncompressed && self.fate() == Fate::Steady
    }

    /// The exact steady profile at the run's slope angle.
    pub fn profile(&self) -> BagnoldProfile {
        self.profile_at(self.slope_angle)
    }

    /// The exact steady profile that the run started with.
    pub fn start_profile(&self) -> BagnoldProfile {
        let is_elsewhere = self.start == LayerStart::Profile && self.fate() != Fate::Steady;
        self.profile_at(if is_elsewhere { self.start_angle } else { self.slope_angle })
    }

    fn profile_at(&self, angle: f64) -> BagnoldProfile {
        let PeriodicLayer { layer_height, gravity, .. } = self.layer;
        BagnoldProfile::of(&self.grains(), layer_height, self.solid_fraction, gravity, angle)
    }

    /// The grains; without a friction for a law that is refused.
    fn grains(&self) -> MuI {
        match self.material {
            Rheology::MuI(grains) => grains,
            Rheology::RegularisedMuI(law) => {
                let RegularisedMuI { static_friction, limiting_friction, reference_inertia, .. } = law;
                let RegularisedMuI { grain_diameter, grain_density, .. } = law;
                MuI { static_friction, limiting_friction, reference_inertia, grain_diameter, grain_density }
            }
            _ => MuI { static_friction: f64::NAN, ..GLASS_BEADS.law },
        }
    }

    /// Why what it leaves behind is not of a steady flow; none where it is.
    pub(super) fn unsteadiness(&self, data: &LayerObservation) -> Option<String> {
        let reason = data.unsteadiness(self.averaging_time)?;
        Some(self.beyond_limits().map_or(reason.clone(), |cause| format!("{reason}; {cause}")))
    }

    /// 2ȳ/h `[-]` of the layer with ρ = ρ0 exp(x (1 − y/h)), x = ρ0 g h cosθ/K: a little below 1.
    pub fn exact_relative_height(&self) -> f64 {
        let density = self.density();
        let weight = density * self.layer.gravity * self.layer.layer_height * libm::cos(self.slope_angle.to_radians());
        let x = weight / self.bulk_modulus();
        2.0 * (libm::expm1(x) - x) / (x * libm::expm1(x))
    }

    fn density(&self) -> f64 {
        self.solid_fraction * self.grains().grain_density
    }

    /// Sound speed `[m/s]`.
    pub fn sound_speed(&self) -> f64 {
        (self.bulk_modulus() / self.density()).sqrt()
    }

    fn bulk_modulus(&self) -> f64 {
        let (density, PeriodicLayer { layer_height, gravity, .. }) = (self.density(), self.layer);
        // at 50 ρ0 g H particles leak once the mean passes half the sound speed
        if self.fate() == Fate::Runaway {
            return 200.0 * density * gravity * layer_height;
        }
        let mean = |profile: BagnoldProfile| profile.depth_mean().unwrap_or(0.0);
        bulk_modulus(density, gravity, layer_height, mean(self.profile()).max(mean(self.start_profile())))
    }

    /// Time that the reference figures need `[s]`: (h/10 mm)^1.5 is how the time to the steady state grows.
    fn recipe(&self) -> f64 {
        let scale = self.duration_factor * libm::pow(self.layer.layer_height / 0.01, 1.5);
        match (self.start, self.fate()) {
            // 2 h/c, in which a liquid layer without pressure would sink as far as it does; grains are a little faster
            (LayerStart::Uncompressed, _) => 2.0 * self.layer.layer_height / self.sound_speed(),
            (_, Fate::Arrest) => 1.5 * scale,
            (_, Fate::Runaway) => 20.0 * scale,
            (LayerStart::Profile, Fate::Steady) => 2.0 * scale,
            (LayerStart::Rest, Fate::Steady) => (3.5 + 0.5 * (self.slope_angle - 22.0)).clamp(3.5, 5.0) * scale,
        }
    }

    /// Simulated time `[s]`: that of the recipe, or from rest what the material needs.
    fn duration(&self) -> f64 {
        if self.start != LayerStart::Rest {
            return self.recipe();
        }
        let steady = time_to_steadiness(&self.profile(), STEADY).map(|time| time + self.averaging_time);
        self.recipe().max(self.duration_factor * steady.unwrap_or(0.0))
    }

    pub(super) fn layer<'a>(&self, velocity: OverHeight<'a>, shear_stress: OverHeight<'a>) -> Layer<'a> {
        let duration = self.duration();
        let is_runaway = self.fate() == Fate::Runaway;
        let particles = PeriodicLayer { jitter: self.arrangement.displacement(self.layer.jitter), ..self.layer };
        Layer {
            bulk_modulus: self.bulk_modulus(),
            velocity,
            shear_stress,
            duration,
            window: self.averaging_time.min(duration),
            interval: 2e-3,
            compressed: self.start != LayerStart::Uncompressed,
            may_diverge: self.is_compared(),
            stop_above: if is_runaway { 0.5 * self.sound_speed() } else { f64::INFINITY },
            ..particles.of(self.material, self.density(), self.slope_angle)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_from_rest_last_as_the_recipe_or_as_long_as_the_material_needs() {
        let glass = |slope_angle| BagnoldFlow { slope_angle, ..BagnoldFlow::default() };
        assert_eq!([22.0, 23.0, 24.0, 25.0].map(|angle| glass(angle).duration()), [3.5, 4.0, 4.5, 5.0]);
        let fine = MuI {
            static_friction: 0.359,
            limiting_friction: 0.547,
            reference_inertia: 0.637,
            grain_diameter: 0.296e-3,
            ..GLASS_BEADS.law
        };
        let fine = BagnoldFlow {
            material: Rheology::MuI(fine),
            layer: PeriodicLayer { layer_height: 0.0123, ..glass(24.0).layer },
            solid_fraction: 0.587,
            ..glass(21.731)
        };
        // 99.9 % after 21.2 s by the resolved transient, and the window
        assert!((21.0..22.5).contains(&fine.duration()), "{}", fine.duration());
    }

    #[test]
    fn the_slope_decides_what_becomes_of_a_layer() {
        let fate = |slope_angle| BagnoldFlow { slope_angle, ..BagnoldFlow::default() }.fate();
        assert_eq!([0.0, 20.0, 24.0, 34.0].map(fate), [Fate::Arrest, Fate::Arrest, Fate::Steady, Fate::Runaway]);
        let start_angle = 20.0;
        let flow = BagnoldFlow { slope_angle: 20.0, start: LayerStart::Profile, start_angle, ..BagnoldFlow::default() };
        let message = flow.check().expect_err("no profile to start with").to_string();
        assert!(message.starts_with("`start_angle` is 20, but must be between 20.91° and 32.74°"), "{message}");
    }
}
