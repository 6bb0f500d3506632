//! Loops over particles on all threads of rayon's pool.
//!
//! A loop's items are divided into parts, and whoever is free takes the next one: what an item writes is its own, so that
//! the result does not depend on who does it. Calls are named as rayon's are. Rayon compiles what divides and waits anew
//! for each loop, which was a third of all code of the solver and a quarter of the time to build it; here that is
//! compiled once, and a loop adds the division of its items alone.

mod items;
#[cfg(test)]
mod tests;

pub(crate) use items::{ChunksMut, Items};

/// All that a file with loops needs.
pub(crate) mod prelude {
    pub(crate) use super::Parallel;
    pub(crate) use super::items::{IntoItems, Items, ParallelSlice, ParallelSliceMut};
}

use items::{Enumerated, Mapped, WithLeast};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Parts for each thread: enough that no one waits long for the last.
const PARTS: usize = 8;

/// Operations of parallel loops on their items.
pub(crate) trait Parallel: Items {
    /// Each item with its number.
    fn enumerate(self) -> Enumerated<Self> {
        Enumerated { items: self, first: 0 }
    }

    /// No part with fewer items: less is done before another thread has woken.
    fn with_min_len(self, least: usize) -> WithLeast<Self> {
        WithLeast { items: self, least }
    }

    /// Results of `function` for each item.
    fn map<R, F: Fn(Self::Item) -> R + Clone + Send>(self, function: F) -> Mapped<Self, F> {
        Mapped { items: self, function }
    }

    /// Calls `task` with every item.
    fn for_each(self, task: impl Fn(Self::Item) + Sync) {
        let queue = Queue::new(self);
        on_threads(queue.threads, &|| {
            while let Some(part) = queue.next() {
                part.sequence().for_each(&task);
            }
        });
    }

    /// All items joined. `join` must be associative and commutative to the bit, as the larger of two is, because parts are
    /// joined as they come.
    fn reduce(
        self,
        none: impl Fn() -> Self::Item + Sync,
        join: impl Fn(Self::Item, Self::Item) -> Self::Item + Sync,
    ) -> Self::Item
    where
        Self::Item: Send,
    {
        let queue = Queue::new(self);
        let all = Mutex::new(none());
        on_threads(queue.threads, &|| {
            let mut own = none();
            while let Some(part) = queue.next() {
                own = part.sequence().fold(own, &join);
            }
            let mut all = lock(&all);
            *all = join(std::mem::replace(&mut *all, none()), own);
        });
        all.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<I: Items> Parallel for I {}

/// The items that no thread has taken yet.
struct Queue<I> {
    rest: Mutex<Option<I>>,
    /// Items of a part.
    part: usize,
    /// Threads that have something to do.
    threads: usize,
}

impl<I: Items> Queue<I> {
    fn new(items: I) -> Self {
        let (length, pool) = (items.length(), rayon::current_num_threads());
        let parts = if pool > 1 { PARTS * pool } else { 1 };
        let part = length.div_ceil(parts).max(items.least()).max(1);
        Self { rest: Mutex::new(Some(items)), part, threads: pool.min(length.div_ceil(part)) }
    }

    fn next(&self) -> Option<I> {
        let mut rest = lock(&self.rest);
        let items = rest.take()?;
        if items.length() <= self.part {
            return (items.length() > 0).then_some(items);
        }
        let (part, later) = items.divided(self.part);
        *rest = Some(later);
        Some(part)
    }
}

/// No lock is held while an item is worked on, so that a panic leaves nothing half done.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Lets so many threads do `work` until there is none left.
fn on_threads(threads: usize, work: &(dyn Fn() + Sync)) {
    if threads <= 1 {
        work();
    } else {
        let half = threads / 2;
        rayon::join(|| on_threads(threads - half, work), || on_threads(half, work));
    }
}
