//! The loops over particles and pairs of a step, with what they store.

pub(super) mod drag_exchange;
pub(crate) mod pair_rows;
pub(super) mod pressure_rows;
pub(super) mod search;
pub(super) mod shifting;
pub(super) mod surroundings;
pub(super) mod viscosities;
