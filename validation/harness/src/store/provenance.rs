//! Build of the program. Its own package declares it at the start, because only that package is built after everything that a
//! result depends on.

use bagnold_solver::lanes::InstructionSet;
use std::path::Path;
use std::sync::OnceLock;

/// Sources and build of a program.
#[derive(Debug, Clone, Copy, Default)]
pub struct Build {
    /// SHA-256 of everything that a result depends on: sources, locked dependencies, compiler, profile, instruction set.
    pub source_hash: &'static str,
    /// SHA-256 of the solver's sources alone.
    pub solver_hash: &'static str,
    /// Cases with SHA-256 of what their simulations depend on; so with laws, by their quoted names, and with what draws.
    pub simulation_hashes: &'static [(&'static str, &'static str)],
    /// Commit, with `+changes` after it if the sources differ from it; `unknown` without a repository.
    pub commit: &'static str,
    /// Cargo's profile.
    pub profile: &'static str,
    /// Optimisation level of the solver.
    pub solver_opt_level: &'static str,
    /// Instruction set extensions that the compiler could count on.
    pub target_features: &'static str,
}

static BUILD: OnceLock<Build> = OnceLock::new();

/// Declares what the program is built from. The first declaration counts.
pub fn declare(build: Build) {
    let _: &Build = BUILD.get_or_init(|| build);
}

/// The declared build. The results of a program that declares nothing are known by its own file.
fn build() -> Build {
    let undeclared = || Build { commit: "unknown", profile: "unknown", ..Build::default() };
    BUILD.get().copied().unwrap_or_else(undeclared)
}

/// Whether the program has declared what it is built from.
pub(super) fn is_declared() -> bool {
    BUILD.get().is_some()
}

/// Version of the package.
pub fn version() -> &'static str {
    env!("CARGO_PKG_VERSION")
}

/// SHA-256 of what a run of a case depends on: the sources of the case, its model and all that is common, and those of each law
/// that its description names, `"law":"mu-i"`; but neither what judges and draws nor other cases and laws.
pub(super) fn simulation_hash(case: &str, description: &str) -> String {
    let hashes = build().simulation_hashes.iter();
    let is_used = |name: &str| name == case || name.starts_with('"') && description.contains(name);
    if !hashes.clone().any(|(name, _)| *name == case) {
        return source_hash().to_owned();
    }
    hashes.filter(|(name, _)| is_used(name)).map(|(_, hash)| *hash).collect()
}

/// SHA-256 of everything that a result depends on; empty where nothing was declared. Laws and cases of another crate are no part
/// of it; see [`identity`](super::identity).
pub fn source_hash() -> &'static str {
    build().source_hash
}

/// SHA-256 of the solver's sources; empty where nothing was declared.
pub fn solver_hash() -> &'static str {
    build().solver_hash
}

/// Cargo profile, with the optimisation level of the solver; other packages may be optimised less.
pub fn profile() -> String {
    let Build { profile, solver_opt_level, .. } = build();
    format!("{profile}, solver at opt-level {solver_opt_level}")
}

/// Warning about a program whose solver is not optimised; none for any other.
pub fn unoptimised() -> Option<&'static str> {
    (build().solver_opt_level == "0").then_some(
        "the solver of this program is not optimised (opt-level 0) and takes many times longer, to the same bits; set \
         `opt-level = 3` for the package `bagnold-solver` in the profile that it is built with",
    )
}

/// The instruction set that the loops over particles run with on this processor, chosen as the program runs.
#[must_use]
pub fn instruction_set() -> &'static str {
    InstructionSet::best().name()
}

/// Instruction set extensions that the compiler could count on everywhere else.
pub fn target_features() -> &'static str {
    build().target_features
}

/// The workspace that this program was built in, if the current folder lies in it. Elsewhere an installed program must
/// neither read nor write a checkout that happens to be there still.
pub fn workspace() -> Option<&'static Path> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2)?;
    is_worked_in(root, &std::env::current_dir().ok()?).then_some(root)
}

/// Whether a folder is a workspace and holds the current one, which has no links in its path.
fn is_worked_in(root: &Path, current: &Path) -> bool {
    root.join("Cargo.lock").is_file() && root.canonicalize().is_ok_and(|root| current.starts_with(root))
}

/// Commit that this program was built from, with `+changes` after it if what it was built from differs from that commit;
/// `unknown` for a program built from no repository. That of the build, whichever folder one works in: what is committed
/// later without a change of the sources makes no other program.
pub fn commit() -> &'static str {
    build().commit
}

/// The first digits of a commit, as many as a page needs, with what stands after it.
pub fn short_commit(commit: &str) -> String {
    let (id, rest) = commit.split_once('+').map_or((commit, String::new()), |(id, rest)| (id, format!("+{rest}")));
    id.chars().take(12).collect::<String>() + &rest
}

#[cfg(test)]
mod tests {
    use super::*;

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
    fn a_commit_is_shortened_and_its_mark_is_kept() {
        let id = "0123456789abcdef0123456789abcdef01234567";
        assert_eq!(short_commit(id), "0123456789ab");
        assert_eq!(short_commit(&format!("{id}+changes")), "0123456789ab+changes");
        assert_eq!(short_commit("unknown"), "unknown");
    }
}
