//! Progress count of work of about equal cost: runs of a sweep, evaluations of a calibration.

use super::display::{Display, time_left};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

/// A count whose number is only usual leaves at least one in so many that are done.
const AT_LEAST_LEFT: u64 = 10;

/// Progress of things of about equal cost.
pub struct CountBar {
    display: Display,
    state: Arc<Mutex<Counted>>,
}

/// Progress of counted work.
struct Counted {
    what: String,
    doing: String,
    all: u64,
    done: u64,
    /// Usual number for such work; what is queued may be less for a while.
    usual: u64,
    /// Done when the count began.
    before: u64,
    begin: Instant,
}

impl Counted {
    fn text(&self) -> String {
        let Self { what, doing, done, before, begin, .. } = self;
        let all = self.expected();
        let part = |count: u64| count as f64 / all.max(1) as f64;
        let left = time_left(part(done - before), part(all.saturating_sub(*done)), begin.elapsed());
        let about = if all > self.all { "about " } else { "" };
        format!("{done}/{about}{all} {what}  {left}  {doing}")
    }

    /// Number of all things: those queued, the usual number, or where that is nearly reached a little more than are done.
    fn expected(&self) -> u64 {
        let least = if self.usual > 0 { self.usual.max(self.done + self.done / AT_LEAST_LEFT) } else { 0 };
        self.all.max(least)
    }
}

impl CountBar {
    /// A bar for so many things, of which some are done.
    #[must_use]
    pub fn new(what: &str, all: usize, done: usize, quiet: bool) -> Self {
        let (all, done) = (all as u64, done as u64);
        let (what, doing, begin) = (what.to_owned(), String::new(), Instant::now());
        let state = Arc::new(Mutex::new(Counted { what, doing, all, done, usual: 0, before: done, begin }));
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
        self.display.bar.set_length(state.expected());
        self.display.bar.set_position(state.done);
        self.display.bar.set_message(state.text());
    }

    /// So many are usual in all, though fewer are queued at first.
    pub(super) fn plan(&self, usual: usize) {
        self.change(|state| state.usual = usual as u64);
    }

    /// So many more are to be done.
    pub(super) fn expect(&self, more: usize) {
        self.change(|state| state.all += more as u64);
    }

    /// Shows what is being done.
    pub fn say(&self, doing: &str) {
        self.change(|state| doing.clone_into(&mut state.doing));
    }

    /// One more is done.
    pub fn step(&self) {
        self.change(|state| state.done += 1);
    }

    /// Takes the bar off the screen.
    pub fn clear(&self) {
        self.display.clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn earlier_work_does_not_count_for_the_rate() {
        let begin = Instant::now();
        let counted =
            |done| Counted { what: "runs".to_owned(), doing: "a".to_owned(), all: 4, done, usual: 0, before: 2, begin };
        assert_eq!(counted(2).text(), "2/4 runs  time left not known yet  a");
    }

    #[test]
    fn work_that_is_queued_step_by_step_counts_as_the_usual_number() {
        let begin = Instant::now();
        let counted = |all, done| Counted {
            what: "runs".to_owned(),
            doing: "a".to_owned(),
            all,
            done,
            usual: 20,
            before: 0,
            begin,
        };
        assert!(counted(4, 2).text().starts_with("2/about 20 runs"), "{}", counted(4, 2).text());
        assert_eq!([counted(4, 4), counted(22, 20), counted(30, 24)].map(|count| count.expected()), [20, 22, 30]);
    }
}
