//! Code that cases of several families share.

mod arrangement;
pub(crate) mod printed_laws;
pub(crate) mod transport_panel;

pub(crate) use arrangement::Arrangement;
