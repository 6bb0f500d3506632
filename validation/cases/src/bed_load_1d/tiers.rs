//! The tiers, the rules between parameters, and the runs that they ask for.

use super::grain_units::{GrainUnits, LayerConditions, Onset};
use super::parameters::{BedGrains, BedLoad1dParameters, WaterStream};
use super::replacements::Sensitivities;
use super::run::{BedLoad1dRun, LayerPurpose, check_sliding};
use super::suspension_inputs::SuspensionInputs;
use super::{others, similar, suspension};
use crate::case::{ParameterError, Parameters, Tier};
use crate::reference::bed_load::MeasuredBedLoad;
use crate::reference::one_dimension::bed_load::{Closures, STEADY, Stream};
use crate::setup::rules;

impl Parameters for BedLoad1dParameters {
    type Run = BedLoad1dRun;

    fn of_tier(tier: Tier) -> Self {
        let quick = Self {
            slopes: vec![0.02, 0.03, 0.05],
            gravity: 9.81,
            cell_height: 2.5e-4,
            steady_change: STEADY,
            fast_start: 2.0,
            dilating_cell_heights: vec![1e-3, 5e-4, 2.5e-4],
            frozen_cell_heights: vec![5e-4, 2.5e-4, 1.25e-4],
            water: WaterStream { depth: 0.046, density: 1000.0, kinematic_viscosity: 1e-6 },
            grains: BedGrains { bed_depth: 0.04, held_depth: 0.0, density: 2600.0, diameter: 5e-3, rest_diameter: 1.0 },
            closures: Closures::default(),
            sensitivities: Sensitivities::chosen(),
            similar: LayerConditions::NONE,
            onset: Onset::of(&[5e-4, 1e-3, 2e-3, 6e-3], GrainUnits::SHALLOW),
            measured: vec![MeasuredBedLoad::GrainSimulation, MeasuredBedLoad::SheetFlow],
            suspension: SuspensionInputs::quick(),
        };
        let paper = Self {
            dilating_cell_heights: vec![5e-4, 2.5e-4, 1.25e-4, 6.25e-5],
            frozen_cell_heights: vec![5e-4, 2.5e-4, 1.25e-4, 6.25e-5],
            sensitivities: Sensitivities::literature(),
            onset: Onset::of(&[5e-4, 1e-3, 2e-3, 3e-3, 5e-3, 6e-3], GrainUnits::DEEP),
            suspension: SuspensionInputs::literature(),
            ..quick.clone()
        };
        match tier {
            Tier::Quick => quick,
            Tier::Paper => paper,
            Tier::Fine => Self { cell_height: 6.25e-5, ..paper },
        }
    }

    fn check(&self) -> Result<(), ParameterError> {
        let grains = &self.grains;
        let remedy = "hold less than the whole bed, or 0 for none";
        rules::between("grains.held_depth", grains.held_depth, 0.0, 0.9 * grains.bed_depth, remedy)?;
        if grains.density <= self.water.density {
            let (rule, remedy) = ("greater than the density of the water", "grains that float are no bed load");
            return Err(ParameterError::field("grains.density", grains.density, rule, remedy));
        }
        rules::refuse("closures", self.closures.problem())?;
        self.cells("cell_height", self.cell_height)?;
        for (name, heights) in
            [("dilating_cell_heights", &self.dilating_cell_heights), ("frozen_cell_heights", &self.frozen_cell_heights)]
        {
            for (index, &height) in heights.iter().enumerate() {
                let field = format!("{name}[{index}]");
                self.cells(&field, height)?;
                if index > 0 && (heights[index - 1] / height - 2.0).abs() > 1e-6 {
                    let remedy = "the order compares means over two cells with one";
                    return Err(ParameterError::field(&field, height, "half the height before it", remedy));
                }
            }
        }
        for run in all(self).iter().filter(|run| run.purpose == LayerPurpose::Literature) {
            let place = self.slopes.iter().position(|slope| *slope == run.stream.slope).unwrap_or(0);
            check_sliding(&format!("slopes[{place}]"), run.stream.slope, run)?;
        }
        similar::check(self)?;
        suspension::check(&self.suspension)?;
        check_replacements(self)
    }

    fn runs(&self) -> Vec<BedLoad1dRun> {
        all(self)
    }
}

fn all(parameters: &BedLoad1dParameters) -> Vec<BedLoad1dRun> {
    let mut runs = Vec::new();
    for &slope in &parameters.slopes {
        let new = |purpose, closures, cell_height| BedLoad1dRun {
            purpose,
            stream: parameters.stream(slope),
            closures,
            cell_height,
            steady_change: parameters.steady_change,
        };
        let own = parameters.closures;
        runs.push(new(LayerPurpose::Literature, own, parameters.cell_height));
        if parameters.fast_start > 0.0 {
            runs.push(new(LayerPurpose::FastStart(parameters.fast_start), own, parameters.cell_height));
        }
        let at_rest = new(LayerPurpose::BedAtRest, own, parameters.cell_height);
        let grain_diameter = parameters.grains.rest_diameter * at_rest.stream.grain_diameter;
        runs.push(BedLoad1dRun { stream: Stream { grain_diameter, ..at_rest.stream }, ..at_rest });
        runs.extend(
            parameters.dilating_cell_heights.iter().map(|&height| new(LayerPurpose::DilatingOrder, own, height)),
        );
        runs.extend(parameters.frozen_cell_heights.iter().map(|&height| new(LayerPurpose::FrozenOrder, own, height)));
        runs.extend(parameters.sensitivities.all().into_iter().map(|replaced| {
            let (closures, cell_height) = replaced.apply(own, parameters.cell_height);
            new(LayerPurpose::Sensitivity(replaced), closures, cell_height)
        }));
    }
    runs.extend(similar::runs(parameters));
    runs.extend(others::runs(&parameters.measured, parameters.closures));
    let slopes: Vec<_> =
        parameters.slopes.iter().map(|slope| (parameters.stream(*slope), parameters.cell_height)).collect();
    runs.extend(suspension::runs(&parameters.suspension, &parameters.measured, &slopes, parameters.closures));
    runs
}

fn check_replacements(parameters: &BedLoad1dParameters) -> Result<(), ParameterError> {
    for replaced in parameters.sensitivities.all() {
        let (changed, cell_height) = replaced.apply(parameters.closures, parameters.cell_height);
        rules::refuse("sensitivities", changed.problem())?;
        parameters.cells("sensitivities.cell_height", cell_height)?;
    }
    Ok(())
}
