//! The flow: a layer of dry grains that flows steadily on a slope, or whose slope of arrest is sought.

use super::start_stop::{SlopeSearch, StartStop};
use crate::case::{Flow, ParameterError, Progress, RunCost};
use crate::layer::{Layer, LayerObservation, PeriodicLayer, bulk_modulus};
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::reference::collapse::RoughIncline;
use crate::reference::grains::{GLASS_BEADS, GLASS_BEADS_FLOW_RULE};
use crate::reference::one_dimension::{BagnoldProfile, NonlocalLayer, NonlocalProfile};
use crate::setup::rules;
use crate::shared::{Arrangement, OverHeight};
use bagnold_solver::material::rheology::field::FieldBoundary;
use bagnold_solver::material::rheology::{MuI, NonlocalMuI, Rheology};
use bagnold_solver::parameter::{between, positive};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Interval of the observations `[s]`.
const INTERVAL: f64 = 0.02;
/// Cells of a steady profile of the nonlocal law: its discretisation is then below what particles do.
const REFERENCE_CELLS: usize = 4000;
/// Averaging window at the end of a steady flow, of its duration `[-]`.
const WINDOW: f64 = 0.3;

/// A layer of grains on a slope.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FlowThicknessFlow {
    /// Geometry, resolution and numerics of the layer.
    #[serde(flatten)]
    pub layer: PeriodicLayer,
    /// Slope angle `[°]` of a steady flow, or at which a layer stops whose slope of arrest is sought.
    #[schemars(transform = rules::slope_angle())]
    pub slope_angle: f64,
    /// Slope angle `[°]` at which a layer flows whose slope of arrest is sought from `slope_angle` on; 0 for a steady flow.
    #[schemars(transform = between(0.0, 89.0, "give a steeper one than `slope_angle`, or 0 for a steady flow"))]
    pub flowing_angle: f64,
    /// Width of the bracket of slopes that ends a search `[°]`.
    #[schemars(transform = between(1e-3, 90.0, "give 0.25°, which takes about six trials"))]
    pub stopping_tolerance: f64,
    /// Slope angle `[°]` whose steady profile under the local law each trial of a search starts with.
    #[schemars(transform = rules::slope_angle())]
    pub start_angle: f64,
    /// Arrangement of the particles.
    pub arrangement: Arrangement,
    /// Solid fraction φ `[-]`: the bulk density is φ times the grain density.
    #[schemars(transform = between(0.01, 1.0, "give 0.5 to 0.64, the share of the space that grains fill"))]
    pub solid_fraction: f64,
    /// Simulated time of a steady flow, longest one of a trial `[s]`.
    #[schemars(transform = between(0.01, 1000.0, "give 1 s for a steady flow, 10 s for thin layers that stop"))]
    pub duration: f64,
    /// The grains, under the local or the nonlocal μ(I) law.
    pub material: Rheology,
    /// Length scale L of the measured h_stop(θ) over the grain diameter `[-]`.
    #[schemars(transform = positive("give 1.65 for glass beads, 2.03 for sand"))]
    pub deposit_length: f64,
    /// Flow coefficient β of (42) `[-]`.
    #[schemars(transform = positive("give 0.136 for glass beads, 0.65 for sand"))]
    pub flow_coefficient: f64,
}

/// Results of a flow.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FlowThicknessObservation {
    /// The trials of a search.
    StartStop(StartStop),
    /// Profile and time series of a steady flow.
    Steady(Box<LayerObservation>),
}

impl Default for FlowThicknessFlow {
    fn default() -> Self {
        Self {
            layer: PeriodicLayer { jitter: 0.05, ..PeriodicLayer::settled(0.01, 12, 10) },
            slope_angle: 24.0,
            flowing_angle: 0.0,
            stopping_tolerance: 0.3,
            start_angle: 22.5,
            arrangement: Arrangement::Jittered,
            solid_fraction: GLASS_BEADS.solid_fraction,
            duration: 10.0,
            material: Rheology::NonlocalMuI(NonlocalMuI::of(GLASS_BEADS.law)),
            deposit_length: GLASS_BEADS_FLOW_RULE.deposit_length,
            flow_coefficient: GLASS_BEADS_FLOW_RULE.flow_coefficient,
        }
    }
}

impl Flow for FlowThicknessFlow {
    const RUNS: &'static str = include_str!("../../../runs/flow-thickness.toml");
    type Observation = FlowThicknessObservation;

    fn check(&self) -> Result<(), ParameterError> {
        self.layer.check()?;
        if !matches!(self.material, Rheology::MuI(_) | Rheology::NonlocalMuI(_)) {
            let remedy = "choose one of these: the layers start with steady profiles of μ(I)";
            let name = format!("\"{}\"", self.material.name());
            return Err(ParameterError::field("material.law", name, "\"mu-i\" or \"nonlocal-mu-i\"", remedy));
        }
        rules::material("material", &self.material)?;
        rules::viscous_step("numerics", &self.layer.numerics, &self.material)?;
        let MuI { static_friction, limiting_friction, .. } = self.grains();
        let [gentlest, steepest] = [static_friction, limiting_friction].map(|mu| libm::atan(mu).to_degrees());
        if self.is_sought() {
            let remedy = "give a steeper angle than `slope_angle`, at which the layer stops";
            rules::between("flowing_angle", self.flowing_angle, self.slope_angle, 89.0, remedy)?;
            let remedy = "give an angle of steady flow, between arctan μ_s and arctan μ_2";
            return rules::between("start_angle", self.start_angle, gentlest, steepest, remedy);
        }
        let remedy = "give an angle of steady flow, between arctan μ_s and arctan μ_2";
        rules::between("slope_angle", self.slope_angle, gentlest, steepest, remedy)?;
        match self.exact(self.slope_angle).and_then(|layer| layer.stopping_thickness()) {
            Some(thinnest) if self.layer.layer_height < thinnest => {
                let rule =
                    format!("at least {thinnest:.5} m, below which the nonlocal law does not flow at this slope");
                let remedy = "raise it, or raise `slope_angle`";
                Err(ParameterError::field("layer_height", format!("{} m", self.layer.layer_height), &rule, remedy))
            }
            _ => Ok(()),
        }
    }

    fn variant(&self) -> Variant {
        let variant = Variant::of("thickness", self.layer.layer_height);
        let variant = if self.is_sought() { variant } else { variant.and("slope_angle", self.slope_angle) };
        let variant = variant.and("rows", self.layer.resolution);
        let variant = self.surface_name().into_iter().fold(variant, |variant, name| variant.and("surface", name));
        match self.arrangement {
            Arrangement::Lattice => variant.and("particles", self.arrangement.name()),
            Arrangement::Jittered => variant,
        }
    }

    fn cost(&self) -> RunCost {
        let still = |_: f64| 0.0;
        let start = self.profile(if self.is_sought() { self.start_angle } else { self.slope_angle });
        // grains far finer than the layer flow so fast that sound must be faster still
        let layer = self.layer(start.depth_mean().unwrap_or(0.0), &still, &still);
        let steps = layer.expected_steps();
        // most trials end early
        let rounds = if self.is_sought() { self.search(layer).rounds() / 3.0 } else { 1.0 };
        RunCost::weakly_compressible(self.layer.particles(), rounds * steps)
    }

    fn simulate(&self, progress: &Progress) -> Result<Recorded<FlowThicknessObservation>, ParameterError> {
        if self.is_sought() {
            let start = self.profile(self.start_angle);
            let (velocity, shear_stress) = (|y| start.velocity(y).unwrap_or(0.0), |y| start.shear_stress(y));
            let layer = self.layer(start.depth_mean().unwrap_or(0.0), &velocity, &shear_stress);
            return Ok(self.search(layer).run(progress)?.map(FlowThicknessObservation::StartStop));
        }
        let (local, nonlocal) = (self.profile(self.slope_angle), self.steady());
        let velocity = |y| match &nonlocal {
            Some(profile) => profile.velocity(y),
            None => local.velocity(y).unwrap_or(0.0),
        };
        let mean = nonlocal.as_ref().map(NonlocalProfile::depth_mean).or(local.depth_mean());
        let shear_stress = |y| local.shear_stress(y);
        let layer = self.layer(mean.unwrap_or(0.0), &velocity, &shear_stress);
        Ok(layer.run(progress)?.map(|seen| FlowThicknessObservation::Steady(Box::new(seen))))
    }
}

impl FlowThicknessFlow {
    /// Whether the slope is sought at which the layer stops.
    pub fn is_sought(&self) -> bool {
        self.flowing_angle > 0.0
    }

    /// Condition on the fluidity at the surface, as a variant has it; none for the local law.
    pub(super) fn surface_name(&self) -> Option<&'static str> {
        let Rheology::NonlocalMuI(law) = self.material else { return None };
        Some(match law.surface {
            FieldBoundary::Vanishing => "vanishing",
            FieldBoundary::NoFlux => "no-flux",
        })
    }

    /// The grains; without a friction for a law that is refused.
    pub(super) fn grains(&self) -> MuI {
        match self.material {
            Rheology::MuI(grains) => grains,
            Rheology::NonlocalMuI(law) => law.local(),
            _ => MuI { static_friction: f64::NAN, ..GLASS_BEADS.law },
        }
    }

    /// The incline that the grains make rough.
    pub(super) fn incline(&self) -> RoughIncline {
        let MuI { static_friction, limiting_friction, grain_diameter, .. } = self.grains();
        RoughIncline { length_scale: self.deposit_length * grain_diameter, static_friction, limiting_friction }
    }

    /// Steady profile under the local law at a slope `[°]`.
    fn profile(&self, angle: f64) -> BagnoldProfile {
        let PeriodicLayer { layer_height, gravity, .. } = self.layer;
        BagnoldProfile::of(&self.grains(), layer_height, self.solid_fraction, gravity, angle)
    }

    /// The nonlocal law's own layer on a slope `[°]`, without particles; none for the local law.
    pub(super) fn exact(&self, angle: f64) -> Option<NonlocalLayer> {
        let Rheology::NonlocalMuI(NonlocalMuI { cooperativity, surface, .. }) = self.material else { return None };
        Some(NonlocalLayer { layer: self.profile(angle), cooperativity, surface })
    }

    /// Steady flow; none for the local law.
    pub(super) fn steady(&self) -> Option<NonlocalProfile> {
        self.exact(self.slope_angle)?.steady(REFERENCE_CELLS).ok()
    }

    /// Speed √(g h) `[m/s]`.
    pub(super) fn speed(&self) -> f64 {
        (self.layer.gravity * self.layer.layer_height).sqrt()
    }

    /// The layer, with a depth mean of its velocity at the start `[m/s]`.
    fn layer<'a>(&self, depth_mean: f64, velocity: OverHeight<'a>, shear_stress: OverHeight<'a>) -> Layer<'a> {
        let density = self.solid_fraction * self.grains().grain_density;
        let particles = PeriodicLayer { jitter: self.arrangement.displacement(self.layer.jitter), ..self.layer };
        Layer {
            bulk_modulus: bulk_modulus(density, self.layer.gravity, self.layer.layer_height, depth_mean),
            velocity,
            shear_stress,
            duration: self.duration,
            window: WINDOW * self.duration,
            interval: INTERVAL,
            ..particles.of(self.material, density, self.slope_angle)
        }
    }

    fn search<'a>(&self, layer: Layer<'a>) -> SlopeSearch<'a> {
        SlopeSearch { layer, bracket: (self.slope_angle, self.flowing_angle), tolerance: self.stopping_tolerance }
    }
}
