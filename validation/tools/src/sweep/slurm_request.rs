//! Request to a Slurm cluster, with the values that may stand in a job script.
//!
//! A script is text that a shell and Slurm read line by line: a line break or a quote in a value would become a line of
//! its own. So every value has the form that Slurm's manual gives it, and nothing else.

use crate::input::FieldError;
use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};

/// Resources and options of a Slurm job.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SlurmRequest {
    /// Partition; `None` for the cluster's default.
    pub partition: Option<String>,
    /// Time limit of a task as Slurm reads it, such as `01:30:00`.
    pub time: Option<String>,
    /// Memory of a task, such as `2G`.
    pub memory: Option<String>,
    /// Cores of a task.
    pub cpus: u16,
    /// Tasks that may run at the same time; `None` for no limit.
    pub throttle: Option<u32>,
    /// A template of one's own.
    pub template: Option<PathBuf>,
    /// Store of finished runs that the tasks use; `None` for the program's usual one.
    pub store: Option<PathBuf>,
}

impl SlurmRequest {
    /// Whether each value has Slurm's form, for a sweep in `folder`.
    ///
    /// # Errors
    /// The first option that has not.
    pub fn check(&self, folder: &Path) -> Result<(), FieldError> {
        let texts = [
            ("--partition", &self.partition, is_partition as fn(&str) -> bool, PARTITION),
            ("--time", &self.time, is_time, TIME),
            ("--memory", &self.memory, is_memory, MEMORY),
        ];
        for (option, value, holds, (rule, remedy)) in texts {
            if let Some(value) = value.as_ref().filter(|value| !holds(value)) {
                return Err(FieldError::new(option, format!("{value:?}"), rule, remedy));
            }
        }
        let store = self.store.as_deref().map(|store| ("--store", store));
        for (option, path) in [("--out", folder)].into_iter().chain(store) {
            if !path.to_str().is_some_and(is_path) {
                let rule = "a path without line breaks, control characters, quotes, backslashes, `$` and backticks";
                return Err(FieldError::new(
                    option,
                    format!("{path:?}"),
                    rule,
                    "it stands in the job script: rename it",
                ));
            }
        }
        Ok(())
    }
}

const PARTITION: (&str, &str) =
    ("one or more names of letters, digits, `_`, `-` and `.`, separated by commas", "`sinfo` lists the partitions");

const TIME: (&str, &str) =
    ("minutes, MM:SS, HH:MM:SS, D-HH, D-HH:MM, D-HH:MM:SS or UNLIMITED", "give it as Slurm reads it, such as 01:30:00");

const MEMORY: (&str, &str) = ("a whole number with K, M, G or T behind it, or none", "such as 2G");

fn is_partition(text: &str) -> bool {
    let is_name = |name: &str| {
        name.starts_with(|first: char| first.is_ascii_alphanumeric() || first == '_')
            && name.chars().all(|letter| letter.is_ascii_alphanumeric() || "_-.".contains(letter))
    };
    text.len() <= 1024 && text.split(',').all(is_name)
}

fn is_time(text: &str) -> bool {
    let is_number = |part: &str| (1..=9).contains(&part.len()) && part.bytes().all(|byte| byte.is_ascii_digit());
    let parts_of = |text: &str, most: usize| {
        let parts: Vec<&str> = text.split(':').collect();
        parts.len() <= most && parts.into_iter().all(is_number)
    };
    match text.split_once('-') {
        Some((days, rest)) => is_number(days) && parts_of(rest, 3),
        None => parts_of(text, 3) || ["UNLIMITED", "INFINITE"].contains(&text.to_ascii_uppercase().as_str()),
    }
}

fn is_memory(text: &str) -> bool {
    let digits = text.strip_suffix(['K', 'M', 'G', 'T', 'k', 'm', 'g', 't']).unwrap_or(text);
    (1..=12).contains(&digits.len()) && digits.bytes().all(|byte| byte.is_ascii_digit())
}

fn is_path(text: &str) -> bool {
    !text.is_empty() && !text.chars().any(|letter| letter.is_control() || "\"\\$`".contains(letter))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(request: &SlurmRequest, folder: &str) -> Option<String> {
        request.check(Path::new(folder)).err().map(|error| error.to_string())
    }

    #[test]
    fn valid_slurm_requests_pass() {
        let texts = |values: &[&str], holds: fn(&str) -> bool| {
            for value in values {
                assert!(holds(value), "{value}");
            }
        };
        texts(&["short", "gpu-a100,long_2", "a.b"], is_partition);
        texts(&["90", "90:30", "01:30:00", "2-12", "2-12:30", "2-12:30:15", "unlimited"], is_time);
        texts(&["2G", "500", "16000M"], is_memory);
        assert_eq!(refusal(&SlurmRequest::default(), "/shared/Lauf 1, it's 50 %/ä"), None);
    }

    #[test]
    fn a_value_that_would_become_a_line_is_refused() {
        let injected = "short\n#SBATCH --wrap=evil";
        for text in [injected, "a b", "-a", "", "a;b", "$(id)", "a\"b"] {
            assert!(!is_partition(text) && !is_time(text) && !is_memory(text), "{text:?}");
        }
        for text in ["1:2:3:4", "1-", "-1", "1-2-3", "1e3", "12h", ":"] {
            assert!(!is_time(text), "{text}");
        }
        for text in ["G", "1GB", "1.5G", "-1"] {
            assert!(!is_memory(text), "{text}");
        }
        let request = SlurmRequest { partition: Some(injected.to_owned()), ..SlurmRequest::default() };
        assert_eq!(
            refusal(&request, "/shared").expect("refused"),
            "`--partition` is \"short\\n#SBATCH --wrap=evil\", but must be one or more names of letters, digits, `_`, `-` \
             and `.`, separated by commas; `sinfo` lists the partitions"
        );
        for folder in ["/shared/a\nrm -rf x", "/shared/a\"b", "/shared/`id`", "/shared/$HOME", "/shared/a\\"] {
            assert!(
                refusal(&SlurmRequest::default(), folder).expect("refused").starts_with("`--out` is "),
                "{folder:?}"
            );
        }
        let store = SlurmRequest { store: Some("/a\nb".into()), ..SlurmRequest::default() };
        assert!(refusal(&store, "/shared").expect("refused").starts_with("`--store` is "));
    }
}
