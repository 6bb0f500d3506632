//! Results that were written earlier, beside each other: `bagnold compare`.

mod difference;
mod figures;
mod page;
mod reading;

pub use difference::{Difference, differences};
pub use page::write;
pub use reading::{CompareError, Results};
