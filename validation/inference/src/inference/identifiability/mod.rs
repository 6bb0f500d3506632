//! Parameters that the data do not determine, in sentences.

mod sentence;

use super::region::{CONFIDENCE, Region, chi_squared_quantile};
use nalgebra::DMatrix;
use sentence::SentenceWriter;
use std::fmt;

/// A closed interval wider than this share of the range says nothing much.
const WIDE: f64 = 0.5;

/// Correlation above which two parameters are known only together.
const STRONG: f64 = 0.95;

/// Singular values below this share of the largest one count as zero.
const RANK_TOLERANCE: f64 = 1e-6;

/// A direction is weak if χ² stays within the threshold for this step along it, in the unit cube.
const WEAK: f64 = 0.25;

/// Components of a direction below this share of the largest one are left out.
const DOMINANT: f64 = 0.3;

/// Longest step along a direction in the cube, the steps in which it is walked, and halvings of the last.
const LONGEST: f64 = 2.0;
const WALK: usize = 80;
const HALVINGS: usize = 30;

/// Distance beyond the end of an interval that is rounding.
const ROUNDING: f64 = 1e-9;

/// Distance from a bound that counts as lying on it.
const AT_BOUND: f64 = 1e-6;

/// A parameter as sentences call it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ParameterLabel {
    /// Name, as in the input file.
    pub name: String,
    /// Unit; empty or `-` without one.
    pub unit: String,
}

/// Kind of finding, with numbers in the unit cube.
#[derive(Debug, Clone, PartialEq)]
pub enum FindingKind {
    /// There are fewer data than parameters.
    FewData {
        /// Number of data.
        data: usize,
        /// Number of parameters.
        parameters: usize,
    },
    /// At the minimum the data depend on fewer combinations than there are parameters.
    RankDeficient {
        /// Number of independent combinations.
        rank: usize,
        /// Number of parameters.
        parameters: usize,
    },
    /// The 95 % interval reaches a bound, or is wider than half the range.
    NotDetermined {
        /// Index of the parameter.
        parameter: usize,
        /// Values that agree with the data, as intervals in rising order.
        intervals: Vec<[f64; 2]>,
        /// Whether it reaches the lower and the upper bound.
        open: [bool; 2],
    },
    /// The minimum lies on a bound.
    AtBound {
        /// Index of the parameter.
        parameter: usize,
        /// The upper bound rather than the lower one.
        upper: bool,
    },
    /// Two parameters are known only together.
    Correlated {
        /// Their indices.
        pair: [usize; 2],
        /// Their correlation `[-]`.
        correlation: f64,
    },
    /// Several parameters can change together at little cost.
    WeakDirection {
        /// Unit vector of the change that the data hardly notice.
        free: Vec<f64>,
        /// Unit vector of the change of the same parameters that they notice most.
        fixed: Vec<f64>,
        /// Step along `free`, both ways, for which χ² rises by the 95 % threshold, if the model were linear; infinite
        /// where it never rises.
        reach: f64,
        /// Steps back and forth along `free` up to which the region holds every point.
        within: [f64; 2],
    },
}

/// A finding and the sentence that describes it.
#[derive(Debug, Clone, PartialEq)]
pub struct Finding {
    /// Kind of finding.
    pub kind: FindingKind,
    text: String,
}

impl fmt::Display for Finding {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.text)
    }
}

/// Everything that the data leave open, worst first. `jacobian` holds the derivatives of the weighted residuals at the
/// minimum, `physical` turns the coordinate of a parameter into its value in its unit.
pub fn assess(
    jacobian: &DMatrix<f64>,
    region: &Region,
    parameters: &[ParameterLabel],
    physical: &dyn Fn(usize, f64) -> f64,
) -> Vec<Finding> {
    let writer = SentenceWriter { parameters, physical };
    let minimum = &region.minimum.point;
    let (data, count) = (jacobian.nrows(), jacobian.ncols());
    let mut findings = Vec::new();
    let mut add = |kind: FindingKind| findings.push(Finding { text: writer.sentence(&kind, minimum), kind });

    let (values, directions) = spectrum(jacobian);
    let largest = values.iter().copied().fold(0.0, f64::max);
    let rank = values.iter().filter(|value| **value > RANK_TOLERANCE * largest).count();
    if data < count {
        add(FindingKind::FewData { data, parameters: count });
    } else if rank < count {
        add(FindingKind::RankDeficient { rank, parameters: count });
    }
    for (k, profile) in region.profiles.iter().enumerate() {
        if !profile.is_closed() || profile.width() > WIDE {
            let open = [profile.open_below, profile.open_above];
            add(FindingKind::NotDetermined { parameter: k, intervals: profile.intervals(k), open });
        }
    }
    for (k, profile) in region.profiles.iter().enumerate() {
        let (lower, upper) = (minimum[k] < AT_BOUND, minimum[k] > 1.0 - AT_BOUND);
        // where every value agrees, it means nothing that the best lies at an end
        if (lower || upper) && !(profile.open_below && profile.open_above) {
            add(FindingKind::AtBound { parameter: k, upper });
        }
    }
    for first in 0..count {
        for second in first + 1..count {
            let correlation = region.correlation[(first, second)];
            if correlation.abs() > STRONG {
                add(FindingKind::Correlated { pair: [first, second], correlation });
            }
        }
    }
    let threshold = region.inflation * chi_squared_quantile(CONFIDENCE, 1).sqrt();
    for (value, direction) in values.iter().zip(&directions) {
        let free = dominant(direction);
        let members = free.iter().filter(|share| **share != 0.0).count();
        let reach = threshold / value;
        let fixed = strongest(jacobian, &free);
        // where even the best known combination is weak there is nothing to set it against
        let alike = free.iter().zip(&fixed).map(|(a, b)| a * b).sum::<f64>().abs() > 0.99;
        let within = [-1.0, 1.0].map(|sense| reach_in_region(region, &free, sense));
        if reach > WEAK && members > 1 && !alike && within[0] + within[1] > WEAK {
            add(FindingKind::WeakDirection { fixed, free, reach, within });
        }
    }
    findings
}

/// The longest step along a direction all of which lies in the cube, in every interval and, by the emulator, below their limit.
fn reach_in_region(region: &Region, direction: &[f64], sense: f64) -> f64 {
    let moved = |step: f64| -> Vec<f64> {
        region.minimum.point.iter().zip(direction).map(|(u, share)| u + sense * step * share).collect()
    };
    let agrees = |step: f64| {
        let point = moved(step);
        let inside = |(k, u): (usize, &f64)| {
            let intervals = region.profiles[k].intervals(k);
            direction[k] == 0.0 || intervals.iter().any(|[from, to]| (*from - ROUNDING..=*to + ROUNDING).contains(u))
        };
        point.iter().enumerate().all(inside) && region.rise(&point) <= region.limit
    };
    let outside = (1..=WALK).map(|step| LONGEST * step as f64 / WALK as f64).find(|step| !agrees(*step));
    let Some(mut outside) = outside else { return LONGEST };
    let mut inside = outside - LONGEST / WALK as f64;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (inside + outside);
        if agrees(middle) { inside = middle } else { outside = middle }
    }
    inside
}

/// Singular values of J and their directions, the smallest first; as many as there are parameters.
fn spectrum(jacobian: &DMatrix<f64>) -> (Vec<f64>, Vec<Vec<f64>>) {
    let count = jacobian.ncols();
    // with fewer data than parameters the directions without effect are only found with rows of zeros
    let square = jacobian.clone().resize_vertically(jacobian.nrows().max(count), 0.0);
    let factors = square.svd(false, true);
    let Some(directions) = factors.v_t else { return (Vec::new(), Vec::new()) };
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by(|a, b| factors.singular_values[*a].total_cmp(&factors.singular_values[*b]));
    let row = |k: &usize| directions.row(*k).iter().copied().collect();
    (order.iter().map(|k| factors.singular_values[*k]).collect(), order.iter().map(row).collect())
}

/// The direction with its small components left out, of length 1, its first component positive.
fn dominant(direction: &[f64]) -> Vec<f64> {
    let largest = direction.iter().fold(0.0_f64, |most, share| most.max(share.abs()));
    let kept = |share: &f64| if share.abs() >= DOMINANT * largest { *share } else { 0.0 };
    let sign = direction.iter().map(kept).find(|share| *share != 0.0).map_or(1.0, f64::signum);
    unit(direction.iter().map(|share| sign * kept(share)).collect())
}

fn unit(vector: Vec<f64>) -> Vec<f64> {
    let length = vector.iter().map(|share| share * share).sum::<f64>().sqrt();
    vector.into_iter().map(|share| share / length).collect()
}

/// The change of the same parameters that moves the residuals most.
fn strongest(jacobian: &DMatrix<f64>, free: &[f64]) -> Vec<f64> {
    let mut part = jacobian.clone();
    for (k, share) in free.iter().enumerate() {
        if *share == 0.0 {
            part.column_mut(k).fill(0.0);
        }
    }
    spectrum(&part).1.last().map_or_else(|| vec![0.0; free.len()], |direction| dominant(direction))
}
