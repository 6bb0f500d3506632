//! Threads of the tests that simulate in their own process.

/// Lets loops of this test's thread run in it alone: tests run beside each other, and the pool that they share would hand over every
/// loop of a step.
pub(crate) fn alone() {
    // a thread that belongs to a pool keeps it
    let _ = rayon::ThreadPoolBuilder::new().num_threads(1).use_current_thread().build();
}
