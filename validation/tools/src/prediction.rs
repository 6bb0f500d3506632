//! A collapse predicted from a fitted law and judged by measurements: `bagnold predict column-planar`.
//!
//! The best law runs at two resolutions, every draw at the coarser one. `plan.json` holds program, flow, law and their digest before
//! the first run, which shows later that the prediction was blind.

use crate::ToolError;
use crate::case::{CaseResult, Limits, PreparedCase, Registry};
use crate::evaluation::{CaseRequest, parse_plan};
use crate::input::{DOCUMENT, FieldError, MeasuredFiles, WRITTEN_BY_HAND, read_text};
use crate::league::{scatter, studies::GrainComparison};
use crate::measured::{Measurements, WantedColumns};
use crate::metric::{Metric, Origin, Quantity};
use crate::output::{FileError, FolderLock, Owner, claim, owner_of};
use crate::store::{hexadecimal, identity_or_unique, is_of_this_program};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::path::Path;
use std::time::SystemTime;
use toml::{Table, Value};

/// Predicted quantities of each case: a metric, with the word of its variant behind it.
const QUANTITIES: [(&str, &[&str]); 2] = [
    ("column-planar", &["run_out", "final_height", "run_out centroid", "run_out front_at_0.05_r0"]),
    ("incline-collapse", &["front_displacement"]),
];

/// Runs of a prediction before they are simulated.
type Runs = Vec<Box<dyn PreparedCase>>;
/// A measured quantity with its value and standard uncertainty.
type MeasuredQuantity = (&'static str, [f64; 2]);

/// A law as `bagnold calibrate` writes it.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct FittedLaw {
    material: Table,
    #[serde(default)]
    draws: Vec<Table>,
}

/// A prediction before it is computed.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct PredictionPlan {
    /// SHA-256 of all fields but this and the time.
    pub digest: String,
    /// Time of the first command with this plan, in seconds since 1970 (UTC).
    pub unix_time: u64,
    /// Source hash of the program.
    pub program: String,
    /// Name of the case.
    pub case: String,
    /// `path=value` changes of the case.
    pub settings: Vec<String>,
    /// Resolution of the draws; the value is computed at twice as many particles.
    pub resolution: u16,
    /// Number of draws.
    pub draws: u16,
    /// Text of the law's file.
    pub law: String,
}

impl Owner for PredictionPlan {
    const WHAT: &'static str = "prediction";
    const MARKER: &'static str = "plan.json";

    fn is_foreign(&self) -> bool {
        !is_of_this_program(&self.program)
    }
}

impl PredictionPlan {
    /// Reads a law and prepares the runs: the best law at the finer and at the coarser resolution, then the draws.
    ///
    /// # Errors
    /// A file that is no law or has too few draws, parameters that the case refuses or that give several runs.
    pub fn prepare(self, file: &Path, registry: Registry, limits: Limits) -> Result<(Self, Runs), ToolError> {
        let text = read_text(file, WRITTEN_BY_HAND).map_err(|error| FileError::unreadable(file, &error))?;
        let law: FittedLaw = parse_plan(file, &text, "bagnold predict column-planar")?;
        if let Some(given) = self.settings.iter().find(|given| given.starts_with("resolution")) {
            let remedy = "use --resolution for the resolution of the draws";
            return Err(FieldError::new("--set", given, "of a parameter other than `resolution`", remedy).into());
        }
        let (given, wanted) = (law.draws.len(), usize::from(self.draws));
        if given < wanted {
            let rule = format!("at least {wanted} tables `[[draws]]`");
            let remedy = "let `bagnold calibrate` write the file, or ask for fewer with --draws";
            return Err(FieldError::new("draws", given, &rule, remedy).in_file(file).into());
        }
        let best = [(2, None), (1, None)];
        let runs = best.into_iter().chain((0..wanted).map(|draw| (1, Some(&law.draws[draw * given / wanted]))));
        let prepare = |(finer, draw): (u32, Option<&Table>)| {
            let mut material = law.material.clone();
            material.extend(draw.cloned().unwrap_or_default());
            let with = [("material", Value::Table(material)), ("variants", Value::Array(Vec::new()))];
            let with = with.map(|(name, value)| (name.to_owned(), value)).into_iter().collect();
            let request = CaseRequest { case: self.case.clone(), with, ..CaseRequest::default() };
            let resolution = format!("resolution={}", finer * u32::from(self.resolution));
            let settings = [&self.settings[..], &[resolution]].concat();
            let prepared = request.prepare(registry, file, &settings, limits)?;
            let runs = prepared.run_count();
            if runs > 1 {
                let defect = format!("selects {runs} runs, but a prediction needs one");
                return Err(FieldError::finding("--set", defect, "give every parameter one value").into());
            }
            Ok(prepared)
        };
        let prepared = runs.map(prepare).collect::<Result<_, ToolError>>()?;
        let plan = Self { program: identity_or_unique(registry.origin()).to_owned(), law: text, ..self };
        Ok((plan, prepared))
    }

    /// Writes the plan with digest and time into its folder, or finds an equal one there.
    ///
    /// # Errors
    /// A folder of another plan or program, files that cannot be written.
    pub fn claim(self, folder: &Path) -> Result<(Self, FolderLock), ToolError> {
        let bare = Self { digest: String::new(), unix_time: 0, ..self };
        let text = serde_json::to_string(&bare).unwrap_or_default();
        let now = || SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default().as_secs();
        let unix_time = owner_of::<Self>(folder)?.map_or_else(now, |old| old.unix_time);
        let plan = Self { digest: hexadecimal(&Sha256::digest(text)), unix_time, ..bare };
        let lock = claim(folder, &plan, true)?;
        Ok((plan, lock))
    }

    /// Predicted quantities from the results of the runs, each with its metric at the finer resolution.
    ///
    /// # Errors
    /// A run that diverged or lacks a quantity.
    pub fn evaluate(
        &self,
        results: &[CaseResult],
        measured: &[MeasuredQuantity],
    ) -> Result<Vec<(GrainComparison, Metric)>, ToolError> {
        let quantity = |name: &'static str| {
            let found: Vec<&Metric> =
                results.iter().enumerate().map(|run| self.metric(run, name)).collect::<Result<_, _>>()?;
            let [value, usual] = [0, 1].map(|run| found[run].value);
            let interval = found[0].prediction.as_ref();
            let own = measured.iter().find(|own| own.0 == name).map(|own| own.1);
            let predicted = GrainComparison {
                case: self.case.clone(),
                quantity: name.to_owned(),
                value,
                u_input: scatter(found[2..].iter().map(|metric| metric.value), 2).map_or(0.0, |(_, scatter)| scatter),
                u_numerical: (value - usual).abs().max(found[0].uncertainty.of(&[Origin::Numerical]).unwrap_or(0.0)),
                lower: interval.map(|interval| interval.lower),
                upper: interval.map(|interval| interval.upper),
                measured: own.iter().map(|own| own[0]).collect(),
                u_measured: own.map(|own| own[1]),
                ..GrainComparison::default()
            };
            Ok((predicted, found[0].clone()))
        };
        self.quantities().map(quantity).collect()
    }

    /// Names of what is predicted.
    fn quantities(&self) -> impl Iterator<Item = &'static str> {
        QUANTITIES.iter().filter(|(case, _)| *case == self.case).flat_map(|(_, names)| names.iter().copied())
    }

    /// A quantity of one of the runs.
    fn metric<'r>(&self, (run, result): (usize, &'r CaseResult), name: &str) -> Result<&'r Metric, ToolError> {
        let (metric, word) = name.split_once(' ').unwrap_or((name, ""));
        let is_meant = |own: &&Metric| {
            let quantity = own.variant.get("quantity").map_or("", |own| own.text());
            own.name == metric && quantity == word && own.value.is_finite()
        };
        result.metrics.iter().find(is_meant).ok_or_else(|| {
            let of = if run < 2 { "the best law".to_owned() } else { format!("draw {}", run - 1) };
            let reason = format!(
                "no `{name}` of {of}: it diverged or moves at the end, as on a slope steeper than its friction; give a gentler one by --set"
            );
            ToolError::at(Path::new(&self.case), reason)
        })
    }

    /// Measured values with their standard uncertainties: one row, with a column for each quantity and each uncertainty or repeat.
    ///
    /// # Errors
    /// A file that cannot be read, names no predicted quantity or has several rows; a value without an uncertainty.
    pub fn measured(&self, file: &Path, registry: Registry) -> Result<Vec<MeasuredQuantity>, ToolError> {
        let text = read_text(file, DOCUMENT).map_err(|error| FileError::unreadable(file, &error))?;
        let is_given = |name: &&str| [" [", " #"].iter().any(|mark| text.contains(&format!("{name}{mark}")));
        let described = registry.find(&self.case)?.quantities();
        let read = |quantity: &'static str| {
            let is_own = |own: &&Quantity| Some(own.name) == quantity.split(' ').next();
            let unit = described.iter().find(is_own).map_or("-", |own| own.unit);
            let wanted = WantedColumns { quantity: &[quantity], ..Default::default() };
            let measured = Measurements::read(&MeasuredFiles::One(file.to_owned()), wanted)?;
            let points = measured.in_units("-", unit)?;
            let [[_, value, uncertainty]] = points[..] else {
                let defect = format!("{} rows, but one is allowed", points.len());
                let remedy = "give repeats as columns: run_out #1 [-], run_out #2 [-]";
                return Err(FieldError::finding(quantity, defect, remedy).in_file(file).into());
            };
            Ok((quantity, [value, uncertainty]))
        };
        let measured: Vec<_> = self.quantities().filter(is_given).map(read).collect::<Result<_, ToolError>>()?;
        if measured.is_empty() {
            let defect = format!("no column of {} with a unit", self.quantities().collect::<Vec<_>>().join(", "));
            let remedy = "write `run_out [-],run_out uncertainty [-]` above `1.9,0.1`";
            return Err(FieldError::finding("columns", defect, remedy).in_file(file).into());
        }
        Ok(measured)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::FolderError;

    fn plan(law: &str) -> PredictionPlan {
        PredictionPlan { case: "column-planar".to_owned(), law: law.to_owned(), draws: 2, ..PredictionPlan::default() }
    }

    #[test]
    fn a_plan_keeps_its_digest_and_time_and_another_is_refused() {
        let root = tempfile::tempdir().expect("temporary folder");
        let folder = root.path().join("column");
        let first = plan("a").claim(&folder).expect("a new folder").0;
        assert!(first.digest.len() == 64 && first.unix_time > 1_700_000_000, "{first:?}");
        let text = std::fs::read_to_string(folder.join("plan.json")).expect("written before any run");
        assert!(text.contains(&first.digest) && text.contains(&first.unix_time.to_string()), "{text}");
        assert_eq!(
            PredictionPlan { digest: String::new(), unix_time: 7, ..first.clone() }.claim(&folder).expect("equal").0,
            first
        );
        let other = plan("b").claim(&folder);
        assert!(matches!(other, Err(ToolError::Folder(FolderError::OtherPlan { .. }))), "{other:?}");
        assert_ne!(plan("b").claim(&root.path().join("other")).expect("a new folder").0.digest, first.digest);
    }
}
