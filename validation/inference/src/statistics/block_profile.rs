//! Profiles over the height, in bins of one spacing and blocks of time.

use super::{BLOCKS, FittedValue, block_jackknife};
use nalgebra::Vector2;
use serde::{Deserialize, Serialize};
use std::ops::Range;

/// The samples (particles × times) of one bin, as sums of one block of time or as averages.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct ProfilePoint {
    /// Number of samples.
    pub samples: f64,
    /// Height of the samples `[m]`.
    pub height: f64,
    /// Velocity along the floor `[m/s]`.
    pub velocity: f64,
    /// Pressure `[Pa]`.
    pub pressure: f64,
}

/// A profile over the averaging window.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct BlockProfile {
    /// Lower edge of the lowest bin `[m]`.
    pub bottom: f64,
    /// Height of a bin `[m]`.
    pub bin: f64,
    /// Times that were sampled.
    pub times: usize,
    /// Sums, shape `[bins][blocks of time]`.
    pub sums: Vec<Vec<ProfilePoint>>,
}

impl BlockProfile {
    /// An empty profile of `bins` bins of the height `bin` `[m]` from `bottom` `[m]`.
    pub fn new(bottom: f64, bin: f64, bins: usize) -> Self {
        Self { bottom, bin, times: 0, sums: vec![vec![ProfilePoint::default(); BLOCKS]; bins] }
    }

    /// A profile that is known without samples: the same in every block of time, so without a statistical error.
    pub fn known(points: impl IntoIterator<Item = ProfilePoint>) -> Self {
        let blocks = |point: ProfilePoint| vec![ProfilePoint { samples: 1.0, ..point }; BLOCKS];
        Self { bottom: 0.0, bin: 1.0, times: BLOCKS, sums: points.into_iter().map(blocks).collect() }
    }

    /// Adds a sample at `share` of the averaging window, 0 … 1: the particles' positions `[m]`, velocities `[m/s]` and
    /// pressures `[Pa]`. What lies outside of the bins is left out.
    pub fn observe(&mut self, share: f64, position: &[Vector2<f64>], velocity: &[Vector2<f64>], pressure: &[f64]) {
        let block = Self::block(share);
        self.times += 1;
        for ((x, v), p) in position.iter().zip(velocity).zip(pressure) {
            let Some(bin) = self.bin_at(x[1]) else { continue };
            let sums = &mut self.sums[bin][block];
            sums.samples += 1.0;
            sums.height += x[1];
            sums.velocity += v[0];
            sums.pressure += p;
        }
    }

    /// The block of time at `share` of the averaging window, 0 … 1.
    pub fn block(share: f64) -> usize {
        ((share * BLOCKS as f64).max(0.0) as usize).min(BLOCKS - 1)
    }

    /// The bin that a height `[m]` lies in; none outside of the bins.
    pub fn bin_at(&self, height: f64) -> Option<usize> {
        let bin = ((height - self.bottom) / self.bin).floor();
        (bin >= 0.0 && bin < self.sums.len() as f64).then_some(bin as usize)
    }

    /// The bins that hold samples, from below.
    pub fn points(&self) -> Vec<ProfilePoint> {
        self.points_without(0..0)
    }

    fn points_without(&self, left_out: Range<usize>) -> Vec<ProfilePoint> {
        self.sums.iter().filter_map(|blocks| mean_without(blocks, &left_out)).collect()
    }

    /// Velocity of every bin that holds samples, from below, with its statistical error `[m/s]`.
    pub fn velocities(&self) -> Vec<FittedValue> {
        let filled = self.sums.iter().filter(|blocks| mean_without(blocks, &(0..0)).is_some());
        filled
            .map(|blocks| {
                let without = |left_out| mean_without(blocks, &left_out).map_or(f64::NAN, |point| point.velocity);
                block_jackknife(BLOCKS, without).estimate()
            })
            .collect()
    }

    /// A statistic of the whole profile with its statistical error.
    pub fn estimate(&self, statistic: impl Fn(&[ProfilePoint]) -> f64) -> FittedValue {
        block_jackknife(BLOCKS, |left_out| statistic(&self.points_without(left_out))).estimate()
    }
}

fn mean_without(blocks: &[ProfilePoint], left_out: &Range<usize>) -> Option<ProfilePoint> {
    let mut sum = ProfilePoint::default();
    for (_, add) in blocks.iter().enumerate().filter(|(block, _)| !left_out.contains(block)) {
        sum.samples += add.samples;
        sum.height += add.height;
        sum.velocity += add.velocity;
        sum.pressure += add.pressure;
    }
    let n = sum.samples;
    let [height, velocity, pressure] = [sum.height, sum.velocity, sum.pressure].map(|sum| sum / n);
    (n > 0.0).then_some(ProfilePoint { samples: n, height, velocity, pressure })
}
