//! Files that a run writes.

mod claim;
mod error;
mod folder;
mod lock;
mod publication;
mod sealed;
mod table;
mod warning;
mod whole;

pub use claim::{Owner, claim, owner_of};
pub use error::{FileError, FolderError, read_if_there, reason};
pub use folder::OutputFolder;
pub use lock::FolderLock;
pub(crate) use sealed::{Refused, SealedFormat};
pub use table::{ABSENT, Table, csv_text};
pub use warning::{caution, caution_about, caution_of_shipped, cautions};
pub use whole::write_whole;
