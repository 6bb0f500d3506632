//! Results that were written earlier, beside each other: `bagnold compare`.

mod difference;
mod figures;
mod page;
mod parameters;
mod reading;
mod roles;

pub use difference::{Difference, differences};
pub use page::write;
pub use parameters::{ChangedParameter, changed};
pub use reading::Results;
pub use roles::PairedKey;
