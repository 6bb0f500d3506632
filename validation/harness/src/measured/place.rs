//! Figure panel that measurements belong to: the one whose axes match theirs, with its curves.

use super::Measurements;
use crate::evidence::{NumberColumn, heading as of_column};
use crate::figure::{Axis, Figure, Mark, Panel, Series};
use crate::input::{FieldError, parted, unit};
use crate::number::four_digits;
use crate::statistics::{Extrapolation, interpolated};
use std::collections::{BTreeMap, BTreeSet};

/// Label of the band of a front whose section is half a row of particles more or less: its resolution.
pub const HALF_A_ROW: &str = "half a row of particles more or less";

/// Source of the uncertainty of a residual that half a row reduces: a gate that passes by it alone is inconclusive.
pub const COARSE: &str = "half a row of particles in place of smaller uncertainties of the measurement";

/// A panel with the axes of the measurements.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MatchingPanel {
    /// Number of the figure.
    pub(super) figure: usize,
    /// Number of its panel.
    pub(super) panel: usize,
    /// Whether what was measured stands on the horizontal axis, as velocities over the depth do.
    pub(super) is_across: bool,
    /// Factors to the units of the axes: of the abscissa, of what was measured `[-]`.
    pub(super) factors: (f64, f64),
}

/// A curve of the panel beside the measurements.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CurveResidual {
    /// Legend of the compared curve.
    pub(super) label: String,
    /// Root mean square of (curve − measurement)/uncertainty where the curve has a value `[-]`; not a number where it has none.
    pub(super) residual: f64,
    /// Reduction of the residual by the curve's resolution, where it counts in place of smaller uncertainties `[-]`.
    pub(super) by_resolution: f64,
    /// Measurements at which it has one.
    pub(super) compared: usize,
    /// Remark on a curve over time that does not reach from the first measurement to the last.
    pub(super) short: Option<String>,
    /// Remark on uncertainties that are smaller than the curve's resolution.
    pub(super) coarse: Option<String>,
}

/// Remark on points (uncertainty, resolution) where half a row of particles is more than the uncertainty and counts in its place.
pub fn coarse_in_words(points: &[(f64, f64)], unit: &str) -> Option<String> {
    let coarse: Vec<f64> = points.iter().filter(|(own, row)| row > own).map(|point| point.1).collect();
    let most = four_digits(coarse.iter().copied().reduce(f64::max)?);
    let (count, all) = (coarse.len(), points.len());
    Some(format!(
        "half a row of particles, which moves the value by up to {most} {unit}, counts in place of the uncertainty at {count} of {all} \
         measurements"
    ))
}

impl MatchingPanel {
    /// The only panel with these axes that fits what the file says.
    pub(super) fn of(measurements: &Measurements, figures: &[Figure]) -> Result<Self, FieldError> {
        let mut found = Vec::new();
        for (figure, own) in figures.iter().enumerate() {
            for (panel, drawn) in own.panels.iter().enumerate() {
                let said = &measurements.said;
                let is_meant = said.figure.as_ref().is_none_or(|name| *name == own.name)
                    && said.panel.as_ref().is_none_or(|title| *title == drawn.title);
                let has_curves = drawn.field.is_none() && drawn.series.iter().any(is_ours);
                if let Some(place) = Self::at(measurements, drawn).filter(|_| is_meant && has_curves) {
                    found.push(Self { figure, panel, ..place });
                }
            }
        }
        match found.as_slice() {
            [only] => Ok(*only),
            [] => Err(none(measurements, figures)),
            several => Err(too_many(measurements, figures, several)),
        }
    }

    /// Refuses headings that are the axes of no panel, of figures without curves.
    pub(super) fn check_axes(measurements: &Measurements, figures: &[Figure]) -> Result<(), FieldError> {
        let fits = |panel: &Panel| panel.field.is_none() && Self::at(measurements, panel).is_some();
        if !figures.iter().flat_map(|figure| &figure.panels).any(fits) {
            return Err(none(measurements, figures));
        }
        // of figures that differ by their variant alone the file has to name one
        let of_variants = figures.iter().enumerate().filter(|(_, own)| own.name.contains("-variant-"));
        let places = of_variants.filter_map(|(figure, own)| Some((figure, own.panels.iter().position(fits)?)));
        let several: Vec<Self> =
            places.map(|(figure, panel)| Self { figure, panel, is_across: false, factors: (1.0, 1.0) }).collect();
        let is_open = measurements.said.figure.is_none() && several.len() > 1;
        if is_open { Err(too_many(measurements, figures, &several)) } else { Ok(()) }
    }

    fn at(measurements: &Measurements, panel: &Panel) -> Option<Self> {
        let (over, what) = (&measurements.abscissa, &measurements.measured);
        let vertical = |y: &NumberColumn| {
            let of_curve = || panel.series.iter().any(|one| names(y, panel, one)).then(|| parted(&panel.y.label).1);
            factor(y, &panel.y).or_else(|| unit::factor(&y.unit, of_curve()?))
        };
        let fit = |x: &NumberColumn, y: &NumberColumn| Some((factor(x, &panel.x)?, vertical(y)?));
        let place = |is_across, factors| Self { figure: 0, panel: 0, is_across, factors };
        let upright = fit(over, what).map(|factors| place(false, factors));
        let across = fit(what, over).map(|(what, over)| place(true, (over, what)));
        upright.or(across)
    }

    /// A point of a curve or measurement as (abscissa, value).
    pub(super) fn turned(&self, (x, y): (f64, f64)) -> (f64, f64) {
        if self.is_across { (y, x) } else { (x, y) }
    }

    /// The curves that are compared, with their residuals.
    pub(super) fn curves(
        &self,
        measurements: &Measurements,
        figures: &[Figure],
    ) -> Result<Vec<CurveResidual>, FieldError> {
        let panel = &figures[self.figure].panels[self.panel];
        let named = |series: &Series| names(&measurements.measured, panel, series);
        let names_one = panel.series.iter().any(named);
        let meant = |series: &&Series| match &measurements.said.curve {
            Some(label) => is_ours(series) && *label == series.label,
            None => is_ours(series) && (!names_one || named(series)),
        };
        let series: Vec<&Series> = panel.series.iter().filter(meant).collect();
        if let (Some(label), true) = (&measurements.said.curve, series.is_empty()) {
            let labels: Vec<String> =
                panel.series.iter().filter(|one| is_ours(one)).map(|one| format!("`{}`", one.label)).collect();
            let rule = format!("the legend of a curve of {}: {}", figures[self.figure].name, labels.join(", "));
            let remedy = "correct it, or leave it out to compare all";
            let error = FieldError::new("# curve", format!("\"{label}\""), &rule, remedy);
            return Err(error.in_file(&measurements.path));
        }
        let residual = |series: &&Series| {
            let half = |&(x, least, most): &(f64, f64, f64)| (x, 0.5 * (most - least).abs());
            let band = panel.bands.iter().find(|band| band.label == HALF_A_ROW);
            let resolution: Vec<(f64, f64)> = band.iter().flat_map(|band| &band.points).map(half).collect();
            let (residual, points) = self.residual(measurements, &series.points, &resolution)?;
            let by_resolution = self.residual(measurements, &series.points, &[])?.0 - residual;
            let coarse = coarse_in_words(&points, parted(&panel.y.label).1);
            let label = series.label.clone();
            let over: Vec<f64> = series.points.iter().map(|point| self.turned(*point).0).collect();
            let places: Vec<f64> = measurements.abscissa.values.iter().map(|x| x * self.factors.0).collect();
            let of_time = unit::factor(&measurements.abscissa.unit, "s").is_some();
            let short = (of_time && !reaches(&over, &places)).then(|| {
                let [own, asked] = [over, places].map(|values| range(values.into_iter().filter(|x| x.is_finite())));
                format!("it covers {own}, but the measurements {asked}")
            });
            Some(CurveResidual { label, residual, by_resolution, compared: points.len(), short, coarse })
        };
        let curves: Vec<CurveResidual> = series.iter().filter_map(residual).collect();
        if curves.is_empty() {
            let (name, figure) = (&measurements.abscissa.name, &figures[self.figure].name);
            let values = measurements.abscissa.values.iter().map(|value| value * self.factors.0);
            let points = series.iter().flat_map(|series| &series.points).map(|point| self.turned(*point).0);
            let rule = format!("within the curves of {figure}, which cover {}", range(points));
            let error = FieldError::new(name, range(values), &rule, "check the unit and the origin of the abscissa");
            return Err(error.in_file(&measurements.path));
        }
        Ok(curves)
    }

    /// The residual in uncertainties, which are no smaller than the curve's resolution, and both of every measurement that it is taken
    /// from; none where all of them lie beyond the curve's ends.
    fn residual(
        &self,
        measurements: &Measurements,
        points: &[(f64, f64)],
        resolution: &[(f64, f64)],
    ) -> Option<(f64, Vec<(f64, f64)>)> {
        let mut curve: Vec<(f64, f64)> = points.iter().map(|point| self.turned(*point)).collect();
        curve.retain(|(x, _)| x.is_finite());
        curve.sort_by(|a, b| a.0.total_cmp(&b.0));
        let (to_x, to_y) = self.factors;
        let (first, last) = (curve.first()?.0, curve.last()?.0);
        let is_beside = measurements.abscissa.values.iter().any(|x| (first..=last).contains(&(x * to_x)));
        let given = measurements.abscissa.values.iter().zip(&measurements.measured.values);
        let (squares, points): (Vec<f64>, Vec<_>) = given
            .zip(&measurements.uncertainty)
            .filter_map(|((x, y), uncertainty)| {
                // the last row may stand just before the end of a run
                let beyond = (Extrapolation::Nothing, Extrapolation::Line(0.1));
                let at = |of: &[(f64, f64)]| interpolated(of, x * to_x, beyond);
                let least = at(resolution).unwrap_or(0.0);
                let own = uncertainty * to_y;
                let residual = (at(&curve)? - y * to_y) / own.max(least);
                Some((residual * residual, (own, least)))
            })
            .unzip();
        let mean = squares.iter().sum::<f64>() / squares.len() as f64;
        is_beside.then_some((mean.sqrt(), points))
    }
}

/// Whether abscissas of a curve reach from the first to the last of some places; its ends may stand a row beside those of a run.
fn reaches(over: &[f64], places: &[f64]) -> bool {
    let mut over: Vec<f64> = over.iter().copied().filter(|x| x.is_finite()).collect();
    over.sort_by(f64::total_cmp);
    let ([first, second, ..], [.., before, last]) = (&over[..], &over[..]) else { return false };
    places.iter().all(|x| (2.0 * first - second..=2.0 * last - before).contains(x))
}

/// Whether a series was drawn by a simulation.
fn is_ours(series: &Series) -> bool {
    series.mark != Mark::Reference && series.points.len() > 1
}

/// Heading of a curve in the tables of results, where it is a column of a gauge: its legend with a unit, or of an only curve the axis.
fn heading<'a>(panel: &'a Panel, series: &'a Series) -> Option<&'a str> {
    let label = if series.label.is_empty() { &panel.y.label } else { &series.label };
    (is_ours(series) && !panel.title.is_empty() && label.ends_with(']')).then_some(label)
}

/// Whether a column has the name of a curve in the tables of results, with or without the gauge in front.
fn names(column: &NumberColumn, panel: &Panel, series: &Series) -> bool {
    let of_gauge = column.name.strip_prefix(&panel.title).and_then(|name| name.strip_prefix(": "));
    heading(panel, series).is_some_and(|label| parted(label).0 == of_gauge.unwrap_or(&column.name))
}

/// The factor from a column's unit to that of an axis of its name; to a ratio also from the quantity that it is a ratio of.
fn factor(column: &NumberColumn, axis: &Axis) -> Option<f64> {
    let (name, own) = parted(&axis.label);
    // keyboards have no minus sign
    let is_named = |name: &str| name.replace('−', "-") == column.name.replace('−', "-");
    if is_named(name) {
        return unit::factor(&column.unit, own);
    }
    let ratio = axis.ratio.as_ref().filter(|ratio| is_named(&ratio.name))?;
    let to_unit = unit::factor("-", own)?;
    unit::factor(&column.unit, &ratio.unit).map(|factor| factor * to_unit / ratio.scale)
}

/// An axis as columns may name it.
fn named(axis: &Axis) -> String {
    match &axis.ratio {
        Some(ratio) => format!("{} or {} [{}]", axis.label, ratio.name, ratio.unit),
        None => axis.label.clone(),
    }
}

fn axes(measurements: &Measurements) -> String {
    format!("{} over {}", of_column(&measurements.measured), of_column(&measurements.abscissa))
}

fn none(measurements: &Measurements, figures: &[Figure]) -> FieldError {
    let panels = figures.iter().flat_map(|figure| figure.panels.iter().map(move |panel| (figure, panel)));
    let drawn = panels.filter(|(_, panel)| panel.field.is_none());
    let heads = |panel: &Panel| -> String {
        let heads = panel.series.iter().filter_map(|one| heading(panel, one));
        heads.map(|head| format!(" or {}: {head}", panel.title)).collect()
    };
    let mut there: BTreeMap<String, BTreeSet<&str>> = BTreeMap::new();
    for (figure, panel) in drawn {
        let axes = format!("{} and {}{}", named(&panel.x), named(&panel.y), heads(panel));
        there.entry(axes).or_default().insert(&figure.name);
    }
    let listed = |(axes, figures): (&String, &BTreeSet<&str>)| {
        let named: Vec<&str> = figures.iter().take(2).copied().collect();
        let others = figures.len() - named.len();
        let others = if others == 0 { String::new() } else { format!(" and {others} more") };
        format!("{}{others}: {axes}", named.join(", "))
    };
    let mut there: Vec<String> = there.iter().map(listed).collect();
    there.sort();
    let rule = format!("the axes of one of the case's figures ({})", there.join("; "));
    let units = [&measurements.abscissa.unit, &measurements.measured.unit];
    let unknown =
        units.into_iter().find(|own| !unit::is_known(own)).map(|own| format!("[{own}] is not a known unit; "));
    let remedy = "name the columns as the axes are labelled, in any unit that converts to theirs";
    let remedy = unknown.unwrap_or_default() + remedy;
    FieldError::new("columns", axes(measurements), &rule, &remedy).in_file(&measurements.path)
}

fn too_many(measurements: &Measurements, figures: &[Figure], several: &[MatchingPanel]) -> FieldError {
    let name = |place: &MatchingPanel| {
        let figure = &figures[place.figure];
        let title = &figure.panels[place.panel].title;
        if title.is_empty() { figure.name.clone() } else { format!("{}, panel {title}", figure.name) }
    };
    let names: Vec<String> = several.iter().map(name).collect();
    let defect = format!("{} are the axes of several panels: {}", axes(measurements), names.join("; "));
    let remedy = "name one above the table by `# figure: NAME`, and if needed `# panel: TITLE`; give a copy of the file for each";
    FieldError::finding("columns", defect, remedy).in_file(&measurements.path)
}

fn range(values: impl Iterator<Item = f64>) -> String {
    let (lower, upper) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(lower, upper), value| (lower.min(value), upper.max(value)));
    format!("{lower} … {upper}")
}
