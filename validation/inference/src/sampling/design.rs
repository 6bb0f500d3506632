//! Points spread over the unit cube.

use super::random::Random;

/// All combinations of one number below `counts[k]` for each k, the last fastest.
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
pub fn full_grid(levels: &[usize]) -> Vec<Vec<f64>> {
    let coordinate = |(&level, &of): (&usize, &usize)| if of == 1 { 0.5 } else { level as f64 / (of - 1) as f64 };
    combinations(levels).iter().map(|point| point.iter().zip(levels).map(coordinate).collect()).collect()
}

/// A Latin hypercube: of `points` slices of every coordinate each holds one point, somewhere within.
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
pub fn sobol(points: usize, dimensions: usize, seed: u64) -> Vec<Vec<f64>> {
    // a short seed is taken as it is, of a longer one both halves count
    let seed = (seed ^ (seed >> 32)) as u32;
    let coordinate = |index: usize, k: usize| f64::from(sobol_burley::sample(index as u32, k as u32, seed));
    (0..points).map(|index| (0..dimensions).map(|k| coordinate(index, k)).collect()).collect()
}
