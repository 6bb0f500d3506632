//! Parameters, tiers and runs.

use super::comparison::NumericsSet;
use super::runs::{FilmRun, incline};
use crate::case::{ParameterError, Parameters, Tier};
use crate::layer::{PeriodicLayer, Preparation, Top};
use crate::reference::film::{Incline, SteadyFilm};
use crate::setup::rules;
use crate::shared::Arrangement;
use bagnold_solver::material::rheology::{Bingham, CoulombBingham, HerschelBulkley, Newtonian, Rheology};
use bagnold_solver::parameter::{between, each, positive, unique, up_to, within};
use bagnold_solver::weakly_compressible::numerics::Numerics;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which fluid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum FluidKind {
    /// Newtonian.
    Newtonian,
    /// Bingham.
    Bingham,
    /// Herschel–Bulkley.
    HerschelBulkley,
    /// A Newtonian liquid with eddies, under `eddies`.
    Eddies,
    /// That of any law, under `material`.
    Material,
}

/// What to do about a film without a viscosity.
const VISCOUS: &str = "a film flows by its viscosity, and its time is ρh²/η; 1 is quick";

/// A thin liquid whose eddies carry as much as its viscosity.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EddyLiquid {
    /// Viscosity μ `[Pa·s]`.
    #[schemars(transform = positive("give it in Pa·s; 0.1 is as much as the eddies add"))]
    pub viscosity: f64,
    /// C_s of the eddy viscosity (5) `[-]`.
    #[schemars(transform = up_to(1.0, "give C_s; 1 makes a film's eddies felt"))]
    pub smagorinsky_constant: f64,
}

/// Parameters of the case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FilmParameters {
    /// The layer.
    #[serde(flatten)]
    pub layer: PeriodicLayer,
    /// Slope angle `[°]`.
    #[schemars(transform = rules::slope_angle())]
    #[schemars(transform = between(0.1, 89.0, "a film needs a slope to flow down"))]
    pub slope_angle: f64,
    /// Density `[kg/m³]`.
    #[schemars(transform = positive("give it in kg/m³, such as 1000"))]
    pub density: f64,
    /// Fluids to run.
    #[schemars(transform = unique("name every fluid once"))]
    pub fluids: Vec<FluidKind>,
    /// Rows of the Newtonian convergence study on the lattice; empty for none.
    #[schemars(transform = each(rules::rows()))]
    #[schemars(transform = unique("name every resolution once"))]
    pub convergence_resolutions: Vec<usize>,
    /// Rows of the Newtonian film that compares other operators and walls with the default; 0 for none.
    pub comparison_resolution: usize,
    /// Simulated time of the Newtonian film, from rest, over ρh²/η `[-]`.
    #[schemars(transform = positive("5 leaves less than 0.01 % of the approach"))]
    pub relaxation_times: f64,
    /// Simulated time of the yield-stress films, from the exact profile, over ρh²/η `[-]`.
    #[schemars(transform = positive("1 lets the errors of the start decay"))]
    pub yield_relaxation_times: f64,
    /// The Newtonian fluid.
    #[schemars(transform = within("viscosity", positive(VISCOUS)))]
    pub newtonian: Newtonian,
    /// The Bingham fluid.
    #[schemars(transform = within("plastic_viscosity", positive(VISCOUS)))]
    pub bingham: Bingham,
    /// The Herschel–Bulkley fluid.
    #[schemars(transform = within("consistency", positive(VISCOUS)))]
    pub herschel_bulkley: HerschelBulkley,
    /// Liquid of the fluid "eddies": a Newtonian one whose eddy viscosity carries as much of the stress as its own.
    pub eddies: EddyLiquid,
    /// Any other law, for the fluid "material".
    pub material: Rheology,
}

impl Parameters for FilmParameters {
    type Run = FilmRun;

    fn of_tier(tier: Tier) -> Self {
        let quick = Self {
            // a viscous fluid needs no artificial viscosity, which is first order: α h c/8 is 0.4 % of ν at 20 rows
            layer: PeriodicLayer {
                numerics: Numerics { artificial_viscosity: 0.0, ..Numerics::default() },
                // a film that settles by 0.2 % carries 0.5 % less, at every resolution
                preparation: Preparation::Raised,
                ..PeriodicLayer::settled(0.01, 20, 8)
            },
            slope_angle: 10.0,
            density: 1000.0,
            fluids: vec![FluidKind::Newtonian, FluidKind::Bingham, FluidKind::HerschelBulkley, FluidKind::Eddies],
            convergence_resolutions: vec![10, 20],
            comparison_resolution: 20,
            relaxation_times: 5.0,
            yield_relaxation_times: 1.0,
            newtonian: Newtonian { viscosity: 1.0 },
            // a plug over the upper 0.3 h that creeps by about 1 % of its speed
            bingham: Bingham { yield_stress: 5.1, plastic_viscosity: 0.5, regularisation_rate: 0.3 },
            herschel_bulkley: HerschelBulkley {
                yield_stress: 5.1,
                consistency: 1.1,
                flow_index: 0.7,
                regularisation_rate: 0.3,
            },
            eddies: EddyLiquid { viscosity: 0.1, smagorinsky_constant: 1.0 },
            // grains that yield by friction alone
            material: Rheology::CoulombBingham(CoulombBingham {
                yield_stress: 0.0,
                friction: 0.1,
                plastic_viscosity: 0.5,
                regularisation_rate: 0.3,
                largest_viscosity: 1e4,
            }),
        };
        let refined = |resolution, convergence_resolutions| Self {
            layer: PeriodicLayer { resolution, columns: 12, ..quick.layer },
            convergence_resolutions,
            ..quick.clone()
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => refined(40, vec![10, 20, 40]),
            Tier::Fine => refined(80, vec![20, 40, 80]),
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        if self.comparison_resolution > 0 {
            rules::row_count("comparison_resolution", self.comparison_resolution)?;
        }
        self.layer.check()
    }

    fn check_runs(&self, runs: &[&FilmRun]) -> Result<(), ParameterError> {
        for run in runs {
            rules::columns("columns", run.layer.columns, &run.layer.numerics)?;
        }
        let is_run = |kind: FluidKind| {
            let (law, numerics) = (self.law(kind), self.numerics(kind));
            let eddies = numerics.smagorinsky_constant;
            self.fluids.contains(&kind)
                && runs.iter().any(|run| run.law == law && run.layer.numerics.smagorinsky_constant == eddies)
        };
        let base = self.incline().shear_stress(0.0);
        let fluids = [
            (FluidKind::Bingham, "bingham.yield_stress", self.bingham.yield_stress),
            (FluidKind::HerschelBulkley, "herschel_bulkley.yield_stress", self.herschel_bulkley.yield_stress),
        ];
        for (_, field, yield_stress) in fluids.into_iter().filter(|(kind, ..)| is_run(*kind)) {
            let remedy = format!("the shear stress at the bed is {base:.3} Pa: above it nothing flows");
            rules::between(field, yield_stress, 0.0, 0.95 * base, &remedy)?;
        }
        if is_run(FluidKind::Material) {
            self.check_material()?;
        }
        let (own, common) = (self.eddies.smagorinsky_constant, self.layer.numerics.smagorinsky_constant);
        if is_run(FluidKind::Eddies) && own == common {
            let remedy = "the liquid with eddies is distinguished by it; or leave \"eddies\" out of `fluids`";
            let rule = "another than `numerics.smagorinsky_constant`";
            return Err(ParameterError::field("eddies.smagorinsky_constant", own, rule, remedy));
        }
        if is_run(FluidKind::Newtonian) {
            rules::viscous_step("numerics", &self.layer.numerics, &Rheology::Newtonian(self.newtonian))?;
        }
        Ok(())
    }

    fn runs(&self) -> Vec<FilmRun> {
        let new = |kind, particles: Arrangement, resolution, numerics_set: NumericsSet| FilmRun {
            law: self.law(kind),
            particles,
            numerics_set,
            top: Top::Free,
            layer: PeriodicLayer {
                resolution,
                jitter: particles.displacement(self.layer.jitter),
                numerics: numerics_set.numerics(self.numerics(kind)),
                ..self.layer
            },
            slope_angle: self.slope_angle,
            density: self.density,
            relaxation_times: match kind {
                FluidKind::Newtonian => self.relaxation_times,
                _ => self.yield_relaxation_times,
            },
        };
        let mut runs = Vec::new();
        for &kind in &self.fluids {
            runs.push(new(kind, Arrangement::Jittered, self.layer.resolution, NumericsSet::Default));
            if kind == FluidKind::Newtonian {
                let study = self.convergence_resolutions.iter();
                runs.extend(study.clone().map(|&rows| new(kind, Arrangement::Lattice, rows, NumericsSet::Default)));
                // displaced particles converge in another way; the finest of them is the film's own
                let others = study.filter(|&&rows| rows != self.layer.resolution);
                runs.extend(others.map(|&rows| new(kind, Arrangement::Jittered, rows, NumericsSet::Default)));
                let coarsest = self.convergence_resolutions.iter().min();
                let own = |&rows: &usize| new(kind, Arrangement::Lattice, rows, NumericsSet::Default);
                runs.extend(coarsest.map(|rows| FilmRun { top: Top::Mirror, ..own(rows) }));
                runs.extend(coarsest.map(|&rows| new(kind, Arrangement::Lattice, rows, NumericsSet::WideSkin)));
            }
        }
        if self.comparison_resolution > 0 && self.fluids.contains(&FluidKind::Newtonian) {
            let other = |set| new(FluidKind::Newtonian, Arrangement::Jittered, self.comparison_resolution, set);
            // the default is compared at the same resolution, which the profile may have run already
            let has_run = |rows| rows == self.layer.resolution || self.convergence_resolutions.contains(&rows);
            if !has_run(self.comparison_resolution) {
                runs.push(other(NumericsSet::Default));
            }
            runs.extend(NumericsSet::OTHERS.map(other));
        }
        runs
    }
}

impl FilmParameters {
    fn incline(&self) -> Incline {
        incline(&self.layer, self.slope_angle, self.density)
    }

    fn law(&self, kind: FluidKind) -> Rheology {
        match kind {
            FluidKind::Newtonian => Rheology::Newtonian(self.newtonian),
            FluidKind::Bingham => Rheology::Bingham(self.bingham),
            FluidKind::HerschelBulkley => Rheology::HerschelBulkley(self.herschel_bulkley),
            FluidKind::Eddies => Rheology::Newtonian(Newtonian { viscosity: self.eddies.viscosity }),
            FluidKind::Material => self.material,
        }
    }

    fn numerics(&self, kind: FluidKind) -> Numerics {
        match kind {
            FluidKind::Eddies => {
                Numerics { smagorinsky_constant: self.eddies.smagorinsky_constant, ..self.layer.numerics }
            }
            _ => self.layer.numerics,
        }
    }

    /// The material must be told from the other fluids, and flow steadily.
    fn check_material(&self) -> Result<(), ParameterError> {
        rules::material("material", &self.material)?;
        rules::viscous_step("numerics", &self.layer.numerics, &self.material)?;
        let refused = |rule: &str, remedy: &str| {
            let name = format!("\"{}\"", self.material.name());
            Err(ParameterError::field("material.law", name, rule, remedy))
        };
        let others = self.fluids.iter().filter(|kind| **kind != FluidKind::Material);
        if others.into_iter().any(|&kind| self.law(kind).name() == self.material.name()) {
            return refused("another law than those of the other `fluids`", "or leave that one out of `fluids`");
        }
        let flux = SteadyFilm::of(self.material, self.incline()).flux();
        if !(flux > 0.0 && flux.is_finite()) {
            let rule = format!("a law that flows steadily at {}°", self.slope_angle);
            return refused(&rule, "choose another `slope_angle`, or other parameters of the law");
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::reference::grains::GLASS_BEADS;

    #[test]
    fn a_material_must_have_a_law_of_its_own_that_flows_at_the_slope() {
        let quick = FilmParameters::of_tier(Tier::Quick);
        let film = |material| FilmParameters {
            fluids: vec![FluidKind::Newtonian, FluidKind::Material],
            material,
            ..quick.clone()
        };
        let fluids = film(quick.material).runs().into_iter().map(|run| run.law.name()).collect::<Vec<_>>();
        assert!(fluids.contains(&"coulomb-bingham"), "{fluids:?}");
        assert!(film(quick.material).check_all().is_ok());
        let message = |material| film(material).check_all().expect_err("refused").to_string();
        assert!(
            message(Rheology::Newtonian(quick.newtonian))
                .starts_with("`material.law` is \"newtonian\", but must be another")
        );
        assert_eq!(
            message(Rheology::MuI(GLASS_BEADS.law)),
            "`material.law` is \"mu-i\", but must be a law that flows steadily at 10°; choose another `slope_angle`, or \
             other parameters of the law"
        );
    }

    #[test]
    fn a_fluid_that_is_not_run_breaks_no_rule() {
        // more than the shear stress at the bed: the Bingham film would rest
        let quick = FilmParameters::of_tier(Tier::Quick);
        let stiff = FilmParameters { bingham: Bingham { yield_stress: 100.0, ..quick.bingham }, ..quick };
        let message = stiff.check_all().expect_err("at rest").to_string();
        assert!(message.starts_with("`bingham.yield_stress` is 100, but must be"), "{message}");
        let runs = stiff.runs();
        let of = |name: &str| -> Vec<&FilmRun> { runs.iter().filter(|run| run.law.name() == name).collect() };
        assert!(!of("newtonian").is_empty() && stiff.check_runs(&of("newtonian")).is_ok());
        assert!(stiff.check_runs(&of("bingham")).is_err());
        let without = FilmParameters { fluids: vec![FluidKind::Newtonian], ..stiff };
        assert!(without.check_all().is_ok());
    }
}
