//! Log lines on standard error, above the progress bar.

use super::terminal::tell_raw;
use crate::input::escaped_lines;
use std::fmt::Debug;
use std::io::{self, Write};
use tracing::Level;
use tracing::field::Field;
use tracing_subscriber::fmt::format::{Writer, debug_fn};

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
        .with_ansi(console::colors_enabled_stderr())
        .fmt_fields(debug_fn(field))
        .with_max_level(level)
        .with_target(false)
        .try_init();
    // Somebody who uses this crate as a library may have started logging before; theirs stays.
    drop(started);
}

/// A field of a log line; it may quote what stands in a file.
fn field(writer: &mut Writer<'_>, field: &Field, value: &dyn Debug) -> std::fmt::Result {
    let text = format!("{value:?}");
    let text = escaped_lines(&text);
    if field.name() == "message" { write!(writer, "{text}") } else { write!(writer, " {}={text}", field.name()) }
}

struct AboveBars;

impl Write for AboveBars {
    /// Takes everything: an unread line is not an error, and the logger would report one on standard error again.
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        tell_raw(String::from_utf8_lossy(bytes).trim_end_matches('\n'));
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
