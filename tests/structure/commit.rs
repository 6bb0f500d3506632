//! The commit that the build script finds, in repositories made for the test.

#[path = "../../validation/build/commit.rs"]
mod built;

use built::commit;
use std::path::Path;
use std::process::Command;

/// Git as somebody without a configuration has it; `None` on a machine that has no git.
pub(crate) fn git(folder: &Path, arguments: &[&str]) -> Option<String> {
    let identity = ["-c", "user.name=test", "-c", "user.email=test@example.org", "-c", "commit.gpgsign=false"];
    let output = Command::new("git").arg("-C").arg(folder).args(identity).args(arguments).output().ok()?;
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    Some(String::from_utf8_lossy(&output.stdout).trim().to_owned())
}

#[test]
fn the_commit_is_that_of_the_sources_and_says_where_they_differ() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = folder.path();
    let write = |name: &str, text: &str| std::fs::write(root.join(name), text).expect("writable");
    let sources = ["src", "Cargo.toml"];
    assert_eq!(commit(root, &sources), None, "no repository");
    if git(root, &["init", "--quiet"]).is_none() {
        // nothing to make a repository with: then no build finds a commit either
        return;
    }
    assert_eq!(commit(root, &sources), None, "a repository without a commit");
    std::fs::create_dir(root.join("src")).expect("writable");
    write("src/lib.rs", "");
    write("notes.md", "");
    git(root, &["add", "."]);
    git(root, &["commit", "--quiet", "-m", "first"]);
    let first = git(root, &["rev-parse", "HEAD"]).expect("a commit");
    assert_eq!(commit(root, &sources), Some(first.clone()));
    // what no result depends on makes no difference
    write("notes.md", "changed");
    assert_eq!(commit(root, &sources), Some(first.clone()));
    write("src/new.rs", "");
    assert_eq!(commit(root, &sources), Some(format!("{first}+changes")), "a file that git does not know");
    git(root, &["add", "."]);
    git(root, &["commit", "--quiet", "-m", "second"]);
    let second = git(root, &["rev-parse", "HEAD"]).expect("a commit");
    assert_eq!(commit(root, &sources), Some(second.clone()));
    write("src/lib.rs", "changed");
    assert_eq!(commit(root, &sources), Some(format!("{second}+changes")));
    // a package that lies somewhere within a repository is no part of it
    let inside = root.join("unpacked");
    std::fs::create_dir(&inside).expect("writable");
    assert_eq!(commit(&inside, &sources), None);
}
