//! The structure of the workspace: who imports whom, where numbers stand, and lists that follow from the registry.

mod advisories;
mod circles;
mod commit;
mod coverage;
mod dependencies;
mod documents;
mod examples;
mod imports;
mod limits;
mod lines;
mod literals;
mod mutations;
mod order;
mod papers;
mod printing;
mod python;
mod readme;
mod references;
mod simulations;
mod source;
pub(crate) mod words;
