//! Request for runs: a case by its name or from a file, with changes, all of its runs or some.

use crate::case::given::error::ParameterError;
use crate::case::{AnyCase, CaseFile, Changes, Limits, OutputPlan, PreparedCase, Registry, Tier};
use crate::input::MeasuredFiles;
use crate::metric::Variant;
use std::path::Path;

/// A case and the changes of its tier's parameters.
#[derive(Debug, Clone, Copy, Default)]
pub struct Request<'a> {
    /// Name of a case, or path of a TOML file that describes one.
    pub target: &'a str,
    /// Tier; without one the file's, else quick.
    pub tier: Option<Tier>,
    /// `path=value` changes, applied after the file; each gives fields of its own.
    pub settings: &'a [String],
    /// Keys of the runs that are meant; all runs where there are none.
    pub only: &'a [Variant],
    /// Resource limits of the runs.
    pub limits: Limits,
}

/// A request whose parameters were checked; nothing has been simulated.
pub struct Requested {
    /// The case's runs.
    pub prepared: Box<dyn PreparedCase>,
    /// Tier of the prepared case.
    pub tier: Tier,
    /// Files with measurements that its file names.
    pub overlay: Vec<MeasuredFiles>,
    /// States that its file asks for during the runs.
    pub output: Option<OutputPlan>,
    /// Whether anything may differ from the defaults of the case.
    pub changed: bool,
    /// Whether a file or a setting may have changed parameters.
    pub has_own_parameters: bool,
}

impl Request<'_> {
    /// Finds the case and checks its parameters.
    ///
    /// # Errors
    /// An unknown case, a file that cannot be understood, parameters that the case refuses, runs that it does not have.
    pub fn prepare(&self, registry: Registry) -> Result<Requested, ParameterError> {
        let (case, tier, file): (&'static dyn AnyCase, _, _) = if names_a_file(self.target, registry) {
            let file = CaseFile::read(Path::new(self.target))?;
            let case = registry.find(&file.case).map_err(|error| error.in_file(&file.path))?;
            (case, self.tier.or(file.tier), Some(file))
        } else {
            (registry.find(self.target)?, self.tier, None)
        };
        let tier = tier.unwrap_or(Tier::Quick);
        let changes = Changes {
            file: file.as_ref().map(|file| (file.path.as_path(), file.fields.clone())),
            settings: self.settings,
            limits: self.limits,
            only: self.only,
        };
        let has_own_parameters = file.is_some() || !self.settings.is_empty();
        let changed = has_own_parameters || !self.only.is_empty();
        let prepared = only(case.prepare(tier, &changes)?, self.only, "--only")?;
        let (overlay, output) = file.map(|file| (file.overlay, file.output)).unwrap_or_default();
        Ok(Requested { prepared, tier, overlay, output, changed, has_own_parameters })
    }
}

/// The runs that have all keys of any of the variants that a field asks for; all where none is asked for.
pub(crate) fn only(
    prepared: Box<dyn PreparedCase>,
    asked: &[Variant],
    field: &str,
) -> Result<Box<dyn PreparedCase>, ParameterError> {
    if asked.is_empty() {
        return Ok(prepared);
    }
    let variants: Vec<Variant> = (0..prepared.run_count()).map(|run| prepared.variant(run)).collect();
    let has = |asked: &Variant| variants.iter().any(|variant| variant.includes(asked));
    if let Some(missing) = asked.iter().find(|asked| !has(asked)) {
        let listed: Vec<String> = variants.iter().take(5).map(|variant| format!("\"{variant}\"")).collect();
        let rule = format!("keys and values of a run of this case and tier, such as {}", listed.join(", "));
        return Err(ParameterError::field(
            field,
            format!("\"{missing}\""),
            &rule,
            "leave out keys to select several runs",
        ));
    }
    let runs: Vec<usize> =
        (0..variants.len()).filter(|&run| asked.iter().any(|asked| variants[run].includes(asked))).collect();
    Ok(prepared.choose(&runs))
}

/// A case goes before a file of the same name; what looks like a path is meant as one.
fn names_a_file(target: &str, registry: Registry) -> bool {
    let path = Path::new(target);
    registry.find(target).is_err()
        && (path.components().count() > 1 || path.extension().is_some_and(|ending| ending == "toml") || path.is_file())
}
