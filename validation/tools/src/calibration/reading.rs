//! Reading a calibration: its text, then its cases and data.

use super::conditions::{self, BlockParameters};
use super::plan::CalibrationPlan;
use super::text::CalibrationText;
use crate::ToolError;
use crate::case::{Limits, Registry};
use crate::evaluation::read_plan;
use crate::input::FieldError;
use crate::measured::read_overlay;
use crate::store::Store;
use std::collections::BTreeMap;
use std::path::Path;

impl CalibrationPlan {
    /// Reads and checks a file.
    ///
    /// # Errors
    /// A file that cannot be read or typed, ranges that break a rule, a case or a path that does not exist, a run that is
    /// in both fit and hold-out.
    pub fn read(file: &Path, registry: Registry, limits: Limits) -> Result<Self, ToolError> {
        let text: CalibrationText = read_plan(file, "bagnold calibrate")?;
        let mut plan = text.checked(file, limits).map_err(|error| error.in_file(file))?;
        for block in plan.blocks.iter_mut().filter(|block| !block.is_law) {
            block.request = block.request.clone().based(file).map_err(|error| error.in_file(file))?;
        }
        plan.check_cases(registry)?;
        plan.check_data()?;
        Ok(plan)
    }

    /// The data's files are read before the folder of the calibration is touched, so that a bad one leaves nothing behind.
    fn check_data(&self) -> Result<(), ToolError> {
        for block in &self.blocks {
            for text in &block.data {
                let data = text.read(0, &self.file)?;
                block.check_inertia(&data).map_err(|error| error.in_file(&self.file))?;
            }
        }
        Ok(())
    }

    fn check_cases(&self, registry: Registry) -> Result<(), ToolError> {
        self.check_names().map_err(|error| error.in_file(&self.file))?;
        let start: Vec<f64> = self.parameters.iter().map(|parameter| parameter.start).collect();
        let store = Store::open(crate::store::StorePolicy::Use);
        let mut fitted: BTreeMap<String, String> = BTreeMap::new();
        let mut known = Vec::new();
        for block in &self.blocks {
            if block.is_law {
                block.check_law(self, &self.settings(block, &start)).map_err(|error| error.in_plan(&self.file))?;
                continue;
            }
            let settings = self.settings(block, &start);
            if settings.is_empty() && self.choices.is_empty() {
                let remedy = "add a parameter with a path of this case, or leave the case out";
                let field = format!("{}.case", block.field);
                return Err(FieldError::new(&field, &block.request.case, "a case with a calibrated parameter", remedy)
                    .in_file(&self.file)
                    .into());
            }
            let prepare = |settings: &[String]| {
                let prepared = block.request.prepare(registry, &self.file, settings, self.limits);
                prepared.map_err(|error| error.of_block(&block.field).in_plan(&self.file))
            };
            for choice in &self.choices {
                prepare(&choice.in_case(&block.request.case))?;
            }
            let mut first = self.choices.first().map_or(settings, |choice| choice.in_case(&block.request.case));
            let mut prepared = prepare(&first)?;
            if let Some(path) = self.repeats.path_in(&block.request.case) {
                first.push(format!("{path}=1"));
                prepared = prepare(&first)
                    .map_err(|_| self.repeats.seedless(&block.request.case, path).in_file(&self.file))?;
            }
            read_overlay(prepared.as_ref(), &block.request.overlay, &[])?;
            if let Some(outline) = prepared.outline() {
                let mut places = block.data.iter().filter_map(|text| text.target(0.0).place());
                places.try_for_each(|place| place.found(&outline.tables).map(drop)).map_err(|reason| {
                    ToolError::at(&self.file, format!("`{}`: the case gives {reason}", block.field))
                })?;
            }
            for run in 0..prepared.run_count() {
                let Some(identity) = prepared.identity(run, &store) else { continue };
                if !block.held_out {
                    fitted.insert(identity, block.field.clone());
                } else if let Some(field) = fitted.get(&identity) {
                    let run = format!("{} {}", prepared.name(), prepared.variant(run));
                    let both = format!("the run `{}` is in both `{field}` and `{}`", run.trim_end(), block.field);
                    let remedy = "remove it from one: held-out data must not be fitted";
                    return Err(ToolError::at(&self.file, format!("{both}; {remedy}")));
                }
            }
            // what the program itself wrote can be read
            let parameters = toml::from_str(prepared.parameters_toml()).unwrap_or_default();
            known.push(BlockParameters { block, parameters });
        }
        conditions::check(self, &known)
    }
}
