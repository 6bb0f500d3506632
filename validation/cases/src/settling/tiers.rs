//! The tiers, the rules between parameters, and the runs that they ask for.

use super::experiment::Vessel;
use super::formulation::GrainFormulation;
use super::grain;
use super::parameters::{SettlingParameters, SingleGrain, SuspendedGrains, SuspendingFluid};
use super::runs::SettlingRun;
use super::suspension::{self, LEAST_BED, covers};
use crate::case::{ParameterError, Parameters, Tier};
use crate::reference::settling::GrainForm;
use crate::setup::rules;
use bagnold_solver::incompressible::{PressureSource, ProjectionNumerics, SurfaceTreatment};
use bagnold_solver::material::drag::DragLaw;

impl Parameters for SettlingParameters {
    type Run = SettlingRun;

    fn of_tier(tier: Tier) -> Self {
        let quick = Self {
            gravity: 9.81,
            grain_density: 2600.0,
            seed: 1,
            water: SuspendingFluid { density: 1000.0, kinematic_viscosity: 1e-6 },
            grain: SingleGrain {
                vessel: Vessel { diameter: 5e-3, columns: 8, rows: 12, drag_smoothing_ratio: 2.0, jitter: 0.001 },
                laws: vec![DragLaw::MorsiAlexander, DragLaw::DiFelice],
                formulations: vec![GrainFormulation::Paper, GrainFormulation::Stabilised],
                relaxation_times: 40.0,
            },
            suspension: SuspendedGrains {
                vessel: Vessel { diameter: 1e-3, columns: 8, rows: 8, drag_smoothing_ratio: 2.0, jitter: 0.1 },
                laws: vec![DragLaw::WenYu, DragLaw::Ergun, DragLaw::Gidaspow, DragLaw::DiFelice],
                solid_fractions: vec![0.1, 0.3, 0.5],
                dilute_fraction: 0.002,
                relaxation_times: 12.0,
            },
            numerics: ProjectionNumerics { time_step: 1e-3, ..ProjectionNumerics::default() },
        };
        let alone = DragLaw::ALL.into_iter().filter(|&law| law != DragLaw::Ergun).collect();
        let of_size = |vessel: Vessel, columns, rows| Vessel { columns, rows, ..vessel };
        let (grain, suspension) = (quick.grain.vessel, quick.suspension.vessel);
        let paper = Self {
            grain: SingleGrain {
                vessel: of_size(grain, 12, 16),
                laws: alone,
                relaxation_times: 80.0,
                ..quick.grain.clone()
            },
            suspension: SuspendedGrains {
                // the laws that do not hinder have twice the slip, at which short waves grow sooner
                vessel: Vessel { drag_smoothing_ratio: 3.0, ..of_size(suspension, 12, 24) },
                laws: DragLaw::ALL.to_vec(),
                solid_fractions: vec![0.05, 0.1, 0.2, 0.3, 0.4, 0.5],
                ..quick.suspension.clone()
            },
            ..quick.clone()
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => paper,
            Tier::Fine => Self {
                grain: SingleGrain { vessel: of_size(grain, 24, 32), relaxation_times: 160.0, ..paper.grain.clone() },
                suspension: SuspendedGrains {
                    vessel: of_size(paper.suspension.vessel, 24, 48),
                    ..paper.suspension.clone()
                },
                numerics: ProjectionNumerics { time_step: 5e-4, ..paper.numerics },
                ..paper
            },
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        if self.grain_density <= self.water.density {
            let (rule, remedy) = ("greater than the density of the water", "grains that float do not settle");
            return Err(ParameterError::field("grain_density", self.grain_density, rule, remedy));
        }
        rules::projection("numerics", &self.numerics)?;
        self.check_operators()?;
        self.check_grain()?;
        self.check_suspension()
    }

    fn runs(&self) -> Vec<SettlingRun> {
        let grains = grain::runs(self).into_iter().map(SettlingRun::Grain);
        grains.chain(suspension::runs(self).into_iter().map(SettlingRun::Suspension)).collect()
    }
}

impl SettlingParameters {
    /// The operators that suspensions allow.
    fn check_operators(&self) -> Result<(), ParameterError> {
        if self.suspension.laws.is_empty() {
            return Ok(());
        }
        let remedy =
            "single grains have the paper's operators by the formulation \"paper\"; or empty `suspension.laws`";
        let refused = |field, value, rule| Err(ParameterError::field(field, value, rule, remedy));
        if self.numerics.pressure_source != PressureSource::Divergence {
            return refused("numerics.pressure_source", "density", "\"divergence\" with suspensions");
        }
        if self.numerics.surface != SurfaceTreatment::Completed {
            return refused("numerics.surface", "eliminated", "\"completed\" with suspensions");
        }
        Ok(())
    }

    fn check_grain(&self) -> Result<(), ParameterError> {
        let grain = &self.grain;
        grain.vessel.check("grain", &self.numerics)?;
        for (index, &law) in grain.laws.iter().enumerate() {
            if self.grains(grain.vessel.diameter).terminal_velocity(law, GrainForm::Planar).is_none() {
                let field = format!("grain.laws[{index}]");
                let rule = "a law of one grain that covers its Reynolds number";
                let remedy = "leave out \"ergun\", and \"morsi-alexander\" above R = 50 000";
                return Err(ParameterError::field(&field, law.name(), rule, remedy));
            }
        }
        Ok(())
    }

    fn check_suspension(&self) -> Result<(), ParameterError> {
        let suspension = &self.suspension;
        suspension.vessel.check("suspension", &self.numerics)?;
        for (index, &law) in suspension.laws.iter().enumerate() {
            let field = format!("suspension.laws[{index}]");
            let judged = suspension.solid_fractions.iter().any(|&fraction| covers(law, fraction));
            let alone = suspension.dilute_fraction > 0.0 && law != DragLaw::Ergun;
            if !(judged || alone) {
                let rule = format!("a law for one of the solid fractions; \"ergun\" begins at {LEAST_BED}");
                let remedy = "leave it out, or add a denser suspension";
                return Err(ParameterError::field(&field, law.name(), &rule, remedy));
            }
            let in_range =
                |&fraction: &f64| self.grains(suspension.vessel.diameter).hindered_slip(law, fraction).is_some();
            if !suspension.solid_fractions.iter().all(in_range) {
                let rule = "a law that covers the grains' Reynolds number";
                return Err(ParameterError::field(&field, law.name(), rule, "\"morsi-alexander\" ends at R = 50 000"));
            }
        }
        Ok(())
    }
}
