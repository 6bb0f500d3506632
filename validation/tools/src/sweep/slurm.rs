//! The engine `slurm`: the manifest as job arrays, one task per entry. Slurm schedules; the shared folder tells what is
//! done.

use super::error::SweepError;
use super::folder::SweepFolder;
pub use super::slurm_request::SlurmRequest;
use crate::input::{WRITTEN_BY_HAND, read_text};
use crate::output::{FileError, write_whole};
use serde::{Deserialize, Serialize};
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The template that ships with the program.
pub const TEMPLATE: &str = include_str!("template/array.sh");

/// Tasks of one array: Slurm's default largest index is 1000.
const ARRAY_LENGTH: usize = 1000;

/// One submitted array.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct SlurmArray {
    /// Slurm's number.
    id: String,
    /// Number to add to a task's index, which gives the number of its entry.
    offset: usize,
}

/// Submits arrays for entries by number and returns Slurm's job numbers.
///
/// # Errors
/// Requests that [`check`] rejects, no Slurm on this machine, a submission that is rejected, a template that cannot be read or
/// filled, files that cannot be written.
pub fn submit(sweep: &SweepFolder, numbers: &[usize], request: &SlurmRequest) -> Result<Vec<String>, SweepError> {
    check(sweep.path(), request)?;
    let template = template_of(request)?;
    let folder = sweep.path().canonicalize().map_err(|error| FileError::unreadable(sweep.path(), &error))?;
    let scripts = folder.join("slurm");
    let logs = scripts.join("logs");
    let unwritable = |error: std::io::Error| FileError::unwritable(&scripts, &error);
    std::fs::create_dir_all(&logs).map_err(unwritable)?;
    write_json(&scripts.join("request.json"), request)?;
    let mut jobs = read_jobs(&scripts)?;
    let mut submitted = Vec::new();
    let blocks: BTreeSet<usize> = numbers.iter().map(|number| (number - 1) / ARRAY_LENGTH).collect();
    for block in blocks {
        let offset = block * ARRAY_LENGTH;
        let tasks: Vec<usize> = numbers
            .iter()
            .filter(|&&number| (number - 1) / ARRAY_LENGTH == block)
            .map(|number| number - offset)
            .collect();
        let text = fill(&template, &folder, &logs, offset, &tasks, request)?;
        let script = scripts.join(format!("job-{}.sh", jobs.len() + 1));
        write_whole(&script, text.as_bytes()).map_err(unwritable)?;
        let shown = script.display().to_string();
        let printed = call("sbatch", &["--parsable", &shown])?;
        let id = printed.trim().split(';').next().unwrap_or_default().to_owned();
        jobs.push(SlurmArray { id: id.clone(), offset });
        write_json(&scripts.join("jobs.json"), &jobs)?;
        submitted.push(id);
    }
    Ok(submitted)
}

/// Whether a job script can be written for a sweep in `folder` that holds what was asked for and nothing else.
///
/// # Errors
/// A value that Slurm does not take, a folder whose name cannot stand in a script, a template that cannot be read or filled.
pub fn check(folder: &Path, request: &SlurmRequest) -> Result<(), SweepError> {
    let folder = std::path::absolute(folder).map_err(|error| FileError::unreadable(folder, &error))?;
    request.check(&folder)?;
    fill(&template_of(request)?, &folder, &folder.join("slurm").join("logs"), 0, &[1], request)?;
    Ok(())
}

fn template_of(request: &SlurmRequest) -> Result<String, FileError> {
    match &request.template {
        Some(file) => read_text(file, WRITTEN_BY_HAND).map_err(|error| FileError::unreadable(file, &error)),
        None => Ok(TEMPLATE.to_owned()),
    }
}

/// Numbers of the entries that wait or run in Slurm's queue.
///
/// # Errors
/// No Slurm on this machine, or a queue that does not answer.
pub fn queued(sweep: &SweepFolder) -> Result<BTreeSet<usize>, SweepError> {
    let jobs = read_jobs(&sweep.path().join("slurm"))?;
    let mut numbers = BTreeSet::new();
    if jobs.is_empty() {
        return Ok(numbers);
    }
    // all jobs of the user: squeue refuses to list a number that it has forgotten
    let printed = call("squeue", &["--noheader", "--array", "--me", "--format=%F %K"])?;
    for line in printed.lines() {
        let mut words = line.split_whitespace();
        let (Some(id), Some(task)) = (words.next(), words.next()) else { continue };
        let job = jobs.iter().find(|job| job.id == id);
        if let (Some(job), Ok(task)) = (job, task.parse::<usize>()) {
            numbers.insert(task + job.offset);
        }
    }
    Ok(numbers)
}

/// Request of the last submission, for a submission without options of its own.
///
/// # Errors
/// A damaged file.
pub fn last_request(sweep: &SweepFolder) -> Result<SlurmRequest, FileError> {
    read_json(&sweep.path().join("slurm").join("request.json"))
}

/// Whether Slurm is on this machine.
///
/// # Errors
/// A machine without it.
pub fn available() -> Result<(), SweepError> {
    call("sbatch", &["--version"]).map(|_| ())
}

fn read_jobs(scripts: &Path) -> Result<Vec<SlurmArray>, FileError> {
    read_json(&scripts.join("jobs.json"))
}

/// Contents of a JSON file; the default without a file.
fn read_json<T: Default + serde::de::DeserializeOwned>(file: &Path) -> Result<T, FileError> {
    let text = match read_text(file, WRITTEN_BY_HAND) {
        Ok(text) => text,
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(T::default()),
        Err(error) => return Err(FileError::unreadable(file, &error)),
    };
    serde_json::from_str(&text).map_err(|error| FileError::Damaged {
        file: file.to_owned(),
        reason: error.to_string(),
        remedy: "remove it when `squeue` shows no job of this sweep".to_owned(),
    })
}

fn write_json(file: &Path, value: &impl Serialize) -> Result<(), FileError> {
    let unwritable = |error: std::io::Error| FileError::unwritable(file, &error);
    let text = serde_json::to_string_pretty(value).map_err(|error| unwritable(error.into()))?;
    write_whole(file, text.as_bytes()).map_err(unwritable)
}

fn fill(
    template: &str,
    folder: &Path,
    logs: &Path,
    offset: usize,
    tasks: &[usize],
    request: &SlurmRequest,
) -> Result<String, FileError> {
    let program = std::env::current_exe().map_err(|error| FileError::unreadable(Path::new("bagnold"), &error))?;
    let mut command = quoted(&program);
    if let Some(store) = &request.store {
        command = format!("env BAGNOLD_STORE={} {command}", quoted(store));
    }
    let throttle = request.throttle.map_or_else(String::new, |most| format!("%{most}"));
    let mut environment = minijinja::Environment::new();
    // a word that is misspelt must not become an empty one
    environment.set_undefined_behavior(minijinja::UndefinedBehavior::Strict);
    let text = |value: &Option<String>| value.clone().unwrap_or_default();
    let name = folder.file_name().map_or_else(|| "bagnold".to_owned(), |name| name.to_string_lossy().into_owned());
    let values = minijinja::Value::from_pairs([
        ("name", name),
        ("array", format!("{}{throttle}", ranges(tasks))),
        ("cpus", request.cpus.to_string()),
        // in the name of an output file `%` begins a pattern of Slurm's
        ("logs", logs.display().to_string().replace('%', "%%")),
        ("partition", text(&request.partition)),
        ("time", text(&request.time)),
        ("memory", text(&request.memory)),
        ("program", command),
        ("folder", quoted(folder)),
        ("offset", offset.to_string()),
    ]);
    environment.render_str(template, values).map_err(|error| {
        let file = request.template.clone().unwrap_or_else(|| PathBuf::from("array.sh"));
        FileError::Damaged {
            file,
            reason: error.to_string(),
            remedy: "`bagnold sweep template` prints the one that ships with bagnold".to_owned(),
        }
    })
}

/// A path as one word of a shell.
fn quoted(path: &Path) -> String {
    format!("'{}'", path.display().to_string().replace('\'', r"'\''"))
}

/// Rising numbers as Slurm writes them: `1-3,7`.
fn ranges(numbers: &[usize]) -> String {
    let mut parts: Vec<(usize, usize)> = Vec::new();
    for number in numbers.iter().copied().collect::<BTreeSet<_>>() {
        match parts.last_mut() {
            Some((_, last)) if *last + 1 == number => *last = number,
            _ => parts.push((number, number)),
        }
    }
    let shown = |&(first, last): &(usize, usize)| {
        if first == last { first.to_string() } else { format!("{first}-{last}") }
    };
    parts.iter().map(shown).collect::<Vec<_>>().join(",")
}

/// Runs one of Slurm's commands and returns what it prints.
fn call(command: &str, arguments: &[&str]) -> Result<String, SweepError> {
    let refused = |reason: String, remedy: &str| SweepError::Slurm {
        command: command.to_owned(),
        reason,
        remedy: remedy.to_owned(),
    };
    let output = Command::new(command).args(arguments).output().map_err(|error| {
        if error.kind() == std::io::ErrorKind::NotFound {
            let remedy = "log in to the cluster, or use --engine local";
            return refused("is not on this machine".to_owned(), remedy);
        }
        refused(format!("cannot be started ({error})"), "check the installation of Slurm")
    })?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).into_owned());
    }
    let message = String::from_utf8_lossy(&output.stderr).trim().replace('\n', "; ");
    Err(refused(format!("failed: {message}"), "check partition, time and memory, and `sinfo`"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_become_ranges() {
        assert_eq!(ranges(&[1, 2, 3, 7, 9, 8]), "1-3,7-9");
        assert_eq!(ranges(&[5]), "5");
    }

    #[test]
    fn a_path_is_one_word() {
        assert_eq!(quoted(Path::new("/a b/it's")), r"'/a b/it'\''s'");
    }

    #[test]
    fn the_template_asks_only_for_what_was_asked() {
        let request = SlurmRequest {
            partition: Some("long".to_owned()),
            memory: Some("2G".to_owned()),
            cpus: 4,
            throttle: Some(8),
            ..SlurmRequest::default()
        };
        let (folder, logs) = (Path::new("/shared/my sweep"), Path::new("/shared/my sweep/slurm/logs"));
        let text = fill(TEMPLATE, folder, logs, 1000, &[1, 2, 5], &request).expect("a good template");
        for line in [
            "#SBATCH --job-name=\"my sweep\"",
            "#SBATCH --array=1-2,5%8",
            "#SBATCH --cpus-per-task=4",
            "#SBATCH --partition=long",
            "#SBATCH --mem=2G",
        ] {
            assert!(text.lines().any(|other| other == line), "{line} in\n{text}");
        }
        assert!(!text.contains("--time="), "{text}");
        assert!(
            text.contains("sweep task '/shared/my sweep' --entry $((SLURM_ARRAY_TASK_ID + 1000)) --threads 4"),
            "{text}"
        );
        let broken = fill("{{ array", folder, logs, 0, &[1], &request).map_err(|error| error.to_string());
        assert!(broken.is_err_and(|message| message.contains("bagnold sweep template")));
        let misspelt = fill("#SBATCH --time={{ tiem }}", folder, logs, 0, &[1], &request);
        let message = misspelt.expect_err("an unknown word").to_string();
        assert!(message.contains("undefined value") && message.contains("bagnold sweep template"), "{message}");
        let percent = fill(TEMPLATE, folder, Path::new("/shared/50%"), 0, &[1], &request).expect("a good template");
        assert!(percent.contains("--output=\"/shared/50%%/%A_%a.log\""), "{percent}");
    }
}
