//! A figure of checks over the variants: what was found at each place, beside what each check is compared with.

use crate::figure::{Axis, Figure, Mark, Panel, is_file_name};
use crate::input::{FieldError, check_text};
use crate::metric::{Metric, Origin, Value, Variant};
use bagnold_solver::parameter::filled;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A figure: values of checks over a number that each variant has.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct FigureText {
    /// Name of the figure's file: letters, digits, `-` and `_`.
    pub(super) name: String,
    /// Caption below the figure.
    pub(super) caption: String,
    /// Label of the abscissa with its unit, such as "θ [°]".
    pub(super) x: String,
    /// Label of the ordinate with its unit, that of the checks.
    pub(super) y: String,
    /// Whether the ordinate is logarithmic.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub(super) logarithmic: bool,
    /// The varied number that is the abscissa, by the name that it has in variants.
    pub(super) over: Option<String>,
    /// Abscissa of each named variant, in place of `over`.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub(super) at: BTreeMap<String, f64>,
    /// Series that are drawn.
    #[schemars(transform = filled("at least one table", "add a [[figures.series]] table with the name of a check"))]
    pub(super) series: Vec<SeriesText>,
}

/// Content of a figure: the values of a check, or their reference, or a curve of one's own.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct SeriesText {
    /// Name of the check; left out beside `curve`.
    pub(super) check: Option<String>,
    /// Points of a curve that `reference` labels, as [x, y].
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(super) curve: Vec<[f64; 2]>,
    /// Label of the check's values in the legend; without one they are not drawn.
    pub(super) simulated: Option<String>,
    /// Label of the check's references in the legend; without one they are not drawn.
    pub(super) reference: Option<String>,
    /// Variants that are drawn, as `key=value`; all, if it is left out.
    #[schemars(with = "Option<String>")]
    pub(super) only: Option<Variant>,
}

/// Names that a figure may refer to.
#[derive(Debug)]
pub(super) struct NamesOfStudy<'study> {
    /// The named variants.
    pub(super) variants: Vec<&'study str>,
    /// The parameters that take several numbers, as variants call them.
    pub(super) varied_numbers: Vec<&'study str>,
    /// Names of the checks whose values can be drawn.
    pub(super) checks: Vec<&'study str>,
}

impl FigureText {
    /// Refuses what could not be drawn of a study with these names.
    pub(super) fn check(&self, study: &NamesOfStudy) -> Result<(), FieldError> {
        if !is_file_name(&self.name) {
            let rule = "a name that a file can have: letters, digits, `-` and `_`";
            let remedy = "give a name such as \"thickness-over-slope\"";
            return Err(FieldError::new("name", format!("\"{}\"", self.name), rule, remedy));
        }
        for (field, text) in [("caption", &self.caption), ("x", &self.x), ("y", &self.y)] {
            check_text(field, text)?;
        }
        match (&self.over, self.at.is_empty()) {
            (Some(over), true) => {
                if !study.varied_numbers.contains(&over.as_str()) {
                    let rule = "the name of a parameter that [[vary]] gives numbers to";
                    return Err(FieldError::new("over", format!("\"{over}\""), rule, "vary it, or use `at`"));
                }
            }
            (None, false) => {
                for (name, place) in &self.at {
                    if !study.variants.contains(&name.as_str()) {
                        let rule = "the name of one of [[variants]]";
                        return Err(FieldError::new("at", format!("\"{name}\""), rule, "correct the name"));
                    }
                    if !place.is_finite() {
                        let field = format!("at.{name}");
                        return Err(FieldError::new(&field, place, "a finite number", "give its x coordinate"));
                    }
                }
            }
            (over, _) => {
                let value = if over.is_some() { "beside `at`" } else { "missing" };
                let remedy = "name a varied number, or give by `at` the position of each of [[variants]]";
                return Err(FieldError::new("over", value, "exactly one of `over` and `at`", remedy));
            }
        }
        for (place, series) in self.series.iter().enumerate() {
            let field = format!("series[{place}]");
            if let Some(check) = series.check.as_ref().filter(|check| !study.checks.contains(&check.as_str())) {
                let field = format!("{field}.check");
                let rule = "the name of one of [[checks]]";
                return Err(FieldError::new(&field, format!("\"{check}\""), rule, "correct the name"));
            }
            if series.check.is_some() != series.curve.is_empty() {
                let value = if series.check.is_some() { "both" } else { "neither" };
                let remedy = "name a check, or give points such as curve = [[22.0, 0.016], [25.0, 0.0085]]";
                return Err(FieldError::new(&field, value, "exactly one of `check` and `curve`", remedy));
            }
            if let Some(point) = series.curve.iter().find(|point| !point.iter().all(|number| number.is_finite())) {
                let field = format!("{field}.curve");
                return Err(FieldError::new(&field, format!("{point:?}"), "finite", "give x and y as numbers"));
            }
            let has_values = series.simulated.is_some() && series.curve.is_empty();
            if !has_values && series.reference.is_none() {
                let rule = "at least one of `simulated` and `reference`";
                return Err(FieldError::new(&field, "neither", rule, "give the label of the points to draw"));
            }
            for (name, text) in [("simulated", &series.simulated), ("reference", &series.reference)] {
                text.as_ref().map_or(Ok(()), |text| check_text(&format!("{field}.{name}"), text))?;
            }
        }
        Ok(())
    }

    /// The figure of the checks' metrics.
    pub(super) fn draw(&self, metrics: &[Metric]) -> Figure {
        let y = if self.logarithmic { Axis::logarithmic(&self.y) } else { Axis::linear(&self.y) };
        let mut panel = Panel::new("", Axis::linear(&self.x), y);
        for (slot, series) in self.series.iter().enumerate() {
            // a logarithmic axis has no place for what is not positive
            let is_drawn = |value: f64| value.is_finite() && (!self.logarithmic || value > 0.0);
            let Some(check) = &series.check else {
                let label = series.reference.as_deref().unwrap_or_default();
                let points = series.curve.iter().map(|&[x, y]| (x, y)).filter(|point| is_drawn(point.1));
                panel.draw(label, Mark::Line, slot, points);
                continue;
            };
            let only = series.only.clone().unwrap_or_default();
            let is_meant = |metric: &&Metric| metric.name == *check && metric.variant.includes(&only);
            let own = metrics.iter().filter(is_meant);
            let mut found: Vec<(f64, &Metric)> =
                own.filter_map(|metric| Some((self.place(&metric.variant)?, metric))).collect();
            found.sort_by(|(a, _), (b, _)| a.total_cmp(b));
            if let Some(label) = &series.reference {
                let known = |(place, metric): &(f64, &Metric)| Some((*place, metric.reference.as_ref()?.value?));
                let points: Vec<_> = found.iter().filter_map(known).filter(|point| is_drawn(point.1)).collect();
                // one place alone makes no line
                panel.draw(label, if points.len() == 1 { Mark::OpenPoints } else { Mark::Line }, slot, points);
                let edges = found.iter().filter_map(|(place, metric)| {
                    let value = metric.reference.as_ref()?.value?;
                    let standard = metric.uncertainty.of(&[Origin::Experiment])?;
                    Some((*place, value - standard, value + standard))
                });
                let edges: Vec<(f64, f64, f64)> = edges.filter(|edge| is_drawn(edge.1) && is_drawn(edge.2)).collect();
                if !edges.is_empty() {
                    panel.band(&format!("{label}, to its standard uncertainty"), edges);
                }
            }
            if let Some(label) = &series.simulated {
                let values = found.iter().map(|(place, metric)| (*place, metric.value));
                panel.draw(label, Mark::Points, slot, values.filter(|point| is_drawn(point.1)));
            }
        }
        let caption = self.caption.clone() + " Filled points are simulated, lines and open points are references.";
        Figure::new(&self.name, &caption, vec![panel])
    }

    /// Abscissa of a variant.
    fn place(&self, variant: &Variant) -> Option<f64> {
        match &self.over {
            Some(over) => variant.get(over).and_then(Value::number),
            None => {
                let of = |name: &String| variant.includes(&Variant::of("variant", name.as_str()));
                self.at.iter().find(|(name, _)| of(name)).map(|(_, place)| *place)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn figure(text: &str) -> FigureText {
        toml::from_str(text).expect("a figure")
    }

    #[test]
    fn values_stand_where_their_variants_do_and_references_beside() {
        let drawn = figure(
            "name = \"a\"\ncaption = \"A.\"\nx = \"θ [°]\"\ny = \"h [m]\"\nlogarithmic = true\nat = { steep = 25.0, flat = 22.0 }\n\
             [[series]]\ncheck = \"left\"\nsimulated = \"found\"\nreference = \"exact\"\n",
        );
        let metric = |name: &str, variant: &str, value: f64, reference: f64| {
            let metric = Metric::observed(name, &Variant::of("variant", variant), value, "m");
            metric.exactly(reference, "an equation")
        };
        let metrics = [
            metric("left", "steep", 1.0, 1.5),
            metric("left", "flat", 0.0, 2.5),
            metric("left", "elsewhere", 3.0, 3.0),
            metric("other", "flat", 4.0, 4.0),
        ];
        let figure = drawn.draw(&metrics);
        let series = &figure.panels[0].series;
        assert_eq!(series[0].points, [(22.0, 2.5), (25.0, 1.5)]);
        assert!(figure.panels[0].bands.is_empty());
        // nothing was left on the gentle slope: a logarithm has no place for it
        assert_eq!(series[1].points, [(25.0, 1.0)]);
    }

    #[test]
    fn reference_is_drawn_with_its_uncertainty() {
        let drawn = figure(
            "name = \"a\"\ncaption = \"A.\"\nx = \"θ [°]\"\ny = \"h [m]\"\nat = { steep = 25.0 }\n\
             [[series]]\ncheck = \"left\"\nreference = \"measured\"\n",
        );
        let metric = Metric::observed("left", &Variant::of("variant", "steep"), 1.0, "m")
            .exactly(2.0, "a flume")
            .known_to(Origin::Experiment, Some(0.25), "a flume");
        assert_eq!(drawn.draw(&[metric]).panels[0].bands[0].points, [(25.0, 1.75, 2.25)]);
    }

    #[test]
    fn a_curve_needs_no_check() {
        let drawn = figure(
            "name = \"a\"\ncaption = \"A.\"\nx = \"θ [°]\"\ny = \"h [m]\"\nat = { steep = 25.0 }\n\
             [[series]]\ncurve = [[22.0, 0.016], [25.0, 0.0085]]\nreference = \"uniform layer\"\n",
        );
        let names = NamesOfStudy { variants: vec!["steep"], varied_numbers: Vec::new(), checks: Vec::new() };
        assert_eq!(drawn.check(&names), Ok(()));
        assert_eq!(drawn.draw(&[]).panels[0].series[0].points, [(22.0, 0.016), (25.0, 0.0085)]);
        let mut without = drawn;
        without.series[0].curve.clear();
        assert!(without.check(&names).expect_err("refused").to_string().contains("exactly one of `check` and `curve`"));
    }

    #[test]
    fn a_varied_number_is_an_abscissa_as_well() {
        let drawn = figure(
            "name = \"a\"\ncaption = \"A.\"\nx = \"Δ [m]\"\ny = \"x [m]\"\nover = \"spacing\"\n\
             [[series]]\ncheck = \"front\"\nsimulated = \"found\"\n",
        );
        let metric = |spacing: f64| Metric::observed("front", &Variant::of("spacing", spacing), 10.0 * spacing, "m");
        let figure = drawn.draw(&[metric(0.02), metric(0.01)]);
        assert_eq!(figure.panels[0].series[0].points, [(0.01, 0.1), (0.02, 0.2)]);
    }
}
