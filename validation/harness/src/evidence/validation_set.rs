//! The validation set: every comparison of the baseline with a measurement or a published fit, with the regime of its flow, which
//! `tests/snapshots/comparisons/TIER.csv` holds. Bias and scatter over it predict how far a value of the user's own is off.

use super::StatedUncertainty;
use crate::metric::{ComparisonPart, FlowRegime, Metric, PredictionInterval, REGIME_NUMBERS, Variant};
use crate::number::two_digits;
use crate::output::csv_text;
use crate::statistics::{Comparison, ModelBias, model_bias};
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

include!(concat!(env!("OUT_DIR"), "/comparisons.rs"));

/// Quantities that are the distance of a front from its start.
pub const WAY_OF_FRONT: [&str; 2] = ["run_out", "front_displacement"];

/// One comparison of a prediction with a reference.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ValidatedComparison {
    /// Name of the case.
    pub case: String,
    /// Name of the metric.
    pub quantity: String,
    /// Variant of the compared run.
    pub variant: Variant,
    /// Unit of value and reference.
    pub unit: String,
    /// The baseline value.
    pub value: f64,
    /// The reference's.
    pub reference: f64,
    /// u_val, as far as it is known.
    pub uncertainty: Option<f64>,
    /// Relative standard uncertainty of the reference `[-]`, where it is known.
    pub reference_uncertainty: Option<f64>,
    /// The same by the inputs.
    pub input_uncertainty: Option<f64>,
    /// a `[-]`.
    pub aspect_ratio: Option<f64>,
    /// θ `[°]`.
    pub slope_angle: Option<f64>,
    /// I `[-]`.
    pub inertial_number: Option<f64>,
    /// D/h `[-]`.
    pub grain_ratio: Option<f64>,
}

impl ValidatedComparison {
    /// That of a metric, with the regime of the run that it speaks of; none for what is not compared.
    fn of(case: &str, metric: &Metric, runs: &[(Variant, FlowRegime)]) -> Option<Self> {
        let reference = metric.compared_with().filter(|_| metric.value.is_finite())?;
        // the run that shares most with it: a run of which it shares nothing is not its own
        let shared = |run: &Variant| run.parts().filter(|(key, _)| metric.variant.get(key).is_some()).count();
        let is_own =
            |(run, _): &&(Variant, FlowRegime)| metric.variant.concerns(run) && (shared(run) > 0 || run.is_empty());
        let own = runs.iter().rev().filter(is_own).max_by_key(|(run, _)| shared(run));
        let regime = own.map(|(_, regime)| *regime).unwrap_or_default();
        let relative = |standard: f64| standard / reference.abs();
        Some(Self {
            case: case.to_owned(),
            quantity: metric.name.clone(),
            variant: metric.variant.clone(),
            unit: metric.unit.clone(),
            value: metric.value,
            reference,
            uncertainty: metric.uncertainty.standard(),
            reference_uncertainty: metric.uncertainty.of_part(ComparisonPart::Reference).map(relative),
            input_uncertainty: metric.uncertainty.of_part(ComparisonPart::Input).map(relative),
            aspect_ratio: regime.aspect_ratio,
            slope_angle: regime.slope_angle,
            inertial_number: regime.inertial_number,
            grain_ratio: regime.grain_ratio,
        })
    }

    /// All numbers of a case.
    pub fn all(case: &str, metrics: &[Metric], runs: &[(Variant, FlowRegime)]) -> Vec<Self> {
        metrics.iter().filter_map(|metric| Self::of(case, metric, runs)).collect()
    }

    /// The regime of its flow.
    pub const fn regime(&self) -> FlowRegime {
        FlowRegime {
            aspect_ratio: self.aspect_ratio,
            slope_angle: self.slope_angle,
            inertial_number: self.inertial_number,
            grain_ratio: self.grain_ratio,
        }
    }

    /// Whether it is there to show what an input does, and is no comparison of its own.
    fn is_altered(&self) -> bool {
        StatedUncertainty::of(&self.case).is_some_and(|stated| stated.is_altered(&self.variant))
    }

    fn comparison(&self) -> Option<Comparison> {
        let has_ratio = self.value > 0.0 && self.reference > 0.0;
        let uncertainty = self.reference_uncertainty.filter(|uncertainty| uncertainty.is_finite());
        has_ratio.then_some(Comparison { predicted: self.value, measured: self.reference, uncertainty })
    }
}

/// Comparisons of a tier.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ValidationSet {
    /// Case by case.
    pub comparisons: Vec<ValidatedComparison>,
}

static SHIPPED: LazyLock<ValidationSet> = LazyLock::new(|| {
    let text = FILES.iter().find(|(name, _)| *name == "quick.csv").map_or("", |(_, text)| *text);
    ValidationSet::parse(text).unwrap_or_else(|error| panic!("failed to read the comparisons of the baseline: {error}"))
});

impl ValidationSet {
    /// The one of the quick tier, which the program carries.
    ///
    /// # Panics
    /// If it is malformed, which a test would find.
    pub fn shipped() -> &'static Self {
        &SHIPPED
    }

    /// Reads a table.
    ///
    /// # Errors
    /// A row that is malformed.
    pub fn parse(text: &str) -> Result<Self, csv::Error> {
        let rows = csv::Reader::from_reader(text.as_bytes()).into_deserialize().collect::<Result<_, _>>()?;
        Ok(Self { comparisons: rows })
    }

    /// Text.
    ///
    /// # Errors
    /// A row that cannot be written.
    pub fn text(&self) -> Result<String, csv::Error> {
        csv_text(&self.comparisons)
    }

    /// Replaces the comparisons of a case; cases stand in alphabetical order.
    pub fn replace(&mut self, case: &str, own: Vec<ValidatedComparison>) {
        self.comparisons.retain(|row| row.case != case);
        self.comparisons.extend(own);
        self.comparisons.sort_by(|a, b| a.case.cmp(&b.case));
    }

    /// The comparisons of some quantities.
    pub fn of<'s>(&'s self, quantities: &'s [&str]) -> impl Iterator<Item = &'s ValidatedComparison> + Clone {
        self.comparisons.iter().filter(|row| quantities.contains(&row.quantity.as_str()))
    }

    /// Those that do not show the effect of an input.
    fn own<'s>(&'s self, quantities: &'s [&str]) -> impl Iterator<Item = &'s ValidatedComparison> {
        self.of(quantities).filter(|row| !row.is_altered())
    }

    /// Number of comparisons of some quantities, without those that show the effect of an input.
    pub fn number(&self, quantities: &[&str]) -> usize {
        self.own(quantities).count()
    }

    /// Prediction over reference of the comparisons that bias and scatter rest on.
    pub fn ratios<'s>(&'s self, quantities: &'s [&str]) -> impl Iterator<Item = (&'s ValidatedComparison, f64)> {
        self.own(quantities).filter_map(|row| Some((row, row.comparison()?.predicted / row.reference)))
    }

    /// Bias and scatter of some quantities; none with fewer than three comparisons. What is there to show what an input does is no
    /// comparison of its own: it would count an experiment several times, and its inputs as the model's scatter.
    pub fn bias(&self, quantities: &[&str]) -> Option<ModelBias> {
        model_bias(&self.own(quantities).filter_map(ValidatedComparison::comparison).collect::<Vec<_>>())
    }

    /// Root mean square of the relative standard uncertainties by the inputs of these comparisons, where they are known `[-]`.
    pub fn input_uncertainty(&self, quantities: &[&str]) -> Option<f64> {
        let own = self.own(quantities).filter(|row| row.comparison().is_some());
        let squares: Vec<f64> = own.filter_map(|row| row.input_uncertainty).map(|own| own * own).collect();
        (!squares.is_empty()).then(|| (squares.iter().sum::<f64>() / squares.len() as f64).sqrt())
    }

    /// Bounds of prediction over true value of a further flow with 95 % confidence `[-]`. The comparisons of an experiment have its
    /// inputs in common, so that an error of those moves all of them and no scatter shows it; a further flow has inputs of its own, known no
    /// better, and they come beside the scatter.
    pub fn next_ratio(&self, quantities: &[&str]) -> Option<(f64, f64)> {
        let bias = self.bias(quantities)?;
        Some(bias.next_ratio_beside(self.input_uncertainty(quantities).unwrap_or(0.0)))
    }

    /// Least and greatest of each number of the regime among the comparisons of some quantities.
    pub fn ranges(&self, quantities: &[&str]) -> [Option<(f64, f64)>; 4] {
        let range = |place: usize| {
            let known = self.of(quantities).filter_map(|row| row.regime().numbers()[place]);
            known.fold(None, |range: Option<(f64, f64)>, value| {
                Some(range.map_or((value, value), |(low, high)| (low.min(value), high.max(value))))
            })
        };
        [0, 1, 2, 3].map(range)
    }

    /// 95 % prediction interval of the true value for a predicted `value`, from the comparisons of some quantities;
    /// none if there are too few.
    pub fn predict(&self, quantities: &[&str], regime: FlowRegime, value: f64) -> Option<PredictionInterval> {
        let bias = self.bias(quantities)?;
        let (least, most) = self.next_ratio(quantities)?;
        let outside = |place: usize| {
            let name = REGIME_NUMBERS[place];
            match (regime.numbers()[place], self.ranges(quantities)[place]) {
                (Some(own), Some((low, high))) if (low..=high).contains(&own) => None,
                (Some(own), Some((low, high))) => {
                    let [own, low, high] = [own, low, high].map(two_digits);
                    Some(format!("{name} = {own} lies outside of what was validated, {low} to {high}"))
                }
                (Some(own), None) => {
                    Some(format!("{name} = {} is known of nothing that was validated", two_digits(own)))
                }
                (None, Some(_)) => Some(format!("{name} is not known of this flow")),
                (None, None) => None,
            }
        };
        Some(PredictionInterval {
            lower: value / most,
            upper: value / least,
            comparisons: bias.comparisons,
            input_uncertainty: self.input_uncertainty(quantities),
            unit_length: None,
            quantity: quantities.join(", "),
            regime,
            warnings: (0..REGIME_NUMBERS.len()).filter_map(outside).collect(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::{Confidence, MetricKind};

    fn compared(a: f64, value: f64) -> Metric {
        Metric::observed("run_out", &Variant::of("a", a), value, "-").of_kind(MetricKind::Validation).against(
            Some(1.0),
            "an experiment",
            Confidence::High,
        )
    }

    fn set() -> ValidationSet {
        let values = [(1.0, 1.1), (2.0, 1.2), (3.0, 1.0), (4.0, 1.1)];
        let metrics = values.map(|(a, value)| compared(a, value));
        let runs = values.map(|(a, _)| {
            (Variant::of("a", a), FlowRegime { aspect_ratio: Some(a), slope_angle: Some(0.0), ..FlowRegime::default() })
        });
        ValidationSet { comparisons: ValidatedComparison::all("column", &metrics, &runs) }
    }

    #[test]
    fn a_set_is_read_as_it_was_written_and_a_case_replaces_its_own_rows() {
        let mut set = set();
        assert_eq!(ValidationSet::parse(&set.text().expect("writable")).expect("readable"), set);
        let other = ValidatedComparison { case: "a-case".to_owned(), ..set.comparisons[0].clone() };
        set.replace("a-case", vec![other]);
        set.replace("column", vec![set.comparisons[2].clone()]);
        let cases: Vec<&str> = set.comparisons.iter().map(|row| row.case.as_str()).collect();
        assert_eq!(cases, ["a-case", "column"]);
    }

    #[test]
    fn a_comparison_has_the_regime_of_the_run_that_it_speaks_of() {
        let regime = |a| FlowRegime { aspect_ratio: Some(a), ..FlowRegime::default() };
        let run = |text: &str| text.parse::<Variant>().expect("a variant");
        let runs = [(run("slope=0.02"), regime(1.0)), (run("a=2,seed=1"), regime(2.0)), (run("a=2"), regime(3.0))];
        let of = |metric: &Metric| ValidatedComparison::of("case", metric, &runs).expect("compared").aspect_ratio;
        assert_eq!(of(&compared(2.0, 1.1)), Some(2.0));
        assert_eq!(of(&compared(5.0, 1.1)), None);
    }

    #[test]
    fn the_interval_holds_what_was_measured_and_says_where_it_extrapolates() {
        let set = set();
        let known = FlowRegime { aspect_ratio: Some(2.5), slope_angle: Some(0.0), ..FlowRegime::default() };
        let found = set.predict(&["run_out"], known, 2.0).expect("four comparisons");
        // predictions are 10 % too long on average: the truth lies below them
        assert!(found.lower < 2.0 / 1.2 && found.upper > 2.0 && found.lower > 1.0, "{found:?}");
        assert!((found.lower * found.upper).sqrt() < 1.9);
        assert_eq!((found.comparisons, found.warnings.len()), (4, 0));
        let tall = FlowRegime { aspect_ratio: Some(9.0), slope_angle: None, ..known };
        let found = set.predict(&["run_out"], tall, 2.0).expect("four comparisons");
        assert!(found.warnings[0].starts_with("a = h/r = 9 lies outside"), "{:?}", found.warnings);
        assert!(found.warnings[1].starts_with("θ [°] is not known"), "{:?}", found.warnings);
        let of_grains = FlowRegime { grain_ratio: Some(0.01), ..known };
        let found = set.predict(&["run_out"], of_grains, 2.0).expect("four comparisons");
        assert_eq!(found.warnings, ["D/h = 0.01 is known of nothing that was validated"]);
        assert_eq!(set.predict(&["height"], known, 2.0), None);
    }

    #[test]
    fn inputs_that_an_experiment_has_in_common_widen_the_interval() {
        let regime = FlowRegime::default();
        let (mut known, narrow) = (set(), set().predict(&["run_out"], regime, 2.0).expect("four comparisons"));
        known.comparisons.iter_mut().for_each(|row| row.input_uncertainty = Some(0.1));
        let wide = known.predict(&["run_out"], regime, 2.0).expect("four comparisons");
        assert_eq!((narrow.input_uncertainty, wide.comparisons), (None, 4));
        assert!(wide.input_uncertainty.is_some_and(|inputs| (inputs - 0.1).abs() < 1e-12));
        let reach = |found: &PredictionInterval| libm::log(found.upper / found.lower);
        // t of three degrees of freedom: the reach of the inputs alone is 3.182 times their uncertainty to either side
        let alone = 2.0 * 3.182_446 * 0.1;
        assert!((reach(&wide) - reach(&narrow).hypot(alone)).abs() < 1e-5, "{} {}", reach(&wide), reach(&narrow));
    }

    #[test]
    fn a_pile_that_shows_what_an_input_does_is_no_comparison_of_its_own() {
        let with = |material: &str| {
            let mut set = set();
            let mut pile = ValidatedComparison { case: "column-planar".to_owned(), ..set.comparisons[0].clone() };
            pile.variant = Variant::of("material", material);
            pile.value = 3.0;
            set.replace("column-planar", vec![pile]);
            set.bias(&["run_out"]).expect("four comparisons")
        };
        assert_eq!(with("bars_friction_0.3387"), set().bias(&["run_out"]).expect("four comparisons"));
        assert_eq!(with("bars").comparisons, 5);
    }

    #[test]
    fn the_program_carries_comparisons_of_fronts_in_known_regimes() {
        let set = ValidationSet::shipped();
        assert!(set.comparisons.len() > 50, "{} comparisons", set.comparisons.len());
        assert!(set.of(&WAY_OF_FRONT).count() >= 6);
        assert!(set.ranges(&WAY_OF_FRONT).iter().all(Option::is_some), "{:?}", set.ranges(&WAY_OF_FRONT));
    }
}
