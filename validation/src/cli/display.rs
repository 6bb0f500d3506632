//! Progress display: a bar on a terminal, elsewhere a line every half minute.

use super::terminal::{BARS, SHOWN, moves_its_cursor, tell};
use super::ticker::Ticker;
use indicatif::{HumanDuration, ProgressBar, ProgressStyle};
use std::sync::atomic::Ordering;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Time between two lines where there is no terminal, and between two updates of a bar that nothing else updates.
const LINE_INTERVAL: Duration = Duration::from_secs(30);
const BAR_INTERVAL: Duration = Duration::from_secs(1);

/// Least time between two updates: a step of the work may take less than a terminal needs for a line.
const UPDATE_INTERVAL: Duration = Duration::from_millis(100);

/// Resolution of the bar.
const PARTS: u64 = 10_000;

/// Part of the work that must be done before the time left is shown `[-]`.
const LEAST_PART: f64 = 1e-3;

/// Work whose progress is shown.
pub(super) trait Work: Send + 'static {
    /// Part that is done, 0 … 1 `[-]`.
    fn part(&self) -> f64;
    /// Time left, counts and the last thing done.
    fn text(&self) -> String;
}

/// Shows work as a bar or, where it cannot be seen, as lines, until it is dropped.
pub(super) struct Display<W: Work> {
    bar: ProgressBar,
    /// The work, and the time of the last update.
    work: Arc<Mutex<(W, Instant)>>,
    ticker: Option<Ticker>,
}

fn lock<W>(work: &Mutex<W>) -> MutexGuard<'_, W> {
    work.lock().unwrap_or_else(PoisonError::into_inner)
}

fn show(bar: &ProgressBar, work: &impl Work) {
    // A saturating cast.
    bar.set_position((work.part() * PARTS as f64) as u64);
    bar.set_message(work.text());
}

impl<W: Work> Display<W> {
    pub(super) fn new(work: W, quiet: bool) -> Self {
        let bar = ProgressBar::hidden();
        let work = Arc::new(Mutex::new((work, Instant::now())));
        if quiet {
            return Self { bar, work, ticker: None };
        }
        let told = Arc::clone(&work);
        if !moves_its_cursor() {
            let tell = move || {
                let (work, _) = &*lock(&told);
                tell(&format!("{:.1} % done  {}", 100.0 * work.part(), work.text()));
            };
            return Self { bar, work, ticker: Some(Ticker::every(LINE_INTERVAL, tell)) };
        }
        let bar = BARS.add(ProgressBar::new(PARTS));
        SHOWN.fetch_add(usize::from(!bar.is_hidden()), Ordering::SeqCst);
        if let Ok(style) = ProgressStyle::with_template("{bar:24} {percent:>3} %  {wide_msg}") {
            bar.set_style(style);
        }
        show(&bar, &lock(&work).0);
        let shown = bar.clone();
        let ticker = Ticker::every(BAR_INTERVAL, move || show(&shown, &lock(&told).0));
        Self { bar, work, ticker: Some(ticker) }
    }

    /// Notes progress.
    pub(super) fn change(&self, change: impl FnOnce(&mut W)) {
        let (work, updated) = &mut *lock(&self.work);
        change(work);
        if updated.elapsed() > UPDATE_INTERVAL {
            *updated = Instant::now();
            show(&self.bar, work);
        }
    }
}

impl<W: Work> Drop for Display<W> {
    fn drop(&mut self) {
        // joined here: it may be about to write
        self.ticker = None;
        if !self.bar.is_hidden() {
            self.bar.finish_and_clear();
            BARS.remove(&self.bar);
            SHOWN.fetch_sub(1, Ordering::SeqCst);
        }
    }
}

/// The time left where `part` of the work has been done in `elapsed` and `rest` of it is left, both `[-]`; never none.
pub(super) fn time_left(part: f64, rest: f64, elapsed: Duration) -> String {
    if part < LEAST_PART || elapsed < Duration::from_secs(1) {
        return "remaining time not known yet".to_owned();
    }
    let seconds = (elapsed.as_secs_f64() * rest / part).clamp(1.0, 1e9);
    format!("{} left", HumanDuration(Duration::from_secs_f64(seconds)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_left_is_never_none() {
        let minute = Duration::from_secs(60);
        assert_eq!(time_left(0.0, 1.0, minute), "remaining time not known yet");
        assert_eq!(time_left(0.5, 0.5, Duration::ZERO), "remaining time not known yet");
        assert_eq!(time_left(0.25, 0.75, minute), "3 minutes left");
        for rest in [0.0, 1e-300, 1e-6, -1.0] {
            assert_eq!(time_left(1.0, rest, minute), "1 second left");
        }
        assert_eq!(time_left(1e-3, 1e308, minute), "32 years left");
    }
}
