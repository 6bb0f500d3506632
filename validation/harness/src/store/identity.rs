//! Identity of the program that computed a number: the sources of these packages and, where code of another crate takes part, its file.
//!
//! The hash of the sources covers the cases and laws of these packages. It knows nothing of a case that another crate adds or
//! of a law that one registers: what a program with any of them computes is known by the program's own file as well, so
//! that a law that was edited and built again finds nothing of what the old one computed. The program `bagnold` and the tests
//! are different files and share their results, hence the file's hash is left out where the sources tell everything.

use super::hexadecimal;
use super::provenance::{is_declared, source_hash};
use bagnold_solver::material::rheology::open::registered;
use sha2::{Digest, Sha256};
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::{SystemTime, UNIX_EPOCH};

/// Origin of the code of a case: the packages of this program or another crate.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct CodeOrigin {
    is_elsewhere: bool,
}

impl CodeOrigin {
    /// Origin in a crate that the hash of the sources does not include.
    pub const ELSEWHERE: Self = Self { is_elsewhere: true };
    /// Origin in the packages whose sources the program declares.
    pub const PACKAGE: Self = Self { is_elsewhere: false };

    /// Origin of several cases together: elsewhere, if any of them is.
    pub fn and(self, other: Self) -> Self {
        if self == Self::PACKAGE { other } else { self }
    }
}

/// Identity of a program's results: SHA-256 in hexadecimal digits of everything that a result of such a case depends
/// on, besides its parameters. `None` if the program's own file would have to be read and cannot be; a warning has said
/// so.
pub fn identity(origin: CodeOrigin) -> Option<&'static str> {
    let is_told_by_sources = origin == CodeOrigin::PACKAGE && is_declared() && registered().is_empty();
    if is_told_by_sources { Some(source_hash()) } else { own_program() }
}

/// The same; for a program that cannot be read, a name that no other process has: nothing that was computed before is
/// taken for its own.
pub fn identity_or_unique(origin: CodeOrigin) -> &'static str {
    static UNIQUE: OnceLock<String> = OnceLock::new();
    identity(origin).unwrap_or_else(|| {
        UNIQUE.get_or_init(|| {
            let now = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default().as_nanos();
            let unique = format!("{} {now} {}", source_hash(), std::process::id());
            hexadecimal(&Sha256::digest(unique.as_bytes()))
        })
    })
}

/// Whether something was made by this program, with or without cases of another crate.
pub fn is_of_this_program(identity: &str) -> bool {
    [CodeOrigin::PACKAGE, CodeOrigin::ELSEWHERE].into_iter().any(|origin| identity_or_unique(origin) == identity)
}

/// The sources and the program's own file; read once.
fn own_program() -> Option<&'static str> {
    static PROGRAM: OnceLock<Option<String>> = OnceLock::new();
    let program = PROGRAM.get_or_init(|| {
        program_file()
            .and_then(|file| of_program(source_hash(), &file))
            .inspect_err(|error| {
                tracing::warn!(
                    "the program's own file cannot be read ({error}), so its laws or cases cannot be told from others: \
                     no stored result is used and none is kept"
                );
            })
            .ok()
    });
    program.as_deref()
}

/// Path of the program. On Linux the file that runs, also if another one has taken its place since.
fn program_file() -> io::Result<PathBuf> {
    let running = Path::new("/proc/self/exe");
    if cfg!(target_os = "linux") && running.exists() { Ok(running.to_owned()) } else { std::env::current_exe() }
}

/// SHA-256 of the hash of the sources and of a file.
fn of_program(sources: &str, file: &Path) -> io::Result<String> {
    let mut hash = Sha256::new();
    hash.update((sources.len() as u64).to_le_bytes());
    hash.update(sources);
    let mut file = File::open(file)?;
    let mut buffer = vec![0; 1 << 16];
    loop {
        match file.read(&mut buffer)? {
            0 => return Ok(hexadecimal(&hash.finalize())),
            count => hash.update(&buffer[..count]),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_program_is_known_by_its_sources_and_its_file() {
        let folder = tempfile::tempdir().expect("temporary folder");
        let file = folder.path().join("program");
        std::fs::write(&file, "law: n = 1").expect("writable");
        let first = of_program("a", &file).expect("readable");
        assert_eq!(of_program("a", &file).expect("readable"), first);
        assert_ne!(of_program("b", &file).expect("readable"), first);
        std::fs::write(&file, "law: n = 2").expect("writable");
        assert_ne!(of_program("a", &file).expect("readable"), first);
        assert!(of_program("a", &folder.path().join("none")).is_err());
    }

    #[test]
    fn cases_of_another_crate_are_known_by_the_program_and_this_packages_are_not() {
        let own = identity(CodeOrigin::ELSEWHERE).expect("a test can be read");
        // nothing is declared here
        assert_eq!(identity(CodeOrigin::PACKAGE), Some(own));
        assert_eq!(own, of_program(source_hash(), &std::env::current_exe().expect("known")).expect("readable"));
        assert!(is_of_this_program(own) && !is_of_this_program("another"));
        assert_eq!(CodeOrigin::PACKAGE.and(CodeOrigin::PACKAGE), CodeOrigin::PACKAGE);
        assert_eq!(CodeOrigin::PACKAGE.and(CodeOrigin::ELSEWHERE), CodeOrigin::ELSEWHERE);
        assert_eq!(CodeOrigin::ELSEWHERE.and(CodeOrigin::PACKAGE), CodeOrigin::ELSEWHERE);
    }
}
