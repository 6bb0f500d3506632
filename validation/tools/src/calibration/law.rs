//! Laws that are fitted to points (I, μ) without a simulation: formulas of the inertial number, and the file of the law with its draws.

use super::objective::Objective;
use super::plan::{CalibrationPlan, DataBlock};
use super::result::{CalibrationResult, DatumComparison};
use super::target::{CURVE, Datum};
use crate::case::ParameterError;
use crate::evaluation::{EvaluationRecord, toml_number};
use crate::figure::Figure;
use crate::input::{FieldError, number_in};
use crate::number::short_digits;
use crate::output::Table;
use crate::statistics::percentile;
use bagnold_harness::setup::rules;
use bagnold_solver::material::rheology::Rheology;
use toml::Value;

/// Pressures `[Pa]` at which a formula of I has one friction within rounding `[-]`, and inertial numbers of the test.
const PRESSURES: [f64; 2] = [1e3, 1e5];
const ROUNDING: f64 = 1e-9;
const TRIED: [f64; 3] = [1e-2, 0.1, 1.0];
/// Draws of the posterior that the file keeps, and of a drawn band.
const DRAWS: usize = 50;
const OF_BAND: usize = 400;
/// Points of a drawn law, and how far beyond the data it is drawn `[-]`.
const POINTS: usize = 80;
const BEYOND: f64 = 1.1;

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

/// Draws the law of the best values as a curve, with the 95 % of its draws, in the figures of its points: a formula is known everywhere.
pub(super) fn draw(figures: &mut [Figure], outcome: &CalibrationResult, plan: &CalibrationPlan) {
    let mut laws = plan.blocks.iter().filter(|block| block.is_law);
    let Some(block) = laws.next() else { return };
    // laws that differ have no common curve
    if laws.any(|other| (&other.request.case, &other.request.with) != (&block.request.case, &block.request.with)) {
        return;
    }
    let law = |values: &[f64]| block.friction(&plan.settings(block, values)).ok();
    let best: Vec<f64> = outcome.parameters.iter().map(|found| found.best).collect();
    let Some(best) = law(&best) else { return };
    let draws: Vec<_> = drawn(outcome, OF_BAND).filter_map(|values| law(values)).collect();
    for panel in figures.iter_mut().flat_map(|figure| &mut figure.panels).filter(|panel| panel.x.label == CURVE[1]) {
        let end = panel.series.iter().flat_map(|series| &series.points).map(|point| point.0).fold(0.0, f64::max);
        let at = (1..=POINTS).map(|k| BEYOND * end * k as f64 / POINTS as f64);
        for series in panel.series.iter_mut().filter(|series| series.label == "model") {
            series.points = at.clone().map(|inertia| (inertia, best(inertia, PRESSURES[0]))).collect();
        }
        for band in &mut panel.bands {
            let between = |inertia: f64| {
                let mut values: Vec<f64> = draws.iter().map(|law| law(inertia, PRESSURES[0])).collect();
                values.sort_by(f64::total_cmp);
                (inertia, percentile(&values, 0.025), percentile(&values, 0.975))
            };
            band.points = if draws.is_empty() { Vec::new() } else { at.clone().map(between).collect() };
        }
        (panel.x.label, panel.y.label) = ("I [-]".to_owned(), "μ [-]".to_owned());
    }
}

/// Draws of the posterior that stand for all.
fn drawn(outcome: &CalibrationResult, number: usize) -> impl Iterator<Item = &Vec<f64>> {
    outcome.samples.iter().step_by((outcome.samples.len() / number).max(1)).take(number)
}

/// The file of the first law that was fitted: the best values, and draws of the posterior; none where no law was.
pub(super) fn file(outcome: &CalibrationResult, plan: &CalibrationPlan) -> Option<String> {
    let block = plan.blocks.iter().find(|block| block.is_law)?;
    let best: Vec<f64> = outcome.parameters.iter().map(|found| found.best).collect();
    let fields = block.law_fields(&plan.settings(block, &best));
    let mut text = format!("# {}\n[material]\n{fields}", outcome.title.replace(['\n', '\r'], " "));
    for sample in drawn(outcome, DRAWS) {
        let values = plan.parameters.iter().zip(sample);
        let lines = values.map(|(own, value)| format!("{} = {}\n", own.path.name(), toml_number(*value)));
        text += &format!("\n[[draws]]\n{}", lines.collect::<String>());
    }
    Some(text)
}
