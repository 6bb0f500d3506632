//! Symmetric tensors of all particles as passes load them: eight side by side, the upper triangle only.

use super::{LANES, Lanes};
use crate::parallel::ChunksMut;
use crate::parallel::prelude::*;
use serde::{Deserialize, Serialize};

/// One symmetric tensor a particle, in groups of eight: entry by entry of the upper triangle, the values of eight particles.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub struct LaneTensors<const D: usize> {
    values: Vec<[f64; LANES]>,
}

/// Entries of the upper triangle.
const fn entries(dimension: usize) -> usize {
    dimension * (dimension + 1) / 2
}

impl<const D: usize> LaneTensors<D> {
    /// Zeros for a number of particles.
    #[must_use]
    pub fn new(particles: usize) -> Self {
        Self { values: vec![[0.0; LANES]; particles.div_ceil(LANES) * entries(D)] }
    }

    /// Room for a number of particles.
    pub fn resize(&mut self, particles: usize) {
        self.values.resize(particles.div_ceil(LANES) * entries(D), [0.0; LANES]);
    }

    /// Whether there is one tensor for each of a number of particles.
    #[must_use]
    pub fn is_for(&self, particles: usize) -> bool {
        self.values.len() == particles.div_ceil(LANES) * entries(D)
    }

    /// The tensors of the eight particles of a group.
    #[inline(always)]
    #[must_use]
    pub fn load<V: Lanes>(&self, group: usize) -> [[V; D]; D] {
        let mut lanes = [[V::splat(0.0); D]; D];
        let mut place = group * entries(D);
        for i in 0..D {
            for j in i..D {
                lanes[i][j] = V::load(&self.values[place]);
                lanes[j][i] = lanes[i][j];
                place += 1;
            }
        }
        lanes
    }

    /// Parts of a given number of groups, to be written by [`store_symmetric`].
    pub(crate) fn blocks_mut(&mut self, groups: usize) -> ChunksMut<'_, [f64; LANES]> {
        self.values.par_chunks_mut(groups * entries(D))
    }
}

/// Stores symmetric tensors as those of a group of a part.
#[inline(always)]
pub(crate) fn store_symmetric<V: Lanes, const D: usize>(
    part: &mut [[f64; LANES]],
    group: usize,
    tensors: &[[V; D]; D],
) {
    let mut place = group * entries(D);
    for i in 0..D {
        for j in i..D {
            part[place] = tensors[i][j].to_array();
            place += 1;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lanes::{InstructionSet, LanePass};

    #[test]
    fn stored_group_is_loaded_again() {
        struct RoundTrip;
        impl LanePass for RoundTrip {
            #[inline(always)]
            fn run<V: Lanes>(self) {
                let mut all = LaneTensors::<3>::new(17);
                assert!(all.is_for(17) && all.is_for(24) && !all.is_for(25));
                let value =
                    |group: usize, i: usize, j: usize| V::splat((100 * group + 10 * i.min(j) + i.max(j)) as f64);
                let tensor = |group| std::array::from_fn(|i| std::array::from_fn(|j| value(group, i, j)));
                all.blocks_mut(2).enumerate().for_each(|(block, part)| {
                    for group in 2 * block..(2 * block + 2).min(3) {
                        store_symmetric::<V, 3>(part, group - 2 * block, &tensor(group));
                    }
                });
                for group in 0..3 {
                    let loaded: [[V; 3]; 3] = all.load(group);
                    for i in 0..3 {
                        for j in 0..3 {
                            assert_eq!(loaded[i][j].to_array(), value(group, i, j).to_array());
                        }
                    }
                }
            }
        }
        InstructionSet::available().into_iter().for_each(|set| set.run(RoundTrip));
    }
}
