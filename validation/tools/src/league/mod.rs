//! The league: stored results of many codes under the gates of our cases, on one page.
//!
//! A league is a folder with a submission for each code and case, `CODE/CASE/submission.toml`. Codes of one law tell how far apart
//! methods are; that is what "the same to another method" is worth.

mod archive;
mod page;
pub mod studies;
mod widths;

pub use page::{ORDER_HEADINGS, orders, write};
pub use widths::{HEADINGS as WIDTH_HEADINGS, widths};

use crate::ToolError;
use crate::case::{PreparedCase, Registry};
use crate::judge::{CaseSubmissions, CodeComparison, JudgedCode, LawOrigin, MetricComparison, Submission};
use crate::metric::{Metric, MetricKind, Variant};
use crate::output::FileError;
use crate::report::Tally;
use crate::statistics::grouped;
use std::path::{Path, PathBuf};

/// Name of a submission's file.
const SUBMISSION: &str = "submission.toml";
/// Folder of submissions that gates must reject.
pub const WRONG: &str = "wrong";
/// Fewest codes of one law whose scatter is told.
const FEWEST: usize = 3;

/// A quantity of a case with what every code gives of it.
#[derive(Debug, Clone)]
pub struct LeagueRow {
    /// The case.
    pub case: String,
    /// Our metric, with our value.
    pub own: Metric,
    /// The codes' values by their place in the league, with the law of their runs.
    pub values: Vec<(usize, LawOrigin, Metric)>,
}

/// All submissions, judged.
#[derive(Debug, Clone, Default)]
pub struct League {
    /// Names of the codes with their versions.
    pub codes: Vec<String>,
    /// The cases.
    pub cases: Vec<String>,
    /// The quantities in the order of the cases.
    pub rows: Vec<LeagueRow>,
    /// Verdicts on the submissions, of a code (first) and a case (second).
    pub judged: Vec<(usize, usize, JudgedCode)>,
}

/// The submissions of a league, in the order of their paths.
///
/// # Errors
/// A folder that cannot be read or holds no submission.
pub fn submissions(folder: &Path) -> Result<Vec<PathBuf>, ToolError> {
    let unreadable = |error: std::io::Error| FileError::unreadable(folder, &error);
    let folders = |of: &Path| -> std::io::Result<Vec<PathBuf>> {
        let entries = std::fs::read_dir(of)?.map(|entry| entry.map(|entry| entry.path()));
        Ok(entries.collect::<std::io::Result<Vec<_>>>()?.into_iter().filter(|path| path.is_dir()).collect())
    };
    let mut files = Vec::new();
    for code in folders(folder).map_err(unreadable)? {
        if code.file_name().is_some_and(|name| name == WRONG) {
            continue;
        }
        let cases = folders(&code).map_err(unreadable)?;
        files.extend(cases.into_iter().map(|case| case.join(SUBMISSION)).filter(|file| file.is_file()));
    }
    files.sort();
    if files.is_empty() {
        let reason = "holds no CODE/CASE/submission.toml; print one to fill with `bagnold judge --template CASE`";
        return Err(ToolError::at(folder, reason.to_owned()));
    }
    Ok(files)
}

/// Groups submissions of the same runs of ours, so that each is simulated once.
///
/// # Errors
/// Submissions that [`CaseSubmissions::read`] refuses.
pub fn read(files: &[PathBuf], registry: Registry) -> Result<Vec<CaseSubmissions>, ToolError> {
    let key = |file: &PathBuf| -> Result<_, ToolError> {
        let Submission { case, tier, with, .. } = Submission::read(file)?;
        Ok(((case, tier, with), file.clone()))
    };
    let groups = grouped(files.iter().map(key).collect::<Result<Vec<_>, _>>()?);
    groups.iter().map(|(_, files)| CaseSubmissions::read(files, registry)).collect()
}

/// The runs of ours, and what the codes give, apart.
pub type Groups = (Vec<Box<dyn PreparedCase>>, Vec<Vec<crate::judge::CodeResults>>);

/// Splits groups into what is simulated and what is judged.
pub fn split(groups: Vec<CaseSubmissions>) -> Groups {
    groups.into_iter().map(|group| (group.prepared, group.entries)).unzip()
}

/// Puts judged groups side by side.
pub fn league(groups: &[CodeComparison]) -> League {
    let mut league = League::default();
    // rows of the case's own parameters come first, and name the others'
    let has_parameters = |group: &&CodeComparison| group.codes.iter().any(|code| !code.submission.with.is_empty());
    let (with, without): (Vec<_>, Vec<_>) = groups.iter().partition(has_parameters);
    for group in without.into_iter().chain(with) {
        let case = place(&mut league.cases, &group.own.name);
        for judged in &group.codes {
            let own = &judged.submission.code;
            let name = format!("{} {}", own.name, own.version);
            let code = place(&mut league.codes, name.trim_end());
            for one in &judged.metrics {
                enter(&mut league.rows, &group.own.name, code, &judged.submission, one);
            }
            league.judged.push((code, case, judged.clone()));
        }
    }
    league
}

fn place(names: &mut Vec<String>, name: &str) -> usize {
    names.iter().position(|own| own == name).unwrap_or_else(|| {
        names.push(name.to_owned());
        names.len() - 1
    })
}

/// Enters a value. A run of ours with parameters of a submission has a row of its own.
fn enter(rows: &mut Vec<LeagueRow>, case: &str, code: usize, submission: &Submission, one: &MetricComparison) {
    let Some(foreign) = one.foreign.clone() else { return };
    let entry = (code, submission.law, foreign);
    let mut own = one.own.clone();
    let named = |row: &LeagueRow, own: &Metric| {
        row.case == case && (&row.own.name, &row.own.variant) == (&own.name, &own.variant)
    };
    let same = |row: &LeagueRow, own: &Metric| named(row, own) && row.own.value.to_bits() == own.value.to_bits();
    if rows.iter().any(|row| named(row, &own) && !same(row, &own)) {
        own.variant = own.variant.and("parameters", submission.code.name.as_str());
    }
    match rows.iter_mut().find(|row| same(row, &own)) {
        Some(row) => row.values.push(entry),
        None => rows.push(LeagueRow { case: case.to_owned(), own, values: vec![entry] }),
    }
}

impl League {
    /// Gates of a code and a case; none without a submission.
    pub fn tally(&self, code: usize, case: usize) -> Option<Tally> {
        let own = self.judged.iter().filter(|(own, of, _)| (*own, *of) == (code, case));
        own.map(|(_, _, judged)| judged.tally()).reduce(|sum, more| Tally([sum.0, more.0].concat()))
    }
}

impl LeagueRow {
    /// Whether it is about physics: it has a limit, a reference or values of several codes, and is no balance of a single run.
    pub fn is_told(&self) -> bool {
        let has_reference = self.own.gate.is_some() || self.own.reference.is_some() || self.values.len() > 1;
        has_reference && self.own.kind != MetricKind::Bookkeeping
    }

    /// Mean of the codes of our law and ours, and their standard deviation; none for fewer than three.
    pub fn of_one_law(&self) -> Option<(f64, f64)> {
        scatter(self.of(LawOrigin::Same).chain([self.own.value]), FEWEST)
    }

    /// Mean of the codes of grains, and their standard deviation; none for fewer than two.
    pub fn of_grains(&self) -> Option<(f64, f64)> {
        scatter(self.of(LawOrigin::Grains), 2)
    }

    fn of(&self, law: LawOrigin) -> impl Iterator<Item = f64> {
        self.values.iter().filter(move |(_, own, _)| *own == law).map(|(_, _, metric)| metric.value)
    }

    /// Name of our run without its numerics.
    pub fn variant(&self) -> Variant {
        physics(&self.own.variant)
    }
}

/// Mean and standard deviation of the finite of some values; none for fewer than `fewest`.
pub(crate) fn scatter(values: impl Iterator<Item = f64>, fewest: usize) -> Option<(f64, f64)> {
    let values: Vec<f64> = values.filter(|value| value.is_finite()).collect();
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    let square = values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / (count - 1.0);
    (values.len() >= fewest).then_some((mean, square.sqrt()))
}

/// A run's name without its numerics.
fn physics(variant: &Variant) -> Variant {
    let parts = variant.parts().filter(|(key, _)| !crate::judge::NUMERICS.contains(key));
    parts.fold(Variant::default(), |variant, (key, value)| variant.and(key, value.clone()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::judge::ObservedOrder;
    use crate::metric::Limit;

    fn row(values: &[(LawOrigin, f64)]) -> LeagueRow {
        let metric = |value| Metric::observed("run_out", &Variant::of("a", 1).and("resolution", 20), value, "-");
        let values = values.iter().enumerate().map(|(code, (law, value))| (code, *law, metric(*value)));
        LeagueRow { case: "column".to_owned(), own: metric(2.0), values: values.collect() }
    }

    #[test]
    fn scatter_is_that_of_codes_of_one_law() {
        let (mean, deviation) = row(&[(LawOrigin::Same, 3.0), (LawOrigin::Same, 4.0), (LawOrigin::Grains, 9.0)])
            .of_one_law()
            .expect("three");
        assert_eq!((mean, deviation), (3.0, 1.0));
        assert_eq!(row(&[(LawOrigin::Same, 3.0), (LawOrigin::Grains, 9.0)]).of_one_law(), None);
        assert_eq!(row(&[]).variant(), Variant::of("a", 1));
        assert_eq!(
            row(&[(LawOrigin::Grains, 9.0), (LawOrigin::Grains, 11.0)]).of_grains(),
            Some((10.0, 2.0f64.sqrt()))
        );
    }

    #[test]
    fn a_limit_that_is_narrow_or_wide_beside_the_scatter_shows_its_reason() {
        // a standard deviation of 1
        let mut row = row(&[(LawOrigin::Same, 3.0), (LawOrigin::Same, 4.0)]);
        let mut reason = |limit| {
            row.own = row.own.clone().gated(limit, "two rows of 20");
            widths(&League { rows: vec![row.clone()], ..League::default() })[0][4..].join(" ")
        };
        assert_eq!(reason(Limit::Within(1.5, 4.5)), "1.5 1 1.5 ");
        assert_eq!(reason(Limit::Within(2.5, 3.5)), "0.5 1 0.5 narrow: two rows of 20");
        assert_eq!(reason(Limit::AtMost(5.5)), "2.5 1 2.5 wide: two rows of 20");
    }

    #[test]
    fn the_observed_order_is_that_of_the_errors_and_none_where_they_change_their_sign() {
        let fine = Metric::observed("velocity_l2", &Variant::default(), 0.5, "%");
        let order = |coarse| ObservedOrder { fine: fine.clone(), coarse, ratio: 2.0 }.order();
        assert_eq!((order(2.0), order(-2.0)), (Some(2.0), None));
    }
}
