//! The engine `slurm`: the manifest as job arrays, one task per entry. Slurm checks what is asked for and schedules; the shared
//! folder tells what is done.

use super::folder::SweepFolder;
use crate::ToolError;
use crate::input::{WRITTEN_BY_HAND, read_text};
use crate::output::{FileError, read_if_there, write_whole};
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Script of a task that ships with the program.
pub const TEMPLATE: &str = include_str!("template/array.sh");

/// Tasks of one array: Slurm's default largest index is 1000.
const ARRAY_LENGTH: usize = 1000;

/// Request to Slurm. The folder of a sweep keeps it, so that a later submission needs no options.
#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct SlurmRequest {
    /// Options of `sbatch` by name, such as `time`.
    pub options: BTreeMap<String, String>,
    /// Tasks that may run at the same time; `None` for no limit.
    pub throttle: Option<u32>,
    /// Store of finished runs that the tasks use; `None` for the program's usual one.
    pub store: Option<PathBuf>,
    /// A script of one's own; the folder of a sweep keeps its text.
    #[serde(skip)]
    pub template: Option<PathBuf>,
    /// Numbers of the submitted arrays, each with the number to add to a task's index, which gives that of its entry.
    pub arrays: BTreeMap<String, usize>,
}

impl SlurmRequest {
    /// The command that submits a script with these options.
    fn sbatch(&self) -> Command {
        let mut command = Command::new("sbatch");
        command.args(self.options.iter().map(|(name, value)| format!("--{name}={value}")));
        command
    }

    /// Whether Slurm accepts the request.
    ///
    /// # Errors
    /// No Slurm on this machine; options or a script that it rejects.
    pub fn test(&self) -> Result<(), ToolError> {
        let mut command = self.sbatch();
        command.arg("--test-only");
        match &self.template {
            Some(script) => command.arg(script),
            None => command.arg("--wrap=true"),
        };
        printed(&mut command).map(|_| ())
    }
}

/// Submits the entries of a sweep that are neither done nor queued, and returns the number of each array with its length.
/// What is not requested is as in the last submission.
///
/// # Errors
/// No Slurm on this machine, a request that it rejects, files that cannot be read or written.
pub fn submit(sweep: &SweepFolder, request: &SlurmRequest) -> Result<Vec<(String, usize)>, ToolError> {
    let folder = sweep.path().canonicalize().map_err(|error| FileError::unreadable(sweep.path(), &error))?;
    let mut all = last_request(sweep)?;
    let queued = queued(&all.arrays)?;
    let missing: BTreeSet<usize> = sweep.missing().iter().map(|entry| entry.number).collect();
    let numbers: Vec<usize> = missing.difference(&queued).copied().collect();
    all.options.extend(request.options.clone());
    all.throttle = request.throttle.or(all.throttle);
    all.store = request.store.clone().or(all.store);

    let [logs, script, kept] = ["slurm/logs", "slurm/job.sh", "slurm/request.json"].map(|name| folder.join(name));
    let unwritable = |error: std::io::Error| FileError::unwritable(&folder, &error);
    std::fs::create_dir_all(&logs).map_err(unwritable)?;
    if let Some(file) = &request.template {
        let text = read_text(file, WRITTEN_BY_HAND).map_err(|error| FileError::unreadable(file, &error))?;
        write_whole(&script, text.as_bytes()).map_err(unwritable)?;
    } else if !script.exists() {
        write_whole(&script, TEMPLATE.as_bytes()).map_err(unwritable)?;
    }
    let program = std::env::current_exe().map_err(|error| FileError::unreadable(Path::new("bagnold"), &error))?;
    let throttle = all.throttle.map_or_else(String::new, |most| format!("%{most}"));
    // in the name of an output file `%` begins a pattern of Slurm's
    let logs = logs.display().to_string().replace('%', "%%");
    let mut submitted = Vec::new();
    let block = |number: usize| (number - 1) / ARRAY_LENGTH;
    for numbers in numbers.chunk_by(|a, b| block(*a) == block(*b)) {
        let offset = block(numbers[0]) * ARRAY_LENGTH;
        let tasks: Vec<String> = numbers.iter().map(|number| (number - offset).to_string()).collect();
        let mut command = all.sbatch();
        command.arg("--parsable").arg(format!("--array={}{throttle}", tasks.join(",")));
        command.arg(format!("--output={logs}/%A_%a.log")).arg(&script);
        command.arg(offset.to_string()).arg(&program).args(["--quiet", "sweep", "task"]).arg(&folder);
        if let Some(store) = &all.store {
            command.arg("--store").arg(store);
        }
        let printed = printed(&mut command)?;
        let id = printed.trim().split(';').next().unwrap_or_default().to_owned();
        all.arrays.insert(id.clone(), offset);
        let text = serde_json::to_string_pretty(&all).map_err(|error| unwritable(error.into()))?;
        write_whole(&kept, text.as_bytes()).map_err(unwritable)?;
        submitted.push((id, numbers.len()));
    }
    Ok(submitted)
}

/// Numbers of the entries that wait or run in Slurm's queue.
fn queued(arrays: &BTreeMap<String, usize>) -> Result<BTreeSet<usize>, ToolError> {
    if arrays.is_empty() {
        return Ok(BTreeSet::new());
    }
    // all jobs of the user: squeue refuses to list a number that it has forgotten
    let printed = printed(Command::new("squeue").args(["--noheader", "--array", "--me", "--format=%F %K"]))?;
    let number = |line: &str| {
        let (id, task) = line.trim().split_once(' ')?;
        Some(arrays.get(id)? + task.trim().parse::<usize>().ok()?)
    };
    Ok(printed.lines().filter_map(number).collect())
}

/// Slurm options of the last submission of a sweep.
///
/// # Errors
/// A file that is damaged or cannot be read.
pub fn last_request(sweep: &SweepFolder) -> Result<SlurmRequest, FileError> {
    let file = sweep.path().join("slurm/request.json");
    let Some(text) = read_if_there(&file, WRITTEN_BY_HAND)? else { return Ok(SlurmRequest::default()) };
    let remedy = "remove it when `squeue` shows no job of this sweep";
    serde_json::from_str(&text).map_err(|error| FileError::damaged(&file, error, remedy))
}

/// Runs one of Slurm's commands and returns what it prints.
fn printed(command: &mut Command) -> Result<String, ToolError> {
    let (reason, remedy) = match command.output() {
        Ok(output) if output.status.success() => return Ok(String::from_utf8_lossy(&output.stdout).into_owned()),
        Ok(output) => {
            let message = String::from_utf8_lossy(&output.stderr).trim().replace('\n', "; ");
            (format!("failed: {message}"), "check partition, time and memory, and `sinfo`")
        }
        Err(error) if error.kind() == ErrorKind::NotFound => {
            ("is not installed on this machine".to_owned(), "log in to the cluster, or use --engine local")
        }
        Err(error) => (format!("cannot be started ({error})"), "check the installation of Slurm"),
    };
    let program = command.get_program().display();
    Err(ToolError::at(Path::new("slurm"), format!("`{program}` {reason}; {remedy}")))
}
