//! Messages of the program on standard output and standard error.
//!
//! Standard error is a courtesy: a reader who has gone, a full disk or a terminal that was closed change nothing. Standard
//! output is a result: one that cannot be written is an error of the command, unless its reader has had enough (`| head`).

use super::error::ProgramError;
use crate::input::escaped_lines;
use crate::report::{Severity, Terminal};
use console::{Style, Term};
use indicatif::{MultiProgress, ProgressDrawTarget};
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::sync::LazyLock;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Whether standard error is a terminal that understands escape codes.
pub(super) fn moves_its_cursor() -> bool {
    io::stderr().is_terminal() && std::env::var_os("TERM").is_none_or(|name| name != "dumb")
}

/// Width of standard output, and whether `-v` was given.
pub(super) fn shape() -> Terminal {
    let width = Term::stdout().size_checked().map_or(usize::MAX, |(_, columns)| columns.into());
    Terminal { width, is_verbose: tracing::enabled!(tracing::Level::INFO) }
}

/// Words at the beginning of lines on what changes the exit code.
const ERRORS: [&str; 4] = ["NEW FAILURE", "NOT JUDGED", "EXPECTED FAILURE", "DIVERGED"];

/// Lines in the colours of their verdicts.
fn coloured(text: &str) -> String {
    let colour = |line: &str| match line {
        _ if line.contains(" gates: ") || line.starts_with("1 gate: ") => {
            let worse = [Severity::NotJudged, Severity::UnexpectedPass];
            let is_sound = line.contains(" 0 new failures") && !worse.iter().any(|own| line.contains(own.word()));
            Some(if is_sound { Style::new().green() } else { Style::new().red() })
        }
        _ if ERRORS.iter().any(|word| line.starts_with(word)) => Some(Style::new().red()),
        _ if line.starts_with(Severity::ExpectedFailure.word()) => Some(Style::new().yellow()),
        _ if line.starts_with(Severity::Inconclusive.word()) => Some(Style::new().dim()),
        _ if line.starts_with("moved") => Some(Style::new().magenta()),
        _ => None,
    };
    let styled = |line: &str| colour(line).map_or_else(|| line.to_owned(), |style| style.apply_to(line).to_string());
    text.split('\n').map(styled).collect::<Vec<_>>().join("\n")
}

/// All progress bars of the program; whatever else is said appears above them.
pub(super) static BARS: LazyLock<MultiProgress> =
    LazyLock::new(|| MultiProgress::with_draw_target(ProgressDrawTarget::stderr()));

/// Number of bars that are shown.
pub(super) static SHOWN: AtomicUsize = AtomicUsize::new(0);

/// Prints one or more lines on standard error, and escapes control characters.
pub fn tell(text: &str) {
    tell_raw(&escaped_lines(text));
}

/// Writes lines to standard error unchanged, where it is open.
pub(super) fn tell_raw(lines: &str) {
    // there is nowhere left to report that this fails
    let _: io::Result<()> = if SHOWN.load(Ordering::SeqCst) > 0 {
        BARS.println(lines)
    } else {
        io::stderr().write_all(format!("{lines}\n").as_bytes())
    };
}

/// Standard output that remembers what it could not write, so that the work is finished before the command fails.
pub(super) struct StandardOutput<'a> {
    to: &'a mut (dyn Write + Send),
    failure: Option<io::Error>,
}

impl<'a> StandardOutput<'a> {
    pub(super) fn new(to: &'a mut (dyn Write + Send)) -> Self {
        Self { to, failure: None }
    }

    /// Whether everything was written, or its reader closed the stream before the end.
    pub(super) fn finish(self) -> Result<(), ProgramError> {
        match self.failure {
            Some(error) if error.kind() != ErrorKind::BrokenPipe => Err(ProgramError::unprintable(&error)),
            _ => Ok(()),
        }
    }

    fn noted<T>(&mut self, result: io::Result<T>) -> io::Result<T> {
        result.inspect_err(|error| {
            let again = || error.raw_os_error().map_or_else(|| error.kind().into(), io::Error::from_raw_os_error);
            // an interrupted call is made again by whoever made it
            if error.kind() != ErrorKind::Interrupted {
                self.failure.get_or_insert_with(again);
            }
        })
    }
}

impl Write for StandardOutput<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.to.write(bytes);
        self.noted(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        let flushed = self.to.flush();
        self.noted(flushed)
    }
}

/// Prints a text with control characters escaped.
pub(super) fn say(output: &mut (dyn Write + Send), text: &str) {
    let text = escaped_lines(text);
    print(output, &if console::colors_enabled() { coloured(&text).into() } else { text });
}

/// Prints a document that a program reads, as it stands.
pub(super) fn print(output: &mut (dyn Write + Send), text: &str) {
    if let Err(error) = output.write_all(text.as_bytes()).and_then(|()| output.flush()) {
        // [`StandardOutput`] remembers it for the end of the command
        tracing::debug!("standard output: {error}");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Refuses every write.
    struct Refusing(ErrorKind);

    impl Write for Refusing {
        fn write(&mut self, _: &[u8]) -> io::Result<usize> {
            Err(self.0.into())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    /// Two lines on an output that refuses them with an error of this kind.
    fn finished(kind: ErrorKind) -> Result<(), ProgramError> {
        let mut refusing = Refusing(kind);
        let mut output = StandardOutput::new(&mut refusing);
        say(&mut output, "a");
        say(&mut output, "b");
        output.finish()
    }

    #[test]
    fn closed_pipe_is_not_an_error() {
        assert!(finished(ErrorKind::BrokenPipe).is_ok());
    }

    #[test]
    fn full_device_is_an_error() {
        let message = finished(ErrorKind::StorageFull).expect_err("full").to_string();
        assert!(message.starts_with("standard output: cannot be written (no storage space); "), "{message}");
    }

    #[test]
    fn lines_are_escaped_and_documents_printed_as_they_are() {
        let mut taken = Vec::new();
        let mut output = StandardOutput::new(&mut taken);
        say(&mut output, "a\u{1b}b\n");
        print(&mut output, "{}");
        assert!(output.finish().is_ok());
        assert_eq!(String::from_utf8_lossy(&taken), "a\\u{1b}b\n{}");
    }
}
