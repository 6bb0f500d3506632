//! The formulas of one pair each, without loops and storage.

pub(super) mod drag_pair;
pub(super) mod viscous_pair;
