//! The baseline and expected failures that the program carries, for where no checkout is.

use std::path::Path;

include!(concat!(env!("OUT_DIR"), "/baseline.rs"));

/// The text of a file by its path in the folder of the baseline, such as `quick/film.snap`.
pub(super) fn text(path: &Path) -> Option<&'static str> {
    FILES.iter().find(|(own, _)| Path::new(own) == path).map(|(_, text)| *text)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Tier;
    use crate::{Baseline, ExpectedFailures};

    #[test]
    fn every_file_of_the_baseline_is_read() {
        for (name, _) in FILES {
            let Some((tier, file)) = name.split_once('/') else { continue };
            let tier = [Tier::Quick, Tier::Paper, Tier::Fine]
                .into_iter()
                .find(|own| own.name() == tier)
                .unwrap_or_else(|| panic!("{name}"));
            let case = file.strip_suffix(".snap").unwrap_or_else(|| panic!("{name}"));
            let read = Baseline::shipped(case, tier).unwrap_or_else(|error| panic!("failed to {error}"));
            assert!(!read.is_empty(), "{name}");
        }
        let list = ExpectedFailures::shipped().unwrap_or_else(|error| panic!("failed to {error}"));
        assert!(!list.failures.is_empty());
        assert_eq!(text(Path::new("quick/no-such-case.snap")), None);
    }
}
