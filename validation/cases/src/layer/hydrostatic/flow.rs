//! The flow: a layer at rest.

use crate::case::{Flow, ParameterError, Progress, RunCost};
use crate::layer::{Layer, LayerObservation, PeriodicLayer};
use crate::metric::Variant;
use crate::observation::Recorded;
use crate::reference::grains::GLASS_BEADS;
use crate::setup::{Bulk, rules};
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::parameter::between;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A layer at rest. Its numerics say whether density and pressure are coupled.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct HydrostaticFlow {
    /// Geometry, resolution and numerics of the layer.
    #[serde(flatten)]
    pub layer: PeriodicLayer,
    /// Simulated time `[s]`.
    #[schemars(transform = between(2.2, 1e4, "give 2.2 s or more: drift is measured from about 1 s to about 2 s"))]
    pub duration: f64,
    /// Density of the layer.
    #[serde(flatten)]
    pub bulk: Bulk,
    /// Constitutive law of the material.
    pub material: Rheology,
}

impl Default for HydrostaticFlow {
    fn default() -> Self {
        Self {
            layer: PeriodicLayer::settled(0.1, 20, 12),
            duration: 2.25,
            bulk: Bulk::of_grains(GLASS_BEADS.solid_fraction),
            material: Rheology::MuI(GLASS_BEADS.law),
        }
    }
}

impl Flow for HydrostaticFlow {
    const RUNS: &'static str = include_str!("../../../runs/hydrostatic.toml");
    type Observation = LayerObservation;

    fn check(&self) -> Result<(), ParameterError> {
        self.layer.check()?;
        rules::material("material", &self.material)?;
        rules::viscous_step("numerics", &self.layer.numerics, &self.material)?;
        self.bulk.check(&self.material)
    }

    fn variant(&self) -> Variant {
        Variant::of("material", self.material.name().replace('-', "_"))
            .and("density_coupling", self.layer.numerics.density_coupling)
            .and("resolution", self.layer.resolution)
    }

    fn cost(&self) -> RunCost {
        RunCost::weakly_compressible(self.layer.particles(), self.layer().expected_steps())
    }

    fn simulate(&self, progress: &Progress) -> Result<Recorded<LayerObservation>, ParameterError> {
        self.layer().run(progress)
    }
}

impl HydrostaticFlow {
    fn layer(&self) -> Layer<'static> {
        let layer = self.layer.of(self.material, self.density(), 0.0);
        Layer { duration: self.duration, window: 0.5, interval: 5e-3, frames: 3, ..layer }
    }

    /// Bulk density `[kg/m³]`.
    pub fn density(&self) -> f64 {
        self.bulk.density(&self.material)
    }

    /// Whether density and pressure are coupled by (27).
    pub fn is_coupled(&self) -> bool {
        self.layer.numerics.density_coupling > 0.0
    }

    /// ρ0 g H² times the length of the layer `[J/m]`.
    pub fn energy_scale(&self) -> f64 {
        let layer = self.layer();
        let PeriodicLayer { layer_height, gravity, columns, .. } = layer.layer;
        layer.reference_density * gravity * layer_height.powi(2) * columns as f64 * layer.spacing()
    }

    /// Height of the layer `[m]`.
    pub fn height(&self) -> f64 {
        self.layer.layer_height
    }

    /// Exact pressure `[Pa]` at a height `[m]`.
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
        let mut flow = HydrostaticFlow::default();
        assert_eq!(flow.density(), GLASS_BEADS.solid_fraction * 2500.0);
        flow.material =
            Rheology::Bingham(Bingham { yield_stress: 1.0, plastic_viscosity: 1.0, regularisation_rate: 1.0 });
        let message = flow.check().expect_err("no density").to_string();
        assert_eq!(
            message,
            "`bulk_density` is 0, but must be positive with the law \"bingham\"; give it in kg/m³, such as 1500, because the \
             law has no grain density"
        );
        flow.bulk.bulk_density = 1500.0;
        assert!(flow.check().is_ok());
        assert_eq!(flow.variant().get("material").map(|name| name.text().to_owned()).as_deref(), Some("bingham"));
        flow.material = Rheology::MuI(GLASS_BEADS.law);
        let message = flow.check().expect_err("two densities").to_string();
        assert!(message.starts_with("`bulk_density` is 1500, but must be 0 with the law \"mu-i\"; "), "{message}");
    }
}
