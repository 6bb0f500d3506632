//! Command-line arguments: the commands, their options and their help.

mod examples;
mod foreign;
mod new;
mod sweep;
pub(super) mod upkeep;
mod work;

pub(super) use examples::ExamplesArguments;
pub(super) use foreign::{CompareArguments, ExportArguments, JudgeArguments};
#[cfg(test)]
pub(super) use new::Named;
pub(super) use new::{NewArguments, NewCrate};
pub(super) use sweep::{Cluster, Engine, SweepAction, SweepArguments};
pub(super) use upkeep::{
    ControlsArguments, DevCommand, MutateArguments, SensitivitiesArguments, StoreAction, StoreArguments,
    VerifyArguments,
};
pub(super) use work::{ExecutionOptions, FigureOptions, ResourceLimits};

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
  bagnold judge mine.toml                      another code's results under the same gates
  bagnold examples --out examples              calibrations, scenes, sweeps to begin with

Exit codes: 0 all gates hold, 1 a gate fails, 2 bad input, 3 a run diverged.";

const RUN_EXAMPLES: &str = "Examples:
  bagnold run film
  bagnold run bagnold --tier paper --out results/bagnold
  bagnold run my.toml --set resolution=30 --set numerics.hourglass=0.1
  bagnold run column-planar --only material=sand,aspect_ratio=3
  bagnold run film --json > metrics.json
  bagnold run film --overlay mine.csv
  bagnold run column-planar --only material=sand,aspect_ratio=3 --output-every 0.01
  bagnold run my-study.toml

A file names its case with `case = \"film\"` and takes from the tier what it leaves out; `bagnold show film`
prints a complete one. Values of --set are TOML; fields inside tables are reached by dots.

Measurements for --overlay are a table of three columns, named as the axes of a figure are, with units:

  # source: own flume, May
  # limit: 2                       largest root mean square residual; without it nothing is judged
  y/h [-],u [cm/s],uncertainty [cm/s]
  0.3,8.6,0.3

A study, a file with `study = \"NAME\"`, says beside its base what is measured and judged:

  study = \"my-flume\"
  summary = \"glass beads in my flume\"
  base = \"flume.toml\"
  [[checks]]
  name = \"front_over_time\"
  table = \"gauges\"                 of the tables/*.csv that the base writes
  column = \"front: front [m]\"
  compare = \"mine.csv\"
  at_most = 2.0
  reason = \"two standard uncertainties of the camera\"

`# figure:`, `# panel:` and `# curve:` say which is meant where there are several. --output-every, or in a file
[output] with every and fields, writes states/RUN.pvd and states/RUN-walls.pvd; such runs are simulated from their start.
The folder receives index.html, case.toml, metrics.json, provenance.json, tables/*.csv, reference/*.csv, figures/ and
snapshots/*.pvd for ParaView.

Exit codes: 0 all gates hold, 1 a gate fails, 2 bad input, 3 a run diverged.";

const REPORT_EXAMPLES: &str = "Examples:
  bagnold report
  bagnold report --tier paper --cases film,bagnold --out paper-report
  bagnold report --against yesterday --deny drift
  bagnold report --figure 85mm,9pt,300dpi      figures for a column of a journal
  bagnold report --suite my-flume

The report is one self-contained folder: open its index.html, which leads to a page of every case. What fails comes first.

Exit codes: 0 all gates hold, 1 a gate fails or, with --deny drift, a value has drifted, 2 bad input, 3 a run diverged.";

const CALIBRATE_EXAMPLES: &str = "Examples:
  bagnold examples --out examples
  bagnold calibrate examples/calibrations/lube-run-out.toml
  bagnold calibrate my.toml --out mine
  bagnold run mine/calibrated.toml

A file with one parameter and one fitted datum; [[hold_out]] has the form of [[fit]]:

  title = \"static friction of our sand\"

  [[parameters]]
  path = \"sand.law.static_friction\"
  lower = 0.4
  upper = 0.8

  [[fit]]
  case = \"column-planar\"
  with = { sand = { aspect_ratios = [0.9] } }
  data = [{ metric = \"run_out\", variant = \"material=sand,aspect_ratio=0.9,resolution=20\",
            value = 1.2, unit = \"-\", uncertainty = 0.1, source = \"own, May\" }]

data may also name a CSV: { table = \"profile-…\", x = \"y [m]\", y = \"u [m/s]\", file = \"mine.csv\" }.
The folder receives index.html, figures/, result.json, data.csv, evaluations.csv and calibrated.toml.";

/// Granular and sediment flows by smoothed particle hydrodynamics, judged against exact solutions and experiments.
#[derive(Debug, Parser)]
#[command(name = "bagnold", version, after_help = EXAMPLES, propagate_version = true)]
pub struct Arguments {
    /// Command.
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
    Show(ShowArguments),
    /// Print the JSON Schema of a case's TOML file, or of a study's, with which editors complete and check it.
    Schema(SchemaArguments),
    /// Simulate one case and judge it.
    Run(RunArguments),
    /// Judge other codes' results on a case as our own are judged.
    Judge(JudgeArguments),
    /// Write what another code needs to run a case.
    Export(ExportArguments),
    /// Put results that were written earlier beside each other.
    Compare(CompareArguments),
    /// Write the calibrations, scenes, studies and sweeps that ship with bagnold, to run or to edit.
    Examples(ExamplesArguments),
    /// Write a crate with a law or a case of your own, ready to build.
    New(NewArguments),
    /// Print a shell's completions, or the manual page.
    Completions(CompletionsArguments),
    /// Simulate many cases and write one page about them.
    Report(ReportArguments),
    /// Find the parameters that agree best with data, and judge them on data held out.
    Calibrate(CalibrateArguments),
    /// Simulate cases at many points of their parameters, here or on a cluster.
    Sweep(Box<SweepArguments>),
    /// List what is stored, or delete what is old or too much of it.
    Store(StoreArguments),
    /// Check bits, gates and sensitivity tables of Bagnold itself, for its developers.
    #[command(subcommand)]
    Dev(DevCommand),
}

/// `bagnold schema`
#[derive(Debug, Args)]
pub struct SchemaArguments {
    /// Name of a case, see `bagnold list`, or `study` for the file of a study.
    #[arg(value_name = "CASE|study")]
    pub case: String,
    /// Tier whose parameters are a case's defaults.
    #[arg(long, value_enum, default_value_t = Tier::Quick)]
    pub tier: Tier,
}

/// `bagnold show`
#[derive(Debug, Args)]
pub struct ShowArguments {
    /// Name of a case, see `bagnold list`; with --picture also a TOML file that describes one.
    #[arg(value_name = "CASE|FILE.toml")]
    pub case: String,
    /// Tier: the cost of the case [default: the file's, else quick].
    #[arg(long, value_enum)]
    pub tier: Option<Tier>,
    /// Draw a scene as it starts instead, with what its walls take of its bodies; no simulation.
    #[arg(long, value_name = "FILE.png|FILE.svg")]
    pub picture: Option<PathBuf>,
}

/// `bagnold run`
#[derive(Debug, Args)]
#[command(after_help = RUN_EXAMPLES)]
pub struct RunArguments {
    /// Name of a case, or a TOML file that describes one or a study.
    #[arg(value_name = "CASE|FILE.toml")]
    pub target: String,
    /// Tier: the cost of the case [default: the file's, else quick].
    #[arg(long, value_enum)]
    pub tier: Option<Tier>,
    /// Change one parameter; may be repeated.
    #[arg(long = "set", value_name = "path=value")]
    pub settings: Vec<String>,
    /// Do the runs with these keys only, such as material=sand,aspect_ratio=3; may be repeated.
    #[arg(long, value_name = "key=value,…")]
    pub only: Vec<crate::metric::Variant>,
    /// Draw measurements into the case's figure with their axes, and say how far the case is from them; may be repeated.
    #[arg(long, value_name = "FILE.csv")]
    pub overlay: Vec<PathBuf>,
    /// Write the particles of every run at this interval of simulated time, for ParaView: states/*.pvd.
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true)]
    pub output_every: Option<f64>,
    /// Fields of the particles to write, such as id,velocity,shear_rate,inertial_number [default: all].
    #[arg(long, value_name = "FIELD,…", value_delimiter = ',', requires = "output_every")]
    pub output_fields: Vec<String>,
    /// Folder to write [default: reports/runs/CASE-TIER].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Print metrics.json on standard output, and nothing else there.
    #[arg(long)]
    pub json: bool,
    /// Write the verdicts as JUnit's XML as well, for CI systems: one test per gate.
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// Say on standard error where the time went: stages, the longest runs, memory.
    #[arg(long)]
    pub profile: bool,
    /// Size of figures.
    #[command(flatten)]
    pub figures: FigureOptions,
    /// Resource limits.
    #[command(flatten)]
    pub allowance: ResourceLimits,
    /// Execution options.
    #[command(flatten)]
    pub work: ExecutionOptions,
}

/// `bagnold completions`
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  bagnold completions bash > ~/.local/share/bash-completion/completions/bagnold
  bagnold completions man > ~/.local/share/man/man1/bagnold.1")]
pub struct CompletionsArguments {
    /// For what.
    #[arg(value_enum)]
    pub of: CompletionsOf,
}

/// Text to print for a shell.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum CompletionsOf {
    /// Bash.
    Bash,
    /// Zsh.
    Zsh,
    /// Fish.
    Fish,
    /// The manual page, in troff.
    Man,
}

/// `bagnold report`
#[derive(Debug, Args)]
#[command(after_help = REPORT_EXAMPLES)]
pub struct ReportArguments {
    /// Tier: the cost of each case [default: quick, or the study's].
    #[arg(long, value_enum)]
    pub tier: Option<Tier>,
    /// Cases by name, separated by commas [default: all].
    #[arg(long, value_name = "CASE,…", value_delimiter = ',')]
    pub cases: Vec<String>,
    /// A folder of studies of your own, in place of the cases.
    #[arg(long, value_name = "DIR", conflicts_with = "cases")]
    pub suite: Option<PathBuf>,
    /// Folder to write [default: reports, or reports/suites/NAME].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Accept these values: later reports and the drift test are compared with them. They go to tests/snapshots of the
    /// checkout that one works in, else to snapshots in the current folder, which goes before what bagnold carries; those of a
    /// suite to snapshots in its folder.
    #[arg(long)]
    pub accept: bool,
    /// Compare with an earlier report's folder instead of the accepted values.
    #[arg(long, value_name = "DIR", conflicts_with = "accept")]
    pub against: Option<PathBuf>,
    /// End with exit code 1 for this as well.
    #[arg(long, value_enum, value_name = "WHAT", conflicts_with = "accept")]
    pub deny: Option<Denied>,
    /// Write the verdicts as JUnit's XML as well, for CI systems: one test per gate.
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// Say on standard error where the time went: stages, the longest runs, memory.
    #[arg(long)]
    pub profile: bool,
    /// Size of figures.
    #[command(flatten)]
    pub figures: FigureOptions,
    /// Resource limits.
    #[command(flatten)]
    pub allowance: ResourceLimits,
    /// Execution options.
    #[command(flatten)]
    pub work: ExecutionOptions,
}

/// Findings that `--deny` turns into errors.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Denied {
    /// A value that has left the tolerance about what it is compared with, or is no longer measured.
    Drift,
}

/// `bagnold calibrate`
#[derive(Debug, Args)]
#[command(after_help = CALIBRATE_EXAMPLES)]
pub struct CalibrateArguments {
    /// TOML file that says which parameters, which cases and which data.
    #[arg(value_name = "FILE.toml")]
    pub file: PathBuf,
    /// Folder to write [default: reports/calibrations/FILE].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Open a calibration that is done again; an unfinished one resumes without it.
    #[arg(long)]
    pub resume: bool,
    /// Resource limits of the runs at one point.
    #[command(flatten)]
    pub allowance: ResourceLimits,
    /// Execution options.
    #[command(flatten)]
    pub work: ExecutionOptions,
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
