//! Errors of one parameter in several sizes: how small an error of it does a gate still reject?

use super::Control;

/// Errors of one parameter of a law.
#[derive(Debug, PartialEq)]
pub struct ErrorSeries {
    /// Name, which with a factor is that of an error of the solver, such as `static-friction-0.9`.
    pub name: &'static str,
    /// The parameter in words.
    pub parameter: &'static str,
    /// Factors of the parameter `[-]`, from the smallest error to the largest.
    pub factors: &'static [f64],
}

const FRICTIONS: &[f64] = &[0.9, 0.8, 0.5];

/// All series.
static ALL: [ErrorSeries; 5] = [
    ErrorSeries::new("static-friction", "friction of slow flow μ_s, with μ_2 − μ_s as it is", FRICTIONS),
    ErrorSeries::new("friction-range", "rate dependence of friction μ_2 − μ_s", &[0.9, 0.8, 0.5, 0.0]),
    ErrorSeries::new("reference-inertia", "reference inertial number I_0", &[0.9, 0.8, 0.5, 0.1]),
    ErrorSeries::new("yield-stress", "yield stress of the viscoplastic law", FRICTIONS),
    ErrorSeries::new("plastic-viscosity", "plastic viscosity of the viscoplastic law", FRICTIONS),
];

impl ErrorSeries {
    const fn new(name: &'static str, parameter: &'static str, factors: &'static [f64]) -> Self {
        Self { name, parameter, factors }
    }

    /// Series with this name.
    pub(super) fn find(name: &str) -> Option<&'static Self> {
        ALL.iter().find(|series| series.name == name)
    }

    /// Name of the error of a factor.
    fn error(&self, factor: f64) -> String {
        format!("{}-{factor}", self.name)
    }

    /// A negative control for each of its errors. No gate is meant for one: all are asked which is the smallest that they reject.
    pub(super) fn controls(&self) -> impl Iterator<Item = Control> {
        self.factors.iter().map(|factor| Control {
            name: self.error(*factor),
            error: format!("{} × {factor}", self.parameter),
            solver: Some(self.error(*factor)),
            ..Control::default()
        })
    }
}

impl Control {
    /// The series that the control is of, and the factor of its parameter `[-]`; none for one that stands alone.
    pub fn size(&self) -> Option<(&'static ErrorSeries, f64)> {
        let error = self.solver.as_ref()?;
        let factor =
            |series: &ErrorSeries| series.factors.iter().copied().find(|factor| series.error(*factor) == *error);
        ALL.iter().find_map(|series| Some((series, factor(series)?)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_control_of_a_series_knows_its_size() {
        for series in &ALL {
            let sizes: Vec<_> = series.controls().map(|control| control.size()).collect();
            assert_eq!(sizes, series.factors.iter().map(|factor| Some((series, *factor))).collect::<Vec<_>>());
            assert!(series.factors.is_sorted_by(|a, b| a > b), "{}: the smallest error first", series.name);
        }
        assert_eq!(
            ErrorSeries::find("reference-inertia").map(|series| series.error(0.0)),
            Some("reference-inertia-0".to_owned())
        );
    }
}
