//! From points of the unit cube to weighted residuals: evaluations in parallel, each a file, none done twice.

use super::folder::CalibrationFolder;
use super::plan::{CalibrationPlan, DataBlock};
use super::repeated::Repeated;
use super::target::{Datum, ProfileLocation, Target};
use crate::ToolError;
use crate::case::{PreparedCase, Registry, Silent, share_out};
use crate::evaluation::{self, EvaluationRecord};
use crate::inference::Evaluate;
use crate::input::{FieldError, unit};
use crate::output::FileError;
use crate::sampling::Random;
use crate::store::Store;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

/// Watches a calibration, for a progress bar. Called from several threads.
pub trait CalibrationMonitor: Sync {
    /// So many evaluations are to be made beyond those counted before.
    fn expected(&self, evaluations: usize);
    /// One has its record.
    fn evaluated(&self, case: &str, failure: Option<&str>);
}

/// A question to the model: a block's case with some settings.
#[derive(Debug, Clone)]
pub(super) struct Question {
    /// Place of the block in the plan.
    pub(super) block: usize,
    /// `path=value` settings.
    pub(super) settings: Vec<String>,
}

/// The model and the data that it is fitted to.
pub(super) struct Objective<'a> {
    pub(super) plan: &'a CalibrationPlan,
    pub(super) registry: Registry,
    pub(super) store: &'a Store,
    /// Folder of the evaluations.
    pub(super) folder: PathBuf,
    pub(super) watch: &'a dyn CalibrationMonitor,
    /// All data, those of fitted blocks first.
    pub(super) data: Vec<Datum>,
    /// Reason for the failure of the last failing record.
    pub(super) failure: Mutex<Option<String>>,
    /// Variance of every fitted prediction over that of its datum `[-]`; empty where runs do not scatter.
    pub(super) variances: Vec<f64>,
}

impl<'a> Objective<'a> {
    /// The objective of a plan, with its data read.
    pub(super) fn begin(
        plan: &'a CalibrationPlan,
        folder: &CalibrationFolder,
        (registry, store): (Registry, &'a Store),
        watch: &'a dyn CalibrationMonitor,
    ) -> Result<Self, ToolError> {
        let (folder, failure) = (folder.evaluations(), Mutex::default());
        let mut begun = Self { plan, registry, store, folder, watch, data: Vec::new(), failure, variances: Vec::new() };
        begun.read_data()?;
        Ok(begun)
    }

    /// Answers of blocks at points of physical values, one point after the other.
    pub(super) fn ask_at(&self, blocks: &[usize], points: &[Vec<f64>]) -> Result<Vec<Repeated>, ToolError> {
        let questions: Vec<Question> =
            points.iter().flat_map(|values| blocks.iter().map(|&block| self.question(block, values))).collect();
        self.ask(&questions)
    }

    /// Answers to questions, in their order, each with every seed where evaluations are repeated.
    pub(super) fn ask(&self, questions: &[Question]) -> Result<Vec<Repeated>, ToolError> {
        let repeated: Vec<Vec<Question>> = questions.iter().map(|question| self.with_seeds(question)).collect();
        let mut records = self.ask_each(&repeated.concat())?.into_iter();
        Ok(repeated.iter().map(|seeds| Repeated(records.by_ref().take(seeds.len()).collect())).collect())
    }

    /// The question with every seed; once as it is where there is nothing to repeat.
    pub(super) fn with_seeds(&self, question: &Question) -> Vec<Question> {
        let case = &self.plan.blocks[question.block].request.case;
        match self.plan.repeats.path_in(case) {
            None => vec![question.clone()],
            Some(path) => (1..=self.plan.repeats.count)
                .map(|seed| {
                    let mut settings = question.settings.clone();
                    settings.push(format!("{path}={seed}"));
                    Question { block: question.block, settings }
                })
                .collect(),
        }
    }

    /// Records of questions, in their order; what has a file is read, the rest simulated on the current pool's threads.
    fn ask_each(&self, questions: &[Question]) -> Result<Vec<EvaluationRecord>, ToolError> {
        // the key of an answer, or why there is none
        let mut answers: Vec<Result<String, EvaluationRecord>> = Vec::with_capacity(questions.len());
        let mut records: BTreeMap<String, EvaluationRecord> = BTreeMap::new();
        let mut waiting: Vec<(usize, String, Box<dyn PreparedCase>)> = Vec::new();
        for (place, question) in questions.iter().enumerate() {
            let block = &self.plan.blocks[question.block];
            if block.is_law {
                answers.push(Err(self.curve(question.block, &question.settings)));
                continue;
            }
            let request = &block.request;
            match request.prepare(self.registry, &self.plan.file, &question.settings, self.plan.limits) {
                Ok(prepared) => {
                    let key = evaluation::key(prepared.as_ref(), &[]);
                    // two questions of one batch may be the same
                    let asked = records.contains_key(&key) || waiting.iter().any(|(_, other, _)| *other == key);
                    if !asked {
                        match EvaluationRecord::read(&self.file(&key), &key) {
                            Some(known) => drop(records.insert(key.clone(), known)),
                            None => waiting.push((place, key.clone(), prepared)),
                        }
                    }
                    answers.push(Ok(key));
                }
                // a point that the case refuses is one where the model fails
                Err(error) => answers.push(Err(EvaluationRecord::failed("", &request.case, &error.to_string()))),
            }
        }
        self.watch.expected(waiting.len());
        let cost = |prepared: &dyn PreparedCase| prepared.estimate_of_all().particle_steps;
        waiting.sort_by(|a, b| cost(b.2.as_ref()).total_cmp(&cost(a.2.as_ref())).then(a.0.cmp(&b.0)));
        records.extend(share_out(waiting, |(_, key, prepared)| -> Result<_, ToolError> {
            let record = evaluation::evaluate(prepared, &[], self.store, &Silent)?;
            self.watch.evaluated(&record.case, record.failure.as_deref());
            let file = self.file(&key);
            record.write(&file).map_err(|error| FileError::unwritable(&file, &error))?;
            Ok((key, record))
        })?);
        let answer = |answer: Result<String, EvaluationRecord>| {
            answer.map_or_else(|refused| refused, |key| records[&key].clone())
        };
        let answers: Vec<EvaluationRecord> = answers.into_iter().map(answer).collect();
        if let Some(reason) = answers.iter().rev().find_map(|record| record.failure.clone()) {
            *self.failure.lock().unwrap_or_else(PoisonError::into_inner) = Some(reason);
        }
        Ok(answers)
    }

    /// Weight of a fitted datum's residual, where its prediction has a variance of its own `[-]`.
    pub(super) fn weight(&self, datum: usize) -> f64 {
        1.0 / (1.0 + self.scatter(datum) * self.scatter(datum)).sqrt()
    }

    /// Standard deviation of a fitted prediction over that of its datum `[-]`.
    pub(super) fn scatter(&self, datum: usize) -> f64 {
        self.variances.get(datum).map_or(0.0, |variance| variance.sqrt())
    }

    /// Reason for the failure of the last failing record.
    pub(super) fn last_failure(&self) -> Option<String> {
        self.failure.lock().unwrap_or_else(PoisonError::into_inner).clone()
    }

    fn file(&self, key: &str) -> PathBuf {
        self.folder.join(format!("{key}.postcard"))
    }

    /// The question of a block at physical values.
    pub(super) fn question(&self, block: usize, values: &[f64]) -> Question {
        Question { block, settings: self.plan.settings(&self.plan.blocks[block], values) }
    }

    /// Data of the fitted blocks, or of those held out.
    pub(super) fn data_of(&self, held_out: bool) -> impl Iterator<Item = &Datum> {
        self.data.iter().filter(move |datum| self.plan.blocks[datum.block].held_out == held_out)
    }

    /// Places of the fitted data of each profile or series, in the order of its abscissas.
    pub(super) fn series(&self) -> Vec<Vec<usize>> {
        let mut series: BTreeMap<(usize, String, String), Vec<(f64, usize)>> = BTreeMap::new();
        for (place, datum) in self.data_of(false).enumerate() {
            if let Some(ProfileLocation { table, y, at, .. }) = datum.target.place() {
                series.entry((datum.block, table, y)).or_default().push((at, place));
            }
        }
        let in_order = |mut points: Vec<(f64, usize)>| {
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            points.into_iter().map(|point| point.1).collect()
        };
        series.into_values().map(in_order).collect()
    }

    /// Residuals of all fitted data by values in the answers of the fitted blocks `[-]`; none where a run fails or lacks a datum's
    /// counterpart.
    pub(super) fn residuals_of(
        &self,
        fitted: &[usize],
        answers: &[Repeated],
        value: impl Fn(&Repeated, &Target) -> Option<f64>,
    ) -> Option<Vec<f64>> {
        let residual = |datum: &Datum| {
            let place = fitted.iter().position(|&block| block == datum.block)?;
            let answer = Some(&answers[place]).filter(|answer| answer.failure().is_none())?;
            Some(datum.residual(value(answer, &datum.target)?)).filter(|residual| residual.is_finite())
        };
        self.data_of(false).map(residual).collect()
    }

    /// Prediction for a datum from the answer of its block; an error where the record lacks the datum's counterpart.
    pub(super) fn predict(&self, datum: &Datum, target: &Target, answer: Option<&Repeated>) -> Result<f64, ToolError> {
        let wrong = |reason: String| self.counterpart(&self.plan.blocks[datum.block], reason);
        let answer = answer.ok_or_else(|| wrong("no record".to_owned()))?;
        if let Some(failure) = answer.failure() {
            return Err(wrong(format!("no numbers: {failure}")));
        }
        let (value, own) = answer.predicted(target).map_err(wrong)?;
        let other = || format!("`{}` in [{own}], but the data are in [{}]; convert them", target.label(), datum.unit);
        let factor = unit::factor(&own, &datum.unit).ok_or_else(|| wrong(other()))?;
        if !value.is_finite() {
            return Err(wrong(format!("{value} for `{}`", target.label())));
        }
        Ok(value * factor)
    }

    pub(super) fn counterpart(&self, block: &DataBlock, reason: String) -> ToolError {
        ToolError::at(&self.plan.file, format!("`{}`: the case gives {reason}", block.field))
    }

    /// Reads the data of the plan; synthetic ones are simulated with the parameters' truth.
    pub(super) fn read_data(&mut self) -> Result<(), ToolError> {
        let blocks = &self.plan.blocks;
        let is_made = |block: &usize| blocks[*block].data.iter().any(|text| text.noise.is_some());
        let made: Vec<usize> = (0..blocks.len()).filter(is_made).collect();
        let mut truths = BTreeMap::new();
        if !made.is_empty() {
            let values = self.plan.parameters.iter().map(|parameter| parameter.truth).collect::<Option<Vec<f64>>>();
            let values = values.ok_or_else(|| {
                let remedy = "give the `truth` of every parameter, from which data with `noise` are generated";
                FieldError::finding("parameters.truth", "missing", remedy).in_file(&self.plan.file)
            })?;
            let answers = self.ask_at(&made, &[values])?;
            truths.extend(made.into_iter().zip(answers));
        }
        let mut noise = Random::new(self.plan.budget.seed);
        for (place, block) in blocks.iter().enumerate() {
            for text in &block.data {
                self.data.extend(match text.noise.zip(truths.get(&place)) {
                    Some((share, truth)) => {
                        text.make(place, share, truth, &mut noise).map_err(|reason| self.counterpart(block, reason))?
                    }
                    None => text.read(place, &self.plan.file)?,
                });
            }
        }
        Ok(())
    }
}

impl Evaluate for Objective<'_> {
    type Error = ToolError;

    fn residuals(&mut self, points: &[Vec<f64>]) -> Result<Vec<Option<Vec<f64>>>, ToolError> {
        let fitted: Vec<usize> = (0..self.plan.blocks.len()).filter(|&k| !self.plan.blocks[k].held_out).collect();
        let values: Vec<Vec<f64>> = points.iter().map(|point| self.plan.values(point)).collect();
        let answers = self.ask_at(&fitted, &values)?;
        let mean = |own: &Repeated, target: &Target| own.predicted(target).ok().map(|(value, _)| value);
        let root = |(place, residual): (usize, f64)| self.plan.loss.root(residual * self.weight(place));
        let of_point = |answers: &[Repeated]| {
            let residuals = self.residuals_of(&fitted, answers, mean)?;
            Some(residuals.into_iter().enumerate().map(root).collect())
        };
        Ok(answers.chunks(fitted.len()).map(of_point).collect())
    }
}
