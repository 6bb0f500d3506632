//! Defects of a study whose checks cannot fail, reported before it runs.

use super::Study;
use super::check::StudyCheck;
use crate::metric::Limit;

impl Study {
    /// Doubts of its checks and controls, a sentence each.
    pub(super) fn doubts(&self) -> Vec<String> {
        let judged: Vec<&StudyCheck> = self.checks.iter().filter(|check| check.limit.is_some()).collect();
        if judged.is_empty() {
            return vec![
                "no check has a limit, so there is no verdict; give `at_most`, `at_least` or `within`".to_owned(),
            ];
        }
        let mut doubts: Vec<String> = judged.iter().filter_map(|check| of_limit(check)).collect();
        if self.text.controls.is_empty() {
            let remedy = "add a negative control under [[controls]] that a check rejects";
            doubts.push(format!("no control shows that a check can fail; {remedy}"));
        }
        doubts
    }
}

/// Defect of the limit of a check beside its reference.
fn of_limit(check: &StudyCheck) -> Option<String> {
    let (limit, (reference, _)) = (check.limit?, check.reference()?);
    let farthest = match limit {
        Limit::AtMost(bound) | Limit::AtLeast(bound) => (bound - reference).abs(),
        Limit::Within(lower, upper) => (reference - lower).abs().max((upper - reference).abs()),
    };
    let words =
        |what: &str| format!("check `{}`: the limit {} {what}", check.name, limit.in_words(|bound| bound.to_string()));
    if !limit.holds(reference) {
        return Some(words(&format!(
            "excludes its own reference {reference}, so that a correct value fails; correct one of the two"
        )));
    }
    let is_wide = reference != 0.0 && farthest > reference.abs();
    is_wide.then(|| words(&format!("allows an error above 100 % of the reference {reference}; narrow it")))
}

#[cfg(test)]
mod tests {
    use super::super::Study;
    use std::path::Path;

    fn doubts(check: &str, rest: &str) -> Vec<String> {
        let head = "study = 'mine'\nsummary = 'one'\ncase = 'film'\n[[checks]]\nname = 'flux'\nmetric = 'flux'\n";
        Study::parse(Path::new("mine.toml"), &format!("{head}{check}\n{rest}")).expect("a study").doubts()
    }

    #[test]
    fn studies_that_cannot_fail_are_doubted() {
        let control = "[[controls]]\nname = 'thick'\nset = { viscosity = 2.0 }\nrejects = ['flux']";
        let limited = |limit: &str| format!("{limit}\nreason = 'because'\nreference = 2.0\nsource = 'a book'");
        assert_eq!(doubts(&limited("within = [1.0, 3.0]"), control), [""; 0]);
        for (check, rest, expected) in [
            (String::new(), "", "no check has a limit"),
            (limited("within = [1.0, 3.0]"), "", "no control shows"),
            (limited("at_most = 1.5"), control, "excludes its own reference 2"),
            (limited("within = [-1e9, 1e9]"), control, "above 100 % of the reference"),
            (limited("at_most = 4.5"), control, "above 100 % of the reference"),
        ] {
            let told = doubts(&check, rest);
            assert!(told.len() == 1 && told[0].contains(expected), "{told:?}");
        }
    }
}
