//! What a case shows of its parameters: the file of `bagnold show` with its remarks, the schema, the options.

pub(super) mod features;
pub(super) mod notes;
pub(super) mod schema;
pub(super) mod tables;
