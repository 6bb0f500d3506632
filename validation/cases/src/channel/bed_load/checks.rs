//! What a case file may ask for.

use super::continuum::LAYER_CELL;
use super::parameters::{BedLoadParameters, GrainParticles, Stage};
use crate::case::ParameterError;
use crate::reference::one_dimension::bed_load::{Closures, MixingLengthClosure};
use crate::setup::rules;
use bagnold_solver::material::drag::DragLaw;
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::material::turbulence::VON_KARMAN;

impl BedLoadParameters {
    pub(super) fn check_combinations(&self) -> Result<(), ParameterError> {
        let materials = &self.materials;
        let lightest = 1.01 * materials.fluid_density;
        let remedy = "grains that float are no bed load";
        rules::between("materials.grain_density", materials.grain_density, lightest, 1e5, remedy)?;
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
        }
        if fit.slopes.len() < 3 && !fit.yield_stresses.is_empty() && !fit.viscosities.is_empty() {
            let (rule, remedy) = ("three or more", "two are fitted for each that is held out");
            return Err(ParameterError::field("fit.slopes", format!("{:?}", fit.slopes), rule, remedy));
        }
        if !fit.yield_stresses.is_empty() && !fit.viscosities.is_empty() {
            self.check_fitted_law()?;
        }
        check_time("fit", fit.duration, fit.averaging_time)
    }

    /// The fits are of one law.
    fn check_fitted_law(&self) -> Result<(), ParameterError> {
        if matches!(self.stabilised.material, Rheology::CoulombBingham(_)) {
            return Ok(());
        }
        let written = toml::Value::try_from(self.stabilised.material).ok();
        let name = written.as_ref().and_then(|law| law.get("law")?.as_str()).unwrap_or("another").to_owned();
        let rule = "coulomb-bingham with a grid of the fits";
        let remedy = "its yield stress and viscosity are fitted; or empty `fit.yield_stresses`";
        Err(ParameterError::field("stabilised.material.law", name, rule, remedy))
    }

    fn check_grains(&self, path: &str, grains: &GrainParticles) -> Result<(), ParameterError> {
        let field = |name: &str| format!("{path}.{name}");
        rules::material(&field("material"), &grains.material)?;
        if grains.drag == DragLaw::Ergun {
            let (rule, remedy) = ("a law of one grain", "Ergun's is one of packed grains; `continuum` has it");
            return Err(ParameterError::field(&field("drag"), "ergun", rule, remedy));
        }
        let diameter = self.materials.grain_diameter;
        for (name, length) in [("bed_depth", grains.bed_depth), ("length", grains.length)] {
            whole(&field(name), length, diameter, "of the grain diameter")?;
            whole(&field(name), length, grains.spacing, "of the spacing")?;
        }
        let remedy = "a fraction of a grain diameter; it lies within the bed";
        rules::between(&field("origin_offset"), grains.origin_offset, 0.0, grains.bed_depth, remedy)?;
        let least = 4.8 * diameter;
        rules::between(&field("length"), grains.length, least, 10.0, "the period must hold twice the grains' kernel")?;
        whole("materials.depth", self.materials.depth, grains.spacing, "of the spacing of every formulation")?;
        let remedy = "it must hold grains and reach less than a quarter of the period";
        let most = 0.25 * grains.length;
        rules::between(&field("drag_smoothing_length"), grains.drag_smoothing_length, 1e-4, most, remedy)?;
        check_time(path, grains.duration, grains.averaging_time)?;
        rules::projection(&field("numerics"), &grains.numerics)
    }

    fn check_continuum(&self) -> Result<(), ParameterError> {
        let continuum = &self.continuum;
        let remedy = "hold less than the whole bed";
        rules::between("continuum.held_depth", continuum.held_depth, 0.0, 0.9 * continuum.bed_depth, remedy)?;
        rules::refuse("continuum.closures", continuum.closures.problem())?;
        let Closures { mixing_length, karman, turbulent_schmidt, .. } = continuum.closures;
        if mixing_length != MixingLengthClosure::Integral {
            let remedy = "the particles know no other; bed-load-1d compares all";
            let given = format!("{mixing_length:?}").to_lowercase();
            return Err(ParameterError::field("continuum.closures.mixing_length", given, "integral", remedy));
        }
        let others = continuum.runs.iter().any(|runs| runs.stage != Stage::Dilating);
        if turbulent_schmidt != 0.0 && others {
            let (rule, remedy) = ("0 unless all runs are `dilating`", "eddies carry no grains of a given fraction");
            return Err(ParameterError::field("continuum.closures.turbulent_schmidt", turbulent_schmidt, rule, remedy));
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
            for (place, &spacing) in runs.spacings.iter().enumerate() {
                let field = format!("{path}.spacings[{place}]");
                let remedy = "0.001 for 1 mm; the period must hold 7";
                rules::between(&field, spacing, 1e-4, continuum.length / 7.2, remedy)?;
            }
            if runs.stage == Stage::Dilating && !runs.pair_laws.is_empty() {
                let given = format!("{:?}", runs.pair_laws);
                let (rule, remedy) = ("empty where grains dilate", "they have columns instead of pairs");
                return Err(ParameterError::field(&format!("{path}.pair_laws"), given, rule, remedy));
            }
            check_time(&path, runs.duration, runs.averaging_time)?;
        }
        rules::projection("continuum.numerics", &continuum.numerics)
    }
}

fn check_time(path: &str, duration: f64, averaging_time: f64) -> Result<(), ParameterError> {
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
