//! The copy of the program, run again for each trial: an error may stop the program that has it.

use crate::error::DevError;
use crate::interruption;
use crate::mutation::{CHOICE, MutantRun, Mutation, MutationOutcome, Scope, TestProgram, judge};
use crate::output::FileError;
use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// End of the line of a test that failed.
const FAILED: &str = " ... FAILED";

/// The name of no error: a case as it is.
pub(super) const NONE: &str = "none";

/// The copy, asked to run a case with the mutation of a number, or to trace one into a file.
pub(super) fn trial(program: &Path, choice: &str, scope: &Scope, threads: Option<u16>) -> Command {
    let mut command = Command::new(program);
    command.env(CHOICE, choice).args(["--quiet", "mutate", "trial", NONE, &scope.case]);
    for setting in &scope.settings {
        command.args(["--set", setting]);
    }
    if let Some(threads) = threads {
        command.arg("--threads").arg(threads.to_string());
    }
    command
}

/// Runs a command to its end, or until enough is known, a time limit or a signal; returns what it said first on standard error, too.
fn ended(command: &mut Command, limit: Duration, is_enough: impl Fn() -> bool) -> Result<(ExitStatus, String), String> {
    let started = Instant::now();
    let mut child = command.stdin(Stdio::null()).stderr(Stdio::piped()).spawn().map_err(|error| error.to_string())?;
    let status = loop {
        match child.try_wait().map_err(|error| error.to_string())? {
            Some(status) => break status,
            None if is_enough() => {
                // It may have ended just now.
                let _ = child.kill();
                break child.wait().map_err(|error| error.to_string())?;
            }
            None if started.elapsed() > limit || interruption::asked().is_some() => {
                // It may have ended just now.
                let _ = child.kill();
                let _ = child.wait();
                return Err(format!(
                    "stopped after {:.0} s, ten times as long as without the error",
                    limit.as_secs_f64()
                ));
            }
            None => std::thread::sleep(Duration::from_millis(50)),
        }
    };
    let said = child.wait_with_output().map(|output| String::from_utf8_lossy(&output.stderr).into_owned());
    // a panic begins with an empty line
    let said = said.unwrap_or_default().lines().find(|line| !line.trim().is_empty()).map(str::to_owned);
    Ok((status, said.unwrap_or_else(|| "the program ended without a word".to_owned())))
}

/// A copy, and where its trials leave what they found.
pub(crate) struct Program {
    path: PathBuf,
    folder: PathBuf,
}

impl Program {
    pub(crate) fn new(path: PathBuf, staging: &Path) -> Result<Self, DevError> {
        let folder = staging.join("trials");
        std::fs::create_dir_all(&folder).map_err(|error| FileError::unwritable(&folder, &error))?;
        Ok(Self { path, folder })
    }

    /// A file of the trials.
    pub(super) fn file(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Runs an error through cases, each with what it says without, until a gate or a stop has caught it. A case may take ten times as long as
    /// without and so many seconds more.
    pub(super) fn try_error(
        &self,
        error: &Mutation,
        number: usize,
        cases: &[(&Scope, &MutantRun)],
        seconds: f64,
    ) -> MutationOutcome {
        let mut comparisons = Vec::new();
        for (scope, right) in cases {
            let limit = Duration::from_secs_f64(10.0 * right.wall_seconds + seconds);
            comparisons.push((*scope, *right, self.run(&number.to_string(), scope, limit)));
            if judge(error, &comparisons).catch.is_certain() {
                break;
            }
        }
        judge(error, &comparisons)
    }

    /// Runs a trial on the current pool's number of threads.
    ///
    /// # Errors
    /// Reason for a missing result: the program stopped, or was stopped.
    pub(crate) fn run(&self, choice: &str, scope: &Scope, limit: Duration) -> Result<MutantRun, String> {
        let name = Path::new(choice).file_name().unwrap_or_default().to_string_lossy().into_owned();
        let file = self.file(&format!("{name}-{}-result", scope.case));
        let threads = u16::try_from(rayon::current_num_threads()).ok();
        let mut command = trial(&self.path, choice, scope, threads);
        let (_, said) = ended(command.arg("--result").arg(&file).stdout(Stdio::null()), limit, || false)?;
        MutantRun::read(&file).ok_or(said)
    }

    /// Runs the tests of physics of a program, or those of one name, with the mutation of a number on the current pool's number of threads, until one
    /// fails.
    ///
    /// # Errors
    /// Name of the first failing test, or reason for the stop of the program.
    pub(super) fn test(
        &self,
        test: &TestProgram,
        only: Option<&str>,
        number: usize,
        limit: Duration,
    ) -> Result<(), String> {
        let name = format!("{number}-{}-{}", test.target.name, only.unwrap_or("all"));
        let (printed, threads) = (self.file(&name), rayon::current_num_threads().to_string());
        let file = File::create(&printed).map_err(|error| error.to_string())?;
        let mut command = Command::new(&test.path);
        command.current_dir(&test.folder).env(CHOICE, number.to_string()).stdout(file);
        command.args(only.as_slice()).args(if only.is_none() { test.target.physics() } else { &[] });
        command.env("RUST_TEST_THREADS", &threads).env("RAYON_NUM_THREADS", &threads);
        // results of this mutation are no other's
        command.env("BAGNOLD_STORE", self.file(&format!("{name}-store")));
        let text =
            || std::fs::read(&printed).map(|text| String::from_utf8_lossy(&text).into_owned()).unwrap_or_default();
        let has_failed = || text().lines().any(|line| line.starts_with("test ") && line.ends_with(FAILED));
        let (status, said) =
            ended(&mut command, limit, has_failed).map_err(|reason| format!("{}: {reason}", test.target.name))?;
        let text = text();
        let results = text.lines().filter_map(|line| line.strip_prefix("test ")?.split_once(" ... "));
        // the program takes the name as a part of others
        let mut results = results.filter(|(name, _)| only.is_none_or(|own| name.rsplit("::").next() == Some(own)));
        if status.success() {
            return results.next().map(drop).ok_or_else(|| format!("{}: no test of this name", test.target.name));
        }
        let failed = results.find(|(_, result)| *result == FAILED.trim_start_matches(" ... "));
        Err(format!("{}: {}", test.target.name, failed.map_or(&*said, |(name, _)| name)))
    }
}

impl Drop for Program {
    fn drop(&mut self) {
        // What stays behind stands in the staging folder, which goes as well.
        let _ = std::fs::remove_dir_all(&self.folder);
    }
}
