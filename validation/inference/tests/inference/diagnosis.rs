//! Outliers of drawn residuals.

use bagnold_inference::inference::diagnosis::outliers;
use bagnold_inference::sampling::Random;

fn normal(random: &mut Random, count: usize) -> Vec<f64> {
    (0..count).map(|_| random.normal()).collect()
}

#[test]
fn two_outliers_of_fifteen_are_named_and_nothing_else() {
    let (mut both, mut others) = (0, 0);
    for seed in 0..200 {
        let mut residuals = normal(&mut Random::new(seed), 15);
        residuals[3] += 8.0;
        residuals[11] -= 8.0;
        let found: Vec<usize> = outliers(&residuals, 0).into_iter().map(|(place, _)| place).collect();
        both += usize::from(found.contains(&3) && found.contains(&11));
        others += usize::from(found.iter().any(|place| *place != 3 && *place != 11));
    }
    assert!(both >= 140 && others <= 6, "{both} and {others} of 200");
}

#[test]
fn correct_residuals_raise_nothing() {
    for count in [6, 9, 15, 40, 100] {
        let mut outlying = 0;
        for seed in 0..1000 {
            let residuals = normal(&mut Random::new(seed), count);
            outlying += usize::from(!outliers(&residuals, 1).is_empty());
        }
        assert!(outlying <= 25, "{count} data: {outlying} of 1000");
    }
}
