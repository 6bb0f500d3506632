//! Arguments of `bagnold sweep`.

use super::{ExecutionOptions, ResourceLimits};
use clap::{Args, Subcommand};
use std::path::PathBuf;

const SWEEP_EXAMPLES: &str = "Examples:
  bagnold sweep viscosity.toml --out viscosity        on this machine
  bagnold sweep viscosity.toml --out /shared/viscosity --engine slurm --partition short --time 00:30:00 --throttle 50
  bagnold sweep collect /shared/viscosity --resubmit

This file varies the viscosity of a film over a grid:

  design = \"grid\"   # or design.sobol = { points = 64, seed = 1 }, design.latin_hypercube = { … }

  [[cases]]
  case = \"film\"
  with = { resolution = 10 }

  [[vary]]
  path = \"material.viscosity\"
  values = [0.5, 1.0, 2.0]         # or lower, upper, levels, scale = \"log\"

The output folder receives manifest.json, runs/NNNN-CASE/, results.csv (one line per metric), failures.csv and figures/.

Exit codes: 0 every run has results, 1 runs are missing, 2 bad input, 3 runs failed (see failures.csv).";

/// `bagnold sweep`
#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true, after_help = SWEEP_EXAMPLES)]
pub struct SweepArguments {
    /// Action on an existing sweep.
    #[command(subcommand)]
    pub action: Option<SweepAction>,
    /// TOML file with cases, varied parameters and their values.
    #[arg(value_name = "FILE.toml", required = true)]
    pub file: Option<PathBuf>,
    /// Folder of the sweep [default: reports/sweeps/FILE].
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Execution engine.
    #[arg(long, value_enum, default_value_t = Engine::Local)]
    pub engine: Engine,
    /// Options for Slurm.
    #[command(flatten)]
    pub cluster: Cluster,
    /// Resource limits of each run.
    #[command(flatten)]
    pub allowance: ResourceLimits,
    /// Execution options.
    #[command(flatten)]
    pub work: ExecutionOptions,
}

/// Engine of a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Engine {
    /// The threads of this machine.
    Local,
    /// A Slurm cluster that shares the folder of the sweep: one task per run.
    Slurm,
}

/// Action on an existing sweep.
#[derive(Debug, Subcommand)]
pub enum SweepAction {
    /// Collect the results of a sweep; resubmit missing runs on request.
    Collect {
        /// Folder of the sweep.
        #[arg(value_name = "DIR")]
        folder: PathBuf,
        /// Resubmit runs to Slurm that are neither finished nor queued.
        #[arg(long)]
        resubmit: bool,
        /// Request to Slurm.
        #[command(flatten)]
        cluster: Cluster,
    },
    /// Run one entry of the manifest, as a task of a cluster does.
    Task {
        /// Folder of the sweep.
        #[arg(value_name = "DIR")]
        folder: PathBuf,
        /// Number of the entry, from 1.
        #[arg(long, value_name = "N")]
        entry: usize,
        /// Execution options.
        #[command(flatten)]
        work: ExecutionOptions,
    },
    /// Print the default Slurm script, to edit for --template.
    Template,
}

/// Request to Slurm.
#[derive(Debug, Clone, Args)]
#[command(next_help_heading = "Slurm")]
pub struct Cluster {
    /// Partition [default: default partition of the cluster].
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
    /// Largest number of simultaneous runs.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub throttle: Option<u32>,
    /// Job script that replaces the one printed by `bagnold sweep template`.
    #[arg(long, value_name = "FILE")]
    pub template: Option<PathBuf>,
}
