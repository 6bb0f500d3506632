//! A case as one flow: its parameters are one simulation, and a list says which of them are run.

pub mod cost;
pub mod list;

use self::cost::RunCost;
use self::list::{ListOfRuns, ListedChange, NamedVariant, VariedParameter};
use crate::case::given::changes::{
    Changes, checked, lay_at, lay_over, overlay, paths, refuse_former, table_of, typed, unknown_law,
};
use crate::case::given::fault;
use crate::case::{ParameterError, Progress, RunScales, Tier};
use crate::input::FieldError;
use crate::metric::{FlowRegime, Value as VariantValue, Variant};
use crate::observation::Recorded;
use bagnold_solver::material::rheology::Rheology;
use bagnold_solver::parameter::{Fault, Shape, first_fault, schema_of};
use schemars::JsonSchema;
use serde::de::{DeserializeOwned, Error};
use serde::{Deserialize, Deserializer, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;
use toml::{Table, Value};

/// One simulation with all of its parameters, each declared once: a field with its doc comment, unit and range. Its serialised
/// form is its identity in the store.
/// `Default` is the flow that a case runs where nothing else is given. The top-level names `case`, `tier`, `vary` and
/// `variants` are taken by the file format.
pub trait Flow:
    Default + Clone + PartialEq + Serialize + DeserializeOwned + JsonSchema + Send + Sync + 'static
{
    /// Text of `runs/CASE.toml`: the flows of each tier. Empty for the default flow alone.
    const RUNS: &'static str = "";
    /// Lists of the flow that a file states whole: one that it leaves out is empty there, and not the tier's.
    const STATED: &'static [&'static str] = &[];

    /// The rules between fields; called once every field is in its own range.
    ///
    /// # Errors
    /// The first field that breaks a rule, by its dotted TOML path.
    fn check(&self) -> Result<(), ParameterError> {
        Ok(())
    }
    /// Warnings of values that are possible but unlikely; asked of a flow that holds.
    fn doubts(&self) -> Vec<String> {
        Vec::new()
    }

    /// Observation that the run produces: plain data, stored and shared by tests and report. Stored as postcard, which
    /// needs serde's plain derive: no untagged or internally tagged enums, no `flatten`.
    type Observation: Serialize + DeserializeOwned + Send + Sync;

    /// Full name of the run, `key=value,…` in the case's fixed order; unique within the case.
    fn variant(&self) -> Variant;
    /// Expected resources; all alike, if nothing is known.
    fn cost(&self) -> RunCost {
        RunCost { particle_steps: 1e6, ..RunCost::weakly_compressible(0.0, 0.0) }
    }
    /// The regime of the flow that it leaves behind; nothing, unless a case tells.
    fn regime(&self, _: &Self::Observation) -> FlowRegime {
        FlowRegime::default()
    }
    /// Scales r_0 and t_0 of columns that another code gives; none, unless a case tells.
    fn scales(&self) -> Option<RunScales> {
        None
    }
    /// Constitutive laws of its scene that its own fields do not name, because they hold a law's numbers alone.
    fn laws(&self) -> Vec<Rheology> {
        Vec::new()
    }
    /// An observation without content, whose tables and figures have the headings and axes of the run's; none, unless a case tells.
    fn outline(&self) -> Option<Self::Observation> {
        None
    }
    /// One line on the run before it starts, for the terminal; nothing, unless a case tells.
    fn brief(&self) -> Option<String> {
        None
    }
    /// The run without its end, equal for runs of which one continues the other; none if a longer run begins anew.
    fn trajectory(&self) -> Option<Self> {
        None
    }
    /// Simulates it. A divergence is part of the record, not an error.
    ///
    /// # Errors
    /// Parameters whose combination gives no valid scene.
    fn simulate(&self, progress: &Progress) -> Result<Recorded<Self::Observation>, ParameterError>;
}

/// The file of the flows of each tier.
#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct TiersFile {
    set: Table,
    paper: Table,
    fine: Table,
    variants: Vec<NamedVariant>,
    vary: Vec<VariedParameter>,
    /// Fields of earlier files, each with the field that takes its place.
    former: BTreeMap<String, String>,
}

impl TiersFile {
    /// That of a flow.
    fn of<F: Flow>() -> Self {
        toml::from_str(F::RUNS).unwrap_or_else(|error| panic!("a case's list of runs is TOML: {error}"))
    }
}

/// A flow, the list of its runs, and these runs.
#[derive(Debug, Clone, Serialize, JsonSchema)]
pub struct RunList<F> {
    /// The values of all runs that have no others.
    #[serde(flatten)]
    pub base: F,
    /// Variants and varied parameters.
    #[serde(flatten)]
    pub list: ListOfRuns,
    /// The runs, once they are asked for: a tier's own are often replaced before.
    #[serde(skip)]
    listed: OnceLock<ListedFlows<F>>,
}

/// The runs of a list.
#[derive(Debug, Clone)]
struct ListedFlows<F> {
    flows: Vec<F>,
    /// Keys that tell each of them apart where their own names do not.
    labels: Vec<Variant>,
}

impl<F: Flow> ListedFlows<F> {
    fn of(case: &str, base: &F, list: &ListOfRuns) -> Result<Self, ParameterError> {
        let table = table_of(base);
        let (mut flows, mut listed) = (Vec::<F>::new(), Vec::new());
        for change in list.changes() {
            let flow = if change.values.is_empty() { base.clone() } else { changed(case, &table, &change)? };
            // a value that is set for all runs can leave several of them equal
            if !flows.contains(&flow) {
                flows.push(flow);
                listed.push(change.variant);
            }
        }
        let labels = labels(&flows, &listed);
        let mut names = BTreeSet::new();
        let mut names_of = flows.iter().zip(&labels).map(|(flow, label)| flow.variant().followed_by(label));
        if let Some(twin) = names_of.find(|name| !names.insert(name.clone())) {
            let defect = format!("two runs are named \"{twin}\"");
            return Err(ParameterError::field("vary", defect, "", "give one of the varied parameters another `name`"));
        }
        Ok(Self { flows, labels })
    }
}

impl<F: Flow> RunList<F> {
    /// The runs of a list over base values of a case.
    ///
    /// # Errors
    /// The first place in the list that breaks a rule.
    pub fn new(case: &str, base: F, list: ListOfRuns) -> Result<Self, ParameterError> {
        list.check()?;
        let listed = ListedFlows::of(case, &base, &list)?.into();
        Ok(Self { base, list, listed })
    }

    fn listed(&self) -> &ListedFlows<F> {
        let listed = || ListedFlows::of("CASE", &self.base, &self.list);
        self.listed.get_or_init(|| listed().unwrap_or_else(|error| panic!("a case's list of runs: {error}")))
    }

    /// Runs in the order of the list.
    pub fn flows(&self) -> &[F] {
        &self.listed().flows
    }
}

/// Of the keys that a list gives its runs, for each run those that tell runs apart which have one name.
fn labels<F: Flow>(flows: &[F], listed: &[Variant]) -> Vec<Variant> {
    let own: Vec<Variant> = flows.iter().map(F::variant).collect();
    let mut first: BTreeMap<String, usize> = BTreeMap::new();
    let mut keys: BTreeSet<&str> = BTreeSet::new();
    for (place, (own, listed_here)) in own.iter().zip(listed).enumerate() {
        let twin = *first.entry(own.to_string()).or_insert(place);
        let differs =
            |(key, value): &(&str, &VariantValue)| own.get(key).is_none() && listed[twin].get(key) != Some(*value);
        keys.extend(listed_here.parts().filter(differs).map(|(key, _)| key));
    }
    let label = |listed: &Variant| {
        let parts = listed.parts().filter(|(key, _)| keys.contains(key));
        parts.fold(Variant::default(), |label, (key, value)| label.and(key, value.clone()))
    };
    listed.iter().map(label).collect()
}

/// A flow with the values of one run.
fn changed<F: Flow>(case: &str, base: &Table, change: &ListedChange) -> Result<F, ParameterError> {
    let schema = schema_of::<F>();
    let mut changes = Table::new();
    for (_, path, value) in &change.values {
        lay_at(&mut changes, path, value);
    }
    keep_shared(schema, base, &mut changes);
    let mut table = base.clone();
    overlay(schema, &mut table, &changes);
    let value = Value::Table(table);
    if let Some(fault) = first_fault(schema, &value).or_else(|| unknown_law(schema, &value, "")) {
        return Err(placed(case, fault, base, change));
    }
    value.try_into().map_err(|error: toml::de::Error| {
        let place = change.values.first().map_or("variants", |(place, ..)| place);
        let defect = format!("run {}: {}", change.variant, error.message());
        ParameterError::field(place, defect, "", "correct the values of this run")
    })
}

/// Gives another choice of a law the parameters that it has in common with the law of the base.
fn keep_shared(schema: &serde_json::Value, base: &Table, changes: &mut Table) {
    for (key, change) in changes {
        let (Some(Value::Table(base)), Some(schema)) = (base.get(key), schema["properties"].get(key)) else { continue };
        let shape = Shape::of(schema);
        let content = shape.chosen(change).and_then(|variant| variant.content);
        let (Some(own), Value::Table(change)) = (content.and_then(|content| content.get("properties")), change) else {
            continue;
        };
        for (name, value) in base.iter().filter(|(name, _)| own.get(name).is_some()) {
            change.entry(name).or_insert_with(|| value.clone());
        }
    }
}

/// A fault in a run, by the place in the list that gives the value.
fn placed(case: &str, fault: Fault, base: &Table, change: &ListedChange) -> ParameterError {
    let path = fault.path().to_owned();
    let gives = |own: &str| own == path || path.starts_with(&format!("{own}.")) || own.starts_with(&format!("{path}."));
    let given = change
        .values
        .iter()
        .rev()
        .find(|(_, own, value)| gives(own) || value.is_table() && path.starts_with(own.as_str()));
    let error = fault::in_parameters(fault, case, &paths(base));
    let Some((place, own, given)) = given else { return error.into() };
    let is_value = own == &path && !error.rule.is_empty();
    let value = if is_value { given.to_string() } else { error.value };
    FieldError { field: format!("{place}.{path}"), value, ..error }.into()
}

impl<'de, F: Flow> Deserialize<'de> for RunList<F> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        Self::of_table("CASE", Table::deserialize(deserializer)?).map_err(D::Error::custom)
    }
}

impl<F: Flow> RunList<F> {
    /// Lists that a file states whole: of the flow, and of the runs.
    pub(in crate::case) const STATED: [&'static [&'static str]; 2] = [F::STATED, &["variants", "vary"]];

    /// Lays the changes over the defaults, checks each field along the schema, and types the result.
    pub(in crate::case) fn resolve(&self, case: &str, changes: &Changes<'_>) -> Result<Self, ParameterError> {
        refuse_former(&TiersFile::of::<F>().former, changes)?;
        let table = checked(case, schema_of::<Self>(), &table_of(self), changes, Self::set_for_all)?;
        Self::of_table(case, table).map_err(|error| changes.blamed(error))
    }

    /// The flows of a tier.
    ///
    /// # Panics
    /// If the case's own list is malformed, which its tests would find.
    pub fn of_tier(tier: Tier) -> Self {
        let file = TiersFile::of::<F>();
        let mut changes = file.set;
        for (lowest, values) in [(Tier::Paper, &file.paper), (Tier::Fine, &file.fine)] {
            if lowest <= tier {
                lay_over(&mut changes, values);
            }
        }
        let values = changes.into_iter().map(|(path, value)| ("set".to_owned(), path, value)).collect();
        let change = ListedChange { variant: Variant::default(), values };
        let base = changed("CASE", &table_of(&F::default()), &change).unwrap_or_else(|error| panic!("{tier}: {error}"));
        let list = ListOfRuns { variants: file.variants, vary: file.vary }.of_tier(tier);
        Self { base, list, listed: OnceLock::new() }
    }

    /// Doubts of all of its flows, each once.
    pub(in crate::case) fn doubts(&self) -> Vec<String> {
        let mut doubts: Vec<String> = Vec::new();
        for doubt in self.flows().iter().flat_map(Flow::doubts) {
            if !doubts.contains(&doubt) {
                doubts.push(doubt);
            }
        }
        doubts
    }

    /// The list of a table whose fields are sound.
    ///
    /// # Errors
    /// What no schema can tell, such as a place in a list of runs that breaks a rule.
    pub(in crate::case) fn of_table(case: &str, mut table: Table) -> Result<Self, ParameterError> {
        let parts = ["variants", "vary"].into_iter().filter_map(|key| Some((key.to_owned(), table.remove(key)?)));
        let list = typed(case, parts.collect())?;
        Self::new(case, typed(case, table)?, list)
    }

    /// Keys that distinguish a run from other runs of the case.
    pub(in crate::case) fn label(&self, run: &F) -> Variant {
        let ListedFlows { flows, labels } = self.listed();
        flows.iter().position(|own| own == run).map(|place| labels[place].clone()).unwrap_or_default()
    }

    /// Full name of a run.
    pub(in crate::case) fn variant_of(&self, run: &F) -> Variant {
        run.variant().followed_by(&self.label(run))
    }

    /// Sets the values at these paths for all runs, whatever the list gives.
    pub(in crate::case) fn set_for_all(table: &mut Table, paths: &[String]) {
        let parts = ["variants", "vary"].into_iter().filter_map(|key| Some((key.to_owned(), table.get(key)?.clone())));
        let Ok(mut list) = Value::Table(parts.collect()).try_into::<ListOfRuns>() else { return };
        for path in paths {
            list.forget(path);
            // the angle stands for the coefficient
            if let Some(above) = path.strip_suffix("friction_angle") {
                list.forget(&format!("{above}static_friction"));
            }
            // another choice of a law replaces what the list says of its parameters
            if let Some((above, tag)) = path.rsplit_once('.')
                && let Some(schema) = schema_of::<F>()["properties"].get(above)
                && matches!(Shape::of(schema), Shape::Tagged { tag: own, .. } if own == tag)
            {
                list.forget(above);
            }
        }
        let list = table_of(&list);
        for key in ["variants", "vary"] {
            match list.get(key) {
                Some(value) => table.insert(key.to_owned(), value.clone()),
                None => table.remove(key),
            };
        }
    }
}
