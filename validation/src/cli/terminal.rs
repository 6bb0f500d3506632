//! Messages of the program on standard output and standard error.
//!
//! Standard error is a courtesy: a reader who has gone, a full disk or a terminal that was closed change nothing. Standard
//! output is a result: one that cannot be written is an error of the command, unless its reader has had enough (`| head`).

use super::error::ProgramError;
use crate::input::escaped_lines;
use console::Term;
use indicatif::{MultiProgress, ProgressDrawTarget, TermLike};
use std::io::{self, ErrorKind, IsTerminal, Write};
use std::sync::LazyLock;

/// Whether standard error is a terminal that understands escape codes.
pub(super) fn moves_its_cursor() -> bool {
    io::stderr().is_terminal() && std::env::var_os("TERM").is_none_or(|name| name != "dumb")
}

/// All progress bars of the program; whatever else is said moves them out of its way.
pub(super) static BARS: LazyLock<MultiProgress> = LazyLock::new(|| {
    let seen = moves_its_cursor();
    let terminal = || ProgressDrawTarget::term_like_with_hz(Box::new(Forgiving(Term::buffered_stderr())), BARS_HERTZ);
    MultiProgress::with_draw_target(if seen { terminal() } else { ProgressDrawTarget::hidden() })
});

/// Most times that bars are drawn anew `[1/s]`.
const BARS_HERTZ: u8 = 20;

/// Says something on standard error, a line or more, and escapes what would control a terminal.
pub fn tell(text: &str) {
    tell_raw(format!("{}\n", escaped_lines(text)).as_bytes());
}

/// Writes to standard error unchanged, where it is open.
pub(super) fn tell_raw(bytes: &[u8]) {
    // there is nowhere left to report that this fails
    let write = || io::stderr().write_all(bytes).and_then(|()| io::stderr().flush());
    let _: io::Result<()> = BARS.suspend(write);
}

/// A terminal for progress bars that may vanish: the crate of the bars panics where one of theirs cannot be written.
#[derive(Debug)]
struct Forgiving(Term);

impl Forgiving {
    fn attempt(&self, act: impl FnOnce(&Term) -> io::Result<()>) -> io::Result<()> {
        // the bar is lost with its terminal, the work continues
        let _: io::Result<()> = act(&self.0);
        Ok(())
    }
}

impl TermLike for Forgiving {
    fn width(&self) -> u16 {
        TermLike::width(&self.0)
    }

    fn height(&self) -> u16 {
        TermLike::height(&self.0)
    }

    fn move_cursor_up(&self, lines: usize) -> io::Result<()> {
        self.attempt(|terminal| terminal.move_cursor_up(lines))
    }

    fn move_cursor_down(&self, lines: usize) -> io::Result<()> {
        self.attempt(|terminal| terminal.move_cursor_down(lines))
    }

    fn move_cursor_right(&self, columns: usize) -> io::Result<()> {
        self.attempt(|terminal| terminal.move_cursor_right(columns))
    }

    fn move_cursor_left(&self, columns: usize) -> io::Result<()> {
        self.attempt(|terminal| terminal.move_cursor_left(columns))
    }

    fn write_line(&self, text: &str) -> io::Result<()> {
        self.attempt(|terminal| terminal.write_line(text))
    }

    fn write_str(&self, text: &str) -> io::Result<()> {
        self.attempt(|terminal| terminal.write_str(text))
    }

    fn clear_line(&self) -> io::Result<()> {
        self.attempt(Term::clear_line)
    }

    fn flush(&self) -> io::Result<()> {
        self.attempt(Term::flush)
    }
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

    /// Whether all was written, or its reader has gone before the end.
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

/// Prints, and escapes what would control a terminal.
pub fn say(output: &mut (dyn Write + Send), text: &str) {
    print(output, &escaped_lines(text));
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
