//! Lattices against what a preconditioner must be, and what they are for.

use super::*;
use crate::linear::{ConjugateGradient, Criterion};
use rand::{RngExt, SeedableRng};
use rand_pcg::Pcg64Mcg;

const SPACING: f64 = 0.1;

/// Displaced particles, periodic along the first axis, with springs of one between neighbours of the undisturbed lattice over
/// the square of their distance; those of the upper row are held as well.
struct Springs {
    cells: [usize; 2],
    positions: Vec<Vector<2>>,
}

impl Springs {
    fn of(cells: [usize; 2]) -> Self {
        let mut random = Pcg64Mcg::seed_from_u64(3);
        let mut jitter = || 0.4 * random.random::<f64>() + 0.3;
        let site = |k: usize| ((k % cells[0]) as f64, (k / cells[0]) as f64);
        let position = |k| Vector::<2>::new(site(k).0 + jitter(), site(k).1 + jitter()) * SPACING;
        Self { cells, positions: (0..cells[0] * cells[1]).map(position).collect() }
    }

    fn stiffness() -> f64 {
        1.0 / (SPACING * SPACING)
    }

    fn partners(&self, a: usize) -> impl Iterator<Item = usize> {
        let [along, up] = self.cells;
        let (i, k) = (a % along, a / along);
        let sides = [k * along + (i + 1) % along, k * along + (i + along - 1) % along];
        let below = k.checked_sub(1).map(|k| k * along + i);
        let above = Some(k + 1).filter(|&k| k < up).map(|k| k * along + i);
        sides.into_iter().chain(below).chain(above)
    }

    fn held(&self, a: usize) -> f64 {
        if a / self.cells[0] + 1 == self.cells[1] { 2.0 * Self::stiffness() } else { 0.0 }
    }

    fn diagonal(&self, a: usize) -> f64 {
        self.partners(a).count() as f64 * Self::stiffness() + self.held(a)
    }

    fn apply(&self, p: &[f64], out: &mut [f64]) {
        for (a, out) in out.iter_mut().enumerate() {
            *out = self.diagonal(a) * p[a] - self.partners(a).map(|b| p[b] * Self::stiffness()).sum::<f64>();
        }
    }

    fn lattices(&self) -> Lattices<2> {
        let upper = self.cells[0] as f64 * SPACING;
        let domain = Domain { axes: [AxisBoundary::Periodic { lower: 0.0, upper }, AxisBoundary::Open] };
        let mut lattices = Lattices::default();
        let inverse = (0..self.positions.len()).map(|a| 1.0 / self.diagonal(a));
        lattices.lay(&self.positions, &domain, SPACING, inverse, |a| (1.0, self.held(a)));
        lattices
    }

    fn iterations(&self) -> u64 {
        let mut random = Pcg64Mcg::seed_from_u64(4);
        let right: Vec<f64> = self.positions.iter().map(|x| 1.0 + x[1] + random.random::<f64>()).collect();
        let mut found = vec![0.0; right.len()];
        let mut solver = ConjugateGradient::default();
        let criterion = Criterion { tolerance: 1e-6, most_iterations: 1000 };
        let apply = |p: &[f64], out: &mut [f64]| self.apply(p, out);
        solver.solve(&mut found, &right, &mut self.lattices(), None, criterion, apply).expect("a solution");
        solver.iterations
    }
}

fn field(count: usize, seed: u64) -> Vec<f64> {
    let mut random = Pcg64Mcg::seed_from_u64(seed);
    (0..count).map(|_| random.random::<f64>() - 0.5).collect()
}

fn product(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[test]
fn the_preconditioner_is_symmetric_and_positive() {
    for cells in [[24, 17], [7, 40], [61, 5], [3, 2]] {
        let springs = Springs::of(cells);
        let (mut lattices, count) = (springs.lattices(), springs.positions.len());
        let (r, s) = (field(count, 1), field(count, 2));
        let (mut of_r, mut of_s) = (vec![0.0; count], vec![0.0; count]);
        lattices.apply(&r, &mut of_r);
        lattices.apply(&s, &mut of_s);
        let scale = (product(&r, &of_r) * product(&s, &of_s)).sqrt();
        assert!(scale > 0.0 && product(&r, &of_r) > 0.0);
        assert!((product(&s, &of_r) - product(&r, &of_s)).abs() < 1e-13 * scale, "{cells:?}");
    }
}

#[test]
fn a_level_passes_on_the_whole_of_a_residual() {
    // the functions of a lattice add up to one everywhere
    let springs = Springs::of([48, 30]);
    let mut lattices = springs.lattices();
    let residual = field(springs.positions.len(), 5);
    lattices.restrict(&residual);
    let whole: f64 = residual.iter().sum();
    assert!(lattices.number > 2, "{} levels", lattices.number);
    for level in 0..lattices.number {
        let sum: f64 = if level == 0 {
            lattices.levels[0].value.iter().sum()
        } else {
            let (before, after) = lattices.levels.split_at_mut(level);
            let coarse = &mut after[0];
            for node in 0..coarse.value.len() {
                let place = split(node, coarse.nodes);
                coarse.value[node] = from_finer(place, coarse.ratio, &before[level - 1], lattices.periodic);
            }
            coarse.value.iter().sum()
        };
        assert!((sum - whole).abs() < 1e-12, "level {level}: {sum} of {whole}");
    }
}

#[test]
fn iterations_hardly_grow_with_the_number_of_particles() {
    let [few, many] = [[24, 16], [192, 128]].map(|cells| Springs::of(cells).iterations());
    // the diagonal alone takes eight times as many
    assert!(few >= 5 && many < 2 * few, "{few} and {many} iterations");
}

#[test]
fn the_result_is_the_same_on_any_number_of_threads() {
    let springs = Springs::of([160, 64]);
    let residual = field(springs.positions.len(), 6);
    let [one, three] = [1, 3].map(|threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        let mut out = vec![0.0; residual.len()];
        pool.install(|| springs.lattices().apply(&residual, &mut out));
        out
    });
    assert_eq!(one, three);
}
