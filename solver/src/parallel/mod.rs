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

/// Everything that a file with loops needs.
pub(crate) mod prelude {
    pub(crate) use super::Parallel;
    pub(crate) use super::items::{IntoItems, Items, ParallelSlice, ParallelSliceMut};
}

use items::{Enumerated, IntoItems};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Parts for each thread: enough that no one waits long for the last.
const PARTS: usize = 8;

/// Operations of parallel loops on their items.
pub(crate) trait Parallel: IntoItems {
    /// Each item with its number.
    fn enumerate(self) -> Enumerated<Self::Items> {
        Enumerated { items: self.into_items(), first: 0 }
    }

    /// No part with fewer items: less is done before another thread has woken.
    fn with_min_len(self, least: usize) -> Loop<Self::Items> {
        Loop { items: self.into_items(), least }
    }

    /// Results of `function` for each item.
    fn map<R, F: Fn(Item<Self>) -> R + Sync>(self, function: F) -> Mapped<Self::Items, F> {
        self.with_min_len(1).map(function)
    }

    /// Calls `task` with every item.
    fn for_each(self, task: impl Fn(Item<Self>) + Sync) {
        self.with_min_len(1).for_each(task);
    }
}

impl<I: IntoItems> Parallel for I {}

/// An item of what becomes items.
type Item<I> = <<I as IntoItems>::Items as Items>::Item;

/// Items in parts of at least a given size.
#[derive(Debug)]
pub(crate) struct Loop<I> {
    items: I,
    least: usize,
}

impl<I: Items> Loop<I> {
    /// Results of `function` for each item.
    pub(crate) fn map<R, F: Fn(I::Item) -> R + Sync>(self, function: F) -> Mapped<I, F> {
        Mapped { items: self, function }
    }

    /// Calls `task` with every item.
    pub(crate) fn for_each(self, task: impl Fn(I::Item) + Sync) {
        let queue = Queue::new(self);
        on_threads(queue.threads, &|| {
            while let Some(part) = queue.next() {
                part.sequence().for_each(&task);
            }
        });
    }
}

/// Results of a function for each item.
#[derive(Debug)]
pub(crate) struct Mapped<I, F> {
    items: Loop<I>,
    function: F,
}

impl<R: Send, I: Items, F: Fn(I::Item) -> R + Sync> Mapped<I, F> {
    /// All results joined. `join` must be associative and commutative to the bit, as the larger of two is, because parts are
    /// joined as they come.
    pub(crate) fn reduce(self, none: impl Fn() -> R + Sync, join: impl Fn(R, R) -> R + Sync) -> R {
        let queue = Queue::new(self.items);
        let all = Mutex::new(none());
        on_threads(queue.threads, &|| {
            let mut own = none();
            while let Some(part) = queue.next() {
                own = part.sequence().map(&self.function).fold(own, &join);
            }
            let mut all = lock(&all);
            *all = join(std::mem::replace(&mut *all, none()), own);
        });
        all.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The items that no thread has taken yet.
struct Queue<I> {
    rest: Mutex<Option<I>>,
    /// Items of a part.
    part: usize,
    /// Threads that have something to do.
    threads: usize,
}

impl<I: Items> Queue<I> {
    fn new(Loop { items, least }: Loop<I>) -> Self {
        let (part, threads) = shares(items.length(), least);
        Self { rest: Mutex::new(Some(items)), part, threads }
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

/// Items of a part, and threads that have something to do.
fn shares(items: usize, least: usize) -> (usize, usize) {
    let pool = rayon::current_num_threads();
    let parts = if pool > 1 { PARTS * pool } else { 1 };
    let part = items.div_ceil(parts).max(least).max(1);
    (part, pool.min(items.div_ceil(part)))
}

/// No lock is held while an item is worked on, so that a panic leaves nothing half done.
fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What threads do until there is none left. It has one method, where a closure would be compiled for each of the ways to call it.
trait Work: Sync {
    fn work(&self);
}

impl<F: Fn() + Sync> Work for F {
    fn work(&self) {
        self();
    }
}

/// Does `work` on a given number of threads.
fn on_threads(threads: usize, work: &dyn Work) {
    if threads <= 1 {
        work.work();
    } else {
        let half = threads / 2;
        rayon::join(|| on_threads(threads - half, work), || on_threads(half, work));
    }
}
