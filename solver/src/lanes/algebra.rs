//! Small vector and tensor algebra, lane by lane.
//!
//! Loops and no closures: only what is inlined without fail is compiled for the chosen instruction set.

use super::Lanes;
use crate::vector::{Tensor, Vector};

/// The same vector in every lane.
#[inline(always)]
pub fn splat_vector<V: Lanes, const D: usize>(vector: &Vector<D>) -> [V; D] {
    let mut lanes = [V::splat(0.0); D];
    for i in 0..D {
        lanes[i] = V::splat(vector[i]);
    }
    lanes
}

/// The same tensor in every lane, indexed `[row][column]`.
#[inline(always)]
pub fn splat_tensor<V: Lanes, const D: usize>(tensor: &Tensor<D>) -> [[V; D]; D] {
    let mut lanes = [[V::splat(0.0); D]; D];
    for i in 0..D {
        for j in 0..D {
            lanes[i][j] = V::splat(tensor[(i, j)]);
        }
    }
    lanes
}

/// a − b.
#[inline(always)]
pub fn difference<V: Lanes, const D: usize>(a: &[V; D], b: &[V; D]) -> [V; D] {
    let mut lanes = *a;
    for i in 0..D {
        lanes[i] = a[i] - b[i];
    }
    lanes
}

/// a + b.
#[inline(always)]
pub fn sum_of<V: Lanes, const D: usize>(a: &[V; D], b: &[V; D]) -> [V; D] {
    let mut lanes = *a;
    for i in 0..D {
        lanes[i] = a[i] + b[i];
    }
    lanes
}

/// f a with one factor a lane.
#[inline(always)]
pub fn scaled<V: Lanes, const D: usize>(factor: V, a: &[V; D]) -> [V; D] {
    let mut lanes = *a;
    for i in 0..D {
        lanes[i] = factor * a[i];
    }
    lanes
}

/// Scalar product.
#[inline(always)]
pub fn dot<V: Lanes, const D: usize>(a: &[V; D], b: &[V; D]) -> V {
    let mut sum = a[0] * b[0];
    for i in 1..D {
        sum = sum + a[i] * b[i];
    }
    sum
}

/// T a.
#[inline(always)]
pub fn product<V: Lanes, const D: usize>(tensor: &[[V; D]; D], a: &[V; D]) -> [V; D] {
    let mut lanes = *a;
    for i in 0..D {
        lanes[i] = dot(&tensor[i], a);
    }
    lanes
}

/// Adds f a to a sum.
#[inline(always)]
pub fn accumulate<V: Lanes, const D: usize>(sum: &mut [V; D], factor: V, a: &[V; D]) {
    for i in 0..D {
        sum[i] = sum[i] + factor * a[i];
    }
}

/// Adds f a ⊗ b to a sum.
#[inline(always)]
pub fn accumulate_outer<V: Lanes, const D: usize>(sum: &mut [[V; D]; D], factor: V, a: &[V; D], b: &[V; D]) {
    for i in 0..D {
        let weighted = factor * a[i];
        for j in 0..D {
            sum[i][j] = sum[i][j] + weighted * b[j];
        }
    }
}

/// The sum over the lanes of every component.
#[inline(always)]
pub fn reduce_vector<V: Lanes, const D: usize>(lanes: &[V; D]) -> Vector<D> {
    let mut vector = Vector::zeros();
    for i in 0..D {
        vector[i] = lanes[i].sum();
    }
    vector
}

/// The sum over the lanes of every component.
#[inline(always)]
pub fn reduce_tensor<V: Lanes, const D: usize>(lanes: &[[V; D]; D]) -> Tensor<D> {
    let mut tensor = Tensor::zeros();
    for i in 0..D {
        for j in 0..D {
            tensor[(i, j)] = lanes[i][j].sum();
        }
    }
    tensor
}
