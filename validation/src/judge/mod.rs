//! Other codes' results under the gates of our cases: `bagnold judge`.

mod blank;
mod column;
mod document;
mod error;
mod export;
mod measured;
mod overlay;
mod page;
mod reading;
mod submission;
mod text_table;
mod unit;
mod verdicts;
mod vtk;

pub use blank::blank;
pub use error::JudgeError;
pub use export::export;
pub use measured::{Measurements, draw_measured};
pub use page::write;
pub use submission::{Code, ForeignRun, ParticleFiles, Submission, TableFile};
pub use verdicts::Compared;

use crate::case::{CaseResult, Changes, ForeignResult, Given, Prepared, Registry};
use crate::evaluation::PlanError;
use crate::figure::Figure;
use crate::input::FieldError;
use crate::metric::{Variant, Verdict};
use std::path::{Path, PathBuf};

/// Submissions of one case, with the runs of ours that they are compared with.
pub struct Trial {
    /// The runs of ours that any code gives something of.
    pub prepared: Box<dyn Prepared>,
    /// What the codes gave.
    pub entries: Vec<Entry>,
}

/// One code's results.
#[derive(Debug, Clone)]
pub struct Entry {
    /// The submission.
    pub submission: Submission,
    /// The runs that it gives, in the order of its file.
    variants: Vec<Variant>,
    /// What follows from the files that it gives.
    result: ForeignResult,
}

/// A code's verdicts.
#[derive(Debug, Clone)]
pub struct Judged {
    /// The code.
    pub code: Code,
    /// Its file.
    pub file: PathBuf,
    /// Metrics in our order.
    pub metrics: Vec<Compared>,
}

/// All codes beside our own.
#[derive(Debug, Clone)]
pub struct Judgement {
    /// Our case.
    pub own: CaseResult,
    /// The codes.
    pub codes: Vec<Judged>,
    /// Our figures with theirs drawn in.
    pub figures: Vec<Figure>,
}

impl Judged {
    /// Gates that hold, that fail, and that nothing was given for.
    #[must_use]
    pub fn counts(&self) -> (usize, usize, usize) {
        let gated = self.metrics.iter().filter(|one| one.own.verdict() != Verdict::Observed);
        gated.fold((0, 0, 0), |(held, failed, open), one| match one.verdict() {
            Some(Verdict::Pass) => (held + 1, failed, open),
            Some(Verdict::Fail) => (held, failed + 1, open),
            Some(Verdict::Observed) | None => (held, failed, open + 1),
        })
    }
}

impl Trial {
    /// Reads submissions and everything that they name; nothing is simulated yet.
    ///
    /// # Errors
    /// Submissions of different cases, tiers or parameters, runs that the case does not have or that are meant twice, files
    /// that cannot be understood.
    pub fn read(files: &[PathBuf], registry: Registry) -> Result<Self, JudgeError> {
        let submissions: Vec<Submission> = files.iter().map(|file| Submission::read(file)).collect::<Result<_, _>>()?;
        let Some(first) = submissions.first() else { return Err(JudgeError::Nothing) };
        for (place, other) in submissions.iter().enumerate().skip(1) {
            let same = (&other.case, other.tier, &other.with) == (&first.case, first.tier, &first.with);
            if !same {
                return Err(JudgeError::Different { first: first.path.clone(), other: other.path.clone() });
            }
            if let Some(twin) = submissions[..place].iter().find(|twin| twin.code == other.code) {
                let value = format!("\"{} {}\"", other.code.name, other.code.version);
                let rule = format!("another code than that of {}", twin.path.display());
                return Err(FieldError::new("code", value, &rule, "give it a version").in_file(&other.path).into());
            }
        }
        let case =
            registry.find(&first.case).map_err(|error| PlanError::of(error.in_file(&first.path), &first.path))?;
        let changes = Changes { file: Some((&first.path, first.with.clone())), settings: &[], ..Changes::default() };
        let all = case.prepare(first.tier, &changes).map_err(|error| PlanError::of(error, &first.path))?;
        // the runs of ours that any code gives something of, in our order
        let places: Vec<Vec<usize>> =
            submissions.iter().map(|submission| places(submission, all.as_ref())).collect::<Result<_, _>>()?;
        let mut chosen: Vec<usize> = places.iter().flatten().copied().collect();
        chosen.sort_unstable();
        chosen.dedup();
        let prepared = all.choose(&chosen);
        let entries = submissions
            .into_iter()
            .zip(places)
            .map(|(submission, places)| {
                let own: Vec<usize> =
                    places.iter().filter_map(|place| chosen.iter().position(|chosen| chosen == place)).collect();
                entry(submission, &own, case.form(), prepared.as_ref())
            })
            .collect::<Result<_, _>>()?;
        Ok(Self { prepared, entries })
    }
}

/// Reads what a code gives of some runs of ours and takes its measurements.
fn entry(
    submission: Submission,
    places: &[usize],
    form: &crate::case::Form,
    prepared: &dyn Prepared,
) -> Result<Entry, JudgeError> {
    let folder = submission.path.parent().unwrap_or_else(|| Path::new("")).to_owned();
    let mut given = vec![Given::default(); prepared.run_count()];
    for (number, (run, &place)) in submission.runs.iter().zip(places).enumerate() {
        let field = format!("run {}", number + 1);
        given[place] = reading::read(run, form, &field, &folder).map_err(|error| error.in_file(&submission.path))?;
    }
    let result = prepared.foreign(&given).map_err(|(place, error)| {
        let number = places.iter().position(|own| *own == place).map_or(0, |number| number + 1);
        error.within(&format!("run {number}")).in_file(&submission.path)
    })?;
    let variants = places.iter().map(|&place| prepared.variant(place)).collect();
    Ok(Entry { submission, variants, result })
}

/// Our run that each of a submission's is: of those that have all its keys the one with the fewest keys.
fn places(submission: &Submission, prepared: &dyn Prepared) -> Result<Vec<usize>, JudgeError> {
    let variants: Vec<Variant> = (0..prepared.run_count()).map(|run| prepared.variant(run)).collect();
    let mut places: Vec<usize> = Vec::new();
    for (number, run) in submission.runs.iter().enumerate() {
        let wrong = |rule: &str, remedy: &str| {
            let field = format!("run {}.variant", number + 1);
            let value = format!("\"{}\"", run.variant);
            JudgeError::from(FieldError::new(&field, value, rule, remedy).in_file(&submission.path))
        };
        let matching: Vec<usize> =
            (0..variants.len()).filter(|&place| variants[place].includes(&run.variant)).collect();
        let keys = |place: usize| variants[place].parts().count();
        let fewest = matching.iter().map(|&place| keys(place)).min();
        let least: Vec<usize> = matching.into_iter().filter(|&place| Some(keys(place)) == fewest).collect();
        match least[..] {
            [place] if places.contains(&place) => {
                return Err(wrong("another run than those before", "give each run once, in one table [[run]]"));
            }
            [place] => places.push(place),
            [] => {
                let listed: Vec<String> = variants.iter().take(6).map(|variant| format!("\"{variant}\"")).collect();
                let rule = format!("keys of a run of this case and tier, such as {}", listed.join(", "));
                return Err(wrong(&rule, "`bagnold judge --template` lists the runs"));
            }
            _ => {
                let listed: Vec<String> =
                    least.iter().take(4).map(|&place| format!("\"{}\"", variants[place])).collect();
                return Err(wrong(
                    &format!("one run, but is {}", listed.join(" and ")),
                    "add a key that tells them apart",
                ));
            }
        }
    }
    Ok(places)
}

/// Puts the codes beside our own results.
///
/// # Errors
/// A single number that no metric of its run has.
pub fn judge(own: CaseResult, entries: &[Entry]) -> Result<Judgement, JudgeError> {
    let codes: Vec<Judged> = entries
        .iter()
        .map(|entry| {
            let numbers: Vec<_> = entry
                .variants
                .iter()
                .zip(&entry.submission.runs)
                .enumerate()
                .map(|(number, (variant, run))| (variant.clone(), run, format!("run {}", number + 1)))
                .collect();
            let metrics = verdicts::compare(&own.metrics, &entry.result, &numbers)
                .map_err(|error| error.in_file(&entry.submission.path))?;
            Ok(Judged { code: entry.submission.code.clone(), file: entry.submission.path.clone(), metrics })
        })
        .collect::<Result<_, JudgeError>>()?;
    let theirs: Vec<(&str, &[Figure])> =
        entries.iter().map(|entry| (entry.submission.code.name.as_str(), entry.result.figures.as_slice())).collect();
    let figures = overlay::overlay(&own.figures, &theirs);
    Ok(Judgement { own, codes, figures })
}

impl PlanError {
    /// Says in which file a field stands, unless that is already known.
    fn in_file(self, file: &Path) -> Self {
        match self {
            Self::Field(error) => Self::Field(error.in_file(file)),
            other => other,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::{Columns, Form, Item, Picture, Tier};
    use crate::cases::REGISTRY;

    /// Columns that rise from 0 to a hundredth.
    fn columns(items: &[Item]) -> Columns {
        let ramp: Vec<f64> = (0..30).map(|row| f64::from(row) / 2900.0).collect();
        items.iter().map(|item| (item.name.to_owned(), ramp.clone())).collect()
    }

    /// Each part alone: series, profile, one picture, two pictures.
    fn parts(form: &'static Form, is_planar: bool) -> Vec<Given> {
        let particles: Vec<Item> =
            form.particles.iter().filter(|item| !(is_planar && item.name == "z")).copied().collect();
        let picture = |time: f64| Picture { time, columns: columns(&particles) };
        let mut parts = vec![
            Given { series: columns(form.series), ..Given::default() },
            Given { profile: columns(form.profile), ..Given::default() },
        ];
        if !particles.is_empty() {
            parts.push(Given { pictures: vec![picture(0.5)], ..Given::default() });
            parts.push(Given { pictures: vec![picture(0.0), picture(0.5)], ..Given::default() });
        }
        parts
    }

    #[test]
    fn every_part_alone_gives_numbers_and_none_for_what_is_missing() {
        let mut cases = 0;
        for case in REGISTRY.iter().filter(|case| *case.form() != Form::NUMBERS) {
            cases += 1;
            let prepared = case.prepare(Tier::Quick, &Changes::default()).expect("a tier");
            for given in parts(case.form(), case.name() != "column-round") {
                let all = vec![given; prepared.run_count()];
                let result =
                    prepared.foreign(&all).map_err(|(run, error)| format!("{} run {run}: {error}", case.name()));
                let result = result.expect("complete columns");
                assert!(
                    result.measured.iter().any(|(_, names)| !names.is_empty()),
                    "{}: nothing measured",
                    case.name()
                );
                for ledger in ["energy_residual", "energy_rise", "momentum_residual"] {
                    let judged =
                        result.metrics.iter().any(|metric| metric.name == ledger && result.is_measured(metric));
                    assert!(!judged, "{}: {ledger} of a code that keeps no ledger", case.name());
                }
            }
        }
        assert!(cases >= 6, "{cases} cases take files");
    }

    fn read(text: &str) -> Result<Trial, JudgeError> {
        let folder = tempfile::tempdir().expect("temporary folder");
        let file = folder.path().join("mine.toml");
        std::fs::write(&file, text).expect("writable");
        std::fs::write(folder.path().join("u.csv"), "y [mm],u\n0,0\n1,0.1\n2,0.2\n").expect("writable");
        Trial::read(&[file], REGISTRY)
    }

    fn message(text: &str) -> String {
        let error = read(text).err().map(|error| error.to_string()).expect("refused");
        error.rsplit_once("mine.toml: ").map_or(error.clone(), |(_, message)| message.to_owned())
    }

    const HEAD: &str = "case = \"bagnold\"\n[code]\nname = \"a\"\n[[run]]\n";

    #[test]
    fn a_profile_in_other_units_is_a_run() {
        let text = format!(
            "{HEAD}variant = \"slope_angle=24,start=rest\"\nprofile = {{ file = \"u.csv\", columns = {{ height = \"y [mm]\", velocity = \"u [m/s]\" }} }}"
        );
        let trial = read(&text).expect("a submission");
        assert_eq!((trial.prepared.run_count(), trial.entries.len()), (1, 1));
        let l2 = trial.entries[0].result.metrics.iter().find(|metric| metric.name == "velocity_l2").expect("a profile");
        assert!(l2.value.is_finite() && trial.entries[0].result.is_measured(l2));
    }

    #[test]
    fn what_is_wrong_is_refused_by_field() {
        let run = "variant = \"slope_angle=24,start=rest\"\n";
        let profile = |columns: &str| format!("{HEAD}{run}profile = {{ file = \"u.csv\", columns = {{ {columns} }} }}");
        let refused = [
            (format!("{HEAD}{run}"), "`run 1` is empty, but must be a run of which something is given"),
            (
                format!("{HEAD}variant = \"slope_angle=3\"\nnumbers = {{ velocity_l2 = 1.0 }}"),
                "`run 1.variant` is \"slope_angle=3\", but must be keys of a run",
            ),
            (
                format!("{HEAD}{run}numbers = {{ velocity_l2 = nan }}"),
                "`run 1.numbers.velocity_l2` is NaN, but must be a number",
            ),
            (
                profile("height = \"y [mm]\", velocity = \"v [m/s]\""),
                "`run 1.profile.columns.velocity` is \"v\", but must be a column of",
            ),
            (
                profile("height = \"y [mm]\", velocity = \"u [furlong/s]\""),
                "`run 1.profile.columns.velocity` is [furlong/s], but must be a unit of the same kind as m/s",
            ),
            (
                profile("height = \"u [s]\""),
                "`run 1.profile.columns.height` is [s], but must be a unit of the same kind as m",
            ),
            (
                profile("hight = \"y [mm]\""),
                "`run 1.profile.columns.hight` is given, but must be one of height, velocity, pressure; did you mean `height`?",
            ),
        ];
        for (text, start) in refused {
            let message = message(&text);
            assert!(message.contains(start), "{message}");
        }
    }
}
