//! Commands that deal with other codes.

use super::{ExecutionOptions, Tier};
use clap::Args;
use std::path::PathBuf;

const JUDGE_EXAMPLES: &str = "Examples:
  bagnold judge --template column-planar > mine.toml    a commented file to fill in
  bagnold judge mine.toml                               your code beside ours, judged by the same gates
  bagnold judge mine.toml theirs.toml --out compared    several codes in one table

A file names the case, the code, its runs, and what there is of each: particles at times (tables of numbers or VTK),
time series, a profile, or single numbers. Measurements are taken from them as from our own runs. What is not given
reads \"not given\" and never passes. The folder receives index.html, metrics.json, figures/ and tables/.

Exit codes: 0 all gates hold that something was given for, 1 one fails, 2 bad input, 3 a run of ours diverged.";

const EXPORT_EXAMPLES: &str = "Examples:
  bagnold export column-planar --out for-my-code
  bagnold export bagnold --tier paper --out for-my-code

The folder receives what another code needs to run the case: case.toml with geometry and material, particles/ with the
initial particles as CSV and VTU, reference/ with the curves to compare with, definitions.md with the exact meaning of
every number, and submission.toml for `bagnold judge`.";

/// `bagnold judge`
#[derive(Debug, Args)]
#[command(after_help = JUDGE_EXAMPLES)]
pub struct JudgeArguments {
    /// Submissions of the codes, one TOML file each.
    #[arg(value_name = "FILE.toml", required_unless_present = "template")]
    pub files: Vec<PathBuf>,
    /// Print a commented submission for a case instead.
    #[arg(long, value_name = "CASE", conflicts_with_all = ["files", "out", "junit"])]
    pub template: Option<String>,
    /// Tier of the submission that is printed.
    #[arg(long, value_enum, default_value_t = Tier::Quick, requires = "template")]
    pub tier: Tier,
    /// Folder to write [default: reports/judged/CASE].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Write the verdicts as JUnit's XML as well: a suite for each code.
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// Execution options.
    #[command(flatten)]
    pub work: ExecutionOptions,
}

/// `bagnold export`
#[derive(Debug, Args)]
#[command(after_help = EXPORT_EXAMPLES)]
pub struct ExportArguments {
    /// Name of a case.
    pub case: String,
    /// Tier of its runs.
    #[arg(long, value_enum, default_value_t = Tier::Quick)]
    pub tier: Tier,
    /// Folder to write.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Execution options.
    #[command(flatten)]
    pub work: ExecutionOptions,
}

const COMPARE_EXAMPLES: &str = "Examples:
  bagnold run bagnold --out before
  bagnold run bagnold --set numerics.hourglass=0.1 --out after
  bagnold compare before after --out compared
  bagnold compare report-of-may reports --out compared     two reports, number by number

Folders of `bagnold run` have their profiles and histories drawn into one figure; of reports the numbers are compared.
The folder receives index.html, differences.json and figures/.

Exit codes: 0 compared, 1 with --deny-differences if a number differs by more than its tolerance, 2 bad input.";

/// `bagnold compare`
#[derive(Debug, Args)]
#[command(after_help = COMPARE_EXAMPLES)]
pub struct CompareArguments {
    /// Folders of `bagnold run` or `bagnold report`, of which the first is what the others are compared with.
    #[arg(value_name = "DIR", required = true, num_args = 2..)]
    pub folders: Vec<PathBuf>,
    /// Folder to write.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// End with exit code 1 if a number differs by more than its tolerance.
    #[arg(long)]
    pub deny_differences: bool,
}
