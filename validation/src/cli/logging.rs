//! Log lines on standard error, above the progress bar.

use indicatif::MultiProgress;
use std::io::{self, Write};
use std::sync::LazyLock;
use tracing::Level;

/// All progress bars of the program; a log line moves them out of its way.
pub(super) static BARS: LazyLock<MultiProgress> = LazyLock::new(MultiProgress::new);

/// Starts logging: warnings, with `verbose` also information and details, with `quiet` errors only.
pub(super) fn start(verbose: u8, quiet: bool) {
    let level = match (quiet, verbose) {
        (true, _) => Level::ERROR,
        (false, 0) => Level::WARN,
        (false, 1) => Level::INFO,
        (false, _) => Level::DEBUG,
    };
    let started = tracing_subscriber::fmt()
        .with_writer(|| AboveBars)
        .with_ansi(io::IsTerminal::is_terminal(&io::stderr()))
        .with_max_level(level)
        .with_target(false)
        .try_init();
    // Somebody who uses this crate as a library may have started logging before; theirs stays.
    drop(started);
}

struct AboveBars;

impl Write for AboveBars {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        BARS.suspend(|| io::stderr().write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        io::stderr().flush()
    }
}
