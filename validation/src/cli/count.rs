//! Progress count of work of about equal cost: runs of a sweep, evaluations of a calibration.

use super::display::{Display, Work, time_left};
use std::time::Instant;

/// A count whose number is only usual leaves at least one in so many that are done.
const AT_LEAST_LEFT: u64 = 10;

/// Progress of items of about equal cost; it leaves the screen when dropped.
pub struct CountBar(Display<Counted>);

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

impl Work for Counted {
    fn part(&self) -> f64 {
        self.done as f64 / self.expected().max(1) as f64
    }

    fn text(&self) -> String {
        let Self { what, doing, done, before, begin, .. } = self;
        let all = self.expected();
        let part = |count: u64| count as f64 / all.max(1) as f64;
        let left = time_left(part(done - before), part(all.saturating_sub(*done)), begin.elapsed());
        let about = if all > self.all { "about " } else { "" };
        format!("{done}/{about}{all} {what}  {left}  {doing}")
    }
}

impl Counted {
    /// Number of all things: those queued, the usual number, or where that is nearly reached a little more than are done.
    fn expected(&self) -> u64 {
        let least = if self.usual > 0 { self.usual.max(self.done + self.done / AT_LEAST_LEFT) } else { 0 };
        self.all.max(least)
    }
}

impl CountBar {
    /// Progress bar for a number of items, some of which are done.
    pub fn new(what: &str, all: usize, done: usize, quiet: bool) -> Self {
        let (what, all, done, begin) = (what.to_owned(), all as u64, done as u64, Instant::now());
        Self(Display::new(Counted { what, doing: String::new(), all, done, usual: 0, before: done, begin }, quiet))
    }

    /// Usual total, though fewer are queued at first.
    pub(super) fn plan(&self, usual: usize) {
        self.0.change(|count| count.usual = usual as u64);
    }

    /// Adds a number of items to do.
    pub(super) fn expect(&self, more: usize) {
        self.0.change(|count| count.all += more as u64);
    }

    /// Shows the current activity.
    pub fn say(&self, doing: &str) {
        self.0.change(|count| doing.clone_into(&mut count.doing));
    }

    /// Counts one more finished item.
    pub fn step(&self) {
        self.0.change(|count| count.done += 1);
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
        assert_eq!(counted(2).text(), "2/4 runs  remaining time not known yet  a");
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
