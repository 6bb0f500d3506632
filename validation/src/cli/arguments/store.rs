//! Arguments of `store`.

use super::work::positive;
use clap::{Args, Subcommand};
use std::path::PathBuf;

/// `bagnold store`
#[derive(Debug, Args)]
pub struct StoreArguments {
    /// Action on stored results.
    #[command(subcommand)]
    pub action: StoreAction,
    /// Folder of stored results [default: $BAGNOLD_STORE, else reports/store of the checkout, else the
    /// cache folder of the user].
    #[arg(long, value_name = "DIR", global = true)]
    pub store: Option<PathBuf>,
}

/// Action on stored results.
#[derive(Debug, Clone, Copy, Subcommand)]
pub enum StoreAction {
    /// List stored results by program version: number, size, age.
    List,
    /// Delete entries, the oldest first.
    #[command(group = clap::ArgGroup::new("limit").required(true).multiple(true))]
    Prune {
        /// Delete entries older than this.
        #[arg(long, value_name = "DAYS", value_parser = positive, allow_negative_numbers = true, group = "limit")]
        days: Option<f64>,
        /// Delete the oldest entries until the total size falls below this.
        #[arg(long, value_name = "GIB", value_parser = positive, allow_negative_numbers = true, group = "limit")]
        size: Option<f64>,
    },
}
