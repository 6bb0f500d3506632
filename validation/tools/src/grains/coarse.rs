//! Coarse graining over the depth: grains and contacts spread by a smoothing function whose integral is 1.
//!
//! Density, momentum and kinetic stress are sums over grains of m W, m v W and m v v W; the contact stress is a sum over contacts of b f
//! along the branch b between the centres. W is a hat over the depth, and a bin takes its integral over the bin: the shares of a grain
//! add up to 1, so that sums over all bins have the mass and the momentum of the grains.
//!
//! Source: I. Goldhirsch, Granular Matter 12 (2010) 239.

use std::collections::BTreeMap;

/// Sums of a bin: of grains m × (1, vx, vy, vx², vy², vx vy, y, y², y vx), of contacts (b_x f_x, b_y f_y, b_y f_x, b_x f_y).
pub(super) type Sums = [f64; 13];

/// Places and weights of Gauss' rule of three points on a branch.
const BRANCH: [(f64, f64); 3] =
    [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

/// Half width of the smoothing function in bins.
const HALF_WIDTH: f64 = 2.0;

/// Sums over frames.
#[derive(Debug, Clone, Default)]
pub(super) struct Window {
    /// Frames, grains, mass and momentum along the flow of the grains themselves.
    pub(super) total: [f64; 4],
    /// Sums by bin.
    pub(super) bins: BTreeMap<i64, Sums>,
}

/// Integral of the hat from −∞ to a distance over its half width.
fn integral(distance: f64) -> f64 {
    let s = distance.clamp(-1.0, 1.0);
    if s < 0.0 { 0.5 * (1.0 + s) * (1.0 + s) } else { 1.0 - 0.5 * (1.0 - s) * (1.0 - s) }
}

impl Window {
    /// Adds values that stand at a height in bins.
    fn spread(&mut self, height: f64, values: &Sums, weight: f64) {
        let last = (height + HALF_WIDTH).floor() as i64;
        let mut below = 0.0;
        for place in (height - HALF_WIDTH).floor() as i64..=last {
            let above = if place == last { 1.0 } else { integral((place as f64 + 1.0 - height) / HALF_WIDTH) };
            add(self.bins.entry(place).or_default(), values, (above - below) * weight);
            below = above;
        }
    }

    /// Adds a grain of a mass at a height, in bins of a height.
    pub(super) fn add_grain(&mut self, bin: f64, mass: f64, y: f64, [vx, vy]: [f64; 2]) {
        let moments = [1.0, vx, vy, vx * vx, vy * vy, vx * vy, y, y * y, y * vx, 0.0, 0.0, 0.0, 0.0];
        add(&mut self.total, &[0.0, 1.0, mass, mass * vx], 1.0);
        self.spread(y / bin, &moments, mass);
    }

    /// Adds a contact of a grain at a height, with the branch to it from the other grain and the force on it.
    pub(super) fn add_contact(&mut self, bin: f64, y: f64, b: [f64; 2], f: [f64; 2]) {
        let mut values = Sums::default();
        values[9..].copy_from_slice(&[b[0] * f[0], b[1] * f[1], b[1] * f[0], b[0] * f[1]]);
        BRANCH.iter().for_each(|(place, weight)| self.spread((y - place * b[1]) / bin, &values, *weight));
    }

    /// Several windows combined into one.
    pub(super) fn merged(windows: &[Self]) -> Self {
        let mut sum = Self::default();
        for window in windows {
            add(&mut sum.total, &window.total, 1.0);
            window.bins.iter().for_each(|(place, more)| add(sum.bins.entry(*place).or_default(), more, 1.0));
        }
        sum
    }
}

fn add(sums: &mut [f64], values: &[f64], weight: f64) {
    sums.iter_mut().zip(values).for_each(|(sum, value)| *sum += weight * value);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sampling::Random;

    #[test]
    fn shares_of_a_grain_and_of_a_contact_add_up_to_one() {
        let mut random = Random::new(5);
        let mut windows = vec![Window::default(); 3];
        let (mut mass, mut momentum, mut stress) = (0.0, 0.0, 0.0);
        for window in &mut windows {
            for _ in 0..4000 {
                let (m, y, vx) = (0.5 + random.uniform(), 20.0 * random.uniform() - 3.0, random.normal());
                window.add_grain(0.35, m, y, [vx, 0.1]);
                window.add_contact(0.35, y, [0.3, random.normal()], [vx, 1.0]);
                (mass, momentum, stress) = (mass + m, momentum + m * vx, stress + 0.3 * vx);
            }
        }
        let all = Window::merged(&windows);
        let sum = |place: usize| all.bins.values().map(|sums| sums[place]).sum::<f64>();
        for (found, expected) in [(sum(0), mass), (sum(1), momentum), (sum(9), stress), (all.total[2], mass)] {
            assert!((found - expected).abs() < 1e-12 * mass, "{found} of {expected}");
        }
    }
}
