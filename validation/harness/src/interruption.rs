//! Whether a signal has asked the program to end. Runs look between two steps, keep what they have and stop; a second
//! signal ends the program at once.

use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};

/// A signal that ends the program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Signal {
    /// Its number.
    number: u8,
    /// Its name.
    pub name: &'static str,
}

impl Signal {
    /// The exit code of a program that it has ended: 128 and its number, as shells have it.
    #[must_use]
    pub fn exit_code(self) -> u8 {
        128 + self.number
    }
}

/// Ctrl-C, what a batch system and `kill` send, and the end of a terminal.
const SIGNALS: [Signal; 3] = [
    Signal { number: 2, name: "SIGINT" },
    Signal { number: 15, name: "SIGTERM" },
    Signal { number: 1, name: "SIGHUP" },
];

/// Flags that the signal handlers set.
#[derive(Default)]
struct Flags {
    asked: Arc<AtomicBool>,
    number: Arc<AtomicUsize>,
}

static FLAGS: OnceLock<Flags> = OnceLock::new();

/// Listens to the signals from now on, once a program. SIGHUP stays ignored where it is, as under nohup.
///
/// # Errors
/// A system that lets no handler be registered.
pub fn listen() -> std::io::Result<()> {
    let mut outcome = Ok(());
    FLAGS.get_or_init(|| {
        let flags = Flags::default();
        for signal in SIGNALS.iter().filter(|signal| signal.name != "SIGHUP" || !is_ignored(signal.number)) {
            if let Err(error) = register(&flags, *signal) {
                outcome = Err(error);
            }
        }
        flags
    });
    outcome
}

fn register(flags: &Flags, signal: Signal) -> std::io::Result<()> {
    let (number, code) = (i32::from(signal.number), i32::from(signal.exit_code()));
    // in this order: the first signal finds the flag down, the second up
    signal_hook::flag::register_conditional_shutdown(number, code, Arc::clone(&flags.asked))?;
    signal_hook::flag::register_usize(number, Arc::clone(&flags.number), usize::from(signal.number))?;
    signal_hook::flag::register(number, Arc::clone(&flags.asked))?;
    Ok(())
}

/// The signal that has asked the program to end.
#[must_use]
pub fn asked() -> Option<Signal> {
    let flags = FLAGS.get().filter(|flags| flags.asked.load(Ordering::SeqCst))?;
    let number = flags.number.load(Ordering::SeqCst);
    SIGNALS.into_iter().find(|signal| usize::from(signal.number) == number)
}

/// Asks for what a signal asks for: for programs that handle signals themselves, as a Python interpreter does.
pub fn ask() {
    let flags = FLAGS.get_or_init(Flags::default);
    flags.number.store(usize::from(SIGNALS[0].number), Ordering::SeqCst);
    flags.asked.store(true, Ordering::SeqCst);
}

/// Takes it back, once what was to end has ended: the process lives on.
pub fn withdraw() {
    if let Some(flags) = FLAGS.get() {
        flags.asked.store(false, Ordering::SeqCst);
    }
}

/// Whether the process was started with a signal ignored; where the system does not tell, it was not.
fn is_ignored(number: u8) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| u64::from_str_radix(line.strip_prefix("SigIgn:")?.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (number - 1) & 1 == 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exit_codes_are_those_of_shells_and_nobody_has_asked() {
        let codes = SIGNALS.map(|signal| (signal.name, signal.exit_code()));
        assert_eq!(codes, [("SIGINT", 130), ("SIGTERM", 143), ("SIGHUP", 129)]);
        assert_eq!(asked(), None);
    }
}
