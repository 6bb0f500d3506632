//! From a request to checked runs with their expected cost, carried out on the threads at hand.

pub(super) mod erased;
pub(super) mod estimate;
pub(super) mod expectation;
pub(super) mod guard;
pub(super) mod progress;
pub(super) mod registry;
pub(super) mod request;
pub(super) mod schedule;
