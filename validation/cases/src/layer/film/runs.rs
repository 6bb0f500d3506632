//! The simulations.

use super::comparison::NumericsSet;
use crate::case::{ExternalData, ExternalObservation, ParameterError, Progress, Run};
use crate::input::FieldError;
use crate::layer::{self, Layer, LayerObservation, PeriodicLayer, Top, bulk_modulus};
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::reference::film::{Incline, SteadyFilm};
use crate::shared::Arrangement;
use bagnold_solver::material::rheology::Rheology;
use serde::Serialize;

/// The incline of a layer of a density `[kg/m³]` on a slope `[°]`.
pub(super) fn incline(layer: &PeriodicLayer, slope_angle: f64, density: f64) -> Incline {
    let PeriodicLayer { layer_height, gravity, .. } = *layer;
    Incline { layer_height, inclination: slope_angle.to_radians(), gravity, density }
}

/// One simulation.
#[derive(Debug, Clone, Serialize)]
pub struct FilmRun {
    /// Law of the fluid.
    pub law: Rheology,
    /// Arrangement of the particles.
    pub particles: Arrangement,
    /// Which numerics.
    pub numerics_set: NumericsSet,
    /// What is above it.
    pub top: Top,
    /// The layer, with the rows, displacements and numerics of this run.
    pub layer: PeriodicLayer,
    pub(super) slope_angle: f64,
    pub(super) density: f64,
    pub(super) relaxation_times: f64,
}

impl Run for FilmRun {
    type Observation = LayerObservation;

    fn variant(&self) -> Variant {
        let variant = Variant::of("fluid", self.law.name().replace('-', "_")).and("particles", self.particles.name());
        let eddies = self.layer.numerics.smagorinsky_constant;
        let variant = if self.has_eddies() { variant.and("eddies", eddies) } else { variant };
        let variant = if self.top == Top::Mirror { variant.and("top", "mirror") } else { variant };
        let variant = match self.numerics_set {
            NumericsSet::Default => variant,
            other => variant.and("numerics", other.name()),
        };
        variant.and("resolution", self.layer.resolution)
    }

    fn particles(&self) -> f64 {
        self.layer.particles()
    }

    fn particle_steps(&self) -> f64 {
        self.layer(&|_| 0.0).expected_steps() * self.layer.particles()
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<LayerObservation>, ParameterError> {
        let film = self.film();
        let velocity = |y: f64| if self.is_newtonian() { 0.0 } else { film.velocity(y) };
        // a law that carries its stress along starts with that of the film, others make it from the velocity
        let (plastic, incline) = (self.law.is_plastic(), self.incline());
        let shear_stress = |y: f64| if plastic { incline.shear_stress(y) } else { 0.0 };
        Layer { shear_stress: &shear_stress, ..self.layer(&velocity) }.run(progress)
    }
}

impl FilmRun {
    /// The film's geometry.
    #[must_use]
    pub fn incline(&self) -> Incline {
        incline(&self.layer, self.slope_angle, self.density)
    }

    /// Its steady flow.
    #[must_use]
    pub fn film(&self) -> SteadyFilm {
        let numerics = &self.layer.numerics;
        let spacing = self.layer.layer_height / self.layer.resolution as f64;
        match self.law {
            Rheology::Newtonian(liquid) if self.has_eddies() => {
                SteadyFilm::with_eddies(liquid, self.incline(), numerics.smagorinsky_constant * spacing)
            }
            law => SteadyFilm::of(law, self.incline()),
        }
    }

    /// Whether it is the Newtonian film, which is studied for its convergence and its numerics.
    #[must_use]
    pub fn is_newtonian(&self) -> bool {
        matches!(self.law, Rheology::Newtonian(_)) && !self.has_eddies()
    }

    /// Whether eddies add to the viscosity.
    #[must_use]
    pub fn has_eddies(&self) -> bool {
        self.layer.numerics.smagorinsky_constant > 0.0
    }

    /// Exact velocity `[m/s]` of the Newtonian film as a weakly compressible fluid, whose density grows with the
    /// pressure p = K (exp(ρ0 g cosθ (h − y)/K) − 1): η du/dy = p tanθ. It exceeds the incompressible one by 0.7 % of
    /// the surface velocity at K = 50 ρ0 g h. None for the other fluids.
    #[must_use]
    pub fn weakly_compressible_velocity(&self, height: f64) -> Option<f64> {
        let Rheology::Newtonian(law) = self.law else { return None };
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

    /// Its observation as another code gives it.
    pub(super) fn observe_external(
        &self,
        given: &ExternalData,
    ) -> Result<ExternalObservation<LayerObservation>, FieldError> {
        layer::foreign::observe(&self.layer(&|_| 0.0), given)
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

    fn layer<'a>(&self, velocity: &'a (dyn Fn(f64) -> f64 + Sync)) -> Layer<'a> {
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
            may_diverge: NumericsSet::OTHERS.contains(&self.numerics_set),
            ..self.layer.of(self.law, self.density, self.slope_angle)
        }
    }
}
