//! Conditions of held-out data, which must differ in their physics from those of fitted data: another slope, another aspect
//! ratio, not another cell.
//!
//! A block that is held out names the parameters that make its conditions (`conditions`). It is refused where all of them
//! have a value that a fitted block of the same case has too, within a tolerance (`same_within`).

use super::plan::{CalibrationPlan, DataBlock};
use crate::ToolError;
use crate::case::list::ListedChange;
use crate::case::{ListOfRuns, leaves};
use crate::input::{FieldError, did_you_mean, nearest, number_in};
use toml::Value;

/// The parameters of a block's case, all of them.
pub(super) struct BlockParameters<'a> {
    pub(super) block: &'a DataBlock,
    pub(super) parameters: toml::Table,
}

impl BlockParameters<'_> {
    /// The numbers that the runs have at a dotted path.
    fn numbers(&self, path: &str, plan: &CalibrationPlan) -> Result<Vec<f64>, ToolError> {
        let base = Value::Table(self.parameters.clone());
        // a case without a list of runs has one change, of nothing
        let list: ListOfRuns = base.clone().try_into().unwrap_or_default();
        let of_run = |change: ListedChange| {
            let given = |(_, own, value): &(String, String, Value)| match path.strip_prefix(own.as_str())? {
                "" => Some(value.clone()),
                rest => value_at(value, rest.strip_prefix('.')?).cloned(),
            };
            change.values.iter().rev().find_map(given).or_else(|| value_at(&base, path).cloned())
        };
        let Some(values) = list.changes().into_iter().map(of_run).collect::<Option<Vec<Value>>>() else {
            let paths = leaves(&self.parameters);
            let guess = did_you_mean(&nearest(path, paths.iter().map(String::as_str)));
            let remedy = format!("{guess}`bagnold show {}` prints all fields", self.block.request.case);
            return Err(FieldError::finding(path, "unknown field", &remedy).in_file(&plan.file).into());
        };
        let numbers = values.iter().flat_map(|value| match value {
            Value::Array(list) => list.iter().map(number_in).collect(),
            one => vec![number_in(one)],
        });
        numbers.collect::<Option<Vec<f64>>>().ok_or_else(|| {
            let field = format!("{}.conditions", self.block.field);
            let remedy = "name a numerical parameter, such as `slope_angle`";
            FieldError::new(&field, path, "a number or a list of numbers of the case", remedy)
                .in_file(&plan.file)
                .into()
        })
    }
}

/// The value at a dotted path.
fn value_at<'a>(value: &'a Value, path: &str) -> Option<&'a Value> {
    path.split('.').try_fold(value, |value, key| value.get(key))
}

/// Refuses a block that is held out if its conditions are those of a fitted one.
pub(super) fn check(plan: &CalibrationPlan, known: &[BlockParameters<'_>]) -> Result<(), ToolError> {
    for held_out in known.iter().filter(|known| known.block.held_out) {
        let case = &held_out.block.request.case;
        for fitted in known.iter().filter(|known| !known.block.held_out && known.block.request.case == *case) {
            let Some(conditions) = &held_out.block.conditions else {
                let field = format!("{}.conditions", held_out.block.field);
                let remedy = "name the parameters that differ from the fit, such as conditions = [\"slope_angle\"]";
                let rule = format!("given, because `{}` has the same case", fitted.block.field);
                return Err(FieldError::new(&field, "missing", &rule, remedy).in_file(&plan.file).into());
            };
            let (mut same, same_within) = (Vec::new(), held_out.block.same_within);
            for path in conditions {
                let (here, there) = (held_out.numbers(path, plan)?, fitted.numbers(path, plan)?);
                let pair = here.iter().flat_map(|a| there.iter().map(move |b| (*a, *b)));
                let close = |(a, b): &(f64, f64)| (a - b).abs() <= same_within * a.abs().max(b.abs());
                same.extend(pair.clone().find(close).map(|(a, b)| format!("{path} {a} and {b}")));
            }
            if same.len() == conditions.len() {
                let (here, there, percent) = (&held_out.block.field, &fitted.block.field, 100.0 * same_within);
                let same = format!("{}: the same within {percent} %", same.join(", "));
                let remedy = "hold out data of other conditions";
                let reason = format!("`{here}` has the conditions of `{there}` ({same}); {remedy}");
                return Err(ToolError::at(&plan.file, reason));
            }
        }
    }
    Ok(())
}
