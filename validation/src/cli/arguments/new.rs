//! The command that writes a crate with a law or a case of a user's own.

use clap::{Args, Subcommand};
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  bagnold new law my-law
  cd my-law
  cargo run -- run film.toml --out film

The crate builds the program bagnold with one more law or case.
It contains the law or case, a test against an exact solution, case files and a README with the next steps.";

/// `bagnold new`
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct NewArguments {
    /// Kind of crate to write: a law or a case.
    #[command(subcommand)]
    pub what: NewCrate,
}

/// Content of a new crate.
#[derive(Debug, Subcommand)]
pub enum NewCrate {
    /// Write a crate with a constitutive law.
    Law(Named),
    /// Write a crate with a case.
    Case(Named),
    /// Refused with the command that writes a scene.
    #[command(hide = true)]
    Scene {
        /// All that follows.
        #[arg(trailing_var_arg = true, allow_hyphen_values = true)]
        ignored: Vec<String>,
    },
}

/// Name and folder of a new crate.
#[derive(Debug, Args)]
pub struct Named {
    /// Name of the crate and of its law or case: lower-case letters, digits and hyphens.
    #[arg(value_name = "NAME")]
    pub name: String,
    /// Folder to create [default: NAME].
    #[arg(long, value_name = "FOLDER")]
    pub out: Option<PathBuf>,
}
