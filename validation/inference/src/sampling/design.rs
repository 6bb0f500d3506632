//! Points spread over the unit cube.

use super::random::Random;

/// All combinations of one number below `counts[k]` for each k, the last fastest.
#[must_use]
pub fn combinations(counts: &[usize]) -> Vec<Vec<usize>> {
    counts.iter().fold(vec![Vec::new()], |heads, &count| {
        let with = |head: &Vec<usize>| {
            let head = head.clone();
            (0..count).map(move |last| [head.as_slice(), &[last]].concat())
        };
        heads.iter().flat_map(with).collect()
    })
}

/// All combinations of equally spaced levels, the last coordinate fastest; one level is the middle.
#[must_use]
pub fn full_grid(levels: &[usize]) -> Vec<Vec<f64>> {
    let coordinate = |(&level, &of): (&usize, &usize)| if of == 1 { 0.5 } else { level as f64 / (of - 1) as f64 };
    combinations(levels).iter().map(|point| point.iter().zip(levels).map(coordinate).collect()).collect()
}

/// A Latin hypercube: of `points` slices of every coordinate each holds one point, somewhere within.
#[must_use]
pub fn latin_hypercube(points: usize, dimensions: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut random = Random::new(seed);
    let mut result = vec![vec![0.0; dimensions]; points];
    for k in 0..dimensions {
        let mut slices: Vec<usize> = (0..points).collect();
        random.shuffle(&mut slices);
        for (point, slice) in result.iter_mut().zip(slices) {
            point[k] = (slice as f64 + random.uniform()) / points as f64;
        }
    }
    result
}

/// The first points of a Sobol sequence, scrambled by Owen's method: evenly spread, and more may follow later. At most
/// 65 536 points and 256 dimensions.
#[must_use]
pub fn sobol(points: usize, dimensions: usize, seed: u64) -> Vec<Vec<f64>> {
    // a short seed is taken as it is, of a longer one both halves count
    let seed = (seed ^ (seed >> 32)) as u32;
    let coordinate = |index: usize, k: usize| f64::from(sobol_burley::sample(index as u32, k as u32, seed));
    (0..points).map(|index| (0..dimensions).map(|k| coordinate(index, k)).collect()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_grid_has_all_combinations() {
        let points = full_grid(&[3, 1, 2]);
        assert_eq!(points.len(), 6);
        assert_eq!(points[0], [0.0, 0.5, 0.0]);
        assert_eq!(points[3], [0.5, 0.5, 1.0]);
        assert_eq!(points[5], [1.0, 0.5, 1.0]);
    }

    #[test]
    fn a_latin_hypercube_fills_every_slice_once() {
        let points = latin_hypercube(13, 4, 7);
        for k in 0..4 {
            let mut slices: Vec<usize> = points.iter().map(|point| (13.0 * point[k]) as usize).collect();
            slices.sort_unstable();
            assert_eq!(slices, (0..13).collect::<Vec<_>>());
        }
        assert_eq!(points, latin_hypercube(13, 4, 7));
        assert_ne!(points, latin_hypercube(13, 4, 8));
    }

    /// Sixteen points of a Sobol sequence are a net: each of the 16 boxes 1 × 1/16, 1/2 × 1/8 … holds one.
    #[test]
    fn a_sobol_sequence_is_evenly_spread() {
        for seed in 0..5 {
            let points = sobol(16, 2, seed);
            for power in 0..5 {
                let (across, along) = (1 << power, 16 >> power);
                let cell = |p: &Vec<f64>| (p[0] * f64::from(across)) as i32 * along + (p[1] * f64::from(along)) as i32;
                let mut cells: Vec<i32> = points.iter().map(cell).collect();
                cells.sort_unstable();
                assert_eq!(cells, (0..16).collect::<Vec<_>>());
            }
        }
    }

    #[test]
    fn a_sobol_sequence_is_continued() {
        assert_eq!(sobol(20, 3, 9)[..10], sobol(10, 3, 9));
        assert!(sobol(1000, 3, 9).iter().flatten().all(|u| (0.0..=1.0).contains(u)));
    }
}
