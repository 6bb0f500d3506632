//! Repeated experiments: how often region and intervals hold the truth, and what a calibration costs.

use bagnold_inference::inference::diagnosis::outliers;
use bagnold_inference::inference::{
    Answer, Budget, Evaluate, Evaluated, Method, Repeatability, SolvePlan, Termination, UNLIKELY, chi_squared, solve,
};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;
use std::convert::Infallible;

/// A model with data of known truth.
pub(crate) struct Problem<F> {
    /// Weighted residuals `[-]` at a point of the unit cube.
    pub(crate) residuals: F,
    /// Parameters behind the data, in the unit cube.
    pub(crate) truth: Vec<f64>,
    /// Places of residuals that follow each other.
    pub(crate) series: Vec<Vec<usize>>,
}

impl<F: Fn(&[f64]) -> Option<Vec<f64>>> Evaluate for Problem<F> {
    type Error = Infallible;

    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
        Ok(points.iter().map(|point| (self.residuals)(point)).collect())
    }
}

/// Default settings of a calibration.
pub(crate) fn usual(start: Vec<f64>) -> SolvePlan {
    let dimensions = start.len();
    SolvePlan {
        start,
        method: Method::TrustRegion,
        design: Vec::new(),
        budget: Budget { starts: 2 * dimensions + 2, ..Budget::default() },
        region_evaluations: 16 * dimensions,
        runs: Repeatability::Smooth,
        series: Vec::new(),
    }
}

/// Counts over the experiments of one problem.
#[derive(Debug, Default)]
pub(crate) struct Tally {
    pub(crate) experiments: usize,
    /// Joint regions that hold the truth.
    pub(crate) joint: usize,
    /// Intervals of each parameter that do.
    pub(crate) single: Vec<usize>,
    /// Experiments all of whose ends and whose joint region the model has confirmed.
    pub(crate) settled: usize,
    /// Experiments with a finding about the search, the fit, or ends and regions that are not settled.
    pub(crate) raised: usize,
    /// Experiments whose errors are named as correlated.
    pub(crate) correlated: usize,
    /// Evaluations of every experiment.
    pub(crate) evaluations: Vec<usize>,
}

impl Tally {
    /// Repeats an experiment with many seeds, as a calibration that says no more than its start.
    pub(crate) fn of<F: Fn(&[f64]) -> Option<Vec<f64>>>(
        seeds: std::ops::Range<u64>,
        start: &[f64],
        problem: impl Fn(u64) -> Problem<F>,
    ) -> Self {
        Self::by(seeds, &usual(start.to_vec()), problem)
    }

    /// The same by another plan.
    pub(crate) fn by<F: Fn(&[f64]) -> Option<Vec<f64>>>(
        seeds: std::ops::Range<u64>,
        plan: &SolvePlan,
        problem: impl Fn(u64) -> Problem<F>,
    ) -> Self {
        let mut tally = Self { single: vec![0; plan.start.len()], ..Self::default() };
        for seed in seeds {
            let mut problem = problem(seed);
            let plan = SolvePlan { series: problem.series.clone(), ..plan.clone() };
            let answer = solve(&mut problem, &plan).expect("the model works");
            tally.add(&problem, &answer);
        }
        tally.evaluations.sort_unstable();
        tally
    }

    fn add<F: Fn(&[f64]) -> Option<Vec<f64>>>(&mut self, problem: &Problem<F>, answer: &Answer) {
        let explored = answer.explored.as_ref().expect("points enough");
        let best = answer.search.history.iter().find(|evaluated| evaluated.point == answer.search.best);
        let residuals = best.and_then(|evaluated: &Evaluated| evaluated.residuals.clone()).expect("evaluated");
        let at_truth = (problem.residuals)(&problem.truth).map_or(f64::INFINITY, |residuals| chi_squared(&residuals));
        self.experiments += 1;
        self.joint += usize::from(at_truth - answer.search.chi_squared <= explored.region.threshold);
        for (k, truth) in problem.truth.iter().enumerate() {
            let [from, to] = explored.region.profiles[k].interval;
            self.single[k] += usize::from((from..=to).contains(truth));
        }
        self.settled += usize::from(explored.is_settled());
        self.correlated += usize::from(answer.correlation.is_some());
        let unlikely = explored.region.p_value.is_some_and(|p| !(UNLIKELY..=1.0 - UNLIKELY).contains(&p));
        self.raised += usize::from(
            unlikely
                || !explored.is_settled()
                || !matches!(answer.search.stopped, Termination::Converged | Termination::AtRest)
                || !answer.search.every_start
                || !outliers(&residuals, problem.truth.len()).is_empty()
                || answer.correlation.is_some(),
        );
        self.evaluations.push(answer.search.history.len());
    }

    /// All intervals and joint regions that hold the truth, and how many there are.
    pub(crate) fn pooled(&self) -> (usize, usize) {
        (self.joint + self.single.iter().sum::<usize>(), self.experiments * (1 + self.single.len()))
    }

    /// Prints a line for the note of the study.
    pub(crate) fn print(&self, name: &str) {
        let middle = self.evaluations[self.evaluations.len() / 2];
        println!(
            "{name}: of {} joint {}, single {:?}, settled {}, correlated {}, with findings {}; evaluations {} to {}, median {middle}",
            self.experiments,
            self.joint,
            self.single,
            self.settled,
            self.correlated,
            self.raised,
            self.evaluations[0],
            self.evaluations[self.evaluations.len() - 1]
        );
    }
}

/// Standard normal numbers of a seed.
pub(crate) fn normal(seed: u64, count: usize) -> Vec<f64> {
    let mut generator = Pcg64Mcg::seed_from_u64(seed);
    let mut one = || {
        let radius = (-2.0 * (1.0 - generator.random::<f64>()).ln()).sqrt();
        radius * (std::f64::consts::TAU * generator.random::<f64>()).cos()
    };
    (0..count).map(|_| one()).collect()
}
