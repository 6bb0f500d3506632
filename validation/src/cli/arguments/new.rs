//! The command that writes a crate with a law or a case of a user's own.

use clap::{Args, Subcommand};
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  bagnold new law my-law
  cd my-law
  cargo run -- run film.toml --out film

The crate is the program bagnold with one more law or case. It builds as it is: a law or case with its source, a test against an
exact solution, case files and a README that says what to do next.";

/// `bagnold new`
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct NewArguments {
    /// Of what.
    #[command(subcommand)]
    pub what: NewCrate,
}

/// Content of a new crate.
#[derive(Debug, Subcommand)]
pub enum NewCrate {
    /// Write a crate with a constitutive law of your own.
    Law(Named),
    /// Write a crate with a case of your own.
    Case(Named),
}

/// Name and folder of a new crate.
#[derive(Debug, Args)]
pub struct Named {
    /// Name of the crate, and of the law or case in files: lower-case letters, digits and hyphens.
    #[arg(value_name = "NAME")]
    pub name: String,
    /// Folder to make [default: NAME].
    #[arg(long, value_name = "FOLDER")]
    pub out: Option<PathBuf>,
}
