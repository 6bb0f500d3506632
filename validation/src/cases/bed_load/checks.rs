//! What a case file may ask for.

use super::parameters::{BedLoadParameters, Grains, Materials, Yield};
use super::runs::LAYER_CELL;
use crate::case::ParameterError;
use crate::cases::{bed_load_1d, rules};
use crate::reference::bed_load_layer::{Closures, MixingLength};
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::material::turbulence::VON_KARMAN;

impl BedLoadParameters {
    pub(super) fn check(&self) -> Result<(), ParameterError> {
        let Materials { depth, gravity, fluid_density, kinematic_viscosity, grain_density, grain_diameter } =
            self.materials;
        rules::positive("materials.depth", depth, "give it in metres, such as 0.046")?;
        rules::positive("materials.gravity", gravity, "give it in m/s², such as 9.81")?;
        rules::positive("materials.fluid_density", fluid_density, "give it in kg/m³, such as 1000")?;
        rules::positive("materials.kinematic_viscosity", kinematic_viscosity, "give it in m²/s; water has 1e-6")?;
        rules::positive("materials.grain_diameter", grain_diameter, "give it in metres; 0.005 for 5 mm")?;
        let remedy = "grains that float are no bed load";
        rules::between("materials.grain_density", grain_density, 1.01 * fluid_density, 1e5, remedy)?;
        rules::between("jitter", self.jitter, 0.0, 0.5, "0.001 breaks the lattice without waves")?;
        for (path, grains) in [("paper", &self.paper), ("stabilised", &self.stabilised)] {
            self.check_grains(path, grains)?;
        }
        self.check_continuum()?;
        let fit = &self.fit;
        for (field, values) in [("fit.yield_stresses", &fit.yield_stresses), ("fit.viscosities", &fit.viscosities)] {
            if !values.is_empty() && (values.len() < 2 || !values.is_sorted_by(|a, b| a < b)) {
                let shown = format!("{values:?}");
                let (rule, remedy) = ("empty or two or more rising values", "the fits interpolate between them");
                return Err(ParameterError::field(field, shown, rule, remedy));
            }
            for (index, &value) in values.iter().enumerate() {
                rules::positive(&format!("{field}[{index}]"), value, "give it in Pa or Pa·s")?;
            }
        }
        check_slopes("fit.slopes", &fit.slopes)?;
        if fit.slopes.len() < 3 && !fit.yield_stresses.is_empty() && !fit.viscosities.is_empty() {
            let (rule, remedy) = ("three or more", "two are fitted for each that is held out");
            return Err(ParameterError::field("fit.slopes", format!("{:?}", fit.slopes), rule, remedy));
        }
        check_time("fit", fit.duration, fit.averaging_time)
    }

    fn check_grains(&self, path: &str, grains: &Grains) -> Result<(), ParameterError> {
        let field = |name: &str| format!("{path}.{name}");
        check_slopes(&field("slopes"), &grains.slopes)?;
        let Yield { yield_stress, viscosity, regularisation_rate, largest_viscosity } = grains.material;
        rules::between(&field("material.yield_stress"), yield_stress, 0.0, 1e6, "give it in Pa, or 0 for none")?;
        rules::between(&field("material.viscosity"), viscosity, 0.0, 1e4, "give it in Pa·s, or 0 for none")?;
        let remedy = "give it in 1/s, well below the bed's rates, such as 0.01";
        rules::positive(&field("material.regularisation_rate"), regularisation_rate, remedy)?;
        let remedy = "give it in Pa·s, such as 1e4";
        rules::positive(&field("material.largest_viscosity"), largest_viscosity, remedy)?;
        rules::between(&field("overburden_friction"), grains.overburden_friction, 0.0, 2.0, "0.6 for sand and gravel")?;
        grains.turbulence.check(&field("turbulence"))?;
        if grains.drag == DragLaw::Ergun {
            let (rule, remedy) = ("a law of one grain", "Ergun's is one of packed grains; `continuum` has it");
            return Err(ParameterError::field(&field("drag"), "ergun", rule, remedy));
        }
        rules::between(&field("drag_factor"), grains.drag_factor, 0.0, 10.0, "1 is the drag law's")?;
        rules::positive(&field("spacing"), grains.spacing, "give it in metres; 0.002 for the paper's")?;
        let diameter = self.materials.grain_diameter;
        whole(&field("bed_depth"), grains.bed_depth, diameter, "of the grain diameter")?;
        whole(&field("bed_depth"), grains.bed_depth, grains.spacing, "of the spacing")?;
        whole(&field("length"), grains.length, diameter, "of the grain diameter")?;
        whole(&field("length"), grains.length, grains.spacing, "of the spacing")?;
        let least = 4.8 * diameter;
        rules::between(&field("length"), grains.length, least, 10.0, "the period must hold twice the grains' kernel")?;
        whole("materials.depth", self.materials.depth, grains.spacing, "of the spacing of every formulation")?;
        let remedy = "it must hold grains and reach less than a quarter of the period";
        rules::between(
            &field("drag_smoothing_length"),
            grains.drag_smoothing_length,
            1e-4,
            0.25 * grains.length,
            remedy,
        )?;
        check_time(path, grains.duration, grains.averaging_time)?;
        rules::projection(&field("numerics"), &grains.numerics)
    }

    fn check_continuum(&self) -> Result<(), ParameterError> {
        let continuum = &self.continuum;
        rules::positive("continuum.bed_depth", continuum.bed_depth, "give it in metres, such as 0.016")?;
        let remedy = "hold less than the whole bed";
        rules::between("continuum.held_depth", continuum.held_depth, 0.0, 0.9 * continuum.bed_depth, remedy)?;
        rules::between("continuum.smoothing_ratio", continuum.smoothing_ratio, 1.0, 3.0, "1.5 for dilating sediment")?;
        rules::between("continuum.sediment_jitter", continuum.sediment_jitter, 0.0, 0.5, "0.3 breaks the rows")?;
        rules::between(
            "continuum.least_fraction",
            continuum.least_fraction,
            1e-6,
            0.1,
            "0.002 leaves no row half empty",
        )?;
        rules::law("continuum.pressure_bounds", continuum.pressure_bounds.parameter_problem())?;
        bed_load_1d::closures("continuum.closures", &continuum.closures)?;
        let Closures { mixing_length, karman, .. } = continuum.closures;
        if mixing_length != MixingLength::Integral {
            let remedy = "the particles know no other; bed-load-1d compares all";
            let given = format!("{mixing_length:?}").to_lowercase();
            return Err(ParameterError::field("continuum.closures.mixing_length", given, "integral", remedy));
        }
        if karman != VON_KARMAN {
            let remedy = "the particles know no other; bed-load-1d takes any";
            return Err(ParameterError::field("continuum.closures.karman", karman, &VON_KARMAN.to_string(), remedy));
        }
        for (name, length) in [
            ("materials.depth", self.materials.depth),
            ("continuum.bed_depth", continuum.bed_depth),
            ("continuum.held_depth", continuum.held_depth),
        ] {
            if length > 0.0 && !continuum.runs.is_empty() {
                whole(name, length, LAYER_CELL, "of a cell of the 1-D layer")?;
            }
        }
        for (index, runs) in continuum.runs.iter().enumerate() {
            let path = format!("continuum.runs[{index}]");
            check_slopes(&format!("{path}.slopes"), &runs.slopes)?;
            for (place, &spacing) in runs.spacings.iter().enumerate() {
                let field = format!("{path}.spacings[{place}]");
                rules::between(
                    &field,
                    spacing,
                    1e-4,
                    continuum.length / 7.2,
                    "0.001 for 1 mm; the period must hold 7",
                )?;
            }
            for (place, &start) in runs.starts.iter().enumerate() {
                rules::between(&format!("{path}.starts[{place}]"), start, 0.0, 3.0, "1 starts as the 1-D layer flows")?;
            }
            check_time(&path, runs.duration, runs.averaging_time)?;
        }
        rules::projection("continuum.numerics", &continuum.numerics)
    }
}

fn check_slopes(field: &str, slopes: &[f64]) -> Result<(), ParameterError> {
    slopes.iter().enumerate().try_for_each(|(index, &slope)| rules::driving_slope(&format!("{field}[{index}]"), slope))
}

fn check_time(path: &str, duration: f64, averaging_time: f64) -> Result<(), ParameterError> {
    rules::between(&format!("{path}.duration"), duration, 0.1, 1e4, "a few seconds, more to be stationary")?;
    let field = format!("{path}.averaging_time");
    rules::between(&field, averaging_time, 0.05, duration, "the window lies within the run")
}

/// A length that is a whole multiple of another.
fn whole(field: &str, length: f64, part: f64, of: &str) -> Result<(), ParameterError> {
    let parts = length / part;
    if parts >= 0.99 && (parts - parts.round()).abs() < 1e-6 * parts.max(1.0) && parts < 1e4 {
        return Ok(());
    }
    let rule = format!("a whole multiple {of}, {part} m");
    Err(ParameterError::field(field, length, &rule, "choose lengths that divide each other"))
}
