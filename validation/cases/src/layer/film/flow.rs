//! The flow: a viscous film on an incline.

use crate::case::{Flow, ParameterError, Progress, RunCost};
use crate::layer::{Layer, LayerObservation, PeriodicLayer, Preparation, Top, bulk_modulus};
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::reference::film::{Incline, SteadyFilm};
use crate::setup::rules;
use crate::shared::{Arrangement, OverHeight};
use bagnold_solver::material::rheology::{Bingham, HerschelBulkley, Newtonian, Rheology};
use bagnold_solver::parameter::{between, positive};
use bagnold_solver::weakly_compressible::{MomentumOperator, Numerics};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A film of any law. A Newtonian film starts from rest, all others from their exact profile.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FilmFlow {
    /// Geometry, resolution and numerics of the layer.
    #[serde(flatten)]
    pub layer: PeriodicLayer,
    /// Slope angle `[°]`.
    #[schemars(transform = rules::slope_angle())]
    #[schemars(transform = between(0.1, 89.0, "give the angle in degrees; a film needs a slope to flow down"))]
    pub slope_angle: f64,
    /// Density `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 1000"))]
    pub density: f64,
    /// Arrangement of the particles.
    pub arrangement: Arrangement,
    /// Boundary above.
    pub top: Top,
    /// Simulated time over ρh²/η `[-]`: from rest 5 leaves less than 0.01 % of the approach.
    #[schemars(transform = positive("give 5 from rest, which leaves 0.01 % of the initial error, or 1 from the exact profile"))]
    pub relaxation_times: f64,
    /// Constitutive law of the fluid.
    pub material: Rheology,
}

impl Default for FilmFlow {
    fn default() -> Self {
        Self {
            // a viscous fluid needs no artificial viscosity, which is first order: α h c/8 is 0.4 % of ν at 20 rows
            layer: PeriodicLayer {
                numerics: Numerics { artificial_viscosity: 0.0, ..Numerics::default() },
                // a film that settles by 0.2 % carries 0.5 % less, at every resolution
                preparation: Preparation::Raised,
                ..PeriodicLayer::settled(0.01, 20, 8)
            },
            slope_angle: 10.0,
            density: 1000.0,
            arrangement: Arrangement::Jittered,
            top: Top::Free,
            relaxation_times: 5.0,
            material: Rheology::Newtonian(Newtonian { viscosity: 1.0 }),
        }
    }
}

impl Flow for FilmFlow {
    const RUNS: &'static str = include_str!("../../../runs/film.toml");
    type Observation = LayerObservation;

    fn check(&self) -> Result<(), ParameterError> {
        self.layer.check()?;
        rules::material("material", &self.material)?;
        rules::viscous_step("numerics", &self.layer.numerics, &self.material)?;
        let stress = self.incline().shear_stress(0.0);
        let remedy = format!("give less than the shear stress at the bed, {stress:.3} Pa");
        if let Rheology::Bingham(Bingham { yield_stress, .. })
        | Rheology::HerschelBulkley(HerschelBulkley { yield_stress, .. }) = self.material
        {
            rules::between("material.yield_stress", yield_stress, 0.0, 0.95 * stress, &remedy)?;
        }
        let flux = SteadyFilm::of(self.material, self.incline()).flux();
        if flux > 0.0 && flux.is_finite() {
            return Ok(());
        }
        let rule = format!("a law with a steady flow at {}°", self.slope_angle);
        let remedy = "choose another `slope_angle`, or other parameters of the law";
        Err(ParameterError::field("material.law", format!("\"{}\"", self.material.name()), &rule, remedy))
    }

    fn variant(&self) -> Variant {
        let law = self.material.name().replace('-', "_");
        let variant = Variant::of("fluid", law).and("particles", self.arrangement.name());
        let eddies = self.layer.numerics.smagorinsky_constant;
        let variant = if self.has_eddies() { variant.and("eddies", eddies) } else { variant };
        let variant = if self.top == Top::Mirror { variant.and("top", "mirror") } else { variant };
        let variant = self.numerics_name().into_iter().fold(variant, |variant, name| variant.and("numerics", name));
        variant.and("resolution", self.layer.resolution)
    }

    fn cost(&self) -> RunCost {
        RunCost::weakly_compressible(self.layer.particles(), self.layer(&|_| 0.0).expected_steps())
    }

    fn simulate(&self, progress: &Progress) -> Result<Recorded<LayerObservation>, ParameterError> {
        let film = self.film();
        let velocity = |y: f64| if self.is_newtonian() { 0.0 } else { film.velocity(y) };
        // a law that carries its stress along starts with that of the film, others make it from the velocity
        let (plastic, incline) = (self.material.is_plastic(), self.incline());
        let shear_stress = |y: f64| if plastic { incline.shear_stress(y) } else { 0.0 };
        Layer { shear_stress: &shear_stress, ..self.layer(&velocity) }.run(progress)
    }
}

impl FilmFlow {
    /// The film's geometry.
    pub fn incline(&self) -> Incline {
        let PeriodicLayer { layer_height, gravity, .. } = self.layer;
        Incline { layer_height, inclination: self.slope_angle.to_radians(), gravity, density: self.density }
    }

    /// Steady flow.
    pub fn film(&self) -> SteadyFilm {
        let numerics = &self.layer.numerics;
        let spacing = self.layer.layer_height / self.layer.resolution as f64;
        match self.material {
            Rheology::Newtonian(liquid) if self.has_eddies() => {
                SteadyFilm::with_eddies(liquid, self.incline(), numerics.smagorinsky_constant * spacing)
            }
            law => SteadyFilm::of(law, self.incline()),
        }
    }

    /// Whether it is the Newtonian film, which is studied for its convergence and its numerics.
    pub fn is_newtonian(&self) -> bool {
        matches!(self.material, Rheology::Newtonian(_)) && !self.has_eddies()
    }

    /// Whether it has the operators and walls of the collapse paper, which are compared with the default.
    pub fn is_compared(&self) -> bool {
        self.layer.numerics.pairwise_operator().is_some()
    }

    /// Whether its neighbour lists have a wider skin than the default, on which no result may depend.
    pub fn has_wide_skin(&self) -> bool {
        self.layer.numerics.verlet_skin > Numerics::default().verlet_skin
    }

    /// Name of its numerics in a variant; none for the default.
    fn numerics_name(&self) -> Option<&'static str> {
        let numerics = &self.layer.numerics;
        match numerics.momentum_operator {
            _ if self.has_wide_skin() => Some("wide_skin"),
            MomentumOperator::Pairwise => Some("pairwise"),
            MomentumOperator::PairwiseCorrected if numerics.kernel == Numerics::paper().kernel => Some("paper"),
            MomentumOperator::PairwiseCorrected => Some("pairwise_corrected"),
            _ => None,
        }
    }

    /// The layer with the displacements of its arrangement.
    fn particles(&self) -> PeriodicLayer {
        PeriodicLayer { jitter: self.arrangement.displacement(self.layer.jitter), ..self.layer }
    }

    /// Whether eddies add to the viscosity.
    pub fn has_eddies(&self) -> bool {
        self.layer.numerics.smagorinsky_constant > 0.0
    }

    /// Exact velocity `[m/s]` of the Newtonian film as a weakly compressible fluid, whose density grows with the
    /// pressure p = K (exp(ρ0 g cosθ (h − y)/K) − 1): η du/dy = p tanθ. It exceeds the incompressible one by 0.7 % of
    /// the surface velocity at K = 50 ρ0 g h. None for the other fluids.
    pub fn weakly_compressible_velocity(&self, height: f64) -> Option<f64> {
        let Rheology::Newtonian(law) = self.material else { return None };
        if self.has_eddies() {
            return None;
        }
        let layer = self.layer(&|_| 0.0);
        let (bulk_modulus, h) = (layer.bulk_modulus, self.layer.layer_height);
        let rate = self.density * self.layer.gravity * libm::cos(layer.inclination) / bulk_modulus;
        // (exp(ah) − exp(a(h − y)))/a − y without cancellation for a stiff fluid
        let integral = libm::exp(rate * (h - height)) * libm::expm1(rate * height) / rate - height;
        Some(libm::tan(layer.inclination) * bulk_modulus / law.viscosity * integral)
    }

    /// Simulated time `[s]`.
    fn duration(&self) -> f64 {
        let depth = self.layer.layer_height;
        self.relaxation_times * self.density * depth * depth / self.film().relaxing_viscosity()
    }

    /// Length of the window before the end that is averaged over `[s]`.
    pub(super) fn window(&self) -> f64 {
        0.15 * self.duration()
    }

    pub(super) fn layer<'a>(&self, velocity: OverHeight<'a>) -> Layer<'a> {
        let film = self.film();
        let PeriodicLayer { layer_height, gravity, .. } = self.layer;
        let duration = self.duration();
        Layer {
            bulk_modulus: bulk_modulus(self.density, gravity, layer_height, film.flux() / layer_height),
            velocity,
            top: self.top,
            duration,
            window: self.window(),
            interval: duration / 500.0,
            // (13) is known to go unstable on displaced particles; that is shown, and no error of the run
            may_diverge: self.is_compared(),
            ..self.particles().of(self.material, self.density, self.slope_angle)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::grains::GLASS_BEADS;

    #[test]
    fn a_law_must_flow_at_the_slope() {
        let message = |material| FilmFlow { material, ..FilmFlow::default() }.check().expect_err("refused").to_string();
        assert_eq!(
            message(Rheology::MuI(GLASS_BEADS.law)),
            "`material.law` is \"mu-i\", but must be a law with a steady flow at 10°; choose another `slope_angle`, or \
             other parameters of the law"
        );
        let stiff = Bingham { yield_stress: 100.0, plastic_viscosity: 0.5, regularisation_rate: 0.3 };
        let message = message(Rheology::Bingham(stiff));
        assert!(message.starts_with("`material.yield_stress` is 100, but must be"), "{message}");
    }
}
