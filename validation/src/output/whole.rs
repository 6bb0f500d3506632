//! Files that appear whole or not at all.

use std::io;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

/// Writes a file so that a reader sees all of it or nothing, also when several processes write it or one is killed.
///
/// # Errors
/// A file that cannot be written.
pub fn write_whole(path: &Path, contents: &[u8]) -> io::Result<()> {
    static COUNT: AtomicU64 = AtomicU64::new(0);
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let unique = format!("{}-{}.partial", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed));
    let partial = path.with_extension(unique);
    std::fs::write(&partial, contents).and_then(|()| std::fs::rename(&partial, path)).inspect_err(|_| {
        // Best effort: the error that counts is the one already at hand.
        let _ = std::fs::remove_file(&partial);
    })
}
