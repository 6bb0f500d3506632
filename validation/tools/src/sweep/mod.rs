//! Many evaluations of one plan: a manifest, one folder per run, one table of results.
//!
//! ```text
//! FOLDER/manifest.json          what is to be run, with the key of every run
//! FOLDER/runs/0001-film/        case.toml, and when it is done record.postcard, metrics.json or failure.txt
//! FOLDER/results.csv            one line per metric; failures.csv, figures/
//! FOLDER/slurm/                 job script, job numbers and logs of the engine `slurm`
//! ```
//!
//! A run is done when its record is there, so a sweep that was killed resumes where it was, and Slurm's tasks, one per entry,
//! need nothing but the folder.

mod folder;
mod gather;
mod local;
mod manifest;
mod map;
mod plan;
pub mod slurm;

pub use folder::{SweepFolder, SweepProgress};
pub use gather::gather;
pub use local::{SweepMonitor, run_entry, run_locally};
pub use manifest::{Manifest, SweepRun};
pub use plan::SweepPlan;

/// JSON Schema of a plan.
pub fn schema() -> &'static serde_json::Value {
    bagnold_solver::parameter::schema_of::<plan::SweepText>()
}
