//! Progress count of work of about equal cost: runs of a sweep, evaluations of a calibration.

use super::display::{Display, time_left};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

/// Progress of things of about equal cost.
pub(super) struct CountBar {
    display: Display,
    state: Arc<Mutex<Counted>>,
}

/// Progress of counted work.
struct Counted {
    what: String,
    doing: String,
    all: u64,
    done: u64,
    /// Done when the count began.
    before: u64,
    begin: Instant,
}

impl Counted {
    fn text(&self) -> String {
        let Self { what, doing, all, done, before, begin } = self;
        let part = |count: u64| count as f64 / (*all).max(1) as f64;
        let left = time_left(part(done - before), part(all.saturating_sub(*done)), begin.elapsed());
        format!("{done}/{all} {what}  {left}  {doing}")
    }
}

impl CountBar {
    pub(super) fn new(what: &str, all: usize, done: usize, quiet: bool) -> Self {
        let (all, done) = (all as u64, done as u64);
        let (what, doing, begin) = (what.to_owned(), String::new(), Instant::now());
        let state = Arc::new(Mutex::new(Counted { what, doing, all, done, before: done, begin }));
        let display = Display::new(all, "{bar:24} {wide_msg}", quiet);
        let told = Arc::clone(&state);
        display.refresh_by(move || told.lock().unwrap_or_else(PoisonError::into_inner).text());
        let count = Self { display, state };
        count.change(|_| {});
        count
    }

    fn change(&self, change: impl FnOnce(&mut Counted)) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        change(&mut state);
        self.display.bar.set_length(state.all);
        self.display.bar.set_position(state.done);
        self.display.bar.set_message(state.text());
    }

    /// So many more are to be done.
    pub(super) fn expect(&self, more: usize) {
        self.change(|state| state.all += more as u64);
    }

    /// Shows what is being done.
    pub(super) fn say(&self, doing: &str) {
        self.change(|state| doing.clone_into(&mut state.doing));
    }

    /// One more is done.
    pub(super) fn step(&self) {
        self.change(|state| state.done += 1);
    }

    /// Takes the bar off the screen.
    pub(super) fn clear(&self) {
        self.display.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn earlier_work_does_not_count_for_the_rate() {
        let begin = Instant::now();
        let counted = |done| Counted { what: "runs".to_owned(), doing: "a".to_owned(), all: 4, done, before: 2, begin };
        assert_eq!(counted(2).text(), "2/4 runs  time left not known yet  a");
    }
}
