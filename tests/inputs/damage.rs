//! Random damage to files, and the watch over those who read them: neither a panic nor an endless loop stays unseen.

use crate::inputs::judge::{count, runner};
use proptest::prelude::*;
use proptest::sample::Index;
use proptest::strategy::ValueTree;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Texts that a typing mistake inserts.
const SLIPS: [&str; 24] = [
    "",
    "\"",
    "[",
    "]",
    "{",
    "}",
    "=",
    ",",
    "#",
    "\n",
    "nan",
    "inf",
    "-",
    "1e308",
    "9223372036854775808",
    "\u{0}",
    "ä",
    "[[",
    "../../x",
    "\r",
    "'''",
    "0x",
    "true",
    "  ",
];

/// Processor time that reading a file may take.
const SOON: Duration = Duration::from_secs(5);

/// Looks of the watch, each a fifth of a second, after which a reader is taken for endless, on a machine however busy.
const ENDLESS: u32 = 600;

/// Processor time between two words on how far a long study is.
const WORD: Duration = Duration::from_secs(10);

/// A place, how many bytes go, and what comes instead.
type Slip = (Index, usize, Index);

fn slips() -> impl Strategy<Value = (Index, Vec<Slip>)> {
    (any::<Index>(), prop::collection::vec((any::<Index>(), 0..6_usize, any::<Index>()), 1..=4))
}

fn with_slips(bytes: &[u8], slips: &[Slip]) -> Vec<u8> {
    let mut wrong = bytes.to_vec();
    for (place, gone, slip) in slips {
        let start = place.index(wrong.len() + 1);
        let end = (start + gone).min(wrong.len());
        wrong.splice(start..end, SLIPS[slip.index(SLIPS.len())].bytes());
    }
    wrong
}

/// Processor time of this thread, which no load of the machine lengthens; zero where the system does not tell it.
fn processor_time() -> Duration {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    Duration::from_nanos(told.split(' ').next().and_then(|nanoseconds| nanoseconds.parse().ok()).unwrap_or_default())
}

/// The input that is read at present, with its number. It is shown where its reader panics or does not end.
struct Watch(Arc<Mutex<(u32, Vec<u8>)>>);

impl Watch {
    fn begin() -> Self {
        let shared = Arc::new(Mutex::new((0, Vec::new())));
        let seen = Arc::downgrade(&shared);
        std::thread::spawn(move || {
            let (mut last, mut looks) = (0, 0);
            while let Some(shared) = seen.upgrade() {
                let reading = shared.lock().unwrap_or_else(PoisonError::into_inner);
                looks = if reading.0 == last { looks + 1 } else { 0 };
                last = reading.0;
                if looks > ENDLESS {
                    eprintln!("input {last} is not read to its end: {}", reading.1.escape_ascii());
                    std::process::abort();
                }
                drop(reading);
                drop(shared);
                std::thread::sleep(Duration::from_millis(200));
            }
        });
        Self(shared)
    }

    fn show(&self, number: u32, input: &[u8]) {
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = (number, input.to_vec());
    }
}

impl Drop for Watch {
    fn drop(&mut self) {
        if std::thread::panicking() {
            let shared = self.0.lock().unwrap_or_else(PoisonError::into_inner);
            eprintln!("the input: {}", shared.1.escape_ascii());
        }
    }
}

/// Mistakes in each of some files: bytes that are wrong, gone or doubled. The reader, which gets the number of the file as well, must
/// come back with whatever it likes, soon.
pub(crate) fn read_damaged(files: &[impl AsRef<[u8]>], mut read: impl FnMut(usize, &[u8])) {
    let (mut runner, watch) = (runner(), Watch::begin());
    let (mut all, mut told, mut longest) = (Duration::ZERO, Duration::ZERO, Duration::ZERO);
    for tried in 1..=count() {
        let (which, slips) = slips().new_tree(&mut runner).expect("slips").current();
        let which = which.index(files.len());
        let wrong = with_slips(files[which].as_ref(), &slips);
        watch.show(tried, &wrong);
        let begun = processor_time();
        read(which, &wrong);
        let taken = processor_time() - begun;
        assert!(taken < SOON, "file {which} took {taken:?}");
        all += taken;
        longest = longest.max(taken);
        if all > told + WORD {
            told = all;
            println!("{tried} inputs in {all:.1?}, the longest in {longest:.3?}");
        }
    }
}
