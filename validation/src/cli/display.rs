//! Progress display: a bar on a terminal, elsewhere a line every half minute.

use super::terminal::{BARS, moves_its_cursor, tell};
use super::ticker::Ticker;
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Time between two lines where there is no terminal, and between two updates of a bar that nothing else updates.
const LINE_INTERVAL: Duration = Duration::from_secs(30);
const BAR_INTERVAL: Duration = Duration::from_secs(1);

/// Part of the work that must be done before the time left is shown `[-]`.
const LEAST_PART: f64 = 1e-3;

/// A bar and, where it cannot be seen, lines in its place.
pub(super) struct Display {
    pub(super) bar: ProgressBar,
    pub(super) begin: Instant,
    pub(super) lines: bool,
    quiet: bool,
    ticker: Mutex<Option<Ticker>>,
}

impl Display {
    pub(super) fn new(length: u64, template: &str, quiet: bool) -> Self {
        let seen = moves_its_cursor();
        let bar = if quiet || !seen {
            ProgressBar::with_draw_target(Some(length), ProgressDrawTarget::hidden())
        } else {
            BARS.add(ProgressBar::new(length))
        };
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style);
        }
        Self { bar, begin: Instant::now(), lines: !quiet && !seen, quiet, ticker: Mutex::new(None) }
    }

    /// Shows the text that `text` makes, from now on also while nothing happens.
    pub(super) fn refresh_by(&self, text: impl Fn() -> String + Send + 'static) {
        let ticker = if self.lines {
            Ticker::every(LINE_INTERVAL, move || tell(&text()))
        } else {
            let bar = self.bar.clone();
            Ticker::every(BAR_INTERVAL, move || bar.set_message(text()))
        };
        *self.ticker.lock().unwrap_or_else(PoisonError::into_inner) = Some(ticker);
    }

    /// Says something once, above the bar.
    pub(super) fn say(&self, text: &str) {
        if !self.quiet {
            tell(text);
        }
    }

    /// Takes the bar off the screen and ends the lines.
    pub(super) fn clear(&self) {
        let ticker = self.ticker.lock().unwrap_or_else(PoisonError::into_inner).take();
        // joined here: it may be about to write
        drop(ticker);
        self.bar.finish_and_clear();
        BARS.remove(&self.bar);
    }
}

/// The time left where `part` of the work has been done in `elapsed` and `rest` of it is left, both `[-]`; never none.
pub(super) fn time_left(part: f64, rest: f64, elapsed: Duration) -> String {
    if part < LEAST_PART || elapsed < Duration::from_secs(1) {
        return "time left not known yet".to_owned();
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
        assert_eq!(time_left(0.0, 1.0, minute), "time left not known yet");
        assert_eq!(time_left(0.5, 0.5, Duration::ZERO), "time left not known yet");
        assert_eq!(time_left(0.25, 0.75, minute), "3 minutes left");
        for rest in [0.0, 1e-300, 1e-6, -1.0] {
            assert_eq!(time_left(1.0, rest, minute), "1 second left");
        }
        assert_eq!(time_left(1e-3, 1e308, minute), "32 years left");
    }
}
