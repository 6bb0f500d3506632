//! Partners of every particle, images included, by trying every pair, and what follows from their places.

use bagnold_solver::internals::weakly_compressible::State;
use bagnold_solver::vector::{Tensor, Vector};
use nalgebra::DMatrix;

/// A partner of a particle.
pub(super) struct Pair<const D: usize> {
    /// Its storage index, and that of the particle that it is an image of.
    pub(super) index: usize,
    pub(super) source: usize,
    sign: Vector<D>,
    /// r_ab `[m]`.
    pub(super) r: Vector<D>,
    /// V_b F `[1/m²]` and V_b W `[-]`.
    pub(super) weight: f64,
    pub(super) value: f64,
}

impl<const D: usize> Pair<D> {
    pub(super) fn vector(&self, values: &[Vector<D>]) -> Vector<D> {
        self.sign.component_mul(&values[self.source])
    }

    pub(super) fn tensor(&self, values: &[Tensor<D>]) -> Tensor<D> {
        Tensor::from_fn(|i, j| self.sign[i] * self.sign[j] * values[self.source][(i, j)])
    }
}

/// The partners of all flow and wall particles, images included, by trying every pair.
pub(super) fn pairs_of<const D: usize>(state: &State<D>, volume: &[f64]) -> Vec<Vec<Pair<D>>> {
    let (kernel, position, real) = (&state.model.kernel, &state.particles.position, state.particles.real_count());
    let images = state.images.entries().map(|(index, source, sign)| (index, source, *sign));
    let all: Vec<_> = (0..real).map(|k| (k, k, Vector::repeat(1.0))).chain(images).collect();
    let of = |a: usize| {
        let others = all.iter().filter(|(index, ..)| *index != a);
        let partners = others.filter_map(|&(index, source, sign)| {
            let r = position[a] - position[index];
            let (distance, volume) = (r.norm(), volume[source]);
            (distance < kernel.support()).then(|| {
                let (weight, value) = (kernel.gradient_factor_at(distance), kernel.value_at(distance));
                Pair { index, source, sign, r, weight: volume * weight, value: volume * value }
            })
        });
        partners.collect()
    };
    (0..real).map(of).collect()
}

/// Moment matrix of a particle, its smallest eigenvalue, and L and E.
pub(super) fn corrections<const D: usize>(pairs: &[Pair<D>]) -> (f64, Tensor<D>, Tensor<D>) {
    let moment = pairs.iter().fold(Tensor::<D>::zeros(), |sum, b| sum - b.r * b.r.transpose() * b.weight);
    let eigenvalue = DMatrix::from_fn(D, D, |i, j| moment[(i, j)]).symmetric_eigen().eigenvalues.min();
    let inverse = moment.try_inverse().expect("neighbours all around");
    let blend = |from: f64| {
        let share = ((eigenvalue - from) / 0.2).clamp(0.0, 1.0);
        inverse * share + Tensor::identity() * (1.0 - share)
    };
    (eigenvalue, blend(0.1), blend(0.6))
}
