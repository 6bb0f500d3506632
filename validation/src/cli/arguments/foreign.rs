//! Commands that deal with other codes.

use super::{ExecutionOptions, FigureOptions, Tier};
use clap::Args;
use std::path::PathBuf;

const JUDGE_EXAMPLES: &str = "Examples:
  bagnold judge --template column-planar > mine.toml    a commented file to fill in
  bagnold judge mine.toml                               your code and ours, judged by the same gates
  bagnold judge mine.toml theirs.toml --out compared    several codes in one table

A submission names case, code and runs. Data of a run are particles at several times (tables or VTK), time series, a profile or numbers.
Metrics are computed from these data as from our own runs. A metric without data is \"not judged\" and neither passes nor fails.
The output folder receives index.html, metrics.json, figures/ and tables/.

Exit codes: 0 all gates with data pass, 1 a gate fails or no gate has data, 2 bad input, 3 a Bagnold run diverged.";

const LEAGUE_EXAMPLES: &str = "Examples:
  bagnold league                                        the stored results of other codes, on one page
  bagnold league my-codes --out compared                the results in your folder

The page has a row per code and a column per case, and for each case all metrics with the distance from their reference.
For three or more codes with one law, the page also shows the standard deviation of their results and the limit.
The output folder also receives an archive of each submission, CODE-CASE.tar.

Exit codes: 0 all results judged, whatever the verdicts, 2 bad input, 3 a Bagnold run diverged.";

const EXPORT_EXAMPLES: &str = "Examples:
  bagnold export column-planar --out for-my-code
  bagnold export bagnold --tier paper --out for-my-code
  bagnold export film --for openfoam --out film         also writes deck/run.sh and its submission.toml

The output folder receives case.toml (geometry, material), boundary.csv and start.csv (boundary and initial conditions of each run).
It also receives reference/ (exact and measured curves), definitions.md (laws, limits) and submission.toml for `bagnold judge`.
--simulate adds particles/ (initial particles as CSV and VTU) and bagnold/ (profiles and histories).";

/// `bagnold judge`
#[derive(Debug, Args)]
#[command(after_help = JUDGE_EXAMPLES)]
pub struct JudgeArguments {
    /// Submissions, one TOML file per code.
    #[arg(value_name = "FILE.toml", required_unless_present = "template")]
    pub files: Vec<PathBuf>,
    /// Print a commented submission file for this case, to fill in.
    #[arg(long, value_name = "CASE", conflicts_with_all = ["files", "out", "junit"])]
    pub template: Option<String>,
    /// Resolution and run time of the runs in the printed submission.
    #[arg(long, value_enum, default_value_t = Tier::Quick, requires = "template")]
    pub tier: Tier,
    /// Output folder [default: reports/judged/CASE].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Also write the verdicts as JUnit XML, one suite per code.
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// Size of figures.
    #[command(flatten)]
    pub figures: FigureOptions,
    /// Execution options.
    #[command(flatten)]
    pub work: ExecutionOptions,
}

/// `bagnold league`
#[derive(Debug, Args)]
#[command(after_help = LEAGUE_EXAMPLES)]
pub struct LeagueArguments {
    /// Folder with one submission per code and case, CODE/CASE/submission.toml [default: validation/league of the checkout].
    pub folder: Option<PathBuf>,
    /// Output folder.
    #[arg(long, value_name = "DIR", default_value = "reports/league")]
    pub out: PathBuf,
    /// Execution options.
    #[command(flatten)]
    pub work: ExecutionOptions,
}

/// `bagnold export`
#[derive(Debug, Args)]
#[command(after_help = EXPORT_EXAMPLES)]
pub struct ExportArguments {
    /// Name of a case, see `bagnold list`.
    pub case: String,
    /// Resolution and run time of the runs.
    #[arg(long, value_enum, default_value_t = Tier::Quick)]
    pub tier: Tier,
    /// Output folder.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Also write the deck of this code with run.sh: openfoam, gerris, dualsphysics, lammps, newton or yade.
    #[arg(long = "for", value_name = "CODE")]
    pub code: Option<String>,
    /// Also simulate the case, to add the initial particles and the results of Bagnold
    #[arg(long)]
    pub simulate: bool,
    /// Execution options.
    #[command(flatten)]
    pub work: ExecutionOptions,
}

const GRAINS_EXAMPLES: &str = "Examples:
  bagnold examples
  bagnold grains examples/grains/slopes.toml --out slopes
  bagnold calibrate examples/grains/law.toml --out law      fit a law to slopes/points.csv

A plan lists runs with their geometry, files and columns; see examples/grains/slopes.toml and `bagnold schema grains`.
The output folder receives fields-1.csv, fields-2.csv, …, points.csv and figures/.";

/// `bagnold grains`
#[derive(Debug, Args)]
#[command(after_help = GRAINS_EXAMPLES)]
pub struct GrainsArguments {
    /// TOML file that lists the runs of the DEM code with their dump files and columns.
    #[arg(value_name = "FILE.toml")]
    pub file: PathBuf,
    /// Output folder [default: reports/grains/FILE].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Size of figures.
    #[command(flatten)]
    pub figures: FigureOptions,
}

const COMPARE_EXAMPLES: &str = "Examples:
  bagnold run bagnold --out before
  bagnold run bagnold --set numerics.hourglass=0.1 --out after
  bagnold compare before after --out compared
  bagnold compare report-of-may reports --out compared     compare the numbers of two reports

For folders of `bagnold run`, the command draws profiles and histories into one figure; for reports, it compares numbers.
The output folder receives index.html, differences.json and figures/.

Exit codes: 0 compared, 1 with --deny-differences if a number differs by more than its tolerance, 2 bad input.";

/// `bagnold compare`
#[derive(Debug, Args)]
#[command(after_help = COMPARE_EXAMPLES)]
pub struct CompareArguments {
    /// Folders of `bagnold run` or `bagnold report`; the first is the reference.
    #[arg(value_name = "DIR", required = true, num_args = 2..)]
    pub folders: Vec<PathBuf>,
    /// Output folder.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// End with exit code 1 if a number differs by more than its tolerance.
    #[arg(long)]
    pub deny_differences: bool,
    /// Also compare results whose gates have different limits.
    #[arg(long)]
    pub across_gates: bool,
}
