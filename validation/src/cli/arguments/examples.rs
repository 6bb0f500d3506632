//! The command that unpacks what ships with the program.

use clap::Args;
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  bagnold examples
  bagnold calibrate examples/calibrations/mu-i-from-profiles.toml
  bagnold sweep examples/sweeps/bed-load-1d-map.toml

The output folder receives calibrations/*.toml, grains/*.toml and studies/*.toml with their data, scenes/*.toml and sweeps/*.toml.";

/// `bagnold examples`
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct ExamplesArguments {
    /// Output folder; what an earlier call wrote there is replaced.
    #[arg(long, value_name = "DIR", default_value = "examples")]
    pub out: PathBuf,
}
