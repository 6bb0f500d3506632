//! One case or study, simulated and judged in memory.

use crate::results::{Figures, particles, table};
use crate::waiting::{Refused, wait_for};
use bagnold_harness::case::{CaseResult, Limits, ParameterError, Request, Requested, Silent, Tier, execute};
use bagnold_harness::measured::{draw_measured, read_overlay};
use bagnold_harness::metric::Variant;
use bagnold_harness::result::MetricsDocument;
use bagnold_harness::store::{Store, StorePolicy};
use bagnold_scenes::study::{Study, is_study};
use bagnold_validation::REGISTRY;
use bagnold_validation::cli::{ProgramError, warn_of_fast};
use clap::ValueEnum;
use pyo3::prelude::*;
use pyo3::types::{PyDict, PyList};
use std::path::{Path, PathBuf};

/// Simulates a case or study, or takes its runs from the store, and judges it.
#[pyfunction]
#[pyo3(signature = (target, *, tier=None, settings=Vec::new(), only=Vec::new(), overlay=Vec::new(), fresh=false, threads=None, store=None))]
#[expect(clippy::too_many_arguments, reason = "they are keywords, and stand for the options of `bagnold run`")]
pub(crate) fn run<'py>(
    py: Python<'py>,
    target: &str,
    tier: Option<&str>,
    settings: Vec<String>,
    only: Vec<String>,
    overlay: Vec<PathBuf>,
    fresh: bool,
    threads: Option<u16>,
    store: Option<PathBuf>,
) -> PyResult<Bound<'py, PyDict>> {
    let refused = |text: String| Refused::new_err(text);
    let tier = tier.map(|name| Tier::from_str(name, false)).transpose().map_err(|_| {
        refused(format!("`tier` must be one of \"quick\", \"paper\", \"fine\", but is {:?}", tier.unwrap_or_default()))
    })?;
    let only: Vec<Variant> = only
        .iter()
        .map(|text| text.parse().map_err(|error| refused(format!("`only` is {text:?}: {error}"))))
        .collect::<PyResult<_>>()?;
    let policy = if fresh { StorePolicy::Refresh } else { StorePolicy::Use };
    let (result, document) = wait_for(py, threads, || {
        let open = || store.as_ref().map_or_else(|| Store::open(policy), |folder| Store::at(folder, policy));
        let path = Path::new(target);
        if REGISTRY.find(target).is_err() && path.is_file() && is_study(path) {
            if let Some((option, _)) =
                [("only", only.is_empty()), ("overlay", overlay.is_empty())].iter().find(|of| !of.1)
            {
                let remedy = "leave it out, or run the case that the study is based on";
                return Err(ParameterError::field(option, "not available for a study", "", remedy).into());
            }
            let study = Study::read(path, *REGISTRY)?;
            let cases = study.prepare(*REGISTRY, tier, &settings, Limits::of(None, None))?;
            cases.iter().for_each(|case| drop(case.briefs()));
            let results = execute(cases, &open(), &Silent)?;
            warn_of_fast(&results);
            let result = study.judge(results)?;
            let document = MetricsDocument::of(&result, rayon::current_num_threads()).text();
            return Ok::<_, ProgramError>((result, document));
        }
        let request = Request { target, tier, settings: &settings, only: &only, limits: Limits::of(None, None) };
        let Requested { prepared, overlay: named, .. } = request.prepare(*REGISTRY)?;
        let measured = read_overlay(prepared.as_ref(), &named, &overlay)?;
        // what it warns of is told at the end
        drop(prepared.briefs());
        let mut result = execute(vec![prepared], &open(), &Silent)?.pop().ok_or(ParameterError::Interrupted)?;
        warn_of_fast(std::slice::from_ref(&result));
        draw_measured(&mut result, &measured)?;
        let document = MetricsDocument::of(&result, rayon::current_num_threads()).text();
        Ok((result, document))
    })?;
    described(py, result, document)
}

/// The result as Python's own values and arrays.
fn described(py: Python<'_>, result: CaseResult, document: String) -> PyResult<Bound<'_, PyDict>> {
    let described = PyDict::new(py);
    described.set_item("document", document)?;
    let parameters: toml::Table = toml::from_str(&result.parameters_toml)
        .map_err(|error| Refused::new_err(format!("failed to read the parameters as run: {error}")))?;
    let parameters = serde_json::to_string(&parameters)
        .map_err(|error| Refused::new_err(format!("failed to read the parameters as run: {error}")))?;
    described.set_item("parameters", parameters)?;
    described.set_item("case_file", result.parameters_toml)?;
    described.set_item("description", result.description)?;
    let tables = PyDict::new(py);
    for own in &result.tables {
        tables.set_item(&own.name, table(py, own)?)?;
    }
    described.set_item("tables", tables)?;
    let frames = PyDict::new(py);
    for (run, own) in result.runs.iter().zip(result.frames) {
        let pictures = own.into_iter().map(|frame| particles(py, frame)).collect::<PyResult<Vec<_>>>()?;
        frames.set_item(run.variant.to_string(), PyList::new(py, pictures)?)?;
    }
    described.set_item("frames", frames)?;
    described.set_item("figures", Figures(result.figures).into_pyobject(py)?)?;
    Ok(described)
}
