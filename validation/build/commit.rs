//! The commit that a program is built from.
//!
//! It is asked for when the build script runs anyway, because a file that results depend on has changed. A script that watched
//! the repository would build the package again after every commit, although not a byte of it has changed.

use std::path::Path;
use std::process::Command;

/// Ends a commit whose files are not those that were built.
const CHANGED: &str = "+changes";

/// The commit that is checked out in a workspace, with `+changes` after it if any of the `sources`, relative to the workspace,
/// differs from it or is not in it. `None` without a repository of its own, or without git.
pub(crate) fn commit(workspace: &Path, sources: &[&str]) -> Option<String> {
    if !workspace.join(".git").exists() {
        return None;
    }
    let head = git(workspace, &["rev-parse", "--verify", "HEAD"])?;
    let changes = git(workspace, &[&["status", "--porcelain", "--untracked-files=all", "--"], sources].concat())?;
    Some(if changes.is_empty() { head } else { head + CHANGED })
}

/// Output of git.
fn git(workspace: &Path, arguments: &[&str]) -> Option<String> {
    let mut command = Command::new("git");
    // a build that another repository's hook started must not look there
    for variable in ["GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE", "GIT_COMMON_DIR", "GIT_PREFIX"] {
        command.env_remove(variable);
    }
    // a checkout may belong to somebody else than who builds it, and nothing is written to it
    command.args(["--no-optional-locks", "-c", "safe.directory=*", "-C"]).arg(workspace).args(arguments);
    let output = command.output().ok().filter(|output| output.status.success())?;
    Some(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}
