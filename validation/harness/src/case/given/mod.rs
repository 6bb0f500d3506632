//! What a user gives: a file, settings, tables that it names; and what is wrong with it.

pub(super) mod changes;
pub(super) mod error;
pub(super) mod fault;
pub(super) mod file;
pub(super) mod friction_angle;
pub(super) mod measured_rows;
pub(super) mod meshes;
pub(super) mod output;
pub(super) mod plausible;
pub(super) mod rates;
