//! Data of an external code for a run, so that its numbers are read and judged as our own are.

use crate::figure::Figure;
use crate::input::{FieldError, did_you_mean, nearest};
use crate::metric::{Metric, Variant};
use crate::observation::{Frame, Outcome, Recorded};
use crate::output::Table;
use std::collections::BTreeMap;

/// Named columns of one length, in the SI units of their [`ExternalColumn`].
pub type NamedColumns = BTreeMap<String, Vec<f64>>;

/// Particles, or cells, at one time.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ParticleFrame {
    /// Time `[s]`.
    pub time: f64,
    /// Values of each particle or cell, by column.
    pub columns: NamedColumns,
}

/// All that another code gives of one run, each part optional.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ExternalData {
    /// Particles at increasing times.
    pub pictures: Vec<ParticleFrame>,
    /// Time series.
    pub series: NamedColumns,
    /// One profile.
    pub profile: NamedColumns,
}

/// A column that a case can use.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ExternalColumn {
    /// Name of the column in a submission.
    pub name: &'static str,
    /// SI unit, `-` for none.
    pub unit: &'static str,
    /// Description, one phrase.
    pub description: &'static str,
}

impl ExternalColumn {
    /// A column that a case can use.
    pub const fn new(name: &'static str, unit: &'static str, description: &'static str) -> Self {
        Self { name, unit, description }
    }
}

/// Scales of a run, which are units of the columns of other codes, `r0` and `t0`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunScales {
    /// Initial half width, radius or length r_0 `[m]`.
    pub length: f64,
    /// t_0 = √(h_0/g) with the initial height h_0 `[s]`.
    pub time: f64,
}

/// Data that a case accepts for a run from an external code, besides single numbers, which every case accepts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ExternalSchema {
    /// Columns of particles.
    pub particles: &'static [ExternalColumn],
    /// Columns of time series.
    pub series: &'static [ExternalColumn],
    /// Columns of the profile.
    pub profile: &'static [ExternalColumn],
    /// Description in prose of how the measurements are taken from these columns.
    pub description: &'static str,
}

impl ExternalSchema {
    /// Single numbers only.
    pub const NUMBERS: Self = Self { particles: &[], series: &[], profile: &[], description: "" };

    /// The column of that name among those of one part.
    ///
    /// # Errors
    /// A name that the case does not know; `field` is where it stands.
    pub fn find(
        items: &'static [ExternalColumn],
        field: &str,
        name: &str,
    ) -> Result<&'static ExternalColumn, FieldError> {
        items.iter().find(|item| item.name == name).ok_or_else(|| {
            let names: Vec<&str> = items.iter().map(|item| item.name).collect();
            let (defect, remedy) = if names.is_empty() {
                ("not used by this case", "leave it out, and give single numbers under `numbers`".to_owned())
            } else {
                let question = did_you_mean(&nearest(name, names.iter().copied()));
                let known = |ExternalColumn { name, unit, description }: &ExternalColumn| {
                    format!("{name} [{unit}] ({description})")
                };
                let known: Vec<String> = items.iter().map(known).collect();
                ("unknown name", format!("{question}known are {}", known.join(", ")))
            };
            FieldError::finding(&format!("{field}.{name}"), defect, &remedy)
        })
    }
}

/// A run's observation from what another code gives.
#[derive(Debug, Clone, PartialEq)]
pub struct ExternalObservation<O> {
    /// The observation; what was not given is not a number, or empty.
    pub observation: O,
    /// Names of the metrics that the given data suffice for; other metrics are not judged.
    pub measured: Vec<&'static str>,
}

/// Results of an external code's runs of a case.
#[derive(Debug, Clone, Default)]
pub struct ExternalResult {
    /// Numbers, of which those in `measured` may be judged.
    pub metrics: Vec<Metric>,
    /// Figures of its runs alone.
    pub figures: Vec<Figure>,
    /// Tables of its runs.
    pub tables: Vec<Table>,
    /// The runs, each with the names of the metrics that what was given suffices for.
    pub measured: Vec<(Variant, Vec<&'static str>)>,
}

impl ExternalResult {
    /// Whether a metric may be judged: the data given for its run, or for one of its runs, suffice.
    pub fn is_measured(&self, metric: &Metric) -> bool {
        let suffices = |names: &[&str]| names.contains(&metric.name.as_str());
        let is_own = |variant: &Variant| metric.variant.includes(variant);
        let has_own = self.measured.iter().any(|(variant, _)| is_own(variant));
        self.measured.iter().any(|(variant, names)| (is_own(variant) || !has_own) && suffices(names))
    }
}

impl ExternalData {
    /// The record of a run that another code made.
    pub fn record<O>(&self, observation: O) -> Recorded<O> {
        let mut frames: Vec<Frame> = self.pictures.iter().map(ParticleFrame::frame).collect();
        // a picture whose particles are not those of the first cannot be compared with it one by one
        let count = frames.last().map_or(0, |frame| frame.position.len());
        if frames.iter().any(|frame| frame.position.len() != count) {
            frames.clear();
        }
        Recorded {
            outcome: Outcome::Finished,
            state_hash: String::new(),
            particles: count,
            steps: 0,
            simulated_time: self
                .pictures
                .last()
                .map(|picture| picture.time)
                .or(self.series("time").last().copied())
                .unwrap_or(f64::NAN),
            wall_seconds: 0.0,
            threads: 0,
            frames,
            first_bad: None,
            data: observation,
        }
    }

    /// Whether no pictures, series or profile are given; single numbers may be.
    pub fn is_empty(&self) -> bool {
        self.pictures.is_empty() && self.series.is_empty() && self.profile.is_empty()
    }

    /// A column of the series; empty where it was not given.
    pub fn series(&self, name: &str) -> &[f64] {
        self.series.get(name).map_or(&[], Vec::as_slice)
    }

    /// A column of the profile; empty where it was not given.
    pub fn profile(&self, name: &str) -> &[f64] {
        self.profile.get(name).map_or(&[], Vec::as_slice)
    }

    /// A column of the series at every `time`; not a number where it was not given.
    pub fn full_series(&self, name: &str) -> Vec<f64> {
        full(self.series(name), self.series("time").len())
    }

    /// A column of the profile at every `height`; not a number where it was not given.
    pub fn full_profile(&self, name: &str) -> Vec<f64> {
        full(self.profile(name), self.profile("height").len())
    }
}

fn full(column: &[f64], rows: usize) -> Vec<f64> {
    if column.is_empty() { vec![f64::NAN; rows] } else { column.to_vec() }
}

impl ParticleFrame {
    /// As our own runs take them.
    fn frame(&self) -> Frame {
        let at = |name: &str, particle: usize| self.column(name).get(particle).copied();
        let count = self.column("x").len();
        let place = |axes: [&str; 3], particle: usize| axes.map(|axis| at(axis, particle).unwrap_or(0.0));
        let or_unknown = |name: &str| (0..count).map(|particle| at(name, particle).unwrap_or(f64::NAN)).collect();
        let scalar = |(name, unit): (&str, &str)| (name.to_owned(), unit.to_owned(), or_unknown(name));
        let speeds = (0..count).map(|particle| place(["vx", "vy", "vz"], particle)).collect();
        Frame {
            time: self.time,
            position: (0..count).map(|particle| place(["x", "y", "z"], particle)).collect(),
            scalars: [("pressure", "Pa"), ("density", "kg/m³")].into_iter().map(scalar).collect(),
            vectors: vec![("velocity".to_owned(), "m/s".to_owned(), speeds)],
        }
    }

    /// A column; empty where it was not given.
    pub fn column(&self, name: &str) -> &[f64] {
        self.columns.get(name).map_or(&[], Vec::as_slice)
    }

    /// Rejects implausible coordinates.
    ///
    /// # Errors
    /// The first particle that is further away than `reach` `[m]`, or below `least` `[m]` on an axis.
    pub fn within(&self, reach: f64, least: [f64; 3], remedy: &str) -> Result<(), FieldError> {
        for (axis, least) in ["x", "y", "z"].into_iter().zip(least) {
            let is_outside = |place: &f64| !(*place >= least && place.abs() <= reach);
            if let Some(particle) = self.column(axis).iter().position(is_outside) {
                let field = format!("particles.columns.{axis}, particle {} at {} s", particle + 1, self.time);
                let value = format!("{} m", self.column(axis)[particle]);
                let rule = format!("between {} and {reach} m", least.max(-reach));
                return Err(FieldError::new(&field, value, &rule, remedy));
            }
        }
        Ok(())
    }

    /// A column that the measurement needs.
    ///
    /// # Errors
    /// A column that was not given.
    pub fn needed(&self, name: &str, remedy: &str) -> Result<&[f64], FieldError> {
        let column = self.columns.get(name).map(Vec::as_slice);
        column.ok_or_else(|| FieldError::finding(&format!("particles.columns.{name}"), "missing", remedy))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const ITEMS: &[ExternalColumn] =
        &[ExternalColumn::new("front", "m", "place of the front"), ExternalColumn::new("height", "m", "height")];

    #[test]
    fn a_column_that_a_case_does_not_know_is_refused_by_name() {
        assert_eq!(ExternalSchema::find(ITEMS, "series.columns", "front").map(|item| item.unit), Ok("m"));
        let message =
            |items, name| ExternalSchema::find(items, "series.columns", name).expect_err("unknown").to_string();
        assert_eq!(
            message(ITEMS, "frnt"),
            "`series.columns.frnt`: unknown name; did you mean `front`? known are front [m] (place of the front), height [m] (height)"
        );
        assert_eq!(
            message(&[], "front"),
            "`series.columns.front`: not used by this case; leave it out, and give single numbers under `numbers`"
        );
    }
}
