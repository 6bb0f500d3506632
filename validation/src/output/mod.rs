//! Files that a run writes.

mod claim;
mod error;
mod folder;
mod publication;
mod table;
mod whole;

pub use claim::{Owner, claim, is_claimed, owner_of};
pub use error::{FileError, FolderError};
pub use folder::OutputFolder;
pub use table::Table;
pub use whole::write_whole;
