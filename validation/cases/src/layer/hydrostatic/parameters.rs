//! Parameters, tiers and runs.

use crate::case::{ParameterError, Parameters, Progress, Run, Tier};
use crate::layer::{Layer, LayerObservation, PeriodicLayer};
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::reference::grains::GLASS_BEADS;
use crate::setup::{Bulk, rules};
use bagnold_solver::material::rheology::{Newtonian, Rheology};
use bagnold_solver::parameter::{between, positive};
use bagnold_solver::weakly_compressible::numerics::Numerics;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct HydrostaticParameters {
    /// The layer.
    #[serde(flatten)]
    pub layer: PeriodicLayer,
    /// Simulated time `[s]`.
    #[schemars(transform = between(2.2, 1e4, "drift is measured over 0.4 s about 1 s and about 2 s"))]
    pub duration: f64,
    /// Density of the grains' layer.
    #[serde(flatten)]
    pub bulk: Bulk,
    /// Density of the liquid `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 1000"))]
    pub liquid_density: f64,
    /// The liquid.
    pub liquid: Rheology,
    /// The grains.
    pub grains: Rheology,
}

impl Parameters for HydrostaticParameters {
    type Run = HydrostaticRun;

    fn of_tier(tier: Tier) -> Self {
        let (layer, duration) = match tier {
            Tier::Quick => (PeriodicLayer::settled(0.1, 20, 12), 2.25),
            Tier::Paper => (PeriodicLayer::settled(0.1, 40, 20), 4.0),
            Tier::Fine => (PeriodicLayer::settled(0.1, 80, 40), 10.0),
        };
        Self {
            layer,
            duration,
            bulk: Bulk::of_grains(GLASS_BEADS.solid_fraction),
            liquid_density: 1000.0,
            liquid: Rheology::Newtonian(Newtonian { viscosity: 1e-3 }),
            grains: Rheology::MuI(GLASS_BEADS.law),
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        self.layer.check()?;
        if self.liquid.name() == self.grains.name() {
            let name = format!("\"{}\"", self.grains.name());
            let remedy = "the two layers are distinguished by their laws";
            return Err(ParameterError::field("grains.law", name, "another law than the liquid's", remedy));
        }
        Ok(())
    }

    fn check_runs(&self, runs: &[&HydrostaticRun]) -> Result<(), ParameterError> {
        let is_run = |law: &Rheology| runs.iter().any(|run| run.law == *law);
        for (field, law) in [("liquid", &self.liquid), ("grains", &self.grains)] {
            if is_run(law) {
                rules::material(field, law)?;
                rules::viscous_step("numerics", &self.layer.numerics, law)?;
            }
        }
        if is_run(&self.grains) { self.bulk.check(&self.grains) } else { Ok(()) }
    }

    fn runs(&self) -> Vec<HydrostaticRun> {
        let materials = [(self.liquid, self.liquid_density), (self.grains, self.bulk.density(&self.grains))];
        let coupling = self.layer.numerics.density_coupling;
        let couplings = if coupling > 0.0 { vec![coupling, 0.0] } else { vec![coupling] };
        let new = |density_coupling, (law, density)| {
            let numerics = Numerics { density_coupling, ..self.layer.numerics };
            HydrostaticRun { law, density, duration: self.duration, layer: PeriodicLayer { numerics, ..self.layer } }
        };
        couplings.into_iter().flat_map(|coupling| materials.map(|material| new(coupling, material))).collect()
    }
}

/// One simulation.
#[derive(Debug, Clone, Serialize)]
pub struct HydrostaticRun {
    /// Law of the material.
    pub law: Rheology,
    /// Its density in bulk `[kg/m³]`.
    pub density: f64,
    /// The layer, whose numerics say whether density and pressure are coupled.
    pub layer: PeriodicLayer,
    duration: f64,
}

impl Run for HydrostaticRun {
    type Observation = LayerObservation;

    fn variant(&self) -> Variant {
        Variant::of("material", self.law.name().replace('-', "_"))
            .and("density_coupling", self.layer.numerics.density_coupling)
            .and("resolution", self.layer.resolution)
    }

    fn particles(&self) -> f64 {
        self.layer.particles()
    }

    fn particle_steps(&self) -> f64 {
        self.layer().expected_steps() * self.layer.particles()
    }

    fn simulate(&self, progress: &dyn Progress) -> Result<Recorded<LayerObservation>, ParameterError> {
        self.layer().run(progress)
    }
}

impl HydrostaticRun {
    fn layer(&self) -> Layer<'static> {
        let layer = self.layer.of(self.law, self.density, 0.0);
        Layer { duration: self.duration, window: 0.5, interval: 5e-3, frames: 3, ..layer }
    }

    /// Whether density and pressure are coupled by (27).
    #[must_use]
    pub fn is_coupled(&self) -> bool {
        self.layer.numerics.density_coupling > 0.0
    }

    /// Least and most of the pressure over the weight above that grains can rest with, 1/(1 ± μ_s): passive and active
    /// state `[-]`; none for a material whose pressure alone carries the weight.
    #[must_use]
    pub fn states_of_rest(&self) -> Option<(f64, f64)> {
        let friction = self.law.contact_friction();
        self.law.is_plastic().then_some((1.0 / (1.0 + friction), 1.0 / (1.0 - friction)))
    }

    /// ρ0 g H² times the length of the layer `[J/m]`.
    #[must_use]
    pub fn energy_scale(&self) -> f64 {
        let layer = self.layer();
        let PeriodicLayer { layer_height, gravity, columns, .. } = layer.layer;
        layer.reference_density * gravity * layer_height.powi(2) * columns as f64 * layer.spacing()
    }

    /// Height of the layer `[m]`.
    #[must_use]
    pub fn height(&self) -> f64 {
        self.layer.layer_height
    }

    /// Exact pressure `[Pa]` at a height `[m]`.
    #[must_use]
    pub fn pressure(&self, y: f64) -> f64 {
        self.layer().hydrostatic_pressure(y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use bagnold_solver::material::rheology::Bingham;

    #[test]
    fn the_law_decides_what_the_bulk_density_comes_from() {
        let mut parameters = HydrostaticParameters::of_tier(Tier::Quick);
        assert_eq!(parameters.bulk.density(&parameters.grains), GLASS_BEADS.solid_fraction * 2500.0);
        parameters.grains =
            Rheology::Bingham(Bingham { yield_stress: 1.0, plastic_viscosity: 1.0, regularisation_rate: 1.0 });
        let message = parameters.check_all().expect_err("no density").to_string();
        assert_eq!(
            message,
            "`bulk_density` is 0, but must be positive with the law \"bingham\"; the law has no grain density: give that of \
             the bulk in kg/m³, such as 1500"
        );
        parameters.bulk.bulk_density = 1500.0;
        assert!(parameters.check_all().is_ok());
        let name = parameters.runs()[1].variant().get("material").map(ToString::to_string);
        assert_eq!(name.as_deref(), Some("bingham"));
        parameters.grains = Rheology::MuI(GLASS_BEADS.law);
        let message = parameters.check_all().expect_err("two densities").to_string();
        assert!(message.starts_with("`bulk_density` is 1500, but must be 0 with the law \"mu-i\"; "), "{message}");
    }
}
