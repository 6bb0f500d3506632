//! What can be typed: the commands, their options and their help.

mod examples;
mod foreign;

pub(super) use examples::Examples;
pub(super) use foreign::{Compare, Export, Judge};

use crate::case::Tier;
use clap::{ArgAction, Args, Parser, Subcommand};
use std::path::PathBuf;
use std::time::Duration;

const EXAMPLES: &str = "Examples:
  bagnold list                                 what can be run
  bagnold run film                             one case, in seconds
  bagnold run bagnold --tier paper --threads 4 the same at full resolution
  bagnold show film > my.toml                  parameters to edit
  bagnold run my.toml --out results            run the edited file
  bagnold report                               all cases, judged on one page: reports/index.html
  bagnold judge mine.toml                      another code's results under the same gates
  bagnold examples --out examples              calibrations and sweeps to begin with

Exit codes: 0 all gates hold, 1 a gate fails, 2 bad input, 3 a run diverged.";

const RUN_EXAMPLES: &str = "Examples:
  bagnold run film
  bagnold run bagnold --tier paper --out results/bagnold
  bagnold run my.toml --set resolution=30 --set numerics.hourglass=0.1
  bagnold run column-planar --only material=sand,aspect_ratio=3
  bagnold run film --json > metrics.json
  bagnold run film --overlay mine.csv

A file names its case with `case = \"film\"` and takes from the tier what it leaves out; `bagnold show film`
prints a complete one. Values of --set are TOML; fields inside tables are reached by dots.

Measurements for --overlay are a table of three columns, named as the axes of a figure are, with units:

  # source: own flume, May
  # limit: 2                       largest root mean square residual; without it nothing is judged
  y/h [-],u [cm/s],uncertainty [cm/s]
  0.3,8.6,0.3

`# figure:`, `# panel:` and `# curve:` say which is meant where there are several. The folder receives index.html, case.toml, metrics.json, provenance.json, tables/*.csv, reference/*.csv, figures/ and
snapshots/*.pvd for ParaView.

Exit codes: 0 all gates hold, 1 a gate fails, 2 bad input, 3 a run diverged.";

const REPORT_EXAMPLES: &str = "Examples:
  bagnold report
  bagnold report --tier paper --cases film,bagnold --out paper-report
  bagnold report --against yesterday --deny drift

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

const SWEEP_EXAMPLES: &str = "Examples:
  bagnold sweep viscosity.toml --out viscosity        here
  bagnold sweep viscosity.toml --out /shared/viscosity --engine slurm --partition short --time 00:30:00 --throttle 50
  bagnold sweep collect /shared/viscosity --resubmit

A file that varies the viscosity of a film over a grid:

  design = \"grid\"   # or design.sobol = { points = 64, seed = 1 }, design.latin_hypercube = { … }

  [[cases]]
  case = \"film\"
  with = { fluids = [\"newtonian\"], resolution = 10 }

  [[parameters]]
  path = \"newtonian.viscosity\"
  values = [0.5, 1.0, 2.0]         # or lower, upper, levels, scale = \"log\"

The folder receives manifest.json, runs/NNNN-CASE/, results.csv (one line a metric), failures.csv and figures/.

Exit codes: 0 every run has numbers, 1 some are missing, 2 bad input, 3 some failed (see failures.csv).";

const MUTATE_EXAMPLES: &str = "Examples:
  cargo run --package bagnold-validation --features planted-errors -- mutate
  bagnold mutate list                                    the errors, and the cases that ought to see them
  bagnold mutate --errors von-karman,gravity-value       some of them
  bagnold mutate trial von-karman clear-water            one case with one error, as `bagnold run` shows it

Needs a program built with the feature planted-errors; one built without has no errors in it. Each error is
caught by a gate that held without it, by a run that stops, only by the snapshot of accepted values, or by nothing.

Exit codes: 0 enough errors are caught, and by gates; 1 too few; 2 bad input, or a program without errors.";

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
    /// Print the JSON Schema of a case's TOML file, with which editors complete and check it.
    Schema(Show),
    /// Simulate one case and judge it.
    Run(Run),
    /// Judge other codes' results on a case as our own are judged.
    Judge(Judge),
    /// Write what another code needs to run a case.
    Export(Export),
    /// Put results that were written earlier beside each other.
    Compare(Compare),
    /// Write the calibrations and sweeps that ship with bagnold, to run or to edit.
    Examples(Examples),
    /// Print a shell's completions, or the manual page.
    Completions(Completions),
    /// Simulate many cases and write one page about them.
    Report(Report),
    /// Find the parameters that agree best with data, and judge them on data held out.
    Calibrate(Calibrate),
    /// Simulate cases at many points of their parameters, here or on a cluster.
    Sweep(Box<Sweep>),
    /// Run every case for a moment and compare the final states with the committed hashes, bit by bit.
    Verify(Verify),
    /// List what is stored, or delete what is old or too much of it.
    Store(Store),
    /// Plant errors in the solver, one at a time, and say which gates notice.
    Mutate(Mutate),
}

/// `bagnold show` and `bagnold schema`
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
    /// Do the runs with these keys only, such as material=sand,aspect_ratio=3; may be repeated.
    #[arg(long, value_name = "key=value,…")]
    pub only: Vec<crate::metric::Variant>,
    /// Draw measurements into the case's figure with their axes, and say how far the case is from them; may be repeated.
    #[arg(long, value_name = "FILE.csv")]
    pub overlay: Vec<PathBuf>,
    /// Folder to write [default: reports/runs/CASE-TIER].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Print metrics.json on standard output, and nothing else there.
    #[arg(long)]
    pub json: bool,
    /// Write the verdicts as JUnit's XML as well, for CI systems: one test a gate.
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// How much it may ask for.
    #[command(flatten)]
    pub allowance: Allowance,
    /// How to compute.
    #[command(flatten)]
    pub work: Work,
}

/// `bagnold completions`
#[derive(Debug, Args)]
#[command(after_help = "Examples:
  bagnold completions bash > ~/.local/share/bash-completion/completions/bagnold
  bagnold completions man > ~/.local/share/man/man1/bagnold.1")]
pub struct Completions {
    /// For what.
    #[arg(value_enum)]
    pub of: CompletionsOf,
}

/// What can be printed for a shell.
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
    /// Accept these values: later reports and the drift test are compared with them. They go to tests/snapshots of the
    /// checkout that one works in, else to snapshots in the current folder, which goes before what bagnold carries.
    #[arg(long)]
    pub accept: bool,
    /// Compare with an earlier report's folder instead of the accepted values.
    #[arg(long, value_name = "DIR", conflicts_with = "accept")]
    pub against: Option<PathBuf>,
    /// End with exit code 1 for this as well.
    #[arg(long, value_enum, value_name = "WHAT", conflicts_with = "accept")]
    pub deny: Option<Denied>,
    /// Write the verdicts as JUnit's XML as well, for CI systems: one test a gate.
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// How much it may ask for.
    #[command(flatten)]
    pub allowance: Allowance,
    /// How to compute.
    #[command(flatten)]
    pub work: Work,
}

/// What a report may be asked not to let pass.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Denied {
    /// A value that has left the tolerance about what it is compared with, or is no longer measured.
    Drift,
}

/// `bagnold calibrate`
#[derive(Debug, Args)]
#[command(after_help = CALIBRATE_EXAMPLES)]
pub struct Calibrate {
    /// TOML file that says which parameters, which cases and which data.
    #[arg(value_name = "FILE.toml")]
    pub file: PathBuf,
    /// Folder to write [default: reports/calibrations/FILE].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Open a calibration that is done again; an unfinished one goes on by itself.
    #[arg(long)]
    pub resume: bool,
    /// How to compute.
    #[command(flatten)]
    pub work: Work,
}

/// `bagnold sweep`
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true, after_help = SWEEP_EXAMPLES)]
pub struct Sweep {
    /// What to do with a sweep that was begun.
    #[command(subcommand)]
    pub action: Option<SweepAction>,
    /// TOML file that says which cases, which parameters and which points.
    #[arg(value_name = "FILE.toml", required = true)]
    pub file: Option<PathBuf>,
    /// Folder of the sweep [default: reports/sweeps/FILE].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Open a sweep that is done again; an unfinished one goes on by itself.
    #[arg(long)]
    pub resume: bool,
    /// What runs it.
    #[arg(long, value_enum, default_value_t = Engine::Local)]
    pub engine: Engine,
    /// What to ask of Slurm.
    #[command(flatten)]
    pub cluster: Cluster,
    /// How to compute.
    #[command(flatten)]
    pub work: Work,
}

/// What runs a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Engine {
    /// The threads of this machine.
    Local,
    /// A Slurm cluster that shares the sweep's folder: one task a run.
    Slurm,
}

/// What to do with a sweep that was begun.
#[derive(Debug, Subcommand)]
pub enum SweepAction {
    /// Gather the results of a sweep, and submit again what is missing.
    Collect {
        /// Folder of the sweep.
        #[arg(value_name = "DIR")]
        folder: PathBuf,
        /// Submit to Slurm again what is neither done nor queued.
        #[arg(long)]
        resubmit: bool,
        /// What to ask of Slurm.
        #[command(flatten)]
        cluster: Cluster,
    },
    /// Run one entry of a sweep's manifest, as the tasks of a cluster do.
    Task {
        /// Folder of the sweep.
        #[arg(value_name = "DIR")]
        folder: PathBuf,
        /// Number of the entry, from 1.
        #[arg(long, value_name = "N")]
        entry: usize,
        /// How to compute.
        #[command(flatten)]
        work: Work,
    },
    /// Print the Slurm script that ships with bagnold, to be edited for --template.
    Template,
}

/// `bagnold verify`
#[derive(Debug, Args)]
#[command(after_help = "Exit codes: 0 the same bits, 1 other bits, 2 bad input.")]
pub struct Verify {
    /// List of short runs to use instead of the committed one.
    #[arg(long, value_name = "FILE.toml")]
    pub file: Option<PathBuf>,
    /// Write the list with the hashes of this program.
    #[arg(long, value_name = "FILE.toml")]
    pub write: Option<PathBuf>,
}

/// `bagnold store`
#[derive(Debug, Args)]
pub struct Store {
    /// What to do.
    #[command(subcommand)]
    pub action: StoreAction,
    /// Folder of stored results [default: $BAGNOLD_STORE, else reports/store of the checkout
    /// that one works in, else the user's cache].
    #[arg(long, value_name = "DIR", global = true)]
    pub store: Option<PathBuf>,
}

/// What to do with stored results.
#[derive(Debug, Clone, Copy, Subcommand)]
pub enum StoreAction {
    /// List the versions of the program that have results, with number, size and age.
    List,
    /// Delete entries, the oldest first.
    #[command(group = clap::ArgGroup::new("limit").required(true).multiple(true))]
    Prune {
        /// Delete what is older.
        #[arg(long, value_name = "DAYS", value_parser = positive, group = "limit")]
        days: Option<f64>,
        /// Delete the oldest until the rest is no larger.
        #[arg(long, value_name = "GIB", value_parser = positive, group = "limit")]
        size: Option<f64>,
    },
}

/// `bagnold mutate`
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, after_help = MUTATE_EXAMPLES)]
pub struct Mutate {
    /// What to do instead of trying errors.
    #[command(subcommand)]
    pub action: Option<MutateAction>,
    /// Errors by name, separated by commas [default: all].
    #[arg(long, value_name = "ERROR,…", value_delimiter = ',')]
    pub errors: Vec<String>,
    /// Folder to write.
    #[arg(long, value_name = "DIR", default_value = "reports/mutation")]
    pub out: PathBuf,
    /// Threads to use [default: all cores].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}

/// What `bagnold mutate` does beside trying errors.
#[derive(Debug, Subcommand)]
pub enum MutateAction {
    /// List the errors and the cases that ought to see them.
    List,
    /// Plant one error and run one case at the quick tier; the store is neither read nor written.
    Trial {
        /// Name of the error, or `none`.
        error: String,
        /// Name of the case.
        case: String,
        /// Change one parameter; may be repeated.
        #[arg(long = "set", value_name = "path=value")]
        settings: Vec<String>,
        /// File to write what the case said to, as `bagnold mutate` reads it, instead of printing it.
        #[arg(long, value_name = "FILE")]
        result: Option<PathBuf>,
        /// Threads to use [default: all cores].
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
        threads: Option<u16>,
    },
}

/// What to ask of Slurm.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Slurm")]
pub struct Cluster {
    /// Partition [default: the cluster's].
    #[arg(long, value_name = "NAME")]
    pub partition: Option<String>,
    /// Time limit of one run, such as 01:30:00.
    #[arg(long, value_name = "TIME")]
    pub time: Option<String>,
    /// Memory of one run, such as 2G.
    #[arg(long, value_name = "SIZE")]
    pub memory: Option<String>,
    /// Cores of one run [default: 1].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub cpus: Option<u16>,
    /// Runs at the same time, at most.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub throttle: Option<u32>,
    /// Job script to use instead of the one that `bagnold sweep template` prints.
    #[arg(long, value_name = "FILE")]
    pub template: Option<PathBuf>,
}

/// How much runs may ask for; more is refused before anything is allocated.
#[derive(Debug, Clone, Copy, Default, Args)]
pub struct Allowance {
    /// Memory that the runs may ask for [default: $BAGNOLD_MOST_MEMORY, else that of the machine].
    #[arg(long, value_name = "GIB", value_parser = positive)]
    pub most_memory: Option<f64>,
    /// Hours of one core that the runs of a case may ask for [default: $BAGNOLD_MOST_HOURS, else 10000].
    #[arg(long, value_name = "HOURS", value_parser = positive)]
    pub most_hours: Option<f64>,
}

fn positive(text: &str) -> Result<f64, String> {
    let number = text.parse::<f64>().ok().filter(|number| *number > 0.0);
    number.ok_or_else(|| "must be a positive number".to_owned())
}

/// Options of everything that simulates.
#[derive(Debug, Args)]
pub struct Work {
    /// Threads to use [default: all cores].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
    /// Simulate even what is stored or unfinished from an earlier run of the same program.
    #[arg(long)]
    pub fresh: bool,
    /// Seconds between two checkpoints of a run [default: 60, up to 120 where one costs over 1 %].
    #[arg(long, value_name = "SECONDS", value_parser = seconds)]
    pub checkpoint_interval: Option<Duration>,
    /// Folder of stored results [default: $BAGNOLD_STORE, else reports/store of the checkout
    /// that one works in, else the user's cache].
    #[arg(long, value_name = "DIR")]
    pub store: Option<PathBuf>,
}

/// A time of an argument.
fn seconds(text: &str) -> Result<Duration, String> {
    let rule = "must be a number of seconds from 0 to 1e6, such as 60";
    let seconds: f64 = text.parse().map_err(|_| rule.to_owned())?;
    if (0.0..=1e6).contains(&seconds) { Ok(Duration::from_secs_f64(seconds)) } else { Err(rule.to_owned()) }
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
