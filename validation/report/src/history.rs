//! `history.csv`: every gated figure whenever the baseline is taken anew, so that a trend over many commits shows.

use super::accepted::MetricKey;
use super::error::{BaselineError, read_if_there};
use crate::case::Tier;
use crate::input::DOCUMENT;
use crate::metric::{Metric, Variant, Verdict};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;

/// One figure at one time. The commit that carries the row dates it.
#[derive(Debug, Serialize)]
struct HistoryRow<'a> {
    version: &'a str,
    /// Commit that was checked out when the figure was made; the change that moved it comes on top.
    base_commit: &'a str,
    tier: Tier,
    case: &'a str,
    metric: &'a str,
    variant: &'a Variant,
    value: f64,
    unit: &'a str,
    verdict: Verdict,
}

/// Appends the gated metrics of `case` to the history at `path`, which is made with its header if it is missing.
///
/// # Errors
/// If the file cannot be written.
pub fn append(
    path: &Path,
    (version, base_commit): (&str, &str),
    tier: Tier,
    case: &str,
    metrics: &[Metric],
) -> Result<(), BaselineError> {
    let write_error = |source| BaselineError::Write { path: path.to_owned(), source };
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(write_error)?;
    }
    let is_new = !path.exists();
    let file = std::fs::OpenOptions::new().create(true).append(true).open(path).map_err(write_error)?;
    let mut writer = csv::WriterBuilder::new().has_headers(is_new).from_writer(file);
    for metric in metrics.iter().filter(|metric| metric.verdict() != Verdict::Observed) {
        let row = HistoryRow {
            version,
            base_commit,
            tier,
            case,
            metric: &metric.name,
            variant: &metric.variant,
            value: metric.value,
            unit: &metric.unit,
            verdict: metric.verdict(),
        };
        writer.serialize(row).map_err(|error| write_error(error.into()))?;
    }
    writer.flush().map_err(write_error)
}

/// The values that a figure had, oldest first, of one tier.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct History {
    values: BTreeMap<MetricKey, Vec<f64>>,
    /// Commits at which the values were taken, as places in `commits`.
    times: BTreeMap<MetricKey, Vec<usize>>,
    /// The commits at which values were taken, oldest first.
    commits: Vec<String>,
}

/// Columns of a row that are read.
#[derive(Debug, Deserialize)]
struct ReadRow {
    base_commit: String,
    tier: Tier,
    case: String,
    metric: String,
    variant: String,
    value: f64,
}

impl History {
    /// Reads the figures of a tier from the history at `path`; a missing file is an empty history. Rows whose variant was
    /// written by other rules than today's are of figures that are gone.
    ///
    /// # Errors
    /// If the file is there but cannot be read or is malformed.
    pub fn read(path: &Path, tier: Tier) -> Result<Self, BaselineError> {
        let Some(text) = read_if_there(path, DOCUMENT)? else { return Ok(Self::default()) };
        let mut read = Self::default();
        for row in csv::Reader::from_reader(text.as_bytes()).deserialize() {
            let row: ReadRow = row.map_err(|error: csv::Error| BaselineError::Content {
                path: path.to_owned(),
                message: error.to_string(),
            })?;
            let Ok(variant) = row.variant.parse() else { continue };
            if row.tier == tier {
                let key = MetricKey { case: row.case, metric: row.metric, variant };
                if !read.commits.contains(&row.base_commit) {
                    read.commits.push(row.base_commit.clone());
                }
                let time = read.commits.iter().position(|commit| *commit == row.base_commit).unwrap_or_default();
                read.times.entry(key.clone()).or_default().push(time);
                read.values.entry(key).or_default().push(row.value);
            }
        }
        Ok(read)
    }

    /// The commits at which values were taken, oldest first.
    #[must_use]
    pub fn commits(&self) -> &[String] {
        &self.commits
    }

    /// A figure over the places of [`History::commits`], oldest first.
    #[must_use]
    pub fn series(&self, key: &MetricKey) -> Vec<(usize, f64)> {
        let times = self.times.get(key).map_or(&[][..], Vec::as_slice);
        times.iter().copied().zip(self.of(key).iter().copied()).collect()
    }

    /// The values of a figure, oldest first.
    #[must_use]
    pub fn of(&self, key: &MetricKey) -> &[f64] {
        self.values.get(key).map_or(&[], Vec::as_slice)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::metric::Limit;

    #[test]
    fn gated_figures_are_appended_below_one_header() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("history.csv");
        let variant = Variant::of("slope_angle", 24);
        let metrics = [
            Metric::observed("velocity_l2", &variant, 0.4, "%").gated(Limit::Within(-1.5, 1.5), "a reason"),
            Metric::observed("velocity_l2_measured_height", &variant, 0.4, "%"),
        ];
        for commit in ["aaa", "bbb"] {
            append(&path, ("0.1.0", commit), Tier::Quick, "bagnold", &metrics).expect("a writable folder");
        }
        let text = std::fs::read_to_string(&path).expect("the history");
        let expected = "version,base_commit,tier,case,metric,variant,value,unit,verdict\n\
                        0.1.0,aaa,quick,bagnold,velocity_l2,slope_angle=24,0.4,%,pass\n\
                        0.1.0,bbb,quick,bagnold,velocity_l2,slope_angle=24,0.4,%,pass\n";
        assert_eq!(text, expected);
        let read = History::read(&path, Tier::Quick).expect("readable");
        assert_eq!(read.of(&MetricKey::of("bagnold", &metrics[0])), [0.4, 0.4]);
        assert_eq!(read.commits(), ["aaa", "bbb"]);
        assert_eq!(read.series(&MetricKey::of("bagnold", &metrics[0])), [(0, 0.4), (1, 0.4)]);
        assert_eq!(read.of(&MetricKey::of("bagnold", &metrics[1])), [0.0; 0]);
        assert_eq!(History::read(&path, Tier::Paper).expect("readable"), History::default());
        assert_eq!(History::read(&folder.path().join("none.csv"), Tier::Quick).expect("empty"), History::default());
        std::fs::write(&path, text.replace("0.4", "much")).expect("a writable folder");
        assert!(History::read(&path, Tier::Quick).is_err_and(|error| error.to_string().contains("history.csv")));
    }
}
