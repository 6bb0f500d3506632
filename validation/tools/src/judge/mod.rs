//! Other codes' results under the gates of our cases: `bagnold judge`.

mod blank;
mod document;
mod export;
mod gates;
mod inputs;
mod lammps;
mod laws;
mod overlay;
mod page;
mod reading;
mod submission;
mod verdicts;
mod vtk;

pub use blank::blank;
pub use export::export;
pub use inputs::inputs_of;
pub use page::write;
pub(crate) use page::{mark, other_limit};
pub(crate) use reading::{frames, plan};
pub use submission::{CoarseRun, Code, ForeignRun, LawOrigin, ParticleFiles, Submission, TableFile};
pub use verdicts::MetricComparison;

use crate::ToolError;
use crate::case::{CaseResult, Changes, ExternalData, ExternalResult, PreparedCase, Registry};
use crate::figure::Figure;
use crate::input::{FieldError, shown};
use crate::metric::{Metric, Variant, Verdict};
use crate::report::{Severity, Tally};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// Submissions of one case, with the runs of ours that they are compared with.
pub struct CaseSubmissions {
    /// The runs of ours that any code gives something of.
    pub prepared: Box<dyn PreparedCase>,
    /// Results of the codes.
    pub entries: Vec<CodeResults>,
}

/// One code's results.
#[derive(Debug, Clone)]
pub struct CodeResults {
    /// The submission.
    pub submission: Submission,
    /// The runs that it gives, in the order of its file.
    variants: Vec<Variant>,
    /// Result computed from the files of the code.
    pub result: ExternalResult,
    /// Notice of other gates than today's, for which it was made.
    moved: Option<String>,
    /// Observed orders of convergence.
    orders: Vec<ObservedOrder>,
}

/// A code's own convergence between two meshes.
#[derive(Debug, Clone, PartialEq)]
pub struct ObservedOrder {
    /// The error on the finer mesh.
    pub fine: Metric,
    /// The error on the coarser mesh, in the unit of the finer one's.
    pub coarse: f64,
    /// Ratio r of the cell sizes `[-]`.
    pub ratio: f64,
}

impl ObservedOrder {
    /// Observed order ln(e_coarse/e_fine)/ln r `[-]`; none where the error changes its sign.
    pub fn order(&self) -> Option<f64> {
        let reduction = self.coarse / self.fine.value;
        (reduction > 0.0).then(|| reduction.ln() / self.ratio.ln())
    }
}

/// A code's verdicts.
#[derive(Debug, Clone)]
pub struct JudgedCode {
    /// The submission.
    pub submission: Submission,
    /// Notice of other gates than today's, for which the submission was made.
    pub moved: Option<String>,
    /// Metrics in our order.
    pub metrics: Vec<MetricComparison>,
    /// Observed orders of convergence.
    pub orders: Vec<ObservedOrder>,
}

/// All codes beside our own.
#[derive(Debug, Clone)]
pub struct CodeComparison {
    /// Our case.
    pub own: CaseResult,
    /// Judged codes, one for each submission.
    pub codes: Vec<JudgedCode>,
    /// Our figures with those of the other codes drawn in.
    pub figures: Vec<Figure>,
}

impl JudgedCode {
    /// Gates; for those that are not judged nothing was given.
    pub fn tally(&self) -> Tally {
        let gated = self.metrics.iter().filter(|one| one.own.verdict() != Verdict::Observed);
        let severity = |one: &MetricComparison| match one.verdict() {
            Some(Verdict::Pass) => Some(Severity::Pass),
            Some(Verdict::Fail) => Some(Severity::NewFailure),
            // of another law: given, but not asked
            Some(Verdict::Observed) => None,
            None => Some(Severity::NotJudged),
        };
        Tally(gated.filter_map(severity).collect())
    }
}

impl CaseSubmissions {
    /// Reads submissions and everything that they name; nothing is simulated yet.
    ///
    /// # Errors
    /// Submissions of different cases, tiers or parameters, runs that the case does not have or that are meant twice, files
    /// that cannot be understood.
    pub fn read(files: &[PathBuf], registry: Registry) -> Result<Self, ToolError> {
        let submissions: Vec<Submission> = files.iter().map(|file| Submission::read(file)).collect::<Result<_, _>>()?;
        let Some(first) = submissions.first() else {
            let remedy = "name a file, or print one to fill with `bagnold judge --template CASE`";
            return Err(FieldError::finding("FILES", "nothing to judge", remedy).into());
        };
        for (place, other) in submissions.iter().enumerate().skip(1) {
            let same = (&other.case, other.tier, &other.with) == (&first.case, first.tier, &first.with);
            if !same {
                let first = shown(&first.path);
                let reason = format!("case, tier or `with` differ from {first}; judge the two separately");
                return Err(ToolError::at(&other.path, reason));
            }
            if let Some(twin) = submissions[..place].iter().find(|twin| twin.code == other.code) {
                let value = format!("\"{} {}\"", other.code.name, other.code.version);
                let rule = format!("another code than that of {}", twin.path.display());
                return Err(FieldError::new("code", value, &rule, "give each a version").in_file(&other.path).into());
            }
        }
        let case = registry.find(&first.case).map_err(|error| error.in_file(&first.path))?;
        let file = first.parameter_file();
        let changes = Changes { file: Some((&file, first.with.clone())), settings: &[], ..Changes::default() };
        let all = case.prepare(first.tier, &changes).map_err(|error| first.placed(error))?;
        // the export has the tier's parameters, whatever a submission lays over them
        let exported = case.prepare(first.tier, &Changes::default()).map_err(|error| error.in_plan(&first.path))?;
        let inputs = inputs::digest(exported.parameters_toml());
        let gates = gates::digests(&exported.asked().metrics);
        let is_other = |submission: &&Submission| submission.inputs.as_ref().is_some_and(|given| *given != inputs);
        if let Some(Submission { inputs: Some(given), path, .. }) = submissions.iter().find(is_other) {
            let (value, rule) = (format!("\"{given}\""), format!("\"{inputs}\", the digest of these inputs"));
            let remedy = "export the case again, and compare the two `case.toml`";
            return Err(FieldError::new("inputs", value, &rule, remedy).in_file(path).into());
        }
        // the runs of ours that any code gives something of, in our order
        let places: Vec<Vec<usize>> =
            submissions.iter().map(|submission| places(submission, all.as_ref())).collect::<Result<_, _>>()?;
        let chosen: BTreeSet<usize> = places.iter().flatten().copied().collect();
        let chosen: Vec<usize> = chosen.into_iter().collect();
        let prepared = all.choose(&chosen);
        let of_code = |(submission, places): (Submission, Vec<usize>)| -> Result<CodeResults, ToolError> {
            let own: Vec<usize> =
                places.iter().filter_map(|place| chosen.iter().position(|chosen| chosen == place)).collect();
            let moved = gates::notice(&submission, &gates);
            Ok(CodeResults { moved, ..entry(submission, &own, case.form(), prepared.as_ref())? })
        };
        let entries = submissions.into_iter().zip(places).map(of_code).collect::<Result<_, _>>()?;
        Ok(Self { prepared, entries })
    }
}

/// Reads what a code gives of some runs of ours and takes its measurements.
fn entry(
    submission: Submission,
    places: &[usize],
    form: &crate::case::ExternalSchema,
    prepared: &dyn PreparedCase,
) -> Result<CodeResults, ToolError> {
    let folder = submission.path.parent().unwrap_or_else(|| Path::new("")).to_owned();
    let judged = |runs: &[ForeignRun]| -> Result<ExternalResult, ToolError> {
        let mut given = vec![ExternalData::default(); prepared.run_count()];
        for (number, (run, &place)) in runs.iter().zip(places).enumerate() {
            let field = format!("run {}", number + 1);
            given[place] = reading::read(run, (form, prepared.scales(place)), &field, &folder)
                .map_err(|error| error.in_file(&submission.path))?;
        }
        Ok(prepared.judge_external(&given).map_err(|(place, error)| {
            let number = places.iter().position(|own| *own == place).map_or(0, |number| number + 1);
            error.within(&format!("run {number}")).in_file(&submission.path)
        })?)
    };
    let result = judged(&submission.runs)?;
    let coarse = judged(&submission.runs.iter().map(ForeignRun::on_coarser_mesh).collect::<Vec<_>>())?;
    let ratio = |metric: &Metric| {
        let own =
            submission.runs.iter().zip(places).find(|(_, place)| metric.variant.includes(&prepared.variant(**place)));
        Some(own?.0.coarse.as_ref()?.ratio)
    };
    let order = |fine: &Metric| {
        let is_coarse = |coarse: &&Metric| (&coarse.name, &coarse.variant) == (&fine.name, &fine.variant);
        let coarse = coarse.metrics.iter().find(is_coarse).filter(|metric| coarse.is_measured(metric))?;
        Some(ObservedOrder { fine: fine.clone(), coarse: coarse.value, ratio: ratio(fine)? })
    };
    let is_error = |metric: &&Metric| metric.unit == "%" && metric.gate.is_some();
    let orders = result.metrics.iter().filter(is_error).filter_map(order).collect();
    let variants = places.iter().map(|&place| prepared.variant(place)).collect();
    Ok(CodeResults { submission, variants, result, moved: None, orders })
}

/// Keys of runs that are the numerics of ours: a code that names none of them is compared with the first run of the case.
pub(crate) const NUMERICS: [&str; 7] = ["particles", "resolution", "seed", "numerics", "top", "hourglass", "timestep"];

/// Our run that each of a submission's is: of those that have all its keys the one with the fewest keys, the first of those that
/// differ in numerics alone.
fn places(submission: &Submission, prepared: &dyn PreparedCase) -> Result<Vec<usize>, ToolError> {
    let variants: Vec<Variant> = (0..prepared.run_count()).map(|run| prepared.variant(run)).collect();
    let mut places: Vec<usize> = Vec::new();
    for (number, run) in submission.runs.iter().enumerate() {
        let wrong = |rule: &str, remedy: &str| {
            let field = format!("run {}.variant", number + 1);
            let value = format!("\"{}\"", run.variant);
            ToolError::from(FieldError::new(&field, value, rule, remedy).in_file(&submission.path))
        };
        let matching: Vec<usize> =
            (0..variants.len()).filter(|&place| variants[place].includes(&run.variant)).collect();
        let keys = |place: usize| variants[place].parts().count();
        let fewest = matching.iter().map(|&place| keys(place)).min();
        let least: Vec<usize> = matching.into_iter().filter(|&place| Some(keys(place)) == fewest).collect();
        let physics =
            |place: usize| -> Vec<_> { variants[place].parts().filter(|(key, _)| !NUMERICS.contains(key)).collect() };
        let least = match least[..] {
            [first, .., last] if least.iter().all(|&place| physics(place) == physics(last)) => vec![first],
            _ => least,
        };
        match least[..] {
            [place] if places.contains(&place) => {
                return Err(wrong("another run than those above it", "give each run once, in one table [[run]]"));
            }
            [place] => places.push(place),
            [] => {
                let listed = quoted(variants.iter().take(6), ", ");
                let rule = format!("keys and values of a run of this case and tier, such as {listed}");
                return Err(wrong(&rule, "`bagnold judge --template` lists the runs"));
            }
            _ => {
                let listed = quoted(least.iter().take(4).map(|&place| &variants[place]), " and ");
                let rule = format!("a single run, but fits {listed}");
                return Err(wrong(&rule, "add a key in which they differ"));
            }
        }
    }
    Ok(places)
}

fn quoted<'v>(variants: impl Iterator<Item = &'v Variant>, between: &str) -> String {
    variants.map(|variant| format!("\"{variant}\"")).collect::<Vec<_>>().join(between)
}

/// Puts the codes beside our own results.
///
/// # Errors
/// A single number that no metric of its run has.
pub fn judge(own: CaseResult, entries: &[CodeResults]) -> Result<CodeComparison, ToolError> {
    let judged = |entry: &CodeResults| -> Result<JudgedCode, ToolError> {
        let runs = entry.variants.iter().zip(&entry.submission.runs).enumerate();
        let numbers = runs.map(|(number, (variant, run))| (variant.clone(), run, format!("run {}", number + 1)));
        let numbers: Vec<_> = numbers.collect();
        let CodeResults { submission, moved, orders, .. } = entry.clone();
        // a gate of a run that only another code has lacks no data of this one
        let is_of = |of: &CodeResults, metric: &Metric| of.variants.iter().any(|run| metric.variant.includes(run));
        let is_others = |metric: &&Metric| !is_of(entry, metric) && entries.iter().any(|of| is_of(of, metric));
        let asked: Vec<Metric> = own.metrics.iter().filter(|metric| !is_others(metric)).cloned().collect();
        let metrics = verdicts::compare(&asked, &entry.result, &numbers, submission.law)
            .map_err(|error| error.in_file(&submission.path))?;
        Ok(JudgedCode { submission, moved, metrics, orders })
    };
    let codes: Vec<JudgedCode> = entries.iter().map(judged).collect::<Result<_, _>>()?;
    let theirs: Vec<(&str, &[Figure])> =
        entries.iter().map(|entry| (entry.submission.code.name.as_str(), entry.result.figures.as_slice())).collect();
    let figures = overlay::overlay(&own.figures, &theirs);
    Ok(CodeComparison { own, codes, figures })
}
