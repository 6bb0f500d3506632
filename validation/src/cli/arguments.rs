//! What can be typed: the commands, their options and their help.

use crate::case::Tier;
use clap::{ArgAction, Args, Parser, Subcommand};
use std::path::PathBuf;

const EXAMPLES: &str = "Examples:
  bagnold list                                 what can be run
  bagnold run film                             one case, in seconds
  bagnold run bagnold --tier paper --threads 4 the same at full resolution
  bagnold show film > my.toml                  parameters to edit
  bagnold run my.toml --out results            run the edited file
  bagnold report                               all cases, judged on one page: reports/index.html

Exit codes: 0 all gates hold, 1 a gate fails, 2 bad input, 3 a run diverged.";

const RUN_EXAMPLES: &str = "Examples:
  bagnold run film
  bagnold run bagnold --tier paper --out results/bagnold
  bagnold run my.toml --set resolution=30 --set numerics.hourglass=0.1
  bagnold run film --json > metrics.json

A file names its case with `case = \"film\"` and takes from the tier what it leaves out; `bagnold show film`
prints a complete one. Values of --set are TOML; fields inside tables are reached by dots. The folder
receives case.toml, metrics.json, provenance.json, tables/*.csv, figures/ and snapshots/*.pvd for ParaView.

Exit codes: 0 all gates hold, 1 a gate fails, 2 bad input, 3 a run diverged.";

const REPORT_EXAMPLES: &str = "Examples:
  bagnold report
  bagnold report --tier paper --cases film,bagnold --out paper-report

The report is one self-contained folder: open its index.html. Failing gates come first.

Exit codes: 0 all gates hold, 1 a gate fails, 2 bad input, 3 a run diverged.";

/// Granular and sediment flows by smoothed particle hydrodynamics, judged against exact solutions and experiments.
#[derive(Debug, Parser)]
#[command(name = "bagnold", version, after_help = EXAMPLES, propagate_version = true)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
    /// Say more on standard error; twice for every detail.
    #[arg(short, long, global = true, action = ArgAction::Count, conflicts_with = "quiet")]
    pub verbose: u8,
    /// Print no progress and no warnings on standard error.
    #[arg(short, long, global = true)]
    pub quiet: bool,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// List the cases.
    List,
    /// Print a case's parameters as a TOML file that `run` takes.
    Show(Show),
    /// Simulate one case and judge it.
    Run(Run),
    /// Simulate many cases and write one page about them.
    Report(Report),
}

/// `bagnold show`
#[derive(Debug, Args)]
pub struct Show {
    /// Name of a case, see `bagnold list`.
    pub case: String,
    /// How much the case may cost.
    #[arg(long, value_enum, default_value_t = Tier::Quick)]
    pub tier: Tier,
}

/// `bagnold run`
#[derive(Debug, Args)]
#[command(after_help = RUN_EXAMPLES)]
pub struct Run {
    /// Name of a case, or a TOML file that describes one.
    #[arg(value_name = "CASE|FILE.toml")]
    pub target: String,
    /// How much the case may cost [default: the file's, else quick].
    #[arg(long, value_enum)]
    pub tier: Option<Tier>,
    /// Change one parameter; may be repeated.
    #[arg(long = "set", value_name = "path=value")]
    pub settings: Vec<String>,
    /// Folder to write [default: reports/runs/CASE-TIER].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Print metrics.json on standard output, and nothing else there.
    #[arg(long)]
    pub json: bool,
    /// How to compute.
    #[command(flatten)]
    pub work: Work,
}

/// `bagnold report`
#[derive(Debug, Args)]
#[command(after_help = REPORT_EXAMPLES)]
pub struct Report {
    /// How much each case may cost.
    #[arg(long, value_enum, default_value_t = Tier::Quick)]
    pub tier: Tier,
    /// Cases by name, separated by commas [default: all].
    #[arg(long, value_name = "CASE,…", value_delimiter = ',')]
    pub cases: Vec<String>,
    /// Folder to write.
    #[arg(long, value_name = "DIR", default_value = "reports")]
    pub out: PathBuf,
    /// Make these results the baseline that later reports and tests are compared with.
    #[arg(long)]
    pub update_baseline: bool,
    /// How to compute.
    #[command(flatten)]
    pub work: Work,
}

/// Options of everything that simulates.
#[derive(Debug, Args)]
pub struct Work {
    /// Threads to use [default: all cores].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Simulate even what is stored from an earlier run of the same program.
    #[arg(long)]
    pub fresh: bool,
    /// Folder of stored results [default: $BAGNOLD_STORE, else reports/store of the workspace].
    #[arg(long, value_name = "DIR")]
    pub store: Option<PathBuf>,
}

#[cfg(test)]
mod tests {
    use super::Arguments;
    use clap::CommandFactory;

    #[test]
    fn the_arguments_are_consistent() {
        Arguments::command().debug_assert();
    }
}
