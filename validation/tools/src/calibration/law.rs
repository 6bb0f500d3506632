//! Laws that are fitted to points (I, μ) without a simulation: formulas of the inertial number, and the file of the law with its draws.

use super::objective::Objective;
use super::plan::{CalibrationPlan, DataBlock};
use super::result::{CalibrationResult, DatumComparison};
use super::target::{CURVE, Datum};
use crate::case::ParameterError;
use crate::evaluation::{EvaluationRecord, toml_number};
use crate::input::{FieldError, number_in};
use crate::number::short_digits;
use crate::output::Table;
use bagnold_harness::setup::rules;
use bagnold_solver::material::rheology::Rheology;
use toml::Value;

/// Pressures `[Pa]` at which a formula of I has one friction within rounding `[-]`, and inertial numbers of the test.
const PRESSURES: [f64; 2] = [1e3, 1e5];
const ROUNDING: f64 = 1e-9;
const TRIED: [f64; 3] = [1e-2, 0.1, 1.0];
/// Draws of the posterior that the file keeps.
const DRAWS: usize = 50;

impl DataBlock {
    /// Fields of the block's law with settings `path=value`.
    fn law_fields(&self, settings: &[String]) -> toml::Table {
        let mut table = self.request.with.clone();
        table.extend(toml::from_str::<toml::Table>(&settings.join("\n")).unwrap_or_default());
        table.insert("law".to_owned(), Value::String(self.request.case.clone()));
        table
    }

    /// Refuses points without shear: a law of the inertial number says nothing of them.
    pub(super) fn check_inertia(&self, data: &[Datum]) -> Result<(), FieldError> {
        let places = data.iter().filter(|_| self.is_law).filter_map(|datum| datum.target.place());
        places.map(|place| place.at).find(|at| *at <= 0.0).map_or(Ok(()), |at| {
            let field = format!("{}.data", self.field);
            Err(FieldError::new(&field, format!("I = {at}"), "positive", "leave out points without shear"))
        })
    }

    /// Friction `[-]` of the block's law over inertial number `[-]` and pressure `[Pa]`.
    fn friction(&self, settings: &[String]) -> Result<impl Fn(f64, f64) -> f64 + use<>, ParameterError> {
        let fields = self.law_fields(settings);
        let [diameter, density] =
            ["grain_diameter", "grain_density"].map(|name| fields.get(name).and_then(number_in).unwrap_or(1.0));
        let law: Rheology = Value::Table(fields).try_into().map_err(|error: toml::de::Error| {
            let unknown = format!("unknown variant `{}`", self.request.case);
            let (part, remedy) = match error.message().contains(&unknown) {
                true => ("law", "give one of these names"),
                false => ("with", "correct `with`, or the paths"),
            };
            ParameterError::from(FieldError::finding(&format!("{}.{part}", self.field), error.message(), remedy))
        })?;
        rules::material(&format!("{}.with", self.field), &law)?;
        if law.field().is_some() {
            return Err(self.no_formula());
        }
        Ok(move |inertia: f64, pressure: f64| {
            let rate = inertia * (pressure / density).sqrt() / diameter;
            law.viscosity(rate, pressure) * rate / pressure
        })
    }

    /// Refuses a law that is no formula of I, and parameters that it does not have.
    pub(super) fn check_law(&self, plan: &CalibrationPlan, settings: &[String]) -> Result<(), ParameterError> {
        if !plan.choices.is_empty() {
            let remedy = "fit each law in a plan of its own, and compare `fit error`";
            return Err(FieldError::finding("choices", "given beside a law", remedy).into());
        }
        let friction = self.friction(settings)?;
        let is_one = |inertia: &f64| {
            let [low, high] = PRESSURES.map(|pressure| friction(*inertia, pressure));
            (low - high).abs() <= ROUNDING * low.abs()
        };
        if TRIED.iter().all(is_one) { Ok(()) } else { Err(self.no_formula()) }
    }

    fn no_formula(&self) -> ParameterError {
        let rule = "a formula of the inertial number alone, such as mu-i";
        let remedy = "choose that, or fit a case that runs this law";
        FieldError::new(&format!("{}.law", self.field), &self.request.case, rule, remedy).into()
    }
}

impl Objective<'_> {
    /// Friction of a block's law at the inertial numbers of its data, as if a case had given it.
    pub(super) fn curve(&self, block: usize, settings: &[String]) -> EvaluationRecord {
        let law = &self.plan.blocks[block];
        let friction = match law.friction(settings) {
            Ok(friction) => friction,
            Err(error) => return EvaluationRecord::failed("", &law.request.case, &error.to_string()),
        };
        let own = self.data.iter().filter(|datum| datum.block == block).filter_map(|datum| datum.target.place());
        let rows = own.map(|place| vec![place.at, friction(place.at, PRESSURES[0])]);
        let table = Table::of_rows(CURVE[0].to_owned(), &CURVE[1..], rows);
        EvaluationRecord { tables: vec![table], failure: None, ..EvaluationRecord::failed("", &law.request.case, "") }
    }
}

/// Finding of a plateau that the data do not reach.
pub(super) fn beyond(plan: &CalibrationPlan, values: &[f64], fit: &[DatumComparison]) -> Option<String> {
    let of_law = fit.iter().filter_map(|datum| datum.at.as_ref()).filter(|at| at.table == CURVE[0]);
    let end = of_law.map(|at| at.at).fold(0.0, f64::max);
    let place = plan.parameters.iter().position(|own| own.path.name() == "reference_inertia")?;
    let (name, value) = (&plan.parameters[place].name, short_digits(values[place], 3));
    let text = format!("`{name}` = {value} lies beyond the data, which end at I = {}", short_digits(end, 3));
    (end > 0.0 && values[place] > end).then(|| text + ": the friction of fast flow is extrapolated")
}

/// The file of the first law that was fitted: the best values, and draws of the posterior; none where no law was.
pub(super) fn file(outcome: &CalibrationResult, plan: &CalibrationPlan) -> Option<String> {
    let block = plan.blocks.iter().find(|block| block.is_law)?;
    let best: Vec<f64> = outcome.parameters.iter().map(|found| found.best).collect();
    let fields = block.law_fields(&plan.settings(block, &best));
    let mut text = format!("# {}\n[material]\n{fields}", outcome.title.replace(['\n', '\r'], " "));
    for sample in outcome.samples.iter().step_by((outcome.samples.len() / DRAWS).max(1)).take(DRAWS) {
        let values = plan.parameters.iter().zip(sample);
        let lines = values.map(|(own, value)| format!("{} = {}\n", own.path.name(), toml_number(*value)));
        text += &format!("\n[[draws]]\n{}", lines.collect::<String>());
    }
    Some(text)
}
