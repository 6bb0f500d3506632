//! Arguments of `store`, and of the commands below `dev`, for the development of Bagnold itself.

use super::work::{ExecutionOptions, ResourceLimits, positive};
use clap::{Args, Subcommand};
use std::path::PathBuf;

const MUTATE_EXAMPLES: &str = "Examples:
  bagnold dev mutate
  bagnold dev mutate list                                the errors, and the cases that ought to see them
  bagnold dev mutate --errors von-karman,gravity-value   some of them
  bagnold dev mutate trial von-karman clear-water        one case with one error, as `bagnold run` shows it
  bagnold dev mutate drawn --count 100 --seed 1          100 errors by rule, drawn from all expressions of the solver

Works in a checkout: a copy of the program, in target/mutations, is built with the errors of
validation/tools/mutations.toml; this program has none of them. Each error is caught by a gate that
held without it, by a run that stops, only by the snapshot of accepted values, or by nothing.

Exit codes: 0 enough errors are caught, and by gates; 1 too few; 2 bad input, or no checkout.";

/// `bagnold dev`
#[derive(Debug, Subcommand)]
pub enum DevCommand {
    /// Run every case for a moment and compare the final states with the committed hashes, bit by bit.
    Verify(VerifyArguments),
    /// Run a case with each input at both ends of its stated range: the table that uncertainties by inputs come from.
    Sensitivities(SensitivitiesArguments),
    /// Try the controls that a report does not run, and renew the tables of what became of them.
    Controls(ControlsArguments),
    /// Put errors into a copy of the solver, one at a time, and say which gates notice.
    Mutate(MutateArguments),
}

/// `bagnold dev verify`
#[derive(Debug, Args)]
#[command(after_help = "Exit codes: 0 the same bits, 1 other bits, 2 bad input.")]
pub struct VerifyArguments {
    /// List of short runs to use instead of the committed one.
    #[arg(long, value_name = "FILE.toml")]
    pub file: Option<PathBuf>,
    /// Write the list with the hashes of this program.
    #[arg(long, value_name = "FILE.toml")]
    pub write: Option<PathBuf>,
}

/// `bagnold dev sensitivities`
#[derive(Debug, Args)]
#[command(
    after_help = "The ranges and their sources stand in reference-data/CASE/uncertainty.toml; the program carries the tables of
validation/harness/sensitivities, from which a report takes the uncertainty by the inputs."
)]
pub struct SensitivitiesArguments {
    /// Name of a case, see `bagnold list`.
    #[arg(value_name = "CASE")]
    pub case: String,
    /// File to write.
    #[arg(long, value_name = "FILE.csv")]
    pub out: PathBuf,
    /// Resource limits.
    #[command(flatten)]
    pub allowance: ResourceLimits,
    /// Threads and store.
    #[command(flatten)]
    pub work: ExecutionOptions,
}

/// `bagnold store`
#[derive(Debug, Args)]
pub struct StoreArguments {
    /// Command.
    #[command(subcommand)]
    pub action: StoreAction,
    /// Folder of stored results [default: $BAGNOLD_STORE, else reports/store of the checkout
    /// that one works in, else the user's cache].
    #[arg(long, value_name = "DIR", global = true)]
    pub store: Option<PathBuf>,
}

/// Action on stored results.
#[derive(Debug, Clone, Copy, Subcommand)]
pub enum StoreAction {
    /// List the versions of the program that have results, with number, size and age.
    List,
    /// Delete entries, the oldest first.
    #[command(group = clap::ArgGroup::new("limit").required(true).multiple(true))]
    Prune {
        /// Delete what is older.
        #[arg(long, value_name = "DAYS", value_parser = positive, allow_negative_numbers = true, group = "limit")]
        days: Option<f64>,
        /// Delete the oldest until the rest is no larger.
        #[arg(long, value_name = "GIB", value_parser = positive, allow_negative_numbers = true, group = "limit")]
        size: Option<f64>,
    },
}

/// `bagnold dev controls`
#[derive(Debug, Args)]
#[command(
    after_help = "Works in a checkout: errors of the solver are tried in the copy that `bagnold dev mutate` builds. The controls stand in
validation/harness/controls/CASE.toml, what became of them in validation/harness/controls/tried/CASE.csv; a report shows both.

Exit codes: 0 written, or the same; 1 other than the tables; 2 bad input, or no checkout."
)]
pub struct ControlsArguments {
    /// Cases by name, separated by commas [default: all].
    #[arg(long, value_name = "CASE,…", value_delimiter = ',')]
    pub cases: Vec<String>,
    /// Compare with the tables instead of writing them.
    #[arg(long)]
    pub check: bool,
    /// Threads and store.
    #[command(flatten)]
    pub work: ExecutionOptions,
}

/// `bagnold dev mutate`
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, after_help = MUTATE_EXAMPLES)]
pub struct MutateArguments {
    /// Action instead of trying errors.
    #[command(subcommand)]
    pub action: Option<MutateAction>,
    /// Errors by name, separated by commas [default: all].
    #[arg(long, value_name = "ERROR,…", value_delimiter = ',')]
    pub errors: Vec<String>,
    /// Only errors found by rule, each of which a gate must kill.
    #[arg(long, conflicts_with = "errors")]
    pub generated: bool,
    /// Only errors that tests must notice: for each element of a paper that rests on tests alone.
    #[arg(long, conflicts_with = "generated")]
    pub tests: bool,
    /// Folder to write.
    #[arg(long, value_name = "DIR", default_value = "reports/mutation")]
    pub out: PathBuf,
    /// Threads to use [default: all cores].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}

const DRAWN_HELP: &str =
    "Rules: + for -, * for /, < for <=, && for ||, a sign or a ! dropped or added, 1 for 0, twice or half of a number,
one term or factor dropped, min for max, [j] for [i], a condition negated. Tests, constants, types and
macros stay as they are. An error that does not compile, or that no case reaches, is replaced by the next.

Cases run the cheapest first, until a gate or a stop has killed the error. The same command continues
after an interruption: findings are kept in target/mutations, by seed and sources.

Exit codes: 0 every error was tried; 2 bad input, or no checkout.";

/// `bagnold dev mutate drawn`
#[derive(Debug, Args)]
#[command(after_help = DRAWN_HELP)]
pub struct DrawnArguments {
    /// Number of errors that compile and are reached.
    #[arg(long, value_name = "N", default_value = "100", value_parser = clap::value_parser!(u16).range(1..=10_000))]
    pub count: u16,
    /// Seed of the draw, decimal or hexadecimal.
    #[arg(long, value_name = "SEED", default_value = "0x22b011ce", value_parser = seed)]
    pub seed: u64,
    /// Run tests with errors that no gate has killed: the solver's unit tests, invariants, convergence, determinism.
    #[arg(long)]
    pub tests: bool,
    /// Folder to write.
    #[arg(long, value_name = "DIR", default_value = "reports/mutation-drawn")]
    pub out: PathBuf,
    /// Threads to use [default: all cores].
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub threads: Option<u16>,
}

fn seed(text: &str) -> Result<u64, String> {
    let number = text.strip_prefix("0x").map_or_else(|| text.parse(), |digits| u64::from_str_radix(digits, 16));
    number.map_err(|_| "must be an integer from 0 to 2^64 - 1, such as 1 or 0x22b011ce".to_owned())
}

/// Actions of `bagnold dev mutate` beside trying errors.
#[derive(Debug, Subcommand)]
pub enum MutateAction {
    /// List the errors and the cases that ought to see them.
    List,
    /// Draw errors by rule, and run each through the cases of the quick tier that reach it.
    Drawn(DrawnArguments),
    /// Run one case at the quick tier with one error; the store is neither read nor written.
    Trial {
        /// Name of the error, or `none`.
        error: String,
        /// Name of the case.
        case: String,
        /// Change one parameter; may be repeated.
        #[arg(long = "set", value_name = "path=value")]
        settings: Vec<String>,
        /// File to write what the case said to, as `bagnold dev mutate` reads it, instead of printing it.
        #[arg(long, value_name = "FILE", hide = true)]
        result: Option<PathBuf>,
        /// Threads to use [default: all cores].
        #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
        threads: Option<u16>,
    },
}
