//! Whether a signal has asked the program to end. Runs look between two steps, keep what they have and stop; a second
//! signal ends the program at once.

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::flag;
use signal_hook::low_level::signal_name;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, OnceLock};

/// A signal that ends the program, by its number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Signal(i32);

impl Signal {
    /// Name of the signal, such as SIGTERM.
    pub fn name(self) -> &'static str {
        signal_name(self.0).unwrap_or("a signal")
    }

    /// Exit code of a program that the signal has ended: 128 plus its number, as in shells.
    pub fn exit_code(self) -> u8 {
        u8::try_from(128 + self.0).unwrap_or(u8::MAX)
    }
}

/// Ctrl-C, what a batch system and `kill` send, and the end of a terminal.
const SIGNALS: [i32; 3] = [SIGINT, SIGTERM, SIGHUP];

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
        for signal in SIGNALS.into_iter().filter(|signal| *signal != SIGHUP || !is_ignored(SIGHUP)) {
            if let Err(error) = register(&flags, signal) {
                outcome = Err(error);
            }
        }
        flags
    });
    outcome
}

fn register(flags: &Flags, signal: i32) -> std::io::Result<()> {
    let code = i32::from(Signal(signal).exit_code());
    // in this order: the first signal finds the flag down, the second up
    flag::register_conditional_shutdown(signal, code, Arc::clone(&flags.asked))?;
    flag::register_usize(signal, Arc::clone(&flags.number), signal as usize)?;
    flag::register(signal, Arc::clone(&flags.asked))?;
    Ok(())
}

/// The signal that has asked the program to end.
pub fn asked() -> Option<Signal> {
    let flags = FLAGS.get().filter(|flags| flags.asked.load(Ordering::SeqCst))?;
    i32::try_from(flags.number.load(Ordering::SeqCst)).ok().map(Signal)
}

/// Requests an interruption as a signal does: for programs that handle signals themselves, such as a Python interpreter.
pub fn ask() {
    let flags = FLAGS.get_or_init(Flags::default);
    flags.number.store(SIGINT as usize, Ordering::SeqCst);
    flags.asked.store(true, Ordering::SeqCst);
}

/// Withdraws the request once its purpose is fulfilled: the process continues.
pub fn withdraw() {
    if let Some(flags) = FLAGS.get() {
        flags.asked.store(false, Ordering::SeqCst);
    }
}

/// Whether the process was started with a signal ignored; where the system does not tell, it was not.
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| u64::from_str_radix(line.strip_prefix("SigIgn:")?.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exit_codes_are_those_of_shells_and_nobody_has_asked() {
        let codes = SIGNALS.map(|signal| (Signal(signal).name(), Signal(signal).exit_code()));
        assert_eq!(codes, [("SIGINT", 130), ("SIGTERM", 143), ("SIGHUP", 129)]);
        assert_eq!(asked(), None);
    }
}
