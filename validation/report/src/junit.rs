//! Verdicts as JUnit's XML, which CI systems show as tests: one per gate, and one for every run that should not have diverged.

use super::judgement::{JudgedCase, JudgedMetric, Judgement, Severity};
use super::put_junit;
use super::rows::{self, statement};
use super::view::typed;
use crate::input::FieldError;
use quick_junit::{NonSuccessKind, Property, TestCase, TestCaseStatus, TestSuite};
use std::fs::File;
use std::io::Read;
use std::path::Path;
use std::time::Duration;

/// Rejects an existing file that is not JUnit XML, such as the input of the command.
///
/// # Errors
/// That file.
pub fn check_junit(path: &Path) -> Result<(), FieldError> {
    let mut head = Vec::new();
    let read =
        if path.is_file() { File::open(path).and_then(|file| file.take(512).read_to_end(&mut head)) } else { Ok(0) };
    if read.is_ok() && (head.is_empty() || String::from_utf8_lossy(&head).contains("<testsuites")) {
        return Ok(());
    }
    let remedy = "name another file: this one would be overwritten";
    Err(FieldError::new("--junit", path.display(), "a new file, or an earlier JUnit XML file", remedy))
}

/// Writes the error of a command that gives no verdicts.
///
/// # Errors
/// A file that cannot be written.
pub fn put_refusal(path: &Path, message: &str) -> Result<(), FieldError> {
    let mut status = TestCaseStatus::non_success(NonSuccessKind::Error);
    status.set_type("refusal").set_message(message);
    let mut suite = TestSuite::new("bagnold");
    suite.add_test_case(TestCase::new("command", status));
    let mut document = quick_junit::Report::new("bagnold");
    document.add_test_suite(suite);
    put_junit(path, &document.to_string().expect("text that the crate itself has cleaned always serialises"))
}

/// A report as text. An expected failure is skipped, with the reason of its entry, and an inconclusive gate with its doubt; a gate that disagrees with the list of
/// expected failures fails, as it fails the report.
pub(super) fn text(judgement: &Judgement<'_>) -> String {
    let mut document = quick_junit::Report::new(judgement.report.title.as_str());
    for case in &judgement.cases {
        let mut suite = TestSuite::new(case.case.name.as_str());
        let seconds: f64 = case.case.runs.iter().map(|run| run.wall_seconds).sum();
        suite.set_time(Duration::try_from_secs_f64(seconds).unwrap_or_default());
        suite.add_property(Property::new("tier", judgement.report.tier.name()));
        suite.add_property(Property::new("command", typed(&case.case.command)));
        suite.add_property(Property::new("tally", case.tally().in_words()));
        suite.add_test_cases(cases(case));
        document.add_test_suite(suite);
    }
    document.to_string().expect("text that the crate itself has cleaned always serialises")
}

fn cases(case: &JudgedCase<'_>) -> Vec<TestCase> {
    let named = |name: &str, variant: String, status| {
        let name = if variant.is_empty() { name.to_owned() } else { format!("{name} [{variant}]") };
        let mut test = TestCase::new(name, status);
        test.set_classname(format!("bagnold.{}", case.case.name));
        test
    };
    let diverged = case.diverged.iter().map(|(variant, message)| {
        let mut status = TestCaseStatus::non_success(NonSuccessKind::Error);
        status.set_type("divergence").set_message(*message);
        named("run", variant.to_string(), status)
    });
    let gates = case.metrics.iter().filter_map(|judged| {
        let mut test = named(&judged.metric.name, judged.metric.variant.to_string(), status(judged)?);
        // what it is, for those who never look at the page
        test.set_system_out(reason(judged));
        Some(test)
    });
    let gone = case.case.not_judged.iter().map(|(key, reason)| {
        let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
        status.set_type(Severity::NotJudged.word()).set_message(reason.as_str());
        named(&key.metric, key.variant.to_string(), status)
    });
    diverged.chain(gates).chain(gone).collect()
}

/// Test status of a gate; none for a metric that is only observed.
fn status(judged: &JudgedMetric<'_>) -> Option<TestCaseStatus> {
    let severity = judged.severity?;
    let mut status = match severity {
        Severity::Pass => return Some(TestCaseStatus::success()),
        Severity::ExpectedFailure | Severity::Inconclusive => TestCaseStatus::skipped(),
        Severity::NewFailure | Severity::NotJudged | Severity::UnexpectedPass => {
            TestCaseStatus::non_success(NonSuccessKind::Failure)
        }
    };
    let note = judged.doubt.map_or_else(|| judged.note(), |doubt| doubt.words().to_owned());
    let message = [statement(judged), note].join(". ");
    status.set_type(severity.word()).set_message(message.trim_end_matches(". "));
    if severity.is_error() {
        status.set_description(reason(judged));
    }
    Some(status)
}

/// Value and limit, why the limit stands where it does, and what the value is compared with.
fn reason(judged: &JudgedMetric<'_>) -> String {
    let doubt = judged.doubt.map_or_else(String::new, |doubt| format!("; inconclusive: {}", doubt.words()));
    let why = rows::reason(judged.metric).map(|why| format!("; {why}")).unwrap_or_default();
    let source = judged.metric.reference.as_ref().map(|reference| format!("; reference: {}", reference.source));
    format!("{}{why}{}{doubt}", statement(judged), source.unwrap_or_default())
}

#[cfg(test)]
mod tests {
    use super::super::tests::{case, gated, known, report};
    use super::super::{Report, judge};
    use super::text;

    fn xml(report: &Report) -> String {
        text(&judge(report))
    }

    #[test]
    fn gates_become_tests_and_observed_values_do_not() {
        let observed = crate::metric::Metric { gate: None, ..gated("height", 1.0) };
        let xml = xml(&report(vec![case("film", vec![gated("velocity_l2", 0.5), gated("wall_slip", 0.9), observed])]));
        assert!(
            xml.contains("<testsuites name=\"Report\" tests=\"2\" skipped=\"0\" failures=\"1\" errors=\"0\""),
            "{xml}"
        );
        assert!(xml.contains("name=\"wall_slip [resolution=40]\" classname=\"bagnold.film\""), "{xml}");
        assert!(xml.contains("<failure message=\"0.9\u{202f}%, limit ≤ 0.7\u{202f}%\" type=\"new failure\">"), "{xml}");
        assert!(xml.contains("prototype reached 0.56 %; reference: Eq. (36)"), "{xml}");
        assert!(!xml.contains("height"));
    }

    #[test]
    fn an_expected_failure_is_skipped_with_its_reason_and_one_that_passes_again_fails() {
        let mut report = report(vec![case("film", vec![gated("velocity_l2", 0.9)])]);
        report.expected_failures = known("film", "velocity_l2", 0.9);
        let listed = xml(&report);
        assert!(listed.contains("failures=\"0\"") && listed.contains("<skipped message=\"0.9\u{202f}%"), "{listed}");
        assert!(listed.contains("two attempts"), "{listed}");
        report.cases[0].result.metrics = vec![gated("velocity_l2", 0.5)];
        let passes = xml(&report);
        assert!(passes.contains("failures=\"1\"") && passes.contains("remove the entry"), "{passes}");
    }

    #[test]
    fn an_inconclusive_gate_is_skipped_with_its_doubt() {
        let doubtful = gated("velocity_l2", 0.5).known_to(crate::metric::Origin::Numerical, Some(3.0), "spacing");
        let xml = xml(&report(vec![case("film", vec![doubtful])]));
        assert!(xml.contains("skipped=\"1\"") && xml.contains("type=\"inconclusive\""), "{xml}");
    }

    #[test]
    fn invalid_xml_characters_are_removed() {
        let xml = xml(&report(vec![case("film", vec![gated("a<b&\u{1}\"", 0.9)])]));
        assert!(xml.contains("a&lt;b&amp;&quot;") && !xml.contains('\u{1}'), "{xml}");
    }
}
