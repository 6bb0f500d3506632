//! The tiers, the rules between parameters, and the runs that they ask for.

use super::parameters::{ARREST_DURATION, BagnoldParameters, LayerStart, OtherGrains};
use super::runs::{self, BagnoldRun};
use crate::case::{ParameterError, Parameters, Tier};
use crate::input::check_name;
use crate::layer::PeriodicLayer;
use crate::reference::grains::GLASS_BEADS;
use crate::setup::rules;
use bagnold_solver::material::rheology::{MuI, Rheology};

impl Parameters for BagnoldParameters {
    type Run = BagnoldRun;

    fn of_tier(tier: Tier) -> Self {
        let quick = Self {
            layer: PeriodicLayer::settled(0.01, 20, 12),
            solid_fraction: GLASS_BEADS.solid_fraction,
            slope_angles: vec![22.0, 23.0, 24.0, 25.0],
            starts: vec![LayerStart::Rest],
            duration_factor: 1.0,
            averaging_time: 0.5,
            convergence_slope_angle: 24.0,
            convergence_resolutions: vec![],
            convergence_seeds: vec![],
            arrest_slope_angles: vec![20.0],
            arrest_start_angle: 24.0,
            // at 20 rows the particles' agitation breaks the layer up before its mean reaches half the sound speed
            runaway_slope_angles: vec![],
            other_grains: Vec::new(),
            // glass beads of Table 1 (Forterre & Pouliquen 2003); I_0 from (41) at 25°, kept at every angle
            material: Rheology::MuI(GLASS_BEADS.law),
            regularised_slope_angles: Vec::new(),
            regularised_rate: 0.01,
            printed_rates: Vec::new(),
            printed_resolution: 10,
        };
        let paper = Self {
            // with 20 columns the velocity at 22° scatters by 0.3 % from seed to seed, with 40 by less than 0.1 %
            layer: PeriodicLayer { resolution: 40, columns: 40, ..quick.layer },
            starts: vec![LayerStart::Rest, LayerStart::Profile],
            convergence_resolutions: vec![10, 20, 40],
            convergence_seeds: vec![1, 2],
            runaway_slope_angles: vec![34.0],
            other_grains: other_grains(),
            printed_rates: vec![1.0],
            regularised_slope_angles: vec![24.0],
            ..quick.clone()
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => paper,
            Tier::Fine => Self {
                layer: PeriodicLayer { layer_height: 0.02, resolution: 60, ..paper.layer },
                convergence_resolutions: vec![20, 40, 60],
                ..paper
            },
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        let shortest = ARREST_DURATION * self.duration_scale();
        let remedy = "the window must fit into the shortest run: choose a shorter one or a larger `duration_factor`";
        rules::between("averaging_time", self.averaging_time, 0.0, shortest, remedy)?;
        self.layer.check()?;
        let remedy = "Bagnold's profile, which the case is judged by, is exact for it alone";
        let grains = rules::only_mu_i("material", &self.material, remedy)?;
        rules::material("material", &self.material)?;
        let numerics = &self.layer.numerics;
        rules::viscous_step("numerics", numerics, &Rheology::MuI(grains))?;
        if !self.regularised_slope_angles.is_empty() {
            rules::implicit_runs("numerics", numerics, "regularised_slope_angles")?;
        }
        let steady = |field: &str, angle: f64| self.steady(&grains, field, angle);
        let lists =
            [("slope_angles", &self.slope_angles), ("regularised_slope_angles", &self.regularised_slope_angles)];
        for (index, other) in self.other_grains.iter().enumerate() {
            let name = |field: &str| format!("other_grains[{index}].{field}");
            check_name(&name("name"), &other.name)?;
            rules::row_count(&name("resolution"), other.resolution)?;
            rules::material(&name("grains"), &Rheology::MuI(other.grains))?;
            self.steady(&other.grains, &name("slope_angle"), other.slope_angle)?;
        }
        for (name, angles) in lists {
            for (index, &angle) in angles.iter().enumerate() {
                steady(&format!("{name}[{index}]"), angle)?;
            }
        }
        if !self.convergence_resolutions.is_empty() || !self.printed_rates.is_empty() {
            steady("convergence_slope_angle", self.convergence_slope_angle)?;
        }
        if !self.arrest_slope_angles.is_empty() {
            steady("arrest_start_angle", self.arrest_start_angle)?;
        }
        Ok(())
    }

    fn runs(&self) -> Vec<BagnoldRun> {
        runs::all(self)
    }
}

/// Three materials that no experiment has: 20, 30 and 100 grains over a layer of 10 mm, friction from 0.3 to 0.95.
fn other_grains() -> Vec<OtherGrains> {
    let new =
        |name: &str, slope_angle, resolution, [static_friction, limiting_friction]: [f64; 2], inertia, diameter| {
            let grains = MuI {
                static_friction,
                limiting_friction,
                reference_inertia: inertia,
                grain_diameter: diameter,
                ..GLASS_BEADS.law
            };
            OtherGrains { name: name.to_owned(), slope_angle, resolution, grains }
        };
    vec![
        new("slippery", 20.0, 40, [0.3, 0.5], 0.1, 0.5e-3),
        new("rough", 28.0, 40, [0.45, 0.75], 0.3, 0.33e-3),
        new("fine", 34.0, 60, [0.6, 0.95], 0.6, 0.1e-3),
    ]
}
