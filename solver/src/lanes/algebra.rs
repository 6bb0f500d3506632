//! Small vector and tensor algebra, lane by lane.
//!
//! Loops and no closures: only what is inlined without fail is compiled for the chosen instruction set.

use super::{LANES, Lanes, Real};
use crate::vector::{Tensor, Vector};

/// Zero, shape `[D]`.
#[inline(always)]
pub fn zero_vector<V: Real, const D: usize>() -> [V; D] {
    [V::splat(0.0); D]
}

/// Zero, shape `[D, D]`.
#[inline(always)]
pub fn zero_tensor<V: Real, const D: usize>() -> [[V; D]; D] {
    [[V::splat(0.0); D]; D]
}

/// The same vector in every lane.
#[inline(always)]
pub fn splat_vector<V: Real, const D: usize>(vector: &Vector<D>) -> [V; D] {
    let mut lanes = [V::splat(0.0); D];
    for i in 0..D {
        lanes[i] = V::splat(vector[i]);
    }
    lanes
}

/// a − b.
#[inline(always)]
pub fn difference<V: Real, const D: usize>(a: &[V; D], b: &[V; D]) -> [V; D] {
    let mut lanes = *a;
    for i in 0..D {
        lanes[i] = a[i] - b[i];
    }
    lanes
}

/// a + b.
#[inline(always)]
pub fn sum_of<V: Real, const D: usize>(a: &[V; D], b: &[V; D]) -> [V; D] {
    let mut lanes = *a;
    for i in 0..D {
        lanes[i] = a[i] + b[i];
    }
    lanes
}

/// f a with one factor a lane.
#[inline(always)]
pub fn scaled<V: Real, const D: usize>(factor: V, a: &[V; D]) -> [V; D] {
    let mut lanes = *a;
    for i in 0..D {
        lanes[i] = factor * a[i];
    }
    lanes
}

/// Scalar product.
#[inline(always)]
pub fn dot<V: Real, const D: usize>(a: &[V; D], b: &[V; D]) -> V {
    let mut sum = a[0] * b[0];
    for i in 1..D {
        sum = sum + a[i] * b[i];
    }
    sum
}

/// T a.
#[inline(always)]
pub fn product<V: Real, const D: usize>(tensor: &[[V; D]; D], a: &[V; D]) -> [V; D] {
    let mut lanes = *a;
    for i in 0..D {
        lanes[i] = dot(&tensor[i], a);
    }
    lanes
}

/// Adds f a to a sum.
#[inline(always)]
pub fn accumulate<V: Real, const D: usize>(sum: &mut [V; D], factor: V, a: &[V; D]) {
    for i in 0..D {
        sum[i] = sum[i] + factor * a[i];
    }
}

/// Adds f a ⊗ b to a sum.
#[inline(always)]
pub fn accumulate_outer<V: Real, const D: usize>(sum: &mut [[V; D]; D], factor: V, a: &[V; D], b: &[V; D]) {
    for i in 0..D {
        let weighted = factor * a[i];
        for j in 0..D {
            sum[i][j] = sum[i][j] + weighted * b[j];
        }
    }
}

/// A B.
#[inline(always)]
pub fn matrix_product<V: Real, const D: usize>(a: &[[V; D]; D], b: &[[V; D]; D]) -> [[V; D]; D] {
    let mut lanes = *a;
    for i in 0..D {
        for j in 0..D {
            let mut sum = a[i][0] * b[0][j];
            for k in 1..D {
                sum = sum + a[i][k] * b[k][j];
            }
            lanes[i][j] = sum;
        }
    }
    lanes
}

/// ε′, the deviator of ½(G + Gᵀ), of a velocity gradient G; its trace is shared over D directions.
#[inline(always)]
pub fn deviatoric_rate<V: Real, const D: usize>(gradient: &[[V; D]; D]) -> [[V; D]; D] {
    let mut lanes = *gradient;
    let mut trace = gradient[0][0];
    for i in 1..D {
        trace = trace + gradient[i][i];
    }
    let mean = trace * V::splat(1.0 / D as f64);
    for i in 0..D {
        for j in 0..D {
            lanes[i][j] = V::splat(0.5) * (gradient[i][j] + gradient[j][i]);
        }
        lanes[i][i] = gradient[i][i] - mean;
    }
    lanes
}

/// A:B.
#[inline(always)]
pub fn contraction<V: Real, const D: usize>(a: &[[V; D]; D], b: &[[V; D]; D]) -> V {
    let mut sum = dot(&a[0], &b[0]);
    for i in 1..D {
        sum = sum + dot(&a[i], &b[i]);
    }
    sum
}

/// √(c T:T).
#[inline(always)]
pub fn invariant<V: Real, const D: usize>(factor: f64, tensor: &[[V; D]; D]) -> V {
    let mut sum = tensor[0][0] * tensor[0][0];
    for i in 0..D {
        for j in 0..D {
            if i + j > 0 {
                sum = sum + tensor[i][j] * tensor[i][j];
            }
        }
    }
    (V::splat(factor) * sum).sqrt()
}

/// f T with one factor a lane.
#[inline(always)]
pub fn scaled_tensor<V: Real, const D: usize>(factor: V, tensor: &[[V; D]; D]) -> [[V; D]; D] {
    let mut lanes = *tensor;
    for i in 0..D {
        lanes[i] = scaled(factor, &tensor[i]);
    }
    lanes
}

/// Eight values, those that are missing in the place of `rest`.
#[inline(always)]
fn filled<T: Copy>(values: &[T], rest: T) -> [T; LANES] {
    let mut all = [rest; LANES];
    all[..values.len()].copy_from_slice(values);
    all
}

/// One value a lane, at most eight; zero in the lanes that are left.
#[inline(always)]
pub fn load<V: Lanes>(values: &[f64]) -> V {
    let partial;
    V::load(match values.first_chunk() {
        Some(all) => all,
        None => {
            partial = filled(values, 0.0);
            &partial
        }
    })
}

/// One vector a lane, at most eight; zero in the lanes that are left.
#[inline(always)]
pub fn load_vector<V: Lanes, const D: usize>(vectors: &[Vector<D>]) -> [V; D] {
    let partial;
    let all = match vectors.first_chunk::<LANES>() {
        Some(all) => all,
        None => {
            partial = filled(vectors, Vector::zeros());
            &partial
        }
    };
    let mut lanes = zero_vector::<V, D>();
    for i in 0..D {
        let mut values = [0.0; LANES];
        for lane in 0..LANES {
            values[lane] = all[lane][i];
        }
        lanes[i] = V::load(&values);
    }
    lanes
}

/// One tensor a lane, at most eight; zero in the lanes that are left.
#[inline(always)]
pub fn load_tensor<V: Lanes, const D: usize>(tensors: &[Tensor<D>]) -> [[V; D]; D] {
    let partial;
    let all = match tensors.first_chunk::<LANES>() {
        Some(all) => all,
        None => {
            partial = filled(tensors, Tensor::zeros());
            &partial
        }
    };
    let mut lanes = zero_tensor::<V, D>();
    for place in 0..D * D {
        let mut values = [0.0; LANES];
        for lane in 0..LANES {
            values[lane] = all[lane][place];
        }
        lanes[place % D][place / D] = V::load(&values);
    }
    lanes
}

/// Copies eight values as far as `out` goes.
#[inline(always)]
fn copy<T: Copy>(all: &[T; LANES], out: &mut [T]) {
    match out.first_chunk_mut() {
        Some(out) => *out = *all,
        None => out.copy_from_slice(&all[..out.len()]),
    }
}

/// Writes a value a lane as far as `out` goes, at most eight.
#[inline(always)]
pub fn store<V: Lanes>(lanes: V, out: &mut [f64]) {
    copy(&lanes.to_array(), out);
}

/// Writes a vector a lane as far as `out` goes, at most eight.
#[inline(always)]
pub fn store_vector<V: Lanes, const D: usize>(lanes: &[V; D], out: &mut [Vector<D>]) {
    let mut all = [Vector::zeros(); LANES];
    for i in 0..D {
        let values = lanes[i].to_array();
        for lane in 0..LANES {
            all[lane][i] = values[lane];
        }
    }
    copy(&all, out);
}

/// Writes a tensor a lane as far as `out` goes, at most eight.
#[inline(always)]
pub fn store_tensor<V: Lanes, const D: usize>(lanes: &[[V; D]; D], out: &mut [Tensor<D>]) {
    let mut all = [Tensor::zeros(); LANES];
    for place in 0..D * D {
        let values = lanes[place % D][place / D].to_array();
        for lane in 0..LANES {
            all[lane][place] = values[lane];
        }
    }
    copy(&all, out);
}
