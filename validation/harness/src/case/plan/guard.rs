//! Checks of the parameters of a case as a whole, before anything is allocated: the rules between fields, runs that can
//! be distinguished, and a size that this machine can take. Every refusal names a field that the user has changed.

use crate::case::given::changes::{Changes, find, is_same_or_within, is_set, leaves, table_of};
use crate::case::given::error::ParameterError;
use crate::case::{Estimate, Flow, RunList, Tier};
use crate::output::caution;
use bagnold_solver::parameter::shortened;
use toml::Table;

/// Most changed fields that a message lists.
const LISTED: usize = 8;

/// Parameters between those of a tier and those that a user asks for.
pub(in crate::case) struct Guard<'a, F> {
    pub(in crate::case) case: &'static str,
    pub(in crate::case) tier: Tier,
    pub(in crate::case) changes: &'a Changes<'a>,
    defaults: Table,
    asked: Table,
    parameters: &'a RunList<F>,
}

impl<'a, F: Flow> Guard<'a, F> {
    pub(in crate::case) fn new(
        (case, tier): (&'static str, Tier),
        changes: &'a Changes<'a>,
        (defaults, parameters): (&RunList<F>, &'a RunList<F>),
    ) -> Self {
        Self { case, tier, changes, defaults: table_of(defaults), asked: table_of(parameters), parameters }
    }

    /// The runs that the parameters ask for.
    pub(in crate::case) fn runs(&self) -> Result<Vec<F>, ParameterError> {
        self.check().map_err(|error| self.changes.source().placed(error))?;
        Ok(self.parameters.flows().to_vec())
    }

    fn check(&self) -> Result<(), ParameterError> {
        self.parameters.list.check_single_tier()?;
        let chosen = self.chosen(self.parameters);
        chosen.iter().try_for_each(|flow| flow.check()).map_err(|error| with_changed(error, &self.changed()))?;
        self.parameters.doubts().iter().for_each(|doubt| caution(doubt));
        self.check_cost(&of_runs(&chosen))
    }

    /// Those of the runs that are to be simulated.
    fn chosen<'r>(&self, list: &'r RunList<F>) -> Vec<&'r F> {
        let only = self.changes.only;
        let is_chosen = |run: &&F| {
            let variant = list.variant_of(run);
            only.is_empty() || only.iter().any(|asked| variant.includes(asked))
        };
        list.flows().iter().filter(is_chosen).collect()
    }

    /// Fields that differ from the tier's, with their values.
    pub(in crate::case) fn changed(&self) -> Vec<(String, String)> {
        leaves(&self.asked)
            .into_iter()
            .filter(|path| self.is_given(path) && find(&self.asked, path) != find(&self.defaults, path))
            .map(|path| {
                let value = find(&self.asked, &path).map(ToString::to_string).unwrap_or_default();
                (path, shortened(value.replace('\n', " ")))
            })
            .collect()
    }

    /// Whether a field is the user's: the list of runs also changes where another field is set for all of them.
    fn is_given(&self, path: &str) -> bool {
        let of_file = self.changes.file.as_ref().is_some_and(|(_, fields)| fields.contains_key(path));
        !["variants", "vary"].contains(&path) || of_file || is_set(self.changes.settings, path)
    }

    /// Estimated resources with one field as the tier has it, if that makes any runs.
    fn without(&self, path: &str) -> Option<Estimate> {
        let before = find(&self.defaults, path)?.clone();
        let mut table = self.asked.clone();
        let mut keys: Vec<&str> = path.split('.').collect();
        let last = keys.pop()?;
        let holder = keys.into_iter().try_fold(&mut table, |table, key| table.get_mut(key)?.as_table_mut())?;
        holder.insert(last.to_owned(), before);
        let parameters = RunList::<F>::of_table(self.case, table).ok()?;
        let chosen = self.chosen(&parameters);
        (!chosen.is_empty() && chosen.iter().all(|flow| flow.check().is_ok())).then(|| of_runs(&chosen))
    }

    /// Check of memory and time against the limits; the field is the one that, as the tier has it, saves most.
    fn check_cost(&self, estimate: &Estimate) -> Result<(), ParameterError> {
        let limits = &self.changes.limits;
        let Some((defect, remedy)) = estimate.problem(limits) else { return Ok(()) };
        let (changed, tier) = (self.changed(), ("tier".to_owned(), self.tier.name().to_owned()));
        let saved = changed.iter().filter_map(|field| Some((self.without(&field.0)?.excess(limits), field)));
        let saved = saved.filter(|(excess, _)| *excess < estimate.excess(limits));
        let most = saved.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, field)| field);
        let (field, value) = most.or(changed.first()).unwrap_or(&tier);
        Err(ParameterError::field(field, format!("{value} {defect}"), "", &remedy))
    }
}

/// Estimated resources of the runs together.
fn of_runs<F: Flow>(runs: &[&F]) -> Estimate {
    runs.iter().map(|run| Estimate::of(run.cost())).fold(Estimate::default(), Estimate::and)
}

/// An error that names no field of the user's says which ones he has changed.
pub(in crate::case) fn with_changed(error: ParameterError, changed: &[(String, String)]) -> ParameterError {
    let is_named = |field: &str| changed.iter().any(|(path, _)| is_same_or_within(field, path));
    if changed.is_empty() || error.field_path().is_some_and(is_named) {
        return error;
    }
    let mut listed: Vec<String> =
        changed.iter().take(LISTED).map(|(path, value)| format!("`{path}` is {value}")).collect();
    if changed.len() > LISTED {
        listed.push(format!("and {} more", changed.len() - LISTED));
    }
    ParameterError::Changed { origin: None, error: Box::new(error), changed: listed.join(", ") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::pendulum::Pendulum;
    use crate::case::{AnyCase, Changes, Limits, Tier};
    use crate::metric::Variant;

    const LIMITS: Limits = Limits { memory: 1e9, core_hours: 1.0 };

    fn refused(settings: &[&str], limits: Limits) -> String {
        let settings: Vec<String> = settings.iter().map(|&text| text.to_owned()).collect();
        let changes = Changes { settings: &settings, limits, ..Changes::default() };
        match Pendulum.prepare(Tier::Quick, &changes) {
            Ok(_) => "taken".to_owned(),
            Err(error) => error.to_string(),
        }
    }

    #[test]
    fn two_runs_of_one_name_are_refused() {
        assert_eq!(
            refused(&["vary=[{path=\"grain.damping\", name=\"steps\", values=[1.0, 2.0]}]"], LIMITS),
            "`vary`: two runs are named \"steps=20\"; give one of the varied parameters another `name`"
        );
    }

    #[test]
    fn the_field_that_saves_most_is_blamed_for_a_size() {
        let message = refused(&["grain.damping=2.0", "steps=900000"], Limits { core_hours: 1e-5, ..LIMITS });
        assert_eq!(
            message,
            "`steps`: 900000 needs 1.7e-4 core hours for 9.0e5 particle-steps, above the limit of 1.0e-5 core hours; \
             reduce the number of particles or steps, or raise `--most-hours`"
        );
        assert_eq!(refused(&["steps=900000"], LIMITS), "taken");
    }

    #[test]
    fn parameters_of_unselected_runs_are_not_refused() {
        let settings = ["vary=[{path=\"steps\", values=[900000, 10]}]".to_owned()];
        let limits = Limits { core_hours: 1e-5, ..LIMITS };
        let of = |only: &[Variant]| {
            let changes = Changes { settings: &settings, limits, only, ..Changes::default() };
            Pendulum.prepare(Tier::Quick, &changes).map(|_| ()).map_err(|error| error.to_string())
        };
        let large = of(&[Variant::of("steps", 900_000)]).expect_err("the long one is chosen");
        assert!(large.contains("above the limit of"), "{large}");
        assert_eq!(of(&[Variant::of("steps", 10)]), Ok(()), "the long one is not chosen");
        assert!(of(&[]).is_err());
    }

    #[test]
    fn a_tier_that_is_beyond_a_limit_is_named_itself() {
        let message = refused(&[], Limits { core_hours: 1e-12, ..LIMITS });
        assert!(message.starts_with("`tier`: quick needs "), "{message}");
    }

    #[test]
    fn an_error_without_a_changed_field_gets_those_that_were_changed() {
        let unnamed = || ParameterError::Interrupted;
        let changed = [("grain.damping".to_owned(), "2.0".to_owned())];
        let message = with_changed(unnamed(), &changed).to_string();
        assert!(message.ends_with("; changed from the tier's defaults: `grain.damping` is 2.0"), "{message}");
        assert_eq!(with_changed(unnamed(), &[]).to_string(), unnamed().to_string());
        let named = ParameterError::field("grain", 1, "2", "change it");
        assert!(!with_changed(named, &changed).to_string().contains("differs"));
    }
}
