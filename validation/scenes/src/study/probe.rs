//! Reading of a check in a finished case. It is a metric of the case itself, a value of a column, or its distance from a
//! measured series.

use super::file::{Distance, Reduction};
use crate::case::CaseResult;
use crate::input::{FieldError, is_same_heading, nearest, parted};
use crate::metric::{Metric, Variant};
use crate::output::Table;
use crate::statistics::{Extrapolation, interpolated, linear_fit};

/// A column of the tables that a case writes, and the part of it that counts.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ColumnWindow {
    /// Name of the table, or the beginning of it.
    pub(super) table: String,
    /// Heading of what is measured.
    pub(super) column: String,
    /// Headings of what is added to it and taken from it.
    pub(super) others: [(&'static str, Option<String>, f64); 2],
    /// Heading of what it is measured over; none for the first column.
    pub(super) over: Option<String>,
    /// First and last value of the latter that count.
    pub(super) window: (f64, f64),
}

/// A column of one run.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct RunCurve {
    /// The run; empty where the case has a single one.
    pub(super) run: Variant,
    /// Heading of the abscissa.
    pub(super) over: String,
    /// Points (abscissa, value) within the window, in ascending order; values that do not exist are not numbers.
    pub(super) points: Vec<(f64, f64)>,
    /// Half the interval of a front at half a row of particles more or less, over the abscissa; empty for other columns.
    pub(super) resolution: Vec<(f64, f64)>,
}

/// The unit at the end of a heading; `-` where there is none.
pub(super) fn unit_of(heading: &str) -> &str {
    parted(heading).1
}

impl ColumnWindow {
    /// True where another column is added to it or taken from it.
    pub(super) fn is_combined(&self) -> bool {
        self.others.iter().any(|(_, heading, _)| heading.is_some())
    }

    /// Heading of its values: that of the column, or of the columns that are added and taken away, with the unit of all.
    pub(super) fn heading(&self) -> String {
        let unit = unit_of(&self.column);
        let bare = |heading: &str| heading.trim_end_matches(&format!("[{unit}]")).trim().to_owned();
        let others = self.others.iter().filter_map(|(_, heading, sign)| Some((heading.as_ref()?, sign)));
        let sum = others.fold(bare(&self.column), |sum, (heading, sign)| {
            format!("{sum} {} {}", if *sign < 0.0 { '−' } else { '+' }, bare(heading))
        });
        if self.is_combined() { format!("{sum} [{unit}]") } else { self.column.clone() }
    }

    /// The column in every table of that name: one a run.
    pub(super) fn curves(&self, result: &CaseResult) -> Result<Vec<RunCurve>, FieldError> {
        let is_meant = |table: &&Table| {
            table.name == self.table || table.name.strip_prefix(&self.table).is_some_and(|rest| rest.starts_with('-'))
        };
        let tables: Vec<&Table> = result.tables.iter().filter(is_meant).collect();
        if tables.is_empty() {
            let names: Vec<&str> = result.tables.iter().map(|table| table.name.as_str()).collect();
            let value = format!("\"{}\"", self.table);
            let rule = format!("a table of {}, or the beginning of its name: {}", result.name, listed(&names));
            return Err(FieldError::new("table", value, &rule, &did_you_mean(&self.table, &names)));
        }
        tables.into_iter().map(|table| self.curve(result, table)).collect()
    }

    fn curve(&self, result: &CaseResult, table: &Table) -> Result<RunCurve, FieldError> {
        let headings: Vec<&str> = table.columns.iter().map(String::as_str).collect();
        let place = |field: &str, wanted: &str| {
            table.columns.iter().position(|own| is_same_heading(own, wanted)).ok_or_else(|| {
                let rule = format!("a heading of the table {}: {}", table.name, listed(&headings));
                FieldError::new(field, format!("\"{wanted}\""), &rule, &did_you_mean(wanted, &headings))
            })
        };
        let measured = place("column", &self.column)?;
        let over = self.over.as_ref().map_or(Ok(0), |over| place("over", over))?;
        let mut others = Vec::new();
        for (field, heading, sign) in &self.others {
            if let Some(heading) = heading {
                others.push((place(field, heading)?, sign));
            }
        }
        let value = |row: &[f64]| others.iter().fold(row[measured], |sum, (other, sign)| sum + *sign * row[*other]);
        let rows = table.rows.iter().map(|row| (row[over], value(row)));
        let (name, unit) = parted(&self.column);
        let half = |word: &str| place("column", &format!("{name} at half a row {word} [{unit}]")).ok();
        let bounds = half("more").zip(half("less")).filter(|_| !self.is_combined());
        let resolution = bounds.map_or_else(Vec::new, |(more, less)| {
            table.rows.iter().map(|row| (row[over], 0.5 * (row[more] - row[less]).abs())).collect()
        });
        let (from, to) = self.window;
        let mut points: Vec<(f64, f64)> = rows.filter(|(x, _)| x.is_finite() && *x >= from && *x <= to).collect();
        points.sort_by(|a, b| a.0.total_cmp(&b.0));
        let run = result.runs.iter().map(|run| &run.variant);
        let run = run.filter(|variant| !variant.is_empty()).find(|variant| table.name.ends_with(&variant.file_name()));
        Ok(RunCurve { run: run.cloned().unwrap_or_default(), over: table.columns[over].clone(), points, resolution })
    }
}

impl RunCurve {
    /// The points that have a value.
    pub(super) fn wet(&self) -> impl DoubleEndedIterator<Item = (f64, f64)> {
        self.points.iter().copied().filter(|point| point.1.is_finite())
    }

    /// Value of a reduction of the curve where it has values; not a number for a curve without suitable points.
    pub(super) fn value(&self, reduction: Reduction) -> f64 {
        let values = || self.wet().map(|point| point.1);
        let found = match reduction {
            Reduction::First => values().next(),
            Reduction::Last => values().next_back(),
            Reduction::Largest => values().reduce(f64::max),
            Reduction::Smallest => values().reduce(f64::min),
            Reduction::Mean => self.mean(),
            Reduction::At(place) => self.at(place),
            Reduction::Reaches(level) => self.reaches(level),
            Reduction::Slope => linear_fit(&self.wet().collect::<Vec<_>>()).map(|fit| fit.slope),
        };
        found.unwrap_or(f64::NAN)
    }

    /// Mean by the trapezoidal rule over the steps between points with values; of single points that of their values.
    fn mean(&self) -> Option<f64> {
        let is_wet = |pair: &&[(f64, f64)]| pair.iter().all(|point| point.1.is_finite());
        let length = |pair: &[(f64, f64)]| pair[1].0 - pair[0].0;
        let (steps, gaps): (Vec<_>, Vec<_>) = self.points.windows(2).partition(is_wet);
        if steps.iter().all(|pair| length(pair) <= 0.0) {
            let count = self.wet().count();
            return (count > 0).then(|| self.wet().map(|point| point.1).sum::<f64>() / count as f64);
        }
        let area: f64 = steps.iter().map(|pair| 0.5 * (pair[0].1 + pair[1].1) * length(pair)).sum();
        let dry: f64 = gaps.into_iter().map(length).sum();
        Some(area / (self.points.last()?.0 - self.points.first()?.0 - dry))
    }

    /// The value at a place, linear between points; none beyond the ends.
    fn at(&self, place: f64) -> Option<f64> {
        interpolated(&self.points, place, (Extrapolation::Nothing, Extrapolation::Nothing))
    }

    /// Resolution at a place; 0 where none is known.
    fn resolution_at(&self, place: f64) -> f64 {
        interpolated(&self.resolution, place, (Extrapolation::Nothing, Extrapolation::Nothing)).unwrap_or(0.0)
    }

    /// Half a row at the place of a value that one row gives; 0 for what is taken of several.
    pub(super) fn resolution_of(&self, reduction: Reduction) -> f64 {
        let place = match reduction {
            Reduction::First => self.wet().next().map(|point| point.0),
            Reduction::Last => self.wet().next_back().map(|point| point.0),
            Reduction::At(place) => Some(place),
            _ => None,
        };
        place.map_or(0.0, |place| self.resolution_at(place))
    }

    /// Uncertainty of measured points within a window, each with the resolution there; none where the distance knows no uncertainty.
    pub(super) fn beside_rows(&self, measured: &[[f64; 3]], (from, to): (f64, f64), by: Distance) -> Vec<(f64, f64)> {
        let meant = measured.iter().filter(|[x, ..]| by == Distance::Residual && *x >= from && *x <= to);
        meant.map(|[x, _, own]| (*own, self.resolution_at(*x))).collect()
    }

    /// The first place at which the value reaches a level, from below or from above; none if it does not. What comes to a place where
    /// nothing was comes from zero, and reaches the level there at the earliest.
    fn reaches(&self, level: f64) -> Option<f64> {
        let first = self.points.first().filter(|point| point.1 == level).map(|point| point.0);
        let crossing = |pair: &[(f64, f64)]| {
            let [(x, y), (next_x, next_y)] = *pair else { return None };
            let before = if y.is_nan() { 0.0 } else { y };
            let crosses = (before < level && next_y >= level) || (before > level && next_y <= level);
            let way = if y.is_nan() { 1.0 } else { (level - y) / (next_y - y) };
            crosses.then_some(x + (next_x - x) * way)
        };
        first.or_else(|| self.points.windows(2).find_map(crossing))
    }

    /// Distance from measured points (abscissa, value, standard uncertainty) within a window, in the curve's units, where it has a
    /// value. It must go on beyond them all: a run that ends early would else be judged by its beginning, so it is not a number then.
    pub(super) fn distance(&self, measured: &[[f64; 3]], window: (f64, f64), distance: Distance) -> f64 {
        let meant = || measured.iter().filter(|point| point[0] >= window.0 && point[0] <= window.1);
        let ends = self.points.first().zip(self.points.last());
        let is_whole = ends.is_some_and(|(first, last)| meant().all(|point| (first.0..=last.0).contains(&point[0])));
        let differences: Vec<[f64; 3]> =
            meant().filter_map(|&[x, y, u]| self.at(x).map(|own| [own - y, y, u.max(self.resolution_at(x))])).collect();
        if !is_whole || differences.is_empty() {
            return f64::NAN;
        }
        let count = differences.len() as f64;
        let mean = |of: fn(&[f64; 3]) -> f64| differences.iter().map(of).sum::<f64>() / count;
        match distance {
            Distance::Residual => mean(|[d, _, u]| (d / u) * (d / u)).sqrt(),
            Distance::RelativeL2 => 100.0 * (mean(|[d, ..]| d * d) / mean(|[_, y, _]| y * y)).sqrt(),
            Distance::Largest => differences.iter().map(|difference| difference[0].abs()).fold(0.0, f64::max),
            Distance::Mean => mean(|difference| difference[0]),
        }
    }
}

/// The metrics of a name that a case gives itself.
pub(super) fn metrics<'a>(result: &'a CaseResult, name: &str) -> Result<Vec<&'a Metric>, FieldError> {
    let found: Vec<&Metric> = result.metrics.iter().filter(|metric| metric.name == name).collect();
    if found.is_empty() {
        let mut names: Vec<&str> = result.metrics.iter().map(|metric| metric.name.as_str()).collect();
        names.dedup();
        let rule = format!("a metric of {} in these runs: {}", result.name, listed(&names));
        return Err(FieldError::new("metric", format!("\"{name}\""), &rule, &did_you_mean(name, &names)));
    }
    Ok(found)
}

fn did_you_mean(wanted: &str, known: &[&str]) -> String {
    match nearest(wanted, known.iter().copied()) {
        Some(guess) => format!("did you mean \"{guess}\"?"),
        None => "name one of these; finished runs are not repeated".to_owned(),
    }
}

/// The first few of many names.
fn listed(names: &[&str]) -> String {
    const MOST: usize = 12;
    let shown: Vec<String> = names.iter().take(MOST).map(|name| format!("\"{name}\"")).collect();
    let more = names.len().saturating_sub(MOST);
    match (shown.is_empty(), more) {
        (true, _) => "it has none".to_owned(),
        (false, 0) => shown.join(", "),
        (false, more) => format!("{} and {more} more", shown.join(", ")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn curve(points: &[(f64, f64)]) -> RunCurve {
        RunCurve { run: Variant::default(), over: "t [s]".to_owned(), points: points.to_vec(), resolution: Vec::new() }
    }

    #[test]
    fn the_heading_of_combined_columns_names_all_of_them() {
        let of = |plus: Option<&str>, minus: Option<&str>| {
            let others = [("plus", plus.map(str::to_owned), 1.0), ("minus", minus.map(str::to_owned), -1.0)];
            let (table, column) = ("gauges".to_owned(), "bed: force along x [N/m]".to_owned());
            ColumnWindow { table, column, others, over: None, window: (0.0, 1.0) }.heading()
        };
        assert_eq!(of(None, None), "bed: force along x [N/m]");
        assert_eq!(of(Some("wall: force along x [N/m]"), None), "bed: force along x + wall: force along x [N/m]");
        assert_eq!(of(None, Some("wall: force along y [N/m]")), "bed: force along x − wall: force along y [N/m]");
    }

    #[test]
    fn values_are_taken_of_a_parabola() {
        let points: Vec<(f64, f64)> = (0..=100).map(|k| f64::from(k) / 100.0).map(|t| (t, t * (1.0 - t))).collect();
        let points_to = |end: f64| points.iter().copied().filter(|point| point.0 <= end).collect();
        let curve = curve(&points);
        assert_eq!(curve.value(Reduction::First), 0.0);
        assert_eq!(curve.value(Reduction::Largest), 0.25);
        assert_eq!(curve.value(Reduction::Smallest), 0.0);
        assert!((curve.value(Reduction::Mean) - 1.0 / 6.0).abs() < 2e-5, "the trapezoidal rule is 1/(6 · 100²) off");
        assert!((curve.value(Reduction::At(0.255)) - 0.255 * 0.745).abs() < 3e-5);
        assert!(curve.value(Reduction::At(1.01)).is_nan() && curve.value(Reduction::At(-0.01)).is_nan());
        let first_half = RunCurve { points: points_to(0.5), ..curve };
        assert!((first_half.value(Reduction::Slope) - 0.5).abs() < 1e-12, "a parabola has the slope of its middle");
    }

    #[test]
    fn the_third_zero_of_a_cosine_is_at_five_quarters_of_its_period() {
        let points: Vec<(f64, f64)> =
            (0..=150).map(|k| f64::from(k) / 100.0).map(|t| (t, libm::cos(TAU * t))).collect();
        let zero_after = |start: f64| {
            let later: Vec<(f64, f64)> = points.iter().copied().filter(|point| point.0 >= start).collect();
            curve(&later).value(Reduction::Reaches(0.0))
        };
        for (start, zero) in [(0.0, 0.25), (0.5, 0.75), (1.005, 1.25)] {
            assert!((zero_after(start) - zero).abs() < 1e-12, "{zero}");
        }
        assert_eq!(curve(&points).value(Reduction::Reaches(1.0)), 0.0, "it starts there");
        assert!(curve(&points).value(Reduction::Reaches(1.1)).is_nan(), "it never is as large");
        // rows on either side of the level count by their distance from it
        assert_eq!(curve(&[(0.0, 1.0), (4.0, 3.0)]).value(Reduction::Reaches(1.5)), 1.0);
    }

    #[test]
    fn the_mean_weighs_uneven_samples_by_their_time() {
        // 1 for nine tenths of the time, sampled once; 2 for the last, sampled often
        let mut points = vec![(0.0, 1.0), (0.9, 1.0)];
        points.extend((0..=10).map(|k| (0.9 + 0.01 * f64::from(k), 2.0)));
        assert!((curve(&points).value(Reduction::Mean) - 1.1).abs() < 1e-12);
    }

    /// A place that is reached at t = 2 with the value 4, dry for a moment at 4, and dry at the end.
    #[test]
    fn a_place_that_is_dry_at_times_has_the_values_of_the_others() {
        let dry = f64::NAN;
        let series = [dry, dry, 4.0, 2.0, dry, 3.0, 1.0, dry];
        let curve = curve(&(0..8).map(f64::from).zip(series).collect::<Vec<_>>());
        for (reduction, value) in [
            (Reduction::First, 4.0),
            (Reduction::Last, 1.0),
            (Reduction::Largest, 4.0),
            (Reduction::Smallest, 1.0),
            (Reduction::Mean, 2.5),
            (Reduction::At(2.5), 3.0),
            (Reduction::Reaches(3.5), 2.0),
            (Reduction::Reaches(1.5), 2.0),
        ] {
            assert_eq!(curve.value(reduction), value, "{reduction:?}");
        }
        for reduction in [Reduction::At(0.0), Reduction::At(3.5), Reduction::Reaches(5.0), Reduction::Reaches(-1.0)] {
            assert!(curve.value(reduction).is_nan(), "{reduction:?}");
        }
        let measured = [[0.5, 9.0, 1.0], [2.0, 3.0, 1.0], [4.5, 9.0, 1.0], [6.0, 1.0, 1.0]];
        let over_all = (f64::NEG_INFINITY, f64::INFINITY);
        assert_eq!(curve.distance(&measured, over_all, Distance::Mean), 0.5);
        assert!(curve.distance(&measured[..1], over_all, Distance::Mean).is_nan(), "nothing is compared");
        let never = RunCurve { points: vec![(0.0, dry), (1.0, dry)], ..curve };
        for reduction in [Reduction::Mean, Reduction::Largest, Reduction::Slope, Reduction::Reaches(0.0)] {
            assert!(never.value(reduction).is_nan(), "{reduction:?}");
        }
    }

    #[test]
    fn distances_are_those_of_an_offset() {
        let curve = curve(&[(0.0, 1.0), (1.0, 3.0)]);
        // the measured line lies 0.2 below the curve, known to 0.1
        let measured = [[0.25, 1.3, 0.1], [0.5, 1.8, 0.1], [1.0, 2.8, 0.1]];
        let distance = |distance| curve.distance(&measured, (f64::NEG_INFINITY, f64::INFINITY), distance);
        assert!((distance(Distance::Residual) - 2.0).abs() < 1e-12);
        assert!((distance(Distance::Largest) - 0.2).abs() < 1e-12);
        assert!((distance(Distance::Mean) - 0.2).abs() < 1e-12);
        let coarse = RunCurve { resolution: vec![(0.0, 0.4), (1.0, 0.4)], ..curve.clone() };
        let whole = (f64::NEG_INFINITY, f64::INFINITY);
        assert!((coarse.distance(&measured, whole, Distance::Residual) - 0.5).abs() < 1e-12);
        let rows = coarse.beside_rows(&measured, (0.5, 2.0), Distance::Residual);
        assert_eq!(rows, [(0.1, 0.4), (0.1, 0.4)]);
        assert_eq!(coarse.beside_rows(&measured, whole, Distance::Mean), []);
        let square: f64 = measured.iter().map(|point| point[1] * point[1]).sum::<f64>() / 3.0;
        assert!((distance(Distance::RelativeL2) - 100.0 * 0.2 / square.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_curve_that_ends_early_has_no_distance() {
        let measured = [[0.5, 1.0, 0.1], [1.5, 1.0, 0.1]];
        let short = curve(&[(0.0, 1.0), (1.0, 1.0)]);
        assert!(short.distance(&measured, (0.0, 2.0), Distance::Residual).is_nan());
        assert_eq!(
            short.distance(&measured, (0.0, 1.0), Distance::Residual),
            0.0,
            "what is beyond the window is not asked"
        );
        assert!(short.distance(&measured, (3.0, 4.0), Distance::Residual).is_nan(), "nothing is compared");
    }

    #[test]
    fn the_unit_is_the_last_thing_of_a_heading() {
        assert_eq!([unit_of("front: front [m]"), unit_of("a [b] c"), unit_of("q* [-]")], ["m", "-", "-"]);
    }
}
