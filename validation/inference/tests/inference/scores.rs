//! Ranking of choices.

use bagnold_inference::inference::scores::rank;
use bagnold_inference::sampling::Random;

fn choice(name: &str, residuals: Vec<f64>) -> (String, Vec<f64>) {
    (name.to_owned(), residuals)
}

#[test]
fn a_clear_winner_always_wins() {
    let choices = [choice("poor", vec![3.0; 20]), choice("good", vec![0.5; 20]), choice("fair", vec![1.0; 20])];
    let scores = rank(&choices, 500, 1).unwrap();
    let names: Vec<&str> = scores.iter().map(|score| score.name.as_str()).collect();
    assert_eq!(names, ["good", "fair", "poor"]);
    assert_eq!((scores[0].first, scores[0].ranks, scores[2].ranks), (1.0, [1, 1], [3, 3]));
    // Δχ² = 15 and 175
    assert!((scores[1].weight / scores[0].weight - libm::exp(-7.5)).abs() < 1e-12);
    assert!((scores.iter().map(|score| score.weight).sum::<f64>() - 1.0).abs() < 1e-12);
}

#[test]
fn equals_share_the_first_place() {
    let mut random = Random::new(3);
    let mut noise = |name| choice(name, (0..40).map(|_| random.normal()).collect());
    let choices = [noise("one"), noise("two")];
    let scores = rank(&choices, 2000, 1).unwrap();
    assert!(scores[0].first > 0.3 && scores[0].first < 1.0 && scores[0].ranks == [1, 2]);
    assert!((scores[0].first + scores[1].first - 1.0).abs() < 1e-12);
    assert_eq!(scores, rank(&choices, 2000, 1).unwrap());
}

#[test]
fn choices_must_share_their_data() {
    assert_eq!(rank(&[], 10, 1), None);
    assert_eq!(rank(&[choice("a", vec![1.0]), choice("b", vec![1.0, 2.0])], 10, 1), None);
}
