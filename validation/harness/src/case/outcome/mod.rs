//! What a run leaves behind, by this program or another code.

pub(super) mod causes;
pub(super) mod conditions;
pub(super) mod finite;
pub(super) mod foreign;
pub(super) mod result;
