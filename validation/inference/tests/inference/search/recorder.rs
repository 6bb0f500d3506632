//! Record of evaluations and its budget.

use crate::stand_in::RosenbrockModel;
use bagnold_inference::inference::Evaluate;
use bagnold_inference::inference::search::lowest;
use bagnold_inference::internals::{Halt, Recorder};

struct Counting(usize);

impl Evaluate for Counting {
    type Error = String;
    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, String> {
        self.0 += points.len();
        Ok(points.iter().map(|u| (u[0] < 0.9).then(|| vec![u[0]])).collect())
    }
}

#[test]
fn a_point_is_evaluated_once() {
    let mut model = Counting(0);
    let mut recorder = Recorder::new(&mut model, 3);
    let points = [vec![0.5], vec![0.0], vec![0.5], vec![-0.0]];
    let residuals = recorder.residuals(&points).unwrap();
    assert_eq!(residuals, [Some(vec![0.5]), Some(vec![0.0]), Some(vec![0.5]), Some(vec![0.0])]);
    assert_eq!(recorder.residuals_at(&[0.95]).unwrap(), None);
    assert_eq!(recorder.history().len(), 3);
    assert_eq!(model.0, 3);
}

#[test]
fn a_batch_is_cut_at_the_budget() {
    let mut model = Counting(0);
    let mut recorder = Recorder::new(&mut model, 2);
    let points = [vec![0.5], vec![0.25], vec![0.125]];
    assert!(matches!(recorder.residuals(&points), Err(Halt::BudgetSpent)));
    assert_eq!(recorder.history().len(), 2);
    assert!(matches!(recorder.residuals(&points[..2]), Ok(list) if list.len() == 2));
    assert_eq!(lowest(recorder.history()).unwrap().chi_squared, 0.0625);
}

#[test]
fn a_start_that_fails_is_replaced() {
    let mut model = Counting(0);
    let (start, residuals) = Recorder::new(&mut model, 9).working_start(&[1.0], 1).unwrap();
    assert!(start[0] < 0.9 && residuals == start);
    let (start, _) = Recorder::new(&mut RosenbrockModel, 9).working_start(&[1.0, 0.5], 1).unwrap();
    assert_eq!(start, [1.0, 0.5]);
}
