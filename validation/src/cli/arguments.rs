//! Command-line arguments: the commands, their options and their help.

mod foreign;
mod predict;
mod sweep;
mod work;

pub(super) use foreign::{CompareArguments, ExportArguments, GrainsArguments, JudgeArguments, LeagueArguments};
pub(super) use predict::{BedLoadArguments, CollapseArguments, PredictAction, PredictArguments};
pub(super) use sweep::{Cluster, Engine, SweepAction, SweepArguments};
pub(super) use work::FigureOptions;
pub use work::{ExecutionOptions, ResourceLimits};

use crate::case::Tier;
use clap::{ArgAction, Args, Parser, Subcommand};
use std::path::PathBuf;
use work::positive;

const EXAMPLES: &str = "Examples:
  bagnold list                                 all cases and studies
  bagnold run film                             one case, in seconds
  bagnold run bagnold --tier paper --threads 4 one case at full resolution
  bagnold show film > my.toml                  parameters to edit
  bagnold run my.toml --out results            run the edited file
  bagnold report                               all cases with their verdicts: reports/index.html
  bagnold judge mine.toml                      results of another code, judged by the same gates
  bagnold grains slopes.toml                   grains of a DEM code, averaged to fields and points of a friction law
  bagnold examples                             sample calibrations, scenes, sweeps

Exit codes: 0 all as expected, 1 a new failure, an unexpected pass or a gate not judged, 2 bad input, 3 a run diverged.";

const RUN_EXAMPLES: &str = "Examples:
  bagnold run film
  bagnold run bagnold --tier paper --out results/bagnold
  bagnold run my.toml --set resolution=30 --set numerics.hourglass=0.1
  bagnold run column-planar --only material=sand,aspect_ratio=3
  bagnold run film --json > metrics.json
  bagnold run film --overlay mine.csv
  bagnold run bagnold --panel velocity-profile:a --figure 85mm,9pt,300dpi    one panel at the width of a journal column
  bagnold run column-planar --only material=sand,aspect_ratio=3 --output-every 0.01
  bagnold run my-study.toml
  bagnold run scene.toml --set duration=2.0    continue a finished, shorter run of a scene
  bagnold run tilted.toml --from STATE         start from the state of another run, such as a prepared bed

A longer run of a scene, a collapse or a channel continues a finished one, or prints why it starts from the beginning.
A case file names its case with `case = \"film\"`; fields that it leaves out have the defaults of the tier.
`bagnold show film` prints a complete file. Values of --set are TOML; a dot separates a table from its field.

Columns of an --overlay file have the names and units of a figure's axes; columns of repeats replace an uncertainty.
`# limit:`, needed for a verdict, is the largest rms residual. `# figure:`, `# panel:` and `# curve:` select one of several:

  # source: own flume, May
  # limit: 2
  y/h [-],u [cm/s],uncertainty [cm/s]
  0.3,8.6,0.3

A study is a file with `study = \"NAME\"`. It names a base case and the checks of its results:

  study = \"my-flume\"
  summary = \"glass beads in my flume\"
  base = \"flume.toml\"
  [[checks]]
  name = \"front_over_time\"
  table = \"gauges\"                 # of the tables/*.csv that the base writes
  column = \"front: front [m]\"
  compare = \"mine.csv\"
  at_most = 2.0
  reason = \"two standard uncertainties of the camera\"

--output-every, or [output] with `every` and `fields` in a file, writes states/RUN.pvd and states/RUN-walls.pvd.
Runs with this output always start from the beginning.
The output folder receives index.html, case.toml, metrics.json, provenance.json, tables/*.csv, reference/*.csv and figures/.
It also receives snapshots/*.pvd for ParaView.

Exit codes: 0 all as expected, 1 a new failure, an unexpected pass or a gate not judged, 2 bad input, 3 a run diverged.";

const REPORT_EXAMPLES: &str = "Examples:
  bagnold report
  bagnold report --tier paper --cases film,bagnold --out paper-report
  bagnold report --against yesterday --deny moved
  bagnold report --set material.reference_inertia=0.3      change the parameter in every case that has it
  bagnold report --figure 85mm,9pt,300dpi      figures at the width of a journal column
  bagnold report --suite my-flume

The report is one self-contained folder. Its index.html links to a page of every case; failures come first.

Exit codes: 0 all as expected, 1 a new failure, an unexpected pass or a gate not judged, 2 bad input, 3 a run diverged.
With --deny moved, the exit code is also 1 if a value moved.";

const CALIBRATE_EXAMPLES: &str = "Examples:
  bagnold examples
  bagnold calibrate examples/calibrations/lube-run-out.toml
  bagnold calibrate my.toml --out mine
  bagnold run mine/calibrated.toml

This file fits one parameter to one value; data under [[hold_out]], in the same form, are predicted and not fitted:

  title = \"static friction of our sand\"

  [[parameters]]
  path = \"material.static_friction\"
  lower = 0.4
  upper = 0.8

  [[fit]]
  case = \"column-planar\"
  with = { aspect_ratio = 0.9 }
  data = [{ metric = \"run_out\", variant = \"material=sand,aspect_ratio=0.9,resolution=20\",
            value = 1.2, unit = \"-\", uncertainty = 0.1, source = \"own, May\" }]

`data` may also name a CSV file: { table = \"profile-…\", x = \"y [m]\", y = \"u [m/s]\", file = \"mine.csv\" }.
With `law = \"mu-i\"` instead of `case`, a block fits that law to points (I, mu) without a simulation.
Its data are { file = \"points.csv\" }, as `bagnold grains` writes it; its paths are those of the law, such as \"static_friction\".
The output folder receives index.html, figures/, result.json, data.csv, evaluations.csv and calibrated.toml (law.toml with draws).";

const SHIPPED_EXAMPLES: &str = "Examples:
  bagnold examples
  bagnold calibrate examples/calibrations/mu-i-from-profiles.toml
  bagnold sweep examples/sweeps/bed-load-1d-map.toml

The output folder receives calibrations/*.toml, grains/*.toml and studies/*.toml with their data, scenes/*.toml and sweeps/*.toml.";

const NEW_EXAMPLES: &str = "Examples:
  bagnold new law my-law
  cd my-law
  cargo run -- run film.toml --out film

The crate builds the program bagnold with one more law or case.
It contains the law or case, a test against an exact solution, case files and a README with the next steps.";

/// Simulates granular and sediment flows by smoothed particle hydrodynamics and judges them against exact solutions and experiments.
#[derive(Debug, Parser)]
#[command(name = "bagnold", version, after_help = EXAMPLES, propagate_version = true)]
pub struct Arguments {
    /// Command to run, such as `report`.
    #[command(subcommand)]
    pub command: Command,
    /// Amount of output.
    #[command(flatten)]
    pub verbosity: Verbosity,
}

/// Amount of output on standard error.
#[derive(Debug, Clone, Copy, Args)]
pub struct Verbosity {
    /// Verbose output; repeat (-vv) for debug output.
    #[arg(short, long, global = true, action = ArgAction::Count, conflicts_with = "quiet")]
    pub verbose: u8,
    /// Suppress progress and warnings.
    #[arg(short, long, global = true)]
    pub quiet: bool,
}

/// Commands of `bagnold`.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// List the cases and studies.
    List,
    /// Print the parameters of a case as a TOML file for `run`.
    Show(ShowArguments),
    /// Print the JSON Schema of a case, study or plan, for completion and checks in editors.
    Schema(SchemaArguments),
    /// Simulate one case and judge it.
    Run(RunArguments),
    /// Judge results of other codes by the gates of a case.
    Judge(JudgeArguments),
    /// Judge the stored results of other codes and write one page.
    League(LeagueArguments),
    /// Average the grains of a DEM code to depth profiles and to points of a friction law.
    Grains(GrainsArguments),
    /// Write the inputs that another code needs to run a case.
    Export(ExportArguments),
    /// Compare folders of earlier runs or reports.
    Compare(CompareArguments),
    /// Write sample calibrations, grains, scenes, studies and sweeps into a folder.
    Examples(ExamplesArguments),
    /// Write a crate with a user-defined law or case, ready to build.
    New(NewArguments),
    /// Print shell completions or the manual page.
    Completions(CompletionsArguments),
    /// Simulate all cases and write a validation report.
    Report(ReportArguments),
    /// Fit parameters to data, and compare the prediction with held-out data.
    Calibrate(CalibrateArguments),
    /// Predict the bed load of a flume, or a collapse, with a 95 % interval.
    Predict(PredictArguments),
    /// Simulate cases at many parameter values, locally or on a cluster.
    Sweep(Box<SweepArguments>),
    /// List stored results, or delete old ones.
    Store(StoreArguments),
}

/// `bagnold schema`
#[derive(Debug, Args)]
pub struct SchemaArguments {
    /// Name of a case (see `bagnold list`), or kind of file: `study`, `calibration`, `grains` or `sweep`.
    #[arg(value_name = "CASE|KIND")]
    pub case: String,
    /// Tier that supplies the defaults.
    #[arg(long, value_enum, default_value_t = Tier::Quick)]
    pub tier: Tier,
}

/// `bagnold show`
#[derive(Debug, Args)]
pub struct ShowArguments {
    /// Name of a case (see `bagnold list`), or a case file to complete.
    #[arg(value_name = "CASE|FILE.toml")]
    pub case: String,
    /// Resolution and run time of the case [default: the file's, else quick].
    #[arg(long, value_enum)]
    pub tier: Option<Tier>,
    /// Change one parameter, such as a law; may be repeated.
    #[arg(long = "set", value_name = "path=value")]
    pub settings: Vec<String>,
    /// Draw the initial state of a scene, with the material that its walls remove, without a simulation.
    #[arg(long, value_name = "FILE.png|FILE.svg")]
    pub picture: Option<PathBuf>,
}

/// `bagnold run`
#[derive(Debug, Args)]
#[command(after_help = RUN_EXAMPLES)]
pub struct RunArguments {
    /// Name of a case, or a TOML file of a case or study.
    #[arg(value_name = "CASE|FILE.toml")]
    pub target: String,
    /// Resolution and run time of the case [default: the file's, else quick].
    #[arg(long, value_enum)]
    pub tier: Option<Tier>,
    /// Change one parameter; may be repeated.
    #[arg(long = "set", value_name = "path=value")]
    pub settings: Vec<String>,
    /// Run several values of a parameter instead of the tier's own runs; repeat the option for all combinations.
    #[arg(long, value_name = "path=A,B,C")]
    pub vary: Vec<String>,
    /// Start a scene from the stored state of another run, or from the last state in a folder of results.
    #[arg(long, value_name = "STATE")]
    pub from: Option<PathBuf>,
    /// Select runs by their keys, such as material=sand,aspect_ratio=3; may be repeated.
    #[arg(long, value_name = "key=value,…")]
    pub only: Vec<crate::metric::Variant>,
    /// Draw measurements into the figure with the same axes, and compute the difference; may be repeated.
    #[arg(long, value_name = "FILE.csv")]
    pub overlay: Vec<PathBuf>,
    /// Also draw one panel of a figure as a separate figure, such as deposit:b; may be repeated.
    #[arg(long = "panel", value_name = "FIGURE:LETTER")]
    pub panels: Vec<String>,
    /// Write the particles of every run at this interval of simulated time, for ParaView (states/*.pvd).
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true)]
    pub output_every: Option<f64>,
    /// Particle fields to write, such as id,velocity,shear_rate,inertial_number [default: all].
    #[arg(long, value_name = "FIELD,…", value_delimiter = ',', requires = "output_every")]
    pub output_fields: Vec<String>,
    /// Output folder [default: reports/runs/CASE-TIER].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Print particles, memory and core hours of each run without simulating it.
    #[arg(long, conflicts_with_all = ["json", "junit"])]
    pub estimate: bool,
    /// Print only metrics.json on standard output.
    #[arg(long)]
    pub json: bool,
    /// Also write the verdicts as JUnit XML, one test per gate.
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// Reject input that causes warnings, such as implausible values.
    #[arg(long)]
    pub deny_warnings: bool,
    /// Print wall time, processor time and peak memory on standard error.
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
  mkdir -p ~/.local/share/bash-completion/completions ~/.local/share/man/man1
  bagnold completions bash > ~/.local/share/bash-completion/completions/bagnold
  bagnold completions man > ~/.local/share/man/man1/bagnold.1

New shells complete commands if the package bash-completion is installed; otherwise add this line to ~/.bashrc:
  . ~/.local/share/bash-completion/completions/bagnold
Zsh reads `_bagnold` in a folder of $fpath, fish reads ~/.config/fish/completions/bagnold.fish.
`man bagnold` finds the page if ~/.local/bin is in the PATH.")]
pub struct CompletionsArguments {
    /// Shell, or `man` for the manual page in troff.
    #[arg(value_name = "SHELL", value_parser = ["bash", "zsh", "fish", "man"])]
    pub of: String,
}

/// `bagnold report`
#[derive(Debug, Args)]
#[command(after_help = REPORT_EXAMPLES)]
pub struct ReportArguments {
    /// Resolution and run time of each case [default: quick, or the study's].
    #[arg(long, value_enum)]
    pub tier: Option<Tier>,
    /// Comma-separated names of cases [default: all].
    #[arg(long, value_name = "CASE,…", value_delimiter = ',')]
    pub cases: Vec<String>,
    /// Folder of user-defined studies that replace the cases.
    #[arg(long, value_name = "DIR", conflicts_with = "cases")]
    pub suite: Option<PathBuf>,
    /// Change one parameter of every case that has it; may be repeated.
    #[arg(long = "set", value_name = "path=value", conflicts_with_all = ["accept", "suite"])]
    pub settings: Vec<String>,
    /// Output folder [default: reports, or reports/suites/NAME].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Save these values as the new baseline (tests/snapshots in a checkout, otherwise ./snapshots; for a suite,
    /// snapshots/ in its folder).
    #[arg(long)]
    pub accept: bool,
    /// Compare with the folder of an earlier report instead of the baseline.
    #[arg(long, value_name = "DIR", conflicts_with = "accept")]
    pub against: Option<PathBuf>,
    /// Also end with exit code 1 for this finding.
    #[arg(long, value_enum, value_name = "WHAT", conflicts_with = "accept")]
    pub deny: Option<Denied>,
    /// Also write the verdicts as JUnit XML, one test per gate.
    #[arg(long, value_name = "FILE")]
    pub junit: Option<PathBuf>,
    /// Print wall time, processor time and peak memory on standard error.
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
    /// A value differs from its baseline by more than its tolerance, or is missing.
    Moved,
}

/// `bagnold calibrate`
#[derive(Debug, Args)]
#[command(after_help = CALIBRATE_EXAMPLES)]
pub struct CalibrateArguments {
    /// TOML file with parameters, cases and data.
    #[arg(value_name = "FILE.toml")]
    pub file: PathBuf,
    /// Output folder [default: reports/calibrations/FILE].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Reopen a finished calibration; an unfinished one resumes without this option.
    #[arg(long)]
    pub resume: bool,
    /// Size of figures.
    #[command(flatten)]
    pub figures: FigureOptions,
    /// Resource limits of the runs at one point.
    #[command(flatten)]
    pub allowance: ResourceLimits,
    /// Execution options.
    #[command(flatten)]
    pub work: ExecutionOptions,
}

/// `bagnold examples`
#[derive(Debug, Args)]
#[command(after_help = SHIPPED_EXAMPLES)]
pub struct ExamplesArguments {
    /// Output folder; what an earlier call wrote there is replaced.
    #[arg(long, value_name = "DIR", default_value = "examples")]
    pub out: PathBuf,
}

/// `bagnold new`
#[derive(Debug, Args)]
#[command(after_help = NEW_EXAMPLES)]
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

#[cfg(test)]
mod tests {
    use super::Arguments;
    use clap::CommandFactory;

    #[test]
    fn the_arguments_are_consistent() {
        Arguments::command().debug_assert();
    }
}
