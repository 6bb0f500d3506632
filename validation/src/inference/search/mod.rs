//! The search for the point of least χ², by one of four methods, within a budget of evaluations.

mod design;
mod evolution;
mod nelder_mead;
mod recorder;
mod trust_region;

pub use design::search_design;
pub(super) use recorder::{Halt, Recorder};

use super::Evaluate;
use serde::{Deserialize, Serialize};
use std::fmt;

/// How the minimum is looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Method {
    /// Gauss–Newton steps in a trust region: the fewest evaluations where the model is smooth.
    TrustRegion,
    /// A simplex that needs no derivatives.
    NelderMead,
    /// Generations of random points (CMA-ES): for a model with noise or several minima.
    Evolution,
    /// Points spread over the whole cube, and the minimum of a polynomial through them.
    Design,
}

impl Method {
    /// Name in files and on pages.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::TrustRegion => "trust-region",
            Self::NelderMead => "nelder-mead",
            Self::Evolution => "evolution",
            Self::Design => "design",
        }
    }
}

/// What a search may spend, and when it has done enough.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Budget {
    /// Most distinct points at which the model is evaluated.
    pub evaluations: usize,
    /// Seed of everything random.
    pub seed: u64,
    /// Step of finite differences in the unit cube `[-]`, above 0 and at most 0.5.
    pub difference: f64,
    /// Change of χ² that is not worth another evaluation, in units of the reduced χ² or 1, whichever is more `[-]`.
    pub tolerance: f64,
}

impl Default for Budget {
    fn default() -> Self {
        Self { evaluations: 40, seed: 1, difference: 0.02, tolerance: 0.01 }
    }
}

impl Budget {
    /// The change of χ² `[-]` that is not worth an evaluation, where χ² of `data` data has this value.
    fn negligible(&self, chi_squared: f64, data: usize) -> f64 {
        self.tolerance * (chi_squared / data.max(1) as f64).max(1.0)
    }
}

/// The model at one point.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Evaluated {
    /// Coordinates in the unit cube.
    pub point: Vec<f64>,
    /// Weighted residuals `[-]`; none where the model failed.
    pub residuals: Option<Vec<f64>>,
    /// χ² `[-]`; none where the model failed.
    pub chi_squared: Option<f64>,
}

impl Evaluated {
    /// A point with what the model returned there; a residual that is no finite number is a failure.
    #[must_use]
    pub fn new(point: Vec<f64>, residuals: Option<Vec<f64>>) -> Self {
        let residuals = residuals.filter(|list| list.iter().all(|residual| residual.is_finite()));
        let chi_squared = residuals.as_deref().map(super::chi_squared);
        Self { point, residuals, chi_squared }
    }
}

/// Why a search ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stopped {
    /// No step would change χ² by more than the tolerance.
    Converged,
    /// The next evaluation would have exceeded the budget.
    BudgetSpent,
    /// Steps became too short to tell from noise, but χ² should still fall.
    Stalled,
    /// The points of the design are evaluated.
    DesignDone,
}

impl fmt::Display for Stopped {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Self::Converged => "converged: no step would change χ² by more than the tolerance",
            Self::BudgetSpent => "budget spent: the best point so far need not be the minimum; allow more evaluations",
            Self::Stalled => "stalled: χ² no longer falls although its slope says it should; the model may be noisy",
            Self::DesignDone => "done: all points of the design and the minimum of their polynomial are evaluated",
        })
    }
}

/// What a search has found.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Search {
    /// The evaluated point of least χ², in the unit cube.
    pub best: Vec<f64>,
    /// χ² there `[-]`.
    pub chi_squared: f64,
    /// Every distinct point once, in the order of first evaluation.
    pub history: Vec<Evaluated>,
    /// Why it ended.
    pub stopped: Stopped,
}

/// Why a search has found nothing. Completes "failed to search: …".
#[derive(Debug, thiserror::Error)]
pub enum SearchError<E> {
    /// The model cannot be evaluated at all.
    #[error("{0}")]
    Model(E),
    /// No run of the model succeeded.
    #[error("the model failed at all {evaluations} points that were tried; move the start or narrow the ranges")]
    NothingWorked {
        /// Points tried.
        evaluations: usize,
    },
    /// The search cannot begin.
    #[error("`{field}` is {value}, but must be {rule}")]
    Setting {
        /// The field at fault.
        field: &'static str,
        /// Its value as written.
        value: String,
        /// The rule it breaks, completing "must be …".
        rule: &'static str,
    },
    /// The model does not always compare with the same data.
    #[error("the model returned {found} residuals, but {expected} before; every point must give one for each datum")]
    Residuals {
        /// Residuals of the first success.
        expected: usize,
        /// Residuals of a later one.
        found: usize,
    },
}

/// Searches the unit cube for the least χ² from `start`; a design does not need the start, but takes its dimension.
///
/// # Errors
/// A setting out of range, an error of the model itself, or no point at which the model worked.
pub fn search<M: Evaluate>(
    model: &mut M,
    start: &[f64],
    method: Method,
    budget: Budget,
) -> Result<Search, SearchError<M::Error>> {
    check(start, &budget)?;
    let mut recorder = Recorder::new(model, budget.evaluations);
    let outcome = match method {
        Method::TrustRegion => trust_region::run(&mut recorder, start, &budget),
        Method::NelderMead => nelder_mead::run(&mut recorder, start, &budget),
        Method::Evolution => evolution::run(&mut recorder, start, &budget),
        Method::Design => {
            let points = crate::sampling::design::sobol((budget.evaluations - 1).max(1), start.len(), budget.seed);
            design::run(&mut recorder, &points, &budget)
        }
    };
    recorder.finish(outcome)
}

/// Refuses settings with which no search can work.
fn check<E>(start: &[f64], budget: &Budget) -> Result<(), SearchError<E>> {
    let refuse = |field, value: String, rule| Err(SearchError::Setting { field, value, rule });
    if start.is_empty() || start.iter().any(|u| !(0.0..=1.0).contains(u)) {
        return refuse("start", format!("{start:?}"), "a point of the unit cube, with at least one coordinate");
    }
    if budget.evaluations == 0 {
        return refuse("evaluations", "0".into(), "at least 1");
    }
    if !(budget.difference > 0.0 && budget.difference <= 0.5) {
        return refuse("difference", budget.difference.to_string(), "above 0 and at most 0.5");
    }
    if !(budget.tolerance > 0.0 && budget.tolerance.is_finite()) {
        return refuse("tolerance", budget.tolerance.to_string(), "a number above 0");
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::stand_in::{Curve, Failing, Valley};
    use super::*;

    const METHODS: [Method; 4] = [Method::TrustRegion, Method::NelderMead, Method::Evolution, Method::Design];

    fn budget(evaluations: usize) -> Budget {
        Budget { evaluations, ..Budget::default() }
    }

    fn sound(found: &Search, evaluations: usize) {
        assert!(found.history.len() <= evaluations, "{} > {evaluations}", found.history.len());
        for evaluated in &found.history {
            assert!(evaluated.point.iter().all(|u| (0.0..=1.0).contains(u)), "{:?}", evaluated.point);
        }
        let least = found.history.iter().filter_map(|e| e.chi_squared).fold(f64::INFINITY, f64::min);
        assert_eq!(found.chi_squared, least);
        for (k, one) in found.history.iter().enumerate() {
            assert!(found.history[..k].iter().all(|other| other.point != one.point));
        }
    }

    #[test]
    fn every_method_descends_the_valley_of_rosenbrock() {
        for (method, evaluations) in
            [(Method::TrustRegion, 40), (Method::NelderMead, 150), (Method::Evolution, 500), (Method::Design, 60)]
        {
            let budget = Budget { tolerance: 1e-4, ..budget(evaluations) };
            let found = search(&mut Valley, &[0.2, 0.8], method, budget).unwrap();
            sound(&found, evaluations);
            let distance = (found.best[0] - 0.6).abs().max((found.best[1] - 0.36).abs());
            println!("{method:?}: {} evaluations, off by {distance:.1e}, {}", found.history.len(), found.stopped);
            assert!(distance < 0.02, "{method:?}: {:?} {}", found.best, found.chi_squared);
        }
    }

    #[test]
    fn every_method_fits_a_curve_of_three_parameters() {
        let model = Curve::new();
        for (method, evaluations, accuracy) in [
            (Method::TrustRegion, 25, 0.005),
            (Method::NelderMead, 150, 0.01),
            (Method::Evolution, 500, 0.01),
            (Method::Design, 80, 0.05),
        ] {
            for start in [[0.35, 0.75, 0.3], [0.8, 0.2, 0.2], [0.5, 0.5, 0.5]] {
                let found = search(&mut model.clone(), &start, method, budget(evaluations)).unwrap();
                sound(&found, evaluations);
                let distance = (0..3).map(|k| (found.best[k] - model.truth[k]).abs()).fold(0.0, f64::max);
                println!("{method:?}: {} evaluations, off by {distance:.1e}, {}", found.history.len(), found.stopped);
                assert!(distance < accuracy, "{method:?}: {:?} {}", found.best, found.chi_squared);
            }
        }
    }

    #[test]
    fn no_budget_is_exceeded_however_small() {
        for method in METHODS {
            for evaluations in 1..20 {
                let found = search(&mut Curve::new(), &[0.9, 0.1, 0.5], method, budget(evaluations)).unwrap();
                sound(&found, evaluations);
            }
        }
    }

    #[test]
    fn regions_where_the_model_fails_are_survived() {
        for method in METHODS {
            // the minimum lies at the edge of the failing half, and the second start within it
            for start in [[0.3, 0.5, 0.5], [0.95, 0.5, 0.5]] {
                let mut model = Failing { curve: Curve::new(), beyond: 0.62 };
                let found = search(&mut model, &start, method, budget(250)).unwrap();
                sound(&found, 250);
                let distance = (0..3).map(|k| (found.best[k] - model.curve.truth[k]).abs()).fold(0.0, f64::max);
                println!("{method:?}: {} evaluations, off by {distance:.1e}, {}", found.history.len(), found.stopped);
                assert!(distance < 0.1, "{method:?}: {:?} {}", found.best, found.chi_squared);
            }
        }
    }

    #[test]
    fn a_model_that_always_fails_is_reported() {
        for method in METHODS {
            let mut model = Failing { curve: Curve::new(), beyond: -1.0 };
            let error = search(&mut model, &[0.5; 3], method, budget(9)).unwrap_err();
            assert!(matches!(error, SearchError::NothingWorked { evaluations: 1..=9 }), "{method:?}: {error}");
        }
    }

    #[test]
    fn a_search_is_repeated_exactly() {
        for method in METHODS {
            let run = || search(&mut Curve::new(), &[0.3, 0.4, 0.9], method, budget(40)).unwrap();
            assert_eq!(run(), run());
        }
    }

    #[test]
    fn settings_out_of_range_are_refused() {
        let run =
            |start: &[f64], budget| search(&mut Valley, start, Method::TrustRegion, budget).unwrap_err().to_string();
        assert!(run(&[1.2, 0.0], budget(9)).starts_with("`start` is [1.2, 0.0], but must be"));
        assert!(run(&[0.5, 0.5], budget(0)).starts_with("`evaluations` is 0, but must be"));
        assert!(run(&[0.5; 2], Budget { difference: 0.0, ..budget(9) }).starts_with("`difference` is 0, but must be"));
    }
}
