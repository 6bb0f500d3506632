//! Findings about models that determine too little.

use bagnold_inference::inference::identifiability::{Finding, FindingKind};
use bagnold_inference::inference::{Emulator, Evaluated, ParameterLabel, Region, Uncertainties, assess, chi_squared};
use bagnold_inference::sampling::design::full_grid;

/// Findings of a model of two parameters, `viscosity` 0.5 to 2.5 Pa·s and `friction` 0 to 1.
fn findings(residuals: impl Fn(&[f64]) -> Vec<f64>) -> Vec<Finding> {
    let one = |point: Vec<f64>| {
        let residuals = residuals(&point);
        Evaluated { point, chi_squared: Some(chi_squared(&residuals)), residuals: Some(residuals) }
    };
    let history: Vec<Evaluated> = full_grid(&[4, 4]).into_iter().map(one).collect();
    let emulator = Emulator::fit(&history, 0.02).unwrap();
    let region = Region::new(&emulator, Uncertainties::STATED);
    let jacobian = emulator.jacobian(&region.minimum.point);
    let parameters = [("viscosity", "Pa·s"), ("friction", "-")]
        .map(|(name, unit)| ParameterLabel { name: name.to_owned(), unit: unit.to_owned() });
    let findings = assess(&jacobian, &region, &parameters, &|k, u| [0.5 + 2.0 * u, u][k]);
    for finding in &findings {
        println!("{finding}");
    }
    findings
}

fn texts(findings: &[Finding]) -> Vec<String> {
    findings.iter().map(ToString::to_string).collect()
}

#[test]
fn well_determined_parameters_raise_nothing() {
    assert_eq!(findings(|u| vec![50.0 * (u[0] - 0.5), 50.0 * (u[1] - 0.5), 1.0]), []);
}

#[test]
fn one_datum_does_not_determine_two_parameters() {
    let found = findings(|u| vec![40.0 * (u[0] + u[1] - 1.0)]);
    assert_eq!(found[0].kind, FindingKind::FewData { data: 1, parameters: 2 });
    assert!(matches!(found[1].kind, FindingKind::NotDetermined { parameter: 0, .. }));
    let all = texts(&found);
    assert_eq!(
        all[1],
        "the data do not determine `viscosity`: any value from 0.5 to 2.5 Pa·s fits them as well as the best, at 95 %"
    );
    let Some(FindingKind::WeakDirection { free, fixed, reach, .. }) = found.last().map(|finding| &finding.kind) else {
        panic!("{all:?}")
    };
    assert!(found.iter().any(|finding| matches!(
        finding.kind,
        FindingKind::Correlated { correlation, .. } if correlation < -0.999
    )));
    assert!((free[0] + free[1]).abs() < 1e-6 && (fixed[0] - fixed[1]).abs() < 1e-6 && *reach > 1e6);
}

#[test]
fn nearly_collinear_parameters_are_known_together() {
    // the sum to 1/100, the difference to 1/4
    let found = findings(|u| vec![100.0 * (u[0] + u[1] - 1.0), 4.0 * (u[0] - u[1])]);
    assert!(found.iter().any(|finding| matches!(
        finding.kind,
        FindingKind::Correlated { pair: [0, 1], correlation } if correlation < -0.99
    )));
    let weak = found.iter().find(|finding| matches!(finding.kind, FindingKind::WeakDirection { .. })).unwrap();
    assert_eq!(
        weak.to_string(),
        "near the best point the data fix 0.71 `viscosity` + 0.71 `friction` (each as a share of its range) but hardly 0.71 \
         `viscosity` − 0.71 `friction`: any point on the line from `viscosity` = 1.01 Pa·s, `friction` = 0.745 to `viscosity` \
         = 1.99 Pa·s, `friction` = 0.255 fits them as well as the best, at 95 %"
    );
}

#[test]
fn a_minimum_at_a_bound_is_told() {
    let found = texts(&findings(|u| vec![50.0 * (u[0] - 1.1), 50.0 * (u[1] - 0.5)]));
    assert!(found[0].starts_with("the data do not bound `viscosity` from above: any value from"), "{found:?}");
    assert!(found[1].starts_with("the best `viscosity` lies at its upper bound 2.5 Pa·s"), "{found:?}");
}

#[test]
fn an_interval_without_end_is_told() {
    let found = texts(&findings(|u| vec![50.0 * (u[0] - 0.5), 0.01 * (u[1] - 0.5), 0.0]));
    assert_eq!(
        found,
        ["the data do not determine `friction`: any value from 0 to 1 fits them as well as the best, at 95 %"]
    );
}

#[test]
fn dependence_on_fewer_combinations_is_told() {
    let found = findings(|u| (1..4).map(|k| f64::from(k) * 10.0 * (u[0] + u[1] - 1.0)).collect());
    assert_eq!(found[0].kind, FindingKind::RankDeficient { rank: 1, parameters: 2 });
}
