//! What this program was built from.

use std::path::{Path, PathBuf};

/// Version of the package.
#[must_use]
pub fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}

/// SHA-256 of everything that a result depends on: sources, locked dependencies, profile, instruction set.
#[must_use]
pub fn source_hash() -> &'static str {
    env!("BAGNOLD_SOURCE_HASH")
}

/// Cargo's profile and the optimisation level.
#[must_use]
pub fn profile() -> &'static str {
    env!("BAGNOLD_PROFILE")
}

/// Instruction set extensions that the compiler could count on.
#[must_use]
pub fn target_features() -> &'static str {
    env!("BAGNOLD_TARGET_FEATURES")
}

/// The workspace that this program was built in, if the current folder lies in it. Elsewhere an installed program must
/// neither read nor write a checkout that happens to be there still.
#[must_use]
pub fn workspace() -> Option<&'static Path> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent()?;
    is_worked_in(root, &std::env::current_dir().ok()?).then_some(root)
}

/// Whether a folder is a workspace and holds the current one, which has no links in its path.
fn is_worked_in(root: &Path, current: &Path) -> bool {
    root.join("Cargo.lock").is_file() && root.canonicalize().is_ok_and(|root| current.starts_with(root))
}

/// Commit checked out in the workspace that one works in, or `unknown`. Read when asked for, since a build script that
/// watched it would rebuild the crate on every commit.
#[must_use]
pub fn commit() -> String {
    workspace().and_then(|root| head(&git_folder(root)?)).unwrap_or_else(|| "unknown".to_owned())
}

/// `.git` itself, or where it points to in a linked worktree.
fn git_folder(root: &Path) -> Option<PathBuf> {
    let git = root.join(".git");
    if git.is_dir() {
        return Some(git);
    }
    let text = std::fs::read_to_string(git).ok()?;
    Some(root.join(text.strip_prefix("gitdir:")?.trim()))
}

fn head(git: &Path) -> Option<String> {
    let text = std::fs::read_to_string(git.join("HEAD")).ok()?;
    let Some(reference) = text.trim().strip_prefix("ref: ") else {
        return commit_id(&text);
    };
    // A linked worktree has its own HEAD, but shares the branches.
    let shared = std::fs::read_to_string(git.join("commondir"))
        .map_or_else(|_| git.to_path_buf(), |folder| git.join(folder.trim()));
    let loose = [git, &shared].iter().find_map(|folder| std::fs::read_to_string(folder.join(reference)).ok());
    if let Some(text) = loose {
        return commit_id(&text);
    }
    let packed = std::fs::read_to_string(shared.join("packed-refs")).ok()?;
    packed.lines().find_map(|line| commit_id(line.strip_suffix(reference)?))
}

fn commit_id(text: &str) -> Option<String> {
    let id = text.trim();
    (id.len() >= 40 && id.bytes().all(|byte| byte.is_ascii_hexdigit())).then(|| id.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    const ID: &str = "0123456789abcdef0123456789abcdef01234567";

    #[test]
    fn a_workspace_counts_where_one_works_in_it() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let root = folder.path().canonicalize().expect("there");
        assert!(!is_worked_in(&root, &root), "no workspace");
        std::fs::write(root.join("Cargo.lock"), "").expect("writable");
        assert!(is_worked_in(&root, &root) && is_worked_in(&root, &root.join("tests")));
        assert!(!is_worked_in(&root, root.parent().expect("a temporary folder lies somewhere")));
        assert!(workspace().is_some(), "tests are run in the workspace");
    }

    #[test]
    fn the_commit_is_found_loose_packed_detached_or_not_at_all() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let git = folder.path();
        let write = |name: &str, text: &str| std::fs::write(git.join(name), text).expect("writable");
        assert_eq!(head(git), None);
        write("HEAD", "ref: refs/heads/main\n");
        assert_eq!(head(git), None);
        write("packed-refs", &format!("# pack-refs\n{ID} refs/heads/main\n"));
        assert_eq!(head(git).as_deref(), Some(ID));
        let newer = ID.replace('0', "f");
        std::fs::create_dir_all(git.join("refs/heads")).expect("writable");
        write("refs/heads/main", &format!("{newer}\n"));
        assert_eq!(head(git), Some(newer));
        write("HEAD", &format!("{ID}\n"));
        assert_eq!(head(git).as_deref(), Some(ID));
    }
}
