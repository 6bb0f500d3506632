use super::{ConjugateGradient, Criterion, IncompleteCholesky, LaneRows, NotConverged, Rows, Single, TwoRows, single};
use crate::parallel::prelude::*;
use crate::vector::Vector;
use nalgebra::DMatrix;
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

const TIGHT: Criterion = Criterion { tolerance: 1e-13, most_iterations: 4000 };

fn random(seed: u64) -> Pcg64Mcg {
    Pcg64Mcg::seed_from_u64(seed)
}

/// A dense symmetric matrix with negative off-diagonals and the row sums that are given.
struct Dense {
    rows: usize,
    value: Vec<f64>,
}

impl Dense {
    /// Couplings of widely different size over a set of springs, held with `hold`.
    fn springs(rows: usize, hold: impl Fn(usize) -> f64, seed: u64) -> Self {
        let mut random = random(seed);
        let mut value = vec![0.0; rows * rows];
        for a in 0..rows {
            value[a * rows + a] += hold(a);
            for b in 0..a {
                if b + 1 == a || random.random::<f64>() < 0.1 {
                    let spring = 10.0_f64.powf(3.0 * random.random::<f64>());
                    value[a * rows + b] -= spring;
                    value[b * rows + a] -= spring;
                    value[a * rows + a] += spring;
                    value[b * rows + b] += spring;
                }
            }
        }
        Self { rows, value }
    }

    fn at(&self, a: usize, b: usize) -> f64 {
        self.value[a * self.rows + b]
    }

    fn row_sums(&self) -> Vec<f64> {
        (0..self.rows).map(|a| (0..self.rows).map(|b| self.at(a, b)).sum()).collect()
    }

    /// The solution for right sides in columns, by dense Cholesky factors.
    fn direct(&self, right_side: &DMatrix<f64>) -> DMatrix<f64> {
        let matrix = DMatrix::from_fn(self.rows, self.rows, |a, b| self.at(a, b));
        matrix.cholesky().expect("a positive matrix").solve(right_side)
    }

    fn factors(&self) -> IncompleteCholesky {
        let mut factors = IncompleteCholesky::default();
        factors.factorise(self.rows, self.rows, self);
        factors
    }

    fn solve<const D: usize>(
        &self,
        unknown: &mut [Vector<D>],
        right_side: &[Vector<D>],
        deflated: bool,
        criterion: Criterion,
    ) -> Result<(), NotConverged> {
        let sums = self.row_sums();
        let of_constant = deflated.then_some(sums.as_slice());
        let mut solver = ConjugateGradient::default();
        solver.solve(unknown, right_side, &mut self.factors(), of_constant, criterion, |x, out| {
            for (a, out) in out.iter_mut().enumerate() {
                *out = x.iter().enumerate().fold(Vector::zeros(), |sum, (b, x)| sum + x * self.at(a, b));
            }
        })
    }

    fn solve_numbers(&self, unknown: &mut [f64], right_side: &[f64], criterion: Criterion) -> Result<(), NotConverged> {
        let mut solver = ConjugateGradient::default();
        let outcome = solver.solve(unknown, right_side, &mut self.factors(), None, criterion, |x, out| {
            for (a, out) in out.iter_mut().enumerate() {
                *out = x.iter().enumerate().map(|(b, x)| x * self.at(a, b)).sum();
            }
        });
        assert_eq!(outcome.is_ok(), solver.iterations > 0 || right_side.iter().all(|&value| value == 0.0));
        outcome
    }
}

impl Rows for Dense {
    fn diagonal(&self, row: usize) -> f64 {
        self.at(row, row)
    }

    fn off_diagonal(&self, row: usize) -> impl Iterator<Item = (u32, f64)> {
        (0..self.rows).filter(move |&b| b != row && self.at(row, b) != 0.0).map(move |b| (b as u32, self.at(row, b)))
    }
}

#[test]
fn numbers_agree_with_direct_factors() {
    for (seed, rows) in [(1, 1), (2, 2), (3, 17), (4, 120)] {
        let matrix = Dense::springs(rows, |a| 1.0 + a as f64, seed);
        let mut random = random(100 + seed);
        let right: Vec<f64> = (0..rows).map(|_| random.random::<f64>() - 0.5).collect();
        let exact = matrix.direct(&DMatrix::from_fn(rows, 1, |a, _| right[a]));
        let mut found: Vec<f64> = (0..rows).map(|_| 10.0 * random.random::<f64>()).collect();
        assert_eq!(matrix.solve_numbers(&mut found, &right, TIGHT), Ok(()));
        let largest = (0..rows).map(|a| exact[(a, 0)].abs()).fold(0.0, f64::max);
        for a in 0..rows {
            assert!((found[a] - exact[(a, 0)]).abs() < 1e-9 * largest, "{rows} rows, {a}");
        }
    }
}

#[test]
fn vectors_agree_with_direct_factors_with_and_without_deflation() {
    // 1500 rows would make two blocks, but a dense direct solve slow: blocks have a test of their own
    for (deflated, hold) in [(false, 1.0), (true, 1.0), (true, 1e-4)] {
        let rows = 90;
        let matrix = Dense::springs(rows, |_| hold, 7);
        let mut random = random(9);
        let right: Vec<Vector<3>> =
            (0..rows).map(|_| Vector::<3>::from_fn(|_, _| random.random::<f64>() - 0.3)).collect();
        let exact = matrix.direct(&DMatrix::from_fn(rows, 3, |a, axis| right[a][axis]));
        let mut found = vec![Vector::zeros(); rows];
        matrix.solve(&mut found, &right, deflated, TIGHT).expect("a solution");
        let largest = right.iter().map(Vector::norm).fold(0.0, f64::max) / hold;
        for a in 0..rows {
            for axis in 0..3 {
                let error = (found[a][axis] - exact[(a, axis)]).abs();
                assert!(error < 1e-9 * largest, "deflated {deflated}, held with {hold}: row {a} is off by {error:.1e}");
            }
        }
    }
}

#[test]
fn deflation_closes_the_sum_of_the_residual_whatever_the_tolerance() {
    let rows = 200;
    let matrix = Dense::springs(rows, |a| 1.0 + (a % 3) as f64, 11);
    let mut random = random(12);
    let right: Vec<Vector<2>> = (0..rows).map(|_| Vector::<2>::from_fn(|_, _| random.random::<f64>())).collect();
    let sums = matrix.row_sums();
    // the sum of the rows of A x is that of the row sums times x
    let open = |deflated| {
        let mut found = vec![Vector::zeros(); rows];
        matrix.solve(&mut found, &right, deflated, Criterion { tolerance: 0.1, most_iterations: 100 }).expect("loose");
        let mut sum = Vector::<2>::zeros();
        for a in 0..rows {
            sum += right[a] - found[a] * sums[a];
        }
        sum.norm() / right.iter().fold(Vector::<2>::zeros(), |sum, right| sum + right).norm()
    };
    assert!(open(true) < 1e-13, "{:.1e}", open(true));
    assert!(open(false) > 1e-6, "the test can fail: {:.1e}", open(false));
}

#[test]
fn blocks_of_factors_lead_to_the_same_solution() {
    // a chain across three blocks, whose exact solution is known: unit springs, ends and all held with 1e-3
    struct Chain(usize);
    impl Rows for Chain {
        fn diagonal(&self, row: usize) -> f64 {
            1e-3 + f64::from(u8::from(row > 0)) + f64::from(u8::from(row + 1 < self.0))
        }
        fn off_diagonal(&self, row: usize) -> impl Iterator<Item = (u32, f64)> {
            let neighbours = [row.checked_sub(1), Some(row + 1).filter(|&next| next < self.0)];
            neighbours.into_iter().flatten().map(|b| (b as u32, -1.0))
        }
    }
    let chain = Chain(2500);
    let apply = |x: &[f64], out: &mut [f64]| {
        for (a, out) in out.iter_mut().enumerate() {
            *out = chain.off_diagonal(a).fold(chain.diagonal(a) * x[a], |sum, (b, value)| sum + value * x[b as usize]);
        }
    };
    let exact: Vec<f64> = (0..chain.0).map(|a| (a as f64 * 0.01).sin() + 2.0).collect();
    let mut right = vec![0.0; chain.0];
    apply(&exact, &mut right);
    let mut factors = IncompleteCholesky::default();
    factors.factorise(chain.0, 2, &chain);
    let mut solver = ConjugateGradient::default();
    let mut found = vec![0.0; chain.0];
    solver.solve(&mut found, &right, &mut factors, None, TIGHT, apply).expect("a solution");
    let worst = found.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(worst < 1e-8, "{worst:.1e}");
    // the factors of a chain are exact within a block: only the two joints are left
    assert!(solver.iterations < 10, "{} iterations", solver.iterations);
}

#[test]
fn nothing_on_the_right_side_gives_nothing() {
    let matrix = Dense::springs(20, |_| 1.0, 5);
    let mut found = vec![3.0; 20];
    assert_eq!(matrix.solve_numbers(&mut found, &[0.0; 20], TIGHT), Ok(()));
    assert_eq!(found, [0.0; 20]);
}

#[test]
fn a_singular_system_names_its_row() {
    // row 3 is free and pushed: no solution
    let mut matrix = Dense { rows: 6, value: vec![0.0; 36] };
    for a in 0..6 {
        matrix.value[a * 6 + a] = if a == 3 { 0.0 } else { 2.0 };
    }
    let outcome = ConjugateGradient::default().solve(
        &mut [0.0; 6],
        &[0.0, 0.0, 0.0, 5.0, 0.0, 0.0],
        &mut vec![0.5, 0.5, 0.5, 1.0, 0.5, 0.5],
        None,
        Criterion { tolerance: 1e-6, most_iterations: 50 },
        |x, out| (0..6).for_each(|a| out[a] = matrix.at(a, a) * x[a]),
    );
    let failed = outcome.expect_err("no solution");
    assert_eq!(failed.row, 3);
    assert!(failed.residual > 0.1, "{failed:?}");
}

#[test]
fn too_few_iterations_and_invalid_numbers_are_errors() {
    let matrix = Dense::springs(60, |_| 1e-3, 21);
    let right: Vec<f64> = (0..60).map(|a| f64::from(a % 7)).collect();
    let few = Criterion { tolerance: 1e-12, most_iterations: 2 };
    let failed = matrix.solve_numbers(&mut [0.0; 60], &right, few).expect_err("two iterations");
    assert!(failed.residual > 1e-12 && failed.residual.is_finite());
    let mut spoilt = right.clone();
    spoilt[41] = f64::NAN;
    let failed = matrix.solve_numbers(&mut [0.0; 60], &spoilt, TIGHT).expect_err("a NaN");
    assert_eq!(failed.row, 41);
    assert!(failed.residual.is_nan());
}

#[test]
fn rows_in_lanes_give_the_product_that_their_entries_give_one_by_one() {
    // 8·k + 5 rows of unequal length, some of them empty; more than a task of the product
    for rows in [1, 5, 13, 2061] {
        let mut random = random(17);
        let entries: Vec<Vec<(u32, f64)>> = (0..rows)
            .map(|row| {
                let length = if row % 7 == 3 { 0 } else { random.random_range(0..12) };
                (0..length).map(|_| (random.random_range(0..rows as u32), random.random::<f64>())).collect()
            })
            .collect();
        let diagonal: Vec<f64> = (0..rows).map(|_| random.random::<f64>()).collect();
        let u: Vec<_> = (0..rows).map(|_| Vector::<2>::new(random.random(), random.random())).collect();
        let mut lanes = LaneRows::<Single>::default();
        let mut seen = vec![0; rows];
        // twice: what is left of longer rows must not come back
        for shortest in [0, 1] {
            lanes.fill(rows, 12, seen.par_chunks_mut(8), |first, group, seen| {
                for (lane, seen) in seen.iter_mut().enumerate() {
                    let kept = &entries[first + lane][shortest.min(entries[first + lane].len())..];
                    group.row(lane, |row| kept.iter().for_each(|&(column, value)| row.push(column, value)));
                    *seen += kept.len();
                }
            });
        }
        let mut product = vec![Vector::zeros(); rows];
        TwoRows { first: &LaneRows::default(), all: &lanes }.subtract_from_diagonal(&diagonal, &u, &mut product);
        for row in 0..rows {
            let kept: Vec<_> = entries[row].iter().skip(1).map(|&(b, value)| (b, single(value))).collect();
            assert_eq!(lanes.row(row).collect::<Vec<_>>(), kept, "row {row} of {rows}");
            let sum = kept.iter().fold(Vector::zeros(), |sum, &(b, value)| sum + u[b as usize] * value);
            assert_eq!(product[row], u[row] * diagonal[row] - sum, "row {row} of {rows}");
        }
    }
}
