//! Coverage of regions of a model whose runs scatter.

use bagnold_inference::inference::{Budget, Evaluate, Method, Repeatability, SolvePlan, chi_squared, solve};
use bagnold_inference::sampling::Random;
use std::convert::Infallible;

/// A region that holds the truth in 95 of 100 does so in 13 of these at least, by three standard deviations.
const EXPERIMENTS: u64 = 16;

/// Twelve data on a bent curve of two parameters, and predictions that scatter by themselves.
struct Scattering {
    truth: [f64; 2],
    noise: Vec<f64>,
    /// Variance of a prediction over that of a datum.
    variance: f64,
    random: Random,
}

impl Scattering {
    fn new(seed: u64, variance: f64) -> Self {
        let mut random = Random::new(seed);
        let noise = (0..12).map(|_| random.normal()).collect();
        Self { truth: [0.45, 0.6], noise, variance, random }
    }

    /// Residuals of the mean of all runs.
    fn mean(&self, u: &[f64]) -> Vec<f64> {
        let curve = |u: &[f64], k: usize| {
            let t = k as f64 / 11.0;
            25.0 * u[0] * t + 18.0 * u[1] * u[1] * (1.0 - t) + 8.0 * u[0] * u[1]
        };
        (0..12).map(|k| curve(u, k) - curve(&self.truth, k) - self.noise[k]).collect()
    }
}

impl Evaluate for Scattering {
    type Error = Infallible;
    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
        let scale = (1.0 + self.variance).sqrt();
        let mut one = |u: &Vec<f64>| -> Vec<f64> {
            let mean = self.mean(u);
            mean.iter().map(|mean| (mean + self.variance.sqrt() * self.random.normal()) / scale).collect()
        };
        Ok(points.iter().map(|u| Some(one(u))).collect())
    }
}

fn plan(runs: Repeatability) -> SolvePlan {
    SolvePlan {
        start: vec![0.8, 0.3],
        method: Method::TrustRegion,
        design: Vec::new(),
        budget: Budget { starts: 6, difference: 0.1, ..Budget::default() },
        region_evaluations: 32,
        runs,
        series: Vec::new(),
    }
}

/// Joint regions and intervals of the experiments that hold the truth.
fn held(variance: f64, runs: Repeatability) -> [usize; 3] {
    let (mut held, mut settled) = ([0; 3], 0);
    for seed in 0..EXPERIMENTS {
        let mut model = Scattering::new(seed, variance);
        let answer = solve(&mut model, &plan(runs)).expect("it works");
        let explored = answer.explored.expect("points enough");
        settled += explored.ends.iter().flatten().filter(|end| end.settled).count();
        let minimum = &explored.region.minimum;
        assert!(minimum.point == answer.search.best && minimum.chi_squared == answer.search.chi_squared);
        held[0] += usize::from(match runs {
            Repeatability::Scattering => explored.region.contains(&model.truth),
            Repeatability::Smooth => {
                chi_squared(&model.mean(&model.truth)) - minimum.chi_squared <= explored.region.threshold
            }
        });
        for k in 0..2 {
            let [from, to] = explored.region.profiles[k].interval;
            held[1 + k] += usize::from((from..=to).contains(&model.truth[k]));
        }
    }
    assert!(runs == Repeatability::Smooth || settled >= 60, "{settled} of 64 ends are settled");
    println!(
        "variance {variance}, {runs:?}: joint {}, single {:?} of {EXPERIMENTS}; {settled} ends settled",
        held[0],
        &held[1..]
    );
    held
}

#[test]
fn regions_of_a_model_that_scatters_hold_the_truth() {
    let held = held(1.0, Repeatability::Scattering);
    assert!(held.iter().all(|count| *count >= 13), "{held:?}");
}

#[test]
fn as_if_it_did_not_scatter_they_would_not() {
    assert!(held(1.0, Repeatability::Smooth).iter().any(|count| *count < 13));
}

/// One parameter that hardly counts up to a threshold, and predictions that rise steeply beyond it and scatter.
struct Cliff(Scattering);

impl Evaluate for Cliff {
    type Error = Infallible;
    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
        let Self(own) = self;
        let mut one = |u: &Vec<f64>| -> Vec<f64> {
            let rise = 0.5 * (u[0] - 0.4) + 6.0 * libm::tanh(30.0 * (u[0] - 0.7)).max(0.0);
            own.noise.iter().map(|noise| rise - noise + 0.3 * own.random.normal()).collect()
        };
        Ok(points.iter().map(|u| Some(one(u))).collect())
    }
}

#[test]
fn an_end_that_its_own_runs_contradict_is_not_settled() {
    let mut contradicted = 0;
    for seed in 0..4 {
        let mut model = Cliff(Scattering::new(seed, 0.0));
        let answer =
            solve(&mut model, &SolvePlan { start: vec![0.5], ..plan(Repeatability::Scattering) }).expect("it works");
        let explored = answer.explored.expect("points enough");
        let end = &explored.ends[0][1];
        contradicted += usize::from(!end.settled);
        assert!(!end.settled || end.point[0] < 0.8, "{end:?}");
    }
    assert!(contradicted > 0, "the smooth fit follows the threshold: no test");
}

mod long {
    use super::*;

    #[test]
    #[ignore = "long: bash tests/long.sh"]
    fn regions_of_a_model_that_scatters_less_hold_the_truth() {
        let held = held(0.3, Repeatability::Scattering);
        assert!(held.iter().all(|count| *count >= 13), "{held:?}");
    }
}
