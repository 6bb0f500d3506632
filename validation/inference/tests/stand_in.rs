//! Cheap models with known minima, for tests.

use bagnold_inference::inference::{Emulator, Evaluate, Evaluated};
use bagnold_inference::sampling::Random;
use bagnold_inference::sampling::design::full_grid;
use nalgebra::DMatrix;
use std::convert::Infallible;

/// The emulator of a model of two parameters on a grid of four by four.
pub(crate) fn emulator(residuals: impl Fn(&[f64]) -> Vec<f64>) -> Emulator {
    let one = |point: Vec<f64>| {
        let residuals = residuals(&point);
        Evaluated::new(point, Some(residuals))
    };
    let history: Vec<Evaluated> = full_grid(&[4, 4]).into_iter().map(one).collect();
    Emulator::fit(&history, 0.02).unwrap()
}

/// Rosenbrock's valley; the minimum, χ² = 0, lies at (0.6, 0.36).
pub(crate) struct RosenbrockModel;

impl Evaluate for RosenbrockModel {
    type Error = Infallible;
    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
        Ok(points.iter().map(|u| Some(vec![30.0 * (u[1] - u[0] * u[0]), 3.0 * (0.6 - u[0])])).collect())
    }
}

/// A decay to a plateau, y = a exp(−b t) + c at twelve times, without noise, standard uncertainty 0.02.
#[derive(Clone)]
pub(crate) struct ExponentialDecay {
    /// Parameters of the synthetic data, in the unit cube.
    pub(crate) truth: [f64; 3],
}

impl ExponentialDecay {
    pub(crate) fn new() -> Self {
        Self { truth: [0.6, 0.45, 0.4] }
    }

    fn value(u: &[f64], time: f64) -> f64 {
        (0.5 + u[0]) * libm::exp(-(0.5 + 2.0 * u[1]) * time) + 0.5 * u[2]
    }

    /// Weighted residuals at a point.
    pub(crate) fn at(&self, u: &[f64]) -> Vec<f64> {
        (0..12).map(|k| 0.25 * f64::from(k)).map(|t| (Self::value(u, t) - Self::value(&self.truth, t)) / 0.02).collect()
    }

    /// The exact derivatives of the residuals.
    pub(crate) fn jacobian(&self, u: &[f64]) -> DMatrix<f64> {
        DMatrix::from_fn(12, 3, |row, column| {
            let time = 0.25 * row as f64;
            let decay = libm::exp(-(0.5 + 2.0 * u[1]) * time);
            [decay, -2.0 * time * (0.5 + u[0]) * decay, 0.5][column] / 0.02
        })
    }
}

impl Evaluate for ExponentialDecay {
    type Error = Infallible;
    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
        Ok(points.iter().map(|u| Some(self.at(u))).collect())
    }
}

/// The curve, where the first coordinate is at most `beyond`; a model that diverges elsewhere.
pub(crate) struct Failing {
    pub(crate) curve: ExponentialDecay,
    pub(crate) beyond: f64,
}

impl Evaluate for Failing {
    type Error = Infallible;
    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
        Ok(points.iter().map(|u| (u[0] <= self.beyond).then(|| self.curve.at(u))).collect())
    }
}

/// Bagnold's profile under the μ(I) law at five slopes: parameters μ_s, μ_2 and I_0, one per cent of noise.
#[derive(Clone)]
pub(crate) struct Slopes {
    /// Velocity with noise over that without.
    noise: Vec<f64>,
}

/// Ranges of μ_s, μ_2 and I_0 `[-]`; the last is logarithmic.
pub(crate) const RANGES: [(f64, f64); 3] = [(0.30, 0.40), (0.57, 0.80), (0.1, 0.6)];

/// True μ_s, μ_2 and I_0 `[-]`.
pub(crate) const TRUTH: [f64; 3] = [0.38, 0.64, 0.279];

/// Depth bins of a slope.
const BINS: usize = 20;

/// Share of a velocity that is its standard uncertainty.
const NOISE: f64 = 0.01;

impl Slopes {
    /// Data of a seed.
    pub(crate) fn new(seed: u64) -> Self {
        let mut random = Random::new(seed);
        Self { noise: (0..5 * BINS).map(|_| 1.0 + NOISE * random.normal()).collect() }
    }

    /// μ_s, μ_2 and I_0 of a point.
    pub(crate) fn physical(k: usize, u: f64) -> f64 {
        let (lower, upper) = RANGES[k];
        if k < 2 { lower + u * (upper - lower) } else { lower * libm::exp(u * libm::log(upper / lower)) }
    }

    /// The truth in the unit cube.
    pub(crate) fn truth() -> Vec<f64> {
        let linear = |k: usize| (TRUTH[k] - RANGES[k].0) / (RANGES[k].1 - RANGES[k].0);
        vec![linear(0), linear(1), libm::log(TRUTH[2] / RANGES[2].0) / libm::log(RANGES[2].1 / RANGES[2].0)]
    }

    /// Velocities `[m/s]` of all slopes and depths.
    fn velocities(parameters: [f64; 3]) -> Vec<f64> {
        let [static_friction, limit_friction, reference_inertia] = parameters;
        let (diameter, depth, gravity) = (0.5e-3, 10e-3_f64, 9.81);
        let mut all = Vec::new();
        for degrees in [22.0_f64, 23.5, 25.0, 27.0, 29.0] {
            let angle = degrees.to_radians();
            let slope = libm::tan(angle);
            let inertia = reference_inertia * (slope - static_friction) / (limit_friction - slope);
            let scale = 2.0 / 3.0 * inertia / diameter * (gravity * libm::cos(angle)).sqrt();
            for bin in 0..BINS {
                let height = depth * (bin as f64 + 0.5) / BINS as f64;
                all.push(scale * (depth * depth.sqrt() - (depth - height) * (depth - height).sqrt()));
            }
        }
        all
    }

    /// Weighted residuals at a point.
    pub(crate) fn at(&self, u: &[f64]) -> Vec<f64> {
        let model = Self::velocities([Self::physical(0, u[0]), Self::physical(1, u[1]), Self::physical(2, u[2])]);
        let exact = Self::velocities(TRUTH);
        (0..exact.len()).map(|k| (model[k] - exact[k] * self.noise[k]) / (NOISE * exact[k])).collect()
    }
}

impl Evaluate for Slopes {
    type Error = Infallible;
    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, Infallible> {
        Ok(points.iter().map(|u| Some(self.at(u))).collect())
    }
}
